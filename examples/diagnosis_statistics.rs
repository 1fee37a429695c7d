//! How often the damaged part is named: four states of the bearing in three housings, perturbed runs, in what disturbs a diagnosis.
//!
//! Each run goes through the run-up of `examples/tadina2011` (10 Hz a second) and is judged from 2.2 to 2.8 s, 13.8 turns of the
//! shaft. Runs of a scene begin 13.7 ms apart, from 1.8 s on: contacts open and close, so that after 0.1 s no two of them are alike.
//! The tables are those of `docs/diagnosis.md`.
//!
//! ```text
//! cargo run --release --example diagnosis_statistics [RUNS] [HOUSING...]
//! ```

use std::error::Error;
use std::f64::consts::TAU;
use std::io::Write;

use plummer::app::case::Case;
use plummer::app::commands::analyze::{AnalysisSettings, AskedBand, analyse};
use plummer::app::commands::run::choice::ModelChoice;
use plummer::app::commands::run::{Simulation, Span};
use plummer::app::scene::{CoupledStructure, Scene};
use plummer::bearing::kinematics::BallRow;
use plummer::bearing::{SpeedKnot, SpeedProfile};
use plummer::numerics::Unwatched;
use plummer::numerics::series::{TimeSeries, TimeWindow};
use plummer::signal::diagnosis::FaultOrders;
use plummer::signal::diagnosis::Kinematics;
use rayon::prelude::*;

type Failure = Box<dyn Error + Send + Sync>;

const HOUSINGS: [&str; 3] = ["ring", "pillow_block", "end_shield"];

/// What is damaged, and the lines of a case that damage it: those of `examples/tadina2011`.
const STATES: [(&str, &str); 4] = [
    ("none", "[]"),
    (
        "outer race",
        "[{on='outer',angle_deg=270,length=0.75e-3,width=0.41e-3,depth=0.015e-3,profile='in-plane',rim_radius=0.05e-3}]",
    ),
    (
        "inner race",
        "[{on='inner',angle_deg=0,length=0.8e-3,width=0.2e-3,depth=0.015e-3,profile='in-plane',rim_radius=0.05e-3}]",
    ),
    ("ball", "[{on='ball',ball=0,angle_deg=0,flat_radius=2e-3,depth=0.01e-3,rim_radius=0.05e-3}]"),
];

const WINDOW: TimeWindow = TimeWindow { from: 2.2, to: 2.8 };
const END_S: f64 = 2.82;

/// What disturbs a diagnosis.
struct Condition {
    name: &'static str,
    /// Whether the cage slips, 0 to 1 % at random every 50 ms, and nobody knows.
    slip: bool,
    /// Relative error of the pitch diameter that is given, in turns too large and too small.
    geometry: f64,
    /// Power of the signal over that of white noise, dB.
    noise_db: Option<f64>,
}

const CONDITIONS: [Condition; 7] = [
    condition("none", false, 0.0, None),
    condition("slip of the cage, 0 to 1 % at random", true, 0.0, None),
    condition("pitch diameter given 1 % wrong", false, 0.01, None),
    condition("white noise, 0 dB", false, 0.0, Some(0.0)),
    condition("white noise, -10 dB", false, 0.0, Some(-10.0)),
    condition("slip, diameter and 0 dB", true, 0.01, Some(0.0)),
    condition("slip, diameter and -10 dB", true, 0.01, Some(-10.0)),
];

const fn condition(name: &'static str, slip: bool, geometry: f64, noise_db: Option<f64>) -> Condition {
    Condition { name, slip, geometry, noise_db }
}

/// Uniform and normal numbers (splitmix64, Box and Muller).
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        (-2.0 * (1.0 - self.unit()).ln()).sqrt() * (TAU * self.unit()).cos()
    }
}

fn main() -> Result<(), Failure> {
    let mut arguments = std::env::args().skip(1);
    let runs: u32 = arguments.next().map_or(Ok(20), |runs| runs.parse())?;
    let named: Vec<String> = arguments.collect();
    for housing in HOUSINGS {
        if named.is_empty() || named.iter().any(|name| name == housing) {
            table(housing, runs)?;
        }
    }
    Ok(())
}

/// Simulates and judges everything in a housing and writes its table.
fn table(housing: &str, runs: u32) -> Result<(), Failure> {
    let path = format!("{}/examples/housings/{housing}.toml", env!("CARGO_MANIFEST_DIR"));
    let structure = CoupledStructure::build(&Case::load(&path, &[])?, &Unwatched)?;
    let structure = structure.ok_or("the case has no ring")?;
    let jobs: Vec<(usize, u32)> = (0..STATES.len()).flat_map(|state| (0..runs).map(move |run| (state, run))).collect();
    let names: Vec<Vec<Vec<&str>>> = jobs
        .par_iter()
        .map(|&(state, run)| judge_run(&path, &structure, state, run))
        .collect::<Result<_, Failure>>()?;
    let mut out = std::io::stdout().lock();
    writeln!(out, "{housing}, {runs} runs each: times named / times another part was named")?;
    write!(out, "| disturbed by |")?;
    for (state, _) in STATES {
        write!(out, " {state} |")?;
    }
    writeln!(out, "\n|---|---|---|---|---|")?;
    for (index, condition) in CONDITIONS.iter().enumerate() {
        write!(out, "| {} |", condition.name)?;
        for (state, (part, _)) in STATES.iter().enumerate() {
            let own = jobs.iter().zip(&names).filter(|((of, _), _)| *of == state);
            let (mut right, mut wrong) = (0, 0);
            for (_, verdicts) in own {
                right += u32::from(verdicts[index].contains(part));
                wrong += u32::from(verdicts[index].iter().any(|name| name != part));
            }
            if state == 0 {
                write!(out, " - / {wrong} |")?;
            } else {
                write!(out, " {right} / {wrong} |")?;
            }
        }
        writeln!(out)?;
    }
    for ((state, run), verdicts) in jobs.iter().zip(&names) {
        let part = STATES[*state].0;
        for (condition, named) in CONDITIONS.iter().zip(verdicts) {
            for wrong in named.iter().filter(|name| **name != part) {
                let disturbed = condition.name;
                writeln!(out, "run {run}, damaged: {part}, disturbed by: {disturbed}: {wrong} named")?;
            }
        }
    }
    Ok(())
}

