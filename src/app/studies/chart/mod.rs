//! Speed against accuracy: methods, steps and sizes of the model on one scene, against a reference that is measured first.
//!
//! `compute_chart` goes through it: [`Starts`] over a ball pass; the [`Reference`] of two methods of different kind that
//! are refined until they agree; the [`Growth`] of small perturbations, and with it the horizon inside which signals can be
//! compared point by point; the [`Point`]s; the front of those that none beats; and beyond the horizon
//! statistics over an ensemble. `chart_report` shows it.
//!
//! Beside it `compute_stability` asks which steps each method can take at all, under which conditions.
//!
//! **Limitations.** Errors are those of the sensors' accelerations up to the band's highest frequency; what lies below its
//! lowest is not taken out. Statistics are those of the first sensor.

mod budget;
mod candidates;
mod compute;
mod plan;
mod plots;
mod points;
#[cfg(test)]
mod points_tests;
mod reference;
mod refining;
mod report;
mod scene;
mod stability;
mod starts;
mod statistics;
mod summary;
mod trace;

pub(crate) use budget::{Budget, Deadline, Stage};
pub use candidates::Parameter;
pub(crate) use candidates::model_name;
pub use compute::{Chart, ModelStatistics};
pub(crate) use compute::{News, compute_chart};
pub(crate) use plan::Plan;
pub(crate) use plots::work_precision;
pub use points::{GROWTHS, GrowthError, Point, PointError};
pub use reference::{Growth, Reference, StartReference};
pub(crate) use report::chart_report;
pub use scene::ChartScene;
pub use stability::{Condition, ConditionSummary, MethodStability, Stability, StabilityModel, StepRecord, Window};
pub(crate) use stability::{
    NO_TIME, compute_stability, resonance_plot, stability_map, stability_report, stability_section,
};
pub use starts::{Start, Starts};
pub use statistics::{ComparedFigure, Estimate, Figure};
pub use summary::{
    ChartResult, ChartSummary, EnsembleSummary, ErrorSummary, MethodParameter, OmissionSummary, OverAllStarts,
    PointSummary, ReferenceSummary, StartSummary, StatisticsSummary,
};
pub use trace::{Effort, Failure, FailureKind, Settings, Trace};
