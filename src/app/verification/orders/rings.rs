//! Curved beams on a thick free ring.

use std::f64::consts::TAU;

use super::super::beams::ring;
use super::{Family, series};
use crate::app::verification::section::VerificationError;
use crate::numerics::linalg::symmetric_generalised_eigen;

/// Elements of the coarsest ring; each of the others has twice as many as the one before.
const ELEMENTS: usize = 24;
/// Rings: of so many, all but the last are compared with the next.
const RINGS: u32 = 4;
/// Radius over thickness.
const SLENDERNESS: f64 = 5.0;

/// What a size is, and its unit.
const SIZE: [&str; 2] = ["Arc of an element", "rad"];

pub(super) fn rings() -> Result<Family, VerificationError> {
    let squared = (0..RINGS).map(|halving| {
        let ring = ring(ELEMENTS << halving, SLENDERNESS)?;
        let modes = symmetric_generalised_eigen(ring.stiffness(), ring.mass())?;
        Ok(modes.values)
    });
    let squared = squared.collect::<Result<Vec<_>, VerificationError>>()?;
    let of_waves = |waves: usize| {
        // three rigid motions, then a pair for each number of waves
        let frequency = |values: &Vec<f64>| values[2 * waves - 1].sqrt();
        let pairs = squared.windows(2);
        series(
            format!("thick ring with {waves} waves"),
            SIZE,
            (0..RINGS - 1).map(|halving| TAU / (ELEMENTS << halving) as f64).collect(),
            pairs.map(|pair| frequency(&pair[0]) / frequency(&pair[1]) - 1.0).collect(),
            [2.0, 0.05],
        )
    };
    Ok(Family {
        title: "Frequencies of a ring of beams",
        source: "What inertia between exact nodes leaves out: shear and stretch under the load p L inside an element, of second order in its length L",
        assumptions: "Free ring, radius over thickness 5, 24 to 192 exact arcs; error: the difference from the ring of twice as many elements.",
        reason: "The next term, of fourth order, is less than a tenth of the first at 96 elements.",
        series: (2..=4).map(of_waves).collect(),
    })
}
