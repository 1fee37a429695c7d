//! A ball that bounces: steps that end where contact begins and ends, and what they cost.

use super::super::*;
use super::free;
use crate::numerics::ode::{LinearCoordinate, NoRecord, State};
use crate::numerics::ode::{Method, Schedule, Statistics, Stepping, integrate};

/// A ball of unit mass that falls on a Hertz contact.
struct Bouncing {
    linear: [LinearCoordinate; 1],
}

const GRAVITY: f64 = 9.81;

const STIFFNESS: f64 = 1e5;

impl Bouncing {
    fn new() -> Self {
        Self { linear: free() }
    }

    fn energy(y: f64, v: f64) -> f64 {
        0.5 * v * v + GRAVITY * y + 0.4 * STIFFNESS * (-y).max(0.0).powf(2.5)
    }
}

impl SecondOrderSystem for Bouncing {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.linear
    }

    fn force_into(&mut self, _t: f64, y: &[f64], _v: &[f64], g: &mut [f64]) {
        g[0] = STIFFNESS * (-y[0]).max(0.0).powf(1.5) - GRAVITY;
    }

    fn events(&self) -> usize {
        1
    }

    fn events_into(&mut self, _t: f64, y: &[f64], _v: &[f64], events: &mut [f64]) {
        events[0] = -y[0];
    }
}

/// Relative error of the energy after ten bounces, and what it took.
fn bounced(tolerance: f64, events: bool) -> (f64, Statistics) {
    let mut state = State { t: 0.0, y: vec![1.0], v: vec![0.0] };
    let statistics = integrate(
        &mut Bouncing::new(),
        Method::Dop853 { tolerance, events },
        &Schedule::covering(9.2, 9.2, 9.2).unwrap(),
        &mut state,
        &mut NoRecord,
        |_, _| Stepping::Continue,
    )
    .unwrap();
    let error = Bouncing::energy(state.y[0], state.v[0]) / GRAVITY - 1.0;
    (error.abs(), statistics)
}

#[test]
fn steps_that_end_at_contact_keep_more_of_the_energy() {
    for exponent in 3..=12 {
        let tolerance = 10.0_f64.powi(-exponent);
        let ((across, plain), (ending, located)) = (bounced(tolerance, false), bounced(tolerance, true));
        // 3 to 50 times were found, for up to 30 % more evaluations
        assert!(2.0 * ending < across, "{tolerance:e}: {ending} {across}");
        assert!(2 * located.evaluations < 3 * plain.evaluations, "{tolerance:e}");
        // each of the ten bounces begins and ends once
        assert_eq!((plain.events, located.events), (0, 20), "{tolerance:e}");
    }
}

#[test]
fn work_is_what_it_was() {
    // a change of these numbers is a change of efficiency: to be looked at, and then to be written here
    let counts =
        |statistics: Statistics| [statistics.steps, statistics.rejected, statistics.evaluations, statistics.events];
    assert_eq!(counts(bounced(1e-6, false).1), [197, 130, 3799, 0]);
    assert_eq!(counts(bounced(1e-6, true).1), [215, 156, 4437, 20]);
    assert_eq!(counts(bounced(1e-10, true).1), [517, 264, 9209, 20]);
}

#[test]
fn events_are_located_within_their_band() {
    for tolerance in [1e-4, 1e-7, 1e-10] {
        let mut system = Bouncing::new();
        let (mut y, mut v, mut g) = ([1.0], [0.0], [-GRAVITY]);
        let mut method = Dop853::new(&system, 0.0, tolerance, true);
        method.begin(&mut system, 1.0, [&y, &v, &g]);
        let mut landings = 0;
        while method.span.to < 4.0 {
            let before = Stepper::<Bouncing>::statistics(&method).events;
            method.advance(&mut system, method.next.unwrap()).unwrap();
            if Stepper::<Bouncing>::statistics(&method).events > before {
                let [height, speed] = method.stages.end().map(|part| part[0]);
                // the largest overlap of a height of 1 m is 1
                assert!(height.abs() <= 0.01 * tolerance, "{tolerance:e}: {height:e}");
                if landings == 0 {
                    let exact = (2.0 / GRAVITY).sqrt();
                    let late = (method.span.to - exact).abs() * speed.abs();
                    // the band, and round-off
                    assert!(late <= 0.01 * tolerance + 1e-13, "{late:e}");
                }
                landings += 1;
            }
        }
        assert_eq!(landings, 8, "{tolerance:e}");
        let t = method.span.to;
        method.step(&mut system, t, &mut y, &mut v, &mut g).unwrap();
    }
}
