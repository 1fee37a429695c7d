//! The JSON Schema of the case file against the reader of case files.
//!
//! Goal: what the reader takes the schema takes; what is misspelt, of the wrong kind, missing or too much, both refuse; the schema
//!   names the keys that the reader knows, each of them and no others.
//! Sketch: a validator of the keywords that the schema uses (draft 07); a keyword that it does not know fails the test.

use std::fs;
use std::path::{Path, PathBuf};

use plummer::app::case::{Case, CaseError, Source};
use serde_json::{Value, json};

use super::common::{errors, plummer, scratch};
use super::validator::Validator;

const FULL: &str = include_str!("../../src/app/case/full.toml");

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(text: &str, set: &[&str]) -> Result<Case, CaseError> {
    Case::from_source(Source {
        path: PathBuf::from("folder/case.toml"),
        text: text.to_owned(),
        set: set.iter().map(|&argument| argument.to_owned()).collect(),
    })
}

fn as_json(text: &str) -> Value {
    toml::from_str(text).unwrap()
}

/// All files of this ending below a folder.
fn files(folder: &Path, ending: &str, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files(&path, ending, found);
        } else if path.extension().is_some_and(|found| found == ending) {
            found.push(path);
        }
    }
}

/// The shipped cases; specifications of data sets are none.
fn cases() -> Vec<PathBuf> {
    let mut found = Vec::new();
    files(&root().join("examples"), "toml", &mut found);
    found.retain(|path| !fs::read_to_string(path).unwrap().contains("\n[[machines]]\n"));
    assert!(found.len() > 20, "{found:?}");
    found
}

#[test]
fn every_shipped_case_is_valid() {
    let schema = Case::schema();
    let validator = Validator::new(&schema);
    let mut built_in = Vec::new();
    files(&root().join("src"), "toml", &mut built_in);
    for path in cases().into_iter().chain(built_in) {
        let text = fs::read_to_string(&path).unwrap();
        let result = validator.check(&as_json(&text));
        assert_eq!(result, Ok(()), "{}", path.display());
    }
}

/// The echo of a case has its defaults filled in: the other forms of the same keys.
#[test]
fn what_the_reader_writes_is_valid() {
    let schema = Case::schema();
    let validator = Validator::new(&schema);
    for path in cases() {
        let case = Case::load(&path, &[]).unwrap();
        let echo = serde_json::to_value(&case).unwrap();
        assert_eq!(validator.check(&echo), Ok(()), "{}", path.display());
    }
}

/// Values of every other form that a key has, taken by both.
#[test]
fn other_forms_are_valid() {
    for set in [
        "damping={modal=0.03}",
        "damping={alpha=1,beta=1e-8}",
        "bearing.slip={profile=[{time=0,slip=0.1},{time=1,slip=0}]}",
        "bearing.slip={profile=[{hz=0,slip=0.1}]}",
        "bearing=\"625\"",
        "bearing=625",
        "bearing={name='625',radial_play=1e-6}",
        "bearing.slip=0",
        "bearing.stiffness=hertz",
        "bearing.race_material=steel",
        "bearing.waviness=[{on='outer',order=9,amplitude=1e-7}]",
        "bearing.defects=[{on='ball',ball=0,flat_radius=2e-3,depth=1e-5}]",
        "bearing.defects=[{on='ball',ball=0,flat_radius=2e-3,depth=1e-5,profile='in-plane',angle_deg=3}]",
        "bearing.defects=[{on='inner',angle_deg=270,profile={csv='a.csv'}}]",
        "bearing.defects=[{on='inner',angle_deg=270,length=1e-3,depth=1e-5}]",
        "shaft.loads=[{profile=[{time=0,force=[0,1]}]}]",
        "modes={}",
        "modes={band_hz=[0,1e4]}",
        "modes={count=3,ball_pass=true,linearise='static'}",
        "housing.supports.0={group='a',fixed='all'}",
        "condense.fixed_interface_modes=auto",
        "condense.fixed_interface_modes=3",
        "condense.interface_modes=none",
        "condense.interface_modes=3",
        "transient.step=auto",
        "transient.step=1",
        "transient.modes=all",
        "analysis={band_hz='kurtogram'}",
        "analysis={band_hz=[1e3,2e3],whiten=true,energy=false}",
        "analysis.scalogram={from=1,to=2,band_hz=[1,2e3]}",
        "sensors=[{name='a',node=3,direction=[0,1,0]}]",
        "frf={from=[{ring_deg=3,direction=[0,1,0]}],check_hz=[1,2],band_hz=[0,1e3]}",
        "housing.links=[]",
        "housing.overlap=refuse",
        "accuracy={band_hz=[0,1000]}",
    ] {
        let case = read(FULL, &[set]);
        assert!(case.is_ok(), "{set}: {}", case.unwrap_err());
        assert_eq!(checked(set), Ok(()), "{set}");
    }
    let superelement = "[housing]\nsuperelement = \"s.npz\"\n[ring]\nsections = [{ material = \"steel\", area = 5e-6, inertia = \
        9e-13, radius = 5.3e-3 }]\n[[sensors]]\nname = \"a\"\nrecovered = \"P1\"\n";
    assert!(read(superelement, &[]).is_ok());
    let schema = Case::schema();
    assert_eq!(Validator::new(&schema).check(&as_json(superelement)), Ok(()));
}

