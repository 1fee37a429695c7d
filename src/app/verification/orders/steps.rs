//! Integrators on the preloaded bearing: the same signal with ever smaller steps.

use super::super::built_in::{SMOOTH, built_in};
use super::{Family, series};
use crate::app::commands::run::compute_run;
use crate::app::verification::section::VerificationError;
use crate::numerics::Unwatched;
use crate::numerics::series::TimeSeries;

/// Rate of the signals, Hz; steps divide its interval.
const OUTPUT_HZ: f64 = 400e3;
/// Steps in an interval, from coarse to fine.
const STEPS: [u32; 3] = [8, 16, 32];

/// Methods, and the order of each.
const METHODS: [(&str, f64); 5] = [
    ("exponential", 2.0),
    ("exponential-adams", 3.0),
    ("newmark-explicit", 2.0),
    ("newmark", 2.0),
    ("generalized-alpha", 2.0),
];

/// What a size is, and its unit.
const SIZE: [&str; 2] = ["Step", "s"];

pub(super) fn steps() -> Result<Family, VerificationError> {
    let steps = STEPS.map(|count| 1.0 / (OUTPUT_HZ * f64::from(count)));
    let exact = |step: &f64| signal("dop853", *step, Some("transient.tolerance=1e-12"));
    let exact = steps.iter().map(exact);
    let exact = exact.collect::<Result<Vec<_>, VerificationError>>()?;
    let mut all = Vec::new();
    for (method, theory) in METHODS {
        let errors = steps.iter().zip(&exact);
        let errors = errors.map(|(&step, exact)| Ok(difference(&signal(method, step, None)?, exact)));
        let errors = errors.collect::<Result<_, VerificationError>>()?;
        all.push(series(method.to_owned(), SIZE, steps.to_vec(), errors, [theory, 0.05]));
    }
    Ok(Family {
        title: "Signals by integrators",
        source: "Hairer, Lubich, Wanner, Geometric Numerical Integration, for the second order of one-step methods; Hochbruck, Ostermann, Acta Numerica 19 (2010) 209, for exponential Adams methods",
        assumptions: "examples/scenes/smooth.toml, 0.25 ms from rest with 14 modes: no impact, and no ball passes the end of a ring element, where accelerations have a kink. Root mean square of the acceleration's difference from dop853 at a tolerance of 1e-12, over that of the acceleration. Both are sampled at the step, whose filter they share.",
        reason: "Theory is for steps that go to zero; from the second step to the third the orders are within 2 % of it.",
        series: all,
    })
}

/// Acceleration of the first sensor, by a method with steps or samples of `step` seconds.
fn signal(method: &str, step: f64, key: Option<&str>) -> Result<TimeSeries, VerificationError> {
    let keys = [
        format!("transient.method={method}"),
        format!("transient.step={step:e}"),
        format!("transient.output_hz={OUTPUT_HZ}"),
    ];
    let of_scene = ["transient.modes=14", "transient.end=2.5e-4", "analysis.envelope=[]"];
    let keys = of_scene.into_iter().chain(keys.iter().map(String::as_str)).chain(key);
    let keys: Vec<&str> = keys.collect();
    let run = compute_run(&built_in("smooth.toml", SMOOTH, &keys)?, &Unwatched)?;
    Ok(run.simulation.signal(0)?)
}

/// Root mean square of the difference, over that of the second.
fn difference(found: &TimeSeries, exact: &TimeSeries) -> f64 {
    let square = |values: &mut dyn Iterator<Item = f64>| values.map(|x| x * x).sum::<f64>();
    let pairs = found.values().iter().zip(exact.values());
    let error = square(&mut pairs.map(|(a, b)| a - b));
    (error / square(&mut exact.values().iter().copied())).sqrt()
}
