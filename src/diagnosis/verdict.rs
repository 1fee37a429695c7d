//! Verdicts on the parts of a bearing, with their evidence.

use serde::Serialize;

use super::Fault;
use super::judge::carrier;

/// Probability under noise alone below which a fault is named: of a thousand windows of noise one, for each fault.
pub const NAMED_BELOW: f64 = 1e-3;
/// Probability under noise alone above which nothing is said to be seen.
pub const UNSEEN_ABOVE: f64 = 0.05;
/// Harmonics that must be seen, free of others, before a fault is named.
pub const LEAST_HARMONICS: usize = 3;
/// Least strength of the harmonics beyond the fundamental for bursts: `sum A_k^2 / sum (A_1 / k)^2` over the free ones. A jump that
/// decays exponentially has `A_k = A_1 sqrt((1 + x^2) / (1 + k^2 x^2)) >= A_1 / k` however long it takes, so 1 or more; what swells
/// and ebbs without a jump falls off as 1 / k^2 or faster: 0.16 or less with eight harmonics.
pub const BURST_STRENGTH: f64 = 1.0;
/// What is said of a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Conclusion {
    /// The part is damaged, as far as a signal can say it.
    #[serde(rename = "named")]
    Named,
    /// Something is there, or the window cannot say.
    #[serde(rename = "not enough evidence")]
    NotEnough,
    /// Nothing that noise would not do.
    #[serde(rename = "not seen")]
    NotSeen,
}

impl Conclusion {
    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Named => "named",
            Self::NotEnough => "not enough evidence",
            Self::NotSeen => "not seen",
        }
    }
}

/// A harmonic of a fault's line, as found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Harmonic {
    /// Which one, from 1.
    pub harmonic: u32,
    /// 0, or -1 or 1 for the line that many spacings beside it, where those count too.
    pub side: i32,
    /// Its order, events per shaft turn.
    pub order: f64,
    /// Its frequency at the mean speed, Hz.
    pub frequency_hz: f64,
    /// Amplitude in the judged envelope, in its unit.
    pub amplitude: f64,
    /// Amplitude over the mean of that envelope: how deep it is modulated.
    pub depth: f64,
    /// Power over the median of the floor about it, dB.
    pub above_floor_db: f64,
    /// Whether it counts and noise would do it less than once in a hundred.
    pub seen: bool,
    /// What it coincides with within the resolution; it does not count then.
    pub coincides_with: Option<String>,
    /// The stronger line whose leakage could be all of it; it is no evidence then.
    pub leakage_of: Option<String>,
}

/// A line beside a harmonic.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SideLine {
    /// Harmonic that it is beside.
    pub harmonic: u32,
    /// How many spacings away.
    pub offset: i32,
    /// Its order.
    pub order: f64,
    /// Power over the median of the floor about it, dB.
    pub above_floor_db: f64,
    /// Whether noise would do it less than once in a hundred.
    pub seen: bool,
}

/// What is said of one part, and why.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FaultVerdict {
    /// The part.
    pub fault: Fault,
    /// What is said of it.
    pub conclusion: Conclusion,
    /// Probability that noise alone looks as much like it; `None` where the window is too short.
    pub false_alarm: Option<f64>,
    /// Order of its line by the kinematics.
    pub expected_order: f64,
    /// Order where its lines fit best.
    pub order: Option<f64>,
    /// That order at the mean speed, Hz.
    pub frequency_hz: Option<f64>,
    /// Its harmonics.
    pub harmonics: Vec<Harmonic>,
    /// Harmonics that coincide with nothing else.
    pub harmonics_free: usize,
    /// Those of them that noise would show, with their side lines where these count, less than once in a hundred.
    pub harmonics_seen: usize,
    /// Strength of the harmonics beyond the fundamental, the lesser of that in the judged envelope and in the signal's own, 1 and more for bursts, see [`BURST_STRENGTH`]; `None` without any that
    /// is free.
    pub burst_strength: Option<f64>,
    /// Distance of side lines in orders: the shaft's for the inner race, the cage's for a ball.
    pub side_spacing: Option<f64>,
    /// Side lines about the first harmonics.
    pub side_lines: Vec<SideLine>,
    /// Why this, and why not more.
    pub why: String,
}

/// One digit: of small ones as a power of ten.
fn probability(chance: f64) -> String {
    if chance >= 0.095 {
        format!("{chance:.1}")
    } else {
        format!("{chance:.0e}")
    }
}

/// Conclusion and reason.
pub(super) fn conclude(verdict: &FaultVerdict, chance: f64) -> (Conclusion, String) {
    let (free, seen) = (verdict.harmonics_free, verdict.harmonics_seen);
    let sides = verdict.side_lines.iter().filter(|line| line.seen).count();
    let strength = verdict.burst_strength.unwrap_or(0.0);
    // the strength of what noise makes is no evidence
    let strong = if seen == 0 || chance >= UNSEEN_ABOVE {
        String::new()
    } else {
        format!(", {strength:.1} times as strong as a jump has them")
    };
    let mut found = format!(
        "{seen} of {free} free harmonics stand out{strong}; noise would do it with probability {}",
        probability(chance)
    );
    if !verdict.side_lines.is_empty() {
        let all = verdict.side_lines.len();
        found.push_str(&format!(
            "; {sides} of {all} lines beside them at the {}'s distance",
            carrier(verdict.fault)
        ));
    }
    let reason = |text: &str| format!("{found}. {text}");
    if free < LEAST_HARMONICS {
        let text = format!(
            "At least {LEAST_HARMONICS} harmonics that coincide with nothing else are needed: a longer window separates more"
        );
        return (Conclusion::NotEnough, reason(&text));
    }
    if chance >= UNSEEN_ABOVE {
        return (Conclusion::NotSeen, found);
    }
    if chance >= NAMED_BELOW {
        let text =
            format!("A fault is named below {NAMED_BELOW:.0e}: a longer window would decide");
        return (Conclusion::NotEnough, reason(&text));
    }
    if seen < LEAST_HARMONICS || strength < BURST_STRENGTH {
        let text = format!(
            "Bursts show in at least {LEAST_HARMONICS} harmonics that are as strong as those of a jump; fewer or weaker ones are what balls passing under the load make without any damage"
        );
        return (Conclusion::NotEnough, reason(&text));
    }
    if verdict.fault == Fault::OuterRace {
        let text = "Balls that strike as they enter the load zone through the play do so at this order too: compare with an earlier signal";
        return (Conclusion::Named, reason(text));
    }
    (Conclusion::Named, found)
}
