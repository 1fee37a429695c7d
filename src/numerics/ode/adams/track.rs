//! One step of the exponential Adams method, coordinates side by side.

use super::flow::{Flow, GroupFlow};
use crate::numerics::lanes::{LANES, Lanes, each, from, fused, put, together};
use crate::numerics::ode::{Exchange, LinearCoordinate, SecondOrderSystem, SnapshotError};
use multiversion::multiversion;

/// A force that is the small difference of large parts is held to this share of them: with all of them quiet starts of a dented
/// bearing lost digits, with none every light touch was followed closely.
const OF_PARTS: f64 = 0.3;

/// What is known of a group of coordinates.
#[derive(Debug, Clone, Copy, Default)]
struct Group {
    /// At the start of the step.
    y: Lanes,
    v: Lanes,
    g: Lanes,
    /// Force and position a step before and two: what is through them and the present ones is the prediction.
    before: Lanes,
    place_before: Lanes,
    two_before: Lanes,
    place_two_before: Lanes,
    /// What the force is to free coordinates at the start of the step: springs that are stepped exactly, 1/s^2.
    spring: Lanes,
    /// Largest force, or share of its parts, so far.
    largest: Lanes,
    /// [`GroupFlow::over`] the step that is being tried.
    over: [Lanes; 3],
    /// What the prediction takes for the change of the force over it without what is a spring, as far as it follows from a line.
    line: Lanes,
    /// And from a parabola.
    parabola: Lanes,
    /// At the end of that step.
    position: Lanes,
    velocity: Lanes,
    force: Lanes,
    /// How far the force at its end is from the prediction.
    defect: Lanes,
}

/// The step that is being tried, and what the last one left.
#[derive(Debug)]
pub(super) struct Track {
    /// From here on coordinates have neither spring nor damper but what the force is to them.
    free: usize,
    /// Whether what the force is to them is stepped.
    with_springs: bool,
    /// Of the coordinates before `free`, then of the others.
    groups: Vec<Group>,
    /// Lengths of the last step and the one before, s; zero where there was none.
    past: [f64; 2],
    /// Whether the next prediction is a parabola.
    pub(super) quadratic: bool,
    weights: Weights,
    /// State and force at the end of the step that is being tried, as the system takes them.
    position: Vec<f64>,
    velocity: Vec<f64>,
    force: Vec<f64>,
    springs: Vec<f64>,
    sizes: Vec<f64>,
}

/// What the curves through the force depend on.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Stencil {
    /// Length of the step, s.
    step: f64,
    /// And of the two before; zero where there was none.
    past: [f64; 2],
    /// Whether the prediction is a parabola.
    quadratic: bool,
}

/// Newton's form of the curves through the force, by the lengths of the steps.
#[derive(Debug, Clone, Copy, Default)]
struct Weights {
    of: Stencil,
    /// Change over the step by that over the last one.
    line: f64,
    /// The quadratic part over the step by the changes over the last one and the one before.
    bow: [f64; 2],
    /// What that adds to the linear part.
    lean: f64,
    /// Parts of the curve through the new force too that grow with time, its square and its cube, by the defect and in units of
    /// [`GroupFlow::over`].
    correction: [f64; 3],
    /// Of the defect in the error.
    share: f64,
}

impl Weights {
    fn new(of: Stencil) -> Self {
        let (step, [last, before]) = (of.step, of.past);
        if last <= 0.0 {
            // no slope is known before the first step: it is of the second order
            return Self { of, correction: [1.0, 0.0, 0.0], ..Self::default() };
        }
        let (ratio, lean) = (step / last, last / step);
        let share = ratio / (1.0 + ratio);
        let mut weights =
            Self { of, line: ratio, bow: [0.0; 2], lean, correction: [share * lean, 2.0 * share, 0.0], share };
        if before > 0.0 {
            let square = step * step / (last + before);
            weights.bow = [square / last, square / before];
        }
        if of.quadratic {
            let two = (last + before) / step;
            let cubic = share / (1.0 + two);
            weights.correction = [lean * two, 2.0 * (lean + two), 3.0].map(|part| cubic * part);
        }
        weights
    }
}

/// Number of coordinates that are held by a spring or a damper of their own, up to the last such one.
pub(super) fn held(coordinates: &[LinearCoordinate]) -> usize {
    let held = |coordinate: &LinearCoordinate| coordinate.squared_frequency != 0.0 || coordinate.damping != 0.0;
    coordinates.iter().rposition(held).map_or(0, |last| last + 1)
}

