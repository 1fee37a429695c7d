//! How balls at equal spacing meet each other, the weight and the sensors through the residual flexibility, as the cage turns.
//!
//! Between two cage angles at which a ball passes from one element to the next all of it is smooth. These stretches are cut
//! until quintics with the values and slopes of their ends and their middle reproduce them to [`ACCURACY`]; a stretch lasts
//! many steps, and its quintics are made when it is entered.

use super::super::balls::BallGroup;
use super::super::raceway::{Quintic, slope, value, value_and_slope};
use super::{ResidualFlexibility, Touch};
use crate::numerics::lanes::{LANES, Lanes, each, first, first_mut, fused, together, total};
use multiversion::multiversion;
use std::f64::consts::TAU;

/// Largest deviation of the quintics, relative to the largest flexibility between balls. The residual is some percent of what a
/// contact gives way.
const ACCURACY: f64 = 1e-8;

/// Pieces at most into which a stretch between two element boundaries is cut.
const MOST_CUTS: usize = 16;

/// Couplings of all balls at the last cage angle.
///
/// Columns stand one behind the other, each of one group of lanes after the other: radial displacement of the balls for a
/// radial force at each ball (m/N), and their displacement under the weight (m). Each sensor's displacement for a radial
/// force at the balls (m/N) follows in the quintics alone: it is asked for where it is recorded.
#[derive(Debug, Clone)]
pub(in super::super) struct Coupling {
    pub(in super::super) residual: ResidualFlexibility,
    balls: usize,
    groups: usize,
    /// Stretches in a turn.
    stretches: usize,
    /// Two stretches: methods go back and forth over the end of one.
    made: [Stretch; 2],
    /// Which of the two, and the place in it.
    at: (usize, f64),
    /// Those of balls that are far from the race are stale.
    values: Vec<Lanes>,
    /// Derivatives of the balls' columns by the cage angle, m/(N rad).
    slopes: Vec<Lanes>,
}

#[derive(Debug, Clone)]
struct Stretch {
    number: usize,
    quintics: Vec<Quintic>,
}

impl Coupling {
    pub(crate) fn new(mut residual: ResidualFlexibility, balls: usize) -> Self {
        let groups = balls.div_ceil(LANES);
        let columns = balls + 1;
        let blank =
            |columns: usize| Stretch { number: usize::MAX, quintics: vec![[[0.0; LANES]; 6]; columns * groups] };
        // the balls say how finely a turn is cut
        let sensors = std::mem::take(&mut residual.sensors);
        let mut coupling = Self {
            stretches: least_common_multiple(residual.elements, balls),
            residual,
            balls,
            groups,
            made: [(); 2].map(|()| blank(columns)),
            at: (0, 0.0),
            // a state that is not a number reaches what fills up the last lanes: they have columns too
            values: vec![[0.0; LANES]; columns.max(groups * LANES) * groups],
            slopes: vec![[0.0; LANES]; groups * LANES * groups],
        };
        let between_elements = coupling.stretches;
        let mut cuts = 1;
        while cuts < MOST_CUTS && coupling.deviation() > ACCURACY {
            cuts *= 2;
            coupling.stretches = cuts * between_elements;
        }
        coupling.residual.sensors = sensors;
        let columns = columns + coupling.residual.sensors.len() / coupling.residual.width;
        coupling.made = [(); 2].map(|()| blank(columns));
        coupling
    }

    /// Turns to the angle of the first ball in turns, 0 <= turn < 1, with the weight's column.
    #[inline(always)]
    pub(crate) fn turn_to(&mut self, turn: f64) {
        let place = turn * self.stretches as f64;
        let number = (place as usize).min(self.stretches - 1);
        let slot = number & 1;
        if self.made[slot].number != number {
            self.make(slot, number);
        }
        let x = 2.0 * (place - number as f64) - 1.0;
        self.at = (slot, x);
        self.turn_column::<0>(self.balls, false);
    }

    /// Turns the column of ball `k` to the same angle, with its slopes if asked for.
    #[inline(always)]
    pub(crate) fn turn_column<const B: usize>(&mut self, k: usize, with_slopes: bool) {
        let (slot, x) = self.at;
        let range = k * self.groups..(k + 1) * self.groups;
        let quintics = first::<B, _>(&self.made[slot].quintics[range.clone()]);
        let values = first_mut::<B, _>(&mut self.values[range.clone()]);
        if !with_slopes {
            for (out, quintic) in values.iter_mut().zip(quintics) {
                *out = together(value(quintic, x));
            }
            return;
        }
        let scale = 2.0 * self.stretches as f64 / TAU;
        let slopes = first_mut::<B, _>(&mut self.slopes[range]);
        for ((value, slope), quintic) in values.iter_mut().zip(slopes).zip(quintics) {
            let [values, slopes] = value_and_slope(quintic, x);
            *value = together(values);
            *slope = together(each(|l| scale * slopes[l]));
        }
    }

