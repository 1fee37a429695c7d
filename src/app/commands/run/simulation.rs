//! A scene stepped through time by one model.

use super::recording::{Checkpoints, InMemory, Recording, RunRequest};
use crate::app::error::ComputeError;
use crate::app::scene::{RunModel, Scene};
use crate::numerics::ode::{
    BlowUp, Instant as Now, Integration, Method, Observer, Schedule, Snapshot, State, Statistics, TransientError,
};
use crate::numerics::series::{SeriesError, TimeSeries, TimeWindow, tolerance_steps};
use crate::system::{Column, EnergyBalance, EnergyMeter, Recorder, RunRecord, Simulated};
use sha2::{Digest, Sha256};
use std::time::Instant;

/// Rows that are handed on at once.
const BLOCK: usize = 4096;

/// Parts of the way at which progress is reported.
const PROGRESS_PARTS: u64 = 10_000;

/// What is simulated of a scene, from its start on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Length, s.
    pub duration: f64,
    /// Sampling rate of the signals, Hz.
    pub output_hz: f64,
}

/// How a simulation ended.
#[derive(Debug)]
pub enum RunEnd {
    /// At the end of its time.
    Complete,
    /// The solution blew up; what was recorded before is there.
    BlewUp(Box<BlowUp>),
}

/// Signals of a scene by one model, and what they took.
#[derive(Debug)]
pub struct Simulation<R = RunRecord> {
    /// Method used.
    pub method: Method,
    /// How the time was cut.
    pub schedule: Schedule,
    /// Kept modes of the structure.
    pub modes: usize,
    /// Whether the static residual of the others was in use.
    pub residual: bool,
    /// Steps and evaluations.
    pub statistics: Statistics,
    /// When it began, s.
    pub start_s: f64,
    /// Simulated time, s.
    pub simulated_s: f64,
    /// Wall time of the stepping alone, s; of a run that went on, of all its parts.
    pub stepping_s: f64,
    /// What of it passed before the run was resumed, s.
    pub before_s: f64,
    /// Signals.
    pub record: R,
    /// The energy balance from the start to the last step; `None` where it was not asked for, where the equations have none
    /// ([`EnergyMeter::new`]) and after a blow-up.
    pub energy: Option<EnergyBalance>,
    /// How it ended.
    pub end: RunEnd,
}

impl Simulation {
    /// Steps a scene through `span` from rest, its signals in memory; `fraction` is told how far it is, 0 to 1.
    ///
    /// # Errors
    /// [`ComputeError`]; a solution that blows up is no error here but a [`RunEnd`].
    pub fn from_rest(
        scene: &Scene,
        model: &RunModel,
        span: Span,
        fraction: impl Fn(f64),
    ) -> Result<Self, ComputeError> {
        Self::kept_from_rest(scene, model, span, false, &mut InMemory, fraction)
    }

    /// A sensor's acceleration as a series, m/s^2.
    ///
    /// # Errors
    /// [`ComputeError::Series`] if nothing was recorded.
    pub fn signal(&self, sensor: usize) -> Result<TimeSeries, ComputeError> {
        let values = self.record.sensors[sensor].1.clone();
        let step = self.schedule.interval;
        Ok(TimeSeries::new(self.start_s, step, UNIT, values)?)
    }
}

/// Unit of the sensors.
const UNIT: &str = "m/s^2";

impl<R: Recording> Simulation<R> {
    /// Steps a scene through `span` from rest, or goes on from a checkpoint, and with `energy` takes the balance of its energy.
    /// What it takes does not grow with time.
    ///
    /// # Errors
    /// [`ComputeError`], [`ComputeError::Interrupted`] among them, after which the checkpoints have all to go on; a solution that blows up
    /// is no error here but a [`RunEnd`].
    pub fn kept_from_rest(
        scene: &Scene,
        model: &RunModel,
        span: Span,
        energy: bool,
        checkpoints: &mut impl Checkpoints<Record = R>,
        fraction: impl Fn(f64),
    ) -> Result<Self, ComputeError> {
        let system = scene.system(model)?;
        let state = scene.at_rest(&system);
        Self::kept(system, state, model, span, energy, checkpoints, fraction)
    }

