//! Whether the estimated error of a run's model holds, over scenes drawn at random.
//!
//! Reference: the same scene with all modes and balls with inertia, in equal steps that are halved until halving changes less than
//! a tenth of the target, as far as both agree.
//! Goal: of smooth scenes all errors lie below their estimate, of the others 95 % while the solution can be predicted.
//! Sketch: the preloaded scene of the examples with load, play, damping, balls, band and a dent drawn anew.
//! Conditions: a fixed seed; all signals limited to the band.
//! Parameters: see [`draw`].
//!
//! ```text
//! cargo test --release --test program estimates -- --ignored --nocapture
//! PLUMMER_SEED=7 PLUMMER_KIND=smooth cargo test --release --test program estimates -- --ignored --nocapture
//! ```
//!
//! Where balls strike, references take most of the time: `PLUMMER_KIND=smooth` leaves these scenes out.

use plummer::app::case::Case;
use plummer::app::commands::run::choice::{Horizon, ModelChoice};
use plummer::app::commands::run::{RunEnd, Simulation, Span};
use plummer::app::scene::{RunModel, Scene};
use plummer::app::studies::chart::Trace;
use plummer::numerics::Unwatched;
use plummer::numerics::ode::Method;
use plummer::signal::{band_limit_edge_s, band_limit_from_rest};
use plummer::system::{BallsInertia, ModeSelection};
use rayon::prelude::*;

/// Scenes of the table.
const SCENES: u64 = 40;

/// Seed of the first scene's numbers, unless `PLUMMER_SEED` gives another; the other scenes follow it. The factors of the estimate were found on
/// the scenes of this one.
const SEED: u64 = 20_261_124;

/// Steps of the reference, s: the longest one, how often it is halved, and how often at most while there is no reference yet.
const FIRST_STEP: f64 = 1e-7;
const HALVINGS: usize = 2;
const MOST_HALVINGS: usize = 7;

/// Samples in a period of the band's highest frequency.
const SAMPLES: f64 = 10.0;

/// Windows in which two references are compared.
const WINDOWS: usize = 40;

/// Numbers between 0 and 1: splitmix64 (Steele, Lea and Flood 2014, OOPSLA).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// Evenly over the logarithm.
    fn scale(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    fn chance(&mut self, part: f64) -> bool {
        self.next() < part
    }
}

/// A scene's keys, and whether it has a fault.
struct Drawn {
    keys: Vec<String>,
    fault: bool,
    band_hz: f64,
    seconds: f64,
    text: String,
}

fn seed() -> u64 {
    std::env::var("PLUMMER_SEED").map_or(SEED, |seed| seed.parse().unwrap())
}

/// Draws scene `number`.
fn draw(number: u64) -> Drawn {
    let mut numbers = Numbers(seed().wrapping_add(number.wrapping_mul(0x1234_5678_9ABC_DEF1)));
    let load = numbers.scale(0.1, 100.0);
    let by_mass = numbers.chance(0.5);
    let play = numbers.between(-10e-6, 10e-6);
    let contact_damping = match numbers.chance(0.3) {
        true => 0.0,
        false => numbers.scale(0.1, 3.0),
    };
    let modal = numbers.scale(1e-3, 0.05);
    let balls = numbers.between(3.0, 41.0).floor();
    let band_hz = numbers.scale(1e3, 40e3).round();
    let seconds = [3e-3, 5e-3, 8e-3][(3.0 * numbers.next()) as usize];
    // the filter to the band takes 25 periods at both ends
    let seconds = f64::max(seconds, 75.0 / band_hz);
    let hz = numbers.between(10.0, 60.0);
    let fault = numbers.chance(0.4);
    let depth = numbers.scale(1e-6, 10e-6);
    // the largest balls that fit, at most those of the example
    let pitch = 3.75525e-3;
    let radius = (0.9 * pitch * (std::f64::consts::PI / balls).sin()).min(1e-3);
    let mut keys = vec![
        "ring.nodes=36".to_owned(),
        format!("bearing.balls={balls}"),
        format!("bearing.ball_radius={radius:e}"),
        format!("bearing.ball_mass={:e}", 3.29e-5 * (radius / 1e-3).powi(3)),
        format!("bearing.inner_race_radius={:e}", pitch - radius),
        format!("bearing.outer_race_radius={:e}", pitch + radius),
        format!("bearing.inner_groove_radius={:e}", 1.04 * radius),
        format!("bearing.outer_groove_radius={:e}", 1.07 * radius),
        format!("bearing.radial_play={play:e}"),
        format!("bearing.contact_damping={contact_damping:e}"),
        format!("damping.modal={modal:e}"),
        format!("accuracy.band_hz=[0,{band_hz}]"),
        format!("transient.output_hz={}", SAMPLES * band_hz),
        format!("transient.end={seconds:e}"),
        format!("speed.profile=[{{time=0,hz={hz}}}]"),
    ];
    let weight = 0.15 * 9.81;
    keys.push(match by_mass {
        true => format!("shaft.mass={:e}", 0.15 * load),
        false => format!("shaft.loads=[{{force=[0,{:e}]}}]", (1.0 - load) * weight),
    });
    if fault {
        keys.push(format!(
            "bearing.defects=[{{on='outer',angle_deg=270,length={:e},depth={depth:e},rim_radius=0.05e-3}}]",
            0.75 * radius
        ));
    }
    let text = format!(
        "{load:.2} {} | {:.1} | {contact_damping:.2} | {:.2} | {balls} | {:.1} | {:.0} | {}",
        if by_mass { "mass" } else { "force" },
        play * 1e6,
        modal * 100.0,
        band_hz / 1e3,
        seconds * 1e3,
        if fault { format!("{:.1}", depth * 1e6) } else { "-".to_owned() },
    );
    Drawn { keys, fault, band_hz, seconds, text }
}

