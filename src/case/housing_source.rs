//! `[housing]`: a mesh with its parts, or a superelement that was condensed elsewhere.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::union::{Mismatch, written_as};
use super::{Case, Housing, Integration, LinearElements, Link, Part, Plane, PointMass, Support};
use crate::units::LengthUnit;

/// Where the housing comes from.
#[derive(Debug, Clone, PartialEq)]
pub enum HousingSource {
    /// A mesh with materials and supports.
    Mesh(Box<Housing>),
    /// A file of condensed matrices on the ring's degrees of freedom, SI units: a NumPy archive (`.npz`) or Nastran's
    /// OUTPUT4 (`.op4`). Relative paths in a case file are relative to that file; here they are resolved.
    Superelement(PathBuf),
}

impl HousingSource {
    /// The file that it is read from.
    #[must_use]
    pub fn path(&self) -> &Path {
        match self {
            Self::Mesh(housing) => &housing.mesh,
            Self::Superelement(path) => path,
        }
    }

    pub(super) fn path_mut(&mut self) -> &mut PathBuf {
        match self {
            Self::Mesh(housing) => &mut housing.mesh,
            Self::Superelement(path) => path,
        }
    }
}

impl Case {
    /// Returns the housing, if the case has one with a mesh.
    #[must_use]
    pub fn meshed_housing(&self) -> Option<&Housing> {
        match &self.housing {
            Some(HousingSource::Mesh(housing)) => Some(housing),
            _ => None,
        }
    }

    /// Returns the file of the superelement that stands for the housing, if there is one.
    #[must_use]
    pub fn superelement(&self) -> Option<&Path> {
        match &self.housing {
            Some(HousingSource::Superelement(path)) => Some(path),
            _ => None,
        }
    }
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SourceForm {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    superelement: Option<PathBuf>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    mesh: Option<PathBuf>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    length_unit: Option<LengthUnit>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    plane: Option<Plane>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    integration: Option<Integration>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    linear: Option<LinearElements>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    parts: Option<Vec<Part>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    supports: Option<Vec<Support>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    masses: Option<Vec<PointMass>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    links: Option<Vec<Link>>,
}

impl SourceForm {
    /// The first key that belongs to a mesh.
    fn key_of_mesh(&self) -> Option<&'static str> {
        let keys = [
            ("mesh", self.mesh.is_some()),
            ("length_unit", self.length_unit.is_some()),
            ("plane", self.plane.is_some()),
            ("integration", self.integration.is_some()),
            ("linear", self.linear.is_some()),
            ("parts", self.parts.is_some()),
            ("supports", self.supports.is_some()),
            ("masses", self.masses.is_some()),
            ("links", self.links.is_some()),
        ];
        keys.iter().find(|(_, given)| *given).map(|(key, _)| *key)
    }
}

written_as!(HousingSource, SourceForm);

impl TryFrom<SourceForm> for HousingSource {
    type Error = Mismatch;

    fn try_from(form: SourceForm) -> Result<Self, Mismatch> {
        let beside = form.key_of_mesh();
        match (form.superelement, beside) {
            (Some(path), None) => return Ok(Self::Superelement(path)),
            (Some(_), Some(key)) => {
                return Err(Mismatch::form(
                    format!("`{key}` beside `superelement`"),
                    "`superelement` alone, or `mesh` with its keys",
                ));
            }
            (None, _) => {}
        }
        let missing = |key| Mismatch::Missing { key };
        Ok(Self::Mesh(Box::new(Housing {
            mesh: form.mesh.ok_or_else(|| missing("mesh"))?,
            length_unit: form.length_unit.ok_or_else(|| missing("length_unit"))?,
            plane: form.plane,
            integration: form.integration.unwrap_or_default(),
            linear: form.linear.unwrap_or_default(),
            parts: form.parts.ok_or_else(|| missing("parts"))?,
            supports: form.supports.unwrap_or_default(),
            masses: form.masses.unwrap_or_default(),
            links: form.links.unwrap_or_default(),
        })))
    }
}

impl From<HousingSource> for SourceForm {
    fn from(source: HousingSource) -> Self {
        let mut form = Self {
            superelement: None,
            mesh: None,
            length_unit: None,
            plane: None,
            integration: None,
            linear: None,
            parts: None,
            supports: None,
            masses: None,
            links: None,
        };
        match source {
            HousingSource::Superelement(path) => form.superelement = Some(path),
            HousingSource::Mesh(housing) => {
                let housing = *housing;
                form.mesh = Some(housing.mesh);
                form.length_unit = Some(housing.length_unit);
                form.plane = housing.plane;
                form.integration = Some(housing.integration);
                form.linear = Some(housing.linear);
                form.parts = Some(housing.parts);
                form.supports = Some(housing.supports);
                form.masses = Some(housing.masses);
                form.links = Some(housing.links).filter(|links| !links.is_empty());
            }
        }
        form
    }
}
