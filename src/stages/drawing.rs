//! The picture of the model: mesh, ring, supports, balls, dents, sensors.

use super::{HousingStage, StructureStage};
use crate::case::{Case, SensorSpot};
use crate::element::plane::PlaneKind;
use crate::report::{Circle, Dent, Drawing, Point, Ring, Sensor, Spring};
use crate::system::BearingSetup;
use std::collections::BTreeSet;
use std::f64::consts::{FRAC_PI_2, PI};

/// Draws a structure, and the bearing in it if there is one.
pub(super) fn draw(case: &Case, stage: &StructureStage, setup: Option<&BearingSetup>) -> Drawing {
    let ring = stage.structure.ring();
    let centre = Point { x: 0.0, y: 0.0 };
    let radius = ring.section().radius;
    let mut drawing = Drawing {
        title: "Model".to_owned(),
        caption: Some("Drawn to scale; springs and sensors are symbols.".to_owned()),
        ring: Some(Ring {
            circle: Circle { centre, radius },
            nodes: (0..ring.nodes())
                .map(|node| centre.polar(radius, ring.node_angle(node)))
                .collect(),
        }),
        ..Drawing::default()
    };
    if let Some(housing) = &stage.housing {
        add_housing(&mut drawing, housing);
    }
    add_ring_springs(&mut drawing, case, stage);
    if let Some(setup) = setup {
        add_bearing(&mut drawing, case, setup);
    }
    add_sensors(&mut drawing, case, stage);
    drawing
}

/// Draws a housing by itself.
pub(super) fn draw_housing(housing: &HousingStage) -> Drawing {
    let mut drawing = Drawing {
        title: "Model".to_owned(),
        ..Drawing::default()
    };
    add_housing(&mut drawing, housing);
    drawing
}

fn add_housing(drawing: &mut Drawing, housing: &HousingStage) {
    let point = |node: usize| {
        let [x, y] = housing.model.coordinates()[node];
        Point { x, y }
    };
    let mut drawn = BTreeSet::new();
    for element in housing.model.elements() {
        for edge in edges(element.kind) {
            let nodes: Vec<usize> = edge.iter().map(|&local| element.nodes[local]).collect();
            let ends = [nodes[0], nodes[nodes.len() - 1]];
            if drawn.insert([ends[0].min(ends[1]), ends[0].max(ends[1])]) {
                drawing
                    .mesh_edges
                    .push(nodes.into_iter().map(point).collect());
            }
        }
    }
    for node in housing.model.spring_nodes() {
        let at = point(node);
        drawing.springs.push(Spring {
            at,
            towards_rad: at.y.atan2(at.x),
        });
    }
}

/// Local nodes along every edge of an element, middle node included, in gmsh's order.
fn edges(kind: PlaneKind) -> &'static [&'static [usize]] {
    match kind {
        PlaneKind::Tri3 => &[&[0, 1], &[1, 2], &[2, 0]],
        PlaneKind::Quad4 => &[&[0, 1], &[1, 2], &[2, 3], &[3, 0]],
        PlaneKind::Tri6 => &[&[0, 3, 1], &[1, 4, 2], &[2, 5, 0]],
        PlaneKind::Quad8 => &[&[0, 4, 1], &[1, 5, 2], &[2, 6, 3], &[3, 7, 0]],
    }
}

fn add_ring_springs(drawing: &mut Drawing, case: &Case, stage: &StructureStage) {
    let ring = stage.structure.ring();
    for support in case.ring.iter().flat_map(|ring| &ring.supports) {
        let (from, to) = (support.from_deg, support.to_deg);
        for node in 0..ring.nodes() {
            let angle = ring.node_angle(node);
            let past = (angle.to_degrees() - from + 1e-6).rem_euclid(360.0) - 1e-6;
            if past < to - from - 1e-6 {
                let radius = ring.section().radius + support.offset;
                drawing.springs.push(Spring {
                    at: Point { x: 0.0, y: 0.0 }.polar(radius, angle),
                    towards_rad: angle,
                });
            }
        }
    }
}

fn add_bearing(drawing: &mut Drawing, case: &Case, setup: &BearingSetup) {
    let centre = Point { x: 0.0, y: 0.0 };
    let geometry = &setup.geometry;
    let race = Circle {
        centre,
        radius: geometry.outer_race_radius(),
    };
    drawing.races = vec![
        Circle {
            centre,
            radius: geometry.effective_inner_race_radius(),
        },
        race,
    ];
    let start = case
        .transient
        .as_ref()
        .map_or(0.0, |transient| transient.start);
    let cage = setup.cage.motion(setup.speed.motion(start));
    for ball in 0..geometry.balls() {
        let angle = setup.cage.ball_angle(cage.angle, ball);
        drawing.balls.push(Circle {
            centre: centre.polar(geometry.pitch_radius(), angle),
            radius: geometry.ball_radius(),
        });
    }
    for dent in &setup.dents {
        let shape = dent.shape();
        drawing.dents.push(Dent {
            race,
            angle_rad: shape.angle,
            length: shape.length,
            label: format!(
                "dent {:.2} mm long, {:.0} \u{b5}m deep",
                shape.length * 1e3,
                shape.depth * 1e6
            ),
        });
    }
}

fn add_sensors(drawing: &mut Drawing, case: &Case, stage: &StructureStage) {
    let origin = Point { x: 0.0, y: 0.0 };
    for sensor in &case.sensors {
        let at = match &sensor.spot {
            SensorSpot::RingDeg(degrees) => Some(origin.polar(
                stage.structure.ring().section().radius,
                degrees.to_radians(),
            )),
            SensorSpot::Point([x, y, _]) => {
                let centre = case.ring.as_ref().and_then(|ring| ring.tie.as_ref());
                let [cx, cy, _] = centre.map_or([0.0; 3], |tie| tie.centre);
                Some(Point {
                    x: x - cx,
                    y: y - cy,
                })
            }
            SensorSpot::Group(group) => stage.housing.as_ref().and_then(|housing| {
                let nodes = &housing.mesh.group(group).ok()?.nodes;
                let mean = |k: usize| {
                    let sum: f64 = nodes
                        .iter()
                        .map(|&n| housing.model.coordinates()[n][k])
                        .sum();
                    sum / nodes.len() as f64
                };
                Some(Point {
                    x: mean(0),
                    y: mean(1),
                })
            }),
        };
        let [x, y, _] = sensor.direction;
        let direction_rad = if x == 0.0 && y == 0.0 {
            FRAC_PI_2
        } else {
            y.atan2(x)
        };
        if let Some(at) = at {
            drawing.sensors.push(Sensor {
                name: sensor.name.clone(),
                at,
                direction_rad: direction_rad.rem_euclid(2.0 * PI),
            });
        }
    }
}
