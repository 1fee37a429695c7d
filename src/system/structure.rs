//! The linear structure that the outer rings of bearings belong to: rings alone, or rings and condensed
//! housing.

use super::SystemError;
use crate::fe::model::{Ring, RingSeat, Rings};
use crate::fe::reduction::Superelement;
use crate::numerics::linalg::{
    DenseCholesky, DenseMatrix, EigenProblem, SparseCholesky, placed, symmetric_generalised_eigen,
};
use std::f64::consts::TAU;
use std::sync::OnceLock;

/// Most coordinates that are solved densely where a part of the modes is enough: a minute's work for all modes.
const LARGEST_DENSE: usize = 1300;

/// Entries of a stiffness, as a divisor of all places, up to which it is factorised as a sparse matrix.
const SPARSE: usize = 10;

/// Smallest pivot of a held structure, relative to its diagonal entry and to the number of rows: a motion without force moves all rows, and
/// round-off of each of them adds to its last pivot. A condensed stiffness has the round-off of the interior's elimination
/// too: 17 eps were seen for a body that turns freely.
const SINGULAR: f64 = 64.0 * f64::EPSILON;

/// Relative error of static responses by a sparse factor above which a structure counts as free.
const LARGEST_CONTRACTION: f64 = 1e-4;

/// A displacement to watch: `row . (ring displacements, housing amplitudes)`.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    /// Its name in results.
    pub name: String,
    /// Row over the structure's coordinates \[dof\], metres per unit of each.
    pub row: Vec<f64>,
}

/// Rings and housing in one pair of matrices; coordinates: displacements of the rings first, one ring after the other (three a node,
/// six in space), then the amplitudes of the housing's fixed-interface modes.
#[derive(Debug, Clone)]
pub struct Structure {
    rings: Rings,
    stiffness: DenseMatrix,
    mass: DenseMatrix,
    gravity: Vec<f64>,
    sensors: Vec<Sensor>,
    /// Factor of the stiffness once it was asked for; `None` in it: the structure is not held.
    factor: OnceLock<Option<StaticFactor>>,
}

/// Factor of the stiffness.
#[derive(Debug, Clone)]
enum StaticFactor {
    Dense(DenseCholesky),
    Sparse(SparseCholesky),
}

/// Modes of a structure: all of them, or the lowest with what they leave out of some static responses.
#[derive(Debug, Clone)]
pub struct StructureModes {
    /// omega^2, 1/s^2, ascending.
    pub squared_frequencies: Vec<f64>,
    /// Mode shapes [dof x modes], `phi^T M phi = 1`.
    pub shapes: DenseMatrix,
    /// Whether the structure has modes above these.
    pub has_more: bool,
}

impl Structure {
    /// A ring, or several, on their own supports.
    ///
    /// `gravity` (m/s^2, along the first ring's x and y) loads the rings' mass.
    pub fn ring_alone(rings: impl Into<Rings>, gravity: [f64; 2]) -> Self {
        let rings = rings.into();
        let (stiffness, mass, load) = (rings.stiffness().clone(), rings.mass().clone(), rings_gravity(&rings, gravity));
        Self::new(rings, [stiffness, mass], load)
    }

    fn new(rings: Rings, [stiffness, mass]: [DenseMatrix; 2], gravity: Vec<f64>) -> Self {
        Self { rings, stiffness, mass, gravity, sensors: Vec::new(), factor: OnceLock::new() }
    }

    /// Rings tied to a condensed housing whose interface is their displacements.
    ///
    /// # Errors
    /// [`SystemError::OtherSize`] if the superelement has another interface.
    pub fn with_housing(
        rings: impl Into<Rings>,
        housing: &Superelement,
        gravity: [f64; 2],
    ) -> Result<Self, SystemError> {
        let rings = rings.into();
        let interface = rings.dof();
        if housing.interface_dof != interface {
            let whose = if rings.seats().len() > 1 { "the rings have" } else { "the ring has" };
            return Err(SystemError::OtherSize(format!(
                "{whose} {interface} degrees of freedom, the superelement's interface {}",
                housing.interface_dof
            )));
        }
        let with_rings = |housing: &DenseMatrix, rings: &DenseMatrix| {
            let mut sum = housing.clone();
            let mut interface = sum.submatrix_mut(0, 0, interface, interface);
            interface += rings;
            sum
        };
        let mut load = housing.gravity_load(gravity);
        for (total, own) in load.iter_mut().zip(rings_gravity(&rings, gravity)) {
            *total += own;
        }
        let stiffness = with_rings(&housing.stiffness, rings.stiffness());
        let mass = with_rings(&housing.mass, rings.mass());
        Ok(Self::new(rings, [stiffness, mass], load))
    }

