//! Sparse matrices as SciPy keeps them.

use std::path::Path;

use super::super::FormatError;
use super::{NpzElement, NpzWriter};
use crate::numerics::linalg::SparseMatrix;

/// Writes a sparse matrix that `scipy.sparse.load_npz` reads: `indices`, `indptr`, `format`, `shape`, `data`. Indices have
/// 32 bits where that is enough, as SciPy's own.
///
/// # Errors
/// [`FormatError`] when the file cannot be written.
pub fn write_sparse_npz(path: &Path, matrix: &SparseMatrix) -> Result<(), FormatError> {
    let mut npz = NpzWriter::create(path)?;
    let (rows, columns) = matrix.shape();
    let offsets = matrix.indptr();
    let offsets = offsets.raw_storage();
    let largest = rows.max(columns).max(matrix.nnz());
    if largest <= i32::MAX as usize {
        indices::<i32>(&mut npz, matrix.indices(), offsets, |index| index as i32)?;
    } else {
        indices::<i64>(&mut npz, matrix.indices(), offsets, |index| index as i64)?;
    }
    npz.bytes("format", if matrix.is_csc() { b"csc" } else { b"csr" })?;
    npz.array("shape", &[rows as i64, columns as i64])?;
    npz.array("data", matrix.data())?;
    npz.finish()
}

fn indices<T: NpzElement>(
    npz: &mut NpzWriter,
    indices: &[usize],
    offsets: &[usize],
    narrow: impl Fn(usize) -> T,
) -> Result<(), FormatError> {
    for (name, values) in [("indices", indices), ("indptr", offsets)] {
        let mut array = npz.begin::<T>(name, &[values.len()])?;
        for piece in values.chunks(4096) {
            let piece: Vec<T> = piece.iter().map(|&index| narrow(index)).collect();
            array.extend(&piece)?;
        }
        array.end()?;
    }
    Ok(())
}
