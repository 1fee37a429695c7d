//! Matrices of a case's housing, ring, or both in full, and their modes.

use super::{HousingStage, StageError, StructureStage, Unwatched, Watch};
use crate::assembly::{CoupledMatrices, CoupledMotions};
use crate::case::ModeExtent;
use crate::linalg::{DenseMatrix, EigenProblem, SparseMatrix, TripletBuilder, sparse_times_dense};
use crate::modal::{ModalBasis, ModeRange, Participation};
use crate::model::{Ring, RingTie};

/// Matrices with what the analysis of their modes needs.
pub(super) struct System {
    pub stiffness: SparseMatrix,
    pub mass: SparseMatrix,
    pub free: Vec<usize>,
    pub dof: usize,
}

impl System {
    /// Ring and housing, and what their coordinates mean.
    pub fn coupled(housing: &HousingStage, tie: &RingTie, ring: &Ring) -> (Self, CoupledMotions) {
        let CoupledMatrices {
            stiffness,
            mass,
            free_dofs: free,
            motions,
        } = CoupledMatrices::new(&housing.matrices, tie, ring);
        let system = Self {
            dof: mass.rows(),
            stiffness,
            mass,
            free,
        };
        (system, motions)
    }

    /// A ring alone.
    pub fn of_ring(ring: &Ring) -> Self {
        Self {
            free: (0..ring.dof()).collect(),
            dof: ring.dof(),
            stiffness: sparse(ring.stiffness()),
            mass: sparse(ring.mass()),
        }
    }

    /// Modes over the free rows, and these rows. The matrices are gone before they are factorised.
    fn eigen(
        self,
        extent: ModeExtent,
        watch: &impl Watch,
    ) -> Result<(ModalBasis, Vec<usize>), StageError> {
        let Self {
            stiffness,
            mass,
            free,
            ..
        } = self;
        watch.stage("order");
        let problem = EigenProblem::restricted(&stiffness, &mass, &free)?;
        drop((stiffness, mass));
        watch.stage("eigen");
        let basis = ModalBasis::of(&problem, range(extent, free.len()))?;
        Ok((basis, free))
    }

    /// Modes, their shapes over all rows, and their participation. `products` gives `Phi^T K Phi` of shapes over all
    /// rows, element by element.
    pub fn solve(
        self,
        extent: ModeExtent,
        rigid: &DenseMatrix,
        products: impl Fn(&DenseMatrix) -> Result<DenseMatrix, StageError>,
        watch: &impl Watch,
    ) -> Result<(ModalBasis, DenseMatrix, Participation, usize), StageError> {
        let dof = self.dof;
        let moved = sparse_times_dense(&self.mass, rigid);
        let (mut basis, free) = self.eigen(extent, watch)?;
        let over_all_rows = |shapes: &DenseMatrix| {
            let mut all = DenseMatrix::zeros(dof, shapes.ncols());
            for (row, &at) in free.iter().enumerate() {
                for mode in 0..shapes.ncols() {
                    all[(at, mode)] = shapes[(row, mode)];
                }
            }
            all
        };
        basis.sharpen(|shapes| products(&over_all_rows(shapes)))?;
        let all = over_all_rows(&basis.shapes);
        let participation = Participation::of_normalised(&moved, &all, rigid)?;
        Ok((basis, all, participation, free.len()))
    }
}

/// Frequencies of a ring, in a housing if the case has one, in full: nothing condensed, nothing analysed.
///
/// # Errors
/// [`StageError`] of eigenvalue computation.
pub(super) fn unloaded_modes(
    stage: &StructureStage,
    extent: ModeExtent,
) -> Result<UnloadedModes, StageError> {
    let ring = stage.structure.ring();
    let system = match (&stage.housing, &stage.tie) {
        (Some(housing), Some(tie)) => System::coupled(housing, tie, ring).0,
        _ => System::of_ring(ring),
    };
    let (basis, ..) = system.eigen(extent, &Unwatched)?;
    Ok(UnloadedModes {
        frequencies_hz: basis.frequencies_hz,
        rigid: basis.rigid_modes,
    })
}

/// Frequencies of a model in full.
pub(super) struct UnloadedModes {
    /// Ascending, Hz.
    pub frequencies_hz: Vec<f64>,
    /// How many of the first ones are rigid.
    pub rigid: usize,
}

fn range(extent: ModeExtent, free_dof: usize) -> ModeRange {
    match extent.of_model(free_dof) {
        ModeExtent::Count(count) => ModeRange::Count(count),
        ModeExtent::UpToHz(hz) => ModeRange::UpToHz(hz),
        ModeExtent::BandHz(band) => ModeRange::BandHz(band),
    }
}

/// The entries of a dense matrix that are not zero.
pub(super) fn sparse(dense: &DenseMatrix) -> SparseMatrix {
    let mut entries = TripletBuilder::new(dense.nrows(), dense.ncols());
    for column in 0..dense.ncols() {
        for row in 0..dense.nrows() {
            if dense[(row, column)] != 0.0 {
                entries.add(row, column, dense[(row, column)]);
            }
        }
    }
    entries.build()
}
