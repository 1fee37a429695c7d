//! Reference: distances, volumes and masses of boxes in closed form.
//! Goal: a tie across a gap or from within the other body is never computed in silence.
//! Sketch: a cube of 0.1 m on another one of 0.1 m, apart by some share of it, tied by their faces and by their bodies.
//! Conditions: the program as a user runs it. Parameters: none; there is no tolerance.

use super::grids::{Grids, modes, result, steps};
use super::program::{errors, scratch};

fn write(folder: &std::path::Path, gap: f64) {
    let mut grid = Grids::default();
    let side = steps(0.0, 0.1, 2);
    grid.solid("a", [&side, &side, &side], false);
    let finer = steps(0.0, 0.1, 3);
    let up = steps(0.1 + gap, 0.2 + gap, 3);
    grid.solid("b", [&finer, &finer, &up], false);
    grid.write(folder);
}

fn housing(between: [&str; 2], more: &str) -> String {
    let [a, b] = between;
    format!(
        "parts = [{{ group = 'a', material = 'steel' }}, {{ group = 'b', material = 'steel' }}]\nsupports = [{{ group = 'a_bottom', fixed = ['x', 'y', 'z'] }}]\nlinks = [{{ between = ['{a}', '{b}'], tie = true }}]\n{more}"
    )
}

/// 7850 kg/m^3 on 0.01 m^2.
#[test]
fn ties_across_a_gap_are_said_and_from_within_refused() {
    let folder = scratch("ties");
    let faces = ["a_top", "b_bottom"];
    write(&folder, 0.0);
    for between in [faces, ["a", "b"]] {
        let (warnings, _) = result(&folder, &modes(&folder, &housing(between, "")));
        assert_eq!(warnings, "[]");
    }
    for (between, gap, words) in [
        (faces, 0.02, ["up to 0.02 m, 0.40 of the size", "about 1.57 kg of material would fill the gap"]),
        (faces, 0.0004, ["up to 4e-4 m, 0.01 of the size", "about 0.0314 kg of material would fill the gap"]),
        (["a", "b"], 0.004, ["up to 0.004 m, 0.08 of the size", "about 0.314 kg of material would fill the gap"]),
    ] {
        write(&folder, gap);
        let (warnings, _) = result(&folder, &modes(&folder, &housing(between, "")));
        for word in words.into_iter().chain(["16 of 16 tied nodes", "the farthest is node"]) {
            assert!(warnings.contains(word), "{word} in: {warnings}");
        }
    }
    // no centre of an element lies in another one; of bodies, nodes at the rim lie on the sides of the other
    write(&folder, -0.004);
    for (between, inside, twice) in [
        (faces, "16 of them into the other body", "; about 0.314 kg count twice"),
        (["a", "b"], "4 of them into the other body", "; about 0.1396 kg count twice"),
    ] {
        let refused = modes(&folder, &housing(between, ""));
        let said = errors(&refused);
        assert_eq!(refused.status.code(), Some(2), "{said}");
        for word in [inside, twice, "housing.overlap"] {
            assert!(said.contains(word), "{word} in: {said}");
        }
        let (warnings, _) = result(&folder, &modes(&folder, &housing(between, "overlap = 'allow'")));
        assert!(warnings.contains(twice), "{warnings}");
    }
}
