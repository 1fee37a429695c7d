//! Modes of a housing, a ring, or both over the free degrees of freedom of their matrices.

use super::{ModalBasis, ModalError, ModeRange, strain_products};
use crate::fe::assembly::{CoupledMatrices, CoupledMotions, SystemMatrices};
use crate::fe::model::HousingModel;
use crate::numerics::linalg::{DenseMatrix, EigenProblem, scattered_rows};
use crate::numerics::{Unwatched, Watch};

/// `Phi^T K Phi` [count x count] of shapes Phi over all rows of coupled matrices [rows x count], element by element.
pub(crate) type Products<'p> = &'p dyn Fn(&CoupledMotions, &DenseMatrix) -> Result<DenseMatrix, ModalError>;

/// Modes of a housing, a ring, or both.
#[derive(Debug)]
pub struct FullModes {
    /// The modes over the free degrees of freedom.
    pub basis: ModalBasis,
    /// What the coordinates mean.
    pub(crate) motions: CoupledMotions,
    /// Rows that are neither fixed nor driven: those that the modes were computed over.
    free: Vec<usize>,
    /// Number of all rows.
    rows: usize,
}

impl FullModes {
    /// Modes over the free rows, at least one; with `products` those near zero by the energies of elements. The matrices are gone
    /// before they are factorised.
    ///
    /// # Errors
    /// [`ModalError::Linalg`], [`ModalError::NoModes`], and what `products` reports.
    pub(crate) fn of(
        matrices: CoupledMatrices,
        range: ModeRange,
        products: Option<Products<'_>>,
        watch: &impl Watch,
    ) -> Result<Self, ModalError> {
        let CoupledMatrices { stiffness, mass, free_dofs: free, motions, ordering } = matrices;
        let rows = mass.rows();
        watch.stage("order");
        let problem = match ordering {
            Some(ordering) => EigenProblem::in_order([&stiffness, &mass], ordering)?,
            None => EigenProblem::restricted(&stiffness, &mass, &free)?,
        };
        drop((stiffness, mass));
        if let Some(choice) = problem.factor_choice() {
            watch.note(&choice.sentence());
        }
        watch.stage("eigen");
        let told = |part| watch.fraction(part);
        let basis = match products {
            None => ModalBasis::told(&problem, range, &told)?,
            Some(products) => {
                let products = |shapes: &DenseMatrix| products(&motions, &scattered_rows(shapes, &free, rows));
                ModalBasis::sharpened(&problem, range, products, &told)?
            }
        };
        match basis.count() {
            0 => Err(ModalError::NoModes { range }),
            _ => Ok(Self { basis, motions, free, rows }),
        }
    }

    /// Computes the modes near zero again by the energies of elements.
    ///
    /// # Errors
    /// What `products` reports, and [`ModalError::Linalg`].
    pub(crate) fn sharpen(&mut self, products: Products<'_>) -> Result<(), ModalError> {
        let Self { basis, motions, free, rows } = self;
        basis.sharpen(|shapes| products(motions, &scattered_rows(shapes, free, *rows)))
    }

    /// Number of degrees of freedom that the modes were computed over.
    pub(crate) fn free_dof(&self) -> usize {
        self.free.len()
    }

    /// Shapes over all rows of the matrices [rows x count].
    pub(crate) fn over_all_rows(&self) -> DenseMatrix {
        scattered_rows(&self.basis.shapes, &self.free, self.rows)
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
    Ok(FullModes::of(matrices, range, Some(&products), &Unwatched)?.basis)
}

impl HousingModel {
    /// Modes of the housing, assembled here: the frequencies of `plummer modes` for the same mesh, materials and supports.
    ///
    /// # Errors
    /// [`ModalError`] of elements, factorisation, iteration or proof; [`ModalError::NoModes`] for a range without any.
    pub fn modes(&self, range: ModeRange) -> Result<ModalBasis, ModalError> {
        housing_modes(self, SystemMatrices::assemble_and_order(self)?, range)
    }
}
