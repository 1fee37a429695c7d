//! The signals of a run, handed over, and how a run is stopped with those that it has.

use crate::arrays;
use crate::work::Told;
use numpy::{PyArray1, PyArrayMethods};
use plummer::app::commands::run::{Checkpoints, Recording, RunRequest, TakePiece};
use plummer::numerics::ode::Snapshot;
use plummer::prelude::ComputeError;
use plummer::system::{Column, RecordLayout, RunRecord};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// The columns of a run in arrays of NumPy.
#[pyclass(frozen, module = "plummer._plummer")]
pub(crate) struct Record {
    layout: RecordLayout,
    rows: usize,
    columns: Vec<(Column, Py<PyArray1<f64>>)>,
}

impl Record {
    /// The columns of a record; their memory goes over.
    pub(crate) fn of(py: Python<'_>, record: RunRecord) -> Self {
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

    fn column<'py>(&self, py: Python<'py>, column: Column) -> PyResult<Bound<'py, PyAny>> {
        let Some((_, values)) = self.columns.iter().find(|(own, _)| *own == column) else {
            return Ok(py.None().into_bound(py));
        };
        let values = values.bind(py).clone();
        Ok(match column.width(2) {
            1 => values.into_any(),
            _ => values.reshape([self.rows, self.layout.balls])?.into_any(),
        })
    }
}

/// A record that a result holds.
pub(crate) struct Held(pub(crate) Py<Record>);

impl Recording for Held {
    fn layout(&self) -> RecordLayout {
        self.0.get().layout.clone()
    }

    fn rows(&self) -> usize {
        self.0.get().rows
    }

    fn append(&mut self, _: &RunRecord) -> Result<(), ComputeError> {
        Err(ComputeError::Failed { what: "a run that has ended takes no rows".to_owned(), help: None })
    }

    fn read(&self, column: Column, rows: Range<usize>, take: TakePiece<'_>) -> Result<(), ComputeError> {
        let record = self.0.get();
        let Some((_, values)) = record.columns.iter().find(|(own, _)| *own == column) else {
            return Ok(());
        };
        let rows = rows.start.min(record.rows)..rows.end.min(record.rows);
        Python::attach(|py| {
            let values = values.bind(py).readonly();
            let values =
                values.as_slice().map_err(|error| ComputeError::Failed { what: error.to_string(), help: None })?;
            take(values.get(column.places(&rows, record.layout.balls)).unwrap_or(&[]))
        })
    }
}

#[pymethods]
impl Record {
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
        for (place, name) in self.layout.sensors.iter().enumerate() {
            sensors.set_item(name, self.column(py, Column::Sensor(place))?)?;
        }
        Ok(sensors)
    }
}

/// Keeps rows in memory; those that there are when a run is told to stop are left in `until_then`.
pub(crate) struct Stoppable<'a> {
    pub(crate) told: &'a Told,
    pub(crate) until_then: &'a Mutex<Option<RunRecord>>,
}

impl Checkpoints for Stoppable<'_> {
    type Record = RunRecord;

    fn open(&mut self, layout: RecordLayout) -> Result<(RunRecord, Option<Snapshot>), ComputeError> {
        let RecordLayout { sensors, balls, in_space } = layout;
        let sensors = sensors.into_iter().map(|name| (name, Vec::new())).collect();
        self.told.stops_itself(true);
        Ok((RunRecord { sensors, balls, in_space, ..RunRecord::default() }, None))
    }

    fn request(&mut self) -> RunRequest {
        if self.told.is_to_stop() { RunRequest::Stop } else { RunRequest::GoOn }
    }

    fn save(&mut self, record: &RunRecord, _: f64, _: &Snapshot) -> Result<(), ComputeError> {
        *self.until_then.lock().unwrap_or_else(PoisonError::into_inner) = Some(record.clone());
        Ok(())
    }

    fn close(&mut self) {
        self.told.stops_itself(false);
    }
}
