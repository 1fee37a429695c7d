//! Modes, handed over.

use crate::{arrays, errors, page};
use numpy::{PyArray1, PyArray2, PyArray3};
use plummer::app::commands::modes::ModesResult;
use plummer::formats::write_modes_npz;
use plummer::prelude::Case;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;

/// Frequencies and shapes, with the points that move.
type Shapes<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray3<f64>>,
    Bound<'py, PyArray2<f64>>,
    Option<Bound<'py, PyArray1<u64>>>,
);

/// Modes of a case.
#[pyclass(frozen, module = "plummer._plummer")]
pub(crate) struct Modes {
    pub(crate) case: Arc<Case>,
    pub(crate) result: ModesResult,
}

#[pymethods]
impl Modes {
    /// Frequencies [modes], Hz; shapes [modes, points, 3]; points [points, 3], m; their tags in the mesh [points].
    fn shapes<'py>(&self, py: Python<'py>) -> PyResult<Shapes<'py>> {
        let found = self.result.mode_shapes();
        let count = found.shapes.len();
        let points = found.points.unwrap_or_default();
        let shape = [count, points.len(), 3];
        Ok((
            arrays::vector(py, found.frequencies_hz),
            arrays::cube(py, found.shapes.concat(), shape)?,
            arrays::points(py, points)?,
            found.node_tags.map(|tags| arrays::vector(py, tags)),
        ))
    }

    /// Writes `modes.npz` into a folder, as the command does.
    fn write(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        let written = write_modes_npz(&folder.join("modes.npz"), &self.result.mode_shapes());
        written.map_err(|error| errors::of(py, error))
    }

    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        page::summary(py, "modes", &self.case, &self.result)
    }

    fn html(&self, py: Python<'_>) -> PyResult<String> {
        page::html(py, "modes", &self.case, &self.result)
    }
}
