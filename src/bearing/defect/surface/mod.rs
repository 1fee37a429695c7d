//! A dent as the true depression in three dimensions, in a groove that nearly conforms to the ball.
//!
//! The race is a torus: over the angle φ and the transverse angle ψ its points lie `R − σ r_g (1 − cos ψ)` from the
//! axis and `r_g sin ψ` from the plane of the bearing, its normal into the material is `m = σ cos ψ e_r + sin ψ e_z`.
//! The ball's centre stays in that plane. With `s = R φ`, `z = r_g sin ψ`:
//!
//! ```text
//! floor      D(s, z) = b sqrt(1 − (s/a)² − (z/c)²)          measured from the race, radially
//! outline    (s/a)² + (z/c)² = 1                            s = a v, z = ±c sqrt(1 − v²), −1 ≤ v ≤ 1
//! rim        a tube of radius r about Q(v), the point r below the outline along m: it touches the groove there
//! ```
//!
//! What is material is race or tube; the floor is what of the depression the tube leaves. Three parts follow:
//!
//! | part | contacts | file |
//! |---|---|---|
//! | rim | minima of `|C − Q(v)|` over v: a symmetric pair at ±z, or the vertex v = ±1, the rim in the plane | `outline`, `minima`, `edge` |
//! | floor | in the plane z = 0 | `bottom` |
//! | race | beside the outline | |
//!
//! A pair moves to `s* = s_0 / (1 − κ_t c² / (κ_l a²))` when the ball is at s_0 (to second order; κ_t and κ_l are the
//! relative curvatures across and along), and merges into the vertex where that reaches a. Where the outline is about
//! as curved as the ball, `κ_t c² ≈ κ_l a²`, its minima say little: `weight` shares the load.

mod dent;
mod minima;
mod outline;
mod query;

pub use dent::SurfaceDent;
#[cfg(test)]
pub(super) use outline::Outline;
