//! NumPy `.npz` archives of named arrays: written without compression, read with and without.
//!
//! Written are arrays of f64, i32, i64, text and a string of bytes, and sparse matrices as SciPy has them; read are arrays
//! of real and whole numbers and text. Format: a ZIP archive with one `NAME.npy` an array; each a header (NumPy "NPY format", version 1.0: magic,
//! version, header length, Python dictionary with descr, fortran_order, shape) followed by the values, little-endian.
//! Read back with `numpy.load(path)["NAME"]`.
//!
//! The crate `npyz` 0.9.1 is not used below: it reserves whatever length a header promises, up to 4 GiB, and 24
//! nested brackets in a header keep its parser busy for more than a minute.

mod header;
mod modes;
#[cfg(test)]
mod modes_tests;
mod reader;
#[cfg(test)]
mod reader_tests;
mod writer;
#[cfg(test)]
mod writer_tests;

pub use modes::{read_modes_npz, write_modes_npz};
pub use reader::{NpzReader, NpzValues};
pub(super) use writer::npz_labels;
pub use writer::{NpzArray, NpzElement, NpzWriter, is_array_name, write_sparse_npz};
