//! The modes of a housing, a ring, or both, without contact and in full: nothing condensed.

use super::full_modes::FullModes;
use super::mode_shapes::{OwnModes, RingShapes};
use super::{
    EnergyShares, MassProperties, Mechanisms, ModalBasis, ModalError, ModeRange, Participation, rigid_motions,
    ring_motions, strain_products,
};
use crate::fe::assembly::{CoupledMatrices, CoupledMotions, SystemMatrices};
use crate::fe::mesh::Mesh;
use crate::fe::model::{HousingModel, Ring, RingFrame, RingTie};
use crate::numerics::Watch;
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
    /// [`ModalError`] of eigenvalue computation and analysis.
    pub(crate) fn of_housing(
        mesh: &Mesh,
        model: &HousingModel,
        matrices: SystemMatrices,
        range: ModeRange,
        watch: &impl Watch,
    ) -> Result<Self, ModalError> {
        let mass = MassProperties::of_housing(&matrices, model)?;
        let rigid = rigid_motions(model.coordinates(), model.dimension(), centroid(&mass));
        let matrices = CoupledMatrices::of_housing(matrices, model);
        let products =
            |motions: &CoupledMotions, all: &DenseMatrix| strain_products(model, &motions.housing(model, all));
        let (modes, all, participation) = FullModes::analysed(matrices, range, &rigid, products, watch)?;
        watch.stage("analyse");
        let shapes = modes.motions().housing(model, &all);
        let groups = mesh.groups.iter();
        let groups = groups.filter(|group| group.dimension == model.dimension());
        let several = model.description.parts.len() > 1 || groups.count() > 1 || !model.spring_nodes().is_empty();
        let shares = several.then(|| EnergyShares::new(mesh, model, &shapes, modes.basis.rigid_modes)).transpose()?;
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
    pub(crate) fn own_modes<'a>(&'a self, housing: Option<(&'a Mesh, &'a HousingModel)>) -> OwnModes<'a> {
        OwnModes {
            frequencies_hz: &self.basis.frequencies_hz,
            housing: housing.zip(self.housing.as_ref()).map(|((mesh, model), shapes)| (mesh, model, shapes)),
            ring: self.ring.as_ref(),
        }
    }

    /// Modes of a housing and the ring in it, tied to its bore.
    ///
    /// # Errors
    /// [`ModalError`] of eigenvalue computation and analysis.
    pub(crate) fn of_coupled(
        (mesh, model, matrices): (&Mesh, &HousingModel, &SystemMatrices),
        tie: &RingTie,
        ring: &Ring,
        range: ModeRange,
        watch: &impl Watch,
    ) -> Result<Self, ModalError> {
        let frame = model.frame();
        let matrices = CoupledMatrices::new(matrices, tie, ring);
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
        let (modes, all, participation) = FullModes::analysed(matrices, range, &rigid, products, watch)?;
        watch.stage("analyse");
        let shapes = modes.motions().housing(model, &all);
        let of_ring = modes.motions().ring(&all);
        let rigid_modes = modes.basis.rigid_modes;
        let shares = EnergyShares::with_ring((mesh, model), ring, &shapes, &of_ring, rigid_modes)?;
        let mechanisms = unless_too_many_bodies(Mechanisms::find_with_ring(mesh, model, tie, ring))?;
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

    /// Modes of a ring alone.
    ///
    /// # Errors
    /// [`ModalError`] of eigenvalue computation and analysis.
    pub(crate) fn of_ring(ring: &Ring, range: ModeRange, watch: &impl Watch) -> Result<Self, ModalError> {
        let frame = RingFrame::default();
        let rigid = ring_motions(ring, &frame, [0.0; 3]);
        let matrices = CoupledMatrices::of_ring(ring);
        let inertia = rigid.transpose() * sparse_times_dense(&matrices.mass, &rigid);
        let mass = MassProperties::from_rigid_inertia(&inertia, [0.0; 3])?;
        let products = |_: &CoupledMotions, all: &DenseMatrix| {
            let strain = ring.strain_products(all);
            Ok(strain.beams + strain.springs)
        };
        let (modes, all, participation) = FullModes::analysed(matrices, range, &rigid, products, watch)?;
        let shares = (!ring.springs.is_empty())
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

/// A mesh in too many bodies is worth no error where only reasons were asked for.
pub(crate) fn unless_too_many_bodies(found: Result<Mechanisms, ModalError>) -> Result<Option<Mechanisms>, ModalError> {
    match found {
        Ok(found) => Ok(Some(found)),
        Err(ModalError::TooManyBodies { .. }) => Ok(None),
        Err(error) => Err(error),
    }
}
