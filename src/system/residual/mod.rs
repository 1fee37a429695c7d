//! Static residual of the modes left out: what they would give at the contacts and at the sensors
//! if they had no mass.
//!
//! `G = N (K^-1 - sum phi phi^T / omega^2) N^T` over the kept modes (Craig 1981, Structural
//! Dynamics, section 11.3: mode-acceleration correction). The flexibility is stored over the polar
//! components of the ring's nodes, in which all elements share one interpolation: a pair of balls
//! costs one product of two six-vectors with a block of it. Balls stand at equal spacing, so that the cage angle decides all
//! of it, and the hot loop takes it from quintics in that angle ([`Coupling`]).

mod coupling;

use super::raceway::RacewayTable;
use super::{Structure, StructureModes, SystemError};
use crate::fe::model::Ring;
use crate::numerics::lanes::{LANES, Lanes};
use crate::numerics::linalg::{DenseMatrix, SparseMatrix, TripletBuilder, sparse_times_dense};
use std::f64::consts::TAU;

pub(super) use coupling::Coupling;

/// Components of an element's two nodes.
const ELEMENT_DOF: usize = 6;

/// Residual flexibility on the ring's displacements.
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
}

/// The radial interpolation at a place over an element's components, filled up.
type Row = [Lanes; ELEMENT_DOF.div_ceil(LANES)];

/// Where a ball meets the ring.
#[derive(Debug, Clone, Copy)]
struct Touch {
    element: usize,
    row: Row,
    /// Its derivative by the angle, 1/rad.
    slope: Row,
}

impl ResidualFlexibility {
    /// # Errors
    /// [`SystemError::Refused`] if the structure is free.
    pub(super) fn new(structure: &Structure, modes: &StructureModes, kept: usize) -> Result<Self, SystemError> {
        let (dof, ring) = (structure.dof(), structure.ring());
        let ring_dof = ring.dof();
        let loads = DenseMatrix::from_fn(dof, ring_dof + 1, |i, j| {
            if j == ring_dof { structure.gravity()[i] } else { f64::from(u8::from(i == j)) }
        });
        let mut response = structure.static_response(&loads)?;
        for mode in 0..kept {
            let shape = modes.shapes.col(mode);
            let softness = 1.0 / modes.squared_frequencies[mode];
            let pull = modes.participation(mode, structure.gravity());
            let of_shape = (0..ring_dof).map(|column| shape[column]).chain([pull]);
            for (column, part) in of_shape.enumerate() {
                let response = response.col_as_slice_mut(column).iter_mut();
                for (entry, moved) in response.zip(shape.iter()) {
                    *entry -= softness * moved * part;
                }
            }
        }
        let sensors = structure.sensors();
        let sensor_rows = DenseMatrix::from_fn(sensors.len(), dof, |sensor, row| sensors[sensor].row[row])
            * response.subcols(0, ring_dof);
        let width = ring_dof + ELEMENT_DOF / 2;
        let polar = polar_components(ring, width);
        let on_ring = response.subrows(0, ring_dof);
        let of_displacements = sparse_times_dense(&polar, &on_ring.to_owned());
        let weight = of_displacements.col_as_slice(ring_dof).to_vec();
        // over loads, row by row
        let by_rows = |over_ring: faer::MatRef<'_, f64>| -> Vec<f64> {
            let polar = sparse_times_dense(&polar, &over_ring.transpose().to_owned());
            (0..polar.ncols()).flat_map(|row| polar.col_as_slice(row)).copied().collect()
        };
        Ok(Self {
            elements: ring.nodes(),
            interpolation: RacewayTable::of_interpolation(ring),
            width,
            flexibility: by_rows(of_displacements.subcols(0, ring_dof)),
            weight,
            sensors: by_rows(sensor_rows.as_ref()),
        })
    }

    /// A place in an element, `inside` from 0 to 1.
    fn touch(&self, element: usize, inside: f64) -> Touch {
        // elements, each a turn of the interpolation, in a radian
        let by_angle = self.elements as f64 / TAU;
        let at = self.interpolation.locate(&[inside; LANES]).get(0);
        let mut touch = Touch { element, row: Row::default(), slope: Row::default() };
        self.interpolation.values_into(at, &Row::default(), touch.row.iter_mut());
        self.interpolation.slopes_into(at, by_angle, &mut touch.slope);
        touch
    }

    /// Radial displacement at one place for a radial force at another, m/N, and its derivative while both turn, m/(N rad).
    fn between(&self, at: &Touch, force: &Touch) -> [f64; 2] {
        let (top, first) = (ELEMENT_DOF / 2 * at.element, ELEMENT_DOF / 2 * force.element);
        let mut sums = [0.0; 2];
        let (rows, slopes) = (at.row.as_flattened(), at.slope.as_flattened());
        for (a, (row, slope)) in rows.iter().zip(slopes).take(ELEMENT_DOF).enumerate() {
            let start = (top + a) * self.width + first;
            let block = &self.flexibility[start..start + ELEMENT_DOF];
            let under = product(&force.row, block);
            sums[0] += row * under;
            sums[1] += slope * under + row * product(&force.slope, block);
        }
        sums
    }

    /// A row over ring loads at a place, and its derivative by the angle.
    fn along(&self, over_ring: &[f64], at: &Touch) -> [f64; 2] {
        let first = ELEMENT_DOF / 2 * at.element;
        let block = &over_ring[first..first + ELEMENT_DOF];
        [product(&at.row, block), product(&at.slope, block)]
    }

    /// A bound of the displacement under the weight along the raceway, m.
    pub(super) fn weight_bound(&self) -> f64 {
        let components = ELEMENT_DOF / 2;
        let most = |component: usize| {
            let values = self.weight.iter().skip(component).step_by(components);
            values.fold(0.0_f64, |most, value| most.max(value.abs()))
        };
        let bounds = self.interpolation.bounds();
        let interpolated = bounds.as_flattened().iter().take(ELEMENT_DOF).enumerate();
        interpolated.map(|(k, bound)| bound * most(k % components)).sum()
    }
}

/// Polar components of all nodes, the first repeated at the end, from (u_x, u_y, theta)
/// [width x ring dof].
fn polar_components(ring: &Ring, width: usize) -> SparseMatrix {
    let mut polar = TripletBuilder::new(width, ring.dof());
    for repeated in 0..width / 3 {
        let node = repeated % ring.nodes();
        let (sin, cos) = ring.node_angle(node).sin_cos();
        let (row, column) = (3 * repeated, 3 * node);
        for (down, across, value) in [(0, 0, -sin), (0, 1, cos), (1, 0, cos), (1, 1, sin), (2, 2, 1.0)] {
            polar.add(row + down, column + across, value);
        }
    }
    polar.build()
}

fn product(row: &Row, b: &[f64]) -> f64 {
    row.as_flattened().iter().zip(b).map(|(x, y)| x * y).sum()
}
