//! A housing condensed, written, read and put in its own place: nothing may change.

use std::fs;
use std::path::{Path, PathBuf};

use super::at_rest::Scene;
use super::condensed::CondensedHousing;
use super::imported::ImportedHousing;
use super::structure::CoupledStructure;
use crate::app::case::{Case, Source};
use crate::app::commands::condense::superelement_record;
use crate::app::commands::modes::compute_modes;
use crate::app::commands::run::choice::ModelChoice;
use crate::app::commands::run::compute_run;
use crate::formats::{
    DofDirection, DofLabel, Op4Format, SuperelementRecord, write_superelement_npz, write_superelement_op4,
};
use crate::numerics::Unwatched;
use crate::numerics::linalg::DenseMatrix;

const RING: &str = "outer_radius = 6e-3\n\
    sections = [{ material = \"steel\", area = 5.37e-6, inertia = 8.88e-13, radius = 5.314e-3 }]\n";

/// The bearing's angle 0 points up the mesh.
const TIE: &str = "tie = { group = \"bore\", centre = [0, 0, 0], axis = [0, 0, 1], zero_deg = [0, 1, 0] }\n";

const REST: &str = "[bearing]\nballs = 7\nball_radius = 1e-3\nball_mass = 3.29e-5\n\
    inner_race_radius = 2.754e-3\nouter_race_radius = 4.7565e-3\ninner_groove_radius = 1.04e-3\n\
    outer_groove_radius = 1.07e-3\ncontact_damping = 2.0\n\
    [shaft]\nmass = 0.15\nunbalance = 2e-5\ngravity = [-9.81, 0]\n[damping]\nmodal = 0.03\n\
    [speed]\nprofile = [{ time = 0.0, hz = 20.0 }, { time = 1.0, hz = 25.0 }]\n\
    [modes]\ncount = 12\nlinearise = \"static\"\n\
    [accuracy]\nband_hz = [0, 20000]\n\
    [transient]\nend = 0.002\noutput_hz = 50000\n";

const PLANE: &str = "mesh = \"ring_6_9_coarse.msh\"\nlength_unit = \"mm\"\n\
    plane = { assumption = \"stress\", thickness = 4e-3 }\n\
    parts = [{ group = \"housing\", material = \"aluminium\" }]\n\
    supports = [{ group = \"lower\", spring = { x = 1e7, y = 1e7 } }]\n";

const SOLID: &str = "mesh = \"pedestal.msh\"\nlength_unit = \"mm\"\n\
    parts = [{ group = \"housing\", material = \"aluminium\" }]\n\
    supports = [{ group = \"feet\", fixed = [\"x\", \"y\", \"z\"] }]\n";

const ON_RING: &str = "[[sensors]]\nname = \"race\"\nring_deg = 30\ndirection = [1.0, 0.5, 0.0]\n";

/// The same basis for a file as for a run, which would go beyond the band by itself.
const SIX: &str = "[condense]\nfixed_interface_modes = 6\n";

fn case(text: &str) -> Case {
    let root = env!("CARGO_MANIFEST_DIR");
    Case::from_source(Source { path: format!("{root}/meshes/a.toml").into(), text: text.to_owned(), set: Vec::new() })
        .unwrap()
}

fn original(housing: &str, nodes: usize, sensors: &str) -> Case {
    case(&format!("[housing]\n{housing}[ring]\nnodes = {nodes}\n{RING}{TIE}{REST}{sensors}"))
}

fn imported(path: &Path, nodes: usize, rest: &str, sensors: &str) -> Case {
    let path = path.display();
    case(&format!("[housing]\nsuperelement = \"{path}\"\n[ring]\nnodes = {nodes}\n{RING}{rest}{sensors}"))
}

fn record_of(case: &Case) -> SuperelementRecord {
    let stage = CondensedHousing::build(case, &Unwatched).unwrap().unwrap();
    superelement_record(case, &stage).unwrap()
}

fn structure(case: &Case) -> CoupledStructure {
    CoupledStructure::build(case, &Unwatched).unwrap().unwrap()
}

/// A small plane housing on 8 nodes of a ring, in a folder.
fn small() -> (tempfile::TempDir, PathBuf, SuperelementRecord) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.npz");
    let modes = "[condense]\nfixed_interface_modes = 4\n";
    let record = record_of(&original(PLANE, 8, modes));
    assert_eq!(record.order(), 28);
    (folder, path, record)
}