    /// The same of a system of a model from any state.
    pub(crate) fn kept(
        mut system: impl Simulated,
        state: State,
        model: &RunModel,
        span: Span,
        energy: bool,
        checkpoints: &mut impl Checkpoints<Record = R>,
        fraction: impl Fn(f64),
    ) -> Result<Self, ComputeError> {
        let start_s = state.t;
        let mut schedule = Schedule::covering(span.duration, 1.0 / span.output_hz, model.step)?;
        // an end between two samples has none beyond it
        let tolerance = tolerance_steps(start_s.abs() + span.duration, schedule.interval);
        schedule.intervals = schedule.intervals.min((span.duration * span.output_hz + tolerance) as u64);
        let wanted = usize::try_from(schedule.intervals).unwrap_or(usize::MAX).saturating_add(1);
        let (ratio, step) = (schedule.steps_per_interval, schedule.step());
        let recorder = Recorder::new(&system, ratio, step, wanted)?;
        schedule.intervals += recorder.intervals_past_the_end();
        let (record, snapshot) = checkpoints.open(system.layout())?;
        let mut stepping = Stepping {
            fingerprint: fingerprint(&mut system, &state),
            energy: energy.then(|| EnergyMeter::new(&system, step)).flatten(),
            recorder,
            record,
            end_s: start_s + span.duration,
            before_s: 0.0,
            clock: Instant::now(),
        };
        let mut integration = match snapshot {
            None => {
                let observers = &mut stepping.observers();
                Integration::begin(&mut system, model.method, schedule, state, observers)?
            }
            Some(snapshot) => {
                let integration = stepping.recall(&system, model.method, schedule, &snapshot)?;
                // all that was read is the same, and what was computed from it is not
                let another = "the model is not to the last bit that of the unfinished run: expected the same program and linear algebra libraries on the same kind of processor";
                integration.ok_or_else(|| ComputeError::input(another, ComputeError::ANEW))?
            }
        };
        let end = stepping.go(&mut system, &mut integration, schedule, checkpoints, fraction)?;
        checkpoints.close();
        let energy = match end {
            RunEnd::Complete => stepping.energy.as_ref(),
            RunEnd::BlewUp(_) => None,
        };
        let energy = energy.and_then(|meter| meter.balance(&mut system, &integration.state));
        Ok(Self {
            method: model.method,
            schedule,
            modes: system.kept_modes(),
            residual: system.uses_residual(),
            statistics: integration.statistics(),
            start_s,
            simulated_s: integration.state.t - start_s,
            stepping_s: stepping.wall_s(),
            before_s: stepping.before_s,
            record: stepping.record,
            energy,
            end,
        })
    }

    /// Simulated time over wall time of the stepping.
    pub(crate) fn realtime_factor(&self) -> f64 {
        self.simulated_s / self.stepping_s.max(f64::MIN_POSITIVE)
    }

    /// Length of a step, s; of a method with steps of its own their mean.
    pub(crate) fn step_s(&self) -> f64 {
        if self.method.chooses_its_steps() {
            self.simulated_s / (self.statistics.steps.max(1) as f64)
        } else {
            self.schedule.step()
        }
    }

    /// Part of a sensor's acceleration, m/s^2: a window with so many seconds before and after it as there are.
    ///
    /// # Errors
    /// [`ComputeError::Series`] for a window that is not in the record, and what reading it returns.
    pub(crate) fn stretch(&self, sensor: usize, window: TimeWindow, margin_s: f64) -> Result<TimeSeries, ComputeError> {
        let (rows, step) = (self.record.rows(), self.schedule.interval);
        if rows == 0 {
            return Err(SeriesError::empty().into());
        }
        window.check_inside(self.start_s, step, rows)?;
        let position = |t: f64| (t - self.start_s) / step;
        // a row more at each end: bounds may miss their instants by round-off
        let first = (position(window.from - margin_s).floor() - 1.0).max(0.0) as usize;
        let end = (position(window.to + margin_s).ceil() + 1.0).max(0.0) as usize;
        let mut values = Vec::new();
        self.record.read(Column::Sensor(sensor), first..end, &mut |piece| {
            values.extend_from_slice(piece);
            Ok(())
        })?;
        let start_s = self.start_s + first as f64 * step;
        Ok(TimeSeries::new(start_s, step, UNIT, values)?)
    }
}

/// A simulation under way.
struct Stepping<R> {
    fingerprint: [u64; 4],
    recorder: Recorder,
    energy: Option<EnergyMeter>,
    record: R,
    end_s: f64,
    /// Wall time of the parts before this one, s.
    before_s: f64,
    clock: Instant,
}

/// All that see the steps.
struct Observers<'a>(&'a mut Recorder, Option<&'a mut EnergyMeter>);

impl<S: Simulated> Observer<S> for Observers<'_> {
    fn observe(&mut self, system: &S, now: Now<'_>) {
        self.0.observe(system, now);
        if let Some(energy) = &mut self.1 {
            energy.observe(system, now);
        }
    }
}

