//! The documents hang together: every link and every anchor leads somewhere, `SUMMARY.md` lists every page, no picture comes from
//! a network, copies are those of the files, and the page of the case file names every key.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Component, Path, PathBuf};
use std::process::Command;

use super::markdown::{renews, replace_blocks, root, split};

/// A link of a page, or a picture.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Link {
    line: usize,
    target: String,
    picture: bool,
}

/// What stands in a line outside of code in backticks.
fn without_code(line: &str) -> String {
    let parts = line.split('`').enumerate();
    let kept = parts.map(|(index, part)| if index % 2 == 0 { part } else { "" });
    kept.collect::<Vec<_>>().join("`")
}

/// Inline links and pictures, `[text](target)`, outside of code.
fn links(text: &str) -> Vec<Link> {
    let mut found = Vec::new();
    for (line, prose) in split(text).1 {
        let prose = without_code(prose);
        let mut rest = prose.as_str();
        while let Some(at) = rest.find("](") {
            let opening = rest[..at].rfind('[');
            let picture = opening.is_some_and(|start| rest[..start].ends_with('!'));
            let target = rest[at + 2..].split(')').next().unwrap_or("");
            found.push(Link { line, target: target.to_owned(), picture });
            rest = &rest[at + 2..];
        }
    }
    found
}

/// Anchors of a page's headings, as GitHub and mdBook make them.
fn anchors(text: &str) -> BTreeSet<String> {
    let mut times: BTreeMap<String, usize> = BTreeMap::new();
    let headings = split(text).1.into_iter().filter_map(|(_, line)| {
        let title = line.trim_start_matches('#');
        let level = line.len() - title.len();
        ((1..=6).contains(&level) && title.starts_with(' ')).then(|| title.trim())
    });
    let mut found = BTreeSet::new();
    for title in headings {
        let kept = title.to_lowercase();
        let kept = kept.chars().filter(|&letter| letter.is_alphanumeric() || "-_ ".contains(letter));
        let slug: String = kept.map(|letter| if letter == ' ' { '-' } else { letter }).collect();
        let before = times.entry(slug.clone()).or_insert(0);
        found.insert(match *before {
            0 => slug,
            before => format!("{slug}-{before}"),
        });
        *before += 1;
    }
    found
}

/// A path without `.` and `..`.
fn plain(path: &Path) -> PathBuf {
    let mut parts = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => {
                parts.pop();
            }
            Component::CurDir => {}
            part => parts.push(part),
        }
    }
    parts
}

fn remote(target: &str) -> bool {
    ["http:", "https:", "//", "data:"].iter().any(|start| target.starts_with(start))
}

/// What is wrong with a link of a page at `path`.
fn complaint(path: &Path, text: &str, link: &Link) -> Option<String> {
    if remote(&link.target) {
        return link.picture.then(|| "a picture from a network".to_owned());
    }
    if link.target.starts_with("mailto:") {
        return None;
    }
    let (file, anchor) = match link.target.split_once('#') {
        Some((file, anchor)) => (file, Some(anchor)),
        None => (link.target.as_str(), None),
    };
    let (to, text) = if file.is_empty() {
        (path.to_owned(), text.to_owned())
    } else {
        let to = plain(&path.parent().unwrap().join(file));
        let docs = root().join("docs");
        if path.starts_with(&docs) && !to.starts_with(&docs) {
            return Some("leads out of docs, which the built book does not have".to_owned());
        }
        if !to.exists() {
            return Some("no such file".to_owned());
        }
        let page = to.extension().is_some_and(|ending| ending == "md");
        let text = if page { fs::read_to_string(&to).unwrap() } else { String::new() };
        (to, text)
    };
    match anchor {
        Some(anchor) if !anchors(&text).contains(anchor) => {
            Some(format!("{} has no such heading", to.file_name()?.display()))
        }
        _ => None,
    }
}

/// Every page below a folder, sorted.
fn pages_below(folder: &Path) -> Vec<PathBuf> {
    let mut pages = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            pages.extend(pages_below(&path));
        } else if path.extension().is_some_and(|ending| ending == "md") {
            pages.push(path);
        }
    }
    pages.sort();
    pages
}

fn documents() -> Vec<PathBuf> {
    let mut pages = pages_below(&root().join("docs"));
    pages.extend(["README.md", "CHANGELOG.md", "meshes/README.md"].map(|name| root().join(name)));
    pages
}

