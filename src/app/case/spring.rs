//! Springs of a support or a link, as the case file gives them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Whether a stiffness stands at each node of a group or is shared by all of them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PerNodeOrGroup {
    /// Each node has a spring of this stiffness, so the sum grows with the mesh.
    #[default]
    Node,
    /// The springs of the group sum up to this stiffness, spread evenly over its length, area or volume.
    Group,
}

/// Spring stiffnesses along the axes in N/m, each >= 0 and at least one > 0.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Spring {
    /// Along x.
    #[serde(default)]
    pub x: f64,
    /// Along y.
    #[serde(default)]
    pub y: f64,
    /// Along z; solid models only.
    #[serde(default)]
    pub z: f64,
}
