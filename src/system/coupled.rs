//! The coupled system in modal coordinates: kept modes of the structure, shaft, balls.

use super::bearing_setup::{BallsInertia, BearingSetup, Formulation};
use super::equilibrium::Equilibrium;
use super::error::SystemError;
use super::force::REACH;
use super::inner::{InnerGap, InnerRace};
use super::lanes::{self, LANES, Lanes};
use super::race::{Damage, RaceContact, RaceForce};
use super::raceway::RacewayTable;
use super::residual::ResidualFlexibility;
use super::structure::{Structure, StructureModes};
use crate::bearing::{Race, RotationCursor};
use crate::dynamics::{LinearCoordinate, State};
use std::f64::consts::TAU;

/// Which modes of the structure a run keeps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ModeSelection {
    /// All of them: the same space as all nodal displacements.
    All,
    /// The lowest so many.
    Count(usize),
    /// Those up to a frequency, Hz.
    UpTo(f64),
}

/// Damping of the structure's modes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ModeDamping {
    /// `C = alpha M + beta K`: 2 zeta omega = alpha + beta omega^2; alpha in 1/s, beta in s.
    Rayleigh {
        /// Mass coefficient, 1/s.
        alpha: f64,
        /// Stiffness coefficient, s.
        beta: f64,
    },
    /// The same ratio zeta for every mode.
    Modal(f64),
}

impl ModeDamping {
    /// Rayleigh damping with the given ratios at two frequencies (Hz):
    /// `zeta = alpha / (2 omega) + beta omega / 2`.
    pub fn rayleigh_through(first: (f64, f64), second: (f64, f64)) -> Self {
        let (w1, w2) = (TAU * first.0, TAU * second.0);
        let beta = 2.0 * (second.1 * w2 - first.1 * w1) / (w2 * w2 - w1 * w1);
        Self::Rayleigh {
            alpha: 2.0 * first.1 * w1 - beta * w1 * w1,
            beta,
        }
    }

    /// 2 zeta omega of a mode, 1/s.
    pub fn coefficient(&self, squared_frequency: f64) -> f64 {
        match *self {
            Self::Rayleigh { alpha, beta } => alpha + beta * squared_frequency,
            Self::Modal(ratio) => 2.0 * ratio * squared_frequency.max(0.0).sqrt(),
        }
    }
}

impl ModeSelection {
    /// Number of lowest modes that the selection keeps.
    fn count(&self, modes: &StructureModes) -> usize {
        match *self {
            Self::All => modes.count(),
            Self::Count(count) => count.min(modes.count()),
            Self::UpTo(hz) => (0..modes.count())
                .take_while(|&mode| modes.frequency_hz(mode) <= hz)
                .count(),
        }
    }
}

/// Ring and housing by their modes, shaft and balls by their positions.
///
/// Coordinates: mode amplitudes (kg^1/2 m), shaft x and y (m), then for every ball with inertia its outward
/// displacement s (m) from touching the undeformed outer race, `rho = R_0 - rho_b + s`.
#[derive(Debug, Clone)]
pub struct CoupledSystem {
    pub(super) setup: BearingSetup,
    pub(super) inner_race: InnerRace,
    pub(super) inner: RaceContact,
    pub(super) outer: RaceContact,
    pub(super) linear: Vec<LinearCoordinate>,
    pub(super) modes: usize,
    /// Work of the weight on each kept mode, N kg^-1/2.
    pub(super) gravity: Vec<Lanes>,
    /// Radial displacement of the raceway by kept modes.
    pub(super) radial: RacewayTable,
    /// Tangential displacement at the raceway by kept modes.
    pub(super) tangential: RacewayTable,
    pub(super) residual: Option<ResidualFlexibility>,
    /// Mean displacement of the ring's nodes in x and y by kept modes (`printed` only).
    pub(super) centre: [Vec<f64>; 2],
    /// Sensor rows over kept modes.
    pub(super) sensors: Vec<(String, Vec<f64>)>,
    /// Gap (m) up to which a ball may be reached by what the others do, or by what rises from the race.
    pub(super) reach: f64,
    pub(super) balls: Balls,
    /// Of shaft and cage.
    pub(super) cursors: [RotationCursor; 2],
    pub(super) work: Work,
}

