//! Ring and condensed housing of a case in one structure, with its sensors and modes.

use super::condensed::{Boundary, CondensedStage};
use super::housing::material;
use super::{HousingStage, StageError, Watch};
use crate::case::{self, Case, Interface, SensorSpot};
use crate::element::curved_beam::RingInterpolation;
use crate::material::{BeamSection, Bond, RadiusRule, RingLayer};
use crate::model::{Fit, Ring, RingFrame, RingSupport, RingTie, SpringShare};
use crate::reduction::CraigBampton;
use crate::system::{Sensor, Structure, StructureModes};

/// Farthest that a node may be from a sensor's point, relative to the housing's size.
const SENSOR_TOLERANCE: f64 = 0.02;

/// The linear model of a case.
#[derive(Debug, Clone)]
pub struct StructureStage {
    /// The housing, if the case has one.
    pub housing: Option<HousingStage>,
    /// How the ring sits in the housing, if there is one.
    pub tie: Option<RingTie>,
    /// Number of vectors of the condensed housing's interior.
    pub fixed_interface_modes: usize,
    /// Ring and housing with the case's sensors.
    pub structure: Structure,
    /// All its modes.
    pub modes: StructureModes,
}

impl StructureStage {
    /// Builds ring and housing of a case; `None` without a ring.
    ///
    /// # Errors
    /// [`StageError`] of the stages that it goes through.
    pub fn build(case: &Case, watch: &impl Watch) -> Result<Option<Self>, StageError> {
        let Some(asked) = &case.ring else {
            return Ok(None);
        };
        let gravity = case
            .shaft
            .as_ref()
            .map_or([0.0, -9.81], |shaft| shaft.gravity);
        if case.condense.interface != Interface::Ring {
            return Err(StageError::InterfaceOfRing);
        }
        let Some(stage) = CondensedStage::build(case, watch)? else {
            let ring = ring(case, asked, false)?;
            let mut structure = Structure::ring_alone(ring, gravity);
            for sensor in &case.sensors {
                let sensor = ring_sensor(&structure, sensor, &RingFrame::default())?;
                structure.add_sensor(sensor)?;
            }
            return Self::solved(structure, None, watch).map(Some);
        };
        let Boundary::Ring(bodies) = stage.boundary else {
            return Err(StageError::InterfaceOfRing);
        };
        let (ring, tie) = *bodies;
        let CondensedStage {
            housing, condensed, ..
        } = stage;
        let mut structure = Structure::with_housing(ring, &condensed.superelement, gravity)?;
        for sensor in &case.sensors {
            let sensor = housing_sensor(&structure, &housing, &tie, &condensed, sensor)?;
            structure.add_sensor(sensor)?;
        }
        let housing = (housing, tie, condensed.basis.count());
        Self::solved(structure, Some(housing), watch).map(Some)
    }

    fn solved(
        structure: Structure,
        housing: Option<(HousingStage, RingTie, usize)>,
        watch: &impl Watch,
    ) -> Result<Self, StageError> {
        watch.stage("eigen");
        let modes = structure.modes()?;
        let (housing, tie, fixed_interface_modes) = match housing {
            Some((housing, tie, count)) => (Some(housing), Some(tie), count),
            None => (None, None, 0),
        };
        Ok(Self {
            housing,
            tie,
            fixed_interface_modes,
            structure,
            modes,
        })
    }
}

/// The ring of a case, and how it sits in its housing if it does.
///
/// # Errors
/// [`StageError`] of the ring and of the tie.
pub(super) fn ring_and_tie(
    case: &Case,
    asked: &case::Ring,
    housing: Option<&HousingStage>,
) -> Result<(Ring, Option<RingTie>), StageError> {
    let in_space = housing.is_some_and(|housing| housing.model.dimension() == 3);
    let ring = ring(case, asked, in_space)?;
    let (Some(housing), Some(tie)) = (housing, &asked.tie) else {
        return Ok((ring, None));
    };
    let fit = match tie.fit {
        case::Fit::Bonded => Fit::Bonded,
        case::Fit::Sliding => Fit::Sliding,
    };
    // a tie without an outer radius was refused with the case
    let outer = asked.outer_radius.unwrap_or(f64::NAN);
    let tie = RingTie::new(&housing.mesh, &housing.model, &tie.group, &ring, outer, fit)?;
    Ok((ring, Some(tie)))
}