    /// Radial displacement of the balls for radial forces at the four balls of a group \[groups\], m/N; `B` of the groups, or all for
    /// 0. Columns of balls that are far from the race are stale, but numbers.
    #[inline(always)]
    pub(crate) fn columns<const B: usize>(&self, group: usize) -> [&[Lanes]; LANES] {
        columns::<B>(&self.values, group, self.groups)
    }

    /// Their derivatives by the cage angle \[groups\], m/(N rad).
    #[inline(always)]
    pub(crate) fn slope_columns<const B: usize>(&self, group: usize) -> [&[Lanes]; LANES] {
        columns::<B>(&self.slopes, group, self.groups)
    }

    /// Radial displacement of ball `j` for a radial force at ball `k`, m/N.
    #[inline]
    pub(crate) fn between(&self, j: usize, k: usize) -> f64 {
        self.values[k * self.groups + j / LANES][j % LANES]
    }

    /// Radial displacement of the balls under the weight \[groups\], m.
    #[inline(always)]
    pub(crate) fn weight<const B: usize>(&self) -> &[Lanes] {
        first::<B, _>(&self.values[self.balls * self.groups..])
    }

    /// Displacement of a sensor for radial forces at the balls (N), m.
    #[inline]
    pub(crate) fn at_sensor(&self, sensor: usize, balls: &[BallGroup]) -> f64 {
        let (slot, x) = self.at;
        let first = (self.balls + 1 + sensor) * self.groups;
        displacement(&self.made[slot].quintics[first..first + self.groups], x, balls)
    }

    /// Rate by the cage angle (N m/rad) of the work of radial forces F at the balls, `F . w + F . G F / 2` with the flexibility
    /// between them G and their displacement under the weight w.
    pub(crate) fn work_by_turning(&self, force: impl Fn(usize) -> f64) -> f64 {
        let (slot, x) = self.at;
        let column = |k: usize| {
            let quintics = &self.made[slot].quintics[k * self.groups..(k + 1) * self.groups];
            let mut sum = 0.0;
            for (group, quintic) in quintics.iter().enumerate() {
                let slopes = slope(quintic, x);
                for (lane, slope) in slopes.into_iter().enumerate() {
                    let ball = group * LANES + lane;
                    if ball < self.balls {
                        sum += slope * force(ball);
                    }
                }
            }
            sum
        };
        let mut sum = column(self.balls);
        for k in 0..self.balls {
            let force = force(k);
            if force != 0.0 {
                sum += 0.5 * force * column(k);
            }
        }
        2.0 * self.stretches as f64 / TAU * sum
    }

    /// Makes the quintics of a stretch: even and odd powers apart.
    #[inline(never)]
    fn make(&mut self, slot: usize, number: usize) {
        let half = 0.5 * TAU / self.stretches as f64;
        let places = [-1.0, 0.0, 1.0].map(|x| self.touches(number, x));
        let mut stretch = std::mem::replace(&mut self.made[slot], Stretch { number, quintics: Vec::new() });
        self.each_entry(&places, |place, lane, [first, middle, last]| {
            let mean = |k: usize| 0.5 * (last[k] + first[k]);
            let rise = |k: usize| 0.5 * (last[k] - first[k]);
            let slope = half * middle[1];
            let (even, odd) = (mean(0) - middle[0], rise(0) - slope);
            let fourth = 0.5 * half * rise(1) - even;
            let fifth = 0.5 * (half * mean(1) - slope - 3.0 * odd);
            let powers = [fifth, fourth, odd - fifth, even - fourth, slope, middle[0]];
            for (lanes, power) in stretch.quintics[place].iter_mut().zip(powers) {
                lanes[lane] = power;
            }
        });
        self.made[slot].quintics = stretch.quintics;
    }

    /// Hands out value and slope (by the cage angle) of every entry at each of these places: its place among the columns'
    /// groups, its lane.
    fn each_entry<const N: usize>(&self, places: &[Vec<Touch>; N], mut take: impl FnMut(usize, usize, [[f64; 2]; N])) {
        let residual = &self.residual;
        let width = residual.width;
        for j in 0..self.balls {
            let (group, lane) = (j / LANES, j % LANES);
            for k in 0..=j {
                let entry = std::array::from_fn(|at| {
                    let touches = &places[at];
                    residual.between(&touches[j], &touches[k])
                });
                take(k * self.groups + group, lane, entry);
                take(j * self.groups + k / LANES, k % LANES, entry);
            }
            let others = residual.weight.chunks(width).chain(residual.sensors.chunks(width));
            for (column, over_ring) in (self.balls..).zip(others) {
                let entry = std::array::from_fn(|at| residual.along(over_ring, &places[at][j]));
                take(column * self.groups + group, lane, entry);
            }
        }
    }

