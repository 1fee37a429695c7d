//! How many eigenvalues lie below a value: Sylvester's law of inertia.

use super::{LinalgError, SparseMatrix, run_sequentially};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::LdltRegularization;
use faer::sparse::linalg::cholesky::simplicial::SimplicialLdltRef;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLdltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Par, Side};

/// Signs of the pivots of `P A P^T = L D L^T`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Inertia {
    /// Number of negative pivots, which is that of negative eigenvalues of A.
    pub negative: usize,
    /// Smallest magnitude of a pivot relative to the largest: the count is not to be trusted when it is
    /// near round-off (nothing is pivoted).
    pub smallest_pivot: f64,
}

/// Factorises a symmetric, in general indefinite `a` [n x n], both triangles stored.
///
/// With `a = K - sigma M` and M positive semidefinite, `negative` is the number of eigenvalues of `K x = lambda M x`
/// below sigma (Parlett, The Symmetric Eigenvalue Problem, section 3.3).
///
/// # Errors
/// [`LinalgError::Factorisation`] when memory does not suffice or a pivot is zero.
pub(super) fn inertia(a: &SparseMatrix) -> Result<Inertia, LinalgError> {
    run_sequentially();
    let order = a.rows();
    let failed = |reason| LinalgError::Factorisation { order, reason };
    let offsets = a.indptr();
    let offsets = offsets.raw_storage();
    let pattern = SymbolicSparseColMatRef::new_checked(order, order, offsets, None, a.indices());
    let symbolic = factorize_symbolic_cholesky(
        pattern,
        Side::Lower,
        SymmetricOrdering::Amd,
        CholeskySymbolicParams::default(),
    )
    .map_err(|_| failed("symbolic analysis"))?;
    let scratch = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default());
    let mut buffer = MemBuffer::try_new(scratch).map_err(|_| failed("out of memory"))?;
    let mut values = vec![0.0; symbolic.len_val()];
    symbolic
        .factorize_numeric_ldlt::<f64>(
            &mut values,
            SparseColMatRef::new(pattern, a.data()),
            Side::Lower,
            LdltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut buffer),
            Default::default(),
        )
        .map_err(|_| failed("a zero pivot"))?;
    let pivots: Vec<f64> = match symbolic.raw() {
        SymbolicCholeskyRaw::Simplicial(symbolic) => {
            let factor = SimplicialLdltRef::<usize, f64>::new(symbolic, &values);
            let first = &symbolic.col_ptr()[..order];
            first.iter().map(|&place| factor.values()[place]).collect()
        }
        SymbolicCholeskyRaw::Supernodal(symbolic) => {
            let factor = SupernodalLdltRef::<usize, f64>::new(symbolic, &values);
            let blocks = (0..symbolic.n_supernodes()).map(|node| factor.supernode(node).val());
            blocks
                .flat_map(|block| (0..block.ncols()).map(move |place| block[(place, place)]))
                .collect()
        }
    };
    let magnitude = |pivot: &f64| pivot.abs();
    let largest = pivots.iter().map(magnitude).fold(0.0, f64::max);
    let smallest = pivots.iter().map(magnitude).fold(f64::INFINITY, f64::min);
    Ok(Inertia {
        negative: pivots.iter().filter(|&&pivot| pivot < 0.0).count(),
        smallest_pivot: smallest / largest,
    })
}

#[cfg(test)]
mod tests {
    use super::super::TripletBuilder;
    use super::*;

    /// Chain of unit springs and masses, fixed at both ends, less sigma: eigenvalues `2 - 2 cos(j pi / (n + 1)) - sigma`.
    fn chain(order: usize, sigma: f64) -> SparseMatrix {
        let mut a = TripletBuilder::new(order, order);
        for row in 0..order {
            a.add(row, row, 2.0 - sigma);
            if row + 1 < order {
                a.add(row, row + 1, -1.0);
                a.add(row + 1, row, -1.0);
            }
        }
        a.build()
    }

    #[test]
    fn counts_the_eigenvalues_of_a_chain() {
        let order = 400;
        let value = |j: usize| 2.0 - 2.0 * (j as f64 * std::f64::consts::PI / 401.0).cos();
        for below in [0, 1, 7, 200, 399] {
            let sigma = 0.4 * value(below) + 0.6 * value(below + 1);
            let found = inertia(&chain(order, sigma)).expect("no zero pivot");
            assert_eq!(found.negative, below);
        }
        // the first pivot is 2 - sigma
        assert!(inertia(&chain(order, 2.0)).is_err());
    }

    /// A dense block makes supernodes: a rank-one update of the identity, `I - sigma + 3 v v^T`.
    #[test]
    fn counts_in_supernodes_too() {
        let order = 60;
        let mut a = TripletBuilder::new(order, order);
        for row in 0..order {
            for column in 0..order {
                let identity = f64::from(u8::from(row == column));
                a.add(row, column, identity * (1.0 - 2.0) + 3.0 / order as f64);
            }
        }
        // eigenvalues -1 (59 times) and 2
        assert_eq!(inertia(&a.build()).expect("no zero pivot").negative, 59);
    }
}
