//! Where an export takes its data from: a case file, or a folder with results of `plummer modes`.
//!
//! `export.json`: which files an export wrote. Exports to other formats in the same folder stay listed under `earlier`.

use super::CliError;
use crate::app::case::Case;
use crate::app::cli::earlier_results::{self, Wanted, case_of_results, other_file, result_of};
use crate::app::cli::{Options, Progress};
use crate::app::commands::modes::compute_mode_shapes;
use crate::app::scene::{mesh_digests, read_mesh};
use crate::fe::mesh::Mesh;
use crate::files::{FileDigest, FileError};
use crate::formats::{ModeShapes, read_modes_npz};
use crate::numerics::Unwatched;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// Farthest that a point of the results may be from its node, relative to the mesh's largest coordinate. Coordinates are
/// written with every bit; a mesh read in another unit or made again is off by far more.
const SAME_POINT: f64 = 1e-9;

/// The results that shapes are taken from.
const MODES: Wanted = Wanted { command: "modes", arrays: "modes.npz", instead: "a case file" };

/// What to do about results of modes that cannot be used.
const MODES_AGAIN: &str = "run `plummer modes` again with --force, or name the case file";

/// A case, and the folder with its results if they are to be taken from there.
pub(super) struct Source {
    pub(super) case: Case,
    /// The folder with results; `None`: they are to be computed.
    pub(super) folder: Option<PathBuf>,
}

impl Source {
    /// Opens a case file, or the case that the `modes.json` of a folder names.
    ///
    /// # Errors
    /// [`CliError`] for a wrong case, or a folder without usable results.
    pub(super) fn open(from: &Path, options: &Options) -> Result<Self, CliError> {
        if !from.is_dir() {
            let case = Case::load(from, &options.set)?;
            return Ok(Self { case, folder: None });
        }
        if !options.set.is_empty() {
            return Err(CliError::input(format!(
                "--set changes the case, but {} holds results of it as it was",
                from.display()
            ))
            .with_help("name the case file to compute it again"));
        }
        let case = case_of_results(from, MODES, &[])?;
        same_meshes(&case, &from.join("modes.json"))?;
        Ok(Self { case, folder: Some(from.to_owned()) })
    }

    /// The mesh, if the case has one, and the mode shapes: at the mesh's nodes, then at the ring's.
    ///
    /// # Errors
    /// [`CliError`] of the computation, or if earlier results cannot be read or are of another mesh.
    pub(super) fn shapes(&self, progress: &Progress) -> Result<(Option<Mesh>, ModeShapes), CliError> {
        let Some(folder) = &self.folder else {
            let (mesh, shapes) = compute_mode_shapes(&self.case, progress)?;
            shapes.check().map_err(|fault| {
                CliError::input(format!("mode shapes: {fault}")).with_help("ask for more modes in [modes]")
            })?;
            return Ok((mesh, shapes));
        };
        progress.stage("read");
        let path = folder.join(MODES.arrays);
        let shapes =
            read_modes_npz(&path).map_err(|error| CliError::input(error.to_string()).with_help(MODES_AGAIN))?;
        let housing = self.case.meshed_housing();
        let mesh = housing.map(|housing| read_mesh(&self.case, housing, &Unwatched)).transpose()?;
        let ring_nodes = self.case.seats().iter().map(|seat| seat.ring.nodes).sum();
        check_fit(&path, mesh.as_ref(), ring_nodes, &shapes)?;
        Ok((mesh, shapes))
    }
}

/// Whether the files that a case rests on are those that its result speaks of.
fn same_meshes(case: &Case, result: &Path) -> Result<(), CliError> {
    let text = std::fs::read(result).unwrap_or_default();
    let json: Value = serde_json::from_slice(&text).unwrap_or_default();
    let then: Vec<FileDigest> = serde_json::from_value(json["meshes"].clone()).unwrap_or_default();
    let now = mesh_digests(case)?;
    match then.iter().zip(now).find(|(then, now)| then.sha256 != now.sha256) {
        None => Ok(()),
        Some((then, now)) => Err(other_file(result, &now.path, &then.sha256, &now.sha256)),
    }
}

