//! Stiffness against differences, symmetry, and what a turned scene gives.

use super::super::*;
use crate::bearing::samples::{source_bearing, steel};
use crate::bearing::{BearingGeometry, RaceContacts};

/// The source's bearing with a play of 5 um, or a free contact angle.
pub(super) fn bearing(thrust: Thrust, control: RaceControl) -> SpatialBearing {
    let geometry = match thrust {
        Thrust::Both => source_bearing().with_radial_play(5e-6).unwrap(),
        _ => source_bearing().with_free_contact_angle(0.45).unwrap(),
    };
    SpatialBearing::new(geometry, moduli(&geometry), thrust, control).unwrap()
}

pub(super) fn moduli(geometry: &BearingGeometry) -> [f64; 2] {
    let contacts = RaceContacts::new(geometry, steel(), steel(), steel()).unwrap();
    [contacts.inner.effective_modulus, contacts.outer.effective_modulus]
}

fn shifted(displacement: &RingDisplacement, axis: usize, step: f64) -> RingDisplacement {
    let mut vector = displacement.vector();
    vector[axis] += step;
    RingDisplacement::of(vector)
}

const LOADED: [RingDisplacement; 3] = [
    RingDisplacement { translation: [3e-6, -8e-6, 2e-6], tilt: [0.0, 0.0] },
    RingDisplacement { translation: [2e-6, -4e-6, 4e-5], tilt: [2e-3, -1e-3] },
    RingDisplacement { translation: [0.0, -1e-6, 3e-5], tilt: [-1e-3, 4e-3] },
];

#[test]
fn stiffness_is_the_derivative_of_the_load() {
    for thrust in [Thrust::Both, Thrust::Positive] {
        for control in [RaceControl::Outer, RaceControl::Shared] {
            let bearing = bearing(thrust, control);
            for speed in [0.0, 500.0, 5000.0, 15_000.0] {
                let condition = BearingCondition { cage_angle: 0.3, shaft_speed: speed };
                for displacement in &LOADED {
                    let state = bearing.state(displacement, condition).unwrap();
                    let pitch = bearing.geometry().pitch_radius();
                    let units = [1.0, 1.0, 1.0, pitch, pitch];
                    let largest = state.stiffness.iter().flatten().fold(0.0_f64, |most, k| most.max(k.abs()));
                    assert!(largest > 1e5, "{largest}");
                    for axis in 0..5 {
                        // differences of fourth order: round-off is 1e-8, the rest less
                        let step = 2e-9 / units[axis];
                        let load = |steps: f64| {
                            bearing.state(&shifted(displacement, axis, steps * step), condition).unwrap().load
                        };
                        let [far_before, before, after, far_after] = [-2.0, -1.0, 1.0, 2.0].map(load);
                        for row in 0..5 {
                            let [far, near] = [far_after[row] - far_before[row], after[row] - before[row]];
                            let rate = (8.0 * near - far) / (12.0 * step);
                            let unit = units[row] * units[axis];
                            let error = (rate - state.stiffness[row][axis]).abs() / unit;
                            assert!(
                                error < 1e-6 * largest,
                                "{thrust:?} {control:?} {speed} {row} {axis}: {rate} {}",
                                state.stiffness[row][axis]
                            );
                        }
                    }
                }
            }
        }
    }
}