impl Track {
    pub(super) fn new(coordinates: &[LinearCoordinate], with_springs: bool) -> Self {
        let free = held(coordinates);
        let blank = vec![0.0; coordinates.len()];
        let groups = free.div_ceil(LANES) + (coordinates.len() - free).div_ceil(LANES);
        Self {
            free,
            with_springs,
            groups: vec![Group::default(); groups],
            past: [0.0; 2],
            quadratic: false,
            weights: Weights::default(),
            position: blank.clone(),
            velocity: blank.clone(),
            force: blank.clone(),
            springs: blank.clone(),
            sizes: blank,
        }
    }

    /// Goes over a step from there under the line of the force, or the parabola.
    pub(super) fn predict(&mut self, flow: &Flow) {
        let now = Stencil { step: flow.step, past: self.past, quadratic: self.quadratic };
        if self.weights.of != now {
            self.weights = Weights::new(now);
        }
        predict(self, flow);
    }

    /// Evaluates the force at its end, and how far it is from the prediction: the largest share of the largest force of its
    /// coordinate so far.
    pub(super) fn evaluate(&mut self, system: &mut impl SecondOrderSystem, t: f64) -> f64 {
        system.force_into(t, &self.position, &self.velocity, &mut self.force);
        let [by_line, by_parabola] = compare(self);
        let defect = if self.quadratic { by_parabola } else { by_line };
        // a parabola needs a past to go through, and is worse than a line where a contact begins
        self.quadratic = self.with_springs && self.past[1] > 0.0 && by_parabola < by_line;
        defect
    }

    /// Takes the step, of `step` s: the velocity under the curve through the force at its end too.
    pub(super) fn accept(&mut self, step: f64, system: &impl SecondOrderSystem) {
        accept(self);
        if self.with_springs {
            self.find_springs(system);
        }
        self.past = [step, self.past[0]];
    }

    /// Hands out where the last step ended.
    pub(super) fn end(&self, y: &mut [f64], v: &mut [f64], g: &mut [f64]) {
        y.copy_from_slice(&self.position);
        v.copy_from_slice(&self.velocity);
        g.copy_from_slice(&self.force);
    }

    /// Takes the springs of the free coordinates, and the size of all forces, where the force was evaluated last.
    pub(super) fn find_springs(&mut self, system: &impl SecondOrderSystem) {
        system.own_springs_into(&mut self.springs, &mut self.sizes);
        take_springs(self);
    }

    /// Writes what the next step depends on, or reads it.
    ///
    /// # Errors
    /// [`SnapshotError`] for a snapshot of something else.
    pub(super) fn exchange(&mut self, words: &mut Exchange<'_, '_>) -> Result<(), SnapshotError> {
        words.numbers("lengths of the last steps", &mut self.past)?;
        words.flag(&mut self.quadratic)?;
        for (what, of) in [
            ("forces a step before", (|group| &mut group.before) as fn(&mut Group) -> &mut Lanes),
            ("positions a step before", |group| &mut group.place_before),
            ("forces two steps before", |group| &mut group.two_before),
            ("positions two steps before", |group| &mut group.place_two_before),
            ("springs", |group| &mut group.spring),
            ("largest forces", |group| &mut group.largest),
        ] {
            let mut values: Vec<f64> = self.groups.iter_mut().flat_map(|group| *of(group)).collect();
            words.numbers(what, &mut values)?;
            for (group, values) in self.groups.iter_mut().zip(values.chunks(LANES)) {
                *of(group) = from(values);
            }
        }
        Ok(())
    }
}

/// Calls `on` with each group and where its coordinates begin and end.
#[inline(always)]
fn each_group(
    groups: &mut [Group],
    [free, all]: [usize; 2],
    mut on: impl FnMut(usize, &mut Group, std::ops::Range<usize>),
) {
    let (held, others) = groups.split_at_mut(free.div_ceil(LANES));
    let mut number = 0;
    for (groups, first, end) in [(held, 0, free), (others, free, all)] {
        let mut start = first;
        for group in groups {
            let next = (start + LANES).min(end);
            on(number, group, start..next);
            (number, start) = (number + 1, next);
        }
    }
}

/// Begins where the state is.
#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"), dispatcher = "direct")]
pub(super) fn begin(track: &mut Track, [y, v, g]: [&[f64]; 3]) {
    let shape = [track.free, track.position.len()];
    each_group(&mut track.groups, shape, |_, group, place| {
        group.y = from(&y[place.clone()]);
        group.v = from(&v[place.clone()]);
        group.g = from(&g[place]);
    });
}

#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"), dispatcher = "direct")]
fn predict(track: &mut Track, flow: &Flow) {
    let Track { free, with_springs, weights, .. } = *track;
    let (position, velocity) = (&mut track.position, &mut track.velocity);
    let shape = [free, position.len()];
    each_group(&mut track.groups, shape, |number, group, place| {
        if with_springs && place.start >= free {
            let (own, springs) = GroupFlow::on_springs(flow.step, &group.spring);
            group.spring = springs;
            advance(group, &own, &weights);
        } else {
            advance(group, &flow.groups[number], &weights);
        }
        put(&group.position, &mut position[place.clone()]);
        put(&group.velocity, &mut velocity[place]);
    });
}

