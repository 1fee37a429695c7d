//! Reference: the same mesh with the node in the middle of its edge.
//! Goal: a folded element is refused with the way to mend it; mended, it has the frequencies of the straight mesh, and is told.
//! Sketch: two Quad8 side by side, held at the left; the middle node between them lies beyond the far edge of the first.
//! Conditions: the program as a user runs it. Parameters: frequencies agree to 1e-12, coordinates to the last digit.

use super::grids::{Grids, modes, result};
use super::program::{errors, plummer, scratch};

/// The middle node of the common edge at this x.
fn write(folder: &std::path::Path, x: f64) {
    let mut grid = Grids::default();
    for from in [0.0, 0.1] {
        let corners = [[from, 0.0], [from + 0.1, 0.0], [from + 0.1, 0.1], [from, 0.1]];
        let middles = [[from + 0.05, 0.0], [from + 0.1, 0.05], [from + 0.05, 0.1], [from, 0.05]];
        let places = corners
            .iter()
            .chain(&middles)
            .map(|&[at, y]: &[f64; 2]| if (at - 0.1).hypot(y - 0.05) < 1e-12 { [x, y] } else { [at, y] });
        let nodes: Vec<usize> = places.map(|[x, y]| grid.node([x, y, 0.0], true)).collect();
        grid.element(16, 2, "plate", &nodes);
        if from == 0.0 {
            grid.element(8, 1, "foot", &[nodes[0], nodes[3], nodes[7]]);
        }
    }
    grid.write(folder);
}

const HOUSING: &str = "plane = { assumption = 'stress', thickness = 0.01 }\nparts = [{ group = 'plate', material = 'steel' }]\nsupports = [{ group = 'foot', fixed = ['x', 'y'] }]";

#[test]
fn folded_elements_get_straight_edges_on_request() {
    let folder = scratch("straighten");
    let straightened = format!("straighten = true\n{HOUSING}");
    write(&folder, 0.1);
    let (warnings, expected) = result(&folder, &modes(&folder, &straightened));
    assert_eq!(warnings, "[]");
    write(&folder, -0.03);
    let refused = modes(&folder, HOUSING);
    assert_eq!(refused.status.code(), Some(2));
    assert!(errors(&refused).contains("housing.straighten = true"), "{}", errors(&refused));
    let (warnings, found) = result(&folder, &modes(&folder, &straightened));
    assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    let told = "1 folded element of second order (1) mended by nodes between corners; 1 inside the body and along its plane faces moved by at most 130.00 % of the longest edge";
    assert!(warnings.contains(told), "{warnings}");
    let seen = plummer(&folder, &["inspect", "grid.msh"]);
    assert_eq!(seen.status.code(), Some(1));
    assert!(errors(&seen).contains("--straighten"), "{}", errors(&seen));
    let seen = plummer(&folder, &["inspect", "grid.msh", "--straighten"]);
    assert_eq!(seen.status.code(), Some(0), "{}", errors(&seen));
    let made = plummer(&folder, &["init", "grid.msh", "--length-unit", "m", "--straighten", "--out", "made.toml"]);
    assert_eq!(made.status.code(), Some(0), "{}", errors(&made));
    assert!(std::fs::read_to_string(folder.join("made.toml")).unwrap().contains("straighten = true"));
    let made = plummer(&folder, &["modes", "made.toml", "--out", "made"]);
    assert_eq!(made.status.code(), Some(0), "{}", errors(&made));
}
