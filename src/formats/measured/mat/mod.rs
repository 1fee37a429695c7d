//! Signals in a MATLAB file of version 5 to 7 (level 5), of either byte order, packed or not.
//!
//! Arrays of numbers are signals: vectors by their name, tables by column or row, `x(:,2)` or `x(2,:)`, fields of structs
//! by their path, `bearing.gs` or `run(2).x`. Cells, text, objects, functions, sparse arrays and those of more than two
//! dimensions are passed over, and so are single numbers, which may state a rate or a speed. A name with the structs
//! around it has up to 255 bytes, and a file up to 65 536 signals.
//!
//! Source: The MathWorks, "MAT-File Format" (R2019b), chapter 1, level 5.
//!
//! # Memory
//! Sizes that a file states are not believed. A variable is unpacked while it is looked through or read, and at most
//! 2 GiB of it, MATLAB's own limit. Memory stays below 20 times the file's size, or 20 000 times where variables are packed
//! (1032 bytes into one at best, and numbers of one byte become eight), and 16 MiB.
//!
//! # Why not another reader
//! Of the readers that crates.io had in 2026, matfile 0.5.0 (2024) passes over structs and unpacks without a limit, matrw
//! 0.1.4 stops the program at damaged streams and names, and matio-rs binds a C library.

mod array;
mod element;
#[cfg(test)]
mod made_tests;
mod signals;
#[cfg(test)]
mod tests;
mod variable;

pub(super) use signals::read;
pub use signals::signals_from_mat;
