//! What a run leaves: band-limited accelerations at the sensors, and instantaneous positions and
//! contact forces.

use super::coupled::CoupledSystem;
use super::force::dot;
use crate::dynamics::{Instant, Observer};
use crate::series::{Decimator, SeriesError};

/// Signals of a run on one time grid; row-major tables have one row an instant.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RunRecord {
    /// Time of each instant, s.
    pub time_s: Vec<f64>,
    /// Shaft displacement in x, m.
    pub shaft_x: Vec<f64>,
    /// Shaft displacement in y, m.
    pub shaft_y: Vec<f64>,
    /// Acceleration of every sensor, m/s^2, band-limited to 0.4 of the output rate.
    pub sensors: Vec<(String, Vec<f64>)>,
    /// Radial positions of the balls [instants x balls], m: from the bearing centre, in `printed`
    /// from the ring's mean centre.
    pub ball_radius: Vec<f64>,
    /// Forces at the outer race [instants x balls], N.
    pub outer_force: Vec<f64>,
    /// Forces at the inner race [instants x balls], N.
    pub inner_force: Vec<f64>,
    /// Number of balls.
    pub balls: usize,
}

/// Takes the record while a run goes on.
///
/// A sensor's displacement, kept modes and static residual together, passes a linear-phase low-pass
/// that differentiates it twice and whose delay is removed. The acceleration of the equations of
/// motion is not used: in modes that a step does not resolve it is a small difference of large terms
/// of which the integrator holds only the position well. Positions and forces are taken as they are
/// at the instant.
#[derive(Debug)]
pub struct Recorder {
    ratio: u64,
    wanted: usize,
    tracks: Vec<Track>,
    record: RunRecord,
}

/// One sensor on its way to the output rate.
#[derive(Debug)]
struct Track {
    /// Takes displacements, gives accelerations.
    filter: Decimator,
    accelerations: Vec<f64>,
}

impl Recorder {
    /// A recorder that takes every `ratio`-th step of length `step` (s), up to `wanted` instants.
    ///
    /// # Errors
    /// [`SeriesError`] for a ratio of zero or a step that is not positive.
    pub fn new(
        system: &CoupledSystem,
        ratio: u32,
        step: f64,
        wanted: usize,
    ) -> Result<Self, SeriesError> {
        let filter = Decimator::second_derivative(ratio as usize, step)?;
        let tracks = system.sensors.iter().map(|_| Track {
            filter: filter.clone(),
            accelerations: Vec::with_capacity(wanted),
        });
        Ok(Self {
            ratio: u64::from(ratio),
            wanted,
            tracks: tracks.collect(),
            record: RunRecord {
                sensors: system
                    .sensors
                    .iter()
                    .map(|(name, _)| (name.clone(), Vec::new()))
                    .collect(),
                balls: system.setup.balls(),
                ..RunRecord::default()
            },
        })
    }

    /// Output intervals to go on past the last wanted instant, until its low-pass is complete.
    pub fn intervals_past_the_end(&self) -> u64 {
        self.tracks
            .first()
            .map_or(0, |track| track.filter.half_length_outputs() as u64)
    }

    /// The record, cut to the instants for which every signal is there.
    pub fn finish(self) -> RunRecord {
        let wanted = self.wanted;
        self.finish_first(wanted)
    }

    /// The record of a run that ended badly after `intervals` good output intervals: without the
    /// instants whose low-pass reaches beyond them.
    pub fn finish_after(self, intervals: u64) -> RunRecord {
        let good = intervals.saturating_sub(self.intervals_past_the_end());
        self.finish_first(usize::try_from(good).unwrap_or(usize::MAX))
    }

    fn finish_first(mut self, most: usize) -> RunRecord {
        let mut instants = self.record.time_s.len().min(self.wanted).min(most);
        for track in &self.tracks {
            instants = instants.min(track.accelerations.len());
        }
        let record = &mut self.record;
        for (track, (_, values)) in self.tracks.iter().zip(&mut record.sensors) {
            *values = track.accelerations[..instants].to_vec();
        }
        for column in [&mut record.time_s, &mut record.shaft_x, &mut record.shaft_y] {
            column.truncate(instants);
        }
        for table in [
            &mut record.ball_radius,
            &mut record.outer_force,
            &mut record.inner_force,
        ] {
            table.truncate(instants * record.balls);
        }
        self.record
    }
}

impl Observer<CoupledSystem> for Recorder {
    fn observe(&mut self, system: &CoupledSystem, now: Instant<'_>) {
        let modes = system.modes;
        for (sensor, track) in self.tracks.iter_mut().enumerate() {
            let modal = dot(&system.sensors[sensor].1, &now.y[..modes]);
            let residual = system.residual.as_ref().map_or(0.0, |residual| {
                let forces = system.balls.all(|ball| &ball.outer_radial);
                let row = residual.sensor_row(sensor).as_flattened().iter();
                row.zip(forces).map(|(row, force)| row * force).sum()
            });
            if let Some(acceleration) = track.filter.push(modal + residual) {
                track.accelerations.push(acceleration);
            }
        }
        if now.step.is_multiple_of(self.ratio) && self.record.time_s.len() < self.wanted {
            let record = &mut self.record;
            record.time_s.push(now.t);
            record.shaft_x.push(now.y[modes]);
            record.shaft_y.push(now.y[modes + 1]);
            let touching = system.inner_race.touching_radius;
            let balls = &system.balls;
            let displacements = balls.all(|ball| &ball.displacement);
            record
                .ball_radius
                .extend(displacements.map(|s| touching + s));
            record
                .outer_force
                .extend(balls.all(|ball| &ball.outer_magnitude));
            record
                .inner_force
                .extend(balls.all(|ball| &ball.inner_force));
        }
    }
}
