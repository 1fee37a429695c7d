//! What is said of a change since an earlier signal: the words, the limits, the figures.

use schemars::JsonSchema;
use serde::Serialize;

use super::Fault;

/// A change counts as growth or decay where the 95 % interval lies beyond so many dB: another mounting of the sensor, another load or
/// temperature change a level by as much.
pub const LEAST_CHANGE_DB: f64 = 3.0;
/// Nothing changed where the 95 % interval lies within so many dB, a factor of two.
pub const AS_BEFORE_WITHIN_DB: f64 = 6.0;

/// What is said of a change.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub enum ChangeConclusion {
    /// The interval lies above 3 dB.
    #[serde(rename = "grew")]
    Grew,
    /// The interval lies within 6 dB to each side.
    #[serde(rename = "as before")]
    AsBefore,
    /// The interval lies below -3 dB.
    #[serde(rename = "fell")]
    Fell,
    /// The interval holds no change and more than 6 dB.
    #[serde(rename = "not certain")]
    NotCertain,
    /// The lines are above the noise in neither signal, or cannot be seen in one of them.
    #[default]
    #[serde(rename = "cannot be compared")]
    NotCompared,
}

impl ChangeConclusion {
    /// In words.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Grew => "grew",
            Self::AsBefore => "as before",
            Self::Fell => "fell",
            Self::NotCertain => "not certain",
            Self::NotCompared => "cannot be compared",
        }
    }

    /// Of a 95 % interval in dB; an end that is `None` is open.
    pub(crate) fn of([low, high]: [Option<f64>; 2]) -> Self {
        if low.is_some_and(|low| low > LEAST_CHANGE_DB) {
            return Self::Grew;
        }
        if high.is_some_and(|high| high < -LEAST_CHANGE_DB) {
            return Self::Fell;
        }
        match (low, high) {
            (Some(low), Some(high)) if low > -AS_BEFORE_WITHIN_DB && high < AS_BEFORE_WITHIN_DB => Self::AsBefore,
            _ => Self::NotCertain,
        }
    }
}

/// How the impacts of a part, or of something else, changed.
#[derive(Debug, Clone, Default, PartialEq, Serialize, JsonSchema)]
pub struct LineChange {
    /// The part; `None` for impacts that belong to none.
    pub fault: Option<Fault>,
    /// What is compared: "outer race", "ball by the cage's lines", "impacts at 88.20 Hz".
    pub name: String,
    /// What is said of it.
    pub conclusion: ChangeConclusion,
    /// Ten times the decimal logarithm of the ratio of the combs' powers, half of it since the envelope is squared, dB. `None` where a comb
    /// is not above its noise.
    pub change_db: Option<f64>,
    /// 95 % interval of the change, dB; an end is `None` where there is none.
    pub interval_db: [Option<f64>; 2],
    /// Level of the comb in the earlier signal, in its unit: the root of the amplitude of the squared envelope's lines. `None` where it is not
    /// above its noise.
    pub earlier: Option<f64>,
    /// The same in this signal.
    pub now: Option<f64>,
    /// Order where the comb fits best in the earlier signal.
    pub order_earlier: Option<f64>,
    /// The same in this signal.
    pub order_now: Option<f64>,
    /// Band whose envelope is compared, Hz.
    pub band_hz: Option<[f64; 2]>,
    /// How much the band as a whole changed, dB: a part whose lines grew no more than this may be heard through what did.
    pub band_change_db: Option<f64>,
    /// Harmonics that are compared.
    pub harmonics: Vec<u32>,
    /// Why this, and why not more.
    pub why: String,
}

impl LineChange {
    /// "+12.3 dB (11.0 to 13.6)", "at least +14.1 dB", "at most -8.0 dB"; empty where nothing is known.
    pub(crate) fn words(&self) -> String {
        change_words(self.change_db, self.interval_db)
    }
}

/// A change with its interval, in words.
pub(crate) fn change_words(change_db: Option<f64>, interval_db: [Option<f64>; 2]) -> String {
    match (change_db, interval_db) {
        (Some(change), [Some(low), Some(high)]) => {
            format!("{change:+.1} dB ({low:.1} to {high:.1})")
        }
        (_, [Some(low), _]) => format!("at least {low:+.1} dB"),
        (_, [_, Some(high)]) => format!("at most {high:+.1} dB"),
        (_, [None, None]) => String::new(),
    }
}
