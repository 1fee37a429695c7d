//! The chart of a scene, from its case.

use super::budget::{Budget, Stage};
use super::candidates::families;
use super::plan::{Costs, Plan};
use super::points::{Comparison, Point, PointError, TIMED};
use super::reference::models;
use super::refining::{Found, refine};
use super::scene::{ChartScene, Ready};
use super::starts::Systems;
use super::statistics::{ComparedFigure, FigureSettings, compare, ensemble};
use super::{Effort, Failure, FailureKind, Reference, Settings, Start, StartReference, Starts};
use crate::app::case::{self, AskedRun, Case, ModesKept, StepLength};
use crate::app::commands::analyze::AskedBand;
use crate::app::error::ComputeError;
use crate::app::scene::RunModel;
use crate::numerics::Watch;
use crate::report::{counted, duration, significant};
use schemars::JsonSchema;
use serde::Serialize;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Speed against accuracy of a scene.
#[derive(Debug)]
pub struct Chart {
    /// The time that it was given, s; `None` for as long as it takes.
    pub budget_s: Option<f64>,
    /// What there was no time for, a few words each.
    pub left_out: Vec<String>,
    /// Methods and models that there was no time to refine, each with what it lacks.
    pub unrefined: Vec<String>,
    /// What was simulated.
    pub scene: ChartScene,
    /// Starts in which a ball strikes the first defect of a race within the horizon; `None` without such a defect.
    pub struck: Option<usize>,
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
    /// What there was no time for, in a sentence; `None` where nothing was left out.
    pub(crate) fn without(&self) -> Option<String> {
        cut_short(self.budget_s?, &self.left_out, self.unrefined.len())
    }

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

/// That a budget (s) cut a chart short, in one sentence: what a page lists by itself is counted.
fn cut_short(budget_s: f64, left_out: &[String], unrefined: usize) -> Option<String> {
    let unrefined = (unrefined > 0).then(|| {
        let count = counted(unrefined, "combination");
        format!("{count} of method and model not refined to the end, see Omissions and left_out in chart.json")
    });
    let list: Vec<String> = left_out.iter().cloned().chain(unrefined).collect();
    let budget = duration(budget_s);
    (!list.is_empty()).then(|| format!("The budget of {budget} cut the chart short: {}.", list.join("; ")))
}

/// What a chart tells while it is computed.
#[derive(Debug, Clone, Copy)]
pub(crate) enum News<'a> {
    /// What it is going to take.
    Plan(Plan),
    /// A point, whose cost is not measured yet, and the error below which the reference tells nothing.
    Point(&'a Point, f64),
}

/// Computes the chart of a case within a budget; `told` hears of each point as it comes.
///
/// # Errors
/// [`ComputeError`], also where not even the reference fits into the budget; a candidate that fails is no error but an omission.
pub(crate) fn compute_chart(
    run: &AskedRun<'_>,
    effort: Effort,
    budget: Budget,
    told: &(dyn Fn(News<'_>) + Sync),
    watch: &impl Watch,
) -> Result<Chart, ComputeError> {
    let (case, asked) = (run.case(), run.transient());
    let whole = budget;
    let scene = ChartScene::build(run, watch)?;
    let asked_settings = Settings::of(case, asked, effort)?;
    watch.stage("choice");
    // as it is used there: all displacements, its own step
    let source = case::Transient { residual: false, ..automatic(asked, case::Method::NewmarkExplicit) };
    let wanted = [scene.choice(case, &automatic(asked, case::Method::Auto))?, scene.choice(case, &source)?];
    let budget = whole.after_scene()?;
    watch.stage("pilots");
    let modes = &scene.stage().modes;
    let frequencies_hz: Vec<f64> = (0..modes.count()).map(|mode| modes.frequency_hz(mode)).collect();
    let families = families(&asked_settings, &frequencies_hz, &wanted);
    let of_reference = models(&asked_settings, 0);
    let systems = Systems::of_all(&scene, of_reference.iter().chain(&wanted).chain(families.iter().flatten()));
    let at_rest = Start { number: 0, time_s: scene.start(), equilibrium: None };
    let until = budget.until(Stage::Reference(0));
    let costs = Costs::measured(&systems, &at_rest, &wanted[0], &asked_settings, until);
    let costs = costs.map_err(|failure| no_pilot(&failure, whole))?;
    let threads = rayon::current_num_threads();
    let mut settings = match budget.seconds() {
        None => asked_settings,
        Some(_) => asked_settings.fitted(costs.of_reference(), until.left_s() * threads as f64),
    };
    let mut plan = costs.plan(&families, &frequencies_hz, &wanted, &settings, threads);
    plan.seconds = plan.seconds.min(budget.seconds().unwrap_or(f64::INFINITY));
    told(News::Plan(plan));
    watch.stage("starts");
    let starts = Starts::over_ball_pass(&scene, &settings, asked.end)?;
    watch.stage("reference");
    let system = systems.of(&of_reference[0]).map_err(|failure| no_pilot(&failure, whole))?;
    let mut attempt = 0;
    let reference = loop {
        let progress = Counter::new(watch, starts.starts.len());
        // where the span is the shortest, this attempt is the last and has the time of all
        let shorter = settings.shorter().filter(|_| attempt + 1 < budget.attempts());
        let until = budget.until(Stage::Reference(if shorter.is_some() { attempt } else { usize::MAX }));
        attempt += 1;
        match Reference::find(system, &starts, &settings, until, || progress.done()) {
            Err(ComputeError::Interrupted { .. }) => match shorter {
                Some(shorter) => settings = shorter.shorter().unwrap_or(shorter),
                None => return Err(no_time(whole)),
            },
            found => break found?,
        }
    };
    let mut left_out = shortened(&asked_settings, &settings, &reference);
    watch.stage("points");
    let on = |stage| Comparison {
        systems: &systems,
        reference: &reference,
        settings: &settings,
        until: budget.until(stage),
    };
    let (found, [chosen, source]) = candidates(on(Stage::Points), &families, wanted, told, watch);
    let Found { mut points, taken, unrefined } = found;
    watch.stage("time");
    if let Some(first) = reference.starts.first() {
        let run_s = on(Stage::Times).measure(&mut points, &taken, first, |part| watch.fraction(part));
        left_out.extend(untimed(&points, run_s, &settings));
    }
    let front = front(&points, reference.disagreement);
    watch.stage("all starts");
    let over_all_starts = [chosen, source].map(|place| {
        let Point { model, error, .. } = &points[place];
        match error {
            Ok(_) if settings.point_stride() > 1 => on(Stage::Statistics).over_all_starts(model),
            known => known.clone(),
        }
    });
    watch.stage("statistics");
    let comparison = on(Stage::Statistics);
    let second = costs.reference[1] + [chosen, source].iter().filter_map(|&place| points[place].wall_s).sum::<f64>();
    let fits = comparison.until.left_s() * threads as f64 / (second * reference.starts.len() as f64);
    // what is a little too long is tried
    let statistics_s = settings.statistics_s.min((fits - settings.edge_s).max(settings.span_s));
    let asked_s = asked_settings.statistics_s;
    let shorter = Settings { statistics_s, ..settings };
    let comparison = Comparison { settings: &shorter, ..comparison };
    let statistics = statistics(case, comparison, [chosen, source].map(|place| (place, &points[place])), watch);
    if statistics.iter().any(|of| of.reason == Some(Failure::out_of_time().reason)) {
        left_out.push("no statistics".to_owned());
    } else if statistics_s < asked_s {
        left_out.push(format!("statistics over {} instead of {}", ms(statistics_s), ms(asked_s)));
    }
    let settings = shorter;
    let struck = struck(&scene, &reference);
    let mut scene = scene;
    if struck == Some(0) {
        scene.doubt(format!(
            "in none of the {} starts does a ball strike the defect within its horizon: the errors say nothing about impacts; more of transient.ensemble.runs, or another transient.start, has some",
            reference.starts.len()
        ));
    }
    Ok(Chart {
        budget_s: whole.seconds(),
        left_out,
        unrefined,
        scene,
        struck,
        settings,
        starts,
        reference,
        points,
        front,
        chosen,
        source,
        over_all_starts,
        statistics,
    })
}

fn struck(scene: &ChartScene, reference: &Reference) -> Option<usize> {
    let strikes = |of: &&StartReference| scene.next_strike(of.start.time_s).is_some_and(|next| next < of.horizon_s);
    scene.is_damaged().then(|| reference.starts.iter().filter(strikes).count())
}

fn ms(seconds: f64) -> String {
    format!("{} ms", significant(1e3 * seconds, 3))
}

/// What a budget took from the starts, the span and the reference.
fn shortened(asked: &Settings, settings: &Settings, reference: &Reference) -> Vec<String> {
    let mut left_out = Vec::new();
    let starts = reference.starts.len();
    if settings.ensemble.runs < asked.ensemble.runs || starts < settings.ensemble.runs {
        left_out.push(format!("{starts} starts instead of {}", asked.ensemble.runs));
    }
    if settings.span_s < asked.span_s {
        left_out.push(format!("a span of {} instead of {}", ms(settings.span_s), ms(asked.span_s)));
    }
    let cut = reference.starts.iter().filter(|start| start.cut_short).count();
    if cut > 0 {
        left_out.push(format!("the reference of {cut} starts not refined as far as is wanted"));
    }
    left_out
}

/// What a budget took from the wall times, by runs of `run_s` (s).
fn untimed(points: &[Point], run_s: f64, settings: &Settings) -> Vec<String> {
    let mut left_out = Vec::new();
    let whole = TIMED.min(settings.span_s);
    if run_s < whole {
        left_out.push(format!("wall times by runs of {} instead of {}", ms(run_s), ms(whole)));
    }
    let without = points.iter().filter(|point| point.error.is_ok() && point.wall_s.is_none()).count();
    if without > 0 {
        left_out.push(format!("{without} points without a wall time"));
    }
    left_out
}

/// The error of a budget in which not even the reference fits.
fn no_time(budget: Budget) -> ComputeError {
    let words = duration(budget.seconds().unwrap_or(0.0));
    ComputeError::failed(
        format!("the reference did not fit into the budget of {words}, not even of the shortest span from two starts"),
        "a longer --budget; a lower accuracy.band_hz or a smaller ring makes its steps cheaper",
    )
}

/// The error of a reference that cannot be computed at all.
fn no_pilot(failure: &Failure, budget: Budget) -> ComputeError {
    match failure.kind {
        FailureKind::OutOfTime => no_time(budget),
        _ => ComputeError::failed(
            format!("the reference failed: {}", failure.reason),
            "`plummer run` with transient.modes = \"all\" shows what happens there; another transient.start begins elsewhere",
        ),
    }
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

/// All points, and the places of the two that must be there, which come first.
fn candidates(
    on: Comparison<'_>,
    families: &[Vec<RunModel>],
    wanted: [RunModel; 2],
    told: &(dyn Fn(News<'_>) + Sync),
    watch: &impl Watch,
) -> (Found, [usize; 2]) {
    let told = |point: &Point| told(News::Point(point, on.reference.disagreement));
    let known = wanted.map(|model| {
        let known = on.point(&model);
        told(&known.0);
        known
    });
    let done = |ended: usize| watch.fraction(ended as f64 / families.len().max(1) as f64);
    let mut found = refine(families, &known, on, told, done);
    let places = known.map(|(point, taken)| {
        let there = found.points.iter().position(|other| other.model == point.model);
        there.unwrap_or_else(|| {
            found.points.push(point);
            found.taken.push(taken);
            found.points.len() - 1
        })
    });
    (found, places)
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
    Comparison { systems, reference, settings, until }: Comparison<'_>,
    points: [(usize, &Point); 2],
    watch: &impl Watch,
) -> Vec<ModelStatistics> {
    let starts: Vec<Start> = reference.starts.iter().map(|s| s.start.clone()).collect();
    let analysis = FigureSettings {
        band_hz: [case.band_hz().map_or(0.0, |band| band[0]), settings.band_hz],
        high_pass_hz: AskedBand::of(case).map(|band| band.corner_hz(settings.output_hz)),
    };
    let progress = Counter::new(watch, 3 * starts.len());
    let run = |system: &Ready, model: &RunModel| {
        let done = || progress.done();
        ensemble(system, &starts, model, settings, &analysis, until, done)
    };
    let [_, beside] = models(settings, 0);
    let measured_by = systems.of(&beside).and_then(|system| run(system, &beside));
    let own = |point: &Point| -> Result<Vec<ComparedFigure>, Failure> {
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
    fn what_was_cut_is_one_sentence_however_much_it_is() {
        assert_eq!(super::cut_short(45.0, &[], 0), None);
        let said = super::cut_short(45.0, &["3 starts instead of 6".to_owned()], 20).unwrap();
        let begin = "The budget of 45 s cut the chart short: 3 starts instead of 6; 20 combinations of method and model not refined";
        assert!(said.starts_with(begin) && said.len() < 250, "{said}");
    }

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
