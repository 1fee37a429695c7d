//! What a run's estimated error covers: how long it holds, and how far small perturbations grow until then.
//!
//! Where balls strike, small differences grow until the signal is one of many that the same machine makes. The finer run of
//! [`pilot`](super::pilot) has the error of modes and steps along the way: on `examples/scenes` it found that of a run with all modes within
//! 20 %, window by window, until both part. What the finer run lacks as well, vectors of a condensed housing, is taken to grow as this does.

use super::growth::Growth;
use super::model_choice::{CONDENSATION, Measured, ModelChoice, REST, SUPERELEMENT};
use super::pilot::{LONG, SAFETY, Stepped, compared, held_s, long_begin, stretch_s, worst_since};
use super::plan::root_of_squares;
use super::quantities::USUAL_BAND;
use crate::app::case::{Case, RunCase, Transient};
use crate::app::commands::run::Span;
use crate::app::scene::Scene;
use crate::numerics::Brief;
use crate::report::significant;
use schemars::JsonSchema;
use serde::Serialize;

/// How far is looked in units of the pilot's stretch: at first, and where the estimate holds so long.
const LENGTHS: [f64; 2] = [3.0, LONG];

/// Growth of a small perturbation up to which an estimate covers a run at least. Where balls are pressed at rest, more says that they leave the
/// races: what only vibrates beats by a few times.
const COVERED: f64 = 10.0;

/// What of a run its estimated error covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Covered {
    /// All of it, as far as was looked; no ball strikes later.
    All,
    /// Its beginning, or the stretch that was looked at.
    Part,
    /// None of it: the error is as large as the signals within the first stretch.
    Nothing,
}

/// How long an estimated error was seen to hold, s from [`from_s`](Self::from_s).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Horizon {
    /// From where it was looked at, s: the run's start, unless its first strike is further off than a look is long; then a stretch
    /// from rest just before a strike.
    pub from_s: f64,
    /// Until then the difference from the finer run since there was at most two thirds of the estimate, since that errs as well; 0 where it never was.
    pub held_s: f64,
    /// Until then it was looked at.
    pub looked_s: f64,
    /// Start of the run.
    pub start_s: f64,
    /// Length of the run.
    pub run_s: f64,
    /// Whether balls strike, so that differences grow beyond any estimate.
    pub strikes: bool,
    /// How many times a small perturbation of the start has grown until then and until `looked_s`; `None` where it cannot be stepped.
    pub growth: Option<[f64; 2]>,
}

impl Horizon {
    /// Steps the beginning of a run by its model and by a finer one, where balls strike; else the estimate is from such a comparison already.
    /// An estimate that the first stretch passes is raised to what that shows, or taken away where it is as large as the signals.
    /// `None` for a model whose error of modes and steps is not measured, or a stretch that cannot be stepped.
    pub fn of(run: RunCase<'_>, scene: &Scene, choice: &mut ModelChoice) -> Option<Self> {
        Self::of_any(run.case, run.transient, scene, choice)
    }

    /// The same of any scene.
    pub(crate) fn of_any(
        case: &Case,
        asked: &Transient,
        scene: &impl Stepped,
        choice: &mut ModelChoice,
    ) -> Option<Self> {
        let (start_s, run_s) = (asked.start, asked.end - asked.start);
        let band_hz = case.band_hz().map_or(USUAL_BAND, |band| band[1]);
        let Measured { from_s, length_s: looked_s, finer, .. } = choice.measured?;
        let model = choice.model;
        let span = |duration| Span { duration, output_hz: asked.output_hz };
        let growth = |from_s, length| Growth::of(scene, &model, span(length), from_s, band_hz).ok();
        if choice.growth <= 1.0 {
            let growth = growth(from_s, looked_s).map(|growth| [growth.until(looked_s); 2]);
            if growth.is_none_or(|[grown, _]| grown <= COVERED) {
                return Some(Self { from_s, held_s: looked_s, looked_s, start_s, run_s, strikes: false, growth });
            }
        }
        let first_s = stretch_s(asked, band_hz);
        let longest_s = LENGTHS[1] * first_s;
        let strike_s = long_begin(asked, scene, longest_s);
        // what the run has become by then only the run itself knows: a look that reaches the strike begins with it
        let (from_s, quiet_s) =
            if strike_s - start_s <= longest_s { (start_s, strike_s - start_s) } else { (strike_s, 0.0) };
        let growth = growth(from_s, (quiet_s + longest_s).min(run_s));
        let covered_s = growth.as_ref().map_or(0.0, |growth| growth.time_s(COVERED)).max(first_s);
        let mut horizon = None;
        for length in LENGTHS {
            let looked_s = (quiet_s + length * first_s).min(run_s);
            let Ok(signals) = compared(scene, [&model, &finer], span(looked_s), from_s, band_hz) else {
                break;
            };
            let held = |choice: &ModelChoice| {
                let most = choice.share_of_steps()? / SAFETY;
                Some(held_s(&signals, most, first_s).min(looked_s))
            };
            let mut held_s = held(choice)?;
            let loud = signals[1].iter().any(|finer| finer.rms() > REST);
            if held_s < covered_s.min(looked_s) && loud {
                choice.raise([covered_s, first_s].map(|time_s| SAFETY * worst_since(&signals, [first_s, time_s])));
                held_s = held(choice).unwrap_or(0.0);
            }
            let growth = growth.as_ref().map(|growth| [held_s, looked_s].map(|time_s| growth.until(time_s)));
            horizon = Some(Self { from_s, start_s, held_s, looked_s, run_s, strikes: true, growth });
            if held_s < looked_s || looked_s >= run_s {
                break;
            }
        }
        horizon
    }

