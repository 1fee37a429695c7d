//! Computed against published values and other programs' numbers.

mod plane_frequencies;
