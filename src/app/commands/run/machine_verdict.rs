//! What the signals of all sensors say of a machine, in a line: no more and no less than the headlines of its windows.

use super::machine::{BearingMotion, at_the_order_of};
use crate::app::commands::analyze::{DamageShown, WindowAnalysis};
use crate::signal::diagnosis::{Conclusion, Diagnosis, Fault};

/// A part, with the label of its bearing, which is empty for the only one.
type Part<'a> = (&'a str, Fault);

/// What windows say, each thing with the sensors that say it, in the order of the windows.
#[derive(Debug, Default)]
pub(super) struct MachineVerdict<'a> {
    named: Vec<(Part<'a>, Vec<&'a str>)>,
    open: Vec<(Part<'a>, Vec<&'a str>)>,
    /// Impacts that belong to no part of the bearing with this label.
    impacts: Vec<(&'a str, Vec<&'a str>)>,
    /// Bearings of which a window judges nothing.
    unjudged: Vec<(&'a str, Vec<&'a str>)>,
    /// Whether a window judges anything.
    judged: bool,
}

impl<'a> MachineVerdict<'a> {
    pub(super) fn of(windows: &'a [WindowAnalysis]) -> Self {
        let mut all = Self::default();
        for window in windows {
            let label = window.bearing.as_deref().unwrap_or_default();
            all.add(label, &window.sensor, window.diagnosis.as_ref().ok());
        }
        all
    }

    /// Adds what a sensor's window says of a bearing; `None`: nothing can be said.
    fn add(&mut self, label: &'a str, sensor: &'a str, diagnosis: Option<&Diagnosis>) {
        let decisive = diagnosis.and_then(Diagnosis::decisive);
        self.judged |= decisive.is_some();
        match decisive {
            None => note(&mut self.unjudged, label, sensor),
            Some((Conclusion::Named, parts)) => {
                parts.iter().for_each(|part| note(&mut self.named, (label, part.fault), sensor));
            }
            Some((Conclusion::NotEnough, parts)) => {
                parts.iter().for_each(|part| note(&mut self.open, (label, part.fault), sensor));
            }
            Some((Conclusion::NotSeen, _)) => {}
        }
        if diagnosis.is_some_and(|found| !found.unexplained.is_empty()) {
            note(&mut self.impacts, label, sensor);
        }
    }

