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
        (&[outside, "bearing.inner_race_radius=50e-3"], ["outer face of the ring", "0.009"]),
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
        (&["bearing.ball_mass=1e-3"], &["2.387e5 kg/m^3"]),
        (
            &["bearing.outer_race_radius=3.0025e-3", "bearing.inner_race_radius=1e-3", "bearing.balls=5"],
            &["innermost of ring.sections"],
        ),
        (&["ring.sections[1].radius=7.5"], &["ring.sections[0] and ring.sections[1] lie apart by about 7.492e0 m"]),
        (&["ring.sections[1].radius=6e-3"], &["reach into each other by about 1.518e-3 m"]),
        (
            &["ring.sections[1].area=12e-3", "ring.sections[1].inertia=9e-9"],
            &["ring.sections[1] is about 4.000e0 m wide"],
        ),
        (
            &["materials.steel.young=210e3"],
            &[
                "materials.steel: young = 2.1000e5 Pa and density = 7.8500e3 kg/m^3 give a speed of sound of 5.172e0 m/s",
            ],
        ),
        (&["materials.steel.density=7.85e-9", "materials.steel.young=210e3"], &["speed of sound of 5.172e6 m/s"]),
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
    refused("impossible-load", "run", BEARING, &set, &["half-axis of 1.032e-3 m"]);
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
    warned("seat-smaller", "modes", SEAT, &smaller, &["the tie bridges 1.296e-3 m"]);
}
