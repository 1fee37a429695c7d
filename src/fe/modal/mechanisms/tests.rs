//! Cubes and squares joined and held in known ways; every count against the eigenvalues of the assembled matrices.

use super::super::ModalError;
use super::super::samples::{Cells, description, solve, support};
use super::*;
use crate::fe::model::{
    Connection, Constraint, HousingDescription, HousingModel, HousingSupport, Link, SpringStiffness, SupportShare,
};

fn fixed(group: &str, components: [bool; 3]) -> HousingSupport {
    support(group, Constraint::Fixed(components))
}

fn spring(group: &str, stiffness: [f64; 3]) -> HousingSupport {
    support(group, Constraint::Spring(SpringStiffness::Global(stiffness)))
}

/// What is found, after a check that as many modes of the matrices have no energy.
fn find(cells: &Cells, description: HousingDescription) -> Mechanisms {
    let solved = solve(&cells.mesh, description);
    let found = Mechanisms::find(&cells.mesh, &solved.model).expect("few bodies");
    assert_eq!(found.total(), solved.rigid_modes, "{found:?}");
    found
}

fn counts(found: &Mechanisms) -> [usize; 3] {
    [found.of_whole, found.of_loose_pieces, found.mechanisms]
}

fn cube(dimension: usize, supports: Vec<HousingSupport>) -> Mechanisms {
    let cells = Cells::new(dimension, [0.1, 0.12, 0.09])
        .block("cube", 0, [0; 3], [2, 2, 2])
        .points("corner", 0, &[[0, 0, 0]])
        .points("second", 0, &[[2, 0, 0]])
        .points("third", 0, &[[0, 2, 0]])
        .face("floor", 0, [0; 3], [2, 2, 0]);
    let description = HousingDescription { supports, ..description(&cells, &["cube"], 1.0) };
    find(&cells, description)
}

/// Two cubes, the second from `at`; `copy` 0 shares the lattice's nodes, 1 does not.
fn two(dimension: usize, at: [i32; 3], copy: usize) -> (Cells, HousingDescription) {
    let to = at.map(|x| x + 1);
    let cells = Cells::new(dimension, [0.1, 0.12, 0.09]).block("body", 0, [0; 3], [1, 1, 1]).block("lid", copy, at, to);
    let description = description(&cells, &["body", "lid"], 1.0);
    (cells, description)
}

#[test]
fn cubes_apart_and_joined() {
    let cases = [
        (3, [3, 0, 0], [6, 6, 0]),
        (3, [1, 1, 1], [6, 0, 3]),
        (3, [1, 1, 0], [6, 0, 1]),
        (3, [1, 0, 0], [6, 0, 0]),
        (2, [3, 0, 0], [3, 3, 0]),
        (2, [1, 1, 0], [3, 0, 1]),
        (2, [1, 0, 0], [3, 0, 0]),
    ];
    for (dimension, at, expected) in cases {
        let (cells, description) = two(dimension, at, 0);
        let found = find(&cells, description);
        assert_eq!(counts(&found), expected, "{dimension} {at:?}");
        let bodies = if at == [1, 0, 0] { 1 } else { 2 };
        assert_eq!(found.bodies.len(), bodies);
    }
}

#[test]
fn a_cube_held_in_part() {
    let all = [true; 3];
    let pins = |groups: &[&str]| groups.iter().map(|group| fixed(group, all)).collect::<Vec<_>>();
    assert_eq!(counts(&cube(3, pins(&["corner"]))), [0, 0, 3]);
    assert_eq!(counts(&cube(3, pins(&["corner", "second"]))), [0, 0, 1]);
    assert_eq!(counts(&cube(3, pins(&["corner", "second", "third"]))), [0, 0, 0]);
    assert_eq!(counts(&cube(2, pins(&["corner"]))), [0, 0, 1]);
    assert_eq!(counts(&cube(2, pins(&["corner", "second"]))), [0, 0, 0]);
    let sliding = |component: usize| fixed("floor", [0, 1, 2].map(|k| k == component));
    assert_eq!(counts(&cube(3, vec![sliding(2)])), [0, 0, 3]);
    assert_eq!(counts(&cube(2, vec![sliding(1)])), [0, 0, 1]);
    // a spring holds however soft it is beside another one
    assert_eq!(counts(&cube(3, vec![spring("corner", [1e7, 0.0, 0.0])])), [0, 0, 5]);
    assert_eq!(counts(&cube(3, vec![spring("corner", [1e9, 1e5, 1e7])])), [0, 0, 3]);
    assert_eq!(counts(&cube(2, vec![spring("corner", [1e7, 0.0, 0.0])])), [0, 0, 2]);
    let bed = HousingSupport { share: SupportShare::PerGroup, ..spring("floor", [0.0, 0.0, 1e8]) };
    assert_eq!(counts(&cube(3, vec![bed])), [0, 0, 3]);
    assert_eq!(counts(&cube(3, vec![spring("floor", [0.0; 3])])), [6, 0, 0]);
}

