//! Condensed housings that a folder keeps for the next computation, each by the digest of all that it follows from.
//!
//! A condensed housing is a function of matrices, partition, basis and the places of sensors. Its key is the SHA-256 of these numbers
//! themselves and of the program: no key of a case can be forgotten, and what does not matter, such as a dent, plays no part.
//! A file is read again bit by bit, or not at all if its own digest does not fit.

use super::places::Place;
use super::ring::Boundary;
use crate::app::program::Program;
use crate::fe::assembly::SystemMatrices;
use crate::fe::reduction::{BasisChoice, Superelement};
use crate::files::{self, FileDigest, hex, make_below, no_link, write_atomic};
use crate::numerics::Watch;
use crate::numerics::linalg::{DenseMatrix, SparseMatrix};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::ffi::OsStr;
use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

/// How a file begins; the number is that of the format.
const MAGIC: &[u8] = b"plummer condensed housing 1\n";

/// Bytes of a SHA-256.
const DIGEST: usize = 32;

/// How the name of a file ends.
const EXTENSION: &str = "condensed";

/// Most bytes that a folder keeps: those used longest ago go first. A ring of 72 nodes in a solid housing takes 4 to 20 MB.
const MOST_BYTES: u64 = 1 << 30;

/// Degrees of freedom of the interior from which on a housing is kept: fewer are condensed in less than half a second.
const LEAST_DOF: usize = if cfg!(test) { 500 } else { 3000 };

/// How long a process waits for another that condenses the same housing. It may have been stopped: then one condensation more is the
/// lesser evil.
const LONGEST_WAIT: Duration = Duration::from_secs(if cfg!(test) { 1 } else { 120 });

/// What a structure of rings takes of the housing.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct OnRings {
    /// The condensed housing, whose interface is the rings, without structural damping; `None` of a ring alone.
    pub(super) element: Option<Superelement>,
    /// Rows of the case's sensors over the coordinates of ring and element \[order\].
    pub(super) sensors: Vec<Vec<f64>>,
    /// Frequency of the lowest vector of the housing's interior that was left out, Hz, > 0.
    pub(super) complete_hz: f64,
}

/// The place of a condensed housing in a folder; other processes that want the same one wait until it is dropped, [`LONGEST_WAIT`] at most.
pub(super) struct Kept {
    path: PathBuf,
    key: String,
    /// Held for the lock on it.
    _lock: File,
}

/// What a file says of itself.
#[derive(Serialize, Deserialize)]
struct Head {
    key: String,
    /// When it was condensed, s since 1970.
    condensed_at: u64,
    /// How long that took, s.
    seconds: f64,
    interface_dof: usize,
    order: usize,
    sensors: usize,
}

impl Kept {
    /// The place in the watched folder; `None` without a folder, or for a housing that is condensed in no time.
    pub(super) fn of(
        matrices: &SystemMatrices,
        boundary: &Boundary,
        choice: BasisChoice,
        places: &[Place],
        watch: &impl Watch,
    ) -> Option<Self> {
        let folder = watch.cache()?;
        if boundary.partition().interior.len() < LEAST_DOF {
            return None;
        }
        watch.stage("look for the condensed housing");
        let place = key(matrices, boundary, choice, places).and_then(|key| Self::at(folder, key, watch));
        place.map_err(|error| watch.reuse(format!("condensed housing: not kept in {}: {error}", folder.display()))).ok()
    }

    fn at(folder: &Path, key: String, watch: &impl Watch) -> io::Result<Self> {
        let name = folder.file_name().unwrap_or(OsStr::new("cache"));
        let folder = make_below(folder.parent().unwrap_or(Path::new("")), Path::new(name))?;
        let file = |extension: &str| folder.join(format!("{}.{extension}", &key[..16]));
        let (path, lock) = (file(EXTENSION), locked(&file("lock"), watch)?);
        Ok(Self { path, key, _lock: lock })
    }

