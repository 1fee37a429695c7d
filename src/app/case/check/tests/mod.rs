//! Every rule fires, with its exact message; every value just inside a rule is let through.

mod lists;
mod materials;
mod ranges;
mod relations;
mod windows;

use super::super::tests::{FULL, read};

/// A ring on springs, no housing: what needs a housing can be missed here.
const RING: &str = "[ring]\n\
    sections = [{ material = \"steel\", area = 5e-6, inertia = 9e-13, radius = 5.3e-3 }]\n\
    supports = [{ from_deg = 0, to_deg = 360, spring = { x = 1e5 } }]\n";

/// A plane housing alone.
const HOUSING: &str = "[housing]\nmesh = \"a.msh\"\nlength_unit = \"mm\"\n\
    plane = { assumption = \"stress\", thickness = 4e-3 }\n\
    parts = [{ group = \"case\", material = \"steel\" }]\n";

fn breaks(text: &str, set: &[&str], key: &str, rule: &str) {
    let error = read(text, set).expect_err(set.last().unwrap_or(&text));
    let last = set.last().map(|argument| format!("--set {argument}"));
    let place = last.unwrap_or_else(|| "folder/case.toml".to_owned());
    assert_eq!(error.to_string(), format!("{place}: `{key}`: {rule}"));
}

/// Breaks `FULL` with one key set and expects the message at that key.
fn full(argument: &str, rule: &str) {
    let (key, _) = argument.split_once('=').unwrap();
    breaks(FULL, &[argument], key, rule);
}

fn holds(text: &str, set: &[&str]) {
    if let Err(error) = read(text, set) {
        panic!("{set:?}: {error}");
    }
}
