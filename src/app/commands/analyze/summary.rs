//! What `analysis.json` says, and `run.json` of windows.

use super::{WindowAnalysis, WindowChange};
use crate::app::commands::result::ResultHead;
use crate::signal::EnvelopePeak;
use crate::signal::diagnosis::{Diagnosis, Fault, FaultOrders, FaultVerdict, SpeedSource, UnexplainedImpacts};
use schemars::JsonSchema;
use serde::Serialize;

/// One input, analysed.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct AnalysisResult {
    /// What all results have.
    #[serde(flatten)]
    pub head: ResultHead,
    /// The input with its orders.
    #[serde(flatten)]
    pub input: InputSummary,
    /// Its windows.
    pub windows: Vec<WindowSummary>,
}

/// Several inputs, analysed into one result.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct SurveyResult {
    /// What all results have.
    #[serde(flatten)]
    pub head: ResultHead,
    /// Inputs that could be read, with their orders.
    pub inputs: Vec<InputSummary>,
    /// What could not be analysed.
    pub failures: Vec<FailureSummary>,
    /// Windows of all of them.
    pub windows: Vec<WindowOfInput>,
}

/// An analysed file or folder.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct InputSummary {
    /// The file or folder.
    pub input: String,
    /// The case that bearing and speed are from, if they are.
    pub case: Option<String>,
    /// Orders of the bearing's faults in the first window; `None` where no signal was analysed.
    pub defect_orders: Option<OrdersSummary>,
}

/// An input, or a channel of it, that was not analysed.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct FailureSummary {
    /// The file or folder.
    pub input: String,
    /// The channel; empty: the whole input.
    pub channel: String,
    /// What is wrong with it.
    pub error: String,
}

/// Orders of a bearing's faults: events in a turn of the shaft; `None` of those not known.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct OrdersSummary {
    /// Turns of the cage.
    pub cage: Option<f64>,
    /// Balls that pass a place of the outer race.
    pub outer: Option<f64>,
    /// Balls that pass a place of the inner race.
    pub inner: Option<f64>,
    /// Strikes of a place on a ball against both races.
    pub ball: Option<f64>,
    /// Relative error of the orders.
    pub relative_error: Option<f64>,
}

/// A window of one of several inputs.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct WindowOfInput {
    /// The file or folder.
    pub input: String,
    /// The window.
    #[serde(flatten)]
    pub window: WindowSummary,
}

/// An analysed window.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct WindowSummary {
    /// Sensor or channel.
    pub sensor: String,
    /// Unit of its signal.
    pub unit: String,
    /// Whether the envelope spectrum is of the whitened signal's squared envelope.
    pub whitened: bool,
    /// Start, s.
    pub from: f64,
    /// End, s.
    pub to: f64,
    /// Mean shaft speed, Hz.
    pub speed_hz: f64,
    /// Root mean square, in the signal's unit.
    pub rms: f64,
    /// Largest magnitude, in the signal's unit.
    pub peak: f64,
    /// Kurtosis (3 for a normal distribution); `None` for a constant signal.
    pub kurtosis: Option<f64>,
    /// Corner of the high-pass before the envelope, Hz; `None`: none.
    pub high_pass_hz: Option<f64>,
    /// Band of the envelope, Hz; `None`: not a band between two frequencies.
    pub band_hz: Option<[f64; 2]>,
    /// Spectral kurtosis of the band that was searched for.
    pub kurtosis_of_band: Option<f64>,
    /// What noise alone stays below.
    pub kurtosis_limit: Option<f64>,
    /// The outer race's line and its second harmonic; empty where its order is not known.
    pub outer_race: Vec<OuterRaceLine>,
    /// Order above which lines over Hz are smeared; `None`: none is.
    pub lines_smeared_above_order: Option<f64>,
    /// Strongest peaks of the envelope spectrum.
    pub envelope_peaks: Vec<EnvelopePeak>,
    /// Verdict on the parts of the bearing.
    pub verdict: VerdictSummary,
    /// What changed since an earlier signal; absent where none was named.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub changes: Option<WindowChange>,
}