    /// Adds a sensor.
    ///
    /// # Errors
    /// [`SystemError::OtherSize`] if its row has another length than the coordinates.
    pub fn add_sensor(&mut self, sensor: Sensor) -> Result<(), SystemError> {
        if sensor.row.len() != self.dof() {
            let (name, found) = (sensor.name, sensor.row.len());
            let what = format!("sensor {name}: {} coordinates expected, {found} found", self.dof());
            return Err(SystemError::OtherSize(what));
        }
        self.sensors.push(sensor);
        Ok(())
    }

    /// A sensor on the first ring at an angle (rad) in a direction of the plane, at the node radius.
    pub fn ring_sensor(&self, name: &str, angle: f64, [x, y]: [f64; 2]) -> Sensor {
        let mut row = vec![0.0; self.dof()];
        for (dof, factor) in self.ring().displacement_row(angle, [x, y, 0.0]) {
            row[dof] += factor;
        }
        Sensor { name: name.to_owned(), row }
    }

    /// Number of coordinates.
    pub fn dof(&self) -> usize {
        self.stiffness.nrows()
    }

    /// The ring of the only bearing, or of the first; its coordinates are the first ones.
    pub fn ring(&self) -> &Ring {
        &self.rings.first().ring
    }

    /// All rings.
    pub fn rings(&self) -> &Rings {
        &self.rings
    }

    /// Sensors in the order they were added.
    pub fn sensors(&self) -> &[Sensor] {
        &self.sensors
    }

    /// Mean of the first ring's nodes' displacement in x and y, of a column of displacements [dof x k], m.
    pub(super) fn ring_mean(&self, displacements: &DenseMatrix, column: usize) -> [f64; 2] {
        let nodes = self.ring().nodes();
        let sum =
            |component: usize| -> f64 { (0..nodes).map(|node| displacements[(3 * node + component, column)]).sum() };
        [0, 1].map(|component| sum(component) / nodes as f64)
    }

    /// Stiffness [dof x dof].
    pub fn stiffness(&self) -> &DenseMatrix {
        &self.stiffness
    }

    /// Mass [dof x dof].
    pub fn mass(&self) -> &DenseMatrix {
        &self.mass
    }

    /// Weight of rings and housing on the coordinates \[dof\], N and N m.
    pub fn gravity(&self) -> &[f64] {
        &self.gravity
    }

    /// All modes, by a dense solver.
    ///
    /// # Errors
    /// What the eigenvalue computation reports.
    pub fn modes(&self) -> Result<StructureModes, SystemError> {
        let spectrum = symmetric_generalised_eigen(&self.stiffness, &self.mass)?;
        Ok(StructureModes { squared_frequencies: spectrum.values, shapes: spectrum.vectors, has_more: false })
    }

    /// The lowest `count` modes of a large structure, by the solver for sparse problems; all of one with few coordinates.
    ///
    /// # Errors
    /// What the eigenvalue computation reports.
    pub fn lowest_modes(&self, count: usize) -> Result<StructureModes, SystemError> {
        let order = self.dof();
        if order <= LARGEST_DENSE.max(count) {
            return self.modes();
        }
        let [k, m] = [&self.stiffness, &self.mass].map(|matrix| placed(matrix, 0, order));
        let pairs = EigenProblem::new(&k, &m)?.lowest(count)?;
        Ok(StructureModes { squared_frequencies: pairs.values, shapes: pairs.vectors, has_more: true })
    }

    /// Static responses `K^-1 B`.
    ///
    /// # Errors
    /// [`SystemError::Refused`] if the structure can move without force.
    pub fn static_response(&self, loads: &DenseMatrix) -> Result<DenseMatrix, SystemError> {
        match self.factor.get_or_init(|| self.factorised()) {
            Some(StaticFactor::Dense(factor)) => Ok(factor.solve(loads)),
            Some(StaticFactor::Sparse(factor)) => {
                let mut response = loads.clone();
                factor.solve_columns(&mut response)?;
                Ok(response)
            }
            None => Err(SystemError::Refused(
                "ring and housing are not held: they can move without force; add springs or fixed nodes under [housing] supports or [ring] supports",
            )),
        }
    }

    /// `None` for a free structure, which may slip through the factorisation with pivots of round-off size.
    fn factorised(&self) -> Option<StaticFactor> {
        let order = self.dof();
        if order > LARGEST_DENSE {
            let sparse = placed(&self.stiffness, 0, order);
            if sparse.nnz() < order * order / SPARSE {
                let factor = SparseCholesky::new(&sparse).ok();
                return factor.filter(|factor| factor.contraction() <= LARGEST_CONTRACTION).map(StaticFactor::Sparse);
            }
        }
        DenseCholesky::new(&self.stiffness)
            .ok()
            .filter(|factor| factor.reciprocal_condition() >= SINGULAR * order as f64)
            .map(StaticFactor::Dense)
    }
}

