//! Modes of a housing, a ring, or both over the free degrees of freedom of their matrices.

use super::{ModalBasis, ModalError, ModeRange, Participation, strain_products};
use crate::fe::assembly::{CoupledMatrices, CoupledMotions, SystemMatrices};
use crate::fe::model::HousingModel;
use crate::numerics::linalg::{DenseMatrix, EigenProblem, scattered_rows, sparse_times_dense};
use crate::numerics::{Unwatched, Watch};

/// Modes of a housing, a ring, or both.
#[derive(Debug)]
pub struct FullModes {
    /// The modes over the free degrees of freedom.
    pub basis: ModalBasis,
    rows: Rows,
}

/// The rows of coupled matrices, and what they mean.
#[derive(Debug)]
struct Rows {
    motions: CoupledMotions,
    /// Rows that are neither fixed nor driven.
    free: Vec<usize>,
    /// Number of all.
    count: usize,
}

impl Rows {
    /// Shapes over all rows from those over the free ones.
    fn all(&self, shapes: &DenseMatrix) -> DenseMatrix {
        scattered_rows(shapes, &self.free, self.count)
    }
}

impl FullModes {
    /// Modes over the free rows, at least one. The matrices are gone before they are factorised.
    ///
    /// # Errors
    /// [`ModalError::Linalg`], [`ModalError::NoModes`].
    pub(crate) fn of(matrices: CoupledMatrices, range: ModeRange, watch: &impl Watch) -> Result<Self, ModalError> {
        Self::by(matrices, range, |problem, _| Ok(ModalBasis::of(problem, range)?), watch)
    }

    /// Modes with those near zero by the energies of elements. `products` gives `Phi^T K Phi` of shapes over all rows, element by element.
    ///
    /// # Errors
    /// [`ModalError::Linalg`], [`ModalError::NoModes`], and what `products` reports.
    pub(crate) fn sharpened(
        matrices: CoupledMatrices,
        range: ModeRange,
        products: impl Fn(&CoupledMotions, &DenseMatrix) -> Result<DenseMatrix, ModalError>,
        watch: &impl Watch,
    ) -> Result<Self, ModalError> {
        let solve = |problem: &EigenProblem, rows: &Rows| {
            ModalBasis::sharpened(problem, range, |shapes| products(&rows.motions, &rows.all(shapes)))
        };
        Self::by(matrices, range, solve, watch)
    }

    /// Modes as `solve` finds them from the problem over the free rows.
    fn by(
        matrices: CoupledMatrices,
        range: ModeRange,
        solve: impl FnOnce(&EigenProblem, &Rows) -> Result<ModalBasis, ModalError>,
        watch: &impl Watch,
    ) -> Result<Self, ModalError> {
        let CoupledMatrices { stiffness, mass, free_dofs: free, motions } = matrices;
        let rows = Rows { motions, free, count: mass.rows() };
        watch.stage("order");
        let problem = EigenProblem::restricted(&stiffness, &mass, &rows.free)?;
        drop((stiffness, mass));
        watch.stage("eigen");
        let basis = solve(&problem, &rows)?;
        if basis.count() == 0 {
            return Err(ModalError::NoModes { range });
        }
        Ok(Self { basis, rows })
    }

    /// Modes as [`sharpened`](Self::sharpened), their shapes over all rows, and their participation in the unit motions `rigid`.
    ///
    /// # Errors
    /// As [`sharpened`](Self::sharpened).
    pub(crate) fn analysed(
        matrices: CoupledMatrices,
        range: ModeRange,
        rigid: &DenseMatrix,
        products: impl Fn(&CoupledMotions, &DenseMatrix) -> Result<DenseMatrix, ModalError>,
        watch: &impl Watch,
    ) -> Result<(Self, DenseMatrix, Participation), ModalError> {
        let moved = sparse_times_dense(&matrices.mass, rigid);
        let modes = Self::sharpened(matrices, range, products, watch)?;
        let all = modes.over_all_rows();
        let participation = Participation::of_normalised(&moved, &all, rigid)?;
        Ok((modes, all, participation))
    }

    /// The lowest `count` modes, or all if there are fewer.
    ///
    /// # Errors
    /// [`ModalError::Linalg`].
    pub(crate) fn lowest(matrices: CoupledMatrices, count: usize, watch: &impl Watch) -> Result<Self, ModalError> {
        Self::of(matrices, ModeRange::AtMost(count), watch)
    }

    /// Computes the modes near zero again by the energies of elements: `products` as in [`sharpened`](Self::sharpened).
    ///
    /// # Errors
    /// What `products` reports, and [`ModalError::Linalg`].
    pub(crate) fn sharpen(
        &mut self,
        products: impl Fn(&CoupledMotions, &DenseMatrix) -> Result<DenseMatrix, ModalError>,
    ) -> Result<(), ModalError> {
        let rows = &self.rows;
        self.basis.sharpen(|shapes| products(&rows.motions, &rows.all(shapes)))
    }

    /// What the coordinates mean.
    pub(crate) fn motions(&self) -> &CoupledMotions {
        &self.rows.motions
    }

    /// Number of degrees of freedom that the modes were computed over.
    pub(crate) fn free_dof(&self) -> usize {
        self.rows.free.len()
    }

    /// Shapes over all rows of the matrices [rows x count].
    pub(crate) fn over_all_rows(&self) -> DenseMatrix {
        self.rows.all(&self.basis.shapes)
    }
}

/// Modes over the free degrees of freedom, those near zero by the energies of elements: the frequencies of `plummer modes`. Whether
/// the housing is held need not be said.
///
/// # Errors
/// [`ModalError`] of factorisation, iteration, proof or elements; [`ModalError::NoModes`] for a range without any.
pub fn housing_modes(
    model: &HousingModel,
    matrices: SystemMatrices,
    range: ModeRange,
) -> Result<ModalBasis, ModalError> {
    let matrices = CoupledMatrices::of_housing(matrices, model);
    let products = |motions: &CoupledMotions, all: &DenseMatrix| strain_products(model, &motions.housing(model, all));
    Ok(FullModes::sharpened(matrices, range, products, &Unwatched)?.basis)
}

impl HousingModel {
    /// Modes of the housing, assembled here: the frequencies of `plummer modes` for the same mesh, materials and supports.
    ///
    /// # Errors
    /// [`ModalError`] of elements, factorisation, iteration or proof; [`ModalError::NoModes`] for a range without any.
    pub fn modes(&self, range: ModeRange) -> Result<ModalBasis, ModalError> {
        housing_modes(self, SystemMatrices::assemble(self)?, range)
    }
}
