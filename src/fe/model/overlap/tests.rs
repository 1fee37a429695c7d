//! Bodies with known faults, and sound ones that must not be blamed.

use super::outline::BoxTree;
use super::{Bodies, Doubled};
use crate::fe::mesh::{
    BoundingBox, ElementBlock, ElementId, ElementKind, Entity, Mesh, MeshNotes, MshFormat, MshVersion, PhysicalGroup,
};
use std::f64::consts::{PI, TAU};

fn empty() -> Mesh {
    Mesh {
        nodes: Vec::new(),
        node_tags: Vec::new(),
        blocks: Vec::new(),
        groups: Vec::new(),
        format: MshFormat { version: MshVersion::V41, binary: false },
        notes: MeshNotes::default(),
        source: "bodies.msh".into(),
    }
}

/// Adds nodes, and elements on them (indices from the first of these nodes) as a group.
fn add(mesh: &mut Mesh, group: &str, kind: ElementKind, nodes: &[[f64; 3]], elements: &[Vec<usize>]) {
    let first = mesh.nodes.len();
    mesh.nodes.extend_from_slice(nodes);
    mesh.node_tags = (1..=mesh.nodes.len() as u64).collect();
    let count: usize = mesh.blocks.iter().map(ElementBlock::len).sum();
    let block = mesh.blocks.len();
    let (dimension, tag) = (kind.dimension(), block as i32 + 1);
    mesh.blocks.push(ElementBlock {
        kind,
        tags: (count as u64 + 1..).take(elements.len()).collect(),
        connectivity: elements.iter().flatten().map(|local| first + local).collect(),
        entity: Entity { dimension, tag },
    });
    mesh.groups.push(PhysicalGroup {
        name: group.to_owned(),
        dimension,
        tag,
        nodes: (first..mesh.nodes.len()).collect(),
        elements: (0..elements.len()).map(|index| ElementId { block, index }).collect(),
    });
}

fn polar(radius: f64, angle: f64, z: f64) -> [f64; 3] {
    [radius * angle.cos(), radius * angle.sin(), z]
}

/// Adds a tube of Hex8, one layer, from radius to radius.
fn tube(mesh: &mut Mesh, group: &str, [inner, outer]: [f64; 2], around: usize) {
    let at = |k: usize| TAU * k as f64 / around as f64;
    let nodes: Vec<[f64; 3]> = (0..around)
        .flat_map(|k| [(inner, 0.0), (outer, 0.0), (inner, 0.3), (outer, 0.3)].map(|(r, z)| polar(r, at(k), z)))
        .collect();
    let elements: Vec<Vec<usize>> = (0..around)
        .map(|k| {
            let (a, b) = (4 * k, 4 * ((k + 1) % around));
            vec![a, a + 1, b + 1, b, a + 2, a + 3, b + 3, b + 2]
        })
        .collect();
    add(mesh, group, ElementKind::Hex8, &nodes, &elements);
}

/// Adds a plane ring of Quad8 whose middle nodes lie on the circles.
fn quadratic_ring(mesh: &mut Mesh, group: &str, [inner, outer]: [f64; 2], around: usize) {
    let half = PI / around as f64;
    let nodes: Vec<[f64; 3]> = (0..2 * around)
        .flat_map(|k| {
            let angle = half * k as f64;
            [inner, 0.5 * (inner + outer), outer].map(|radius| polar(radius, angle, 0.0))
        })
        .collect();
    let elements: Vec<Vec<usize>> = (0..around)
        .map(|k| {
            let [a, m, b] = [2 * k, 2 * k + 1, (2 * k + 2) % (2 * around)].map(|place| 3 * place);
            vec![a, a + 2, b + 2, b, a + 1, m + 2, b + 1, m]
        })
        .collect();
    add(mesh, group, ElementKind::Quad8, &nodes, &elements);
}

const CUBE: [[f64; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 1.0],
    [0.0, 1.0, 1.0],
];

/// Two tubes, one in the other, that share a radius and but two nodes: flat faces miss each other by the sagitta and the bodies
/// reach into one another by as much, and still they touch all round and do not overlap.
#[test]
fn curved_faces_of_other_meshes_touch() {
    let mut mesh = empty();
    tube(&mut mesh, "hub", [1.0, 1.5], 20);
    tube(&mut mesh, "shaft", [0.5, 1.0], 33);
    let bodies = Bodies::of_mesh(&mesh);
    assert_eq!((bodies.doubled(), bodies.overlaps()), (None, Vec::new()));
    let touching = bodies.touching(|_| false);
    assert_eq!(touching.len(), 1, "{touching:?}");
    let found = &touching[0];
    assert_eq!(found.parts, ["hub", "shaft"]);
    assert_eq!((found.faces, found.node_pairs), (20 + 33, 2));
    // the larger of both: 33 chords of the circle, 0.3 m high
    let area = 33.0 * 2.0 * (PI / 33.0).sin() * 0.3;
    assert!((found.size / area - 1.0).abs() < 1e-12, "{} {area}", found.size);
    // the apothem of the coarser polygon is 0.0123 m short of the circle
    assert!(found.gap > 0.004 && found.gap < 1.0 - (PI / 20.0).cos(), "{}", found.gap);
    let [x, y, _] = found.place;
    assert!((x.hypot(y) - (PI / 20.0).cos()).abs() < 1e-12);
}

