//! `plummer init`: a case file from a mesh.

mod arguments;
mod error;
mod list;
mod relative;

use std::fs;
use std::path::{Path, PathBuf};

pub use arguments::InitArguments;
pub use error::InitError;
pub(in crate::app::cli) use error::bearing_names;

use super::inspect::verdict;
use super::output::json;
use super::{CliError, Options, Outcome, Verdict, write_atomic};
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
        return Err(InitError::Exists { path: case }.into());
    }
    let folder = case.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    let mesh_in_case = relative::path_from(folder, mesh);
    let title = case.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let request =
        DraftRequest { mesh, mesh_in_case: &mesh_in_case, title: &title, length_unit: asked.length_unit, bearing };
    let (draft, inspection) = Draft::of_mesh(request).map_err(InitError::from)?;
    if let Verdict::Bad { what, help } = verdict(&inspection) {
        let path = mesh.clone();
        return Err(InitError::Mesh { path, what, help }.into());
    }
    fs::create_dir_all(folder).map_err(|source| CliError::Folder { path: folder.to_owned(), source })?;
    write_atomic(&case, draft.text.as_bytes())?;
    Ok(Outcome {
        summary: summary(&draft, &case),
        result: json(&DraftResult { plummer: VERSION, command: "init", mesh, case: &case, draft: &draft })?,
        written: vec![case],
        verdict: Verdict::Good,
    })
}

fn named(name: &str) -> Result<&'static CatalogueBearing, InitError> {
    CatalogueBearing::named(name).ok_or_else(|| InitError::UnknownBearing { found: name.to_owned() })
}

/// `--out`, else the mesh's name with another ending in the current folder.
fn case_file(mesh: &Path, options: &Options) -> Result<PathBuf, InitError> {
    let path = match &options.out {
        Some(path) => path.clone(),
        None => Path::new(mesh.file_stem().unwrap_or_default()).with_extension("toml"),
    };
    if path.file_name().is_none() || path.is_dir() {
        return Err(InitError::NoName { path });
    }
    Ok(path)
}

fn summary(draft: &Draft, case: &Path) -> String {
    let mut lines = draft.findings.clone();
    let case = shell_word(&case.to_string_lossy());
    lines.push(format!("Look through the guesses, then: plummer modes {case}"));
    lines.join("\n")
}
