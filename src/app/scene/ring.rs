//! The ring of a case: its section and supports, its tie to the bore, and the bore itself.

use super::housing::{AssembledHousing, material};
use crate::app::case::{self, Case, other_size, short};
use crate::app::error::ComputeError;
use crate::bearing::catalogue::CatalogueBearing;
use crate::fe::assembly::SystemMatrices;
use crate::fe::material::{BeamSection, Bond, RingLayer};
use crate::fe::mesh::Mesh;
use crate::fe::model::{HousingModel, HousingPartition, NodeInterface, Ring, RingSupport, RingTie};
use crate::fe::reduction::Attached;
use std::borrow::Cow;
use std::f64::consts::TAU;

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
    let seat = Seat::of(mesh, model, tie)?;
    let tied = RingTie::new(mesh, model, &tie.group, &ring, outer, tie.fit)?;
    refuse_outside(case, asked, &format!("the bore \"{}\"", tie.group), seat.radii)?;
    Ok((ring, Some(tied)))
}

/// A section of a ring as it is asked for.
///
/// # Errors
/// [`ComputeError::Input`].
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
    let new = if in_space { Ring::in_space } else { Ring::new };
    let mut ring = new(asked.nodes, section, asked.element)?;
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

/// A length of a message, m, as a case file has it: six digits of what was measured.
pub(super) fn metres(length: f64) -> String {
    let digits = format!("{length:.5e}");
    format!("{} m", short(digits.parse().unwrap_or(length)))
}

/// Refuses a ring or a race that is not inside a bore whose nearest and farthest nodes are known (m from the axis), and a bearing by
/// name that does not fit it; `bore` is as messages call it.
///
/// # Errors
/// [`ComputeError`] with both radii or diameters and their keys.
pub(crate) fn refuse_outside(case: &Case, ring: &case::Ring, bore: &str, radii: [f64; 2]) -> Result<(), ComputeError> {
    let name = case.bearing.as_ref().and_then(|bearing| bearing.name.as_deref());
    if let Some(bearing) = name.and_then(CatalogueBearing::named) {
        // rings between bearing and bore are sections of their own
        let nearest = if ring.sections.len() > 1 { 0.0 } else { radii[0] };
        if let Some(rule) = other_size(bearing, bore, [nearest, radii[1]], "housing.length_unit") {
            return Err(case.broken(&rule.at("bearing.name")).into());
        }
    }
    let farthest = radii[1];
    let sections = ring.sections.iter().enumerate();
    let sections = sections.map(|(index, section)| (format!("ring.sections[{index}].radius"), section.radius));
    let race = case.bearing.iter().map(|bearing| ("bearing.outer_race_radius".to_owned(), bearing.outer_race_radius));
    let mut outside = race.chain(sections).filter(|(_, radius)| *radius >= farthest);
    let Some((key, radius)) = outside.next() else {
        return Ok(());
    };
    Err(ComputeError::input(
        format!(
            "{key} is {} and the radius of {bore} is {}: expected the race in the ring, and the ring in the bore",
            metres(radius),
            metres(farthest)
        ),
        "check that the radii are in m and none is a diameter, and housing.length_unit, ring.tie.centre and ring.tie.group",
    ))
}

/// What a housing is attached by.
#[derive(Debug, Clone)]
pub enum Boundary {
    /// A ring through its tie.
    Ring(Box<(Ring, RingTie)>),
    /// Nodes of the mesh themselves.
    Nodes(NodeInterface),
}

impl Boundary {
    /// How the housing's degrees of freedom are split.
    pub(crate) fn partition(&self) -> &HousingPartition {
        match self {
            Self::Ring(bodies) => bodies.1.partition(),
            Self::Nodes(nodes) => &nodes.partition,
        }
    }

    pub(crate) fn matrices<'h>(&self, housing: &'h AssembledHousing) -> Cow<'h, SystemMatrices> {
        match self.ring() {
            Some((_, tie)) if tie.rotation().is_some() => Cow::Owned(housing.matrices.clone().for_tie(tie)),
            _ => Cow::Borrowed(&housing.matrices),
        }
    }

    /// What sits on the interface.
    pub fn attached(&self) -> Option<Attached<'_>> {
        self.ring().map(|(ring, _)| Attached { stiffness: ring.stiffness(), mass: ring.mass() })
    }

    /// Ring and tie, if that is what it is.
    pub(crate) fn ring(&self) -> Option<(&Ring, &RingTie)> {
        match self {
            Self::Ring(bodies) => Some((&bodies.0, &bodies.1)),
            Self::Nodes(_) => None,
        }
    }
}

/// The bore in the ring's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Seat {
    /// Number of its nodes.
    pub nodes: usize,
    /// Least and largest distance of a node from the axis, m.
    pub radii: [f64; 2],
    /// First place along the axis, m.
    pub from: f64,
    /// Last place along the axis, m.
    pub to: f64,
    /// Largest angle round the axis without a node of the bore, radians.
    pub free_turn: f64,
}

impl Seat {
    /// The bore of a tie.
    ///
    /// # Errors
    /// [`ComputeError::Model`] if the mesh lacks it.
    pub(crate) fn of(mesh: &Mesh, model: &HousingModel, tie: &case::Tie) -> Result<Self, ComputeError> {
        let group = model.group_on_housing(mesh, &tie.group, "the tie")?;
        let nodes = group.nodes.iter().filter(|&&node| model.used[node]);
        let places: Vec<[f64; 3]> = nodes.map(|&node| model.ring_coordinates(node)).collect();
        let along: Vec<f64> = places.iter().map(|place| place[2]).collect();
        let mut angles: Vec<f64> = places.iter().map(|[x, y, _]| y.atan2(*x)).collect();
        angles.sort_unstable_by(f64::total_cmp);
        let next = angles.iter().skip(1).copied();
        let next = next.chain(angles.first().map(|first| first + TAU));
        let gaps = angles.iter().zip(next).map(|(angle, next)| next - angle);
        let radii = places.iter().map(|[x, y, _]| x.hypot(*y));
        Ok(Self {
            radii: radii.fold([f64::INFINITY, 0.0], |[low, high], radius| [low.min(radius), high.max(radius)]),
            free_turn: gaps.fold(0.0, f64::max),
            nodes: along.len(),
            from: along.iter().copied().fold(f64::INFINITY, f64::min),
            to: along.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        })
    }

    /// Share, 0 to 1, of a ring of this width (m) about the ring's plane that lies beyond the bore's ends.
    pub(crate) fn share_outside(&self, width: f64) -> f64 {
        let half = 0.5 * width;
        let inside = self.to.min(half) - self.from.max(-half);
        1.0 - inside.max(0.0) / width
    }
}
