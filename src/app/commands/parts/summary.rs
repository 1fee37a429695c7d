//! What several results say.

use crate::app::scene::RingsInHousing;
use crate::fe::reduction::Check;
use schemars::JsonSchema;
use serde::Serialize;
use std::path::Path;

/// A superelement from a file in the place of a housing.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct SuperelementSummary<'a> {
    /// The file.
    pub path: &'a Path,
    /// Number of its interface coordinates.
    pub interface_dof: usize,
    /// Number of its modal coordinates.
    pub modes: usize,
    /// What a reader must know of it, in sentences.
    pub notes: &'a [String],
}

impl<'a> SuperelementSummary<'a> {
    /// That around a ring; `None` where its housing is of a mesh, or it has none.
    #[must_use]
    pub(crate) fn of(bodies: &'a RingsInHousing) -> Option<Self> {
        let imported = bodies.imported.as_ref()?;
        Some(Self {
            path: &imported.path,
            interface_dof: imported.element.interface_dof,
            modes: imported.element.modal_dof(),
            notes: &imported.notes,
        })
    }
}

/// A check with its verdict.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct CheckSummary<'a> {
    /// The check.
    #[serde(flatten)]
    pub check: &'a Check,
    /// Whether it passes.
    pub ok: bool,
}

impl<'a> CheckSummary<'a> {
    /// Those of a list.
    #[must_use]
    pub(crate) fn of(checks: &'a [Check]) -> Vec<Self> {
        let checks = checks.iter();
        checks.map(|check| Self { check, ok: check.ok() }).collect()
    }
}
