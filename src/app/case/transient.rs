//! `[accuracy]`, `[transient]` and `[analysis]`: what is simulated, how finely, and what is made of the signals.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::EnvelopeBand;
use super::schema::{forms, number, together, whole, words};
use super::union::{Loose, NoTable, read_as};
use crate::numerics::series::TimeWindow;

/// What the signals must be good for.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Accuracy {
    /// Lowest and highest frequency of interest in Hz, 0 <= lowest < highest.
    pub band_hz: [f64; 2],
    /// Relative error that is good enough, > 0 and < 1.
    #[serde(default = "one_percent")]
    pub target: f64,
}

fn one_percent() -> f64 {
    0.01
}

/// The simulation in time. It begins in static equilibrium at the start time's speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Transient {
    /// In s, >= 0.
    #[serde(default)]
    pub start: f64,
    /// In s, after the start.
    pub end: f64,
    /// How time is stepped.
    #[serde(default)]
    pub method: Method,
    /// For `generalized-alpha`: share of the amplitude that a step leaves of motions far too fast for it, 0 to 1; `None`:
    /// 0.8.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spectral_radius: Option<f64>,
    /// Length of a step; time between samples of a method that chooses its steps.
    #[serde(default)]
    pub step: StepLength,
    /// For `dop853`: relative error of a step, > 0 and < 1; `None`: 1e-6. For `exponential-adams`: part of the force that a
    /// step may leave out of its prediction; `None`: equal steps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Sampling rate of the signals in Hz, at least twice the highest frequency of interest.
    pub output_hz: f64,
    /// Which coupled modes of ring and housing are kept.
    #[serde(default)]
    pub modes: ModesKept,
    /// Whether the static compliance of the modes left out is kept, at the contacts and at the sensors.
    #[serde(default = "super::yes")]
    pub residual: bool,
    /// The runs that `chart` takes statistics and scatter from.
    #[serde(default)]
    pub ensemble: Ensemble,
}

/// Runs of one scene from starts that differ, spread over a ball pass from the start time on. A run whose statistics are
/// taken is perturbed beside: every coordinate and velocity by a part of itself, at random.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Ensemble {
    /// How many, 2 to 10 000.
    pub runs: usize,
    /// Largest relative change of a coordinate, > 0 and < 1.
    pub perturbation: f64,
    /// Begin of the random numbers: the same seed gives the same runs.
    pub seed: u64,
}

impl Default for Ensemble {
    fn default() -> Self {
        // a perturbation far below every error of interest, far above rounding
        Self { runs: 20, perturbation: 1e-9, seed: 1 }
    }
}

/// How time is stepped.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// The program's choice.
    #[default]
    Auto,
    /// The linear part exactly, the contact forces held over a step.
    Exponential,
    /// The same with a polynomial through the forces of three steps: third order, for contacts and modes that a step resolves.
    ExponentialAdams,
    /// Explicit Newmark, the source paper's.
    NewmarkExplicit,
    /// Impulses of the contact forces between exact flows of the linear part: to see it fail.
    Splitting,
    /// Implicit: Newmark's method of average acceleration.
    Newmark,
    /// Implicit, with damping of what the step does not resolve.
    GeneralizedAlpha,
    /// Explicit Runge-Kutta of order 8(5,3) by the tolerance, its steps ending where contacts begin and end.
    Dop853,
}

/// Length of a time step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum StepLength {
    /// The program's choice.
    #[default]
    Auto,
    /// In s, > 0.
    #[serde(untagged)]
    Seconds(f64),
}

read_as!(StepLength, Loose<NoTable>, forms(vec![words(&["auto"]), number()]), |form| match form {
    Loose::Word(word) if word == "auto" => Ok(Self::Auto),
    Loose::Number(seconds) => Ok(Self::Seconds(seconds)),
    // Steps of whole seconds are far below 2^53.
    Loose::Whole(seconds) => Ok(Self::Seconds(seconds as f64)),
    other => Err(other.mismatch(&["auto"], "\"auto\" or a number")),
});

/// Which coupled modes of ring and housing are kept in the simulation.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ModesKept {
    /// As many as the accuracy asked for needs.
    #[default]
    Auto,
    /// All of them.
    All,
    /// The lowest so many, at least 1.
    #[serde(untagged)]
    Count(usize),
}

read_as!(ModesKept, Loose<NoTable>, forms(vec![words(&["auto", "all"]), whole()]), |form| match form {
    Loose::Word(word) if word == "auto" => Ok(Self::Auto),
    Loose::Word(word) if word == "all" => Ok(Self::All),
    Loose::Whole(count) => Ok(Self::Count(count)),
    other => Err(other.mismatch(&["auto", "all"], "\"auto\", \"all\" or a whole number")),
});

/// What is made of the signals.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(extend("not" = together(&["high_pass_hz", "band_hz"])))]
pub struct Analysis {
    /// Corner of the high-pass filter before the envelope in Hz, > 0 and below half the sampling rate; `None`, without
    /// `band_hz` either: no filter.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub high_pass_hz: Option<f64>,
    /// The band before the envelope, in the place of `high_pass_hz`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub band_hz: Option<EnvelopeBand>,
    /// Whether the envelope spectra are those of the whitened signal's squared envelope.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub whiten: bool,
    /// Windows whose envelope spectra are computed; may be empty.
    pub envelope: Vec<TimeWindow>,
    /// Scalogram of every sensor; `None`: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scalogram: Option<ScalogramWindow>,
    /// Whether the balance of the run's energy is taken, which costs up to a third of a fast run's time; `None`:
    /// of runs of up to 100 000 samples.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub energy: Option<bool>,
}

/// What a scalogram shows: amplitude over time and frequency.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScalogramWindow {
    /// In s.
    pub from: f64,
    /// In s, after `from`.
    pub to: f64,
    /// Lowest and highest frequency in Hz; the highest below half the sampling rate.
    pub band_hz: [f64; 2],
    /// Cycles of the wavelet, 2 to 1000: more tell frequencies apart better, and instants worse.
    #[serde(default = "usual_cycles")]
    pub cycles: f64,
}

fn usual_cycles() -> f64 {
    6.0
}
