//! What can be wrong with the contents of a report.

use thiserror::Error;

/// Why a report cannot be made, kept or read: a sentence that names the piece and what is wrong with it.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct ReportError(pub(super) String);

impl ReportError {
    /// A row of a chart (from 1) with another number of values than the chart has labels.
    pub(super) fn wrong_length(chart: &str, row: usize, [found, expected]: [usize; 2]) -> Self {
        Self(format!("\"{chart}\": row {row} has {found} values for {expected} labels"))
    }

    /// Checks the values of a row (from 1) of a chart; the first that is not good is the error.
    pub(super) fn check_row(
        chart: &str,
        row: usize,
        values: impl IntoIterator<Item = f64>,
        good: impl Fn(f64) -> bool,
    ) -> Result<(), Self> {
        match (1..).zip(values).find(|(_, value)| !good(*value)) {
            Some((column, value)) => Err(Self(format!("\"{chart}\": value {column} of row {row} is {value}"))),
            None => Ok(()),
        }
    }
}

impl From<minijinja::Error> for ReportError {
    fn from(error: minijinja::Error) -> Self {
        Self(format!("page template failed: {error}"))
    }
}
