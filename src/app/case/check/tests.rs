//! Every rule fires, with its exact message; every value just inside a rule is let through.

use super::super::tests::{FULL, read};

/// A ring on springs, no housing: what needs a housing can be missed here.
const RING: &str = "[ring]\n\
    sections = [{ material = \"steel\", area = 5e-6, inertia = 9e-13, radius = 5.3e-3 }]\n\
    supports = [{ from_deg = 0, to_deg = 360, spring = { x = 1e5 } }]\n";

/// A plane housing alone.
const HOUSING: &str = "[housing]\nmesh = \"a.msh\"\nlength_unit = \"mm\"\n\
    plane = { assumption = \"stress\", thickness = 4e-3 }\n\
    parts = [{ group = \"case\", material = \"steel\" }]\n";

pub(super) fn breaks(text: &str, set: &[&str], key: &str, rule: &str) {
    let error = read(text, set).expect_err(set.last().unwrap_or(&text));
    let last = set.last().map(|argument| format!("--set {argument}"));
    let place = last.unwrap_or_else(|| "folder/case.toml".to_owned());
    assert_eq!(error.to_string(), format!("{place}: `{key}`: {rule}"));
}

/// Breaks `FULL` with one key set and expects the message at that key.
pub(super) fn full(argument: &str, rule: &str) {
    let (key, _) = argument.split_once('=').unwrap();
    breaks(FULL, &[argument], key, rule);
}

pub(super) fn holds(text: &str, set: &[&str]) {
    if let Err(error) = read(text, set) {
        panic!("{set:?}: {error}");
    }
}

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
    full(
        "condense.interface_modes=0",
        "found 0, expected a number above 0",
    );
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
        full(
            &format!("{key}=-1e-9"),
            "found -1e-9, expected a number not below 0",
        );
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

