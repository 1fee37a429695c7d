//! The modes of a case's housing, ring, or both, without contact and in full: nothing condensed.

use super::housing::AssembledHousing;
use super::loose::unless_too_many_bodies;
use super::modal_system::FullModes;
use super::mode_set::{OwnModes, RingShapes};
use super::structure::CoupledStructure;
use super::watch::{Unwatched, Watch};
use crate::app::error::ComputeError;
use crate::fe::assembly::{CoupledMatrices, CoupledMotions, SystemMatrices};
use crate::fe::mesh::Mesh;
use crate::fe::modal::ModeRange;
use crate::fe::modal::{
    EnergyShares, MassProperties, Mechanisms, ModalBasis, Participation, rigid_motions,
    ring_motions, strain_products,
};
use crate::fe::model::{HousingModel, Ring, RingFrame, RingTie};
use crate::numerics::linalg::{DenseMatrix, sparse_times_dense};

/// Modes and all that is said of them.
#[derive(Debug, Clone)]
pub struct ModalSurvey {
    /// Degrees of freedom of ring and housing, fixed and tied ones included.
    pub dof: usize,
    /// Degrees of freedom that the modes were computed over.
    pub free_dof: usize,
    /// The modes with their proof.
    pub basis: ModalBasis,
    /// Mass, centroid and inertia, in the mesh's axes (of a ring alone: in its own); `None` for a superelement from a
    /// file, whose interface does not tell them.
    pub mass: Option<MassProperties>,
    /// Participation factors and effective masses, rotations about the centroid; `None` where there is no mass.
    pub participation: Option<Participation>,
    /// Where the energy of each mode is; `None` if there is only one place for it: one part, which is the only group
    /// too, or a ring, without springs.
    pub shares: Option<EnergyShares>,
    /// Why modes without strain exist; `None` if the housing falls into too many bodies.
    pub mechanisms: Option<Mechanisms>,
    /// Displacements of the housing's degrees of freedom in the mesh's axes [dof x count].
    pub housing: Option<DenseMatrix>,
    /// How the ring moves.
    pub ring: Option<RingShapes>,
}

impl ModalSurvey {
    /// Modes of a housing alone; its matrices are used up.
    ///
    /// # Errors
    /// [`ComputeError`] of eigenvalue computation and analysis.
    pub fn of_housing(
        mesh: &Mesh,
        model: &HousingModel,
        matrices: SystemMatrices,
        extent: ModeRange,
        watch: &impl Watch,
    ) -> Result<Self, ComputeError> {
        let mass = MassProperties::of_housing(&matrices, model)?;
        let rigid = rigid_motions(model.coordinates(), model.dimension(), centroid(&mass));
        let matrices = CoupledMatrices::of_housing(matrices, model);
        let products = |motions: &CoupledMotions, all: &DenseMatrix| {
            Ok(strain_products(model, &motions.housing(model, all))?)
        };
        let (modes, all, participation) =
            FullModes::analysed(matrices, extent, &rigid, products, watch)?;
        watch.stage("analyse");
        let shapes = modes.motions.housing(model, &all);
        let groups = mesh.groups.iter();
        let groups = groups.filter(|group| group.dimension == model.dimension());
        let several =
            model.part_names().len() > 1 || groups.count() > 1 || !model.spring_nodes().is_empty();
        let shares = several
            .then(|| EnergyShares::new(mesh, model, &shapes, modes.basis.rigid_modes))
            .transpose()?;
        let mechanisms = unless_too_many_bodies(Mechanisms::find(mesh, model))?;
        Ok(Self {
            dof: model.dof(),
            free_dof: modes.free_dof(),
            basis: modes.basis,
            mass: Some(mass),
            participation: Some(participation),
            shares,
            mechanisms,
            housing: Some(shapes),
            ring: None,
        })
    }

