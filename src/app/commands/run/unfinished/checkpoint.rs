//! The file of a checkpoint, and what a run was begun with, told apart by content.
//!
//! ```text
//! plummer checkpoint 3            a line
//! {"identity": ..}                a line of JSON: what the run was begun with, how far it is, rows, words
//! words                           64 bits each, little-endian
//! SHA-256 of all before           32 bytes
//! ```

use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::app::scene::mesh_digests;
use crate::files::{self, FileDigest, FileError, write_atomic};
use crate::formats::ColumnFiles;
use crate::numerics::ode::Snapshot;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fs;
use std::io::Write;
use std::path::Path;

const MAGIC: &[u8] = b"plummer checkpoint 3\n";

/// Bytes of the digest at the end.
const DIGEST: usize = 32;

/// A checkpoint: a line of JSON with all but its words, which follow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Checkpoint {
    pub identity: RunIdentity,
    /// For a reader of the file, s.
    time_s: f64,
    /// Rows of the columns that belong to it.
    pub rows: usize,
    /// SHA-256 of these rows, 64 hexadecimal digits.
    pub columns_sha256: String,
    /// How many words follow.
    words: usize,
    #[serde(skip)]
    pub snapshot: Snapshot,
}

/// Writes a checkpoint, whole or not at all, in the place of an earlier one.
///
/// # Errors
/// [`ComputeError::File`].
pub(crate) fn write(
    path: &Path,
    identity: &RunIdentity,
    columns: &ColumnFiles,
    time_s: f64,
    snapshot: &Snapshot,
) -> Result<(), ComputeError> {
    let head = Checkpoint {
        identity: identity.clone(),
        time_s,
        rows: columns.rows(),
        columns_sha256: columns.digest(),
        words: snapshot.words.len(),
        snapshot: Snapshot::default(),
    };
    let mut bytes = MAGIC.to_vec();
    let written = serde_json::to_writer(&mut bytes, &head).map_err(std::io::Error::from);
    written.map_err(FileError::write(path))?;
    bytes.push(b'\n');
    bytes.extend(snapshot.words.iter().flat_map(|word| word.to_le_bytes()));
    let digest = Sha256::digest(&bytes);
    bytes.extend_from_slice(&digest);
    Ok(write_atomic(path, |file| file.write_all(&bytes))?)
}

/// The error of a file or folder that holds no whole checkpoint.
pub(crate) fn damaged(path: &Path, what: &str) -> ComputeError {
    ComputeError::input(format!("{} is no whole checkpoint: {what}", path.display()), ComputeError::ANEW)
}

impl Checkpoint {
    /// Reads a checkpoint.
    ///
    /// # Errors
    /// [`ComputeError::File`], and as [`damaged`].
    pub(crate) fn read(path: &Path) -> Result<Self, ComputeError> {
        let bytes = fs::read(path).map_err(FileError::read(path))?;
        Self::parse(&bytes).map_err(|what| damaged(path, &what))
    }

    fn parse(bytes: &[u8]) -> Result<Self, String> {
        let Some(rest) = bytes.strip_prefix(MAGIC) else {
            return Err("it does not begin as one of this version does".to_owned());
        };
        let content = bytes.len().saturating_sub(DIGEST);
        if rest.len() < DIGEST || Sha256::digest(&bytes[..content])[..] != bytes[content..] {
            return Err("its digest is not that of its content".to_owned());
        }
        let rest = &rest[..rest.len() - DIGEST];
        let line = rest.iter().position(|&byte| byte == b'\n');
        let (head, words) = rest.split_at(line.unwrap_or(rest.len()));
        let head: Self = serde_json::from_slice(head).map_err(|error| error.to_string())?;
        let (words, _) = words.get(1..).unwrap_or_default().as_chunks();
        let words: Vec<u64> = words.iter().map(|word| u64::from_le_bytes(*word)).collect();
        if words.len() != head.words {
            return Err(format!("{} words of {}", words.len(), head.words));
        }
        Ok(Self { snapshot: Snapshot { words }, ..head })
    }
}

/// Program, case, arguments and files of a run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunIdentity {
    plummer: String,
    /// SHA-256 of the values, 64 hexadecimal digits.
    case_sha256: String,
    set: Vec<String>,
    /// Meshes and tables that they name.
    files: Vec<FileDigest>,
}

