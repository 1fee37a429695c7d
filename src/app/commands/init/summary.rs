//! What `plummer init --json` says.

use super::Draft;
use crate::app::case::{BuiltInMaterial, IsotropicMaterial};
use crate::bearing::catalogue::{CatalogueBearing, normal_clearance};
use crate::bearing::kinematics::DefectOrders;
use schemars::JsonSchema;
use serde::Serialize;
use std::path::Path;

/// A case file that was written.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct DraftResult<'a> {
    /// Version of the program.
    pub plummer: &'static str,
    /// "init".
    pub command: &'static str,
    /// The mesh.
    pub mesh: &'a Path,
    /// The case file.
    pub case: &'a Path,
    /// What it was made from.
    #[serde(flatten)]
    pub draft: &'a Draft,
}

/// The catalogue: what `--list-bearings` prints.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct CatalogueResult {
    /// Version of the program.
    pub plummer: &'static str,
    /// "init".
    pub command: &'static str,
    /// The bearings, by series and bore.
    pub bearings: Vec<CatalogueEntry>,
}

/// The materials that a case may name: what `--list-materials` prints.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct MaterialsResult {
    /// Version of the program.
    pub plummer: &'static str,
    /// "init".
    pub command: &'static str,
    /// The materials.
    pub materials: Vec<MaterialSummary>,
}

/// A material that a case may name.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct MaterialSummary {
    /// Its name.
    pub name: &'static str,
    /// Young's modulus, Pa.
    pub young_pa: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Density, kg/m^3.
    pub density_kg_m3: f64,
    /// How far real ones lie from these values, and by what.
    pub range: &'static str,
    /// Where this is published.
    pub source: &'static str,
}

impl From<&BuiltInMaterial> for MaterialSummary {
    fn from(built_in: &BuiltInMaterial) -> Self {
        let BuiltInMaterial { name, material, range, source } = *built_in;
        let IsotropicMaterial { young, poisson, density, .. } = material;
        Self { name, young_pa: young, poisson, density_kg_m3: density, range, source }
    }
}

/// A bearing of the catalogue.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct CatalogueEntry {
    /// What its maker publishes.
    #[serde(flatten)]
    pub bearing: CatalogueBearing,
    /// Balls that pass a place of the outer race in a turn of the shaft, without contact angle.
    pub bpfo: Option<f64>,
    /// Balls that pass a place of the inner race.
    pub bpfi: Option<f64>,
    /// Spin of a ball.
    pub bsf: Option<f64>,
    /// Turns of the cage.
    pub ftf: Option<f64>,
    /// Smallest and largest diametral clearance of group N, m; `None` for a bore outside the table.
    pub normal_clearance_m: Option<[f64; 2]>,
    /// Where this is published.
    pub source: &'static str,
}

impl CatalogueEntry {
    /// Of a bearing and its orders.
    #[must_use]
    pub(crate) fn of(bearing: &CatalogueBearing, orders: Option<DefectOrders>) -> Self {
        Self {
            bearing: *bearing,
            bpfo: orders.map(|orders| orders.outer),
            bpfi: orders.map(|orders| orders.inner),
            bsf: orders.map(|orders| orders.ball_spin),
            ftf: orders.map(|orders| orders.cage),
            normal_clearance_m: normal_clearance(bearing.bore),
            source: bearing.source.citation(),
        }
    }
}
