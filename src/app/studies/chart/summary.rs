//! What `chart.json` says.

use super::{
    Chart, Failure, GrowthError, ModelStatistics, Parameter, Point, PointError, Stability, StartReference, model_name,
};
use crate::app::case::Case;
use crate::app::commands::result::CaseResult;
use schemars::JsonSchema;
use serde::Serialize;

/// A chart as the program prints it.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct ChartResult<'a> {
    /// `chart.json`.
    #[serde(flatten)]
    pub chart: CaseResult<'a, ChartSummary<'a>>,
    /// `stability.json`, where the map was computed too; not in `chart.json`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stability: Option<CaseResult<'a, &'a Stability>>,
}

/// Speed against accuracy.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct ChartSummary<'a> {
    /// Title of the case.
    pub scene: &'a str,
    /// What of the case may be meant otherwise, a sentence each.
    pub warnings: &'a [String],
    /// Band, Hz.
    pub band_hz: Option<[f64; 2]>,
    /// Relative error that is good enough.
    pub target: f64,
    /// The time that the chart was given, s; `None` for as long as it takes.
    pub budget_s: Option<f64>,
    /// What there was no time for, a few words each.
    pub left_out: Vec<&'a String>,
    /// Longest span compared point by point, s.
    pub span_s: f64,
    /// Where the runs began.
    pub ensemble: EnsembleSummary<'a>,
    /// What the errors are measured by.
    pub reference: ReferenceSummary<'a>,
    /// Time over which nearby solutions stay together, mean over the starts, s.
    pub horizon_s: f64,
    /// The shortest of the starts', s.
    pub least_horizon_s: f64,
    /// Growth rate of the distance of nearby solutions, 1/s; `None` where none was found.
    pub growth_rate_per_s: Option<f64>,
    /// Every candidate that was computed.
    pub points: Vec<PointSummary<'a>>,
    /// Indices from 0 of the points that none beats in cost and error, by cost.
    pub front: &'a [usize],
    /// Points without an error.
    pub omissions: Vec<OmissionSummary<'a>>,
    /// Index of the program's own choice.
    pub chosen: usize,
    /// Index of the source paper's method.
    pub source: usize,
    /// Errors of these two over every start.
    pub over_all_starts: OverAllStarts<'a>,
    /// Statistics beyond the horizon.
    pub statistics: StatisticsSummary<'a>,
}

/// The starts of a chart.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct EnsembleSummary<'a> {
    /// When, s.
    pub starts_s: Vec<f64>,
    /// Time over which they are spread, s.
    pub spread_s: f64,
    /// Those in which a ball strikes the first defect of a race within the horizon; `None` without such a defect.
    pub struck: Option<usize>,
    /// Relative perturbation of a start.
    pub perturbation: f64,
    /// Seed of the perturbations.
    pub seed: u64,
    /// Starts without an equilibrium, and why.
    pub left_out: &'a [String],
}

/// The reference of a chart.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct ReferenceSummary<'a> {
    /// The method measured by and the one beside it, as the last refined start has them.
    pub methods: [MethodParameter; 2],
    /// The model in words.
    pub model: &'static str,
    /// Number of its modes.
    pub modes: usize,
    /// Mean relative difference of the two methods: the floor of the chart.
    pub disagreement: f64,
    /// Whether it is well below the target.
    pub agreed: bool,
    /// Of every start.
    pub starts: Vec<StartSummary<'a>>,
}

/// A method and what it was refined to.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct MethodParameter {
    /// The method.
    pub method: &'static str,
    /// Its step or tolerance.
    #[serde(flatten)]
    pub parameter: Parameter,
}

/// The reference from one start.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct StartSummary<'a> {
    /// When, s.
    pub start_s: f64,
    /// Time over which nearby solutions stay together, s.
    pub horizon_s: f64,
    /// Relative difference of the two methods over it.
    pub disagreement: f64,
    /// Refinements that it took.
    pub refinements: usize,
    /// Whether the budget ended before the methods agreed as far as is wanted.
    pub cut_short: bool,
    /// Growth rate of the distance of a perturbed solution, 1/s; `None` where none was found.
    pub growth_rate_per_s: Option<f64>,
    /// Times of the following distances, s.
    pub time_s: Vec<f64>,
    /// Relative distance of the perturbed solution.
    pub perturbed: &'a [f64],
    /// Relative distance of the two methods.
    pub methods: &'a [f64],
}

/// A candidate and what came of it.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct PointSummary<'a> {
    /// The method.
    pub method: &'static str,
    /// The model in words.
    pub model: String,
    /// Its step or tolerance.
    pub parameter: Parameter,
    /// Wall time a simulated second, s; `None` where it was not measured.
    pub wall_s: Option<f64>,
    /// Whether the error is below what the reference can tell.
    pub below_floor: bool,
    /// Its error.
    #[serde(flatten)]
    pub error: ErrorSummary<'a>,
}

