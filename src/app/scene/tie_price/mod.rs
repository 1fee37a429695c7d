//! What it costs that a ring is a beam: its frequencies beside those of the same ring of solid elements.

pub(crate) mod body;
pub(crate) mod points;
pub(crate) mod price;
pub(crate) mod reason;
#[cfg(test)]
mod tests;

pub use price::{BeamAndSolid, TIE_PRICE_MODES, TieComparison, TiePrice, tie_price};
pub use reason::NoTiePrice;
