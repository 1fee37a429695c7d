//! The envelopes that a verdict is sought in: of bands of the whitened signal, at equal angles of the shaft.

use crate::numerics::Brief;
use rayon::prelude::*;

use super::DiagnosisError;
use super::line_spectrum::{LineSpectrum, REVOLUTIONS, stretches};
use super::order_spectrum::AngleGrid;
use crate::numerics::series::TimeSeries;
use crate::signal::RawSpectrum;

/// The lowest frequency of a band over the highest at which a part strikes: an envelope needs a carrier that is faster than it.
const LOWEST_CARRIER: f64 = 2.0;
/// Times that the whole band is halved; for a window of one stretch of revolutions less often, since every band is one more
/// chance to be misled by its few bins.
const LEVELS: u32 = 3;
const SHORT_LEVELS: u32 = 2;
/// A band is as wide as so many times the highest frequency at which a part strikes, at least: its envelope shows no more than its width.
const HARMONICS_A_BAND: f64 = 3.0;
/// What is added to a squared envelope over its mean before the logarithm is taken: silence would be without end.
const LEAST_POWER: f64 = 0.01;

/// Revolutions of a stretch, and highest order, of the spectra in which the cage's lines are sought. These are sharp, since slip
/// spreads a line in proportion to its order, and the cage turns less than half as often as the shaft.
const FINE_REVOLUTIONS: f64 = 256.0;
const HIGHEST_FINE_ORDER: f64 = 6.0;

/// Share of half the sampling rate below which a band begins.
const LATEST_START: f64 = 0.9;

/// What of an envelope a spectrum is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum EnvelopeKind {
    /// Its magnitude.
    Magnitude,
    /// Its magnitude, impulsive frequencies emphasised before: best where noise hides most of the band.
    Impulsive,
    /// The logarithm of its square, in which a few strong knocks do not hide many weak ones (P. Borghesani and J. Antoni,
    /// CS2 analysis in presence of non-Gaussian background noise, Mechanical Systems and Signal Processing 90 (2017) 378-398).
    Logarithm,
}

/// The spectrum of the envelope of a band.
#[derive(Debug, Clone)]
pub(super) struct BandSpectrum {
    /// Edges, Hz.
    pub(super) band_hz: [f64; 2],
    pub(super) kind: EnvelopeKind,
    pub(super) lines: LineSpectrum,
}

/// The band that is searched (Hz): as asked for; where it begins at 0 or none is asked for, from the lowest carrier of events at
/// `strikes_hz` on.
pub(super) fn searched_band(asked_hz: Option<[f64; 2]>, signal: &TimeSeries, strikes_hz: f64) -> [f64; 2] {
    let [from_hz, to_hz] = asked_hz.unwrap_or([0.0, f64::INFINITY]);
    let end_hz = to_hz.min(0.5 * signal.rate_hz());
    if from_hz > 0.0 { [from_hz, end_hz] } else { [(LOWEST_CARRIER * strikes_hz).min(0.5 * end_hz), end_hz] }
}

/// Refuses a band that is asked for where the signal ends.
///
/// # Errors
/// [`DiagnosisError::Refused`].
pub(super) fn check_band(asked_hz: Option<[f64; 2]>, signal: &TimeSeries) -> Result<(), DiagnosisError> {
    let [from_hz, to_hz] = asked_hz.unwrap_or([0.0, f64::INFINITY]);
    let end_hz = 0.5 * signal.rate_hz();
    if from_hz > LATEST_START * end_hz || from_hz >= to_hz {
        let most_hz = LATEST_START * to_hz.min(end_hz);
        return Err(DiagnosisError::Refused(format!(
            "expected a band that begins below {} Hz, nine tenths of what the signal is good for, found one from {} Hz on",
            Brief(most_hz),
            Brief(from_hz)
        )));
    }
    Ok(())
}

