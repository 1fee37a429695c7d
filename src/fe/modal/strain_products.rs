//! Strain energy of shapes, and between shapes, without the round-off of an assembled matrix.
//!
//! Springs on several displacements as single springs, each on one combination of them.
//!
//! One element at a time: its matrices, and its displacements less their rigid part.

use super::error::{ModalError, check_count};
use crate::fe::element::continuum::{MAX_NODES, mass_into, stiffness_into};
use crate::fe::model::{HousingElement, HousingModel, ModelError};
use crate::numerics::linalg::DenseMatrix;
use nalgebra::{DMatrix, Matrix3, Vector3};
use rayon::prelude::*;

/// `Phi^T K Phi` [count x count] of shapes Phi [dof x count] over all degrees of freedom of a housing, tied nodes
/// filled in.
///
/// The sum of `phi_e^T K_e phi_e` over the elements, each without its rigid part, and of `k (row . phi)^2` over the
/// springs. An assembled K leaves `eps |K| |phi|^2` of a rigid motion, this the square of eps: what strains
/// nothing is told from what hangs on a support, however soft. In parallel; the result is the same to the bit for any
/// number of threads.
///
/// # Errors
/// [`ModalError::Shape`] for another number of rows, [`ModalError::Model`] with the tag of an element that is inverted
/// or degenerate.
pub fn strain_products(model: &HousingModel, shapes: &DenseMatrix) -> Result<DenseMatrix, ModalError> {
    check_count("rows of the modes", model.dof(), shapes.nrows())?;
    let count = shapes.ncols();
    let mut total = sum_over_elements(model, [count; 2], |work, _, element, sum| {
        let of_mode = |mode| work.strains(model, element, shapes.col_as_slice(mode));
        let moves: Vec<_> = (0..count).map(of_mode).collect();
        for (b, own) in moves.iter().enumerate() {
            let force = work.force(own);
            for (a, other) in moves.iter().enumerate() {
                sum[(a, b)] += work.work(other, &force);
            }
        }
    })?;
    let d = model.dimension;
    for spring in &model.springs {
        for row in spring_rows(&spring.matrix) {
            let stretch = |mode: usize| -> f64 {
                let shape = shapes.col_as_slice(mode);
                let entries = row.factors.iter().enumerate();
                entries.map(|(place, factor)| factor * shape[d * spring.nodes[place / d] + place % d]).sum()
            };
            let stretches: Vec<f64> = (0..count).map(stretch).collect();
            for (b, own) in stretches.iter().enumerate() {
                for (a, other) in stretches.iter().enumerate() {
                    total[(a, b)] += row.stiffness * own * other;
                }
            }
        }
    }
    Ok(total)
}

/// Part of its own stiffness that a component of a spring must have left beside those before, to be a spring of its own.
const OWN_STIFFNESS: f64 = 1e-12;

/// A single spring: energy `stiffness (factors . u)^2 / 2`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SpringRow {
    /// N/m, > 0.
    pub stiffness: f64,
    /// Factors of the displacements; the largest is 1.
    pub factors: Vec<f64>,
}

/// Single springs whose sum is a positive semidefinite S [n x n].
///
/// Cholesky's factor with the component that has most of its own stiffness left as the next pivot: a soft spring
/// across a stiff one is found however soft it is. Source: Higham, Accuracy and Stability of Numerical Algorithms
/// (2002), section 10.3.
pub(super) fn spring_rows(stiffness: &DMatrix<f64>) -> Vec<SpringRow> {
    let mut left = stiffness.clone();
    let n = left.nrows().min(left.ncols());
    let share = |left: &DMatrix<f64>, i: usize| {
        let own = stiffness[(i, i)];
        if own > 0.0 { left[(i, i)] / own } else { 0.0 }
    };
    let mut rows = Vec::new();
    for _ in 0..n {
        let best = (0..n).max_by(|&i, &j| share(&left, i).total_cmp(&share(&left, j)));
        let Some(pivot) = best.filter(|&pivot| share(&left, pivot) > OWN_STIFFNESS) else {
            break;
        };
        let own = left[(pivot, pivot)];
        let row: Vec<f64> = (0..n).map(|j| left[(pivot, j)]).collect();
        for i in 0..n {
            for j in 0..n {
                left[(i, j)] -= row[i] * row[j] / own;
            }
        }
        let largest = row.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        rows.push(SpringRow {
            stiffness: largest * (largest / own),
            factors: row.into_iter().map(|x| x / largest).collect(),
        });
    }
    rows
}

