//! The signals of a shard: a task each, around structures that are built once.

use super::drawn::Signal;
use super::manifest::SignalRecord;
use super::noise::Around;
use super::plan::DatasetPlan;
use super::recorder::{Recorded, ThroughChannel};
use super::spec::Untrusted;
use crate::app::case::Case;
use crate::app::commands::run::{RunEnd, step_run};
use crate::app::error::ComputeError;
use crate::app::scene::CoupledStructure;
use crate::files::hex;
use crate::numerics::Watch;
use crate::numerics::series::{TimeWindow, root_mean_square};
use crate::signal::diagnosis::{Fault, Kinematics};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Structures that are in memory at once, for each thread.
const MOST_STRUCTURES: usize = 4;

/// What a data set's computation tells, and what ends it.
#[derive(Clone, Copy)]
pub(crate) struct Work<'a> {
    /// Told of each signal that is done.
    pub(crate) done: &'a (dyn Fn() + Sync),
    /// Set to stop.
    pub(crate) stop: &'a AtomicBool,
    /// Folder that keeps condensed housings.
    pub(crate) cache: Option<&'a Path>,
}

/// A signal with its samples, if it could be computed.
#[derive(Debug)]
pub(super) struct Computed {
    pub(super) record: SignalRecord,
    pub(super) samples: Option<Vec<f32>>,
}

/// Housings by the values that they follow from.
#[derive(Debug, Default)]
pub(crate) struct Structures(BTreeMap<String, Result<Arc<CoupledStructure>, String>>);

/// Condenses in silence.
struct Kept<'a>(Option<&'a Path>);

impl Watch for Kept<'_> {
    fn stage(&self, _: &str) {}

    fn fraction(&self, _: f64) {}

    fn cache(&self) -> Option<&Path> {
        self.0
    }
}

/// Does so many tasks on as many threads as there are, and keeps their order. Each thread has a pool of its own for what its task does in
/// parallel: what is computed does not depend on the number of threads.
///
/// # Errors
/// [`ComputeError::Failed`] if a thread cannot be started.
fn on_threads<T: Send>(count: usize, task: impl Fn(usize) -> T + Sync) -> Result<Vec<T>, ComputeError> {
    let next = AtomicUsize::new(0);
    let alone = || -> Result<Vec<(usize, T)>, ComputeError> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let pool = pool.map_err(|error| ComputeError::Failed { what: format!("threads: {error}"), help: None })?;
        let taken = || Some(next.fetch_add(1, Ordering::Relaxed)).filter(|place| *place < count);
        Ok(pool.install(|| std::iter::from_fn(taken).map(|place| (place, task(place))).collect()))
    };
    let threads = rayon::current_num_threads().clamp(1, count.max(1));
    let done: Vec<Result<Vec<(usize, T)>, ComputeError>> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..threads).map(|_| scope.spawn(alone)).collect();
        let ended = threads.into_iter().map(|thread| thread.join());
        ended.map(|ended| ended.unwrap_or_else(|panic| std::panic::resume_unwind(panic))).collect()
    });
    let mut done: Vec<(usize, T)> = done.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect();
    done.sort_unstable_by_key(|(place, _)| *place);
    Ok(done.into_iter().map(|(_, found)| found).collect())
}

impl Structures {
    /// Builds what these cases need and is not there, and drops the others.
    fn provide(&mut self, cases: &[(String, &Case)], work: Work<'_>) -> Result<(), ComputeError> {
        self.0.retain(|key, _| cases.iter().any(|(needed, _)| needed == key));
        let mut missing: Vec<&(String, &Case)> = cases.iter().filter(|(key, _)| !self.0.contains_key(key)).collect();
        missing.sort_by_key(|(key, _)| key);
        missing.dedup_by_key(|(key, _)| key);
        let build = |place: usize| {
            let (key, case) = missing[place];
            let built = CoupledStructure::for_run(case, &Kept(work.cache));
            (key.clone(), built.map(Arc::new).map_err(|error| error.to_string()))
        };
        self.0.extend(on_threads(missing.len(), build)?);
        Ok(())
    }
}

impl DatasetPlan {
    /// Computes the signals of a shard, in order.
    ///
    /// # Errors
    /// [`ComputeError::Interrupted`]; a signal that cannot be computed has the reason in its record.
    pub(super) fn compute(
        &self,
        shard: usize,
        structures: &mut Structures,
        work: Work<'_>,
    ) -> Result<Vec<Computed>, ComputeError> {
        let numbers = self.of_shard(shard);
        let drawn: Vec<(Signal, Result<Case, String>)> = on_threads(numbers.len(), |place| {
            let signal = self.signal(numbers.start + place);
            let case = self.case(&signal).map_err(|error| error.to_string());
            (signal, case)
        })?;
        let keys = drawn.iter().map(|(_, case)| CoupledStructure::values(case.as_ref().ok()?));
        let keys: Vec<Option<String>> = keys.collect();
        let most = MOST_STRUCTURES * rayon::current_num_threads().max(1);
        let mut computed = Vec::with_capacity(drawn.len());
        let mut first = 0;
        while first < drawn.len() {
            // as many signals as the structures that fit into memory
            let mut needed: Vec<&String> = Vec::new();
            let mut end = first;
            while let Some(key) = keys.get(end) {
                if let Some(key) = key.as_ref().filter(|key| !needed.contains(key)) {
                    if needed.len() == most {
                        break;
                    }
                    needed.push(key);
                }
                end += 1;
            }
            let batch = first..end;
            let cases: Vec<(String, &Case)> =
                batch.clone().filter_map(|place| Some((keys[place].clone()?, drawn[place].1.as_ref().ok()?))).collect();
            structures.provide(&cases, work)?;
            let one = |place: usize| {
                let (signal, case) = &drawn[place];
                let stage = keys[place].as_ref().and_then(|key| structures.0.get(key));
                let found = self.one(signal, case, stage, work);
                if found.is_ok() {
                    (work.done)();
                }
                found
            };
            let batch = on_threads(batch.len(), |place| one(first + place))?;
            computed.extend(batch.into_iter().collect::<Result<Vec<_>, _>>()?);
            first = end;
        }
        Ok(computed)
    }

