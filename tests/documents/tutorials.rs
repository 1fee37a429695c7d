//! Each tutorial runs as it is written: its `sh` blocks in order, in a folder with `examples`, `meshes` and `docs`; and what stands
//! in the `text` block below one is what it prints. Blocks that name a result of another page run among the others' results too.

use std::collections::BTreeSet;
use std::env;
use std::ffi::{OsStr, OsString};
use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::markdown::{Block, renews, replace_blocks, root, split};

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
    /// The `text` block below it: what it prints.
    shown: Option<Block>,
}

/// What a script names of what it may leave: files in its folder, and folders of results. A command without `--out` has one of
/// its file's name.
fn names(script: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for line in script.replace("\\\n", " ").lines() {
        let apart = |letter: char| letter.is_whitespace() || "\"'=,;()[]{}<>".contains(letter);
        for word in line.split(apart) {
            if let Some(result) = word.strip_prefix("out/") {
                found.extend(result.split('/').next().map(|name| format!("out/{name}")));
                continue;
            }
            let path = Path::new(word);
            let ending = path.extension().and_then(OsStr::to_str).unwrap_or("");
            if !["toml", "msh", "npz", "csv", "pdf", "sha256", "asc"].contains(&ending) {
                continue;
            }
            if !word.contains('/') {
                found.insert(word.to_owned());
            }
            if line.contains("plummer ") && !line.contains("--out") {
                found.insert(format!("out/{}", path.file_stem().unwrap().display()));
            }
        }
    }
    found
}

/// The steps of a page: `sh` blocks, each with the `text` block that follows before the next one.
fn steps(text: &str) -> Vec<Step> {
    let mut found: Vec<Step> = Vec::new();
    for block in split(text).0 {
        let Block { info, lines, line } = &block;
        let (mut words, line) = (info.split(' '), *line);
        match words.next() {
            Some("sh") => {
                let mut step = Step { line, script: lines.join("\n"), exit: 0, needs: Vec::new(), shown: None };
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
                if let Some(step) = found.last_mut().filter(|step| step.shown.is_none()) {
                    step.shown = Some(block);
                }
            }
            _ => {}
        }
    }
    found
}

/// How far numbers may be from those that a page shows, relative; the words are the same.
type Tolerance = f64;

/// What `numbers=` behind a fence says: `10%` of meshes, which each version of gmsh makes another way; `any` where a computer's
/// speed or a chaotic motion decides, which another processor's roundings change. Without it a line is as shown.
fn tolerance(block: &Block) -> Tolerance {
    match block.word("numbers") {
        None => 0.0,
        Some("any") => f64::INFINITY,
        Some(share) => share.trim_end_matches('%').parse::<f64>().unwrap() / 100.0,
    }
}

/// A word as what stands before a number, the number, and what stands behind it.
fn parted(word: &str) -> Option<(&str, f64, &str)> {
    let start = word.find(|letter: char| letter.is_ascii_digit() || "+-−".contains(letter))?;
    let within = |letter: char| letter.is_ascii_digit() || "+-−.e·⁻⁰¹²³⁴⁵⁶⁷⁸⁹".contains(letter);
    let length = word[start..].find(|letter| !within(letter)).unwrap_or(word.len() - start);
    let number = word[start..start + length].trim_end_matches(['.', 'e', '·']);
    let plain = |letter| match "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|raised| raised == letter) {
        Some(digit) => char::from(b'0' + digit as u8),
        None if "−⁻".contains(letter) => '-',
        None => letter,
    };
    let value = number.replace("·10", "e").chars().map(plain).collect::<String>().parse().ok()?;
    Some((&word[..start], value, &word[start + number.len()..]))
}

/// Whether a line is what a page shows but for its numbers, which are within the tolerance.
fn alike(line: &str, shown: &str, tolerance: Tolerance) -> bool {
    if line == shown || tolerance == 0.0 {
        return line == shown;
    }
    let same = |(one, other): (&str, &str)| {
        let numbers = || parted(one).zip(parted(other));
        one == other
            || numbers().is_some_and(|((before, a, behind), (same_before, b, same_behind))| {
                let near = tolerance.is_infinite() || (a - b).abs() <= tolerance * a.abs().max(b.abs());
                before == same_before && behind == same_behind && near
            })
    };
    let words = || line.split_whitespace().zip(shown.split_whitespace());
    line.split_whitespace().count() == shown.split_whitespace().count() && words().all(same)
}

