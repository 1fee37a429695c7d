//! `plummer analyze`: which part of a bearing is damaged, by a signal in windows.

pub(crate) mod band_search;
#[cfg(test)]
mod band_search_tests;
pub(crate) mod change;
pub(crate) mod change_report;
mod fault_lines;
mod flaws;
pub(crate) mod report;
pub(crate) mod summary;
pub(crate) mod table;
pub(crate) mod window;

pub use band_search::{AskedBand, BandSearch, UsedBand};
pub use change::{EarlierSignal, compare_windows};
pub use fault_lines::FaultLine;
pub use flaws::signal_flaws;
pub(crate) use report::{analysis_report, verdict_lines};
pub use summary::{AnalysisResult, FailureSummary, InputSummary, OrdersSummary, SurveyResult, WindowOfInput};
pub use table::{AnalysisRow, SHOWN_WINDOWS};
pub(crate) use table::{analysis_table, input_section, survey_report, survey_section, verdicts_table};
pub use window::{AnalysisSettings, WindowAnalysis, WindowChange, analyse, compute_analysis};
pub(crate) use window::{DamageShown, check_speed};