/// A line of the outer race in an envelope spectrum.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct OuterRaceLine {
    /// Where it is expected, Hz.
    pub expected_hz: f64,
    /// Peak within three per cent, Hz; `None`: there is none.
    pub found_hz: Option<f64>,
    /// Its amplitude, in the spectrum's unit.
    pub amplitude: Option<f64>,
}

/// A verdict, or why there is none.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct VerdictSummary {
    /// In a sentence.
    pub sentence: String,
    /// What it rests on; absent where there is no verdict.
    #[serde(flatten)]
    pub diagnosis: Option<DiagnosisSummary>,
}

/// What a verdict rests on.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct DiagnosisSummary {
    /// The envelope that shows most.
    pub envelope: String,
    /// How many were judged.
    pub envelopes: usize,
    /// Turns of the shaft in the window.
    pub turns: f64,
    /// Mean shaft speed, Hz: the given one, sharpened where the signal shows it.
    pub speed_hz: f64,
    /// The mean speed that was given, Hz.
    pub given_speed_hz: f64,
    /// Relative uncertainty of the speed.
    pub speed_relative_error: f64,
    /// What shows the speed.
    pub speed_source: SpeedSource,
    /// One verdict a part whose order is known.
    pub faults: Vec<FaultVerdict>,
    /// Impacts that belong to no part.
    pub unexplained: Vec<UnexplainedImpacts>,
    /// Faults that the signal alone indicates and something else speaks against.
    pub by_signal_alone: Vec<Fault>,
}

impl OrdersSummary {
    /// Those of a bearing; without one none is known.
    #[must_use]
    pub(crate) fn of(orders: Option<FaultOrders>) -> Self {
        let order = |fault| orders.and_then(|orders| orders.order(fault));
        Self {
            cage: order(Fault::Cage),
            outer: order(Fault::OuterRace),
            inner: order(Fault::InnerRace),
            ball: order(Fault::Ball),
            relative_error: orders.map(|orders| orders.error(Fault::OuterRace)),
        }
    }
}

impl WindowAnalysis {
    /// What a result says of it.
    #[must_use]
    pub(crate) fn summary(&self) -> WindowSummary {
        let search = self.band.found();
        let line = |(expected_hz, found): &(f64, Option<(f64, f64)>)| OuterRaceLine {
            expected_hz: *expected_hz,
            found_hz: found.map(|found| found.0),
            amplitude: found.map(|found| found.1),
        };
        WindowSummary {
            sensor: self.sensor.clone(),
            unit: self.unit.clone(),
            whitened: self.whitened,
            from: self.from,
            to: self.to,
            speed_hz: self.speed_hz,
            rms: self.rms,
            peak: self.peak,
            kurtosis: self.kurtosis,
            high_pass_hz: self.band.high_pass_hz,
            band_hz: self.band.band_hz(),
            kurtosis_of_band: search.map(|search| search.best.kurtosis),
            kurtosis_limit: search.map(|search| search.best.limit),
            outer_race: self.outer.iter().map(line).collect(),
            lines_smeared_above_order: self.smeared_above,
            envelope_peaks: self.peaks.clone(),
            verdict: VerdictSummary {
                sentence: match &self.diagnosis {
                    Ok(diagnosis) => diagnosis.sentence(),
                    Err(reason) => format!("no verdict: {reason}"),
                },
                diagnosis: self.diagnosis.as_ref().ok().map(DiagnosisSummary::of),
            },
            // a result keeps no spectra
            changes: self.change.as_ref().map(|change| WindowChange { spectra: None, ..change.clone() }),
        }
    }
}

impl DiagnosisSummary {
    fn of(diagnosis: &Diagnosis) -> Self {
        Self {
            envelope: diagnosis.envelope.clone(),
            envelopes: diagnosis.envelopes,
            turns: diagnosis.spectrum.turns,
            speed_hz: diagnosis.speed_hz,
            given_speed_hz: diagnosis.given_speed_hz,
            speed_relative_error: diagnosis.speed_error,
            speed_source: diagnosis.speed_source,
            faults: diagnosis.faults.clone(),
            unexplained: diagnosis.unexplained.clone(),
            by_signal_alone: diagnosis.by_signal_alone.clone(),
        }
    }
}
