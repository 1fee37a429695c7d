//! The balance of energy.

use super::*;

/// Gap of the balance over all that was exchanged.
fn energy_gap(setup: &SpatialSetup, structure: &Structure, step: f64, steps: u64) -> f64 {
    let modes = structure.modes().unwrap();
    let rest = SpatialEquilibrium::find(structure, setup, &SpatialCondition::at(setup, 0.0)).unwrap();
    let mut system = system(structure, &modes, setup);
    let mut state = system.state_at(0.0, &rest, &modes);
    let mut meter = EnergyMeter::new(&system, step).unwrap();
    let schedule = Schedule { interval: step, steps_per_interval: 1, intervals: steps };
    let method = Method::ExponentialAdams { tolerance: None };
    integrate(&mut system, method, &schedule, &mut state, &mut meter, |_, _| Stepping::Continue).unwrap();
    let balance = meter.balance(&mut system, &state).unwrap();
    assert!(balance.exchanged_j > 1e-9 && balance.contact_damping_j > 0.0, "{balance:?}");
    balance.error()
}

#[test]
fn energy_is_kept_with_axial_preload_tilt_and_every_kind_of_force() {
    let (structure, mut setup) = pair(300.0);
    for own in &mut setup.bearings {
        own.contact_damping = 1.0;
    }
    for control in [RaceControl::Outer, RaceControl::Shared] {
        let geometry = geometry().with_free_contact_angle(15_f64.to_radians()).unwrap();
        for own in &mut setup.bearings {
            let thrust = if own.place < 0.0 { Thrust::BACK_TO_BACK[0] } else { Thrust::BACK_TO_BACK[1] };
            own.bearing = SpatialBearing::new(geometry, moduli(), thrust, control).unwrap();
        }
        let gap = energy_gap(&setup, &structure, 2e-8, 10_000);
        println!("{control:?}: {gap:e}");
        // the integrator's own error; 1e-6 is what such a balance is asked for
        assert!(gap.abs() < 1e-7, "{control:?}: {gap:e}");
    }
}

/// Balls of both bearings cross a dent that their patches cover in part, on the outer race of one and on the inner race of the other.
#[test]
fn energy_is_kept_on_dents_across_the_groove() {
    let (structure, mut setup) = pair(300.0);
    let dents = [((Race::Outer, FIRST + 0.07), 2e-4), ((Race::Inner, FIRST - 0.09), 2e-4)];
    for (own, (dent, place)) in setup.bearings.iter_mut().zip(dents) {
        own.contact_damping = 1.0;
        own.offset *= 3.0;
        own.bearing = dented(&own.bearing, &[dent], Some(AcrossGroove { place, width: 2e-4 }));
    }
    let gap = energy_gap(&setup, &structure, 1e-8, 20_000);
    println!("{gap:e}");
    // what such a balance is asked for in the plane
    assert!(gap.abs() < 1e-6, "{gap:e}");
}
