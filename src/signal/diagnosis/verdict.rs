//! Verdicts on the parts of a bearing, with their evidence.

use schemars::JsonSchema;
use serde::Serialize;

use super::Fault;
use super::comb::LEAST_FREE;
use super::known::carrier;
use super::line_spectrum::{LineSpectrum, REVOLUTIONS};

/// Probability by chance below which a fault is indicated.
pub const NAMED_BELOW: f64 = 1e-3;
/// Probability by chance above which nothing is said to be seen.
pub const UNSEEN_ABOVE: f64 = 0.05;
/// Harmonics that must be seen, free of others, before a fault is indicated; the fundamental or the second among them.
pub const LEAST_HARMONICS: usize = LEAST_FREE;
/// Mean power over the floor of the first five free harmonics before a fault is indicated, dB at a resolution of 1 / 64 of a revolution.
/// Sound bearings have lines at these orders too, of balls that pass under the load, of marks of assembly, of other bearings'
/// damage that is heard; they are weaker. See `docs/diagnosis.md` for what was measured.
pub const LEAST_STRENGTH_DB: f64 = 15.0;
/// Harmonics that must be seen in a window of fewer than 96 revolutions.
pub const LEAST_SHORT_HARMONICS: usize = 2;
/// The level in a window of fewer than 96 revolutions: one stretch scatters by 5 dB a line, and shows no weak lines at all.
pub const LEAST_SHORT_STRENGTH_DB: f64 = 12.0;
/// The same for a cage. Balls of unequal size, and a ball that is damaged, change the vibration once a revolution of the cage as well.
pub const LEAST_CAGE_STRENGTH_DB: f64 = 18.0;
/// Mean power over the floor of the cage's lines from which they indicate a ball, dB at a resolution of 1 / 256 of a revolution. Sound
/// bearings and damaged races without that have 7.4 dB at most, balls from 6.3 on (`docs/diagnosis.md`).
pub const LEAST_CAGE_LINES_DB: f64 = 8.0;
/// Probability by chance below which the cage's lines indicate a ball: they are an indirect sign.
pub const BALL_BY_CAGE_BELOW: f64 = 1e-6;
/// Least impulsiveness of a fault, [`FaultVerdict::impulsiveness`].
pub const LEAST_IMPULSIVENESS: f64 = 0.2;
/// The same in a window of fewer than 96 revolutions, where the noise in more and coarser harmonics adds to it. A healthy bearing
/// under ten times its shaft's weight has more than 0.2 in 13 revolutions.
pub const LEAST_SHORT_IMPULSIVENESS: f64 = 0.4;

/// What is said of a part.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub enum Conclusion {
    /// The part is damaged, as far as a signal can say it.
    #[serde(rename = "named")]
    Named,
    /// Something is there, or the window cannot say.
    #[default]
    #[serde(rename = "not enough evidence")]
    NotEnough,
    /// Nothing that chance would not do.
    #[serde(rename = "not seen")]
    NotSeen,
}

impl Conclusion {
    /// In words.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Named => "fault indicated",
            Self::NotEnough => "not enough evidence",
            Self::NotSeen => "not seen",
        }
    }
}

/// A harmonic of a fault's line, as found.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Harmonic {
    /// What it is called: "2 x ball -1 x cage".
    pub name: String,
    /// Which one, from 1.
    pub harmonic: u32,
    /// 0, or -1 or 1 for the line that many spacings beside it, where those count too.
    pub side: i32,
    /// Its order, events per revolution of the shaft.
    pub order: f64,
    /// Its frequency at the mean speed, Hz.
    pub frequency_hz: f64,
    /// Amplitude over the mean of the judged envelope: how deep it is modulated.
    pub depth: f64,
    /// Power over the median of the floor about it, dB.
    pub above_floor_db: f64,
    /// Whether it is free and noise would do it less than once in a hundred.
    pub seen: bool,
    /// The line that it coincides with within the resolution; it does not count then.
    pub coincides_with: Option<String>,
}

/// A line beside a harmonic: a sideband.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SideLine {
    /// Harmonic that it is beside.
    pub harmonic: u32,
    /// How many spacings away.
    pub offset: i32,
    /// Its order.
    pub order: f64,
    /// Power over the median of the floor about it, dB.
    pub above_floor_db: f64,
    /// Whether it is free and noise would do it less than once in a hundred.
    pub seen: bool,
}

