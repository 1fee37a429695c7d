//! Modes of small rings against their own, changed as those of another program might differ.

use super::*;
use crate::app::case::Source;
use crate::app::commands::modes::{ModesResult, compute_modes};
use crate::numerics::Unwatched;
use std::path::Path;

const HOUSING: &str = "[housing]\nmesh = \"ring_6_9_24.msh\"\nlength_unit = \"mm\"\n\
    plane = { assumption = \"stress\", thickness = 4e-3 }\n\
    parts = [{ group = \"housing\", material = \"aluminium\" }]\n";
const RING: &str = "[ring]\nnodes = 24\nouter_radius = 6e-3\n\
    sections = [{ material = \"steel\", area = 5.37e-6, inertia = 8.88e-13, radius = 5.314e-3 }]\n";
const TIE: &str = "tie = { group = \"bore\" }\n";
const MODES: &str = "[modes]\ncount = 10\n";

fn case(text: &str) -> Case {
    let source = Source {
        path: Path::new(env!("CARGO_MANIFEST_DIR")).join("meshes/case.toml"),
        text: text.to_owned(),
        set: Vec::new(),
    };
    Case::from_source(source).expect("a case")
}

fn computed(text: &str) -> ModesResult {
    compute_modes(&case(text), &Unwatched).expect("modes")
}

fn limits() -> ComparedModes {
    ComparedModes {
        file: PathBuf::from("bench.csv"),
        what: String::new(),
        mac: 0.95,
        within: 0.01,
        points_within: None,
        length_unit: None,
    }
}

/// The result against its own modes, changed.
fn against(result: &ModesResult, change: impl Fn(&mut ModeShapes)) -> Result<FileComparison, ComputeError> {
    let mut modes = result.mode_shapes();
    change(&mut modes);
    let asked = limits();
    let file = ComparedFile { asked: &asked, modes };
    file.compare(&result.survey, result.mesh_and_model())
}

fn remove(modes: &mut ModeShapes, mode: usize) {
    modes.frequencies_hz.remove(mode);
    modes.shapes.remove(mode);
}

/// Free ring: modes 0 to 2 rigid, (3, 4) and (5, 6) pairs, 7 breathing, (8, 9) a pair.
fn free_ring() -> ModesResult {
    let result = computed(&(HOUSING.to_owned() + MODES));
    let basis = &result.survey.basis;
    assert_eq!((basis.rigid_modes, basis.count()), (3, 10));
    result
}

#[test]
fn a_result_agrees_with_itself() {
    let tied = HOUSING.to_owned() + RING + TIE + MODES;
    // matched by tag only where there are nothing but nodes of the mesh
    for (text, by, points) in [
        (HOUSING.to_owned() + MODES, MatchedBy::Tag, 120),
        (RING.to_owned() + MODES, MatchedBy::Place, 24),
        (tied, MatchedBy::Place, 144),
    ] {
        let result = computed(&text);
        let found = against(&result, |_| {}).expect("compares");
        assert!(found.ok, "{found:?}");
        assert_eq!((found.points.by, found.points.matched), (by, points));
        assert_eq!(found.agreeing(), [10, 10]);
        for pair in &found.pairs {
            assert_eq!(pair.here, pair.there);
            // rounding of a product of a few hundred terms
            assert!(pair.mac > 1.0 - 1e-12, "{pair:?}");
            assert!(pair.relative_difference.is_none_or(|d| d.abs() < 1e-15));
        }
    }
}

#[test]
fn a_frequency_beyond_its_limit_fails_its_pair_alone() {
    let result = free_ring();
    for (factor, ok) in [(1.009, true), (1.011, false), (0.989, false)] {
        let found = against(&result, |modes| modes.frequencies_hz[7] /= factor).expect("compares");
        assert_eq!(found.ok, ok, "{factor}");
        let pair = found.pairs.iter().find(|pair| pair.here == [7]).expect("paired");
        assert!((pair.relative_difference.expect("elastic") - (factor - 1.0)).abs() < 1e-12);
        let misses: &[Miss] = if ok { &[] } else { &[Miss::Frequency] };
        assert_eq!(pair.misses, misses);
        assert_eq!(found.agreeing(), [if ok { 10 } else { 9 }, 10]);
    }
}

