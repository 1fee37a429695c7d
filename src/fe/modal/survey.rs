//! The modes of a housing, a ring, or both, without contact and in full: nothing condensed.

use super::full_modes::{FullModes, Products};
use super::mode_shapes::{RingShapes, mode_set};
use super::{
    Bore, EnergyShares, MassProperties, Mechanisms, ModalBasis, ModalError, ModeRange, ModeSet, Participation,
    rigid_motions, ring_motions, strain_products,
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
        let (survey, motions, all) = Self::analysed(matrices, range, (mass, &rigid), &products, watch)?;
        watch.stage("analyse");
        let shapes = motions.housing(model, &all);
        let groups = mesh.groups.iter();
        let groups = groups.filter(|group| group.dimension == model.dimension());
        let several = model.description.parts.len() > 1 || groups.count() > 1 || !model.spring_nodes().is_empty();
        let shares = several.then(|| EnergyShares::new(Some((mesh, model, &shapes)), None, survey.basis.rigid_modes));
        Ok(Self {
            shares: shares.transpose()?,
            mechanisms: Mechanisms::find_in(mesh, model, &Bore::Empty)?,
            housing: Some(shapes),
            ..survey
        })
    }

    /// Modes with their participation in the unit motions `rigid` about the centroid, what the coordinates mean, and the
    /// shapes over all rows.
    fn analysed(
        matrices: CoupledMatrices,
        range: ModeRange,
        (mass, rigid): (MassProperties, &DenseMatrix),
        products: Products<'_>,
        watch: &impl Watch,
    ) -> Result<(Self, CoupledMotions, DenseMatrix), ModalError> {
        let moved = sparse_times_dense(&matrices.mass, rigid);
        let modes = FullModes::of(matrices, range, Some(products), watch)?;
        let all = modes.over_all_rows();
        let participation = Participation::of_normalised(&moved, &all, rigid)?;
        let survey = Self {
            mass: Some(mass),
            participation: Some(participation),
            ..Self::without_mass(all.nrows(), modes.free_dof(), modes.basis)
        };
        Ok((survey, modes.motions, all))
    }

    /// The modes alone.
    pub(crate) fn without_mass(dof: usize, free_dof: usize, basis: ModalBasis) -> Self {
        Self {
            dof,
            free_dof,
            basis,
            mass: None,
            participation: None,
            shares: None,
            mechanisms: None,
            housing: None,
            ring: None,
        }
    }

    /// The modes at the nodes of the mesh and of the ring; `housing` is what they are of.
    pub(crate) fn mode_set(&self, housing: Option<(&Mesh, &HousingModel)>) -> ModeSet {
        let housing = housing.zip(self.housing.as_ref()).map(|((mesh, model), shapes)| (mesh, model, shapes));
        mode_set(&self.basis.frequencies_hz, housing, self.ring.as_ref())
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
        let mass = MassProperties::about_centroid(&matrices.mass, frame.centre(), rigid_about)?;
        let rigid = rigid_about(centroid(&mass));
        let products = |motions: &CoupledMotions, all: &DenseMatrix| {
            let of_ring = ring.strain_products(&motions.ring(all));
            let of_housing = strain_products(model, &motions.housing(model, all))?;
            Ok(of_housing + of_ring.beams + of_ring.springs)
        };
        let (survey, motions, all) = Self::analysed(matrices, range, (mass, &rigid), &products, watch)?;
        watch.stage("analyse");
        let (shapes, of_ring) = (motions.housing(model, &all), motions.ring(&all));
        let (housing, rigid_modes) = (Some((mesh, model, &shapes)), survey.basis.rigid_modes);
        Ok(Self {
            shares: Some(EnergyShares::new(housing, Some((ring, &of_ring)), rigid_modes)?),
            mechanisms: Mechanisms::find_in(mesh, model, &Bore::Ring(tie, ring))?,
            housing: Some(shapes),
            ring: Some(RingShapes::new(ring, frame, &of_ring)),
            ..survey
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
        let (survey, _, all) = Self::analysed(matrices, range, (mass, &rigid), &products, watch)?;
        let of_ring = || EnergyShares::new(None, Some((ring, &all)), survey.basis.rigid_modes);
        Ok(Self {
            shares: (!ring.springs.is_empty()).then(of_ring).transpose()?,
            mechanisms: Some(Mechanisms::of_ring(ring)),
            ring: Some(RingShapes::new(ring, &frame, &all)),
            ..survey
        })
    }
}

fn centroid(mass: &MassProperties) -> [f64; 3] {
    mass.centroid().map(|component| component.unwrap_or(0.0))
}
