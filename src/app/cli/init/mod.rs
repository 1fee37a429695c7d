//! `plummer init`: a case file from a mesh.

mod arguments;
mod list;
mod relative;

use std::fs;
use std::path::{Path, PathBuf};

pub use arguments::InitArguments;

use super::analyze::bearing_names;
use super::inspect::verdict;
use super::output::json;
use super::{CliError, Options, Outcome, write_atomic};
use crate::app::commands::init::{Draft, DraftRequest, DraftResult};
use crate::app::commands::result::VERSION;
use crate::app::shell_word::shell_word;
use crate::bearing::catalogue::CatalogueBearing;

/// Writes a case file for a mesh, or lists the bearings.
///
/// # Errors
/// [`CliError`] when the mesh cannot be read, makes no case or has elements that no command takes, the bearing is not known, or the file exists or cannot be written.
pub(crate) fn init(asked: &InitArguments, options: &Options) -> Result<Outcome, CliError> {
    let Some(mesh) = &asked.mesh else {
        return list::list();
    };
    let bearing = asked.bearing.as_deref().map(named).transpose()?;
    let case = case_file(mesh, options)?;
    if case.exists() && !options.force {
        return Err(CliError::input(format!("{} exists", case.display()))
            .with_help("replace it with --force, or name another file with --out"));
    }
    let folder = case.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    let mesh_in_case = relative::path_from(folder, mesh);
    let title = case.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let request =
        DraftRequest { mesh, mesh_in_case: &mesh_in_case, title: &title, length_unit: asked.length_unit, bearing };
    let (draft, inspection) = Draft::of_mesh(request)?;
    if let Err(error) = verdict(&inspection) {
        let what = format!("{}: {error}; no case file was written", mesh.display());
        return Err(CliError { help: error.help, ..CliError::input(what) });
    }
    fs::create_dir_all(folder).map_err(|error| CliError::folder(folder, &error))?;
    write_atomic(&case, draft.text.as_bytes())?;
    Ok(Outcome {
        summary: summary(&draft, &case),
        result: json(&DraftResult { plummer: VERSION, command: "init", mesh, case: &case, draft: &draft })?,
        written: vec![case],
        verdict: Ok(()),
    })
}

fn named(name: &str) -> Result<&'static CatalogueBearing, CliError> {
    CatalogueBearing::named(name).ok_or_else(|| {
        CliError::input(format!("--bearing: found \"{name}\", expected a bearing of the catalogue"))
            .with_help(format!("names: {}; plummer init --list-bearings says their dimensions", bearing_names()))
    })
}

/// `--out`, else the mesh's name with another ending in the current folder.
fn case_file(mesh: &Path, options: &Options) -> Result<PathBuf, CliError> {
    let path = match &options.out {
        Some(path) => path.clone(),
        None => Path::new(mesh.file_stem().unwrap_or_default()).with_extension("toml"),
    };
    if path.file_name().is_none() || path.is_dir() {
        return Err(CliError::input(format!(
            "{}: found no file name, expected that of a case file (--out FILE.toml)",
            path.display()
        )));
    }
    Ok(path)
}

fn summary(draft: &Draft, case: &Path) -> String {
    let mut lines = draft.findings.clone();
    let case = shell_word(&case.to_string_lossy());
    lines.push(format!("Look through the guesses, then: plummer modes {case}"));
    lines.join("\n")
}