/// The parts that are named in each condition.
fn judge_run(
    path: &str,
    structure: &CoupledStructure,
    state: usize,
    run: u32,
) -> Result<Vec<Vec<&'static str>>, Failure> {
    let steady = simulate(path, structure, state, run, false)?;
    let slipping = simulate(path, structure, state, run, true)?;
    let verdicts = CONDITIONS.iter().map(|condition| {
        let (signal, bearing) = if condition.slip { &slipping } else { &steady };
        let noisy = with_noise(signal, condition.noise_db, run)?;
        named(&noisy, bearing, condition, run)
    });
    verdicts.collect()
}

/// Signal at the first sensor, and balls, ball diameter and pitch diameter of the bearing.
fn simulate(
    path: &str,
    structure: &CoupledStructure,
    state: usize,
    run: u32,
    slip: bool,
) -> Result<(TimeSeries, (u32, f64, f64)), Failure> {
    let mut set = vec![
        format!("bearing.defects={}", STATES[state].1),
        "speed.profile=[{time=0.2,hz=0.0},{time=4.7,hz=45.0}]".to_owned(),
        format!("transient.start={}", 1.8 + 0.0137 * f64::from(run)),
        format!("transient.end={END_S}"),
        "analysis.envelope=[]".to_owned(),
    ];
    if slip {
        let mut random = Random(u64::from(run) + 1);
        let knots = (0..27).map(|k| {
            let time = 1.75 + 0.05 * f64::from(k);
            format!("{{time={time},slip={}}}", 0.01 * random.unit())
        });
        let knots: Vec<String> = knots.collect();
        set.push(format!("bearing.slip={{profile=[{}]}}", knots.join(",")));
    }
    let case = Case::load(path, &set)?;
    let run = case.for_run()?;
    let asked = run.transient;
    let mut scene = Scene::around(structure.clone(), run)?;
    let choice = ModelChoice::of_case(run, &scene)?;
    scene.setup.balls_inertia = choice.model.balls_inertia;
    let span = Span { duration: asked.end - asked.start, output_hz: asked.output_hz };
    let simulation = Simulation::from_rest(&scene, &choice.model, span, |_| ())?;
    let geometry = &scene.setup.geometry;
    let diameters = (2.0 * geometry.ball_radius(), 2.0 * geometry.pitch_radius());
    let bearing = (geometry.balls(), diameters.0, diameters.1);
    Ok((simulation.signal(0)?, bearing))
}

fn with_noise(signal: &TimeSeries, noise_db: Option<f64>, run: u32) -> Result<TimeSeries, Failure> {
    let Some(noise_db) = noise_db else {
        return Ok(signal.clone());
    };
    let level = signal.window(WINDOW.from, WINDOW.to)?.rms() * 10_f64.powf(-noise_db / 20.0);
    let mut random = Random(1000 + u64::from(run));
    let noisy = signal.values().iter().map(|value| value + level * random.normal());
    Ok(signal.with_values(noisy.collect())?)
}

/// The parts that are named by somebody who has the signal, the shaft's speed and the bearing as given.
#[allow(clippy::result_large_err)] // the library's own error
fn named(
    signal: &TimeSeries,
    bearing: &(u32, f64, f64),
    condition: &Condition,
    run: u32,
) -> Result<Vec<&'static str>, Failure> {
    let &(balls, ball_diameter, pitch_diameter) = bearing;
    let sign = if run.is_multiple_of(2) { 1.0 } else { -1.0 };
    let pitch_diameter = pitch_diameter * (1.0 + sign * condition.geometry);
    let row = BallRow::new(balls, ball_diameter, pitch_diameter, 0.0)?;
    // the tolerance that `plummer analyze` has unless told otherwise
    let kinematics = Kinematics::Given {
        orders: FaultOrders::of(&row.orders(), 0.01)?,
        speed: SpeedProfile::new(&[
            SpeedKnot { time: 0.2, frequency_hz: 0.0 },
            SpeedKnot { time: 4.7, frequency_hz: 45.0 },
        ])?,
    };
    let settings = AnalysisSettings {
        band: None,
        shown_band: Some(AskedBand::HighPass(5e3)),
        whiten: false,
        windows: vec![WINDOW],
        good_to_hz: None,
        no_signs: Vec::new(),
    };
    let read = |window: TimeWindow, margin_s: f64| {
        let span = signal.span();
        let from = (window.from - margin_s).max(span.from);
        let to = (window.to + margin_s).min(span.to);
        Ok(signal.window(from, to)?)
    };
    let windows = analyse("P1", &settings, read, &kinematics)?;
    let diagnosis = windows[0].diagnosis.as_ref().map_err(String::clone)?;
    Ok(diagnosis.named().map(|verdict| verdict.fault.name()).collect())
}
