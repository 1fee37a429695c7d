//! Arrows from file to file: the paths that the code names, followed to where the names are defined.

use std::collections::BTreeMap;

use super::source::Source;

/// A file uses a name that another file defines.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Arrow {
    /// Path of the file that imports.
    pub from: String,
    /// Line in it.
    pub line: usize,
    /// Path of the file that defines the name.
    pub to: String,
    /// The name.
    pub name: String,
}

/// Modules by their path in the crate, each with its file and the names that it hands on.
struct Modules<'a> {
    files: BTreeMap<Vec<String>, &'a str>,
    /// (module, name) to the path that a `use` in the module gives this name.
    names: BTreeMap<(Vec<String>, String), Vec<String>>,
}

/// A path that is named somewhere: whole, from the crate's root.
struct Named {
    line: usize,
    path: Vec<String>,
    /// What the path is called in its file: the last name, or another after `as`.
    called: String,
    /// Whether it stands in a `pub use`.
    handed_on: bool,
    /// Whether it stands in any `use`.
    used: bool,
}

/// Every arrow of the crate.
pub fn arrows(sources: &[Source]) -> Vec<Arrow> {
    let named: Vec<Vec<Named>> = sources.iter().map(named_paths).collect();
    let mut modules = Modules { files: BTreeMap::new(), names: BTreeMap::new() };
    for (source, named) in sources.iter().zip(&named) {
        let module = module_of(&source.path);
        for named in named.iter().filter(|named| named.used) {
            let key = (module.clone(), named.called.clone());
            modules.names.insert(key, named.path.clone());
        }
        modules.files.insert(module, &source.path);
    }
    let mut found = Vec::new();
    for (source, named) in sources.iter().zip(&named) {
        let face = source.path.ends_with("/mod.rs");
        for named in named.iter().filter(|named| !(face && named.handed_on)) {
            let Some((to, name)) = modules.definition(&named.path, 0) else {
                continue;
            };
            if to != source.path {
                found.push(Arrow { from: source.path.clone(), line: named.line, to: to.to_owned(), name });
            }
        }
    }
    found
}

impl Modules<'_> {
    /// The file that defines what a path names, and the name; none for what is no module of the crate.
    fn definition(&self, path: &[String], depth: usize) -> Option<(&str, String)> {
        let long = (1..=path.len()).rev().find(|&k| self.files.contains_key(&path[..k]))?;
        let Some(name) = path.get(long) else {
            return Some((self.files[path], "the module".to_owned()));
        };
        let key = (path[..long].to_vec(), name.clone());
        match self.names.get(&key) {
            // a name handed on; ten steps end a circle of them
            Some(next) if depth < 10 && next[..] != path[..=long] => {
                let whole: Vec<String> = next.iter().chain(&path[long + 1..]).cloned().collect();
                self.definition(&whole, depth + 1).or_else(|| Some((self.files[&path[..long]], name.clone())))
            }
            _ => Some((self.files[&path[..long]], name.clone())),
        }
    }
}

/// Path of a file's module in the crate.
fn module_of(path: &str) -> Vec<String> {
    let path = path.strip_suffix(".rs").unwrap_or(path);
    let path = path.strip_suffix("/mod").unwrap_or(path);
    path.split('/').map(str::to_owned).collect()
}

/// All paths of a file that start at the crate's root, at a module above, or, in a `use`, at a module below.
fn named_paths(source: &Source) -> Vec<Named> {
    let (mut text, mut starts) = (String::new(), Vec::new());
    for (line, part) in &source.code {
        starts.push((text.len(), *line));
        text.push_str(part);
        text.push('\n');
    }
    let line_at = |place: usize| {
        let after = starts.partition_point(|&(start, _)| start <= place);
        starts[after - 1].1
    };
    let module = module_of(&source.path);
    let mut found = Vec::new();
    let mut covered = 0;
    for place in path_starts(&text) {
        if place < covered {
            continue;
        }
        let head = text[..place].trim_end();
        let used = head.ends_with("use") && !head.ends_with("_use");
        let before = head.trim_end_matches("use").trim_end();
        let handed_on = used && (before.ends_with("pub") || before.ends_with(')'));
        let end = if used { place + text[place..].find(';').unwrap_or(0) } else { place };
        covered = end;
        for (path, called) in paths(&text[place..], used) {
            if let Some(path) = whole(&module, &path) {
                found.push(Named { line: line_at(place), path, called, handed_on, used });
            }
        }
    }
    found
}

/// Where paths begin: behind `use`, and at each `crate::` and `super::` elsewhere.
fn path_starts(text: &str) -> Vec<usize> {
    let begins = |place: usize| {
        let before = text[..place].chars().next_back();
        !before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':')
    };
    let mut found = Vec::new();
    for word in ["crate::", "super::"] {
        let places = text.match_indices(word).map(|(place, _)| place);
        found.extend(places.filter(|&place| begins(place)));
    }
    let uses = text.match_indices("use ").filter(|&(place, _)| {
        begins(place) && text[..place].rsplit('\n').next().is_some_and(|line| !line.contains('"'))
    });
    found.extend(uses.map(|(place, word)| place + word.len()));
    found.sort_unstable();
    found.dedup();
    found
}

/// Paths of one tree of names, `a::{b, c::D as E}`, each with what it is called.
fn paths(text: &str, used: bool) -> Vec<(Vec<String>, String)> {
    let mut found = Vec::new();
    tree(text, &[], used, &mut found);
    found
}

/// Reads one tree and returns how many bytes it took.
fn tree(text: &str, above: &[String], used: bool, found: &mut Vec<(Vec<String>, String)>) -> usize {
    let mut path = above.to_vec();
    let mut at = 0;
    loop {
        at += text[at..].len() - text[at..].trim_start().len();
        if text[at..].starts_with('{') && used {
            at += 1;
            loop {
                at += text[at..].len() - text[at..].trim_start().len();
                if text[at..].starts_with('}') {
                    return at + 1;
                }
                let took = tree(&text[at..], &path, used, found);
                at += took;
                at += text[at..].len() - text[at..].trim_start().len();
                if text[at..].starts_with(',') {
                    at += 1;
                } else if took == 0 {
                    return at;
                }
            }
        }
        let name: String = text[at..].chars().take_while(|c| c.is_alphanumeric() || *c == '_' || *c == '*').collect();
        at += name.len();
        if name.is_empty() {
            break;
        }
        if name != "self" && name != "*" {
            path.push(name);
        }
        if text[at..].starts_with("::") {
            at += 2;
        } else {
            break;
        }
    }
    let mut called = path.last().cloned().unwrap_or_default();
    if let Some(rest) = text[at..].strip_prefix(" as ").filter(|_| used) {
        called = rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        at += " as ".len() + called.len();
    }
    if path.len() > above.len() || !above.is_empty() {
        found.push((path, called));
    }
    at
}

/// A path from the crate's root: `crate::` and `super::` are taken away, a name below the module is set behind it.
fn whole(module: &[String], path: &[String]) -> Option<Vec<String>> {
    let mut names = path.iter().peekable();
    match names.peek()?.as_str() {
        "crate" => Some(names.skip(1).cloned().collect()),
        "std" | "core" | "alloc" => None,
        _ => {
            let mut start = module.to_vec();
            while names.next_if(|name| *name == "super").is_some() {
                start.pop()?;
            }
            start.extend(names.cloned());
            Some(start)
        }
    }
}
