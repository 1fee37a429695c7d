//! Drawing a signal: what it is follows from the seed and its number alone.
//!
//! Every key has a stream of random numbers of its own: a key more in the specification changes no other.

use super::distribution::{Amount, Distribution, toml_text};
use super::drawn::{Loudness, Noise, Pitch, Recorder, Signal, Tone};
use super::hierarchy::{Label, Specimen};
use super::level::{Level, plain_key, stream};
use super::plan::DatasetPlan;
use super::spec::DamageSpec;
use crate::app::case::{Case, Source};
use crate::app::error::ComputeError;
use crate::numerics::random::Stream;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::path::Path;

/// Samples of the simulation for each of the recorder's, at least: what the low-pass before the samples lets through is there.
const LEAST_OVERSAMPLING: usize = 4;
/// Samples of the simulation in a period of the sensor's resonance.
const PER_RESONANCE: f64 = 4.0;

/// Slip beyond which no cage of a run is: it would stand.
const MOST_SLIP: f64 = 0.9;

/// Numbers of a signal, kept with their names.
struct Draws {
    seed: u64,
    drawn: BTreeMap<String, Value>,
}

impl Draws {
    fn number(&mut self, level: Level, index: usize, name: &str, amount: &Amount) -> f64 {
        let number = amount.draw(&mut stream(self.seed, level, index, name));
        self.drawn.insert(name.to_owned(), number.into());
        number
    }
}

impl DatasetPlan {
    /// Reads a specification, its cases and its background; `count` goes before that of the specification.
    ///
    /// # Errors
    /// [`ComputeError::Case`] for a specification or a case that is wrong, or where what is drawn makes no valid case of a machine with some
    /// fault; that of a mesh or a background that cannot be read.
    pub(crate) fn load(path: &Path, set: &[String], count: Option<usize>) -> Result<Self, ComputeError> {
        let plan = Self::read(path, set, count)?;
        plan.check_draws()?;
        Ok(plan)
    }

    /// All that is drawn for a signal, from 0 to below [`count`](Self::count).
    pub(super) fn signal(&self, number: usize) -> Signal {
        let specimen_number = number / self.spec.signals_per_specimen;
        self.signal_of(self.hierarchy.specimens[specimen_number], specimen_number, number)
    }

    /// The same of a specimen of any number, also beyond those of the data set.
    fn signal_of(&self, specimen: Specimen, specimen_number: usize, number: usize) -> Signal {
        let spec = &self.spec;
        let entry = self.hierarchy.machines[specimen.machine].entry;
        let case = &self.cases[entry];
        let mut draws = Draws { seed: spec.seed, drawn: BTreeMap::new() };
        let places = [(Level::Machine, specimen.machine), (Level::Specimen, specimen_number), (Level::Signal, number)];
        let mut set = Vec::new();
        for (level, index) in places {
            for (key, distribution) in &spec.keys_of(entry, level) {
                let value = distribution.draw(&mut stream(spec.seed, level, index, key));
                set.push(format!("{key}={}", toml_text(&value)));
                draws.drawn.insert(key.clone(), value);
            }
        }
        let faults = self.faults(entry, specimen, &set, &mut |name, keys: &Distribution| {
            keys.draw(&mut stream(spec.seed, Level::Specimen, specimen_number, name))
        });
        let mut mount = stream(spec.seed, Level::Specimen, specimen_number, "recorder.path");
        let draw = &mut |name: &str, amount: &Amount| draws.number(Level::Specimen, specimen_number, name, amount);
        let recorder = self.recorder(&mut mount, draw);
        let noise = self.noise(number, &mut |name, amount| draws.number(Level::Signal, number, name, amount));
        let seat = self.seat(entry);
        // other bearings are sound unless a key of theirs says otherwise
        for (place, other) in case.seats().iter().enumerate() {
            let key = other.key("bearing.defects");
            match place == seat {
                true => set.push(format!("{key}={}", toml_text(&Value::Array(faults.clone())))),
                false if draws.drawn.keys().any(|drawn| plain_key(drawn) == plain_key(&key)) => {}
                false => set.push(format!("{key}=[]")),
            }
        }
        let start = draws.drawn.get("transient.start").and_then(Value::as_f64);
        let start = start.or(case.transient.as_ref().map(|transient| transient.start)).unwrap_or(0.0);
        let end = start + (recorder.settling + recorder.samples) as f64 / recorder.rate_hz;
        if let Some(slip) = &spec.slip {
            let mean = draws.number(Level::Specimen, specimen_number, "slip.mean", &slip.mean);
            let jitter = slip.jitter.as_ref();
            let jitter = jitter.map(|jitter| draws.number(Level::Specimen, specimen_number, "slip.jitter", jitter));
            let mut wander = stream(spec.seed, Level::Signal, number, "slip");
            let knots = ((end - start) / slip.every_s).ceil().max(1.0) as usize;
            // of one value with the next
            let correlation = if slip.correlation_s > 0.0 { (-slip.every_s / slip.correlation_s).exp() } else { 0.0 };
            let mut away = wander.normal();
            let mut knot = |k: usize| {
                let there = (mean + jitter.unwrap_or(0.0) * away).clamp(0.0, MOST_SLIP);
                away = correlation * away + (1.0 - correlation * correlation).sqrt() * wander.normal();
                format!("{{ time = {:?}, slip = {there:?} }}", start + k as f64 * slip.every_s)
            };
            let profile: Vec<String> = (0..=knots).map(&mut knot).collect();
            let key = case.seats()[seat].key("bearing.slip");
            set.push(format!("{key}={{ profile = [{}] }}", profile.join(", ")));
        }
        set.extend([
            // what the case does with its own signals
            "analysis={}".to_owned(),
            format!("transient.end={end:?}"),
            format!("transient.output_hz={:?}", recorder.rate_hz * recorder.oversampling as f64),
            format!("accuracy.band_hz=[0, {:?}]", 0.5 * recorder.rate_hz),
        ]);
        Signal { number, specimen_number, specimen, entry, set, faults, drawn: draws.drawn, recorder, noise }
    }