#[inline(always)]
fn advance(group: &mut Group, flow: &GroupFlow, weights: &Weights) {
    let (y, v, g, spring) = (&group.y, &group.v, &group.g, &group.spring);
    let (before, two_before) = (&group.before, &group.two_before);
    let (place, place_two) = (&group.place_before, &group.place_two_before);
    let rise = each(|l| fused(spring[l], y[l] - place[l], g[l] - before[l]));
    let earlier = each(|l| fused(spring[l], place[l] - place_two[l], before[l] - two_before[l]));
    let line = each(|l| weights.line * rise[l]);
    let bow = each(|l| fused(-weights.bow[1], earlier[l], weights.bow[0] * rise[l]));
    let lean = each(|l| fused(weights.lean, bow[l], line[l]));
    group.line = line;
    group.parabola = each(|l| lean[l] + bow[l]);
    group.over = flow.over;
    let curve = if weights.of.quadratic { [lean, bow] } else { [line, [0.0; LANES]] };
    let [linear, square] = &curve;
    group.position = each(|l| {
        let forced = fused(flow.square[l], square[l], fused(flow.ramp[l], linear[l], flow.response[l] * g[l]));
        fused(flow.position_position[l], y[l], fused(flow.position_velocity[l], v[l], forced))
    });
    let [over, ramp_over, _] = &flow.over;
    group.velocity = each(|l| {
        let forced = fused(over[l], linear[l], flow.position_velocity[l] * g[l]);
        let forced = fused(2.0 * ramp_over[l], square[l], forced);
        fused(flow.velocity_position[l], y[l], fused(flow.velocity_velocity[l], v[l], forced))
    });
}

/// Sets the defects; gives the largest error that line and parabola leave. What is not a number does not count.
#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"), dispatcher = "direct")]
fn compare(track: &mut Track) -> [f64; 2] {
    let shape = [track.free, track.position.len()];
    let (force, weights) = (&track.force, track.weights);
    let (mut by_line, mut by_parabola) = ([0.0; LANES], [0.0; LANES]);
    each_group(&mut track.groups, shape, |_, group, place| {
        group.force = from(&force[place]);
        let (next, now, largest) = (&group.force, &group.g, &group.largest);
        let (end, start, spring) = (&group.position, &group.y, &group.spring);
        let rise = each(|l| fused(spring[l], end[l] - start[l], next[l] - now[l]));
        let unit = each(|l| larger(largest[l], next[l].abs()) + f64::MIN_POSITIVE);
        let share = each(|l| weights.share / unit[l]);
        let (line, parabola) = (&group.line, &group.parabola);
        let from_line = each(|l| rise[l] - line[l]);
        let from_parabola = each(|l| rise[l] - parabola[l]);
        by_line = each(|l| larger(by_line[l], from_line[l].abs() * share[l]));
        by_parabola = each(|l| larger(by_parabola[l], from_parabola[l].abs() * share[l]));
        group.defect = if weights.of.quadratic { from_parabola } else { from_line };
    });
    [by_line, by_parabola].map(|of| together(of).into_iter().fold(0.0, f64::max))
}

/// The larger one; the first where the second is not a number.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}

#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"), dispatcher = "direct")]
fn accept(track: &mut Track) {
    let [line, square, cube] = track.weights.correction;
    let velocity = &mut track.velocity;
    let shape = [track.free, velocity.len()];
    each_group(&mut track.groups, shape, |_, group, place| {
        let (predicted, defect, over) = (&group.velocity, &group.defect, &group.over);
        group.v = each(|l| {
            let correction = fused(cube, over[2][l], fused(square, over[1][l], line * over[0][l]));
            fused(correction, defect[l], predicted[l])
        });
        put(&group.v, &mut velocity[place]);
        (group.place_two_before, group.two_before) = (group.place_before, group.before);
        (group.place_before, group.before) = (group.y, group.g);
        (group.y, group.g) = (group.position, group.force);
        let (force, largest) = (&group.force, &group.largest);
        group.largest = each(|l| larger(largest[l], force[l].abs()));
    });
}

#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"), dispatcher = "direct")]
fn take_springs(track: &mut Track) {
    let (free, springs, sizes) = (track.free, &track.springs, &track.sizes);
    let shape = [free, springs.len()];
    each_group(&mut track.groups, shape, |_, group, place| {
        let (size, largest) = (together(from(&sizes[place.clone()])), &group.largest);
        group.largest = each(|l| larger(largest[l], OF_PARTS * size[l]));
        if place.start >= free {
            group.spring = from(&springs[place]);
        }
    });
}
