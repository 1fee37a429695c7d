//! What it costs that a ring is a beam: its frequencies beside those of the same ring of solid elements; and that a bore is rigid.

pub(crate) mod body;
mod bores;
pub(crate) mod price;
#[cfg(test)]
mod tests;

pub use body::NoTiePrice;
pub use bores::BorePrice;
pub(crate) use bores::bore_price;
pub(crate) use price::tie_price;
pub use price::{BeamAndSolid, TIE_PRICE_MODES, TieComparison, TiePrice};