/// What the schema says to [`FULL`] with one value set.
fn checked(set: &str) -> Result<(), String> {
    let schema = Case::schema();
    let (key, value) = set.split_once('=').unwrap();
    let value: Value = toml::from_str::<Value>(&format!("value={value}"))
        .map_or_else(|_| json!(value), |table| table["value"].clone());
    let mut case = as_json(FULL);
    let mut place = &mut case;
    for step in key.split('.') {
        place = match step.parse::<usize>() {
            Ok(index) => &mut place[index],
            Err(_) => &mut place[step],
        };
    }
    *place = value;
    Validator::new(&schema).check(&case)
}

#[test]
fn wrong_cases_are_refused_by_both() {
    for set in [
        // unknown keys
        "transcient={end=1}",
        "bearing.ball_raduis=1e-3",
        "housing.parts.0={grup='case',material='steel'}",
        "ring.sections.0.colour=1",
        "materials.printed.stiff=true",
        "transient.step={seconds=1}",
        "condense.interface={edge='a'}",
        "bearing.stiffness={inner=1,outer=2,other=3}",
        // wrong kinds
        "title=3",
        "ring.shear=1",
        "bearing.balls=7.5",
        "bearing.balls=-3",
        "bearing.balls='seven'",
        "bearing.stiffness=3e9",
        "sensors=1",
        "materials=1",
        "transient.modes=1.5",
        "transient.output_hz='fast'",
        "housing.plane=[1]",
        "speed.profile={time=0,hz=1}",
        // wrong names
        "ring.bond=slipp",
        "housing.length_unit=feet",
        "transient.method=euler",
        "housing.supports.0={group='a',fixed=['up']}",
        "housing.supports.0={group='a',fixed='up'}",
        "bearing.defects.0.on=shaft",
        "bearing.defects.0.profile=deep",
        "analysis={band_hz='kurtgram'}",
        // arrays of another length
        "shaft.gravity=[0]",
        "shaft.gravity=[0,-1,0]",
        "ring.tie.centre=[0,0]",
        "materials.printed.young=[1e9,1e9,1e9,1e9]",
        "materials.printed.young=[1e9,1e9]",
        "materials.printed.poisson=[0.3,0.3,0.3,0.3]",
        "housing.links.0.between=['a']",
        "accuracy.band_hz=[0]",
        // missing keys
        "housing={mesh='a.msh',length_unit='mm'}",
        "housing={length_unit='mm',parts=[{group='a',material='steel'}]}",
        "bearing.defects.0={angle_deg=270,length=1e-3,depth=1e-5}",
        "bearing.defects.0={on='outer',length=1e-3,depth=1e-5}",
        "bearing.defects.0={on='outer',angle_deg=270,length=1e-3,depth=1e-5,profile='surface'}",
        "bearing.defects.0={on='ball',ball=1,depth=1e-5}",
        "bearing={balls=7}",
        "ring={nodes=72}",
        "transient={end=1}",
        "sensors.0={name='a',ring_deg=1}",
        "sensors.0={name='a',direction=[0,1,0]}",
        "modes.compare.0={what='a'}",
        // keys that exclude each other
        "housing={superelement='a.npz',mesh='a.msh'}",
        "housing.supports.0={group='a'}",
        "housing.supports.0={group='a',fixed=['x'],radial=1}",
        "housing.supports.0={group='a',fixed=['x'],per='node'}",
        "housing.supports.0={group='a',fixed=['x'],spring={x=1},per='node'}",
        "housing.links.0={between=['a','b'],tie=false}",
        "housing.links.0={between=['a','b'],tie=true,per='node'}",
        "materials.printed={young=1e9,poisson=0.3,density=1,x_axis=[1,0,0]}",
        "materials.printed={young=[1,1,1],poisson=0.3,density=1,shear=[1,1,1]}",
        "materials.printed={young=[1,1,1],poisson=[0,0,0],density=1}",
        "damping={}",
        "damping={modal=0.1,alpha=1,beta=1}",
        "damping={alpha=1}",
        "damping={beta=1}",
        "modes={count=1,up_to_hz=1}",
        "modes={band_hz=[1,2],up_to_hz=1}",
        "sensors.0={name='a',group='a',ring_deg=1,direction=[0,1,0]}",
        "sensors.0={name='a',recovered='b',direction=[0,1,0]}",
        "shaft.loads.0={force=[0,1],profile=[]}",
        "shaft.loads.0={}",
        "bearing.defects.0={on='outer',angle_deg=270,profile={csv='a.csv'},depth=1}",
        "bearing.defects.0={on='outer',angle_deg=270,length=1e-3,depth=1e-5,ball=1}",
        "bearing.defects.0={on='ball',ball=1,flat_radius=2e-3,depth=1e-5,length=1}",
        "bearing.defects.0={on='ball',ball=1,flat_radius=2e-3,depth=1e-5,profile='surface'}",
        "bearing.slip={profile=[{time=0,slip=0},{hz=1,slip=0}]}",
        "bearing.slip={profile=[{slip=0}]}",
        "bearing.slip={profile=[{time=0,hz=1,slip=0}]}",
        "condense.interface={}",
        "condense.interface={group='a',nodes=[1]}",
        "bearing.density=7850",
        "bearing={}",
        "bearing={balls=8}",
        "analysis.band_hz=[1,2]",
    ] {
        assert!(read(FULL, &[set]).is_err(), "the reader takes {set}");
        assert!(checked(set).is_err(), "the schema takes {set}");
    }
    assert!(read("title = \"a\"\n", &[]).is_err());
    let schema = Case::schema();
    assert!(Validator::new(&schema).check(&json!({ "title": "a" })).is_err());
}