/// What stands in the way of a record with a ring of 8 nodes.
fn refusal(path: &Path, record: &SuperelementRecord, sensors: &str) -> String {
    write_superelement_npz(path, record).unwrap();
    let case = imported(path, 8, "", sensors);
    let error = CoupledStructure::build(&case, &Unwatched).unwrap_err();
    assert!(error.is_input(), "{error}");
    let start = format!("housing.superelement: {}: ", path.display());
    error.to_string().replace(&start, "")
}

/// Largest difference relative to the largest value.
fn apart(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let largest = expected.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let both = found.iter().zip(expected);
    both.fold(0.0_f64, |a, (x, y)| a.max((x - y).abs())) / largest
}

/// Signals, frequencies and weight of a plane and of a solid housing come back; the solid one has a ring with motions that
/// move nothing of its coarse bore.
#[test]
fn a_superelement_takes_the_place_of_the_housing_that_it_came_from() {
    let of_housing = |place: &str| format!("[[sensors]]\nname = \"foot\"\n{place}\ndirection = [1, 1, 0]\n");
    let of_file = "[[sensors]]\nname = \"foot\"\nrecovered = \"foot\"\n";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.npz");
    for (housing, nodes, place) in [(PLANE, 24, "group = \"lower\""), (SOLID, 72, "point = [0, 10e-3, 0]")] {
        let sensors = format!("{ON_RING}{}{SIX}", of_housing(place));
        let before = original(housing, nodes, &sensors);
        write_superelement_npz(&path, &record_of(&before)).unwrap();
        let after = imported(&path, nodes, REST, &format!("{ON_RING}{of_file}"));
        let (old, new) = (structure(&before), structure(&after));
        assert_eq!(new.structure.stiffness(), old.structure.stiffness());
        assert_eq!(new.structure.mass(), old.structure.mass());
        // the frame is found again from the labels: round-off of a unit vector
        assert!(apart(new.structure.gravity(), old.structure.gravity()) < 1e-14);
        for (new, old) in new.structure.sensors().iter().zip(old.structure.sensors()) {
            assert_eq!(new.name, old.name);
            assert!(apart(&new.row, &old.row) < 1e-14, "{}", new.name);
        }
        let (of_old, of_new) =
            (compute_modes(&before, &Unwatched).unwrap(), compute_modes(&after, &Unwatched).unwrap());
        let condensed: Vec<f64> = (0..12).map(|mode| old.modes.frequency_hz(mode)).collect();
        // two solvers of the same matrices
        assert!(apart(&of_new.base.unloaded_hz, &condensed) < 1e-10);
        let listed = [&of_new, &of_old].map(|modes| match &modes.base.loaded {
            Some(loaded) => loaded.modes.iter().map(|mode| mode.frequency_hz).collect(),
            None => modes.base.unloaded_hz.clone(),
        });
        assert!(apart(&listed[0], &listed[1]) < 1e-10);
        assert!(of_new.survey.mass.is_none());
        assert_eq!(of_new.mode_shapes().points.unwrap().len(), nodes, "the ring alone");
        let (of_old, of_new) =
            (compute_run(&before, &Unwatched).unwrap().simulation, compute_run(&after, &Unwatched).unwrap().simulation);
        assert!(of_new.statistics.steps > 200);
        assert_eq!(of_new.record.time_s, of_old.record.time_s);
        for (new, old) in of_new.record.sensors.iter().zip(&of_old.record.sensors) {
            assert_eq!(new.0, old.0);
            // round-off of the weight, grown by the contacts
            assert!(apart(&new.1, &old.1) < 1e-8, "{}", new.0);
        }
    }
}