    /// The modes at the nodes of the mesh and of the ring; `housing` is what they are of.
    pub(crate) fn own_modes<'a>(
        &'a self,
        housing: Option<(&'a Mesh, &'a HousingModel)>,
    ) -> OwnModes<'a> {
        OwnModes {
            frequencies_hz: &self.basis.frequencies_hz,
            housing: housing
                .zip(self.housing.as_ref())
                .map(|((mesh, model), shapes)| (mesh, model, shapes)),
            ring: self.ring.as_ref(),
        }
    }

    /// Modes of a ring, in a housing if the case has one.
    ///
    /// # Errors
    /// [`ComputeError`] of eigenvalue computation and analysis.
    pub fn of_structure(
        stage: &CoupledStructure,
        extent: ModeRange,
        watch: &impl Watch,
    ) -> Result<Self, ComputeError> {
        let ring = stage.structure.ring();
        match (&stage.housing, &stage.tie) {
            (Some(housing), Some(tie)) => Self::of_coupled(housing, tie, ring, extent, watch),
            _ if stage.imported.is_some() => Self::of_imported(stage, extent, watch),
            _ => Self::of_ring(ring, extent, watch),
        }
    }

    /// Of a superelement from a file there are frequencies, their proof and the ring's motion.
    fn of_imported(
        stage: &CoupledStructure,
        extent: ModeRange,
        watch: &impl Watch,
    ) -> Result<Self, ComputeError> {
        let ring = stage.structure.ring();
        let modes = FullModes::of(matrices_of(stage), extent, watch)?;
        let of_ring = modes.motions.ring(&modes.over_all_rows());
        Ok(Self {
            dof: stage.structure.dof(),
            free_dof: modes.free_dof(),
            basis: modes.basis,
            mass: None,
            participation: None,
            shares: None,
            mechanisms: None,
            housing: None,
            ring: Some(RingShapes::new(ring, &stage.frame(), &of_ring)),
        })
    }

    fn of_coupled(
        housing: &AssembledHousing,
        tie: &RingTie,
        ring: &Ring,
        extent: ModeRange,
        watch: &impl Watch,
    ) -> Result<Self, ComputeError> {
        let AssembledHousing { mesh, model, .. } = housing;
        let frame = model.frame();
        let matrices = CoupledMatrices::new(&housing.matrices, tie, ring);
        let rigid_about = |about: [f64; 3]| {
            let of_housing = rigid_motions(model.coordinates(), model.dimension(), about);
            let of_ring = ring_motions(ring, frame, about);
            matrices.motions.coordinates(&of_housing, &of_ring)
        };
        let inertia = |about: [f64; 3]| {
            let rigid = rigid_about(about);
            let inertia = rigid.transpose() * sparse_times_dense(&matrices.mass, &rigid);
            MassProperties::from_rigid_inertia(&inertia, about)
        };
        // a second time about the centroid itself, where nothing is left to subtract
        let mass = inertia(centroid(&inertia(frame.centre())?))?;
        let rigid = rigid_about(centroid(&mass));
        let products = |motions: &CoupledMotions, all: &DenseMatrix| {
            let of_ring = ring.strain_products(&motions.ring(all));
            let of_housing = strain_products(model, &motions.housing(model, all))?;
            Ok(of_housing + of_ring.beams + of_ring.springs)
        };
        let (modes, all, participation) =
            FullModes::analysed(matrices, extent, &rigid, products, watch)?;
        watch.stage("analyse");
        let shapes = modes.motions.housing(model, &all);
        let of_ring = modes.motions.ring(&all);
        let rigid_modes = modes.basis.rigid_modes;
        let shares = EnergyShares::with_ring((mesh, model), ring, &shapes, &of_ring, rigid_modes)?;
        let mechanisms =
            unless_too_many_bodies(Mechanisms::find_with_ring(mesh, model, tie, ring))?;
        Ok(Self {
            dof: model.dof() + ring.dof(),
            free_dof: modes.free_dof(),
            basis: modes.basis,
            mass: Some(mass),
            participation: Some(participation),
            shares: Some(shares),
            mechanisms,
            housing: Some(shapes),
            ring: Some(RingShapes::new(ring, frame, &of_ring)),
        })
    }

    fn of_ring(ring: &Ring, extent: ModeRange, watch: &impl Watch) -> Result<Self, ComputeError> {
        let frame = RingFrame::default();
        let rigid = ring_motions(ring, &frame, [0.0; 3]);
        let matrices = CoupledMatrices::of_ring(ring);
        let inertia = rigid.transpose() * sparse_times_dense(&matrices.mass, &rigid);
        let mass = MassProperties::from_rigid_inertia(&inertia, [0.0; 3])?;
        let products = |_: &CoupledMotions, all: &DenseMatrix| {
            let strain = ring.strain_products(all);
            Ok(strain.beams + strain.springs)
        };
        let (modes, all, participation) =
            FullModes::analysed(matrices, extent, &rigid, products, watch)?;
        let shares = ring
            .has_springs()
            .then(|| EnergyShares::of_ring(ring, &all, modes.basis.rigid_modes))
            .transpose()?;
        Ok(Self {
            dof: ring.dof(),
            free_dof: modes.free_dof(),
            basis: modes.basis,
            mass: Some(mass),
            participation: Some(participation),
            shares,
            mechanisms: Some(Mechanisms::of_ring(ring)),
            housing: None,
            ring: Some(RingShapes::new(ring, &frame, &all)),
        })
    }
}

fn centroid(mass: &MassProperties) -> [f64; 3] {
    mass.centroid().map(|component| component.unwrap_or(0.0))
}

/// Frequencies of a ring, in a housing if the case has one, in full: nothing condensed, nothing analysed.
///
/// # Errors
/// [`ComputeError`] of eigenvalue computation.
pub(crate) fn unloaded_modes(
    stage: &CoupledStructure,
    extent: ModeRange,
) -> Result<UnloadedModes, ComputeError> {
    let basis = FullModes::of(matrices_of(stage), extent, &Unwatched)?.basis;
    Ok(UnloadedModes {
        frequencies_hz: basis.frequencies_hz,
        rigid: basis.rigid_modes,
    })
}

/// Matrices of a ring, in a housing if the case has one: in full, or as a superelement has them.
pub(crate) fn matrices_of(stage: &CoupledStructure) -> CoupledMatrices {
    let structure = &stage.structure;
    let ring = structure.ring();
    match (&stage.housing, &stage.tie) {
        (Some(housing), Some(tie)) => CoupledMatrices::new(&housing.matrices, tie, ring),
        _ if stage.imported.is_some() => {
            CoupledMatrices::of_condensed(structure.stiffness(), structure.mass(), ring.dof())
        }
        _ => CoupledMatrices::of_ring(ring),
    }
}

/// Frequencies of a model in full.
pub(crate) struct UnloadedModes {
    /// Ascending, Hz.
    pub frequencies_hz: Vec<f64>,
    /// How many of the first ones are rigid.
    pub rigid: usize,
}
