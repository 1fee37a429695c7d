//! The bore that a ring is tied to, along the ring's axis.

use crate::app::case;
use crate::app::error::ComputeError;
use crate::fe::mesh::Mesh;
use crate::fe::model::HousingModel;
use std::f64::consts::TAU;

/// The bore in the ring's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Seat {
    /// Number of its nodes.
    pub nodes: usize,
    /// First place along the axis, m.
    pub from: f64,
    /// Last place along the axis, m.
    pub to: f64,
    /// Largest angle round the axis without a node of the bore, radians.
    pub free_turn: f64,
}

impl Seat {
    /// The bore of a tie.
    ///
    /// # Errors
    /// [`ComputeError::Model`] if the mesh lacks it.
    pub(crate) fn of(mesh: &Mesh, model: &HousingModel, tie: &case::Tie) -> Result<Self, ComputeError> {
        let group = model.group_on_housing(mesh, &tie.group, "the tie")?;
        let nodes = group.nodes.iter().filter(|&&node| model.is_used(node));
        let places: Vec<[f64; 3]> = nodes.map(|&node| model.ring_coordinates(node)).collect();
        let along: Vec<f64> = places.iter().map(|place| place[2]).collect();
        let mut angles: Vec<f64> = places.iter().map(|[x, y, _]| y.atan2(*x)).collect();
        angles.sort_unstable_by(f64::total_cmp);
        let next = angles.iter().skip(1).copied();
        let next = next.chain(angles.first().map(|first| first + TAU));
        let gaps = angles.iter().zip(next).map(|(angle, next)| next - angle);
        Ok(Self {
            free_turn: gaps.fold(0.0, f64::max),
            nodes: along.len(),
            from: along.iter().copied().fold(f64::INFINITY, f64::min),
            to: along.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        })
    }

    /// Share, 0 to 1, of a ring of this width (m) about the ring's plane that lies beyond the bore's ends.
    pub(crate) fn share_outside(&self, width: f64) -> f64 {
        let half = 0.5 * width;
        let inside = self.to.min(half) - self.from.max(-half);
        1.0 - inside.max(0.0) / width
    }
}
