//! A transfer path, and what single modes carry of it.

use crate::fe::reduction::frf::PathShares;
use faer::c64;

/// What one mode carries of a path.
#[derive(Debug, Clone, PartialEq)]
pub struct CarriedPart {
    /// Its natural frequency, Hz.
    pub frequency_hz: f64,
    /// Its part of the receptance over the frequencies of the response, m/N.
    pub receptance: Vec<c64>,
}

/// A path from a force to a sensor.
#[derive(Debug, Clone, PartialEq)]
pub struct TransferPath {
    /// Name of the force.
    pub from: String,
    /// Name of the sensor.
    pub to: String,
    /// Which sensor and which load of the response.
    pub place: (usize, usize),
    /// What carries it in the band.
    pub shares: PathShares,
    /// The few modes with the largest shares, over frequency.
    pub carried: Vec<CarriedPart>,
}
