use super::*;
use crate::fe::mesh::{ElementBlock, Entity, MeshNotes, MshFormat, MshVersion, PhysicalGroup};
use std::path::PathBuf;

/// Two Tet10 on one face; the middle of an edge of it lies beyond the body, so that both fold.
fn folded() -> Mesh {
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0]];
    let at = |nodes: &[[f64; 3]], place: [f64; 3]| nodes.iter().position(|node| distance(*node, place) < 1e-15);
    let mut nodes = corners.to_vec();
    let mut connectivity = Vec::new();
    for tetrahedron in [[0, 1, 2, 3], [1, 2, 3, 4]] {
        connectivity.extend(tetrahedron);
        for &[a, b] in ElementKind::Tet10.corner_edges() {
            let [a, b] = [a, b].map(|place| nodes[tetrahedron[place]]);
            let middle = [0, 1, 2].map(|d| 0.5 * (a[d] + b[d]));
            let known = at(&nodes, middle);
            connectivity.push(known.unwrap_or_else(|| {
                nodes.push(middle);
                nodes.len() - 1
            }));
        }
    }
    let far = at(&nodes, [0.5, 0.5, 0.0]).unwrap();
    nodes[far] = [0.05, 0.05, 0.0];
    Mesh {
        node_tags: (1..=nodes.len() as u64).collect(),
        nodes,
        blocks: vec![ElementBlock {
            kind: ElementKind::Tet10,
            tags: vec![7, 8],
            connectivity,
            entity: Entity { dimension: 3, tag: 1 },
        }],
        groups: Vec::new(),
        format: MshFormat { version: MshVersion::V41, binary: false },
        source: PathBuf::new(),
        notes: MeshNotes::default(),
    }
}

#[test]
fn folded_elements_and_their_neighbours_are_mended() {
    let mut mesh = folded();
    let ids: Vec<ElementId> = mesh.element_ids(3).collect();
    assert!(folds(&mesh, ids[0]));
    let nodes = (0..mesh.nodes.len()).collect();
    mesh.groups = vec![PhysicalGroup { name: "skin".into(), dimension: 2, tag: 1, nodes, elements: Vec::new() }];
    let told = mend_all(&mut mesh, ids.clone());
    for id in ids {
        assert!(measure(ElementKind::Tet10, &places(&mesh, id)).is_ok() && !is_thin(&mesh, id));
    }
    assert!(told.contains("off its surfaces moved by at most"), "{told}");
    assert!(told.ends_with("of them in the group \"skin\""), "{told}");
    let before = mesh.clone();
    straighten(&mut mesh).unwrap();
    assert_eq!(mesh, before);
}

#[test]
fn inverted_elements_stay() {
    let mut mesh = folded();
    mesh.nodes.swap(0, 3);
    mesh.nodes[4] = [-1.0; 3];
    let before = mesh.clone();
    straighten(&mut mesh).unwrap();
    assert_eq!(mesh, before);
}

/// Two layers of Quad8 about a bore of radius 1, ten round the turn: the inner layer is thinner than its arcs are high.
fn bore() -> Mesh {
    let mut nodes: Vec<[f64; 3]> = Vec::new();
    let mut connectivity = Vec::new();
    let turn = |tenths: f64, radius: f64| {
        let (sin, cos) = (tenths * std::f64::consts::PI / 5.0).sin_cos();
        [radius * cos, radius * sin, 0.0]
    };
    for (inner, outer) in [(1.0, 1.04), (1.04, 2.0)] {
        for side in 0..10 {
            let [from, to] = [f64::from(side), f64::from(side + 1)];
            let corners = [turn(from, inner), turn(from, outer), turn(to, outer), turn(to, inner)];
            let middle = |a: usize, b: usize| [0, 1, 2].map(|d| 0.5 * (corners[a][d] + corners[b][d]));
            let arc = if inner < 1.02 { turn(from + 0.5, 1.0) } else { middle(3, 0) };
            for place in corners.into_iter().chain([middle(0, 1), middle(1, 2), middle(2, 3), arc]) {
                let known = nodes.iter().position(|node| distance(*node, place) < 1e-9);
                connectivity.push(known.unwrap_or_else(|| {
                    nodes.push(place);
                    nodes.len() - 1
                }));
            }
        }
    }
    let block = ElementBlock {
        kind: ElementKind::Quad8,
        tags: (1..=20).collect(),
        connectivity,
        entity: Entity { dimension: 2, tag: 1 },
    };
    Mesh { node_tags: (1..=nodes.len() as u64).collect(), nodes, blocks: vec![block], ..folded() }
}

#[test]
fn a_bore_stays_round() {
    let mut mesh = bore();
    let ids: Vec<ElementId> = mesh.element_ids(2).collect();
    assert_eq!(ids.iter().filter(|&&id| folds(&mesh, id)).count(), 10);
    straighten(&mut mesh).unwrap();
    assert!(mesh.notes.told[0].to_string().contains("; the area of the mesh changed by "));
    assert!(ids.iter().all(|&id| !folds(&mesh, id) && !is_thin(&mesh, id)));
    assert_eq!(on_bore(&mesh), 20);
}

fn on_bore(mesh: &Mesh) -> usize {
    mesh.nodes.iter().filter(|node| (node[0].hypot(node[1]) - 1.0).abs() < 1e-12).count()
}

/// The body twice: its corners alone stay on the bore, and so much of a change is refused.
#[test]
fn all_edges_become_straight_where_elements_lie_in_one_another() {
    let mut mesh = bore();
    let count = mesh.nodes.len();
    mesh.nodes.extend(mesh.nodes.clone());
    mesh.node_tags = (1..=2 * count as u64).collect();
    let mut copy = mesh.blocks[0].clone();
    copy.tags.iter_mut().for_each(|tag| *tag += 20);
    copy.connectivity.iter_mut().for_each(|node| *node += count);
    mesh.blocks.push(copy);
    let told = straighten(&mut mesh).unwrap_err().to_string();
    assert_eq!(on_bore(&mesh), 20);
    // ten chords in the place of the circle of radius 1, in ten straight sides of radius 2; arcs are parabolas
    let (sin, cos) = (std::f64::consts::PI / 10.0).sin_cos();
    let (chords, gained) = (10.0 * sin * cos, 10.0 * 2.0 / 3.0 * 2.0 * sin * (1.0 - cos));
    let change = 100.0 * gained / (3.0 * chords - gained);
    assert!(
        told.contains(&format!(
            "would change the area of the mesh by {change:+.2} %: expected at most 2 %; mesh finer"
        )),
        "{told}"
    );
}

#[test]
fn straight_edges_are_advised_only_where_they_mend() {
    let mut mesh = folded();
    let id = mesh.element_ids(3).next().unwrap();
    let advice = |mesh: &Mesh| measure(ElementKind::Tet10, &places(mesh, id)).unwrap_err().to_string();
    assert!(advice(&mesh).contains("housing.straighten = true mends"), "{}", advice(&mesh));
    // all corners in one plane
    mesh.nodes[3] = [1.0, 1.0, 0.0];
    assert!(advice(&mesh).ends_with("straight edges do not mend it: mesh again"), "{}", advice(&mesh));
}
