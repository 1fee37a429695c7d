//! The modes of a housing, of rings, or both, without contact and in full: nothing condensed.

use super::full_modes::{FullModes, Products};
use super::mode_shapes::{RingShapes, mode_set};
use super::{
    Bore, EnergyShares, MassProperties, Mechanisms, ModalBasis, ModalError, ModeRange, ModeSet, Participation,
    rigid_motions, ring_motions, strain_products,
};
use crate::fe::assembly::{CoupledMatrices, CoupledMotions, SystemMatrices};
use crate::fe::mesh::Mesh;
use crate::fe::model::{HousingModel, RingTie, Rings};
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
    /// How each ring moves.
    pub rings: Vec<RingShapes>,
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
            rings: Vec::new(),
        }
    }

    /// The modes at the nodes of the mesh and of the ring; `housing` is what they are of.
    pub(crate) fn mode_set(&self, housing: Option<(&Mesh, &HousingModel)>) -> ModeSet {
        let housing = housing.zip(self.housing.as_ref()).map(|((mesh, model), shapes)| (mesh, model, shapes));
        mode_set(&self.basis.frequencies_hz, housing, &self.rings)
    }

    /// Modes of a housing and the rings in it, tied to its bores.
    ///
    /// # Errors
    /// [`ModalError`] of eigenvalue computation and analysis.
    pub(crate) fn of_coupled(
        (mesh, model, matrices): (&Mesh, &HousingModel, &SystemMatrices),
        tie: &RingTie,
        rings: &Rings,
        range: ModeRange,
        watch: &impl Watch,
    ) -> Result<Self, ModalError> {
        let matrices = CoupledMatrices::new(matrices, tie, rings);
        let rigid_about = |about: [f64; 3]| {
            let of_housing = rigid_motions(model.coordinates(), model.dimension(), about);
            matrices.motions.coordinates(&of_housing, &ring_motions(rings, about))
        };
        let mass = MassProperties::about_centroid(&matrices.mass, model.frame().centre(), rigid_about)?;
        let rigid = rigid_about(centroid(&mass));
        let products = |motions: &CoupledMotions, all: &DenseMatrix| {
            let of_housing = strain_products(model, &motions.housing(model, all))?;
            Ok(with_strain_of(rings, &motions.rings(all), of_housing))
        };
        let (survey, motions, all) = Self::analysed(matrices, range, (mass, &rigid), &products, watch)?;
        watch.stage("analyse");
        let (shapes, of_rings) = (motions.housing(model, &all), motions.rings(&all));
        let (housing, rigid_modes) = (Some((mesh, model, &shapes)), survey.basis.rigid_modes);
        Ok(Self {
            shares: Some(EnergyShares::new(housing, Some((rings, &of_rings)), rigid_modes)?),
            mechanisms: Mechanisms::find_in(mesh, model, &Bore::Rings(tie, rings))?,
            housing: Some(shapes),
            rings: RingShapes::of_all(rings, &of_rings),
            ..survey
        })
    }

    /// Modes of rings alone.
    ///
    /// # Errors
    /// [`ModalError`] of eigenvalue computation and analysis.
    pub(crate) fn of_rings(rings: &Rings, range: ModeRange, watch: &impl Watch) -> Result<Self, ModalError> {
        let rigid = ring_motions(rings, [0.0; 3]);
        let matrices = CoupledMatrices::of_rings(rings);
        let inertia = rigid.transpose() * sparse_times_dense(&matrices.mass, &rigid);
        let mass = MassProperties::from_rigid_inertia(&inertia, [0.0; 3])?;
        let products = |_: &CoupledMotions, all: &DenseMatrix| {
            Ok(with_strain_of(rings, all, DenseMatrix::zeros(all.ncols(), all.ncols())))
        };
        let (survey, _, all) = Self::analysed(matrices, range, (mass, &rigid), &products, watch)?;
        let of_rings = || EnergyShares::new(None, Some((rings, &all)), survey.basis.rigid_modes);
        let springs = rings.seats().iter().any(|seat| !seat.ring.springs.is_empty());
        Ok(Self {
            shares: springs.then(of_rings).transpose()?,
            mechanisms: Some(Mechanisms::of_rings(rings)),
            rings: RingShapes::of_all(rings, &all),
            ..survey
        })
    }
}

/// Adds the strain energies of all rings, `phi^T K phi` of modes over their coordinates, to those of the rest [modes x modes].
fn with_strain_of(rings: &Rings, shapes: &DenseMatrix, rest: DenseMatrix) -> DenseMatrix {
    rings.seats().iter().fold(rest, |sum, seat| {
        let own = seat.ring.strain_products(&shapes.subrows(seat.first, seat.ring.dof()).to_owned());
        sum + own.beams + own.springs
    })
}

fn centroid(mass: &MassProperties) -> [f64; 3] {
    mass.centroid().map(|component| component.unwrap_or(0.0))
}
