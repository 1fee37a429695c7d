//! Places on housing and ring where something is measured or pushed, as rows over the coordinates of either.
//!
//! Names of all degrees of freedom of housing and ring, in the order of the matrices before anything is left out.

use super::housing::AssembledHousing;
use super::ring::{Boundary, metres};
use crate::app::case::{Push, Sensor, SensorSpot};
use crate::app::error::ComputeError;
use crate::fe::assembly::CoupledMatrices;
use crate::fe::mesh::BoundingBox;
use crate::fe::model::{HousingModel, RingSeat, RingTie, Rings};
use crate::fe::reduction::CraigBampton;
use crate::formats::{DofBody, DofDirection, DofLabel};
use crate::numerics::Brief;
use std::collections::BTreeSet;
use std::fmt;

/// Farthest that a node may be from a point, relative to the housing's size.
const TOLERANCE: f64 = 0.02;

/// Share of a direction that is round-off.
const NOTHING: f64 = 1e-12;

/// Part of a unit vector across a plane that numbers with six digits may leave.
const ACROSS: f64 = 1e-6;

/// A sensor or a force of a case: its name, where it is, and its direction in the axes of the mesh, of any length.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spot<'a> {
    /// "sensor" or "force".
    kind: &'static str,
    pub name: &'a str,
    pub at: &'a SensorSpot,
    /// Label of the bearing whose ring it is on, where there are several.
    bearing: Option<&'a str>,
    direction: [f64; 3],
}

impl<'a> From<&'a Sensor> for Spot<'a> {
    fn from(Sensor { name, spot, bearing, direction }: &'a Sensor) -> Self {
        Self { kind: "sensor", name, at: spot, bearing: bearing.as_deref(), direction: *direction }
    }
}

impl<'a> From<&'a Push> for Spot<'a> {
    fn from(Push { name, spot, bearing, direction }: &'a Push) -> Self {
        Self { kind: "force", name, at: spot, bearing: bearing.as_deref(), direction: *direction }
    }
}

/// As messages call it.
impl fmt::Display for Spot<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} \"{}\"", self.kind, self.name)
    }
}

/// A displacement component at a place: pairs (degree of freedom, factor).
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Place {
    /// Over the housing, in the displacements that the partition uses.
    Housing(Vec<(usize, f64)>),
    /// Over the rings.
    Ring(Vec<(usize, f64)>),
}

/// The bodies of a case that a place may be on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlaceBodies<'a> {
    pub housing: Option<&'a AssembledHousing>,
    pub rings: Option<&'a Rings>,
    pub tie: Option<&'a RingTie>,
}

impl<'a> PlaceBodies<'a> {
    /// Rings, and nothing else.
    pub(crate) fn of_rings(rings: &'a Rings) -> Self {
        Self { housing: None, rings: Some(rings), tie: None }
    }
}

