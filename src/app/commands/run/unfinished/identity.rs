//! What a run was begun with, told apart by content.

use crate::app::case::{Case, Defect};
use crate::app::error::ComputeError;
use crate::app::scene::mesh_digests;
use crate::files;
use crate::files::FileDigest;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// Program, case, arguments and files of a run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunIdentity {
    plummer: String,
    /// SHA-256 of the case file's text, 64 hexadecimal digits.
    case_sha256: String,
    set: Vec<String>,
    /// Meshes and tables that it names.
    files: Vec<FileDigest>,
}

impl RunIdentity {
    /// Of a case as it would be run now.
    ///
    /// # Errors
    /// [`ComputeError`] for a mesh that cannot be read.
    pub fn of(case: &Case) -> Result<Self, ComputeError> {
        let mut files = mesh_digests(case)?;
        let defects = case.bearing.iter().flat_map(|bearing| &bearing.defects);
        for defect in defects {
            if let Defect::Measured(measured) = defect {
                // one that cannot be read is named where it is needed
                files.extend(FileDigest::of_file(&measured.profile.csv));
            }
        }
        Ok(Self {
            plummer: env!("CARGO_PKG_VERSION").to_owned(),
            case_sha256: files::hex(Sha256::new_with_prefix(&case.source.text)),
            set: case.source.set.clone(),
            files,
        })
    }

    /// Whether the case file's text is this one.
    pub(crate) fn is_of_text(&self, text: &str) -> bool {
        self.case_sha256 == files::hex(Sha256::new_with_prefix(text))
    }

    /// What is not the same now, in words.
    #[must_use]
    pub(crate) fn changes(&self, now: &Self) -> Vec<String> {
        let mut changes = Vec::new();
        if self.plummer != now.plummer {
            changes.push(format!("plummer {}, now plummer {}", self.plummer, now.plummer));
        }
        if self.case_sha256 != now.case_sha256 {
            changes.push("another text of the case file".to_owned());
        }
        if self.set != now.set {
            changes.push(format!("{}, now {}", set_text(&self.set), set_text(&now.set)));
        }
        let hashes = |files: &[FileDigest]| -> Vec<String> { files.iter().map(|file| file.sha256.clone()).collect() };
        if hashes(&self.files) != hashes(&now.files) {
            let pairs = self.files.iter().zip(&now.files);
            let other = pairs.filter(|(then, now)| then.sha256 != now.sha256);
            let mut names: Vec<String> = other.map(|(_, now)| now.path.display().to_string()).collect();
            if names.is_empty() {
                names.push("more or fewer files".to_owned());
            }
            changes.push(format!("another content of {}", names.join(", ")));
        }
        changes
    }
}

fn set_text(set: &[String]) -> String {
    if set.is_empty() {
        return "no --set".to_owned();
    }
    let words: Vec<String> = set.iter().map(|set| format!("--set {set}")).collect();
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_change_is_named() {
        let identity = RunIdentity {
            plummer: "0.1.0".to_owned(),
            case_sha256: "aa".to_owned(),
            set: vec!["a=1".to_owned()],
            files: vec![FileDigest { path: "a.msh".into(), sha256: "bb".to_owned() }],
        };
        assert!(identity.changes(&identity).is_empty());
        let mut moved = identity.clone();
        moved.files[0].path = "elsewhere/a.msh".into();
        assert!(identity.changes(&moved).is_empty());
        let other = RunIdentity {
            plummer: "0.2.0".to_owned(),
            case_sha256: "ab".to_owned(),
            set: Vec::new(),
            files: vec![FileDigest { path: "a.msh".into(), sha256: "cc".to_owned() }],
        };
        assert_eq!(
            identity.changes(&other),
            [
                "plummer 0.1.0, now plummer 0.2.0",
                "another text of the case file",
                "--set a=1, now no --set",
                "another content of a.msh",
            ]
        );
        moved.files.clear();
        assert_eq!(identity.changes(&moved), ["another content of more or fewer files"]);
    }
}
