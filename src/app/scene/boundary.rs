//! What a housing is attached by when it is condensed.

use super::housing::AssembledHousing;
use crate::fe::assembly::SystemMatrices;
use crate::fe::model::{HousingPartition, NodeInterface, Ring, RingTie};
use crate::fe::reduction::Attached;
use std::borrow::Cow;

/// What a housing is attached by.
#[derive(Debug, Clone)]
pub enum Boundary {
    /// A ring through its tie.
    Ring(Box<(Ring, RingTie)>),
    /// Nodes of the mesh themselves.
    Nodes(NodeInterface),
}

impl Boundary {
    /// How the housing's degrees of freedom are split.
    pub(crate) fn partition(&self) -> &HousingPartition {
        match self {
            Self::Ring(bodies) => bodies.1.partition(),
            Self::Nodes(nodes) => &nodes.partition,
        }
    }

    pub(crate) fn matrices<'h>(&self, housing: &'h AssembledHousing) -> Cow<'h, SystemMatrices> {
        match self.ring() {
            Some((_, tie)) if tie.rotation().is_some() => Cow::Owned(housing.matrices.clone().for_tie(tie)),
            _ => Cow::Borrowed(&housing.matrices),
        }
    }

    /// What sits on the interface.
    pub fn attached(&self) -> Option<Attached<'_>> {
        match self {
            Self::Ring(bodies) => Some(Attached { stiffness: bodies.0.stiffness(), mass: bodies.0.mass() }),
            Self::Nodes(_) => None,
        }
    }

    /// Ring and tie, if that is what it is.
    pub(crate) fn ring(&self) -> Option<(&Ring, &RingTie)> {
        match self {
            Self::Ring(bodies) => Some((&bodies.0, &bodies.1)),
            Self::Nodes(_) => None,
        }
    }
}