/// OUTPUT4 keeps the matrices, bit by bit, and nothing else: the interface's length is told by the stiffness.
#[test]
fn op4_brings_the_matrices_and_says_what_it_lacks() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.op4");
    for (housing, nodes) in [(PLANE, 8), (SOLID, 8)] {
        let before = original(housing, nodes, &format!("{ON_RING}{SIX}"));
        let record = record_of(&before);
        for format in [Op4Format::Binary, Op4Format::Ascii] {
            write_superelement_op4(&path, &record, format).unwrap();
            let stage = structure(&imported(&path, nodes, REST, ""));
            let old = structure(&before);
            assert_eq!(stage.modes.squared_frequencies, old.modes.squared_frequencies);
            let found = stage.bodies.imported.unwrap();
            assert_eq!(found.record.interface.len(), record.interface.len());
            let file = path.display();
            assert_eq!(
                found.notes[1..],
                [
                    format!(
                        "{file} does not say what its coordinates are: the first {} are taken for the ring's in the ring's order. Only their number was checked.",
                        record.interface.len()
                    ),
                    format!(
                        "ring.outer_radius of the case does not act: {file} was condensed before, and does not say with which."
                    ),
                    format!("{file} has no array \"weight\": the weight of the housing does not act."),
                    format!("The viscous damping in {file} is not used: [damping] of the case counts."),
                ]
            );
            assert!(found.element.gravity_load([1.0, 1.0]).iter().all(|&force| force == 0.0));
        }
    }
    let record = record_of(&original(PLANE, 8, ""));
    write_superelement_op4(&path, &record, Op4Format::Binary).unwrap();
    let error = CoupledStructure::build(&imported(&path, 40, "", ""), &Unwatched).unwrap_err();
    assert_eq!(
        error.to_string(),
        format!(
            "housing.superelement: {}: expected 120 interface coordinates for ring.nodes = 40 (x, y, about_z of each) or \
             240 (in a solid housing then z, about_x, about_y of each), found {}",
            path.display(),
            record.order()
        )
    );
}

#[test]
fn an_interface_that_is_not_the_ring_s_is_named() {
    let (_folder, path, whole) = small();
    let case = imported(&path, 9, "", "");
    write_superelement_npz(&path, &whole).unwrap();
    let error = CoupledStructure::build(&case, &Unwatched).unwrap_err();
    assert!(error.to_string().ends_with(
        "expected 27 interface coordinates for ring.nodes = 9 (x, y, about_z of each) or 54 (in a solid housing then z, \
         about_x, about_y of each), found 24"
    ));
    let changed = |change: fn(&mut [DofLabel])| {
        let mut record = whole.clone();
        change(&mut record.interface);
        refusal(&path, &record, "")
    };
    assert_eq!(
        changed(|labels| labels.swap(3, 4)),
        "interface coordinate 3 (from 0): expected ring node 1, x, found ring node 1, y"
    );
    assert_eq!(
        changed(|labels| labels.iter_mut().for_each(|l| l.body = crate::formats::DofBody::Housing)),
        "interface coordinate 0 (from 0): expected ring node 0, x, found housing node 0, x"
    );
    assert_eq!(
        changed(|labels| labels[7].direction = DofDirection::Along(2)),
        "interface coordinate 7 (from 0): expected ring node 2, y, found ring node 2, z"
    );
    let moved = changed(|labels| {
        labels.iter_mut().for_each(|label| label.position = label.position.map(|x| 1.01 * x));
    });
    assert!(
        moved.starts_with("interface coordinate 0 (from 0), position in m of ring node 0, x: expected ["),
        "{moved}"
    );
    // a left-handed frame
    let turned = changed(|labels| labels[1].axis = labels[1].axis.map(|part| -part));
    assert!(turned.starts_with("interface coordinate 1 (from 0), axis of ring node 0, y: expected ["), "{turned}");
    let flat = changed(|labels| labels[2].axis = labels[0].axis);
    assert!(flat.starts_with("expected axes x and z of ring node 0 at right angles, found ["), "{flat}");
    // what is not known passes
    let mut bare = whole.clone();
    for label in &mut bare.interface {
        (label.position, label.axis) = ([f64::NAN; 3], [f64::NAN; 3]);
    }
    write_superelement_npz(&path, &bare).unwrap();
    structure(&imported(&path, 8, "", ""));
    bare.interface = (0..24).map(DofLabel::interface).collect();
    write_superelement_npz(&path, &bare).unwrap();
    let stage = structure(&imported(&path, 8, "", ""));
    assert!(stage.bodies.imported.unwrap().notes[1].contains("Only their number was checked."));
}

