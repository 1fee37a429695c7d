//! Numbers that Rust owns, handed over to NumPy: their memory goes over, where it lies as NumPy has it.
//!
//! Nobody writes into them: results are saved from the same memory.

use numpy::{Element, IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayMethods};
use plummer::numerics::linalg::DenseMatrix;
use pyo3::prelude::*;

/// A vector.
pub(crate) fn vector<T: Element>(py: Python<'_>, values: Vec<T>) -> Bound<'_, PyArray1<T>> {
    let array = values.into_pyarray(py);
    let _ = array.readwrite().make_nonwriteable();
    array
}

/// A table, row by row.
pub(crate) fn table<T: Element>(py: Python<'_>, values: Vec<T>, shape: [usize; 2]) -> PyResult<Bound<'_, PyArray2<T>>> {
    vector(py, values).reshape(shape)
}

/// A table of tables.
pub(crate) fn cube(py: Python<'_>, values: Vec<f64>, shape: [usize; 3]) -> PyResult<Bound<'_, PyArray3<f64>>> {
    vector(py, values).reshape(shape)
}

/// A dense matrix, whose columns lie apart in memory: it is copied, row by row.
pub(crate) fn matrix<'py>(py: Python<'py>, a: &DenseMatrix) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let (rows, columns) = (a.nrows(), a.ncols());
    let values = (0..rows).flat_map(|row| (0..columns).map(move |column| a[(row, column)]));
    table(py, values.collect(), [rows, columns])
}

/// Points x, y, z.
pub(crate) fn points<'py>(py: Python<'py>, points: Vec<[f64; 3]>) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let count = points.len();
    table(py, points.into_flattened(), [count, 3])
}
