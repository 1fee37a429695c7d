//! A run, whose signals are handed over.

use crate::{arrays, page};
use numpy::{PyArray1, PyArrayMethods};
use plummer::app::commands::run::{Recording, RunEnd, RunResult, Simulation, TakePiece};
use plummer::prelude::{Case, ComputeError};
use plummer::system::{Column, RecordLayout, RunRecord};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ops::Range;
use std::sync::Arc;

/// A run of a case.
#[pyclass(frozen, module = "plummer._plummer")]
pub(crate) struct Run {
    case: Arc<Case>,
    result: RunResult<Signals>,
}

/// The columns of a run in arrays of NumPy.
struct Signals {
    layout: RecordLayout,
    rows: usize,
    columns: Vec<(Column, Py<PyArray1<f64>>)>,
}

impl Signals {
    /// The columns of a record; their memory goes over.
    fn of(py: Python<'_>, record: RunRecord) -> Self {
        let (layout, rows) = (record.layout(), record.rows());
        let RunRecord { time_s, shaft_x, shaft_y, sensors, ball_radius, outer_force, inner_force, .. } = record;
        let RunRecord { shaft_z, tilt_x, tilt_y, ball_axial, outer_angle, inner_angle, .. } = record;
        let sensors = sensors.into_iter().enumerate().map(|(place, (_, values))| (Column::Sensor(place), values));
        let plane = [
            (Column::Time, time_s),
            (Column::ShaftX, shaft_x),
            (Column::ShaftY, shaft_y),
            (Column::BallRadius, ball_radius),
            (Column::OuterForce, outer_force),
            (Column::InnerForce, inner_force),
        ];
        let space = [
            (Column::ShaftZ, shaft_z),
            (Column::TiltX, tilt_x),
            (Column::TiltY, tilt_y),
            (Column::BallAxial, ball_axial),
            (Column::OuterAngle, outer_angle),
            (Column::InnerAngle, inner_angle),
        ];
        let columns = plane.into_iter().chain(sensors).chain(space.into_iter().filter(|_| layout.in_space));
        let columns = columns.map(|(column, values)| (column, arrays::vector(py, values).unbind())).collect();
        Self { layout, rows, columns }
    }
}

impl Recording for Signals {
    fn layout(&self) -> RecordLayout {
        self.layout.clone()
    }

    fn rows(&self) -> usize {
        self.rows
    }

    fn append(&mut self, _: &RunRecord) -> Result<(), ComputeError> {
        Err(ComputeError::Failed { what: "a run that has ended takes no rows".to_owned(), help: None })
    }

    fn read(&self, column: Column, rows: Range<usize>, take: TakePiece<'_>) -> Result<(), ComputeError> {
        let Some((_, values)) = self.columns.iter().find(|(own, _)| *own == column) else {
            return Ok(());
        };
        let rows = rows.start.min(self.rows)..rows.end.min(self.rows);
        Python::attach(|py| {
            let values = values.bind(py).readonly();
            let values = values.as_slice().map_err(|error| ComputeError::Failed { what: error.to_string(), help: None })?;
            take(values.get(column.places(&rows, self.layout.balls)).unwrap_or(&[]))
        })
    }
}

impl Run {
    pub(crate) fn new(py: Python<'_>, case: Arc<Case>, result: RunResult) -> Self {
        let RunResult { machine, bearing_model, choice, horizon, simulation, .. } = result;
        let RunResult { windows, scalograms, not_analysed, warnings, .. } = result;
        let Simulation { method, schedule, modes, residual, statistics, start_s, simulated_s, .. } = simulation;
        let Simulation { stepping_s, record, energy, end, .. } = simulation;
        let record = Signals::of(py, record);
        let simulation = Simulation {
            method,
            schedule,
            modes,
            residual,
            statistics,
            start_s,
            simulated_s,
            stepping_s,
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
        Self { case, result }
    }

    fn column<'py>(&self, py: Python<'py>, column: Column) -> PyResult<Bound<'py, PyAny>> {
        let Some((_, values)) = self.result.simulation.record.columns.iter().find(|(own, _)| *own == column) else {
            return Ok(py.None().into_bound(py));
        };
        let values = values.bind(py).clone();
        let Signals { rows, layout, .. } = &self.result.simulation.record;
        Ok(match column.width(2) {
            1 => values.into_any(),
            _ => values.reshape([*rows, layout.balls])?.into_any(),
        })
    }
}

#[pymethods]
impl Run {
    /// All columns but those of sensors by the names that they have in signals.npz; tables are [instants, balls].
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let named = [
            ("time_s", Column::Time),
            ("shaft_x", Column::ShaftX),
            ("shaft_y", Column::ShaftY),
            ("ball_radius", Column::BallRadius),
            ("outer_force", Column::OuterForce),
            ("inner_force", Column::InnerForce),
            ("shaft_z", Column::ShaftZ),
            ("tilt_x", Column::TiltX),
            ("tilt_y", Column::TiltY),
            ("ball_axial", Column::BallAxial),
            ("outer_angle", Column::OuterAngle),
            ("inner_angle", Column::InnerAngle),
        ];
        let columns = PyDict::new(py);
        for (name, column) in named {
            columns.set_item(name, self.column(py, column)?)?;
        }
        Ok(columns)
    }

    /// Accelerations of the sensors, m/s^2, by their names.
    fn sensors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let sensors = PyDict::new(py);
        for (place, name) in self.result.simulation.record.layout.sensors.iter().enumerate() {
            sensors.set_item(name, self.column(py, Column::Sensor(place))?)?;
        }
        Ok(sensors)
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

    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        page::summary(py, "run", &self.case, &self.result)
    }

    fn html(&self, py: Python<'_>) -> PyResult<String> {
        page::html(py, "run", &self.case, &self.result)
    }
}
