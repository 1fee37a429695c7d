//! What tests of the program from outside have in common: folders of their own, and the program run in them.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// An empty folder of a test's own.
pub fn scratch(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// The program with these arguments in a folder, to its end.
pub fn plummer(folder: &Path, words: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_plummer")).current_dir(folder).args(words).output().unwrap()
}

/// What it wrote to standard error behind the lines of its progress: from the first error or warning on.
pub fn errors(output: &Output) -> String {
    let text = String::from_utf8(output.stderr.clone()).unwrap();
    let mut lines =
        text.split_inclusive('\n').skip_while(|line| !line.starts_with("error") && !line.starts_with("warning"));
    let first = lines.next().unwrap_or_default().to_owned();
    lines.fold(first, |all, line| all + line)
}
