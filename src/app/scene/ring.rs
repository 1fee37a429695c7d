//! The ring of a case: its section and supports, its tie to the bore, and the bore itself.

use super::centres::{Centres, RingsAndCentres};
use super::housing::{AssembledHousing, frame, material};
use crate::app::case::{self, Case, other_size, short};
use crate::app::error::ComputeError;
use crate::bearing::catalogue::CatalogueBearing;
use crate::fe::assembly::SystemMatrices;
use crate::fe::material::{BeamSection, Bond, RingLayer};
use crate::fe::mesh::Mesh;
use crate::fe::model::{
    Bore, HousingModel, HousingPartition, ModelError, NodeInterface, Ring, RingFrame, RingSupport, RingTie, Rings,
};
use crate::fe::reduction::Attached;
use std::borrow::Cow;
use std::f64::consts::TAU;

/// The rings of a case, and how they sit in its housing if they do.
///
/// # Errors
/// [`ComputeError`] of the rings and of the tie, and for a case without a ring.
pub(crate) fn rings_and_tie<'c>(
    case: &'c Case,
    housing: Option<&AssembledHousing>,
) -> Result<(Rings, Option<RingTie>), ComputeError> {
    let in_space = housing.is_some_and(|housing| housing.model.dimension() == 3);
    let seats = case.seats();
    let seated = seats.iter().map(|seat| Ok((seat.label.clone(), ring(case, seat.ring, in_space)?, frame(seat)?)));
    let rings = Rings::new(seated.collect::<Result<_, ComputeError>>()?).ok_or(ComputeError::NothingToCondense)?;
    let Some(AssembledHousing { mesh, model, .. }) = housing else {
        return Ok((rings, None));
    };
    let tied = |ring: &'c case::Ring| {
        let tie = ring.tie.as_ref()?;
        Some(Bore { group: &tie.group, outer_radius: ring.outer_radius, fit: tie.fit })
    };
    let Some(bores) = seats.iter().map(|seat| tied(seat.ring)).collect::<Option<Vec<_>>>() else {
        return Ok((rings, None));
    };
    let of_tie = |place: usize, error: ComputeError| match &seats[place] {
        // messages about the only tie name its keys
        seat if seat.label.is_empty() => error,
        seat => error.of_key(&seat.key("ring.tie")),
    };
    let extents = rings.seats().iter().zip(&bores).enumerate().map(|(place, (own, bore))| {
        BoreExtent::of(mesh, model, &own.frame, bore.group).map_err(|error| of_tie(place, error))
    });
    let extents = extents.collect::<Result<Vec<_>, ComputeError>>()?;
    let tie = RingTie::of_bores(mesh, model, &rings, &bores).map_err(|error| match error {
        ModelError::Bore { place, source } => of_tie(place, (*source).into()),
        error => error.into(),
    })?;
    for ((seat, bore), extent) in seats.iter().zip(&bores).zip(extents) {
        refuse_outside(case, seat, &format!("the bore \"{}\"", bore.group), extent.radii)?;
    }
    Ok((rings, Some(tie)))
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

/// A ring of a case with its supports; in space for a solid housing.
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
pub(crate) fn refuse_outside(
    case: &Case,
    seat: &case::Seat<'_>,
    bore: &str,
    radii: [f64; 2],
) -> Result<(), ComputeError> {
    let ring = seat.ring;
    let name = seat.bearing.and_then(|bearing| bearing.name.as_deref());
    if let Some(bearing) = name.and_then(CatalogueBearing::named) {
        // rings between bearing and bore are sections of their own
        let nearest = if ring.sections.len() > 1 { 0.0 } else { radii[0] };
        if let Some(rule) = other_size(bearing, bore, [nearest, radii[1]], "housing.length_unit") {
            return Err(case.broken(&rule.at(seat.key("bearing.name"))).into());
        }
    }
    let farthest = radii[1];
    let sections = ring.sections.iter().enumerate();
    let sections =
        sections.map(|(index, section)| (seat.key(&format!("ring.sections[{index}].radius")), section.radius));
    let race = seat.bearing.map(|bearing| (seat.key("bearing.outer_race_radius"), bearing.outer_race_radius));
    let mut outside = race.into_iter().chain(sections).filter(|(_, radius)| *radius >= farthest);
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
    /// Rings through their tie.
    Rings(Box<(Rings, RingTie)>),
    /// Nodes of the mesh themselves.
    Nodes(NodeInterface),
    /// Centre nodes of bores.
    Centres(Centres),
    /// Rings through their tie, then centre nodes of other bores.
    Both(Box<RingsAndCentres>),
}

impl Boundary {
    /// How the housing's degrees of freedom are split.
    pub(crate) fn partition(&self) -> &HousingPartition {
        match self {
            Self::Rings(bodies) => bodies.1.partition(),
            Self::Nodes(nodes) => &nodes.partition,
            Self::Centres(centres) => centres.partition(),
            Self::Both(both) => both.partition(),
        }
    }

    pub(crate) fn matrices<'h>(&self, housing: &'h AssembledHousing) -> Cow<'h, SystemMatrices> {
        match self.rings() {
            Some((_, tie)) if tie.rotation().is_some() => Cow::Owned(housing.matrices.clone().for_tie(tie)),
            _ => Cow::Borrowed(&housing.matrices),
        }
    }

    /// What sits on the interface.
    pub fn attached(&self) -> Option<Attached<'_>> {
        match self {
            Self::Rings(bodies) => Some(Attached { stiffness: bodies.0.stiffness(), mass: bodies.0.mass() }),
            Self::Both(both) => Some(both.attached()),
            Self::Nodes(_) | Self::Centres(_) => None,
        }
    }

    /// Rings and tie, if that is what it is.
    pub(crate) fn rings(&self) -> Option<(&Rings, &RingTie)> {
        match self {
            Self::Rings(bodies) => Some((&bodies.0, &bodies.1)),
            Self::Both(both) => Some((&both.rings, &both.tie)),
            Self::Nodes(_) | Self::Centres(_) => None,
        }
    }
}

/// A bore in its ring's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BoreExtent {
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

impl BoreExtent {
    /// The bore with this group in the frame of its ring.
    ///
    /// # Errors
    /// [`ComputeError::Model`] if the mesh lacks it.
    pub(crate) fn of(mesh: &Mesh, model: &HousingModel, frame: &RingFrame, group: &str) -> Result<Self, ComputeError> {
        let group = model.group_on_housing(mesh, group, "the tie")?;
        let nodes = group.nodes.iter().filter(|&&node| model.used[node]);
        let places: Vec<[f64; 3]> = nodes.map(|&node| frame.point(model.coordinates()[node])).collect();
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