#[test]
fn matrices_are_checked_at_the_door() {
    let (_folder, path, whole) = small();
    let mut record = whole.clone();
    let mode = record.interface.len();
    record.stiffness[(0, mode)] += 1e-3 * record.stiffness[(0, 0)];
    record.stiffness[(mode, 0)] = record.stiffness[(0, mode)];
    let error = refusal(&path, &record, "");
    assert!(
        error.starts_with("check \"k_bq = 0\" (largest stiffness between interface and modal amplitudes, relative to both diagonals): expected at most 1e-8, found "),
        "{error}"
    );
    // `condense` lists what fails
    let case = imported(&path, 8, "", "");
    let (found, _) = ImportedHousing::read(&case, &path).unwrap();
    let failed: Vec<&str> = (found.checks.iter().filter(|check| !check.ok())).map(|check| check.name).collect();
    assert!(failed.contains(&"k_bq = 0"), "{failed:?}");
    let mut record = whole.clone();
    record.mass[(1, 1)] *= -1.0;
    let error = refusal(&path, &record, "");
    assert!(error.starts_with("check \"mass definite\" ("), "{error}");
    let sensor = "[[sensors]]\nname = \"a\"\nrecovered = \"P1\"\n";
    assert_eq!(
        refusal(&path, &whole, sensor),
        "sensor \"a\": expected one of the rows of array \"sensors\", which the file lacks, found \"P1\""
    );
    let spring = "supports = [{ from_deg = 0, to_deg = 90, spring = { z = 1e5 } }]\n";
    write_superelement_npz(&path, &whole).unwrap();
    let case = imported(&path, 8, spring, "");
    let error = CoupledStructure::build(&case, &Unwatched).unwrap_err();
    assert!(error.to_string().ends_with(
        "ring.supports[0].spring has a component z, expected x and y only: the superelement is plane, three motions a node"
    ));
    let other = path.with_extension("mat");
    fs::copy(&path, &other).unwrap();
    let error = CoupledStructure::build(&imported(&other, 8, "", ""), &Unwatched).unwrap_err();
    assert!(error.to_string().ends_with(": expected a file that ends in .npz or .op4"));
    let mut record = whole;
    let order = record.order();
    record.structural = Some(DenseMatrix::from_fn(order, order, |i, j| 1e-2 * record.stiffness[(i, j)]));
    write_superelement_npz(&path, &record).unwrap();
    let case = imported(&path, 8, REST, ON_RING);
    compute_modes(&case, &Unwatched).unwrap();
    let error = compute_run(&case, &Unwatched).unwrap_err();
    assert!(error.is_input() && error.to_string().ends_with(
        "array \"structural\" is structural damping, which has a meaning for harmonic motion alone; a run steps through time"
    ), "{error}");
}

/// Displacements of nodes come back from the record's recovery: those of the bore by rigid motions of the ring.
#[test]
fn the_field_of_a_record_moves_the_nodes() {
    let case = original(PLANE, 24, "");
    let stage = CondensedHousing::build(&case, &Unwatched).unwrap().unwrap();
    let record = superelement_record(&case, &stage).unwrap();
    let field = record.field.unwrap();
    // 160 nodes, a small file: all of them
    assert_eq!(field.node_tags.len(), 160);
    let order = stage.condensed.superelement.order();
    let coordinates = DenseMatrix::from_fn(order, 1, |row, _| (1.7 * row as f64).sin());
    let dof = stage.housing.model.dof();
    let expected = stage.condensed.field(&coordinates, dof);
    let found = &field.recovery * &coordinates;
    for node in 0..160 {
        for axis in 0..3 {
            let expected = if axis < 2 { expected[(2 * node + axis, 0)] } else { 0.0 };
            // sums of a hundred terms in another order
            assert!((found[(3 * node + axis, 0)] - expected).abs() < 1e-12);
        }
    }
}

/// Eight modes of an interface are no coordinates of a ring, whatever their number.
#[test]
fn modes_of_an_interface_are_not_taken_for_its_coordinates() {
    let (_folder, path, mut record) = small();
    let interface = record.interface.len();
    record.interface_recovery = Some(crate::formats::InterfaceRecovery {
        labels: record.interface.clone(),
        modes: DenseMatrix::identity(interface, interface),
    });
    record.interface = (0..interface as u64).map(DofLabel::interface).collect();
    assert_eq!(
        refusal(&path, &record, ""),
        "expected the ring's own coordinates, found 24 modes of an interface of 24 coordinates (array \
         \"interface_modes\"): condense without condense.interface_modes"
    );
}