#[test]
fn a_spectral_radius_is_of_one_method_and_from_zero_to_one() {
    let (key, alpha) = (
        "transient.spectral_radius",
        "transient.method=generalized-alpha",
    );
    for value in ["-0.1", "1.01"] {
        let rule = format!("found {value}, expected a number from 0 to 1");
        breaks(FULL, &[alpha, &format!("{key}={value}")], key, &rule);
    }
    for value in ["0", "1"] {
        holds(FULL, &[alpha, &format!("{key}={value}")]);
    }
    full(
        "transient.spectral_radius=0.5",
        "needs `transient.method = \"generalized-alpha\"`, which the case lacks",
    );
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
    for key in [
        "modes.expected[0].within",
        "modes.compare[0].within",
        "accuracy.target",
    ] {
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
fn loss_factors_stay_below_two() {
    for name in ["\"my alloy\"", "printed"] {
        for value in ["-0.1", "2"] {
            let rule = format!("found {value}, expected a number from 0 to below 2");
            full(&format!("materials.{name}.loss_factor={value}"), &rule);
        }
    }
    holds(FULL, &["materials.printed.loss_factor=1.99"]);
}

#[test]
fn rings_and_contacts_have_no_loss_factor() {
    let lossy = "materials.lossy={young=2e11,poisson=0.3,density=7800,loss_factor=0.01}";
    for key in ["ring.sections[0].material", "bearing.ball_material"] {
        breaks(
            FULL,
            &[lossy, &format!("{key}=lossy")],
            key,
            "\"lossy\" has a loss factor, expected a material without: structural damping is for parts of the housing",
        );
    }
    holds(FULL, &[lossy, "housing.parts[0].material=lossy"]);
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
        (
            "transient.ensemble.runs=1",
            "found 1, expected 2 to 10000 runs",
        ),
        (
            "transient.ensemble.runs=10001",
            "found 10001, expected 2 to 10000 runs",
        ),
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
fn lists_and_names_that_must_hold_something_do() {
    for (argument, expected) in [
        ("housing.parts=[]", "at least one part"),
        ("housing.supports[0].fixed=[]", "at least one of x, y, z"),
        ("housing.supports[1].spring={}", "a stiffness above 0"),
        ("ring.supports[0].spring={x=0}", "a stiffness above 0"),
        ("ring.sections=[]", "at least one section"),
        ("speed.profile=[]", "at least one point"),
        ("sensors[0].name=\"\"", "a name"),
        ("modes.variants[0].set=[]", "at least one KEY=VALUE"),
        ("modes.convergence.meshes=[]", "at least one other mesh"),
    ] {
        full(argument, &format!("found nothing, expected {expected}"));
    }
}

#[test]
fn materials_exist() {
    for key in [
        "housing.parts[0].material",
        "ring.sections[0].material",
        "bearing.ball_material",
    ] {
        full(
            &format!("{key}=\"steal\""),
            "no material is called \"steal\"",
        );
    }
    for (argument, name) in [
        ("bearing.race_material=brass", "brass"),
        (
            "bearing.race_material={inner=\"tin\",outer=\"steel\"}",
            "tin",
        ),
        (
            "bearing.race_material={inner=\"steel\",outer=\"tin\"}",
            "tin",
        ),
    ] {
        full(argument, &format!("no material is called \"{name}\""));
    }
    let help = |name: &str| {
        let argument = format!("bearing.ball_material=\"{name}\"");
        read(FULL, &[&argument]).unwrap_err().help().unwrap()
    };
    let known = "materials here: aluminium, bearing steel, my alloy, printed, steel";
    assert_eq!(help("steal"), format!("did you mean `steel`? {known}"));
    assert_eq!(help("unobtainium"), known);
}

#[test]
fn a_plane_has_no_third_axis() {
    let rule = "found a component z, expected x and y only in a plane model";
    full("housing.supports[0].fixed=[\"x\",\"z\"]", rule);
    full("housing.supports[1].spring={z=1}", rule);
    full("housing.links[1].spring={z=1}", rule);
    full("ring.supports[0].spring={z=1}", rule);
    let solid = FULL.replace("plane = {", "#");
    holds(&solid, &["housing.supports[0].fixed=[\"z\"]"]);
    holds(&solid, &["housing.supports[1].spring={z=1}"]);
    holds(&solid, &["ring.supports[0].spring={z=1}"]);
}

#[test]
fn rings_and_contacts_are_isotropic() {
    let rule = "\"printed\" is orthotropic, expected an isotropic material: rings and contacts have no other";
    for key in [
        "ring.sections[0].material",
        "bearing.ball_material",
        "bearing.race_material",
    ] {
        full(&format!("{key}=printed"), rule);
    }
    holds(FULL, &["housing.parts[0].material=printed"]);
}

#[test]
fn an_orthotropic_material_has_positive_energy_and_axes() {
    full(
        "materials.printed.poisson=[0.9,0.9,0.9]",
        "the three Poisson's ratios do not go together: 1 - nu_xy^2 E_y/E_x - nu_yz^2 E_z/E_y - \
         nu_xz^2 E_z/E_x - 2 nu_xy nu_yz nu_xz E_z/E_x must be positive, found -2.108375",
    );
    full(
        "materials.printed.y_axis=[2,0,0]",
        "the material axes x (1, 0, 0) and y (2, 0, 0) are parallel: two different directions are needed",
    );
    full(
        "materials.printed.x_axis=[0,0,0]",
        "found a vector of length zero, expected a direction",
    );
}

#[test]
fn a_link_connects_two_groups() {
    full(
        "housing.links[0].between=['lid','lid']",
        "\"lid\" stands here a second time, expected each once",
    );
}

#[test]
fn directions_point_somewhere() {
    let nowhere = "found a vector of length zero, expected a direction";
    for key in ["ring.tie.axis", "ring.tie.zero_deg", "sensors[0].direction"] {
        full(&format!("{key}=[0,0.0,0]"), nowhere);
    }
    let along = "found the direction of `ring.tie.axis`, expected one across it";
    full("ring.tie.zero_deg=[0,0,-2]", along);
    holds(FULL, &["ring.tie.zero_deg=[1,0,-2]"]);
}

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
    assert_eq!(
        error,
        format!("folder/case.toml:6: `bearing`: {}", needs("[ring]"))
    );
    let rule = needs("`ring.bond = \"slip\"`");
    breaks(
        FULL,
        &["ring.bond=composite", "ring.radius_rule=common-centroid"],
        "ring.radius_rule",
        &rule,
    );
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
    assert_eq!(
        error.help().unwrap(),
        "add tie = { group = \"NAME OF THE BORE\" } to [ring]"
    );
    let sliding = ["ring.tie.group=bore", "ring.tie.fit=sliding"];
    holds(&text, &sliding);
    let free = [&["ring.supports=[]"][..], &sliding[..]].concat();
    let rule =
        "found \"sliding\" and no springs in `ring.supports`, which leaves the ring free to turn";
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
        (
            "ring.outer_radius=7.5e-3",
            "found 0.0075, expected more than the section's radius (0.0075)",
        ),
        (
            "ring.supports[0].to_deg=180",
            "found 180, expected more than `from_deg` (180)",
        ),
        (
            "bearing.outer_race_radius=2e-3",
            "found 0.002, expected more than `bearing.inner_race_radius` (0.002754)",
        ),
        (
            "bearing.inner_groove_radius=1e-3",
            "found 0.001, expected more than `bearing.ball_radius` (0.001)",
        ),
        (
            "bearing.outer_groove_radius=0.9e-3",
            "found 9e-4, expected more than `bearing.ball_radius` (0.001)",
        ),
        (
            "damping.ratios[1].frequency_hz=8200",
            "found 8200, expected more than the frequency before it (8200)",
        ),
        (
            "speed.profile[1].time=0.2",
            "found 0.2, expected more than the time before it (0.2)",
        ),
        (
            "accuracy.band_hz[1]=0",
            "found 0, expected more than the lowest frequency (0)",
        ),
        (
            "transient.end=0.5",
            "found 0.5, expected more than `transient.start` (0.5)",
        ),
        (
            "analysis.envelope[0].to=2.3",
            "found 2.3, expected more than `from` (2.3)",
        ),
    ] {
        full(argument, rule);
    }
}

#[test]
fn one_value_stays_below_the_other() {
    // A simulated time without rounding.
    let text = FULL.replace("end = 2.8", "end = 2.5");
    for (argument, rule) in [
        (
            "ring.supports[0].to_deg=541",
            "found 541, expected at most a full turn after `from_deg` (540)",
        ),
        (
            "bearing.radial_play=2e-4",
            "found 2e-4, expected at most a tenth of the ball's radius either way (1e-4)",
        ),
        (
            "bearing.radial_play=-2e-4",
            "found -2e-4, expected at most a tenth of the ball's radius either way (1e-4)",
        ),
        (
            "bearing.defects[0].depth=1e-3",
            "found 0.001, expected below `bearing.ball_radius` (0.001)",
        ),
        (
            "transient.step=3",
            "found 3, expected below the simulated time (2)",
        ),
        (
            "analysis.high_pass_hz=50000",
            "found 50000, expected below half of `transient.output_hz` (50000)",
        ),
        (
            "bearing.defects[0].rim_radius=0.375e-3",
            "found 3.75e-4, expected below half the defect's length (3.75e-4)",
        ),
    ] {
        breaks(
            &text,
            &[argument],
            argument.split_once('=').unwrap().0,
            rule,
        );
    }
    holds(FULL, &["ring.supports[0].to_deg=540"]);
}

#[test]
fn a_defect_is_shorter_than_the_race() {
    // 2 pi 4.7565e-3
    full(
        "bearing.defects[0].length=0.03",
        "found 0.03, expected below the race's circumference (0.0298859709136)",
    );
}

#[test]
fn signals_are_sampled_finely_enough() {
    let rule =
        "found 79999, expected at least twice the highest frequency of `accuracy.band_hz` (80000)";
    full("transient.output_hz=79999", rule);
    holds(FULL, &["transient.output_hz=80000"]);
    assert_eq!(
        read(FULL, &["transient.output_hz=79999"])
            .unwrap_err()
            .help()
            .unwrap(),
        "raise the sampling rate or narrow `accuracy.band_hz`"
    );
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
    assert!(
        error
            .help()
            .unwrap()
            .starts_with("check that all radii are in m")
    );
    let message = read(&text, &["bearing.outer_race_radius=4.6e-3"])
        .unwrap_err()
        .to_string();
    assert!(message.contains("radial play of -1.5"), "{message}");
    // pi / asin(1 / 3.755) = 11.66
    holds(&text, &["bearing.balls=11"]);
    full(
        "bearing.balls=12",
        "found 12, expected at most 11: balls of this radius would overlap",
    );
}

#[test]
fn a_ball_has_one_mass() {
    let rule = "found beside `bearing.density`, expected one of the two";
    let message = read(FULL, &["bearing.density=7800"])
        .unwrap_err()
        .to_string();
    assert!(
        message.ends_with(&format!("`bearing.ball_mass`: {rule}")),
        "{message}"
    );
}

/// Values that overflow or vanish in the products of matrix entries: refused where they are written.
#[test]
fn materials_and_directions_beyond_all_numbers() {
    let material = |keys: &str| format!("materials.steel={{{keys}}}");
    for (keys, key, rule) in [
        (
            "young=2e11,poisson=0.3,density=1e-300",
            "materials.steel.density",
            "found 1e-300, expected a density from 1e-9 to 1e9 kg/m^3",
        ),
        (
            "young=2e11,poisson=0.3,density=1e12",
            "materials.steel.density",
            "expected a density from 1e-9 to 1e9 kg/m^3",
        ),
        (
            "young=1e-300,poisson=0.3,density=7800",
            "materials.steel.young",
            "found 1e-300, expected a modulus from 1e-6 to 1e18 Pa",
        ),
        (
            "young=1e300,poisson=0.3,density=7800",
            "materials.steel.young",
            "expected a modulus from 1e-6 to 1e18 Pa",
        ),
    ] {
        let text = read(FULL, &[&material(keys)]).unwrap_err().to_string();
        assert!(
            text.contains(&format!("`{key}`")) && text.contains(rule),
            "{text}"
        );
    }
    for length in ["1e-200", "1e200"] {
        let broken = super::range::direction("direction", [length.parse().unwrap(), 0.0, 0.0]);
        assert!(broken.is_err(), "{length}");
    }
}

#[test]
fn angles_beyond_a_hundred_turns_are_refused() {
    let expected = "found 1e12, expected an angle from -36000 to 36000 degrees";
    for (set, key) in [
        ("bearing.first_ball_deg=1e12", "bearing.first_ball_deg"),
        (
            "bearing.defects=[{on='outer',angle_deg=1e12,length=1e-3,depth=1e-5}]",
            "bearing.defects[0].angle_deg",
        ),
        (
            "sensors=[{name='a',direction=[0,1,0],ring_deg=1e12}]",
            "sensors[0].ring_deg",
        ),
    ] {
        breaks(FULL, &[set], key, expected);
    }
    holds(FULL, &["bearing.first_ball_deg=-36000"]);
}
