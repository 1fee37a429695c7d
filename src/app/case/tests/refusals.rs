//! The exact message of what is not understood: names, kinds of values, keys that exclude each other, malformed text.

use super::{FULL, read, refusal};
use crate::app::case::Case;

#[test]
fn misspelt_keys_and_names_come_with_the_nearest() {
    let (message, help) = refusal(&["bearing.ball_raduis=1e-3"]);
    assert_eq!(message, "--set bearing.ball_raduis=1e-3: unknown key `bearing.ball_raduis`");
    assert!(help.unwrap().starts_with("did you mean `ball_radius`? keys here: name, balls, ball_radius, ball_mass,"));
    let (message, help) = refusal(&["ring.bond=slipp"]);
    assert_eq!(message, "--set ring.bond=slipp: `ring.bond` is \"slipp\", expected one of `slip`, `composite`");
    assert_eq!(help.unwrap(), "did you mean `slip`? names here: slip, composite");
    let (message, help) = refusal(&["transient.modes=every"]);
    assert_eq!(message, "--set transient.modes=every: `transient.modes` is \"every\", expected one of `auto`, `all`");
    assert_eq!(help.unwrap(), "names here: auto, all");
    let (message, help) = refusal(&["transcient.end=1"]);
    assert_eq!(message, "--set transcient.end=1: unknown key `transcient`");
    assert!(help.unwrap().starts_with("did you mean `transient`?"));
}

#[test]
fn errors_in_the_file_name_its_line() {
    for (from, to, line, rest) in [
        ("balls = 7", "bals = 7", "balls = 7", "unknown key `bearing.bals`"),
        ("balls = 7", "balls = 7.5", "balls = 7", "`bearing.balls`: found 7.5, expected a whole number, 0 or more"),
        (
            "depth = 0.015e-3",
            "depth = \"deep\"",
            "depth = 0.015e-3",
            "`bearing.defects[0].depth`: found \"deep\", expected a number",
        ),
        ("on = \"outer\"", "", "[[bearing.defects]]", "`bearing.defects[0]` lacks the required key `on`"),
        ("length_unit = \"mm\"", "", "[housing]", "`housing` lacks the required key `length_unit`"),
        (
            "group = \"case\", material",
            "grup = \"case\", material",
            "group = \"case\", material",
            "unknown key `housing.parts[0].grup`",
        ),
    ] {
        let number = 1 + FULL.lines().position(|text| text.contains(line)).unwrap();
        let error = read(&FULL.replacen(from, to, 1), &[]).unwrap_err();
        assert_eq!(error.to_string(), format!("folder/case.toml:{number}: {rest}"));
    }
}

#[test]
fn values_of_the_wrong_kind_are_named() {
    for (set, rest) in [
        ("title=3", "`title`: found 3, expected a string"),
        ("ring.shear=1", "`ring.shear`: found 1, expected true or false"),
        ("bearing.balls=-3", "`bearing.balls`: found -3, expected a whole number, 0 or more"),
        ("bearing.ball_radius=nan", "`bearing.ball_radius`: found NaN, expected a finite number"),
        ("shaft.mass=2011-01-01", "`shaft.mass`: found the date 2011-01-01, expected a number"),
        ("ring.bond=1", "`ring.bond`: found 1, expected one of `slip`, `composite`"),
        ("housing.plane=[1]", "`housing.plane`: found an array of 1, expected a table"),
        ("sensors=1", "`sensors`: found 1, expected an array"),
        ("materials=1", "`materials`: found 1, expected a table"),
        ("shaft.gravity=[0]", "`shaft.gravity`: found an array of 1, expected an array of 2"),
        ("shaft.gravity=[0,-1,0]", "`shaft.gravity`: found an array of 3, expected an array of 2"),
        ("shaft.gravity=[0,true]", "`shaft.gravity[1]`: found true, expected a number"),
        (
            "materials.printed.young=[1e9,1e9,1e9,1e9]",
            "`materials.printed.young`: found an array of 4, expected a number or an array of three",
        ),
        (
            "materials.printed.poisson=[0.3,0.3]",
            "`materials.printed.poisson`: found an array of 2, expected a number or an array of three",
        ),
        ("materials.printed.young=[1e9,true,1e9]", "`materials.printed.young[1]`: found true, expected a number"),
        (
            "bearing.stiffness=3e9",
            "`bearing.stiffness`: found 3000000000, expected \"hertz\", or { inner = NUMBER, outer = NUMBER }",
        ),
        (
            "bearing.race_material=[]",
            "`bearing.race_material`: found an array, expected a material's name, or { inner = NAME, outer = NAME }",
        ),
        ("transient.step={a=1}", "`transient.step`: found a table, expected \"auto\" or a number"),
        ("transient.step=true", "`transient.step`: found true, expected \"auto\" or a number"),
        ("transient.modes=-1", "`transient.modes`: found -1, expected \"auto\", \"all\" or a whole number"),
        (
            "condense.fixed_interface_modes=1.5",
            "`condense.fixed_interface_modes`: found 1.5, expected \"auto\", a whole number or { up_to_hz = NUMBER }",
        ),
        (
            "condense.interface_modes=1.5",
            "`condense.interface_modes`: found 1.5, expected \"none\", a whole number or { up_to_hz = NUMBER }",
        ),
    ] {
        assert_eq!(refusal(&[set]).0, format!("--set {set}: {rest}"));
    }
}

