//! Nastran's OUTPUT4 files (`.op4`): named matrices.
//!
//! Written: binary (little-endian, 32-bit words) and ASCII, dense columns, double precision. Read: binary in both byte
//! orders with words of 32 and 64 bits, and ASCII; dense, sparse and big sparse ("bigmat") columns; single and double
//! precision. Complex matrices are passed over and refused by name when asked for.
//!
//! # Format
//! - A header: columns, rows (below zero: big sparse), form, type (1 real single, 2 real double, 3 and 4 complex), name.
//! - A record for each column that is not zero: column, first row, length; then its numbers (dense), or, where the first
//!   row is 0, runs of numbers, each with its length and first row (sparse: both in one word, `row + 65536 (words + 1)`;
//!   big sparse, which matrices of 65536 rows or more always are: `words + 1`, `row`).
//! - A last record whose column is beyond the matrix.
//!
//! In binary files each of these is a Fortran record, its length in 4 bytes before and after it. In ASCII files they are
//! lines: whole numbers in columns of 8, reals as the header says (`1P,3E24.16`: three a line in columns of 24).
//!
//! Sources: MSC Nastran DMAP Programmer's Guide, module OUTPUT4; the reader was compared with that of pyYeti 1.4.7
//! (`pyyeti.nastran.op4`) on files written by it and by Nastran.

mod ascii;
mod binary;
mod matrix;
mod read;
#[cfg(test)]
mod read_tests;
mod write;
#[cfg(test)]
mod write_tests;

pub use matrix::Op4Matrix;
pub use read::{op4_from_bytes, read_op4};
pub use write::{Op4Format, write_op4};
