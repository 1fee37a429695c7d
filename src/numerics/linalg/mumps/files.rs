//! Folders for factors out of core, removed when the factor is dropped, and when the program is interrupted. Those of a process that was
//! killed are removed by the next one that makes one.

use super::super::LinalgError;
use super::ffi::LONGEST_PATH;
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::{DirBuilderExt, MetadataExt};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Those that are there.
static FOLDERS: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// MUMPS's own variable.
const ROOT: &str = "MUMPS_OOC_TMPDIR";

/// How their names begin; the process's number and one of its own follow.
const NAME: &str = "plummer-factor-";

/// File in each that says which machine the process's number is of.
pub(super) const MACHINE: &str = "machine";

/// Where they are made: MUMPS's own variable says it, or the system's.
pub(super) fn root() -> PathBuf {
    std::env::var_os(ROOT).filter(|name| !name.is_empty()).map_or_else(std::env::temp_dir, PathBuf::from)
}

/// Checks that a folder can be made where they are made.
///
/// # Errors
/// [`LinalgError::Refused`].
pub(in crate::numerics::linalg) fn check_root() -> Result<(), LinalgError> {
    let root = root();
    let refused = |why: &str| {
        let set = std::env::var_os(ROOT).is_some_and(|name| !name.is_empty());
        let what = if set {
            format!("the variable {ROOT} is")
        } else {
            format!("the variable {ROOT} is not set, and the default")
        };
        LinalgError::Refused(format!(
            "{what} \"{}\": {why}; expected a folder that can be written; set {ROOT} to one",
            root.display()
        ))
    };
    match fs::metadata(&root) {
        Err(error) => Err(refused(&error.to_string())),
        Ok(found) if !found.is_dir() => Err(refused("it is no folder")),
        Ok(_) => Folder::made().map(drop).map_err(|why| refused(&why)),
    }
}

/// A folder of its own for one factor.
#[derive(Debug)]
pub(super) struct Folder {
    path: PathBuf,
    /// The factor's files in it, and their lengths.
    files: Vec<(PathBuf, u64)>,
}

impl Folder {
    /// Makes one that no other user can read.
    ///
    /// # Errors
    /// [`LinalgError::Refused`] if it cannot be made, or its path is too long for MUMPS.
    pub(super) fn new() -> Result<Self, LinalgError> {
        remove_abandoned(&root());
        Self::made().map_err(|why| {
            let root = root();
            let root = root.display();
            LinalgError::Refused(format!(
                "no folder for a factor out of core can be made in {root}: {why}; set {ROOT} to a folder that can be written"
            ))
        })
    }

    fn made() -> Result<Self, String> {
        static MADE: AtomicUsize = AtomicUsize::new(0);
        let number = MADE.fetch_add(1, Ordering::Relaxed);
        let path = root().join(format!("{NAME}{}-{number}", std::process::id()));
        if path.as_os_str().len() > LONGEST_PATH {
            return Err(format!("the name {} is longer than {LONGEST_PATH} bytes", path.display()));
        }
        fs::DirBuilder::new().mode(0o700).create(&path).map_err(|error| error.to_string())?;
        FOLDERS.lock().unwrap_or_else(PoisonError::into_inner).push(path.clone());
        let folder = Self { path, files: Vec::new() };
        fs::write(folder.path.join(MACHINE), machine()).map_err(|error| error.to_string())?;
        Ok(folder)
    }

    /// Its path.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Its path.
    pub(super) fn bytes(&self) -> &[u8] {
        self.path.as_os_str().as_bytes()
    }

    /// Notes the files, which are all written.
    pub(super) fn written(&mut self) {
        let entries = fs::read_dir(&self.path).into_iter().flatten().flatten();
        self.files = entries.filter_map(|entry| Some((entry.path(), entry.metadata().ok()?.len()))).collect();
    }

