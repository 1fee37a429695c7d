//! Nodes that MBDyn can connect to, and how they move.

use std::collections::HashSet;

use super::super::SuperelementRecord;
use crate::formats::{DofBody, DofDirection, DofLabel};

/// A node and its six motions.
pub(super) struct Node {
    /// Without blanks.
    pub(super) name: String,
    /// m, mesh axes.
    pub(super) position: [f64; 3],
    /// Displacements along x, y, z and rotations about them, each a row over the superelement's coordinates.
    pub(super) motions: [Motion; 6],
}

/// Coordinates that move a node and how much; others do not.
pub(super) type Motion = Vec<(usize, f64)>;

/// Axes whose products differ from those of right angles by more are not three displacements of one node.
const RIGHT_ANGLE: f64 = 1e-6;

/// Nodes of the interface whose displacements are all known, then those of the field.
pub(super) fn nodes(record: &SuperelementRecord) -> Vec<Node> {
    let (mut nodes, mut seen, mut housing) = (Vec::new(), HashSet::new(), HashSet::new());
    for label in &record.interface {
        if !seen.insert((label.body, label.node)) {
            continue;
        }
        if let Some(node) = interface_node(record, label) {
            if label.body == DofBody::Housing {
                housing.insert(label.node);
            }
            nodes.push(node);
        }
    }
    if let Some(field) = &record.field {
        let of_field = field.node_tags.iter().zip(&field.positions).enumerate();
        for (place, (tag, &position)) in of_field.filter(|(_, (tag, _))| !housing.contains(tag)) {
            let row = |axis: usize| field.recovery.row(3 * place + axis).iter().copied().enumerate().collect();
            let motions = [row(0), row(1), row(2), Vec::new(), Vec::new(), Vec::new()];
            nodes.push(Node { name: tag.to_string(), position, motions });
        }
    }
    nodes
}

/// The node of an interface coordinate.
fn interface_node(record: &SuperelementRecord, of: &DofLabel) -> Option<Node> {
    let own = record.interface.iter().enumerate();
    let own = own.filter(|(_, label)| (label.body, label.node) == (of.body, of.node));
    let mut motions: [Motion; 6] = Default::default();
    let mut axes = Vec::new();
    for (coordinate, label) in own {
        let first = match label.direction {
            DofDirection::Along(_) | DofDirection::Polar(_) => {
                axes.push(label.axis);
                0
            }
            DofDirection::About(_) => 3,
            DofDirection::Generalised => return None,
        };
        if !label.axis.iter().all(|part| part.is_finite()) {
            return None;
        }
        for (axis, &part) in label.axis.iter().enumerate() {
            if part != 0.0 {
                motions[first + axis].push((coordinate, part));
            }
        }
    }
    let known = of.position.iter().all(|part| part.is_finite());
    if !known || axes.len() != 3 || !at_right_angles(&axes) {
        return None;
    }
    let name = match of.body {
        DofBody::Housing => of.node.to_string(),
        body => format!("{}{}", body.name(), of.node),
    };
    Some(Node { name, position: of.position, motions })
}

fn at_right_angles(axes: &[[f64; 3]]) -> bool {
    let product = |a: &[f64; 3], b: &[f64; 3]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let mut pairs = (0..axes.len()).flat_map(|i| (0..=i).map(move |j| (i, j)));
    pairs.all(|(i, j)| (product(&axes[i], &axes[j]) - if i == j { 1.0 } else { 0.0 }).abs() <= RIGHT_ANGLE)
}