/// A pair turned by 30 degrees: mode by mode a MAC of 3/4, as a space 1.
#[test]
fn a_repeated_pair_may_be_turned() {
    let result = free_ring();
    let found = against(&result, |modes| {
        let [a, b] = [modes.shapes[3].clone(), modes.shapes[4].clone()];
        let (sin, cos) = 30.0_f64.to_radians().sin_cos();
        for (row, (a, b)) in a.iter().zip(&b).enumerate() {
            modes.shapes[3][row] = cos * a + sin * b;
            modes.shapes[4][row] = cos * b - sin * a;
        }
    })
    .expect("compares");
    assert!(found.ok);
    let pair = found.pairs.iter().find(|pair| pair.here == [3, 4]).expect("paired");
    assert!(pair.mac > 1.0 - 1e-12);
    // the two are equally long at the nodes to the mesh's symmetry only
    assert!((found.mac[3][3] - 0.75).abs() < 1e-3, "{}", found.mac[3][3]);
}

/// Half of another mode mixed in: MAC = 1 / (1 + 1/4) for shapes of one length.
#[test]
fn a_shape_beyond_its_limit_fails() {
    let result = free_ring();
    let found = against(&result, |modes| {
        let length = |shape: &[f64]| shape.iter().map(|x| x * x).sum::<f64>().sqrt();
        let factor = 0.5 * length(&modes.shapes[7]) / length(&modes.shapes[3]);
        let other = modes.shapes[3].clone();
        for (own, other) in modes.shapes[7].iter_mut().zip(other) {
            *own += factor * other;
        }
    })
    .expect("compares");
    let pair = found.pairs.iter().find(|pair| pair.here == [7]).expect("paired");
    assert_eq!(pair.misses, [Miss::Mac]);
    assert!((pair.mac - 0.8).abs() < 1e-3, "{}", pair.mac);
    assert!(!found.ok);
}

#[test]
fn modes_without_a_partner_fail_where_both_sides_reach() {
    let result = free_ring();
    // within the file's range: missing there
    let found = against(&result, |modes| remove(modes, 7)).expect("compares");
    assert!(!found.ok && found.lone_here.len() == 1);
    assert!(found.lone_here[0].missing && found.lone_here[0].mode == 7);
    assert_eq!(found.agreeing(), [9, 10]);
    // the file ends before it, or begins after the rigid ones
    let found = against(&result, |modes| {
        remove(modes, 9);
        remove(modes, 8);
        for _ in 0..3 {
            remove(modes, 0);
        }
    })
    .expect("compares");
    assert!(found.ok);
    assert!(found.lone_here.len() == 5 && found.lone_here.iter().all(|mode| !mode.missing));
    assert_eq!(found.agreeing(), [5, 5]);
    // of a pair one: missing, but not at the end of the list
    let found = against(&result, |modes| remove(modes, 4)).expect("compares");
    let pair = found.pairs.iter().find(|pair| pair.here == [3, 4]).expect("paired");
    assert_eq!(pair.misses, [Miss::Count]);
    assert!(!found.ok);
    assert!(against(&result, |modes| remove(modes, 9)).expect("compares").ok);
}

