//! The ring in space: rigid motions, continuity, and the plane ring inside it.

use super::*;
use crate::fe::element::curved_beam::RingInterpolation;
use crate::fe::material::{BeamSection, Bond, Material, RadiusRule, RingLayer};
use crate::numerics::linalg::symmetric_generalised_eigen;
use std::f64::consts::{PI, TAU};

/// The published ring pair, whose masses lie off the reference radius.
fn layers() -> [RingLayer; 2] {
    let layer = |young, density, area, inertia, radius| RingLayer {
        material: Material::new(young, 0.3, density).expect("valid"),
        area,
        inertia,
        axial_inertia: None,
        torsion: None,
        radius,
        shear_coefficient: 5.0 / 6.0,
    };
    [layer(210e9, 7850.0, 5.37e-6, 8.88e-13, 5.314e-3), layer(72e9, 2700.0, 12e-6, 9e-12, 7.5e-3)]
}

fn section(rule: RadiusRule) -> BeamSection {
    BeamSection::combine(&layers(), Bond::Slip(rule)).expect("valid")
}

fn ring(nodes: usize) -> Ring {
    let section = section(RadiusRule::CommonCentroid);
    Ring::in_space(nodes, section, RingInterpolation::ExactArc).expect("enough nodes")
}

/// The six rigid motions, and one of all together; translations of micrometres, turns to match.
fn motions() -> Vec<([f64; 3], [f64; 3])> {
    let unit = |k: usize| std::array::from_fn(|i| if i == k % 3 { 1.0 } else { 0.0 });
    let mut motions: Vec<_> = (0..6)
        .map(|k| match k {
            0..3 => (unit(k).map(|x: f64| 1e-6 * x), [0.0; 3]),
            _ => ([0.0; 3], unit(k).map(|x: f64| 1e-4 * x)),
        })
        .collect();
    motions.push(([2e-6, -3e-6, 1e-6], [1e-4, -2e-4, 3e-4]));
    motions
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

#[test]
fn rigid_motions_are_exact_at_any_angle_and_off_the_centroid_line() {
    for nodes in [3, 17, 72] {
        let ring = ring(nodes);
        let radius = ring.section().radius;
        for (translation, rotation) in motions() {
            let d = ring.rigid_motion_in_space(translation, rotation);
            for step in 0..100 {
                let angle = 0.173 * f64::from(step) - 7.0;
                let (sin, cos) = angle.sin_cos();
                let rows = ring.space_rows_at(angle).expect("in space");
                let frame = [[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]];
                let along = |e: [f64; 3], v: [f64; 3]| (0..3).map(|i| e[i] * v[i]).sum::<f64>();
                for (arm, height) in [(0.0, 0.0), (1.3e-3, 2e-3), (-0.7e-3, -1.1e-3)] {
                    let point = [(radius + arm) * cos, (radius + arm) * sin, height];
                    let turned = cross(rotation, point);
                    let moved = std::array::from_fn(|i| translation[i] + turned[i]);
                    let found = rows.displacement_at(arm, height);
                    for (row, e) in found.iter().zip(frame) {
                        let error = rows.apply(row, &d) - along(e, moved);
                        // round-off of displacements of 1e-6 m
                        assert!(error.abs() < 1e-18, "{nodes} {angle}: {error:e}");
                    }
                }
                let turns = [rows.about_radial, rows.about_tangential, rows.about_axial];
                for (row, e) in turns.iter().zip(frame) {
                    let error = rows.apply(row, &d) - along(e, rotation);
                    // round-off of 1e-6 m over the element's length
                    assert!(error.abs() < 1e-15, "{nodes} {angle}: {error:e}");
                }
            }
        }
    }
}

#[test]
fn the_interpolation_goes_on_from_element_to_element() {
    let ring = ring(9);
    // a rough displacement vector: no rigid motion, no symmetry
    let d: Vec<f64> = (0..ring.dof()).map(|i| (1.7 * i as f64).sin()).collect();
    for node in 0..9 {
        let angle = ring.node_angle(node);
        let side = |offset: f64| {
            let rows = ring.space_rows_at(angle + offset).expect("in space");
            [rows.axial, rows.about_radial, rows.about_tangential, rows.radial, rows.tangential, rows.about_axial]
                .map(|row| rows.apply(&row, &d))
        };
        let [before, after] = [-1e-9, 1e-9].map(side);
        let (sin, cos) = angle.sin_cos();
        let at = |component: usize| d[27 + 3 * node + component];
        let expected = [at(0), at(1) * cos + at(2) * sin, at(2) * cos - at(1) * sin];
        for k in 0..6 {
            // slopes of rad per 5 mm over 1e-9 rad
            assert!((before[k] - after[k]).abs() < 1e-5, "{node} {k}");
            if k < 3 {
                assert!((after[k] - expected[k]).abs() < 1e-5, "{node} {k}");
            }
        }
    }
}

#[test]
fn six_rigid_modes_and_symmetric_matrices() {
    for rule in [RadiusRule::Own, RadiusRule::CommonCentroid] {
        let section = section(rule);
        let ring = Ring::in_space(36, section, RingInterpolation::ExactArc).expect("nodes");
        let (k, m) = (ring.stiffness(), ring.mass());
        for matrix in [k, m] {
            let scale = matrix.norm_max();
            for i in 0..ring.dof() {
                for j in 0..i {
                    let error = (matrix[(i, j)] - matrix[(j, i)]).abs();
                    // round-off of the turned element matrices
                    assert!(error <= 1e-15 * scale, "{i} {j}: {error:e}");
                }
            }
        }
        let modes = symmetric_generalised_eigen(k, m).expect("free");
        let ratio = (modes.values[5].abs() / modes.values[6]).sqrt();
        assert!(ratio < 1e-5, "{rule:?}: {ratio:e}");
    }
}

#[test]
fn a_tilted_ring_has_the_inertia_of_its_layers_where_they_are() {
    let ring = ring(72);
    let mass = ring.mass();
    // on the reference radius: integral of (A R_k^2 + I) sin^2 + I_a over the circumference
    let exact: f64 = layers()
        .iter()
        .map(|layer| {
            let turned = layer.area * layer.radius.powi(2) + layer.inertia;
            let along = 2.0 * layer.out_of_plane_inertia();
            layer.material.density * (turned + along) * PI * ring.section().radius
        })
        .sum();
    for turn in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.6, -0.8, 0.0]] {
        let d = ring.rigid_motion_in_space([0.0; 3], turn);
        let found: f64 = (0..ring.dof())
            .flat_map(|i| (0..ring.dof()).map(move |j| (i, j)))
            .map(|(i, j)| d[i] * mass[(i, j)] * d[j])
            .sum();
        assert!((found / exact - 1.0).abs() < 1e-12, "{found} {exact}");
    }
}