/// Whether shapes are at the nodes of this mesh and of a ring of so many nodes.
fn check_fit(path: &Path, mesh: Option<&Mesh>, ring_nodes: usize, shapes: &ModeShapes) -> Result<(), CliError> {
    let wrong = |expected: String, found: String| {
        CliError::input(format!("{} does not fit the case: expected {expected}, found {found}", path.display()))
            .with_help(MODES_AGAIN)
    };
    let nodes: &[[f64; 3]] = mesh.map_or(&[], |mesh| &mesh.nodes);
    let found = shapes.count_points();
    if found != nodes.len() + ring_nodes {
        let expected = format!("{} nodes of the mesh and {ring_nodes} of the ring", nodes.len());
        return Err(wrong(expected, format!("{found} nodes")));
    }
    let largest = nodes.as_flattened().iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    let points = shapes.points.iter().flatten();
    for (index, (node, point)) in nodes.iter().zip(points).enumerate() {
        let apart = (0..3).any(|axis| (node[axis] - point[axis]).abs() > SAME_POINT * largest);
        if let (true, Some(mesh)) = (apart, mesh) {
            let tag = mesh.node_tags[index];
            return Err(wrong(
                format!("node {tag} of {} at {node:?} m", mesh.source.display()),
                format!("{point:?} m"),
            ));
        }
    }
    Ok(())
}

/// What `export.json` says.
#[derive(Debug, Serialize, JsonSchema)]
pub(in crate::app::cli) struct ExportSummary<'a> {
    /// The format.
    pub(super) to: String,
    /// Folder of the results that were exported; `None` for a case.
    pub(super) results: Option<&'a Path>,
    /// What of the model may be meant otherwise, a sentence each.
    pub(super) warnings: &'a [String],
    /// The files.
    pub(super) files: Vec<WrittenFile>,
    /// What an earlier `export.json` says of other formats, without its own `earlier`.
    pub(super) earlier: Vec<Value>,
}

/// A file of an export.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub(in crate::app::cli) struct WrittenFile {
    /// Name in the folder.
    pub(super) file: String,
    /// Size, bytes.
    pub(super) bytes: u64,
    /// What it holds.
    pub(super) what: String,
}

impl WrittenFile {
    /// A file that was written into a folder.
    ///
    /// # Errors
    /// [`CliError`] if it is not there.
    pub(super) fn new(folder: &Path, name: &str, what: String) -> Result<Self, CliError> {
        let path = folder.join(name);
        let found = fs::metadata(&path).map_err(FileError::write(&path))?;
        Ok(Self { file: name.to_owned(), bytes: found.len(), what })
    }
}

/// What a file of an export is of, behind "an earlier run"; `None`: of this case, by the `export.json` beside it.
pub(super) fn lost_with(file: &Path, case: &Case) -> Option<&'static str> {
    let mut last = result_of("export", &file.with_file_name("export.json"));
    let earlier = last["earlier"].take();
    let exports = std::iter::once(&last).chain(earlier.as_array().into_iter().flatten());
    let name = file.file_name().unwrap_or_default();
    let wrote = |export: &&Value| {
        let files = export["files"].as_array().into_iter().flatten();
        files.filter_map(|file| file["file"].as_str()).any(|file| file == name)
    };
    exports.filter(wrote).map(|export| earlier_results::lost_with(export, case)).next().unwrap_or(Some(""))
}

/// Exports to other formats that a folder's `export.json` speaks of.
/// An earlier file that is no result of an export is left out.
pub(super) fn earlier(folder: &Path, to: &str) -> Vec<Value> {
    let text = fs::read_to_string(folder.join("export.json")).unwrap_or_default();
    let Ok(Value::Object(mut last)) = serde_json::from_str(&text) else {
        return Vec::new();
    };
    let mut all = match last.remove("earlier") {
        Some(Value::Array(earlier)) => earlier,
        _ => Vec::new(),
    };
    all.push(Value::Object(last));
    all.retain(|export| export.get("to").is_some_and(|other| *other != *to));
    all
}
