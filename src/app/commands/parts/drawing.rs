//! The picture of the model: mesh, ring, supports, balls, dents, sensors.

use crate::app::case::{Case, SensorSpot};
use crate::app::scene::RingsInHousing;
use crate::bearing::Race;
use crate::bearing::defect::{DentShape, RaceDefect};
use crate::fe::mesh::Mesh;
use crate::fe::model::{HousingModel, RingSeat};
use crate::report::{Circle, Dent, Drawing, Point, Ring, Sensor, Spring};
use crate::system::BearingSetup;
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

/// Angle between two faces (rad) from which on their common edge is drawn: chords of a bore of 16 faces meet at 22
/// degrees.
const SHARP: f64 = 0.45;

/// Draws ring and housing, and the bearing in it if there is one.
pub(crate) fn draw(case: &Case, bodies: &RingsInHousing, setup: Option<&BearingSetup>) -> Drawing {
    let several = bodies.rings.seats().len() > 1;
    let plane = if several { "the first bearing" } else { "the bearing" };
    let mut drawing = Drawing {
        title: "Model".to_owned(),
        caption: Some(format!(
            "The model in the plane of {plane}, to scale; springs and sensors are symbols. Defects are red."
        )),
        rings: bodies.rings.seats().iter().map(|seat| ring_of(bodies, seat)).collect(),
        ..Drawing::default()
    };
    if let Some(housing) = &bodies.housing {
        add_housing(&mut drawing, &housing.mesh, &housing.model);
    }
    add_ring_springs(&mut drawing, case, bodies);
    if let Some(setup) = setup {
        add_bearing(&mut drawing, case, setup);
    }
    add_sensors(&mut drawing, case, bodies);
    drawing
}

/// Centre of a ring in the plane of the first.
fn centre_of(bodies: &RingsInHousing, seat: &RingSeat) -> Point {
    let [x, y, _] = bodies.frame().point(seat.frame.centre());
    Point { x, y }
}

/// A ring in the plane of the first.
fn ring_of(bodies: &RingsInHousing, seat: &RingSeat) -> Ring {
    let (centre, radius) = (centre_of(bodies, seat), seat.ring.section().radius);
    let nodes = (0..seat.ring.nodes()).map(|node| {
        let [x, y, _] = bodies.frame().point(seat.frame.point_to_mesh(seat.ring.node_position(node)));
        Point { x, y }
    });
    Ring { circle: Circle { centre, radius }, nodes: nodes.collect() }
}

fn point(model: &HousingModel, node: usize) -> Point {
    let [x, y, _] = model.ring_coordinates(node);
    Point { x, y }
}

fn add_housing(drawing: &mut Drawing, mesh: &Mesh, model: &HousingModel) {
    let edges = match model.dimension() {
        2 => element_edges(mesh),
        _ => feature_edges(mesh),
    };
    for edge in edges {
        // gmsh's order: two ends, then the middle node if there is one
        let along = match edge.as_slice() {
            [first, last, middle] => vec![*first, *middle, *last],
            ends => ends.to_vec(),
        };
        let line = along.into_iter().map(|node| point(model, node)).collect();
        drawing.mesh_edges.push(line);
    }
    for node in model.spring_nodes() {
        let at = point(model, node);
        drawing.springs.push(Spring { at, towards_rad: at.y.atan2(at.x) });
    }
}

/// Every edge of a plane housing once.
fn element_edges(mesh: &Mesh) -> Vec<Vec<usize>> {
    let mut drawn = BTreeSet::new();
    let mut edges = Vec::new();
    for id in mesh.element_ids(2) {
        let block = &mesh.blocks[id.block];
        let nodes = block.element(id.index).unwrap_or_default();
        for face in block.kind.faces() {
            let edge: Vec<usize> = face.nodes.iter().map(|&local| nodes[local]).collect();
            if drawn.insert([edge[0].min(edge[1]), edge[0].max(edge[1])]) {
                edges.push(edge);
            }
        }
    }
    edges
}

/// Edges between faces of a solid housing's surface that meet at an angle, as a draughtsman draws them; hidden ones too.
fn feature_edges(mesh: &Mesh) -> Vec<Vec<usize>> {
    // nodes of an edge, and the normals of the faces that meet there
    type Meeting = (Vec<usize>, Vec<Vector3<f64>>);
    let mut meeting: BTreeMap<[usize; 2], Meeting> = BTreeMap::new();
    for face in mesh.boundary_faces(mesh.element_ids(3)) {
        let corner = |k: usize| Vector3::from(mesh.nodes[face.nodes[k]]);
        let normal = (corner(1) - corner(0)).cross(&(corner(2) - corner(0)));
        let normal = normal.try_normalize(0.0).unwrap_or_default();
        for side in face.kind.faces() {
            let edge: Vec<usize> = side.nodes.iter().map(|&local| face.nodes[local]).collect();
            let ends = [edge[0].min(edge[1]), edge[0].max(edge[1])];
            let entry = meeting.entry(ends).or_insert_with(|| (edge, Vec::new()));
            entry.1.push(normal);
        }
    }
    let sharp = |normals: &[Vector3<f64>]| match normals {
        [a, b] => a.dot(b) < SHARP.cos(),
        _ => true,
    };
    let edges = meeting.into_values().filter(|(_, normals)| sharp(normals));
    edges.map(|(edge, _)| edge).collect()
}

