use std::f64::consts::TAU;

use nalgebra::{Rotation3, Unit, Vector3};

use super::{Cylinder, Facet, fit};
use crate::fe::mesh::ElementKind;

struct Made {
    centre: Vector3<f64>,
    turn: Rotation3<f64>,
    radius: f64,
    length: f64,
    arc: f64,
    noise: f64,
}

impl Made {
    fn about_z() -> Self {
        Self { centre: Vector3::zeros(), turn: Rotation3::identity(), radius: 6.0, length: 10.0, arc: TAU, noise: 0.0 }
    }

    fn fit(&self) -> Option<Cylinder> {
        let (round, rows) = (24, 5);
        let mut state = 12345_u32;
        let mut random = move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            2.0 * f64::from(state) / f64::from(u32::MAX) - 1.0
        };
        let mut nodes = vec![[0.0; 3]; (round + 1) * (rows + 1)];
        let full = self.arc > TAU - 1e-9;
        for row in 0..=rows {
            for step in 0..=round {
                let angle = self.arc * step as f64 / round as f64;
                let radius = self.radius + self.noise * random();
                let along = self.length * (row as f64 / rows as f64 - 0.5);
                let point = Vector3::new(radius * angle.cos(), radius * angle.sin(), along);
                let place = row * (round + 1) + step;
                nodes[place] = (self.turn * point + self.centre).into();
                if full && step == round {
                    nodes[place] = nodes[row * (round + 1)];
                }
            }
        }
        let mut facets = Vec::new();
        for row in 0..rows {
            for step in 0..round {
                let place = row * (round + 1) + step;
                let corners = [place, place + 1, place + round + 2, place + round + 1];
                let corners: Vec<[f64; 3]> = corners.iter().map(|&n| nodes[n]).collect();
                let middle = corners.iter().map(|&c| Vector3::from(c)).sum::<Vector3<f64>>() / 4.0;
                let axis = self.turn * Vector3::z();
                let arm = middle - self.centre;
                let out = arm - axis * axis.dot(&arm);
                let inside = Some((middle + 0.1 * out).into());
                facets.push(Facet { kind: ElementKind::Quad4, nodes: corners, inside });
            }
        }
        fit(&facets, &nodes)
    }
}

fn near(found: [f64; 3], expected: Vector3<f64>, within: f64) {
    let found = Vector3::from(found);
    assert!((found - expected).norm() < within, "{found} {expected}");
}

#[test]
fn a_whole_cylinder_is_found_to_round_off() {
    let made = Made::about_z();
    let found = made.fit().unwrap();
    near(found.axis, Vector3::z(), 1e-12);
    near(found.centre, Vector3::zeros(), 1e-11);
    assert!((found.radius / 6.0 - 1.0).abs() < 1e-12);
    assert!((found.length / 10.0 - 1.0).abs() < 1e-12);
    assert!(found.rms < 1e-11 && found.farthest < 1e-11);
    assert!((found.turn - 1.0).abs() < 1e-9, "{}", found.turn);
    assert_eq!(found.hole, Some(true));
}

#[test]
fn any_axis_and_any_place() {
    let made = Made {
        centre: Vector3::new(300.0, -20.0, 1000.0),
        turn: Rotation3::from_axis_angle(&Unit::new_normalize(Vector3::new(1.0, 2.0, 0.3)), 1.1),
        ..Made::about_z()
    };
    let found = made.fit().unwrap();
    let axis = made.turn * Vector3::z();
    near(found.axis, if axis[axis.iamax()] < 0.0 { -axis } else { axis }, 1e-11);
    near(found.centre, made.centre, 1e-9);
    assert!((found.radius / 6.0 - 1.0).abs() < 1e-11);
}

#[test]
fn half_a_noisy_bore() {
    let made = Made {
        arc: 0.5 * TAU,
        noise: 0.006,
        centre: Vector3::new(5.0, 40.0, 0.0),
        turn: Rotation3::from_axis_angle(&Vector3::x_axis(), 0.5 * std::f64::consts::PI),
        ..Made::about_z()
    };
    let found = made.fit().unwrap();
    // 150 nodes with a deviation of 0.006 / sqrt(3) each: a tenth of it is three standard errors of a centre by half a circle
    near(found.axis, -(made.turn * Vector3::z()), 3e-3);
    near(found.centre, made.centre, 4e-3);
    assert!((found.radius - 6.0).abs() < 4e-3, "{}", found.radius);
    assert!((found.turn - 0.5).abs() < 1e-2, "{}", found.turn);
    assert!((0.002..0.0046).contains(&found.rms), "{}", found.rms);
    assert!((0.005..0.0075).contains(&found.farthest), "{}", found.farthest);
}

#[test]
fn planes_spheres_and_boxes_are_none() {
    let flat = |corners: [[f64; 3]; 4]| Facet { kind: ElementKind::Quad4, nodes: corners.to_vec(), inside: None };
    let plane: Vec<Facet> = (0..9)
        .map(|n| {
            let (x, y) = (f64::from(n % 3), f64::from(n / 3));
            flat([[x, y, 0.0], [x + 1.0, y, 0.0], [x + 1.0, y + 1.0, 0.0], [x, y + 1.0, 0.0]])
        })
        .collect();
    assert_eq!(fit(&plane, &[]), None);
    assert_eq!(fit(&[], &[]), None);
    let cube = [
        [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]],
        [[0., 0., 1.], [1., 0., 1.], [1., 1., 1.], [0., 1., 1.]],
        [[0., 0., 0.], [1., 0., 0.], [1., 0., 1.], [0., 0., 1.]],
        [[0., 1., 0.], [1., 1., 0.], [1., 1., 1.], [0., 1., 1.]],
        [[0., 0., 0.], [0., 1., 0.], [0., 1., 1.], [0., 0., 1.]],
        [[1., 0., 0.], [1., 1., 0.], [1., 1., 1.], [1., 0., 1.]],
    ];
    let cube: Vec<Facet> = cube.into_iter().map(flat).collect();
    assert_eq!(fit(&cube, &[]), None);
    // four sides of a box: the normals are those of a cylinder, and the corners lie on one
    assert_eq!(fit(&cube[2..], &[[0.5, 0.0, 0.5]]), None);
}