/// What does not change of the balls; groups of lanes are filled up with balls that touch nothing.
#[derive(Debug, Clone)]
pub(super) struct Balls {
    pub count: usize,
    /// Cosine and sine of each ball's angle from the first.
    pub spacing: Vec<[Lanes; 2]>,
    /// That angle in turns, 0 to 1.
    pub turns: Vec<Lanes>,
    /// 1 for a ball, 0 for what fills up a group.
    pub present: Vec<Lanes>,
    /// How much larger than nominal, m.
    pub oversize: Vec<f64>,
    pub oversize_lanes: Vec<Lanes>,
    /// Number of the ball's flat.
    pub flat: Vec<Option<usize>>,
    /// Bounds of the kept modes' radial displacement along the raceway.
    pub mode_bounds: Vec<Lanes>,
    /// Bound of what the weight adds, m.
    pub weight_bound: f64,
}

/// Buffers and results of the last force evaluation.
#[derive(Debug, Clone, Default)]
pub(super) struct Work {
    /// Of the kept modes \[groups\].
    pub amplitudes: Vec<Lanes>,
    pub velocities: Vec<Lanes>,
    pub modal_force: Vec<Lanes>,
    /// Radial rows of the balls that are near [balls x groups of modes].
    pub rows: Vec<Lanes>,
    /// Scratch: the tangential row or the slopes of one ball.
    pub scratch_row: Vec<Lanes>,
    /// Of the first ball, rad.
    pub cage_angle: f64,
    /// Cosine and sine of the shaft's angle.
    pub shaft_direction: [f64; 2],
    /// Cosine and sine.
    pub direction: Vec<[Lanes; 2]>,
    /// Angle in turns, 0 to 1.
    pub turn: Vec<Lanes>,
    /// Angle of each ball's flat from its radius vector, rad, and its speed in the fixed frame, rad/s.
    pub spin: Vec<[f64; 2]>,
    /// What the ball may feel at the outer race.
    pub damage: Vec<Damage>,
    /// Displacement of the last evaluation and its force.
    pub known: Vec<(f64, RaceForce)>,
    /// Ball displacements s, m, and their rates, m/s.
    pub displacement: Vec<Lanes>,
    pub displacement_rate: Vec<Lanes>,
    /// Displacement relative to the race, without the residual's part, m; minus infinity where it cannot be reached.
    pub gap: Vec<Lanes>,
    /// Velocity towards the outer race and along it, m/s.
    pub rate: Vec<[f64; 2]>,
    /// Radial force on the race, N.
    pub outer_radial: Vec<Lanes>,
    pub outer_tangential: Vec<f64>,
    /// Sum of contact force magnitudes, N.
    pub outer_magnitude: Vec<Lanes>,
    /// Overlap with the inner race, m.
    pub penetration: Vec<Lanes>,
    /// Distance from the inner race's centre, m, and unit vector from there.
    pub inner_distance: Vec<Lanes>,
    pub inner_normal: Vec<[Lanes; 2]>,
    /// Sum of contact force magnitudes, N.
    pub inner_force: Vec<Lanes>,
    /// Force on the inner race, N.
    pub on_inner: Vec<[Lanes; 2]>,
    /// Its reaction on the ball, along the radius vector, N.
    pub inner_along: Vec<Lanes>,
    /// Of all balls, N.
    pub on_shaft: [f64; 2],
}