impl StructureModes {
    /// Number of modes.
    pub fn count(&self) -> usize {
        self.squared_frequencies.len()
    }

    /// The lowest of them.
    pub(crate) fn lowest(&self, kept: usize) -> Self {
        Self {
            squared_frequencies: self.squared_frequencies[..kept].to_vec(),
            shapes: self.shapes.subcols(0, kept).to_owned(),
            has_more: self.has_more || kept < self.count(),
        }
    }

    /// The modes below `hz`, and what they leave out of the static response to `loads` [dof x k], as k modes more: a basis
    /// in which a linear coupling through these loads is felt as with all modes, up to terms of order (f / hz)^4.
    ///
    /// # Errors
    /// [`SystemError::Refused`] for a structure that is not held; what the eigenvalue computation reports.
    pub fn with_static_response(
        &self,
        structure: &Structure,
        hz: f64,
        loads: &DenseMatrix,
    ) -> Result<Self, SystemError> {
        let limit = (TAU * hz).powi(2);
        let kept = self.squared_frequencies.partition_point(|&square| square < limit);
        let lowest = self.shapes.subcols(0, kept);
        let parts = lowest.transpose() * loads;
        let amplitudes = DenseMatrix::from_fn(kept, loads.ncols(), |mode, load| {
            parts[(mode, load)] / self.squared_frequencies[mode]
        });
        let residual = structure.static_response(loads)? - lowest * amplitudes;
        // orthogonal to the modes kept, in stiffness and in mass, so that its own modes can stand beside them
        let k = residual.transpose() * (structure.stiffness() * &residual);
        let m = residual.transpose() * (structure.mass() * &residual);
        let own = symmetric_generalised_eigen(&k, &m)?;
        let mut squares = self.squared_frequencies[..kept].to_vec();
        squares.extend(&own.values);
        let shapes = faer::concat![[lowest, &residual * &own.vectors]];
        Ok(Self { has_more: false, squared_frequencies: squares, shapes })
    }

    /// Frequency of a mode, Hz; rigid ones within round-off of zero.
    pub fn frequency_hz(&self, mode: usize) -> f64 {
        self.squared_frequencies[mode].max(0.0).sqrt() / TAU
    }

    /// `phi_mode . row`.
    pub fn participation(&self, mode: usize, row: &[f64]) -> f64 {
        self.shapes.col(mode).iter().zip(row).map(|(shape, factor)| shape * factor).sum()
    }
}

/// Weight of all rings on their coordinates, N and N m; `gravity` along the first ring's x and y.
fn rings_gravity(rings: &Rings, [x, y]: [f64; 2]) -> Vec<f64> {
    let down = rings.first().frame.vector_to_mesh([x, y, 0.0]);
    let of_seat = |seat: &RingSeat| {
        let along = if seat.first == 0 { [x, y, 0.0] } else { seat.frame.vector(down) };
        let fall = seat.ring.rigid_motion_in_space(along, [0.0; 3]);
        let fall = DenseMatrix::from_fn(fall.len(), 1, |row, _| fall[row]);
        (seat.ring.mass() * fall).col(0).iter().copied().collect::<Vec<_>>()
    };
    rings.seats().iter().flat_map(of_seat).collect()
}

#[cfg(test)]
mod tests {
    use super::super::force::tangent_tests::structure_of;
    use super::*;

    /// A ring just beyond what is solved densely: its equations hold, and it knows that it has more modes.
    #[test]
    fn a_ring_of_many_nodes_has_its_lowest_modes_and_its_static_response() {
        let structure = structure_of(LARGEST_DENSE / 3 + 1);
        let modes = structure.lowest_modes(20).unwrap();
        assert!(modes.has_more && modes.count() == 20);
        let (stiff, heavy) = (structure.stiffness() * &modes.shapes, structure.mass() * &modes.shapes);
        for mode in 0..20 {
            let square = modes.squared_frequencies[mode];
            let rest = stiff.col(mode) - heavy.col(mode) * faer::Scale(square);
            // the iteration's own limit
            assert!(rest.norm_l2() < 1e-5 * stiff.col(mode).norm_l2(), "{mode}");
        }
        let load = DenseMatrix::from_fn(structure.dof(), 1, |row, _| f64::from(u8::from(row == 7)));
        let response = structure.static_response(&load).unwrap();
        assert!(matches!(structure.factor.get(), Some(Some(StaticFactor::Sparse(_)))));
        let rest = structure.stiffness() * &response - &load;
        // stiffness of an element times the displacement, 1e9 N/m and 1e-6 m, in the last digits
        assert!(rest.norm_max() < 1e-9, "{:e}", rest.norm_max());
        // a structure that is small enough has all
        let small = structure_of(24).lowest_modes(20).unwrap();
        assert!(!small.has_more && small.count() == 72);
    }
}