impl Place {
    /// A place: the mean of a group, the node nearest to a point, a node, or an angle on the ring, along a direction.
    ///
    /// # Errors
    /// [`ComputeError`] for a place that is not there or cannot move, and a direction across the plane of a plane model; each names the
    /// sensor or force.
    pub(crate) fn new(bodies: PlaceBodies<'_>, spot: Spot<'_>) -> Result<Self, ComputeError> {
        let needs_housing = |place: String| {
            ComputeError::wrong(format!(
                "{spot} stands on {place}, but the case has no housing: use ring_deg for a place on the ring"
            ))
        };
        let (nodes, housing) = match (spot.at, bodies.housing) {
            (SensorSpot::RingDeg(degrees), _) => {
                let rings = bodies.rings.ok_or_else(|| {
                    ComputeError::wrong(format!(
                        "{spot} stands on the ring, but no ring is attached here: give group, node or point"
                    ))
                })?;
                let seat = ring_of(rings, spot)?;
                let direction = unit(seat.frame.vector(spot.direction));
                if !rings.are_in_space() {
                    in_plane(spot, direction)?;
                }
                let row = seat.ring.displacement_row(degrees.to_radians(), direction).into_iter();
                return Ok(Self::Ring(row.map(|(dof, factor)| (seat.range().start + dof, factor)).collect()));
            }
            (SensorSpot::Recovered(row), _) => return Err(needs_housing(format!("row \"{row}\" of a superelement"))),
            (_, Some(housing)) => (nodes_at(housing, spot)?, housing),
            (SensorSpot::Group(group), None) => return Err(needs_housing(format!("group \"{group}\""))),
            (SensorSpot::Point(_), None) => return Err(needs_housing("a point of the mesh".to_owned())),
            (SensorSpot::Node(tag), None) => return Err(needs_housing(format!("node {tag} of the mesh"))),
        };
        let direction = match housing.model.dimension() {
            2 => in_plane(spot, unit(spot.direction))?,
            _ => unit(spot.direction),
        };
        let share = 1.0 / nodes.len() as f64;
        let entries = nodes
            .iter()
            .flat_map(|&node| match bodies.tie {
                Some(tie) => tie.displacement_row(&housing.model, node, direction),
                None => housing.model.displacement_row(node, direction),
            })
            .map(|(dof, factor)| (dof, share * factor));
        let entries: Vec<(usize, f64)> = entries.collect();
        check_moves(housing, spot, &entries)?;
        Ok(Self::Housing(entries))
    }

    /// The row over the coordinates of a condensed housing \[order\], of which the interface are the rings if there are
    /// any.
    pub(crate) fn reduced(&self, condensed: &CraigBampton) -> Vec<f64> {
        match self {
            Self::Ring(_) => self.on_rings(condensed.superelement.order()),
            Self::Housing(entries) => {
                let parts = entries.iter().flat_map(|&(dof, factor)| {
                    // a fixed degree of freedom does not move: no row
                    let row = condensed.recovery_row(dof).into_iter().flatten();
                    row.enumerate().map(move |(place, part)| (place, factor * part))
                });
                row(condensed.superelement.order(), parts)
            }
        }
    }

    /// The row over the housing's degrees of freedom \[dof\]; zero for a place on the ring.
    pub(crate) fn on_housing(&self, dof: usize) -> Vec<f64> {
        match self {
            Self::Housing(entries) => row(dof, entries.iter().copied()),
            Self::Ring(_) => vec![0.0; dof],
        }
    }

    /// The row over the coordinates of housing and rings in full: what the tie drives moves with its ring.
    pub(crate) fn full(&self, boundary: &Boundary, matrices: &CoupledMatrices) -> Vec<f64> {
        let drives = !matches!(boundary, Boundary::Nodes(_));
        let length = matrices.mass.rows();
        let first = length - if drives { boundary.partition().tie.cols() } else { 0 };
        let partition = boundary.partition();
        let of_housing = |&(dof, factor): &(usize, f64)| {
            let driven = partition.driven.iter().position(|&at| at == dof).filter(|_| drives);
            let Some(place) = driven else {
                return vec![(dof, factor)];
            };
            let columns = partition.tie.outer_iterator().enumerate();
            columns
                .map(|(column, entries)| (first + column, factor * entries.get(place).copied().unwrap_or(0.0)))
                .collect()
        };
        match self {
            Self::Ring(entries) => row(length, entries.iter().map(|&(dof, factor)| (first + dof, factor))),
            Self::Housing(entries) => row(length, entries.iter().flat_map(of_housing)),
        }
    }

    /// The row over so many coordinates of which the rings' come first; zero for a place on the housing.
    pub(crate) fn on_rings(&self, order: usize) -> Vec<f64> {
        match self {
            Self::Ring(entries) => row(order, entries.iter().copied()),
            Self::Housing(_) => vec![0.0; order],
        }
    }
}

