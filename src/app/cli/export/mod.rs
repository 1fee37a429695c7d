//! `plummer export`: matrices and mode shapes in the formats of other programs.
//!
//! A case is computed as far as the format needs: matrices are assembled, mode shapes solved for, the housing condensed. A folder with results of
//! `plummer modes` gives its mode shapes without solving again.

mod condensed;
mod deck;
mod matrices;
mod shapes;
mod source;

use std::path::{Path, PathBuf};

use super::earlier_results::{left_in, result_of};
use super::results::{Job, warnings};
use super::{CliError, ExportFormat, Options, Outcome, OutputFolder, Progress, failure, word};
use crate::app::case::Case;
use crate::app::scene::{doubts_of_case, mesh_digests};
pub(super) use source::ExportSummary;
use source::{Source, WrittenFile};

/// What an export wrote.
struct Export {
    /// Names of its files and what they hold, in the order of writing.
    files: Vec<(&'static str, String)>,
    /// A line for a reader.
    summary: String,
}

/// Exports a case, or the results in a folder, and writes `export.json` last, which names the files.
///
/// # Errors
/// [`CliError`] when the input is wrong, an earlier file would be replaced, the computation fails or a file cannot be
/// written.
pub(crate) fn export(from: &Path, to: ExportFormat, options: &Options) -> Result<Outcome, CliError> {
    let progress = Progress::new(options.shows_progress());
    let started = std::time::Instant::now();
    let source = Source::open(from, options)?;
    let case = &source.case;
    if let ExportFormat::Op4 | ExportFormat::Dmig | ExportFormat::Mbdyn = to {
        condensed::can_condense(case, to)?;
    }
    let mut job = Job { started, ..Job::new("export", case, options, &progress) };
    if let (None, Some(folder)) = (&options.out, &source.folder) {
        job.folder = OutputFolder::at(folder);
    }
    let folder = &job.folder;
    // what `plummer modes` left in the folder is a source, not in the way
    let stays = |name: &&str| !(*name == "modes.npz" && source.folder.as_ref() == Some(&folder.path));
    let names: Vec<&str> = to.files(case).into_iter().filter(stays).collect();
    folder.claim_unless(&[&names[..], &["export.json"]].concat(), options.force, |path| {
        let record = path.ends_with("export.json");
        if record { result_of("export", path).is_null().then_some("") } else { source::lost_with(path, case) }
    })?;
    failure::on_interrupt(left_in(&folder.path, "export", options.force));
    let exported = match to {
        ExportFormat::Mtx => matrices::mtx(case, folder, &progress),
        ExportFormat::Npz => matrices::npz(&source, folder, &progress),
        ExportFormat::Vtu => shapes::vtu(&source, folder, &progress),
        ExportFormat::Uff => shapes::uff(&source, folder, &progress),
        ExportFormat::Op4 => condensed::op4(case, folder, &progress),
        ExportFormat::Dmig => condensed::dmig(case, folder, &progress),
        ExportFormat::Inp => deck::inp(case, folder, &progress),
        ExportFormat::Mbdyn => condensed::mbdyn(case, folder, &progress),
    };
    progress.finish();
    let Export { files, summary } = exported?;
    let mut doubts = doubts_of_case(case)?;
    if to == ExportFormat::Inp {
        doubts.extend(deck::left_out(case).into_iter().map(|what| format!("housing.inp has not: {what}")));
    }
    let lines = warnings(&doubts).chain(std::iter::once(summary));
    let summary = lines.collect::<Vec<_>>().join("\n");
    let meshes = mesh_digests(case)?;
    let files = files.into_iter().map(|(name, what)| WrittenFile::new(&folder.path, name, what));
    let to = word(to);
    let record = ExportSummary {
        results: source.folder.as_deref(),
        warnings: &doubts,
        files: files.collect::<Result<_, _>>()?,
        earlier: source::earlier(&folder.path, &to),
        to,
    };
    let record = job.record(&meshes, None, record);
    // what stayed as it was is listed, not written
    let mut written: Vec<PathBuf> = names.iter().map(|name| folder.path.join(name)).collect();
    let (path, result) = folder.write_json("export.json", &record)?;
    written.push(path);
    Ok(Outcome { summary, result, written, verdict: Ok(()) })
}

impl ExportFormat {
    /// Names of the files that an export of a case writes beside `export.json`.
    fn files(self, case: &Case) -> Vec<&'static str> {
        let of_bodies = |housing, ring| {
            let housing = case.meshed_housing().map(|_| housing);
            housing.into_iter().chain(case.has_rings().then_some(ring)).collect()
        };
        match self {
            Self::Mtx => vec!["stiffness.mtx", "mass.mtx", "dofs.csv"],
            Self::Npz => vec!["stiffness.npz", "mass.npz", "dofs.npz", "modes.npz"],
            Self::Vtu => of_bodies("modes.vtu", "ring.vtu"),
            Self::Uff => of_bodies("modes.uff", "ring.uff"),
            Self::Op4 => vec!["superelement.op4", "superelement_dofs.csv"],
            Self::Dmig => vec!["superelement.bdf"],
            Self::Inp => vec!["housing.inp"],
            Self::Mbdyn => vec!["superelement.fem"],
        }
    }
}
