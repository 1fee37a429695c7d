//! Reference: the places where boxes were made wrong, in closed form.
//! Goal: elements that are there twice, bodies that lie in one another, and rings that do not fit are refused or said, whichever way.
//! Sketch: a cube of 0.1 m in two by two by two Hex8, held at its bottom, with one thing wrong each; a bore of 36 cells.
//! Conditions: the program as a user runs it. Parameters: none; there is no tolerance.

use std::f64::consts::TAU;

use super::grids::{Grids, modes, result, steps};
use super::program::{errors, plummer, scratch};

const HELD: &str = "supports = [{ group = 'a_bottom', fixed = ['x', 'y', 'z'] }]";

/// The cube, and the nodes of its elements.
fn cube() -> (Grids, Vec<Vec<usize>>) {
    let mut grid = Grids::default();
    let side = steps(0.0, 0.1, 2);
    let cells = grid.solid("a", [&side, &side, &side], false);
    (grid, cells)
}

/// `Err` with words of the refusal, or `Ok` with words of a warning; no words: nothing is said.
type Said = Result<&'static str, &'static str>;

fn check(folder: &str, name: &str, grid: &Grids, housing: &str, said: Said) {
    let folder = scratch(folder);
    grid.write(&folder);
    let output = modes(&folder, housing);
    match said {
        Err(words) => {
            let found = errors(&output);
            assert_eq!(output.status.code(), Some(2), "{name}: {found}");
            assert!(found.contains(words), "{name}: {words} in: {found}");
        }
        Ok(words) => {
            let (found, _) = result(&folder, &output);
            assert!(found.contains(words), "{name}: {words} in: {found}");
            assert_eq!(found == "[]", words.is_empty(), "{name}: {found}");
        }
    }
}

#[test]
fn elements_that_are_there_twice() {
    let parts = format!("parts = [{{ group = 'a', material = 'steel' }}]\n{HELD}");
    // gmsh's type, its dimension and group, and which corners of the first element it takes
    type Extra = (usize, usize, &'static str, &'static [usize]);
    let doubled: Said = Err("on the corners of another element");
    let within: Said = Err("have their centre in another element");
    let crossed: Said = Err("is no face of the housing's elements");
    for (name, extra, said) in [
        ("turned about z", &[(5, 3, "a", &[1, 2, 3, 0, 5, 6, 7, 4])], doubled),
        ("turned about x", &[(5, 3, "a", &[0, 4, 5, 1, 3, 7, 6, 2])], doubled),
        ("inside out", &[(5, 3, "a", &[4, 5, 6, 7, 0, 1, 2, 3])], doubled),
        ("a tetrahedron in it", &[(4, 3, "a", &[0, 1, 2, 6])], within),
        ("a wedge in it", &[(6, 3, "a", &[0, 1, 2, 4, 5, 6])], within),
        ("a face again", &[(3, 2, "a_bottom", &[3, 2, 1, 0])], Ok("")),
        ("a face as a group of another name", &[(3, 2, "b", &[0, 1, 2, 3])], Ok("")),
        ("a face in the group of solids", &[(3, 3, "a", &[0, 1, 2, 3])], Ok("")),
        ("a face whose sides cross", &[(3, 2, "a_bottom", &[0, 2, 1, 3])], crossed),
        ("a quadrilateral between faces", &[(3, 2, "a_bottom", &[0, 1, 6, 7])], crossed),
        ("a face inside", &[(3, 2, "a_bottom", &[7, 6, 5, 4])], Ok("")),
    ] as [(&str, &[Extra], Said); 11]
    {
        let (mut grid, cells) = cube();
        for (kind, dimension, group, corners) in extra {
            let nodes: Vec<usize> = corners.iter().map(|&corner| cells[0][corner]).collect();
            grid.element(*kind, *dimension, group, &nodes);
        }
        check("bodies-elements", name, &grid, &parts, said);
    }
    // no draft of a case either
    let (mut grid, cells) = cube();
    grid.element(5, 3, "a", &cells[0]);
    let folder = scratch("bodies-draft");
    grid.write(&folder);
    let draft = plummer(&folder, &["init", "grid.msh", "--length-unit", "m"]);
    assert_eq!(draft.status.code(), Some(2));
    assert!(errors(&draft).contains("no case file was written"), "{}", errors(&draft));
    assert!(!folder.join("grid.toml").exists());
    // a triangle in a face of the support, which is shared by area
    let springs = "parts = [{ group = 'a', material = 'steel' }]\nsupports = [{ group = 'a_bottom', spring = { x = 1e8, y = 1e8, z = 1e8 }, per = 'group' }]";
    let frequencies = [false, true].map(|again| {
        let (mut grid, cells) = cube();
        if again {
            grid.element(2, 2, "a_bottom", &cells[0][..3]);
        }
        let folder = scratch("bodies-triangle");
        grid.write(&folder);
        result(&folder, &modes(&folder, springs)).1
    });
    let [once, twice] = frequencies.map(f64::to_bits);
    assert_eq!(once, twice);
}

