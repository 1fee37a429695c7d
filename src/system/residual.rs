//! Static residual of the modes left out: what they would give at the contacts and at the sensors
//! if they had no mass.
//!
//! `G = N (K^-1 - sum phi phi^T / omega^2) N^T` over the kept modes (Craig 1981, Structural
//! Dynamics, section 11.3: mode-acceleration correction). The balls keep their spacing, so all
//! entries are functions of the cage angle alone; they change little over a fraction of an element
//! and are interpolated linearly on a grid of cage angles that does not depend on the history.

use super::structure::{Structure, StructureModes};
use super::SystemError;
use crate::linalg::DenseMatrix;
use crate::model::Ring;
use std::f64::consts::TAU;

/// Grid cells of the cage angle in the width of one element.
const CELLS_PER_ELEMENT: usize = 16;

/// Residual flexibility on the ring's displacements and how the balls meet it.
#[derive(Debug, Clone)]
pub(super) struct ResidualFlexibility {
    ring: Ring,
    balls: usize,
    /// [ring dof x ring dof], m/N.
    flexibility: DenseMatrix,
    /// Displacement under the weight that the kept modes lack [ring dof], m.
    weight: Vec<f64>,
    /// Sensors over ring loads [sensors x ring dof].
    sensors: DenseMatrix,
    cell: f64,
    current: i64,
    left: Entries,
    right: Entries,
    now: Entries,
}

/// Values at one cage angle.
#[derive(Debug, Clone)]
struct Entries {
    /// Radial displacement at ball j for a radial force at ball k [balls x balls], m/N.
    contact: Vec<f64>,
    /// Radial displacement at ball j under the weight [balls], m.
    weight: Vec<f64>,
    /// Sensor displacement for a radial force at ball k [sensors x balls], m/N.
    sensor: Vec<f64>,
}

impl ResidualFlexibility {
    /// # Errors
    /// [`SystemError::NotSupported`] if the structure is free.
    pub fn new(
        structure: &Structure,
        modes: &StructureModes,
        kept: &[usize],
        balls: usize,
    ) -> Result<Self, SystemError> {
        let (dof, ring_dof) = (structure.dof(), structure.ring().dof());
        let identity = DenseMatrix::from_fn(dof, ring_dof, |i, j| f64::from(u8::from(i == j)));
        let mut flexibility = structure.static_response(&identity)?;
        let weight_load = DenseMatrix::from_fn(dof, 1, |i, _| structure.gravity()[i]);
        let mut weight = structure.static_response(&weight_load)?;
        for &mode in kept {
            let shape = modes.shapes.col(mode);
            let softness = 1.0 / modes.squared_frequencies[mode];
            let pull = modes.participation(mode, structure.gravity());
            for row in 0..dof {
                for column in 0..ring_dof {
                    flexibility[(row, column)] -= softness * shape[row] * shape[column];
                }
                weight[(row, 0)] -= softness * shape[row] * pull;
            }
        }
        let sensors = structure.sensors();
        let sensors = DenseMatrix::from_fn(sensors.len(), ring_dof, |sensor, column| {
            (0..dof)
                .map(|row| sensors[sensor].row[row] * flexibility[(row, column)])
                .sum()
        });
        let entries = Entries {
            contact: vec![0.0; balls * balls],
            weight: vec![0.0; balls],
            sensor: vec![0.0; sensors.nrows() * balls],
        };
        Ok(Self {
            ring: structure.ring().clone(),
            balls,
            flexibility: flexibility.subrows(0, ring_dof).to_owned(),
            weight: (0..ring_dof).map(|row| weight[(row, 0)]).collect(),
            sensors,
            cell: TAU / (structure.ring().nodes() * CELLS_PER_ELEMENT) as f64,
            current: i64::MIN,
            left: entries.clone(),
            right: entries.clone(),
            now: entries,
        })
    }

    /// Moves to the cage angle `first` of ball 0, rad.
    #[inline]
    pub fn turn_to(&mut self, first: f64) {
        let place = first / self.cell;
        let cell = place.floor();
        if cell as i64 != self.current {
            self.enter_cell(cell as i64);
        }
        let fraction = place - cell;
        blend(&mut self.now.contact, &self.left.contact, &self.right.contact, fraction);
        blend(&mut self.now.weight, &self.left.weight, &self.right.weight, fraction);
        blend(&mut self.now.sensor, &self.left.sensor, &self.right.sensor, fraction);
    }

    /// Row of ball `j`: radial displacement there for radial forces at all balls, m/N.
    #[inline]
    pub fn contact_row(&self, j: usize) -> &[f64] {
        &self.now.contact[j * self.balls..(j + 1) * self.balls]
    }

    /// Radial displacement at ball `j` under the weight, m.
    #[inline]
    pub fn weight(&self, j: usize) -> f64 {
        self.now.weight[j]
    }

    /// Row of a sensor over radial forces at all balls, m/N.
    #[inline]
    pub fn sensor_row(&self, sensor: usize) -> &[f64] {
        &self.now.sensor[sensor * self.balls..(sensor + 1) * self.balls]
    }

    fn enter_cell(&mut self, cell: i64) {
        self.current = cell;
        for (side, entries) in [(0, &mut self.left), (1, &mut self.right)] {
            let first = (cell + side) as f64 * self.cell;
            let rows = |j: usize| {
                let angle = first + TAU * j as f64 / self.balls as f64;
                self.ring.rows_at(angle)
            };
            for j in 0..self.balls {
                let at_j = rows(j);
                entries.weight[j] = at_j.apply(&at_j.radial, &self.weight);
                for sensor in 0..self.sensors.nrows() {
                    entries.sensor[sensor * self.balls + j] = (0..6)
                        .map(|k| at_j.radial[k] * self.sensors[(sensor, at_j.dofs[k])])
                        .sum();
                }
                for k in 0..=j {
                    let at_k = rows(k);
                    let mut sum = 0.0;
                    for a in 0..6 {
                        for b in 0..6 {
                            sum += at_j.radial[a]
                                * self.flexibility[(at_j.dofs[a], at_k.dofs[b])]
                                * at_k.radial[b];
                        }
                    }
                    entries.contact[j * self.balls + k] = sum;
                    entries.contact[k * self.balls + j] = sum;
                }
            }
        }
    }
}

#[inline]
fn blend(now: &mut [f64], left: &[f64], right: &[f64], fraction: f64) {
    for ((now, left), right) in now.iter_mut().zip(left).zip(right) {
        *now = left + fraction * (right - left);
    }
}
