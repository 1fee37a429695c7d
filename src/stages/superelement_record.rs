//! A condensed housing as files carry it.

use super::StageError;
use super::condensed::CondensedStage;
use super::damping::viscous_matrix;
use super::places::Place;
use crate::case::Case;
use crate::exchange::{SensorRow, SuperelementRecord};
use crate::linalg::{DenseMatrix, sparse_times_dense, transpose_times_dense};
use std::f64::consts::TAU;

/// The superelement with its labels, its damping, its weight and the rows of the case's sensors.
///
/// # Errors
/// [`StageError`] of sensors and damping.
pub fn superelement_record(
    case: &Case,
    stage: &CondensedStage,
) -> Result<SuperelementRecord, StageError> {
    let element = &stage.condensed.superelement;
    let sensors = case
        .sensors
        .iter()
        .map(|sensor| {
            let place = Place::of_sensor(stage, sensor)?;
            Ok(SensorRow {
                name: sensor.name.clone(),
                row: place.reduced(&stage.condensed),
            })
        })
        .collect::<Result<_, StageError>>()?;
    let damping = viscous_matrix(case, &element.stiffness, &element.mass)?;
    Ok(SuperelementRecord {
        damping: Some(damping).filter(|c| c.norm_max() > 0.0),
        structural: element.structural.clone(),
        interface: stage.interface_labels(),
        modal_hz: stage
            .condensed
            .basis
            .values()
            .iter()
            .map(|value| value.sqrt() / TAU)
            .collect(),
        weight: Some(weight(stage)),
        sensors,
        field: None,
        stiffness: element.stiffness.clone(),
        mass: element.mass.clone(),
    })
}

/// Mass times unit accelerations along the mesh's axes, on the coordinates [order x 3].
fn weight(stage: &CondensedStage) -> DenseMatrix {
    let model = &stage.housing.model;
    let d = model.dimension();
    let falls = DenseMatrix::from_fn(model.dof(), 3, |dof, axis| {
        f64::from(u8::from(dof % d == axis))
    });
    let nodal = sparse_times_dense(&stage.housing.matrices.mass, &falls);
    let turned = match stage.boundary.ring().and_then(|(_, tie)| tie.rotation()) {
        Some(rotation) => transpose_times_dense(rotation, &nodal),
        None => nodal,
    };
    stage.condensed.project(&turned)
}
