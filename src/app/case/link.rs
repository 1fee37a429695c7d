//! Connections between groups of a housing.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::schema::{one_of, together};
use super::spring::{PerNodeOrGroup, Spring};
use super::union::{Mismatch, written_as};

/// A connection between two groups. Nodes of one are connected to the nearest points of the other, so the meshes of
/// two parts need not match: those of the first group by springs, those of the finer surface by a tie.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// Names of two physical groups of the mesh.
    pub between: [String; 2],
    /// How they are connected.
    pub joint: Joint,
}

/// How two groups are connected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Joint {
    /// By springs along the axes.
    Spring {
        /// Stiffness along each axis.
        spring: Spring,
        /// What the stiffness belongs to, in the first group.
        per: PerNodeOrGroup,
    },
    /// By springs along the radius from the bearing's axis.
    Radial {
        /// Stiffness in N/m, > 0.
        stiffness: f64,
        /// What the stiffness belongs to, in the first group.
        per: PerNodeOrGroup,
    },
    /// Rigidly: two surfaces (curves in a plane housing) move as one.
    Tie,
}

#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = one_of(&["spring", "radial", "tie"]), "not" = together(&["tie", "per"])))]
/// A connection between two groups: `spring`, `radial` or `tie = true`.
struct LinkForm {
    /// Names of two physical groups of the mesh.
    between: [String; 2],
    /// Stiffnesses of springs along the axes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    spring: Option<Spring>,
    /// Stiffness in N/m of springs along the radius from the bearing's axis, > 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    radial: Option<f64>,
    /// Rigidly: two surfaces (curves in a plane housing) move as one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("enum" = [true]))]
    tie: Option<bool>,
    /// What the stiffness belongs to, in the first group; not beside `tie`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    per: Option<PerNodeOrGroup>,
}

written_as!(Link, LinkForm);

impl TryFrom<LinkForm> for Link {
    type Error = Mismatch;

    fn try_from(form: LinkForm) -> Result<Self, Mismatch> {
        const ONE: &str = "exactly one of `spring`, `radial`, `tie = true`";
        let per = form.per.unwrap_or_default();
        let joint = match (form.spring, form.radial, form.tie) {
            (None, None, Some(true)) if form.per.is_some() => {
                return Err(Mismatch::form(
                    "`per` beside `tie`",
                    "`per` beside `spring` or `radial` only",
                ));
            }
            (None, None, Some(true)) => Joint::Tie,
            (Some(spring), None, None) => Joint::Spring { spring, per },
            (None, Some(stiffness), None) => Joint::Radial { stiffness, per },
            (None, None, None) => return Err(Mismatch::form("none of them", ONE)),
            (None, None, Some(false)) => return Err(Mismatch::form("`tie = false`", ONE)),
            _ => return Err(Mismatch::form("several", ONE)),
        };
        Ok(Self {
            between: form.between,
            joint,
        })
    }
}

impl From<Link> for LinkForm {
    fn from(link: Link) -> Self {
        let mut form = Self {
            between: link.between,
            spring: None,
            radial: None,
            tie: None,
            per: None,
        };
        match link.joint {
            Joint::Spring { spring, per } => (form.spring, form.per) = (Some(spring), Some(per)),
            Joint::Radial { stiffness, per } => {
                (form.radial, form.per) = (Some(stiffness), Some(per));
            }
            Joint::Tie => form.tie = Some(true),
        }
        form
    }
}