    /// Number of balls of the bearing with the faults, where these keys of its case are drawn.
    fn balls(&self, entry: usize, set: &[String]) -> usize {
        let of = |case: &Case| case.seats().get(self.seat(entry)).and_then(|seat| Some(seat.bearing?.balls));
        let base = &self.cases[entry];
        let sound = base.seats().get(self.seat(entry)).map(|seat| format!("{}=[]", seat.key("bearing.defects")));
        let set = set.iter().cloned().chain(sound).collect();
        let drawn = Case::from_source(Source { set, ..base.source.clone() });
        // what makes no case is told where the signal is computed
        drawn.ok().as_ref().and_then(of).or_else(|| of(base)).unwrap_or(1)
    }

    /// Damage of a specimen, with these keys of its case drawn: an item of `bearing.defects` each.
    fn faults(
        &self,
        entry: usize,
        specimen: Specimen,
        set: &[String],
        draw: &mut dyn FnMut(&str, &Distribution) -> Value,
    ) -> Vec<Value> {
        let parts = self.spec.fault_of(entry).parts();
        let there: Vec<_> = parts.into_iter().filter_map(|(part, damage)| Some((part, damage?))).collect();
        let taken: Vec<_> = match specimen.label {
            Label::None => Vec::new(),
            Label::Several => {
                let left_out = Distribution::any_of((0..there.len()).map(Value::from));
                let left_out = draw("fault.several", &left_out).as_u64();
                // of two parts both
                let left_out = left_out.filter(|_| there.len() > 2);
                let kept = there.into_iter().enumerate();
                kept.filter(|(place, _)| Some(*place as u64) != left_out).map(|(_, part)| part).collect()
            }
            one => there.into_iter().filter(|(part, _)| *part == one.name()).collect(),
        };
        let one = |(part, damage): (&str, &DamageSpec)| {
            let mut table = Map::new();
            table.insert("on".to_owned(), part.into());
            for (key, distribution) in damage.keys() {
                table.insert(key.to_owned(), draw(&format!("fault.{part}.{key}"), distribution));
            }
            if part == "ball" && damage.ball.is_none() {
                let any = Distribution::any_of((0..self.balls(entry, set)).map(Value::from));
                table.insert("ball".to_owned(), draw("fault.ball.ball", &any));
            }
            Value::Object(table)
        };
        taken.into_iter().map(one).collect()
    }

