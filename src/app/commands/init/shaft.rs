//! The shaft that a case file offers: a steel bar through its bearings.

use super::found::Found;
use super::scene::{BALANCE, SPEED_HZ, STEEL};
use super::seat::Seat;
use serde::Serialize;
use std::f64::consts::PI;

/// The shaft is as thick as the bearing's bore, and so many times longer on each bearing's share. A guess.
pub(crate) const SHAFT_LENGTHS: f64 = 10.0;

/// In several bearings it is so many times as long as the outermost lie apart. A guess.
pub(crate) const OVERHANG: f64 = 1.5;

/// A shaft as a case file has it, a steel cylinder. SI.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct ShaftNumbers {
    /// Diameter.
    pub bore: f64,
    pub length: f64,
    pub mass: f64,
    pub unbalance: f64,
    pub transverse_inertia: f64,
    pub polar_inertia: f64,
    /// Its middle along the axis, from the first bearing's centre.
    pub centre: f64,
}

impl ShaftNumbers {
    /// As thick as the smallest bearing's bore; in several bearings it reaches beyond the outermost, which lie `reach` apart.
    pub(crate) fn of(found: &Found<'_>) -> Self {
        let bore = found.seats().map(Seat::shaft_bore).fold(f64::INFINITY, f64::min);
        let places = || found.seats().map(|seat| seat.place);
        let [low, high] = [places().fold(0.0, f64::min), places().fold(0.0, f64::max)];
        let length = if high > low { OVERHANG * (high - low) } else { SHAFT_LENGTHS * bore };
        Self::cylinder(bore, length, 0.5 * (low + high))
    }

    /// A cylinder of this diameter and length about this place, m.
    pub(super) fn cylinder(bore: f64, length: f64, centre: f64) -> Self {
        let mass = STEEL * 0.25 * PI * bore.powi(2) * length;
        Self {
            bore,
            length,
            mass,
            unbalance: mass * BALANCE / (2.0 * PI * SPEED_HZ),
            transverse_inertia: mass * (0.75 * bore.powi(2) + length.powi(2)) / 12.0,
            polar_inertia: 0.125 * mass * bore.powi(2),
            centre,
        }
    }
}
