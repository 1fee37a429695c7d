//! The map of a small scene, through its files.

use std::fs;

use serde_json::Value;

use super::{Effort, Options, Progress, alone};
use crate::case::{Case, Source};
use crate::cli::Visibility;

/// The smooth scene made small: a ring of 12 nodes, and a band that keeps few modes.
fn small() -> Case {
    let path = format!("{}/examples/scenes/smooth.toml", env!("CARGO_MANIFEST_DIR"));
    let case = Case::from_source(Source {
        text: fs::read_to_string(&path).unwrap(),
        path: path.into(),
        set: vec!["ring.nodes=12".to_owned()],
    });
    case.unwrap()
}

#[test]
fn a_map_has_its_files_and_limits() {
    let case = small();
    let out = std::env::temp_dir().join(format!("plummer-{}-stability", std::process::id()));
    fs::create_dir_all(&out).unwrap();
    let options = Options {
        out: Some(out.clone()),
        ..Options::default()
    };
    let progress = Progress::new(Visibility::Hidden);
    let outcome = alone(&case, Effort::Quick, "plummer chart", &options, &progress).unwrap();
    let read = |name: &str| fs::read_to_string(out.join(name)).unwrap();
    let json: Value = serde_json::from_str(&read("stability.json")).unwrap();
    assert_eq!(json, outcome.result);
    let conditions = json["conditions"].as_array().unwrap();
    let given = &conditions[0];
    assert_eq!(given["condition"], "as given");
    let of = |condition: &Value, name: &str| -> Value {
        let methods = condition["methods"].as_array().unwrap().iter();
        let mut equal = methods.filter(|of| of["by_tolerance"] == false);
        equal.find(|of| of["method"] == name).unwrap().clone()
    };
    let limit = |of: &Value, which: &str| of[which].as_f64().unwrap();
    for name in [
        "exponential",
        "exponential-adams",
        "newmark-explicit",
        "splitting",
    ] {
        let method = of(given, name);
        let ratio = limit(&method, "measured_limit_s") / limit(&method, "predicted_limit_s");
        // all balls stay in contact: motions are small to the end; the bisection ends within half a percent, and runs of 600
        // steps do not see the slowest growth
        assert!((ratio - 1.0).abs() < 0.03, "{name}: {ratio}");
        // below the limit all steps of the grid are stable, beyond it none is
        for step in method["steps"].as_array().unwrap() {
            let below = limit(step, "step_s") < limit(&method, "measured_limit_s");
            assert_eq!(step["measured"] == "stable", below, "{name}: {step}");
            assert_eq!(step["predicted"] == "stable", below, "{name}: {step}");
        }
    }
    for name in ["newmark", "generalized-alpha"] {
        let method = of(given, name);
        assert!(method["predicted_limit_s"].is_null());
        assert!(method["steps"][0]["measured"] == "stable");
    }
    let at = |label: &str| conditions.iter().find(|of| of["label"] == label).unwrap();
    let exponential = |label: &str| limit(&of(at(label), "exponential"), "measured_limit_s");
    // Verlet's limit goes with the contacts' frequency, k^(1/3) F^(1/6) in equilibrium; preload fixes the overlap, and the
    // frequency goes with sqrt(k) there. Contact damping is taken out of it: what is left lies between
    let stiffer = exponential("contact stiffness × 0.1") / exponential("contact stiffness × 100");
    assert!((5.0..40.0).contains(&stiffer), "{stiffer}");
    let damped = exponential("contact damping 0 %") / exponential("contact damping 5 %");
    // velocity Verlet with the damping a step late: 1 / (1 + 2 zeta) or so of the undamped limit
    assert!((1.03..1.3).contains(&damped), "{damped}");
    assert!(read("stability.svg").contains("predicted limit"));
    assert!(read("resonance.svg").starts_with("<svg "));
    assert!(read("report.html").contains("Stability map"));
    fs::remove_dir_all(out).unwrap();
}