/// Two cubes that share no nodes where they touch, linked there.
#[test]
fn links_join_as_far_as_they_hold() {
    for (dimension, full) in [(2, 3), (3, 6)] {
        let at = if dimension == 2 { [0, 1, 0] } else { [0, 0, 1] };
        let linked = |connection| {
            let cells = Cells::new(dimension, [0.1, 0.12, 0.09]).block("body", 0, [0; 3], [2, 2, 1]).block(
                "lid",
                1,
                if dimension == 2 { [0, 2, 0] } else { at },
                [2, 4, 2],
            );
            let height = if dimension == 2 { [0, 2, 0] } else { at };
            let cells = cells.face("seat", 0, height, [2, 2, height[2]]).face("cover", 1, height, [2, 2, height[2]]);
            let description = HousingDescription {
                links: vec![Link { between: ["cover", "seat"].map(str::to_owned), connection }],
                ..description(&cells, &["body", "lid"], 1.0)
            };
            find(&cells, description)
        };
        assert_eq!(counts(&linked(Connection::Tie)), [full, 0, 0]);
        let springs = |stiffness, share| linked(Connection::Spring(SpringStiffness::Global(stiffness), share));
        for share in [SupportShare::PerNode, SupportShare::PerGroup] {
            assert_eq!(counts(&springs([1e8; 3], share)), [full, 0, 0]);
            // springs across the joint alone: the lid slides, and turns in the plane of the joint
            let across = if dimension == 2 { [0.0, 1e8, 0.0] } else { [0.0, 0.0, 1e8] };
            let found = springs(across, share);
            assert_eq!(counts(&found), [full, 0, if dimension == 2 { 1 } else { 3 }]);
            let sentence = &found.sentences()[0];
            let expected =
                "\"body\" and \"lid\" are joined by springs of the link \"cover - seat\" and can still move: ";
            assert!(sentence.starts_with(expected), "{sentence}");
        }
    }
}

#[test]
fn sentences_name_what_is_loose() {
    let (cells, description) = two(3, [3, 0, 0], 0);
    assert_eq!(
        find(&cells, description).sentences(),
        ["part \"lid\" (1 element, near x = 0.3500, y = 0.0600, z = 0.0450 m) is not connected: 6 extra rigid modes"]
    );
    let (cells, description) = two(3, [1, 1, 0], 0);
    let found = find(&cells, description);
    assert_eq!(found.sentences(), ["\"body\" and \"lid\" are joined along an edge only (nodes 3, 7): 1 mechanism"]);
    assert_eq!(found.bodies[1].groups, ["lid"]);
    let (cells, description) = two(2, [1, 1, 0], 0);
    assert_eq!(
        find(&cells, description).sentences(),
        ["\"body\" and \"lid\" are joined at a single node only (node 3): 1 mechanism"]
    );
    let pinned = cube(3, vec![fixed("corner", [true; 3])]);
    assert_eq!(
        pinned.sentences(),
        [
            "part \"cube\" (8 elements, near x = 0.1000, y = 0.1200, z = 0.0900 m) is held, but can still move: 3 motions without stiffness"
        ]
    );
    assert!(cube(3, Vec::new()).sentences().is_empty());
}

/// A held cube and a loose one: the loose one is not the whole. A hinge between two held ones moves nothing.
#[test]
fn what_is_held_is_told_from_what_is_loose() {
    let held = |at: [i32; 3], both: bool| {
        let (cells, all) = two(3, at, 0);
        let cells = cells.points("feet", 0, &[[0, 0, 0], [1, 0, 0], [0, 1, 0]]);
        let top = [[0, 0, 1], [1, 0, 1], [0, 1, 1]];
        let top = top.map(|[x, y, z]| [at[0] + x, at[1] + y, at[2] + z]);
        let cells = cells.points("top", 0, &top);
        let mut supports = vec![fixed("feet", [true; 3])];
        if both {
            supports.push(fixed("top", [true; 3]));
        }
        find(&cells, HousingDescription { supports, ..all })
    };
    assert_eq!(counts(&held([3, 0, 0], false)), [0, 6, 0]);
    assert_eq!(held([3, 0, 0], false).sentences().len(), 1);
    assert_eq!(counts(&held([1, 1, 0], false)), [0, 0, 1]);
    assert_eq!(counts(&held([1, 1, 0], true)), [0, 0, 0]);
    assert!(held([1, 1, 0], true).sentences().is_empty());
}