#[test]
fn modes_of_the_file_that_are_not_here_fail_where_both_sides_reach() {
    let result = free_ring();
    let hz = |mode: usize| result.survey.basis.frequencies_hz[mode];
    // a shape that no mode has: one node moves
    let added = |frequency: f64| {
        against(&result, |modes| {
            let mut shape = vec![0.0; modes.shapes[0].len()];
            shape[0] = 1.0;
            modes.frequencies_hz.push(frequency);
            modes.shapes.push(shape);
        })
        .expect("compares")
    };
    let found = added(0.5 * (hz(4) + hz(5)));
    assert!(!found.ok && found.missing_here() == 1);
    let found = added(2.0 * hz(9));
    assert!(found.ok && found.lone_there.len() == 1 && found.missing_here() == 0);
}

/// Frequencies of modes without stiffness are round-off: judged beside the first elastic one.
#[test]
fn rigid_modes_are_judged_by_their_shape() {
    let result = free_ring();
    let found = against(&result, |modes| modes.frequencies_hz[..3].fill(20.0)).expect("compares");
    assert!(found.ok);
    assert_eq!(found.pairs[0].relative_difference, None);
    let stiff = 0.02 * result.survey.basis.frequencies_hz[3];
    let found = against(&result, |modes| modes.frequencies_hz[..3].fill(stiff)).expect("compares");
    assert_eq!(found.pairs[0].misses, [Miss::Frequency]);
}

#[test]
fn points_are_known_by_place_or_by_label() {
    let result = free_ring();
    let labels = against(&result, |modes| modes.points = None).expect("compares");
    assert!(labels.ok && labels.points.by == MatchedBy::Tag);
    let tied = computed(&(HOUSING.to_owned() + RING + TIE + MODES));
    let tags = result.mode_shapes().node_tags.expect("labels");
    let of_mesh = against(&tied, |modes| {
        modes.points = None;
        modes.node_tags = Some(tags.clone());
        modes.shapes.iter_mut().for_each(|shape| shape.truncate(3 * 120));
    })
    .expect("compares");
    assert!(of_mesh.ok && of_mesh.points.matched == 120);
    let message =
        |result: &ModesResult, change: fn(&mut ModeShapes)| against(result, change).expect_err("refused").to_string();
    assert_eq!(
        message(&result, |modes| (modes.points, modes.node_tags) = (None, None)),
        "bench.csv: expected mode shapes at points, found neither points nor node labels"
    );
    let ring = computed(&(RING.to_owned() + MODES));
    let labelled = |modes: &mut ModeShapes| {
        modes.node_tags = Some((1..=modes.count_points() as u64).collect());
        modes.points = None;
    };
    assert_eq!(
        message(&ring, labelled),
        "bench.csv: expected mode shapes at points, found node labels, and the case has no mesh"
    );
    // millimetres taken for metres
    let far = |modes: &mut ModeShapes| {
        modes.points.iter_mut().flatten().flatten().for_each(|x| *x *= 1e3);
    };
    let error = against(&result, far).expect_err("refused");
    assert!(error.to_string().starts_with("bench.csv: only 0 points of the two sets of modes coincide"), "{error}");
    assert!(error.is_input() && error.help().is_some());
}

#[test]
fn points_within_widens_the_match() {
    let result = free_ring();
    let mut asked = limits();
    let mut modes = result.mode_shapes();
    modes.node_tags = None;
    // 0.1 mm off: the default is 0.025 mm
    modes.points.iter_mut().flatten().for_each(|point| point[0] += 1e-4);
    let file = ComparedFile { asked: &asked, modes: modes.clone() };
    assert!(file.compare(&result.survey, result.mesh_and_model()).is_err());
    asked.points_within = Some(1.1e-4);
    let file = ComparedFile { asked: &asked, modes };
    let found = file.compare(&result.survey, result.mesh_and_model()).expect("compares");
    assert_eq!(found.points.matched, 120);
    assert!((found.points.largest_distance_m - 1e-4).abs() < 1e-12);
}

