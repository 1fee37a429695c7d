//! The bore that a ring is tied to, along the ring's axis.

use super::StageError;
use crate::case;
use crate::mesh::Mesh;
use crate::model::HousingModel;

/// The bore in the ring's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Seat {
    /// Number of its nodes.
    pub nodes: usize,
    /// First place along the axis, m.
    pub from: f64,
    /// Last place along the axis, m.
    pub to: f64,
}

impl Seat {
    /// The bore of a tie.
    ///
    /// # Errors
    /// [`StageError::Model`] if the mesh lacks it.
    pub fn of(mesh: &Mesh, model: &HousingModel, tie: &case::Tie) -> Result<Self, StageError> {
        let group = model.group_on_housing(mesh, &tie.group, "the tie")?;
        let nodes = group.nodes.iter().filter(|&&node| model.is_used(node));
        let along: Vec<f64> = nodes.map(|&node| model.ring_coordinates(node)[2]).collect();
        Ok(Self {
            nodes: along.len(),
            from: along.iter().copied().fold(f64::INFINITY, f64::min),
            to: along.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        })
    }

    /// Share, 0 to 1, of a ring of this width (m) about the ring's plane that lies beyond the bore's ends.
    pub fn share_outside(&self, width: f64) -> f64 {
        let half = 0.5 * width;
        let inside = self.to.min(half) - self.from.max(-half);
        1.0 - inside.max(0.0) / width
    }
}
