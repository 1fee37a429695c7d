//! A uniform circular ring: free vibration in its own plane and out of it, and pinching by two
//! opposite forces.
//!
//! The thick ring is that of the decoupled curved-beam theory, whose strains are
//!
//! ```text
//! ε = (u' + w) / R     γ = (w' − u) / R + θ     χ = θ' / R          (' = d/dφ)
//! ```
//!
//! with `u` tangential, `w` radial outwards, `θ` the rotation. Equilibrium of an unloaded arc is
//! `N' = −V`, `V' = N`, `M' = R V`. For two opposite inward forces P, φ from the section at right
//! angles to them, symmetry and no net rotation of a quarter (`∫ M dφ = 0`) give
//!
//! ```text
//! M = (P R / 2)(cos φ − 2/π)     V = −(P/2) sin φ     N = −(P/2) cos φ
//! ```
//!
//! and Castigliano's theorem on `U = ∫ (M²/EI + N²/EA + V²/κGA) R dφ / 2`, with a dummy pair of
//! forces for the widening, gives the deflections below. The thin parts are those of
//! S. Timoshenko, *Strength of Materials* II, section on thin circular rings.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_4, PI};

use thiserror::Error;

/// Shortening of a thin pinched ring in units of `P R³ / (E I)`: `π/4 − 2/π` = 0.1488.
pub const THIN_SHORTENING: f64 = FRAC_PI_4 - 2.0 * FRAC_1_PI;

/// Widening of a thin pinched ring in units of `P R³ / (E I)`: `2/π − 1/2` = 0.1366.
pub const THIN_WIDENING: f64 = 2.0 * FRAC_1_PI - 0.5;

/// A property of a ring is not positive (infinite is allowed for a stiffness, as a limit).
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("{name} = {value} must be positive")]
pub struct NotPositive {
    /// What the value is.
    pub name: &'static str,
    /// The value that was given.
    pub value: f64,
}

/// A ring's radius and section stiffnesses, as its theory takes them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RingSection {
    /// Radius of the section's centroid, m.
    pub radius: f64,
    /// Bending stiffness E I, N m².
    pub bending: f64,
    /// Axial stiffness E A, N; infinite for an inextensible ring.
    pub axial: f64,
    /// Shear stiffness κ G A, N; infinite without shear flexibility.
    pub shear: f64,
}

/// Change of the two diameters of a pinched ring, m, both positive when the ring is squeezed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PinchedRing {
    /// The loaded diameter becomes shorter by this.
    pub shortening: f64,
    /// The diameter across becomes longer by this.
    pub widening: f64,
}

/// Frequency (Hz) of in-plane mode `order` (waves around the ring) of a thin, free, inextensible ring:
///
/// ```text
/// f_n = n (n² − 1) / (2 π R² sqrt(n² + 1)) · sqrt(E I / (ρ A))
/// ```
///
/// `radius` m, `bending` E I in N m², `mass_per_length` ρ A in kg/m, all positive. Orders 0 and 1
/// give 0: a uniform breathing does not exist without extension, and order 1 is rigid.
/// Thin-ring theory is an upper bound: shear, rotary inertia and extension lower the frequency.
/// Source: R. Hoppe 1871; R. D. Blevins, *Formulas for Natural Frequency and Mode Shape*, table 9-1.
///
/// # Errors
/// [`NotPositive`] names the property.
pub fn thin_frequency_hz(order: u32, radius: f64, bending: f64, mass_per_length: f64) -> Result<f64, NotPositive> {
    positive(&[("radius", radius), ("bending stiffness", bending), ("mass per length", mass_per_length)])?;
    Ok(thin_hz(order, radius, bending / mass_per_length, 1.0))
}

/// Frequency (Hz) of out-of-plane mode `order` (waves around the ring) of a thin, free ring:
///
/// ```text
/// f_n = n (n² − 1) / (2 π R² sqrt(n² + E I_a / G J)) · sqrt(E I_a / (ρ A))
/// ```
///
/// `radius` m, `bending` E I_a about the radial axis and `torsion` G J in N m², `mass_per_length` ρ A in
/// kg/m, all positive (an infinite torsion stiffness is allowed as a limit). For a circular section
/// `E I / G J = 1 + ν`. Orders 0 and 1 give 0: they are rigid, a twist of the section all round needs
/// rotary inertia. Shear and rotary inertia, left out here, lower the frequency. Source: A. E. H. Love,
/// *Mathematical Theory of Elasticity*, section 293; S. Timoshenko, *Vibration Problems in
/// Engineering*, section on the vibration of rings.
///
/// # Errors
/// [`NotPositive`] names the property.
pub fn thin_out_of_plane_frequency_hz(
    order: u32,
    radius: f64,
    bending: f64,
    torsion: f64,
    mass_per_length: f64,
) -> Result<f64, NotPositive> {
    positive(&[
        ("radius", radius),
        ("bending stiffness", bending),
        ("torsion stiffness", torsion),
        ("mass per length", mass_per_length),
    ])?;
    Ok(thin_hz(order, radius, bending / mass_per_length, bending / torsion))
}

/// `n (n² − 1) / (2 π R² sqrt(n² + addend)) · sqrt(bending over mass)`, and 0 for the orders below 2.
fn thin_hz(order: u32, radius: f64, bending_over_mass: f64, addend: f64) -> f64 {
    if order < 2 {
        return 0.0;
    }
    let n = f64::from(order);
    let shape = n * (n * n - 1.0) / (n * n + addend).sqrt();
    shape / (2.0 * PI * radius * radius) * bending_over_mass.sqrt()
}

/// Diameters of a ring pinched by two opposite forces of `force` N each, inwards positive:
///
/// ```text
/// shortening = (π/4 − 2/π) P R³/EI + (π/4) P R (1/EA + 1/κGA)
/// widening   = (2/π − 1/2) P R³/EI + (1/2) P R (1/κGA − 1/EA)
/// ```
///
/// # Errors
/// [`NotPositive`] names the property of `section` that is not positive.
pub fn pinched(section: &RingSection, force: f64) -> Result<PinchedRing, NotPositive> {
    let RingSection { radius, bending, axial, shear } = *section;
    positive(&[
        ("radius", radius),
        ("bending stiffness", bending),
        ("axial stiffness", axial),
        ("shear stiffness", shear),
    ])?;
    let flexure = force * radius * radius * radius / bending;
    let stretch = force * radius / axial;
    let slide = force * radius / shear;
    Ok(PinchedRing {
        shortening: THIN_SHORTENING * flexure + FRAC_PI_4 * (stretch + slide),
        widening: THIN_WIDENING * flexure + 0.5 * (slide - stretch),
    })
}

fn positive(properties: &[(&'static str, f64)]) -> Result<(), NotPositive> {
    let wrong = properties.iter().find(|(_, value)| value.is_nan() || *value <= 0.0);
    wrong.map_or(Ok(()), |&(name, value)| Err(NotPositive { name, value }))
}

#[cfg(test)]
#[path = "closed_form_tests.rs"]
mod tests;
