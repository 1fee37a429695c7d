//! The command line, from a Python interpreter.

use plummer::app::cli::main_of;
use plummer::app::program::Program;
use pyo3::prelude::*;
use std::ffi::OsString;
use std::path::PathBuf;

/// Runs the command `plummer` on arguments; gives its exit code. `code`: the file of this module; `call`: what starts it again.
#[pyfunction]
pub(crate) fn main(py: Python<'_>, code: PathBuf, call: Vec<OsString>, arguments: Vec<OsString>) -> u8 {
    Program { code, call }.declare();
    py.detach(|| main_of(arguments))
}
