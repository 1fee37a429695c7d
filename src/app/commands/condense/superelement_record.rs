//! A condensed housing as files carry it.

use super::CondenseResult;
use crate::app::case::{Case, Sensor};
use crate::app::error::ComputeError;
use crate::app::scene::condensed::basis_choice;
use crate::app::scene::damping::viscous_matrix;
use crate::app::scene::places::{Place, nodes_at};
use crate::app::scene::{Boundary, CondensedHousing};
use crate::fe::reduction::{InterfaceReduction, InteriorBasis, Superelement};
use crate::formats::{DofLabel, FieldRecovery, InterfaceRecovery, SensorRow, SuperelementRecord};
use crate::numerics::linalg::{DenseMatrix, sparse_times_dense, transpose_times_dense};
use std::collections::BTreeSet;
use std::f64::consts::TAU;

/// Numbers of a recovery that goes into a file: 8 MiB.
const FIELD: usize = 1 << 20;

/// The superelement with its labels, its damping, its weight and the rows of the case's sensors.
///
/// # Errors
/// [`ComputeError`] of sensors and damping.
pub fn superelement_record(case: &Case, stage: &CondensedHousing) -> Result<SuperelementRecord, ComputeError> {
    Coordinates { stage, reduction: None }.record(case)
}

impl CondenseResult {
    /// The superelement of `superelement.npz`: that of the whole interface, or on the modes of it that the case asks for.
    ///
    /// # Errors
    /// As [`superelement_record`].
    pub fn record(&self, case: &Case) -> Result<SuperelementRecord, ComputeError> {
        let reduction = self.interface.as_ref().map(|interface| &interface.reduction);
        Coordinates { stage: &self.stage, reduction }.record(case)
    }
}

/// What the coordinates of a record are: those of the condensed housing, or modes of its interface, with the way back to that.
struct Coordinates<'a> {
    stage: &'a CondensedHousing,
    reduction: Option<&'a InterfaceReduction>,
}

impl Coordinates<'_> {
    fn element(&self) -> &Superelement {
        match self.reduction {
            Some(reduced) => &reduced.superelement,
            None => &self.stage.condensed.superelement,
        }
    }

    /// Columns over the coordinates of the whole interface, over these.
    fn columns(&self, columns: DenseMatrix) -> DenseMatrix {
        match self.reduction {
            Some(reduced) => reduced.rows(&columns),
            None => columns,
        }
    }

    /// The row of a place.
    fn row(&self, place: &Place) -> Vec<f64> {
        let row = place.reduced(&self.stage.condensed);
        let column = DenseMatrix::from_fn(row.len(), 1, |entry, _| row[entry]);
        self.columns(column).col_as_slice(0).to_vec()
    }

    /// The superelement on these coordinates.
    ///
    /// # Errors
    /// As [`superelement_record`].
    fn record(&self, case: &Case) -> Result<SuperelementRecord, ComputeError> {
        let (stage, element) = (self.stage, self.element());
        let row = |sensor: &Sensor| {
            let row = self.row(&Place::new(stage.bodies(), sensor.into())?);
            Ok(SensorRow { name: sensor.name.clone(), row })
        };
        let sensors = case.sensors.iter().map(row).collect::<Result<_, ComputeError>>()?;
        let damping = viscous_matrix(case, &element.stiffness, &element.mass)?;
        let values = stage.condensed.basis.values();
        let labels = stage.interface_labels();
        let (interface, interface_recovery) = match self.reduction {
            None => (labels, None),
            Some(reduced) => (
                (0..reduced.kept() as u64).map(DofLabel::interface).collect(),
                Some(InterfaceRecovery { labels, modes: reduced.modes() }),
            ),
        };
        Ok(SuperelementRecord {
            damping: Some(damping).filter(|c| c.norm_max() > 0.0),
            structural: element.structural.clone(),
            interface,
            interface_recovery,
            modal_hz: values.iter().map(|value| value.sqrt() / TAU).collect(),
            band_hz: Some(basis_choice(case).band_hz),
            complete_hz: complete_hz(&stage.condensed.basis),
            outer_radius: match &stage.boundary {
                Boundary::Rings(_) => case.ring.as_ref().and_then(|ring| ring.outer_radius),
                _ => None,
            },
            weight: Some(self.columns(weight(stage))),
            sensors,
            field: self.field(case)?,
            stiffness: element.stiffness.clone(),
            mass: element.mass.clone(),
        })
    }

    /// The way back to nodes of the mesh: all of them, else those of the sensors and of the bore, else those of the sensors;
    /// the first whose recovery has at most [`FIELD`] numbers.
    fn field(&self, case: &Case) -> Result<Option<FieldRecovery>, ComputeError> {
        let stage = self.stage;
        let housing = &stage.housing;
        let d = housing.model.dimension();
        let used = |node: &usize| housing.model.used[*node];
        let all: Vec<usize> = (0..housing.mesh.nodes.len()).filter(used).collect();
        let mut of_sensors = BTreeSet::new();
        for sensor in &case.sensors {
            of_sensors.extend(nodes_at(housing, sensor.into())?);
        }
        let driven = stage.boundary.partition().driven.iter();
        let with_bore: BTreeSet<usize> = driven.map(|dof| dof / d).chain(of_sensors.clone()).collect();
        let order = self.element().order();
        let fits = |nodes: &Vec<usize>| !nodes.is_empty() && 3 * nodes.len() * order <= FIELD;
        let choices = [all, with_bore.into_iter().collect(), of_sensors.into_iter().collect()];
        let Some(nodes) = choices.into_iter().find(fits) else {
            return Ok(None);
        };
        let mut recovery = DenseMatrix::zeros(3 * nodes.len(), order);
        for (place, &node) in nodes.iter().enumerate() {
            for axis in 0..d {
                let mut direction = [0.0; 3];
                direction[axis] = 1.0;
                let entries = match stage.boundary.rings() {
                    Some((_, tie)) => tie.displacement_row(&housing.model, node, direction),
                    None => housing.model.displacement_row(node, direction),
                };
                let row = self.row(&Place::Housing(entries));
                for (column, value) in row.into_iter().enumerate() {
                    recovery[(3 * place + axis, column)] = value;
                }
            }
        }
        Ok(Some(FieldRecovery {
            node_tags: nodes.iter().map(|&n| housing.model.node_tags[n]).collect(),
            positions: nodes.iter().map(|&n| housing.model.coordinates()[n]).collect(),
            recovery,
        }))
    }
}

/// Up to which frequency a basis has all vectors of the interior, Hz: the first that was left out, or the highest of all.
fn complete_hz(basis: &InteriorBasis) -> Option<f64> {
    let below = basis.complete_below;
    let end = if below.is_finite() { Some(below) } else { basis.values().iter().copied().reduce(f64::max) };
    end.map(|value| value.sqrt() / TAU)
}

/// Mass times unit accelerations along the mesh's axes, on the coordinates [order x 3].
fn weight(stage: &CondensedHousing) -> DenseMatrix {
    let model = &stage.housing.model;
    let d = model.dimension();
    let falls = DenseMatrix::from_fn(model.dof(), 3, |dof, axis| f64::from(u8::from(dof % d == axis)));
    let nodal = sparse_times_dense(&stage.housing.matrices.mass, &falls);
    let turned = match stage.boundary.rings().and_then(|(_, tie)| tie.rotation()) {
        Some(rotation) => transpose_times_dense(rotation, &nodal),
        None => nodal,
    };
    stage.condensed.project(&turned)
}
