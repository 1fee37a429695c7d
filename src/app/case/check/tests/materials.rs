//! Materials: constants that make one, and where which kind may stand.

use super::{breaks, full, holds};
use crate::app::case::check::range::direction;
use crate::app::case::tests::{FULL, read};

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
fn materials_exist() {
    for key in ["housing.parts[0].material", "ring.sections[0].material", "bearing.ball_material"] {
        full(&format!("{key}=\"steal\""), "no material is called \"steal\"");
    }
    for (argument, name) in [
        ("bearing.race_material=lead", "lead"),
        ("bearing.race_material={inner=\"tin\",outer=\"steel\"}", "tin"),
        ("bearing.race_material={inner=\"steel\",outer=\"tin\"}", "tin"),
    ] {
        full(argument, &format!("no material is called \"{name}\""));
    }
    let help = |name: &str| {
        let argument = format!("bearing.ball_material=\"{name}\"");
        read(FULL, &[&argument]).unwrap_err().help().unwrap()
    };
    let known = "materials here: 1.4301, EN-GJL-200, EN-GJL-250, EN-GJS-400-15, PA66-GF30, POM, aluminium, bearing steel, \
        brass, cast aluminium, cast magnesium, my alloy, printed, silicon nitride, steel";
    assert_eq!(help("steal"), format!("did you mean `steel`? {known}"));
    assert_eq!(help("EN-GJL-25"), format!("did you mean `EN-GJL-250`? {known}"));
    assert_eq!(help("unobtainium"), known);
    let built_in = "the nearest that is built in is \"EN-GJL-250\" (plummer init --list-materials); or give it a table";
    assert_eq!(help("GG25"), format!("{built_in} [materials.\"GG25\"]; {known}"));
    // three letters from grey iron
    let ductile = "the nearest that is built in is \"EN-GJS-400-15\" ";
    assert!(help("EN-GJS-400").starts_with(ductile), "{}", help("EN-GJS-400"));
}

#[test]
fn rings_and_contacts_are_isotropic() {
    let rule = "\"printed\" is orthotropic, expected an isotropic material: rings and contacts have no other";
    for key in ["ring.sections[0].material", "bearing.ball_material", "bearing.race_material"] {
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
    full("materials.printed.x_axis=[0,0,0]", "found a vector of length zero, expected a direction");
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
        ("young=1e300,poisson=0.3,density=7800", "materials.steel.young", "expected a modulus from 1e-6 to 1e18 Pa"),
    ] {
        let text = read(FULL, &[&material(keys)]).unwrap_err().to_string();
        assert!(text.contains(&format!("`{key}`")) && text.contains(rule), "{text}");
    }
    for length in ["1e-200", "1e200"] {
        let broken = direction("direction", [length.parse().unwrap(), 0.0, 0.0]);
        assert!(broken.is_err(), "{length}");
    }
}
