//! Filters, spectra and envelopes on signals whose answer is known; and a dent that is found by its order.

use std::f64::consts::{SQRT_2, TAU};

use super::section::{BEARING, Check, Kind, SMOOTH, SectionResult, VerificationError, built_in};
use crate::app::commands::run::compute_run;
use crate::bearing::kinematics::BallRow;
use crate::numerics::Unwatched;
use crate::numerics::series::TimeSeries;
use crate::signal::diagnosis::Fault;
use crate::signal::{Butterworth, FilterBand, WindowFunction, amplitude_spectrum, envelope};

/// Title of the section.
const TITLE: &str = "Signals";
/// The source's dent in the outer race.
const DENT: &str =
    "bearing.defects=[{on='outer',angle_deg=270,length=0.75e-3,width=0.41e-3,depth=15e-6,rim_radius=0.05e-3}]";

/// Carries the section out.
///
/// # Errors
/// [`VerificationError`] if a signal cannot be formed or analysed.
pub(super) fn signals() -> Result<SectionResult, VerificationError> {
    Ok(SectionResult::of_checks(TITLE, [sine()?, filter()?, modulation()?, dent()?].concat()))
}

/// Half a second at 100 kHz.
fn series(value: impl Fn(f64) -> f64) -> Result<TimeSeries, VerificationError> {
    let step = 1e-5;
    let values = (0..50_000).map(|k| value(f64::from(k) * step)).collect();
    Ok(TimeSeries::new(0.0, step, "m/s^2", values)?)
}

fn sine() -> Result<Vec<Check>, VerificationError> {
    let hz = 1234.5;
    let signal = series(|t| 2.0 * (TAU * hz * t).sin())?;
    let spectrum = amplitude_spectrum(&signal, WindowFunction::Hann, 0.25)?;
    let peak = spectrum.peak_near(hz, 0.01);
    let kind = |unit, reason| Kind {
        unit,
        source: "the signal itself: 2 sin(2 pi 1234.5 t)",
        assumptions: "0.5 s at 100 kHz, Hann window, padded to bins of 0.25 Hz or less.",
        reason,
    };
    let of = |pick: fn(&crate::signal::Peak) -> f64| peak.as_ref().map_or(f64::NAN, pick);
    let frequency = kind("Hz", "An eighth of the bins' distance over the frequency: 1e-4.");
    let amplitude = kind("m/s^2", "A bin beside the top of Hann's main lobe, 4 Hz wide, loses up to 2e-3.");
    Ok(vec![
        frequency.check("Sine: frequency of the peak", of(|peak| peak.frequency_hz), hz, 1e-4),
        amplitude.check("Sine: amplitude of the peak", of(|peak| peak.amplitude), 2.0, 3e-3),
    ])
}

/// Root mean square of the middle half.
fn rms(series: &TimeSeries) -> f64 {
    let values = series.values();
    let middle = &values[values.len() / 4..3 * values.len() / 4];
    (middle.iter().map(|x| x * x).sum::<f64>() / middle.len() as f64).sqrt()
}

fn filter() -> Result<Vec<Check>, VerificationError> {
    let cut_off_hz = 5000.0;
    let filter = Butterworth::new(FilterBand::HighPass { cut_off_hz });
    let signal = series(|t| (TAU * cut_off_hz * t).sin())?;
    let kind = Kind {
        unit: "",
        source: "definition: |H|^2 = 1/2 at the cut-off frequency",
        assumptions: "High-pass of order 4 at 5 kHz, a sine of 5 kHz, 100 kHz; once forward, and forward and backward.",
        reason: "The filter starts in the first quarter, which is left out: rounding is left.",
    };
    let causal = rms(&filter.causal(&signal)?) * SQRT_2;
    let zero_phase = rms(&filter.zero_phase(&signal)?) * SQRT_2;
    Ok(vec![
        kind.check("Butterworth: gain at the cut-off, causal", causal, 0.5_f64.sqrt(), 1e-9),
        kind.check("Butterworth: gain at the cut-off, zero phase", zero_phase, 0.5, 1e-9),
    ])
}

fn modulation() -> Result<Vec<Check>, VerificationError> {
    // whole periods of both in half a second
    let signal = series(|t| (1.0 + 0.4 * (TAU * 56.0 * t).cos()) * (TAU * 9000.0 * t).sin())?;
    let spectrum = amplitude_spectrum(&envelope(&signal)?, WindowFunction::Hann, 0.25)?;
    let peak = spectrum.peak_near(56.0, 0.05);
    let kind = |unit, reason| Kind {
        unit,
        source: "the signal itself: (1 + 0.4 cos(2 pi 56 t)) sin(2 pi 9000 t)",
        assumptions: "0.5 s at 100 kHz; the modulus of the analytic signal, its spectrum with a Hann window.",
        reason,
    };
    let (hz, depth) = peak.map_or((f64::NAN, f64::NAN), |peak| (peak.frequency_hz, peak.amplitude));
    let frequency = kind("Hz", "An eighth of the bins' distance of 0.19 Hz.");
    let amplitude = kind("m/s^2", "A bin beside the top of Hann's main lobe.");
    Ok(vec![
        frequency.check("Envelope: frequency of the modulation", hz, 56.0, 5e-4),
        amplitude.check("Envelope: depth of the modulation", depth, 0.4, 3e-3),
    ])
}

/// A simulated dent is heard at the order of the ball pass.
fn dent() -> Result<Vec<Check>, VerificationError> {
    let set = [
        DENT,
        "bearing.radial_play=2.5e-6",
        "transient.end=0.42",
        "transient.output_hz=100e3",
        "analysis.energy=false",
        "analysis.envelope=[{from=0.02,to=0.42}]",
    ];
    let case = built_in("smooth.toml", SMOOTH, &set)?;
    let run = compute_run(&case, &Unwatched)?;
    let pitch = BEARING.inner_race_radius + BEARING.outer_race_radius;
    let orders = BallRow::new(BEARING.balls, 2.0 * BEARING.ball_radius, pitch, 0.0)?.orders();
    let found = run.windows.first().and_then(|window| {
        let verdict = window.diagnosis.as_ref().ok()?;
        let named = verdict.faults.iter().find(|fault| fault.fault == Fault::OuterRace)?;
        named.order
    });
    let kind = Kind {
        unit: "per shaft turn",
        source: "kinematics: N/2 (1 - d/D), Harris, chapter 8",
        assumptions: "The source's bearing with its dent in the outer race, play of 2.5 µm, 20 Hz, 0.4 s. The order is the one where the envelope's lines fit best.",
        reason: "Half the resolution of 8 turns, over four harmonics and the order: 1 %.",
    };
    let found = found.unwrap_or(f64::NAN);
    Ok(vec![kind.check("Dent in the outer race: order found", found, orders.outer, 0.01)])
}
