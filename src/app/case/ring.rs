//! `[ring]`: the outer ring as curved beam elements, its supports and its tie to the housing.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::spring::Spring;
use crate::fe::element::curved_beam::RingInterpolation;
use crate::fe::material::RadiusRule;
use crate::fe::model::{Fit, SpringShare};

/// The ring. Angles are counted from +x towards +y, the ring's first node stands at 0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("required" = []))]
pub struct Ring {
    /// Number of nodes and of elements, 8 to 2000.
    #[serde(default = "default_nodes")]
    pub nodes: usize,
    /// The cross-sections of rings fitted into each other, in any order; at least one. Beside `bearing.name` it may be absent: that
    /// bearing's outer ring.
    pub sections: Vec<Section>,
    /// How several sections act together.
    #[serde(default)]
    pub bond: Bond,
    /// On which radius each section bends; sections that slip only.
    #[serde(default)]
    pub radius_rule: RadiusRule,
    /// The element's interpolation.
    #[serde(default)]
    pub element: RingInterpolation,
    /// Whether shear deformation is included.
    #[serde(default = "super::yes")]
    pub shear: bool,
    /// Whether the sections' rotary inertia is included.
    #[serde(default = "super::yes")]
    pub rotary_inertia: bool,
    /// Radius of the ring's outer surface in m, not below any section's radius; `None`: not stated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outer_radius: Option<f64>,
    /// Springs to the ground; may be empty.
    #[serde(default)]
    pub supports: Vec<RingSupport>,
    /// The connection to the housing's bore; required if and only if there is a housing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tie: Option<Tie>,
}

fn default_nodes() -> usize {
    // Source paper, section 4: 72 elements.
    72
}

/// The cross-section of one ring.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Section {
    /// Name of a material.
    pub material: String,
    /// Area A in m^2, > 0.
    pub area: f64,
    /// Second moment of area I about the bending axis in m^4, > 0.
    pub inertia: f64,
    /// Second moment of area about the radial axis in m^4, > 0: bending out of the ring's plane, which
    /// a solid housing needs; `None`: that of the rectangle with the given `area` and `inertia`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axial_inertia: Option<f64>,
    /// Torsion constant J in m^4, > 0, for a solid housing too; `None`: that of the same rectangle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub torsion: Option<f64>,
    /// Radius of the centroid R in m, > 0.
    pub radius: f64,
    /// Share of the area that carries shear, > 0 and <= 1; 5/6 for a rectangle.
    #[serde(default = "default_shear_coefficient")]
    pub shear_coefficient: f64,
}

fn default_shear_coefficient() -> f64 {
    5.0 / 6.0
}

/// How rings fitted into each other act together.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Bond {
    /// In radial contact, free to slide: bending stiffnesses add up.
    #[default]
    Slip,
    /// One body: plane sections through both.
    Composite,
}

/// Springs at the ring's nodes from one angle to another.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RingSupport {
    /// First angle in degrees; a node there has a spring.
    pub from_deg: f64,
    /// Last angle in degrees, above the first by at most 360; a node there has none.
    pub to_deg: f64,
    /// Stiffness along x and y in N/m; z must be 0.
    pub spring: Spring,
    /// What the stiffness belongs to.
    #[serde(default)]
    pub per: SpringShare,
    /// Distance from the node outwards to where the spring attaches, in m; may be negative.
    #[serde(default)]
    pub offset: f64,
}

/// The ring's connection to the housing's bore.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Tie {
    /// The group of the bore: a physical group, a set, or CAD entities as "surface 7".
    pub group: String,
    /// What the bore follows.
    #[serde(default)]
    pub fit: Fit,
    /// Bearing centre in the mesh's frame, in m.
    #[serde(default)]
    pub centre: [f64; 3],
    /// Direction of the bearing's axis in the mesh's frame, any length but zero.
    #[serde(default = "axis_z")]
    pub axis: [f64; 3],
    /// Direction in the mesh's frame of the ring's angle 0, any length but zero, not along the axis.
    #[serde(default = "axis_x")]
    pub zero_deg: [f64; 3],
}

fn axis_z() -> [f64; 3] {
    [0.0, 0.0, 1.0]
}

fn axis_x() -> [f64; 3] {
    [1.0, 0.0, 0.0]
}
