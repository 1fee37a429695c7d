//! Reading a specification, and what it names; ranges, and values that contradict each other.

use super::distribution::Amount;
use super::level::plain_key;
use super::spec::{DatasetSpec, Keys, Split, SplitBy};
use crate::app::case::{Case, CaseError, Document, Rule, Source};
use crate::app::error::ComputeError;
use crate::files;
use crate::formats::{SignalRequest, read_signals};
use crate::report::significant;
use std::collections::BTreeMap;
use std::path::Path;

/// Keys of a case that the specification's own tables set.
const SET_HERE: [(&str, &str); 7] = [
    ("transient.end", "[recorder] sets it by settle_s and duration_s"),
    ("transient.output_hz", "[recorder] sets it by rate_hz"),
    ("accuracy.band_hz", "[recorder] sets it, up to half of rate_hz"),
    ("analysis", "nothing is analysed here"),
    ("sensors", "machines.sensor names one of the case's"),
    ("transient", "set single keys of it"),
    ("accuracy", "set single keys of it"),
];

/// Most signals of one data set, and most machines.
pub(super) const MOST_SIGNALS: usize = 10_000_000;
const MOST_MACHINES: usize = 1_000_000;
/// Relative difference of two rates that are the same.
const SAME_RATE: f64 = 1e-6;

/// Most samples of one signal: an hour and a half at 200 kHz.
const MOST_SAMPLES: f64 = 1e9;

impl DatasetSpec {
    /// Reads a specification and applies `KEY=VALUE` arguments in order.
    ///
    /// # Errors
    /// [`CaseError`] with file and line, key, what was found and what was expected.
    pub(crate) fn load(path: &Path, set: &[String]) -> Result<(Self, Source), CaseError> {
        let text = files::read_text(path)
            .map_err(|error| CaseError::unread(format!("cannot read the specification {}: {error}", path.display())))?;
        let source = Source { path: path.to_owned(), text, set: set.to_vec() };
        let document = Document::of_other(&source)?;
        let spec: Self = document.decode()?;
        spec.check().map_err(|(key, rule)| document.broken(&rule.at(key)))?;
        drop(document);
        Ok((spec, source))
    }

