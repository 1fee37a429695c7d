//! Explanations compared: each part of the bearing, repeated impacts of something else, or neither. What explains the most goes first;
//! its lines are no evidence for the others, whether it is named or not.

use super::bands::{BandSpectrum, EnvelopeKind};
use super::comb::{Fit, LEAST_FREE, Masked, SHOWN_HARMONICS, best_fit};
use super::control::{ByChance, control_scores};
use super::fault::{Fault, FaultOrders};
use super::known::{KnownLine, Mask, coincidence, impact_lines, line_name, shaft_lines};
use super::line_spectrum::REVOLUTIONS;
use super::verdict::{Evidence, FaultVerdict, Harmonic, SideLine, UnexplainedImpacts, conclude};

/// Probability by chance below which a comb explains lines, named or not.
const EXPLAINS_BELOW: f64 = 0.01;
/// Bins that the floor of a part's fundamental needs within half of it, to each side.
const FLOOR_BINS: f64 = 8.0;
/// Lowest and highest order of impacts of something else.
const UNEXPLAINED_ORDERS: [f64; 2] = [0.3, 16.0];
/// Impacts of something else are said below this probability by chance.
const UNEXPLAINED_BELOW: f64 = 1e-4;
/// Ratios and sums in which orders are related, so that a comb of the one is one of the other's lines.
const RELATED: u32 = 4;
const RELATED_SIDES: i32 = 3;
/// A comb at a part of another's order is the same impacts' where it scores at least this part of the other's score.
const SAME_COMB: f64 = 0.7;
/// Multiples of the cage's order that the balls make as they come into the load one after the other.
const CAGE_MULTIPLES: u32 = 5;
/// Parts of an order in which its fundamental is sought.
const LOWEST_PART: u32 = 5;
/// Most combs that are explained one after the other.
const MOST_ROUNDS: usize = 8;
/// Side lines that are looked at: to so many spacings on each side of so many harmonics.
const SIDES: i32 = 2;
const SIDED_HARMONICS: u32 = 3;

/// Everything that verdicts are sought in.
pub(super) struct Search<'a> {
    pub(super) spectra: &'a [BandSpectrum],
    pub(super) orders: &'a FaultOrders,
    /// Shaft revolutions of the window.
    pub(super) turns: f64,
    pub(super) speed_hz: f64,
    /// Relative uncertainty of the shaft's speed.
    pub(super) speed_error: f64,
}

/// What was found.
pub(super) struct Found {
    pub(super) faults: Vec<FaultVerdict>,
    pub(super) unexplained: Vec<UnexplainedImpacts>,
    /// Spectrum of the strongest comb.
    pub(super) spectrum: usize,
}

/// A comb that is the best of its kind, before it is judged.
struct Candidate {
    fault: Option<Fault>,
    fit: Fit,
    beside: Option<f64>,
    /// Reach of its search over its order.
    relative_reach: f64,
}

/// Shaft revolutions that the floor of a part's lines needs.
pub(super) fn turns_needed(order: f64) -> f64 {
    2.0 * FLOOR_BINS / order
}

