//! `plummer export`: matrices and mode shapes in the formats of other programs.
//!
//! A case is computed as far as the format needs: matrices are assembled, mode shapes solved for, the housing condensed. A folder with results of
//! `plummer modes` gives its mode shapes without solving again.

mod condensed;
mod matrices;
mod record;
mod shapes;
mod source;

use std::path::{Path, PathBuf};

use super::results::{result_head, result_of_case, warnings};
use super::{CliError, ExportFormat, Options, Outcome, OutputFolder, Progress};
use crate::app::case::Case;
use crate::app::scene::{doubts_of_case, mesh_digests};
pub(super) use record::ExportSummary;
use record::WrittenFile;
use source::Source;

/// What an export wrote.
struct Export {
    /// Its files, in the order of writing.
    files: Vec<WrittenFile>,
    /// A line for a reader.
    summary: String,
}

/// Exports a case, or the results in a folder, and writes `export.json` last, which names the files.
///
/// # Errors
/// [`CliError`] when the input is wrong, an earlier file would be replaced, the computation fails or a file cannot be
/// written.
pub(crate) fn export(from: &Path, to: ExportFormat, options: &Options) -> Result<Outcome, CliError> {
    let started = std::time::Instant::now();
    let source = Source::open(from, options)?;
    let case = source.case();
    if let ExportFormat::Op4 | ExportFormat::Mbdyn = to {
        condensed::can_condense(case, to)?;
    }
    let folder = match (&options.out, source.folder()) {
        (None, Some(folder)) => OutputFolder::at(folder),
        _ => OutputFolder::of(case, options),
    };
    // what `plummer modes` left in the folder is a source, not in the way
    let stays = |name: &&str| !(*name == "modes.npz" && source.folder() == Some(folder.path()));
    let names: Vec<&str> = to.files(case).into_iter().filter(stays).collect();
    folder.claim_files(&names, options.force)?;
    let progress = Progress::new(options.visibility());
    let exported = match to {
        ExportFormat::Mtx => matrices::mtx(case, &folder, &progress),
        ExportFormat::Npz => matrices::npz(&source, &folder, &progress),
        ExportFormat::Vtu => shapes::vtu(&source, &folder, &progress),
        ExportFormat::Uff => shapes::uff(&source, &folder, &progress),
        ExportFormat::Op4 => condensed::op4(case, &folder, &progress),
        ExportFormat::Mbdyn => condensed::mbdyn(case, &folder, &progress),
    };
    progress.finish();
    let Export { files, summary } = exported?;
    let doubts = doubts_of_case(case)?;
    let lines = warnings(&doubts).chain(std::iter::once(summary));
    let summary = lines.collect::<Vec<_>>().join("\n");
    let meshes = mesh_digests(case)?;
    let wall_s = started.elapsed().as_secs_f64();
    let record = ExportSummary {
        to: to.name(),
        results: source.folder(),
        warnings: &doubts,
        earlier: record::earlier(folder.path(), to.name()),
        files,
    };
    let head = result_head("export", &progress, wall_s, None);
    let record = result_of_case(head, case, &meshes, record);
    // what stayed as it was is listed, not written
    let written = names.iter().map(|name| folder.path().join(name));
    let mut written: Vec<PathBuf> = written.collect();
    let (path, result) = folder.write_json("export.json", &record)?;
    written.push(path);
    Ok(Outcome { summary, result, written, verdict: Ok(()) })
}

impl ExportFormat {
    /// Names of the files that an export of a case writes beside `export.json`.
    fn files(self, case: &Case) -> Vec<&'static str> {
        let of_bodies = |housing, ring| {
            let housing = case.meshed_housing().map(|_| housing);
            housing.into_iter().chain(case.ring.as_ref().map(|_| ring)).collect()
        };
        match self {
            Self::Mtx => vec!["stiffness.mtx", "mass.mtx", "dofs.csv"],
            Self::Npz => vec!["stiffness.npz", "mass.npz", "dofs.npz", "modes.npz"],
            Self::Vtu => of_bodies("modes.vtu", "ring.vtu"),
            Self::Uff => of_bodies("modes.uff", "ring.uff"),
            Self::Op4 => vec!["superelement.op4", "superelement_dofs.csv"],
            Self::Mbdyn => vec!["superelement.fem"],
        }
    }
}
