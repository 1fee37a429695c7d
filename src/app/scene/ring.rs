//! The ring of a case: its section, supports and tie to the bore.

use super::housing::{AssembledHousing, material};
use crate::app::case::{self, Case};
use crate::app::error::ComputeError;
use crate::fe::material::{BeamSection, Bond, RingLayer};
use crate::fe::model::{Ring, RingSupport, RingTie};

/// The ring of a case, and how it sits in its housing if it does.
///
/// # Errors
/// [`ComputeError`] of the ring and of the tie.
pub(crate) fn ring_and_tie(
    case: &Case,
    asked: &case::Ring,
    housing: Option<&AssembledHousing>,
) -> Result<(Ring, Option<RingTie>), ComputeError> {
    let in_space = housing.is_some_and(|housing| housing.model.dimension() == 3);
    let ring = ring(case, asked, in_space)?;
    let (Some(housing), Some(tie)) = (housing, &asked.tie) else {
        return Ok((ring, None));
    };
    let outer = asked.outer_radius;
    let AssembledHousing { mesh, model, .. } = housing;
    let tie = RingTie::new(mesh, model, &tie.group, &ring, outer, tie.fit)?;
    Ok((ring, Some(tie)))
}

/// A section of a ring as it is asked for.
///
/// # Errors
/// [`ComputeError::Material`].
pub(crate) fn layer(case: &Case, section: &case::Section) -> Result<RingLayer, ComputeError> {
    Ok(RingLayer {
        material: material(case, "ring.sections", &section.material)?,
        area: section.area,
        inertia: section.inertia,
        axial_inertia: section.axial_inertia,
        torsion: section.torsion,
        radius: section.radius,
        shear_coefficient: section.shear_coefficient,
    })
}

/// The ring of a case with its supports; in space for a solid housing.
pub(crate) fn ring(case: &Case, asked: &case::Ring, in_space: bool) -> Result<Ring, ComputeError> {
    let layers = asked.sections.iter().map(|section| layer(case, section));
    let layers = layers.collect::<Result<Vec<_>, ComputeError>>()?;
    let bond = match asked.bond {
        case::Bond::Composite => Bond::Composite,
        case::Bond::Slip => Bond::Slip(asked.radius_rule),
    };
    let mut section = BeamSection::combine(&layers, bond)?;
    if !asked.shear {
        section = section.without_shear();
    }
    if !asked.rotary_inertia {
        section = section.without_rotary_inertia();
    }
    let mut ring = if in_space {
        Ring::in_space(asked.nodes, section, asked.element)?
    } else {
        Ring::new(asked.nodes, section, asked.element)?
    };
    for support in &asked.supports {
        ring.add_support(&RingSupport {
            from: support.from_deg.to_radians(),
            to: support.to_deg.to_radians(),
            spring: [support.spring.x, support.spring.y, support.spring.z],
            share: support.per,
            offset: support.offset,
        })?;
    }
    Ok(ring)
}