/// A gap of five sagittas of the coarser tube (0.0123) is a gap.
#[test]
fn curved_faces_apart_do_not_touch() {
    let mut mesh = empty();
    tube(&mut mesh, "hub", [1.0, 1.5], 20);
    tube(&mut mesh, "shaft", [0.5, 0.94], 33);
    assert_eq!(Bodies::of_mesh(&mesh).touching(|_| false), []);
}

/// Eighths of a circle as single Quad8: their chords cut into the ring within, their curves do not.
#[test]
fn curved_elements_are_taken_as_they_are_curved() {
    let mut mesh = empty();
    quadratic_ring(&mut mesh, "coarse", [1.0, 1.2], 8);
    quadratic_ring(&mut mesh, "fine", [0.8, 1.0], 40);
    let bodies = Bodies::of_mesh(&mesh);
    assert_eq!((bodies.doubled(), bodies.overlaps()), (None, Vec::new()));
    let touching = bodies.touching(|_| false);
    assert_eq!(touching.len(), 1);
    assert_eq!((touching[0].faces, touching[0].dimension), (48, 2));
}

/// The same ring reaching into the other by half its thickness.
#[test]
fn rings_in_one_another_overlap() {
    let mut mesh = empty();
    quadratic_ring(&mut mesh, "outer", [1.0, 1.2], 30);
    quadratic_ring(&mut mesh, "inner", [0.8, 1.12], 41);
    let overlaps = Bodies::of_mesh(&mesh).overlaps();
    assert_eq!(overlaps.len(), 1);
    assert_eq!(overlaps[0].parts, ["outer", "inner"]);
    // centres of the outer ring's elements at 1.1 m lie in the inner one, those of the inner one at 0.96 m not in the outer one
    assert_eq!(overlaps[0].elements, 30);
    let area = PI * (1.2_f64.powi(2) - 1.0);
    assert!((overlaps[0].size / area - 1.0).abs() < 1e-3, "{}", overlaps[0].size);
}

/// Two Tet10 on one face in a wall of 1 mm about a radius of 70 mm (lengths in mm): by the planes of its straight faces each holds
/// the centre of the other, by its own map it does not. A third one that lies in the first is found.
#[test]
fn curved_tetrahedra_are_judged_by_their_own_map() {
    let places = [
        [0.0, 0.0, 0.0],
        [-9.0, 0.3, 12.1],
        [-2.2, 12.7, 7.1],
        [-5.0, 0.3, 5.8],
        [-1.4, 6.3, 3.4],
        [-6.0, 6.7, 9.4],
        [-4.1, -1.0, 2.8],
        [-1.2, 12.3, 4.1],
        [5.1, 5.2, -4.3],
        [-2.8, 5.7, 3.2],
        [1.7, 8.8, -0.3],
        [0.2, 2.1, -1.1],
        [-2.0, -0.5, 1.1],
        [-1.7, 12.5, 5.6],
        [2.1, 2.4, -2.2],
        [-0.8, 6.1, 1.7],
        [-5.6, 6.5, 7.9],
    ];
    let tets = [[7, 6, 8, 0, 9, 11, 10, 15, 14, 12], [0, 7, 1, 2, 15, 16, 3, 4, 5, 13]];
    let mut mesh = empty();
    add(&mut mesh, "wall", ElementKind::Tet10, &places, &tets.map(|tet: [usize; 10]| tet.to_vec()));
    assert_eq!(Bodies::of_mesh(&mesh).overlaps(), []);
    // about the centre of the first, a tenth as large
    let first = tets[0].map(|node| places[node]);
    let weight = |local: usize| if local < 4 { -0.125 } else { 0.25 };
    let centre = [0, 1, 2].map(|d| (0..10).map(|local| weight(local) * first[local][d]).sum::<f64>());
    let small = first.map(|place| [0, 1, 2].map(|d| centre[d] + 0.1 * (place[d] - centre[d])));
    add(&mut mesh, "within", ElementKind::Tet10, &small, &[(0..10).collect()]);
    let overlaps = Bodies::of_mesh(&mesh).overlaps();
    assert_eq!(overlaps.len(), 1, "{overlaps:?}");
    assert_eq!((overlaps[0].elements, overlaps[0].tags), (2, [1, 3]));
}