/// The ring that a place is on.
///
/// # Errors
/// [`ComputeError`] for a label that no bearing has, and for none where there are several.
fn ring_of<'r>(rings: &'r Rings, spot: Spot<'_>) -> Result<&'r RingSeat, ComputeError> {
    let seats = rings.seats();
    let labels = || seats.iter().map(|seat| format!("\"{}\"", seat.label)).collect::<Vec<_>>().join(", ");
    match (spot.bearing, seats) {
        (None, [only]) => Ok(only),
        (None, _) => Err(ComputeError::wrong(format!(
            "{spot} stands on a ring, and the case has several: add bearing = LABEL, one of {}",
            labels()
        ))),
        (Some(label), _) => seats.iter().find(|seat| seat.label == label).ok_or_else(|| {
            let expected = if seats.len() > 1 { format!("one of {}", labels()) } else { "no key `bearing`".to_owned() };
            ComputeError::wrong(format!("{spot}: found bearing = \"{label}\", expected {expected}"))
        }),
    }
}

/// Sums of pairs (place, factor) over so many places.
fn row(length: usize, entries: impl Iterator<Item = (usize, f64)>) -> Vec<f64> {
    let mut row = vec![0.0; length];
    for (place, factor) in entries {
        row[place] += factor;
    }
    row
}

fn unit([x, y, z]: [f64; 3]) -> [f64; 3] {
    let length = (x * x + y * y + z * z).sqrt();
    [x / length, y / length, z / length]
}

/// A unit vector that lies in the plane.
fn in_plane(spot: Spot<'_>, [x, y, across]: [f64; 3]) -> Result<[f64; 3], ComputeError> {
    if across.abs() > ACROSS {
        let across = (across * 1e6).round() / 1e6;
        return Err(ComputeError::wrong(format!(
            "{spot}: direction has a part across the bearing's plane, {across}: a plane model moves in its plane alone; give direction = [0, 1, 0] or the like"
        )));
    }
    Ok([x, y, 0.0])
}

/// Something in a place's row can move.
fn check_moves(housing: &AssembledHousing, spot: Spot<'_>, entries: &[(usize, f64)]) -> Result<(), ComputeError> {
    let model = &housing.model;
    let d = model.dimension();
    let moving = entries.iter().filter(|(_, factor)| factor.abs() > NOTHING);
    // none of a row of which anything is free
    let holders: Option<Vec<usize>> = moving.map(|&(dof, _)| model.fixed[dof / d][dof % d]).collect();
    match holders.and_then(|holders| holders.last().copied()) {
        None => Ok(()),
        Some(support) => Err(ComputeError::wrong(format!(
            "{spot} stands where the support \"{}\" holds the housing in its direction, so that it measures zero: expected a place that moves; give another place or direction, or another support",
            model.description.supports[support].group
        ))),
    }
}

/// Nodes of the mesh at a place; none at one on the ring.
///
/// # Errors
/// [`ComputeError`] for a place that is not there.
pub(crate) fn nodes_at(housing: &AssembledHousing, spot: Spot<'_>) -> Result<Vec<usize>, ComputeError> {
    let model = &housing.model;
    let used = |node: &usize| model.used[*node];
    match spot.at {
        SensorSpot::Group(group) => {
            let group = model.group_on_housing(&housing.mesh, group, "the sensor")?;
            Ok(group.nodes.iter().copied().filter(used).collect())
        }
        SensorSpot::Point(point) => Ok(vec![nearest_node(housing, spot, point)?]),
        SensorSpot::Node(tag) => {
            let place = model.node_tags.iter().position(|found| found == tag);
            let missing = if place.is_some() { "no element of the housing has node" } else { "the mesh has no node" };
            let node = place.filter(used);
            Ok(vec![node.ok_or_else(|| ComputeError::wrong(format!("{spot}: {missing} {tag}")))?])
        }
        SensorSpot::RingDeg(_) | SensorSpot::Recovered(_) => Ok(Vec::new()),
    }
}

