//! The housing of transfer paths: condensed from a mesh, or a superelement from a file.

use crate::app::case::{self, Case};
use crate::app::error::ComputeError;
use crate::app::scene::CondensedHousing;
use crate::app::scene::ImportedHousing;
use crate::app::scene::places::{Named, Place};
use crate::fe::model::Ring;
use crate::fe::reduction::{Attached, Superelement};

/// A housing and the ring in it.
#[derive(Debug, Clone)]
pub enum FrfHousing {
    /// Condensed from a mesh.
    Mesh(Box<CondensedHousing>),
    /// From a file, with the ring that fits it. What it lacks is not known.
    File(Box<(ImportedHousing, Ring)>),
}

/// Where one end of a path is.
pub(crate) type Spot<'c> = (Named<'c>, &'c case::SensorSpot, [f64; 3]);

impl FrfHousing {
    /// Reads the file of a case.
    ///
    /// # Errors
    /// [`ComputeError`] of the file, the ring, and matrices that are not those of a condensed housing.
    pub(crate) fn read(case: &Case, path: &std::path::Path) -> Result<Self, ComputeError> {
        let asked = case.ring.as_ref().ok_or(ComputeError::NothingToCondense)?;
        let (imported, ring) = ImportedHousing::read(case, asked, path)?;
        imported.accept()?;
        Ok(Self::File(Box::new((imported, ring))))
    }

    /// Its matrices.
    pub(crate) fn element(&self) -> &Superelement {
        match self {
            Self::Mesh(stage) => &stage.condensed.superelement,
            Self::File(imported) => &imported.0.element,
        }
    }

    /// What sits on its interface.
    pub(crate) fn attached(&self) -> Option<Attached<'_>> {
        match self {
            Self::Mesh(stage) => stage.boundary.attached(),
            Self::File(imported) => Some(Attached { stiffness: imported.1.stiffness(), mass: imported.1.mass() }),
        }
    }

    /// Rows of some places over its coordinates, one \[order\] for each.
    ///
    /// # Errors
    /// [`ComputeError`] for a place that is not there.
    pub(crate) fn rows<'c>(&self, spots: impl Iterator<Item = Spot<'c>>) -> Result<Vec<Vec<f64>>, ComputeError> {
        match self {
            Self::Mesh(stage) => {
                let places = places(stage, spots)?;
                Ok(places.iter().map(|at| at.reduced(&stage.condensed)).collect())
            }
            Self::File(imported) => {
                spots.map(|(name, spot, direction)| imported.0.row(name, spot, direction, &imported.1)).collect()
            }
        }
    }
}

/// Places on housing and ring.
///
/// # Errors
/// [`ComputeError`] for a place that is not there.
pub(crate) fn places<'c>(
    stage: &CondensedHousing,
    spots: impl Iterator<Item = Spot<'c>>,
) -> Result<Vec<Place>, ComputeError> {
    let bodies = stage.bodies();
    spots.map(|(name, spot, direction)| Place::new(bodies, name, spot, direction)).collect()
}
