//! What it costs that a ring is a beam: its frequencies beside those of the same ring of solid elements.

pub(crate) mod body;
pub(crate) mod price;
#[cfg(test)]
mod tests;

pub use body::NoTiePrice;
pub(crate) use price::tie_price;
pub use price::{BeamAndSolid, TIE_PRICE_MODES, TieComparison, TiePrice};
