//! What a run leaves: band-limited accelerations at the sensors, and instantaneous positions and
//! contact forces.

use super::record::{Column, RunRecord};
use super::simulated::Simulated;
use crate::numerics::ode::{Instant, Observer, Snapshot, SnapshotError, SnapshotReader};
use crate::numerics::series::{Decimator, DecimatorState, HALF_LENGTH_OUTPUTS, SeriesError};

/// Takes the record while a run goes on.
///
/// A sensor's displacement, kept modes and static residual together, passes a linear-phase low-pass
/// that differentiates it twice and whose delay is removed. The acceleration of the equations of
/// motion is not used: in modes that a step does not resolve it is a small difference of large terms
/// of which the integrator holds only the position well. Positions and forces are taken as they are
/// at the instant.
///
/// A sensor's value comes some output intervals after its instant ([`intervals_past_the_end`](Self::intervals_past_the_end)).
/// Rows leave the recorder when they are complete and confirmed: what it holds does not grow with time.
#[derive(Debug)]
pub struct Recorder {
    ratio: u64,
    wanted: usize,
    /// Rows begun.
    begun: usize,
    /// One a sensor: takes displacements, gives accelerations.
    filters: Vec<Decimator>,
    /// Rows that were not taken out; those whose sensors are still to come at the end.
    queue: RunRecord,
    /// Number of rows at the start of the queue that are good and may leave.
    pub(crate) confirmed: usize,
}

impl Recorder {
    /// A recorder that takes every `ratio`-th step of length `step` (s), up to `wanted` instants.
    ///
    /// # Errors
    /// [`SeriesError`] for a ratio of zero or a step that is not positive.
    pub fn new(system: &impl Simulated, ratio: u32, step: f64, wanted: usize) -> Result<Self, SeriesError> {
        let filter = Decimator::second_derivative(ratio as usize, step)?;
        let layout = system.layout();
        Ok(Self {
            ratio: u64::from(ratio),
            wanted,
            begun: 0,
            filters: vec![filter; layout.sensors.len()],
            queue: RunRecord::blank(layout),
            confirmed: 0,
        })
    }

    /// Output intervals to go on past the last wanted instant, until its low-pass is complete.
    pub fn intervals_past_the_end(&self) -> u64 {
        if self.filters.is_empty() { 0 } else { HALF_LENGTH_OUTPUTS as u64 }
    }

    /// Declares everything observed so far good: rows that are complete may leave. To be called between intervals; what a run
    /// that blows up showed in its last interval stays here.
    pub(crate) fn confirm(&mut self) {
        self.confirmed = self.queue.rows();
    }

    /// Takes these rows out.
    pub(crate) fn take_confirmed(&mut self) -> RunRecord {
        let rows = std::mem::take(&mut self.confirmed);
        self.queue.take_first(rows)
    }

    /// The record of a run that ended well, cut to the instants for which every signal is there.
    pub fn finish(mut self) -> RunRecord {
        self.confirm();
        self.take_confirmed()
    }

    /// Writes all that the rows to come depend on. Confirmed rows belong to those who took them out: to be called after
    /// [`take_confirmed`](Self::take_confirmed).
    pub(crate) fn remember(&self, snapshot: &mut Snapshot) {
        snapshot.count(self.begun as u64);
        for filter in &self.filters {
            let state = filter.state();
            snapshot.count(state.phase as u64);
            snapshot.count(state.intervals);
            snapshot.numbers(&state.accumulators);
            snapshot.option(state.first_value);
        }
        for column in self.queue.all_columns() {
            snapshot.numbers(self.queue.column(column));
        }
    }

    /// Reads what [`remember`](Self::remember) wrote, into a recorder made for the same system, step and instants.
    ///
    /// # Errors
    /// [`SnapshotError`] for a snapshot of something else.
    pub(crate) fn recall(&mut self, snapshot: &mut SnapshotReader) -> Result<(), SnapshotError> {
        let short = |_| SnapshotError::Short;
        self.begun = snapshot.count()?.try_into().map_err(short)?;
        for filter in &mut self.filters {
            let state = DecimatorState {
                phase: snapshot.count()?.try_into().map_err(short)?,
                intervals: snapshot.count()?,
                accumulators: snapshot.numbers()?,
                first_value: snapshot.option()?,
            };
            let other =
                SnapshotError::Other { what: "steps an output", expected: self.ratio, found: state.phase as u64 };
            *filter = filter.clone().with_state(&state).map_err(|_| other)?;
        }
        for values in self.queue.columns_mut() {
            *values = snapshot.numbers()?;
        }
        let (begun, balls) = (self.queue.time_s.len(), self.queue.balls);
        for column in self.queue.all_columns() {
            let (expected, found) = (begun * column.width(balls), self.queue.column(column).len());
            if found != expected && !matches!(column, Column::Sensor(_)) {
                let (expected, found) = (expected as u64, found as u64);
                return Err(SnapshotError::Other { what: "numbers of a column", expected, found });
            }
        }
        self.confirmed = 0;
        Ok(())
    }
}

impl<S: Simulated> Observer<S> for Recorder {
    fn observe(&mut self, system: &S, now: Instant<'_>) {
        for (sensor, filter) in self.filters.iter_mut().enumerate() {
            if let Some(acceleration) = filter.push(system.sensor_displacement(sensor, now.y)) {
                self.queue.sensors[sensor].1.push(acceleration);
            }
        }
        if now.step.is_multiple_of(self.ratio) && self.begun < self.wanted {
            self.begun += 1;
            system.record_into(&now, &mut self.queue);
        }
    }
}
