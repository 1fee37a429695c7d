//! Beyond the horizon: figures that sum a signal up, over an ensemble of runs, with their scatter.

use super::budget::Deadline;
use super::scene::Ready;
use super::trace::Failure;
use super::{Settings, Start};
use crate::app::error::ComputeError;
use crate::app::scene::RunModel;
use crate::numerics::series::TimeSeries;
use crate::signal::{EnvelopeAnalysis, SignalError, third_octaves};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;

/// Standard errors beyond which a difference is not chance: with many runs one in 370 is larger by chance alone.
pub const BEYOND_CHANCE: f64 = 3.0;

/// A figure of a signal.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// What it is.
    pub name: String,
    /// Its unit, "" for none.
    pub unit: &'static str,
    /// Its value.
    pub value: f64,
}

/// Mean of a figure over an ensemble.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct Estimate {
    /// Mean.
    #[schemars(with = "Option<f64>")]
    pub mean: f64,
    /// Standard deviation of one run.
    #[schemars(with = "Option<f64>")]
    pub deviation: f64,
    /// Standard error of the mean: `deviation / sqrt(runs)`.
    #[schemars(with = "Option<f64>")]
    pub standard_error: f64,
}

/// A figure of two models over the same starts.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ComparedFigure {
    /// What it is.
    pub name: String,
    /// Its unit, "" for none.
    pub unit: &'static str,
    /// Of the model.
    pub own: Estimate,
    /// Of the reference.
    pub reference: Estimate,
    /// Of their difference, start by start: what the starts have in common does not count.
    pub difference: Estimate,
    /// Mean difference in its standard errors; zero where there is no difference at all.
    #[schemars(with = "Option<f64>")]
    pub standard_errors: f64,
    /// Whether it differs by more than chance and the target.
    pub differs: bool,
}

impl ComparedFigure {
    /// Whether the model's figure differs by more than chance (three standard errors) and by more than a relative
    /// `target`; levels by as many decibels as that makes.
    fn differs_by(&self, target: f64) -> bool {
        let limit = match self.unit {
            "dB" => 20.0 * (1.0 + target).log10(),
            _ => target * self.reference.mean.abs(),
        };
        self.standard_errors.abs() > BEYOND_CHANCE && self.difference.mean.abs() > limit
    }
}

impl Estimate {
    /// Mean and scatter of values that are independent of each other, at least two.
    pub(crate) fn of(values: &[f64]) -> Self {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares = values.iter().map(|value| (value - mean).powi(2));
        let deviation = (squares.sum::<f64>() / (count - 1.0).max(1.0)).sqrt();
        Self { mean, deviation, standard_error: deviation / count.sqrt() }
    }
}

/// Figures of a signal limited to `band_hz`: root mean square, kurtosis, largest magnitude, mean and largest of the envelope
/// above `high_pass_hz`, levels of third-octave bands (dB re 1 m/s^2).
///
/// # Errors
/// [`SignalError`] for a filter that does not fit the sampling.
fn figures(signal: &TimeSeries, settings: FigureSettings) -> Result<Vec<Figure>, SignalError> {
    let FigureSettings { band_hz, high_pass_hz } = settings;
    let figure = |name: &str, unit, value| Figure { name: name.to_owned(), unit, value };
    let settings = EnvelopeAnalysis { high_pass_hz, ..EnvelopeAnalysis::default() };
    let envelope = settings.envelope(signal)?;
    let mut figures = vec![
        figure("root mean square", "m/s^2", signal.rms()),
        figure("kurtosis", "", signal.kurtosis().unwrap_or(f64::NAN)),
        figure("largest magnitude", "m/s^2", signal.peak()),
        figure("mean envelope", "m/s^2", envelope.mean()),
        figure("envelope peak", "m/s^2", envelope.peak()),
    ];
    let [low, high] = band_hz;
    for band in third_octaves(signal, low, high)? {
        // a signal without anything there has no level
        let level = 20.0 * band.rms.max(f64::MIN_POSITIVE).log10();
        figures.push(figure(&format!("level at {} Hz", nominal(band.centre_hz)), "dB", level));
    }
    Ok(figures)
}

/// A band's centre as it is named: to two digits, and 1250, 3150, 12 500, 31 500 to three.
fn nominal(centre_hz: f64) -> f64 {
    let decade = 10_f64.powf(centre_hz.log10().floor());
    let digits = centre_hz / decade;
    let named = [1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0, 10.0];
    let nearest = named.into_iter().min_by(|a, b| {
        let apart = |x: f64| (x / digits).ln().abs();
        apart(*a).total_cmp(&apart(*b))
    });
    (nearest.unwrap_or(digits) * decade).round()
}

/// Figures of the first sensor in every run of an ensemble, in order of the starts: from rest and perturbed, over the span of
/// the statistics. Runs in parallel, each reduced to its figures before the next begins.
///
/// # Errors
/// The [`Failure`] of the first start that fails.
pub(super) fn ensemble(
    system: &Ready,
    starts: &[Start],
    model: &RunModel,
    settings: &Settings,
    analysis: &FigureSettings,
    until: Deadline,
    done: impl Fn() + Sync,
) -> Result<Vec<Vec<Figure>>, Failure> {
    let runs: Vec<_> = starts
        .par_iter()
        .map(|start| {
            let span = settings.simulated(settings.statistics_s);
            let simulation = system.simulate(start, model, span, Some(settings.ensemble), until)?;
            let signal = simulation.signal(0)?;
            let signal = crate::signal::band_limit(&signal, settings.band_hz).map_err(ComputeError::from)?;
            let end = signal.start_s() + settings.statistics_s;
            let signal = signal.window(signal.start_s(), end).map_err(ComputeError::from)?;
            let figures = figures(&signal, *analysis);
            done();
            Ok(figures.map_err(ComputeError::from)?)
        })
        .collect();
    runs.into_iter().collect()
}