/// Accelerometers of one axis, radial ones and a few along x: what they do not see counts nowhere.
#[test]
fn one_direction_a_place_is_compared_along_it() {
    let result = free_ring();
    let along = |modes: &mut ModeShapes| {
        let points = modes.points.clone().unwrap();
        let radial = points.iter().map(|[x, y, _]| [x / x.hypot(*y), y / x.hypot(*y), 0.0]);
        // every fourth place radially, and the first five along x too
        let mut rows: Vec<(usize, [f64; 3])> = radial.enumerate().step_by(4).collect();
        rows.extend((0..5).map(|k| (4 * k, [1.0, 0.0, 0.0])));
        for shape in &mut modes.shapes {
            let of_row = |(place, direction): &(usize, [f64; 3])| {
                let value: f64 = (0..3).map(|axis| direction[axis] * shape[3 * place + axis]).sum();
                direction.map(|part| part * value)
            };
            *shape = rows.iter().flat_map(of_row).collect();
        }
        let places = rows.iter().map(|(place, _)| *place);
        modes.node_tags = modes.node_tags.as_ref().map(|tags| places.clone().map(|place| tags[place]).collect());
        modes.points = Some(places.map(|place| points[place]).collect());
        modes.directions = Some(rows.into_iter().map(|(_, direction)| direction).collect());
    };
    let found = against(&result, along).expect("compares");
    assert_eq!((found.points.by, found.points.matched, found.points.there), (MatchedBy::Tag, 35, 35));
    assert!(found.ok, "{found:?}");
    assert!(found.pairs.iter().all(|pair| pair.mac > 1.0 - 1e-9), "{:?}", found.pairs);
    // by place it is the same
    let by_place = against(&result, |modes| {
        along(modes);
        modes.node_tags = None;
    });
    let by_place = by_place.expect("compares");
    assert_eq!((by_place.points.by, by_place.points.matched), (MatchedBy::Place, 35));
    assert_eq!(by_place.pairs, found.pairs);
    // the same numbers as shapes in space say that what was not measured is zero
    let as_if_in_space = against(&result, |modes| {
        along(modes);
        let tags = modes.node_tags.as_ref().unwrap();
        modes.node_tags = Some((0..30).map(|row| tags[row]).collect());
        modes.points = modes.points.as_ref().map(|points| points[..30].to_vec());
        modes.shapes.iter_mut().for_each(|shape| shape.truncate(90));
        modes.directions = None;
    });
    assert!(!as_if_in_space.expect("compares").ok);
}

/// `tests/data/frd/cube.frd` is of CalculiX 2.20 on the same mesh, in mm, t and MPa.
#[test]
fn modes_of_calculix_are_those_of_this_program() {
    const CUBE: &str = "[materials.of_ccx]\nyoung = 210e9\npoisson = 0.3\ndensity = 7850\n\
        [housing]\nmesh = \"../tests/data/cube_tet10_msh22.msh\"\nlength_unit = \"mm\"\n\
        parts = [{ group = \"body\", material = \"of_ccx\" }]\n[modes]\ncount = 9\n";
    let compared = |more: &str| {
        let case = case(&format!("{CUBE}compare = [{{ file = \"../tests/data/frd/cube.frd\", {more} }}]\n"));
        compute_modes(&case, &Unwatched).map(|result| result.comparisons[0].clone())
    };
    // CalculiX integrates the mass of a Tet10 with four points: 0.5 % on a mesh of two elements a side. With the full mass
    // the seventh frequency of this mesh is 1524499.6 Hz, with four points 1531366.2 Hz, as in the file
    let found = compared("mac = 0.99, within = 6e-3").expect("compares");
    assert!(found.ok, "{:?}", found.pairs);
    assert_eq!(
        (found.points.by, found.points.matched, found.pairs.last().unwrap().here.len()),
        (MatchedBy::Tag, 125, 1)
    );
    // the file does not say its unit: that of the mesh unless told
    let error = compared("length_unit = \"m\"").expect_err("a cube of 1 m");
    assert!(error.help().unwrap().contains("`length_unit` the unit of a .frd file"), "{error}");
}
