//! Structure, rigid shaft and the balls of several bearings as one system of second order.

use super::balls::BearingBalls;
use super::equilibrium::SpatialEquilibrium;
use super::setup::{SHAFT, SpatialSetup};
use crate::bearing::RotationCursor;
use crate::fe::reduction::frf::ModalDamping;
use crate::numerics::lanes::{self, Lanes, scalar_product};
use crate::numerics::ode::{Instant, LinearCoordinate, State};
use crate::system::{
    ModeSelection, Powers, RecordLayout, RunRecord, Simulated, Structure, StructureModes, SystemError,
};

/// Structure by its modes, shaft and balls by their places.
///
/// Coordinates: mode amplitudes (kg^1/2 m); x, y, z of the shaft's centre of mass (m) and its tilts about x and y (rad); then
/// bearing by bearing the radial places of its balls and their axial places (m), both from the outer groove's centre at rest. The kept
/// modes have no static residual: what the others give to the contacts is left out.
#[derive(Debug, Clone)]
pub struct SpatialSystem {
    pub(super) setup: SpatialSetup,
    pub(super) linear: Vec<LinearCoordinate>,
    pub(super) modes: usize,
    /// Work of the weight on each kept mode, N kg^-1/2.
    pub(super) gravity: Vec<Lanes>,
    pub(super) bearings: Vec<BearingBalls>,
    /// Sensor rows over kept modes.
    pub(super) sensors: Vec<(String, Vec<f64>)>,
    pub(super) shaft_cursor: RotationCursor,
    pub(super) work: Work,
}

/// Buffers of the last evaluation.
#[derive(Debug, Clone, Default)]
pub(super) struct Work {
    pub amplitudes: Vec<Lanes>,
    pub velocities: Vec<Lanes>,
    pub modal_force: Vec<Lanes>,
    pub scratch_row: Vec<Lanes>,
    /// Cosine and sine of the shaft's angle.
    pub shaft_direction: [f64; 2],
    /// Force that is evaluated for its overlaps alone.
    pub force: Vec<f64>,
}

impl SpatialSystem {
    /// Couples a structure, whose ring k is that of bearing k, and a shaft in its bearings.
    ///
    /// # Errors
    /// [`SystemError::NoModesKept`]; [`SystemError::Damping`]; [`SystemError::Refused`] for rings in their plane;
    /// [`SystemError::OtherSize`] for another number of rings than bearings.
    pub fn new(
        structure: &Structure,
        modes: &StructureModes,
        setup: SpatialSetup,
        selection: ModeSelection,
        damping: &ModalDamping,
    ) -> Result<Self, SystemError> {
        let seats = structure.rings().seats();
        if seats.len() != setup.bearings.len() || seats.is_empty() {
            let (rings, bearings) = (seats.len(), setup.bearings.len());
            return Err(SystemError::OtherSize(format!(
                "{rings} rings and {bearings} bearings: expected one ring each"
            )));
        }
        if !seats.iter().all(|seat| seat.ring.is_in_space()) {
            return Err(SystemError::Refused(
                "a bearing in space needs a ring in space: give a solid housing, or forces in the bearing's plane alone",
            ));
        }
        let count = selection.count(modes);
        if count == 0 {
            let lowest_hz = modes.squared_frequencies.first().map_or(f64::NAN, |_| modes.frequency_hz(0));
            return Err(SystemError::NoModesKept { lowest_hz });
        }
        let rates = damping.rates(&modes.squared_frequencies)?;
        let structural = modes.squared_frequencies[..count].iter().zip(rates);
        let structural =
            structural.map(|(square, damping)| LinearCoordinate { squared_frequency: square.max(0.0), damping });
        let free = LinearCoordinate { squared_frequency: 0.0, damping: 0.0 };
        let linear = structural.chain(std::iter::repeat_n(free, SHAFT + 2 * setup.balls())).collect();
        let over_modes = |row: &[f64]| -> Vec<f64> { (0..count).map(|mode| modes.participation(mode, row)).collect() };
        let bearings = setup.bearings.iter().zip(seats);
        let bearings = bearings.map(|(own, seat)| BearingBalls::new(own, seat, modes, count)).collect();
        let of_modes = || lanes::column(count, 0.0);
        Ok(Self {
            linear,
            modes: count,
            gravity: lanes::filled(&over_modes(structure.gravity()), 0.0),
            bearings,
            sensors: structure.sensors().iter().map(|sensor| (sensor.name.clone(), over_modes(&sensor.row))).collect(),
            shaft_cursor: RotationCursor::default(),
            work: Work {
                amplitudes: of_modes(),
                velocities: of_modes(),
                modal_force: of_modes(),
                scratch_row: of_modes(),
                shaft_direction: [1.0, 0.0],
                force: Vec::new(),
            },
            setup,
        })
    }

