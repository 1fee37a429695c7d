//! Static residual of the modes left out: what they would give at the contacts and at the sensors
//! if they had no mass.
//!
//! `G = N (K^-1 - sum phi phi^T / omega^2) N^T` over the kept modes (Craig 1981, Structural
//! Dynamics, section 11.3: mode-acceleration correction). The flexibility is stored over the polar
//! components of the ring's nodes, in which all elements share one interpolation: a pair of balls
//! costs one product of two six-vectors with a block of it.

use super::SystemError;
use super::lanes::{LANES, Lanes};
use super::raceway::{Place, Places, RacewayTable};
use super::structure::{Structure, StructureModes};
use crate::linalg::DenseMatrix;
use crate::model::Ring;
use std::f64::consts::TAU;

/// Components of an element's two nodes.
const ELEMENT_DOF: usize = 6;

/// The radial interpolation at a place over these components, filled up.
type Row = [Lanes; ELEMENT_DOF.div_ceil(LANES)];

/// Residual flexibility on the ring's displacements and how the balls meet it.
#[derive(Debug, Clone)]
pub(super) struct ResidualFlexibility {
    elements: usize,
    interpolation: RacewayTable,
    /// Three components a node, the first node repeated after the last.
    width: usize,
    /// [width x width], m/N.
    flexibility: Vec<f64>,
    /// Displacement under the weight that the kept modes lack \[width\], m.
    weight: Vec<f64>,
    /// Sensors over ring loads [sensors x width].
    sensors: Vec<f64>,
    /// Element of every ball and its radial interpolation there.
    places: Vec<(usize, Row)>,
    /// Place of every ball in its element.
    local: Vec<Place>,
    /// Derivative of that interpolation by the angle, 1/rad.
    slopes: Vec<Row>,
    /// Radial displacement at ball j for a radial force at ball k [balls x balls], m/N.
    contact: Vec<f64>,
    /// Its derivative by the cage angle, m/(N rad).
    contact_slope: Vec<f64>,
    /// Radial displacement at ball j under the weight \[balls\], m.
    weight_now: Vec<f64>,
    /// Sensor displacement for a radial force at ball k [sensors x balls], m/N.
    sensor_now: Vec<f64>,
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
        let (dof, ring) = (structure.dof(), structure.ring());
        let ring_dof = ring.dof();
        let loads = DenseMatrix::from_fn(dof, ring_dof + 1, |i, j| {
            if j == ring_dof {
                structure.gravity()[i]
            } else {
                f64::from(u8::from(i == j))
            }
        });
        let mut response = structure.static_response(&loads)?;
        for &mode in kept {
            let shape = modes.shapes.col(mode);
            let softness = 1.0 / modes.squared_frequencies[mode];
            let pull = modes.participation(mode, structure.gravity());
            for row in 0..dof {
                for column in 0..ring_dof {
                    response[(row, column)] -= softness * shape[row] * shape[column];
                }
                response[(row, ring_dof)] -= softness * shape[row] * pull;
            }
        }
        let sensors = structure.sensors();
        let sensor_rows = DenseMatrix::from_fn(sensors.len(), ring_dof, |sensor, column| {
            (0..dof)
                .map(|row| sensors[sensor].row[row] * response[(row, column)])
                .sum()
        });
        let width = ring_dof + ELEMENT_DOF / 2;
        let polar = polar_components(ring, width);
        let on_ring = response.subrows(0, ring_dof);
        let flexibility = &polar * on_ring.subcols(0, ring_dof) * polar.transpose();
        let weight = &polar * on_ring.subcols(ring_dof, 1);
        let sensor_rows = sensor_rows * polar.transpose();
        let by_rows = |matrix: &DenseMatrix| -> Vec<f64> {
            (0..matrix.nrows())
                .flat_map(|row| (0..matrix.ncols()).map(move |column| (row, column)))
                .map(|place| matrix[place])
                .collect()
        };
        Ok(Self {
            elements: ring.nodes(),
            interpolation: RacewayTable::of_interpolation(ring),
            width,
            flexibility: by_rows(&flexibility),
            weight: by_rows(&weight),
            places: vec![(0, Row::default()); balls],
            local: vec![Place::default(); balls],
            slopes: vec![Row::default(); balls],
            contact: vec![0.0; balls * balls],
            contact_slope: vec![0.0; balls * balls],
            weight_now: vec![0.0; balls],
            sensor_now: vec![0.0; sensor_rows.nrows() * balls],
            sensors: by_rows(&sensor_rows),
        })
    }

    /// Moves ball `j` to a place in turns, 0 <= turn < 1.
    #[inline]
    pub fn place(&mut self, j: usize, turn: f64) {
        let element = Places::among(self.elements as f64, &[turn; LANES]).get(0);
        let inside = 0.5 * (element.xi + 1.0);
        let (place, row) = &mut self.places[j];
        *place = element.piece;
        let element = element.piece;
        self.local[j] = self.interpolation.locate(&[inside; LANES]).get(0);
        self.interpolation
            .values_into(self.local[j], &[[0.0; LANES]; 2], row.iter_mut());
        let first = ELEMENT_DOF / 2 * element;
        self.weight_now[j] = product(row, &self.weight[first..first + ELEMENT_DOF]);
        let balls = self.places.len();
        let sensors = self.sensors.chunks_exact(self.width);
        for (sensor, loads) in sensors.enumerate() {
            self.sensor_now[sensor * balls + j] =
                product(&self.places[j].1, &loads[first..first + ELEMENT_DOF]);
        }
    }

    /// Computes the coupling between the balls for which `near(j)` holds; the others' is stale.
    #[inline]
    pub fn couple(&mut self, near: impl Fn(usize) -> bool) {
        let balls = self.places.len();
        // elements, each a turn of the interpolation, in a radian
        let by_angle = self.elements as f64 / TAU;
        for j in (0..balls).filter(|&j| near(j)) {
            self.interpolation
                .slopes_into(self.local[j], by_angle, &mut self.slopes[j]);
            let (element, row) = &self.places[j];
            let top = ELEMENT_DOF / 2 * element;
            for k in (0..=j).filter(|&k| near(k)) {
                let (other, column) = &self.places[k];
                let first = ELEMENT_DOF / 2 * other;
                let (row_slope, column_slope) = (&self.slopes[j], &self.slopes[k]);
                let (row, row_slope) = (row.as_flattened(), row_slope.as_flattened());
                let (mut sum, mut slope) = (0.0, 0.0);
                for a in 0..ELEMENT_DOF {
                    let start = (top + a) * self.width + first;
                    let block = &self.flexibility[start..start + ELEMENT_DOF];
                    let at = product(column, block);
                    sum += row[a] * at;
                    slope += row_slope[a] * at + row[a] * product(column_slope, block);
                }
                for place in [j * balls + k, k * balls + j] {
                    self.contact[place] = sum;
                    self.contact_slope[place] = slope;
                }
            }
        }
    }

    /// Row of ball `j`: radial displacement there for radial forces at all balls, m/N.
    #[inline]
    pub fn contact_row(&self, j: usize) -> &[f64] {
        let balls = self.places.len();
        &self.contact[j * balls..(j + 1) * balls]
    }

    /// The same differentiated by the cage angle, m/(N rad).
    #[inline]
    pub fn contact_slope_row(&self, j: usize) -> &[f64] {
        let balls = self.places.len();
        &self.contact_slope[j * balls..(j + 1) * balls]
    }

    /// Radial displacement at ball `j` under the weight, m.
    #[inline]
    pub fn weight(&self, j: usize) -> f64 {
        self.weight_now[j]
    }

    /// A bound of the displacement under the weight along the raceway, m.
    pub fn weight_bound(&self) -> f64 {
        let components = ELEMENT_DOF / 2;
        let most = |component: usize| {
            let values = self.weight.iter().skip(component).step_by(components);
            values.fold(0.0_f64, |most, value| most.max(value.abs()))
        };
        let bounds = self.interpolation.bounds();
        let interpolated = bounds.as_flattened().iter().take(ELEMENT_DOF).enumerate();
        interpolated
            .map(|(k, bound)| bound * most(k % components))
            .sum()
    }

    /// Row of a sensor over radial forces at all balls, m/N.
    #[inline]
    pub fn sensor_row(&self, sensor: usize) -> &[f64] {
        let balls = self.places.len();
        &self.sensor_now[sensor * balls..(sensor + 1) * balls]
    }
}

/// Polar components of all nodes, the first repeated at the end, from (u_x, u_y, theta)
/// [width x ring dof].
fn polar_components(ring: &Ring, width: usize) -> DenseMatrix {
    let mut polar = DenseMatrix::zeros(width, ring.dof());
    for repeated in 0..width / 3 {
        let node = repeated % ring.nodes();
        let (sin, cos) = ring.node_angle(node).sin_cos();
        let (row, column) = (3 * repeated, 3 * node);
        polar[(row, column)] = -sin;
        polar[(row, column + 1)] = cos;
        polar[(row + 1, column)] = cos;
        polar[(row + 1, column + 1)] = sin;
        polar[(row + 2, column + 2)] = 1.0;
    }
    polar
}

#[inline]
fn product(row: &Row, b: &[f64]) -> f64 {
    row.as_flattened().iter().zip(b).map(|(x, y)| x * y).sum()
}