/// Elements that one thread sums in a row. A constant, so that the order of the sums does not depend on the number
/// of threads.
const CHUNK: usize = 512;

/// Largest degrees of freedom of an element.
const MAX_DOF: usize = 3 * MAX_NODES;

/// The sum [rows x columns] of what `add` adds for every element, which it gets with its place in the model. In parallel; the
/// result is the same to the bit for any number of threads.
///
/// # Errors
/// [`ModelError::Refused`] for the first element that is inverted or degenerate.
pub(super) fn sum_over_elements(
    model: &HousingModel,
    [rows, columns]: [usize; 2],
    add: impl Fn(&ElementWork, usize, &HousingElement, &mut DenseMatrix) + Sync,
) -> Result<DenseMatrix, ModelError> {
    let chunks = model.elements.list.par_chunks(CHUNK).enumerate();
    let sums: Vec<Result<DenseMatrix, ModelError>> = chunks
        .map(|(chunk, elements)| {
            let mut sum = DenseMatrix::zeros(rows, columns);
            let mut work = ElementWork::default();
            for (place, element) in elements.iter().enumerate() {
                work.load(model, element)?;
                add(&work, CHUNK * chunk + place, element, &mut sum);
            }
            Ok(sum)
        })
        .collect();
    let mut total = DenseMatrix::zeros(rows, columns);
    for sum in sums {
        total += sum?;
    }
    Ok(total)
}

/// Matrices of one element, column by column.
#[derive(Default)]
pub(super) struct ElementWork {
    stiffness: Vec<f64>,
    mass: Vec<f64>,
    dof: usize,
    /// Nodes from their mean, m.
    arms: Vec<[f64; 3]>,
    /// `(sum |a|^2 1 - a a^T)^-1` of the arms a: from the moment of displacements to the mean turn.
    turn: Matrix3<f64>,
}

impl ElementWork {
    fn load(&mut self, model: &HousingModel, element: &HousingElement) -> Result<(), ModelError> {
        let nodes = model.elements.nodes(element).iter();
        let at: Vec<[f64; 3]> = nodes.map(|&node| model.coordinates[node]).collect();
        let properties = &model.properties[element.part];
        self.dof = element.kind.dof();
        self.stiffness.resize(self.dof * self.dof, 0.0);
        self.mass.resize(self.dof * self.dof, 0.0);
        let formulation = model.description.formulation;
        stiffness_into(element.kind, &at, properties, formulation, &mut self.stiffness)
            .and_then(|()| mass_into(element.kind, &at, properties, formulation, element.across_plate, &mut self.mass))
            .map_err(|source| ModelError::element(&model.path, element.tag, &source))?;
        let count = at.len() as f64;
        let mean = [0, 1, 2].map(|i| at.iter().map(|x| x[i]).sum::<f64>() / count);
        self.arms = at.iter().map(|x| [0, 1, 2].map(|i| x[i] - mean[i])).collect();
        let mut inertia = Matrix3::zeros();
        for a in self.arms.iter().map(|&arm| Vector3::from(arm)) {
            inertia += Matrix3::identity() * a.norm_squared() - a * a.transpose();
        }
        // nodes in line have no volume and were refused
        self.turn = inertia.try_inverse().unwrap_or_default();
        Ok(())
    }

    /// Displacements of the element's nodes in a mode.
    fn moves(&self, model: &HousingModel, element: &HousingElement, shape: &[f64]) -> [f64; MAX_DOF] {
        let (d, mut moves) = (model.dimension, [0.0; MAX_DOF]);
        for (a, &node) in model.elements.nodes(element).iter().enumerate() {
            moves[d * a..d * a + d].copy_from_slice(&shape[d * node..d * node + d]);
        }
        moves
    }

    /// The same without the element's rigid part.
    pub(super) fn strains(&self, model: &HousingModel, element: &HousingElement, shape: &[f64]) -> [f64; MAX_DOF] {
        let mut moves = self.moves(model, element, shape);
        self.take_rigid_out(model.dimension, &mut moves);
        moves
    }