    /// Where the balls are at a place, -1 to 1, in a stretch: in the elements in which they are inside it.
    fn touches(&self, number: usize, x: f64) -> Vec<Touch> {
        let elements = self.residual.elements;
        let by_stretch = elements as f64 / self.stretches as f64;
        let spacing = elements as f64 / self.balls as f64;
        let touch = |j: usize| {
            let element = |x: f64| (number as f64 + 0.5 * (x + 1.0)) * by_stretch + j as f64 * spacing;
            let whole = element(0.0).floor();
            let inside = (element(x) - whole).clamp(0.0, 1.0);
            self.residual.touch(whole as usize % elements, inside)
        };
        (0..self.balls).map(touch).collect()
    }

    /// Largest deviation at a quarter of stretches over a ball spacing, relative to the largest flexibility between balls.
    fn deviation(&mut self) -> f64 {
        let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
        let spacing = self.stretches.div_ceil(self.balls);
        for number in 0..spacing {
            self.make(0, number);
            let balls = self.balls * self.groups;
            let quintics = &self.made[0].quintics;
            self.each_entry(&[self.touches(number, 0.5)], |place, lane, [[exact, _]]| {
                if place < balls {
                    let found = value(&quintics[place], 0.5)[lane];
                    worst = worst.max((found - exact).abs());
                    largest = largest.max(exact.abs());
                }
            });
        }
        worst / largest.max(f64::MIN_POSITIVE)
    }
}

/// Sum over the radial forces at the balls (N), each times its quintic at a place.
#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"), dispatcher = "direct")]
fn displacement(quintics: &[Quintic], x: f64, balls: &[BallGroup]) -> f64 {
    let mut sums = [0.0; LANES];
    for (quintic, BallGroup { outer_radial, .. }) in quintics.iter().zip(balls) {
        let row = value(quintic, x);
        sums = each(|l| fused(row[l], outer_radial[l], sums[l]));
    }
    total(&sums)
}

#[inline(always)]
fn columns<const B: usize>(values: &[Lanes], group: usize, groups: usize) -> [&[Lanes]; LANES] {
    let start = group * LANES * groups;
    [0, 1, 2, 3].map(|l| first::<B, _>(&values[start + l * groups..start + (l + 1) * groups]))
}

fn least_common_multiple(a: usize, b: usize) -> usize {
    let (mut x, mut y) = (a, b);
    while y > 0 {
        (x, y) = (y, x % y);
    }
    a / x.max(1) * b
}

#[cfg(test)]
mod tests {
    use super::super::super::force::tangent_tests::structure;
    use super::*;

    #[test]
    fn quintics_are_the_interpolation_and_do_not_depend_on_the_way() {
        let structure = structure();
        let modes = structure.modes().unwrap();
        let residual = ResidualFlexibility::new(&structure, &modes, 10).unwrap();
        let balls = 7;
        let mut coupling = Coupling::new(residual.clone(), balls);
        let exact = |turn: f64| -> Vec<Touch> {
            let place = |j: usize| (turn + j as f64 / balls as f64) * residual.elements as f64;
            let touch = |place: f64| {
                let whole = place.floor();
                residual.touch(whole as usize % residual.elements, place - whole)
            };
            (0..balls).map(|j| touch(place(j))).collect()
        };
        let mut at = |turn: f64| -> Vec<f64> {
            coupling.turn_to(turn);
            let columns = (0..balls).map(|k| {
                coupling.turn_column::<0>(k, true);
                (0..balls).map(|j| coupling.between(j, k)).collect::<Vec<_>>()
            });
            columns.collect::<Vec<_>>().concat()
        };
        let first = at(0.123);
        let mut largest = 0.0_f64;
        let mut worst = 0.0_f64;
        for i in 0..200 {
            let turn = f64::from(i) * 0.618_034 % 1.0;
            let touches = exact(turn);
            for (place, found) in at(turn).into_iter().enumerate() {
                let [value, _] = residual.between(&touches[place % balls], &touches[place / balls]);
                worst = worst.max((found - value).abs());
                largest = largest.max(value.abs());
            }
        }
        // the accuracy is held at a quarter of each stretch; elsewhere it is of the same size
        assert!(worst < 3.0 * ACCURACY * largest, "{:e}", worst / largest);
        assert_eq!(at(0.123), first);
    }
}
