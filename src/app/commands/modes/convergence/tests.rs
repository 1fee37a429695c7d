//! The ring of examples/modal on its three meshes, against the exact solution beside it.

use super::*;
use crate::app::case::Source;
use crate::app::commands::modes::compute_modes;
use crate::formats::read_modes_csv;
use crate::numerics::Unwatched;
use std::path::{Path, PathBuf};

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

const RING: &str = "[ring]\nnodes = 24\nouter_radius = 6e-3\n\
    sections = [{ material = \"steel\", area = 5.37e-6, inertia = 8.88e-13, radius = 5.314e-3 }]\n\
    tie = { group = \"bore\" }\n";

/// The annulus on `mesh` beside `others`, in TOML.
fn case(mesh: &str, others: &str, more: &str) -> Case {
    let text = format!(
        "[materials.aluminium]\nyoung = 72e9\npoisson = 0.33\ndensity = 2700\n\
         [housing]\nmesh = \"{mesh}\"\nlength_unit = \"mm\"\n\
         plane = {{ assumption = \"stress\", thickness = 4e-3 }}\n\
         parts = [{{ group = \"housing\", material = \"aluminium\" }}]\n{more}\
         [modes]\ncount = 12\nconvergence = {{ meshes = [{others}] }}\n"
    );
    let source = Source { path: path("meshes/case.toml"), text, set: Vec::new() };
    Case::from_source(source).expect("a case")
}

fn converged(case: &Case) -> MeshConvergence {
    let result = compute_modes(case, &Unwatched).expect("modes");
    result.convergence.expect("a convergence")
}

/// The nine elastic frequencies of examples/modal/exact_ring.csv, Hz.
fn exact() -> Vec<f64> {
    let modes = read_modes_csv(&path("examples/modal/exact_ring.csv")).expect("a file");
    assert_eq!(modes.frequencies_hz.len(), 9);
    modes.frequencies_hz
}

/// Whichever of the three meshes is the case's own: its error is in the stated interval, and the estimate is nearer to
/// the exact frequency than that of the finest mesh.
#[test]
fn the_mesh_error_is_that_against_the_exact_frequency() {
    let exact = exact();
    let names = ["ring_6_9.msh", "ring_6_9_48.msh", "ring_6_9_24.msh"];
    for own in 0..3 {
        let others = [names[(own + 1) % 3], names[(own + 2) % 3]];
        let others = format!("\"{}\", \"{}\"", others[0], others[1]);
        let found = converged(&case(names[own], &others, ""));
        let sizes: Vec<f64> = found.meshes.iter().map(|mesh| mesh.element_size_m).collect();
        // 24, 96, 216 elements of 45 pi mm^2
        for (size, elements) in sizes.iter().zip([24.0, 96.0, 216.0_f64]) {
            let drawn = (45e-6 * std::f64::consts::PI / elements).sqrt();
            // curved sides of parabolas miss 1e-5 of the circles' area
            assert!((size / drawn - 1.0).abs() < 1e-4, "{size} {drawn}");
        }
        let is_own = |mesh: &SequenceMesh| mesh.own;
        assert_eq!(found.meshes.iter().position(is_own), Some(2 - own));
        assert!(found.notes.is_empty(), "{:?}", found.notes);
        assert_eq!(found.modes.len(), 9);
        for (mode, exact) in found.modes.iter().zip(&exact) {
            let own_hz = mode.frequencies_hz[2 - own].expect("its own");
            let [error, around] = [mode.mesh_error, mode.mesh_error_uncertainty].map(Option::unwrap);
            let real = own_hz / exact - 1.0;
            assert!((error - real).abs() <= around, "{own} {exact}: {error} {around} {real}");
            let limit = mode.limit.as_ref().expect("a limit");
            let left = (limit.estimate.expect("an estimate") - exact).abs();
            // measured: 0.05 to 0.39 of the finest mesh's distance
            assert!(left < 0.5 * (limit.finest - exact).abs(), "{own} {exact} {left}");
            assert!((2.9..4.1).contains(&limit.order.expect("an order")));
        }
    }
}

