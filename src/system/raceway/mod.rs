//! Mode shapes along the raceway, ready for the hot loop: pieces of fifth degree, modes side by side.
//!
//! Values, slopes and curvatures are continuous from piece to piece, a ball stays on one for many steps, and a value costs
//! five products.

mod table;

pub(super) use table::{Place, Quintic, RacewayTable, lowest_bits, nearest_whole, reduced_turn, slope, value};