/// A cube as one Hex8 and again as one Hex20 on the same corners, which begins at another one.
#[test]
fn kinds_and_order_do_not_hide_a_double() {
    let mut mesh = empty();
    add(&mut mesh, "linear", ElementKind::Hex8, &CUBE, &[(0..8).collect()]);
    let mut second: Vec<usize> = [1, 2, 3, 0, 5, 6, 7, 4].to_vec();
    let pairs = [[0, 1], [0, 3], [0, 4], [1, 2], [1, 5], [2, 3], [2, 6], [3, 7], [4, 5], [4, 7], [5, 6], [6, 7]];
    for pair in pairs {
        let [a, b] = pair.map(|corner| mesh.nodes[second[corner]]);
        mesh.nodes.push([0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis])));
        second.push(mesh.nodes.len() - 1);
    }
    let first = mesh.nodes.len();
    let second: Vec<usize> = second.iter().map(|node| node.wrapping_sub(first)).collect();
    add(&mut mesh, "quadratic", ElementKind::Hex20, &[], &[]);
    mesh.blocks[1].connectivity = second.iter().map(|node| node.wrapping_add(first)).collect();
    mesh.blocks[1].tags = vec![2];
    mesh.groups[1].elements = vec![ElementId { block: 1, index: 0 }];
    let bodies = Bodies::of_mesh(&mesh);
    let expected =
        Doubled { elements: 1, tags: [1, 2], parts: ["linear".to_owned(), "quadratic".to_owned()], place: [0.5; 3] };
    assert_eq!(bodies.doubled(), Some(expected));
    assert_eq!(bodies.overlaps(), []);
}

/// A cube as a Hex8 and as five Tet4 on its nodes: no corners are the same, no faces either.
/// Two cubes on each other that share the nodes of their common face; the centre of that face is in one of them alone.
#[test]
fn faces_with_and_without_a_centre_come_apart() {
    use ElementKind::{Hex20, Hex27, Pyramid13, Pyramid14};
    let found = |lower: ElementKind, upper: ElementKind| {
        let mut mesh = empty();
        for (name, kind, up) in [("lower", lower, 0.0), ("upper", upper, 2.0)] {
            // a pyramid stands on the lower cube's upper face
            let up = if kind.corners() == 5 { 1.0 } else { up };
            let nodes: Vec<_> = kind.natural_nodes().iter().map(|&[x, y, z]| [x, y, z + up]).collect();
            add(&mut mesh, name, kind, &nodes, &[(0..kind.nodes()).collect()]);
        }
        let points = mesh.nodes.clone();
        let same = |a: [f64; 3], b: [f64; 3]| (0..3).all(|d| (a[d] - b[d]).abs() < 1e-12);
        for node in &mut mesh.blocks[1].connectivity {
            *node = points.iter().position(|&point| same(point, points[*node])).unwrap();
        }
        Bodies::of_mesh(&mesh).mixed_orders().map(|mixed| mixed.sentence("m"))
    };
    for [lower, upper] in [[Hex27, Hex27], [Hex20, Hex20], [Hex27, Pyramid14], [Hex20, Pyramid13]] {
        assert_eq!(found(lower, upper), None, "{lower:?} {upper:?}");
    }
    for [lower, upper] in [[Hex27, Hex20], [Hex20, Hex27], [Hex27, Pyramid13], [Hex20, Pyramid14]] {
        assert_eq!(
            found(lower, upper).as_deref(),
            Some(
                "1 face is without a centre node that all elements there have in common, the first is that of elements 1 and 2 of \"lower\" and \"upper\" at (0.000000, 0.000000, 1.000000) m"
            ),
            "{lower:?} {upper:?}"
        );
    }
}

#[test]
fn other_elements_on_the_same_nodes_overlap() {
    let mut mesh = empty();
    add(&mut mesh, "whole", ElementKind::Hex8, &CUBE, &[(0..8).collect()]);
    let tets = [[0, 1, 3, 4], [1, 2, 3, 6], [1, 6, 4, 5], [3, 4, 6, 7], [1, 3, 4, 6]];
    add(&mut mesh, "pieces", ElementKind::Tet4, &CUBE, &tets.map(|tet: [usize; 4]| tet.to_vec()));
    mesh.blocks[1].connectivity.iter_mut().for_each(|node| *node -= 8);
    mesh.nodes.truncate(8);
    let bodies = Bodies::of_mesh(&mesh);
    assert_eq!(bodies.doubled(), None);
    let overlaps = bodies.overlaps();
    assert_eq!(overlaps.len(), 1);
    assert_eq!(overlaps[0].elements, 6);
    assert!((overlaps[0].size - 1.0).abs() < 1e-12);
}

