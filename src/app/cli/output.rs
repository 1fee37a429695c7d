//! Where results go: what a command hands back, a folder that is not overwritten by accident and that one process at
//! a time writes into, files that are whole or not there.

use super::earlier_results::{refuse_foreign, with_names_of};
use super::{CliError, Options};
use crate::app::case::Case;
use crate::app::shell_word::printable;
use crate::files;
use crate::numerics::linalg::launched;
use serde::Serialize;
use serde_json::Value;
use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Writes a line. A closed pipe (`plummer ... | head`) counts as success.
///
/// # Errors
/// As [`printed`].
pub(crate) fn emit(to: &mut impl Write, line: &str) -> Result<(), CliError> {
    printed(writeln!(to, "{}", printable(line)).and_then(|()| to.flush()))
}

/// What a writing to standard output comes to: a closed pipe is no error.
///
/// # Errors
/// [`CliError`] when it failed for another reason.
pub(super) fn printed(written: io::Result<()>) -> Result<(), CliError> {
    match written {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(CliError::failed(format!("cannot write to standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Writes a file under a temporary name beside it and renames it: a half-written file never carries its name.
///
/// # Errors
/// [`CliError`] when writing or renaming fails; the temporary file is then removed and an earlier file of this
/// name is as it was.
pub(crate) fn write_atomic(path: &Path, bytes: &[u8]) -> Result<(), CliError> {
    Ok(files::write_atomic(path, |file| file.write_all(bytes))?)
}

/// Appends what is not there yet.
pub(super) fn extend_new<T: PartialEq>(list: &mut Vec<T>, more: impl IntoIterator<Item = T>) {
    for item in more {
        if !list.contains(&item) {
            list.push(item);
        }
    }
}

/// A result as JSON.
///
/// # Errors
/// [`CliError`] for what JSON cannot hold: names of files that are not UTF-8.
pub(super) fn json(result: &impl Serialize) -> Result<Value, CliError> {
    serde_json::to_value(result).map_err(|error| CliError::failed(format!("cannot write to standard output: {error}")))
}

/// The folder for the results of one case. Several commands may share it: each has its own `COMMAND.json`, which is to
/// be written last, after the files that it speaks of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutputFolder {
    /// Where it is.
    pub(crate) path: PathBuf,
}

impl OutputFolder {
    /// Returns the folder of a case: `--out`, else `out/` and the case's name. Makes nothing yet.
    #[must_use]
    pub(crate) fn of(case: &Case, options: &Options) -> Self {
        Self { path: options.out.clone().unwrap_or_else(|| Path::new("out").join(case.name())) }
    }

    /// Returns the folder of this path.
    #[must_use]
    pub(crate) fn at(path: &Path) -> Self {
        Self { path: path.to_owned() }
    }

    /// Makes the folder, takes it for this process and checks that no earlier result of the command would be replaced without `force`.
    ///
    /// # Errors
    /// [`CliError`]: a folder that cannot be made or that another process has, a result or a file of another program that is there.
    pub(crate) fn claim(&self, command: &str, force: bool) -> Result<(), CliError> {
        self.claim_unless(&[format!("{command}.json")], force, |_| Some(""))
    }

    /// Makes the folder, takes it for this process and checks that no earlier result would be lost without `force`:
    /// `lost` says of a file that is there what it is the result of, behind "an earlier run"; `None`: of what is computed now.
    /// Files of another program that have the names of these results are refused too.
    ///
    /// # Errors
    /// As [`claim`](Self::claim).
    pub(super) fn claim_unless<N: AsRef<Path>>(
        &self,
        names: &[N],
        force: bool,
        lost: impl Fn(&Path) -> Option<&'static str>,
    ) -> Result<(), CliError> {
        fs::create_dir_all(&self.path).map_err(|error| CliError::folder(&self.path, &error))?;
        self.lock()?;
        let paths = names.iter().map(|name| self.path.join(name));
        let mut lost = paths.filter(|path| !force && path.exists()).filter_map(|path| lost(&path).map(|of| (path, of)));
        if let Some((path, of)) = lost.next() {
            return Err(CliError::input(format!("{} is the result of an earlier run{of}", path.display()))
                .with_help("replace it with --force, or choose another folder with --out"));
        }
        if force {
            return Ok(());
        }
        let words = names.iter().filter_map(|name| name.as_ref().to_str()?.strip_suffix(".json"));
        refuse_foreign(&self.path, words.flat_map(|word| with_names_of(&self.path, word)).collect())
    }

    /// Takes the folder, if it is there, for this process until it ends: no other one may write into it meanwhile.
    ///
    /// # Errors
    /// [`CliError`] when another process has it, or it cannot be opened.
    pub(crate) fn lock(&self) -> Result<(), CliError> {
        match take(&self.path) {
            Ok(true) => Ok(()),
            Ok(false) => Err(CliError::input(format!("another plummer writes into {}", self.path.display()))
                .with_help(match cfg!(not(feature = "mumps-mpi")) && launched() {
                    true => "processes that MPI starts compute together if plummer is built with --features mumps-mpi (docs/how-to/large-meshes.md); this one is not",
                    false => "wait for its end, or choose another folder with --out",
                })),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
            Err(error) => Err(CliError::folder(&self.path, &error)),
        }
    }

    /// Writes a result as JSON; gives its path, and what it says.
    ///
    /// # Errors
    /// [`CliError`] when it cannot be written, and as [`json`].
    pub(super) fn write_json(&self, name: &str, result: &impl Serialize) -> Result<(PathBuf, Value), CliError> {
        let json = json(result)?;
        let path = self.write(name, format!("{json:#}\n").as_bytes())?;
        Ok((path, json))
    }

    /// Makes a folder below this one; none between may be a symbolic link.
    ///
    /// # Errors
    /// [`CliError`] when it cannot be made.
    pub(crate) fn make_below(&self, name: &Path) -> Result<PathBuf, CliError> {
        files::make_below(&self.path, name).map_err(|error| CliError::folder(&self.path.join(name), &error))
    }

    /// Writes a file of this name into the folder, whole or not at all, and returns its path.
    ///
    /// # Errors
    /// [`CliError`] when it cannot be written.
    pub(crate) fn write(&self, name: &str, bytes: &[u8]) -> Result<PathBuf, CliError> {
        let path = self.path.join(name);
        write_atomic(&path, bytes)?;
        Ok(path)
    }
}

/// The folders that this process holds: a lock ends with the process, however it ends.
static HELD: Mutex<Vec<(PathBuf, File)>> = Mutex::new(Vec::new());

/// Takes a folder for this process until it ends, by `flock` on the folder itself. Returns whether no other process has it.
///
/// A file system that knows no locks gives none: the folder is then taken without.
///
/// # Errors
/// What the system says when the folder cannot be opened.
pub(super) fn take(folder: &Path) -> io::Result<bool> {
    let path = folder.canonicalize()?;
    let mut held = HELD.lock().unwrap_or_else(PoisonError::into_inner);
    if held.iter().any(|(other, _)| *other == path) {
        return Ok(true);
    }
    let file = File::open(&path)?;
    match file.try_lock() {
        Ok(()) => {
            held.push((path, file));
            Ok(true)
        }
        Err(TryLockError::WouldBlock) => Ok(false),
        Err(TryLockError::Error(_)) => Ok(true),
    }
}

/// Whether another process has a folder now.
pub(super) fn is_taken(folder: &Path) -> bool {
    let Ok(file) = File::open(folder) else {
        return false;
    };
    // the lock ends with the file
    matches!(file.try_lock(), Err(TryLockError::WouldBlock))
}

/// What a command computed.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// A few lines for a reader, without a line end after the last.
    pub summary: String,
    /// The content of the command's result file.
    pub result: serde_json::Value,
    /// The files that were written, the most useful last.
    pub written: Vec<PathBuf>,
    /// What is bad about the answer, or wrong in some of the input; results are written all the same.
    pub verdict: Result<(), CliError>,
}

impl Outcome {
    /// Writes the result: as JSON if asked for, else summary and files, else (quiet) nothing.
    ///
    /// # Errors
    /// [`CliError`] when `to` cannot be written; a closed pipe is none.
    pub(crate) fn show(&self, options: &Options, to: &mut impl Write) -> Result<(), CliError> {
        if options.json {
            return emit(to, &format!("{:#}", self.result));
        }
        if options.quiet {
            return Ok(());
        }
        emit(to, &self.summary)?;
        for path in &self.written {
            emit(to, &format!("wrote {}", path.display()))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::io::{self, Write};
    use std::path::{Path, PathBuf};

    use super::{CliError, Options, OutputFolder, emit, write_atomic};
    use crate::app::case::{Case, Source};

    struct Broken(io::ErrorKind);

    impl Write for Broken {
        fn write(&mut self, _bytes: &[u8]) -> io::Result<usize> {
            Err(self.0.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    /// An empty folder of this test's own.
    fn folder(name: &str) -> PathBuf {
        let path = std::env::temp_dir().join(format!("plummer-{}-{name}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        path
    }

    fn names(path: &Path) -> Vec<String> {
        let name = |entry: io::Result<fs::DirEntry>| entry.unwrap().file_name();
        let mut names: Vec<String> =
            fs::read_dir(path).unwrap().map(|entry| name(entry).into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_name_does_not_steer_the_terminal() {
        let mut written = Vec::new();
        emit(&mut written, "a\tb\n\u{1b}[2Jc\r\u{9b}d é").unwrap();
        let text = String::from_utf8(written).unwrap();
        assert_eq!(text, "a\tb\n\u{fffd}[2Jc\u{fffd}\u{fffd}d é\n");
    }

    #[test]
    fn a_closed_pipe_is_success_and_a_full_disk_is_not() {
        emit(&mut Broken(io::ErrorKind::BrokenPipe), "line").unwrap();
        let error = emit(&mut Broken(io::ErrorKind::StorageFull), "line").unwrap_err();
        assert_eq!(error.exit_code(), 1);
        assert_eq!(error.to_string(), "cannot write to standard output: no storage space");
    }

    #[test]
    fn a_file_is_replaced_whole_and_nothing_is_left_beside() {
        let folder = folder("whole");
        let path = folder.join("run.json");
        write_atomic(&path, b"first").unwrap();
        write_atomic(&path, b"second").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        assert_eq!(names(&folder), ["run.json"]);
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_failed_write_leaves_nothing_behind() {
        let folder = folder("failed");
        // A folder of that name cannot be replaced by a file.
        let path = folder.join("run.json");
        fs::create_dir_all(path.join("inside")).unwrap();
        let error = write_atomic(&path, b"text").unwrap_err();
        assert_eq!(error.exit_code(), 1);
        assert!(error.to_string().starts_with(&format!("cannot write {}: ", path.display())), "{error}");
        assert_eq!(names(&folder), ["run.json"]);
        assert!(write_atomic(&folder.join("no/such/run.json"), b"text").is_err());
        assert!(write_atomic(Path::new("/"), b"text").is_err());
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_result_is_replaced_only_by_force() {
        let path = folder("force");
        let options = Options { out: Some(path.join("new")), ..Options::default() };
        let case = Case::from_source(Source {
            path: PathBuf::from("folder/case.v2.toml"),
            text: include_str!("../case/full.toml").to_owned(),
            set: Vec::new(),
        })
        .unwrap();
        let folder = OutputFolder::of(&case, &options);
        folder.claim("run", false).unwrap();
        let written = folder.write("run.json", b"{}").unwrap();
        assert_eq!(written, path.join("new/run.json"));
        let error = folder.claim("run", false).unwrap_err();
        let expected = CliError::input(format!("{} is the result of an earlier run", written.display()))
            .with_help("replace it with --force, or choose another folder with --out");
        assert_eq!(error, expected);
        folder.claim("modes", false).unwrap();
        folder.claim("run", true).unwrap();
        let default = OutputFolder::of(&case, &Options::default());
        assert_eq!(default.path, Path::new("out/case.v2"));
        let blocked = OutputFolder { path: written.join("below a file") };
        let error = blocked.claim("run", false).unwrap_err();
        assert_eq!(error.exit_code(), 2);
        assert!(error.to_string().starts_with("cannot make the folder "), "{error}");
        fs::remove_dir_all(path).unwrap();
    }
}

#[cfg(test)]
mod lock_tests {
    use std::fs::File;

    use super::{is_taken, take};

    #[test]
    fn a_folder_is_taken_once_until_its_lock_ends() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path();
        assert!(!is_taken(path));
        // as another process would
        let other = File::open(path).unwrap();
        other.lock().unwrap();
        assert!(is_taken(path));
        assert!(!take(path).unwrap());
        drop(other);
        assert!(take(path).unwrap());
        assert!(is_taken(path));
        // what this process has it may take again, by any name
        assert!(take(&path.join(".")).unwrap());
        assert!(take(&path.join("nothing")).is_err());
    }
}

#[cfg(test)]
mod outcome_tests {
    use std::path::PathBuf;

    use super::{Options, Outcome};

    fn shown(options: &Options) -> String {
        let outcome = Outcome {
            summary: "8.2 kHz\n11.3 kHz".to_owned(),
            result: serde_json::json!({ "command": "modes" }),
            written: vec![PathBuf::from("out/a/modes.json")],
            verdict: Ok(()),
        };
        let mut written = Vec::new();
        outcome.show(options, &mut written).unwrap();
        String::from_utf8(written).unwrap()
    }

    #[test]
    fn summary_json_or_nothing() {
        let plain = Options::default();
        assert_eq!(shown(&plain), "8.2 kHz\n11.3 kHz\nwrote out/a/modes.json\n");
        let json = Options { json: true, quiet: true, ..Options::default() };
        assert_eq!(shown(&json), "{\n  \"command\": \"modes\"\n}\n");
        let quiet = Options { quiet: true, ..Options::default() };
        assert_eq!(shown(&quiet), "");
    }
}