#[test]
fn bodies_in_and_on_one_another() {
    let parts = "parts = [{ group = 'a', material = 'steel' }, { group = 'b', material = 'steel' }]";
    let supports =
        "supports = [{ group = 'a_bottom', fixed = ['x', 'y', 'z'] }, { group = 'b_top', fixed = ['x', 'y', 'z'] }]";
    let crossing = Ok("the parts \\\"a\\\" and \\\"b\\\" reach into one another");
    let touching = Ok("the parts \\\"a\\\" and \\\"b\\\" touch without common nodes");
    let side = steps(0.0, 0.1, 2);
    for (name, [xs, ys, zs], said) in [
        ("a cube inside", [vec![0.025, 0.075], vec![0.025, 0.075], vec![0.025, 0.075]], crossing),
        (
            "a cube inside one element",
            [vec![0.01, 0.03], vec![0.01, 0.03], vec![0.01, 0.03]],
            Err("have their centre in"),
        ),
        ("a needle between all centres", [vec![0.045, 0.055], vec![0.045, 0.055], steps(-0.2, 0.3, 2)], crossing),
        ("a bar across between all centres", [vec![-0.2, 0.3], vec![0.04, 0.06], vec![0.04, 0.06]], crossing),
        ("into it by a thousandth", [side.clone(), side.clone(), steps(0.0999, 0.2, 2)], crossing),
        ("on it", [side.clone(), side.clone(), steps(0.1, 0.2, 2)], touching),
        ("on it but for 1e-9 m", [side.clone(), side.clone(), steps(0.1 + 1e-9, 0.2, 2)], touching),
        ("into it by 1e-9 m", [side.clone(), side.clone(), steps(0.1 - 1e-9, 0.2, 2)], touching),
        ("beside by 1e-9 m", [steps(1e-9, 0.1 + 1e-9, 2), side.clone(), steps(0.1, 0.2, 2)], touching),
        ("apart", [side.clone(), side.clone(), steps(0.102, 0.2, 2)], Ok("")),
        ("along an edge", [steps(0.1, 0.2, 2), steps(0.1, 0.2, 2), side.clone()], Ok("")),
        ("at a corner", [steps(0.1, 0.2, 2), steps(0.1, 0.2, 2), steps(0.1, 0.2, 2)], Ok("")),
    ] as [(&str, [Vec<f64>; 3], Said); 12]
    {
        let (mut grid, _) = cube();
        grid.solid("b", [&xs, &ys, &zs], false);
        check("bodies-two", name, &grid, &format!("{parts}\n{supports}"), said);
    }
}

#[test]
fn rings_that_do_not_fit() {
    // cells of the bore in its group, its flattening over its radius, and the ring's outer radius and place
    for (name, cells, oval, outer, centre, said) in [
        ("fits", 36, 0.0, 6e-3, [0.0; 3], Ok("")),
        ("half of the bore", 18, 0.0, 6e-3, [0.0; 3], Ok("leaves 180 degrees of the turn free")),
        ("a face of the bore", 1, 0.0, 6e-3, [0.0; 3], Ok("leaves 350 degrees of the turn free")),
        ("oval", 36, 0.02, 6e-3, [0.0; 3], Err("they lie 0.00588 to 0.00612 m from the axis")),
        ("another radius", 36, 0.0, 6.1e-3, [0.0; 3], Err("at the ring's outer radius 0.0061 m")),
        ("in millimetres", 36, 0.0, 6.0, [0.0; 3], Err("check length_unit")),
        ("beside the axis", 36, 0.0, 6e-3, [2e-4, 0.0, 0.0], Err("check length_unit, tie.centre")),
        ("at the end of the bore", 36, 0.0, 6e-3, [0.0, 0.0, 2e-3], Ok("50 % of the ring's width lies outside")),
        ("beyond the bore", 36, 0.0, 6e-3, [0.0, 0.0, 3e-3], Err("bore")),
    ] as [(&str, usize, f64, f64, [f64; 3], Said); 9]
    {
        let mut grid = Grids::default();
        let mut rows = Vec::new();
        for z in steps(-2e-3, 2e-3, 2) {
            for radius in [6e-3, 7.5e-3, 9e-3] {
                let first = grid.nodes.len() + 1;
                for i in 0..36 {
                    let angle = TAU * f64::from(i) / 36.0;
                    let shape = if radius < 7e-3 { 1.0 + oval * (2.0 * angle).cos() } else { 1.0 };
                    grid.nodes.push([shape * radius * angle.cos(), shape * radius * angle.sin(), z]);
                }
                rows.push(first);
            }
        }
        for z in 0..2 {
            for i in 0..36 {
                let next = (i + 1) % 36;
                for row in [3 * z, 3 * z + 1] {
                    let low = [rows[row] + i, rows[row + 1] + i, rows[row + 1] + next, rows[row] + next];
                    let high = low.map(|node| node + 3 * 36);
                    grid.element(5, 3, "a", &[low, high].concat());
                }
                let [low, high] = [rows[3 * z], rows[3 * z + 3]];
                if i < cells {
                    grid.element(3, 2, "bore", &[low + i, low + next, high + next, high + i]);
                }
                let [low, high] = [rows[3 * z + 2], rows[3 * z + 5]];
                grid.element(3, 2, "a_bottom", &[low + i, low + next, high + next, high + i]);
            }
        }
        let housing = format!(
            "parts = [{{ group = 'a', material = 'aluminium' }}]\n{HELD}\n[ring]\nsections = [{{ material = 'steel', area = 5.37e-6, inertia = 8.88e-13, radius = 5.314e-3 }}]\nouter_radius = {outer}\ntie = {{ group = 'bore', centre = {centre:?} }}"
        );
        check("bodies-rings", name, &grid, &housing, said);
    }
}