/// The band-limited signals of a run by a model.
fn signals(scene: &Scene, model: &RunModel, drawn: &Drawn) -> Result<Trace, String> {
    let span = Span { duration: drawn.seconds, output_hz: SAMPLES * drawn.band_hz };
    let run = Simulation::from_rest(scene, model, span, |_| ()).map_err(|e| e.to_string())?;
    if let RunEnd::BlewUp(error) = &run.end {
        return Err(error.to_string());
    }
    let signals = (0..run.record.sensors.len()).map(|sensor| {
        let signal = run.signal(sensor).map_err(|error| error.to_string())?;
        band_limit_from_rest(&signal, drawn.band_hz).map_err(|error| error.to_string())
    });
    Ok(Trace::of(signals.collect::<Result<_, _>>()?))
}

/// The reference and the time over which it is one, s.
fn reference(scene: &Scene, drawn: &Drawn, target: f64) -> Result<(Trace, f64), String> {
    let mut step = FIRST_STEP;
    let inside = inside(drawn)?;
    let by = |step| RunModel {
        modes: ModeSelection::All,
        residual: false,
        balls_inertia: BallsInertia::Dynamic,
        method: Method::ExponentialAdams { tolerance: None },
        step,
    };
    let mut coarse = signals(scene, &by(step), drawn);
    let mut best: Result<(Trace, f64), String> = Err("no reference".to_owned());
    for halving in 0..MOST_HALVINGS {
        let found = best.as_ref().is_ok_and(|(_, horizon)| *horizon > inside[0]);
        if halving >= HALVINGS && found {
            break;
        }
        step *= 0.5;
        let fine = signals(scene, &by(step), drawn);
        if let (Ok(a), Ok(b)) = (&coarse, &fine) {
            let horizon = agreement(a, b, inside, 0.1 * target)?;
            best = Ok((b.clone(), horizon));
            if horizon >= inside[1] {
                break;
            }
        } else if let Err(error) = &fine {
            best = Err(error.clone());
        }
        coarse = fine;
    }
    best
}

/// The time that does not depend on how the filter goes on beyond the ends, s.
fn inside(drawn: &Drawn) -> Result<[f64; 2], String> {
    let step = 1.0 / (SAMPLES * drawn.band_hz);
    let edge = band_limit_edge_s(step, drawn.band_hz).map_err(|error| error.to_string())?;
    Ok([edge, drawn.seconds - edge])
}

/// Until when two traces differ by less than `most` of the size since the start, s; the start where they never do.
fn agreement(a: &Trace, b: &Trace, [start, stop]: [f64; 2], most: f64) -> Result<f64, String> {
    let window = (stop - start) / WINDOWS as f64;
    for number in 1..=WINDOWS {
        let end = start + window * number as f64;
        let error = a.error(b, end - window, end);
        let whole = a.error(b, start, end).map_err(|e| e.to_string())?;
        if error.is_ok_and(|error| error > most) || whole > most {
            return Ok(end - window);
        }
    }
    Ok(stop)
}

/// What a scene's row says.
struct Row {
    text: String,
    smooth: bool,
    holds: bool,
}