/// Where a key stands, as it would be written with a value: `bearing = { defects = [{ depth = VALUE }] }`.
fn written(path: &[String], value: &str) -> String {
    path.iter().rev().enumerate().fold(value.to_owned(), |inside, (depth, step)| {
        if step == "[]" {
            format!("[{inside}]")
        } else if depth + 1 == path.len() {
            format!("{step} = {inside}\n")
        } else {
            format!("{{ {step} = {inside} }}")
        }
    })
}

/// Every table of the schema, as the path to it, with its keys: from every branch.
fn tables(schema: &Value) -> Vec<(Vec<String>, Vec<String>)> {
    fn walk(root: &Value, at: &Value, path: &[String], found: &mut Vec<(Vec<String>, Vec<String>)>) {
        if let Some(target) = at["$ref"].as_str() {
            let pointer = target.strip_prefix('#').unwrap();
            walk(root, root.pointer(pointer).unwrap(), path, found);
        }
        for list in ["anyOf", "oneOf", "allOf"] {
            for branch in at[list].as_array().into_iter().flatten() {
                walk(root, branch, path, found);
            }
        }
        let below = |step: &str| [path, &[step.to_owned()]].concat();
        if at["items"].is_object() {
            walk(root, &at["items"], &below("[]"), found);
        }
        if at["additionalProperties"].is_object() {
            walk(root, &at["additionalProperties"], &below("anything"), found);
        }
        if at["additionalProperties"] == json!(false) {
            let keys = at["properties"].as_object().unwrap();
            found.push((path.to_vec(), keys.keys().cloned().collect()));
            for (key, schema) in keys {
                walk(root, schema, &below(key), found);
            }
        }
    }
    let mut found = Vec::new();
    walk(schema, schema, &[], &mut found);
    found
}

#[test]
fn keys_of_the_schema_are_those_of_the_reader() {
    let tables = tables(&Case::schema());
    assert!(tables.len() > 40, "{}", tables.len());
    for (path, keys) in &tables {
        // the reader lists its keys when it meets one that it does not know
        let below: Vec<String> = [path.as_slice(), &["unheard_of".to_owned()]].concat();
        // an array may have to have several items before its first is looked at
        let text = written(&below, "1");
        let known = match read(&text, &[]) {
            Err(error) if error.to_string().contains(": unknown key `") => error.valid,
            Err(other) if path.last().is_some_and(|step| step == "[]") => {
                // two items: damping.ratios
                let twice = text.replace("[{ unheard_of = 1 }]", "[{ unheard_of = 1 }, { unheard_of = 1 }]");
                match read(&twice, &[]) {
                    Err(error) if error.to_string().contains(": unknown key `") => error.valid,
                    _ => panic!("{text}: {other}"),
                }
            }
            other => panic!("{text}: {other:?}"),
        };
        let sorted = |keys: &[String]| {
            let mut keys = keys.to_vec();
            keys.sort();
            keys
        };
        assert_eq!(sorted(keys), sorted(&known), "{path:?}");
    }
}