    /// Whether the files that were written are there, with their lengths.
    pub(super) fn is_whole(&self) -> bool {
        let whole = |(path, length): &(PathBuf, u64)| fs::metadata(path).is_ok_and(|found| found.len() == *length);
        self.path.is_dir() && self.files.iter().all(whole)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        FOLDERS.lock().unwrap_or_else(PoisonError::into_inner).retain(|path| *path != self.path);
        let _ = fs::remove_dir_all(&self.path);
    }
}

/// Removes all of them.
pub(super) fn remove_all() {
    for path in FOLDERS.lock().unwrap_or_else(PoisonError::into_inner).drain(..) {
        let _ = fs::remove_dir_all(path);
    }
}

/// What the numbers of processes belong to: a start of a machine, and one of its spaces of such numbers, as of a container.
fn machine() -> Vec<u8> {
    let start = fs::read("/proc/sys/kernel/random/boot_id").unwrap_or_default();
    let space = fs::read_link("/proc/self/ns/pid").unwrap_or_default();
    [start, space.into_os_string().into_encoded_bytes()].concat()
}

/// The process's number in the name of such a folder.
fn process(name: &str) -> Option<u32> {
    let (process, number) = name.strip_prefix(NAME)?.split_once('-')?;
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    if digits(number) && digits(process) { process.parse().ok() } else { None }
}

/// Removes folders of this user in `root` whose process has ended, as by a kill. Those of other machines that share the disk stay.
fn remove_abandoned(root: &Path) {
    let Ok(user) = fs::metadata("/proc/self").map(|own| own.uid()) else { return };
    for entry in fs::read_dir(root).into_iter().flatten().flatten() {
        let Some(process) = entry.file_name().to_str().and_then(process) else { continue };
        // of a link it is that of the link itself
        let is_own = entry.metadata().is_ok_and(|found| found.is_dir() && found.uid() == user);
        let is_elsewhere = fs::read(entry.path().join(MACHINE)).is_ok_and(|found| found != machine());
        if is_own && !is_elsewhere && !Path::new("/proc").join(process.to_string()).exists() {
            let _ = fs::remove_dir_all(entry.path());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_of_processes_that_ended_are_removed_and_no_others() {
        let root = tempfile::tempdir().unwrap();
        let mut ended = std::process::Command::new("true").spawn().unwrap();
        ended.wait().unwrap();
        let [ended, own] = [ended.id(), std::process::id()];
        let folder = |name: &str, machine: Option<&[u8]>| {
            let path = root.path().join(name);
            fs::create_dir(&path).unwrap();
            fs::write(path.join("factor"), "1").unwrap();
            if let Some(machine) = machine {
                fs::write(path.join(MACHINE), machine).unwrap();
            }
        };
        let name = |process: u32, number: &str| format!("plummer-factor-{process}-{number}");
        folder(&name(ended, "0"), None);
        folder(&name(ended, "12"), Some(&machine()));
        let kept = [
            name(own, "0"),
            name(ended, "1"),
            name(ended, ""),
            name(ended, "0-old"),
            name(ended, "+1"),
            format!("{}x", name(ended, "0")),
            format!("my-{}", name(ended, "0")),
            "plummer-factor--0".to_owned(),
        ];
        for kept in &kept {
            folder(kept, kept.ends_with("-1").then_some(b"another"));
        }
        // neither a file nor a link
        fs::write(root.path().join(name(ended, "7")), "a file").unwrap();
        let elsewhere = tempfile::tempdir().unwrap();
        std::os::unix::fs::symlink(elsewhere.path(), root.path().join(name(ended, "8"))).unwrap();
        remove_abandoned(root.path());
        let left = |name: &str| fs::symlink_metadata(root.path().join(name)).is_ok();
        assert!(!left(&name(ended, "0")) && !left(&name(ended, "12")));
        for kept in kept.iter().chain(&[name(ended, "7"), name(ended, "8")]) {
            assert!(left(kept), "{kept}");
        }
        assert!(elsewhere.path().exists());
    }
}
