//! Springs of a support or a link, as the case file gives them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::fe::model::{SpringStiffness, SupportShare};

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