#[test]
fn every_link_leads_somewhere() {
    let mut wrong = Vec::new();
    let mut count = 0;
    for path in documents() {
        let text = fs::read_to_string(&path).unwrap();
        for link in links(&text) {
            count += 1;
            if let Some(what) = complaint(&path, &text, &link) {
                let page = path.strip_prefix(root()).unwrap();
                wrong.push(format!("{}:{}: {}: {what}", page.display(), link.line, link.target));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    // that the search finds them
    assert!(count > 200, "{count}");
}

/// GitHub shows a page as it is: nothing in it waits for the book to be built.
#[test]
fn pages_can_be_read_where_they_lie() {
    for path in documents() {
        let text = fs::read_to_string(&path).unwrap();
        assert!(!text.contains("{{#"), "{}: a page that only the book shows whole", path.display());
    }
}

/// Whether each line is the beginning of one of the file's, in the file's order.
fn stands_in(lines: &[String], file: &str) -> bool {
    let mut rest = file.lines();
    lines.iter().filter(|line| !line.is_empty()).all(|line| rest.any(|other| other.starts_with(line.as_str())))
}

/// A block `file=PATH` is that file, a block `from=PATH` has lines of it; with PLUMMER_WRITE the files are copied.
#[test]
fn copies_are_those_of_the_files() {
    let (mut wrong, mut count) = (Vec::new(), 0);
    for path in documents() {
        let blocks = split(&fs::read_to_string(&path).unwrap()).0;
        let mut new = Vec::new();
        for block in &blocks {
            let read = |file: &str| fs::read_to_string(root().join(file)).unwrap();
            let place = || format!("{}:{}: {}", path.display(), block.line, block.info);
            if let Some(file) = block.word("file") {
                count += 1;
                let lines: Vec<String> = read(file).lines().map(str::to_owned).collect();
                if lines != block.lines {
                    wrong.push(place());
                    new.push((block.line, lines));
                }
            }
            if let Some(file) = block.word("from") {
                count += 1;
                if !stands_in(&block.lines, &read(file)) {
                    wrong.push(place());
                }
            }
        }
        if renews() {
            replace_blocks(&path, &new);
        }
    }
    assert!(renews() || wrong.is_empty(), "not as in the file:\n{}", wrong.join("\n"));
    // that the search finds them
    assert!(count >= 3, "{count}");
}

/// With CARGO_TARGET_DIR the program is elsewhere.
#[test]
fn nothing_takes_for_granted_where_cargo_builds() {
    let mut files = documents();
    files.push(root().join("Makefile"));
    for folder in ["scripts", "benches", "docs/python", "meshes"] {
        let entries = fs::read_dir(root().join(folder)).unwrap().map(|entry| entry.unwrap().path());
        files.extend(entries.filter(|path| path.extension().is_some_and(|ending| ending == "sh" || ending == "py")));
    }
    assert!(files.len() > 50, "{}", files.len());
    for path in files {
        let text = fs::read_to_string(&path).unwrap();
        assert!(!text.contains("target/release"), "{} names target/release", path.display());
    }
}

#[test]
fn the_summary_lists_every_page_once() {
    let docs = root().join("docs");
    let summary = docs.join("SUMMARY.md");
    let text = fs::read_to_string(&summary).unwrap();
    let mut listed: Vec<_> = links(&text).iter().map(|link| docs.join(&link.target)).collect();
    listed.sort();
    let mut pages = pages_below(&docs);
    pages.retain(|page| *page != summary);
    assert_eq!(listed, pages);
}

/// Keys that a source file of the case reads: the fields of its structs that refuse unknown ones.
fn keys_of(source: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let (mut inside, mut skipped) = (false, false);
    for line in source.lines() {
        match line.trim() {
            "#[serde(deny_unknown_fields)]" => inside = true,
            "}" => inside = false,
            "#[serde(skip)]" => skipped = true,
            field if inside => {
                let field = field.strip_prefix("pub ").unwrap_or(field);
                let name = field.split(':').next().unwrap_or("");
                let is_name = name.chars().all(|letter| letter.is_alphanumeric() || letter == '_');
                let named = field.contains(": ") && is_name;
                if named && !std::mem::take(&mut skipped) {
                    found.push(name);
                }
            }
            _ => {}
        }
    }
    found
}

#[test]
fn the_page_of_the_case_file_names_every_key() {
    let page = fs::read_to_string(root().join("docs/case-file.md")).unwrap();
    let words: BTreeSet<&str> = page.split(|letter: char| !(letter.is_alphanumeric() || letter == '_')).collect();
    let mut missing = BTreeSet::new();
    let mut count = 0;
    for entry in fs::read_dir(root().join("src/app/case")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "rs") {
            let source = fs::read_to_string(&path).unwrap();
            let keys = keys_of(&source);
            count += keys.len();
            let lacking = keys.into_iter().filter(|key| !words.contains(key));
            missing.extend(lacking.map(str::to_owned));
        }
    }
    assert!(missing.is_empty(), "{missing:?}");
    // that the search finds them
    assert!(count > 150, "{count}");
}

/// Values of an attribute in a page of HTML.
fn attributes<'a>(html: &'a str, name: &str) -> Vec<&'a str> {
    let start = format!(" {name}=\"");
    let values = html.split(start.as_str()).skip(1);
    values.filter_map(|rest| rest.split('"').next()).collect()
}

