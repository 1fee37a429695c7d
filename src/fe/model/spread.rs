//! Stiffness and mass that a group shares, spread over its elements.
//!
//! What is spread evenly over a surface S acts through `int N_a N_b dS / S`: symmetric, positive, the same for
//! every mesh. (Lumping it by `int N_a dS` would give the corners of Quad8 a negative share.)

use super::ModelError;
use super::support::sorted;
use crate::fe::element::continuum::{measure_matrix, surface_matrix};
use crate::fe::mesh::{ElementKind, Mesh, PhysicalGroup};
use nalgebra::DMatrix;
use std::collections::BTreeSet;

/// Nodes with the symmetric matrix of shares between them [nodes x nodes]; the entries of all blocks of a
/// group add up to 1.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Share {
    pub nodes: Vec<usize>,
    pub matrix: DMatrix<f64>,
}

/// Shares of the nodes and elements of a group that the housing uses.
///
/// # Errors
/// [`ModelError::Refused`] for an element without length, area or volume, [`ModelError::Refused`] if no whole
/// element lies on the housing.
pub(super) fn shares(
    mesh: &Mesh,
    group: &PhysicalGroup,
    used: &[bool],
    purpose: &'static str,
) -> Result<Vec<Share>, ModelError> {
    let elements = group.elements.iter().map(|id| {
        let block = &mesh.blocks[id.block];
        (block.kind, block.nodes_of(id.index), block.tags[id.index])
    });
    let on_housing = elements.filter(|(_, nodes, _)| nodes.iter().all(|&node| used[node]));
    let (shares, _) = spread(mesh, on_housing)?;
    match shares.is_empty() {
        false => Ok(shares),
        true => Err(not_on_housing(&mesh.source.display().to_string(), &group.name, purpose)),
    }
}

/// Shares of elements given by kind, nodes and tag, and their length, area or volume together; points share equally
/// and have none. What is listed twice counts once, a triangle in a quadrilateral not at all.
///
/// # Errors
/// [`ModelError::Refused`] for an element without length, area or volume.
pub(super) fn spread<'a>(
    mesh: &Mesh,
    elements: impl Iterator<Item = (ElementKind, &'a [usize], u64)>,
) -> Result<(Vec<Share>, f64), ModelError> {
    let mut found = Vec::new();
    let mut total = 0.0;
    let elements: Vec<_> = elements.collect();
    // a triangle on three corners of a quadrilateral of the group lies in it
    let quads = elements.iter().filter(|(kind, ..)| kind.dimension() == 2 && kind.corners() == 4);
    let mut seen: BTreeSet<Vec<usize>> = quads
        .flat_map(|(_, nodes, _)| (0..4).map(|left_out| sorted(&[1, 2, 3].map(|k| nodes[(left_out + k) % 4]))))
        .collect();
    for (kind, nodes, tag) in elements {
        if !seen.insert(sorted(&nodes[..kind.corners()])) {
            continue; // a group is a set
        }
        let coordinates: Vec<[f64; 3]> = nodes.iter().map(|&node| mesh.nodes[node]).collect();
        let matrix = match kind.dimension() {
            0 => Ok(DMatrix::from_element(1, 1, 1.0)),
            3 => measure_matrix(kind, &coordinates),
            _ => surface_matrix(kind, &coordinates),
        };
        let matrix = matrix.map_err(|source| ModelError::element(&mesh.source.display().to_string(), tag, &source))?;
        total += matrix.sum();
        found.push(Share { nodes: nodes.to_vec(), matrix });
    }
    for share in &mut found {
        share.matrix /= total;
    }
    Ok((found, total))
}

/// A group of which nothing, or no whole element, is on the housing.
pub(super) fn not_on_housing(path: &str, group: &str, purpose: &str) -> ModelError {
    ModelError::Refused(format!(
        "group \"{group}\" in {path}: no part of it belongs to an element of the housing, so {purpose} would hang on nothing"
    ))
}

impl Share {
    /// A node that carries everything by itself.
    pub(super) fn of_node(node: usize) -> Self {
        Self { nodes: vec![node], matrix: DMatrix::from_element(1, 1, 1.0) }
    }
}
