//! Groups that a mesh lacks or names twice: CAD entities in their place, and elements that are left out.
//!
//! Goal: `init` and `modes` take such meshes without an edit, and say what they took and what they left out.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::common::{errors, plummer, scratch};
use super::tube::Tube;

/// A tube whose elements have no physical group, the bore in two halves: surfaces 2 and 4.
fn nameless() -> String {
    let text = Tube::default().msh();
    let (_, body) = text.split_once("$EndPhysicalNames\n").unwrap();
    let (nodes, elements) = body.split_once("$Elements\n").unwrap();
    let mut bore = 0;
    let lines = elements.lines().map(|line| {
        let words: Vec<&str> = line.split(' ').collect();
        match words[..] {
            [tag, kind, "2", _, entity, ref rest @ ..] if !rest.is_empty() => {
                bore += usize::from(entity == "2");
                // 36 quadrilaterals a row
                let half = if entity == "2" && (bore - 1) % 36 >= 18 { "4" } else { entity };
                format!("{tag} {kind} 2 0 {half} {}", rest.join(" "))
            }
            _ => line.to_owned(),
        }
    });
    let lines = lines.collect::<Vec<_>>().join("\n");
    format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n{nodes}$Elements\n{lines}\n")
}

fn json(folder: &Path, words: &[&str]) -> Value {
    let output = plummer(folder, &[words, &["--json"]].concat());
    assert_eq!(output.status.code(), Some(0), "{words:?}: {}", errors(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn cad_entities_stand_in_for_physical_groups() {
    let folder = scratch("groups-none");
    fs::write(folder.join("a.msh"), nameless()).unwrap();
    let seen = json(&folder, &["inspect", "a.msh"]);
    let surfaces = seen["surfaces"].as_array().unwrap();
    let names: Vec<&str> = surfaces.iter().map(|own| own["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["surface 2", "surface 3", "surface 4"]);
    assert_eq!((&surfaces[0]["shape"], &surfaces[0]["hole"]), (&"cylinder".into(), &true.into()));
    assert!((surfaces[0]["diameter"].as_f64().unwrap() - 12.0).abs() < 1e-9);
    assert!((surfaces[0]["turn"].as_f64().unwrap() - 0.5).abs() < 1e-9);
    assert_eq!(surfaces[1]["hole"], false);
    let found = json(&folder, &["init", "a.msh", "--length-unit", "mm"]);
    assert_eq!(found["bore"]["group"], "surfaces 2, 4");
    assert!((found["bore"]["turn"].as_f64().unwrap() - 1.0).abs() < 1e-9);
    assert_eq!(found["parts"], serde_json::json!([["volume 1", "aluminium"]]));
    let modes = json(&folder, &["modes", "a.toml", "--threads", "1"]);
    assert_eq!(modes["rigid_modes"], 6);
    // the same tube with names
    fs::write(folder.join("named.msh"), Tube::default().msh()).unwrap();
    json(&folder, &["init", "named.msh", "--length-unit", "mm"]);
    let set = ["--set", "housing.supports=[]", "--threads", "1"];
    let named = json(&folder, &[&["modes", "named.toml"], &set[..]].concat());
    let hz = |of: &Value, mode: usize| of["frequencies_hz"][mode].as_f64().unwrap();
    assert!((hz(&modes, 6) / hz(&named, 6) - 1.0).abs() < 1e-9);
    // one that is not there
    let set = ["modes", "a.toml", "--force", "--set", "ring.tie.group=surface 9"];
    let output = plummer(&folder, &set);
    assert_eq!(output.status.code(), Some(2));
    let expected =
        "`ring.tie.group` is \"surface 9\", expected one of `volume 1`, `surface 2`, `surface 3`, `surface 4`";
    assert!(errors(&output).contains(expected), "{}", errors(&output));
}

#[test]
fn a_name_means_the_dimension_of_its_key() {
    let folder = scratch("groups-twice");
    let text = Tube::default().msh().replace("3 1 \"housing\"", "3 1 \"bore\"");
    fs::write(folder.join("a.msh"), text).unwrap();
    let found = json(&folder, &["init", "a.msh", "--length-unit", "mm"]);
    assert_eq!(found["parts"], serde_json::json!([["bore", "aluminium"]]));
    assert_eq!(found["bore"]["group"], "bore");
    let modes = json(&folder, &["modes", "a.toml", "--threads", "1"]);
    assert_eq!(modes["rigid_modes"], 0);
}

/// A line from a node to itself, a face of two nodes, and a point away from the body.
#[test]
fn what_no_body_needs_is_left_out() {
    let folder = scratch("groups-left");
    let text = Tube::default().msh();
    let add = |text: &str, elements: &[&str]| {
        let (start, rest) = text.split_once("$Elements\n").unwrap();
        let (count, rest) = rest.split_once('\n').unwrap();
        let count = count.parse::<usize>().unwrap() + elements.len();
        let rest = rest.replace("$EndElements", &format!("{}\n$EndElements", elements.join("\n")));
        let (nodes, list) = start.split_once("$Nodes\n432\n").unwrap();
        format!("{nodes}$Nodes\n433\n433 0 0 99\n{list}$Elements\n{count}\n{rest}")
    };
    let lines = ["9001 1 2 0 7 1 1", "9002 15 2 0 8 433", "9003 2 2 9 9 1 1 2"];
    fs::write(folder.join("a.msh"), add(&text, &lines)).unwrap();
    json(&folder, &["init", "a.msh", "--length-unit", "mm"]);
    let modes = plummer(&folder, &["modes", "a.toml", "--threads", "1"]);
    assert_eq!(modes.status.code(), Some(0), "{}", errors(&modes));
    for told in [
        "a.msh: 2 elements have a node twice and are left out (the first is element 9001)",
        "a.msh: 1 element is on nodes that no volume element has and is left out (the first is element 9002)",
    ] {
        let said = String::from_utf8_lossy(&modes.stdout);
        assert!(said.contains(told), "{said}");
    }
    // a face of the bore, and an element of the body
    for (line, told) in [
        ("9001 2 2 2 2 1 1 2", "group \"bore\" in a.msh: its element 9001 has a node twice; the tie needs whole faces"),
        ("9001 4 2 1 1 1 1 2 3", "element 9001 has the node 1 twice: expected different nodes"),
    ] {
        fs::write(folder.join("a.msh"), add(&text, &[line])).unwrap();
        let modes = plummer(&folder, &["modes", "a.toml", "--force"]);
        assert_eq!(modes.status.code(), Some(2), "{line}");
        assert!(errors(&modes).contains(told), "{}", errors(&modes));
    }
}

/// Of one body in no group, in the mesh's own unit; and of shells no more than that.
#[test]
fn a_bad_body_and_shells_are_refused_in_their_own_words() {
    let folder = scratch("groups-bad");
    let mesh = |nodes: &str, elements: &str| {
        format!(
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n{nodes}\n$EndNodes\n$Elements\n2\n{elements}\n$EndElements\n"
        )
    };
    let folded = mesh("1 0 0 0\n2 1 0 0\n3 1 1 0\n4 .9 .5 0", "1 2 2 0 1 1 2 3\n2 2 2 0 1 1 4 3");
    fs::write(folder.join("folded.msh"), folded).unwrap();
    let output = plummer(&folder, &["inspect", "folded.msh"]);
    let told = errors(&output);
    assert_eq!(output.status.code(), Some(1));
    assert!(told.contains("error: elements of the mesh lie in one another") && told.contains("unit^2"), "{told}");
    assert!(
        told.contains("help: mesh the geometry again") && !told.contains(" m^2") && !told.contains("cut"),
        "{told}"
    );
    let shells = mesh("1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 0 1", "1 2 2 0 1 1 2 3\n2 2 2 0 2 1 2 4");
    fs::write(folder.join("shells.msh"), shells).unwrap();
    let output = plummer(&folder, &["inspect", "shells.msh"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty() && errors(&output).starts_with("error: shells.msh: the mesh is of surfaces"));
}

/// What stands in the place of a group's name, in editors.
#[test]
fn the_schema_says_what_a_group_may_be() {
    let schema = plummer(Path::new("."), &["schema"]);
    let schema = String::from_utf8_lossy(&schema.stdout).into_owned();
    assert!(
        schema.contains("a physical group, a set, or CAD entities") && !schema.contains("physical group of the mesh")
    );
}