/// Looks for lines in an output, in their order: neighbours but where a line of three dots parts them. Returns the first that is
/// not where it should be, and the lines as the output has them.
fn found<'a>(output: &str, expected: &'a [String], tolerance: Tolerance) -> (Option<&'a str>, Vec<String>) {
    let said: Vec<&str> = output.lines().map(str::trim_end).collect();
    let (mut from, mut missing, mut now) = (0, None, Vec::new());
    for (number, run) in expected.split(|line| line.trim() == "...").enumerate() {
        if number > 0 {
            now.push("...".to_owned());
        }
        let pairs = |at: usize| run.iter().enumerate().map(move |(k, line)| (k, line.trim_end(), at + k));
        let fits = |at: usize| {
            let fit =
                |&(_, line, at): &(usize, &str, usize)| said.get(at).is_some_and(|said| alike(said, line, tolerance));
            pairs(at).take_while(fit).count()
        };
        let loosely =
            |at: usize| pairs(at).filter(|&(_, line, at)| said.get(at).is_some_and(|said| akin(said, line))).count();
        // where most of the run stands says what is wrong with it
        let best = (from..said.len()).max_by_key(|&at| (fits(at), loosely(at), usize::MAX - at)).unwrap_or(from);
        let count = fits(best);
        if let Some(line) = run.get(count) {
            missing = missing.or(Some(line.as_str()));
        }
        let whole = count == run.len();
        let printed = said.iter().skip(best).take(run.len()).map(|&line| line.to_owned());
        now.extend(if whole { run.to_vec() } else { printed.collect() });
        from = best + run.len();
    }
    (missing, now)
}

/// Whether two lines say the same sort of thing: most of their words.
fn akin(one: &str, other: &str) -> bool {
    let words: Vec<&str> = other.split_whitespace().collect();
    let shared = one.split_whitespace().filter(|word| words.contains(word)).count();
    2 * shared > words.len()
}

/// Whether a program, or else a module of Python, is there.
fn installed(name: &str, path: &OsStr) -> bool {
    let looked = "command -v \"$1\" || python3 -c \"import $1\"";
    let output = Command::new("bash").args(["-c", looked, "bash", name]).env("PATH", path).output();
    output.is_ok_and(|output| output.status.success())
}

/// An empty folder with what a clone of the repository has.
fn clone(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("tutorial-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    for shared in ["examples", "meshes", "docs"] {
        symlink(root().join(shared), folder.join(shared)).unwrap();
    }
    folder
}

/// Places of programs: the one that is tested first.
fn path() -> OsString {
    let program = Path::new(env!("CARGO_BIN_EXE_plummer"));
    let mut places = vec![program.parent().unwrap().to_owned(), root().join("target/tools/bin")];
    places.extend(env::split_paths(&env::var_os("PATH").unwrap_or_default()));
    env::join_paths::<Vec<PathBuf>, _>(places).unwrap()
}

/// What a script prints, and its exit code.
fn bash(folder: &Path, script: &str) -> (Option<i32>, String) {
    let all = format!("exec 2>&1\n{script}");
    let words = ["-e", "-o", "pipefail", "-c", &all];
    let output = Command::new("bash").args(words).env("PATH", path()).current_dir(folder).output().unwrap();
    (output.status.code(), String::from_utf8_lossy(&output.stdout).into_owned())
}

/// The file of a page, and its steps.
fn page_steps(page: &str) -> (PathBuf, Vec<Step>) {
    let file = root().join("docs").join(page);
    let steps = steps(&fs::read_to_string(&file).unwrap());
    assert!(!steps.is_empty(), "{page} has no commands");
    (file, steps)
}

/// Does in a folder what steps of a page say, and compares what is printed with what the page shows; with PLUMMER_WRITE the
/// page gets what is printed.
fn follow(page: &str, folder: &Path, (file, steps): (PathBuf, Vec<Step>)) {
    let mut new = Vec::new();
    for step in steps {
        let place = format!("docs/{page}:{}", step.line);
        if let Some(lacking) = step.needs.iter().find(|name| !installed(name, &path())) {
            println!("{place}: skipped, {lacking} is not installed");
            continue;
        }
        let (code, said) = bash(folder, &step.script);
        assert_eq!(code, Some(step.exit), "{place}:\n{said}");
        let Some(shown) = &step.shown else { continue };
        let (missing, now) = found(&said, &shown.lines, tolerance(shown));
        match missing {
            Some(_) if renews() => new.push((shown.line, now)),
            Some(line) => panic!("{place}: this line is not where it should be:\n{line}\n\nin\n{said}"),
            None => {}
        }
    }
    replace_blocks(&file, &new);
}

/// Follows a page alone. It leaves what it names and nothing else: on this rests which steps of other pages find it.
fn run(page: &str) {
    let folder = clone(&page.replace(['/', '.'], "-"));
    let (file, steps) = page_steps(page);
    let named: BTreeSet<String> = steps.iter().flat_map(|step| names(&step.script)).collect();
    follow(page, &folder, (file, steps));
    for place in ["", "out/"] {
        for entry in fs::read_dir(folder.join(place)).into_iter().flatten() {
            let left = format!("{place}{}", entry.unwrap().file_name().display());
            let known = ["examples", "meshes", "docs", "out"].contains(&left.as_str()) || named.contains(&left);
            assert!(known, "{page} leaves {left}, which no command names: {named:?}");
        }
    }
}

