//! Mesh to matrices of a housing, as the case asks for them.

use super::{StageError, Watch};
use crate::assembly::SystemMatrices;
use crate::case::{self, Case, Hold, PerNodeOrGroup};
use crate::element::plane::{PlaneAssumption, PlaneProperties};
use crate::material::Material;
use crate::mesh::Mesh;
use crate::model::{
    Constraint, HousingModel, HousingSupport, PartProperties, PointMass, SupportShare,
};

/// A housing, assembled.
#[derive(Debug, Clone)]
pub struct HousingStage {
    /// The mesh.
    pub mesh: Mesh,
    /// The mesh with properties and supports.
    pub model: HousingModel,
    /// Stiffness and mass over all its degrees of freedom.
    pub matrices: SystemMatrices,
}

impl HousingStage {
    /// Reads and assembles the case's housing; `None` without one.
    ///
    /// # Errors
    /// [`StageError`] of mesh, model and elements.
    pub fn build(case: &Case, watch: &impl Watch) -> Result<Option<Self>, StageError> {
        let Some(housing) = &case.housing else {
            return Ok(None);
        };
        watch.stage("read");
        let mesh = Mesh::read_gmsh(&housing.mesh, housing.length_unit)?;
        let groups: Vec<String> = mesh.groups.iter().map(|group| group.name.clone()).collect();
        case.check_groups(&groups)?;
        watch.stage("assemble");
        let centre = centre(case)?;
        let parts = housing
            .parts
            .iter()
            .map(|part| part_properties(case, housing, part))
            .collect::<Result<_, _>>()?;
        let supports = housing.supports.iter().flat_map(support).collect();
        let masses: Vec<PointMass> = housing
            .masses
            .iter()
            .map(|mass| PointMass {
                group: mass.group.clone(),
                mass: mass.mass,
            })
            .collect();
        let model = HousingModel::new(&mesh, parts, supports, &masses, centre)?;
        let matrices = SystemMatrices::assemble(&model)?;
        Ok(Some(Self {
            mesh,
            model,
            matrices,
        }))
    }
}

/// Centre of the ring in the mesh's axes, m.
fn centre(case: &Case) -> Result<[f64; 2], StageError> {
    let Some(tie) = case.ring.as_ref().and_then(|ring| ring.tie.as_ref()) else {
        return Ok([0.0; 2]);
    };
    let is = |given: [f64; 3], wanted: [f64; 3]| {
        given.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-12)
    };
    if is(tie.axis, [0.0, 0.0, 1.0]) && is(tie.zero_deg, [1.0, 0.0, 0.0]) {
        Ok([tie.centre[0], tie.centre[1]])
    } else {
        Err(StageError::TieFrame)
    }
}

/// A material of the case, checked.
///
/// # Errors
/// [`StageError::Material`] for values out of range; a missing name was refused with the case.
pub(super) fn material(case: &Case, name: &str) -> Result<Material, StageError> {
    let given = case.material(name).copied();
    let (young, poisson, density) = given.map_or((f64::NAN, f64::NAN, f64::NAN), |given| {
        (given.young, given.poisson, given.density)
    });
    Material::new(young, poisson, density).map_err(|source| StageError::Material {
        name: name.to_owned(),
        source,
    })
}

fn part_properties(
    case: &Case,
    housing: &case::Housing,
    part: &case::Part,
) -> Result<PartProperties, StageError> {
    // a plane housing without `plane` was refused with the case
    let (assumption, thickness) =
        housing
            .plane
            .map_or((PlaneAssumption::Stress, f64::NAN), |plane| {
                let assumption = match plane.assumption {
                    case::PlaneAssumption::Stress => PlaneAssumption::Stress,
                    case::PlaneAssumption::Strain => PlaneAssumption::Strain,
                };
                (assumption, plane.thickness)
            });
    Ok(PartProperties {
        group: part.group.clone(),
        properties: PlaneProperties::new(material(case, &part.material)?, assumption, thickness)?,
    })
}

fn support(support: &case::Support) -> Option<HousingSupport> {
    let share = |per: PerNodeOrGroup| match per {
        PerNodeOrGroup::Node => SupportShare::PerNode,
        PerNodeOrGroup::Group => SupportShare::PerGroup,
    };
    let (constraint, share) = match &support.hold {
        Hold::Fixed(axes) => {
            let holds = |axis| axes.contains(&axis);
            let fixed = [holds(case::Axis::X), holds(case::Axis::Y)];
            (Constraint::Fixed(fixed), SupportShare::PerNode)
        }
        Hold::Spring { spring, per } => (Constraint::Spring([spring.x, spring.y]), share(*per)),
        Hold::Radial { stiffness, per } => (Constraint::Radial(*stiffness), share(*per)),
    };
    Some(HousingSupport {
        group: support.group.clone(),
        constraint,
        share,
    })
}
