//! Linear algebra between the libraries and the mechanics: one sparse type, one dense type, one
//! factorisation, one eigensolver for sparse and one for dense problems.
//!
//! The sparse currency is [`SparseMatrix`] (compressed columns, both triangles stored), the dense
//! one is [`faer::Mat`]. Everything runs sequentially inside a call, so that results do not depend
//! on the number of threads.

#[allow(unsafe_code)]
mod arpack;
mod cholesky;
mod complete;
mod dense;
mod eigen;
mod error;
mod inertia;
mod sparse;

pub use cholesky::SparseCholesky;
pub use dense::{
    DenseCholesky, GeneralSpectrum, SymmetricSpectrum, general_spectrum, symmetric_eigen,
    symmetric_generalised_eigen,
};
pub use eigen::{EigenOptions, EigenPairs, lowest_eigenpairs};
pub use error::LinalgError;
pub use sparse::{
    SparseMatrix, TripletBuilder, congruence, sparse_times_dense, submatrix, transpose_times_dense,
};

/// Dense column-major matrix of `f64`.
pub type DenseMatrix = faer::Mat<f64>;

/// Makes faer run sequentially: sums are then formed in one order whatever the machine.
fn run_sequentially() {
    use std::sync::Once;
    static ONCE: Once = Once::new();
    ONCE.call_once(|| faer::set_global_parallelism(faer::Par::Seq));
}
