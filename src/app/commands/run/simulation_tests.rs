//! Simulations that stop and go on, and what is read back of them.

use super::unfinished::{RunIdentity, UnfinishedRun};
use super::*;
use crate::app::case::Case;
use crate::app::commands::analyze::{AnalysisSettings, DamageShown, WindowAnalysis, analyse};
use crate::app::commands::run::choice::ModelChoice;
use crate::app::error::ComputeError;
use crate::app::scene::{Scene, bearing_setup};
use crate::numerics::Unwatched;
use crate::numerics::ode::{
    Method, NoRecord, Schedule, Snapshot, Statistics, Stepping as Going, TransientError, integrate,
};
use crate::numerics::series::{TimeSeries, TimeWindow};
use crate::signal::diagnosis::Kinematics;
use crate::system::{RecordLayout, RunRecord};
use std::f64::consts::TAU;

/// Stops after so many intervals, one number a part of the run.
#[derive(Default)]
struct Stops {
    after: Vec<u64>,
    intervals: u64,
    kept: Option<(RunRecord, Snapshot)>,
}

impl Checkpoints for Stops {
    type Record = RunRecord;

    fn open(&mut self, layout: RecordLayout) -> Result<(RunRecord, Option<Snapshot>), ComputeError> {
        self.intervals = 0;
        Ok(match self.kept.take() {
            Some((record, snapshot)) => (record, Some(snapshot)),
            None => (RunRecord::blank(layout), None),
        })
    }

    fn request(&mut self) -> RunRequest {
        self.intervals += 1;
        match self.after.last() {
            Some(&after) if self.intervals >= after => {
                self.after.pop();
                RunRequest::Stop
            }
            // checkpoints change nothing
            _ if self.intervals.is_multiple_of(7) => RunRequest::Checkpoint,
            _ => RunRequest::GoOn,
        }
    }

    fn save(&mut self, record: &RunRecord, _: f64, snapshot: &Snapshot) -> Result<(), ComputeError> {
        // through words, as a file has them
        let words = snapshot.words.clone();
        self.kept = Some((record.clone(), Snapshot { words }));
        Ok(())
    }
}

fn case(set: &[&str]) -> Case {
    Case::example("scenes/smooth", set)
}

/// Bits of all columns.
fn bits(record: &RunRecord) -> Vec<Vec<u64>> {
    record.layout().columns().map(|column| record.column(column).iter().map(|x| x.to_bits()).collect()).collect()
}

/// A first ball in a dent, the others lifting off and landing.
const DENTED: [&str; 2] = [
    "bearing.radial_play=2.5e-6",
    "bearing.defects=[{on='outer',angle_deg=270,length=0.75e-3,width=0.41e-3,depth=15e-6,rim_radius=0.05e-3}]",
];

#[test]
fn a_run_that_stops_and_goes_on_gives_the_bits_of_one_that_does_not() {
    let with_inertia = [&["transient.end=3e-4"], &DENTED[..]].concat();
    let without = [&with_inertia[..], &["bearing.balls_inertia='quasi-static'", "bearing.contact_damping=0"]].concat();
    let methods: &[&[&str]] = &[
        &["exponential", "step=1.3e-7"],
        &["exponential-adams", "step=1.3e-7"],
        &["splitting", "step=1.3e-7"],
        &["newmark-explicit", "end=1.2e-4"],
        &["newmark", "step=2.5e-7"],
        &["generalized-alpha", "step=2.5e-7"],
        &["dop853", "tolerance=1e-5"],
        &["exponential", "step=1.3e-7", "modes=8"],
    ];
    let few: &[&[&str]] = &[&["exponential", "end=2e-4"]];
    let mut other = Vec::new();
    for (scene_set, methods) in [(with_inertia, methods), (without, few)] {
        let of_scene = case(&scene_set);
        let scene = Scene::build(of_scene.for_run().unwrap(), &Unwatched).unwrap();
        for keys in methods {
            let method = format!("transient.method={}", keys[0]);
            let others = keys[1..].iter().map(|key| format!("transient.{key}"));
            let others: Vec<String> = others.collect();
            let mut set = scene_set.clone();
            set.push(&method);
            set.extend(others.iter().map(String::as_str));
            if !goes_on_as_if_it_had_not_stopped(&scene, &case(&set)) {
                other.push(keys);
            }
        }
    }
    assert!(other.is_empty(), "{other:?}");
}

