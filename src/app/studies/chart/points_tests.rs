//! Candidates on a small scene: the same whatever the number of threads, and what fails is told.

use super::budget::{Budget, Deadline, Stage};
use super::points::{Comparison, Point};
use super::reference::models;
use super::refining::refine;
use super::scene::ChartScene;
use super::starts::Systems;
use super::{Effort, FailureKind, Reference, Settings, Starts};
use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::app::scene::RunModel;
use crate::numerics::Unwatched;
use crate::numerics::ode::Method;
use crate::system::{BallsInertia, ModeSelection};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// The smooth scene with a ring of 12 nodes, 0.5 ms from two starts.
fn small() -> (ChartScene, Settings) {
    let set = ["ring.nodes=12", "transient.end=0.5e-3", "transient.ensemble.runs=2"];
    let case = Case::example("scenes/smooth", &set);
    built(&case, Effort::Quick)
}

fn built(case: &Case, effort: Effort) -> (ChartScene, Settings) {
    let run = case.asked_run("`chart`").unwrap();
    let settings = Settings::of(case, run.transient(), effort).unwrap();
    (ChartScene::build(&run, &Unwatched).unwrap(), settings)
}

fn reference(scene: &ChartScene, starts: &Starts, settings: &Settings) -> Reference {
    let [by, _] = models(settings, 0);
    let systems = Systems::of_all(scene, [&by]);
    Reference::find(systems.of(&by).unwrap(), starts, settings, Deadline::NEVER, || ()).unwrap()
}

fn all_modes(method: Method, steps: &[f64]) -> Vec<RunModel> {
    let model = |step: &f64| RunModel {
        modes: ModeSelection::All,
        residual: false,
        balls_inertia: BallsInertia::Dynamic,
        method,
        step: *step,
    };
    steps.iter().map(model).collect()
}

#[test]
fn points_do_not_depend_on_the_number_of_threads_and_failures_say_why() {
    let (scene, settings) = small();
    let starts = Starts::over_ball_pass(&scene, &settings, settings.span_s).unwrap();
    assert!((starts.starts[1].time_s - 0.25e-3).abs() < 1e-12);
    let computed = |threads: usize| -> (Reference, Vec<Point>) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| {
            let reference = reference(&scene, &starts, &settings);
            let families = [
                all_modes(Method::ExponentialAdams { tolerance: None }, &[1.25e-6, 3e-7, 1.5e-7]),
                all_modes(Method::NewmarkExplicit, &[2e-6]),
                all_modes(Method::Exponential, &[-1.0, 1e-7]),
            ];
            let systems = Systems::of_all(&scene, families.iter().flatten());
            let on =
                Comparison { systems: &systems, reference: &reference, settings: &settings, until: Deadline::NEVER };
            let found = refine(&families, &[], on, |_| (), |_| ());
            assert_eq!((found.points.len(), found.unrefined.len()), (found.taken.len(), 0));
            (reference, found.points)
        })
    };
    let (reference, points) = computed(2);
    let (other, again) = computed(1);
    assert_eq!(points, again);
    assert_eq!(reference.disagreement.to_bits(), other.disagreement.to_bits());
    for (a, b) in reference.starts.iter().zip(&other.starts) {
        assert_eq!((&a.trace, &a.growth), (&b.trace, &b.growth));
    }
    // all balls in contact: nothing grows
    assert!((reference.least_horizon_s() - settings.span_s).abs() < 1e-9);
    let failure = |place: usize| points[place].error.as_ref().unwrap_err();
    assert_eq!(failure(0).kind, FailureKind::BlewUp);
    let reason = &failure(0).reason;
    assert!(reason.starts_with("the solution blew up at t = 0.0"), "{reason}");
    // of third order: halving the step leaves an eighth; a sixth with what the first one does not resolve
    let error = |place: usize| points[place].error.as_ref().unwrap().mean;
    assert!(error(2) < error(1) / 6.0, "{:e} {:e}", error(1), error(2));
    assert!(error(2) < 0.05, "{:e}", error(2));
    assert_eq!(failure(3).kind, FailureKind::Unstable);
    let reason = &failure(3).reason;
    assert!(reason.contains("beyond the stability limit"), "{reason}");
    // refused: nothing finer of that family is tried
    assert_eq!((failure(4).kind, points.len()), (FailureKind::Refused, 5));
}

#[test]
fn marked_points_take_every_start_and_others_some() {
    let set = ["ring.nodes=12", "transient.end=0.2e-3", "accuracy.band_hz=[0,160000]", "transient.ensemble.runs=9"];
    let case = Case::example("scenes/smooth", &set);
    let (scene, settings) = built(&case, Effort::Full);
    assert_eq!(settings.point_stride(), 2);
    let starts = Starts::over_ball_pass(&scene, &settings, settings.span_s).unwrap();
    let reference = reference(&scene, &starts, &settings);
    let family = all_modes(Method::Exponential, &[2e-7]);
    let systems = Systems::of_all(&scene, &family);
    let on = Comparison { systems: &systems, reference: &reference, settings: &settings, until: Deadline::NEVER };
    let (some, _) = on.point(&family[0]);
    let all = on.over_all_starts(&some.model).unwrap();
    // those of every second start, and the others
    let some = some.error.unwrap();
    assert!(all.largest >= some.largest && all.mean.to_bits() != some.mean.to_bits());
    let halves = [0, 1].map(|first| {
        let mut half = reference.clone();
        half.starts = half.starts.into_iter().skip(first).step_by(2).collect();
        Comparison { reference: &half, ..on }.over_all_starts(&family[0]).unwrap().mean
    });
    assert!((halves[0] / some.mean - 1.0).abs() < 1e-12);
    let together = (5.0 * halves[0] + 4.0 * halves[1]) / 9.0;
    assert!((all.mean / together - 1.0).abs() < 1e-12);
}

