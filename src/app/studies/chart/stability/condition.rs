//! What is varied, one at a time, and the scene that it gives.
//!
//! What short runs do: two that begin a little apart, side by side, against finer ones from the same starts.

use super::super::{Deadline, Effort};
use crate::app::case;
use crate::app::case::{Case, Defect, Load};
use crate::app::commands::run::choice::perturbation::perturb;
use crate::app::error::ComputeError;
use crate::app::scene::bearing::setup_of;
use crate::app::scene::contact_damping::PressedBall;
use crate::app::scene::{RunModel, Scene};
use crate::bearing::SpeedKnot;
use crate::fe::reduction::frf::ModalDamping;
use crate::numerics::ode::{Integration, Method, NoRecord, Schedule, State, TransientError};
use crate::report::significant;
use crate::system::{BearingSetup, CoupledSystem, Equilibrium, ModeSelection, StaticCondition};

/// Forces on the shaft, in units of those given.
const LOADS: [f64; 4] = [0.1, 0.3, 3.0, 10.0];
/// Radial play in ball radii, from preload to loose.
const PLAYS: [f64; 5] = [-3e-3, -1e-3, 0.0, 2.5e-3, 1e-2];
/// Shaft speeds, Hz.
const SPEEDS: [f64; 5] = [0.0, 10.0, 21.0, 45.0, 60.0];
/// Depths of all dents and flats, in units of those given.
const DEPTHS: [f64; 3] = [0.25, 0.5, 2.0];
/// Stiffness of both contacts, in units of those given.
const STIFFNESSES: [f64; 3] = [0.1, 10.0, 100.0];
/// Damping ratios, of the stiffest ball between its contacts and of all modes.
const RATIOS: [f64; 4] = [0.0, 0.01, 0.02, 0.05];

/// What is different from the case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Condition {
    /// Nothing.
    AsGiven,
    /// All forces on the shaft, its weight among them, times this.
    Load(f64),
    /// Radial play, m.
    RadialPlay(f64),
    /// Constant shaft speed, Hz.
    Speed(f64),
    /// Depths of dents and flats times this.
    DefectDepth(f64),
    /// Stiffness of both contacts times this.
    ContactStiffness(f64),
    /// Contact damping that gives the stiffest ball between its contacts this ratio.
    ContactDamping(f64),
    /// Ratio of all modes.
    ModalDamping(f64),
    /// All modes are kept.
    AllModes,
    /// All modes are kept, and nothing damps them.
    AllModesUndamped,
}

/// A scene under a condition, in a model's coordinates and at rest.
#[derive(Debug)]
pub(super) struct Variant {
    pub(super) system: CoupledSystem,
    pub(super) state: crate::numerics::ode::State,
    /// When its runs end, done or not.
    pub(super) until: Deadline,
}

impl Condition {
    /// All that fit a case; a quick map has the ends of each range.
    pub(crate) fn all(case: &Case, effort: Effort) -> Vec<Self> {
        let defects = case.bearing.as_ref().map_or(0, |of| of.defects.len());
        let radius = case.bearing.as_ref().map_or(0.0, |of| of.ball_radius);
        let ends = |values: &[f64]| -> Vec<f64> {
            match (effort, values) {
                (Effort::Quick, [first, .., last]) => vec![*first, *last],
                _ => values.to_vec(),
            }
        };
        let mut all = vec![Self::AsGiven];
        all.extend(ends(&LOADS).into_iter().map(Self::Load));
        all.extend(ends(&PLAYS).into_iter().map(|x| Self::RadialPlay(x * radius)));
        all.extend(ends(&SPEEDS).into_iter().map(Self::Speed));
        if defects > 0 {
            all.extend(ends(&DEPTHS).into_iter().map(Self::DefectDepth));
        }
        all.extend(ends(&STIFFNESSES).into_iter().map(Self::ContactStiffness));
        all.extend(ends(&RATIOS).into_iter().map(Self::ContactDamping));
        all.extend(ends(&RATIOS).into_iter().map(Self::ModalDamping));
        if effort == Effort::Full {
            all.push(Self::AllModes);
        }
        all.push(Self::AllModesUndamped);
        all
    }

