//! Mode shapes at the points of a housing and a ring, and which of two sets belong together.

use super::{ModalComparison, ModeSet};
use crate::fe::mesh::Mesh;
use crate::fe::model::{HousingModel, RingSeat, Rings};
use crate::numerics::linalg::DenseMatrix;

/// Modes of a housing, of rings, or both, at the nodes of the mesh and then those of the rings, in one list: of the housing its
/// displacements in the mesh's axes [dof x modes]. Labelled by the mesh's tags where no node of a ring is among them.
pub(crate) fn mode_set(
    frequencies_hz: &[f64],
    housing: Option<(&Mesh, &HousingModel, &DenseMatrix)>,
    rings: &[RingShapes],
) -> ModeSet {
    let mut points = housing.map_or(Vec::new(), |(mesh, ..)| mesh.nodes.clone());
    let nodes = points.len();
    points.extend(rings.iter().flat_map(|ring| &ring.points));
    let of_rings: Vec<(&RingShapes, usize)> =
        rings.iter().flat_map(|ring| (0..ring.points.len()).map(move |node| (ring, node))).collect();
    let shapes = DenseMatrix::from_fn(3 * points.len(), frequencies_hz.len(), |row, mode| {
        let (point, axis) = (row / 3, row % 3);
        match housing {
            Some((_, model, shapes)) if point < nodes => {
                let d = model.dimension();
                if axis < d { shapes[(d * point + axis, mode)] } else { 0.0 }
            }
            _ => {
                let (ring, node) = of_rings[point - nodes];
                ring.displacements[mode][node][axis]
            }
        }
    });
    let node_tags = housing.filter(|_| rings.is_empty()).map(|(mesh, ..)| mesh.node_tags.clone());
    ModeSet { frequencies_hz: frequencies_hz.to_vec(), points, node_tags, shapes, directions: None }
}

/// A mode that belongs to another one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Partner {
    /// Its frequency, Hz.
    pub hz: f64,
    /// Squared cosine of the largest angle between the two, or between the groups of repeated modes that they are in.
    pub mac: f64,
}

/// What of `other` belongs to each mode of `own`: by shape, and repeated ones in their order within their group.
pub(crate) fn partners(own: &ModeSet, other: &ModeSet, found: &ModalComparison) -> Vec<Option<Partner>> {
    let mut partners = vec![None; own.frequencies_hz.len()];
    for pair in &found.pairs {
        // a group that the end of the list cuts off has its lowest modes here
        let cut = pair.here.len() < pair.there.len() && pair.here.contains(&(partners.len() - 1));
        if pair.here.len() != pair.there.len() && !cut {
            continue;
        }
        let ascending = |modes: &[usize], hz: &[f64]| {
            let mut modes = modes.to_vec();
            modes.sort_by(|&a, &b| hz[a].total_cmp(&hz[b]));
            modes
        };
        let here = ascending(&pair.here, &own.frequencies_hz);
        let there = ascending(&pair.there, &other.frequencies_hz);
        for (here, there) in here.into_iter().zip(there) {
            partners[here] = Some(Partner { hz: other.frequencies_hz[there], mac: pair.mac });
        }
    }
    partners
}

/// Displacements of one ring's nodes in the mesh's axes.
#[derive(Debug, Clone, PartialEq)]
pub struct RingShapes {
    /// The nodes, m.
    pub points: Vec<[f64; 3]>,
    /// Displacements, by mode and node.
    pub displacements: Vec<Vec<[f64; 3]>>,
}

impl RingShapes {
    /// Of all rings from shapes over their coordinates [ring dof x modes].
    pub(crate) fn of_all(rings: &Rings, shapes: &DenseMatrix) -> Vec<Self> {
        let of_seat = |seat: &RingSeat| Self::new(seat, &shapes.subrows(seat.first, seat.ring.dof()).to_owned());
        rings.seats().iter().map(of_seat).collect()
    }

    /// Of one ring from shapes over its own coordinates [ring dof x modes].
    fn new(RingSeat { ring, frame, .. }: &RingSeat, shapes: &DenseMatrix) -> Self {
        let points = (0..ring.nodes()).map(|node| frame.point_to_mesh(ring.node_position(node)));
        let displacements = (0..shapes.ncols())
            .map(|mode| {
                let shape = shapes.col_as_slice(mode);
                (0..ring.nodes()).map(|node| frame.vector_to_mesh(ring.node_displacement(node, shape))).collect()
            })
            .collect();
        Self { points: points.collect(), displacements }
    }
}
