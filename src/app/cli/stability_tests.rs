//! The map of a small scene under a few conditions, through its files.

use std::fs;
use std::time::{Duration, Instant};

use serde_json::Value;

use super::{Effort, OutputFolder, compute_stability, stability_lines, write_stability};
use crate::app::case::Case;
use crate::app::cli::results::Job;
use crate::app::cli::{Options, Progress};
use crate::app::scene::Scene;
use crate::app::studies::chart::{Budget, Condition, Deadline, Stage, stability_report};
use crate::numerics::Unwatched;

/// The smooth scene made small: a ring of 12 nodes, and a target for which seven modes are enough, whose limits are the test's.
fn small() -> Case {
    Case::example("scenes/smooth", &["ring.nodes=12", "accuracy.target=0.1"])
}

fn limit(of: &Value, which: &str) -> f64 {
    of[which].as_f64().unwrap()
}

#[test]
fn a_map_has_its_files_and_limits() {
    let case = small();
    let out = std::env::temp_dir().join(format!("plummer-{}-stability", std::process::id()));
    fs::create_dir_all(&out).unwrap();
    let run = case.for_stability().unwrap();
    let scene = Scene::build(run, &Unwatched).unwrap();
    let asked = vec![
        Condition::AsGiven,
        Condition::ContactDamping(0.0),
        Condition::ContactStiffness(10.0),
        // more than a tenth of the ball's radius
        Condition::RadialPlay(2e-4),
    ];
    let map = compute_stability(run, &scene, asked, Effort::Quick, Deadline::NEVER, &Unwatched).unwrap();
    let begun = Instant::now().checked_sub(Duration::from_secs(9)).unwrap();
    let over = Budget::new(begun, Some(Duration::from_secs(1)), false).until(Stage::Map);
    let none = compute_stability(run, &scene, vec![Condition::AsGiven], Effort::Quick, over, &Unwatched).unwrap();
    assert_eq!(none.conditions[0].reason.as_deref(), Some("left out: the budget ended before"));
    assert!(stability_lines(&none).ends_with("\nwarning: the budget left 1 of 1 conditions out"));
    let (options, progress) = (Options::default(), Progress::new(false));
    let job = Job::new("chart", &case, &options, &progress);
    // a map without a condition has no picture
    let nothing = write_stability(&OutputFolder::at(&out), &none, &job.record(&[], None, &none)).unwrap();
    assert!(nothing.len() == 2 && !out.join("stability.svg").exists());
    let record = job.record(&[], None, &map);
    write_stability(&OutputFolder::at(&out), &map, &record).unwrap();
    let json = serde_json::to_value(&record).unwrap();
    let conditions = json["conditions"].as_array().unwrap();
    let of = |condition: usize, name: &str| -> Value {
        let methods = conditions[condition]["methods"].as_array().unwrap().iter();
        let mut equal = methods.filter(|of| of["by_tolerance"] == false);
        equal.find(|of| of["method"] == name).unwrap().clone()
    };
    for name in ["exponential", "exponential-adams", "newmark-explicit", "splitting"] {
        let method = of(0, name);
        let ratio = limit(&method, "measured_limit_s") / limit(&method, "predicted_limit_s");
        // all balls stay in contact: motions are small to the end; the bisection ends within 0.7 %, and runs of 600 steps do not
        // see the slowest growth
        assert!((ratio - 1.0).abs() < 0.03, "{name}: {ratio}");
        for step in method["steps"].as_array().unwrap() {
            let below = limit(step, "step_s") < limit(&method, "measured_limit_s");
            assert_eq!(step["measured"] == "stable", below, "{name}: {step}");
            assert_eq!(step["predicted"] == "stable", below, "{name}: {step}");
        }
    }
    for name in ["newmark", "generalized-alpha"] {
        let method = of(0, name);
        assert!(method["predicted_limit_s"].is_null() && method["measured_limit_s"].is_null());
        assert_eq!(method["note"], "none found up to a step of 7.92 µs");
    }
    let measured = |condition: usize| limit(&of(condition, "exponential"), "measured_limit_s");
    // a damper that is known a step late takes a third here: 1 s/m under a preload of 1.5 um
    assert!((1.3..2.0).contains(&(measured(1) / measured(0))));
    // preload fixes the overlap: without damping sqrt(10), with it, which grows as the force does, up to 10
    assert!((3.2..10.0).contains(&(measured(0) / measured(2))));
    let reason = conditions[3]["reason"].as_str().unwrap();
    assert!(reason.contains("radial_play"), "{reason}");
    let lines = stability_lines(&map);
    assert!(lines.contains("  newmark: predicted –, measured –; none found"), "{lines}");
    let read = |name: &str| fs::read_to_string(out.join(name)).unwrap();
    let written: Value = serde_json::from_str(&read("stability.json")).unwrap();
    assert_eq!(written["conditions"][0]["condition"], "as given");
    assert!(read("stability.svg").contains("predicted limit"));
    assert!(read("resonance.svg").starts_with("<svg "));
    let report = stability_report(&case, &map, "plummer chart").to_html().unwrap();
    assert!(report.contains("Stability map") && report.contains("radial play 200 µm"));
    fs::remove_dir_all(out).unwrap();
}