/// What figures are taken of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FigureSettings {
    pub(super) band_hz: [f64; 2],
    pub(super) high_pass_hz: Option<f64>,
}

/// Figures of an ensemble against those of the reference from the same starts; `target` is the relative error that is good enough.
pub(super) fn compare(own: &[Vec<Figure>], reference: &[Vec<Figure>], target: f64) -> Vec<ComparedFigure> {
    let Some(first) = reference.first() else {
        return Vec::new();
    };
    let column = |runs: &[Vec<Figure>], place: usize| -> Vec<f64> { runs.iter().map(|run| run[place].value).collect() };
    first
        .iter()
        .enumerate()
        .map(|(place, figure)| {
            let (own, reference) = (column(own, place), column(reference, place));
            let difference: Vec<f64> = own.iter().zip(&reference).map(|(a, b)| a - b).collect();
            let difference = Estimate::of(&difference);
            let has_scatter = difference.standard_error > 0.0;
            let mut compared = ComparedFigure {
                name: figure.name.clone(),
                unit: figure.unit,
                own: Estimate::of(&own),
                reference: Estimate::of(&reference),
                difference,
                standard_errors: if has_scatter { difference.mean / difference.standard_error } else { 0.0 },
                differs: false,
            };
            compared.differs = compared.differs_by(target);
            compared
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn a_mean_has_its_standard_error() {
        let values: Vec<f64> = (0..1001).map(|k| f64::from(k) / 1000.0).collect();
        let estimate = Estimate::of(&values);
        // even over 0 to 1: mean 1/2, variance 1/12 and a grid's 1/1000 more
        assert!((estimate.mean - 0.5).abs() < 1e-12);
        assert!((estimate.deviation / (1.0 / 12.0_f64).sqrt() - 1.0).abs() < 2e-3);
        let error = estimate.deviation / 1001_f64.sqrt();
        assert!((estimate.standard_error - error).abs() < 1e-15);
        // of 0 and 2: the sample's variance is 2
        assert!((Estimate::of(&[0.0, 2.0]).deviation - 2_f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn what_starts_have_in_common_does_not_count() {
        let runs = |values: &[f64]| -> Vec<Vec<Figure>> {
            let figure = |value: &f64| Figure { name: "kurtosis".to_owned(), unit: "", value: *value };
            values.iter().map(|value| vec![figure(value)]).collect()
        };
        let found = compare(&runs(&[1.5, 10.5, 100.8]), &runs(&[1.0, 10.0, 100.0]), 0.015);
        // differences 0.5, 0.5, 0.8: mean 0.6, standard error 0.1
        assert!((found[0].difference.mean - 0.6).abs() < 1e-12);
        assert!((found[0].standard_errors - 6.0).abs() < 1e-9);
        assert!(found[0].own.standard_error > 30.0);
        // 0.6 of a mean of 37: 1.6 %
        assert!(found[0].differs && found[0].differs_by(0.015) && !found[0].differs_by(0.017));
        let level = ComparedFigure { unit: "dB", ..found[0].clone() };
        // 0.6 dB: 7.15 %
        assert!(level.differs_by(0.071) && !level.differs_by(0.072));
        let chance = compare(&runs(&[2.0, 10.0]), &runs(&[1.0, 10.0]), 0.01);
        assert!(!chance[0].differs);
        let same = compare(&runs(&[1.0, 2.0]), &runs(&[1.0, 2.0]), 0.01);
        assert!(same[0].standard_errors <= 0.0);
        assert!(compare(&[], &[], 0.01).is_empty());
    }

    #[test]
    fn figures_of_a_tone() {
        let values = (0..20_000).map(|k| 4.0 * (TAU * 8e3 * f64::from(k) * 5e-6).sin());
        let signal = TimeSeries::new(0.0, 5e-6, "m/s^2", values.collect()).unwrap();
        let found = figures(&signal, FigureSettings { band_hz: [0.0, 40e3], high_pass_hz: Some(5e3) }).unwrap();
        let of = |name: &str| {
            let figure = found.iter().find(|figure| figure.name == name);
            figure.unwrap_or_else(|| panic!("{name}: {found:?}")).value
        };
        assert!((of("root mean square") - 8_f64.sqrt()).abs() < 1e-6);
        assert!((of("kurtosis") - 1.5).abs() < 1e-6);
        // the high-pass of fourth order at 5 kHz, forwards and backwards, leaves 1 / (1 + (5/8)^8) of the tone
        let expected = 4.0 / (1.0 + 0.625_f64.powi(8));
        assert!((of("mean envelope") / expected - 1.0).abs() < 1e-3);
        assert!((of("level at 8000 Hz") - 20.0 * 8_f64.sqrt().log10()).abs() < 0.05);
        assert!(found.iter().any(|figure| figure.name == "level at 31500 Hz"));
        assert!(found.iter().any(|figure| figure.name == "level at 1250 Hz"));
    }
}
