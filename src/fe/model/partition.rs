//! How the degrees of freedom of a housing split.

use crate::numerics::linalg::SparseMatrix;

/// Degrees of freedom of a housing seen from its interface.
#[derive(Debug, Clone)]
pub struct HousingPartition {
    /// Degrees of freedom that the tie drives.
    pub driven: Vec<usize>,
    /// Degrees of freedom that stay free, neither driven nor fixed, ascending.
    pub interior: Vec<usize>,
    /// T: displacements of `driven` from the interface coordinates [driven x interface].
    pub tie: SparseMatrix,
}