    /// What is varied, its value, and the unit of that: "" for a ratio, "x" for a multiple of what is given.
    pub(crate) fn axis_and_value(self) -> (&'static str, Option<(f64, &'static str)>) {
        match self {
            Self::AsGiven => ("as given", None),
            Self::Load(factor) => ("load", Some((factor, "x"))),
            Self::RadialPlay(play) => ("radial play", Some((play, "m"))),
            Self::Speed(hz) => ("speed", Some((hz, "Hz"))),
            Self::DefectDepth(factor) => ("defect depth", Some((factor, "x"))),
            Self::ContactStiffness(factor) => ("contact stiffness", Some((factor, "x"))),
            Self::ContactDamping(ratio) => ("contact damping ratio", Some((ratio, ""))),
            Self::ModalDamping(ratio) => ("modal damping ratio", Some((ratio, ""))),
            Self::AllModes => ("all modes", None),
            Self::AllModesUndamped => ("all modes, undamped", None),
        }
    }

    /// In a few words.
    pub(crate) fn label(self) -> String {
        let (axis, value) = self.axis_and_value();
        match value {
            None => axis.to_owned(),
            Some((factor, "x")) => format!("{axis} × {factor}"),
            Some((metres, "m")) => format!("{axis} {} µm", round(1e6 * metres)),
            Some((hz, "Hz")) => format!("{axis} {hz} Hz"),
            Some((ratio, _)) => format!("{} {} %", axis.trim_end_matches(" ratio"), round(100.0 * ratio)),
        }
    }

    /// The scene of a case under it, with the model's coordinates.
    ///
    /// # Errors
    /// [`ComputeError`] for a condition that the bearing cannot be in.
    pub(super) fn variant(
        self,
        case: &Case,
        scene: &Scene,
        model: &RunModel,
        until: Deadline,
    ) -> Result<Variant, ComputeError> {
        let mut case = case.clone();
        self.apply(&mut case, scene);
        let run = case.for_stability()?;
        let setup = setup_of(run.case, run.bearing, run.shaft)?;
        let setup = BearingSetup { balls_inertia: model.balls_inertia, ..setup };
        let damping = match self {
            Self::ModalDamping(ratio) => ModalDamping::Uniform(ratio),
            Self::AllModesUndamped => ModalDamping::Uniform(0.0),
            _ => scene.damping.clone(),
        };
        let (modes, residual) = match self {
            Self::AllModes | Self::AllModesUndamped => (ModeSelection::All, false),
            _ => (model.modes, model.residual),
        };
        let stage = &scene.stage;
        let condition = StaticCondition::at(&setup, scene.start);
        let equilibrium = Equilibrium::find(&stage.structure, &setup, condition)?;
        let system = CoupledSystem::new(&stage.structure, &stage.modes, setup, modes, &damping, residual)?;
        let state = system.state_at(scene.start, &equilibrium, &stage.modes);
        Ok(Variant { system, state, until })
    }

    /// Changes the case; what concerns modes is left to the model.
    fn apply(self, case: &mut Case, scene: &Scene) {
        let stiffness = &scene.setup.stiffness;
        match (self, &mut case.shaft, &mut case.bearing) {
            (Self::Load(factor), Some(shaft), _) => load_by(shaft, factor),
            (Self::Speed(hz), ..) => {
                let profile = vec![SpeedKnot { time: 0.0, frequency_hz: hz }];
                case.speed = Some(case::Speed { profile });
            }
            (Self::RadialPlay(play), _, Some(bearing)) => bearing.radial_play = Some(play),
            (Self::DefectDepth(factor), _, Some(bearing)) => {
                for defect in &mut bearing.defects {
                    match defect {
                        Defect::Dent(dent) => dent.depth *= factor,
                        Defect::Flat(flat) => flat.depth *= factor,
                        // a measured depth is what it is
                        Defect::Measured(_) => {}
                    }
                }
            }
            (Self::ContactStiffness(factor), _, Some(bearing)) => {
                let [inner, outer] = [factor * stiffness.inner(), factor * stiffness.outer()];
                bearing.stiffness = case::ContactStiffness::Given { inner, outer };
            }
            (Self::ContactDamping(ratio), _, Some(bearing)) => {
                let ball = scene.pressed_ball(stiffness);
                bearing.contact_damping = ratio * ball.map_or(0.0, PressedBall::critical);
            }
            _ => {}
        }
    }
}

/// The shaft with `factor` times the forces on it, its weight among them; the balls' weight stays.
fn load_by(shaft: &mut case::Shaft, factor: f64) {
    for load in &mut shaft.loads {
        match load {
            Load::Constant(force) => *force = force.map(|part| factor * part),
            Load::Spatial { force, moment, .. } => {
                force.iter_mut().chain(moment).for_each(|part| *part *= factor);
            }
            Load::SpatialProfile { profile, .. } => {
                for point in profile {
                    point.force.iter_mut().chain(&mut point.moment).for_each(|part| *part *= factor);
                }
            }
            Load::Profile(points) => {
                for point in points {
                    point.force = point.force.map(|part| factor * part);
                }
            }
        }
    }
    let weight = shaft.gravity.map(|g| (factor - 1.0) * shaft.mass * g);
    shaft.loads.push(Load::Constant(weight));
}

