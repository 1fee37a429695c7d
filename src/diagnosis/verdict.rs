//! Verdicts on the parts of a bearing, with their evidence.

use serde::Serialize;

use super::comb::{Comb, HARMONICS, Known, Worth, coincidence, side_line, turns_needed};
use super::{DiagnosisError, Fault, FaultOrders, OrderSpectrum};
use crate::series::{TimeSeries, TimeWindow};

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
/// Side lines that are looked at: to so many spacings on each side of so many harmonics.
const SIDES: i32 = 2;
const SIDED_HARMONICS: usize = 3;

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
    /// Its order, events per shaft turn.
    pub order: f64,
    /// Its frequency at the mean speed, Hz.
    pub frequency_hz: f64,
    /// Amplitude in the envelope, in the signal's unit.
    pub amplitude: f64,
    /// Amplitude over the mean of the envelope: how deep the envelope is modulated.
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
    /// Strength of the harmonics beyond the fundamental, 1 and more for bursts, see [`BURST_STRENGTH`]; `None` without any that
    /// is free.
    pub burst_strength: Option<f64>,
    /// Distance of side lines in orders: the shaft's for the inner race, the cage's for a ball.
    pub side_spacing: Option<f64>,
    /// Side lines about the first harmonics.
    pub side_lines: Vec<SideLine>,
    /// Why this, and why not more.
    pub why: String,
}

impl FaultVerdict {
    fn seen(&self) -> impl Iterator<Item = &Harmonic> {
        self.harmonics.iter().filter(|harmonic| harmonic.seen)
    }
}

/// What is said of a window.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// Mean shaft speed, Hz.
    pub speed_hz: f64,
    /// Spectrum of the envelope over the shaft's angle.
    pub spectrum: OrderSpectrum,
    /// One verdict a fault whose order is known, in the order of [`Fault::ALL`].
    pub faults: Vec<FaultVerdict>,
}

impl Diagnosis {
    /// Judges a window (s) of the envelope of a high-passed or band-passed signal; `turns` is the shaft's angle at a time, in
    /// turns.
    ///
    /// Faults are judged from the least likely under noise on; the lines of one that is named do not count for the others.
    ///
    /// # Errors
    /// [`DiagnosisError`]: a shaft that rests or turns back, a window outside the envelope or without samples.
    pub fn of(
        envelope: &TimeSeries,
        window: TimeWindow,
        turns: impl Fn(f64) -> f64,
        orders: &FaultOrders,
    ) -> Result<Self, DiagnosisError> {
        // room for the floor beside the highest harmonic
        let highest = (f64::from(HARMONICS) + 1.0) * orders.highest();
        let spectrum = OrderSpectrum::new(envelope, window, turns, highest)?;
        let speed_hz = spectrum.turns / (window.to - window.from);
        let mut left: Vec<(Fault, f64)> = Fault::ALL
            .into_iter()
            .filter_map(|fault| Some((fault, orders.order(fault)?)))
            .collect();
        let (mut faults, mut known) = (Vec::new(), Vec::new());
        while !left.is_empty() {
            let verdict = |&(fault, order): &(Fault, f64)| {
                let comb = Comb::find(&spectrum, order, orders.error(), &known);
                let judge = Judge {
                    fault,
                    expected: order,
                    cage: orders.order(Fault::Cage),
                    spectrum: &spectrum,
                    speed_hz,
                    known: &known,
                };
                judge.verdict(comb)
            };
            let found: Vec<FaultVerdict> = left.iter().map(verdict).collect();
            let likely = |verdict: &FaultVerdict| verdict.false_alarm.unwrap_or(f64::INFINITY);
            let first = (0..found.len())
                .min_by(|&a, &b| likely(&found[a]).total_cmp(&likely(&found[b])))
                .unwrap_or(0);
            let named = found[first].conclusion == Conclusion::Named;
            if named {
                known.extend(lines(&found[first], &spectrum));
                faults.push(found[first].clone());
                left.remove(first);
            } else {
                faults.extend(found);
                break;
            }
        }
        faults.sort_by_key(|verdict| verdict.fault as usize);
        Ok(Self {
            speed_hz,
            spectrum,
            faults,
        })
    }

