//! Connections between groups of a housing.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::schema::{one_of, together};
use super::spring::{Spring, SpringKeys};
use super::union::{Mismatch, written_as};
use crate::fe::model::{Connection, Link, SpringStiffness, SupportShare};

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
    per: Option<SupportShare>,
}

written_as!(Link, LinkForm);

impl TryFrom<LinkForm> for Link {
    type Error = Mismatch;

    fn try_from(form: LinkForm) -> Result<Self, Mismatch> {
        const ONE: &str = "exactly one of `spring`, `radial`, `tie = true`";
        let per = form.per.unwrap_or_default();
        let connection = match (form.spring, form.radial, form.tie) {
            (None, None, Some(true)) if form.per.is_some() => {
                return Err(Mismatch::form("`per` beside `tie`", "`per` beside `spring` or `radial` only"));
            }
            (None, None, Some(true)) => Connection::Tie,
            (Some(spring), None, None) => Connection::Spring(spring.into(), per),
            (None, Some(radial), None) => Connection::Spring(SpringStiffness::Radial(radial), per),
            (None, None, None) => return Err(Mismatch::form("none of them", ONE)),
            (None, None, Some(false)) => return Err(Mismatch::form("`tie = false`", ONE)),
            _ => return Err(Mismatch::form("several", ONE)),
        };
        Ok(Self { between: form.between, connection })
    }
}

impl From<Link> for LinkForm {
    fn from(link: Link) -> Self {
        let (tie, keys) = match link.connection {
            Connection::Tie => (Some(true), SpringKeys::default()),
            Connection::Spring(stiffness, share) => (None, SpringKeys::of(stiffness, share)),
        };
        Self { between: link.between, spring: keys.spring, radial: keys.radial, tie, per: keys.per }
    }
}
