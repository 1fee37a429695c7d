//! Files of the crate as the checker reads them: numbered lines of code, without comments and tests.

use std::fs;
use std::path::{Path, PathBuf};

/// One file.
pub struct Source {
    /// Path below `src`, with `/`.
    pub path: String,
    /// Numbered lines of code.
    pub code: Vec<(usize, String)>,
    /// First sentence of the file's own documentation.
    pub says: String,
}

impl Source {
    /// A file by its path below `src` and its text; a file of tests has no code.
    pub fn new(path: &str, text: &str) -> Self {
        let code = if is_test_file(path) { Vec::new() } else { code_lines(text) };
        Self { path: path.to_owned(), code, says: first_sentence(text) }
    }
}

/// All files of a folder but `lib.rs` and `main.rs`, in the order of their paths.
pub fn read_all(src: &Path) -> Vec<Source> {
    let mut files = Vec::new();
    rust_files(src, &mut files);
    files.sort();
    let read = |file: PathBuf| {
        let below = file.strip_prefix(src).unwrap();
        let names: Vec<_> = below.iter().map(|name| name.to_str().unwrap()).collect();
        Source::new(&names.join("/"), &fs::read_to_string(&file).unwrap())
    };
    let sources = files.into_iter().map(read);
    sources.filter(|source| source.path.contains('/')).collect()
}

fn rust_files(folder: &Path, into: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, into);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            into.push(path);
        }
    }
}

fn is_test_file(path: &str) -> bool {
    let mut names = path.rsplit('/');
    let name = names.next().unwrap_or(path);
    name == "tests.rs"
        || name.ends_with("_tests.rs")
        || name.starts_with("tests_")
        || names.any(|folder| folder == "tests")
}

/// What the first lines of `//!` say, to the first full stop.
fn first_sentence(text: &str) -> String {
    let lines = text.lines().map_while(|line| line.strip_prefix("//!"));
    let lines: Vec<&str> = lines.map(str::trim).take_while(|line| !line.is_empty()).collect();
    let whole = lines.join(" ").replace(['`', '[', ']'], "");
    let end = whole.find(". ").unwrap_or(whole.len());
    whole[..end].trim_end_matches('.').to_owned()
}

/// Numbered lines without comments and without modules under `#[cfg(test)]`. Formatted source is assumed: such a module ends at the
/// brace with its own indentation.
fn code_lines(text: &str) -> Vec<(usize, String)> {
    let mut lines = Vec::new();
    let mut test_next = false;
    let mut closing: Option<String> = None;
    for (index, line) in text.lines().enumerate() {
        if let Some(end) = &closing {
            if line == end {
                closing = None;
            }
            continue;
        }
        let code = without_comment(line);
        let word = code.trim();
        if word.starts_with("#[cfg(test)]") {
            test_next = true;
            continue;
        }
        if test_next && !word.is_empty() && !word.starts_with("#[") {
            test_next = false;
            if word.ends_with('{') {
                let indent = line.len() - line.trim_start().len();
                closing = Some(format!("{}}}", " ".repeat(indent)));
            }
            continue;
        }
        if !word.is_empty() {
            lines.push((index + 1, code.to_owned()));
        }
    }
    lines
}

/// Cuts at `//` unless it stands in a string on that line.
fn without_comment(line: &str) -> &str {
    let bytes = line.as_bytes();
    let (mut inside, mut place) = (false, 0);
    while place < bytes.len() {
        match bytes[place] {
            b'\\' if inside => place += 1,
            // a character literal with a quotation mark in it opens nothing
            b'"' if !line[..place].ends_with('\'') => inside = !inside,
            b'/' if !inside && bytes.get(place + 1) == Some(&b'/') => return &line[..place],
            _ => {}
        }
        place += 1;
    }
    line
}

/// Whether `word` stands in `text` by itself, outside strings.
pub fn has_word(text: &str, word: &str) -> bool {
    let outside: String = text.split('"').step_by(2).collect::<Vec<_>>().join(" ");
    outside.split(|c: char| !(c.is_alphanumeric() || c == '_')).any(|found| found == word)
}