#[test]
fn keys_have_descriptions() {
    fn without(schema: &Value, path: &str, found: &mut Vec<String>) {
        if let Some(properties) =
            schema["properties"].as_object().filter(|_| schema["additionalProperties"] == json!(false))
        {
            for (key, schema) in properties {
                if !schema["description"].is_string() {
                    found.push(format!("{path}.{key}"));
                }
                let text = schema["description"].as_str().unwrap_or_default();
                assert!(!text.contains("`None`") && !text.contains("[`"), "{path}.{key}: {text}");
            }
        }
        match schema {
            Value::Object(map) => map.iter().for_each(|(key, value)| without(value, &format!("{path}/{key}"), found)),
            Value::Array(items) => items.iter().for_each(|item| without(item, path, found)),
            _ => {}
        }
    }
    let mut found = Vec::new();
    without(&Case::schema(), "", &mut found);
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
fn the_program_prints_the_schema_and_nothing_else() {
    let folder = scratch("schema");
    let first = plummer(&folder, &["schema"]);
    assert_eq!(first.status.code(), Some(0), "{}", errors(&first));
    assert_eq!(errors(&first), "");
    let text = String::from_utf8(first.stdout).unwrap();
    let printed: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(printed, Case::schema());
    assert_eq!(printed["$schema"], "http://json-schema.org/draft-07/schema#");
    for words in [&["schema"][..], &["schema", "--json"], &["schema", "--quiet"]] {
        let again = plummer(&folder, words);
        assert_eq!(String::from_utf8(again.stdout).unwrap(), text, "{words:?}");
    }
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
}

/// The validator is tested by breaking what it checks.
#[test]
fn the_validator_refuses_what_each_keyword_excludes() {
    for (schema, good, bad) in [
        (json!({ "type": "integer" }), json!(3), json!(3.5)),
        (json!({ "type": "number" }), json!(3), json!("3")),
        (json!({ "type": ["string", "boolean"] }), json!(true), json!(1)),
        (json!({ "enum": ["a", true] }), json!(true), json!(false)),
        (json!({ "const": 3 }), json!(3), json!(4)),
        (json!({ "minimum": 0 }), json!(0), json!(-1)),
        (json!({ "items": { "type": "number" } }), json!([1, 2]), json!([1, "a"])),
        (json!({ "minItems": 2 }), json!([1, 2]), json!([1])),
        (json!({ "maxItems": 2 }), json!([1, 2]), json!([1, 2, 3])),
        (json!({ "maxProperties": 1 }), json!({ "a": 1 }), json!({ "a": 1, "b": 2 })),
        (json!({ "required": ["a"] }), json!({ "a": 1 }), json!({ "b": 1 })),
        (json!({ "properties": { "a": { "type": "number" } } }), json!({ "b": "x" }), json!({ "a": "x" })),
        (json!({ "properties": { "a": true }, "additionalProperties": false }), json!({ "a": 1 }), json!({ "b": 1 })),
        (json!({ "additionalProperties": { "type": "number" } }), json!({ "a": 1 }), json!({ "a": "x" })),
        (json!({ "dependencies": { "a": ["b"] } }), json!({ "b": 1 }), json!({ "a": 1 })),
        (json!({ "not": { "required": ["a"] } }), json!({}), json!({ "a": 1 })),
        (json!({ "allOf": [{ "minimum": 0 }, { "type": "integer" }] }), json!(1), json!(-1)),
        (json!({ "anyOf": [{ "type": "number" }, { "type": "string" }] }), json!("a"), json!(true)),
        (
            json!({ "oneOf": [{ "required": ["a"] }, { "required": ["b"] }] }),
            json!({ "a": 1 }),
            json!({ "a": 1, "b": 1 }),
        ),
        (json!({ "$ref": "#/definitions/n", "definitions": { "n": { "type": "number" } } }), json!(1), json!("a")),
    ] {
        let validator = Validator::new(&schema);
        assert_eq!(validator.check(&good), Ok(()), "{schema}");
        assert!(validator.check(&bad).is_err(), "{schema}");
    }
    let unknown = json!({ "pattern": "a" });
    assert!(Validator::new(&unknown).check(&json!("a")).is_err());
}
