//! Mesh to matrices of a housing, as the case asks for them.

use super::mesh_digest::read_mesh;
use crate::app::case::{self, Case, Hold, IsotropicMaterial, Rule};
use crate::app::error::ComputeError;
use crate::fe::assembly::SystemMatrices;
use crate::fe::material::{ElasticMaterial, Material, MaterialError, OrthotropicMaterial};
use crate::fe::mesh::Mesh;
use crate::fe::model::{
    Constraint, HousingDescription, HousingModel, HousingPart, HousingSupport, RingFrame, SupportShare,
};
use crate::numerics::Watch;

/// A housing, assembled.
#[derive(Debug, Clone)]
pub struct AssembledHousing {
    /// The mesh.
    pub mesh: Mesh,
    /// The mesh with properties and supports.
    pub model: HousingModel,
    /// Stiffness and mass over all its degrees of freedom.
    pub matrices: SystemMatrices,
}

impl AssembledHousing {
    /// Reads and assembles the case's housing; `None` without one.
    ///
    /// # Errors
    /// [`ComputeError`] of mesh, model and elements.
    pub fn build(case: &Case, watch: &impl Watch) -> Result<Option<Self>, ComputeError> {
        let Some(housing) = case.meshed_housing() else {
            return Ok(None);
        };
        watch.stage("read");
        let mesh = read_mesh(housing, watch)?;
        let groups: Vec<String> = mesh.groups.iter().map(|group| group.name.clone()).collect();
        case.check_groups(&groups)?;
        watch.stage("assemble");
        let model = HousingModel::new(&mesh, description(case, housing)?)?;
        let matrices = SystemMatrices::assemble(&model)?;
        Ok(Some(Self { mesh, model, matrices }))
    }
}

impl AssembledHousing {
    /// The housing of a case without a ring.
    ///
    /// # Errors
    /// As [`AssembledHousing::build`].
    pub(crate) fn of(case: &Case, watch: &impl Watch) -> Result<Self, ComputeError> {
        let nothing = || case.broken(Rule::nothing_to_model().at("housing"));
        Self::build(case, watch)?.ok_or_else(|| nothing().into())
    }
}

/// Everything that the case says of its housing.
///
/// # Errors
/// [`ComputeError`] of materials and of the tie's frame.
pub(crate) fn description(case: &Case, housing: &case::Housing) -> Result<HousingDescription, ComputeError> {
    let parts = housing
        .parts
        .iter()
        .map(|part| Ok(HousingPart { group: part.group.clone(), material: elastic_material(case, &part.material)? }));
    Ok(HousingDescription {
        parts: parts.collect::<Result<_, ComputeError>>()?,
        plane: housing.plane,
        formulation: housing.formulation,
        supports: housing.supports.iter().map(support).collect(),
        masses: housing.masses.clone(),
        links: housing.links.clone(),
        overlap: housing.overlap,
        frame: frame(case)?,
    })
}

/// Where the ring sits; the mesh's own frame without one.
fn frame(case: &Case) -> Result<RingFrame, ComputeError> {
    match case.ring.as_ref().and_then(|ring| ring.tie.as_ref()) {
        None => Ok(RingFrame::default()),
        Some(tie) => RingFrame::new(tie.centre, tie.axis, tie.zero_deg).ok_or(ComputeError::TieFrame),
    }
}

/// An isotropic material of the case, checked.
///
/// # Errors
/// [`ComputeError::Material`] for values out of range, [`ComputeError::Case`] for a name that `key` may not have.
pub(crate) fn material(case: &Case, key: &str, name: &str) -> Result<Material, ComputeError> {
    checked(name, case.isotropic(key, name)?)
}

fn checked(name: &str, given: &IsotropicMaterial) -> Result<Material, ComputeError> {
    Material::new(given.young, given.poisson, given.density).map_err(|source| named(name, source))
}

fn elastic_material(case: &Case, name: &str) -> Result<ElasticMaterial, ComputeError> {
    match case.known_material("housing.parts", name)? {
        case::Material::Orthotropic(given) => {
            let case::OrthotropicMaterial { young, poisson, shear, density, loss_factor, x_axis, y_axis } = *given;
            OrthotropicMaterial::new(young, poisson, shear, density, x_axis, y_axis)
                .and_then(|material| material.with_loss_factor(loss_factor))
                .map(ElasticMaterial::Orthotropic)
                .map_err(|source| named(name, source))
        }
        case::Material::Isotropic(given) => checked(name, given)?
            .with_loss_factor(given.loss_factor)
            .map(ElasticMaterial::from)
            .map_err(|source| named(name, source)),
    }
}

fn named(name: &str, source: MaterialError) -> ComputeError {
    let name = name.to_owned();
    ComputeError::Material { name, source }
}

fn support(support: &case::Support) -> HousingSupport {
    let (constraint, share) = match &support.hold {
        Hold::Fixed(axes) => {
            let fixed = [case::Axis::X, case::Axis::Y, case::Axis::Z].map(|axis| axes.contains(&axis));
            (Constraint::Fixed(fixed), SupportShare::PerNode)
        }
        Hold::Spring(stiffness, share) => (Constraint::Spring(*stiffness), *share),
    };
    HousingSupport { group: support.group.clone(), constraint, share }
}
