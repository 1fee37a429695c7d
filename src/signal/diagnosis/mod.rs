//! From the envelope of a signal to a verdict on each part of a ball bearing.
//!
//! 1. [`FaultOrders`]: how often each part strikes, per revolution of the shaft, and how well that is known.
//! 2. `bands`: envelopes of bands of the whitened signal, over the shaft's angle; `shaft_speed` sharpens its speed before.
//! 3. `line_spectrum`: their spectra, averaged over stretches of 64 revolutions, against their own floor.
//! 4. `comb`: a line and its harmonics, moved together within the uncertainty of their order.
//! 5. `control`: how good a comb is by chance, from the same comb at hundreds of other orders.
//! 6. `explain`: what explains most goes first; its lines are no evidence for the rest (`known`). `unexplained`: combs of no part.
//!    `cage_lines`: a ball whose own lines are smeared shows by those of the cage.
//!    `doubts`: lines of a part that may be something else's.
//!    `spectrum_end`: bands end where a resampled or filtered signal does.
//! 7. [`Diagnosis`]: fault indicated, not enough evidence, or not seen, with the evidence; and impacts that belong to no part.
//! 8. `line_changes`: what of it grew since an earlier signal, and by how much (`stretch_spectrum`, `comb_power`, `ratio_interval`);
//!    `level_changes`: the same of the vibration as a whole and in octaves.
//!
//! A healthy bearing has the ball-pass line of the outer race too: balls that pass under the load make its compliance vary. That is a smooth
//! modulation; impacts have many harmonics ([`FaultVerdict::impulsiveness`]). Sound bearings of real machines have weak lines with all
//! harmonics as well ([`LEAST_STRENGTH_DB`]). Thresholds and what was measured: `docs/diagnosis.md`.
//!
//! Nothing here knows of simulations or files.
//!
//! # Limitations
//! Faults that strike at the same order are not told apart; a window of one speed and load; defects all round a race (waviness,
//! wear) make no impacts and are not seen.

mod bands;
mod cage_lines;
mod change;
mod comb;
mod comb_power;
mod compared_lines;
mod doubts;
mod error;
mod explain;
mod fault;
mod findings;
mod known;
mod line_change;
mod line_spectrum;
mod order_spectrum;
mod ratio_interval;
mod search;
mod shaft_speed;
mod spectrum_end;
mod stretch_spectrum;
mod strictly_periodic;
#[cfg(test)]
mod tests;
mod unexplained;
mod verdict;
mod window;

/// Harmonics of a part's line that are shown, the line itself included.
pub const JUDGED_HARMONICS: u32 = comb::SHOWN_HARMONICS;

pub(crate) use change::line_changes;
pub use compared_lines::ComparedSignal;
pub use error::DiagnosisError;
pub use fault::{Fault, FaultOrders, Kinematics};
pub use line_change::{
    AS_BEFORE_WITHIN_DB, ChangeConclusion, LEAST_CHANGE_DB, LevelChange, LineChange, STRONG_CHANGE_DB,
};
pub(crate) use line_change::{change_words, level_changes};
pub use order_spectrum::EnvelopeOrderSpectrum;
pub use shaft_speed::SpeedSource;
pub(crate) use spectrum_end::spectrum_end_hz;
pub use verdict::{
    BALL_BY_CAGE_BELOW, CageLines, Conclusion, FaultVerdict, Harmonic, LEAST_CAGE_LINES_DB, LEAST_CAGE_STRENGTH_DB,
    LEAST_HARMONICS, LEAST_IMPULSIVENESS, LEAST_SHORT_HARMONICS, LEAST_SHORT_IMPULSIVENESS, LEAST_SHORT_STRENGTH_DB,
    LEAST_STRENGTH_DB, NAMED_BELOW, SideLine, UNSEEN_ABOVE, UnexplainedImpacts,
};
pub use window::Diagnosis;