/// What a file's vectors leave out is part of a run's estimate; a warning beyond the target says what of it is the largest.
#[test]
fn a_run_says_what_its_superelement_leaves_out() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.npz");
    for (vectors, largest) in [("0", true), ("{ up_to_hz = 400e3 }", false)] {
        let basis = format!("{ON_RING}[condense]\nfixed_interface_modes = {vectors}\n");
        write_superelement_npz(&path, &record_of(&original(PLANE, 24, &basis))).unwrap();
        let case = imported(&path, 24, REST, ON_RING);
        let run = case.for_run().unwrap();
        let scene = Scene::build(run, &Unwatched).unwrap();
        let choice = ModelChoice::of_case(run, &scene).unwrap();
        let part = choice.parts.last().unwrap();
        let imported = scene.stage.bodies.imported.as_ref().unwrap();
        let complete = imported.record.complete_hz.unwrap();
        let growth = choice.growth;
        let expected = growth * super::structure::left_out(20e3, complete);
        assert_eq!(part.what, "superelement");
        assert!((part.estimated_error.unwrap() / expected - 1.0).abs() < 1e-12);
        let warnings = choice.warnings();
        println!("{vectors}: {expected:e}, {warnings:?}");
        let told = warnings.iter().any(|text| text.contains("most of it of the superelement"));
        assert_eq!(told, largest);
        assert_eq!(expected > choice.target, largest);
    }
}

/// Vectors up to the band and no further err by as much as the signals; of a file that does not tell, nothing is estimated.
#[test]
fn a_run_with_too_few_vectors_is_not_trusted() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.npz");
    let basis = format!("{ON_RING}[condense]\nfixed_interface_modes = 0\n");
    let record = record_of(&original(PLANE, 24, &basis));
    for (complete_hz, lacks, words) in [
        (Some(20e3), true, "most of it of the superelement"),
        (Some(500e3), false, ""),
        (None, false, "its file does not tell which vectors were left out"),
    ] {
        write_superelement_npz(&path, &SuperelementRecord { complete_hz, band_hz: None, ..record.clone() }).unwrap();
        let case = imported(&path, 24, REST, ON_RING);
        let run = case.for_run().unwrap();
        let scene = Scene::build(run, &Unwatched).unwrap();
        let choice = ModelChoice::of_case(run, &scene).unwrap();
        let warnings = choice.warnings().join(" ");
        assert_eq!(choice.lacks_vectors(), lacks, "{complete_hz:?}: {warnings}");
        assert!(warnings.contains(words), "{complete_hz:?}: {warnings}");
        assert_eq!(choice.estimated_error.is_some(), complete_hz.is_some());
    }
}

#[test]
fn results_above_the_band_of_a_superelement_are_doubted() {
    let (_kept, path, record) = small();
    let nodes = record.interface.len() / 3;
    let doubts = |band_hz: Option<f64>| {
        let record = SuperelementRecord { band_hz, ..record.clone() };
        write_superelement_npz(&path, &record).unwrap();
        let case = imported(&path, nodes, REST, "");
        compute_modes(&case, &Unwatched).unwrap().doubts.join(" ")
    };
    let told = "10.000 Hz, the band that it was condensed for";
    assert!(doubts(Some(10.0)).contains(told), "{}", doubts(Some(10.0)));
    assert!(!doubts(Some(1e9)).contains("superelement"));
    // a file that does not say its band: two thirds of its last vector close to others, and the twelve modes go up to 237 kHz
    let highest = |modal_hz: &[f64]| {
        let record = SuperelementRecord { band_hz: None, modal_hz: modal_hz.to_vec(), ..record.clone() };
        let asked = imported(&path, nodes, REST, "");
        write_superelement_npz(&path, &record_of(&original(PLANE, 8, ""))).unwrap();
        let (mut housing, _) = ImportedHousing::read(&asked, &path).unwrap();
        housing.record = record;
        housing.doubt(237e3)
    };
    assert!(highest(&[4e5]).is_none());
    assert!(highest(&[2e5, 3.6e5, 4e5]).is_none());
    // two residual vectors beyond the last mode
    for modes in [&[3e5][..], &[2.4e5, 2.5e5, 3.9e5, 4.8e5]] {
        let doubt = highest(modes).unwrap();
        assert!(doubt.contains("two thirds of its last vector"), "{doubt}");
    }
}

#[test]
fn another_bore_than_the_condensed_one_is_refused() {
    let (_kept, path, record) = small();
    let nodes = record.interface.len() / 3;
    write_superelement_npz(&path, &record).unwrap();
    let file = record.outer_radius.expect("a tied ring");
    let of = |radius: f64| {
        let mut case = imported(&path, nodes, REST, "");
        case.ring.as_mut().expect("a ring").outer_radius = Some(radius);
        compute_modes(&case, &Unwatched)
    };
    assert!(of(file).is_ok());
    let refused = of(1.0).unwrap_err();
    let words = format!("ring.outer_radius is 1 m, but the superelement was condensed with {file} m");
    assert!(refused.to_string().contains(&words), "{refused}");
    assert!(refused.help().expect("help").contains("condense again"));
}
