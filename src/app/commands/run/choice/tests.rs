//! What a run's estimate looks at beyond the state that it begins in.

use super::model_choice::{CONDENSATION, ModelChoice};
use crate::app::case::Case;
use crate::app::scene::Scene;
use crate::numerics::Unwatched;

fn choice(example: &str, set: &[&str]) -> ModelChoice {
    let case = Case::example(example, set);
    let run = case.for_run().unwrap();
    let scene = Scene::build(run, &Unwatched).unwrap();
    ModelChoice::of_case(run, &scene).unwrap()
}

fn part(choice: &ModelChoice, what: &str) -> f64 {
    let mut parts = choice.parts.iter();
    let part = parts.find(|part| part.what == what).unwrap();
    part.estimated_error.unwrap()
}

/// The run errs by 5 to 6 % after 2 ms, when balls leave the race.
#[test]
fn a_load_that_comes_later_is_looked_at() {
    let loads = "shaft.loads=[{profile=[{time=0,force=[0,0]},{time=0.002,force=[0,0]},{time=0.003,force=[30,-50]}]}]";
    let (plain, late) = (choice("scenes/smooth", &[]), choice("scenes/smooth", &[loads]));
    assert!(plain.estimated_error.unwrap() < 0.01);
    let found = late.estimated_error.unwrap();
    println!("{found}");
    assert!(found > 0.03, "{found}");
    assert!(late.growth > plain.growth);
}

/// Every third one; the sentence is not there where all are looked at.
#[test]
fn the_estimate_of_modes_looks_at_few_of_many_sensors_and_says_so() {
    let why = |sensors: usize| {
        let sensor = |at| format!("{{name='P{at}',ring_deg={at},direction=[0,1,0]}}");
        let all: Vec<String> = (0..sensors).map(sensor).collect();
        let set = format!("sensors=[{}]", all.join(","));
        choice("scenes/smooth", &[&set]).parts[0].why.clone()
    };
    let few = why(130);
    assert!(few.ends_with("; estimated at 44 of the 130 sensors"), "{few}");
    assert!(!why(2).contains("estimated at"));
}

/// With a preload; the vectors of the second one are complete up to twice the band.
#[test]
fn a_condensed_housing_is_part_of_the_estimate() {
    let start = "bearing.first_ball_deg=270";
    let preload =
        ["bearing.radial_play=-2e-6", "bearing.defects=[]", "transient.end=0.008", "analysis.envelope=[]", start];
    let auto = choice("housings/pillow_block", &preload);
    let few = [&preload[..], &["condense.fixed_interface_modes=8"]].concat();
    let few = choice("housings/pillow_block", &few);
    let [auto, few] = [auto, few].map(|choice| part(&choice, CONDENSATION));
    println!("{auto} {few}");
    // half of the target by the choice of the vectors
    assert!((4e-3..5.5e-3).contains(&auto), "{auto}");
    assert!(few > 0.1, "{few}");
}

/// Beside a smaller tolerance the dented ring errs by little, beside more modes by more.
#[test]
fn what_makes_the_measured_error_is_named() {
    let choice = choice("scenes/impact", &[]);
    let [modes, method] = ["modes", "method"].map(|what| part(&choice, what));
    println!("{modes} {method}");
    assert!(modes > method, "{modes} {method}");
    assert!(choice.warnings()[0].contains("most of it of the modes"), "{:?}", choice.warnings());
    // the parts that share the measured error make it up
    let found = choice.growth * choice.measured.unwrap().error;
    assert!(modes.hypot(method) >= found, "{modes} {method} {found}");
}
