//! Orders of convergence: how fast errors fall with the size of elements and steps, against theory. An element or a method that
//! is wrong in a term of its own often still looks right on one mesh; its order does not.
//!
//! [`solids`], [`rings`] and [`steps`] each compute a [`Family`] of [`series`]; [`section`] shows and judges them.

mod family;
mod section;

use family::{Family, series};
pub(super) use section::orders;