    /// The housing, if it is there and whole.
    pub(super) fn read(&self, watch: &impl Watch) -> Option<OnRings> {
        let bytes = match no_link(&self.path).and_then(|()| files::read(&self.path)) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return None,
            Err(error) => {
                watch.reuse(format!("condensed housing: {} is not used: {error}", self.path.display()));
                return None;
            }
        };
        let Some((head, found)) = parsed(&bytes, &self.key) else {
            watch.reuse(format!("condensed housing: {} is damaged, condensed again", self.path.display()));
            return None;
        };
        // the files used last stay longest; where the system refuses, the order is that of their making
        let _ = File::options().append(true).open(&self.path).and_then(|file| file.set_modified(SystemTime::now()));
        watch.reuse(format!(
            "condensed housing: from {}, condensed {} UTC, {:.0} s saved",
            self.path.display(),
            date(head.condensed_at),
            head.seconds
        ));
        Some(found)
    }

    /// Keeps a housing that took so long to condense.
    pub(super) fn write(&self, housing: &OnRings, took: Duration, watch: &impl Watch) {
        let Some(element) = &housing.element else {
            return;
        };
        let bytes = written(housing, element, &self.key, took);
        let kept = write_atomic(&self.path, |file| file.write_all(&bytes)).map_err(|error| error.to_string());
        let kept = kept.and_then(|()| trim(&self.path, MOST_BYTES).map_err(|error| error.to_string()));
        if let Err(error) = kept {
            watch.reuse(format!("condensed housing: not kept: {error}"));
        }
    }
}

/// A file locked by this process, whose number stands in it.
fn locked(path: &Path, watch: &impl Watch) -> io::Result<File> {
    no_link(path)?;
    let mut file = File::options().write(true).create(true).truncate(false).open(path)?;
    let began = Instant::now();
    let mut holder = None;
    loop {
        match file.try_lock() {
            Ok(()) => break,
            Err(TryLockError::Error(error)) => return Err(error),
            Err(TryLockError::WouldBlock) => {}
        }
        let wait = LONGEST_WAIT.as_secs();
        let holder = holder.get_or_insert_with(|| {
            let number = fs::read_to_string(path).unwrap_or_default();
            watch.stage("wait for another run to condense the housing");
            format!("process {} holds {}", number.trim(), path.display())
        });
        if began.elapsed() >= LONGEST_WAIT {
            return Err(io::Error::other(format!("{holder} for more than {wait} s, end it if it is stopped")));
        }
        thread::sleep(Duration::from_millis(100));
    }
    file.set_len(0)?;
    write!(file, "{}", std::process::id())?;
    Ok(file)
}

/// Digest of all that a condensed housing follows from.
fn key(matrices: &SystemMatrices, boundary: &Boundary, choice: BasisChoice, places: &[Place]) -> io::Result<String> {
    let mut sum = Sha256::new_with_prefix(MAGIC);
    sum.update(FileDigest::of_file(&Program::this()?.code)?.sha256);
    sparse(&mut sum, &matrices.stiffness);
    sparse(&mut sum, &matrices.mass);
    dense(&mut sum, &matrices.weight);
    let partition = boundary.partition();
    whole(&mut sum, &partition.driven);
    whole(&mut sum, &partition.interior);
    sparse(&mut sum, &partition.tie);
    whole(&mut sum, &partition.mean.coordinates);
    sparse(&mut sum, &partition.mean.weights);
    if let Some(attached) = boundary.attached() {
        dense(&mut sum, attached.stiffness);
        dense(&mut sum, attached.mass);
    }
    // Rust's shortest form of a number tells every one from every other
    sum.update(format!("{choice:?}{places:?}"));
    Ok(hex(sum))
}

fn whole(sum: &mut Sha256, values: &[usize]) {
    sum.update((values.len() as u64).to_le_bytes());
    values.iter().for_each(|&value| sum.update((value as u64).to_le_bytes()));
}

fn real(sum: &mut Sha256, values: &[f64]) {
    sum.update((values.len() as u64).to_le_bytes());
    values.iter().for_each(|value| sum.update(value.to_le_bytes()));
}

fn dense(sum: &mut Sha256, matrix: &DenseMatrix) {
    whole(sum, &[matrix.nrows(), matrix.ncols()]);
    (0..matrix.ncols()).for_each(|column| real(sum, matrix.col_as_slice(column)));
}

fn sparse(sum: &mut Sha256, matrix: &SparseMatrix) {
    whole(sum, &[matrix.rows(), matrix.cols(), usize::from(matrix.is_csc())]);
    whole(sum, matrix.indptr().to_proper().as_ref());
    whole(sum, matrix.indices());
    real(sum, matrix.data());
}