    fn recorder(&self, mount: &mut Stream, draw: &mut dyn FnMut(&str, &Amount) -> f64) -> Recorder {
        let asked = &self.spec.recorder;
        let [samples, settling] = asked.samples();
        let mut drawn = |name: &str, amount: &Option<Amount>| amount.as_ref().map(|amount| draw(name, amount));
        let resonance_hz = drawn("recorder.resonance_hz", &asked.resonance_hz);
        let for_resonance = resonance_hz.map_or(0.0, |hz| (PER_RESONANCE * hz / asked.rate_hz).ceil());
        let steps = asked.bits.zip(asked.full_scale);
        let path = asked.path.as_ref().map(|path| {
            let direct = drawn("recorder.path.direct", &path.direct).unwrap_or(1.0);
            let count = drawn("recorder.path.modes", &Some(path.modes.clone())).unwrap_or(0.0).round() as usize;
            let mode = |_| [path.hz.draw(mount), path.damping.draw(mount), mount.normal()];
            (direct, (0..count).map(mode).collect())
        });
        Recorder {
            path,
            rate_hz: asked.rate_hz,
            oversampling: LEAST_OVERSAMPLING.max(for_resonance as usize),
            samples,
            settling,
            anti_alias_hz: drawn("recorder.anti_alias_hz", &asked.anti_alias_hz).unwrap_or(0.4 * asked.rate_hz),
            anti_alias_order: asked.anti_alias_order,
            high_pass_hz: drawn("recorder.high_pass_hz", &asked.high_pass_hz),
            resonance_hz,
            resonance_damping: asked.resonance_damping,
            gain: drawn("recorder.gain", &asked.gain).unwrap_or(1.0),
            converter: steps.map(|(bits, full)| [2.0 * full / 2.0_f64.powf(f64::from(bits)), full]),
        }
    }

    fn noise(&self, number: usize, draw: &mut dyn FnMut(&str, &Amount) -> f64) -> Noise {
        let Some(asked) = &self.spec.noise else {
            return Noise { coloured: None, modulation: [[0.0; 2]; 3], background: None, tones: Vec::new() };
        };
        let mut drawn = |name: &str, amount: &Option<Amount>| amount.as_ref().map(|amount| draw(name, amount));
        let own = |name: &str| stream(self.spec.seed, Level::Signal, number, name);
        let loudness = drawn("noise.snr_db", &asked.snr_db).map(Loudness::Below);
        let loudness = loudness.or_else(|| drawn("noise.rms", &asked.rms).map(Loudness::Itself));
        let colour = drawn("noise.colour", &asked.colour).unwrap_or(0.0);
        let most = drawn("noise.modulation", &asked.modulation).unwrap_or(0.0);
        let mut swell = own("noise.modulation of orders");
        // together no more than the share
        let modulation = std::array::from_fn(|_| [most / 3.0 * swell.unit(), TAU * swell.unit()]);
        let background = asked.background.as_ref().and_then(|background| {
            let ratio = drawn("noise.background.ratio_db", &background.ratio_db).map(Loudness::Below);
            let loudness = ratio.or_else(|| drawn("noise.background.gain", &background.gain).map(Loudness::Itself));
            Some((loudness?, own("noise.background").unit()))
        });
        let mut phases = own("noise.tones");
        let tones = asked.tones.iter().enumerate().filter_map(|(index, tone)| {
            let mut drawn = |key: &str, amount: &Option<Amount>| drawn(&format!("noise.tones.{index}.{key}"), amount);
            let pitch = drawn("hz", &tone.hz).map(Pitch::Clock);
            let pitch = pitch.or_else(|| drawn("order", &tone.order).map(Pitch::Shaft));
            let loudness = drawn("ratio_db", &tone.ratio_db).map(Loudness::Below);
            let loudness = loudness.or_else(|| drawn("rms", &tone.rms).map(Loudness::Itself));
            Some(Tone { pitch: pitch?, loudness: loudness?, phase: TAU * phases.unit() })
        });
        let tones = tones.collect();
        Noise { coloured: loudness.map(|loudness| (loudness, colour, own("noise"))), modulation, background, tones }
    }

    /// Reads cases of signals of each kind of machine with each fault: what is wrong with all is wrong with the specification.
    fn check_draws(&self) -> Result<(), ComputeError> {
        /// Signals of one kind that are looked at, more than a small data set has.
        const LOOKED_AT: usize = 50;
        let mut kinds: BTreeMap<(usize, Label), Specimen> = BTreeMap::new();
        for specimen in &self.hierarchy.specimens {
            let entry = self.hierarchy.machines[specimen.machine].entry;
            kinds.entry((entry, specimen.label)).or_insert(*specimen);
        }
        for ((entry, label), specimen) in kinds {
            let drawn = (0..LOOKED_AT).map(|number| self.signal_of(specimen, number, number));
            let mut errors = drawn.map(|signal| self.case(&signal).err());
            let Some(Some(error)) = errors.next() else { continue };
            // a value out of a range may be a rare one; a key that is none is not
            if error.valid.is_empty() && errors.any(|other| other.is_none()) {
                continue;
            }
            let place = self.source.path.display();
            let what = format!(
                "{place}: what is drawn for machines[{entry}] with fault \"{}\" makes no valid case: {error}",
                label.name()
            );
            let help = error.help().unwrap_or_else(|| "change the distribution of that key".to_owned());
            return Err(ComputeError::input(what, help));
        }
        Ok(())
    }
}
