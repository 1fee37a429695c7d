//! From the envelope of a signal to a verdict on each part of a ball bearing.
//!
//! 1. [`FaultOrders`]: how often each part strikes, per shaft turn, and how well that is known.
//! 2. [`judged_envelopes`]: the envelopes that are judged; the verdict is that of the one which shows most.
//! 3. [`EnvelopeOrderSpectrum`]: the envelope's spectrum over the shaft's angle, so that a run-up smears nothing.
//! 4. A comb: a fault's line and its harmonics, for a ball those beside them too, moved together within the uncertainty of its order. Each harmonic is
//!    compared with the median of the bins about it; those that coincide with multiples of the shaft, or with lines of a
//!    fault that is named already, do not count.
//! 5. [`chance`]: the probability that noise alone has a comb as good anywhere in the search, computed.
//! 6. [`Diagnosis`]: named, not enough evidence, or not seen, with the evidence.
//!
//! A healthy bearing has the ball-pass line of the outer race too: balls that pass under the load make its compliance vary.
//! That is a smooth modulation, with a harmonic or two; bursts of a defect have many of about equal strength. Three of them
//! are asked for, and together the strength of a jump ([`LEAST_HARMONICS`], [`BURST_STRENGTH`]). Thresholds and what was measured: `docs/diagnosis.md`.
//!
//! Nothing here knows of simulations or files.
//!
//! # Limitations
//! Faults that strike at the same order are not told apart; a window of one speed and load; defects all round a race (waviness,
//! wear) make no bursts and are not seen.

pub mod chance;
mod comb;
mod envelopes;
mod error;
mod fault;
mod judge;
mod order_spectrum;
#[cfg(test)]
mod tests;
mod verdict;
mod window;

/// Harmonics of a part's line that are judged, the line itself included.
pub const JUDGED_HARMONICS: u32 = comb::HARMONICS;

pub use envelopes::{Envelopes, JudgedEnvelope, judged_envelopes};
pub use error::DiagnosisError;
pub use fault::{Fault, FaultOrders};
pub use judge::line_name;
pub use order_spectrum::EnvelopeOrderSpectrum;
pub use verdict::{
    BURST_STRENGTH, Conclusion, FaultVerdict, Harmonic, LEAST_HARMONICS, NAMED_BELOW, SideLine,
    UNSEEN_ABOVE,
};
pub use window::Diagnosis;