impl RunIdentity {
    /// Of a case as this command would compute it now.
    ///
    /// # Errors
    /// [`ComputeError`] for a mesh that cannot be read.
    pub fn of(case: &Case, command: &str) -> Result<Self, ComputeError> {
        let mut files = mesh_digests(case)?;
        // one that cannot be read is named where it is needed
        files.extend(case.tables(command).filter_map(|table| FileDigest::of_file(table).ok()));
        Ok(Self {
            plummer: env!("CARGO_PKG_VERSION").to_owned(),
            case_sha256: Self::values_of(case, command),
            set: case.source.set.clone(),
            files,
        })
    }

    fn values_of(case: &Case, command: &str) -> String {
        // all but what a report's head says
        let values = case.values(command, &["title", "report"]);
        files::hex(Sha256::new_with_prefix(values.unwrap_or_default()))
    }

    /// Whether a case has these values.
    pub(crate) fn has_values_of(&self, case: &Case, command: &str) -> bool {
        self.case_sha256 == Self::values_of(case, command)
    }

    /// What is not the same now, in words.
    pub(crate) fn changes(&self, now: &Self) -> Vec<String> {
        let mut changes = Vec::new();
        if self.plummer != now.plummer {
            changes.push(format!("plummer {}, now plummer {}", self.plummer, now.plummer));
        }
        if self.case_sha256 != now.case_sha256 {
            changes.push(match self.set == now.set {
                true => "other values in the case file".to_owned(),
                false => format!("{}, now {}", set_text(&self.set), set_text(&now.set)),
            });
        }
        let [then, current] = [self, now].map(|run| run.files.iter().map(|file| &file.sha256));
        if then.ne(current) {
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
    use crate::app::case::Source;

    fn identity() -> RunIdentity {
        let case = Case::from_source(Source {
            text: "[ring]\nsections = [{ material = \"steel\", area = 5e-6, inertia = 9e-13, radius = 5.3e-3 }]\n"
                .to_owned(),
            ..Source::default()
        });
        RunIdentity::of(&case.unwrap(), "run").unwrap()
    }

    #[test]
    fn a_checkpoint_comes_back_and_a_damaged_one_does_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint");
        let mut snapshot = Snapshot::default();
        snapshot.numbers(&[f64::NAN, -0.0, 1.0 / 3.0]);
        snapshot.count(u64::MAX - 1);
        let columns = ColumnFiles::create(folder.path(), crate::system::RecordLayout::default()).unwrap();
        write(&path, &identity(), &columns, 0.25, &snapshot).unwrap();
        let read = Checkpoint::read(&path).unwrap();
        assert_eq!((read.rows, &read.snapshot), (0, &snapshot));
        assert_eq!(read.columns_sha256, columns.digest());
        assert_eq!(read.identity, identity());
        let whole = fs::read(&path).unwrap();
        for place in [MAGIC.len() + 5, whole.len() / 2, whole.len() - 40, whole.len() - 1] {
            let mut damaged = whole.clone();
            damaged[place] ^= 4;
            fs::write(&path, &damaged).unwrap();
            let error = Checkpoint::read(&path).unwrap_err().to_string();
            assert!(error.ends_with("is no whole checkpoint: its digest is not that of its content"), "{error}");
        }
        for length in 0..whole.len() {
            assert!(Checkpoint::parse(&whole[..length]).is_err(), "{length}");
        }
        let error = Checkpoint::read(&folder.path().join("nowhere")).unwrap_err();
        assert!(matches!(error, ComputeError::File(_)));
    }

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
            ["plummer 0.1.0, now plummer 0.2.0", "--set a=1, now no --set", "another content of a.msh",]
        );
        let values = RunIdentity { case_sha256: "ab".to_owned(), ..identity.clone() };
        assert_eq!(identity.changes(&values), ["other values in the case file"]);
        // the same values in other words
        let words = RunIdentity { set: vec!["a=1.0".to_owned()], ..identity.clone() };
        assert!(identity.changes(&words).is_empty());
        moved.files.clear();
        assert_eq!(identity.changes(&moved), ["another content of more or fewer files"]);
    }
}
