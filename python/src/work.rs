//! A computation on a thread of its own: the interpreter is free meanwhile, signals and progress are served, and Ctrl-C ends it.

use crate::{errors, threads};
use plummer::prelude::{ComputeError, Watch};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// How often signals and progress are looked at.
const PAUSE: Duration = Duration::from_millis(40);
/// How long a computation has to stop.
const GRACE: Duration = Duration::from_secs(1);

/// How far a computation is, and whether it is to stop.
#[derive(Default)]
pub(crate) struct Told {
    stop: AtomicBool,
    /// Whether the computation looks at the request by itself now.
    stops_itself: AtomicBool,
    at: Mutex<At>,
}

/// Stages begun, the name of the last and the part of it that is done, 0 to 1.
#[derive(Default, Clone, PartialEq)]
struct At {
    stages: usize,
    stage: String,
    done: Option<f64>,
}

/// What unwinds a computation that is to stop.
struct Stopped;

impl Told {
    fn at(&self) -> std::sync::MutexGuard<'_, At> {
        self.at.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(crate) fn is_to_stop(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    pub(crate) fn stops_itself(&self, itself: bool) {
        self.stops_itself.store(itself, Ordering::Relaxed);
    }

    fn stop_here(&self) {
        if self.is_to_stop() && !self.stops_itself.load(Ordering::Relaxed) {
            resume_unwind(Box::new(Stopped));
        }
    }
}

impl Watch for Told {
    fn stage(&self, name: &str) {
        self.stop_here();
        let mut at = self.at();
        let stages = at.stages + 1;
        *at = At { stages, stage: name.to_owned(), done: None };
    }

    fn fraction(&self, done: f64) {
        self.stop_here();
        self.at().done = Some(done.clamp(0.0, 1.0));
    }
}

type Outcome<T> = Result<Result<T, ComputeError>, Box<dyn Any + Send>>;

/// Computes `work` on the pool, and calls `progress(stage, part)` as it goes on, part from 0 to 1 or None.
pub(crate) fn compute<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Told) -> Result<T, ComputeError> + Send + 'static,
) -> PyResult<T> {
    let told = Arc::new(Told::default());
    let (done, outcome) = channel::<Outcome<T>>();
    let outcome = Mutex::new(outcome);
    let on_worker = Arc::clone(&told);
    threads::pool(py)?.spawn(move || {
        // whom it would be told to may have given up
        let _ = done.send(catch_unwind(AssertUnwindSafe(|| work(&on_worker))));
    });
    let mut shown = At::default();
    loop {
        match wait(py, &outcome, PAUSE) {
            Ok(outcome) => return ended(py, outcome),
            Err(RecvTimeoutError::Disconnected) => return Err(errors::failed(py, "the computation was lost")),
            Err(RecvTimeoutError::Timeout) => {}
        }
        let served = py.check_signals().and_then(|()| match progress {
            Some(progress) => tell(progress, &told, &mut shown),
            None => Ok(()),
        });
        if let Err(error) = served {
            told.stop.store(true, Ordering::Relaxed);
            if wait(py, &outcome, GRACE).is_err() {
                threads::renew();
            }
            if !error.is_instance_of::<PyKeyboardInterrupt>(py) {
                return Err(error);
            }
            let stage = told.at().stage.clone();
            let during = if stage.is_empty() { String::new() } else { format!(" during \"{stage}\"") };
            let interrupted = errors::interrupted(py, &format!("interrupted{during}"));
            interrupted.set_cause(py, Some(error));
            return Err(interrupted);
        }
    }
}

fn wait<T: Send>(
    py: Python<'_>,
    outcome: &Mutex<Receiver<Outcome<T>>>,
    time: Duration,
) -> Result<Outcome<T>, RecvTimeoutError> {
    py.detach(|| outcome.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(time))
}

fn tell(progress: &Bound<'_, PyAny>, told: &Told, shown: &mut At) -> PyResult<()> {
    let at = told.at().clone();
    if at != *shown && at.stages > 0 {
        progress.call1((at.stage.as_str(), at.done))?;
    }
    *shown = at;
    Ok(())
}

fn ended<T>(py: Python<'_>, outcome: Outcome<T>) -> PyResult<T> {
    match outcome {
        Ok(result) => result.map_err(|error| errors::of(py, error)),
        Err(panic) => {
            let text = panic.downcast_ref::<String>().map(String::as_str);
            let text = text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no words");
            let what = format!("the computation ended in a panic, which is a fault of plummer: {text}");
            Err(errors::failed(py, what))
        }
    }
}
