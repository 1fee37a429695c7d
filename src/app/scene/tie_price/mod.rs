//! What it costs that a ring is a beam: its frequencies beside those of the same ring of solid elements.

pub(crate) mod body;
pub(crate) mod price;
pub(crate) mod reason;
#[cfg(test)]
mod tests;

pub(crate) use price::tie_price;
pub use price::{BeamAndSolid, TIE_PRICE_MODES, TieComparison, TiePrice};
pub use reason::NoTiePrice;
