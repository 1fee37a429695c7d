//! What rigid bores cost: modes of the housing with its centre nodes, nothing on them, beside those of the housing as it is.

use super::price::{MORE, RIGID, TIE_PRICE_MODES};
use crate::app::error::ComputeError;
use crate::app::scene::CondensedHousing;
use crate::fe::assembly::CoupledMatrices;
use crate::fe::modal::{
    ComparisonOptions, FullModes, ModalComparison, ModeRange, ModeSet, Partner, mode_set, partners, strain_products,
};
use crate::numerics::Watch;
use schemars::JsonSchema;
use serde::Serialize;

/// A mode of the housing with rigid bores, and what belongs to it in the housing whose bores may deform.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct BorePrice {
    /// Its number, from 0.
    pub mode: usize,
    /// With rigid bores, Hz.
    pub rigid_hz: f64,
    /// With bores that deform, Hz; `None` where no mode has its shape.
    pub free_hz: Option<f64>,
    /// `(rigid - free) / free`.
    pub relative_difference: Option<f64>,
    /// Modal assurance criterion of the two shapes.
    pub mac: Option<f64>,
}

/// The price of the rigid centre nodes of a housing for its lowest elastic modes, nothing condensed.
///
/// # Errors
/// [`ComputeError`] of the eigenvalue computations.
pub(crate) fn bore_price(stage: &CondensedHousing, watch: &impl Watch) -> Result<Vec<BorePrice>, ComputeError> {
    watch.stage("rigid bores");
    let (mesh, model) = (&stage.housing.mesh, &stage.housing.model);
    let sought = ModeRange::AtMost(TIE_PRICE_MODES + RIGID + MORE[0]);
    let set = |matrices: CoupledMatrices| -> Result<(ModeSet, usize), ComputeError> {
        let mut modes = FullModes::of(matrices, sought, None, watch)?;
        modes.sharpen(&|motions, all| strain_products(model, &motions.housing(model, all)))?;
        let shapes = modes.motions.housing(model, &modes.over_all_rows());
        let housing = Some((mesh, model, &shapes));
        Ok((mode_set(&modes.basis.frequencies_hz, housing, &[]), modes.basis.rigid_modes))
    };
    let (rigid, without_strain) = set(stage.full_matrices())?;
    let (free, _) = set(CoupledMatrices::of_housing(stage.housing.matrices.clone(), model))?;
    let found = ModalComparison::new(&rigid, &free, ComparisonOptions::default())?;
    let partners = partners(&rigid, &free, &found);
    let elastic = partners.iter().enumerate().skip(without_strain).take(TIE_PRICE_MODES);
    let row = |(mode, &partner): (usize, &Option<Partner>)| {
        let rigid_hz = rigid.frequencies_hz[mode];
        BorePrice {
            mode,
            rigid_hz,
            free_hz: partner.map(|partner| partner.hz),
            relative_difference: partner.map(|partner| rigid_hz / partner.hz - 1.0),
            mac: partner.map(|partner| partner.mac),
        }
    };
    Ok(elastic.map(row).collect())
}