#[test]
fn two_meshes_take_the_promised_order_and_say_so() {
    let found = converged(&case("ring_6_9_48.msh", "\"ring_6_9_24.msh\"", ""));
    assert!((found.formal_order - 4.0).abs() < 1e-12);
    let behaviours = found.modes.iter().map(|mode| mode.limit.as_ref().map(|limit| limit.behaviour));
    assert!(behaviours.clone().all(|behaviour| behaviour == Some(Behaviour::Unknown)));
    assert_eq!(
        found.notes,
        [
            "Two meshes: the order of convergence is not observed but assumed to be 4; three meshes or more would show it."
        ]
    );
    // h^4, sizes 2 : 1: a fifteenth of the step
    let mode = &found.modes[0];
    let [coarse, own] = [0, 1].map(|mesh| mode.frequencies_hz[mesh].expect("recognised"));
    let estimate = own + (own - coarse) / 15.0;
    let error = mode.mesh_error.expect("an error");
    // sizes are 2 : 1 to 1e-4 of the area
    assert!((error - (own - estimate) / estimate).abs() < 1e-3 * error.abs());
    let around = mode.mesh_error_uncertainty.expect("an uncertainty");
    // safety factor 3 of the finest value: 2 beyond the estimate
    assert!((around / error - 2.0).abs() < 1e-9);
}

/// A mesh of the ring with every coordinate multiplied, in a folder of its own.
fn scaled(mesh: &str, factor: f64) -> (tempfile::TempDir, PathBuf) {
    let text = std::fs::read_to_string(path("meshes").join(mesh)).expect("a mesh");
    let mut nodes = false;
    let lines = text.lines().map(|line| {
        nodes = (nodes || line == "$Nodes") && line != "$EndNodes";
        let words: Vec<&str> = line.split_whitespace().collect();
        // in this section lines of three are coordinates
        if !nodes || words.len() != 3 {
            return format!("{line}\n");
        }
        let moved = words.iter().map(|word| factor * word.parse::<f64>().expect("a number"));
        moved.map(|x| format!("{x:.16} ")).collect::<String>() + "\n"
    });
    let text: String = lines.collect();
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("scaled.msh");
    std::fs::write(&file, text).expect("written");
    (folder, file)
}

/// The middle one of three meshes is of a ring 4 % larger: its frequencies are 4 % lower, they go down and up again.
#[test]
fn what_does_not_converge_is_told() {
    let (_folder, larger) = scaled("ring_6_9_48.msh", 1.04);
    let others = format!("\"ring_6_9_24.msh\", \"{}\"", larger.display());
    let found = converged(&case("ring_6_9.msh", &others, ""));
    assert_eq!(found.modes.len(), 9);
    for mode in &found.modes {
        let limit = mode.limit.as_ref().expect("a limit");
        assert_eq!(limit.behaviour, Behaviour::Oscillating);
        assert_eq!(mode.mesh_error, None);
        let [coarse, middle, own] = [0, 1, 2].map(|mesh| mode.frequencies_hz[mesh].expect("a mode"));
        assert!(middle < own && own < coarse);
        // the range of the three values, over that of the finest mesh
        let range = mode.mesh_error_uncertainty.expect("a range");
        assert!((range - (coarse - middle) / own).abs() < 1e-12);
    }
    assert_eq!(found.without_limit(), 9);
    assert!(found.worst().is_none());
    assert_eq!(
        found.notes,
        [
            "Frequencies that go to and fro from mesh to mesh are not extrapolated, their error is not known: mode 4, 5, 6, 7, 8, 9, 10, 11, 12."
        ]
    );
}

