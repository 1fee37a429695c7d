//! Eigenpairs of a sparse symmetric problem, with a residual and a bound for each and a proof that none is missing.

mod beyond;
mod cuts;
mod iteration;
mod pairs;
mod problem;
mod slices;
mod solve;

pub use pairs::{CountCheck, EigenPairs, EigenTimes};
pub use problem::EigenProblem;

#[cfg(test)]
mod many_tests;
#[cfg(test)]
mod tests;
