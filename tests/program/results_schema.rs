//! The JSON Schemas of results against what commands print.
//!
//! Goal: what a command prints with `--json` is valid by `plummer schema --results COMMAND`; without a key that the schema requires, or with a
//!   value of another kind, it is not; every key says what it is.
//! Conditions: examples that take a second, one of each form of a result.

use std::path::Path;

use serde_json::{Value, json};

use super::common::{errors, plummer, scratch};
use super::validator::Validator;

const ALL: [&str; 15] = [
    "modes",
    "condense",
    "frf",
    "bearing",
    "run",
    "analyze",
    "chart",
    "stability",
    "sweep",
    "dataset",
    "verify",
    "inspect",
    "init",
    "export",
    "report",
];

/// What the program prints as JSON; an answer that is bad is printed too.
fn printed(folder: &Path, words: &[&str]) -> Value {
    let output = plummer(folder, words);
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    serde_json::from_str(&text).unwrap_or_else(|error| {
        panic!("{words:?}: {error}: {}", errors(&output));
    })
}

fn schema(folder: &Path, command: &str) -> Value {
    printed(folder, &["schema", "--results", command])
}

/// Checks a result, and that it is not valid without any of its keys nor with a value of another kind in its place.
fn check(schema: &Value, result: &Value, what: &str) {
    let validator = Validator::new(schema);
    assert_eq!(validator.check(result), Ok(()), "{what}");
    let mut refused = 0;
    for key in result.as_object().unwrap().keys() {
        let mut without = result.clone();
        without.as_object_mut().unwrap().remove(key);
        let mut other = result.clone();
        other[key] = json!({ "of": [null] });
        assert!(validator.check(&other).is_err(), "{what}: {key}");
        refused += usize::from(validator.check(&without).is_err());
    }
    // tables and digests of arrays belong to some results only, a difference or what a section says to some commands only
    let optional = ["tables", "arrays", "table_1_stiffness", "formulations"];
    // what a run of a bearing in its plane has, and one in space has not
    let in_plane = ["equilibrium", "defect_orders"];
    let required = result.as_object().unwrap().keys();
    let required = required.filter(|key| !optional.contains(&key.as_str()));
    let required = required.filter(|key| !(what.starts_with("run ") && in_plane.contains(&key.as_str())));
    assert_eq!(refused, required.count(), "{what}");
}

#[test]
fn what_commands_print_is_valid() {
    let folder = scratch("results-schema");
    let at = |path: &str| format!("{}/{path}", env!("CARGO_MANIFEST_DIR"));
    let (ring, impact, beam) =
        (at("examples/housings/ring.toml"), at("examples/scenes/impact.toml"), at("examples/tadina2011/beam.toml"));
    let mesh = at("meshes/ring_6_9.msh");
    let small = ["ring.nodes=12", "accuracy.band_hz=[0,160000]", "transient.end=0.13e-3", "transient.ensemble.runs=2"];
    let two = at("examples/datasets/two_machines.toml");
    let smooth = at("examples/scenes/smooth.toml");
    let mut chart = vec!["chart", &smooth, "--quick", "--only", "accuracy"];
    chart.extend(small.iter().flat_map(|set| ["--set", set]));
    let vary = ["--vary", "ring.nodes=36,48", "--command", "modes"];
    for (command, words) in [
        ("modes", vec!["modes", &ring]),
        ("modes", vec!["modes", &impact]),
        ("condense", vec!["condense", &ring, "--compare-full"]),
        ("bearing", vec!["bearing", &impact]),
        ("run", vec!["run", &ring]),
        ("run", vec!["run", &impact]),
        ("run", vec!["run", &impact, "--explain"]),
        ("analyze", vec!["analyze", "out/impact"]),
        ("analyze", vec!["analyze", "out/impact", "out/ring"]),
        ("chart", chart),
        ("sweep", [&["sweep", &beam], &vary[..]].concat()),
        ("sweep", [&["sweep", &beam, "--slurm", "--out", "out/jobs"], &vary[..]].concat()),
        ("dataset", vec!["dataset", &two, "--count", "1", "--set", "recorder.duration_s=0.05"]),
        ("verify", vec!["verify"]),
        ("inspect", vec!["inspect", &mesh, "--length-unit", "mm"]),
        ("init", vec!["init", &mesh, "--length-unit", "mm"]),
        ("init", vec!["init", "--list-bearings"]),
        ("init", vec!["init", "--list-materials"]),
        ("export", vec!["export", &ring, "--to", "mtx"]),
        ("report", vec!["report", "out/impact"]),
    ] {
        let result = printed(&folder, &[&words[..], &["--json"]].concat());
        check(&schema(&folder, command), &result, &words.join(" "));
    }
}

/// Every property of a schema, wherever it stands; the one key of an alternative is described with it.
fn properties<'a>(schema: &'a Value, found: &mut Vec<(&'a String, &'a Value)>) {
    match schema {
        Value::Array(items) => items.iter().for_each(|item| properties(item, found)),
        Value::Object(keywords) => {
            let own = keywords.get("properties").and_then(Value::as_object);
            found.extend(own.into_iter().flatten());
            for (keyword, part) in keywords {
                match (keyword.as_str(), part) {
                    ("oneOf", Value::Array(alternatives)) => {
                        let inside = alternatives.iter().map(|one| &one["properties"]);
                        inside.for_each(|part| properties(part, found));
                    }
                    _ => properties(part, found),
                }
            }
        }
        _ => {}
    }
}

#[test]
fn every_key_says_what_it_is() {
    let folder = scratch("results-schema-keys");
    for command in ALL {
        let schema = schema(&folder, command);
        assert_eq!(schema["title"], format!("result of plummer {command}"));
        let mut found = Vec::new();
        properties(&schema, &mut found);
        assert!(found.len() > 5, "{command}: {found:?}");
        for (key, property) in found {
            let text = property["description"].as_str().unwrap_or_default();
            assert!(!text.is_empty() && !text.contains("`None`"), "{command}: {key}");
        }
    }
}
