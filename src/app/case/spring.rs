//! Springs of a support or a link, and links between groups of a housing, as the case file gives them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::schema::{one_of, together};
use super::union::{exactly_one, mismatch, written_as};
use crate::fe::model::{Connection, Link, SpringStiffness, SupportShare};

/// Spring stiffnesses along the axes in N/m, each >= 0 and at least one > 0.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Spring {
    /// Along x.
    pub x: f64,
    /// Along y.
    pub y: f64,
    /// Along z; solid models only.
    pub z: f64,
}

impl From<Spring> for SpringStiffness {
    fn from(Spring { x, y, z }: Spring) -> Self {
        Self::Global([x, y, z])
    }
}

/// The keys that springs of a support or a link are written with.
#[derive(Default)]
pub(super) struct SpringKeys {
    pub spring: Option<Spring>,
    pub radial: Option<f64>,
    pub per: Option<SupportShare>,
}

impl SpringKeys {
    pub(super) fn of(stiffness: SpringStiffness, share: SupportShare) -> Self {
        let (spring, radial) = match stiffness {
            SpringStiffness::Global([x, y, z]) => (Some(Spring { x, y, z }), None),
            SpringStiffness::Radial(radial) => (None, Some(radial)),
        };
        Self { spring, radial, per: Some(share) }
    }
}

#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = one_of(&["spring", "radial", "tie"]), "not" = together(&["tie", "per"])))]
/// A connection between two groups: `spring`, `radial` or `tie = true`.
struct LinkForm {
    /// Names of two groups of the mesh.
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

written_as!(Link, LinkForm, |form| {
    const ONE: &str = "exactly one of `spring`, `radial`, `tie = true`";
    let per = form.per.unwrap_or_default();
    let connections = [
        form.spring.map(|spring| Connection::Spring(spring.into(), per)),
        form.radial.map(|radial| Connection::Spring(SpringStiffness::Radial(radial), per)),
        form.tie.map(|_| Connection::Tie),
    ];
    match exactly_one(connections, ONE)? {
        Connection::Tie if form.tie == Some(false) => Err(mismatch("`tie = false`", ONE)),
        Connection::Tie if form.per.is_some() => {
            Err(mismatch("`per` beside `tie`", "`per` beside `spring` or `radial` only"))
        }
        connection => Ok(Self { between: form.between, connection }),
    }
});

impl From<Link> for LinkForm {
    fn from(link: Link) -> Self {
        let (tie, keys) = match link.connection {
            Connection::Tie => (Some(true), SpringKeys::default()),
            Connection::Spring(stiffness, share) => (None, SpringKeys::of(stiffness, share)),
        };
        Self { between: link.between, spring: keys.spring, radial: keys.radial, tie, per: keys.per }
    }
}
