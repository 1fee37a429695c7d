//! Modules import only from the rows above their own, and `unsafe` stays in the files of foreign libraries.
//!
//! Reference: the table of layers below, the program's architecture.
//! Goal: an import against the flow from mesh to report fails here, with file and line.
//! Sketch: every `crate::` path in `src` (and `super::` chains that climb out of their module) is an edge
//!   from the module of the file to the module named.
//! Conditions: test code is exempt: files `tests.rs` and `*_tests.rs`, and `mod ... { }` under
//!   `#[cfg(test)]`; so are comments, `lib.rs` and `main.rs`.
//! Parameters: none; there is no tolerance.

mod picture;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// What a module may import.
#[derive(Debug, Clone, Copy)]
enum Imports {
    /// Any row above its own.
    RowsAbove,
    /// These and row 0.
    Only(&'static [&'static str]),
}

use Imports::{Only, RowsAbove};

/// Row, module, what it may import. The case file is read, then run, then shown: three rows; the built-in checks and the chart run
/// cases too.
const LAYERS: &[(u32, &str, Imports)] = &[
    (0, "units", RowsAbove),
    (0, "lanes", RowsAbove),
    (0, "files", RowsAbove),
    (0, "shell_word", RowsAbove),
    (1, "linalg", RowsAbove),
    (1, "closed_form", Only(&[])),
    (1, "series", Only(&[])),
    (1, "dynamics", RowsAbove),
    (2, "mesh", Only(&[])),
    (2, "material", Only(&[])),
    (2, "catalogue", Only(&[])),
    (3, "element", RowsAbove),
    (4, "model", RowsAbove),
    (5, "assembly", RowsAbove),
    (6, "modal", RowsAbove),
    (7, "reduction", RowsAbove),
    (7, "bearing", Only(&["closed_form"])),
    (8, "system", RowsAbove),
    (8, "transient", Only(&["dynamics", "linalg", "series"])),
    (9, "signal", Only(&["series"])),
    (10, "diagnosis", Only(&["closed_form", "series", "signal"])),
    (10, "exchange", RowsAbove),
    (10, "report", RowsAbove),
    (11, "case", RowsAbove),
    (12, "stages", RowsAbove),
    (13, "verification", RowsAbove),
    (13, "chart", RowsAbove),
    (13, "sweep", RowsAbove),
    (14, "cli", RowsAbove),
];

/// The files with `unsafe` in them: a foreign library each.
const UNSAFE_FILES: [&str; 2] = ["linalg/arpack.rs", "linalg/metis.rs"];

/// Source of one file: its path below `src`, with `/`, and its text.
struct Source<'a> {
    path: &'a str,
    text: &'a str,
}

fn layer(module: &str) -> Option<(u32, Imports)> {
    let found = LAYERS.iter().find(|(_, name, _)| *name == module);
    found.map(|&(row, _, imports)| (row, imports))
}

fn allowed(importer: &str, imported: &str) -> Result<(), String> {
    if importer == imported {
        return Ok(());
    }
    let no_row = |module: &str| format!("`{module}` has no row in the table of layers");
    let (row, imports) = layer(importer).ok_or_else(|| no_row(importer))?;
    let (above, _) = layer(imported).ok_or_else(|| no_row(imported))?;
    match imports {
        _ if above >= row => Err(format!(
            "`{importer}` (row {row}) imports `{imported}` (row {above}): only rows above its own"
        )),
        Only(names) if above > 0 && !names.contains(&imported) => Err(format!(
            "`{importer}` imports `{imported}`: it may import {names:?} and row 0 alone"
        )),
        _ => Ok(()),
    }
}

/// All that is wrong in one file, as `path:line: what`.
fn violations(source: &Source) -> Vec<String> {
    if is_test_file(source.path) {
        return Vec::new();
    }
    let code = code_lines(source.text);
    let mut found = Vec::new();
    let mut report =
        |line: usize, what: String| found.push(format!("{}:{line}: {what}", source.path));
    for &(line, ref text) in &code {
        if !UNSAFE_FILES.contains(&source.path) && has_word(text, "unsafe") {
            report(
                line,
                format!("`unsafe` outside {}", UNSAFE_FILES.join(", ")),
            );
        }
    }
    if let Some(importer) = module_of(source.path) {
        for (line, imported) in imported_modules(source.path, &code) {
            if let Err(what) = allowed(importer, &imported) {
                report(line, what);
            }
        }
    }
    found
}

fn is_test_file(path: &str) -> bool {
    let name = path.rsplit('/').next().unwrap_or(path);
    name == "tests.rs" || name.ends_with("_tests.rs")
}

/// Module at the top of the crate that a file belongs to; none for `lib.rs` and `main.rs`.
fn module_of(path: &str) -> Option<&str> {
    if path == "lib.rs" || path == "main.rs" {
        return None;
    }
    let first = path.split('/').next()?;
    Some(first.strip_suffix(".rs").unwrap_or(first))
}

