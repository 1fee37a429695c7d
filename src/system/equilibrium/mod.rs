//! Static equilibrium of ring, housing, shaft and balls at one cage angle, by Newton's method on
//! the reduced potential.
//!
//! For given positions of shaft and balls the structure's response is found first (its static
//! flexibility at the contacts, a small monotone problem). What remains is a potential of 2 + balls
//! unknowns whose gradient is the force out of balance and whose Hessian includes the geometric
//! term of the contacts. Directions of negative curvature are walked downhill, so that the end is a
//! minimum: a ball straight under the load is a saddle, and the shaft leans on a neighbour.
//!
//! **Rules.** Of two mirror-image equilibria the one reached from a start displaced by a hundredth
//! of a micrometre counter-clockwise of the load is taken. A ball that nothing pushes stays where
//! it touches the undeformed outer race. The others that are found from starts all round the load, and the saddles
//! between neighbours, are reported by [`Equilibrium::find_all`].

mod find;
mod problem;
mod search;

pub use find::{BallLoad, Equilibrium};
pub use problem::StaticCondition;
pub(super) use problem::contact_rows;
pub(super) use search::{Evaluation, Found, HELD, Potential, Search};
