//! How much of a group's stiffness or mass each of its nodes carries.

use super::ModelError;
use crate::element::plane::{EdgeKind, edge_weights};
use crate::mesh::{ElementKind, Mesh, PhysicalGroup};

/// Nodes of a group that the housing uses, with their shares; the shares add up to 1.
///
/// Points share equally. Curves share by length with the consistent weights of their edges
/// (integral of the shape functions). Surfaces share equally: plane housings have no load on faces.
///
/// # Errors
/// [`ModelError::Element`] for an edge without length.
pub(super) fn shares(
    mesh: &Mesh,
    group: &PhysicalGroup,
    used: &[bool],
) -> Result<Vec<(usize, f64)>, ModelError> {
    if group.dimension != 1 {
        let nodes: Vec<usize> = group.nodes.iter().copied().filter(|&n| used[n]).collect();
        let share = 1.0 / nodes.len() as f64;
        return Ok(nodes.into_iter().map(|node| (node, share)).collect());
    }
    let mut weights = vec![0.0; mesh.nodes.len()];
    for element in &group.elements {
        let block = &mesh.blocks[element.block];
        let kind = match block.kind {
            ElementKind::Line2 => EdgeKind::Line2,
            ElementKind::Line3 => EdgeKind::Line3,
            _ => continue,
        };
        let Some(nodes) = block.element(element.index) else {
            continue;
        };
        let coordinates: Vec<[f64; 2]> = nodes
            .iter()
            .map(|&node| [mesh.nodes[node][0], mesh.nodes[node][1]])
            .collect();
        let edge = edge_weights(kind, &coordinates).map_err(|source| ModelError::Element {
            path: mesh.source.display().to_string(),
            tag: block.tags[element.index],
            source,
        })?;
        for (&node, weight) in nodes.iter().zip(edge) {
            if used[node] {
                weights[node] += weight;
            }
        }
    }
    let total: f64 = weights.iter().sum();
    Ok(group
        .nodes
        .iter()
        .filter(|&&node| used[node])
        .map(|&node| (node, weights[node] / total))
        .collect())
}
