//! `plummer init`: from a mesh to a case file that is ready to be edited.
//!
//! The bore is the group that lies on a cylinder with the housing outside of it. Parts and supports go by dimension and name. The
//! rest is from the catalogue, usual values and guesses. The file says of every value which of these it is. What could not be told
//! is there as a template, commented out. The same mesh gives the same file.
//!
//! **Limitations**: one bore, one bearing; links between parts that share no nodes are left to the user.

use schemars::JsonSchema;
use serde::Serialize;

use super::found::{DraftRequest, Found, FoundCylinder, find};
use super::page::Page;
use super::run_text::run;
use super::scene::UnitFrom;
use super::text::{bearing, findings, head, housing, motion, ring, sensors};
use crate::app::commands::Inspection;
use crate::app::error::ComputeError;
use crate::fe::mesh::Mesh;
use crate::numerics::units::LengthUnit;

/// A case file, and what it was made from.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Draft {
    /// Unit that the file says.
    pub length_unit: LengthUnit,
    /// Where it comes from.
    #[serde(skip)]
    pub unit_from: UnitFrom,
    /// The bore that the ring is tied to; `None`: none was found.
    pub bore: Option<FoundCylinder>,
    /// Other round holes, best first.
    pub other_holes: Vec<FoundCylinder>,
    /// Designation of the bearing; `None`: none of the catalogue fits.
    pub bearing: Option<&'static str>,
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

impl Draft {
    /// Writes a case file for a mesh. The inspection is that of the same mesh in its own unit, as if that were the metre.
    ///
    /// # Errors
    /// [`ComputeError`] when the mesh cannot be read, has no group for a part, or its bore is not as large as the bearing asked for.
    pub(crate) fn of_mesh(request: DraftRequest<'_>) -> Result<(Self, Inspection), ComputeError> {
        let mesh = Mesh::read_gmsh(request.mesh, LengthUnit::Metre)?;
        let inspection = Inspection::of_mesh(&mesh, None);
        let found = find(request, &mesh, &inspection)?;
        Ok((write(&found), inspection))
    }
}

fn write(found: &Found<'_>) -> Draft {
    let findings = findings(found);
    let mut page = Page::default();
    head(&mut page, found);
    housing(&mut page, found);
    ring(&mut page, found);
    bearing(&mut page, found);
    motion(&mut page, found);
    sensors(&mut page, found);
    run(&mut page, found);
    let parts = found.groups.parts.iter();
    Draft {
        length_unit: found.unit,
        unit_from: found.unit_from,
        bore: found.bore.clone(),
        other_holes: found.holes.clone(),
        bearing: found.bearing.map(|numbers| numbers.bearing.name),
        parts: parts.map(|part| [part.group.clone(), part.material.to_owned()]).collect(),
        supports: found.groups.supports.clone(),
        findings,
        text: page.text(),
    }
}
