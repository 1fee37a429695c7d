//! `plummer analyze`: which part of a bearing is damaged, by a signal in windows.

pub(crate) mod band_search;
pub(crate) mod band_search_report;
#[cfg(test)]
mod band_search_tests;
pub(crate) mod change;
pub(crate) mod change_report;
pub(crate) mod no_signs;
pub(crate) mod report;
pub(crate) mod summary;
pub(crate) mod survey_report;
pub(crate) mod table;
pub(crate) mod window;

pub use band_search::{AskedBand, BandSearch, UsedBand};
pub use change::EarlierSignal;
pub(crate) use change::compare_window;
pub(crate) use report::analysis_report;
pub use summary::{AnalysisResult, FailureSummary, InputSummary, OrdersSummary, SurveyResult, WindowOfInput};
pub use survey_report::SHOWN_WINDOWS;
pub(crate) use survey_report::{survey_report, survey_section};
pub use table::AnalysisRow;
pub(crate) use table::{analysis_table, unexplained};
pub use window::{AnalysisSettings, OuterRaceLine, WindowAnalysis, WindowChange, analyse, compute_analysis};
