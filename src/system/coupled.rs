//! The coupled system in modal coordinates: kept modes of the structure, shaft, balls.

use super::balls::Balls;
use super::inner::InnerRace;
use super::powers::Powers;
use super::race::{Damage, RaceContact, Touch};
use super::raceway::RacewayTable;
use super::record::{RecordLayout, RunRecord};
use super::residual::{Coupling, ResidualFlexibility};
use super::simulated::Simulated;
use super::{BallsInertia, BearingSetup, Equilibrium, Formulation, Structure, StructureModes, SystemError};
use crate::bearing::{Race, RotationCursor};
use crate::fe::reduction::frf::ModalDamping;
use crate::numerics::lanes::{self, Lanes, scalar_product};
use crate::numerics::ode::{Instant, LinearCoordinate, State};

/// A ball that is farther from the race than this (m) cannot be reached by the residual
/// displacement that other balls cause: 1e-9 m/N under less than 100 N.
const REACH: f64 = 1e-7;

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

impl ModeSelection {
    /// Number of lowest modes that the selection keeps.
    pub(crate) fn count(&self, modes: &StructureModes) -> usize {
        match *self {
            Self::All => modes.count(),
            Self::Count(count) => count.min(modes.count()),
            Self::UpTo(hz) => (0..modes.count()).take_while(|&mode| modes.frequency_hz(mode) <= hz).count(),
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
    pub(super) residual: Option<Coupling>,
    /// Mean displacement of the ring's nodes in x and y by kept modes (`printed` only).
    pub(super) centre: [Vec<f64>; 2],
    /// Sensor rows over kept modes.
    pub(super) sensors: Vec<(String, Vec<f64>)>,
    /// Gap (m) up to which a ball may be reached by what the others do, or by what rises from the race.
    pub(super) reach: f64,
    pub(super) balls: Balls,
    /// Inverse masses of the shaft and of a ball, 1/kg.
    pub(super) shaft_mobility: f64,
    pub(super) ball_mobility: f64,
    /// Of shaft and cage.
    pub(super) cursors: [RotationCursor; 2],
    pub(super) work: Work,
}

/// Buffers and results of the last force evaluation, beside those of the balls.
#[derive(Debug, Clone, Default)]
pub(super) struct Work {
    /// Of the kept modes \[groups\].
    pub amplitudes: Vec<Lanes>,
    pub velocities: Vec<Lanes>,
    pub modal_force: Vec<Lanes>,
    /// Scratch: the tangential row or the slopes of one ball.
    pub scratch_row: Vec<Lanes>,
    /// Angle of the cage, rad, and its speed, rad/s.
    pub cage_angle: f64,
    pub cage_speed: f64,
    /// Cosine and sine of the shaft's angle.
    pub shaft_direction: [f64; 2],
    /// Angle of each ball's flat from its radius vector, rad, and its speed in the fixed frame, rad/s.
    pub spin: Vec<[f64; 2]>,
    /// What each ball may feel at the outer race, and which of them feel anything.
    pub damage: Vec<Damage>,
    pub damaged: Vec<usize>,
    /// Balls on waves or damage of the outer race; with a static residual what each of them touches.
    pub uneven: Vec<usize>,
    pub touch: Vec<Touch>,
    /// Displacement of the race under each ball without inertia, m.
    pub under: Vec<f64>,
    /// Of all balls, N.
    pub on_shaft: [f64; 2],
    /// Force that is evaluated for its tangent alone.
    pub force: Vec<f64>,
}

impl CoupledSystem {
    /// Couples a structure and a bearing.
    ///
    /// With `residual` the static flexibility of the modes left out acts in the contacts and the
    /// sensors.
    ///
    /// # Errors
    /// [`SystemError::NoModesKept`]; [`SystemError::Damping`]; [`SystemError::Refused`] for a free structure with `residual`, for `printed` equations without all
    /// modes, and for balls without inertia in them or with contact damping.
    pub fn new(
        structure: &Structure,
        modes: &StructureModes,
        setup: BearingSetup,
        selection: ModeSelection,
        damping: &ModalDamping,
        residual: bool,
    ) -> Result<Self, SystemError> {
        let count = selection.count(modes);
        let complete = count == modes.count() && !modes.has_more;
        if count == 0 {
            return Err(SystemError::NoModesKept { lowest_hz: modes.frequency_hz(0) });
        }
        if setup.formulation == Formulation::Printed && !complete {
            return Err(SystemError::Refused(
                "formulation = \"printed\" couples the balls to the ring's mean acceleration and needs all modes: set transient.modes = \"all\"",
            ));
        }
        let dynamic = setup.balls_inertia == BallsInertia::Dynamic;
        if !dynamic && (setup.formulation == Formulation::Printed || setup.contact_damping > 0.0) {
            return Err(SystemError::Refused(
                "balls_inertia = \"quasi-static\" leaves out how fast balls move, which contact_damping and formulation = \"printed\" need: set balls_inertia = \"dynamic\"",
            ));
        }
        let balls = setup.balls();
        let residual = if residual && !complete {
            Some(Coupling::new(ResidualFlexibility::new(structure, modes, count)?, balls))
        } else {
            None
        };
        let rates = damping.rates(&modes.squared_frequencies)?;
        let structural = modes.squared_frequencies[..count].iter().zip(rates);
        let structural =
            structural.map(|(square, damping)| LinearCoordinate { squared_frequency: square.max(0.0), damping });
        let free = LinearCoordinate { squared_frequency: 0.0, damping: 0.0 };
        let linear = structural.chain(std::iter::repeat_n(free, if dynamic { 2 + balls } else { 2 })).collect();
        let over_modes = |row: &[f64]| -> Vec<f64> { (0..count).map(|mode| modes.participation(mode, row)).collect() };
        let outer = RaceContact::new(&setup, Race::Outer);
        let ring = structure.ring();
        // mean of the ring nodes' displacement in one direction, the source's (11) and (12)
        let mean_row = |component: usize| -> Vec<f64> {
            let is_mean = |row: usize| row < 3 * ring.nodes() && row % 3 == component;
            let share = 1.0 / ring.nodes() as f64;
            (0..structure.dof()).map(|row| if is_mean(row) { share } else { 0.0 }).collect()
        };
        let arm = setup.raceway_arm(ring.section().radius);
        let radial = RacewayTable::new(ring, modes, count, |rows| rows.radial);
        let gravity = match setup.formulation {
            Formulation::Consistent => over_modes(structure.gravity()),
            Formulation::Printed => vec![0.0; count],
        };
        Ok(Self {
            inner_race: InnerRace::new(&setup.geometry),
            inner: RaceContact::new(&setup, Race::Inner),
            reach: REACH + outer.rise,
            outer,
            linear,
            modes: count,
            gravity: lanes::filled(&gravity, 0.0),
            shaft_mobility: 1.0 / setup.shaft.mass,
            ball_mobility: 1.0 / setup.geometry.ball_mass(),
            balls: Balls {
                mode_bounds: radial.bounds(),
                weight_bound: residual.as_ref().map_or(0.0, |coupling| coupling.residual.weight_bound()),
                ..Balls::new(&setup, radial.groups)
            },
            radial,
            tangential: RacewayTable::new(ring, modes, count, |rows| rows.tangential_at(arm)),
            residual,
            centre: [0, 1].map(|component| over_modes(&mean_row(component))),
            sensors: structure.sensors().iter().map(|sensor| (sensor.name.clone(), over_modes(&sensor.row))).collect(),
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
    pub(crate) fn highest_squared_frequency(&self) -> f64 {
        self.linear.iter().map(|coordinate| coordinate.squared_frequency).fold(0.0, f64::max)
    }

    /// The bearing.
    pub fn setup(&self) -> &BearingSetup {
        &self.setup
    }

    /// Inverse of the least mass that a contact force can set in motion, 1/kg: a ball's, or without their inertia that of
    /// shaft and kept modes together.
    pub(crate) fn contact_mobility(&self) -> f64 {
        match self.setup.balls_inertia {
            BallsInertia::Dynamic => self.ball_mobility,
            BallsInertia::QuasiStatic => {
                let bounds = self.balls.mode_bounds.as_flattened().iter();
                self.shaft_mobility + bounds.map(|bound| bound * bound).sum::<f64>()
            }
        }
    }

    /// State at rest in an equilibrium, the cage held at its angle at `t` (s).
    pub fn state_at(&self, t: f64, equilibrium: &Equilibrium, modes: &StructureModes) -> State {
        let amplitudes = (0..self.modes)
            .map(|mode| modes.participation(mode, &equilibrium.structure_load) / modes.squared_frequencies[mode]);
        let balls = match self.setup.balls_inertia {
            BallsInertia::Dynamic => equilibrium.balls.as_slice(),
            BallsInertia::QuasiStatic => &[],
        };
        let y: Vec<f64> =
            amplitudes.chain(equilibrium.shaft).chain(balls.iter().map(|ball| ball.displacement)).collect();
        State { t, v: vec![0.0; y.len()], y }
    }
}

impl Simulated for CoupledSystem {
    fn layout(&self) -> RecordLayout {
        let sensors = self.sensors.iter().map(|(name, _)| name.clone()).collect();
        RecordLayout { sensors, balls: self.balls.count, in_space: false }
    }

    fn kept_modes(&self) -> usize {
        self.modes
    }

    fn uses_residual(&self) -> bool {
        self.residual.is_some()
    }

    fn sensor_displacement(&self, sensor: usize, y: &[f64]) -> f64 {
        let modal = scalar_product(&self.sensors[sensor].1, &y[..self.modes]);
        let balls = &self.balls.groups;
        let residual = self.residual.as_ref().map_or(0.0, |residual| residual.at_sensor(sensor, balls));
        modal + residual
    }

    fn record_into(&self, now: &Instant<'_>, record: &mut RunRecord) {
        record.time_s.push(now.t);
        record.shaft_x.push(now.y[self.modes]);
        record.shaft_y.push(now.y[self.modes + 1]);
        let touching = self.inner_race.touching_radius;
        record.ball_radius.extend(self.balls.all(|ball| &ball.displacement).map(|s| touching + s));
        record.outer_force.extend(self.balls.all(|ball| &ball.outer_magnitude));
        record.inner_force.extend(self.balls.all(|ball| &ball.inner_force));
    }

    fn has_energy(&self) -> bool {
        self.keeps_energy()
    }

    fn stored_energy(&self, now: &Instant<'_>) -> f64 {
        self.energy_at(now)
    }

    fn find_powers(&self, now: &Instant<'_>, powers: &mut Powers) {
        powers.find(self, now);
    }
}

impl Work {
    fn new(balls: usize, modes: usize) -> Self {
        let of_modes = || lanes::column(modes, 0.0);
        Self {
            amplitudes: of_modes(),
            velocities: of_modes(),
            modal_force: of_modes(),
            scratch_row: of_modes(),
            shaft_direction: [1.0, 0.0],
            spin: vec![[0.0; 2]; balls],
            damage: vec![Damage::None; balls],
            damaged: Vec::with_capacity(balls),
            uneven: Vec::with_capacity(balls),
            touch: vec![Touch::default(); balls],
            under: vec![0.0; balls],
            ..Self::default()
        }
    }
}