/// As a reader does: `make demo`, then page after page in one folder. A step that names nothing of another page finds there what
/// it finds alone, where its page's own test follows it: here are the others, and what they need of their page.
#[test]
fn in_one_folder_page_after_page() {
    let makefile = fs::read_to_string(root().join("Makefile")).unwrap();
    let value = |name: &str| makefile.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(" := ")).unwrap();
    let demo = format!("plummer run {} --set '{}' --quiet", value("CASE"), value("WINDOWS"));
    let folder = clone("all");
    assert_eq!(bash(&folder, &demo), (Some(0), String::new()));
    let pages = [
        "quick-start.md",
        "tutorials/modal-verification.md",
        "tutorials/run-up.md",
        "tutorials/transfer-path.md",
        "python.md",
    ];
    let mut followed = 0;
    for page in pages {
        let others = pages.iter().filter(|other| **other != page).flat_map(|other| page_steps(other).1);
        let mut shared: BTreeSet<String> = others.flat_map(|step| names(&step.script)).collect();
        shared.extend(names(&demo));
        let (file, mut steps) = page_steps(page);
        let mut chosen = Vec::new();
        while let Some(step) = steps.pop() {
            let own = names(&step.script);
            if !own.is_disjoint(&shared) {
                shared.extend(own);
                chosen.insert(0, step);
            }
        }
        followed += chosen.len();
        follow(page, &folder, (file, chosen));
    }
    // that the choice finds those of the folders `outer-dent` and `pedestal`
    assert!((6..20).contains(&followed), "{followed}");
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
fn scripts_name_what_they_leave() {
    let named = |script: &str| names(script).into_iter().collect::<Vec<_>>();
    assert_eq!(named("plummer modes a/b.toml\nx > c.csv"), ["c.csv", "out/b"]);
    assert_eq!(named("plummer run b.toml \\\n --out out/d/e --set 'a.b=1'"), ["b.toml", "out/d"]);
    assert_eq!(named("open(\"out/inner/signals.npz\")"), ["out/inner"]);
}

#[test]
fn blocks_are_steps() {
    let found = steps("```sh\na\nb\n```\n```text\nc\n```\n```sh exit=1 needs=gmsh,ccx\nd\n```\n```toml\n```\n");
    assert_eq!(found.len(), 2);
    assert_eq!((found[0].script.as_str(), found[0].exit), ("a\nb", 0));
    assert_eq!(found[0].shown.as_ref().unwrap().lines, ["c"]);
    assert_eq!((found[1].exit, found[1].line), (1, 8));
    assert_eq!(found[1].needs, ["gmsh", "ccx"]);
    assert!(found[1].shown.is_none());
}

#[test]
fn numbers_may_differ_where_the_page_says_so() {
    assert_eq!(parted("(−5.36·10⁻⁴,"), Some(("(", -5.36e-4, ",")));
    assert_eq!(parted("7e-12;"), Some(("", 7e-12, ";")));
    assert_eq!((parted("tie"), parted("·")), (None, None));
    for (line, shown, tolerance, expected) in [
        ("1.93 s simulated", "2.01 s simulated", 0.0, false),
        ("1.93 s simulated", "2.01 s simulated", 0.05, true),
        ("1.93 s simulated", "2.01 s simulated", 0.03, false),
        ("P1: (7e-12; ok)", "P1:  (8e-13; ok)", f64::INFINITY, true),
        ("P1: 7 m", "P1: 7 s", f64::INFINITY, false),
        ("7 m 1", "7 m", f64::INFINITY, false),
    ] {
        assert_eq!(alike(line, shown, tolerance), expected, "{line}, {shown}");
    }
}

#[test]
fn lines_are_looked_for_in_order() {
    let said = "one\ntwo  \nthree\nfour\ntwo\nfive\n";
    let look = |lines: &[&str]| {
        let expected: Vec<String> = lines.iter().map(|&line| line.to_owned()).collect();
        let (missing, now) = found(said, &expected, 0.0);
        (missing.map(str::to_owned), now)
    };
    for lines in [&["one", "two"][..], &["two", "three", "...", "five"], &["...", "two", "five", "..."], &[]] {
        assert_eq!(look(lines).0, None, "{lines:?}");
    }
    for (lines, missed) in [
        (&["one", "three"][..], "three"),
        (&["five", "...", "one"], "one"),
        (&["six"], "six"),
        (&["four", "...", "two", "three"], "three"),
        (&["five", "six"], "six"),
        (&["t...o"], "t...o"),
    ] {
        assert_eq!(look(lines).0.as_deref(), Some(missed), "{lines:?}");
    }
    // what the page is to show instead
    assert_eq!(look(&["one", "zwei", "...", "five"]).1, ["one", "two", "...", "five"]);
}
