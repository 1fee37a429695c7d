//! What can go wrong in a factorisation or an eigenvalue computation.

use std::f64::consts::TAU;
use thiserror::Error;

/// In 10^9 bytes, a digit behind the point, or where that is little in 10^6.
pub(super) fn gigabytes(bytes: u64) -> String {
    if bytes < 100_000_000 {
        format!("{} MB", bytes.div_ceil(1_000_000))
    } else {
        format!("{:.1} GB", bytes as f64 / 1e9)
    }
}

/// Failure of a numerical linear algebra step.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum LinalgError {
    /// A Cholesky factorisation met a pivot that is not positive.
    #[error("the {order} x {order} matrix is not positive definite (pivot {pivot} is not positive)")]
    NotPositiveDefinite {
        /// Number of rows of the matrix.
        order: usize,
        /// Row of the matrix; in an eigenvalue computation, of its factor.
        pivot: usize,
    },
    /// A factorisation ran out of memory or met an internal limit.
    #[error("the sparse factorisation of a {order} x {order} matrix failed: {reason}")]
    Factorisation {
        /// Number of rows of the matrix.
        order: usize,
        /// What the library said.
        reason: &'static str,
    },
    /// A factorisation by another library failed.
    #[error("the factorisation of a {order} x {order} matrix by {by} failed: {reason}")]
    Library {
        /// Number of rows of the matrix.
        order: usize,
        /// Which library, and how it keeps factors.
        by: String,
        /// Why, and what helps.
        reason: String,
    },
    /// A factor that is larger than the memory.
    #[error(
        "the factor of a {order} x {order} matrix has {entries} entries, at least {}: {limit}; expected a coarser mesh, or elements of lower order",
        gigabytes(*bytes)
    )]
    TooLarge {
        /// Number of rows of the matrix.
        order: usize,
        /// Entries of its factor.
        entries: u64,
        /// What they take.
        bytes: u64,
        /// What it was compared with.
        limit: String,
    },
    /// A problem that is too large for the memory or not determined, found before it is solved; a sentence.
    #[error("{0}")]
    Refused(String),
    /// A factorisation went through, but its factor does not solve the system.
    #[error(
        "the {order} x {order} matrix is singular to working precision: iterative refinement with its factor reduces an error only by {contraction:.1e}"
    )]
    NearlySingular {
        /// Number of rows of the matrix.
        order: usize,
        /// Factor by which refinement changes an error.
        contraction: f64,
    },
    /// A factor that solves its system, but to few digits.
    #[error(
        "the {order} x {order} matrix is ill-conditioned: solutions are right to {contraction:.0e} (row {row}), expected {limit:.0e}"
    )]
    IllConditioned {
        /// Number of rows of the matrix.
        order: usize,
        /// Row in which the error is largest.
        row: usize,
        /// Relative error of solutions.
        contraction: f64,
        /// Largest one accepted.
        limit: f64,
    },
    /// Matrices that should fit together do not.
    #[error("{what}: expected {expected} rows, found {found}")]
    Shape {
        /// Which operand.
        what: &'static str,
        /// Rows expected.
        expected: usize,
        /// Rows found.
        found: usize,
    },
    /// More eigenvalues asked for than the problem has.
    #[error("{asked} modes asked for, but the model has only {available} degrees of freedom")]
    TooManyModes {
        /// Number asked for.
        asked: usize,
        /// Order of the matrix.
        available: usize,
    },
    /// Stiffness and mass so far apart that no frequency is a number.
    #[error(
        "no motion of the {order} degrees of freedom has a frequency that can be computed: the largest entries are {stiffness:.1e} N/m of stiffness and {mass:.1e} kg of mass; look at the units of moduli, densities, masses and springs"
    )]
    NoFrequency {
        /// Order of the matrices.
        order: usize,
        /// Largest entry of the stiffness's diagonal.
        stiffness: f64,
        /// Largest entry of the mass's diagonal.
        mass: f64,
    },
    /// An iteration for eigenvalues failed where another way may not, or its modes do not satisfy their equation.
    #[error("{0}")]
    Iteration(String),
    /// A dense eigenvalue computation failed or met values that are not finite.
    #[error("the dense eigenvalue computation of a {order} x {order} matrix failed")]
    DenseEigen {
        /// Number of rows of the matrix.
        order: usize,
    },
}

impl LinalgError {
    /// Eigenvalues in such a crowd that there is no place to count behind the `asked` ones.
    pub(super) fn no_gap(asked: usize) -> Self {
        Self::Iteration(format!(
            "the {asked} modes asked for end in a crowd of equal frequencies, so that they cannot be counted; ask for a \
             few more"
        ))
    }

    /// An iteration that did not converge.
    pub(super) fn not_converged(asked: usize, converged: usize, restarts: usize) -> Self {
        Self::Iteration(format!(
            "the eigenvalue iteration found {converged} of {asked} modes in {restarts} restarts; ask for more modes or fewer"
        ))
    }

    /// Modes that exist below a value (1/s^2), by the inertia of `K - sigma M`, and were not found.
    pub(super) fn missing_modes(below: f64, counted: usize, found: usize) -> Self {
        let below_hz = below.max(0.0).sqrt() / TAU;
        Self::Iteration(format!(
            "the eigenvalue iteration missed modes: {counted} lie below {below_hz:.6e} Hz, {found} were found; ask for a \
             few more modes"
        ))
    }
}
