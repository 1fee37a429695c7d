//! Each tutorial runs as it is written: its `sh` blocks in order, in one empty folder with `examples`, `meshes` and `docs`,
//! and what stands in the `text` block below one is in what it prints.

use std::env;
use std::ffi::OsStr;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::markdown::{Block, root, split};

/// A block of commands, and what it is to print.
#[derive(Debug)]
struct Step {
    /// Line in the page, from 1.
    line: usize,
    script: String,
    /// Exit code that it ends with.
    exit: i32,
    /// Programs that it needs; without one of them it is skipped.
    needs: Vec<String>,
    /// Lines of the `text` block below it.
    expected: Vec<String>,
}

/// The steps of a page: `sh` blocks, each with the `text` block that follows before the next one.
fn steps(text: &str) -> Vec<Step> {
    let mut found: Vec<Step> = Vec::new();
    for Block { info, lines, line } in split(text).0 {
        let mut words = info.split(' ');
        match words.next() {
            Some("sh") => {
                let mut step =
                    Step { line, script: lines.join("\n"), exit: 0, needs: Vec::new(), expected: Vec::new() };
                for word in words {
                    match word.split_once('=') {
                        Some(("exit", code)) => step.exit = code.parse().unwrap(),
                        Some(("needs", names)) => {
                            step.needs = names.split(',').map(str::to_owned).collect();
                        }
                        _ => panic!("line {line}: `{word}` behind ```sh"),
                    }
                }
                found.push(step);
            }
            Some("text") => {
                if let Some(step) = found.last_mut().filter(|step| step.expected.is_empty()) {
                    step.expected = lines;
                }
            }
            _ => {}
        }
    }
    found
}

/// Whether a line is what a page shows, where three dots stand for anything.
fn alike(line: &str, shown: &str) -> bool {
    match shown.split_once("...") {
        None => line == shown,
        Some((before, after)) => line.strip_prefix(before).is_some_and(|rest| {
            let starts = rest.char_indices().map(|(at, _)| at).chain([rest.len()]);
            starts.into_iter().any(|at| alike(&rest[at..], after))
        }),
    }
}

/// Looks for lines in an output, in their order: neighbours but where a line of three dots parts them. Returns the first that is
/// not where it should be.
fn missing<'a>(output: &str, expected: &'a [String]) -> Option<&'a str> {
    let said: Vec<&str> = output.lines().map(str::trim_end).collect();
    let mut from = 0;
    for run in expected.split(|line| line.trim() == "...") {
        let Some(first) = run.first() else { continue };
        let fits = |at: &usize| {
            let lines = run.iter().enumerate();
            lines
                .map(|(k, line)| said.get(at + k).is_some_and(|said| alike(said, line.trim_end())))
                .take_while(|&same| same)
                .count()
        };
        // where most of the run stands says what is wrong with it
        let best = (from..said.len()).max_by_key(|at| (fits(at), usize::MAX - at));
        match best.map(|at| (at, fits(&at))) {
            Some((at, count)) if count == run.len() => from = at + count,
            Some((_, count)) => return Some(&run[count]),
            None => return Some(first),
        }
    }
    None
}

/// Whether a program, or else a module of Python, is there.
fn installed(name: &str, path: &OsStr) -> bool {
    let looked = "command -v \"$1\" || python3 -c \"import $1\"";
    let output = Command::new("bash").args(["-c", looked, "bash", name]).env("PATH", path).output();
    output.is_ok_and(|output| output.status.success())
}

/// Runs a page's steps.
fn run(page: &str) {
    let text = fs::read_to_string(root().join("docs").join(page)).unwrap();
    let name = page.replace(['/', '.'], "-");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("tutorial-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    for shared in ["examples", "meshes", "docs"] {
        symlink(root().join(shared), folder.join(shared)).unwrap();
    }
    let program = Path::new(env!("CARGO_BIN_EXE_plummer"));
    let tools = root().join("target/tools/bin");
    let mut places = vec![program.parent().unwrap().to_owned(), tools];
    places.extend(env::split_paths(&env::var_os("PATH").unwrap_or_default()));
    let path = env::join_paths::<Vec<PathBuf>, _>(places).unwrap();
    let steps = steps(&text);
    assert!(!steps.is_empty(), "{page} has no commands");
    for step in steps {
        let place = format!("docs/{page}:{}", step.line);
        if let Some(lacking) = step.needs.iter().find(|name| !installed(name, &path)) {
            println!("{place}: skipped, {lacking} is not installed");
            continue;
        }
        let all = format!("exec 2>&1\n{}", step.script);
        let output = Command::new("bash")
            .args(["-e", "-o", "pipefail", "-c", &all])
            .env("PATH", &path)
            .current_dir(&folder)
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stdout);
        assert_eq!(output.status.code(), Some(step.exit), "{place}:\n{said}");
        if let Some(line) = missing(&said, &step.expected) {
            panic!("{place}: this line is not where it should be:\n{line}\n\nin\n{said}");
        }
    }
}

#[test]
fn quick_start() {
    run("quick-start.md");
}

#[test]
fn modal_verification() {
    run("tutorials/modal-verification.md");
}

#[test]
fn run_up() {
    run("tutorials/run-up.md");
}

#[test]
fn transfer_path() {
    run("tutorials/transfer-path.md");
}

#[test]
fn python() {
    run("python.md");
}

#[test]
fn blocks_are_steps() {
    let found = steps("```sh\na\nb\n```\n```text\nc\n```\n```sh exit=1 needs=gmsh,ccx\nd\n```\n```toml\n```\n");
    assert_eq!(found.len(), 2);
    assert_eq!((found[0].script.as_str(), found[0].exit), ("a\nb", 0));
    assert_eq!(found[0].expected, ["c"]);
    assert_eq!((found[1].exit, found[1].line), (1, 8));
    assert_eq!(found[1].needs, ["gmsh", "ccx"]);
    assert!(found[1].expected.is_empty());
}

#[test]
fn lines_are_looked_for_in_order() {
    let said = "one\ntwo  \nthree\nfour\ntwo\nfive\n";
    let first_missing = |lines: &[&str]| {
        let expected: Vec<String> = lines.iter().map(|&line| line.to_owned()).collect();
        missing(said, &expected).map(str::to_owned)
    };
    for lines in [
        &["one", "two"][..],
        &["two", "three", "...", "five"],
        &["...", "two", "five", "..."],
        &["t...o", "...e...", "f..."],
        &[],
    ] {
        assert_eq!(first_missing(lines), None, "{lines:?}");
    }
    for (lines, missed) in [
        (&["one", "three"][..], "three"),
        (&["five", "...", "one"], "one"),
        (&["six"], "six"),
        (&["t...x"], "t...x"),
        (&["one...x", "two"], "one...x"),
        (&["four", "...", "two", "three"], "three"),
        (&["five", "six"], "six"),
    ] {
        assert_eq!(first_missing(lines).as_deref(), Some(missed), "{lines:?}");
    }
}