    /// Takes the mean translation and the mean turn out: K_e does not resist them, and round-off of what is left
    /// is relative to the element's own deformation.
    fn take_rigid_out(&self, d: usize, moves: &mut [f64; MAX_DOF]) {
        let nodes = self.arms.len();
        for i in 0..d {
            let mean = (0..nodes).map(|a| moves[d * a + i]).sum::<f64>() / nodes as f64;
            (0..nodes).for_each(|a| moves[d * a + i] -= mean);
        }
        let component = |moves: &[f64; MAX_DOF], a: usize, i: usize| {
            if i < d { moves[d * a + i] } else { 0.0 }
        };
        let mut moment = Vector3::zeros();
        for (a, arm) in self.arms.iter().enumerate() {
            let u = Vector3::from([0, 1, 2].map(|i| component(moves, a, i)));
            moment += Vector3::from(*arm).cross(&u);
        }
        let turn = self.turn * moment;
        for (a, arm) in self.arms.iter().enumerate() {
            let carried = turn.cross(&Vector3::from(*arm));
            (0..d).for_each(|i| moves[d * a + i] -= carried[i]);
        }
    }

    /// `K_e u`.
    pub(super) fn force(&self, moves: &[f64; MAX_DOF]) -> [f64; MAX_DOF] {
        self.times(&self.stiffness, moves)
    }

    fn times(&self, matrix: &[f64], moves: &[f64; MAX_DOF]) -> [f64; MAX_DOF] {
        let mut product = [0.0; MAX_DOF];
        for (to, column) in product.iter_mut().zip(matrix.chunks_exact(self.dof)) {
            *to = column.iter().zip(moves).map(|(entry, u)| entry * u).sum();
        }
        product
    }

    /// Work of a force on displacements of the element.
    pub(super) fn work(&self, moves: &[f64; MAX_DOF], force: &[f64; MAX_DOF]) -> f64 {
        moves.iter().zip(force).take(self.dof).map(|(u, f)| u * f).sum()
    }

    /// `[phi_e^T K_e phi_e, phi_e^T M_e phi_e]`.
    pub(super) fn energies(&self, model: &HousingModel, element: &HousingElement, shape: &[f64]) -> [f64; 2] {
        let mut moves = self.moves(model, element, shape);
        let kinetic = self.work(&moves, &self.times(&self.mass, &moves));
        self.take_rigid_out(model.dimension, &mut moves);
        [self.work(&moves, &self.force(&moves)), kinetic]
    }
}

#[cfg(test)]
#[path = "strain_products_tests.rs"]
mod tests;

#[cfg(test)]
mod spring_rows_tests {
    use super::spring_rows;
    use nalgebra::DMatrix;

    #[test]
    fn a_soft_spring_beside_a_stiff_one_is_found() {
        let k = DMatrix::from_diagonal(&nalgebra::dvector![1e9, 0.0, 1e-6]);
        let rows = spring_rows(&k);
        assert_eq!(rows.len(), 2);
        // a spring along (1, 1): one row, whatever the rounding
        let k = DMatrix::from_element(2, 2, 0.1 + 0.2);
        let rows = spring_rows(&k);
        assert_eq!(rows.len(), 1);
        assert_eq!(rows[0].factors, [1.0, 1.0]);
        assert!(spring_rows(&DMatrix::zeros(3, 3)).is_empty());
    }

    #[test]
    fn single_springs_add_up_to_the_whole() {
        let shape = DMatrix::from_fn(5, 3, |i, j| {
            // the last component, which is taken first, has least of it
            ((i + 1) as f64 * (j + 2) as f64).sin() / (1.0 + i as f64).powi(2)
        });
        let k = 1e8 * &shape * shape.transpose();
        let rows = spring_rows(&k);
        assert_eq!(rows.len(), 3);
        let sum = DMatrix::from_fn(5, 5, |i, j| {
            rows.iter().map(|row| row.stiffness * row.factors[i] * row.factors[j]).sum::<f64>()
        });
        // round-off of three subtractions
        assert!((sum - &k).amax() < 1e-14 * k.amax());
    }
}