/// What is said of one part, and why.
#[derive(Debug, Clone, Default, PartialEq, Serialize, JsonSchema)]
pub struct FaultVerdict {
    /// The part.
    pub fault: Fault,
    /// What is said of it.
    pub conclusion: Conclusion,
    /// Probability that chance looks as much like it: by the score of the same comb at other orders of the same signal. `None` where
    /// the window is too short.
    pub false_alarm: Option<f64>,
    /// Order of its line by the kinematics.
    pub expected_order: f64,
    /// Order where its lines fit best.
    pub order: Option<f64>,
    /// That order at the mean speed, Hz.
    pub frequency_hz: Option<f64>,
    /// Band whose envelope shows it best, Hz.
    pub band_hz: Option<[f64; 2]>,
    /// Its harmonics.
    pub harmonics: Vec<Harmonic>,
    /// Harmonics among the first five that coincide with nothing else.
    pub harmonics_free: usize,
    /// Those of them that noise would show less than once in a hundred.
    pub harmonics_seen: usize,
    /// Mean power of the free ones over their floor, dB, at a resolution of 1 / 64 of a revolution; of an inner race with that of the
    /// sidebands of the first three.
    pub strength_db: Option<f64>,
    /// Amplitudes A_k of the free harmonics beyond the first against those of a jump that decays, `sum A_k^2 / sum (A_1 / k)^2`: 1 or more for
    /// impacts, less where resonance, filters and slip damp high harmonics; 0.16 or less for what swells and ebbs once an event.
    pub impulsiveness: Option<f64>,
    /// Distance of sidebands in orders: the shaft's for the inner race, the cage's for a ball.
    pub side_spacing: Option<f64>,
    /// Sidebands about the first harmonics.
    pub side_lines: Vec<SideLine>,
    /// The lines of the cage, where it is by these that a ball is indicated: `false_alarm` and
    /// `strength_db` are theirs then.
    pub cage_lines: Option<CageLines>,
    /// The evidence, and why not more.
    pub why: String,
    /// What decided, in a sentence.
    pub reason: String,
}

/// The lines of the cage, by which a ball shows that differs from the others.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CageLines {
    /// Probability by chance.
    pub false_alarm: f64,
    /// Order of the cage where they fit best, revolutions per revolution of the shaft.
    pub order: f64,
    /// That order at the mean speed, Hz.
    pub frequency_hz: f64,
    /// Band whose envelope shows them best, Hz.
    pub band_hz: [f64; 2],
    /// Harmonics among the deciding ones that stand out.
    pub harmonics_seen: usize,
    /// Mean power of the free harmonics over their floor, dB, at a resolution of 1 / 256 of a revolution.
    pub strength_db: f64,
    /// The harmonics.
    pub harmonics: Vec<Harmonic>,
}

impl FaultVerdict {
    /// Says something else of it, for a reason that is added to the evidence.
    pub(crate) fn revise(&mut self, conclusion: Conclusion, reason: String) {
        self.conclusion = conclusion;
        self.why = format!("{} {reason}", self.why).trim_start().to_owned();
        self.reason = reason;
    }
}

/// Repeated impacts at an order that belongs to no part of the bearing, nor to the shaft.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct UnexplainedImpacts {
    /// Events per revolution of the shaft.
    pub order: f64,
    /// Frequency at the mean speed, Hz.
    pub frequency_hz: f64,
    /// Probability by chance.
    pub false_alarm: f64,
    /// Harmonics among the first five that stand out.
    pub harmonics_seen: usize,
    /// Mean power of the free harmonics over their floor, dB, as of a part.
    pub strength_db: Option<f64>,
    /// Band whose envelope shows them best, Hz.
    pub band_hz: [f64; 2],
}

/// What the harmonics of a comb amount to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Evidence {
    pub(super) free: usize,
    pub(super) seen: usize,
    /// Whether the fundamental or the second harmonic is seen.
    pub(super) first: bool,
    pub(super) strength_db: Option<f64>,
    pub(super) impulsiveness: Option<f64>,
    least: Least,
}

/// What a fault has to reach.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Least {
    seen: usize,
    strength_db: f64,
    impulsiveness: f64,
}

impl Evidence {
    pub(super) fn of(harmonics: &[Harmonic], lines: &LineSpectrum) -> Self {
        let deciding = harmonics.iter().filter(|h| h.side == 0 && h.harmonic <= lines.harmonics);
        let free: Vec<&Harmonic> = deciding.filter(|h| h.coincides_with.is_none()).collect();
        // a finer resolution takes the floor down and leaves the lines
        let finer_db = 10.0 * (REVOLUTIONS * lines.resolution).max(1.0).log10();
        let level = |h: &&Harmonic| h.above_floor_db.clamp(0.0, 26.0);
        let strength = free.iter().map(level).sum::<f64>() / free.len().max(1) as f64;
        let least = if lines.is_short() {
            Least {
                seen: LEAST_SHORT_HARMONICS,
                strength_db: LEAST_SHORT_STRENGTH_DB,
                impulsiveness: LEAST_SHORT_IMPULSIVENESS,
            }
        } else {
            Least { seen: LEAST_HARMONICS, strength_db: LEAST_STRENGTH_DB, impulsiveness: LEAST_IMPULSIVENESS }
        };
        Self {
            free: free.len(),
            seen: free.iter().filter(|h| h.seen).count(),
            first: harmonics.iter().any(|h| h.harmonic <= 2 && h.seen),
            strength_db: (!free.is_empty()).then_some(strength + finer_db),
            impulsiveness: impulsiveness(&free),
            least,
        }
    }