    /// What of the run an estimated error covers.
    pub(crate) fn covers(&self, estimated_error: Option<f64>) -> Covered {
        match (self.passed(), self.looked_s < self.run_s && self.strikes) {
            _ if estimated_error.is_none_or(|error| error >= 1.0) => Covered::Nothing,
            (true, _) if self.held_s <= 0.0 => Covered::Nothing,
            (false, false) => Covered::All,
            _ => Covered::Part,
        }
    }

    /// That an estimated error covers part of the run alone, if so, and how far a small perturbation grows until then.
    pub(crate) fn warning(&self, estimated_error: Option<f64>) -> Option<String> {
        let error = estimated_error.filter(|_| self.covers(estimated_error) == Covered::Part)?;
        let ms = |seconds: f64| format!("{} ms", significant(1e3 * seconds, 3));
        let covered = match self.from_s > self.start_s {
            true => {
                let [from, start, end] = [self.from_s, self.start_s, self.start_s + self.run_s];
                let [from, start, end] = [from, start, end].map(|instant| Brief::rounded(instant, 6));
                format!("a trial of {} from rest at {from} s (the run: {start} to {end} s)", ms(self.held_s))
            }
            false => format!("{} of the run's {}", ms(self.held_s), ms(self.run_s)),
        };
        let grown = self.growth.map_or(String::new(), |[held, looked]| {
            let later = match self.passed() {
                true => format!(", {} times in {}", significant(looked, 2), ms(self.looked_s)),
                false => String::new(),
            };
            format!(", in which a small perturbation of the start grows {} times{later}", significant(held, 2))
        });
        Some(format!(
            "the estimated error of {} covers {covered}{grown}: beyond, compare spectra and verdicts instead of samples",
            significant(error, 2)
        ))
    }

    /// Whether the error was seen to pass the estimate.
    pub(crate) fn passed(&self) -> bool {
        self.held_s < self.looked_s
    }

    /// For how long the estimate holds, after "estimated error ...".
    pub fn sentence(&self) -> String {
        let ms = |seconds: f64| significant(1e3 * seconds, 2);
        let precise = |seconds: f64| significant(1e3 * seconds, 3);
        let whole = ms(self.run_s);
        let later = match self.strikes {
            true => "the waveform depends on the smallest disturbance: compare spectra and verdicts, not samples",
            false => "it is larger: lower accuracy.target",
        };
        let held = ms(self.held_s);
        let place = match self.from_s > self.start_s {
            true => format!("for {held} ms of a trial from rest at {} ms", precise(self.from_s)),
            false => format!("in the first {held} ms of {whole}"),
        };
        match (self.passed(), self.looked_s < self.run_s) {
            (true, _) if self.held_s <= 0.0 => {
                format!("passed within {} ms; then {later}", ms(self.looked_s))
            }
            (true, _) => format!("{place}; after that, {later}"),
            (false, true) if self.strikes => {
                format!("{place}, beyond which it was not checked; at some later time, {later}")
            }
            (false, true) => format!("{place} at least"),
            (false, false) => "over the whole run".to_owned(),
        }
    }
}