fn bytes_of(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

fn written(housing: &OnRings, element: &Superelement, key: &str, took: Duration) -> Vec<u8> {
    let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    let head = Head {
        key: key.to_owned(),
        condensed_at: now.as_secs(),
        seconds: took.as_secs_f64(),
        interface_dof: element.interface_dof,
        order: element.order(),
        sensors: housing.sensors.len(),
    };
    let mut bytes = MAGIC.to_vec();
    bytes.extend(serde_json::to_vec(&head).unwrap_or_default());
    bytes.push(b'\n');
    for matrix in [&element.stiffness, &element.mass, &element.weight] {
        (0..matrix.ncols()).for_each(|column| bytes.extend(bytes_of(matrix.col_as_slice(column))));
    }
    housing.sensors.iter().for_each(|row| bytes.extend(bytes_of(row)));
    bytes.extend(housing.complete_hz.to_le_bytes());
    let digest = Sha256::digest(&bytes);
    bytes.extend_from_slice(&digest);
    bytes
}

/// What a file holds; `None` if it is damaged, or another one's.
fn parsed(bytes: &[u8], key: &str) -> Option<(Head, OnRings)> {
    let (content, digest) = bytes.split_at_checked(bytes.len().checked_sub(DIGEST)?)?;
    let rest = content.strip_prefix(MAGIC)?;
    if Sha256::digest(content)[..] != *digest {
        return None;
    }
    let (head, numbers) = rest.split_at_checked(rest.iter().position(|&byte| byte == b'\n')?)?;
    let head: Head = serde_json::from_slice(head).ok()?;
    let (numbers, []) = numbers.get(1..)?.as_chunks() else {
        return None;
    };
    let numbers: Vec<f64> = numbers.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
    let order = head.order;
    let count = order.checked_mul(order.checked_mul(2)?.checked_add(2)?.checked_add(head.sensors)?)?;
    if head.key != key || head.interface_dof > order || numbers.len() != count.checked_add(1)? {
        return None;
    }
    let mut rest = numbers.as_slice();
    let mut take = |count: usize| {
        let (taken, after) = rest.split_at(count);
        rest = after;
        taken
    };
    let mut matrix = |columns: usize| {
        let taken = take(order * columns);
        DenseMatrix::from_fn(order, columns, |row, column| taken[column * order + row])
    };
    let [stiffness, mass, weight] = [order, order, 2].map(&mut matrix);
    let sensors = (0..head.sensors).map(|_| take(order).to_vec()).collect();
    let element = Superelement { stiffness, mass, weight, structural: None, interface_dof: head.interface_dof };
    Some((head, OnRings { element: Some(element), sensors, complete_hz: take(1)[0] }))
}

/// Removes the files used longest ago until the others have so many bytes at most; the one just written stays.
fn trim(written: &Path, most: u64) -> io::Result<()> {
    let folder = written.parent().unwrap_or(Path::new(""));
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let known = fs::symlink_metadata(&path).ok().filter(|known| known.is_file());
        if let Some(known) = known.filter(|_| path.extension() == Some(OsStr::new(EXTENSION)) && path != written) {
            files.push((known.modified()?, known.len(), path));
        }
    }
    files.sort_unstable();
    let own = fs::metadata(written)?.len();
    let mut total = files.iter().fold(own, |total, (_, bytes, _)| total + bytes);
    for (_, bytes, path) in files {
        if total <= most {
            break;
        }
        fs::remove_file(&path)?;
        total -= bytes;
    }
    Ok(())
}

/// A time as `2026-11-26 20:31`, from seconds since 1970. Source: H. Hinnant, chrono-compatible low-level date algorithms, `civil_from_days`.
fn date(seconds: u64) -> String {
    let (days, minutes) = (seconds / 86_400 + 719_468, seconds % 86_400 / 60);
    let (era, day_of_era) = (days / 146_097, days % 146_097);
    let year = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year + year / 4 - year / 100);
    let month = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month + 2) / 5 + 1;
    let month = if month < 10 { month + 3 } else { month - 9 };
    let year = year + era * 400 + u64::from(month <= 2);
    format!("{year:04}-{month:02}-{day:02} {:02}:{:02}", minutes / 60, minutes % 60)
}

#[cfg(test)]
#[path = "kept_tests.rs"]
mod tests;