/// Numbered lines without comments and without modules under `#[cfg(test)]`. Formatted source is
/// assumed: such a module ends at the brace with its own indentation.
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
            let opens = word.starts_with("mod ") || word.starts_with("pub mod ");
            if opens && word.ends_with('{') {
                let indent = line.len() - line.trim_start().len();
                closing = Some(format!("{}}}", " ".repeat(indent)));
                continue;
            }
        }
        lines.push((index + 1, code.to_owned()));
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
fn has_word(text: &str, word: &str) -> bool {
    let outside: String = text.split('"').step_by(2).collect::<Vec<_>>().join(" ");
    outside
        .split(|c: char| !(c.is_alphanumeric() || c == '_'))
        .any(|found| found == word)
}

/// Modules at the top of the crate that the code names, with the line of the path's start.
fn imported_modules(path: &str, code: &[(usize, String)]) -> Vec<(usize, String)> {
    // one text, so that a list in braces may go over several lines
    let (mut text, mut starts) = (String::new(), Vec::new());
    for (line, part) in code {
        starts.push((text.len(), *line));
        text.push_str(part);
        text.push('\n');
    }
    let line_at = |place: usize| {
        let after = starts.partition_point(|&(start, _)| start <= place);
        starts[after - 1].1
    };
    let mut found = Vec::new();
    for (place, root) in roots(&text, path) {
        for name in first_names(&text[root..]) {
            found.push((line_at(place), name));
        }
    }
    found
}

/// Where a path from the crate's root starts, and where its first name does: after `crate::`, or after
/// as many `super::` as the file is deep.
fn roots(text: &str, path: &str) -> Vec<(usize, usize)> {
    let mut depth = path.split('/').count();
    if path.ends_with("/mod.rs") {
        depth -= 1;
    }
    let begins = |place: usize| {
        let before = text[..place].chars().next_back();
        // `$crate::` is `crate::` too
        !before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':')
    };
    let mut found: Vec<(usize, usize)> = text
        .match_indices("crate::")
        .filter(|&(place, _)| begins(place))
        .map(|(place, word)| (place, place + word.len()))
        .collect();
    let climb = "super::".repeat(depth);
    found.extend(
        text.match_indices(&climb)
            .filter(|&(place, _)| begins(place))
            .map(|(place, _)| (place, place + climb.len())),
    );
    found.sort_unstable();
    found
}

/// First names of a path or of every path in a list: `a::b` gives a, `{a, b::{c, d}}` gives a and b.
fn first_names(text: &str) -> Vec<String> {
    let Some(list) = text.strip_prefix('{') else {
        return first_name(text).into_iter().collect();
    };
    let (mut depth, mut start) = (1, 0);
    let mut names = Vec::new();
    for (place, c) in list.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 || (depth == 1 && c == ',') {
            names.extend(first_name(list[start..place].trim_start()));
            start = place + 1;
        }
        if depth == 0 {
            break;
        }
    }
    names
}

/// Leading identifier that is a module's name: what starts with a capital is an item at the root.
fn first_name(text: &str) -> Option<String> {
    let name: String = text
        .chars()
        .take_while(|c| c.is_alphanumeric() || *c == '_')
        .collect();
    let starts_small = name.chars().next().is_some_and(char::is_lowercase);
    starts_small.then_some(name)
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

#[test]
fn imports_go_up_and_unsafe_stays_where_it_is() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    rust_files(&src, &mut files);
    files.sort();
    // a checker that finds no files finds no faults
    assert!(files.len() > 50, "{} files", files.len());
    let (mut found, mut edges) = (Vec::new(), 0);
    for file in &files {
        let below = file.strip_prefix(&src).unwrap();
        let names: Vec<_> = below.iter().map(|name| name.to_str().unwrap()).collect();
        let (path, text) = (names.join("/"), fs::read_to_string(file).unwrap());
        edges += imported_modules(&path, &code_lines(&text)).len();
        found.extend(violations(&Source {
            path: &path,
            text: &text,
        }));
    }
    assert!(edges > 50, "{edges} imports");
    assert!(found.is_empty(), "{}", found.join("\n"));
    for file in UNSAFE_FILES {
        let text = fs::read_to_string(src.join(file)).unwrap();
        let lines = code_lines(&text);
        assert!(
            lines.iter().any(|(_, line)| has_word(line, "unsafe")),
            "{file}"
        );
    }
}

/// The picture is made again with `PLUMMER_WRITE=1 cargo test --test layering`.
#[test]
fn the_picture_is_that_of_the_code() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let src = root.join("src");
    let mut files = Vec::new();
    rust_files(&src, &mut files);
    files.sort();
    let (mut graph, mut lines) = (picture::Graph::new(), BTreeMap::new());
    for file in &files {
        let below = file.strip_prefix(&src).unwrap();
        let names: Vec<_> = below.iter().map(|name| name.to_str().unwrap()).collect();
        let path = names.join("/");
        let Some(module) = module_of(&path).filter(|_| !is_test_file(&path)) else {
            continue;
        };
        let code = code_lines(&fs::read_to_string(file).unwrap());
        *lines.entry(module.to_owned()).or_insert(0) += code.len();
        let imports = graph.entry(module.to_owned()).or_default();
        let others = imported_modules(&path, &code).into_iter();
        imports.extend(others.map(|(_, name)| name).filter(|name| name != module));
    }
    let rows: Vec<(u32, &str)> = LAYERS.iter().map(|&(row, name, _)| (row, name)).collect();
    let made = picture::svg(&rows, &graph, &lines);
    let file = root.join("docs/figures/architecture.svg");
    if std::env::var_os("PLUMMER_WRITE").is_some() {
        fs::write(&file, &made).unwrap();
    }
    let kept = fs::read_to_string(&file).unwrap_or_default();
    assert!(
        kept == made,
        "{} is not that of the code: PLUMMER_WRITE=1 cargo test --test layering",
        file.display()
    );
}

