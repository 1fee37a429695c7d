//! Tadina & Boltezar (2011) in numbers, and the case that stands for the paper.

use plummer::app::case::{Case, Source};
use plummer::app::verification::BEAM_CASE;
use std::path::PathBuf;

/// Why a table cannot be computed: nothing that the reader of the tables could set right.
pub type Failure = Box<dyn std::error::Error + Send + Sync>;

/// Table 1's contact stiffness of the inner and the outer race, N/m^(3/2) (printed as N/m).
pub const TABLE_ONE: [f64; 2] = [3.828e9, 3.867e9];

/// Eigenfrequency "of the bearing/housing-pedestal system", Hz ("around", section 4.2).
pub const SWAY: f64 = 8.2e3;

/// Eigenfrequency "of the shaft", Hz ("around", section 4.2).
pub const BOUNCE: f64 = 11.3e3;

/// "First eigenfrequency of the outer ring", Hz: 35 kHz in section 4.1, 36 kHz in section 4.2.
pub const RING: [f64; 2] = [35e3, 36e3];

/// How far a frequency (Hz) lies outside what the paper says of the ring, relatively: 0 between its two figures, negative
/// below them.
pub fn outside_of_ring(hz: f64) -> f64 {
    let [low, high] = RING;
    if hz < low {
        hz / low - 1.0
    } else if hz > high {
        hz / high - 1.0
    } else {
        0.0
    }
}

/// Relative distances of three frequencies (Hz) from the paper's.
pub fn errors(hz: [f64; 3]) -> [f64; 3] {
    [hz[0] / SWAY - 1.0, hz[1] / BOUNCE - 1.0, outside_of_ring(hz[2])]
}

/// The case `examples/tadina2011/beam.toml` without the variants that it lists, with keys set as on the command line.
///
/// # Errors
/// What is wrong with a key.
pub fn beam_case(set: &[&str]) -> Result<Case, Failure> {
    let keys = ["modes.variants=[]"].iter().chain(set);
    Ok(Case::from_source(Source {
        path: PathBuf::from("beam.toml"),
        text: BEAM_CASE.to_owned(),
        set: keys.map(|key| (*key).to_owned()).collect(),
    })?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ring_may_be_anywhere_between_the_papers_two_figures() {
        for (hz, expected) in [(34.3e3, -0.02), (35e3, 0.0), (35.9e3, 0.0), (37.8e3, 0.05)] {
            assert!((outside_of_ring(hz) - expected).abs() < 1e-12, "{hz}");
        }
        let errors = errors([8.2e3 * 1.01, 11.3e3 * 0.98, 36e3]);
        assert!((errors[0] - 0.01).abs() < 1e-12 && (errors[1] + 0.02).abs() < 1e-12);
    }
}
