//! Symmetry, definiteness and block structure of a superelement's matrices.
//!
//! A check with its limit.

use super::{ReductionError, Superelement};
use crate::numerics::linalg::{DenseMatrix, acting_motions, congruent, symmetric_eigen};
use schemars::JsonSchema;
use serde::Serialize;

/// Asymmetry: matrices are symmetrised when they are made, and files keep 16 digits.
const SYMMETRY: f64 = 1e-12;

/// Smallest eigenvalue of a matrix scaled to a unit diagonal that is not round-off of its entries (1e-16 times an order
/// of a few hundred).
const DEFINITE: f64 = 1e-13;

/// Negative eigenvalues of a stiffness that is singular by its rigid motions are round-off of its entries; what is
/// computed through a factor of condition 1e6 keeps ten digits.
const SEMIDEFINITE: f64 = -1e-9;

/// What stands in a block that is zero in theory, and how far from one a unit diagonal is: the products of computed
/// modes, of which residuals are below 1e-5 and errors of orthogonality below the square of that.
const BLOCK: f64 = 1e-8;

/// Checks of the matrices alone: they hold for a superelement from anywhere. `made_of` is what the interface's stiffness was summed
/// from, where it is known.
///
/// # Errors
/// What the dense eigenvalue solver reports.
pub(crate) fn check_matrices(element: &Superelement, made_of: Option<&[f64]>) -> Result<Vec<Check>, ReductionError> {
    let (k, m) = (&element.stiffness, &element.mass);
    let (b, n) = (element.interface_dof, element.order());
    let references = references(element, made_of);
    let lowest_k = symmetric_eigen(&scaled(k, &references))?;
    let acting = acting_motions(k, m)?;
    let lowest_m = match &acting {
        Some(basis) => symmetric_eigen(&unit_diagonal(&congruent(m, basis)))?,
        None => symmetric_eigen(&unit_diagonal(m))?,
    };
    let idle = acting.map_or(0, |basis| n - basis.ncols());
    let first = |values: &[f64]| values.first().copied().unwrap_or(1.0);
    let root = |row: usize, column: usize| (references[row] * references[column]).sqrt();
    let modal = b..n;
    let coupling = modal.clone().flat_map(|q| (0..b).map(move |row| (row, q)));
    let coupling = largest(coupling.map(|(row, q)| k[(row, q)] / root(row, q)));
    let unit = largest(pairs(n - b).map(|(p, q)| m[(b + p, b + q)] - f64::from(u8::from(p == q))));
    let diagonal = modal.clone().flat_map(|q| (b..q).map(move |p| (p, q)));
    let diagonal = largest(diagonal.map(|(p, q)| k[(p, q)] / root(p, q)));
    Ok(vec![
        Check::at_most("stiffness symmetry", "largest |k - k^T| / largest |k|", asymmetry(k), SYMMETRY),
        Check::at_most("mass symmetry", "largest |m - m^T| / largest |m|", asymmetry(m), SYMMETRY),
        Check::at_least(
            "stiffness semidefinite",
            "lowest eigenvalue of k, relative to the stiffness that it is made of",
            first(&lowest_k.values),
            SEMIDEFINITE,
        ),
        Check::at_least(
            "mass definite",
            match idle {
                0 => "lowest eigenvalue of m scaled to a unit diagonal".to_owned(),
                _ => format!(
                    "lowest eigenvalue of m scaled to a unit diagonal, without {idle} motions that have neither stiffness nor mass"
                ),
            },
            first(&lowest_m.values),
            DEFINITE,
        ),
        Check::at_most(
            "k_bq = 0",
            "largest stiffness between interface and modal amplitudes, relative to both diagonals",
            coupling,
            BLOCK,
        ),
        Check::at_most(
            "k_qq diagonal",
            "largest stiffness between modal amplitudes, relative to both diagonals",
            diagonal,
            BLOCK,
        ),
        Check::at_most("m_qq = 1", "largest |m_qq - 1|", unit, BLOCK),
    ])
}

/// What each row of k is measured by: its diagonal, but at the interface no less than what it was summed from. Of a file, where
/// that is not known, it is the inertia at the lowest fixed-interface frequency: k_bb of a free body on one node is round-off.
fn references(element: &Superelement, made_of: Option<&[f64]>) -> Vec<f64> {
    let (k, m) = (&element.stiffness, &element.mass);
    let b = element.interface_dof;
    let lowest = (b..element.order()).map(|row| k[(row, row)]).reduce(f64::min).unwrap_or(0.0);
    let of = |row: usize| {
        let least = match made_of {
            _ if row >= b => 0.0,
            Some(made_of) => made_of[row],
            None => lowest * m[(row, row)],
        };
        let reference = k[(row, row)].max(least);
        if reference > 0.0 { reference } else { 1.0 }
    };
    (0..element.order()).map(of).collect()
}

/// Places of a square matrix, column by column.
pub(super) fn pairs(order: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..order).flat_map(move |column| (0..order).map(move |row| (row, column)))
}

/// Largest magnitude; not a number if one of them is none.
pub(super) fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |largest: f64, value| if value.is_nan() { value } else { largest.max(value.abs()) })
}

fn asymmetry(a: &DenseMatrix) -> f64 {
    let scale = a.norm_max();
    let pairs = (0..a.ncols()).flat_map(|column| (0..column).map(move |row| (row, column)));
    let found = largest(pairs.map(|(row, column)| a[(row, column)] - a[(column, row)]));
    if scale > 0.0 { found / scale } else { found }
}

/// `D A D` with a unit diagonal; a row without a diagonal stays as it is.
fn unit_diagonal(a: &DenseMatrix) -> DenseMatrix {
    let diagonal = (0..a.nrows()).map(|row| a[(row, row)]);
    let references: Vec<f64> = diagonal.map(|diagonal| if diagonal > 0.0 { diagonal } else { 1.0 }).collect();
    scaled(a, &references)
}

/// `D A D`, symmetric, D the inverse roots of some references.
fn scaled(a: &DenseMatrix, references: &[f64]) -> DenseMatrix {
    DenseMatrix::from_fn(a.nrows(), a.ncols(), |row, column| {
        0.5 * (a[(row, column)] + a[(column, row)]) / (references[row] * references[column]).sqrt()
    })
}

/// Which side of its limit a value should be on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub enum Bound {
    /// Good up to the limit.
    #[serde(rename = "at most")]
    AtMost,
    /// Good from the limit on.
    #[serde(rename = "at least")]
    AtLeast,
}

/// A check and its verdict.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Check {
    /// Short name.
    pub name: &'static str,
    /// What the value is.
    pub what: String,
    /// What was found, relative to what `what` says.
    #[schemars(with = "Option<f64>")]
    pub value: f64,
    /// What passes.
    pub limit: f64,
    /// On which side of the limit.
    pub bound: Bound,
}

impl Check {
    /// A value that is good up to its limit.
    pub(crate) fn at_most(name: &'static str, what: impl Into<String>, value: f64, limit: f64) -> Self {
        Self { name, what: what.into(), value, limit, bound: Bound::AtMost }
    }

    /// A value that is good from its limit on.
    pub(crate) fn at_least(name: &'static str, what: impl Into<String>, value: f64, limit: f64) -> Self {
        Self { bound: Bound::AtLeast, ..Self::at_most(name, what, value, limit) }
    }

    /// Whether it passes; a value that is no number does not.
    pub fn ok(&self) -> bool {
        match self.bound {
            Bound::AtMost => self.value <= self.limit,
            Bound::AtLeast => self.value >= self.limit,
        }
    }
}
