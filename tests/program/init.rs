//! `plummer init` from outside: every mesh of the repository, and meshes made for what housings can be.
//!
//! Goal: the file loads, says the right bore and bearing, and `plummer modes` runs on it; what is in the way or wrong is exit code 2.

use std::fs;
use std::path::{Path, PathBuf};

use plummer::app::case::{Bearing, Case, Defect, DentProfile, Purpose, Source};
use serde_json::Value;

use super::common::{errors, plummer, scratch};
use super::tube::Tube;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn meshes() -> Vec<PathBuf> {
    let mut found = Vec::new();
    for folder in ["meshes", "tests/data"] {
        for entry in fs::read_dir(root().join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|ending| ending == "msh") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// Runs `init` in a folder and returns what it says as JSON.
fn init(folder: &Path, words: &[&str]) -> Value {
    let output = plummer(folder, &[&["init", "--json"], words].concat());
    assert_eq!(output.status.code(), Some(0), "{words:?}: {}", errors(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Everything that is commented out as a value switched on.
fn switched_on(text: &str) -> String {
    let value = |line: &str| line.starts_with('#') && !line.starts_with("# ") && !line.starts_with("#:") && line != "#";
    let lines = text.lines().map(|line| if value(line) { &line[1..] } else { line });
    lines.collect::<Vec<_>>().join("\n") + "\n"
}

/// The dent is a pit that a ball bridges, and no ball starts within its length of either end of it.
fn starts_beside_its_dent(bearing: &Bearing, name: &str) {
    let [Defect::Dent(dent)] = &bearing.defects[..] else {
        panic!("{name}: {:?}", bearing.defects);
    };
    assert_eq!(dent.profile, DentProfile::Surface, "{name}");
    assert!(dent.width.is_some_and(|width| width > dent.length), "{name}");
    for ball in 0..bearing.balls {
        let angle = bearing.first_ball_deg + 360.0 * ball as f64 / bearing.balls as f64;
        let away = (angle - dent.angle_deg + 180.0).rem_euclid(360.0) - 180.0;
        let way = away.to_radians().abs() * bearing.outer_race_radius;
        assert!(way > 1.5 * dent.length, "{name}: ball {ball} is {way} m from a dent of {} m", dent.length);
    }
}

#[test]
fn every_mesh_makes_a_case_that_loads() {
    let folder = scratch("init-every");
    let all = meshes();
    assert!(all.len() > 35, "{}", all.len());
    for mesh in all {
        let name = mesh.file_stem().unwrap().to_string_lossy().into_owned();
        let file = folder.join(format!("{name}.toml"));
        init(&folder, &[mesh.to_str().unwrap()]);
        let text = fs::read_to_string(&file).unwrap();
        assert!(text.starts_with("#:schema plummer.schema.json\n"), "{name}");
        assert!(text.lines().all(|line| line.chars().count() <= 160), "{name}");
        let case = Case::load(&file, &[]).unwrap_or_else(|error| panic!("{name}: {error}\n{text}"));
        case.ready_for(Purpose::Modes).unwrap();
        // relative to the case, and there
        let found = &case.meshed_housing().unwrap().mesh;
        assert_eq!(fs::canonicalize(found).unwrap(), fs::canonicalize(&mesh).unwrap());
        let whole = Case::from_source(Source { path: file.clone(), text: switched_on(&text), set: Vec::new() });
        let whole = whole.unwrap_or_else(|error| panic!("{name}: {error}\n{}", switched_on(&text)));
        let seats = whole.seats();
        assert!(!seats.is_empty(), "{name}");
        for seat in seats {
            starts_beside_its_dent(seat.bearing.unwrap(), &name);
            assert!(seat.ring.tie.is_some(), "{name}");
        }
        // the same mesh, the same file
        init(&folder, &[mesh.to_str().unwrap(), "--force"]);
        assert_eq!(fs::read_to_string(&file).unwrap(), text, "{name}");
    }
}

/// Against the first elastic frequency (Hz) of the same housings with the ring of the examples (Tadina & Boltezar's outer ring, area
/// 5.37e-6 m^2, second moment 8.88e-13 m^4) in place of the scaled one. The guessed ring is another, 13 % lighter and 30 % less
/// stiff, between a housing that does not feel much of it and a thin one that is half ring.
#[test]
fn modes_run_on_the_shipped_housings() {
    let folder = scratch("init-modes");
    for (name, rigid, first, within) in [
        ("pedestal", 0, 16_160.5, 0.01),
        ("pillow_block", 0, 20_609.2, 0.01),
        ("end_shield", 0, 6845.5, 0.01),
        ("ring_6_9", 3, 52_015.3, 0.04),
    ] {
        let bore = "bore";
        let mesh = root().join(format!("meshes/{name}.msh"));
        let found = init(&folder, &[mesh.to_str().unwrap(), "--length-unit", "mm"]);
        assert_eq!(found["bore"]["group"], bore, "{name}");
        assert!((found["bore"]["radius_m"].as_f64().unwrap() / 6e-3 - 1.0).abs() < 1e-6, "{name}");
        assert!(found["bearing"].is_null(), "{name}: no bearing of 12 mm is in the catalogue");
        let case = format!("{name}.toml");
        let modes = plummer(&folder, &["modes", &case, "--json", "--threads", "1"]);
        assert_eq!(modes.status.code(), Some(0), "{name}: {}", errors(&modes));
        let modes: Value = serde_json::from_slice(&modes.stdout).unwrap();
        let hz = modes["frequencies_hz"].as_array().unwrap();
        let hz: Vec<f64> = hz.iter().map(|hz| hz.as_f64().unwrap()).collect();
        assert_eq!(modes["rigid_modes"], rigid, "{name}: {hz:?}");
        let off = (hz[rigid] / first - 1.0).abs();
        assert!(off < within, "{name}: {hz:?}");
    }
}

/// Bores on one axis carry one shaft: a bearing each, which hold each other, a sensor each, and the shaft between them.
#[test]
fn several_bores_are_a_bearing_each() {
    let folder = scratch("init-several");
    for (name, labels, bearings) in [
        ("motor", ["drive bore", "rear bore"], [Some("6205"), Some("6203")]),
        ("spindle_block", ["front bore", "rear bore"], [None, None]),
    ] {
        let mesh = root().join(format!("meshes/{name}.msh"));
        let found = init(&folder, &[mesh.to_str().unwrap(), "--length-unit", "mm"]);
        for (own, (label, bearing)) in found["bearings"].as_array().unwrap().iter().zip(labels.iter().zip(bearings)) {
            assert_eq!((own["label"].as_str(), own["bearing"].as_str()), (Some(*label), bearing), "{name}");
        }
        assert_eq!(found["other_holes"], serde_json::json!([]), "{name}");
        let case = Case::load(folder.join(format!("{name}.toml")), &[]).unwrap();
        let seats = case.seats();
        assert_eq!(seats.iter().map(|seat| seat.label.as_str()).collect::<Vec<_>>(), labels, "{name}");
        let standards: Vec<Option<&str>> =
            seats.iter().map(|seat| seat.bearing.and_then(|own| own.name.as_deref())).collect();
        assert_eq!(standards, bearings, "{name}");
        assert_eq!(case.sensors.len(), 2, "{name}");
        assert_eq!(case.ready_for(Purpose::Run).is_ok(), name == "motor", "{name}");
    }
    // a bar of 17 mm, half as long again as the bearings lie apart: 195 mm
    let case = Case::load(folder.join("motor.toml"), &[]).unwrap();
    let shaft = case.shaft.as_ref().unwrap();
    let mass = 7850.0 * 0.25 * std::f64::consts::PI * 17e-3_f64.powi(2) * 195e-3;
    assert!((shaft.mass / mass - 1.0).abs() < 2e-3, "{shaft:?}");
    assert!((shaft.transverse_inertia.unwrap() / (mass * 195e-3_f64.powi(2) / 12.0) - 1.0).abs() < 1e-2, "{shaft:?}");
    assert!((shaft.centre.unwrap() - 65e-3).abs() < 1e-9, "{shaft:?}");
    let modes = plummer(&folder, &["modes", "spindle_block.toml", "--json", "--threads", "1"]);
    assert_eq!(modes.status.code(), Some(0), "{}", errors(&modes));
    let modes: Value = serde_json::from_slice(&modes.stdout).unwrap();
    assert_eq!(modes["rigid_modes"], 0);
    // a bearing that fits one bore alone goes there
    for (asked, both) in [("6304", ["6304", "6203"]), ("6203", ["6205", "6203"])] {
        let mesh = root().join("meshes/motor.msh");
        let found = init(&folder, &[mesh.to_str().unwrap(), "--bearing", asked, "--force"]);
        assert_eq!([0, 1].map(|place| found["bearings"][place]["bearing"].as_str().unwrap()), both);
    }
}

#[test]
fn a_bearing_that_fits_is_taken_and_its_contacts_can_be_loaded() {
    let folder = scratch("init-6205");
    let tube = Tube { inner: 26.0, outer: 40.0, length: 15.0, ..Tube::default() };
    fs::write(folder.join("housing.msh"), tube.msh()).unwrap();
    let found = init(&folder, &["housing.msh"]);
    assert_eq!(found["length_unit"], "mm");
    assert_eq!(found["bearing"], "6205");
    assert_eq!(found["supports"], serde_json::json!(["base"]));
    let case = Case::load(folder.join("housing.toml"), &[]).unwrap();
    case.ready_for(Purpose::Run).unwrap();
    let bearing = case.bearing.as_ref().unwrap();
    assert_eq!((bearing.balls, bearing.name.as_deref()), (9, Some("6205")));
    // GMN: 39.1 and 7.938 mm
    assert!((bearing.outer_race_radius - 0.5e-3 * (39.1 + 7.938)).abs() < 1e-9);
    assert!((bearing.play() - 6.25e-6).abs() < 1e-9, "{}", bearing.play());
    // a coarser ring than the file's, for the sake of time
    for set in ["modes.linearise=none", "modes.linearise=static"] {
        let words = ["--force", "--quiet", "--threads", "1", "--set", "ring.nodes=24"];
        let words = [&["modes", "housing.toml", "--set", set], &words[..]].concat();
        let output = plummer(&folder, &words);
        assert_eq!(output.status.code(), Some(0), "{set}: {}", errors(&output));
    }
}

/// Half a split housing, its bore along x and away from the origin, in a mesh whose nodes are off by 0.1 %.
#[test]
fn half_a_noisy_bore_along_x_away_from_the_origin() {
    let folder = scratch("init-half");
    let tube = Tube {
        inner: 26.0,
        outer: 40.0,
        length: 30.0,
        from: 180.0,
        to: 360.0,
        noise: 0.026,
        axes: [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
        centre: [100.0, 250.0, -70.0],
    };
    fs::write(folder.join("lower.msh"), tube.msh()).unwrap();
    let found = init(&folder, &["lower.msh", "--length-unit", "mm"]);
    let bore = &found["bore"];
    assert_eq!(bore["group"], "bore");
    let part = |key: &str, place: usize| bore[key][place].as_f64().unwrap();
    // nodes off by up to 0.026 mm: a centre by half a circle of some 100 of them is off by a part of that
    for (place, expected) in [0.100, 0.250, -0.070].into_iter().enumerate() {
        assert!((part("centre_m", place) - expected).abs() < 2.6e-5, "{bore}");
    }
    assert!(part("axis", 0) > 0.999_99, "{bore}");
    assert!((bore["radius_m"].as_f64().unwrap() / 26e-3 - 1.0).abs() < 1e-3, "{bore}");
    assert!((bore["turn"].as_f64().unwrap() - 0.5).abs() < 0.01, "{bore}");
    let case = Case::load(folder.join("lower.toml"), &[]).unwrap();
    let tie = case.ring.as_ref().unwrap().tie.as_ref().unwrap();
    // up stays up: the bearing's 90 degrees are the mesh's y
    assert!(tie.zero_deg[2] < -0.999, "{:?}", tie.zero_deg);
    let modes = plummer(&folder, &["modes", "lower.toml", "--quiet", "--threads", "1"]);
    assert_eq!(modes.status.code(), Some(0), "{}", errors(&modes));
}

/// Feet below the mesh's z, or beside its x, where the shaft lies along x, y or z.
#[test]
fn up_is_away_from_the_foot() {
    let folder = scratch("init-up");
    for (name, axes) in [
        ("x", [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]),
        ("y", [[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]),
        ("z", [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]),
    ] {
        let tube = Tube { inner: 26.0, outer: 40.0, length: 15.0, axes, ..Tube::default() };
        fs::write(folder.join(format!("{name}.msh")), tube.msh()).unwrap();
        init(&folder, &[&format!("{name}.msh")]);
        let text = fs::read_to_string(folder.join(format!("{name}.toml"))).unwrap();
        assert!(text.replace("\n# ", " ").contains("90 degrees point up, away from the foot"), "{text}");
        let case = Case::load(folder.join(format!("{name}.toml")), &[]).unwrap();
        let tie = case.ring.as_ref().unwrap().tie.as_ref().unwrap();
        let (a, b) = (tie.axis, tie.zero_deg);
        let ninety = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        for (place, up) in axes[1].into_iter().enumerate() {
            assert!((ninety[place] - up).abs() < 1e-9, "{name}: {tie:?}");
            assert!((case.sensors[0].direction[place] - up).abs() < 1e-9, "{name}");
        }
    }
}

#[test]
fn the_bearing_tells_the_unit() {
    let folder = scratch("init-unit");
    let tube = Tube { inner: 2.6, outer: 4.0, length: 1.5, ..Tube::default() };
    fs::write(folder.join("a.msh"), tube.msh()).unwrap();
    let found = init(&folder, &["a.msh", "--bearing", "6205-2RS"]);
    assert_eq!(found["length_unit"], "cm");
    // the same file again is no loss
    init(&folder, &["a.msh", "--bearing", "6205-2RS"]);
    let found = init(&folder, &["a.msh", "--force"]);
    assert_eq!(found["length_unit"], "mm", "by the extent");
    let found = init(&folder, &["a.msh", "--force", "--length-unit", "cm"]);
    assert_eq!(found["bearing"], "6205");
}

/// What makes no case, or no bore, is said.
#[test]
fn what_is_wrong_is_exit_code_2() {
    let folder = scratch("init-wrong");
    let mesh = |name: &str| root().join(name).to_string_lossy().into_owned();
    let ring = mesh("meshes/ring_6_9.msh");
    fs::write(folder.join("taken.toml"), "kept").unwrap();
    for (words, expected) in [
        (
            vec![ring.as_str(), "--out", "taken.toml"],
            "error: taken.toml exists\nhelp: replace it with --force, or name another file with --out\n",
        ),
        (vec![&ring, "--out", "."], "error: .: found no file name"),
        (
            vec![&ring, "--bearing", "6299"],
            "error: --bearing: found \"6299\", expected a bearing of the catalogue\nhelp: bearings here: 625, ",
        ),
        (
            vec![&ring, "--bearing", "6205", "--length-unit", "mm"],
            "error: --bearing: found the outer diameter of 6205, 52 mm, expected that of the bore \"bore\", 12 mm, within 1 %\n\
             help: nearest of the catalogue: 625 (16 mm); is --length-unit right?",
        ),
        (vec!["no.msh"], "error: "),
    ] {
        let output = plummer(&folder, &[&["init"], &words[..]].concat());
        assert_eq!(output.status.code(), Some(2), "{words:?}");
        assert!(errors(&output).starts_with(expected), "{words:?}: {}", errors(&output));
        assert!(output.stdout.is_empty());
    }
    let damaged = mesh("tests/data/damaged/node_nan.msh");
    let looked = plummer(&folder, &["inspect", &damaged]);
    let tried = plummer(&folder, &["init", &damaged]);
    assert_eq!(tried.status.code(), looked.status.code());
    assert_eq!(errors(&tried), errors(&looked));
    assert_eq!(fs::read_to_string(folder.join("taken.toml")).unwrap(), "kept");
    let names: Vec<_> = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(names.len(), 1, "{names:?}");
}

#[test]
fn what_was_found_is_said_on_standard_output() {
    let folder = scratch("init-says");
    let mesh = root().join("meshes/ring_6_9.msh");
    let output = plummer(&folder, &["init", mesh.to_str().unwrap(), "--out", "sub/ring.toml"]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    for part in [
        "length_unit = \"mm\": guess: the mesh is 18 x 18 x 0 units wide; the file does not say its unit",
        "Group \"bore\" is a circle of radius 6 mm about z, all round, its nodes on it but for round-off. No other",
        "No other group is a round hole. Round outsides: \"outer\" (radius 9 mm) and \"lower\" (radius 9 mm).",
        "No bearing of the catalogue has an outer diameter within 1 % of the bore's, 12 mm: [bearing] is a template.",
        "Parts: \"housing\" of aluminium (a guess).",
        "Nothing is held: no group is named like a support.",
        "wrote sub/ring.toml",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let case = fs::read_to_string(folder.join("sub/ring.toml")).unwrap();
    assert!(case.contains("group = \"top\""), "a point for the sensor: {case}");
    assert!(case.contains("curve \"lower\": a circle of radius 9 mm about z, over 50 % of the turn"), "{case}");
    assert!(case.contains("title = \"ring\""), "{case}");
}

#[test]
fn materials_are_listed_with_ranges_and_sources() {
    let folder = scratch("init-materials");
    let output = plummer(&folder, &["init", "--list-materials"]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    for part in [
        "steel               206      0.3    7850  E 200 to 212 GPa",
        "EN-GJL-250          110     0.26    7200  grey iron; a range, E 103 to 118 GPa: it falls with load, and in thick sections",
        "EN 1561:2011, annex A",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let json = init(&folder, &["--list-materials"]);
    let materials = json["materials"].as_array().unwrap();
    let iron = materials.iter().find(|material| material["name"] == "EN-GJS-400-15").unwrap();
    assert_eq!((iron["young_pa"].as_f64(), iron["density_kg_m3"].as_f64()), (Some(169e9), Some(7100.0)));
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
}

#[test]
fn the_catalogue_is_listed_with_its_sources() {
    let folder = scratch("init-list");
    let output = plummer(&folder, &["init", "--list-bearings"]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    for part in [
        "6205     25     52     15      9          7.938          39.10   0.128 3.5864 5.4136 2.3613 0.3985  GMN",
        "6305     25     62     17      7         11.906          43.50*  0.222 2.5420 4.4580 1.6899 0.3631  Timken",
        "BSF is the spin of a ball: a flaw on it strikes both races, twice a spin",
        "GMN: GMN, High precision ball bearings, catalogue 4000 0813 EN (2013)",
        "Usual, no maker's: groove radii of 0.52 (inner) and 0.53 (outer) of the ball's diameter.",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let json = init(&folder, &["--list-bearings"]);
    let bearings = json["bearings"].as_array().unwrap();
    assert_eq!(bearings.len(), 69);
    let bearing = bearings.iter().find(|bearing| bearing["name"] == "6205").unwrap();
    // with gamma = 7.938 / 39.1: 4.5 (1 - gamma), 4.5 (1 + gamma), (1 - gamma^2) / (2 gamma), (1 - gamma) / 2
    let gamma = 7.938 / 39.1;
    for (key, order) in [
        ("bpfo", 4.5 * (1.0 - gamma)),
        ("bpfi", 4.5 * (1.0 + gamma)),
        ("bsf", 0.5 * (1.0 - gamma * gamma) / gamma),
        ("ftf", 0.5 * (1.0 - gamma)),
    ] {
        let found = bearing[key].as_f64().unwrap();
        assert!((found / order - 1.0).abs() < 1e-12, "{key}: {found}");
    }
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
}
