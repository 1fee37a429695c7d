//! The program: case files, commands, studies and the command line.
//!
//! In come a TOML file and arguments; out go result files, figures and one HTML page.
//!
//! - [`case`]: the case file, read and checked;
//! - [`error`]: what can go wrong on the way to a result;
//! - [`program`]: which program this is, where another has loaded it;
//! - [`scene`]: a checked case as domain objects;
//! - [`commands`]: what each command computes, as a value, and its report;
//! - [`verification`]: the built-in checks of `plummer verify`;
//! - [`studies`]: many runs of one case;
//! - [`cli`]: arguments, progress, files, exit codes.
//!
//! Read [`case::Case`] first.

pub mod case;
pub mod cli;
pub mod commands;
pub mod error;
pub mod program;
pub mod scene;
pub mod shell_word;
pub mod studies;
pub mod verification;
