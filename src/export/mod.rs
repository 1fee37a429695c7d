//! Results out of the program, in formats that other programs read.

pub mod npz;

pub use npz::{NpzArray, NpzError, NpzWriter};
