//! A run.

use crate::record::{Held, Record, Stoppable};
use crate::work::{Told, compute};
use crate::{arrays, errors, page};
use numpy::PyArray1;
use plummer::app::commands::run::{RunEnd, RunResult, Simulation, compute_kept_run};
use plummer::prelude::Case;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

/// A run of a case.
#[pyclass(frozen, module = "plummer._plummer")]
pub(crate) struct Run {
    case: Arc<Case>,
    result: RunResult<Held>,
}

impl Run {
    /// Carries a run out; what Ctrl-C ends leaves its signals in the exception.
    pub(crate) fn compute(py: Python<'_>, case: &Arc<Case>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let until_then = Arc::new(Mutex::new(None));
        let (own, left) = (Arc::clone(case), Arc::clone(&until_then));
        let work = move |told: &Told| compute_kept_run(&own, told, &mut Stoppable { told, until_then: &left });
        match compute(py, progress, work) {
            Ok(result) => Self::new(py, Arc::clone(case), result),
            Err(error) => {
                let left = until_then.lock().unwrap_or_else(PoisonError::into_inner).take();
                if let Some(record) = left.filter(|_| errors::is_interrupted(py, &error)) {
                    error.value(py).setattr("signals", Record::of(py, record))?;
                }
                Err(error)
            }
        }
    }

    fn new(py: Python<'_>, case: Arc<Case>, result: RunResult) -> PyResult<Self> {
        let RunResult { machine, bearing_model, choice, horizon, simulation, .. } = result;
        let RunResult { windows, scalograms, not_analysed, warnings, .. } = result;
        let Simulation { method, schedule, modes, residual, statistics, start_s, simulated_s, .. } = simulation;
        let Simulation { stepping_s, before_s, record, energy, end, .. } = simulation;
        let record = Held(Py::new(py, Record::of(py, record))?);
        let simulation = Simulation {
            method,
            schedule,
            modes,
            residual,
            statistics,
            start_s,
            simulated_s,
            stepping_s,
            before_s,
            record,
            energy,
            end,
        };
        let result = RunResult {
            machine,
            bearing_model,
            choice,
            horizon,
            simulation,
            windows,
            scalograms,
            not_analysed,
            warnings,
        };
        Ok(Self { case, result })
    }
}

#[pymethods]
impl Run {
    /// The signals.
    #[getter]
    fn record(&self, py: Python<'_>) -> Py<Record> {
        self.result.simulation.record.0.clone_ref(py)
    }

    /// Speed (Hz) and angle (rad) of the shaft at some instants (s).
    fn shaft<'py>(
        &self,
        py: Python<'py>,
        time_s: numpy::PyReadonlyArray1<'py, f64>,
    ) -> PyResult<[Bound<'py, PyArray1<f64>>; 2]> {
        let shaft = self.result.machine.shaft_speed();
        let times = time_s.as_slice()?;
        let speed = times.iter().map(|&time| shaft.speed(time) / std::f64::consts::TAU).collect();
        let angle = times.iter().map(|&time| shaft.angle(time)).collect();
        Ok([arrays::vector(py, speed), arrays::vector(py, angle)])
    }

    /// Why the signals end early, if they do.
    #[getter]
    fn blew_up(&self) -> Option<String> {
        match &self.result.simulation.end {
            RunEnd::Complete => None,
            RunEnd::BlewUp(why) => Some(why.to_string()),
        }
    }

    /// Why the signals cannot be trusted, if they cannot.
    #[getter]
    fn distrust(&self) -> Option<&'static str> {
        self.result.distrust()
    }

    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        page::summary(py, "run", &self.case, &self.result)
    }

    fn html(&self, py: Python<'_>) -> PyResult<String> {
        page::html(py, "run", &self.case, &self.result)
    }

    fn write_report(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        page::write(py, &folder, "run", &self.case, &self.result)
    }
}
