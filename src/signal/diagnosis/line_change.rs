//! What is said of a change since an earlier signal: the words, the limits, the figures.
//!
//! How the vibration as a whole, and that of each octave, changed since an earlier signal.

use super::ratio_interval::{Scattered, interval_db};
use super::{DiagnosisError, Fault};
use crate::numerics::series::{TimeSeries, TimeWindow};
use crate::signal::RawSpectrum;
use schemars::JsonSchema;
use serde::Serialize;

/// A change counts as growth or decay where the 95 % interval lies beyond so many dB: another mounting of the sensor, another load or
/// temperature change a level by as much.
pub const LEAST_CHANGE_DB: f64 = 3.0;
/// Growth of which the 95 % interval lies above so many dB, ten times the amplitude, is strong evidence of damage: practice calls twice the
/// amplitude a change and ten times it serious (R. B. Randall, Vibration-based Condition Monitoring, 2011).
pub const STRONG_CHANGE_DB: f64 = 20.0;
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
    // what rounds to zero has no minus
    let tenth = |db: f64| (10.0 * db).round() / 10.0 + 0.0;
    match (change_db.map(tenth), interval_db.map(|db| db.map(tenth))) {
        (Some(change), [Some(low), Some(high)]) => {
            format!("{change:+.1} dB ({low:.1} to {high:.1})")
        }
        (_, [Some(low), _]) => format!("at least {low:+.1} dB"),
        (_, [_, Some(high)]) => format!("at most {high:+.1} dB"),
        (_, [None, None]) => String::new(),
    }
}

/// Blocks whose scatter says how well a level is known.
const BLOCKS: usize = 20;
/// Octaves from one to the next (IEC 61260-1, base ten).
const OCTAVE: f64 = 1.995_262_314_968_879_5;
const CENTRE_HZ: f64 = 1000.0;
/// Least number of independent values that an octave has in a block.
const LEAST_VALUES: f64 = 4.0;

/// Root mean square in both signals.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, JsonSchema)]
pub struct LevelChange {
    /// Centre of the octave, Hz; `None`: all of the signal.
    pub centre_hz: Option<f64>,
    /// Root mean square in the earlier signal, in its unit.
    pub earlier: f64,
    /// The same in this signal.
    pub now: f64,
    /// Change, dB; `None` where one of them is silent.
    pub change_db: Option<f64>,
    /// 95 % interval of it, dB, from the scatter between 20 blocks of each signal.
    pub interval_db: [Option<f64>; 2],
    /// What is said of it, by the limits of the parts' changes.
    pub conclusion: ChangeConclusion,
}

/// Sampling rates that differ by no more than this part are the same.
const SAME_RATE: f64 = 1e-3;

/// Changes of the RMS from the earlier window to that of this signal (both in s, inside the series). The first is of the whole signal without its
/// mean. Where sampling rates differ it is of what both reach. The others are of each octave that both reach.
///
/// Each window is cut into 20 blocks. The relative variance of their mean squares, over their number, is that of the mean; the interval is that of
/// the ratio of two gamma variables of such variances. Blocks that are alike by luck are allowed for, a level that drifts within the window
/// only as far as it shows.
///
/// # Errors
/// A window outside its series, or without samples.
pub(crate) fn level_changes(
    (now, now_window): (&TimeSeries, TimeWindow),
    (earlier, earlier_window): (&TimeSeries, TimeWindow),
) -> Result<Vec<LevelChange>, DiagnosisError> {
    let parts = [now.window(now_window.from, now_window.to)?, earlier.window(earlier_window.from, earlier_window.to)?];
    let whole = |part: &TimeSeries| {
        let mean = part.mean();
        let squares: Vec<f64> = part.values().iter().map(|v| (v - mean).powi(2)).collect();
        scattered(&squares)
    };
    let spectra = [RawSpectrum::of(&parts[0])?, RawSpectrum::of(&parts[1])?];
    let least_s = parts[0].duration_s().min(parts[1].duration_s());
    let end_hz = 0.5 * parts[0].rate_hz().min(parts[1].rate_hz());
    let within = |spectrum: &RawSpectrum, band_hz: [f64; 2]| {
        let envelope = spectrum.envelope(band_hz);
        // the mean square is half of the squared envelope
        let squares: Vec<f64> = envelope.squared.iter().map(|v| 0.5 * v).collect();
        scattered(&squares)
    };
    let same_rate = (parts[0].rate_hz() / parts[1].rate_hz() - 1.0).abs() < SAME_RATE;
    let all = if same_rate {
        [whole(&parts[0]), whole(&parts[1])]
    } else {
        let common_hz = [1.0 / least_s, end_hz];
        [within(&spectra[0], common_hz), within(&spectra[1], common_hz)]
    };
    let mut changes = vec![change(None, all)];
    let half = OCTAVE.sqrt();
    // an octave is as wide as its centre over the root of two
    let lowest_hz = LEAST_VALUES * BLOCKS as f64 / (least_s * (half - 1.0 / half));
    let number = |hz: f64| (hz / CENTRE_HZ).ln() / OCTAVE.ln();
    let (first, last) = (number(lowest_hz).ceil(), number(end_hz / half).floor());
    for place in first as i32..=last as i32 {
        let centre_hz = CENTRE_HZ * OCTAVE.powi(place);
        let of = |spectrum: &RawSpectrum| within(spectrum, [centre_hz / half, centre_hz * half]);
        changes.push(change(Some(centre_hz), [of(&spectra[0]), of(&spectra[1])]));
    }
    Ok(changes)
}