fn goes_on_as_if_it_had_not_stopped(scene: &Scene, case: &Case) -> bool {
    let (run, set) = (case.for_run().unwrap(), &case.source.set);
    let asked = run.transient;
    let model = ModelChoice::of_case(run, scene).unwrap().model;
    let span = Span { duration: asked.end - asked.start, output_hz: asked.output_hz };
    let whole = Simulation::kept_from_rest(scene, &model, span, true, &mut InMemory, |_| {});
    let whole = whole.unwrap();
    assert!(matches!(whole.end, RunEnd::Complete), "{set:?}");
    let mut stops = Stops { after: vec![31, 14, 2, 1, 9], ..Stops::default() };
    let mut parts = 1;
    let gone_on = loop {
        match Simulation::kept_from_rest(scene, &model, span, true, &mut stops, |_| {}) {
            Ok(simulation) => break simulation,
            Err(ComputeError::Interrupted { .. }) => parts += 1,
            Err(error) => panic!("{set:?}: {error}"),
        }
    };
    assert_eq!(parts, 6, "{set:?}");
    let loads = whole.record.outer_force.iter();
    let loaded = loads.filter(|force| **force > 0.0).count();
    assert!((1..whole.record.outer_force.len()).contains(&loaded));
    // a finished run that goes on has nothing left to do
    let again = Simulation::kept_from_rest(scene, &model, span, true, &mut stops, |_| {}).unwrap();
    let same = |other: &Simulation| {
        other.statistics == whole.statistics
            && bits(&other.record) == bits(&whole.record)
            && other.energy == whole.energy
    };
    same(&gone_on) && same(&again)
}

#[test]
fn a_run_of_another_model_does_not_go_on() {
    let stopped = |set: &[&str], stops: &mut Stops| {
        let case = case(set);
        let run = case.for_run().unwrap();
        let asked = run.transient;
        let scene = Scene::build(run, &Unwatched).unwrap();
        let model = ModelChoice::of_case(run, &scene).unwrap().model;
        let span = Span { duration: 1e-4, output_hz: asked.output_hz };
        Simulation::kept_from_rest(&scene, &model, span, true, stops, |_| {}).unwrap_err()
    };
    let mut stops = Stops { after: vec![5], ..Stops::default() };
    let error = stopped(&[], &mut stops);
    assert!(matches!(error, ComputeError::Interrupted { .. }), "{error}");
    assert!(!error.is_input());
    let error = stopped(&["shaft.mass=0.15000000000000002"], &mut stops);
    assert!(error.to_string().starts_with("the model is not to the last bit that of the unfinished run: "), "{error}");
    assert_eq!(error.help().as_deref(), Some("begin anew with --force"));
    assert!(error.is_input());
}

