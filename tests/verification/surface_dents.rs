//! Reference: statics of two balls that share the shaft's weight, each in a dent; a ball bridges a dent of width 2c in a
//!   groove of radius r_g by its geometry alone, nearly `(1/rho_b - 1/r_g) c^2 / 2`.
//! Goal: a dent in three dimensions lowers a loaded ball by its drop, not by its depth, in a bearing as in its own query.
//! Sketch: shaft on the lower balls; under each the source's outer dent, 15 um deep.
//!
//! ```text
//!        \   /
//!         o o        the shaft sinks by (drop and change of compression) / cos(180/7 deg)
//!        ~~ ~~
//! ```
//!
//! Conditions: zero speed, weight of ring, balls and shaft; ring on its springs; consistent formulation.
//! Parameters: see `setup`; dents 0.75 x 0.41 x 0.015 mm.

use plummer::bearing::Race;
use plummer::bearing::defect::{
    CurvatureReading, Dent, DentShape, PolarPosition, RaceDefect, RaceProfile, SurfaceDent,
};
use plummer::system::{BearingSetup, Equilibrium, Formulation, StaticCondition};

use crate::setup::{SYMMETRIC_DEG, paper_bearing, paper_structure};

/// Half the angle between the lower balls, rad.
const HALF: f64 = std::f64::consts::PI / 7.0;

fn shape(angle: f64) -> DentShape {
    DentShape {
        angle,
        length: 0.75e-3,
        width: Some(0.41e-3),
        depth: 15e-6,
        rim_radius: 0.05e-3,
        curvature: CurvatureReading::Total,
    }
}

/// Beyond its place on the undamaged race, m, of a ball at the dent's middle under a force (N).
fn sunk(setup: &BearingSetup, dent: &SurfaceDent, force: f64) -> f64 {
    let place = setup.geometry.outer_race_radius() - setup.geometry.ball_radius();
    let angle = dent.shape().angle;
    let [mut low, mut high] = [0.0, 20e-6];
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let radius = place + middle;
        let found = dent.contacts(PolarPosition { radius, angle });
        let radial = found.pressing().map(|c| c.stiffness * c.delta.powf(1.5) * c.normal_radial);
        if radial.sum::<f64>() < force {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

#[test]
fn the_shaft_sinks_by_the_drop_into_the_surface() {
    let structure = paper_structure(72, 0.0);
    let sound = paper_bearing(SYMMETRIC_DEG, Formulation::Consistent);
    let solve = |race_defects: Vec<RaceDefect>| {
        let setup = BearingSetup { race_defects, ..sound.clone() };
        let condition = StaticCondition::at(&setup, 0.0);
        Equilibrium::find(&structure, &setup, condition).unwrap()
    };
    let below = 1.5 * std::f64::consts::PI;
    let places = [below - HALF, below + HALF];
    let dents =
        places.map(|angle| SurfaceDent::new(&sound.geometry, Race::Outer, shape(angle), sound.stiffness).unwrap());
    let healthy = solve(Vec::new());
    let damaged = solve(dents.iter().cloned().map(RaceDefect::SurfaceDent).collect());
    let force = healthy.balls[0].outer;
    let usual = (force / sound.stiffness.outer()).powf(2.0 / 3.0);
    let deeper = sunk(&sound, &dents[0], force) - usual;
    // the drop, and 0.05 um more of compression by the softer contacts
    let drop = dents[0].ball_drop();
    assert!(deeper > drop && deeper < drop + 0.1e-6, "{deeper} {drop}");
    let found = healthy.shaft[1] - damaged.shaft[1];
    let expected = deeper / HALF.cos();
    // balls a little lower carry the shaft at angles and forces that differ by 1e-3, the ball's weight apart
    assert!((found / expected - 1.0).abs() < 0.01, "{found} m, expected {expected} m");
    // in the plane the same dents let the balls fall until others carry
    let in_plane = places.map(|angle| {
        let dent = Dent::new(&sound.geometry, Race::Outer, shape(angle), sound.stiffness);
        RaceDefect::Dent(dent.unwrap())
    });
    let fallen = healthy.shaft[1] - solve(in_plane.to_vec()).shaft[1];
    assert!(fallen > 2.0 * found, "{fallen} m against {found} m");
}
