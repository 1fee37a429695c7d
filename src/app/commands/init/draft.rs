//! `plummer init`: from a mesh to a case file that is ready to be edited.
//!
//! The bore is the group that lies on a cylinder with the housing outside of it. Parts and supports go by dimension and name.
//! CAD entities stand in for groups that the mesh lacks. The
//! rest is from the catalogue, usual values and guesses. The file says of every value which of these it is. What could not be told
//! is there as a template, commented out. The same mesh gives the same file.
//!
//! Several bores on one axis are a bearing each, on one shaft.
//!
//! **Limitations**: links between parts that share no nodes are left to the user.

use schemars::JsonSchema;
use serde::Serialize;

use super::found::{DraftRequest, find};
use super::seat::{FoundCylinder, Seat};
use super::text::{case_text, findings};
use crate::app::commands::Inspection;
use crate::app::error::ComputeError;
use crate::fe::mesh::{Mesh, MeshNotes, MshVersion};
use crate::fe::model::straighten;
use crate::numerics::units::LengthUnit;

/// A case file, and what it was made from.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Draft {
    /// Unit that the file says.
    pub length_unit: LengthUnit,
    /// The bore that the ring, or the first of several, is tied to; `None`: none was found.
    pub bore: Option<FoundCylinder>,
    /// Other round holes, best first.
    pub other_holes: Vec<FoundCylinder>,
    /// Designation of the bearing, or the first of several; `None`: none of the catalogue fits.
    pub bearing: Option<&'static str>,
    /// Several bearings of one shaft, in the order of the file; absent for one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub bearings: Vec<DraftBearing>,
    /// Groups that are parts, with their materials.
    pub parts: Vec<[String; 2]>,
    /// Groups that are held.
    pub supports: Vec<String>,
    /// What was found and guessed, in sentences.
    pub findings: Vec<String>,
    /// The case file.
    #[serde(skip)]
    pub text: String,
}

/// One of several bearings of a shaft.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DraftBearing {
    /// What the case calls it: the group of its bore.
    pub label: String,
    /// Designation; `None`: none of the catalogue fits.
    pub bearing: Option<&'static str>,
    /// Place along the axis from the first bore's centre.
    pub place_m: f64,
    /// Its bore.
    pub bore: FoundCylinder,
}

impl DraftBearing {
    fn of(seat: &Seat) -> Option<Self> {
        let bore = seat.bore.clone()?;
        let bearing = seat.bearing.map(|numbers| numbers.bearing.name);
        Some(Self { label: bore.group.clone(), bearing, place_m: seat.place, bore })
    }
}

impl Draft {
    /// Writes a case file for a mesh. The inspection is that of the same mesh in its own unit, as if that were the metre.
    ///
    /// # Errors
    /// [`ComputeError`] when the mesh cannot be read, has no group for a part, or its bore is not as large as the bearing asked for.
    pub(crate) fn of_mesh(request: DraftRequest<'_>) -> Result<(Self, Inspection), ComputeError> {
        let mut mesh = Mesh::read(request.mesh, LengthUnit::Metre)?;
        if request.straighten {
            // a hole whose edges are straight now is none that a ring could be tied to
            straighten(&mut mesh)?;
        }
        let inspection = Inspection::of_mesh(&mesh, None);
        let found = find(request, &mut mesh, &inspection)?;
        let text = case_text(&found).map_err(|error| ComputeError::Failed { what: error.to_string(), help: None })?;
        let parts = found.groups.parts.iter();
        let draft = Self {
            length_unit: found.unit,
            bearing: found.seat.bearing.map(|numbers| numbers.bearing.name),
            parts: parts.map(|part| [part.group.clone(), part.material.clone()]).collect(),
            findings: read_from(&inspection).into_iter().chain(findings(&found)).collect(),
            text,
            bearings: if found.further.is_empty() {
                Vec::new()
            } else {
                found.seats().filter_map(DraftBearing::of).collect()
            },
            bore: found.seat.bore,
            other_holes: found.holes,
            supports: found.groups.supports.into_iter().map(|support| support.group).collect(),
        };
        Ok((draft, inspection))
    }
}

/// What of the file was changed, or is not taken.
fn read_from(inspection: &Inspection) -> Vec<String> {
    let MeshNotes { told, as_points, passed_over, not_supports, .. } = &inspection.inventory.notes;
    let mut lines: Vec<String> = told.iter().map(|note| format!("warning: {note}")).collect();
    lines.extend(as_points.iter().chain(not_supports).cloned());
    if inspection.inventory.format.version == MshVersion::Inp {
        let passed_over = if passed_over.is_empty() { String::new() } else { format!(" ({})", passed_over.join(", ")) };
        lines.push(format!(
            "Of this file mesh, materials and supports are read; loads and all else{passed_over} are the case's."
        ));
    }
    lines
}
