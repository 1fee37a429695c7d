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
    /// Radial positions of the balls from the bearing centre [instants x balls], m.
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
/// Accelerations contain frequencies far above the output rate, so they pass a linear-phase
/// low-pass whose delay is removed; positions and forces are taken as they are at the instant.
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
    /// Acceleration by the kept modes.
    modal: Decimator,
    /// Displacement by the modes left out, differentiated twice on the way.
    residual: Option<Decimator>,
    modal_values: Vec<f64>,
    residual_values: Vec<f64>,
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
        let modal = Decimator::new(ratio as usize)?;
        let residual = match system.residual {
            Some(_) => Some(Decimator::second_derivative(ratio as usize, step)?),
            None => None,
        };
        let tracks = system.sensors.iter().map(|_| Track {
            modal: modal.clone(),
            residual: residual.clone(),
            modal_values: Vec::with_capacity(wanted),
            residual_values: Vec::with_capacity(wanted),
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
            .map_or(0, |track| track.modal.half_length_outputs() as u64)
    }

    /// The record, cut to the instants for which every signal is there.
    pub fn finish(mut self) -> RunRecord {
        let mut instants = self.record.time_s.len().min(self.wanted);
        for track in &self.tracks {
            instants = instants.min(track.modal_values.len());
        }
        let record = &mut self.record;
        for (track, (_, values)) in self.tracks.iter().zip(&mut record.sensors) {
            *values = track.modal_values[..instants].to_vec();
            for (value, residual) in values.iter_mut().zip(&track.residual_values) {
                *value += residual;
            }
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
            let acceleration = dot(&system.sensors[sensor].1, &now.a[..modes]);
            if let Some(value) = track.modal.push(acceleration) {
                track.modal_values.push(value);
            }
            if let (Some(decimator), Some(residual)) = (&mut track.residual, &system.residual) {
                let displacement = dot(residual.sensor_row(sensor), &system.work.outer_radial);
                if let Some(value) = decimator.push(displacement) {
                    track.residual_values.push(value);
                }
            }
        }
        if now.step % self.ratio == 0 && self.record.time_s.len() < self.wanted {
            let record = &mut self.record;
            record.time_s.push(now.t);
            record.shaft_x.push(now.y[modes]);
            record.shaft_y.push(now.y[modes + 1]);
            let touching = system.inner.touching_radius;
            let radii = now.y[modes + 2..].iter().map(|s| touching + s);
            record.ball_radius.extend(radii);
            record.outer_force.extend_from_slice(&system.work.outer_magnitude);
            record.inner_force.extend_from_slice(&system.work.inner_force);
        }
    }
}
