//! The house keeps its plan: wings import from the wings below them alone, rooms and files go in no circle, and `unsafe` stays in
//! the files of foreign libraries.
//!
//! Reference: the table of wings below, and `docs/architecture.md`.
//! Goal: an import against the flow from mesh to report fails here, with file and line.
//! Sketch: every path of a `use`, and every `crate::` or `super::` path in code, is followed through re-exports to the file that
//!   defines the name. That is an arrow from file to file.
//! Conditions: test code is exempt: files `tests.rs`, `*_tests.rs` and `tests_*.rs`, and modules under `#[cfg(test)]`.
//!   So are comments, `lib.rs` and `main.rs`. A `pub use` in a `mod.rs` is no arrow of its own: it hands names on.
//! Parameters: none; there is no tolerance.

mod circles;
mod imports;
mod picture;
mod source;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use imports::{Arrow, arrows};
use source::{Source, has_word, read_all};

/// Each wing, from the lowest one on, and the wings that it may import.
const WINGS: &[(&str, &[&str])] = &[
    ("files", &[]),
    ("numerics", &["files"]),
    ("fe", &["numerics", "files"]),
    ("bearing", &["numerics"]),
    ("signal", &["numerics", "bearing"]),
    ("system", &["fe", "bearing", "numerics"]),
    ("formats", &["fe", "signal", "system", "numerics", "files"]),
    ("report", &["numerics"]),
    ("app", &["report", "formats", "system", "signal", "bearing", "fe", "numerics", "files"]),
];

/// The files with `unsafe` in them: a foreign library each.
const UNSAFE_FILES: [&str; 7] = [
    "app/cli/heap.rs",
    "numerics/linalg/arpack.rs",
    "numerics/linalg/blas.rs",
    "numerics/linalg/loaded.rs",
    "numerics/linalg/metis.rs",
    "numerics/linalg/mumps/ffi.rs",
    "numerics/linalg/mumps/world.rs",
];

/// Wing of a file: the folder at the top.
fn wing(path: &str) -> &str {
    path.split('/').next().unwrap_or(path)
}

/// Room of a file: the folder or file below the wing; of files in `app/commands` and `app/studies` the one below that.
fn room(path: &str) -> String {
    let depth = match path {
        _ if path.starts_with("app/commands/") || path.starts_with("app/studies/") => 3,
        _ => 2,
    };
    let names: Vec<&str> = path.split('/').take(depth).collect();
    names.join("/").trim_end_matches(".rs").to_owned()
}

/// All that is wrong with the arrows between wings and with `unsafe`, as `path:line: what`.
fn violations(sources: &[Source], arrows: &[Arrow]) -> Vec<String> {
    let mut found = Vec::new();
    for source in sources {
        if UNSAFE_FILES.contains(&source.path.as_str()) {
            continue;
        }
        for (line, text) in &source.code {
            if has_word(text, "unsafe") {
                found.push(format!("{}:{line}: `unsafe` outside {}", source.path, UNSAFE_FILES.join(", ")));
            }
        }
    }
    for arrow in arrows {
        let (from, to) = (wing(&arrow.from), wing(&arrow.to));
        let Some((_, below)) = WINGS.iter().find(|(name, _)| *name == from) else {
            found.push(format!("{}: `{from}` is not in the table of wings", arrow.from));
            continue;
        };
        if from != to && !below.contains(&to) {
            found.push(format!(
                "{}:{}: `{from}` imports `{to}` ({}): it may import {below:?}",
                arrow.from, arrow.line, arrow.to
            ));
        }
    }
    found
}

/// Every circle of a graph with the arrows that tie it, in words.
fn circles_in_words(arrows: &[Arrow], name: impl Fn(&str) -> String) -> Vec<String> {
    let mut graph: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for arrow in arrows {
        let (from, to) = (name(&arrow.from), name(&arrow.to));
        if from != to {
            graph.entry(from).or_default().insert(to);
        }
    }
    let circles = circles::circles(&graph).into_iter();
    let words = circles.map(|members| {
        let ties = arrows.iter().filter(|arrow| {
            let (from, to) = (name(&arrow.from), name(&arrow.to));
            from != to && members.contains(&from) && members.contains(&to)
        });
        let ties = ties.map(|tie| format!("  {}:{} -> {} ({})", tie.from, tie.line, tie.to, tie.name));
        let ties: BTreeSet<String> = ties.collect();
        let ties: Vec<String> = ties.into_iter().collect();
        format!("circle of {members:?}:\n{}", ties.join("\n"))
    });
    words.collect()
}

fn src() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

#[test]
fn wings_import_downwards_and_unsafe_stays_where_it_is() {
    let sources = read_all(&src());
    // a checker that finds nothing finds no faults
    assert!(sources.len() > 50, "{} files", sources.len());
    let arrows = arrows(&sources);
    assert!(arrows.len() > 1000, "{} imports", arrows.len());
    let found = violations(&sources, &arrows);
    assert!(found.is_empty(), "{}", found.join("\n"));
    for file in UNSAFE_FILES {
        let source = sources.iter().find(|source| source.path == file).unwrap();
        assert!(source.code.iter().any(|(_, line)| has_word(line, "unsafe")), "{file}");
    }
}

