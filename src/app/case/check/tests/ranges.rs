//! Numbers in their ranges.

use super::{RING, breaks, full, holds};
use crate::app::case::tests::FULL;

const ABOVE_ZERO: [&str; 35] = [
    "materials.\"my alloy\".young",
    "materials.\"my alloy\".density",
    "materials.printed.young[1]",
    "materials.printed.shear[2]",
    "materials.printed.density",
    "housing.links[2].radial",
    "housing.plane.thickness",
    "housing.supports[2].radial",
    "housing.masses[0].mass",
    "ring.sections[1].area",
    "ring.sections[1].inertia",
    "ring.sections[1].axial_inertia",
    "ring.sections[1].torsion",
    "ring.sections[1].radius",
    "bearing.ball_radius",
    "bearing.ball_mass",
    "bearing.inner_race_radius",
    "bearing.stiffness.inner",
    "bearing.stiffness.outer",
    "bearing.defects[0].length",
    "bearing.defects[0].width",
    "bearing.defects[0].depth",
    "bearing.defects[0].rim_radius",
    "shaft.mass",
    "damping.ratios[0].frequency_hz",
    "damping.ratios[1].frequency_hz",
    "modes.up_to_hz",
    "modes.expected[0].hz",
    "modes.compare[0].points_within",
    "modes.convergence.order",
    "condense.fixed_interface_modes.up_to_hz",
    "condense.interface_modes.up_to_hz",
    "transient.step",
    "transient.output_hz",
    "analysis.high_pass_hz",
];

#[test]
fn what_must_exceed_zero_does() {
    for key in ABOVE_ZERO {
        for value in ["0", "-1.5"] {
            let rule = format!("found {value}, expected a number above 0");
            full(&format!("{key}={value}"), &rule);
        }
    }
    full("condense.interface_modes=0", "found 0, expected a number above 0");
    let text = FULL.replace("ball_mass = 3.29e-5\n", "");
    let (key, rule) = ("bearing.density", "found 0, expected a number above 0");
    breaks(&text, &["bearing.density=0"], key, rule);
}

#[test]
fn what_may_be_zero_is_not_below() {
    for key in [
        "housing.supports[1].spring.x",
        "housing.supports[1].spring.y",
        "ring.supports[0].spring.y",
        "bearing.contact_damping",
        "shaft.unbalance",
        "accuracy.band_hz[0]",
        "transient.start",
    ] {
        full(&format!("{key}=-1e-9"), "found -1e-9, expected a number not below 0");
        holds(FULL, &[&format!("{key}=0")]);
    }
    for (key, other) in [("alpha", "beta"), ("beta", "alpha")] {
        breaks(
            FULL,
            &[&format!("damping={{{key}=-1,{other}=0}}")],
            &format!("damping.{key}"),
            "found -1, expected a number not below 0",
        );
    }
    holds(FULL, &["damping={alpha=0,beta=0}"]);
}

/// Beyond, squares leave the numbers and no equilibrium is found.
#[test]
fn what_is_beyond_all_measure_is_refused() {
    const MASS: &str = "found 1e300, expected a mass of at most 1e15 kg";
    const LOAD: &str = "found 1e300, expected at most 1e15 either way";
    const STIFF: &str = "found 1e300, expected a stiffness of at most 1e20";
    for (argument, key, rule) in [
        ("shaft.mass=1e300", "shaft.mass", MASS),
        ("bearing.ball_mass=1e300", "bearing.ball_mass", MASS),
        ("housing.masses[0].mass=1e300", "housing.masses[0].mass", MASS),
        ("shaft.unbalance=1e300", "shaft.unbalance", LOAD),
        ("transient.output_hz=1e300", "transient.output_hz", "found 1e300, expected a rate of at most 1e9 Hz"),
        ("accuracy.target=1e-300", "accuracy.target", "found 1e-300, expected at least 1e-9, which round-off allows"),
        (
            "bearing.contact_damping=1e300",
            "bearing.contact_damping",
            "found 1e300, expected at most 1e6 s/m, by which no ball rebounds from any impact",
        ),
        ("shaft.gravity=[0,1e300]", "shaft.gravity", LOAD),
        ("shaft.loads=[{force=[1e300,0]}]", "shaft.loads[0]", LOAD),
        ("shaft.loads=[{profile=[{time=0,force=[0,1e300]}]}]", "shaft.loads[0].profile", LOAD),
        ("bearing.stiffness={inner=1,outer=1e300}", "bearing.stiffness.outer", STIFF),
        ("housing.supports[1].spring.x=1e300", "housing.supports[1].spring.x", STIFF),
        (
            "speed.profile=[{time=-1e300,hz=21},{time=1e300,hz=21}]",
            "speed.profile[0].time",
            "found -1e300, expected a time of at most 1e7 s from 0 (let the clock begin near 0)",
        ),
        (
            "transient.end=1.7e9",
            "transient.end",
            "found 1.7e9, expected a time of at most 1e7 s from 0 (let the clock begin near 0)",
        ),
        (
            "speed.profile=[{time=0,rpm=1e300}]",
            "speed.profile[0]",
            "found 1.66666666667e298 Hz (1e300 rpm), expected a speed of at most 1e6 Hz (6e7 rpm) either way",
        ),
    ] {
        breaks(FULL, &[argument], key, rule);
    }
}