#[test]
fn the_plane_ring_stands_first_and_unchanged() {
    for kind in [RingInterpolation::ExactArc, RingInterpolation::Raveendranath] {
        let section = section(RadiusRule::Own);
        let plane = Ring::new(12, section, kind).expect("enough nodes");
        let space = Ring::in_space(12, section, kind).expect("enough nodes");
        assert_eq!((plane.dof(), space.dof()), (36, 72));
        assert!(!plane.is_in_space() && space.is_in_space());
        assert!(plane.space_rows_at(0.3).is_none());
        for (small, large) in [(plane.stiffness(), space.stiffness()), (plane.mass(), space.mass())] {
            for i in 0..36 {
                for j in 0..36 {
                    assert_eq!(small[(i, j)].to_bits(), large[(i, j)].to_bits());
                    assert_eq!(large[(i, j + 36)].to_bits(), 0);
                    assert_eq!(large[(i + 36, j)].to_bits(), 0);
                }
            }
        }
        assert_eq!(plane.rows_at(0.3), space.rows_at(0.3));
        let motion = ([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]);
        assert_eq!(plane.rigid_motion_in_space(motion.0, motion.1), plane.rigid_motion(1.0, 2.0, 6.0));
        // out of the plane it is the exact arc, whatever is asked for in it
        let exact = Ring::in_space(12, section, RingInterpolation::ExactArc).expect("nodes");
        for i in 36..72 {
            for j in 36..72 {
                let entry = |ring: &Ring| ring.stiffness()[(i, j)].to_bits();
                assert_eq!(entry(&space), entry(&exact));
            }
        }
    }
}

#[test]
fn a_support_stays_in_the_plane() {
    let mut ring = ring(8);
    let before = ring.stiffness().clone();
    ring.add_support(&RingSupport {
        from: 0.0,
        to: TAU,
        spring: [1e5, 1e5, 0.0],
        share: SpringShare::PerNode,
        offset: 1e-3,
    })
    .expect("nodes stand there");
    for i in 0..48 {
        for j in 24..48 {
            let (new, old) = (ring.stiffness()[(i, j)], before[(i, j)]);
            assert_eq!(new.to_bits(), old.to_bits());
        }
    }
    assert!(ring.stiffness()[(0, 0)] > before[(0, 0)] + 9e4);
}

/// Energy of springs along the axis in a rigid motion: the attachment, outside of the node, moves by
/// `z + (about_x y - about_y x)` there.
#[test]
fn a_support_along_the_axis_holds_its_attachment() {
    let free = ring(8);
    let (translation, rotation) = ([0.3, -0.2, 0.7], [0.5, -0.4, 0.9]);
    let offset = 1e-3;
    let mut held = free.clone();
    let spring = [0.0, 0.0, 1e5];
    let (from, to, share) = (0.0, TAU, SpringShare::PerNode);
    held.add_support(&RingSupport { from, to, spring, share, offset }).expect("nodes stand there");
    let motion = free.rigid_motion_in_space(translation, rotation);
    let mut energy = 0.0;
    for (j, right) in motion.iter().enumerate() {
        for (i, left) in motion.iter().enumerate() {
            energy += left * (held.stiffness()[(i, j)] - free.stiffness()[(i, j)]) * right;
        }
    }
    let radius = free.section().radius + offset;
    let expected: f64 = (0..8)
        .map(|node| {
            let (sin, cos) = free.node_angle(node).sin_cos();
            let lift = radius * (rotation[0] * sin - rotation[1] * cos);
            1e5 * (translation[2] + lift).powi(2)
        })
        .sum();
    // differences of matrix entries much larger than the springs
    assert!((energy / expected - 1.0).abs() < 1e-6, "{energy} {expected}");
}
