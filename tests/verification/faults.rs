//! Every kind of damage makes itself heard at its own order.

use std::path::PathBuf;

use plummer::app::case::{Case, Source};
use plummer::app::commands::run::{RunEnd, RunResult, compute_run};
use plummer::numerics::Unwatched;

/// An example at constant speed: 10 Hz between two lines of the envelope's spectrum over 0.2 s, in quarters.
fn run(example: &str, set: &[&str]) -> RunResult {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("examples/tadina2011/{example}.toml"));
    let constant = ["speed.profile=[{time=0,hz=21}]", "transient.end=0.25", "analysis.envelope=[{from=0.05,to=0.25}]"];
    let case = Case::from_source(Source {
        text: std::fs::read_to_string(&path).unwrap(),
        path,
        set: constant.iter().chain(set).map(|&set| set.to_owned()).collect(),
    });
    let result = compute_run(&case.unwrap(), &Unwatched).unwrap();
    assert!(matches!(result.simulation.end, RunEnd::Complete));
    result
}

/// Largest amplitude of the envelope's spectrum within 3 % of a frequency, m/s^2.
fn line(result: &RunResult, hz: f64) -> f64 {
    let peak = result.windows[0].spectrum.peak_near(hz, 0.03);
    peak.map_or(0.0, |peak| peak.amplitude)
}

/// From six starts: impacts are chaotic, and own lines were found to scatter from 11 to 15 m/s^2 (outer dent), 3.6 to 8.7 (inner dent)
/// and 5.1 to 7.4 (flat), those beside them up to 5.3, 5.0 and 4.7, and 0.2 to 0.6 without damage. The flat's own line is above the
/// others by 4.6 on average, over 32 starts by -0.4 to 9.9: of a single one nothing follows.
#[test]
fn every_fault_has_its_own_order() {
    let starts = [270, 280, 290, 300, 310, 320].map(|deg| format!("bearing.first_ball_deg={deg}"));
    let runs = |example: &str| starts.each_ref().map(|start| run(example, &[start]));
    let mean = |runs: &[RunResult; 6], of: &dyn Fn(&RunResult) -> f64| runs.iter().map(of).sum::<f64>() / 6.0;
    let healthy = runs("healthy");
    let orders = healthy[0].machine.in_plane().unwrap().scene.setup.geometry.orders();
    let lines = [orders.outer, orders.inner, orders.ball_defect].map(|order| 21.0 * order);
    for (example, own) in [("outer-dent", 0), ("inner-dent", 1), ("ball-flat", 2)] {
        let faulty = runs(example);
        let amplitude = mean(&faulty, &|run| line(run, lines[own]));
        for (other, &hz) in lines.iter().enumerate().filter(|(other, _)| *other != own) {
            // the inner dent comes under the load once a turn: 93.1 Hz less one and two times 21 Hz are 72.1 and 51.1 Hz,
            // which 0.2 s cannot tell from 73.3 and 53.9 Hz
            if example == "inner-dent" {
                continue;
            }
            let beside = mean(&faulty, &|run| line(run, hz));
            assert!(amplitude > beside, "{example}: {amplitude} at its own order, {beside} at {other}");
        }
        let sound = mean(&healthy, &|run| line(run, lines[own]));
        assert!(amplitude > 5.0 * sound, "{example}: {amplitude}, without it {sound}");
        // found 240 to 620 m/s^2, and 25 to 60
        let [peak, quiet] = [&faulty, &healthy].map(|runs| mean(runs, &|run| run.windows[0].peak));
        assert!(peak > 5.0 * quiet, "{example}: {peak} m/s^2, without it {quiet} m/s^2");
    }
}

/// A dent on top of the outer race is passed by balls that nothing presses. One start scatters by two: mean of six.
#[test]
fn a_dent_outside_the_loaded_zone_is_hardly_heard() {
    let rms = |angle_deg: u32| {
        let angle = format!("bearing.defects[0].angle_deg={angle_deg}");
        let starts = [270, 280, 290, 300, 310, 320].map(|deg| format!("bearing.first_ball_deg={deg}"));
        let of = |start: &String| run("outer-dent", &[&angle, start]).windows[0].rms;
        starts.iter().map(of).sum::<f64>() / 6.0
    };
    let (heard, hardly) = (rms(270), rms(90));
    println!("{heard} and {hardly} m/s^2");
    // found 44 and 9 m/s^2 with any number of vectors; 3.9 without a dent
    assert!(heard > 4.0 * hardly, "{heard} and {hardly} m/s^2");
}

/// A dent in the inner race is heard while it passes the load. Not so the paper's: it is deeper than the play, so that the
/// balls above the shaft fall into it and are thrown against the outer race.
#[test]
fn a_turning_dent_is_heard_under_the_load() {
    let shallow = ["bearing.defects[0].depth=1e-6", "shaft.loads=[{force=[0,-20]}]"];
    let result = run("inner-dent", &shallow);
    let signal = result.simulation.signal(0).unwrap();
    let times = &result.simulation.record.time_s;
    let mut power = [(0.0, 0); 2];
    for (&time, acceleration) in times.iter().zip(signal.values()) {
        // the dent's height, its angle being the shaft's
        let height = result.machine.in_plane().unwrap().scene.setup.cage.shaft().angle(time).sin();
        if time > 0.05 && height.abs() > 0.5 {
            let (sum, count) = &mut power[usize::from(height > 0.0)];
            *sum += acceleration * acceleration;
            *count += 1;
        }
    }
    let [below, above] = power.map(|(sum, count)| sum / f64::from(count));
    // found 3e4 and 17
    assert!(below > 100.0 * above, "{below} and {above} m^2/s^4");
}
