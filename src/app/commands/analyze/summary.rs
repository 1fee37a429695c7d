//! What `analysis.json` says beside its windows.

use super::WindowAnalysis;
use crate::app::commands::result::ResultHead;
use crate::signal::diagnosis::{Fault, FaultOrders};
use schemars::JsonSchema;
use serde::Serialize;

/// One input, analysed.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct AnalysisResult<'a> {
    /// What all results have.
    #[serde(flatten)]
    pub head: ResultHead,
    /// The input with its orders.
    #[serde(flatten)]
    pub input: InputSummary,
    /// SHA-256 of the options and of the content of the files, 64 hexadecimal digits.
    pub asked_digest: String,
    /// Its windows.
    pub windows: Vec<&'a WindowAnalysis>,
}

/// Several inputs, analysed into one result.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct SurveyResult<'a> {
    /// What all results have.
    #[serde(flatten)]
    pub head: ResultHead,
    /// Inputs that could be read, with their orders.
    pub inputs: Vec<InputSummary>,
    /// SHA-256 of the options and of the content of the files, 64 hexadecimal digits.
    pub asked_digest: String,
    /// What could not be analysed.
    pub failures: Vec<FailureSummary>,
    /// Windows of all of them.
    pub windows: Vec<WindowOfInput<'a>>,
}

/// An analysed file or folder.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct InputSummary {
    /// The file or folder.
    pub input: String,
    /// The case that bearing and speed are from, if they are.
    pub case: Option<String>,
    /// Orders of the bearing's faults in the first window; `None` where no signal was analysed.
    pub defect_orders: Option<OrdersSummary>,
}

/// An input, or a channel of it, that was not analysed.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct FailureSummary {
    /// The file or folder.
    pub input: String,
    /// The channel; empty: the whole input.
    pub channel: String,
    /// What is wrong with it.
    pub error: String,
}

/// Orders of a bearing's faults: events in a turn of the shaft; `None` of those not known.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct OrdersSummary {
    /// Turns of the cage.
    pub cage: Option<f64>,
    /// Balls that pass a place of the outer race.
    pub outer: Option<f64>,
    /// Balls that pass a place of the inner race.
    pub inner: Option<f64>,
    /// Strikes of a place on a ball against both races.
    pub ball: Option<f64>,
    /// Relative error of the orders.
    pub relative_error: Option<f64>,
}

/// A window of one of several inputs.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct WindowOfInput<'a> {
    /// The file or folder.
    pub input: &'a str,
    /// The window.
    #[serde(flatten)]
    pub window: &'a WindowAnalysis,
}

impl OrdersSummary {
    /// Those of a bearing; without one none is known.
    #[must_use]
    pub(crate) fn of(orders: Option<FaultOrders>) -> Self {
        let order = |fault| orders.and_then(|orders| orders.order(fault));
        Self {
            cage: order(Fault::Cage),
            outer: order(Fault::OuterRace),
            inner: order(Fault::InnerRace),
            ball: order(Fault::Ball),
            relative_error: orders.map(|orders| orders.error(Fault::OuterRace)),
        }
    }
}