#[test]
fn the_checker_fires() {
    let cases = [
        (
            "mesh/mod.rs",
            "use crate::numerics::linalg::DenseMatrix;",
            "mesh/mod.rs:1: `mesh` imports `linalg`: it may import [] and row 0 alone",
        ),
        (
            "assembly/mod.rs",
            "//! Doc.\n\nuse crate::{\n    linalg::SparseMatrix,\n    system::Structure,\n};",
            "assembly/mod.rs:3: `assembly` (row 5) imports `system` (row 8): only rows above its own",
        ),
        (
            "transient/driver.rs",
            "fn f() {\n    let s = crate::system::Structure;\n}",
            "transient/driver.rs:2: `transient` (row 8) imports `system` (row 8): only rows above its own",
        ),
        (
            "transient/driver.rs",
            "use crate::fe::mesh::Mesh;",
            "transient/driver.rs:1: `transient` imports `mesh`: it may import [\"dynamics\", \"linalg\", \"series\"] and row 0 alone",
        ),
        (
            "bearing/dent/mod.rs",
            "use super::super::linalg::DenseMatrix;",
            "bearing/dent/mod.rs:1: `bearing` imports `linalg`: it may import [\"closed_form\"] and row 0 alone",
        ),
        (
            "signal/mod.rs",
            "use crate::system::RunRecord;",
            "signal/mod.rs:1: `signal` imports `system`: it may import [\"series\"] and row 0 alone",
        ),
        (
            "linalg/sparse.rs",
            "use crate::numerics::series::TimeSeries; // why not",
            "linalg/sparse.rs:1: `linalg` (row 1) imports `series` (row 1): only rows above its own",
        ),
        (
            "units.rs",
            "use crate::numerics::linalg::DenseMatrix;",
            "units.rs:1: `units` (row 0) imports `linalg` (row 1): only rows above its own",
        ),
        (
            "stages/mod.rs",
            "macro_rules! m { () => { $crate::app::cli::run() } }",
            "stages/mod.rs:1: `stages` (row 12) imports `cli` (row 14): only rows above its own",
        ),
        (
            "novelty/mod.rs",
            "use crate::numerics::units::LengthUnit;",
            "novelty/mod.rs:1: `novelty` has no row in the table of layers",
        ),
        (
            "system/force.rs",
            "fn f(x: &[f64]) -> f64 {\n    unsafe { *x.get_unchecked(0) }\n}",
            "system/force.rs:2: `unsafe` outside linalg/arpack.rs, linalg/metis.rs",
        ),
        (
            "model/mod.rs",
            "#[cfg(test)]\nmod tests {\n    use crate::app::cli::run;\n}\n\nuse crate::app::cli::run;",
            "model/mod.rs:6: `model` (row 4) imports `cli` (row 14): only rows above its own",
        ),
    ];
    for (path, text, expected) in cases {
        assert_eq!(violations(&Source { path, text }), [expected]);
    }
}

#[test]
fn the_checker_lets_pass_what_is_right() {
    let cases = [
        (
            "mesh/mod.rs",
            "//! See [`crate::app::cli`].\nuse crate::numerics::units::LengthUnit;\nuse crate::fe::mesh::gmsh::Reader;",
        ),
        ("mesh/tests.rs", "use crate::app::cli::run;"),
        ("mesh/gmsh/reader_tests.rs", "use crate::app::cli::run;"),
        (
            "mesh/mod.rs",
            "#[cfg(test)]\n#[allow(clippy::unwrap_used)]\nmod tests {\n    use crate::numerics::linalg::DenseMatrix;\n}",
        ),
        (
            "system/mod.rs",
            "use super::bearing::Cage;\nuse crate::{dynamics::State, linalg::{DenseMatrix, SparseMatrix}};",
        ),
        (
            "system/force.rs",
            "use super::coupled::CoupledSystem;\nconst URL: &str = \"http://x\"; // crate::app::cli",
        ),
        (
            "linalg/mod.rs",
            "#[allow(unsafe_code)]\nmod arpack;\nconst SAY: &str = \"unsafe\";",
        ),
        ("linalg/arpack.rs", "unsafe extern \"C\" {}"),
        ("main.rs", "fn main() { plummer::app::cli::main() }"),
    ];
    for (path, text) in cases {
        assert_eq!(
            violations(&Source { path, text }),
            [""; 0],
            "{path}: {text}"
        );
    }
}
