//! What can go wrong in a factorisation or an eigenvalue computation.

use thiserror::Error;

/// What a factor exceeds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum FactorLimit {
    /// Memory.
    #[error("{} GB of memory are free", gigabytes(*.free))]
    Memory {
        /// Memory that the system can give, in bytes.
        free: u64,
    },
    /// Places that 32 bits can count.
    #[error("more than 2^31 entries cannot be counted")]
    Places,
}

/// In 10^9 bytes, a digit behind the point.
fn gigabytes(bytes: u64) -> String {
    format!("{:.1}", bytes as f64 / 1e9)
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
    /// A matrix that should be positive definite has negative eigenvalues.
    #[error("the {order} x {order} matrix is not positive definite: {negative} of its eigenvalues are negative")]
    Indefinite {
        /// Number of rows of the matrix.
        order: usize,
        /// How many.
        negative: usize,
    },
    /// A factorisation ran out of memory or met an internal limit.
    #[error("the sparse factorisation of a {order} x {order} matrix failed: {reason}")]
    Factorisation {
        /// Number of rows of the matrix.
        order: usize,
        /// What the library said.
        reason: &'static str,
    },
    /// A factor that is too large, found before it is computed.
    #[error(
        "the factor of a {order} x {order} matrix has {entries} entries, at least {} GB: {limit}; expected a coarser mesh, or elements of lower order",
        gigabytes(*.bytes)
    )]
    TooLarge {
        /// Number of rows of the matrix.
        order: usize,
        /// Entries of the factor that are not zero.
        entries: u64,
        /// Memory that it takes at least, in bytes.
        bytes: u64,
        /// What it exceeds.
        limit: FactorLimit,
    },
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
    /// Eigenvalues in such a crowd that there is no place to count.
    #[error(
        "the {asked} modes asked for end in a crowd of equal frequencies, so that they cannot be counted; ask for a few more"
    )]
    NoGap {
        /// Number asked for.
        asked: usize,
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
    /// A degree of freedom with neither stiffness nor mass.
    #[error(
        "row {row} of stiffness and mass is empty: this degree of freedom is held by nothing and carries nothing, so that its motion is not determined; leave it out or hold it"
    )]
    NothingThere {
        /// Its row in the matrices given.
        row: usize,
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
    /// More modes than there is memory for.
    #[error(
        "{asked} modes of {order} degrees of freedom take at least {} GB, {} GB of memory are free; ask for fewer modes",
        gigabytes(*.bytes), gigabytes(*.free)
    )]
    ModesTooLarge {
        /// Number asked for.
        asked: usize,
        /// Order of the matrix.
        order: usize,
        /// Memory that they take at least, in bytes.
        bytes: u64,
        /// Memory that the system can give, in bytes.
        free: u64,
    },
    /// An iteration did not converge.
    #[error(
        "the eigenvalue iteration found {converged} of {asked} modes in {restarts} restarts; ask for more modes or fewer"
    )]
    NotConverged {
        /// Number asked for.
        asked: usize,
        /// Number that converged.
        converged: usize,
        /// Restarts made.
        restarts: usize,
    },
    /// Modes that exist and were not found.
    #[error(
        "the eigenvalue iteration missed modes: {counted} lie below {below_hz:.6e} Hz, {found} were found; ask for a few more modes"
    )]
    MissingModes {
        /// Frequency up to which was counted, Hz.
        below_hz: f64,
        /// Number of modes below it, from the inertia of `K - sigma M`.
        counted: usize,
        /// Number found.
        found: usize,
    },
    /// Modes that do not satisfy their equation.
    #[error(
        "mode {mode} leaves a relative residual of {residual:.3e} in its eigenvalue equation, more than {limit:.0e}: the matrices are too ill-conditioned"
    )]
    Residual {
        /// Which mode, from 0.
        mode: usize,
        /// Its residual.
        residual: f64,
        /// Largest residual accepted.
        limit: f64,
    },
    /// ARPACK refused its input; an error of this program.
    #[error("ARPACK routine {routine} returned info = {info}")]
    Arpack {
        /// Name of the routine.
        routine: &'static str,
        /// Its error code.
        info: i32,
    },
    /// A dense eigenvalue computation failed or met values that are not finite.
    #[error("the dense eigenvalue computation of a {order} x {order} matrix failed")]
    DenseEigen {
        /// Number of rows of the matrix.
        order: usize,
    },
}

impl LinalgError {
    /// Whether an iteration failed where another way may not.
    pub(super) fn is_of_iteration(&self) -> bool {
        matches!(
            self,
            Self::NotConverged { .. }
                | Self::MissingModes { .. }
                | Self::NoGap { .. }
                | Self::Residual { .. }
                | Self::Arpack { .. }
        )
    }
}
