//! Every part judged in a spectrum: the least likely under noise first, the others beside its lines.

use super::chance::any_of;
use super::comb::{Comb, HARMONICS, Known, Tooth, Worth, coincidence, side_line, turns_needed};
use super::verdict::conclude;
use super::{
    Conclusion, EnvelopeOrderSpectrum, Fault, FaultOrders, FaultVerdict, Harmonic, SideLine,
};

/// Side lines that are looked at: to so many spacings on each side of so many harmonics.
const SIDES: i32 = 2;
const SIDED_HARMONICS: usize = 3;

/// Verdicts on all faults in one spectrum of `trials`, and in that of the signal's own envelope.
pub(super) fn faults(
    [spectrum, plain]: [&EnvelopeOrderSpectrum; 2],
    speed_hz: f64,
    orders: &FaultOrders,
    trials: usize,
) -> Vec<FaultVerdict> {
    let mut left: Vec<(Fault, f64)> = Fault::ALL
        .into_iter()
        .filter_map(|fault| Some((fault, orders.order(fault)?)))
        .collect();
    let (mut faults, mut known) = (Vec::new(), Vec::new());
    while !left.is_empty() {
        let judge = Judge {
            orders,
            spectrum,
            plain,
            speed_hz,
            trials,
            known: &known,
        };
        let found: Vec<FaultVerdict> = left
            .iter()
            .map(|&(fault, order)| judge.verdict(fault, order))
            .collect();
        let likely = |verdict: &FaultVerdict| verdict.false_alarm.unwrap_or(f64::INFINITY);
        let first = (0..found.len())
            .min_by(|&a, &b| likely(&found[a]).total_cmp(&likely(&found[b])))
            .unwrap_or(0);
        if found[first].conclusion == Conclusion::Named {
            known.extend(lines(&found[first], spectrum));
            faults.push(found[first].clone());
            left.remove(first);
        } else {
            faults.extend(found);
            break;
        }
    }
    faults.sort_by_key(|verdict| verdict.fault as usize);
    faults
}

/// Distance of the side lines of a fault: the load zone comes by once a turn of what carries it.
fn side_spacing(fault: Fault, cage: Option<f64>) -> Option<f64> {
    match fault {
        Fault::InnerRace => Some(1.0),
        Fault::Ball => cage,
        Fault::OuterRace | Fault::Cage => None,
    }
}

/// What a line is called: "2 x ball -1 x cage".
#[must_use]
pub fn line_name(fault: Fault, harmonic: u32, side: i32) -> String {
    let name = fault.name();
    match side {
        0 => format!("{harmonic} x {name}"),
        _ => format!("{harmonic} x {name} {side:+} x {}", carrier(fault)),
    }
}

