//! `[housing]`: mesh, parts, supports and added masses.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::fe::element::continuum::Formulation;
use crate::fe::model::{Link, OverlapRule, PlaneModel, PointMass, SpringStiffness, SupportShare};
use crate::numerics::units::LengthUnit;

use super::schema::{one_of, together};
use super::spring::{Spring, SpringKeys};
use super::union::{exactly_one, mismatch, written_as};

/// The housing around the ring. Frame: the mesh's own, which the ring's tie relates to the bearing.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Housing {
    /// Mesh file. Relative paths in a case file are relative to that file; here they are resolved.
    pub mesh: PathBuf,
    /// Unit of the mesh's coordinates.
    pub length_unit: LengthUnit,
    /// How a plane mesh stands for a solid; `None` for a mesh of solids.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plane: Option<PlaneModel>,
    /// Stiffness of ten-noded tetrahedra (`integration`), four-noded quadrilaterals and eight-noded hexahedra (`linear`).
    #[serde(flatten)]
    pub formulation: Formulation,
    /// Which group is made of what; at least one.
    pub parts: Vec<Part>,
    /// What holds the housing; may be empty.
    pub supports: Vec<Support>,
    /// Masses without size, each spread over a group; may be empty.
    pub masses: Vec<PointMass>,
    /// Connections between its groups; may be empty.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub links: Vec<Link>,
    /// Whether bodies may lie in one another.
    #[serde(skip_serializing_if = "is_refused")]
    pub overlap: OverlapRule,
}

fn is_refused(rule: &OverlapRule) -> bool {
    *rule == OverlapRule::Refuse
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
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
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
    /// By springs to the ground. Radial ones alone leave a round housing free to turn and to slide along the axis.
    Spring(SpringStiffness, SupportShare),
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
    per: Option<SupportShare>,
}

written_as!(Support, SupportForm, |form| {
    const ONE: &str = "exactly one of `fixed`, `spring`, `radial`";
    let per = form.per.unwrap_or_default();
    let holds = [
        form.fixed.map(Hold::Fixed),
        form.spring.map(|spring| Hold::Spring(spring.into(), per)),
        form.radial.map(|radial| Hold::Spring(SpringStiffness::Radial(radial), per)),
    ];
    match exactly_one(holds, ONE)? {
        Hold::Fixed(_) if form.per.is_some() => {
            Err(mismatch("`per` beside `fixed`", "`per` beside `spring` or `radial` only"))
        }
        hold => Ok(Self { group: form.group, hold }),
    }
});

impl From<Support> for SupportForm {
    fn from(support: Support) -> Self {
        let (fixed, keys) = match support.hold {
            Hold::Fixed(axes) => (Some(axes), SpringKeys::default()),
            Hold::Spring(stiffness, share) => (None, SpringKeys::of(stiffness, share)),
        };
        Self { group: support.group, fixed, spring: keys.spring, radial: keys.radial, per: keys.per }
    }
}
