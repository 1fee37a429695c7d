//! Transfer paths, handed over.

use crate::{arrays, errors, page};
use numpy::{Complex64, PyArray1, PyArray2};
use plummer::app::commands::frf::FrfResult;
use plummer::fe::reduction::frf::FrfQuantity;
use plummer::prelude::{Case, ComputeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;

/// Transfer paths of a case.
#[pyclass(frozen, module = "plummer._plummer")]
pub(crate) struct Frf {
    pub(crate) case: Arc<Case>,
    pub(crate) result: FrfResult,
}

#[pymethods]
impl Frf {
    fn frequencies_hz<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::vector(py, self.result.response.frequencies_hz().to_vec())
    }

    /// Force and sensor of each path.
    fn paths(&self) -> Vec<(String, String)> {
        self.result.paths.iter().map(|path| (path.from.clone(), path.to.clone())).collect()
    }

    /// Responses [paths, frequencies]: "receptance", m/N; "mobility", m/(N s); "accelerance", 1/kg.
    fn responses<'py>(&self, py: Python<'py>, quantity: &str) -> PyResult<Bound<'py, PyArray2<Complex64>>> {
        let asked = match quantity {
            "receptance" => FrfQuantity::Receptance,
            "mobility" => FrfQuantity::Mobility,
            "accelerance" => FrfQuantity::Accelerance,
            other => {
                let what = format!("quantity: found \"{other}\", expected receptance, mobility or accelerance");
                return Err(errors::input(py, what, None));
            }
        };
        let mut values = Vec::new();
        for path in &self.result.paths {
            let (sensor, load) = path.place;
            let response = self.result.response.path(sensor, load, asked);
            values.extend(response.map_err(|error| errors::of(py, ComputeError::from(error)))?);
        }
        arrays::table(py, values, [self.result.paths.len(), self.result.response.frequencies_hz().len()])
    }

    /// Writes `frf.uff` into a folder, as the command does.
    fn write(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        self.result.write_uff(&folder.join("frf.uff"), &self.case).map_err(|error| errors::of(py, error))
    }

    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        page::summary(py, "frf", &self.case, &self.result)
    }

    fn html(&self, py: Python<'_>) -> PyResult<String> {
        page::html(py, "frf", &self.case, &self.result)
    }

    fn write_report(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        page::write(py, &folder, "frf", &self.case, &self.result)
    }
}