/// The condensed housing is made for the band.
#[test]
fn responses_are_checked_in_their_band() {
    const PATHS: &str = "frf={from=[{ring_deg=3,direction=[0,1,0]}],check_hz=[1,41e3]}";
    let rule = "found 41000, expected at most the highest frequency of the band (40000)";
    breaks(FULL, &[PATHS], "frf.check_hz[1]", rule);
    holds(FULL, &[&PATHS.replace("check", "band_hz=[0,42e3],check")]);
}

#[test]
fn a_spectral_radius_is_of_one_method_and_from_zero_to_one() {
    let (key, alpha) = ("transient.spectral_radius", "transient.method=generalized-alpha");
    for value in ["-0.1", "1.01"] {
        let rule = format!("found {value}, expected a number from 0 to 1");
        breaks(FULL, &[alpha, &format!("{key}={value}")], key, &rule);
    }
    for value in ["0", "1"] {
        holds(FULL, &[alpha, &format!("{key}={value}")]);
    }
    full("transient.spectral_radius=0.5", "needs `transient.method = \"generalized-alpha\"`, which the case lacks");
}

#[test]
fn a_tolerance_is_of_methods_that_choose_steps_and_between_zero_and_one() {
    let (key, method) = ("transient.tolerance", "transient.method=dop853");
    for value in ["0", "1"] {
        let rule = format!("found {value}, expected a number above 0 and below 1");
        breaks(FULL, &[method, &format!("{key}={value}")], key, &rule);
    }
    for method in [method, "transient.method=exponential-adams"] {
        holds(FULL, &[method, "transient.tolerance=1e-8"]);
    }
    full(
        "transient.tolerance=1e-8",
        "needs `transient.method = \"dop853\"` or `\"exponential-adams\"`, which the case lacks",
    );
}

#[test]
fn ratios_and_fractions_stay_within_one() {
    for key in ["damping.ratios[1].ratio", "bearing.slip"] {
        for value in ["-0.1", "1"] {
            let rule = format!("found {value}, expected a number from 0 to below 1");
            full(&format!("{key}={value}"), &rule);
        }
        holds(FULL, &[&format!("{key}=0")]);
    }
    let rule = "found 1.5, expected a number from 0 to below 1";
    breaks(FULL, &["damping={modal=1.5}"], "damping.modal", rule);
    for key in ["modes.expected[0].within", "modes.compare[0].within", "accuracy.target"] {
        for value in ["0", "1"] {
            let rule = format!("found {value}, expected a number above 0 and below 1");
            full(&format!("{key}={value}"), &rule);
        }
    }
    for key in ["ring.sections[1].shear_coefficient", "modes.compare[0].mac"] {
        for value in ["0", "1.1"] {
            let rule = format!("found {value}, expected a number above 0, at most 1");
            full(&format!("{key}={value}"), &rule);
        }
        holds(FULL, &[&format!("{key}=1")]);
    }
    for value in ["-1", "0.5"] {
        let rule = format!("found {value}, expected a number above -1 and below 0.5");
        full(&format!("materials.\"my alloy\".poisson={value}"), &rule);
    }
}

#[test]
fn a_perturbation_is_between_zero_and_one() {
    for value in ["0", "1"] {
        let rule = format!("found {value}, expected a number above 0 and below 1");
        full(&format!("transient.ensemble.perturbation={value}"), &rule);
    }
}

#[test]
fn counts_stay_within_their_range() {
    for (argument, rule) in [
        ("ring.nodes=7", "found 7, expected 8 to 2000 nodes"),
        ("ring.nodes=2001", "found 2001, expected 8 to 2000 nodes"),
        ("bearing.balls=2", "found 2, expected 3 to 40 balls"),
        ("bearing.balls=41", "found 41, expected 3 to 40 balls"),
        ("transient.modes=0", "found 0, expected at least 1"),
        ("transient.ensemble.runs=1", "found 1, expected 2 to 10000 runs"),
        ("transient.ensemble.runs=10001", "found 10001, expected 2 to 10000 runs"),
    ] {
        full(argument, rule);
    }
    let text = RING.to_owned() + "[modes]\ncount = 1\n";
    holds(&text, &[]);
    let rule = "found 0, expected at least 1";
    breaks(&text, &["modes.count=0"], "modes.count", rule);
    holds(FULL, &["ring.nodes=8"]);
}

#[test]
fn angles_beyond_a_hundred_turns_are_refused() {
    let expected = "found 1e12, expected an angle from -36000 to 36000 degrees";
    for (set, key) in [
        ("bearing.first_ball_deg=1e12", "bearing.first_ball_deg"),
        ("bearing.defects=[{on='outer',angle_deg=1e12,length=1e-3,depth=1e-5}]", "bearing.defects[0].angle_deg"),
        ("sensors=[{name='a',direction=[0,1,0],ring_deg=1e12}]", "sensors[0].ring_deg"),
    ] {
        breaks(FULL, &[set], key, expected);
    }
    holds(FULL, &["bearing.first_ball_deg=-36000"]);
}
