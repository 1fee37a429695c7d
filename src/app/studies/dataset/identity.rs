//! What a data set was begun with: files by their content.

use super::spec::DatasetSpec;
use crate::app::case::{Case, Source};
use crate::app::commands::result::VERSION;
use crate::app::error::ComputeError;
use crate::app::scene::mesh_digests;
use crate::files::{FileDigest, FileError};
use serde::{Deserialize, Serialize};

/// What a data set was begun with: files by their content.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct DatasetIdentity {
    /// The program's version.
    pub(crate) plummer: String,
    /// SHA-256 of the specification.
    pub(crate) spec_sha256: String,
    /// `KEY=VALUE` arguments.
    pub(crate) set: Vec<String>,
    /// Cases, the meshes and tables that they name, the background: as the specification names them.
    pub(crate) files: Vec<FileDigest>,
}

/// What a specification, its cases and their files are now.
pub(super) fn identity(spec: &DatasetSpec, source: &Source, cases: &[Case]) -> Result<DatasetIdentity, ComputeError> {
    let folder = DatasetSpec::folder(source);
    let mut files = Vec::new();
    for case in cases {
        files.push(FileDigest::of_bytes(&case.source.path, case.source.text.as_bytes()));
        files.extend(mesh_digests(case)?);
        files.extend(case.tables("run").filter_map(|table| FileDigest::of_file(table).ok()));
    }
    if let Some(background) = spec.noise.as_ref().and_then(|noise| noise.background.as_ref()) {
        let path = folder.join(&background.file);
        files.push(FileDigest::of_file(&path).map_err(FileError::read(&path))?);
    }
    for file in &mut files {
        if let Ok(named) = file.path.strip_prefix(folder) {
            file.path = named.to_owned();
        }
    }
    files.sort_by(|a, b| a.path.cmp(&b.path));
    files.dedup();
    Ok(DatasetIdentity {
        plummer: VERSION.to_owned(),
        spec_sha256: FileDigest::of_bytes(&source.path, source.text.as_bytes()).sha256,
        set: source.set.clone(),
        files,
    })
}

impl DatasetIdentity {
    /// What is not the same now, in words.
    pub(crate) fn changes(&self, now: &Self) -> Vec<String> {
        let mut changes = Vec::new();
        if self.plummer != now.plummer {
            changes.push(format!("plummer {}, now {}", self.plummer, now.plummer));
        }
        if self.spec_sha256 != now.spec_sha256 {
            changes.push("another specification".to_owned());
        }
        if self.set != now.set {
            let words = |set: &[String]| match set {
                [] => "no --set".to_owned(),
                set => set.iter().map(|set| format!("--set {set}")).collect::<Vec<_>>().join(" "),
            };
            changes.push(format!("{}, now {}", words(&self.set), words(&now.set)));
        }
        let other = now.files.iter().filter(|file| !self.files.contains(file));
        changes.extend(other.map(|file| format!("another {}", file.path.display())));
        changes
    }
}
