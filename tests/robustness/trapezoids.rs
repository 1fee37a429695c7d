//! Reference: the same bodies of straight elements, whose lowest frequency is within 3 % of the right one.
//! Goal: elements whose tilted sides make a thin body far too stiff are said, and no others.
//! Sketch: a strip of 100 x 20 mm, 5 mm thick, one or more elements across its thickness, fixed at one end. The sides of its
//!   elements are tilted to and fro, or its inner nodes are moved at random along it.
//! Conditions: the program as a user runs it. Parameters: a frequency counts as far too high from 1.25 times on.

use super::grids::{Grids, modes, result, steps};
use super::program::scratch;

const FAR_TOO_HIGH: f64 = 1.25;

/// What moves the nodes between the ends, by their place.
#[derive(Clone, Copy)]
enum Moved {
    /// Sides tilted to and fro by so many degrees.
    Tilted(f64),
    /// Along the strip by this part of an edge at most, the same across the thickness or not.
    Shaken { by: f64, alike: bool },
}

/// The lowest frequency and the warnings of a strip of this thickness, m.
fn strip(thickness: f64, layers: usize, moved: Moved, more: &str) -> (String, f64) {
    let folder = scratch("trapezoids");
    let (length, cells) = (0.1, 10);
    let mut grids = Grids::default();
    let sections = [steps(0.0, thickness, layers), steps(0.0, 0.02, 2), steps(0.0, length, cells)];
    grids.solid("a", sections.each_ref().map(Vec::as_slice), false);
    let edge = length / cells as f64;
    for (index, node) in grids.nodes.iter_mut().enumerate() {
        let row = (node[2] / edge).round() as usize;
        if row == 0 || row == cells {
            continue;
        }
        node[2] += match moved {
            Moved::Tilted(angle) => {
                let side = if row.is_multiple_of(2) { 1.0 } else { -1.0 };
                side * angle.to_radians().tan() * (node[0] - 0.5 * thickness)
            }
            Moved::Shaken { by, alike } => {
                // the nodes of a row across the thickness follow each other
                let which = if alike { index / (layers + 1) } else { index };
                by * edge * (12.9898 * (which + 1) as f64).sin()
            }
        };
    }
    grids.write(&folder);
    let housing = format!(
        "parts = [{{ group = 'a', material = 'steel' }}]\nsupports = [{{ group = 'a_bottom', fixed = ['x', 'y', 'z'] }}]\n{more}"
    );
    result(&folder, &modes(&folder, &housing))
}

#[test]
fn tilted_sides_are_said_where_they_lock() {
    let words = "with tilted sides in thin places";
    let thin = 0.005;
    for (name, thickness, layers, moved, told) in [
        ("tilted by 5 degrees", thin, 1, Moved::Tilted(5.0), false),
        ("tilted by 20 degrees", thin, 1, Moved::Tilted(20.0), true),
        ("tilted by 30 degrees", thin, 1, Moved::Tilted(30.0), true),
        ("tilted by 10 degrees in a thick strip", 0.02, 1, Moved::Tilted(10.0), false),
        ("inner nodes moved", 0.002, 1, Moved::Shaken { by: 0.3, alike: false }, true),
        ("inner nodes moved in two layers", 0.002, 2, Moved::Shaken { by: 0.3, alike: false }, true),
        ("inner nodes moved in a thick strip", 0.02, 4, Moved::Shaken { by: 0.1, alike: false }, false),
        ("cells of all lengths with straight sides", 0.002, 1, Moved::Shaken { by: 0.3, alike: true }, false),
    ] {
        let (_, right) = strip(thickness, layers, Moved::Tilted(0.0), "");
        let (warnings, own) = strip(thickness, layers, moved, "");
        assert_eq!(warnings.contains(words), told, "{name}, {:.2} times: {warnings}", own / right);
        assert_eq!(own > FAR_TOO_HIGH * right, told, "{name}: {own} Hz, straight {right} Hz");
    }
    // plain elements lock without tilted sides too, and are said to
    let (warnings, _) = strip(thin, 1, Moved::Tilted(30.0), "linear = 'plain'");
    assert!(!warnings.contains(words) && warnings.contains("plain Hex8 elements"), "{warnings}");
}

/// What stands on a held face cannot bend.
#[test]
fn tilted_sides_on_a_held_face_are_not_said() {
    let folder = scratch("trapezoids-held");
    let mut grids = Grids::default();
    let side = steps(0.0, 0.02, 4);
    grids.solid("a", [&side, &side, &steps(0.0, 0.002, 1)], false);
    for (index, node) in grids.nodes.iter_mut().enumerate() {
        if (1e-9..0.0199).contains(&node[0]) {
            node[0] += 0.0015 * (12.9898 * (index + 1) as f64).sin();
        }
    }
    grids.write(&folder);
    let part = "parts = [{ group = 'a', material = 'steel' }]\n";
    let fixed = |group: &str| format!("{part}supports = [{{ group = '{group}', fixed = ['x', 'y', 'z'] }}]");
    let (free, _) = result(&folder, &modes(&folder, part));
    assert!(free.contains("with tilted sides"), "{free}");
    let (held, _) = result(&folder, &modes(&folder, &fixed("a_bottom")));
    assert!(!held.contains("with tilted sides"), "{held}");
}