fn nearest_node(housing: &AssembledHousing, spot: Spot<'_>, point: &[f64; 3]) -> Result<usize, ComputeError> {
    let across = housing.model.dimension() == 3;
    let distance = |node: &[f64; 3]| {
        let plane = (node[0] - point[0]).hypot(node[1] - point[1]);
        if across { plane.hypot(node[2] - point[2]) } else { plane }
    };
    let bounds = BoundingBox::of(housing.mesh.nodes.iter().copied()).extent();
    let nodes = housing.mesh.nodes.iter().enumerate();
    let mut found: Option<(usize, f64)> = None;
    for (index, node) in nodes.filter(|(index, _)| housing.model.used[*index]) {
        let nearer = |away: f64| found.is_none_or(|(_, least)| away < least);
        // what is too far along x alone need not be measured
        if nearer((node[0] - point[0]).abs()) {
            let away = distance(node);
            if nearer(away) {
                found = Some((index, away));
            }
        }
    }
    let missed = |distance: f64| {
        let [x, y, z] = point.map(Brief);
        ComputeError::wrong(format!(
            "{spot}: the nearest node of the housing to ({x}, {y}, {z}) m is {} away; give a point on the mesh, in metres",
            metres(distance)
        ))
    };
    let (index, away) = found.ok_or_else(|| missed(f64::INFINITY))?;
    if away <= TOLERANCE * bounds[0].hypot(bounds[1]).hypot(bounds[2]) { Ok(index) } else { Err(missed(away)) }
}

/// Labels of a housing's degrees of freedom; those of a sliding tie's bore are in polar axes.
pub(crate) fn of_housing(model: &HousingModel, tie: Option<&RingTie>) -> Vec<DofLabel> {
    let d = model.dimension();
    // a sliding tie turns all components of its bore's nodes
    let sliding = tie.filter(|tie| tie.rotation().is_some());
    let bore: BTreeSet<usize> = sliding.iter().flat_map(|tie| &tie.partition().driven).map(|dof| dof / d).collect();
    let nodes = model.coordinates().iter().zip(&model.node_tags).enumerate();
    let labels = nodes.flat_map(|(index, (&position, &node))| {
        let polar = bore.contains(&index);
        let axes = match polar {
            true => model.frame().polar_axes(position),
            false => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        };
        (0..d).map(move |component| DofLabel {
            body: DofBody::Housing,
            node,
            direction: match polar {
                true => DofDirection::Polar(component),
                false => DofDirection::Along(component),
            },
            position,
            axis: axes[component],
        })
    });
    labels.collect()
}

/// Labels of the displacements of all rings, whose nodes are counted on from ring to ring.
pub(crate) fn of_rings(rings: &Rings) -> Vec<DofLabel> {
    let mut first_node = 0;
    let of_seat = |seat: &RingSeat| {
        let labels = of_ring(first_node, seat);
        first_node += seat.ring.nodes();
        labels
    };
    rings.seats().iter().flat_map(of_seat).collect()
}

/// In the order of a ring's displacements: those in its plane, then those out of it.
fn of_ring(first_node: usize, RingSeat { ring, frame, .. }: &RingSeat) -> Vec<DofLabel> {
    use DofDirection::{About, Along};
    let in_plane = [(Along(0), 0), (Along(1), 1), (About(2), 2)];
    let out_of_plane = [(Along(2), 2), (About(0), 0), (About(1), 1)];
    let blocks = if ring.is_in_space() { vec![in_plane, out_of_plane] } else { vec![in_plane] };
    let mut labels = Vec::with_capacity(ring.dof());
    for block in blocks {
        for node in 0..ring.nodes() {
            for (direction, axis) in block {
                let mut unit = [0.0; 3];
                unit[axis] = 1.0;
                labels.push(DofLabel {
                    body: DofBody::Ring,
                    node: (first_node + node) as u64,
                    direction,
                    position: frame.point_to_mesh(ring.node_position(node)),
                    axis: frame.vector_to_mesh(unit),
                });
            }
        }
    }
    labels
}
