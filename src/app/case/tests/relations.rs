//! A case against its variants, the command that asks for it, and the groups of its mesh.

use super::{FULL, read};
use crate::app::case::{Case, Linearise, Purpose};

#[test]
fn variants_are_read_with_the_command_lines_keys() {
    let case = read(FULL, &["ring.nodes=36"]).unwrap();
    let variants = case.variants().unwrap();
    assert_eq!(variants.len(), 1);
    assert_eq!(variants[0].what, "one ball fewer");
    let variant = &variants[0].case;
    assert_eq!(variant.bearing.as_ref().unwrap().balls, 6);
    assert_eq!(variant.ring.as_ref().unwrap().nodes, 36);
    assert!(variant.modes.variants.is_empty());
}

#[test]
fn a_bad_variant_is_found_when_the_case_is_read() {
    let error = read(&FULL.replace("bearing.balls=6", "bearing.bals=6"), &[]).unwrap_err();
    let line = 1 + FULL.lines().position(|text| text.contains("one ball fewer")).unwrap();
    assert_eq!(
        error.to_string(),
        format!(
            "folder/case.toml:{line}: variant \"one ball fewer\": \
             --set bearing.bals=6: unknown key `bearing.bals`"
        )
    );
    assert!(error.help().unwrap().starts_with("did you mean `balls`?"));
}

#[test]
fn a_command_names_the_table_that_it_lacks() {
    let case = read(FULL, &[]).unwrap();
    case.ready_for(Purpose::Run).unwrap();
    case.ready_for(Purpose::Modes).unwrap();
    type Removal = (&'static str, fn(&mut Case));
    let removals: [Removal; 6] = [
        ("[bearing]", |case| case.bearing = None),
        ("[shaft]", |case| case.shaft = None),
        ("[speed]", |case| case.speed = None),
        ("[transient]", |case| case.transient = None),
        ("[[sensors]]", |case| case.sensors.clear()),
        ("a support in [housing] or [ring]", |case| {
            case.housing = None;
            case.ring.as_mut().unwrap().supports.clear();
        }),
    ];
    for (table, remove) in removals {
        let mut poorer = case.clone();
        remove(&mut poorer);
        for (purpose, command) in [(Purpose::Run, "run"), (Purpose::Chart, "chart")] {
            assert_eq!(
                poorer.ready_for(purpose).unwrap_err().to_string(),
                format!("folder/case.toml: `{command}` needs {table}, which the case file lacks")
            );
        }
    }
    let mut poorer = case.clone();
    poorer.ring = None;
    assert_eq!(
        poorer.ready_for(Purpose::Modes).unwrap_err().to_string(),
        "folder/case.toml: `modes.linearise = \"static\"` needs [ring], which the case file lacks"
    );
    poorer.modes.linearise = Linearise::None;
    poorer.ready_for(Purpose::Modes).unwrap();
}

#[test]
fn a_group_that_the_mesh_lacks_is_named_with_the_nearest() {
    let case = read(FULL, &[]).unwrap();
    let all = ["case", "feet", "lower", "rim", "lid", "bore", "top", "lid seat", "case seat", "plug"];
    let groups: Vec<String> = all.iter().map(|&name| name.to_owned()).collect();
    case.check_groups(&groups).unwrap();
    for (missing, key) in [
        ("case", "housing.parts[0].group"),
        ("feet", "housing.supports[0].group"),
        ("lid", "housing.masses[0].group"),
        ("plug", "housing.links[2].between"),
        ("bore", "ring.tie.group"),
        ("top", "sensors[0].group"),
    ] {
        let mut groups = groups.clone();
        groups.iter_mut().filter(|name| *name == missing).for_each(|name| name.push('s'));
        let error = case.check_groups(&groups).unwrap_err();
        let message = error.to_string();
        let (place, named) = message.split_once(": ").unwrap();
        assert!(named.starts_with(&format!("`{key}` is \"{missing}\", expected one of ")), "{message}");
        assert!(error.help().unwrap().starts_with(&format!("did you mean `{missing}s`?")), "{error:?}");
        let line: usize = place.rsplit(':').next().unwrap().parse().unwrap();
        assert!(FULL.lines().nth(line - 1).unwrap().contains(missing));
    }
}
