//! What became of one point.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

/// What became of one point: `point.json`, written when its process has ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PointRecord {
    /// The process's exit code; `None` if a signal ended it.
    pub exit_code: Option<i32>,
    /// Its error message; empty if there is none.
    pub message: String,
    /// Wall time, s.
    pub wall_s: f64,
}

/// What is there of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointState {
    /// Computed.
    Done,
    /// Computed, and the answer is bad: exit code 1 with a result.
    Bad,
    /// Ended without a result.
    Failed,
    /// Not computed yet, or not to the end.
    Missing,
}

impl PointState {
    /// Its name in tables.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::Bad => "bad answer",
            Self::Failed => "failed",
            Self::Missing => "not computed",
        }
    }

    /// Whether there are results.
    pub(crate) fn has_result(self) -> bool {
        matches!(self, Self::Done | Self::Bad)
    }
}

impl PointRecord {
    /// The record's file in a point's folder.
    pub(crate) fn file(folder: &Path) -> PathBuf {
        folder.join("point.json")
    }

    /// Reads a point's record; `None` while there is none that can be read.
    pub(crate) fn read(folder: &Path) -> Option<Self> {
        let text = std::fs::read(Self::file(folder)).ok()?;
        serde_json::from_slice(&text).ok()
    }

    /// What is there of a point, by its record and whether its folder has a result.
    pub(crate) fn state(record: Option<&Self>, has_result: bool) -> PointState {
        match record.map(|record| (record.exit_code, has_result)) {
            Some((Some(0), true)) => PointState::Done,
            Some((Some(1), true)) => PointState::Bad,
            Some(_) => PointState::Failed,
            None => PointState::Missing,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{PointRecord, PointState};

    #[test]
    fn states_follow_from_exit_code_and_result() {
        let state = |exit_code, has_result| {
            let record = PointRecord { exit_code, message: String::new(), wall_s: 1.0 };
            PointRecord::state(Some(&record), has_result)
        };
        assert_eq!(state(Some(0), true), PointState::Done);
        assert_eq!(state(Some(1), true), PointState::Bad);
        for (code, result) in [(Some(0), false), (Some(1), false), (Some(2), true), (None, true)] {
            assert_eq!(state(code, result), PointState::Failed, "{code:?} {result}");
        }
        assert_eq!(PointRecord::state(None, true), PointState::Missing);
    }
}
