//! Reference: the geometry of the examples; 4200 MPa of ISO 76; the share of a width by hand.
//! Goal: bearings and seats that cannot be are refused, those in doubt are said, those that are built pass without a word.
//! Sketch: the example of a healthy bearing, and of a pillow block whose bore reaches from z = -5 to 5 mm, with one value
//!   changed each.
//! Conditions: the program as a user runs it. Parameters: none; there is no tolerance.

use std::path::Path;
use std::process::Output;

use super::program::{errors, plummer, scratch};

fn ran(name: &str, command: &str, example: &str, set: &[&str]) -> Output {
    let folder = scratch(name);
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(example);
    let case = case.to_str().unwrap();
    let mut words = vec![command, case, "--out", "out", "--force"];
    for value in set {
        words.extend(["--set", value]);
    }
    plummer(&folder, &words)
}

/// Exit code 2 with these words.
fn refused(name: &str, command: &str, example: &str, set: &[&str], words: &[&str]) {
    let output = ran(name, command, example, set);
    let said = errors(&output);
    assert_eq!(output.status.code(), Some(2), "{set:?}: {said}");
    for word in words {
        assert!(said.contains(word), "{word} in: {said}");
    }
}

/// Exit code 0 with these warnings on the terminal and no other, but for what errors grow to as balls strike.
fn warned(name: &str, command: &str, example: &str, set: &[&str], words: &[&str]) {
    let output = ran(name, command, example, set);
    assert_eq!(output.status.code(), Some(0), "{set:?}: {}", errors(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    let warnings: Vec<&str> =
        text.lines().filter(|line| line.starts_with("warning") && !line.contains("as balls strike")).collect();
    assert_eq!(warnings.len(), words.len(), "{set:?}: {warnings:?}");
    for (word, warning) in words.iter().zip(warnings) {
        assert!(warning.contains(word), "{word} in: {warning}");
    }
}

const BEARING: &str = "scenes/healthy.toml";
const SHORT: &str = "transient.end=1e-3";

#[test]
fn impossible_bearings_are_refused() {
    let outside = "bearing.outer_race_radius=52.0025e-3";
    for (set, words) in [
        (&["bearing.inner_groove_radius=1.0000001e-3"][..], ["bearing.inner_groove_radius", "half-axis"]),
        (&["bearing.outer_groove_radius=1.0000001e-3"], ["bearing.outer_groove_radius", "half-axis"]),
        (
            &[outside, "bearing.inner_race_radius=50e-3"],
            ["outer face of the outermost of `ring.sections`", "bearing.outer_race_radius"],
        ),
        (&["ring.sections[1].inertia=9e-9"], ["ring.sections[1].inertia", "reaches the ring's axis"]),
        (&["bearing.waviness=[{on='outer',order=9,amplitude=1e-3}]"], ["amplitude", "a tenth of the ball's radius"]),
    ] {
        let set = [set, &[SHORT]].concat();
        refused("impossible-bearing", "run", BEARING, &set, &words);
    }
}

#[test]
fn bearings_in_doubt_are_said() {
    for (set, words) in [
        (&["bearing.inner_groove_radius=1.001e-3"][..], &["0.5005000 of the ball's diameter"][..]),
        (&["bearing.ball_mass=1e-3"], &["238700 kg/m^3"]),
        (
            &["bearing.outer_race_radius=3.0025e-3", "bearing.inner_race_radius=1e-3", "bearing.balls=5"],
            &["innermost of ring.sections"],
        ),
        (&["ring.sections[1].radius=7.5"], &["ring.sections[0] and ring.sections[1] lie apart by about 7.49"]),
        (&["ring.sections[1].radius=6e-3"], &["reach into each other by about 0.00151"]),
        (&["ring.sections[1].area=12e-3", "ring.sections[1].inertia=9e-9"], &["ring.sections[1] is about 4 m wide"]),
        (
            &["materials.steel.young=210e3"],
            &[
                "materials.steel: young = 210000 Pa and density = 7850 kg/m^3 give a speed of sound of 5.17 m/s, and no solid has these; steel has 2.1e11 Pa, 7850 kg/m^3 and 5.2e3 m/s: 210000 looks like MPa: write 2.1e11",
            ],
        ),
        (&["materials.steel.density=7.85e-9", "materials.steel.young=210e3"], &["speed of sound of 5.17e6 m/s"]),
        (&[], &[]),
    ] {
        let set = [set, &[SHORT]].concat();
        warned("doubtful-bearing", "run", BEARING, &set, words);
    }
}

/// A stiff ring, and so much weight on its 7 balls of 2 mm: 257 N on one of them are just above the static load rating.
#[test]
fn pressures_beyond_the_rating_are_said_and_impossible_ones_refused() {
    let stiff = "ring.supports=[{from_deg=0,to_deg=360,spring={x=1e9,y=1e9}}]";
    let words = ["half-axis of 5.3", "4240 MPa", "accuracy.target is 0.010"];
    let set = [stiff, "shaft.mass=40", SHORT];
    warned("doubtful-load", "run", BEARING, &set, &words);
    let set = [stiff, "shaft.mass=300", SHORT];
    refused("impossible-load", "run", BEARING, &set, &["half-axis of 0.00103"]);
    // grooves that hardly conform: a patch so small that the pressure ends it first
    let grooves = ["bearing.inner_groove_radius=2e-3", "bearing.outer_groove_radius=2e-3"];
    let set = [&[stiff, "shaft.mass=200", SHORT], &grooves[..]].concat();
    let words = ["the pressure between a ball and the inner race would be 13165 MPa"];
    refused("impossible-pressure", "run", BEARING, &set, &words);
}

const SEAT: &str = "housings/pillow_block.toml";
const FEW: &str = "modes.count=6";

/// The ring is 3.812 mm wide: at z = -4 mm it has 1 mm of bore on one side, `1/2 - 1/3.812` of it is outside.
#[test]
fn a_ring_beyond_its_bore_is_said() {
    for (centre, share) in [("5e-3", "50 % of the ring's width"), ("-4e-3", "24 % of the ring's width")] {
        let centre = format!("ring.tie.centre=[0,0,{centre}]");
        warned("seat-overhang", "modes", SEAT, &[&centre, FEW], &[share]);
    }
    warned("seat-inside", "modes", SEAT, &["ring.tie.centre=[0,0,3e-3]", FEW], &[]);
    let beside = ["ring.tie.centre=[0,0,6e-3]", FEW];
    refused("seat-beside", "modes", SEAT, &beside, &["does not cut the group \"bore\""]);
    let smaller = ["ring.sections[0].radius=4e-3", FEW];
    warned("seat-smaller", "modes", SEAT, &smaller, &["the tie bridges 0.00129", "innermost of ring.sections"]);
}

const RING: &str = "housings/ring.toml";

/// The bore has a radius of 6 mm, the ring reaches from 4.6 mm to there with its centroid at 5.314 mm, a ball is 2 mm thick.
#[test]
fn a_race_outside_of_its_ring_is_refused_and_one_in_doubt_is_said() {
    let race = |outer: f64| {
        let inner = outer - 2.0025e-3;
        [format!("bearing.outer_race_radius={outer:e}"), format!("bearing.inner_race_radius={inner:e}")]
    };
    for command in ["run", "modes", "condense", "chart"] {
        for outer in [6e-3, 8e-3] {
            let set = race(outer);
            let set = set.each_ref().map(String::as_str);
            let found = format!("found {}, expected below `ring.outer_radius`", outer);
            refused("race-outside", command, RING, &set, &["bearing.outer_race_radius", &found, "(0.006)"]);
        }
    }
    let thin = ["bearing.ball_radius=0.4e-3", "bearing.inner_race_radius=3.954e-3"];
    for (set, word) in [
        (race(5.5e-3).to_vec(), "the centroid of its ring lies at 0.005314 m (ring.sections[0].radius)"),
        (thin.map(str::to_owned).to_vec(), "1.6 times the diameter of a ball"),
        (vec!["bearing.radial_play=5e-5".to_owned()], "5.0 % of the ball's radius"),
        (
            vec!["shaft.mass=1e-4".to_owned(), "shaft.unbalance=0".to_owned()],
            "shaft.mass is 0.1 g and the 7 balls have 0.23 g together",
        ),
        (vec!["shaft.unbalance=0.02".to_owned()], "off its axis by 0.133333 m"),
        (vec!["speed.profile=[{time=0,hz=60000}]".to_owned()], "check which of `hz` and `rpm` is meant"),
    ] {
        let set: Vec<&str> = set.iter().map(String::as_str).chain([FEW]).collect();
        warned("race-in-doubt", "modes", RING, &set, &[word]);
    }
}

/// A case file of its own beside nothing but a mesh of `meshes`, and what a command says of it.
fn own(name: &str, command: &str, mesh: &str, text: &str) -> Output {
    let folder = scratch(name);
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("meshes").join(mesh);
    let text = format!("[housing]\nmesh = \"{}\"\n{text}", mesh.display());
    std::fs::write(folder.join("a.toml"), text).unwrap();
    plummer(&folder, &[command, "a.toml", "--out", "out"])
}

/// Nothing but the mesh says how large the bore is, 6 mm.
#[test]
fn a_ring_or_race_outside_of_the_bore_is_refused_without_its_radius_in_the_case() {
    let case = |race: f64, section: f64| {
        format!(
            "length_unit = \"mm\"\nplane = {{ assumption = \"stress\", thickness = 4e-3 }}\n\
             parts = [{{ group = \"housing\", material = \"aluminium\" }}]\nsupports = [{{ group = \"outer\", fixed = \"all\" }}]\n\
             [ring]\nsections = [{{ material = \"steel\", area = 5.37e-6, inertia = 8.88e-13, radius = {section:e} }}]\n\
             tie = {{ group = \"bore\" }}\n[bearing]\nballs = 5\nball_radius = 1e-3\ninner_race_radius = {:e}\n\
             outer_race_radius = {race:e}\ninner_groove_radius = 1.04e-3\nouter_groove_radius = 1.07e-3\n[modes]\ncount = 3\n",
            race - 2.0025e-3
        )
    };
    for (race, section, key) in [
        (6.3e-3, 5.9e-3, "bearing.outer_race_radius is 0.0063 m"),
        (22e-3, 23e-3, "bearing.outer_race_radius is 0.022 m"),
        (5.9e-3, 6.2e-3, "ring.sections[0].radius is 0.0062 m"),
    ] {
        for command in ["modes", "condense"] {
            let output = own("outside-the-bore", command, "ring_6_9.msh", &case(race, section));
            let said = errors(&output);
            assert_eq!(output.status.code(), Some(2), "{said}");
            assert!(said.contains(key) && said.contains("the radius of the bore \"bore\" is 0.006 m"), "{said}");
        }
    }
    let far = own("far-from-the-bore", "modes", "ring_6_9.msh", &case(3.1e-3, 3.5e-3));
    let text = String::from_utf8(far.stdout).unwrap();
    assert!(text.contains("warning: the nodes of the bore \"bore\" lie 0.006 m to 0.006 m from the axis"), "{text}");
}

#[test]
fn meshes_and_materials_in_other_units_are_said() {
    let case = |unit: &str, young: f64, density: f64| {
        format!(
            "length_unit = \"{unit}\"\nparts = [{{ group = \"housing\", material = \"own\" }}]\n\
             supports = [{{ group = \"feet\", fixed = \"all\" }}]\n[modes]\ncount = 3\n\
             [materials.own]\nyoung = {young:e}\npoisson = 0.3\ndensity = {density:e}\n"
        )
    };
    let said = |unit: &str, young: f64, density: f64| {
        let output = own("other-units", "modes", "pedestal.msh", &case(unit, young, density));
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        let text = String::from_utf8(output.stdout).unwrap();
        let warnings = text.lines().filter(|line| line.starts_with("warning"));
        warnings.map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(said("mm", 206e9, 7850.0), Vec::<String>::new());
    assert_eq!(
        said("m", 206e9, 7850.0),
        [
            "warning: the housing is 44 x 23 x 10 m by housing.length_unit = \"m\": none is as large (the largest rolling bearings are 8 m across); its mesh looks like one in mm: write housing.length_unit = \"mm\" (44 x 23 x 10 mm)"
        ]
    );
    assert_eq!(
        said("mm", 206e3, 7.85e-9),
        [
            "warning: materials.own: young = 206000 Pa and density = 7.85e-9 kg/m^3 give a speed of sound of 5.12e6 m/s, and no solid has these; steel has 2.1e11 Pa, 7850 kg/m^3 and 5.2e3 m/s: 206000 looks like MPa: write 2.06e11; 7.85e-9 looks like t/mm^3: write 7850"
        ]
    );
    let small = said("um", 206e9, 7850.0);
    assert!(small[0].contains("44 x 23 x 10 µm") && small[0].contains("looks like one in mm"), "{small:?}");
}

/// A turned body of 32 sides. Its bore has a radius of 23.5 mm from z = 0 to 14 mm, then a shoulder down to 20 mm.
/// The group "bore" has both.
fn bore_with_shoulder() -> String {
    const SIDES: usize = 32;
    const RADII: [f64; 4] = [20.0, 23.5, 30.0, 36.0];
    let node = |i: usize, j: usize, k: usize| 1 + (4 * j + i) * SIDES + k % SIDES;
    let mut text = String::from(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 1 \"bore\"\n2 2 \"feet\"\n3 3 \"housing\"\n$EndPhysicalNames\n",
    );
    text += &format!("$Nodes\n{}\n", 16 * SIDES);
    for (j, z) in [0.0, 7.0, 14.0, 20.0].into_iter().enumerate() {
        for (i, radius) in RADII.into_iter().enumerate() {
            for k in 0..SIDES {
                let angle = std::f64::consts::TAU * k as f64 / SIDES as f64;
                text += &format!("{} {} {} {z}\n", node(i, j, k), radius * angle.cos(), radius * angle.sin());
            }
        }
    }
    let mut elements = Vec::new();
    let mut add = |kind: usize, tag: usize, nodes: &[usize]| {
        let nodes: Vec<String> = nodes.iter().map(usize::to_string).collect();
        elements.push(format!("{} {kind} 2 {tag} {tag} {}", elements.len() + 1, nodes.join(" ")));
    };
    for k in 0..SIDES {
        let face = |i: usize, j: usize| [node(i, j, k), node(i, j, k + 1), node(i, j + 1, k + 1), node(i, j + 1, k)];
        (0..2).for_each(|j| add(3, 1, &face(1, j)));
        add(3, 1, &[node(0, 2, k), node(1, 2, k), node(1, 2, k + 1), node(0, 2, k + 1)]);
        (0..3).for_each(|j| add(3, 2, &face(3, j)));
        for (i, j) in [(1, 0), (2, 0), (1, 1), (2, 1), (0, 2), (1, 2), (2, 2)] {
            let layer = |j: usize| [node(i, j, k), node(i + 1, j, k), node(i + 1, j, k + 1), node(i, j, k + 1)];
            add(5, 3, &[layer(j), layer(j + 1)].concat());
        }
    }
    text + &format!("$EndNodes\n$Elements\n{}\n{}\n$EndElements\n", elements.len(), elements.join("\n"))
}

#[test]
fn a_bore_named_with_its_shoulder_is_told_by_its_shares() {
    let folder = scratch("bore-with-shoulder");
    std::fs::write(folder.join("a.msh"), bore_with_shoulder()).unwrap();
    let found = plummer(&folder, &["init", "a.msh", "--out", "b.toml"]);
    let text = String::from_utf8(found.stdout.clone()).unwrap();
    assert_eq!(found.status.code(), Some(0), "{}", errors(&found));
    // chords of 32 sides: 2 n R sin(pi / n) L beside n / 2 sin(2 pi / n) (R^2 - r^2)
    assert!(text.contains("81 % of the area of group \"bore\" is a cylinder of radius 23.5 mm about z"), "{text}");
    assert!(text.contains("the rest is flat and lies across its axis, as a shoulder does"), "{text}");
    let case = "[housing]\nmesh = \"a.msh\"\nlength_unit = \"mm\"\nparts = [{ group = \"housing\", material = \"steel\" }]\n\
        supports = [{ group = \"feet\", fixed = \"all\" }]\n[ring]\nouter_radius = 23.5e-3\n\
        sections = [{ material = \"steel\", area = 5e-5, inertia = 1e-10, radius = 22e-3 }]\n\
        tie = { group = \"bore\", centre = [0, 0, 7e-3] }\n";
    std::fs::write(folder.join("a.toml"), case).unwrap();
    let said = errors(&plummer(&folder, &["modes", "a.toml", "--out", "out"]));
    assert!(said.contains("75 % of the nodes of group \"bore\" (a.msh) lie at the ring's outer radius"), "{said}");
}