#[test]
fn a_circle_in_a_plane_mesh() {
    let at = |step: usize| {
        let angle = TAU * step as f64 / 12.0;
        [3.0 + 2.0 * angle.cos(), 1.0 + 2.0 * angle.sin(), 0.0]
    };
    let facets: Vec<Facet> = (0..9)
        .map(|step| Facet {
            kind: ElementKind::Line2,
            nodes: vec![at(step), at(step + 1)],
            inside: Some([3.0, 1.0, 0.0]),
        })
        .collect();
    let nodes: Vec<[f64; 3]> = (0..10).map(at).collect();
    let found = fit(&facets, &nodes).unwrap();
    near(found.axis, Vector3::z(), 1e-15);
    near(found.centre, Vector3::new(3.0, 1.0, 0.0), 1e-12);
    assert!((found.radius - 2.0).abs() < 1e-12);
    assert!((found.turn - 0.75).abs() < 1e-9, "{}", found.turn);
    assert_eq!(found.hole, Some(false));
}

/// Triangles of second order in staggered rows, so many round the turn; `bend` is 1 where the middle nodes are on the
/// cylinder of radius 41, 0 on chords.
fn staggered(around: usize, bend: f64) -> Vec<Facet> {
    let at = |row: usize, step: usize| {
        let angle = TAU * (step as f64 + 0.5 * row as f64) / around as f64;
        [41.0 * angle.cos(), 41.0 * angle.sin(), 20.0 * row as f64]
    };
    let facet = |corners: [[f64; 3]; 3]| {
        let [a, b, c] = corners.map(Vector3::from);
        let middle = |from: Vector3<f64>, to: Vector3<f64>| {
            let chord = 0.5 * (from + to);
            let scale = 1.0 + bend * (41.0 / chord.xy().norm() - 1.0);
            [scale * chord.x, scale * chord.y, chord.z]
        };
        let nodes = corners.into_iter().chain([middle(a, b), middle(b, c), middle(c, a)]).collect();
        let inside = (a + b + c) / 3.0;
        Facet { kind: ElementKind::Tri6, nodes, inside: Some([1.3 * inside.x, 1.3 * inside.y, inside.z]) }
    };
    let rows = (0..2).flat_map(|row| (0..around).map(move |step| (row, step)));
    let pairs = rows.flat_map(|(row, step)| {
        let next = [at(row, step + 1), at(row + 1, step + 1), at(row + 1, step)];
        [facet([at(row, step), at(row, step + 1), at(row + 1, step)]), facet(next)]
    });
    pairs.collect()
}

#[test]
fn six_curved_elements_round_the_turn_are_enough() {
    let nodes = |facets: &[Facet]| facets.iter().flat_map(|facet| facet.nodes.clone()).collect::<Vec<_>>();
    for around in 6..16 {
        let facets = staggered(around, 1.0);
        let found = fit(&facets, &nodes(&facets)).unwrap();
        assert!(found.is_round() && (found.radius / 41.0 - 1.0).abs() < 1e-12, "{around}: {found:?}");
        assert!((found.turn - 1.0).abs() < 1e-9 && found.hole == Some(true), "{around}: {found:?}");
        let facets = staggered(around, 0.0);
        assert!(!fit(&facets, &nodes(&facets)).is_some_and(|found| found.is_round()), "{around}");
    }
}

/// A fillet of one element: its corners lie on any cylinder.
#[test]
fn one_curved_element_is_a_fillet() {
    let corner = |eighths: f64, z: f64| [(TAU / 8.0 * eighths).cos(), (TAU / 8.0 * eighths).sin(), z];
    let places = [(0.0, 0.0), (2.0, 0.0), (2.0, 3.0), (0.0, 3.0), (1.0, 0.0), (2.0, 1.5), (1.0, 3.0), (0.0, 1.5)];
    let nodes: Vec<[f64; 3]> = places.iter().map(|&(eighths, z)| corner(eighths, z)).collect();
    let facet = Facet { kind: ElementKind::Quad8, nodes: nodes.clone(), inside: Some([0.0, 0.0, 1.5]) };
    let found = fit(&[facet], &nodes).unwrap();
    near(found.axis, Vector3::z(), 1e-12);
    assert!((found.radius - 1.0).abs() < 1e-12 && (found.turn - 0.25).abs() < 1e-9, "{found:?}");
    assert_eq!(found.hole, Some(false));
}

/// One middle node off: the corners tell the cylinder, and both distances tell the node.
#[test]
fn a_node_off_the_cylinder_counts_in_both_distances() {
    let mut facets = staggered(24, 1.0);
    let off = &mut facets[7].nodes[3];
    (off[0], off[1]) = (0.999 * off[0], 0.999 * off[1]);
    let nodes: Vec<[f64; 3]> = facets.iter().flat_map(|facet| facet.nodes.clone()).collect();
    let found = fit(&facets, &nodes).unwrap();
    assert!((found.farthest - 0.041).abs() < 1e-11 && (found.radius - 41.0).abs() < 1e-11);
    assert!((found.rms - 0.041 / (nodes.len() as f64).sqrt()).abs() < 1e-11, "{found:?}");
}