impl<R: Recording> Stepping<R> {
    fn observers(&mut self) -> Observers<'_> {
        Observers(&mut self.recorder, self.energy.as_mut())
    }

    fn wall_s(&self) -> f64 {
        self.before_s + self.clock.elapsed().as_secs_f64()
    }

    /// Goes to the end, or as far as it comes.
    fn go<S: Simulated>(
        &mut self,
        system: &mut S,
        integration: &mut Integration<S>,
        schedule: Schedule,
        checkpoints: &mut impl Checkpoints<Record = R>,
        fraction: impl Fn(f64),
    ) -> Result<RunEnd, ComputeError> {
        let tell_every = (schedule.intervals / PROGRESS_PARTS).max(1);
        let tell = |done: u64| fraction(done as f64 / schedule.intervals as f64);
        tell(integration.intervals);
        self.save(integration, checkpoints)?;
        while !integration.is_complete() {
            if let Err(error) = integration.advance(system, &mut self.observers()) {
                self.append_confirmed()?;
                return match error {
                    TransientError::BlewUp(blow_up) => Ok(RunEnd::BlewUp(blow_up)),
                    other => Err(other.into()),
                };
            }
            self.recorder.confirm();
            if self.recorder.confirmed >= BLOCK {
                self.append_confirmed()?;
            }
            let done = integration.intervals;
            if done.is_multiple_of(tell_every) {
                tell(done);
            }
            match checkpoints.request() {
                RunRequest::GoOn => {}
                RunRequest::Checkpoint => self.save(integration, checkpoints)?,
                RunRequest::Stop if integration.is_complete() => {}
                RunRequest::Stop => {
                    self.save(integration, checkpoints)?;
                    return Err(ComputeError::Interrupted { at_s: integration.state.t, end_s: self.end_s });
                }
            }
        }
        self.save(integration, checkpoints)?;
        Ok(RunEnd::Complete)
    }

    /// Brings the rows that are good into the record.
    fn append_confirmed(&mut self) -> Result<(), ComputeError> {
        let rows = self.recorder.take_confirmed();
        self.record.append(&rows)
    }

    fn save<S: Simulated>(
        &mut self,
        integration: &mut Integration<S>,
        checkpoints: &mut impl Checkpoints<Record = R>,
    ) -> Result<(), ComputeError> {
        self.append_confirmed()?;
        let mut snapshot = Snapshot::default();
        for word in self.fingerprint {
            snapshot.count(word);
        }
        snapshot.number(self.wall_s());
        self.recorder.remember(&mut snapshot);
        snapshot.flag(self.energy.is_some());
        if let Some(energy) = &self.energy {
            energy.remember(&mut snapshot);
        }
        integration.remember(&mut snapshot).map_err(TransientError::from)?;
        checkpoints.save(&self.record, integration.state.t, &snapshot)
    }

    /// Takes up what [`save`](Self::save) wrote; `None` where that is of another model.
    fn recall<S: Simulated>(
        &mut self,
        system: &S,
        method: Method,
        schedule: Schedule,
        snapshot: &Snapshot,
    ) -> Result<Option<Integration<S>>, TransientError> {
        let mut reader = snapshot.reader();
        let mut same = true;
        for word in self.fingerprint {
            same &= reader.count()? == word;
        }
        if !same {
            return Ok(None);
        }
        self.before_s = reader.number()?;
        self.recorder.recall(&mut reader)?;
        if reader.flag()? != self.energy.is_some() {
            return Ok(None);
        }
        if let Some(energy) = &mut self.energy {
            energy.recall(&mut reader)?;
        }
        let integration = Integration::resume(system, method, schedule, &mut reader)?;
        reader.end()?;
        Ok(Some(integration))
    }
}

/// Tells models apart: SHA-256 of the linear part and of the force at the start, to the last bit.
fn fingerprint(system: &mut impl Simulated, start: &State) -> [u64; 4] {
    let mut force = vec![0.0; start.y.len()];
    system.force_into(start.t, &start.y, &start.v, &mut force);
    let linear = system.linear().iter();
    let linear = linear.flat_map(|linear| [linear.squared_frequency, linear.damping]);
    let mut hasher = Sha256::new();
    for value in linear.chain(start.y.iter().copied()).chain(force) {
        hasher.update(value.to_bits().to_le_bytes());
    }
    let digest: [u8; 32] = hasher.finalize().into();
    let (words, _) = digest.as_chunks();
    std::array::from_fn(|word| u64::from_be_bytes(words[word]))
}
