//! The points at which modes with beams and with a body are compared, and how the beams move them.

use crate::fe::modal::FullModes;
use crate::fe::modal::ModeSet;
use crate::fe::model::{MeshedRing, Ring, RingFrame};
use crate::numerics::linalg::DenseMatrix;

/// Corner nodes of all sections of a solid ring.
pub(crate) fn section_nodes(meshed: &MeshedRing) -> impl Iterator<Item = usize> + '_ {
    meshed.sections.iter().flatten().map(|&(node, _)| node)
}

/// Nodes at which modes are compared.
pub(crate) struct Points {
    /// Their indices in the mesh.
    pub nodes: Vec<usize>,
    /// Where they are, m.
    pub places: Vec<[f64; 3]>,
    tags: Vec<u64>,
}

impl Points {
    /// Some nodes of the mesh that a ring was added to.
    pub fn new(meshed: &MeshedRing, nodes: impl Iterator<Item = usize>) -> Self {
        let nodes: Vec<usize> = nodes.collect();
        let mesh = &meshed.mesh;
        Self {
            places: nodes.iter().map(|&node| mesh.nodes[node]).collect(),
            tags: nodes.iter().map(|&node| mesh.node_tags[node]).collect(),
            nodes,
        }
    }

    /// Displacements (x, y, z) at the nodes from those of all degrees of freedom.
    pub(crate) fn shapes(&self, moved: &DenseMatrix, dimension: usize) -> DenseMatrix {
        DenseMatrix::from_fn(3 * self.nodes.len(), moved.ncols(), |row, mode| match row % 3 < dimension {
            true => moved[(dimension * self.nodes[row / 3] + row % 3, mode)],
            false => 0.0,
        })
    }

    /// Modes with their shapes at the nodes.
    pub(crate) fn set(&self, modes: &FullModes, shapes: DenseMatrix) -> ModeSet {
        ModeSet {
            frequencies_hz: modes.basis.frequencies_hz.clone(),
            points: self.places.clone(),
            node_tags: Some(self.tags.clone()),
            shapes,
        }
    }
}

/// Displacements of points of a ring's rigid sections, in the mesh's axes [3 points x modes].
pub(crate) fn beam_shapes(ring: &Ring, frame: &RingFrame, modes: &DenseMatrix, points: &[[f64; 3]]) -> DenseMatrix {
    let mut shapes = DenseMatrix::zeros(3 * points.len(), modes.ncols());
    for (place, point) in points.iter().enumerate() {
        let [x, y, z] = frame.point(*point);
        let (arm, angle) = (x.hypot(y) - ring.section().radius, y.atan2(x));
        let axes = frame.polar_axes(*point);
        let (in_space, plane) = (ring.space_rows_at(angle), ring.rows_at(angle));
        for mode in 0..modes.ncols() {
            let d = modes.col_as_slice(mode);
            let polar = match &in_space {
                Some(rows) => rows.displacement_at(arm, z).map(|row| rows.apply(&row, d)),
                None => {
                    let tangential = plane.tangential_at(arm);
                    [plane.apply(&plane.radial, d), plane.apply(&tangential, d), 0.0]
                }
            };
            for axis in 0..3 {
                shapes[(3 * place + axis, mode)] = (0..3).map(|k| polar[k] * axes[k][axis]).sum();
            }
        }
    }
    shapes
}