/// Mean of squares with the scatter between their blocks.
fn scattered(squares: &[f64]) -> Scattered {
    let length = squares.len().div_ceil(BLOCKS).max(1);
    let blocks: Vec<f64> = squares.chunks(length).map(|block| block.iter().sum::<f64>() / block.len() as f64).collect();
    let count = blocks.len() as f64;
    let power = squares.iter().sum::<f64>() / squares.len().max(1) as f64;
    let freedom = (count - 1.0).max(1.0);
    let square = blocks.iter().map(|block| (block - power).powi(2)).sum::<f64>() / freedom;
    Scattered {
        power,
        variance: square / (count * power * power).max(f64::MIN_POSITIVE),
        freedom,
        floor: 0.0,
        floor_variance: 0.0,
    }
}

/// Of the mean squares of this signal and the earlier one.
fn change(centre_hz: Option<f64>, [now, earlier]: [Scattered; 2]) -> LevelChange {
    let levels =
        LevelChange { centre_hz, earlier: earlier.power.sqrt(), now: now.power.sqrt(), ..LevelChange::default() };
    if !(now.power > 0.0 && earlier.power > 0.0) {
        return levels;
    }
    let interval_db = interval_db(&now, &earlier);
    LevelChange {
        change_db: Some(10.0 * (now.power / earlier.power).log10()),
        interval_db,
        conclusion: ChangeConclusion::of(interval_db),
        ..levels
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::diagnosis::tests::Noise;

    fn noise(seed: u64, level: f64, tone: f64) -> TimeSeries {
        let mut noise = Noise(seed);
        let values = (0..40_000).map(|k| {
            let t = f64::from(k) / 20e3;
            level * noise.normal() + tone * (std::f64::consts::TAU * 3000.0 * t).sin()
        });
        TimeSeries::new(0.0, 1.0 / 20e3, "g", values.collect()).unwrap()
    }

    #[test]
    fn the_octave_that_grew_is_the_one_with_the_tone() {
        let (earlier, now) = (noise(1, 1.0, 0.0), noise(2, 1.0, 2.0));
        let changes = level_changes((&now, now.span()), (&earlier, earlier.span())).unwrap();
        // mean squares 1 and 1 + 2
        assert!((changes[0].change_db.unwrap() - 10.0 * 3.0_f64.log10()).abs() < 0.1);
        for change in &changes[1..] {
            let centre = change.centre_hz.unwrap();
            // 2.8 to 5.6 kHz
            let tone = (centre - 3981.0).abs() < 1.0;
            let expected = if tone { ChangeConclusion::Grew } else { ChangeConclusion::AsBefore };
            assert_eq!(change.conclusion, expected, "{change:?}");
        }
        // 4 values in each of 20 blocks of 2 s: octaves from 57 Hz on; 4 kHz is the last below 10 kHz / 1.41
        let last = changes.last().unwrap().centre_hz.unwrap();
        assert!((last - 3981.07).abs() < 0.01, "{last}");
        assert!((changes[1].centre_hz.unwrap() - 63.1).abs() < 0.1);
    }

    #[test]
    fn intervals_hold_no_change_as_often_as_they_say() {
        let hits = (0..200).filter(|&run| {
            let (a, b) = (noise(2 * run + 10, 1.0, 0.0), noise(2 * run + 11, 1.0, 0.0));
            let changes = level_changes((&a, a.span()), (&b, b.span())).unwrap();
            let [low, high] = changes[0].interval_db.map(Option::unwrap);
            low <= 0.0 && 0.0 <= high
        });
        // 95 % of 200, and three deviations of 3.1 to each side
        let hits = hits.count();
        assert!((180..=199).contains(&hits), "{hits}");
    }

    /// White noise of one density has half of its power below half of the frequency.
    #[test]
    fn of_two_sampling_rates_what_both_reach_is_compared() {
        let now = noise(3, 1.0, 0.0);
        let mut half = Noise(4);
        let values = (0..20_000).map(|_| 0.5_f64.sqrt() * half.normal()).collect();
        let earlier = TimeSeries::new(0.0, 1.0 / 10e3, "g", values).unwrap();
        let changes = level_changes((&now, now.span()), (&earlier, earlier.span())).unwrap();
        // the scatter of 20 000 squares is 0.06 dB
        assert!(changes[0].change_db.unwrap().abs() < 0.25, "{:?}", changes[0]);
    }

    #[test]
    fn silence_is_not_compared() {
        let silent = TimeSeries::new(0.0, 1e-3, "g", vec![0.0; 5000]).unwrap();
        let changes = level_changes((&silent, silent.span()), (&silent, silent.span())).unwrap();
        assert!(changes.iter().all(|c| c.conclusion == ChangeConclusion::NotCompared));
    }
}