    fn one(
        &self,
        signal: &Signal,
        case: &Result<Case, String>,
        stage: Option<&Result<Arc<CoupledStructure>, String>>,
        work: Work<'_>,
    ) -> Result<Computed, ComputeError> {
        let mut record = SignalRecord::of(self, signal);
        match self.recorded(signal, case, stage, work, &mut record) {
            Ok(Ok(recorded)) => {
                let mut digest = Sha256::new();
                recorded.samples.iter().for_each(|sample| digest.update(sample.to_le_bytes()));
                let samples: Vec<f64> = recorded.samples.iter().map(|sample| f64::from(*sample)).collect();
                record.rms = Some(root_mean_square(&samples));
                record.clean_rms = Some(recorded.clean_rms);
                record.clipped = Some(recorded.clipped);
                record.sha256 = Some(hex(digest));
                record.reason = record.reason.take().or_else(|| record.distrust());
                record.trusted = record.reason.is_none();
                Ok(Computed { record, samples: Some(recorded.samples) })
            }
            Ok(Err(reason)) => {
                record.reason = Some(reason);
                Ok(Computed { record, samples: None })
            }
            Err(interrupted @ ComputeError::Interrupted { .. }) => Err(interrupted),
            Err(error) => {
                record.reason = Some(error.to_string());
                Ok(Computed { record, samples: None })
            }
        }
    }

    /// The record of a signal, or why it cannot be trusted.
    fn recorded(
        &self,
        signal: &Signal,
        case: &Result<Case, String>,
        stage: Option<&Result<Arc<CoupledStructure>, String>>,
        work: Work<'_>,
        record: &mut SignalRecord,
    ) -> Result<Result<Recorded, String>, ComputeError> {
        let (case, stage) = match (case, stage) {
            (Ok(case), Some(Ok(stage))) => (case, Arc::clone(stage)),
            (Err(reason), _) | (_, Some(Err(reason))) => return Ok(Err(reason.clone())),
            (Ok(_), None) => return Ok(Err("its values cannot be written".to_owned())),
        };
        let asked = case.asked_run("`dataset`")?;
        let mut through = ThroughChannel { recorder: &signal.recorder, stop: work.stop };
        let run = step_run(&asked, stage, &mut through)?;
        record.model_of(&run.choice, run.simulation.modes);
        let recorder = &signal.recorder;
        let before_s = recorder.settling as f64 / recorder.rate_hz;
        let from = run.simulation.start_s + before_s;
        let window = TimeWindow { from, to: from + recorder.samples as f64 / recorder.rate_hz };
        if let Some((cage, balls, orders)) = run.bearings.get(self.seat(signal.entry)) {
            let kinematics = Kinematics::of(cage, *balls, *orders);
            let speed_hz = kinematics.mean_speed_hz(window);
            let orders = kinematics.orders(window)?;
            let hz = |fault| orders.order(fault).map(|order| order * speed_hz);
            record.speed_hz = Some(speed_hz);
            record.speed_spread_hz = Some(kinematics.speed_spread_hz(window));
            record.bpfo_hz = hz(Fault::OuterRace);
            record.bpfi_hz = hz(Fault::InnerRace);
            record.bsf_hz = hz(Fault::Ball).map(|twice| 0.5 * twice);
            record.ftf_hz = hz(Fault::Cage);
        }
        if let RunEnd::BlewUp(blow_up) = &run.simulation.end {
            return Ok(Err(blow_up.to_string()));
        }
        if let Some(why) = run.choice.distrust() {
            let reason = format!("it cannot be trusted: {why}");
            match self.spec.untrusted {
                Untrusted::LeaveOut => return Ok(Err(reason)),
                Untrusted::Keep => record.reason = Some(reason),
            }
        }
        let samples = run.simulation.record.samples;
        if samples.len() != recorder.samples || samples.iter().any(|sample| !sample.is_finite()) {
            return Ok(Err(format!("{} of {} samples", samples.len(), recorder.samples)));
        }
        let shaft = run.bearings.first().map(|(cage, ..)| cage.shaft());
        let fastest_hz = shaft.map_or(0.0, |shaft| shaft.fastest(window.from, window.to) / TAU);
        if let Some(reason) = signal.noise.folded(fastest_hz, 0.5 * recorder.rate_hz) {
            return Ok(Err(reason));
        }
        let around = Around {
            background: self.background_of(signal.specimen.part),
            step_s: 1.0 / recorder.rate_hz,
            shaft: &|time| shaft.map_or(0.0, |shaft| shaft.angle(from + time)),
        };
        Ok(Ok(Recorded::new(samples, recorder, &signal.noise, &around)?))
    }
}