    /// First coordinate of the balls of each bearing, with their number.
    pub(super) fn ball_ranges(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let first = self.modes + SHAFT;
        self.bearings.iter().scan(first, |next, bearing| {
            let own = *next;
            *next += 2 * bearing.count;
            Some((own, bearing.count))
        })
    }
}

impl SpatialSystem {
    /// State at rest in an equilibrium, the cages held at their angles at `t` (s).
    pub(crate) fn state_at(&self, t: f64, equilibrium: &SpatialEquilibrium, modes: &StructureModes) -> State {
        let amplitudes = (0..self.modes)
            .map(|mode| modes.participation(mode, &equilibrium.structure_load) / modes.squared_frequencies[mode]);
        let mut y: Vec<f64> = amplitudes.chain(equilibrium.shaft).collect();
        for balls in &equilibrium.bearings {
            y.extend([0, 1].iter().flat_map(|&way| balls.iter().map(move |ball| ball.place[way])));
        }
        State { t, v: vec![0.0; y.len()], y }
    }
}

impl Simulated for SpatialSystem {
    fn layout(&self) -> RecordLayout {
        let sensors = self.sensors.iter().map(|(name, _)| name.clone()).collect();
        RecordLayout { sensors, balls: self.setup.balls(), in_space: true }
    }

    fn kept_modes(&self) -> usize {
        self.modes
    }

    fn uses_residual(&self) -> bool {
        false
    }

    fn sensor_displacement(&self, sensor: usize, y: &[f64]) -> f64 {
        scalar_product(&self.sensors[sensor].1, &y[..self.modes])
    }

    fn record_into(&self, now: &Instant<'_>, record: &mut RunRecord) {
        record.time_s.push(now.t);
        let shaft = &now.y[self.modes..];
        let columns =
            [&mut record.shaft_x, &mut record.shaft_y, &mut record.shaft_z, &mut record.tilt_x, &mut record.tilt_y];
        for (column, value) in columns.into_iter().zip(shaft) {
            column.push(*value);
        }
        for bearing in &self.bearings {
            record.ball_radius.extend(bearing.all(|ball| &ball.place[0]).map(|s| bearing.base + s));
            record.ball_axial.extend(bearing.all(|ball| &ball.place[1]));
            record.inner_force.extend(bearing.all(|ball| &ball.loads[0]));
            record.outer_force.extend(bearing.all(|ball| &ball.loads[1]));
            record.inner_angle.extend(bearing.angles(|ball| &ball.inner, -1.0));
            record.outer_angle.extend(bearing.angles(|ball| &ball.outer, 1.0));
        }
    }

    fn has_energy(&self) -> bool {
        true
    }

    fn stored_energy(&self, now: &Instant<'_>) -> f64 {
        self.energy_at(now)
    }

    fn find_powers(&self, now: &Instant<'_>, powers: &mut Powers) {
        let flow = self.flow(now, &mut powers.velocities, &mut powers.row);
        powers.flows = [flow.loads, flow.rotation, flow.modal_damping, flow.contact_damping, flow.blending];
        powers.yielding.fill([0.0; 2]);
    }
}