    /// Whether lines are as those of impacts.
    pub(super) fn is_clear(&self) -> bool {
        self.seen >= self.least.seen
            && self.first
            && self.strength_db.is_some_and(|db| db >= self.least.strength_db)
            && self.impulsiveness.is_none_or(|x| x >= self.least.impulsiveness)
    }
}

/// See [`FaultVerdict::impulsiveness`]. Where the first harmonic is not free the second takes its place, as half of the first.
fn impulsiveness(free: &[&Harmonic]) -> Option<f64> {
    let first = free.first()?;
    let scale = first.depth * f64::from(first.harmonic);
    let (mut found, mut jump) = (0.0, 0.0);
    for harmonic in &free[1..] {
        found += harmonic.depth.powi(2);
        jump += (scale / f64::from(harmonic.harmonic)).powi(2);
    }
    (jump > 0.0).then(|| found / jump)
}

/// A probability in words: "below 1e-12", "3e-5", "0.2".
pub(crate) fn probability(chance: f64) -> String {
    if chance < 1e-12 {
        "below 1e-12".to_owned()
    } else if chance >= 0.095 {
        format!("{chance:.1}")
    } else {
        format!("{chance:.0e}")
    }
}

/// Conclusion, evidence and reason.
pub(super) fn conclude(verdict: &FaultVerdict, evidence: &Evidence, chance: f64) -> (Conclusion, String, String) {
    let (free, seen) = (evidence.free, evidence.seen);
    let strength = evidence.strength_db.unwrap_or(0.0);
    let mut found = format!("{seen} of {free} free harmonics stand out; probability by chance {}", probability(chance));
    if chance >= UNSEEN_ABOVE {
        return (Conclusion::NotSeen, format!("{found}."), "No more lines stand out than chance makes.".to_owned());
    }
    let reason = format!("{seen} harmonics stand out, {strength:.0} dB above the floor on the average.");
    found.push_str(&format!("; {strength:.0} dB above the floor on the average"));
    if let Some([from, to]) = verdict.band_hz {
        found.push_str(&format!(", band {from:.0} to {to:.0} Hz"));
    }
    if let Some(impulsiveness) = verdict.impulsiveness {
        found.push_str(&format!(
            "; impulsiveness {impulsiveness:.1} (1 or more: impacts; {LEAST_IMPULSIVENESS} or less: slow modulation)"
        ));
    }
    let sides = verdict.side_lines.iter().filter(|line| line.seen).count();
    if !verdict.side_lines.is_empty() {
        found.push_str(&format!(
            "; {sides} of {} sidebands at the {}'s distance",
            verdict.side_lines.len(),
            carrier(verdict.fault)
        ));
    }
    let least = evidence.least;
    let too_few = format!(
        "A verdict needs at least {} harmonics that stand out, one of them the first or the second.",
        least.seen
    );
    let by_chance = format!(
        "Of a thousand windows without damage, about {:.0} look like this by chance. A longer window may decide.",
        (1e3 * chance).ceil()
    );
    let objections = [
        (chance >= NAMED_BELOW, by_chance.as_str()),
        (seen < least.seen || !evidence.first, too_few.as_str()),
        (
            verdict.impulsiveness.is_some_and(|x| x < least.impulsiveness),
            "That is a slow modulation, which balls passing under the load make without any damage.",
        ),
        (
            strength < least.strength_db,
            "That is weak: sound bearings have such lines too, of the load, of assembly, of damage elsewhere. Compare with an earlier signal.",
        ),
        (
            verdict.fault == Fault::Cage && strength < LEAST_CAGE_STRENGTH_DB,
            "A ball that differs from the others, by damage or size, shows once a revolution of the cage as well.",
        ),
    ];
    if let Some((_, text)) = objections.into_iter().find(|(holds, _)| *holds) {
        return (Conclusion::NotEnough, format!("{found}. {text}"), text.to_owned());
    }
    let beside = match verdict.fault {
        Fault::OuterRace => {
            " In a bearing with play, balls that strike as they enter the load zone do so at this order too: compare with an earlier signal."
        }
        _ => "",
    };
    (Conclusion::Named, format!("{found}.{beside}"), reason)
}
