//! Values and tables beside each other.

use super::{HOUSING, RING, breaks, full, holds};
use crate::app::case::tests::{FULL, read};

#[test]
fn what_needs_another_table_says_so() {
    let needs = |other: &str| format!("needs {other}, which the case lacks");
    let tie = ["ring.tie.group=bore"];
    breaks(RING, &tie, "ring.tie", &needs("[housing]"));
    for spot in ["group='top'", "point=[0,0,0]"] {
        let argument = format!("sensors=[{{name='a',direction=[0,1,0],{spot}}}]");
        let key = format!("sensors[0].{}", spot.split_once('=').unwrap().0);
        breaks(RING, &[&argument], &key, &needs("[housing]"));
    }
    let meshes = ["modes.convergence.meshes=[\"a.msh\"]"];
    breaks(RING, &meshes, "modes.convergence", &needs("[housing]"));
    let spot = ["sensors=[{name='a',direction=[0,1,0],ring_deg=1}]"];
    breaks(HOUSING, &spot, "sensors[0].ring_deg", &needs("[ring]"));
    let start = FULL.find("[bearing]").unwrap();
    let end = FULL.find("[shaft]").unwrap();
    let text = HOUSING.to_owned() + &FULL[start..end].replace("my alloy", "steel");
    let error = read(&text, &[]).unwrap_err().to_string();
    assert_eq!(error, format!("folder/case.toml:6: `bearing`: {}", needs("[ring]")));
    let rule = needs("`ring.bond = \"slip\"`");
    breaks(FULL, &["ring.bond=composite", "ring.radius_rule=common-centroid"], "ring.radius_rule", &rule);
    holds(FULL, &["ring.bond=composite", "ring.radius_rule=own"]);
}

#[test]
fn housing_and_ring_are_connected_and_held() {
    let text = "title = \"nothing\"\n";
    let rule = "found neither [housing] nor [ring], expected at least one";
    breaks(text, &[], "housing", rule);
    let text = HOUSING.to_owned() + RING;
    let error = read(&text, &[]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "folder/case.toml:6: `ring`: found a housing and no `ring.tie`, which leaves the ring unconnected"
    );
    assert_eq!(error.help().unwrap(), "add tie = { group = \"NAME OF THE BORE\" } to [ring]");
    let sliding = ["ring.tie.group=bore", "ring.tie.fit=sliding"];
    holds(&text, &sliding);
    let free = [&["ring.supports=[]"][..], &sliding[..]].concat();
    let rule = "found \"sliding\" and no springs in `ring.supports`, which leaves the ring free to turn";
    breaks(&text, &free, "ring.tie.fit", rule);
    assert_eq!(
        read(&text, &free).unwrap_err().help().unwrap(),
        "use fit = \"bonded\", or add springs in x and y (in a solid housing in z too) to `ring.supports`"
    );
    holds(&text, &["ring.supports=[]", "ring.tie.group=bore"]);
}

#[test]
fn one_value_exceeds_the_other() {
    for (argument, rule) in [
        ("ring.outer_radius=7.5e-3", "found 0.0075, expected more than the section's radius (0.0075)"),
        ("ring.supports[0].to_deg=180", "found 180, expected more than `from_deg` (180)"),
        ("bearing.outer_race_radius=2e-3", "found 0.002, expected more than `bearing.inner_race_radius` (0.002754)"),
        ("bearing.inner_groove_radius=1e-3", "found 0.001, expected more than `bearing.ball_radius` (0.001)"),
        ("bearing.outer_groove_radius=0.9e-3", "found 9e-4, expected more than `bearing.ball_radius` (0.001)"),
        ("damping.ratios[1].frequency_hz=8200", "found 8200, expected more than the frequency before it (8200)"),
        ("speed.profile[1].time=0.2", "found 0.2, expected more than the time before it (0.2)"),
        ("accuracy.band_hz[1]=0", "found 0, expected more than the lowest frequency (0)"),
        ("transient.end=0.5", "found 0.5, expected more than `transient.start` (0.5)"),
        (
            "transient.end=0.500001",
            "found 0.500001, expected at least one interval of `transient.output_hz` after `transient.start` (0.50001)",
        ),
        ("analysis.envelope[0].to=2.3", "found 2.3, expected more than `from` (2.3)"),
    ] {
        full(argument, rule);
    }
}

#[test]
fn one_value_stays_below_the_other() {
    // A simulated time without rounding.
    let text = FULL.replace("end = 2.8", "end = 2.5");
    for (argument, rule) in [
        ("ring.supports[0].to_deg=541", "found 541, expected at most a full turn after `from_deg` (540)"),
        ("bearing.radial_play=2e-4", "found 2e-4, expected at most a tenth of the ball's radius either way (1e-4)"),
        ("bearing.radial_play=-2e-4", "found -2e-4, expected at most a tenth of the ball's radius either way (1e-4)"),
        ("bearing.defects[0].depth=5e-4", "found 5e-4, expected below half `bearing.ball_radius` (5e-4)"),
        ("transient.step=3", "found 3, expected below the simulated time (2)"),
        ("analysis.high_pass_hz=50000", "found 50000, expected below half of `transient.output_hz` (50000)"),
        ("bearing.defects[0].rim_radius=0.375e-3", "found 3.75e-4, expected below half the defect's length (3.75e-4)"),
    ] {
        breaks(&text, &[argument], argument.split_once('=').unwrap().0, rule);
    }
    holds(FULL, &["ring.supports[0].to_deg=540"]);
}

#[test]
fn a_defect_is_shorter_than_the_race() {
    // 2 pi 4.7565e-3
    full("bearing.defects[0].length=0.03", "found 0.03, expected below the race's circumference (0.0298859709136)");
}

#[test]
fn signals_are_sampled_finely_enough() {
    let rule = "found 79999, expected at least twice the highest frequency of `accuracy.band_hz` (80000)";
    full("transient.output_hz=79999", rule);
    holds(FULL, &["transient.output_hz=80000"]);
    assert_eq!(
        read(FULL, &["transient.output_hz=79999"]).unwrap_err().help().unwrap(),
        "raise the sampling rate or narrow `accuracy.band_hz`"
    );
    // a filter for a lower band would not fit into the memory
    let rule =
        "found 0.9, expected at least 1 Hz, or a hundred-thousandth of `transient.output_hz` where that is less (1)";
    full("accuracy.band_hz[1]=0.9", rule);
    holds(FULL, &["accuracy.band_hz[1]=1"]);
}

#[test]
fn the_balls_have_room() {
    let text = FULL.replace("radial_play = -1e-6\n", "");
    holds(&text, &[]);
    let error = read(&text, &["bearing.outer_race_radius=5e-3"]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "--set bearing.outer_race_radius=5e-3: `bearing.outer_race_radius`: the radii leave a radial play of \
         2.46e-4 m, expected at most a tenth of the ball's radius (1e-4 m) either way"
    );
    assert!(error.help().unwrap().starts_with("check that all radii are in m"));
    let message = read(&text, &["bearing.outer_race_radius=4.6e-3"]).unwrap_err().to_string();
    assert!(message.contains("radial play of -1.5"), "{message}");
    // pi / asin(1 / 3.755) = 11.66
    holds(&text, &["bearing.balls=11"]);
    full("bearing.balls=12", "found 12, expected at most 11: balls of this radius would overlap");
}

#[test]
fn a_ball_has_one_mass() {
    let rule = "found beside `bearing.density`, expected one of the two";
    let message = read(FULL, &["bearing.density=7800"]).unwrap_err().to_string();
    assert!(message.ends_with(&format!("`bearing.ball_mass`: {rule}")), "{message}");
}