#[test]
fn elements_of_another_kind_are_shown_only() {
    let others = "\"ring_6_9_24.msh\", \"ring_6_9_tri.msh\"";
    let with = converged(&case("ring_6_9_48.msh", others, ""));
    let without = converged(&case("ring_6_9_48.msh", "\"ring_6_9_24.msh\"", ""));
    assert!(!with.meshes[2].extrapolated && with.meshes[1].own);
    for (with, without) in with.modes.iter().zip(&without.modes) {
        assert!(with.frequencies_hz[2].is_some());
        assert!(with.limit.is_some() && with.limit == without.limit);
    }
    assert!(with.notes.iter().any(|note| note.ends_with(
        "ring_6_9_tri.msh has Tri6 where this case's mesh has Quad8: it is shown and not extrapolated with, since unlike elements have unlike errors."
    )));
    let alone = converged(&case("ring_6_9_48.msh", "\"ring_6_9_tri.msh\"", ""));
    assert!(alone.modes.iter().all(|mode| mode.limit.is_none()));
    let told = |note: &String| note.starts_with("No other mesh has the elements");
    assert!(alone.notes.iter().any(told));
}

/// Half a pair at the end of the case's list is recognised by its space.
#[test]
fn a_pair_cut_in_two_is_recognised() {
    let mut case = case("ring_6_9_48.msh", "\"ring_6_9_24.msh\"", "");
    case.modes.extent = ModeRange::Count(4);
    let found = converged(&case);
    assert_eq!(found.modes.len(), 1);
    assert!(found.modes[0].mesh_error.is_some(), "{found:?}");
}

#[test]
fn ring_and_housing_together() {
    let found = converged(&case("ring_6_9_48.msh", "\"ring_6_9_24.msh\", \"ring_6_9.msh\"", RING));
    let dof: Vec<usize> = found.meshes.iter().map(|mesh| mesh.free_dof).collect();
    // two a node of the mesh less the bore's, three a node of the ring
    assert_eq!(dof, [240 - 2 * 48 + 72, 768 - 2 * 96 + 72, 1584 - 2 * 144 + 72]);
    assert!(found.modes.iter().all(|mode| mode.frequencies_hz.iter().all(Option::is_some)));
    assert!(found.notes.iter().any(|note| note.starts_with("The ring keeps its nodes")));
    let worst = found.worst().expect("one");
    let largest = found.modes.iter().filter_map(|mode| mode.mesh_error).fold(0.0_f64, |m, e| m.max(e.abs()));
    assert!((worst.mesh_error.expect("its error").abs() - largest).abs() < 1e-15);
}

#[test]
fn wrong_meshes_are_named_before_anything_is_computed() {
    let message = |others: &str| {
        let error = compute_modes(&case("ring_6_9_48.msh", others, ""), &Stageless);
        let error = error.expect_err("refused");
        assert!(error.is_input());
        error.to_string().replace(&path("meshes").display().to_string(), "meshes")
    };
    assert_eq!(
        message("\"ring_6_9_24.msh\", \"no.msh\""),
        "modes.convergence.meshes[1] (meshes/no.msh): cannot read the mesh meshes/no.msh: No such file or directory (os error 2)"
    );
    let other = message("\"pillow_block.msh\"");
    assert!(
        other.starts_with("modes.convergence.meshes[0] (meshes/pillow_block.msh): expected a mesh of the same body, of area or volume 1.4137e-4 (m^2, m^3), found "),
        "{other}"
    );
    // another path to the same mesh
    let same = message("\"../meshes/ring_6_9_48.msh\"");
    assert!(
        same.starts_with("modes.convergence: two meshes have sizes ")
            && same.ends_with("expected them to differ by 1 % at least"),
        "{same}"
    );
}

/// Fails the test when a computation begins.
struct Stageless;

impl Watch for Stageless {
    fn stage(&self, name: &str) {
        panic!("{name} began");
    }
    fn fraction(&self, _done: f64) {}
}
