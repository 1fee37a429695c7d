//! What is found of a part: its harmonics and sidebands, and the verdict that they amount to.

use super::bands::{BandSpectrum, EnvelopeKind};
use super::comb::{Fit, LEAST_FREE, SHOWN_HARMONICS};
use super::fault::Fault;
use super::known::{KnownLine, coincidence, line_name};
use super::line_spectrum::LineSpectrum;
use super::search::{Candidate, Search, turns_needed};
use super::verdict::{Conclusion, Evidence, FaultVerdict, Harmonic, SideLine, conclude};

/// Side lines that are looked at: to so many spacings on each side of so many harmonics.
const SIDES: i32 = 2;
const SIDED_HARMONICS: u32 = 3;

impl Search<'_> {
    pub(super) fn side_spacing(&self, fault: Fault) -> Option<f64> {
        match fault {
            Fault::InnerRace => Some(1.0),
            Fault::Ball => self.orders.order(Fault::Cage),
            Fault::OuterRace | Fault::Cage => None,
        }
    }

    pub(super) fn empty(&self, fault: Fault, expected: f64) -> FaultVerdict {
        FaultVerdict {
            fault,
            expected_order: expected,
            side_spacing: self.side_spacing(fault),
            ..FaultVerdict::default()
        }
    }

    pub(super) fn too_short(&self, fault: Fault, expected: f64) -> FaultVerdict {
        let why = format!(
            "The window has {:.1} revolutions. At least {:.1} are needed to tell these lines from the floor about them.",
            self.turns,
            turns_needed(expected)
        );
        FaultVerdict { reason: why.clone(), why, ..self.empty(fault, expected) }
    }

    /// A part whose lines cannot be told from others, or lie beyond the spectrum.
    pub(super) fn hidden(&self, fault: Fault, expected: f64, known: &[KnownLine]) -> FaultVerdict {
        let ends = |band: &BandSpectrum| band.lines.end();
        let widest = (0..self.spectra.len())
            .max_by(|&a, &b| ends(&self.spectra[a]).total_cmp(&ends(&self.spectra[b])))
            .unwrap_or(0);
        let ends = ends(&self.spectra[widest]);
        let fit = Fit { score: 0.0, order: expected, spectrum: widest, beside: None };
        let harmonics = self.harmonics(&fit, Some(fault), known);
        let why = if ends < LEAST_FREE as f64 * expected {
            format!(
                "The envelope's spectrum ends at order {ends:.1}, below the third harmonic of this part. A higher sampling rate is needed."
            )
        } else {
            self.covered(fault, &harmonics, widest)
        };
        FaultVerdict { reason: why.clone(), why, harmonics, ..self.empty(fault, expected) }
    }

    /// Which lines hide those of a part, and what window shows them; the table of harmonics has them all.
    fn covered(&self, fault: Fault, harmonics: &[Harmonic], spectrum: usize) -> String {
        let deciding = self.spectra[spectrum].lines.harmonics as usize;
        let harmonics = &harmonics[..deciding.min(harmonics.len())];
        let hidden = harmonics.iter().filter_map(|harmonic| {
            let other = harmonic.coincides_with.as_ref()?;
            Some(format!("{} with {other}", harmonic.name))
        });
        let hidden: Vec<String> = hidden.collect();
        let free = harmonics.len() - hidden.len();
        let too_few = match free {
            0 => format!("each of the first {deciding} harmonics coincides with another line"),
            free if free < LEAST_FREE => {
                format!("of the first {deciding} harmonics, only {free} can be told from lines of other origin")
            }
            _ => "neither the first nor the second harmonic can be told from lines of other origin".to_owned(),
        };
        let shown = hidden.iter().take(2).map(String::as_str);
        let shown: Vec<&str> = shown.collect();
        let hint = self
            .beside_the_shafts(fault)
            .unwrap_or_else(|| "Lines of other origin stand in the same places.".to_owned());
        format!("No verdict: {too_few} ({}). {hint}", shown.join(", "))
    }

    /// That the window is too short to tell a part's lines from the shaft's, and which one is not.
    fn beside_the_shafts(&self, fault: Fault) -> Option<String> {
        match self.orders.turns_to_judge(fault) {
            Some(turns) if turns > self.turns => Some(format!(
                "A window of {:.0} revolutions separates these lines from the shaft's; this one has {:.0}.",
                turns.ceil(),
                self.turns
            )),
            Some(_) => None,
            None => Some("No window separates these lines from the shaft's.".to_owned()),
        }
    }

    pub(super) fn verdict(
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
        let harmonics = self.harmonics(&fit, Some(fault), known);
        let side_lines = self.side_lines(&fit, spacing, known);
        let mut evidence = Evidence::of(&harmonics, &band.lines);
        if fault == Fault::InnerRace {
            evidence.strength_db = with_sidebands(&harmonics, &side_lines, &band.lines);
        }
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
        (verdict.conclusion, verdict.why, verdict.reason) = conclude(&verdict, &evidence, chance);
        let objection = match verdict.conclusion {
            Conclusion::NotSeen => self.beside_the_shafts(fault),
            Conclusion::Named => self.doubt(expected, candidate, known),
            Conclusion::NotEnough => None,
        };
        if let Some(reason) = objection {
            verdict.revise(Conclusion::NotEnough, reason);
        }
        if verdict.conclusion == Conclusion::NotSeen {
            // where chance puts its comb is no place of its lines
            (verdict.order, verdict.frequency_hz) = (None, None);
        }
        verdict
    }

    /// The harmonics of a comb of a part or of something else, and the lines beside them where they count.
    pub(super) fn harmonics(&self, fit: &Fit, fault: Option<Fault>, known: &[KnownLine]) -> Vec<Harmonic> {
        let lines = &self.spectra[fit.spectrum].lines;
        let sides: &[i32] = if fit.beside.is_some() { &[-1, 0, 1] } else { &[0] };
        let places = (1..=SHOWN_HARMONICS).flat_map(|k| sides.iter().map(move |side| (k, *side)));
        places
            .filter_map(|(harmonic, side)| {
                let beside = f64::from(side) * fit.beside.unwrap_or(0.0);
                let order = f64::from(harmonic) * fit.order + beside;
                lines.bin(order)?;
                let other = coincidence(lines, order, known);
                Some(Harmonic {
                    name: fault.map_or_else(|| harmonic.to_string(), |fault| line_name(fault, harmonic, side)),
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

    pub(super) fn side_lines(&self, fit: &Fit, spacing: Option<f64>, known: &[KnownLine]) -> Vec<SideLine> {
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
}

/// Strength of a comb whose harmonics count with the sidebands that are seen. The load sees a flaw of the inner race once a revolution, or
/// twice where the outer ring is squeezed: the power of each harmonic is spread over its sidebands.
fn with_sidebands(harmonics: &[Harmonic], sides: &[SideLine], lines: &LineSpectrum) -> Option<f64> {
    let ratio = |db: f64| 10.0_f64.powf(0.1 * db);
    let mut harmonics = harmonics.to_vec();
    for line in &mut harmonics {
        let sides = sides.iter().filter(|side| side.seen && side.harmonic == line.harmonic);
        let sides: f64 = sides.map(|side| ratio(side.above_floor_db)).sum();
        line.above_floor_db = 10.0 * (ratio(line.above_floor_db) + sides).log10();
    }
    Evidence::of(&harmonics, lines).strength_db
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