/// The ring of a case with its supports; in space for a solid housing.
pub(super) fn ring(case: &Case, asked: &case::Ring, in_space: bool) -> Result<Ring, StageError> {
    let layers = asked
        .sections
        .iter()
        .map(|section| {
            Ok(RingLayer {
                material: material(case, &section.material)?,
                area: section.area,
                inertia: section.inertia,
                axial_inertia: section.axial_inertia,
                torsion: section.torsion,
                radius: section.radius,
                shear_coefficient: section.shear_coefficient,
            })
        })
        .collect::<Result<Vec<_>, StageError>>()?;
    let bond = match (asked.bond, asked.radius_rule) {
        (case::Bond::Composite, _) => Bond::Composite,
        (case::Bond::Slip, case::RadiusRule::Own) => Bond::Slip(RadiusRule::Own),
        (case::Bond::Slip, case::RadiusRule::CommonCentroid) => {
            Bond::Slip(RadiusRule::CommonCentroid)
        }
    };
    let mut section = BeamSection::combine(&layers, bond)?;
    if !asked.shear {
        section = section.without_shear();
    }
    if !asked.rotary_inertia {
        section = section.without_rotary_inertia();
    }
    let interpolation = match asked.element {
        case::RingElement::ExactArc => RingInterpolation::ExactArc,
        case::RingElement::Raveendranath => RingInterpolation::Raveendranath,
    };
    let mut ring = if in_space {
        Ring::in_space(asked.nodes, section, interpolation)?
    } else {
        Ring::new(asked.nodes, section, interpolation)?
    };
    for support in &asked.supports {
        ring.add_support(&RingSupport {
            from: support.from_deg.to_radians(),
            to: support.to_deg.to_radians(),
            spring: [support.spring.x, support.spring.y, support.spring.z],
            share: match support.per {
                case::PerNodeOrTotal::Node => SpringShare::PerNode,
                case::PerNodeOrTotal::Total => SpringShare::Total,
            },
            offset: support.offset,
        })?;
    }
    Ok(ring)
}

/// Unit vector of a sensor's direction, of which `frame` keeps a part in its plane.
fn in_plane(sensor: &case::Sensor, frame: &RingFrame) -> Result<[f64; 2], StageError> {
    let [x, y, z] = frame.vector(sensor.direction);
    let length = (x * x + y * y + z * z).sqrt();
    if x.hypot(y) > 1e-9 * length {
        Ok([x / length, y / length])
    } else {
        Err(StageError::SensorDirection {
            name: sensor.name.clone(),
        })
    }
}

fn ring_sensor(
    structure: &Structure,
    sensor: &case::Sensor,
    frame: &RingFrame,
) -> Result<Sensor, StageError> {
    let direction = in_plane(sensor, frame)?;
    match &sensor.spot {
        SensorSpot::RingDeg(degrees) => {
            Ok(structure.ring_sensor(&sensor.name, degrees.to_radians(), direction))
        }
        SensorSpot::Group(group) => Err(StageError::SensorNeedsHousing {
            name: sensor.name.clone(),
            place: format!("group \"{group}\""),
        }),
        SensorSpot::Point(_) => Err(StageError::SensorNeedsHousing {
            name: sensor.name.clone(),
            place: "a point of the mesh".to_owned(),
        }),
    }
}

/// A sensor on housing nodes: the mean of a group, or the node nearest to a point.
fn housing_sensor(
    structure: &Structure,
    housing: &HousingStage,
    tie: &RingTie,
    condensed: &CraigBampton,
    sensor: &case::Sensor,
) -> Result<Sensor, StageError> {
    let nodes = match &sensor.spot {
        SensorSpot::RingDeg(_) => return ring_sensor(structure, sensor, housing.model.frame()),
        SensorSpot::Group(group) => housing
            .model
            .group_on_housing(&housing.mesh, group, "the sensor")?
            .nodes
            .iter()
            .copied()
            .filter(|&node| housing.model.is_used(node))
            .collect(),
        SensorSpot::Point(point) => vec![nearest_node(housing, &sensor.name, point)?],
    };
    let [x, y, z] = sensor.direction;
    let direction = match housing.model.dimension() {
        2 => {
            in_plane(sensor, &RingFrame::default())?;
            let length = (x * x + y * y + z * z).sqrt();
            [x / length, y / length, 0.0]
        }
        _ => {
            let length = (x * x + y * y + z * z).sqrt();
            sensor.direction.map(|part| part / length)
        }
    };
    let mut row = vec![0.0; structure.dof()];
    for &node in &nodes {
        for (dof, factor) in tie.displacement_row(&housing.model, node, direction) {
            // a fixed degree of freedom does not move: no row
            for (place, part) in condensed
                .recovery_row(dof)
                .into_iter()
                .flatten()
                .enumerate()
            {
                row[place] += factor * part / nodes.len() as f64;
            }
        }
    }
    Ok(Sensor {
        name: sensor.name.clone(),
        row,
    })
}

fn nearest_node(housing: &HousingStage, name: &str, point: &[f64; 3]) -> Result<usize, StageError> {
    let across = housing.model.dimension() == 3;
    let distance = |node: &[f64; 3]| {
        let plane = (node[0] - point[0]).hypot(node[1] - point[1]);
        if across {
            plane.hypot(node[2] - point[2])
        } else {
            plane
        }
    };
    let bounds = housing.mesh.inventory().bounding_box.extent();
    let nodes = housing.mesh.nodes.iter().enumerate();
    let on_housing = nodes.filter(|(index, _)| housing.model.is_used(*index));
    let found = on_housing.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
    let missed = |distance| StageError::SensorPlace {
        name: name.to_owned(),
        point: *point,
        distance,
    };
    let (index, node) = found.ok_or_else(|| missed(f64::INFINITY))?;
    if distance(node) <= SENSOR_TOLERANCE * bounds[0].hypot(bounds[1]).hypot(bounds[2]) {
        Ok(index)
    } else {
        Err(missed(distance(node)))
    }
}
