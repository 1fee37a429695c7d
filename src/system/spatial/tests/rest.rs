//! Rest: against rigid rings, and all equilibria over one ball.

use super::*;

/// In rings that hardly give way the rest is that of rigid rings.
#[test]
fn in_stiff_rings_the_rest_is_that_of_rigid_ones() {
    let (_, setup) = pair(0.0);
    let at = |z: f64| RingFrame::new([0.0, 0.0, z], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]).unwrap();
    let rings = [-0.0125, 0.0125].map(|z| (format!("{z}"), ring(true, 1e6), at(z))).to_vec();
    let structure = Structure::ring_alone(Rings::new(rings).unwrap(), [0.0; 2]);
    let found = SpatialEquilibrium::find(&structure, &setup, &SpatialCondition::at(&setup, 0.0)).unwrap();
    let mounted = setup.bearings.iter().map(|own| MountedBearing {
        bearing: own.bearing.clone(),
        place: own.place,
        offset: own.offset,
        cage_angle: FIRST,
    });
    let rigid = RigidShaft::new(mounted.collect(), 0.0).unwrap();
    // the weight acts at the centre of mass, the load beside it
    let load =
        ShaftLoad { force: [1.0, -6.0 - 0.15 * 9.81, 12.0], moment: [0.01 + 0.02 * 6.0, 0.02 + 0.02], place: 0.0 };
    let expected = rigid.equilibrium(&load).unwrap();
    for (own, expected) in found.bearings.iter().zip(&expected.bearings) {
        for (ball, expected) in own.iter().zip(&expected.balls) {
            for race in 0..2 {
                // the rings give way by 1e-6 of what the contacts do; balls have their weight here, 3e-4 N
                assert!((ball.load[race] - expected.load[race]).abs() < 1.2e-3, "{ball:?} {expected:?}");
            }
        }
    }
    for i in 0..5 {
        for j in 0..5 {
            let scale = (expected.stiffness[i][i] * expected.stiffness[j][j]).sqrt();
            let [a, b] = [found.shaft_stiffness[i][j], expected.stiffness[i][j]];
            assert!((a - b).abs() < 1e-3 * scale, "{i} {j}: {a:e} {b:e}");
        }
    }
}

/// A load straight on a ball in play leans the shaft to either side of it, in rings that give way as in rigid ones; mirror images, with
/// a saddle between. Where two balls share the load, or the balls are preloaded, there is one equilibrium.
#[test]
fn every_equilibrium_over_one_ball_is_found() {
    let (structure, mut setup) = pair(0.0);
    setup.shaft = shaft(vec![SpatialLoad { place: 0.0, profile: LoadProfile::constant([0.0, -6.0, 0.0, 0.0, 0.0]) }]);
    let mut find_all = |play: f64, first: f64| {
        let geometry = geometry().with_radial_play(play).unwrap();
        for own in &mut setup.bearings {
            own.bearing = SpatialBearing::new(geometry, moduli(), Thrust::Both, RaceControl::Outer).unwrap();
            own.cage = cage(&geometry, first, 0.0);
            own.offset = 0.0;
        }
        let condition = SpatialCondition::at(&setup, 0.0);
        let all = SpatialEquilibrium::find_all(&structure, &setup, &condition).unwrap();
        assert_eq!(all[0], SpatialEquilibrium::find(&structure, &setup, &condition).unwrap());
        all
    };
    let all = find_all(5e-6, -TAU / 4.0);
    // both ends lean alike, or against each other
    let (stable, saddles): (Vec<_>, Vec<_>) = all.iter().partition(|rest| rest.is_stable());
    assert_eq!((stable.len(), saddles.len()), (4, 3));
    let lean = |rest: &SpatialEquilibrium| [-0.0125, 0.0125].map(|place| rest.shaft[0] + place * rest.shaft[4]);
    for (number, rest) in stable.iter().enumerate() {
        let [a, b] = lean(rest);
        // round-off of the forces over the stiffness
        assert!((a.abs() - b.abs()).abs() < 1e-12 && a.abs() > 1e-6, "{a} {b}");
        let mirrored = |other: &&&SpatialEquilibrium| (lean(other)[0] + a).abs() + (lean(other)[1] + b).abs() < 1e-12;
        assert!(stable.iter().position(|other| mirrored(&other)) != Some(number));
        assert_eq!(stable.iter().filter(mirrored).count(), 1);
    }
    assert_eq!(find_all(5e-6, -TAU / 4.0 + TAU / 14.0).len(), 1);
    assert_eq!(find_all(-1e-6, -TAU / 4.0).len(), 1);
}
