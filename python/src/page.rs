//! What all results have: the content of the command's JSON file, and the report.

use crate::{errors, values};
use plummer::app::cli::write_report;
use plummer::app::commands::result::VERSION;
use plummer::prelude::{Case, Computed};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::Path;

/// The content of `COMMAND.json` but for what only a process has: times, threads, files.
pub(crate) fn summary<'py>(
    py: Python<'py>,
    command: &str,
    case: &Case,
    result: &impl Computed,
) -> PyResult<Bound<'py, PyDict>> {
    let summary = PyDict::new(py);
    summary.set_item("plummer", VERSION)?;
    summary.set_item("command", command)?;
    summary.set_item("case", case.source.path.to_string_lossy())?;
    summary.set_item("set", &case.source.set)?;
    summary.set_item("case_digest", case.digest(command))?;
    summary.update(values::dict(py, result)?.as_mapping())?;
    Ok(summary)
}

/// The report as one page of HTML.
pub(crate) fn html(py: Python<'_>, command: &str, case: &Case, result: &impl Computed) -> PyResult<String> {
    result.page(case, &format!("case.{command}()")).map_err(|error| errors::of(py, error))
}

/// Writes the report into a folder that is there, its tables and figures beside it.
pub(crate) fn write(py: Python<'_>, folder: &Path, command: &str, case: &Case, result: &impl Computed) -> PyResult<()> {
    let report = result.report(case, &format!("case.{command}()")).map_err(|error| errors::of(py, error))?;
    write_report(folder, command, case, report).map_err(|error| errors::of_command(py, error))
}