    /// The faults that are named.
    pub fn named(&self) -> impl Iterator<Item = &FaultVerdict> {
        let named = |verdict: &&FaultVerdict| verdict.conclusion == Conclusion::Named;
        self.faults.iter().filter(named)
    }

    /// The verdict in a line.
    #[must_use]
    pub fn sentence(&self) -> String {
        let of = |conclusion: Conclusion| {
            let of = self
                .faults
                .iter()
                .filter(|verdict| verdict.conclusion == conclusion);
            of.map(|verdict| verdict.fault.name()).collect::<Vec<_>>()
        };
        let parts = [
            (Conclusion::Named, "fault: "),
            (Conclusion::NotEnough, "not enough evidence: "),
            (Conclusion::NotSeen, "not seen: "),
        ];
        let parts = parts
            .into_iter()
            .map(|(conclusion, word)| (of(conclusion), word));
        let parts = parts.filter(|(faults, _)| !faults.is_empty());
        let parts: Vec<String> = parts
            .map(|(faults, word)| format!("{word}{}", faults.join(", ")))
            .collect();
        parts.join("; ")
    }
}

/// Distance of the side lines of a fault: the load zone comes by once a turn of what carries it.
fn side_spacing(fault: Fault, cage: Option<f64>) -> Option<f64> {
    match fault {
        Fault::InnerRace => Some(1.0),
        Fault::Ball => cage,
        Fault::OuterRace | Fault::Cage => None,
    }
}

/// The lines that a named fault explains: its harmonics, their side lines, and of a ball the cage's multiples, since it comes
/// into the load zone once a turn of the cage.
fn lines(named: &FaultVerdict, spectrum: &OrderSpectrum) -> Vec<Known> {
    let (Some(order), name) = (named.order, named.fault.name()) else {
        return Vec::new();
    };
    let mut lines = Vec::new();
    for k in 1..=HARMONICS {
        let line = f64::from(k) * order;
        lines.push(Known {
            order: line,
            name: format!("{k} x {name}"),
        });
        for offset in (1..=SIDES).flat_map(|m| [-m, m]) {
            let side = named.side_spacing.map(|spacing| Known {
                order: line + f64::from(offset) * spacing,
                name: format!("{k} x {name} {offset:+} x {}", carrier(named.fault)),
            });
            lines.extend(side);
        }
    }
    if let (Fault::Ball, Some(cage)) = (named.fault, named.side_spacing) {
        let count = (spectrum.highest / cage) as u32;
        lines.extend((1..=count).map(|k| Known {
            order: f64::from(k) * cage,
            name: format!("{k} x cage, at which the damaged ball comes into the load"),
        }));
    }
    lines
}

/// What carries a fault through the load zone.
fn carrier(fault: Fault) -> &'static str {
    match fault {
        Fault::Ball => "cage",
        _ => "shaft",
    }
}

/// All that a verdict rests on.
struct Judge<'a> {
    fault: Fault,
    expected: f64,
    cage: Option<f64>,
    spectrum: &'a OrderSpectrum,
    speed_hz: f64,
    known: &'a [Known],
}

