//! Every kind of damage makes itself heard at its own order.

use std::path::PathBuf;

use plummer::case::{Case, Source};
use plummer::stages::{RunEnd, RunResult, Unwatched, compute_run};

/// An example at constant speed: 10 Hz between two lines of the envelope's spectrum over 0.2 s, in quarters.
fn run(example: &str, set: &[&str]) -> RunResult {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join(format!("examples/tadina2011/{example}.toml"));
    let constant = [
        "speed.profile=[{time=0,hz=21}]",
        "transient.end=0.25",
        "analysis.envelope=[{from=0.05,to=0.25}]",
    ];
    let case = Case::from_source(Source {
        text: std::fs::read_to_string(&path).unwrap(),
        path,
        set: constant
            .iter()
            .chain(set)
            .map(|&set| set.to_owned())
            .collect(),
    });
    let result = compute_run(&case.unwrap(), &Unwatched).unwrap();
    assert!(matches!(result.end, RunEnd::Complete));
    result
}

/// Largest amplitude of the envelope's spectrum within 3 % of a frequency, m/s^2.
fn line(result: &RunResult, hz: f64) -> f64 {
    let peak = result.windows[0].spectrum.peak_near(hz, 0.03);
    peak.map_or(0.0, |peak| peak.amplitude)
}

#[test]
fn every_fault_has_its_own_order() {
    let healthy = run("healthy", &[]);
    let orders = healthy.setup.geometry.orders();
    let lines = [orders.outer, orders.inner, orders.ball_defect].map(|order| 21.0 * order);
    for (example, own) in [("outer-dent", 0), ("inner-dent", 1), ("ball-flat", 2)] {
        let faulty = run(example, &[]);
        let amplitude = line(&faulty, lines[own]);
        for (other, &hz) in lines.iter().enumerate().filter(|(other, _)| *other != own) {
            let beside = line(&faulty, hz);
            assert!(
                amplitude > 2.0 * beside,
                "{example}: {amplitude} at its own order, {beside} at {other}"
            );
        }
        let sound = line(&healthy, lines[own]);
        assert!(
            amplitude > 10.0 * sound,
            "{example}: {amplitude}, without it {sound}"
        );
        let (peak, quiet) = (faulty.windows[0].peak, healthy.windows[0].peak);
        assert!(
            peak > 10.0 * quiet,
            "{example}: {peak} m/s^2, without it {quiet} m/s^2"
        );
    }
}

/// A dent on top of the outer race is passed by balls that nothing presses.
#[test]
fn a_dent_outside_the_loaded_zone_is_not_heard() {
    let loaded = run("outer-dent", &[]);
    let unloaded = run("outer-dent", &["bearing.defects[0].angle_deg=90"]);
    let (heard, not_heard) = (loaded.windows[0].rms, unloaded.windows[0].rms);
    assert!(heard > 30.0 * not_heard, "{heard} and {not_heard} m/s^2");
}
