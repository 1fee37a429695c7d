//! The chart of a scene, from its case.

use super::candidates::families;
use super::points::{Comparison, Point, PointError};
use super::reference::models;
use super::starts::{Ready, Systems};
use super::statistics::{ComparedFigure, FigureSettings, compare, ensemble};
use super::{Effort, Failure, Reference, Settings, Start, Starts};
use crate::app::case::{self, Case, ModesKept, RunCase, StepLength};
use crate::app::commands::analyze::AskedBand;
use crate::app::commands::run::choice::ModelChoice;
use crate::app::error::ComputeError;
use crate::app::scene::{RunModel, Scene};
use crate::numerics::Watch;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Speed against accuracy of a scene.
#[derive(Debug)]
pub struct Chart {
    /// What was simulated.
    pub scene: Scene,
    /// What was compared.
    pub settings: Settings,
    /// Where the runs began.
    pub starts: Starts,
    /// What the errors are measured by.
    pub reference: Reference,
    /// Every candidate that was computed; those without an error are the omissions.
    pub points: Vec<Point>,
    /// Places of the points that none beats in cost and error, by cost; none that is below the floor.
    pub front: Vec<usize>,
    /// Place of the program's own choice.
    pub chosen: usize,
    /// Place of the source paper's method.
    pub source: usize,
    /// Errors of these two over every start, where points take some of them.
    pub over_all_starts: [Result<PointError, Failure>; 2],
    /// Statistics beyond the horizon.
    pub statistics: Vec<ModelStatistics>,
}

/// Statistics of a model against those of the reference.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[schemars(rename = "ModelStatisticsSummary")]
pub struct ModelStatistics {
    /// Index from 0 of its point.
    pub point: usize,
    /// The figures; `None` where there are none.
    pub figures: Option<Vec<ComparedFigure>>,
    /// Why there are none.
    pub reason: Option<String>,
}

impl Chart {
    /// Points without an error, and why.
    pub(crate) fn omissions(&self) -> impl Iterator<Item = (usize, &super::Failure)> {
        let points = self.points.iter().enumerate();
        points.filter_map(|(place, point)| Some((place, point.error.as_ref().err()?)))
    }

    /// Whether a point's error is below what the reference can tell.
    pub(crate) fn below_floor(&self, point: &Point) -> bool {
        let error = point.error.as_ref();
        error.is_ok_and(|error| error.mean < self.reference.disagreement)
    }
}

/// Computes the chart of a case.
///
/// # Errors
/// [`ComputeError`]; a candidate that fails is no error but an omission.
pub(crate) fn compute_chart(
    run: RunCase<'_>,
    effort: Effort,
    watch: &(impl Watch + Sync),
) -> Result<Chart, ComputeError> {
    let RunCase { case, transient: asked, .. } = run;
    let scene = Scene::with_all_modes(run, watch)?;
    let settings = Settings::of(run, effort)?;
    watch.stage("starts");
    let starts = Starts::over_ball_pass(&scene, &settings, asked.end - asked.start)?;
    watch.stage("reference");
    let progress = Counter::new(watch, starts.starts.len());
    let reference = Reference::find(&scene, &starts, &settings, || progress.done())?;
    let chosen = |transient: &case::Transient| -> Result<RunModel, ComputeError> {
        let run = RunCase { transient, ..run };
        Ok(ModelChoice::of_case(run, &scene)?.model)
    };
    // as it is used there: all displacements, its own step
    let source = case::Transient { residual: false, ..automatic(asked, case::Method::NewmarkExplicit) };
    let wanted = [chosen(&automatic(asked, case::Method::Auto))?, chosen(&source)?];
    watch.stage("points");
    let comparison = Comparison { scene: &scene, reference: &reference, settings: &settings };
    let (mut points, places) = candidates(comparison, wanted, watch);
    let [chosen, source] = places;
    watch.stage("time");
    if let Some(first) = reference.starts.first() {
        comparison.measure(&mut points, first, |part| watch.fraction(part));
    }
    let front = front(&points, reference.disagreement);
    watch.stage("all starts");
    let over_all_starts = [chosen, source].map(|place| {
        let Point { model, error, .. } = &points[place];
        match error {
            Ok(_) if settings.point_stride() > 1 => comparison.over_all_starts(model),
            known => known.clone(),
        }
    });
    watch.stage("statistics");
    let statistics = statistics(case, comparison, places.map(|place| (place, &points[place])), watch);
    Ok(Chart { scene, settings, starts, reference, points, front, chosen, source, over_all_starts, statistics })
}

/// What a case asks for with everything left to the program but the method.
pub(super) fn automatic(asked: &case::Transient, method: case::Method) -> case::Transient {
    case::Transient {
        method,
        step: StepLength::Auto,
        modes: ModesKept::Auto,
        residual: true,
        tolerance: None,
        spectral_radius: None,
        ..asked.clone()
    }
}

