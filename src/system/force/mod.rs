//! The hot loop: all that is evaluated in every step. No allocation, O(balls x modes).
//!
//! Balls stand side by side in lanes, and so do modes. A ball that cannot reach the outer race, however the kept modes move
//! it, costs no mode row.

mod evaluate;
mod events;
mod inner_race;
mod outer_race;
mod placing;
mod quasi_static;
#[cfg(test)]
mod rate_tests;
mod tangent;
#[cfg(test)]
pub(super) mod tangent_tests;
mod with_residual;
