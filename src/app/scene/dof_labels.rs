//! Names of all degrees of freedom of housing and ring, in the order of the matrices before anything is left out.

use std::collections::BTreeSet;

use crate::fe::model::{HousingModel, Ring, RingFrame, RingTie};
use crate::formats::{DofBody, DofDirection, DofLabel};

/// Labels of a housing's degrees of freedom; those of a sliding tie's bore are in polar axes.
pub(crate) fn of_housing(model: &HousingModel, tie: Option<&RingTie>) -> Vec<DofLabel> {
    let d = model.dimension();
    // a sliding tie turns all components of the bore's nodes
    let sliding = tie.filter(|tie| tie.rotation().is_some());
    let bore: BTreeSet<usize> = sliding.iter().flat_map(|tie| &tie.partition().driven).map(|dof| dof / d).collect();
    let nodes = model.coordinates().iter().zip(&model.node_tags).enumerate();
    let labels = nodes.flat_map(|(index, (&position, &node))| {
        let polar = bore.contains(&index);
        let axes = match polar {
            true => model.frame().polar_axes(position),
            false => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        };
        (0..d).map(move |component| DofLabel {
            body: DofBody::Housing,
            node,
            direction: match polar {
                true => DofDirection::Polar(component),
                false => DofDirection::Along(component),
            },
            position,
            axis: axes[component],
        })
    });
    labels.collect()
}

/// In the order of a ring's displacements: those in its plane, then those out of it.
pub(crate) fn of_ring(ring: &Ring, frame: &RingFrame) -> Vec<DofLabel> {
    use DofDirection::{About, Along};
    let in_plane = [(Along(0), 0), (Along(1), 1), (About(2), 2)];
    let out_of_plane = [(Along(2), 2), (About(0), 0), (About(1), 1)];
    let blocks = if ring.is_in_space() { vec![in_plane, out_of_plane] } else { vec![in_plane] };
    let mut labels = Vec::with_capacity(ring.dof());
    for block in blocks {
        for node in 0..ring.nodes() {
            for (direction, axis) in block {
                let mut unit = [0.0; 3];
                unit[axis] = 1.0;
                labels.push(DofLabel {
                    body: DofBody::Ring,
                    node: node as u64,
                    direction,
                    position: frame.point_to_mesh(ring.node_position(node)),
                    axis: frame.vector_to_mesh(unit),
                });
            }
        }
    }
    labels
}
