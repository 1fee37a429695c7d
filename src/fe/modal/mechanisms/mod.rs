//! How many motions without energy a housing must have, and why: parts that are not connected, and mechanisms.
//!
//! A mesh falls into bodies ([`Body`]), elements that hang together through whole faces. What joins bodies to each other
//! (single nodes, edges, ties, springs) and to the ground (fixed nodes, springs) are linear constraints on the
//! bodies' rigid motions; the motions that satisfy all of them are counted by the rank of a small dense matrix. No
//! eigenvalue is computed and no stiffness compared: a spring of any stiffness above zero holds. A ring in the bore
//! is one more body, and each displacement that its tie drives a constraint.

mod bodies;
mod count;
mod rows;
mod sentences;

pub use count::{Body, Joint, Mechanisms, Piece};
pub(crate) use count::{Bore, pieces_at};

#[cfg(test)]
mod ring_tests;
#[cfg(test)]
mod tests;