/// A cut without width through one body of four squares, whose halves share the two nodes at its ends.
#[test]
fn a_crack_in_one_body_touches_itself() {
    let mut mesh = empty();
    let mut nodes: Vec<[f64; 3]> =
        (0..3).flat_map(|y| (0..3).map(move |x| [f64::from(x), f64::from(y), 0.0])).collect();
    nodes.push([2.0, 1.0, 0.0]);
    let cells = [[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 9, 8, 7]];
    add(&mut mesh, "plate", ElementKind::Quad4, &nodes, &cells.map(|cell: [usize; 4]| cell.to_vec()));
    let touching = Bodies::of_mesh(&mesh).touching(|_| false);
    assert_eq!(touching.len(), 1);
    assert_eq!((touching[0].faces, touching[0].node_pairs), (2, 1));
    assert_eq!(touching[0].parts, ["plate", "plate"]);
    assert!((touching[0].size - 1.0).abs() < 1e-12);
    assert_eq!(Bodies::of_mesh(&mesh).touching(|node| [4, 5].contains(&node)), []);
}

/// What is folded is the assembly's to name.
#[test]
fn an_inverted_element_is_no_overlap() {
    let mut mesh = empty();
    let nodes = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.9, 0.5, 0.0]];
    let cells = [vec![0, 1, 2], vec![0, 4, 2]];
    add(&mut mesh, "plate", ElementKind::Tri3, &nodes, &cells);
    assert_eq!(Bodies::of_mesh(&mesh).overlaps().len(), 1);
    mesh.blocks[0].connectivity[3..].reverse();
    assert_eq!(Bodies::of_mesh(&mesh).overlaps(), []);
}

/// Of one body without a group, in a unit that is not known.
#[test]
fn one_body_is_told_as_one() {
    let mut mesh = empty();
    let nodes = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.9, 0.5, 0.0]];
    add(&mut mesh, "plate", ElementKind::Tri3, &nodes, &[vec![0, 1, 2], vec![0, 4, 2]]);
    let told = |mesh: &Mesh| {
        let [overlap] = &Bodies::of_mesh(mesh).overlaps()[..] else { panic!() };
        (overlap.sentence("unit"), overlap.advice())
    };
    let (sentence, advice) = told(&mesh);
    assert!(sentence.starts_with("elements of the part \"plate\" lie in one another: 1 elements have their centre"));
    assert_eq!(advice, "mesh the geometry again, or delete the copy where it holds a body twice");
    mesh.groups.clear();
    let (sentence, _) = told(&mesh);
    assert!(sentence.starts_with("elements of the mesh lie in one another: "), "{sentence}");
    assert!(sentence.contains(" on about 0.1 unit^2, ") && sentence.ends_with(") unit"), "{sentence}");
}

/// A surface that folds back over itself in space has no inside.
#[test]
fn surfaces_in_space_are_left_alone() {
    let mut mesh = empty();
    let mut nodes = CUBE.to_vec();
    nodes.truncate(6);
    let cells = [vec![0, 1, 2, 3], vec![0, 1, 5, 4]];
    add(&mut mesh, "skin", ElementKind::Quad4, &nodes, &cells);
    let bodies = Bodies::of_mesh(&mesh);
    assert_eq!((bodies.overlaps(), bodies.touching(|_| false)), (Vec::new(), Vec::new()));
}

/// Against every box, at random places.
#[test]
fn the_tree_finds_the_boxes_of_a_point() {
    let mut state = 1_u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state) / f64::from(u32::MAX)
    };
    let boxes: Vec<BoundingBox> = (0..500)
        .map(|_| {
            let low = [random(), random(), random()];
            let high = low.map(|x| x + 0.2 * random());
            BoundingBox::of([low, high].into_iter())
        })
        .collect();
    let tree = BoxTree::new(boxes.clone());
    let mut met = 0;
    for _ in 0..200 {
        let (point, reach) = ([random(), random(), random()], 0.05 * random());
        let mut found = Vec::new();
        tree.visit(point, reach, |index| found.push(index));
        found.sort_unstable();
        let inside = |bounds: &BoundingBox| {
            (0..3).all(|axis| (bounds.min[axis] - reach..=bounds.max[axis] + reach).contains(&point[axis]))
        };
        let expected: Vec<usize> = (0..boxes.len()).filter(|&index| inside(&boxes[index])).collect();
        assert_eq!(found, expected);
        met += found.len();
    }
    assert!(met > 200);
}
