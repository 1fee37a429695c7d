//! Where the entries of a factor are: supernodes of one pattern, shared by all factorisations on it.

use super::LinalgError;
use super::symmetric::SymmetricMatrix;
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::SymbolicSupernodalParams;
use faer::sparse::linalg::cholesky::simplicial::{
    prefactorize_symbolic_cholesky, prefactorize_symbolic_cholesky_scratch,
};
use faer::sparse::linalg::cholesky::supernodal::{
    SymbolicSupernodalCholesky, factorize_supernodal_symbolic_cholesky,
    factorize_supernodal_symbolic_cholesky_scratch,
};

/// Supernodes that are merged: so many columns with at most this fraction of zeros. Against faer's default 5 % faster on
/// a solid of 60 000 degrees of freedom.
const RELAXATION: &[(usize, f64)] = &[(8, 1.0), (24, 0.6), (64, 0.15), (usize::MAX, 0.05)];

/// Where the factor's entries are, for one pattern.
#[derive(Debug)]
pub(super) struct Symbolic {
    /// faer's analysis.
    pub supernodes: SymbolicSupernodalCholesky<u32>,
}

impl Symbolic {
    /// Analyses the pattern of a matrix in the order in which it is factorised.
    ///
    /// # Errors
    /// [`LinalgError::Factorisation`] if the factor has more than 2^31 entries or memory does not suffice.
    pub fn new(a: &SymmetricMatrix) -> Result<Self, LinalgError> {
        let order = a.order();
        let failed = |reason| LinalgError::Factorisation { order, reason };
        let (offsets, rows) = upper_pattern(a);
        let pattern = SymbolicSparseColMatRef::new_checked(order, order, &offsets, None, &rows);
        let scratch = StackReq::or(
            prefactorize_symbolic_cholesky_scratch::<u32>(order, rows.len()),
            factorize_supernodal_symbolic_cholesky_scratch::<u32>(order),
        );
        let mut buffer = MemBuffer::try_new(scratch).map_err(|_| failed("out of memory"))?;
        let stack = MemStack::new(&mut buffer);
        let (mut tree, mut counts) = (vec![0; order], vec![0; order]);
        let tree = prefactorize_symbolic_cholesky(&mut tree, &mut counts, pattern, stack);
        let parameters = SymbolicSupernodalParams {
            relax: Some(RELAXATION),
        };
        let supernodes =
            factorize_supernodal_symbolic_cholesky(pattern, tree, &counts, stack, parameters)
                .map_err(|_| failed("its factor has more than 2^31 entries, or memory is short"))?;
        Ok(Self { supernodes })
    }

    /// Entries of the factor.
    pub fn entries(&self) -> usize {
        self.supernodes.len_val()
    }
}

/// Upper triangle in compressed columns: the transposed pattern.
fn upper_pattern(a: &SymmetricMatrix) -> (Vec<u32>, Vec<u32>) {
    let order = a.order();
    let mut offsets = vec![0_u32; order + 1];
    for &row in &a.rows {
        offsets[row as usize + 1] += 1;
    }
    for row in 0..order {
        offsets[row + 1] += offsets[row];
    }
    let mut next = offsets.clone();
    let mut columns = vec![0; a.rows.len()];
    for column in 0..order {
        for (row, _) in a.column(column) {
            columns[next[row] as usize] = column as u32;
            next[row] += 1;
        }
    }
    (offsets, columns)
}
