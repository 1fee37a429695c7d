//! What of a housing can still move, in the mesh's words: a condensation that cannot be made names the part.

use super::housing::AssembledHousing;
use super::ring::Boundary;
use crate::app::error::ComputeError;
use crate::fe::modal::{Mechanisms, unless_too_many_bodies};
use crate::fe::model::HousingModel;
use crate::fe::reduction::{Check, ReductionError};

/// Every part of the housing hangs on the interface or on a support: otherwise `K_ii` is singular, and round-off may hide it
/// from a factorisation.
///
/// # Errors
/// [`ComputeError::LooseInterior`].
pub(crate) fn check_interior(housing: &AssembledHousing, boundary: &Boundary) -> Result<(), ComputeError> {
    let partition = boundary.partition();
    if partition.driven.is_empty() || partition.interior.is_empty() {
        return Ok(()); // refused for this
    }
    let rotation = boundary.ring().and_then(|(_, tie)| tie.rotation());
    let found = Mechanisms::find_with_held(&housing.mesh, &housing.model, &partition.driven, rotation);
    match unless_too_many_bodies(found)? {
        Some(found) if found.total() > 0 => Err(ComputeError::LooseInterior { what: found.sentences() }),
        _ => Ok(()),
    }
}

/// A reduction that failed at a degree of freedom of the housing, with the part that it belongs to.
pub(crate) fn located(error: ReductionError, model: &HousingModel) -> ComputeError {
    let dof = match error {
        ReductionError::FloatingInterior { dof, .. } | ReductionError::SoftInterior { dof, .. } => dof,
        other => return other.into(),
    };
    let node = dof / model.dimension();
    let mut elements = model.elements().iter();
    let of_node = elements.find(|element| model.elements().nodes(element).contains(&node));
    let part = of_node.and_then(|element| model.part_names().get(element.part));
    match (part, model.node_tags.get(node)) {
        (Some(part), Some(&tag)) => ComputeError::SoftPart { part: part.clone(), tag, source: error },
        _ => error.into(),
    }
}

/// Adds what of the whole housing can move to the check that says that something can.
///
/// # Errors
/// [`ComputeError::Modal`] for a mesh that is not the model's.
pub(crate) fn name_mechanisms(
    checks: &mut [Check],
    housing: &AssembledHousing,
    boundary: &Boundary,
) -> Result<(), ComputeError> {
    let Some(held) = checks.iter_mut().find(|check| check.name == "held" && !check.ok()) else {
        return Ok(());
    };
    let (mesh, model) = (&housing.mesh, &housing.model);
    let found = match boundary.ring() {
        Some((ring, tie)) => Mechanisms::find_with_ring(mesh, model, tie, ring),
        None => Mechanisms::find(mesh, model),
    };
    for sentence in unless_too_many_bodies(found)?.map_or(Vec::new(), |found| found.sentences()) {
        held.what = format!("{}; {sentence}", held.what);
    }
    Ok(())
}