impl Search<'_> {
    pub(super) fn run(&self) -> Found {
        let highest = self
            .spectra
            .iter()
            .map(|spectrum| spectrum.lines.end())
            .fold(1.0, f64::max);
        let mut known = shaft_lines(highest, self.speed_error);
        let mut found = Found {
            faults: Vec::new(),
            unexplained: Vec::new(),
            spectrum: 0,
        };
        let mut open: Vec<(Fault, f64)> = Vec::new();
        for fault in Fault::ALL {
            let Some(order) = self.orders.order(fault) else {
                continue;
            };
            if self.turns < turns_needed(order) {
                found.faults.push(self.too_short(fault, order));
            } else {
                open.push((fault, order));
            }
        }
        let mut first = true;
        for _ in 0..MOST_ROUNDS {
            let masked = self.masked(&known);
            let parts = open
                .iter()
                .filter_map(|&(fault, order)| self.part(&masked, fault, order));
            let best = parts
                .chain(self.something_else(&masked))
                .max_by(|a, b| a.fit.score.total_cmp(&b.fit.score));
            let Some(best) = best else { break };
            if first {
                found.spectrum = best.fit.spectrum;
                first = false;
            }
            let own = self.own_lines(&best, highest);
            let Some(chance) = self.chance(&masked, &best, &own) else {
                break;
            };
            if chance >= EXPLAINS_BELOW {
                break;
            }
            match best.fault {
                Some(fault) => {
                    let expected = self.orders.order(fault).unwrap_or(best.fit.order);
                    let verdict = self.verdict(fault, expected, &best, chance, &known);
                    found.faults.push(verdict);
                    open.retain(|(other, _)| *other != fault);
                }
                None => found
                    .unexplained
                    .extend(self.unexplained(&best, chance, &known)),
            }
            known.extend(own);
        }
        let masked = self.masked(&known);
        for (fault, order) in open {
            let verdict = match self.part(&masked, fault, order) {
                Some(best) => {
                    let chance = self.chance(&masked, &best, &[]).unwrap_or(1.0);
                    self.verdict(fault, order, &best, chance, &known)
                }
                None => self.hidden(fault, order, &known),
            };
            found.faults.push(verdict);
        }
        found.faults.sort_by_key(|verdict| verdict.fault as usize);
        found
    }

    fn masked(&self, known: &[KnownLine]) -> Vec<Masked<'_>> {
        let masked = self.spectra.iter().map(|spectrum| {
            let mut mask = Mask::new(&spectrum.lines);
            mask.take(&spectrum.lines, known);
            Masked { spectrum, mask }
        });
        masked.collect()
    }

    /// The best comb of a part; lines beside the harmonics count where that scores more.
    fn part(&self, masked: &[Masked<'_>], fault: Fault, order: f64) -> Option<Candidate> {
        let relative_reach = self.orders.error(fault) + self.speed_error;
        let reach = relative_reach * order;
        let of = |beside| {
            Some(Candidate {
                fault: Some(fault),
                fit: best_fit(masked, order, reach, beside)?,
                beside,
                relative_reach,
            })
        };
        let alone = of(None);
        match self.side_spacing(fault) {
            Some(spacing) if fault == Fault::Ball => alone
                .into_iter()
                .chain(of(Some(spacing)))
                .max_by(|a, b| a.fit.score.total_cmp(&b.fit.score)),
            _ => alone,
        }
    }

    /// The best comb that is none of a part, of the shaft, or of what one of them and the shaft or the cage make together.
    fn something_else(&self, masked: &[Masked<'_>]) -> Option<Candidate> {
        let [from, to] = UNEXPLAINED_ORDERS;
        let resolution = self.spectra.first()?.lines.resolution;
        let mut best: Option<Fit> = None;
        // so that every place is looked at by one search of half the resolution to each side
        let least = from.max(turns_needed(1.0) / self.turns);
        let mut order = least;
        let fit_at = |order: f64| {
            let fit = best_fit(masked, order, 0.0, None)?;
            (!self.is_related(fit.order, resolution)).then_some(fit)
        };
        while order < to {
            if let Some(fit) = fit_at(order)
                && best.is_none_or(|best| fit.score > best.score)
            {
                best = Some(fit);
            }
            order += resolution;
        }
        // the harmonics of a harmonic score as much as those of its fundamental
        let lowest = best.and_then(|best| {
            let parts = (2..=LOWEST_PART).rev();
            let mut fits = parts
                .map(|part| best.order / f64::from(part))
                .filter(|order| *order >= least)
                .filter_map(fit_at);
            fits.find(|fit| fit.score >= SAME_COMB * best.score)
        });
        lowest.or(best).map(|fit| Candidate {
            fault: None,
            fit,
            beside: None,
            relative_reach: 0.0,
        })
    }

    /// Whether an order is one of the lines that a part or the shaft has anyway, or one of which they are harmonics.
    fn is_related(&self, order: f64, resolution: f64) -> bool {
        let cage = self.orders.order(Fault::Cage);
        let near = |line: f64, reach: f64| (order - line).abs() < reach + 3.0 * resolution;
        // half and third revolutions: belts, rubs
        if (1..=3).any(|n| {
            let multiple = (order * f64::from(n)).round() / f64::from(n);
            near(multiple, self.speed_error * order)
        }) {
            return true;
        }
        Fault::ALL.into_iter().any(|fault| {
            let Some(part) = self.orders.order(fault) else {
                return false;
            };
            let reach = self.orders.error(fault) * part;
            let ratios = (1..=RELATED).flat_map(|i| (1..=RELATED).map(move |j| (i, j)));
            let mut ratios = ratios.map(|(i, j)| f64::from(i) / f64::from(j));
            if ratios.any(|ratio| near(ratio * part, ratio * reach)) {
                return true;
            }
            (1..=2).any(|harmonic| {
                (-RELATED_SIDES..=RELATED_SIDES).any(|side| {
                    let (line, side) = (f64::from(harmonic) * part, f64::from(side));
                    let reach = f64::from(harmonic) * reach;
                    near(line + side, reach)
                        || cage.is_some_and(|cage| near(line + side * cage, reach))
                })
            })
        })
    }

    /// Lines that a candidate explains.
    fn own_lines(&self, candidate: &Candidate, highest: f64) -> Vec<KnownLine> {
        let name = match candidate.fault {
            Some(fault) => fault.name().to_owned(),
            None => format!("{:.2} Hz", candidate.fit.order * self.speed_hz),
        };
        let resolution = self.spectra[candidate.fit.spectrum].lines.resolution;
        let cage = self.orders.order(Fault::Cage);
        let cage = cage.filter(|_| candidate.fault != Some(Fault::Cage));
        let mut lines = impact_lines(&name, candidate.fit.order, cage, highest, resolution);
        if let (Some(_), Some(cage)) = (candidate.fault, cage) {
            lines.extend((1..=CAGE_MULTIPLES).map(|multiple| KnownLine {
                order: f64::from(multiple) * cage,
                error: self.orders.error(Fault::Cage) + self.speed_error,
                name: format!("{multiple} x cage, at which each ball comes into the load"),
            }));
        }
        lines
    }

    /// Probability by chance of a candidate, its own lines taken out of the controls.
    fn chance(
        &self,
        masked: &[Masked<'_>],
        candidate: &Candidate,
        own: &[KnownLine],
    ) -> Option<f64> {
        let without: Vec<Masked<'_>> = masked
            .iter()
            .map(|masked| {
                let mut mask = masked.mask.clone();
                mask.take(&masked.spectrum.lines, own);
                Masked {
                    spectrum: masked.spectrum,
                    mask,
                }
            })
            .collect();
        let Candidate {
            fit,
            beside,
            relative_reach,
            ..
        } = candidate;
        let scores = control_scores(&without, fit.order, *relative_reach, *beside);
        let by_chance = ByChance::of(scores)?;
        let searches = match candidate.fault {
            Some(Fault::Ball) => 2.0,
            Some(_) => 1.0,
            None => (UNEXPLAINED_ORDERS[1] - UNEXPLAINED_ORDERS[0]) * self.turns.min(REVOLUTIONS),
        };
        Some(by_chance.probability(fit.score, searches))
    }

    fn side_spacing(&self, fault: Fault) -> Option<f64> {
        match fault {
            Fault::InnerRace => Some(1.0),
            Fault::Ball => self.orders.order(Fault::Cage),
            Fault::OuterRace | Fault::Cage => None,
        }
    }

    fn empty(&self, fault: Fault, expected: f64) -> FaultVerdict {
        FaultVerdict::new(fault, expected, self.side_spacing(fault))
    }

    fn too_short(&self, fault: Fault, expected: f64) -> FaultVerdict {
        let why = format!(
            "The window has {:.1} revolutions. At least {:.1} are needed to tell these lines from the floor about them.",
            self.turns,
            turns_needed(expected)
        );
        FaultVerdict {
            why,
            ..self.empty(fault, expected)
        }
    }

    /// A part whose lines cannot be told from others, or lie beyond the spectrum.
    fn hidden(&self, fault: Fault, expected: f64, known: &[KnownLine]) -> FaultVerdict {
        let ends = |band: &BandSpectrum| band.lines.end();
        let widest = (0..self.spectra.len())
            .max_by(|&a, &b| ends(&self.spectra[a]).total_cmp(&ends(&self.spectra[b])))
            .unwrap_or(0);
        let ends = ends(&self.spectra[widest]);
        let why = if ends < LEAST_FREE as f64 * expected {
            format!(
                "The envelope's spectrum ends at order {ends:.1}, below the third harmonic of this part. A higher sampling rate is needed."
            )
        } else {
            format!(
                "Fewer than {LEAST_FREE} of the first harmonics are free of other lines. A longer window separates more."
            )
        };
        let candidate = Candidate {
            fault: Some(fault),
            fit: Fit {
                score: 0.0,
                order: expected,
                spectrum: widest,
                sided: false,
            },
            beside: None,
            relative_reach: 0.0,
        };
        FaultVerdict {
            why,
            harmonics: self.harmonics(&candidate, known, |harmonic, side| {
                line_name(fault, harmonic, side)
            }),
            ..self.empty(fault, expected)
        }
    }

    fn verdict(
        &self,
        fault: Fault,
        expected: f64,
        candidate: &Candidate,
        chance: f64,
        known: &[KnownLine],
    ) -> FaultVerdict {
        let fit = candidate.fit;
        let band = &self.spectra[fit.spectrum];
        let spacing = self.side_spacing(fault);
        let harmonics = self.harmonics(candidate, known, |harmonic, side| {
            line_name(fault, harmonic, side)
        });
        let evidence = Evidence::of(&harmonics, &band.lines);
        let side_lines = self.side_lines(&fit, spacing, known);
        let mut verdict = FaultVerdict {
            false_alarm: Some(chance),
            order: Some(fit.order),
            frequency_hz: Some(fit.order * self.speed_hz),
            band_hz: Some(band.band_hz),
            harmonics_free: evidence.free,
            harmonics_seen: evidence.seen,
            strength_db: evidence.strength_db,
            impulsiveness: evidence.impulsiveness,
            harmonics,
            side_lines,
            ..self.empty(fault, expected)
        };
        (verdict.conclusion, verdict.why) = conclude(&verdict, &evidence, chance);
        verdict
    }

    /// The harmonics of a comb, and the lines beside them where they count.
    fn harmonics(
        &self,
        candidate: &Candidate,
        known: &[KnownLine],
        name: impl Fn(u32, i32) -> String,
    ) -> Vec<Harmonic> {
        let fit = candidate.fit;
        let lines = &self.spectra[fit.spectrum].lines;
        let sides: &[i32] = if fit.sided { &[-1, 0, 1] } else { &[0] };
        let places = (1..=SHOWN_HARMONICS).flat_map(|k| sides.iter().map(move |side| (k, *side)));
        places
            .filter_map(|(harmonic, side)| {
                let beside = f64::from(side) * candidate.beside.unwrap_or(0.0);
                let order = f64::from(harmonic) * fit.order + beside;
                lines.bin(order)?;
                let other = coincidence(lines, order, known);
                Some(Harmonic {
                    name: name(harmonic, side),
                    harmonic,
                    side,
                    order,
                    frequency_hz: order * self.speed_hz,
                    depth: lines.amplitude(order),
                    above_floor_db: 10.0 * lines.ratio(order).max(1e-3).log10(),
                    seen: other.is_none() && lines.seen(order),
                    coincides_with: other.map(|line| line.name.clone()),
                })
            })
            .collect()
    }

    fn side_lines(&self, fit: &Fit, spacing: Option<f64>, known: &[KnownLine]) -> Vec<SideLine> {
        let Some(spacing) = spacing else {
            return Vec::new();
        };
        let lines = &self.spectra[fit.spectrum].lines;
        let mut found = Vec::new();
        for harmonic in 1..=SIDED_HARMONICS {
            for offset in (-SIDES..=SIDES).filter(|&offset| offset != 0) {
                let order = f64::from(harmonic) * fit.order + f64::from(offset) * spacing;
                if order <= 0.0 || lines.bin(order).is_none() {
                    continue;
                }
                let free = spacing > lines.resolution && coincidence(lines, order, known).is_none();
                found.push(SideLine {
                    harmonic,
                    offset,
                    order,
                    above_floor_db: 10.0 * lines.ratio(order).max(1e-3).log10(),
                    seen: free && lines.seen(order),
                });
            }
        }
        found
    }

    /// Impacts of something else, if they are as clear as those of a part have to be.
    fn unexplained(
        &self,
        candidate: &Candidate,
        chance: f64,
        known: &[KnownLine],
    ) -> Option<UnexplainedImpacts> {
        let order = candidate.fit.order;
        let harmonics = self.harmonics(candidate, known, |harmonic, _| format!("{harmonic}"));
        let band = &self.spectra[candidate.fit.spectrum];
        let evidence = Evidence::of(&harmonics, &band.lines);
        if chance >= UNEXPLAINED_BELOW || !evidence.is_clear() {
            return None;
        }
        Some(UnexplainedImpacts {
            order,
            frequency_hz: order * self.speed_hz,
            false_alarm: chance,
            harmonics_seen: evidence.seen,
            strength_db: evidence.strength_db,
            band_hz: band.band_hz,
        })
    }
}

/// What an envelope is called in a report.
pub(super) fn envelope_name(band: &BandSpectrum) -> String {
    let [from, to] = band.band_hz;
    let kind = match band.kind {
        EnvelopeKind::Magnitude => "envelope",
        EnvelopeKind::Impulsive => "envelope of the impulsive frequencies",
        EnvelopeKind::Logarithm => "logarithm of the envelope",
    };
    format!("{kind} of the whitened signal, {from:.0} to {to:.0} Hz")
}
