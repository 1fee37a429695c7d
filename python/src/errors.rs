//! Errors of the library as exceptions of `plummer._errors`, by kind, with the program's words.

use plummer::app::cli::CliError;
use plummer::prelude::ComputeError;
use pyo3::prelude::*;
use std::fmt::Display;

/// An exception of this class.
fn exception(py: Python<'_>, class: &str, what: String, help: Option<String>) -> PyErr {
    let made = py.import("plummer._errors").and_then(|module| module.getattr(class)?.call1((what, help)));
    made.map_or_else(|error| error, PyErr::from_value)
}

/// What a stage says. `class`: of wrong input where the error itself does not say its kind.
pub(crate) fn of(py: Python<'_>, error: impl Into<ComputeError>) -> PyErr {
    let error = error.into();
    let class = match &error {
        ComputeError::Case(_) => "CaseError",
        ComputeError::Mesh(_) => "MeshError",
        ComputeError::OtherMesh { source, .. } if matches!(**source, ComputeError::Mesh(_)) => "MeshError",
        ComputeError::File(_) => "FileError",
        _ => "",
    };
    let CliError { is_input, what, help } = error.into();
    let class = match (class, is_input) {
        ("", true) => "InputError",
        ("", false) => "ComputationError",
        (class, _) => class,
    };
    exception(py, class, what, help)
}

/// What the command line says of files.
pub(crate) fn of_command(py: Python<'_>, CliError { is_input, what, help }: CliError) -> PyErr {
    exception(py, if is_input { "InputError" } else { "ComputationError" }, what, help)
}

/// Wrong input of this interface itself.
pub(crate) fn input(py: Python<'_>, what: impl Display, help: Option<&str>) -> PyErr {
    exception(py, "InputError", what.to_string(), help.map(str::to_owned))
}

/// A computation that failed in a way that nobody foresaw.
pub(crate) fn failed(py: Python<'_>, what: impl Display) -> PyErr {
    exception(py, "ComputationError", what.to_string(), None)
}

/// Whether Ctrl-C ended it.
pub(crate) fn is_interrupted(py: Python<'_>, error: &PyErr) -> bool {
    error.get_type(py).name().is_ok_and(|name| name == "Interrupted")
}

/// A computation that Ctrl-C ended.
pub(crate) fn interrupted(py: Python<'_>, what: &str) -> PyErr {
    let made = py.import("plummer._errors").and_then(|module| module.getattr("Interrupted")?.call1((what,)));
    made.map_or_else(|error| error, PyErr::from_value)
}