#[test]
fn what_there_is_no_time_for_is_left_out_and_said() {
    let (scene, settings) = small();
    let starts = Starts::over_ball_pass(&scene, &settings, settings.span_s).unwrap();
    let reference = reference(&scene, &starts, &settings);
    assert!(reference.starts.iter().all(|start| !start.cut_short));
    let families = [
        all_modes(Method::ExponentialAdams { tolerance: None }, &[3e-7, 1.5e-7]),
        all_modes(Method::Dop853 { tolerance: 1e-3, events: true }, &[3e-7]),
    ];
    let systems = Systems::of_all(&scene, families.iter().flatten());
    let on = Comparison { systems: &systems, reference: &reference, settings: &settings, until: Deadline::NEVER };
    let known = [on.point(&families[0][0])];
    let begun = Instant::now().checked_sub(Duration::from_secs(10)).unwrap();
    let over = Budget::new(begun, Some(Duration::from_secs(1)), true).until(Stage::Map);
    let told = AtomicUsize::new(0);
    let count = |_: &Point| {
        told.fetch_add(1, Ordering::Relaxed);
    };
    let found = refine(&families, &known, Comparison { until: over, ..on }, count, |_| ());
    // what is known stays; nothing is computed in no time
    assert_eq!((found.points, told.into_inner()), (vec![known[0].0.clone()], 0));
    assert_eq!(
        found.unrefined,
        [
            "dop853, all modes: without tolerances of 0.0010 and smaller",
            "exponential-adams, all modes: without steps of 0.150 µs and shorter",
        ]
    );
    let [by, _] = models(&settings, 0);
    let systems = Systems::of_all(&scene, [&by]);
    let cut = Reference::find(systems.of(&by).unwrap(), &starts, &settings, over, || ()).unwrap_err();
    assert!(matches!(cut, ComputeError::Interrupted { .. }), "{cut}");
}

#[test]
fn starts_of_a_run_up_lie_where_it_is_fastest() {
    let set = ["ring.nodes=12", "transient.ensemble.runs=2"];
    for (name, runs_up) in [("tadina2011/healthy", true), ("scenes/smooth", false)] {
        let case = Case::example(name, &set);
        let (scene, settings) = built(&case, Effort::Quick);
        let end = case.for_run().unwrap().transient.end;
        let Starts { starts, spread_s, .. } = Starts::over_ball_pass(&scene, &settings, end).unwrap();
        let cage = scene.cage();
        let begin = starts[0].time_s;
        let turned = cage.motion(begin + spread_s).angle - cage.motion(begin).angle;
        if runs_up {
            // a bisection to the last digits
            assert!((turned.abs() / cage.spacing - 1.0).abs() < 1e-9, "{name}: {turned}");
            let reach = end - (begin + spread_s);
            let longest = settings.span_s.max(settings.statistics_s) + settings.edge_s;
            assert!((reach - longest).abs() < 1e-12, "{reach}, {longest}");
        } else {
            assert!((begin - scene.start()).abs() < 1e-12, "{name}: {begin}");
        }
    }
}

/// Two methods that share nothing agree on a shaft in two bearings, and errors are measured by them as in the plane.
#[test]
fn a_shaft_in_space_is_charted_as_a_bearing_in_its_plane() {
    let set = [
        "bearings[0].ring.nodes=8",
        "bearings[1].ring.nodes=8",
        "bearings[0].bearing.preload={displacement=4e-6}",
        "bearings[1].bearing.preload={displacement=4e-6}",
        "bearings[0].bearing.defects=[]",
        "accuracy.band_hz=[0,20000]",
        "transient.end=1e-3",
        "analysis.envelope=[]",
        "transient.ensemble.runs=2",
    ];
    let (scene, settings) = built(&Case::example("machines/spindle", &set), Effort::Quick);
    let starts = Starts::over_ball_pass(&scene, &settings, settings.span_s).unwrap();
    assert!(starts.starts.iter().all(|start| start.equilibrium.is_none()) && starts.left_out.is_empty());
    let reference = reference(&scene, &starts, &settings);
    // what is wanted of a reference
    assert!(reference.disagreement < 0.01 * settings.target, "{}", reference.disagreement);
    assert!(!scene.is_damaged() && scene.next_strike(0.0).is_none());
    // no mode lies in the band: refused, by name
    for residual in [false, true] {
        let none = RunModel { modes: ModeSelection::UpTo(1.0), residual, ..all_modes(Method::Exponential, &[4e-7])[0] };
        let said = scene.ready(&none).err().unwrap().to_string();
        assert!(said.contains("modes"), "{said}");
    }
    let families = [all_modes(Method::Exponential, &[4e-7])];
    let systems = Systems::of_all(&scene, families.iter().flatten());
    let on = Comparison { systems: &systems, reference: &reference, settings: &settings, until: Deadline::NEVER };
    let found = refine(&families, &[], on, |_: &Point| (), |_| ());
    // a third method, of second order, from the same rest
    let error = found.points[0].error.as_ref().unwrap().mean;
    assert!(error < 0.1 * settings.target, "{error}");
}