/// The lines that a named fault explains: its harmonics, their side lines, and of a ball the cage's multiples, since it comes
/// into the load zone once a turn of the cage.
fn lines(named: &FaultVerdict, spectrum: &EnvelopeOrderSpectrum) -> Vec<Known> {
    let Some(order) = named.order else {
        return Vec::new();
    };
    let mut lines = Vec::new();
    // bursts have more harmonics than are judged, and those of a part with a higher order lie among them
    let count = (spectrum.highest / order).max(f64::from(HARMONICS)) as u32;
    for k in 1..=count {
        let line = f64::from(k) * order;
        lines.push(Known {
            order: line,
            name: line_name(named.fault, k, 0),
        });
        for offset in (1..=SIDES).flat_map(|m| [-m, m]) {
            let side = named.side_spacing.map(|spacing| Known {
                order: line + f64::from(offset) * spacing,
                name: line_name(named.fault, k, offset),
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
pub(super) fn carrier(fault: Fault) -> &'static str {
    match fault {
        Fault::Ball => "cage",
        _ => "shaft",
    }
}

/// All that verdicts rest on.
struct Judge<'a> {
    orders: &'a FaultOrders,
    spectrum: &'a EnvelopeOrderSpectrum,
    /// That of the signal's own envelope.
    plain: &'a EnvelopeOrderSpectrum,
    speed_hz: f64,
    /// Spectra that are judged, of which the best is shown.
    trials: usize,
    known: &'a [Known],
}

impl Judge<'_> {
    fn verdict(&self, fault: Fault, expected: f64) -> FaultVerdict {
        let mut verdict = FaultVerdict {
            fault,
            conclusion: Conclusion::NotEnough,
            false_alarm: None,
            expected_order: expected,
            order: None,
            frequency_hz: None,
            harmonics: Vec::new(),
            harmonics_free: 0,
            harmonics_seen: 0,
            burst_strength: None,
            side_spacing: side_spacing(fault, self.orders.order(Fault::Cage)),
            side_lines: Vec::new(),
            why: String::new(),
        };
        let Some((comb, chance)) = self.best_comb(fault, expected, verdict.side_spacing) else {
            verdict.why = self.too_short(expected);
            return verdict;
        };
        verdict.false_alarm = Some(chance);
        verdict.order = Some(comb.order);
        verdict.frequency_hz = Some(comb.order * self.speed_hz);
        verdict.harmonics = self.harmonics(&comb);
        (verdict.harmonics_free, verdict.harmonics_seen) = (comb.free, comb.seen);
        // balls that pass under a load with play may sound like bursts in a whitened signal, and swell and ebb in the signal
        let own = burst_strength(&verdict.harmonics, |harmonic| harmonic.amplitude);
        let plain = burst_strength(&verdict.harmonics, |harmonic| self.plain.at(harmonic.order));
        verdict.burst_strength = own.zip(plain).map(|(own, plain)| own.min(plain));
        verdict.side_lines = self.side_lines(&comb, verdict.side_spacing);
        (verdict.conclusion, verdict.why) = conclude(&verdict, chance);
        verdict
    }

    /// The comb of a fault and the probability of the best of all trials. A ball's has two: it strikes in the load zone alone,
    /// where it is for a part of a turn of the cage, so that its power may lie beside its harmonics as well as on them.
    fn best_comb(&self, fault: Fault, order: f64, spacing: Option<f64>) -> Option<(Comb, f64)> {
        let find = |beside| {
            Comb::find(
                self.spectrum,
                order,
                self.orders.error(fault),
                beside,
                self.known,
            )
        };
        let (comb, combs) = match (fault, find(None)?, spacing) {
            (Fault::Ball, alone, Some(_)) => {
                let sided = find(spacing).filter(|sided| sided.chance < alone.chance);
                (sided.unwrap_or(alone), 2)
            }
            (_, alone, _) => (alone, 1),
        };
        let chance = any_of(comb.chance, self.trials * combs);
        Some((comb, chance))
    }

    fn too_short(&self, expected: f64) -> String {
        let (turns, needed) = (self.spectrum.turns, turns_needed(expected));
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
        let harmonic = |tooth: &Tooth| Harmonic {
            harmonic: tooth.harmonic,
            side: tooth.side,
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
        let central = comb.teeth.iter().filter(|tooth| tooth.side == 0);
        for tooth in central.take(SIDED_HARMONICS) {
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

/// See [`BURST_STRENGTH`](super::BURST_STRENGTH); lines beside a harmonic are compared with those beside the first.
fn burst_strength(harmonics: &[Harmonic], amplitude: impl Fn(&Harmonic) -> f64) -> Option<f64> {
    let (first, others): (Vec<&Harmonic>, Vec<&Harmonic>) = harmonics
        .iter()
        .partition(|harmonic| harmonic.harmonic == 1);
    let (mut found, mut jump) = (0.0, 0.0);
    for harmonic in others.into_iter().filter(|h| h.coincides_with.is_none()) {
        let Some(first) = first.iter().find(|first| first.side == harmonic.side) else {
            continue;
        };
        found += amplitude(harmonic).powi(2);
        jump += (amplitude(first) / f64::from(harmonic.harmonic)).powi(2);
    }
    (jump > 0.0).then(|| found / jump)
}