impl CoupledSystem {
    /// Couples a structure and a bearing.
    ///
    /// With `residual` the static flexibility of the modes left out acts in the contacts and the
    /// sensors.
    ///
    /// # Errors
    /// [`SystemError::NotSupported`] for a free structure with `residual`;
    /// [`SystemError::PrintedNeedsAllModes`]; [`SystemError::NoModesKept`]; [`SystemError::BallsNeedInertia`] for balls
    /// without inertia in the `printed` equations or with contact damping.
    pub fn new(
        structure: &Structure,
        modes: &StructureModes,
        setup: BearingSetup,
        selection: ModeSelection,
        damping: ModeDamping,
        residual: bool,
    ) -> Result<Self, SystemError> {
        let count = selection.count(modes);
        let complete = count == modes.count();
        if count == 0 {
            return Err(SystemError::NoModesKept {
                lowest_hz: modes.frequency_hz(0),
            });
        }
        if setup.formulation == Formulation::Printed && !complete {
            return Err(SystemError::PrintedNeedsAllModes);
        }
        let dynamic = setup.balls_inertia == BallsInertia::Dynamic;
        if !dynamic && (setup.formulation == Formulation::Printed || setup.contact_damping > 0.0) {
            return Err(SystemError::BallsNeedInertia);
        }
        let kept: Vec<usize> = (0..count).collect();
        let balls = setup.balls();
        let residual = if residual && !complete {
            Some(ResidualFlexibility::new(structure, modes, &kept, balls)?)
        } else {
            None
        };
        let structural = kept.iter().map(|&mode| {
            let squared_frequency = modes.squared_frequencies[mode].max(0.0);
            LinearCoordinate {
                squared_frequency,
                damping: damping.coefficient(squared_frequency),
            }
        });
        let free = LinearCoordinate {
            squared_frequency: 0.0,
            damping: 0.0,
        };
        let linear = structural
            .chain(std::iter::repeat_n(
                free,
                if dynamic { 2 + balls } else { 2 },
            ))
            .collect();
        let over_modes = |row: &[f64]| -> Vec<f64> {
            kept.iter()
                .map(|&mode| modes.participation(mode, row))
                .collect()
        };
        let outer = RaceContact::new(&setup, Race::Outer);
        let ring = structure.ring();
        let arm = setup.raceway_arm(ring.section().radius);
        let radial = RacewayTable::new(ring, modes, &kept, |rows| rows.radial);
        let gravity = match setup.formulation {
            Formulation::Consistent => over_modes(structure.gravity()),
            Formulation::Printed => vec![0.0; count],
        };
        Ok(Self {
            inner_race: InnerRace::new(&setup.geometry),
            inner: RaceContact::new(&setup, Race::Inner),
            reach: REACH + outer.rise(),
            outer,
            linear,
            modes: count,
            gravity: lanes::filled(&gravity, 0.0),
            balls: Balls {
                mode_bounds: radial.bounds(),
                weight_bound: residual
                    .as_ref()
                    .map_or(0.0, ResidualFlexibility::weight_bound),
                ..Balls::new(&setup)
            },
            radial,
            tangential: RacewayTable::new(ring, modes, &kept, |rows| rows.tangential_at(arm)),
            residual,
            centre: [0, 1].map(|component| over_modes(&mean_row(structure, component))),
            sensors: structure
                .sensors()
                .iter()
                .map(|sensor| (sensor.name.clone(), over_modes(&sensor.row)))
                .collect(),
            cursors: [RotationCursor::default(); 2],
            work: Work::new(balls, count),
            setup,
        })
    }

    /// Number of kept modes.
    pub fn modes(&self) -> usize {
        self.modes
    }

    /// Largest omega^2 among the kept modes, 1/s^2.
    pub fn highest_squared_frequency(&self) -> f64 {
        self.linear
            .iter()
            .map(|coordinate| coordinate.squared_frequency)
            .fold(0.0, f64::max)
    }

    /// Whether the static residual of the modes left out is in use.
    pub fn has_residual(&self) -> bool {
        self.residual.is_some()
    }

    /// The bearing.
    pub fn setup(&self) -> &BearingSetup {
        &self.setup
    }

    /// Inverse of the least mass that a contact force can set in motion, 1/kg: a ball's, or without their inertia that of
    /// shaft and kept modes together.
    pub fn contact_mobility(&self) -> f64 {
        match self.setup.balls_inertia {
            BallsInertia::Dynamic => 1.0 / self.setup.geometry.ball_mass(),
            BallsInertia::QuasiStatic => {
                let bounds = self.balls.mode_bounds.as_flattened().iter();
                1.0 / self.setup.shaft.mass + bounds.map(|bound| bound * bound).sum::<f64>()
            }
        }
    }

    /// Ball displacements of the last evaluation \[balls\], m.
    pub(super) fn displacements(&self) -> &[f64] {
        &self.work.displacement.as_flattened()[..self.balls.count]
    }

    /// Radial forces of the last evaluation on the outer race \[balls\], N.
    pub(super) fn outer_radial(&self) -> &[f64] {
        &self.work.outer_radial.as_flattened()[..self.balls.count]
    }

    /// Contact forces of the last evaluation at the outer race \[balls\], N.
    pub(super) fn outer_magnitude(&self) -> &[f64] {
        &self.work.outer_magnitude.as_flattened()[..self.balls.count]
    }

    /// Contact forces of the last evaluation at the inner race \[balls\], N.
    pub(super) fn inner_magnitude(&self) -> &[f64] {
        &self.work.inner_force.as_flattened()[..self.balls.count]
    }

