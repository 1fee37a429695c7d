use super::*;
use crate::fe::element::continuum::quality;
use crate::fe::mesh::{MeshNotes, MshFormat, MshVersion};
use std::path::PathBuf;

const RING: SolidRing = SolidRing { radius: 5.0, height: 1.5, width: 4.0, around: 24, across: 2, along: 4 };

fn empty() -> Mesh {
    Mesh {
        nodes: Vec::new(),
        node_tags: Vec::new(),
        blocks: Vec::new(),
        groups: Vec::new(),
        format: MshFormat { version: MshVersion::V41, binary: false },
        notes: MeshNotes::default(),
        source: PathBuf::from("ring"),
    }
}

/// A frame about no axis of the mesh (in space), or clockwise (in the plane).
fn frame(dimension: usize) -> RingFrame {
    let (axis, zero) = match dimension {
        3 => ([1.0, 2.0, 3.0], [1.0, 0.0, 0.0]),
        _ => ([0.0, 0.0, -1.0], [0.3, 1.0, 0.0]),
    };
    RingFrame::new([0.5, -1.0, 2.0], axis, zero).expect("a frame")
}

/// Volume (area) and the measures of the two groups are those of the ring, and every element is well shaped: a ring
/// whose cells were turned inside out, or whose middle nodes were mixed up, has neither.
#[test]
fn the_elements_fill_the_ring() {
    for (dimension, frames) in [(2, [RingFrame::default(), frame(2)]), (3, [RingFrame::default(), frame(3)])] {
        for frame in frames {
            let MeshedRing { mesh, body, .. } = RING.added_to(&empty(), &frame, dimension);
            let group = mesh.group(&body).expect("its body");
            assert_eq!(group.elements.len(), RING.elements(dimension));
            let mut volume = 0.0;
            for id in &group.elements {
                let block = &mesh.blocks[id.block];
                let nodes = block.element(id.index).expect("an element");
                let places: Vec<[f64; 3]> = nodes.iter().map(|&node| mesh.nodes[node]).collect();
                let kind = block.kind;
                let shape = quality(kind, &places).expect("numbers");
                // a cell of 15 degrees: inner side over outer side is 0.74 across the whole ring
                assert!(shape.scaled_jacobian > 0.7, "{dimension}: {shape:?}");
                volume += crate::fe::element::continuum::measure(kind, &places).expect("a size");
            }
            let area = 2.0 * PI * RING.radius * RING.height;
            let expected = if dimension == 3 { area * RING.width } else { area };
            // every arc is a parabola through its ends and its middle, half an arc is 7.5 degrees
            let half = PI / RING.around as f64;
            let bulge = half.sin() * (1.0 + (1.0 - half.cos()) / 3.0) / half;
            // what remains is round-off
            assert!((volume / (bulge * expected) - 1.0).abs() < 1e-12, "{dimension}: {volume} {expected}");
        }
    }
}

#[test]
fn the_outer_face_lies_outside_and_sections_balance_about_the_centroid_line() {
    for dimension in [2, 3] {
        let frame = frame(dimension);
        let ring = RING.added_to(&empty(), &frame, dimension);
        let outside = ring.mesh.group(&ring.outer_face).expect("its face");
        assert_eq!(outside.dimension, dimension - 1);
        let along = if dimension == 3 { RING.along } else { 1 };
        assert_eq!(outside.elements.len(), RING.around * along);
        for &node in &outside.nodes {
            let [x, y, _] = frame.point(ring.mesh.nodes[node]);
            assert!((x.hypot(y) - 5.75).abs() < 1e-12);
        }
        assert_eq!(ring.sections.len(), RING.around);
        for (station, section) in ring.sections.iter().enumerate() {
            let mut mean = [0.0; 3];
            for &(node, share) in section {
                let place = frame.point(ring.mesh.nodes[node]);
                (0..3).for_each(|axis| mean[axis] += share * place[axis]);
            }
            let (sin, cos) = (PI * station as f64 / 12.0).sin_cos();
            let height = if dimension == 3 { 0.0 } else { mean[2] };
            for (found, expected) in mean.iter().zip([5.0 * cos, 5.0 * sin, height]) {
                assert!((found - expected).abs() < 1e-12, "{found} {expected}");
            }
            let whole: f64 = section.iter().map(|&(_, share)| share).sum();
            assert!((whole - 1.0).abs() < 1e-14);
        }
        if dimension == 3 {
            let body = ring.mesh.group(&ring.body).expect("its body");
            let faces = ring.mesh.boundary_faces(body.elements.iter().copied());
            // outside, inside, and the two ends
            assert_eq!(faces.len(), 24 * (4 + 4 + 2 + 2));
        }
    }
}

/// What was there stays where it was, and names, tags and nodes of the ring are new.
#[test]
fn a_second_ring_leaves_the_first_alone() {
    for dimension in [2, 3] {
        let first = RING.added_to(&empty(), &RingFrame::default(), dimension);
        let smaller = SolidRing { radius: 3.0, ..RING };
        let both = smaller.added_to(&first.mesh, &RingFrame::default(), dimension);
        assert_ne!(both.body, first.body);
        assert_ne!(both.outer_face, first.outer_face);
        assert_eq!(both.mesh.nodes.len(), 2 * first.mesh.nodes.len());
        assert_eq!(both.mesh.nodes[..first.mesh.nodes.len()], first.mesh.nodes);
        for (block, before) in both.mesh.blocks.iter().zip(&first.mesh.blocks) {
            assert_eq!(block, before);
        }
        for group in &first.mesh.groups {
            assert_eq!(both.mesh.group(&group.name).expect("still there"), group);
        }
        let unique = |mut tags: Vec<u64>| {
            let all = tags.len();
            tags.sort_unstable();
            tags.dedup();
            tags.len() == all && tags[0] > 0
        };
        assert!(unique(both.mesh.node_tags.clone()));
        let elements = both.mesh.blocks.iter().flat_map(|block| block.tags.clone());
        assert!(unique(elements.collect()));
        let new = both.mesh.group(&both.body).expect("its body");
        assert!(new.nodes.iter().all(|&node| node >= first.mesh.nodes.len()));
    }
}
