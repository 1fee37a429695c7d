//! What the interior of a condensed housing would still move, in statics, under forces that its basis does not carry.
//!
//! The basis Q carries the part `Q diag(1/values) Q^T` of the interior's static response to forces F; the rest, the residual
//! flexibility of what is left out (MacNeal, Computers and Structures 1 (1971) 581-601), is
//!
//! ```text
//! W = (K_ii^-1 - Q diag(1/values) Q^T) F
//! ```
//!
//! Moving with coordinates p, the interior needs the forces `w^2 B p - i S p`: its inertia, `B = [A, M_ii Q]`, and the losses
//! of its material, S those of the structural stiffness.

use super::{InteriorBasis, ReductionError, Substructure};
use crate::numerics::linalg::DenseMatrix;
use faer::c64;

/// Share of the first eigenvalue left out up to which the rest of the series is summed: nearer to it, or above, that sum
/// says nothing.
const NEAREST: f64 = 0.9;

/// Strain energy of W beside that of what the basis carries, below which it is round-off.
const CARRIED: f64 = 1e-20;

/// Residual flexibility for some forces on the interior, in columns [interior x k].
#[derive(Debug, Clone)]
pub struct ResidualFlexibility {
    /// W [interior x k].
    pub(super) moved: DenseMatrix,
    /// `W^T K_ii W` [k x k].
    pub(super) flexibility: DenseMatrix,
    /// `W^T M_ii W` [k x k].
    pub(super) inertia: DenseMatrix,
    complete_below: f64,
}

impl ResidualFlexibility {
    /// For forces F [interior x k].
    ///
    /// # Errors
    /// [`ReductionError::Linalg`].
    pub fn new(
        substructure: &Substructure,
        basis: &InteriorBasis,
        forces: DenseMatrix,
    ) -> Result<Self, ReductionError> {
        let mut carried = basis.vectors.transpose() * &forces;
        for column in 0..carried.ncols() {
            let entries = carried.col_as_slice_mut(column).iter_mut();
            entries.zip(basis.values()).for_each(|(entry, value)| *entry /= value);
        }
        // W
        let mut moved = substructure.solve_interior(forces)? - &basis.vectors * &carried;
        let mut flexibility = moved.transpose() * substructure.interior.stiffness_times(&moved);
        for column in 0..moved.ncols() {
            let entries = carried.col_as_slice(column).iter().zip(basis.values());
            let energy: f64 = entries.map(|(entry, value)| entry * entry * value).sum();
            if flexibility[(column, column)] <= CARRIED * energy {
                moved.col_mut(column).fill(0.0);
                flexibility.col_mut(column).fill(0.0);
                flexibility.row_mut(column).fill(0.0);
            }
        }
        Ok(Self {
            inertia: moved.transpose() * substructure.interior.mass_times(&moved),
            flexibility,
            moved,
            complete_below: basis.complete_below,
        })
    }

    /// What a response lacks at a squared angular frequency lambda (1/s^2), from amplitudes l of the forces in the
    /// residual of the response to the load, and s in that of the response to a unit force at the sensor:
    ///
    /// ```text
    /// e = s^T (G_0 + lambda / (1 - lambda / lambda_cut) G_1) l
    /// ```
    ///
    /// with `G_0 = W^T K_ii W`, `G_1 = W^T M_ii W` and `lambda_cut` that of the first fixed-interface mode left out: a
    /// geometric series from its second term on. Damping of what is left out is neglected.
    pub(crate) fn missing(&self, squared: f64, load: &[c64], sensor: &[c64]) -> c64 {
        let ratio = (squared / self.complete_below).min(NEAREST);
        let further = squared / (1.0 - ratio);
        let mut sum = c64::new(0.0, 0.0);
        for (column, &load) in load.iter().enumerate() {
            let entry = |row: usize| self.flexibility[(row, column)] + further * self.inertia[(row, column)];
            let pulled: c64 = sensor.iter().enumerate().map(|(row, &sensor)| sensor * entry(row)).sum();
            sum += pulled * load;
        }
        sum
    }
}