fn add_ring_springs(drawing: &mut Drawing, case: &Case, bodies: &RingsInHousing) {
    for (seat, asked) in bodies.rings.seats().iter().zip(case.seats()) {
        let (ring, centre) = (&seat.ring, centre_of(bodies, seat));
        for support in &asked.ring.supports {
            let (from, to) = (support.from_deg, support.to_deg);
            for node in 0..ring.nodes() {
                let angle = ring.node_angle(node);
                let past = (angle.to_degrees() - from + 1e-6).rem_euclid(360.0) - 1e-6;
                if past < to - from - 1e-6 {
                    let radius = ring.section().radius + support.offset;
                    drawing.springs.push(Spring { at: centre.polar(radius, angle), towards_rad: angle });
                }
            }
        }
    }
}

fn add_bearing(drawing: &mut Drawing, case: &Case, setup: &BearingSetup) {
    let centre = Point { x: 0.0, y: 0.0 };
    let geometry = &setup.geometry;
    let circle = |race: Race| Circle {
        centre,
        radius: match race {
            Race::Inner => geometry.effective_inner_race_radius(),
            Race::Outer => geometry.outer_race_radius(),
        },
    };
    drawing.races = vec![circle(Race::Inner), circle(Race::Outer)];
    let start = case.transient.as_ref().map_or(0.0, |transient| transient.start);
    let shaft_angle = setup.cage.shaft().angle(start);
    let cage = setup.cage.motion(start);
    for ball in 0..geometry.balls() {
        let angle = setup.cage.ball_angle(cage.angle, ball);
        let at = centre.polar(geometry.pitch_radius(), angle);
        drawing.balls.push(Circle { centre: at, radius: geometry.ball_radius() });
    }
    for defect in &setup.race_defects {
        let race = circle(defect.race());
        let turned = match defect.race() {
            Race::Inner => shaft_angle,
            Race::Outer => 0.0,
        };
        let length = 2.0 * defect.half_angle() * race.radius;
        let dent = |shape: &DentShape| {
            format!("dent {:.2} mm long, {:.0} \u{b5}m deep", shape.length * 1e3, shape.depth * 1e6)
        };
        let label = match defect {
            RaceDefect::Dent(of) => dent(of.shape()),
            RaceDefect::SurfaceDent(of) => dent(of.shape()),
            RaceDefect::Measured(_) => format!("profile {:.2} mm long", length * 1e3),
        };
        drawing.dents.push(Dent { race, angle_rad: defect.angle() + turned, length, label });
    }
}

fn add_sensors(drawing: &mut Drawing, case: &Case, bodies: &RingsInHousing) {
    let seats = bodies.rings.seats();
    for sensor in &case.sensors {
        let at = match (&sensor.spot, &bodies.housing) {
            (SensorSpot::RingDeg(degrees), _) => {
                let label = sensor.bearing.as_deref().unwrap_or_default();
                let seat = seats.iter().find(|seat| seat.label == label);
                seat.map(|seat| centre_of(bodies, seat).polar(seat.ring.section().radius, degrees.to_radians()))
            }
            (SensorSpot::Point(point), Some(housing)) => {
                let [x, y, _] = housing.model.frame().point(*point);
                Some(Point { x, y })
            }
            (SensorSpot::Node(tag), Some(housing)) => {
                let node = housing.model.node_tags.iter().position(|found| found == tag);
                node.map(|node| point(&housing.model, node))
            }
            (SensorSpot::Group(group), Some(housing)) => housing.mesh.group(group).ok().map(|group| {
                let points = || group.nodes.iter().map(|&node| point(&housing.model, node));
                let count = group.nodes.len() as f64;
                let (x, y): (f64, f64) = (points().map(|at| at.x).sum(), points().map(|at| at.y).sum());
                Point { x: x / count, y: y / count }
            }),
            // a row does not say where it is
            _ => None,
        };
        let [x, y, _] = bodies.frame().vector(sensor.direction);
        let size = sensor.direction.iter().fold(0.0_f64, |size, part| size.max(part.abs()));
        let direction_rad = (x.hypot(y) > 1e-9 * size).then(|| y.atan2(x).rem_euclid(2.0 * PI));
        if let Some(at) = at {
            drawing.sensors.push(Sensor { name: sensor.name.clone(), at, direction_rad });
        }
    }
}