    /// State at rest in an equilibrium, the cage held at its angle at `t` (s).
    pub fn state_at(&self, t: f64, equilibrium: &Equilibrium, modes: &StructureModes) -> State {
        let amplitudes = (0..self.modes).map(|mode| {
            modes.participation(mode, &equilibrium.structure_load) / modes.squared_frequencies[mode]
        });
        let balls = match self.setup.balls_inertia {
            BallsInertia::Dynamic => equilibrium.balls.as_slice(),
            BallsInertia::QuasiStatic => &[],
        };
        let y: Vec<f64> = amplitudes
            .chain(equilibrium.shaft)
            .chain(balls.iter().map(|ball| ball.displacement))
            .collect();
        State {
            t,
            v: vec![0.0; y.len()],
            y,
        }
    }
}

impl Balls {
    /// Without the bounds.
    fn new(setup: &BearingSetup) -> Self {
        let count = setup.balls();
        let numbers = |f: &dyn Fn(usize) -> f64| -> Vec<f64> { (0..count).map(f).collect() };
        let turns = numbers(&|j| j as f64 / count as f64);
        let angle = |j: usize| TAU * turns[j];
        let cosines = lanes::filled(&numbers(&|j| angle(j).cos()), 1.0);
        let sines = lanes::filled(&numbers(&|j| angle(j).sin()), 0.0);
        let oversize = numbers(&|j| setup.oversize(j));
        Self {
            spacing: cosines
                .into_iter()
                .zip(sines)
                .map(|(c, s)| [c, s])
                .collect(),
            turns: lanes::filled(&turns, 0.0),
            present: lanes::filled(&vec![1.0; count], 0.0),
            oversize_lanes: lanes::filled(&oversize, 0.0),
            oversize,
            flat: (0..count)
                .map(|ball| setup.spin(ball, 0.0).map(|(flat, _)| flat))
                .collect(),
            mode_bounds: Vec::new(),
            weight_bound: 0.0,
            count,
        }
    }
}

impl Work {
    fn new(balls: usize, modes: usize) -> Self {
        let of_balls = || lanes::column(balls, 0.0);
        let of_modes = || lanes::column(modes, 0.0);
        let groups = of_balls().len();
        Self {
            amplitudes: of_modes(),
            velocities: of_modes(),
            modal_force: of_modes(),
            rows: vec![[0.0; LANES]; balls * of_modes().len()],
            scratch_row: of_modes(),
            cage_angle: 0.0,
            shaft_direction: [1.0, 0.0],
            direction: vec![[[0.0; LANES]; 2]; groups],
            turn: of_balls(),
            spin: vec![[0.0; 2]; balls],
            damage: vec![Damage::None; balls],
            known: vec![(0.0, RaceForce::default()); balls],
            displacement: of_balls(),
            displacement_rate: of_balls(),
            gap: lanes::column(balls, f64::NEG_INFINITY),
            rate: vec![[0.0; 2]; balls],
            outer_radial: of_balls(),
            outer_tangential: vec![0.0; balls],
            outer_magnitude: of_balls(),
            penetration: of_balls(),
            inner_distance: of_balls(),
            inner_normal: vec![[[0.0; LANES]; 2]; groups],
            inner_force: of_balls(),
            on_inner: vec![[[0.0; LANES]; 2]; groups],
            inner_along: of_balls(),
            on_shaft: [0.0; 2],
        }
    }

    /// Unit vector towards ball `j` from the bearing's centre.
    #[inline]
    pub fn direction_of(&self, j: usize) -> [f64; 2] {
        self.direction[j / LANES].map(|component| component[j % LANES])
    }

    /// Where ball `j` stands to the inner race.
    #[inline]
    pub fn inner_gap(&self, j: usize) -> InnerGap {
        let (group, lane) = (j / LANES, j % LANES);
        InnerGap {
            penetration: self.penetration[group][lane],
            distance: self.inner_distance[group][lane],
            normal: self.inner_normal[group].map(|component| component[lane]),
        }
    }
}

/// Mean of the ring nodes' displacement in one direction, the source's (11) and (12).
fn mean_row(structure: &Structure, component: usize) -> Vec<f64> {
    let nodes = structure.ring().nodes();
    let mut row = vec![0.0; structure.dof()];
    for node in 0..nodes {
        row[3 * node + component] = 1.0 / nodes as f64;
    }
    row
}