/// The book as mdBook builds it: every link and anchor in it, as the browser sees them.
#[test]
fn the_built_book_holds_together() {
    let own = root().join("target/tools/bin/mdbook");
    let program = if own.is_file() { own } else { PathBuf::from("mdbook") };
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("book");
    let _ = fs::remove_dir_all(&folder);
    let built = Command::new(&program).args(["build", "-d"]).arg(&folder).arg(root().join("docs")).output();
    let Ok(built) = built else {
        println!("skipped: mdbook is not installed (scripts/setup-ci.sh installs it)");
        return;
    };
    let said = String::from_utf8_lossy(&built.stderr);
    assert!(built.status.success(), "{said}");
    assert!(!said.contains("WARN") && !said.contains("ERROR"), "{said}");
    let mut wrong = Vec::new();
    let mut count = 0;
    for page in pages_below(&root().join("docs")) {
        let name = page.strip_prefix(root().join("docs")).unwrap();
        if name == Path::new("SUMMARY.md") {
            continue;
        }
        let path = folder.join(name).with_extension("html");
        let html = fs::read_to_string(&path).unwrap();
        for source in attributes(&html, "src") {
            if remote(source) || !plain(&path.parent().unwrap().join(source)).is_file() {
                wrong.push(format!("{}: {source}", name.display()));
            }
        }
        for target in attributes(&html, "href") {
            if remote(target) || target.is_empty() || target.starts_with("mailto:") {
                continue;
            }
            count += 1;
            let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
            let to = match file {
                "" => path.clone(),
                file => plain(&path.parent().unwrap().join(file)),
            };
            let whole = anchor.is_empty() || to.extension().is_none_or(|ending| ending != "html");
            let there = if whole {
                to.exists()
            } else {
                fs::read_to_string(&to).is_ok_and(|html| html.contains(&format!(" id=\"{anchor}\"")))
            };
            if !there {
                wrong.push(format!("{}: {target}", name.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count > 200, "{count}");
}

#[test]
fn links_anchors_and_complaints() {
    let text = "# One `x`: the ring's, two\n[a](b.md#c) `[no](x)` ![p](q.svg)\n```sh\n[no](y)\n```\n## Two\n### Two\n";
    let found: Vec<_> = links(text).into_iter().map(|link| (link.line, link.target, link.picture)).collect();
    assert_eq!(found, [(2, "b.md#c".to_owned(), false), (2, "q.svg".to_owned(), true)]);
    let slugs: Vec<_> = anchors(text).into_iter().collect();
    assert_eq!(slugs, ["one-x-the-rings-two", "two", "two-1"]);

    let page = root().join("docs/limits.md");
    let said = |target: &str, picture| {
        let target = target.to_owned();
        complaint(&page, "# A\n", &Link { line: 1, target, picture })
    };
    for (target, picture, expected) in [
        ("theory/structure.md", false, None),
        ("theory/structure.md#mesh", false, None),
        ("#a", false, None),
        ("https://gmsh.info", false, None),
        ("theory/structure.md#no", false, Some("structure.md has no such heading")),
        ("#b", false, Some("limits.md has no such heading")),
        ("none.md", false, Some("no such file")),
        ("../README.md", false, Some("leads out of docs, which the built book does not have")),
        ("https://gmsh.info/logo.png", true, Some("a picture from a network")),
    ] {
        assert_eq!(said(target, picture).as_deref(), expected, "{target}");
    }
}
