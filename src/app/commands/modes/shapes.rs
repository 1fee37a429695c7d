//! Mode shapes at the nodes of a housing and of its ring, as other programs read them.

use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::app::scene::{AssembledHousing, CoupledStructure};
use crate::fe::mesh::Mesh;
use crate::fe::modal::ModalSurvey;
use crate::fe::model::HousingModel;
use crate::formats::ModeShapes;
use crate::numerics::Watch;

/// Frequencies and shapes of a survey along the mesh's axes: all nodes of the mesh, then those of the ring.
pub(crate) fn mode_shapes(survey: &ModalSurvey, housing: Option<(&Mesh, &HousingModel)>) -> ModeShapes {
    let mut points = Vec::new();
    let mut shapes = vec![Vec::new(); survey.basis.count()];
    if let (Some((mesh, model)), Some(moved)) = (housing, &survey.housing) {
        points.extend(&mesh.nodes);
        let d = model.dimension();
        for (mode, shape) in shapes.iter_mut().enumerate() {
            for node in moved.col_as_slice(mode).chunks_exact(d) {
                // nothing moves across a plane
                shape.extend((0..3).map(|axis| node.get(axis).copied().unwrap_or(0.0)));
            }
        }
    }
    if let Some(ring) = &survey.ring {
        points.extend(&ring.points);
        for (shape, moved) in shapes.iter_mut().zip(&ring.displacements) {
            shape.extend(moved.as_flattened());
        }
    }
    let node_tags = match (&survey.ring, housing) {
        (None, Some((mesh, _))) => Some(mesh.node_tags.clone()),
        _ => None,
    };
    ModeShapes { frequencies_hz: survey.basis.frequencies_hz.clone(), node_tags, points: Some(points), shapes }
}

/// Computes the modes of a case, as many as it asks for, and nothing else: the mesh, if it has one, and the shapes.
///
/// # Errors
/// [`ComputeError`] of the stages that it goes through.
pub(crate) fn compute_mode_shapes(case: &Case, watch: &impl Watch) -> Result<(Option<Mesh>, ModeShapes), ComputeError> {
    let extent = case.modes.extent;
    if let Some(stage) = CoupledStructure::build(case, watch)? {
        let survey = stage.survey(extent, watch)?;
        let housing = stage.housing.as_ref();
        let shapes = mode_shapes(&survey, housing.map(|stage| (&stage.mesh, &stage.model)));
        return Ok((stage.housing.map(|stage| stage.mesh), shapes));
    }
    let AssembledHousing { mesh, model, matrices } = AssembledHousing::of(case, watch)?;
    let survey = ModalSurvey::of_housing(&mesh, &model, matrices, extent, watch)?;
    let shapes = mode_shapes(&survey, Some((&mesh, &model)));
    Ok((Some(mesh), shapes))
}
