//! `[report]`: for whom and by whom a report is made.

use super::check::report;
use super::document::{Document, Source};
use super::error::CaseError;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What stands in the head of every report of the case. It changes no result.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ReportDetails {
    /// Title of the reports, in the place of the case's; one line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// Who made the computation; one line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub author: Option<String>,
    /// For whom it was made; one line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub customer: Option<String>,
    /// Project or order that it belongs to; one line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub project: Option<String>,
    /// What else the reader is to know; may have several lines.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remark: Option<String>,
}

/// What arguments may set where there is no case.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WithoutCase {
    #[serde(default)]
    report: Option<ReportDetails>,
}

impl ReportDetails {
    /// Entries of `KEY=VALUE` arguments for a command without a case, `report.customer=...`; `None` without any.
    ///
    /// # Errors
    /// [`CaseError`]: an argument that is none, another key than those of `report`, an entry that does not fit the report's head.
    pub(crate) fn of_arguments(set: &[String]) -> Result<Option<Self>, CaseError> {
        let source = Source { set: set.to_vec(), ..Source::default() };
        let document = Document::read(&source)?;
        let read = WithoutCase::deserialize(&document.root).map_err(|fault| document.error(fault))?;
        let checked = read.report.iter().try_for_each(report);
        checked.map_err(|broken| CaseError::broken(document.place(&broken.key), &broken))?;
        Ok(read.report)
    }

    /// Every entry with its key, in the order of the report's head.
    pub(crate) fn entries(&self) -> [(&'static str, Option<&str>); 5] {
        let Self { title, author, customer, project, remark } = self;
        [("title", title), ("customer", customer), ("project", project), ("author", author), ("remark", remark)]
            .map(|(key, text)| (key, text.as_deref()))
    }
}