#[test]
fn no_files_and_no_rooms_go_in_circles() {
    let arrows = arrows(&read_all(&src()));
    let mut found = circles_in_words(&arrows, |path| path.to_owned());
    found.extend(circles_in_words(&arrows, room));
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// The picture is made again with `PLUMMER_WRITE=1 cargo test --test layering`.
#[test]
fn the_picture_is_that_of_the_code() {
    let sources = read_all(&src());
    let arrows = arrows(&sources);
    let made = picture::svg(WINGS, &sources, &arrows);
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/figures/architecture.svg");
    if std::env::var_os("PLUMMER_WRITE").is_some() {
        std::fs::write(&file, &made).unwrap();
    }
    let kept = std::fs::read_to_string(&file).unwrap_or_default();
    assert!(kept == made, "{} is not that of the code: PLUMMER_WRITE=1 cargo test --test layering", file.display());
}

/// A small house of files, each path with its text.
fn house(files: &[(&str, &str)]) -> Vec<Source> {
    let sources = files.iter().map(|(path, text)| Source::new(path, text));
    sources.collect()
}

#[test]
fn the_checker_fires() {
    let base = [
        ("numerics/mod.rs", "pub mod linalg;\n"),
        ("numerics/linalg/mod.rs", "mod sparse;\npub use sparse::{SparseMatrix, other};\n"),
        ("numerics/linalg/sparse.rs", "pub struct SparseMatrix;\n"),
        ("system/mod.rs", "mod structure;\npub use structure::Structure;\n"),
        ("system/structure.rs", "pub struct Structure;\n"),
    ];
    let cases = [
        (
            "bearing/dent.rs",
            "use crate::system::Structure;",
            "bearing/dent.rs:1: `bearing` imports `system` (system/structure.rs): it may import [\"numerics\"]",
        ),
        (
            "fe/assembly/mod.rs",
            "//! Doc.\n\nuse crate::{\n    numerics::linalg::SparseMatrix,\n    system::Structure,\n};",
            "fe/assembly/mod.rs:3: `fe` imports `system` (system/structure.rs): it may import [\"numerics\", \"files\"]",
        ),
        (
            "numerics/ode/driver.rs",
            "fn f() {\n    let s = crate::system::Structure;\n}",
            "numerics/ode/driver.rs:2: `numerics` imports `system` (system/structure.rs): it may import [\"files\"]",
        ),
        (
            "report/mod.rs",
            "use super::system::Structure;",
            "report/mod.rs:1: `report` imports `system` (system/structure.rs): it may import [\"numerics\"]",
        ),
        (
            "fe/model.rs",
            "#[cfg(test)]\nmod tests {\n    use crate::system::Structure;\n}\n\nmacro_rules! m { () => { $crate::system::Structure } }",
            "fe/model.rs:6: `fe` imports `system` (system/structure.rs): it may import [\"numerics\", \"files\"]",
        ),
        (
            "novelty/mod.rs",
            "use crate::numerics::linalg::SparseMatrix;",
            "novelty/mod.rs: `novelty` is not in the table of wings",
        ),
        (
            "system/force.rs",
            "fn f(x: &[f64]) -> f64 {\n    unsafe { *x.get_unchecked(0) }\n}",
            "system/force.rs:2: `unsafe` outside app/cli/heap.rs, numerics/linalg/arpack.rs, numerics/linalg/blas.rs, numerics/linalg/loaded.rs, numerics/linalg/metis.rs, numerics/linalg/mumps/ffi.rs, numerics/linalg/mumps/world.rs",
        ),
    ];
    for (path, text, expected) in cases {
        let mut files = base.to_vec();
        files.push((path, text));
        let sources = house(&files);
        assert_eq!(violations(&sources, &arrows(&sources)), [expected]);
    }
}

#[test]
fn circles_of_files_are_found_through_re_exports() {
    let sources = house(&[
        ("fe/mod.rs", "pub mod mesh;\n"),
        ("fe/mesh/mod.rs", "mod a;\nmod b;\npub use a::A;\npub use b::B;\n"),
        ("fe/mesh/a.rs", "use super::B;\npub struct A(B);\n"),
        ("fe/mesh/b.rs", "fn f() -> crate::fe::mesh::A { todo!() }\npub struct B;\n"),
        ("fe/mesh/c.rs", "use super::{A, B};\n"),
    ]);
    let found = circles_in_words(&arrows(&sources), |path| path.to_owned());
    assert_eq!(
        found,
        [
            "circle of {\"fe/mesh/a.rs\", \"fe/mesh/b.rs\"}:\n  fe/mesh/a.rs:1 -> fe/mesh/b.rs (B)\n  fe/mesh/b.rs:1 -> fe/mesh/a.rs (A)"
        ]
    );
    assert!(circles_in_words(&arrows(&sources), room).is_empty());
}

#[test]
fn the_checker_lets_pass_what_is_right() {
    let cases = [
        ("fe/mesh/mod.rs", "//! See [`crate::app::cli`].\nuse crate::numerics::units::LengthUnit;"),
        ("fe/mesh/tests.rs", "use crate::app::cli::run;"),
        ("system/force.rs", "use super::coupled::CoupledSystem;\nconst URL: &str = \"http://x\"; // crate::app::cli"),
        ("numerics/linalg/mod.rs", "#[allow(unsafe_code)]\nmod arpack;\nconst SAY: &str = \"unsafe\";"),
        ("numerics/linalg/arpack.rs", "unsafe extern \"C\" {}"),
        ("main.rs", "fn main() { plummer::app::cli::main() }"),
    ];
    for (path, text) in cases {
        let sources = house(&[
            ("app/cli/mod.rs", "pub fn run() {}"),
            ("numerics/units.rs", "pub enum LengthUnit {}"),
            (path, text),
        ]);
        let found = violations(&sources, &arrows(&sources));
        assert_eq!(found, [""; 0], "{path}: {text}");
    }
}