impl Judge<'_> {
    fn verdict(&self, comb: Option<Comb>) -> FaultVerdict {
        let mut verdict = FaultVerdict {
            fault: self.fault,
            conclusion: Conclusion::NotEnough,
            false_alarm: None,
            expected_order: self.expected,
            order: None,
            frequency_hz: None,
            harmonics: Vec::new(),
            burst_strength: None,
            side_spacing: side_spacing(self.fault, self.cage),
            side_lines: Vec::new(),
            why: String::new(),
        };
        let Some(comb) = comb else {
            verdict.why = self.too_short();
            return verdict;
        };
        verdict.false_alarm = Some(comb.chance);
        verdict.order = Some(comb.order);
        verdict.frequency_hz = Some(comb.order * self.speed_hz);
        verdict.harmonics = self.harmonics(&comb);
        verdict.burst_strength = burst_strength(&verdict.harmonics);
        verdict.side_lines = self.side_lines(&comb, verdict.side_spacing);
        (verdict.conclusion, verdict.why) = conclude(&verdict, comb.chance);
        verdict
    }

    fn too_short(&self) -> String {
        let (turns, needed) = (self.spectrum.turns, turns_needed(self.expected));
        if turns < needed {
            format!(
                "the window has {turns:.1} shaft turns: at least {needed:.1} are needed to tell these lines from the floor about them"
            )
        } else {
            format!(
                "the signal ends at order {:.1}, below the second harmonic of this fault and its floor: a higher sampling rate is needed",
                self.spectrum.highest
            )
        }
    }

    fn harmonics(&self, comb: &Comb) -> Vec<Harmonic> {
        let harmonic = |tooth: &super::comb::Tooth| Harmonic {
            harmonic: tooth.harmonic,
            order: tooth.order,
            frequency_hz: tooth.order * self.speed_hz,
            amplitude: tooth.amplitude,
            depth: tooth.amplitude / self.spectrum.mean,
            above_floor_db: 10.0 * tooth.ratio.log10(),
            seen: tooth.worth == Worth::Seen,
            coincides_with: match &tooth.worth {
                Worth::Coincides(name) => Some(name.clone()),
                _ => None,
            },
            leakage_of: match &tooth.worth {
                Worth::Leakage(name) => Some(name.clone()),
                _ => None,
            },
        };
        comb.teeth.iter().map(harmonic).collect()
    }

    fn side_lines(&self, comb: &Comb, spacing: Option<f64>) -> Vec<SideLine> {
        let Some(spacing) = spacing else {
            return Vec::new();
        };
        let bin = 1.0 / self.spectrum.turns;
        let mut lines = Vec::new();
        for tooth in comb.teeth.iter().take(SIDED_HARMONICS) {
            for offset in (-SIDES..=SIDES).filter(|&offset| offset != 0) {
                let order = tooth.order + f64::from(offset) * spacing;
                let free = spacing > bin && coincidence(order, bin, self.known).is_none();
                let Some((ratio, seen)) = side_line(self.spectrum, order, comb.order) else {
                    continue;
                };
                lines.push(SideLine {
                    harmonic: tooth.harmonic,
                    offset,
                    order,
                    above_floor_db: 10.0 * ratio.log10(),
                    seen: seen && free,
                });
            }
        }
        lines
    }
}

/// See [`BURST_STRENGTH`].
fn burst_strength(harmonics: &[Harmonic]) -> Option<f64> {
    let (first, others) = harmonics.split_first()?;
    let free = others.iter().filter(|h| h.coincides_with.is_none());
    let (mut found, mut jump) = (0.0, 0.0);
    for harmonic in free {
        found += harmonic.amplitude.powi(2);
        jump += (first.amplitude / f64::from(harmonic.harmonic)).powi(2);
    }
    (jump > 0.0).then(|| found / jump)
}

/// Conclusion and reason.
fn conclude(verdict: &FaultVerdict, chance: f64) -> (Conclusion, String) {
    let free = verdict.harmonics.iter();
    let free = free.filter(|harmonic| harmonic.coincides_with.is_none());
    let (free, seen) = (free.count(), verdict.seen().count());
    let sides = verdict.side_lines.iter().filter(|line| line.seen).count();
    let strength = verdict.burst_strength.unwrap_or(0.0);
    let mut found = format!(
        "{seen} of {free} free harmonics stand out, {strength:.1} times as strong as a jump has them; noise would do it with probability {chance:.0e}"
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
    (Conclusion::Named, found)
}
