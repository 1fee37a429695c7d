//! Reference: the same square counter-clockwise.
//! Goal: a plane mesh seen from behind gives the same frequencies and says so; a mixed surface is refused with an element.
//! Sketch: two squares of 0.1 m on each other, each a group, in elements of each plane kind, held at the bottom and on springs at the top.
//! Conditions: the program as a user runs it. Parameters: frequencies agree to 1e-9, round-off of sums in another order.

use super::grids::{Grids, modes, result};
use super::program::{errors, plummer, scratch};

/// Nodes of a square from (0, y) counter-clockwise, first corners, then middles; and its elements by their gmsh type.
const KINDS: [(usize, &[&[usize]]); 4] = [
    (3, &[&[0, 1, 2, 3]]),
    (2, &[&[0, 1, 2], &[0, 2, 3]]),
    (16, &[&[0, 1, 2, 3, 4, 5, 6, 7]]),
    (9, &[&[0, 1, 2, 4, 5, 8], &[0, 2, 3, 8, 6, 7]]),
];

/// The same nodes the other way round, as gmsh orders them.
fn backwards(kind: usize, nodes: &[usize]) -> Vec<usize> {
    let order: &[usize] = match kind {
        2 => &[1, 0, 2],
        3 => &[1, 0, 3, 2],
        9 => &[1, 0, 2, 3, 5, 4],
        _ => &[1, 0, 3, 2, 4, 7, 6, 5],
    };
    order.iter().map(|&place| nodes[place]).collect()
}

/// The squares "a" and "b"; `turned` of each: how many of its elements run clockwise. Each element is on a surface of its own
/// if `apart`.
fn write(folder: &std::path::Path, kind: usize, elements: &[&[usize]], turned: [usize; 2], apart: bool) {
    let mut grid = Grids::default();
    let quadratic = kind > 3;
    for (name, floor, turned) in [("a", 0.0, turned[0]), ("b", 0.1, turned[1])] {
        let corners = [[0.0, 0.0], [0.1, 0.0], [0.1, 0.1], [0.0, 0.1]];
        let middles = [[0.05, 0.0], [0.1, 0.05], [0.05, 0.1], [0.0, 0.05], [0.05, 0.05]];
        let places = corners.iter().chain(middles.iter().take(match kind {
            9 => 5,
            16 => 4,
            _ => 0,
        }));
        let nodes: Vec<usize> = places.map(|[x, y]| grid.node([*x, y + floor, 0.0], true)).collect();
        for (number, element) in elements.iter().enumerate() {
            let own: Vec<usize> = element.iter().map(|&place| nodes[place]).collect();
            let own = if number < turned { backwards(kind, &own) } else { own };
            let entity = if apart { 100 + number } else { 100 };
            grid.element_on(entity + 10 * usize::from(name == "b"), kind, 2, name, &own);
        }
        let (edge, from) = if name == "a" { ("foot", 0) } else { ("roof", 2) };
        let mut ends = vec![nodes[from], nodes[from + 1]];
        if quadratic {
            ends.push(nodes[4 + from]);
        }
        grid.element(if quadratic { 8 } else { 1 }, 1, edge, &ends);
    }
    grid.write(folder);
}

const HOUSING: &str = "plane = { assumption = 'stress', thickness = 0.01 }\nparts = [{ group = 'a', material = 'steel' }, { group = 'b', material = 'aluminium' }]\nsupports = [{ group = 'foot', fixed = ['x', 'y'] }, { group = 'roof', spring = { x = 1e6 } }]";

#[test]
fn surfaces_that_run_clockwise_are_turned() {
    let folder = scratch("turned");
    for (kind, elements) in KINDS {
        let all = elements.len();
        write(&folder, kind, elements, [0, 0], false);
        let (as_drawn, expected) = result(&folder, &modes(&folder, HOUSING));
        // 2: triangles of first order, which lock in bending
        assert_eq!(as_drawn == "[]", kind != 2, "{kind}: {as_drawn}");
        // a group of two surfaces, one of which runs clockwise, in the end
        for (turned, apart) in [([all, 0], false), ([0, all], false), ([all, all], false), ([1, 0], true)] {
            write(&folder, kind, elements, turned, apart);
            let (warnings, found) = result(&folder, &modes(&folder, HOUSING));
            assert!((found / expected - 1.0).abs() < 1e-9, "{kind} {turned:?}: {found} {expected}");
            let said =
                format!("{} elements of the plane mesh ran clockwise and were turned round", turned[0] + turned[1]);
            assert!(warnings.contains(&said), "{warnings}");
            let seen = plummer(&folder, &["inspect", "grid.msh", "--length-unit", "m"]);
            assert_eq!(seen.status.code(), Some(0), "{}", errors(&seen));
            assert!(String::from_utf8_lossy(&seen.stdout).contains(&said));
        }
        if all > 1 {
            write(&folder, kind, elements, [1, 0], false);
            let mixed = modes(&folder, HOUSING);
            let said = errors(&mixed);
            assert_eq!(mixed.status.code(), Some(2), "{said}");
            assert!(said.contains("element 1") && said.contains("clockwise"), "{said}");
        }
    }
}