#[test]
fn keys_that_exclude_each_other_are_named() {
    const SUPPORT: &str = "exactly one of `fixed`, `spring`, `radial`";
    const DAMPING: &str = "exactly one of `ratios`, `alpha` with `beta`, `modal`";
    const SENSOR: &str = "exactly one of `group`, `ring_deg`, `node`, `point`, `recovered`";
    for (set, key, found, expected) in [
        ("housing.supports[0]={group='a'}", "housing.supports[0]", "none of them", SUPPORT),
        ("housing.supports[0]={group='a',fixed=['x'],radial=1}", "housing.supports[0]", "several", SUPPORT),
        (
            "housing.supports[0]={group='a',fixed=['x'],per='node'}",
            "housing.supports[0]",
            "`per` beside `fixed`",
            "`per` beside `spring` or `radial` only",
        ),
        ("damping={}", "damping", "none of them", DAMPING),
        ("damping={modal=0.1,alpha=1}", "damping", "several", DAMPING),
        ("damping={alpha=1}", "damping", "`alpha` without `beta`", DAMPING),
        ("damping={beta=1}", "damping", "`beta` without `alpha`", DAMPING),
        ("sensors[0]={name='a',direction=[0,1,0]}", "sensors[0]", "none of them", SENSOR),
        ("sensors[0]={name='a',group='a',ring_deg=1,direction=[0,1,0]}", "sensors[0]", "several", SENSOR),
        ("modes={count=1,up_to_hz=1}", "modes", "several", "one of `count`, `up_to_hz`, `band_hz`"),
        ("modes={band_hz=[1,2],up_to_hz=1}", "modes", "several", "one of `count`, `up_to_hz`, `band_hz`"),
    ] {
        let message = format!("--set {set}: `{key}`: found {found}, expected {expected}");
        assert_eq!(refusal(&[set]).0, message);
    }
}

#[test]
fn a_key_set_beside_one_that_it_excludes_says_how_to_replace_both() {
    let help = "to replace the whole table: --set 'modes={ band_hz = [1, 2] }'".to_owned();
    assert_eq!(refusal(&["modes.band_hz=[1, 2]"]).1, Some(help));
    assert_eq!(refusal(&["modes={count=1,up_to_hz=1}"]).1, None);
}

#[test]
fn text_and_arguments_that_are_malformed_are_named() {
    let error = read("title = \n", &[]).unwrap_err().to_string();
    assert!(error.starts_with("folder/case.toml:1: not valid TOML: "), "{error}");
    assert_eq!(refusal(&["ring.nodes"]).0, "--set ring.nodes: found no `=`, expected KEY=VALUE");
    let error = Case::load("no/such.toml", &[]).unwrap_err().to_string();
    assert!(error.starts_with("cannot read the case file no/such.toml: "));
}
