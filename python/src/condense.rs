//! A superelement, handed over.

use crate::{arrays, errors, page};
use numpy::{PyArray1, PyArray2};
use plummer::app::commands::condense::CondenseResult;
use plummer::formats::SuperelementRecord;
use plummer::numerics::linalg::DenseMatrix;
use plummer::prelude::{Case, write_superelement_npz};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::path::PathBuf;
use std::sync::Arc;

/// A condensed housing.
#[pyclass(frozen, module = "plummer._plummer")]
pub(crate) struct Superelement {
    pub(crate) case: Arc<Case>,
    pub(crate) result: CondenseResult,
    pub(crate) record: SuperelementRecord,
}

impl Superelement {
    fn optional<'py>(py: Python<'py>, a: Option<&DenseMatrix>) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        a.map(|a| arrays::matrix(py, a)).transpose()
    }
}

#[pymethods]
impl Superelement {
    fn stiffness<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::matrix(py, &self.record.stiffness)
    }

    fn mass<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::matrix(py, &self.record.mass)
    }

    fn damping<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        Self::optional(py, self.record.damping.as_ref())
    }

    fn structural<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        Self::optional(py, self.record.structural.as_ref())
    }

    fn weight<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        Self::optional(py, self.record.weight.as_ref())
    }

    fn modal_hz<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::vector(py, self.record.modal_hz.clone())
    }

    /// Body, node, direction, unit, position [3] (m) and axis [3] of each interface coordinate.
    fn interface<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let rows = self.record.interface.iter();
        let rows = rows
            .map(|row| (row.body.name(), row.node, row.direction.name(), row.direction.unit(), row.position, row.axis));
        PyList::new(py, rows.collect::<Vec<_>>())
    }

    /// What each sensor does, by its name: a row [coordinates] that gives its displacement (m).
    fn sensors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let rows = PyDict::new(py);
        for sensor in &self.record.sensors {
            rows.set_item(&sensor.name, arrays::vector(py, sensor.row.clone()))?;
        }
        Ok(rows)
    }

    /// Writes `superelement.npz` into a folder, as the command does.
    fn write(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        let written = write_superelement_npz(&folder.join("superelement.npz"), &self.record);
        written.map_err(|error| errors::of(py, error))
    }

    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        page::summary(py, "condense", &self.case, &self.result)
    }

    fn html(&self, py: Python<'_>) -> PyResult<String> {
        page::html(py, "condense", &self.case, &self.result)
    }

    fn write_report(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        page::write(py, &folder, "condense", &self.case, &self.result)
    }
}
