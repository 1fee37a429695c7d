//! Elements that share a place without sharing nodes as neighbours do: the same element twice, bodies that lie in one
//! another, faces that lie on each other unconnected, and edges with a middle node in one element alone.
//!
//! [`Bodies`] comes in, the elements of the highest dimension of a mesh. What comes out names parts, counts and places:
//! [`Doubled`], [`MixedOrders`], [`Overlap`],
//! [`Touching`], [`Crossing`], [`Apart`]. Read `inside.rs` first. Every search sorts or descends a tree of boxes:
//! O(n log n).
//!
//! # Limitations
//! An [`Overlap`], which is refused, shows itself by the centre of an element that lies within another one. Faces touch where the
//! centre of one lies on the other. What is between these is a [`Crossing`], which is told.

mod apart;
mod bodies;
mod crossing;
mod doubled;
mod facets;
mod group;
mod inside;
mod outline;
#[cfg(test)]
mod tests;
mod touching;

pub use apart::Apart;
pub use bodies::Bodies;
pub(super) use bodies::part;
pub use crossing::Crossing;
pub use doubled::{Doubled, MixedOrders};
pub use inside::{Overlap, OverlapRule};
pub(super) use outline::normal;
pub use touching::Touching;
