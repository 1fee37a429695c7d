//! A case: read from a file or a dict, changed key by key, computed.

use crate::condense::Superelement;
use crate::frf::Frf;
use crate::modes::Modes;
use crate::run::Run;
use crate::values::{dict, to_table, to_toml};
use crate::work::{Told, compute};
use crate::errors;
use plummer::app::case::{Purpose, Source};
use plummer::prelude::{
    Case as Library, Comparison, ComputeError, compute_condense, compute_frf, compute_modes, compute_run,
};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping};
use std::path::PathBuf;
use std::sync::Arc;

/// A case, checked.
#[pyclass(frozen, module = "plummer._plummer")]
pub(crate) struct Case {
    case: Arc<Library>,
}

impl Case {
    fn of(py: Python<'_>, read: Result<Library, plummer::app::case::CaseError>) -> PyResult<Self> {
        let case = Arc::new(read.map_err(|error| errors::of(py, error))?);
        Ok(Self { case })
    }

    /// What a command computes of the case that has what it needs.
    fn compute<T: Send + 'static>(
        &self,
        py: Python<'_>,
        purpose: Purpose,
        progress: Option<&Bound<'_, PyAny>>,
        work: impl FnOnce(&Library, &Told) -> Result<T, ComputeError> + Send + 'static,
    ) -> PyResult<(Arc<Library>, T)> {
        self.case.ready_for(purpose).map_err(|error| errors::of(py, error))?;
        let case = Arc::clone(&self.case);
        let result = compute(py, progress, move |told| work(&case, told))?;
        Ok((Arc::clone(&self.case), result))
    }
}

#[pymethods]
impl Case {
    /// Reads a case file; `set`: `KEY=VALUE`, as after --set.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf, set: Vec<String>) -> PyResult<Self> {
        Self::of(py, Library::load(path, &set))
    }

    /// A case of nested dicts; files that it names are looked for beside `path`.
    #[staticmethod]
    fn of_dict(py: Python<'_>, table: &Bound<'_, PyMapping>, path: PathBuf) -> PyResult<Self> {
        let text = toml::to_string(&to_table(table)?).map_err(|error| errors::input(py, error, None))?;
        Self::of(py, Library::from_source(Source { path, text, set: Vec::new() }))
    }

    /// The same case with further arguments `KEY=VALUE`.
    fn with_arguments(&self, py: Python<'_>, set: Vec<String>) -> PyResult<Self> {
        let mut source = self.case.source.clone();
        source.set.extend(set);
        Self::of(py, Library::from_source(source))
    }

    /// The case with all defaults, as nested dicts.
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        dict(py, &*self.case)
    }

    #[getter]
    fn path(&self) -> PathBuf {
        self.case.source.path.clone()
    }

    #[getter]
    fn text(&self) -> String {
        self.case.source.text.clone()
    }

    #[getter]
    fn set(&self) -> Vec<String> {
        self.case.source.set.clone()
    }

    #[getter]
    fn title(&self) -> String {
        self.case.title.clone()
    }

    fn modes(&self, py: Python<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<Modes> {
        let (case, result) = self.compute(py, Purpose::Modes, progress, |case, told| compute_modes(case, told))?;
        Ok(Modes { case, result })
    }

    fn condense(
        &self,
        py: Python<'_>,
        compare_full: bool,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Superelement> {
        let comparison = if compare_full { Comparison::Full } else { Comparison::None };
        let work = move |case: &Library, told: &Told| {
            let result = compute_condense(case, comparison, told)?;
            let record = result.record(case)?;
            Ok((result, record))
        };
        let (case, (result, record)) = self.compute(py, Purpose::Condense, progress, work)?;
        Ok(Superelement { case, result, record })
    }

    fn frf(&self, py: Python<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<Frf> {
        let (case, result) = self.compute(py, Purpose::Frf, progress, |case, told| compute_frf(case, told))?;
        Ok(Frf { case, result })
    }

    fn run(&self, py: Python<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<Run> {
        let (case, result) = self.compute(py, Purpose::Run, progress, |case, told| compute_run(case, told))?;
        Ok(Run::new(py, case, result))
    }
}

/// A value as a case file has it, on one line.
#[pyfunction]
pub(crate) fn toml_value(value: &Bound<'_, PyAny>) -> PyResult<String> {
    Ok(to_toml(value)?.to_string())
}