#[test]
fn what_is_on_disk_is_what_would_be_in_memory() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("partial");
    // a window that is read in part, and more rows than are handed on at once
    let case = case(&[
        "transient.end=12e-3",
        "transient.step=2.5e-6",
        "transient.method=newmark",
        "analysis.envelope=[{from=4e-3,to=5e-3}]",
    ]);
    let in_memory = compute_run(&case, &Unwatched).unwrap();
    let identity = || RunIdentity::of(&case, "run").unwrap();
    let mut unfinished = UnfinishedRun::begin(&path, identity());
    let on_disk = compute_kept_run(&case, &Unwatched, &mut unfinished).unwrap();
    assert_eq!(Recording::rows(&on_disk.simulation.record), 4801);
    for column in in_memory.simulation.record.layout().columns() {
        let mut values = Vec::new();
        let mut take = |piece: &[f64]| {
            values.extend_from_slice(piece);
            Ok(())
        };
        let record: &dyn Recording = &on_disk.simulation.record;
        record.read(column, 0..record.rows(), &mut take).unwrap();
        assert_eq!(values, in_memory.simulation.record.column(column), "{column:?}");
    }
    let windows = |result: &[WindowAnalysis]| format!("{result:?}");
    assert_eq!(windows(&on_disk.windows), windows(&in_memory.windows));
    assert_eq!(on_disk.windows.len(), 1);
    let text = |report: crate::report::Report| {
        let html = report.to_html().unwrap();
        html.split("application/json").nth(1).unwrap_or_default().to_owned()
    };
    assert!(text(run_report(&case, &on_disk, "").unwrap()) == text(run_report(&case, &in_memory, "").unwrap()));
    assert!(UnfinishedRun::is_in(&path));
    // the end is a checkpoint too: what is left to do is to analyse
    let mut unfinished = UnfinishedRun::resume(&path, identity()).unwrap();
    let again = compute_kept_run(&case, &Unwatched, &mut unfinished).unwrap();
    assert_eq!(windows(&again.windows), windows(&in_memory.windows));
    // the times of all parts add up
    let [first, then] = [&on_disk, &again].map(|result| &result.simulation);
    assert!(first.before_s <= 0.0 && first.stepping_s > 0.0);
    assert!(then.before_s > 0.5 * first.stepping_s && then.before_s <= first.stepping_s, "{}", then.before_s);
    assert!(then.stepping_s >= then.before_s);
    unfinished.remove().unwrap();
    assert!(!path.exists());
    let error = UnfinishedRun::resume(&path, identity()).unwrap_err();
    let expected = format!("{} has no checkpoint: there is no unfinished run to go on with", path.display());
    assert_eq!(error.to_string(), expected);
    assert_eq!(error.help().as_deref(), Some("leave --resume out to begin a run"));
    assert!(error.is_input());
}

#[test]
fn no_sample_lies_beyond_the_end() {
    for (end, rows) in [("1e-3", 401), ("1.001e-3", 401), ("1.0025e-3", 402)] {
        let case = Case::example("scenes/smooth", &[&format!("transient.end={end}"), "transient.modes=7"]);
        let result = compute_run(&case, &Unwatched).unwrap();
        assert_eq!(Recording::rows(&result.simulation.record), rows, "{end}");
    }
}

/// A simulation with this signal at its one sensor, 100 kHz.
fn with_signal(values: Vec<f64>) -> Simulation {
    let mut record = RunRecord::blank(RecordLayout { sensors: vec!["P1".to_owned()], ..RecordLayout::default() });
    let instants = values.iter().enumerate();
    record.time_s = instants.map(|(k, _)| 2.0 + k as f64 * 1e-5).collect();
    (record.shaft_x, record.shaft_y) = (values.clone(), values.clone());
    record.sensors[0].1 = values;
    Simulation {
        method: crate::numerics::ode::Method::Exponential,
        schedule: Schedule::covering(1.0, 1e-5, 1e-5).unwrap(),
        modes: 1,
        residual: false,
        statistics: Statistics::default(),
        start_s: 2.0,
        simulated_s: 1.0,
        stepping_s: 1.0,
        before_s: 0.0,
        record,
        energy: None,
        end: RunEnd::Complete,
    }
}

