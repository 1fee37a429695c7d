//! A ring, and the housing around it if there is one, in full: nothing is condensed.

use super::housing::AssembledHousing;
use super::imported::ImportedHousing;
use super::places::{Place, PlaceBodies};
use super::ring::{ring, ring_and_tie};
use crate::app::case::{self, Case};
use crate::app::error::ComputeError;
use crate::fe::assembly::CoupledMatrices;
use crate::fe::mesh::Mesh;
use crate::fe::modal::{FullModes, ModalSurvey, ModeRange, RingShapes};
use crate::fe::model::{HousingModel, Ring, RingFrame, RingTie};
use crate::numerics::Watch;
use crate::system::Structure;
use std::path::Path;

/// A ring, and what it sits in: a housing of a mesh, a superelement from a file, or nothing.
#[derive(Debug, Clone)]
pub struct RingInHousing {
    /// The ring.
    pub ring: Ring,
    /// The housing, if it is of a mesh.
    pub housing: Option<AssembledHousing>,
    /// How the ring sits in it.
    pub tie: Option<RingTie>,
    /// The superelement that stands for the housing, if the case has one.
    pub imported: Option<Box<ImportedHousing>>,
}

impl RingInHousing {
    /// The ring that is asked for, and the housing of its case, assembled or read.
    ///
    /// # Errors
    /// [`ComputeError`] of mesh, model, ring and tie, of the file, and of sensors that are at no place.
    pub(crate) fn build(case: &Case, asked: &case::Ring, watch: &impl Watch) -> Result<Self, ComputeError> {
        if let Some(path) = case.superelement() {
            let bodies = Self::around_file(case, asked, path, watch)?;
            for (sensor, imported) in case.sensors.iter().zip(bodies.imported.iter().cycle()) {
                imported.row(sensor.into(), &bodies.ring)?;
            }
            return Ok(bodies);
        }
        let housing = AssembledHousing::build(case, watch)?;
        let bodies = match ring_and_tie(case, asked, housing.as_ref())? {
            (ring, Some(tie)) => Self { ring, housing, tie: Some(tie), imported: None },
            _ => Self::alone(ring(case, asked, false)?),
        };
        // what stands at no place is told before anything is computed
        bodies.sensors(case)?;
        Ok(bodies)
    }

    /// A ring in the superelement of a file.
    ///
    /// # Errors
    /// [`ComputeError`] of the file and of the ring.
    pub(super) fn around_file(
        case: &Case,
        asked: &case::Ring,
        path: &Path,
        watch: &impl Watch,
    ) -> Result<Self, ComputeError> {
        watch.stage("read");
        let (imported, ring) = ImportedHousing::read(case, asked, path)?;
        imported.accept()?;
        Ok(Self { imported: Some(Box::new(imported)), ..Self::alone(ring) })
    }

    /// A ring on its own supports.
    pub(super) fn alone(ring: Ring) -> Self {
        Self { ring, housing: None, tie: None, imported: None }
    }

    /// Where the case's sensors are, on a housing of a mesh or on the ring.
    ///
    /// # Errors
    /// [`ComputeError`] for a sensor that is at no place.
    pub(super) fn sensors(&self, case: &Case) -> Result<Vec<Place>, ComputeError> {
        let bodies = PlaceBodies {
            housing: self.housing.as_ref(),
            ring: Some(&self.ring),
            tie: self.tie.as_ref(),
            frame: self.frame(),
        };
        case.sensors.iter().map(|sensor| Place::new(bodies, sensor.into())).collect()
    }

    /// Mesh and model of the housing, if it is of a mesh.
    pub(crate) fn mesh_and_model(&self) -> Option<(&Mesh, &HousingModel)> {
        self.housing.as_ref().map(|housing| (&housing.mesh, &housing.model))
    }

    /// Where the bearing sits in the mesh's axes; a ring alone has none but its own.
    pub(crate) fn frame(&self) -> RingFrame {
        match (&self.housing, &self.imported) {
            (Some(housing), _) => *housing.model.frame(),
            (None, Some(imported)) => imported.frame,
            (None, None) => RingFrame::default(),
        }
    }

    /// Matrices of all: in full, or as a superelement has them.
    ///
    /// # Errors
    /// [`ComputeError::System`] for a superelement that does not fit the ring.
    pub(crate) fn matrices(&self) -> Result<CoupledMatrices, ComputeError> {
        let ring = &self.ring;
        Ok(match (&self.housing, &self.tie, &self.imported) {
            (Some(housing), Some(tie), _) => CoupledMatrices::new(&housing.matrices, tie, ring),
            (_, _, Some(imported)) => {
                let structure = Structure::with_housing(ring.clone(), &imported.element, [0.0; 2])?;
                CoupledMatrices::of_condensed(structure.stiffness(), structure.mass(), ring.dof())
            }
            _ => CoupledMatrices::of_ring(ring),
        })
    }

    /// The modes without contact, and all that is said of them.
    ///
    /// # Errors
    /// [`ComputeError`] of eigenvalue computation and analysis.
    pub(crate) fn survey(&self, extent: ModeRange, watch: &impl Watch) -> Result<ModalSurvey, ComputeError> {
        Ok(match (&self.housing, &self.tie) {
            (Some(AssembledHousing { mesh, model, matrices }), Some(tie)) => {
                ModalSurvey::of_coupled((mesh, model, matrices), tie, &self.ring, extent, watch)?
            }
            _ if self.imported.is_some() => self.survey_of_imported(extent, watch)?,
            _ => ModalSurvey::of_ring(&self.ring, extent, watch)?,
        })
    }

    /// Of a superelement from a file there are frequencies, their proof and the ring's motion.
    fn survey_of_imported(&self, range: ModeRange, watch: &impl Watch) -> Result<ModalSurvey, ComputeError> {
        let modes = FullModes::of(self.matrices()?, range, None, watch)?;
        let all = modes.over_all_rows();
        let of_ring = modes.motions.ring(&all);
        Ok(ModalSurvey {
            ring: Some(RingShapes::new(&self.ring, &self.frame(), &of_ring)),
            ..ModalSurvey::without_mass(all.nrows(), modes.free_dof(), modes.basis)
        })
    }
}
