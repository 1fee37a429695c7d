//! Mathematics without mechanics.
//!
//! In come matrices, systems of equations and samples; out go factors, eigenpairs, trajectories and filtered series.
//!
//! - [`linalg`]: sparse symmetric matrices, factorisation with inertia, eigenpairs with a proof, dense blocks;
//! - [`ode`]: a second-order system as an integrator sees it, and the integrators;
//! - [`series`]: evenly sampled signals, their statistics and decimation;
//! - [`Watch`]: where a computation tells how far it is;
//! - `random`: random numbers by counter;
//! - [`units`]: units of a file, turned into SI; `lanes`: four numbers side by side.
//!
//! Read [`linalg::SparseMatrix`] first, then [`ode::SecondOrderSystem`].

mod brief;
pub(crate) mod lanes;
pub mod linalg;
pub mod ode;
pub(crate) mod random;
pub mod series;
pub mod units;
mod watch;

pub(crate) use brief::Brief;
pub(crate) use watch::Told;
pub use watch::{Unwatched, Watch};
