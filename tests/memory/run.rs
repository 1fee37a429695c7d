//! Memory that stepping takes does not grow with the simulated time.
//!
//! Reference: the rows that leave the recorder as they are complete.
//! Goal: a run of hours takes what a run of seconds takes.
//! Sketch: the same scene is stepped for two lengths of time, its rows on disk, under an allocator that counts.
//! Conditions: one test at a time, so that nothing else allocates.
//! Parameters: four times the time; the rows of the longer run take 5 MB, and one more may be held.

use plummer::app::case::Case;
use plummer::app::commands::run::choice::ModelChoice;
use plummer::app::commands::run::unfinished::{RunIdentity, UnfinishedRun};
use plummer::app::commands::run::{Simulation, Span};
use plummer::app::scene::Scene;
use plummer::numerics::Unwatched;

use super::{alone, peak};

#[test]
fn stepping_four_times_as_long_takes_the_same_memory() {
    let _alone = alone();
    let root = env!("CARGO_MANIFEST_DIR");
    let path = format!("{root}/examples/scenes/smooth.toml");
    let set = ["transient.step=2.5e-6".to_owned(), "transient.method=newmark".to_owned()];
    let case = Case::load(&path, &set).unwrap();
    let run = case.for_run().unwrap();
    let scene = Scene::build(run, &Unwatched).unwrap();
    let model = ModelChoice::of_case(run, &scene).unwrap().model;
    let folder = tempfile::tempdir().unwrap();
    let taken = [0.02, 0.08].map(|duration| {
        let span = Span { duration, output_hz: run.transient.output_hz };
        let identity = RunIdentity::of(&case, "run").unwrap();
        let mut unfinished = UnfinishedRun::begin(&folder.path().join("partial"), identity);
        peak(|| {
            let run = Simulation::kept_from_rest(&scene, &model, span, false, &mut unfinished, |_| {});
            let rows = run.unwrap().record.rows();
            assert_eq!(rows, (duration * 400e3_f64).round() as usize + 1);
        })
    });
    println!("{taken:?} bytes");
    assert!(taken[1] < taken[0] + (1 << 18), "{taken:?}");
}