/// All points, and the places of the two that must be there.
fn candidates(on: Comparison<'_>, wanted: [RunModel; 2], watch: &(impl Watch + Sync)) -> (Vec<Point>, [usize; 2]) {
    let modes = &on.scene.stage.modes;
    let frequencies_hz: Vec<f64> = (0..modes.count()).map(|mode| modes.frequency_hz(mode)).collect();
    let families = families(on.settings, &frequencies_hz, &wanted);
    let progress = Counter::new(watch, families.len());
    let found: Vec<Vec<Point>> = families
        .par_iter()
        .map(|family| {
            let points = on.evaluate(family);
            progress.done();
            points
        })
        .collect();
    let mut points = found.concat();
    let mut systems = Systems::new(on.scene);
    let places = wanted.map(|model| {
        let known = points.iter().position(|point| point.model == model);
        known.unwrap_or_else(|| {
            points.push(on.point(systems.of(&model), &model));
            points.len() - 1
        })
    });
    (points, places)
}

/// Places of the points that none beats, without what lies below the floor.
fn front(points: &[Point], floor: f64) -> Vec<usize> {
    let measured = points.iter().enumerate();
    let measured: Vec<(usize, (f64, f64))> = measured
        .filter_map(|(place, point)| Some((place, point.measured()?)))
        .filter(|(_, (_, error))| *error >= floor)
        .collect();
    let values: Vec<(f64, f64)> = measured.iter().map(|(_, value)| *value).collect();
    let places = pareto_front(&values).into_iter();
    places.map(|place| measured[place].0).collect()
}

/// Places of the points (cost, error) that none other beats: no other costs at most as much and errs at most as much, one
/// of the two less. In order of cost; of equal points the first.
fn pareto_front(points: &[(f64, f64)]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    let key = |place: usize| points[place];
    order.sort_by(|&a, &b| {
        let ((cost_a, error_a), (cost_b, error_b)) = (key(a), key(b));
        cost_a.total_cmp(&cost_b).then(error_a.total_cmp(&error_b))
    });
    let mut least = f64::INFINITY;
    order.retain(|&place| {
        let beaten = key(place).1 >= least;
        least = least.min(key(place).1);
        !beaten
    });
    order
}

/// Statistics of points against the reference's second method, which is the cheaper one, with its first step.
fn statistics(
    case: &Case,
    Comparison { scene, reference, settings }: Comparison<'_>,
    points: [(usize, &Point); 2],
    watch: &(impl Watch + Sync),
) -> Vec<ModelStatistics> {
    let starts: Vec<Start> = reference.starts.iter().map(|s| s.start.clone()).collect();
    let analysis = FigureSettings {
        band_hz: [case.band_hz().map_or(0.0, |band| band[0]), settings.band_hz],
        high_pass_hz: AskedBand::of(case).map(|band| band.corner_hz(settings.output_hz)),
    };
    let progress = Counter::new(watch, 3 * starts.len());
    let run = |system: &Ready, model: &RunModel| {
        let done = || progress.done();
        ensemble(system, &starts, model, settings, &analysis, done)
    };
    let [_, beside] = models(settings, 0);
    let measured_by = Ready::of(scene, &beside).map_err(Failure::from).and_then(|system| run(&system, &beside));
    let mut systems = Systems::new(scene);
    let mut own = |point: &Point| -> Result<Vec<ComparedFigure>, Failure> {
        let by = measured_by.as_ref().map_err(Clone::clone)?;
        if let Err(failure) = &point.error {
            return Err(failure.clone());
        }
        let model = &point.model;
        Ok(compare(&run(systems.of(model)?, model)?, by, settings.target))
    };
    let statistics = points.map(|(point, of)| {
        let (figures, reason) = own(of).map_or_else(|failure| (None, Some(failure.reason)), |all| (Some(all), None));
        ModelStatistics { point, figures, reason }
    });
    statistics.to_vec()
}

/// Tells a watch how many of the parts are done.
pub(super) struct Counter<'a, W> {
    watch: &'a W,
    count: usize,
    done: AtomicUsize,
}

impl<'a, W: Watch> Counter<'a, W> {
    pub(super) fn new(watch: &'a W, count: usize) -> Self {
        Self { watch, count: count.max(1), done: AtomicUsize::new(0) }
    }

    pub(super) fn done(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        self.watch.fraction(done as f64 / self.count as f64);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_none_beats_is_on_the_front() {
        let points = [
            (4.0, 1e-4),
            (1.0, 1e-1),
            (2.0, 1e-2),
            // dearer and worse than the second
            (3.0, 2e-2),
            // as dear as the second and worse
            (2.0, 5e-2),
            // dearer and as good as the first
            (5.0, 1e-4),
            // as the first
            (4.0, 1e-4),
        ];
        assert_eq!(pareto_front(&points), [1, 2, 0]);
    }

    #[test]
    fn nothing_and_one() {
        assert!(pareto_front(&[]).is_empty());
        assert_eq!(pareto_front(&[(1.0, 1.0)]), [0]);
    }
}
