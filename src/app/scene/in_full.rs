//! Rings, and the housing around them if there is one, in full: nothing is condensed.

use super::housing::AssembledHousing;
use super::imported::ImportedHousing;
use super::places::{Place, PlaceBodies};
use super::ring::rings_and_tie;
use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::fe::assembly::CoupledMatrices;
use crate::fe::mesh::Mesh;
use crate::fe::modal::{FullModes, ModalSurvey, ModeRange, RingShapes};
use crate::fe::model::{HousingModel, RingFrame, RingTie, Rings};
use crate::numerics::Watch;
use crate::system::Structure;
use std::path::Path;

/// Rings, and what they sit in: a housing of a mesh, a superelement from a file, or nothing.
#[derive(Debug, Clone)]
pub struct RingsInHousing {
    /// The rings.
    pub rings: Rings,
    /// The housing, if it is of a mesh.
    pub housing: Option<AssembledHousing>,
    /// How the rings sit in it.
    pub tie: Option<RingTie>,
    /// The superelement that stands for the housing, if the case has one.
    pub imported: Option<Box<ImportedHousing>>,
}

impl RingsInHousing {
    /// The rings of a case and its housing, assembled or read.
    ///
    /// # Errors
    /// [`ComputeError`] of mesh, model, rings and tie, of the file, of sensors that are at no place, and for a case without a ring.
    pub(crate) fn build(case: &Case, watch: &impl Watch) -> Result<Self, ComputeError> {
        if let Some(path) = case.superelement() {
            let bodies = Self::around_file(case, path, watch)?;
            for (sensor, imported) in case.sensors.iter().zip(bodies.imported.iter().cycle()) {
                imported.row(sensor.into(), &bodies.rings)?;
            }
            return Ok(bodies);
        }
        let housing = AssembledHousing::build(case, watch)?;
        let bodies = match rings_and_tie(case, housing.as_ref())? {
            (rings, Some(tie)) => Self { rings, housing, tie: Some(tie), imported: None },
            _ => Self::alone(rings_and_tie(case, None)?.0),
        };
        // what stands at no place is told before anything is computed
        bodies.sensors(case)?;
        Ok(bodies)
    }

    /// Rings in the superelement of a file.
    ///
    /// # Errors
    /// [`ComputeError`] of the file and of the rings.
    pub(super) fn around_file(case: &Case, path: &Path, watch: &impl Watch) -> Result<Self, ComputeError> {
        watch.stage("read");
        let (imported, rings) = ImportedHousing::read(case, path)?;
        imported.accept()?;
        Ok(Self { imported: Some(Box::new(imported)), ..Self::alone(rings) })
    }

    /// Rings on their own supports.
    pub(super) fn alone(rings: Rings) -> Self {
        Self { rings, housing: None, tie: None, imported: None }
    }

    /// Where the case's sensors are, on a housing of a mesh or on a ring.
    ///
    /// # Errors
    /// [`ComputeError`] for a sensor that is at no place.
    pub(super) fn sensors(&self, case: &Case) -> Result<Vec<Place>, ComputeError> {
        let bodies = PlaceBodies { housing: self.housing.as_ref(), rings: Some(&self.rings), tie: self.tie.as_ref() };
        case.sensors.iter().map(|sensor| Place::new(bodies, sensor.into())).collect()
    }

    /// Mesh and model of the housing, if it is of a mesh.
    pub(crate) fn mesh_and_model(&self) -> Option<(&Mesh, &HousingModel)> {
        self.housing.as_ref().map(|housing| (&housing.mesh, &housing.model))
    }

    /// Where the first bearing sits in the mesh's axes; a ring alone has none but its own.
    pub(crate) fn frame(&self) -> RingFrame {
        self.rings.first().frame
    }

    /// Matrices of all: in full, or as a superelement has them.
    ///
    /// # Errors
    /// [`ComputeError::System`] for a superelement that does not fit the rings.
    pub(crate) fn matrices(&self) -> Result<CoupledMatrices, ComputeError> {
        let rings = &self.rings;
        Ok(match (&self.housing, &self.tie, &self.imported) {
            (Some(housing), Some(tie), _) => CoupledMatrices::new(&housing.matrices, tie, rings),
            (_, _, Some(imported)) => {
                let structure = Structure::with_housing(rings.clone(), &imported.element, [0.0; 2])?;
                CoupledMatrices::of_condensed(structure.stiffness(), structure.mass(), rings.dof())
            }
            _ => CoupledMatrices::of_rings(rings),
        })
    }

    /// The modes without contact, and all that is said of them.
    ///
    /// # Errors
    /// [`ComputeError`] of eigenvalue computation and analysis.
    pub(crate) fn survey(&self, extent: ModeRange, watch: &impl Watch) -> Result<ModalSurvey, ComputeError> {
        Ok(match (&self.housing, &self.tie) {
            (Some(AssembledHousing { mesh, model, matrices }), Some(tie)) => {
                ModalSurvey::of_coupled((mesh, model, matrices), tie, &self.rings, extent, watch)?
            }
            _ if self.imported.is_some() => self.survey_of_imported(extent, watch)?,
            _ => ModalSurvey::of_rings(&self.rings, extent, watch)?,
        })
    }

    /// Of a superelement from a file there are frequencies, their proof and the rings' motion.
    fn survey_of_imported(&self, range: ModeRange, watch: &impl Watch) -> Result<ModalSurvey, ComputeError> {
        let modes = FullModes::of(self.matrices()?, range, None, watch)?;
        let all = modes.over_all_rows();
        let of_rings = modes.motions.rings(&all);
        Ok(ModalSurvey {
            rings: RingShapes::of_all(&self.rings, &of_rings),
            ..ModalSurvey::without_mass(all.nrows(), modes.free_dof(), modes.basis)
        })
    }
}