    fn check(&self) -> Result<(), (String, Rule)> {
        let refuse = |key: &str, rule: Rule| Err((key.to_owned(), rule));
        let within = |key: &str, value: f64, expected: &'static str, good: bool| match good {
            true => Ok(()),
            false => Err((key.to_owned(), Rule::found(value, expected))),
        };
        let amount = |key: &str, amount: &Option<Amount>, expected: &'static str, good: fn(f64) -> bool| match amount
            .as_ref()
            .map(Amount::range)
        {
            Some([low, high]) if !(good(low) && good(high)) => {
                let value = if good(low) { high } else { low };
                let what = match value.is_finite() {
                    true => value.to_string(),
                    false => "a normal distribution without `within`".to_owned(),
                };
                Err((key.to_owned(), Rule::found(what, expected)))
            }
            _ => Ok(()),
        };
        if self.count.is_some_and(|count| count == 0 || count > MOST_SIGNALS) {
            return refuse("count", Rule::found(self.count.unwrap_or(0), "a number from 1 to 10000000"));
        }
        if self.signals_per_specimen == 0 {
            return refuse("signals_per_specimen", Rule::found(0, "1 or more"));
        }
        if self.signals_per_file == Some(0) {
            return refuse("signals_per_file", Rule::found(0, "1 or more"));
        }
        if self.machines.is_empty() {
            return refuse("machines", Rule::found("none", "one [[machines]] with a case at least"));
        }
        let shares = |key: &str, shares: &[f64]| match shares.iter().find(|share| **share < 0.0) {
            Some(negative) => Err((key.to_owned(), Rule::found(negative, "shares not below 0"))),
            None if shares.iter().sum::<f64>() > 0.0 => Ok(()),
            None => Err((key.to_owned(), Rule::found("shares of 0", "one above 0 at least"))),
        };
        shares("split", &self.split.shares())?;
        let weights: Vec<f64> = self.machines.iter().map(|machine| machine.weight).collect();
        shares("machines", &weights)?;
        let instances = self.machines.iter().fold(0_usize, |sum, machine| sum.saturating_add(machine.count));
        if instances > MOST_MACHINES {
            let rule = Rule::found(format!("{instances} machines by count"), "at most 1000000 in all");
            return refuse("machines", rule.with_help("lower count of [[machines]]"));
        }
        let parts = self.split.shares().iter().filter(|share| **share > 0.0).count();
        if self.split.by == SplitBy::Machine && instances < parts {
            let rule = Rule::found(format!("\"machine\" with {instances} machines"), "one for each part at least");
            return refuse("split.by", rule.with_help("raise count of [[machines]], or split by \"specimen\""));
        }
        for (index, machine) in self.machines.iter().enumerate() {
            if machine.count == 0 {
                return refuse(&format!("machines[{index}].count"), Rule::found(0, "1 or more"));
            }
        }
        self.check_keys()?;
        let faults = self
            .machines
            .iter()
            .enumerate()
            .filter_map(|(index, machine)| Some((format!("machines[{index}].fault"), machine.fault.as_ref()?)));
        for (key, fault) in faults.chain([("fault".to_owned(), &self.fault)]) {
            let parts = fault.parts().map(|(_, part)| part.map_or(0.0, |part| part.share));
            shares(&key, &[&parts[..], &[fault.none, fault.several]].concat())?;
            if fault.several > 0.0 && fault.parts().iter().filter(|(_, part)| part.is_some()).count() < 2 {
                let what = format!("{} where fewer than two parts can be damaged", fault.several);
                return refuse(&format!("{key}.several"), Rule::found(what, "two of outer, inner and ball"));
            }
        }
        if let Some(slip) = &self.slip {
            amount("slip.mean", &Some(slip.mean.clone()), "a number from 0 to below 1", |x| (0.0..1.0).contains(&x))?;
            amount("slip.jitter", &slip.jitter, "a number from 0 to below 1", |x| (0.0..1.0).contains(&x))?;
            within("slip.every_s", slip.every_s, "a time of at least 1e-4 s", slip.every_s >= 1e-4)?;
            within("slip.correlation_s", slip.correlation_s, "a time not below 0", slip.correlation_s >= 0.0)?;
        }
        let recorder = &self.recorder;
        within(
            "recorder.rate_hz",
            recorder.rate_hz,
            "a rate from 1 to 1e7 Hz",
            (1.0..=1e7).contains(&recorder.rate_hz),
        )?;
        let long = recorder.duration_s * recorder.rate_hz;
        let before = recorder.settle_s * recorder.rate_hz;
        for (key, time_s, samples, least, expected) in [
            ("duration_s", recorder.duration_s, long, 2.0, "a time of 2 to 1e9 samples"),
            ("settle_s", recorder.settle_s, before, 0.0, "a time of 0 to 1e9 samples"),
        ] {
            if !(least..=MOST_SAMPLES).contains(&samples) {
                let rule = Rule::found(format!("{time_s} s, which is {samples} samples at rate_hz"), expected);
                return refuse(&format!("recorder.{key}"), rule);
            }
        }
        let (above_zero, below_half) = ("a number above 0", "above 0 and at most half of rate_hz");
        let half = 0.5 * recorder.rate_hz;
        amount("recorder.anti_alias_hz", &recorder.anti_alias_hz, above_zero, |x| x > 0.0 && x.is_finite())?;
        if let Some([_, high]) = recorder.anti_alias_hz.as_ref().map(Amount::range) {
            within("recorder.anti_alias_hz", high, below_half, high <= half)?;
        }
        let order = recorder.anti_alias_order;
        within("recorder.anti_alias_order", order as f64, "1 to 12", (1..=12).contains(&order))?;
        amount("recorder.high_pass_hz", &recorder.high_pass_hz, above_zero, |x| x > 0.0 && x.is_finite())?;
        if let Some([low, high]) = recorder.high_pass_hz.as_ref().map(Amount::range) {
            within("recorder.high_pass_hz", high, below_half, high <= half)?;
            within("recorder.high_pass_hz", low, "at least 1e-4 of rate_hz / 2", low >= 1e-4 * half)?;
        }
        amount("recorder.resonance_hz", &recorder.resonance_hz, above_zero, |x| x > 0.0 && x.is_finite())?;
        if let Some([low, high]) = recorder.resonance_hz.as_ref().map(Amount::range) {
            let good = |x: f64| (0.05..=10.0).contains(&(x / recorder.rate_hz));
            let expected = "0.05 to 10 times rate_hz";
            within("recorder.resonance_hz", if good(low) { high } else { low }, expected, good(low) && good(high))?;
        }
        let damping = recorder.resonance_damping;
        within("recorder.resonance_damping", damping, "above 0 and below 1", damping > 0.0 && damping < 1.0)?;
        if let Some(path) = &recorder.path {
            amount("recorder.path.modes", &Some(path.modes.clone()), "a number from 0 to 100", |x| {
                (0.0..=100.0).contains(&x)
            })?;
            amount("recorder.path.hz", &Some(path.hz.clone()), above_zero, |x| x > 0.0 && x.is_finite())?;
            let high = path.hz.range()[1];
            within("recorder.path.hz", high, "above 0 and at most 1.5 times rate_hz", high <= 1.5 * recorder.rate_hz)?;
            let ratio = "a damping ratio above 0 and below 1";
            amount("recorder.path.damping", &Some(path.damping.clone()), ratio, |x| x > 0.0 && x < 1.0)?;
        }
        amount("recorder.gain", &recorder.gain, above_zero, |x| x > 0.0 && x.is_finite())?;
        match (recorder.bits, recorder.full_scale) {
            (None, None) => {}
            (Some(bits), Some(full_scale)) => {
                within("recorder.bits", f64::from(bits), "1 to 32", (1..=32).contains(&bits))?;
                within("recorder.full_scale", full_scale, above_zero, full_scale > 0.0)?;
            }
            (bits, _) => {
                let (key, lacks) = if bits.is_some() { ("bits", "full_scale") } else { ("full_scale", "bits") };
                let rule = Rule::found(format!("it without {lacks}"), "bits and full_scale, or neither");
                return refuse(&format!("recorder.{key}"), rule);
            }
        }
        if let Some(noise) = &self.noise {
            let decibels = "-200 to 200 dB";
            if noise.snr_db.is_some() && noise.rms.is_some() {
                return refuse("noise", Rule::found("snr_db and rms", "one of the two"));
            }
            if noise.colour.is_some() && noise.snr_db.is_none() && noise.rms.is_none() {
                return refuse("noise.colour", Rule::found("a colour without a level", "snr_db or rms beside it"));
            }
            amount("noise.rms", &noise.rms, "a number not below 0", |x| x >= 0.0 && x.is_finite())?;
            amount("noise.modulation", &noise.modulation, "a share from 0 to 1", |x| (0.0..=1.0).contains(&x))?;
            amount("noise.colour", &noise.colour, "an exponent from -4 to 4", |x| (-4.0..=4.0).contains(&x))?;
            let db = |x: f64| (-200.0..=200.0).contains(&x) || x.is_infinite();
            amount("noise.snr_db", &noise.snr_db, decibels, db)?;
            for (index, tone) in noise.tones.iter().enumerate() {
                let key = format!("noise.tones[{index}]");
                if tone.hz.is_some() == tone.order.is_some() {
                    return refuse(&key, Rule::found("both or neither of hz and order", "one of the two"));
                }
                if tone.ratio_db.is_some() == tone.rms.is_some() {
                    return refuse(&key, Rule::found("both or neither of ratio_db and rms", "one of the two"));
                }
                amount(&format!("{key}.hz"), &tone.hz, above_zero, |x| x > 0.0 && x.is_finite())?;
                if let Some([_, high]) = tone.hz.as_ref().map(Amount::range).filter(|[_, high]| *high >= half) {
                    let rule = Rule::beyond(high, "a frequency below half of recorder.rate_hz", half);
                    let help = "it would appear at another frequency: lower it, or raise recorder.rate_hz";
                    return refuse(&format!("{key}.hz"), rule.with_help(help));
                }
                amount(&format!("{key}.order"), &tone.order, above_zero, |x| x > 0.0 && x.is_finite())?;
                amount(&format!("{key}.ratio_db"), &tone.ratio_db, decibels, db)?;
                amount(&format!("{key}.rms"), &tone.rms, "a number not below 0", |x| x >= 0.0 && x.is_finite())?;
            }
            if let Some(background) = &noise.background {
                if background.ratio_db.is_some() == background.gain.is_some() {
                    let rule = Rule::found("both or neither of ratio_db and gain", "one of the two");
                    return refuse("noise.background", rule);
                }
                amount("noise.background.ratio_db", &background.ratio_db, decibels, db)?;
                amount("noise.background.gain", &background.gain, "a number not below 0", |x| x >= 0.0)?;
            }
        }
        Ok(())
    }

    /// Keys of cases: none that other tables set, none at two levels.
    fn check_keys(&self) -> Result<(), (String, Rule)> {
        let tables = |prefix: String, tables: [&Keys; 3]| {
            let names = ["per_machine", "per_specimen", "per_signal"];
            let keys = names.into_iter().zip(tables);
            let keys = keys.flat_map(move |(name, keys)| {
                let prefix = prefix.clone();
                keys.keys().map(move |key| (format!("{prefix}{name}.\"{key}\""), name, key.clone())).collect::<Vec<_>>()
            });
            keys.collect::<Vec<_>>()
        };
        let all = tables(String::new(), [&self.per_machine, &self.per_specimen, &self.per_signal]);
        for (index, machine) in self.machines.iter().enumerate() {
            let own = [&machine.per_machine, &machine.per_specimen, &machine.per_signal];
            let own = tables(format!("machines[{index}]."), own);
            let mut seen: BTreeMap<String, &'static str> = BTreeMap::new();
            for (place, level, key) in all.iter().chain(&own) {
                let plain = plain_key(key);
                if let Some((_, why)) = SET_HERE.iter().find(|(name, _)| *name == plain) {
                    return Err((place.clone(), Rule::found("a key that is set elsewhere", why)));
                }
                // those of another bearing are its own matter
                if plain.split('.').any(|part| part == "defects") && !plain.starts_with("bearings.") {
                    let rule = Rule::found("damage", "none here: [fault] says it");
                    return Err((place.clone(), rule));
                }
                if self.slip.is_some() && plain.ends_with("bearing.slip") {
                    return Err((place.clone(), Rule::found("slip", "none beside the table [slip]")));
                }
                if let Some(other) = seen.insert(plain, level).filter(|other| other != level) {
                    let rule = Rule::found(format!("the key in {level} and in {other}"), "each key at one level");
                    return Err((place.clone(), rule));
                }
            }
        }
        Ok(())
    }

    /// The case of each of its machines.
    ///
    /// # Errors
    /// [`CaseError`] for a case that cannot be read, or that lacks the sensor or the bearing that is named.
    pub(super) fn cases(&self, source: &Source) -> Result<Vec<Case>, CaseError> {
        let mut cases = Vec::new();
        for (index, machine) in self.machines.iter().enumerate() {
            let case = Case::load(Self::folder(source).join(&machine.case), &[])?;
            let sensors: Vec<String> = case.sensors.iter().map(|sensor| sensor.name.clone()).collect();
            let labels: Vec<String> = case.seats().iter().map(|seat| seat.label.clone()).collect();
            for (key, named, known) in [("sensor", &machine.sensor, sensors), ("bearing", &machine.bearing, labels)] {
                let Some(unknown) = named.as_ref().filter(|named| !known.contains(named)) else { continue };
                let expected = format!("one of the case's: {}", known.join(", "));
                let rule = Rule::found(format!("\"{unknown}\""), &expected).at(format!("machines[{index}].{key}"));
                return Err(Document::of_other(source)?.broken(&rule));
            }
            cases.push(case);
        }
        Ok(cases)
    }

    /// The samples of the background; `None` without one.
    ///
    /// # Errors
    /// [`ComputeError`] for a file that cannot be read, another rate, and a record that is silent or too short for a part of the split.
    pub(super) fn background(&self, source: &Source) -> Result<Option<Vec<f64>>, ComputeError> {
        let Some(asked) = self.noise.as_ref().and_then(|noise| noise.background.as_ref()) else { return Ok(None) };
        let path = Self::folder(source).join(&asked.file);
        let channels = asked.channel.iter().cloned().collect();
        let signals = read_signals(&path, &SignalRequest { channels, rate_hz: None })?;
        let refuse = |key: &str, found: String, expected: String, help: &str| {
            let rule = Rule::found(found, &expected).with_help(help).at(format!("noise.background.{key}"));
            Ok::<_, ComputeError>(Document::of_other(source)?.broken(&rule))
        };
        let Some(series) = signals.first().map(|signal| &signal.series) else { return Ok(None) };
        let (rate_hz, wanted_hz) = (series.rate_hz(), self.recorder.rate_hz);
        if (rate_hz / wanted_hz - 1.0).abs() > SAME_RATE {
            let help = "resample the record, or set recorder.rate_hz";
            return Err(refuse("file", format!("{rate_hz} Hz"), format!("the recorder's {wanted_hz} Hz"), help)?.into());
        }
        let [samples, _] = self.recorder.samples();
        let (there, shares) = (series.values().len(), self.split.shares());
        let of_part = (0..shares.len()).map(|part| (part, self.split.stretch(part, there).len()));
        let least = of_part.filter(|(part, _)| shares[*part] > 0.0).min_by_key(|(_, length)| *length);
        if let Some((part, length)) = least.filter(|(_, length)| *length < samples) {
            let seconds = |samples: f64| format!("{} s", significant(samples / rate_hz, 4));
            let name = Split::PARTS[part];
            let found = format!("{}, of which {name} has {}", seconds(there as f64), seconds(length as f64));
            let needed = samples as f64 * shares.iter().sum::<f64>() / shares[part];
            let expected = format!("at least {}: {} for {name}", seconds(needed), seconds(samples as f64));
            let help = "take a longer record, a shorter recorder.duration_s, or a larger share of split";
            return Err(refuse("file", found, expected, help)?.into());
        }
        let mean = series.mean();
        let values: Vec<f64> = series.values().iter().map(|value| value - mean).collect();
        if values.iter().all(|value| *value == 0.0) {
            return Err(refuse(
                "file",
                "silence".to_owned(),
                "a record of a background".to_owned(),
                "name its channel",
            )?
            .into());
        }
        Ok(Some(values))
    }
}
