//! Reference: the same meshes with plain elements, whose lowest frequency errs by +12 % at most in such layers.
//! Goal: a flat layer of incompatible elements that something stiff holds is said wherever it is far too soft, and not else.
//! Sketch: a plate of 0.4 m in four by four cells, 10 mm high, alone or with blocks of 0.1 m above and below.
//! Conditions: the program as a user runs it. Parameters: a frequency counts as far too low below 0.85 of the plain one, which the
//!   plain elements' own error cannot make.

use super::grids::{Grids, modes, result, steps};
use super::program::scratch;

const FAR_TOO_LOW: f64 = 0.85;

/// Blocks on each other from z = 0 on: name, height, cells over it, and whether it shares its nodes with what is below.
type Stack<'s> = &'s [(&'s str, f64, usize, bool)];

fn write(folder: &std::path::Path, stack: Stack) {
    let mut grid = Grids::default();
    let side = steps(0.0, 0.4, 4);
    let mut floor = 0.0;
    for &(name, height, cells, joined) in stack {
        let up = steps(floor, floor + height, cells);
        grid.solid(name, [&side, &side, &up], joined);
        floor += height;
    }
    grid.write(folder);
}

#[test]
fn flat_layers_are_said_where_they_are_too_soft() {
    let folder = scratch("layers");
    let fixed = "supports = [{ group = 'a_bottom', fixed = ['x', 'y', 'z'] }]";
    let springs = |stiffness: &str| {
        format!(
            "supports = [{{ group = 'a_bottom', spring = {{ x = {stiffness}, y = {stiffness}, z = {stiffness} }} }}]"
        )
    };
    let ply = |young: [f64; 3], shear: [f64; 3]| {
        format!("[materials.ply]\nyoung = {young:?}\npoisson = [0, 0, 0]\nshear = {shear:?}\ndensity = 8000")
    };
    let tie = "links = [{ between = ['a_top', 'b_bottom'], tie = true }]";
    let plate: Stack = &[("a", 0.01, 1, false)];
    let block: Stack = &[("a", 0.1, 1, false), ("b", 0.01, 1, true)];
    let laminated: Stack = &[("a", 0.01, 1, false), ("b", 0.01, 1, true)];
    for (name, stack, materials, more, told) in [
        ("held", plate, ["steel", ""], fixed.to_owned(), true),
        ("on stiff springs", plate, ["steel", ""], springs("1e15"), true),
        ("on soft springs", plate, ["steel", ""], springs("1e5"), false),
        ("on a stiffer block", block, ["steel", "rubber"], fixed.to_owned(), true),
        ("on a block of its own", block, ["steel", "steel"], fixed.to_owned(), false),
        (
            "tied to a stiffer block",
            &[("a", 0.1, 1, false), ("b", 0.01, 1, false)],
            ["steel", "rubber"],
            format!("{fixed}\n{tie}"),
            true,
        ),
        (
            "between stiffer blocks, in two elements",
            &[("a", 0.1, 1, false), ("b", 0.01, 2, true), ("a", 0.002, 1, true)],
            ["steel", "rubber"],
            fixed.to_owned(),
            true,
        ),
        (
            "between stiffer blocks, in one element",
            &[("a", 0.1, 1, false), ("b", 0.01, 1, true), ("a", 0.1, 1, true)],
            ["steel", "rubber"],
            fixed.to_owned(),
            false,
        ),
        (
            "soft along it",
            block,
            ["steel", "ply"],
            format!("{fixed}\n{}", ply([1e9, 1e9, 2e11], [1e9, 8e10, 8e10])),
            true,
        ),
        (
            "stiff along it",
            block,
            ["steel", "ply"],
            format!("{fixed}\n{}", ply([2e11, 2e11, 1e9], [8e10, 1e8, 1e8])),
            false,
        ),
        (
            "soft along it, half as high as its edges",
            &[("a", 0.1, 1, false), ("b", 0.05, 1, true)],
            ["steel", "ply"],
            format!("{fixed}\n{}", ply([1e9, 1e9, 2e11], [1e9, 8e10, 8e10])),
            true,
        ),
        (
            "stiff along it, held",
            plate,
            ["ply", ""],
            format!("{fixed}\n{}", ply([2e11, 2e11, 1e9], [8e10, 1e8, 1e8])),
            false,
        ),
        (
            "on a laminate that is held",
            laminated,
            ["ply", "POM"],
            format!("{fixed}\n{}", ply([7e10, 7e10, 9e9], [5e9, 4e9, 4e9])),
            true,
        ),
        ("as high as its edges", &[("a", 0.1, 1, false)], ["steel", ""], fixed.to_owned(), false),
    ] as [(&str, Stack, [&str; 2], String, bool); 14]
    {
        write(&folder, stack);
        let parts = ["a", "b"].into_iter().zip(materials).filter(|(_, material)| !material.is_empty());
        let parts = parts.map(|(part, material)| format!("{{ group = '{part}', material = '{material}' }},"));
        let housing = format!("parts = [{}]\n{more}", parts.collect::<String>());
        let (warnings, own) = result(&folder, &modes(&folder, &housing));
        let plain = format!("linear = 'plain'\n{housing}");
        let (_, plain) = result(&folder, &modes(&folder, &plain));
        assert_eq!(warnings.contains("flat layers"), told, "{name}: {warnings}");
        assert_eq!(own < FAR_TOO_LOW * plain, told, "{name}: {own} Hz, plain {plain} Hz");
    }
}

/// A block of steel on a pad that is held below; the fourth mode is the first one that presses it.
#[test]
fn single_elements_of_rubber_between_held_faces_are_told() {
    let folder = scratch("pads");
    let fourth = |material: &str, cells: usize| {
        write(&folder, &[("a", 0.2, cells, false), ("b", 0.2, 1, true)]);
        let parts = format!("{{ group = 'a', material = '{material}' }}, {{ group = 'b', material = 'steel' }}");
        let support = "supports = [{ group = 'a_bottom', fixed = ['x', 'y', 'z'] }]";
        let (warnings, _) = result(&folder, &modes(&folder, &format!("parts = [{parts}]\n{support}")));
        let json = std::fs::read_to_string(folder.join("out/modes.json")).unwrap();
        let json: serde_json::Value = serde_json::from_str(&json).unwrap();
        (warnings.contains("stand alone between held faces"), json["frequencies_hz"][3].as_f64().unwrap())
    };
    for (material, told) in [("rubber", true), ("POM", false)] {
        let ((one, stiff), (two, right)) = (fourth(material, 1), fourth(material, 2));
        assert_eq!([one, two], [told, false], "{material}");
        assert_eq!(stiff > 1.25 * right, told, "{material}: {stiff} and {right} Hz");
    }
}

#[test]
fn materials_that_keep_their_volume_are_told() {
    let folder = scratch("gel");
    write(&folder, &[("a", 0.1, 1, false)]);
    for (poisson, told) in [(0.4901, true), (0.49, false)] {
        let gel = format!("[materials.gel]\nyoung = 5e6\npoisson = {poisson}\ndensity = 1000");
        let housing = format!("parts = [{{ group = 'a', material = 'gel' }}]\n{gel}");
        let (warnings, _) = result(&folder, &modes(&folder, &housing));
        assert_eq!(warnings.contains("a Poisson's ratio above 0.49"), told, "{poisson}: {warnings}");
    }
}
