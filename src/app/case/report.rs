//! `[report]`: for whom and by whom a report is made.

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

impl ReportDetails {
    /// Every entry with its key, in the order of the report's head.
    pub(crate) fn entries(&self) -> [(&'static str, Option<&str>); 5] {
        let Self { title, author, customer, project, remark } = self;
        [("title", title), ("customer", customer), ("project", project), ("author", author), ("remark", remark)]
            .map(|(key, text)| (key, text.as_deref()))
    }
}