fn row(number: u64) -> Result<Row, String> {
    let drawn = draw(number);
    let path = format!("{}/examples/scenes/smooth.toml", env!("CARGO_MANIFEST_DIR"));
    let case = Case::load(&path, &drawn.keys).map_err(|error| error.to_string())?;
    let run = case.for_run().map_err(|error| error.to_string())?;
    let scene = Scene::build(run, &Unwatched).map_err(|error| error.to_string())?;
    let mut choice = ModelChoice::of_case(run, &scene).map_err(|error| error.to_string())?;
    let held = Horizon::of(run, &scene, &mut choice).ok_or("the estimate's horizon was not measured")?;
    let estimate = choice.estimated_error.ok_or("no estimate")?;
    let balls = scene.equilibrium.balls.iter();
    let pressed = { balls }.all(|ball| ball.inner > 0.0 && ball.outer > 0.0);
    let strikes = drawn.fault || !pressed;
    if strikes && std::env::var("PLUMMER_KIND").is_ok_and(|kind| kind == "smooth") {
        return Err("left out: balls strike".to_owned());
    }
    let (truth, horizon) = reference(&scene, &drawn, case.target())?;
    let [start, stop] = inside(&drawn)?;
    if horizon <= start {
        return Err("the references agree at no time".to_owned());
    }
    let until = horizon.min(held.held_s);
    if until <= start {
        return Err(format!("the estimate holds for {:.1} ms only", 1e3 * held.held_s));
    }
    // since the start, as `accuracy.target` is meant, and without the beginning, in which little has gone wrong yet: the larger one is judged
    let errors = |model: &RunModel| -> Result<[f64; 2], String> {
        let signals = signals(&scene, model, &drawn)?;
        let error = |from: f64| signals.error(&truth, from, until).map_err(|e| e.to_string());
        Ok([error(0.0)?, error(start)?])
    };
    let [whole, inner] = errors(&choice.model)?;
    let of_model = errors(&RunModel {
        method: Method::ExponentialAdams { tolerance: None },
        step: 0.5 * FIRST_STEP,
        ..choice.model
    });
    let smooth = !strikes && horizon >= stop;
    let part = |what: &str| choice.parts.iter().find(|part| part.what == what);
    let chosen = |what: &str| part(what).map_or("", |part| &part.chosen);
    let [modes, balls, method] =
        ["modes", "balls", "method"].map(|what| part(what).and_then(|part| part.estimated_error));
    let number_of = |value: Option<f64>| value.map_or("-".to_owned(), |value| format!("{value:.1e}"));
    let holds = whole.max(inner) <= estimate;
    let text = format!(
        "| {number} | {} | {} | {:.1} | {} {} | {} | {} | {} | {estimate:.1e} | {:.1} of {:.1} | {inner:.1e} | {whole:.1e} | {} | {} |",
        drawn.text,
        if smooth { "smooth" } else { "other" },
        (until - start) * 1e3,
        chosen("modes").split(' ').next().unwrap_or_default(),
        chosen("balls").split(' ').next().unwrap_or_default(),
        number_of(modes),
        number_of(balls),
        number_of(method),
        1e3 * held.held_s,
        1e3 * held.looked_s,
        number_of(of_model.ok().map(|[_, inner]| inner)),
        if holds { "yes" } else { "**no**" },
    );
    Ok(Row { text, smooth, holds })
}

#[test]
#[ignore = "minutes: compares 40 scenes with references of all modes"]
fn estimates_hold() {
    println!(
        "| scene | load, by | play um | c s/m | damping % | balls | band kHz | time ms | dent um | kind | compared ms | modes, balls | of modes | of balls | of method | estimate | holds ms | error after {} periods | since the start | of model | holds |",
        25
    );
    let rows: Vec<_> = (0..SCENES)
        .into_par_iter()
        .map(|number| {
            let row = row(number);
            match &row {
                Ok(row) => println!("{}", row.text),
                Err(error) => println!("| {number} | {} | {error} |", draw(number).text),
            }
            row
        })
        .collect();
    let of = |smooth: bool| {
        let rows = rows.iter().flatten().filter(|row| row.smooth == smooth);
        let holds: Vec<bool> = rows.map(|row| row.holds).collect();
        let held = holds.iter().filter(|holds| **holds).count();
        println!("{}: {held} of {} below their estimate", if smooth { "smooth" } else { "others" }, holds.len());
        (held, holds.len())
    };
    let (smooth, others) = (of(true), of(false));
    // of the forty of the seed above, 15 and 20 can be compared with a reference; other round-off may move one
    if seed() == SEED {
        assert!(smooth.1 >= 14 && others.1 >= 19, "{smooth:?} {others:?}");
    }
    assert_eq!(smooth.0, smooth.1);
    assert!(others.0 as f64 >= 0.95 * others.1 as f64);
}
