//! A bearing by its name: every command that reads a case takes it, and says which of its numbers no maker publishes.

use super::common::{errors, plummer, scratch};
use super::tube::Tube;
use plummer::app::case::Case;
use serde_json::Value;
use std::fs;
use std::process::Output;

const CASE: &str = r#"
bearing = "6204"
[ring]
nodes = 24
sections = [{ material = "bearing steel", area = 4.2e-5, inertia = 8e-11, radius = 21.9e-3 }]
outer_radius = 23.5e-3
supports = [{ from_deg = 0, to_deg = 360, spring = { x = 1e8, y = 1e8 }, per = "total" }]
[shaft]
mass = 2.0
[damping]
modal = 0.03
[speed]
profile = [{ time = 0.0, hz = 25.0 }]
[[sensors]]
name = "P1"
ring_deg = 90
direction = [0, 1, 0]
[modes]
count = 4
linearise = "static"
[transient]
end = 0.005
output_hz = 10000
"#;

/// The summary, in which warnings stand, and the errors.
fn said(output: &Output) -> String {
    format!("{}{}", String::from_utf8_lossy(&output.stdout), errors(output))
}

#[test]
fn commands_take_a_bearing_by_its_name() {
    let folder = scratch("named-bearing");
    fs::write(folder.join("named.toml"), CASE).unwrap();
    let told = "warning: bearing 6204: balls and diameters are those of GMN, High precision ball bearings, catalogue 4000 0813 EN (2013), \
                pp. 52-55; groove radii of 0.52 (inner) and 0.53 (outer) of the ball's diameter are usual ones, no maker's; \
                a radial play of 6.25 µm is half the middle of the clearance of group N";
    for command in ["modes", "run"] {
        let output = plummer(&folder, &[command, "named.toml"]);
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        assert!(said(&output).contains(told), "{command}: {}", said(&output));
        let result = fs::read_to_string(folder.join(format!("out/named/{command}.json"))).unwrap();
        let result: Value = serde_json::from_str(&result).unwrap();
        assert!(result.to_string().contains("those of GMN"), "{command}");
    }
    // a key beside the name goes before it, and a name that is none has near ones
    let output = plummer(&folder, &["modes", "named.toml", "--set", "bearing.radial_play=1e-6", "--force"]);
    assert!(said(&output).contains("no maker's; give your own in [bearing]"), "{}", said(&output));
    let output = plummer(&folder, &["modes", "named.toml", "--set", "bearing=6240"]);
    assert_eq!(output.status.code(), Some(2));
    let text = errors(&output);
    assert!(
        text.contains("--set bearing=6240: `bearing.name`: found \"6240\", expected a bearing of the catalogue"),
        "{text}"
    );
    // another size is no misprint
    assert!(!text.contains("did you mean"), "{text}");
}

/// Of a bore of 47 mm, `init` takes a 6204. Every command that knows both refuses a bearing of another outer diameter.
#[test]
fn a_bearing_of_another_size_than_the_bore_is_refused() {
    let folder = scratch("bearing-and-bore");
    let tube = Tube { inner: 23.5, outer: 35.0, length: 14.0, ..Tube::default() };
    fs::write(folder.join("a.msh"), tube.msh()).unwrap();
    assert_eq!(plummer(&folder, &["init", "a.msh", "--length-unit", "mm"]).status.code(), Some(0));
    let frf = "frf={from=[{ring_deg=270,direction=[0,1,0]}]}";
    let nearest = "help: nearest of the catalogue: 6005 (47 mm), 6204 (47 mm), 6303 (47 mm); is ";
    for command in ["modes", "condense", "frf", "run", "chart"] {
        for (set, place, found, of, unit) in [
            ("bearing=6304", "--set bearing=6304", "6304, 52", "`ring.outer_radius`", "it right?"),
            ("bearing=6203", "--set bearing=6203", "6203, 40", "the bore \"bore\"", "housing.length_unit right?"),
        ] {
            let output = plummer(&folder, &[command, "a.toml", "--set", set, "--set", frf]);
            assert_eq!(output.status.code(), Some(2), "{command}: {}", errors(&output));
            let told = format!(
                "error: {place}: `bearing.name`: found the outer diameter of {found} mm, expected that of {of}, 47 mm, within 1 %\n{nearest}{unit}"
            );
            assert!(errors(&output).contains(&told), "{command}: {}", errors(&output));
        }
    }
    // the ring is that of the bearing, and one of the same size is taken with its own
    let area = |set: &[&str]| {
        let set: Vec<String> = set.iter().map(|&key| key.to_owned()).collect();
        let case = Case::load(folder.join("a.toml"), &set).unwrap();
        case.ring.unwrap().sections[0].area
    };
    let [own, other] = [area(&[]), area(&["bearing=6303"])];
    assert!((other / own - 1.0).abs() > 0.05, "{own} {other}");
    let inspected = plummer(&folder, &["inspect", "a.toml"]);
    assert_eq!(inspected.status.code(), Some(0), "{}", errors(&inspected));
    assert!(said(&inspected).contains("a.msh"), "{}", said(&inspected));
    let output = plummer(&folder, &["run", "a.toml", "--set", "transient.end=0.3"]);
    assert!(errors(&output).contains("help: simulate it all, `transient.end` = "), "{}", errors(&output));
    let output = plummer(&folder, &["frf", "a.toml"]);
    assert!(
        errors(&output).contains("help: add [frf] to the case file with from = [{ ring_deg = 270, "),
        "{}",
        errors(&output)
    );
}
