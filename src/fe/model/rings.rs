//! Rings at their places: one alone, or those in the bores of one housing.

use super::{Ring, RingFrame};
use crate::numerics::linalg::DenseMatrix;
use std::ops::Range;

/// A ring and where it sits.
#[derive(Debug, Clone)]
pub struct RingSeat {
    /// What results call its bearing; empty for the only one of a case.
    pub label: String,
    /// The ring, in its own frame.
    pub ring: Ring,
    /// Where that frame is in the mesh's axes.
    pub frame: RingFrame,
    /// Its first coordinate among those of all rings.
    pub(crate) first: usize,
}

impl RingSeat {
    /// Its coordinates among those of all rings.
    pub(crate) fn range(&self) -> Range<usize> {
        self.first..self.first + self.ring.dof()
    }

    /// As sentences call it: "the ring", or "the ring of bearing A".
    pub(crate) fn name(&self) -> String {
        if self.label.is_empty() { "the ring".to_owned() } else { format!("the ring of bearing {}", self.label) }
    }
}

/// One or more rings. Their coordinates stand one ring after the other; no two share stiffness or mass.
#[derive(Debug, Clone)]
pub struct Rings {
    seats: Vec<RingSeat>,
    /// Stiffness and mass of all; `None` of a single ring, which has its own.
    joint: Option<[DenseMatrix; 2]>,
}

impl From<Ring> for Rings {
    /// The only ring of a case, in the mesh's own frame.
    fn from(ring: Ring) -> Self {
        Self::one(ring, RingFrame::default())
    }
}

impl Rings {
    /// The only ring of a case.
    pub fn one(ring: Ring, frame: RingFrame) -> Self {
        Self { seats: vec![RingSeat { label: String::new(), ring, frame, first: 0 }], joint: None }
    }

    /// Rings with the labels of their bearings; `None` without any.
    pub fn new(rings: Vec<(String, Ring, RingFrame)>) -> Option<Self> {
        let mut dof = 0;
        let place = |(label, ring, frame): (String, Ring, RingFrame)| {
            let first = dof;
            dof += ring.dof();
            RingSeat { label, ring, frame, first }
        };
        let seats: Vec<RingSeat> = rings.into_iter().map(place).collect();
        let block = |of: fn(&Ring) -> &DenseMatrix| {
            let mut whole = DenseMatrix::zeros(dof, dof);
            for seat in &seats {
                let own = of(&seat.ring);
                whole.submatrix_mut(seat.first, seat.first, own.nrows(), own.ncols()).copy_from(own);
            }
            whole
        };
        let joint = (seats.len() > 1).then(|| [block(Ring::stiffness), block(Ring::mass)]);
        (!seats.is_empty()).then_some(Self { seats, joint })
    }

    /// The rings in their order; at least one.
    pub fn seats(&self) -> &[RingSeat] {
        &self.seats
    }

    /// The first ring, or the only one.
    pub fn first(&self) -> &RingSeat {
        &self.seats[0]
    }

    /// Number of coordinates of all rings.
    pub fn dof(&self) -> usize {
        self.stiffness().nrows()
    }

    /// Stiffness of all rings with their supports [dof x dof].
    pub fn stiffness(&self) -> &DenseMatrix {
        self.joint.as_ref().map_or_else(|| self.first().ring.stiffness(), |[stiffness, _]| stiffness)
    }

    /// Consistent mass of all rings [dof x dof].
    pub fn mass(&self) -> &DenseMatrix {
        self.joint.as_ref().map_or_else(|| self.first().ring.mass(), |[_, mass]| mass)
    }

    /// Whether the rings have displacements out of their planes.
    pub(crate) fn are_in_space(&self) -> bool {
        self.first().ring.is_in_space()
    }
}