/// Four squares round a hole, joined at their corners: each joint leaves a turn, together one; and three in a row.
#[test]
fn joints_in_a_ring_hold_each_other() {
    let cells = Cells::new(2, [0.1; 3])
        .block("s", 0, [1, 0, 0], [2, 1, 0])
        .block("e", 0, [2, 1, 0], [3, 2, 0])
        .block("n", 0, [1, 2, 0], [2, 3, 0])
        .block("w", 0, [0, 1, 0], [1, 2, 0]);
    let found = find(&cells, description(&cells, &["s", "e", "n", "w"], 1.0));
    assert_eq!((counts(&found), found.joints.len()), ([3, 0, 1], 4));
    let sentences = found.sentences();
    assert!(sentences[0].ends_with("1 mechanism by itself"), "{sentences:?}");
    assert_eq!(sentences[4], "these joints together leave 1 mechanism");
    let row = Cells::new(3, [0.1; 3]).block("a", 0, [0; 3], [1, 1, 1]).block("b", 0, [1; 3], [2, 2, 2]).block(
        "c",
        0,
        [2, 2, 1],
        [3, 3, 2],
    );
    let found = find(&row, description(&row, &["a", "b", "c"], 1.0));
    assert_eq!(counts(&found), [6, 0, 4]);
    assert_eq!(found.sentences().len(), 2);
}

/// More constraints on one body than are kept: 49 nodes on a plane.
#[test]
fn many_constraints_count_like_few() {
    let cells =
        Cells::new(3, [0.1, 0.12, 0.09]).block("plate", 0, [0; 3], [6, 6, 1]).face("floor", 0, [0; 3], [6, 6, 0]);
    let sliding = HousingDescription {
        supports: vec![fixed("floor", [false, false, true])],
        ..description(&cells, &["plate"], 1.0)
    };
    assert_eq!(counts(&find(&cells, sliding)), [0, 0, 3]);
}

/// A body a thousand times smaller than the one that it hangs on, far from the origin.
#[test]
fn small_bodies_count_like_large_ones() {
    let mut cells =
        Cells::new(3, [1.0; 3]).block("large", 0, [0; 3], [1, 1, 1]).block("small", 0, [1, 1, 0], [2, 2, 1]);
    // the small cube keeps the edge, which shrinks with it to a corner's size
    for point in &mut cells.mesh.nodes {
        for (axis, x) in point.iter_mut().enumerate() {
            if axis < 2 && *x > 1.5 {
                *x = 1.001;
            }
        }
        point.iter_mut().for_each(|x| *x += 100.0);
    }
    let model = HousingModel::new(&cells.mesh, description(&cells, &["large", "small"], 1.0));
    let found = Mechanisms::find(&cells.mesh, &model.expect("a model")).expect("two bodies");
    assert_eq!(counts(&found), [6, 0, 1]);
}

/// Two pins a thousandth of the body apart hold it in its plane.
#[test]
fn a_joint_of_one_small_element_holds() {
    let mut cells = Cells::new(2, [1.0; 3]).block("b", 0, [0; 3], [2, 1, 1]).points("pins", 0, &[[0, 0, 0], [1, 0, 0]]);
    let near = cells.node(0, [1, 0, 0]);
    cells.mesh.nodes[near][0] = 0.002;
    let pinned =
        HousingDescription { supports: vec![fixed("pins", [true, true, false])], ..description(&cells, &["b"], 1.0) };
    assert_eq!(counts(&find(&cells, pinned)), [0, 0, 0]);
}

#[test]
fn a_mesh_in_crumbs_is_refused() {
    let mut cells = Cells::new(2, [0.1; 3]);
    for k in 0..201 {
        cells = cells.block("crumbs", 0, [2 * k, 0, 0], [2 * k + 1, 1, 0]);
    }
    let model = HousingModel::new(&cells.mesh, description(&cells, &["crumbs"], 1.0));
    let found = Mechanisms::find(&cells.mesh, &model.expect("a model"));
    assert!(matches!(found, Err(ModalError::TooManyBodies { found: 201, limit: 200 })));
}
