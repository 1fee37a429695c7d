//! A scene's equations as a Python module, for integrators of other packages: see `../peers.py`.

mod equations;
mod others;
mod own;
mod record;

use equations::Equations;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyReadwriteArray1};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::error::Error;
use std::time::Instant;

/// What a run took and left.
struct Run {
    /// Wall time of the integration alone, s.
    seconds: f64,
    /// Evaluations of the right-hand side, of the contacts' tangent with them.
    evaluations: u64,
    /// Between two states, s.
    interval: f64,
    /// In the units of the equations, one behind the other; none unless asked for.
    states: Vec<f64>,
}

/// (wall seconds, evaluations, time between states, states \[samples x size\]).
type RunResult<'py> = (f64, u64, f64, Bound<'py, PyArray2<f64>>);

fn failed(error: Box<dyn Error>) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}

fn shown<'py>(py: Python<'py>, run: Run, size: usize) -> PyResult<RunResult<'py>> {
    let states = PyArray1::from_vec(py, run.states);
    let rows = states.len()? / size;
    let states = states.reshape([rows, size])?;
    Ok((run.seconds, run.evaluations, run.interval, states))
}

/// The equations of a scene.
#[pyclass]
struct Scene {
    equations: Equations,
    derivative: Vec<f64>,
}

#[pymethods]
impl Scene {
    /// Of a case file with overrides (`key=value`).
    #[new]
    fn new(path: &str, set: Vec<String>) -> PyResult<Self> {
        let equations = Equations::of_case(path, &set).map_err(failed)?;
        Ok(Self { derivative: vec![0.0; equations.size()], equations })
    }

    /// Number of coordinates and velocities.
    #[getter]
    fn size(&self) -> usize {
        self.equations.size()
    }

    /// Method, tolerance and largest step (s) that the program chooses.
    #[getter]
    fn chosen(&self) -> (String, Option<f64>, f64) {
        use plummer::numerics::ode::Method;
        let model = self.equations.chosen();
        let tolerance = match model.method {
            Method::ExponentialAdams { tolerance } => tolerance,
            Method::Dop853 { tolerance, .. } => Some(tolerance),
            _ => None,
        };
        (model.method.name().to_owned(), tolerance, model.step)
    }

    /// Sets what coordinates and velocities are measured in.
    fn set_scale(&mut self, scale: PyReadonlyArray1<'_, f64>) -> PyResult<()> {
        self.equations.set_scale(scale.as_slice()?);
        Ok(())
    }

    /// State at rest.
    fn start<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_vec(py, self.equations.start())
    }

    /// The right-hand side.
    fn rhs<'py>(
        &mut self,
        py: Python<'py>,
        t: f64,
        x: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.equations.rhs_into(t, x.as_slice()?, &mut self.derivative);
        Ok(PyArray1::from_slice(py, &self.derivative))
    }

    /// The same into memory at hand.
    fn rhs_into(&mut self, t: f64, x: PyReadonlyArray1<'_, f64>, mut dx: PyReadwriteArray1<'_, f64>) -> PyResult<()> {
        self.equations.rhs_into(t, x.as_slice()?, dx.as_slice_mut()?);
        Ok(())
    }

    /// Its derivative by the state \[size x size\].
    fn jacobian<'py>(
        &mut self,
        py: Python<'py>,
        t: f64,
        x: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let size = self.equations.size();
        let (mut unit, mut columns) = (vec![0.0; size], Vec::with_capacity(size * size));
        for column in 0..size {
            unit[column] = 1.0;
            let out = &mut self.derivative;
            self.equations.jacobian_times(t, x.as_slice()?, &unit, out);
            columns.extend_from_slice(out);
            unit[column] = 0.0;
        }
        let columns = PyArray1::from_vec(py, columns).reshape([size, size])?;
        columns.transpose()
    }

    /// Evaluations of the right-hand side, of the contacts' tangent with them, since the last call.
    fn take_evaluations(&mut self) -> u64 {
        self.equations.take_evaluations()
    }

    /// Seconds that an evaluation takes in the mean over these states \[samples x size\], without Python.
    fn bare_seconds(&mut self, interval: f64, states: PyReadonlyArray2<'_, f64>) -> PyResult<f64> {
        let (states, size) = (states.as_slice()?, self.equations.size());
        let clock = Instant::now();
        for (sample, x) in states.chunks_exact(size).enumerate() {
            let t = sample as f64 * interval;
            self.equations.rhs_into(t, x, &mut self.derivative);
        }
        Ok(clock.elapsed().as_secs_f64() / (states.len() / size) as f64)
    }

    /// Acceleration of the first sensor (m/s^2) every `ratio` intervals, limited to `band_hz`.
    fn acceleration<'py>(
        &mut self,
        py: Python<'py>,
        states: PyReadonlyArray2<'py, f64>,
        interval: f64,
        ratio: u32,
        band_hz: f64,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let states = states.as_slice()?;
        let values = record::acceleration(&mut self.equations, states, interval, ratio, band_hz);
        Ok(PyArray1::from_vec(py, values.map_err(failed)?))
    }

    /// States every `interval` seconds from those at an integrator's steps.
    fn between_steps<'py>(
        &mut self,
        py: Python<'py>,
        times: PyReadonlyArray1<'py, f64>,
        states: PyReadonlyArray2<'py, f64>,
        interval: f64,
        samples: usize,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (times, states) = (times.as_slice()?, states.as_slice()?);
        let found = record::between_steps(&mut self.equations, times, states, interval, samples);
        PyArray1::from_vec(py, found.map_err(failed)?).reshape([samples, self.equations.size()])
    }

    /// Runs a method of plummer from rest; `times` are the largest step, the whole run and an interval
    /// that steps divide, s.
    fn plummer<'py>(
        &mut self,
        py: Python<'py>,
        method: &str,
        tolerance: Option<f64>,
        times: [f64; 3],
        keep: bool,
    ) -> PyResult<RunResult<'py>> {
        let [step, seconds, interval] = times;
        let method = own::method(method, tolerance).map_err(failed)?;
        let run = own::run(&mut self.equations, method, seconds, interval, step, keep);
        shown(py, run.map_err(failed)?, self.equations.size())
    }

    /// Runs a method of `diffsol` from rest.
    fn diffsol<'py>(
        &mut self,
        py: Python<'py>,
        method: &str,
        tolerance: f64,
        seconds: f64,
        interval: Option<f64>,
    ) -> PyResult<RunResult<'py>> {
        let run = others::diffsol(&mut self.equations, method, tolerance, seconds, interval);
        shown(py, run.map_err(failed)?, self.equations.size())
    }

    /// Runs a method of `ode_solvers` from rest.
    fn ode_solvers<'py>(
        &mut self,
        py: Python<'py>,
        method: &str,
        tolerance: f64,
        seconds: f64,
        interval: Option<f64>,
    ) -> PyResult<RunResult<'py>> {
        let run = others::ode_solvers(&mut self.equations, method, tolerance, seconds, interval);
        shown(py, run.map_err(failed)?, self.equations.size())
    }
}

/// Equations of a scene, and integrators for them.
#[pymodule]
mod peers {
    #[pymodule_export]
    use super::Scene;
}
