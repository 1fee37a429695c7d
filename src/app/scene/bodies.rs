//! Housing and ring of a case with their matrices in full.

use super::housing::AssembledHousing;
use super::ring::ring_and_tie;
use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::fe::assembly::CoupledMatrices;
use crate::fe::mesh::Mesh;
use crate::fe::modal::{FullModes, ModeSet, OwnModes, RingShapes};
use crate::fe::model::{HousingModel, Ring, RingFrame, RingTie};
use crate::numerics::Watch;

/// Housing and ring of a case, of which one may be missing.
pub(crate) struct Bodies {
    pub housing: Option<(Mesh, HousingModel)>,
    pub ring: Option<Ring>,
    pub tie: Option<RingTie>,
}

impl Bodies {
    /// The bodies and the matrices of all together; those of the housing alone are gone.
    ///
    /// # Errors
    /// [`ComputeError`] of mesh, model, elements, ring and tie.
    pub(crate) fn assemble(case: &Case, watch: &impl Watch) -> Result<(Self, CoupledMatrices), ComputeError> {
        let Some(asked) = &case.ring else {
            let housing = AssembledHousing::of(case, watch)?;
            let matrices = CoupledMatrices::of_housing(housing.matrices, &housing.model);
            let bodies = Self { housing: Some((housing.mesh, housing.model)), ring: None, tie: None };
            return Ok((bodies, matrices));
        };
        let housing = AssembledHousing::build(case, watch)?;
        let (ring, tie) = ring_and_tie(case, asked, housing.as_ref())?;
        watch.stage("couple");
        let matrices = match (&housing, &tie) {
            (Some(housing), Some(tie)) => CoupledMatrices::new(&housing.matrices, tie, &ring),
            _ => CoupledMatrices::of_ring(&ring),
        };
        let bodies = Self { housing: housing.map(|housing| (housing.mesh, housing.model)), ring: Some(ring), tie };
        Ok((bodies, matrices))
    }

    /// Modes at the nodes of the mesh and of the ring.
    pub(crate) fn mode_set(&self, modes: &FullModes) -> ModeSet {
        let all = modes.over_all_rows();
        let housing = self.housing.as_ref();
        let moved = housing.map(|(_, model)| modes.motions().housing(model, &all));
        let of_ring = self.ring.as_ref().map(|ring| RingShapes::new(ring, &self.frame(), &modes.motions().ring(&all)));
        let with_shapes = housing.zip(moved.as_ref());
        let own = OwnModes {
            frequencies_hz: &modes.basis.frequencies_hz,
            housing: with_shapes.map(|((mesh, model), moved)| (mesh, model, moved)),
            ring: of_ring.as_ref(),
        };
        own.set()
    }

    /// Where the ring sits: in the mesh's axes, or in its own.
    pub(crate) fn frame(&self) -> RingFrame {
        let housing = self.housing.as_ref();
        housing.map_or_else(RingFrame::default, |(_, model)| *model.frame())
    }
}