/// Relative differences from the reference over the horizons, or why there are none.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct ErrorSummary<'a> {
    /// Mean over the starts.
    pub error: Option<f64>,
    /// Standard deviation over the starts.
    pub deviation: Option<f64>,
    /// Largest of the starts.
    pub largest_error: Option<f64>,
    /// While nearby solutions have parted by less than over the horizon.
    pub by_growth: Option<&'a [GrowthError]>,
    /// Whether there is an error to speak of.
    pub ok: bool,
    /// Why not.
    pub reason: Option<&'a str>,
}

/// A point without an error.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct OmissionSummary<'a> {
    /// Its index from 0.
    pub point: usize,
    /// The method.
    pub method: &'static str,
    /// The model in words.
    pub model: String,
    /// Its step or tolerance.
    pub parameter: Parameter,
    /// "refused", "unstable", "blew up", "too inaccurate" or "out of time".
    pub kind: &'static str,
    /// What happened.
    pub reason: &'a str,
}

/// Errors over every start.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct OverAllStarts<'a> {
    /// Of the program's own choice.
    pub chosen: ErrorSummary<'a>,
    /// Of the source paper's method.
    pub source: ErrorSummary<'a>,
}

/// Statistics beyond the horizon.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct StatisticsSummary<'a> {
    /// Length of the runs, s.
    pub seconds: f64,
    /// By model.
    pub models: &'a [ModelStatistics],
}

impl Chart {
    /// What `chart.json` says of it; `case` is the case that it was computed of.
    pub(crate) fn summary<'a>(&'a self, case: &'a Case) -> ChartSummary<'a> {
        let (reference, settings) = (&self.reference, &self.settings);
        let starts = reference.starts.iter();
        let [chosen, source] = &self.over_all_starts;
        let point = |point: &'a Point| PointSummary {
            method: point.model.method.name(),
            model: model_name(&point.model),
            parameter: Parameter::of(&point.model),
            wall_s: point.wall_s,
            below_floor: self.below_floor(point),
            error: ErrorSummary::of(&point.error),
        };
        ChartSummary {
            scene: &case.title,
            warnings: self.scene.doubts(),
            band_hz: case.band_hz(),
            target: settings.target,
            budget_s: self.budget_s,
            left_out: self.left_out.iter().chain(&self.unrefined).collect(),
            span_s: settings.span_s,
            ensemble: EnsembleSummary {
                starts_s: starts.clone().map(|of| of.start.time_s).collect(),
                spread_s: self.starts.spread_s,
                struck: self.struck,
                perturbation: settings.ensemble.perturbation,
                seed: settings.ensemble.seed,
                left_out: &self.starts.left_out,
            },
            reference: ReferenceSummary {
                methods: reference
                    .models
                    .map(|model| MethodParameter { method: model.method.name(), parameter: Parameter::of(&model) }),
                model: "all modes, balls with inertia",
                modes: self.scene.stage().modes.count(),
                disagreement: reference.disagreement,
                agreed: reference.agreed,
                starts: starts.map(StartSummary::of).collect(),
            },
            horizon_s: reference.mean_horizon_s(),
            least_horizon_s: reference.least_horizon_s(),
            growth_rate_per_s: reference.growth_rate_per_s(),
            points: self.points.iter().map(point).collect(),
            front: &self.front,
            omissions: self
                .omissions()
                .map(|(point, failure)| OmissionSummary {
                    point,
                    method: self.points[point].model.method.name(),
                    model: model_name(&self.points[point].model),
                    parameter: Parameter::of(&self.points[point].model),
                    kind: failure.kind.name(),
                    reason: &failure.reason,
                })
                .collect(),
            chosen: self.chosen,
            source: self.source,
            over_all_starts: OverAllStarts { chosen: ErrorSummary::of(chosen), source: ErrorSummary::of(source) },
            statistics: StatisticsSummary { seconds: settings.statistics_s, models: &self.statistics },
        }
    }
}

impl<'a> StartSummary<'a> {
    fn of(start: &'a StartReference) -> Self {
        Self {
            start_s: start.start.time_s,
            horizon_s: start.horizon_s,
            disagreement: start.disagreement,
            refinements: start.refinements,
            cut_short: start.cut_short,
            growth_rate_per_s: start.growth.rate_per_s(),
            time_s: start.growth.times_s(),
            perturbed: &start.growth.distances,
            methods: &start.between.distances,
        }
    }
}

impl<'a> ErrorSummary<'a> {
    fn of(error: &'a Result<PointError, Failure>) -> Self {
        let (error, failure) = (error.as_ref().ok(), error.as_ref().err());
        Self {
            error: error.map(|error| error.mean),
            deviation: error.map(|error| error.deviation),
            largest_error: error.map(|error| error.largest),
            by_growth: error.map(|error| error.by_growth.as_slice()),
            ok: failure.is_none(),
            reason: failure.map(|failure| failure.reason.as_str()),
        }
    }
}