    /// In words. A part that one sensor names is not said to be open for another, nor beside named parts one of a bearing that the case
    /// has without damage.
    pub(super) fn words(mut self, bearings: &[BearingMotion<'_>]) -> String {
        let named = &self.named;
        let sound = |label: &str| {
            bearings.iter().any(|own| own.label == label && own.damage == DamageShown::Share(0.0)) && !named.is_empty()
        };
        self.open.retain(|(part, _)| named.iter().all(|(known, _)| known != part) && !sound(part.0));
        let by = |sensors: &[&str]| format!("by {}", sensors.join(", "));
        let parts = |parts: &[(Part<'_>, Vec<&str>)]| -> Vec<String> {
            parts.iter().map(|(part, sensors)| format!("{} ({})", part_words(*part), by(sensors))).collect()
        };
        let of_bearings = |of: &[(&str, Vec<&str>)]| -> String {
            let told = of.iter().map(|(label, sensors)| match *label {
                "" => by(sensors),
                label => format!("bearing {label} ({})", by(sensors)),
            });
            told.collect::<Vec<_>>().join(", ")
        };
        let mut said: Vec<String> = Vec::new();
        for (part, sensors) in &self.named {
            let alike: Vec<String> = at_the_order_of(bearings, *part).into_iter().map(part_words).collect();
            let alike = match alike.is_empty() {
                true => String::new(),
                false => format!(
                    "; {} strikes at the same order: the damage that the case has decides, the signals do not",
                    alike.join(" and ")
                ),
            };
            said.push(format!("{} ({}{alike})", part_words(*part), by(sensors)));
        }
        if self.named.is_empty() && self.judged {
            said.push("no fault indicated".to_owned());
        }
        if !self.open.is_empty() {
            said.push(format!("{}: {}", Conclusion::NotEnough.words(), parts(&self.open).join(", ")));
        }
        if !self.impacts.is_empty() {
            said.push(format!("impacts that belong to no part: {}", of_bearings(&self.impacts)));
        }
        if !self.unjudged.is_empty() {
            said.push(format!("no verdict: {}", of_bearings(&self.unjudged)));
        }
        said.join("; ")
    }
}

fn part_words((label, fault): Part<'_>) -> String {
    match label {
        "" => fault.name().to_owned(),
        label => format!("bearing {label}, {}", fault.name()),
    }
}

/// Adds a sensor, once, to what says a thing.
fn note<'a, T: PartialEq>(list: &mut Vec<(T, Vec<&'a str>)>, thing: T, sensor: &'a str) {
    match list.iter_mut().find(|(known, _)| *known == thing) {
        Some((_, sensors)) if sensors.contains(&sensor) => {}
        Some((_, sensors)) => sensors.push(sensor),
        None => list.push((thing, vec![sensor])),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::diagnosis::{EnvelopeOrderSpectrum, FaultVerdict, SpeedSource, UnexplainedImpacts};

    /// A window whose races and ball have these verdicts; `None`: not judged.
    fn window(conclusions: [Option<Conclusion>; 3]) -> Diagnosis {
        let faults = [Fault::OuterRace, Fault::InnerRace, Fault::Ball].into_iter().zip(conclusions);
        let faults = faults.map(|(fault, conclusion)| FaultVerdict {
            fault,
            conclusion: conclusion.unwrap_or_default(),
            false_alarm: conclusion.map(|_| 0.01),
            ..FaultVerdict::default()
        });
        Diagnosis {
            envelope: String::new(),
            envelopes: 1,
            spectrum: EnvelopeOrderSpectrum {
                order: Vec::new(),
                amplitude: Vec::new(),
                unit: String::new(),
                turns: 10.0,
                mean: 1.0,
                highest: 1.0,
            },
            speed_hz: 50.0,
            given_speed_hz: 50.0,
            speed_error: 0.0,
            speed_source: SpeedSource::Exact,
            faults: faults.collect(),
            unexplained: Vec::new(),
            by_signal_alone: Vec::new(),
            grew: Vec::new(),
        }
    }

    fn words(windows: &[(&str, &str, Option<Diagnosis>)]) -> String {
        let mut all = MachineVerdict::default();
        windows.iter().for_each(|(label, sensor, found)| all.add(label, sensor, found.as_ref()));
        all.words(&[])
    }

    #[test]
    fn the_machine_says_what_its_windows_say() {
        use Conclusion::{Named, NotEnough, NotSeen};
        let sound = window([Some(NotSeen); 3]);
        let open = window([Some(NotSeen), Some(NotEnough), Some(NotSeen)]);
        let hidden = window([Some(NotSeen), Some(NotSeen), None]);
        let named = window([Some(Named), Some(NotEnough), None]);
        let unjudged = window([None; 3]);
        let impacts = UnexplainedImpacts {
            order: 2.2,
            frequency_hz: 110.0,
            false_alarm: 0.0,
            harmonics_seen: 3,
            strength_db: None,
            band_hz: [0.0, 1.0],
        };
        let impacts = Diagnosis { unexplained: vec![impacts], ..sound.clone() };
        let one = |diagnosis: &Diagnosis| words(&[("", "P1", Some(diagnosis.clone()))]);
        assert_eq!(one(&sound), "no fault indicated");
        assert_eq!(one(&open), "no fault indicated; not enough evidence: inner race (by P1)");
        assert_eq!(one(&hidden), "no fault indicated; not enough evidence: ball (by P1)");
        assert_eq!(one(&named), "outer race (by P1)");
        assert_eq!(one(&impacts), "no fault indicated; impacts that belong to no part: by P1");
        // where nothing was judged no fault is excluded either
        assert_eq!(one(&unjudged), "no verdict: by P1");
        let two = |label, sensor, diagnosis: &Diagnosis| (label, sensor, Some(diagnosis.clone()));
        assert_eq!(
            words(&[two("DE", "P1", &sound), two("PE", "P1", &open), two("PE", "P2", &open), two("PE", "P2", &open)]),
            "no fault indicated; not enough evidence: bearing PE, inner race (by P1, P2)"
        );
        // what another sensor names is not open
        let maybe = window([Some(NotEnough), Some(NotSeen), Some(NotSeen)]);
        assert_eq!(
            words(&[two("DE", "P1", &named), two("DE", "P2", &maybe), two("PE", "P1", &open), ("PE", "P2", None)]),
            "bearing DE, outer race (by P1); not enough evidence: bearing PE, inner race (by P1); no verdict: bearing PE (by P2)"
        );
    }
}