impl ModelChoice {
    /// What the measured error of modes and steps may be while the estimate of all parts holds, relative; `None` without an estimate.
    fn share_of_steps(&self) -> Option<f64> {
        let together = self.estimated_error?;
        let part = |what: &str| self.parts.iter().find(|part| part.what == what)?.estimated_error;
        let measured = match self.measured {
            Some(found) => self.growth * found.error,
            None => part("method")?,
        };
        let unseen = [SUPERELEMENT, CONDENSATION].map(|what| part(what).unwrap_or(0.0));
        let unseen = unseen[0].hypot(unseen[1]);
        if measured <= 0.0 {
            return Some(together);
        }
        Some(together * measured / measured.hypot(unseen))
    }

    /// Takes in the largest of these errors of modes and steps, relative, that is smaller than the signals; takes the estimate away where none is.
    fn raise(&mut self, errors: [f64; 2]) {
        let method = self.parts.iter_mut().find(|part| part.what == "method");
        let (Some(method), Some(measured)) = (method, &mut self.measured) else { return };
        let known = errors.into_iter().filter(|error| *error < 1.0).reduce(f64::max);
        let of_method = method.estimated_error.zip(known).map(|(own, error)| own.max(error));
        method.estimated_error = of_method;
        method.why += match known {
            Some(_) => "; the run's beginning showed more beside a finer one",
            None => "; a finer run parts from it at once",
        };
        measured.error = measured.error.max(known.unwrap_or(0.0) / self.growth);
        self.estimated_error = root_of_squares(&self.parts);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::commands::run::choice::ModelChoice;
    use crate::numerics::Unwatched;

    fn horizon(example: &str, set: &[&str]) -> Horizon {
        let case = Case::example(example, set);
        let run = case.for_run().unwrap();
        let scene = Scene::build(run, &Unwatched).unwrap();
        let mut choice = ModelChoice::of_case(run, &scene).unwrap();
        Horizon::of(run, &scene, &mut choice).unwrap()
    }

    /// Against runs with all modes in equal steps of 25 ns, the error since the start passes the estimate of 0.0037 after 5.6 ms.
    #[test]
    fn a_healthy_bearing_in_play_is_predicted_for_some_milliseconds() {
        let end = ["transient.start=0", "transient.end=0.02", "analysis.envelope=[]"];
        let horizon = horizon("scenes/healthy", &end);
        assert!((3e-3..5.6e-3).contains(&horizon.held_s), "{horizon:?}");
        assert!(horizon.passed() && horizon.strikes);
        let sentence = horizon.sentence();
        assert!(sentence.contains(" ms of 20; after that, the waveform"), "{sentence}");
        let [held, looked] = horizon.growth.unwrap();
        assert!(held > COVERED && looked > held, "{horizon:?}");
        assert_eq!(horizon.covers(Some(0.0037)), Covered::Part);
        assert!(
            horizon.warning(Some(0.0037)).is_some_and(|warning| warning.starts_with("the estimated error of 0.0037"))
        );
    }

    /// An estimate that the beginning passes before a perturbation has grown tenfold is raised until it covers that, and one that it passes at once is none.
    #[test]
    fn an_estimate_covers_tenfold_growth_or_is_none() {
        let case = Case::example("scenes/healthy", &["transient.end=6e-3", "analysis.envelope=[]"]);
        let run = case.for_run().unwrap();
        let scene = Scene::build(run, &Unwatched).unwrap();
        let mut choice = ModelChoice::of_case(run, &scene).unwrap();
        let honest = choice.estimated_error.unwrap();
        let small = |choice: &mut ModelChoice| {
            for part in &mut choice.parts {
                part.estimated_error = part.estimated_error.map(|error| 1e-3 * error);
            }
            let measured = choice.measured.as_mut().unwrap();
            measured.error *= 1e-3;
            choice.estimated_error = root_of_squares(&choice.parts);
        };
        small(&mut choice);
        let horizon = Horizon::of(run, &scene, &mut choice).unwrap();
        let raised = choice.estimated_error.unwrap();
        let span = Span { duration: 6e-3, output_hz: run.transient.output_hz };
        let growth = Growth::of(&scene, &choice.model, span, 0.0, 40e3).unwrap();
        assert!((0.1..2.0).contains(&(raised / honest)), "{raised} {honest}");
        assert!(
            (2e-3..6e-3).contains(&growth.time_s(COVERED)) && horizon.held_s >= growth.time_s(COVERED),
            "{horizon:?}"
        );
        choice.raise([1.5, 1.0]);
        assert_eq!(choice.estimated_error, None);
        let part = choice.parts.iter().find(|part| part.what == "method").unwrap();
        assert!(part.why.ends_with("parts from it at once"), "{}", part.why);
    }

    /// After 2.5 ms the first ball that the preload does not hold comes back, and a perturbation grows thousandfold. The estimate
    /// holds until then, and within the next stretch no longer.
    #[test]
    fn a_preload_of_ten_nanometres_holds_no_ball_for_long() {
        let horizon = horizon("scenes/smooth", &["ring.nodes=36", "bearing.radial_play=-1e-8", "transient.end=5e-3"]);
        assert!((1.9e-3..3e-3).contains(&horizon.held_s), "{horizon:?}");
        let [held, looked] = horizon.growth.unwrap();
        assert!(held < COVERED && looked > 100.0 * COVERED, "{horizon:?}");
    }

    #[test]
    fn pressed_balls_are_predicted_to_the_end() {
        let horizon = horizon("scenes/smooth", &["transient.end=6e-3"]);
        assert!(!horizon.strikes && !horizon.passed(), "{horizon:?}");
        assert_eq!(horizon.sentence(), "over the whole run");
        let longer = Horizon { run_s: 1.0, ..horizon };
        assert!(longer.sentence().contains("at least"), "{longer:?}");
        assert_eq!((horizon.covers(Some(0.01)), horizon.warning(Some(0.01))), (Covered::All, None));
        assert_eq!([None, Some(1.0)].map(|error| horizon.covers(error)), [Covered::Nothing; 2]);
        let short = Horizon { start_s: 0.0, from_s: 2.58, held_s: 1e-3, strikes: true, ..longer };
        assert!(
            short.sentence().starts_with("for 1.0 ms of a trial from rest at 2580 ms; after that"),
            "{}",
            short.sentence()
        );
    }

    /// The first strike is 1.5 ms after the start of a run that is longer than the looks.
    #[test]
    fn a_run_that_strikes_soon_is_looked_at_from_its_start() {
        let soon = horizon("scenes/impact", &["transient.end=0.1", "analysis.envelope=[]"]);
        assert_eq!((soon.from_s, soon.start_s), (0.0, 0.0), "{soon:?}");
        let late = horizon("tadina2011/outer-dent", &[]);
        assert!(late.from_s > late.start_s + 0.02, "{late:?}");
    }

    #[test]
    fn what_is_covered_and_the_run_are_on_one_clock() {
        let late = Horizon {
            from_s: 2.58,
            held_s: 2e-3,
            looked_s: 6e-3,
            start_s: 2.2,
            run_s: 0.4,
            strikes: true,
            growth: None,
        };
        let warning = late.warning(Some(0.01)).unwrap();
        assert!(
            warning.contains("0.010 covers a trial of 2.00 ms from rest at 2.58 s (the run: 2.2 to 2.6 s): beyond"),
            "{warning}"
        );
        let first = Horizon { from_s: 2.2, ..late }.warning(Some(0.01)).unwrap();
        assert!(first.contains("covers 2.00 ms of the run's 400 ms: beyond"), "{first}");
    }

    /// What no finer model sees leaves less to what it sees.
    #[test]
    fn vectors_left_out_shorten_it() {
        let case = Case::example("scenes/impact", &[]);
        let run = case.for_run().unwrap();
        let scene = Scene::build(run, &Unwatched).unwrap();
        let mut choice = ModelChoice::of_case(run, &scene).unwrap();
        let method = choice.parts.iter().find(|part| part.what == "method");
        let mut part = method.unwrap().clone();
        let measured = choice.growth * choice.measured.unwrap().error;
        let whole = choice.share_of_steps().unwrap() / choice.estimated_error.unwrap();
        // but for round-off
        assert!((whole - 1.0).abs() < 1e-12, "{whole}");
        // three times the measured error: a third of the whole is left to it, within 6 % as the modes' part counts in none
        part.what = CONDENSATION;
        part.estimated_error = Some(3.0 * measured);
        choice.parts.push(part);
        choice.estimated_error = choice.estimated_error.map(|e| e.hypot(3.0 * measured));
        let share = choice.share_of_steps().unwrap() / measured;
        assert!((1.0..1.06).contains(&share), "{share}");
    }
}
