//! Linear algebra between the libraries and the mechanics: one sparse type, one dense type, one
//! factorisation, one eigensolver for sparse problems (block Krylov for the lowest pairs, ARPACK for a band), one for
//! dense ones, and one solver for harmonic loads.
//!
//! The sparse currency is [`SparseMatrix`] (compressed columns, both triangles stored), the dense
//! one is [`faer::Mat`]. Small dense problems run sequentially. A factorisation and its solves share the elimination tree
//! and the large fronts among the threads of the pool, products their columns; results do not depend on the number of threads.
//!
//! **Limitations**: symmetric problems, complex ones for harmonic loads alone; a factor must fit into memory.

#[allow(unsafe_code)]
mod arpack;
mod band;
mod basis;
#[allow(unsafe_code)]
mod blas;
mod bound;
mod cholesky;
mod dense;
mod eigen;
mod error;
mod factor;
mod followers;
mod front;
mod harmonic;
mod idle;
mod launch;
#[allow(unsafe_code)]
mod loaded;
mod lowest;
mod lu;
mod memory;
#[allow(unsafe_code)]
mod metis;
#[cfg(feature = "mumps")]
mod mumps;
mod numeric;
mod ordering;
mod plan;
mod precision;
mod rest;
mod rows;
mod sparse;
mod substitution;
mod symbolic;
mod symmetric;
mod trapezoid;
mod tree;

pub(crate) use basis::times;
pub use cholesky::SparseCholesky;
pub(crate) use dense::symmetric_eigen;
pub use dense::{DenseCholesky, GeneralSpectrum, SymmetricSpectrum, general_spectrum, symmetric_generalised_eigen};
pub use eigen::{CountCheck, EigenPairs, EigenProblem, EigenTimes};
pub use error::LinalgError;
pub(in crate::numerics::linalg) use error::gigabytes;
pub(in crate::numerics::linalg) use factor::{Factor, FactorMemory};
pub(crate) use followers::Followers;
pub(in crate::numerics::linalg) use front::Kind;
pub use harmonic::{
    ComplexSolution, HarmonicDamping, HarmonicError, HarmonicProblem, HarmonicSolution, HarmonicTimes, MotionDamping,
};
pub(crate) use harmonic::{complex_columns, complex_solve};
pub(crate) use idle::{acting_generalised_eigen, acting_motions, congruent};
pub(crate) use launch::launched;
pub(crate) use lu::SmallLu;
#[cfg(feature = "mumps")]
pub(crate) use mumps::abandon;
#[cfg(feature = "mumps-mpi")]
pub(crate) use mumps::{joined, leave};
pub(crate) use ordering::{Ordering, Pattern};
pub use plan::FactorChoice;
pub(in crate::numerics::linalg) use plan::Plan;
pub(crate) use plan::check_asked;
pub use sparse::{SparseMatrix, TripletBuilder, sparse_times_dense, submatrix, transpose_times_dense};
pub(crate) use sparse::{congruence, placed, scattered_rows};
pub(in crate::numerics::linalg) use symmetric::SymmetricMatrix;

/// Dense column-major matrix of `f64`.
pub type DenseMatrix = faer::Mat<f64>;

/// Dense column-major matrix of complex numbers.
pub type ComplexMatrix = faer::Mat<faer::c64>;