/// The whole band, its halves, quarters and eighths, and those halfway between them, no narrower than `narrowest` (Hz).
fn bands([from, to]: [f64; 2], narrowest: f64, levels: u32) -> Vec<[f64; 2]> {
    let mut bands = vec![[from, to]];
    for level in 1..=levels {
        let width = (to - from) / f64::from(2_u32.pow(level));
        if width < narrowest {
            break;
        }
        let count = 2_u32.pow(level + 1) - 1;
        bands.extend((0..count).map(|half| {
            let low = from + 0.5 * f64::from(half) * width;
            [low, low + width]
        }));
    }
    bands
}

/// The spectra that verdicts are sought in.
#[derive(Debug, Clone)]
pub(super) struct Spectra {
    /// Averaged over stretches of 64 revolutions.
    pub(super) lines: Vec<BandSpectrum>,
    /// The low orders of the same envelopes, averaged over stretches of 256 revolutions.
    pub(super) fine: Vec<BandSpectrum>,
}

/// Spectra up to the order `highest` of the envelopes of all bands within `within_hz`, and of the whole of the emphasised signal;
/// `strikes_hz` is the highest frequency at which a part strikes.
pub(super) fn band_spectra(
    signal: &RawSpectrum,
    impulsive: Option<&RawSpectrum>,
    grid: &AngleGrid,
    within_hz: [f64; 2],
    strikes_hz: f64,
    highest: f64,
) -> Result<Spectra, DiagnosisError> {
    let levels = match stretches(grid.turns(), REVOLUTIONS) {
        1 => SHORT_LEVELS,
        _ => LEVELS,
    };
    let bands = bands(within_hz, HARMONICS_A_BAND * strikes_hz, levels);
    let spectra: Result<Vec<Vec<[BandSpectrum; 2]>>, DiagnosisError> = bands
        .into_par_iter()
        .enumerate()
        .map(|(place, band_hz)| {
            let envelope = signal.envelope(band_hz);
            let (start_s, step_s) = (envelope.start_s, envelope.step_s);
            // an envelope has nothing beyond the width of its band
            let own = (band_hz[1] - band_hz[0]) / grid.fastest_hz;
            let of = |kind, values: &[f64]| -> Result<[BandSpectrum; 2], DiagnosisError> {
                let means = grid.means(start_s, step_s, values);
                let scale = match kind {
                    EnvelopeKind::Magnitude | EnvelopeKind::Impulsive => means.iter().sum::<f64>() / means.len() as f64,
                    EnvelopeKind::Logarithm => 2.0,
                };
                let scale = scale.max(f64::MIN_POSITIVE);
                let highest = highest.min(own);
                let spectrum = |highest: f64, revolutions: f64| {
                    let lines = LineSpectrum::new(&means, grid.per_turn, highest, scale, revolutions)?;
                    Ok::<_, DiagnosisError>(BandSpectrum { band_hz, kind, lines })
                };
                Ok([spectrum(highest, REVOLUTIONS)?, spectrum(highest.min(HIGHEST_FINE_ORDER), FINE_REVOLUTIONS)?])
            };
            let mut found = vec![of(EnvelopeKind::Magnitude, &envelope.magnitude())?];
            if place == 0 {
                if let Some(impulsive) = impulsive {
                    found.push(of(EnvelopeKind::Impulsive, &impulsive.envelope(band_hz).magnitude())?);
                }
                let mean = envelope.squared.iter().sum::<f64>() / envelope.squared.len() as f64;
                let mean = mean.max(f64::MIN_POSITIVE);
                let logarithm: Vec<f64> =
                    envelope.squared.iter().map(|power| (power / mean + LEAST_POWER).ln()).collect();
                found.push(of(EnvelopeKind::Logarithm, &logarithm)?);
            }
            Ok(found)
        })
        .collect();
    let (lines, fine) = spectra?.into_iter().flatten().map(|[lines, fine]| (lines, fine)).unzip();
    Ok(Spectra { lines, fine })
}
