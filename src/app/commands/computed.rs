//! What a command computed, whichever it was: its content as its JSON file has it, and its report.

use crate::app::case::Case;
use crate::app::commands::parts::with_details;
use crate::app::error::ComputeError;
use crate::report::Report;
use serde::Serialize;

/// What a command computed. Serialised it is what the command's JSON file says behind its head.
pub trait Computed: Serialize {
    /// Composes the report; `command` is the line that made it.
    ///
    /// # Errors
    /// [`ComputeError`] of what cannot be shown.
    fn report(&self, case: &Case, command: &str) -> Result<Report, ComputeError>;

    /// The report as one HTML page, with what the case says of its head.
    ///
    /// # Errors
    /// As [`report`](Self::report), and of contents that do not fit together.
    fn page(&self, case: &Case, command: &str) -> Result<String, ComputeError> {
        Ok(with_details(self.report(case, command)?, case).to_html()?)
    }
}