#[test]
fn a_stretch_is_a_part_of_the_signal_with_its_instants() {
    let simulation = with_signal((0..1000).map(f64::from).collect());
    let window = |from: f64, to: f64| TimeWindow { from, to };
    let part = simulation.stretch(0, window(2.004, 2.005), 1e-3).unwrap();
    let whole = simulation.signal(0).unwrap();
    assert!(part.start_s() <= 2.003 && part.end_s() >= 2.006);
    assert!(part.values().len() <= 305);
    assert_eq!(part.window(2.004, 2.005).unwrap().values(), whole.window(2.004, 2.005).unwrap().values());
    // more before and after than there is
    let all = simulation.stretch(0, window(2.004, 2.005), 1.0).unwrap();
    assert_eq!(all.values(), whole.values());
    let error = simulation.stretch(0, window(2.004, 2.02), 1e-3);
    assert_eq!(error.unwrap_err().to_string(), whole.window(2.004, 2.02).unwrap_err().to_string());
}

#[test]
fn an_envelope_of_a_stretch_is_that_of_the_whole_signal() {
    let set = ["analysis.envelope=[{from=2.4,to=2.6}]"];
    let case = Case::example("tadina2011/outer-dent", &set);
    let setup = bearing_setup(&case).unwrap().unwrap();
    // bursts of 8.2 kHz 55 times a second over a slow vibration that does not end where it begins
    let values = (0..100_000).map(|k| {
        let t = f64::from(k) * 1e-5;
        let since = t - (t * 55.0).floor() / 55.0;
        30.0 * (TAU * 300.3 * t).sin() + 100.0 * (-515.0 * since).exp() * (TAU * 8200.0 * since).sin()
    });
    let simulation = with_signal(values.collect());
    let analysed = |read: &dyn Fn(TimeWindow, f64) -> Result<TimeSeries, ComputeError>| {
        let settings = AnalysisSettings::of(&case, case.bearing.as_ref(), DamageShown::InPlane);
        let mut windows = analyse(
            "P1",
            &settings,
            read,
            &Kinematics::of(&setup.cage, setup.geometry.balls(), setup.geometry.orders()),
        )
        .unwrap();
        windows.remove(0).spectrum.spectrum.amplitude
    };
    let part = analysed(&|window, margin| simulation.stretch(0, window, margin));
    let whole = analysed(&|_, _| simulation.signal(0));
    let most = whole.iter().fold(0.0, |most: f64, a| most.max(*a));
    let pairs = part.iter().zip(&whole);
    let difference = pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
    println!("{difference:.1e} of {most:.1e}");
    // both have ends of their own: 1 / (2 pi^2 200 periods of 5 kHz or more) of the signal there, at the window's edges alone
    assert!(difference < 3e-4 * most, "{difference:e} of {most:e}");
}

/// The limit that a blow-up names is that of runs: contacts, their damping and modes count together. In seven modes; with many more, runs grow
/// within it too.
#[test]
fn a_run_is_stable_up_to_the_limit_that_a_blow_up_names() {
    let case = case(&["transient.modes=7"]);
    let run = case.for_run().unwrap();
    let scene = Scene::build(run, &Unwatched).unwrap();
    let model = ModelChoice::of_case(run, &scene).unwrap().model;
    let mut system = scene.system(&model).unwrap();
    let rest = scene.at_rest(&system);
    for method in [Method::ExponentialAdams { tolerance: None }, Method::Exponential] {
        let mut run = |h: f64| {
            let schedule = Schedule { interval: 6.0 * h, steps_per_interval: 6, intervals: 300 };
            let mut state = rest.clone();
            let on = |_, _| Going::Continue;
            integrate(&mut system, method, &schedule, &mut state, &mut NoRecord, on)
        };
        let Err(TransientError::BlewUp(blow_up)) = run(1.4e-6) else {
            panic!("1.4e-6 s is too long for {method:?}");
        };
        let limit = blow_up.limit.unwrap().step_s;
        assert!(limit < 1.4e-6, "{blow_up}");
        assert_eq!(blow_up.beyond_the_limit(), Some(true));
        assert_eq!(blow_up.resonance, None);
        // 1800 steps show growth beyond some percent of the limit: five percent beyond it is a tenth a step and more
        assert!(run(0.98 * limit).is_ok(), "{method:?} {limit}");
        assert!(run(1.05 * limit).is_err(), "{method:?} {limit}");
    }
}