/// Without digits that say nothing.
fn round(value: f64) -> String {
    let text = significant(value, 3);
    if text.contains('.') && !text.contains('e') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// Relative distance of the two starts: far above rounding, far below what changes contacts.
const APART: f64 = 1e-7;

/// Steps between two looks.
const STRIDE: u32 = 5;

/// A run may be so many times as fast as the finer one has been, and its distance from its neighbour so many times that of these:
/// balls that strike part nearby runs too, by other factors in other steps.
const FASTER: f64 = 10.0;
const FARTHER: f64 = 100.0;

/// Part of the finer runs' time whose largest values count from the beginning on: in the first moments all is at rest.
const BEGINNING: f64 = 0.1;

/// Where nothing moves, a velocity is told from none beside this part of the state's size at the fastest frequency: what a method moves
/// that does not keep the equilibrium is no growth.
const MOVING: f64 = 1e-2;

/// Largest velocity and distance so far of finer runs, over time.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Reference {
    every_s: f64,
    values: Vec<[f64; 2]>,
    /// Velocity that is none.
    still: f64,
}

/// Runs of a variant.
pub(super) struct Measurement<'a> {
    pub(super) variant: &'a Variant,
    /// Steps of a run.
    pub(super) steps: u32,
    /// What the finer runs do.
    pub(super) reference: &'a Reference,
}

impl Reference {
    /// Of so many steps of `h` (s) by `method`; `fastest` (1/s) is the order of the fastest motion. Runs that fail tell of their time
    /// until then.
    pub(super) fn of(variant: &Variant, method: Method, h: f64, steps: u32, fastest: f64) -> Self {
        let mut values = Vec::with_capacity((steps / STRIDE) as usize);
        let mut most = [0.0_f64; 2];
        let _ = observe(variant, method, h, steps, |_, now| {
            most = [0, 1].map(|k| most[k].max(now[k]));
            values.push(most);
            true
        });
        let size = variant.state.y.iter().map(|y| y * y).sum::<f64>().sqrt();
        Self { every_s: h * f64::from(STRIDE), values, still: MOVING * size * fastest }
    }

    /// Largest velocity and distance until a time after the start, s.
    fn until(&self, time: f64) -> [f64; 2] {
        let last = self.values.len().saturating_sub(1);
        let place = (time / self.every_s).max(BEGINNING * last as f64);
        let [speed, apart] = self.values.get((place as usize).min(last)).copied().unwrap_or([0.0; 2]);
        [speed.max(self.still), apart.max(APART * self.still)]
    }
}

impl Measurement<'_> {
    /// Whether runs with steps of `h` (s) do what fine ones do not; with the failure if there is one.
    pub(super) fn unstable(&self, method: Method, h: f64) -> (bool, Option<TransientError>) {
        let mut grown = false;
        let failure = observe(self.variant, method, h, self.steps, |time, [speed, apart]| {
            let [fast, far] = self.reference.until(time);
            grown = speed > FASTER * fast || apart > FARTHER * far;
            !grown
        })
        .err();
        (grown || failure.is_some(), failure)
    }
}

/// Runs of so many steps of `h` (s) from rest and from beside it; `see` is told the time since the start (s), the root of the sum
/// of the squared velocities and that of their difference, and says whether to go on. Gives the mean length of a step, s.
///
/// # Errors
/// Why they ended early.
pub(super) fn observe(
    variant: &Variant,
    method: Method,
    h: f64,
    steps: u32,
    mut see: impl FnMut(f64, [f64; 2]) -> bool,
) -> Result<f64, TransientError> {
    let intervals = (steps / STRIDE).max(1);
    let schedule =
        Schedule { interval: h * f64::from(STRIDE), steps_per_interval: STRIDE, intervals: u64::from(intervals) };
    let mut beside = variant.state.clone();
    perturb(&mut beside, APART, 1, 0);
    let mut systems = [variant.system.clone(), variant.system.clone()];
    let begin = |system: &mut _, state: State| Integration::begin(system, method, schedule, state, &mut NoRecord);
    let mut runs = [begin(&mut systems[0], variant.state.clone())?, begin(&mut systems[1], beside)?];
    for interval in 1..=intervals {
        for (run, system) in runs.iter_mut().zip(&mut systems) {
            run.advance(system, &mut NoRecord)?;
        }
        let [own, other] = [&runs[0], &runs[1]].map(|run| &run.state.v);
        let speed = own.iter().map(|v| v * v).sum::<f64>().sqrt();
        let pairs = own.iter().zip(other);
        let apart = pairs.map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
        if !see(f64::from(interval) * schedule.interval, [speed, apart]) || variant.until.is_over() {
            break;
        }
    }
    let taken = runs[0].statistics().steps.max(1) as f64;
    Ok(runs[0].intervals as f64 * schedule.interval / taken)
}
