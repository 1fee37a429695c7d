//! A case: read from a file or a dict, changed key by key, computed.

use crate::condense::Superelement;
use crate::errors;
use crate::frf::Frf;
use crate::mesh::Mesh;
use crate::modes::Modes;
use crate::run::Run;
use crate::values::{dict, to_python, to_table, to_toml};
use crate::work::{Told, compute};
use plummer::app::case::{CaseError, Purpose, Source};
use plummer::prelude::{Case as Library, Comparison, ComputeError, compute_condense, compute_frf, compute_modes};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping};
use std::path::PathBuf;
use std::sync::Arc;

/// Meshes in memory, by the names that the case has for them.
type Meshes<'py> = Vec<(String, PyRef<'py, Mesh>)>;

/// A case, checked.
#[pyclass(frozen, module = "plummer._plummer")]
pub(crate) struct Case {
    case: Arc<Library>,
    contents: Vec<(String, Arc<[u8]>)>,
}

impl Case {
    /// The case of the library.
    pub(crate) fn library(&self) -> Arc<Library> {
        Arc::clone(&self.case)
    }

    /// A case that was read, with those meshes that are at hand already, and more.
    fn of(
        py: Python<'_>,
        read: Result<Library, CaseError>,
        had: &[(String, Arc<[u8]>)],
        more: &Meshes<'_>,
    ) -> PyResult<Self> {
        let more = more.iter().map(|(name, mesh)| (name.clone(), Arc::clone(&mesh.content)));
        let contents: Vec<_> = had.iter().cloned().chain(more).collect();
        let case = read.map_err(|error| errors::of(py, error))?;
        let case = contents.iter().fold(case, |case, (name, content)| case.with_content(name, Arc::clone(content)));
        Ok(Self { case: Arc::new(case), contents })
    }

    fn ready_for(&self, py: Python<'_>, purpose: Purpose) -> PyResult<()> {
        self.case.ready_for(purpose).map_err(|error| errors::of(py, error))
    }

    /// What a command computes of the case that has what it needs.
    fn compute<T: Send + 'static>(
        &self,
        py: Python<'_>,
        purpose: Purpose,
        progress: Option<&Bound<'_, PyAny>>,
        work: impl FnOnce(&Library, &Told) -> Result<T, ComputeError> + Send + 'static,
    ) -> PyResult<(Arc<Library>, T)> {
        self.ready_for(py, purpose)?;
        let case = Arc::clone(&self.case);
        let result = compute(py, progress, move |told| work(&case, told))?;
        Ok((Arc::clone(&self.case), result))
    }
}

#[pymethods]
impl Case {
    /// Reads a case file; `set`: `KEY=VALUE`, as after --set.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf, set: Vec<String>, meshes: Meshes<'_>) -> PyResult<Self> {
        Self::of(py, Library::load(path, &set), &[], &meshes)
    }

    /// A case of nested dicts; files that it names are looked for beside `path`.
    #[staticmethod]
    fn of_dict(py: Python<'_>, table: &Bound<'_, PyMapping>, path: PathBuf, meshes: Meshes<'_>) -> PyResult<Self> {
        let text = toml::to_string(&to_table(table)?).map_err(|error| errors::input(py, error, None))?;
        Self::of(py, Library::from_source(Source { path, text, set: Vec::new() }), &[], &meshes)
    }

    /// A case by the text of its file.
    #[staticmethod]
    fn of_text(py: Python<'_>, path: PathBuf, text: String, set: Vec<String>, meshes: Meshes<'_>) -> PyResult<Self> {
        Self::of(py, Library::from_source(Source { path, text, set }), &[], &meshes)
    }

    /// Meshes that are at hand, by the names that the case has for them.
    fn meshes(&self, py: Python<'_>) -> PyResult<Vec<(String, Mesh)>> {
        let mesh = |(name, content): &(String, Arc<[u8]>)| Ok((name.clone(), Mesh::again(py, content, name)?));
        self.contents.iter().map(mesh).collect()
    }

    /// The same case with further arguments `KEY=VALUE`.
    fn with_arguments(&self, py: Python<'_>, set: Vec<String>, meshes: Meshes<'_>) -> PyResult<Self> {
        let mut source = self.case.source.clone();
        source.set.extend(set);
        Self::of(py, Library::from_source(source), &self.contents, &meshes)
    }

    /// The value of a key, defaults filled in.
    fn value<'py>(&self, py: Python<'py>, key: &str) -> PyResult<Bound<'py, PyAny>> {
        let value = self.case.value(key).map_err(|error| errors::of(py, error))?;
        to_python(py, &value)
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
        let (case, result) = self.compute(py, Purpose::Modes, progress, compute_modes)?;
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
        let (case, result) = self.compute(py, Purpose::Frf, progress, compute_frf)?;
        Ok(Frf { case, result })
    }

    fn run(&self, py: Python<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<Run> {
        self.ready_for(py, Purpose::Run)?;
        Run::compute(py, &self.case, progress)
    }
}

/// A value as a case file has it, on one line.
#[pyfunction]
pub(crate) fn toml_value(value: &Bound<'_, PyAny>) -> PyResult<String> {
    Ok(to_toml(value)?.to_string())
}
