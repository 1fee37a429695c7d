//! `[housing]`: mesh, parts, supports and added masses.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::fe::model::OverlapRule;
use crate::numerics::units::LengthUnit;

use super::link::Link;
use super::schema::{one_of, together};
use super::spring::{PerNodeOrGroup, Spring};
use super::union::{Mismatch, written_as};

/// The housing around the ring. Frame: the mesh's own, which the ring's tie relates to the bearing.
#[derive(Debug, Clone, PartialEq)]
pub struct Housing {
    /// Mesh file. Relative paths in a case file are relative to that file; here they are resolved.
    pub mesh: PathBuf,
    /// Unit of the mesh's coordinates.
    pub length_unit: LengthUnit,
    /// How a plane mesh stands for a solid; `None` for a mesh of solids.
    pub plane: Option<Plane>,
    /// Integration of the stiffness of ten-noded tetrahedra.
    pub integration: Integration,
    /// Formulation of four-noded quadrilaterals and eight-noded hexahedra.
    pub linear: LinearElements,
    /// Which group is made of what; at least one.
    pub parts: Vec<Part>,
    /// What holds the housing; may be empty.
    pub supports: Vec<Support>,
    /// Masses without size, each spread over a group; may be empty.
    pub masses: Vec<PointMass>,
    /// Connections between its groups; may be empty.
    pub links: Vec<Link>,
    /// Whether bodies may lie in one another.
    pub overlap: OverlapRule,
}

/// What a plane mesh assumes across its plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plane {
    /// Which stress or strain vanishes.
    pub assumption: PlaneAssumption,
    /// Thickness in m, > 0.
    pub thickness: f64,
}

/// What vanishes across a plane model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PlaneAssumption {
    /// Stress across the plane is zero: a sheet.
    Stress,
    /// Strain across the plane is zero: a slice of something long.
    Strain,
}

/// How the stiffness of ten-noded tetrahedra is integrated.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Integration {
    /// With enough points for curved edges.
    #[default]
    Full,
    /// With four points: exact for straight edges only.
    #[serde(rename = "4-point")]
    FourPoint,
}

/// How four-noded quadrilaterals and eight-noded hexahedra are formulated.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LinearElements {
    /// With incompatible modes: no locking in bending.
    #[default]
    Incompatible,
    /// Plain: much too stiff in bending.
    Plain,
}

/// A group of elements and its material.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// Name of a physical group of the mesh.
    pub group: String,
    /// Name of a material.
    pub material: String,
}

/// A direction of the mesh's frame.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// First coordinate.
    X,
    /// Second coordinate.
    Y,
    /// Third coordinate; solid meshes only.
    Z,
}

/// What holds a group of nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct Support {
    /// Name of a physical group of the mesh.
    pub group: String,
    /// How it is held.
    pub hold: Hold,
}

/// How a group is held.
#[derive(Debug, Clone, PartialEq)]
pub enum Hold {
    /// These displacements are zero.
    Fixed(Vec<Axis>),
    /// Springs to the ground along the axes.
    Spring {
        /// Stiffness along each axis.
        spring: Spring,
        /// What the stiffness belongs to.
        per: PerNodeOrGroup,
    },
    /// Springs to the ground along the radius from the bearing's axis. Alone they leave a round housing free to turn and
    /// to slide along the axis.
    Radial {
        /// Stiffness in N/m, > 0.
        stiffness: f64,
        /// What the stiffness belongs to.
        per: PerNodeOrGroup,
    },
}

#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = one_of(&["fixed", "spring", "radial"]), "not" = together(&["fixed", "per"])))]
/// What holds a group of nodes: `fixed`, `spring` or `radial`.
struct SupportForm {
    /// Name of a physical group of the mesh.
    group: String,
    /// These displacements are zero.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    fixed: Option<Vec<Axis>>,
    /// Stiffnesses of springs to the ground along the axes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    spring: Option<Spring>,
    /// Stiffness in N/m of springs to the ground along the radius from the bearing's axis, > 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    radial: Option<f64>,
    /// What the stiffness belongs to; not beside `fixed`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    per: Option<PerNodeOrGroup>,
}

written_as!(Support, SupportForm);

impl TryFrom<SupportForm> for Support {
    type Error = Mismatch;

    fn try_from(form: SupportForm) -> Result<Self, Mismatch> {
        const ONE: &str = "exactly one of `fixed`, `spring`, `radial`";
        let per = form.per.unwrap_or_default();
        let hold = match (form.fixed, form.spring, form.radial) {
            (Some(_), None, None) if form.per.is_some() => {
                return Err(Mismatch::form(
                    "`per` beside `fixed`",
                    "`per` beside `spring` or `radial` only",
                ));
            }
            (Some(axes), None, None) => Hold::Fixed(axes),
            (None, Some(spring), None) => Hold::Spring { spring, per },
            (None, None, Some(stiffness)) => Hold::Radial { stiffness, per },
            (None, None, None) => return Err(Mismatch::form("none of them", ONE)),
            _ => return Err(Mismatch::form("several", ONE)),
        };
        Ok(Self {
            group: form.group,
            hold,
        })
    }
}

impl From<Support> for SupportForm {
    fn from(support: Support) -> Self {
        let mut form = Self {
            group: support.group,
            fixed: None,
            spring: None,
            radial: None,
            per: None,
        };
        match support.hold {
            Hold::Fixed(axes) => form.fixed = Some(axes),
            Hold::Spring { spring, per } => {
                (form.spring, form.per) = (Some(spring), Some(per));
            }
            Hold::Radial { stiffness, per } => {
                (form.radial, form.per) = (Some(stiffness), Some(per));
            }
        }
        form
    }
}

/// A mass without size, spread over the nodes of a group.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointMass {
    /// Name of a physical group of the mesh.
    pub group: String,
    /// Mass of the whole group in kg, > 0.
    pub mass: f64,
}
