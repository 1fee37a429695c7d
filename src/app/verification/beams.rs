//! The ring as curved beams against thin and thick rings in closed form.

use std::f64::consts::TAU;

use super::section::{Check, Kind, SectionResult, VerificationError};
use crate::fe::element::curved_beam::RingInterpolation;
use crate::fe::element::curved_beam::closed_form::{
    RingSection, THIN_SHORTENING, THIN_WIDENING, pinched, thin_frequency_hz,
};
use crate::fe::material::{BeamSection, Bond, Material, RadiusRule, RingLayer};
use crate::fe::model::Ring;
use crate::numerics::linalg::{DenseCholesky, DenseMatrix, symmetric_generalised_eigen};

/// Title of the section.
const TITLE: &str = "Curved beams";
/// Elements of the rings compared.
const ELEMENTS: usize = 36;

/// Carries the section out.
///
/// # Errors
/// [`VerificationError`] if a ring cannot be computed.
pub(super) fn beams() -> Result<SectionResult, VerificationError> {
    let checks = [free_ring()?, thin_pinched()?, thick_pinched()?];
    Ok(SectionResult::of_checks(TITLE, checks.concat()))
}

/// A ring of so many elements, of radius 1 m, 0.1 m wide and 1 / slenderness thick.
pub(super) fn ring(elements: usize, slenderness: f64) -> Result<Ring, VerificationError> {
    let thickness = 1.0 / slenderness;
    let section = [0.1 * thickness, 0.1 * thickness.powi(3) / 12.0, 1.0];
    ring_of(elements, Material::new(2e11, 0.3, 7800.0)?, section)
}

/// A ring of so many elements of a rectangular section: its area (m^2), second moment of area (m^4) and radius (m).
pub(super) fn ring_of(
    elements: usize,
    material: Material,
    [area, inertia, radius]: [f64; 3],
) -> Result<Ring, VerificationError> {
    let (axial_inertia, torsion, shear_coefficient) = (None, None, 5.0 / 6.0);
    let layer = RingLayer { material, area, inertia, axial_inertia, torsion, radius, shear_coefficient };
    let section = BeamSection::combine(&[layer], Bond::Slip(RadiusRule::Own))?;
    Ok(Ring::new(elements, section, RingInterpolation::ExactArc)?)
}

fn free_ring() -> Result<Vec<Check>, VerificationError> {
    let ring = ring(ELEMENTS, 1000.0)?;
    let section = ring.section();
    let modes = symmetric_generalised_eigen(ring.stiffness(), ring.mass())?;
    let kind = Kind {
        unit: "Hz",
        source: "closed form: Hoppe 1871; Blevins, Formulas for Natural Frequency and Mode Shape, table 9-1",
        assumptions: "Free ring, radius over thickness 1000, 36 elements.",
        reason: "The thin formula is good to (t/R)^2 = 1e-6; four waves over 36 elements add 5e-6.",
    };
    let waves = 2..=4_u32;
    waves
        .map(|n| {
            let thin = thin_frequency_hz(n, section.radius, section.bending, section.mass)?;
            // three rigid motions, then a pair for each number of waves
            let value = modes.values[2 * n as usize - 1];
            let name = format!("Thin free ring, {n} waves");
            Ok(kind.check(&name, value.abs().sqrt() / TAU, thin, 1e-5))
        })
        .collect()
}

/// Shortening along two unit forces and widening across them, m; held at one loaded node, where symmetry leaves no other reaction.
fn pinch(ring: &Ring) -> Result<[f64; 2], VerificationError> {
    let (dof, half) = (ring.dof(), ring.nodes() / 2);
    let k = DenseMatrix::from_fn(dof - 3, dof - 3, |i, j| ring.stiffness()[(i + 3, j + 3)]);
    let mut load = DenseMatrix::zeros(dof - 3, 1);
    load[(3 * half - 3, 0)] = 1.0;
    let found = DenseCholesky::new(&k)?.solve(&load);
    let at = |node: usize, component: usize| found[(3 * node + component - 3, 0)];
    Ok([at(half, 0), at(half / 2, 1) - at(half + half / 2, 1)])
}

fn thin_pinched() -> Result<Vec<Check>, VerificationError> {
    let ring = ring(ELEMENTS, 1000.0)?;
    let unit = ring.section().radius.powi(3) / ring.section().bending;
    let [shortening, widening] = pinch(&ring)?;
    let kind = Kind {
        unit: "m",
        source: "closed form: Timoshenko, Strength of Materials II: (pi/4 - 2/pi) and (2/pi - 1/2) P R^3 / EI",
        assumptions: "Ring pinched by 1 N, radius over thickness 1000, 36 elements.",
        reason: "Stretch and shear, which the thin formula leaves out, add 1.8e-6.",
    };
    Ok(vec![
        kind.check("Thin pinched ring: shortening", shortening, THIN_SHORTENING * unit, 3e-6),
        kind.check("Thin pinched ring: widening", widening, THIN_WIDENING * unit, 3e-6),
    ])
}

fn thick_pinched() -> Result<Vec<Check>, VerificationError> {
    let ring = ring(ELEMENTS, 5.0)?;
    let section = ring.section();
    let theory = RingSection {
        radius: section.radius,
        bending: section.bending,
        axial: section.axial,
        shear: 1.0 / section.shear_compliance,
    };
    let exact = pinched(&theory, 1.0)?;
    let [shortening, widening] = pinch(&ring)?;
    let kind = Kind {
        unit: "m",
        source: "closed form: Castigliano's theorem with bending, stretch and shear",
        assumptions: "Ring pinched by 1 N, radius over thickness 5, shear coefficient 5/6, 36 elements.",
        reason: "The element is exact at its nodes: rounding is left.",
    };
    Ok(vec![
        kind.check("Thick pinched ring: shortening", shortening, exact.shortening, 1e-10),
        kind.check("Thick pinched ring: widening", widening, exact.widening, 1e-10),
    ])
}
