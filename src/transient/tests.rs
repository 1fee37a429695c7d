//! Order, equilibrium and stability on oscillators with known answers.

use super::*;
use crate::dynamics::{LinearCoordinate, NoRecord, SecondOrderSystem, State};

/// A damped oscillator with part `split` of its spring outside the linear part, under a cosine
/// force: `y'' + c y' + w^2 y = cos(p t)`.
struct Oscillator {
    linear: [LinearCoordinate; 1],
    outside: f64,
    drive: f64,
}

const W: f64 = 3.0;
const C: f64 = 0.3;
const P: f64 = 2.0;

impl Oscillator {
    fn new(split: f64) -> Self {
        Self {
            linear: [LinearCoordinate {
                squared_frequency: W * W * (1.0 - split),
                damping: C,
            }],
            outside: W * W * split,
            drive: 1.0,
        }
    }
}

impl SecondOrderSystem for Oscillator {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.linear
    }

    fn force_into(&mut self, t: f64, y: &[f64], _v: &[f64], g: &mut [f64]) {
        g[0] = self.drive * (P * t).cos() - self.outside * y[0];
    }
}

/// Steady answer `y = A cos(p t) + B sin(p t)` of the driven oscillator.
fn steady(t: f64) -> (f64, f64) {
    let (stiff, damp) = (W * W - P * P, C * P);
    let scale = 1.0 / (stiff * stiff + damp * damp);
    let (a, b) = (stiff * scale, damp * scale);
    let (sin, cos) = (P * t).sin_cos();
    (a * cos + b * sin, P * (b * cos - a * sin))
}

fn error_after(method: Method, step: f64, split: f64) -> f64 {
    let mut system = Oscillator::new(split);
    let (y, v) = steady(0.0);
    let mut state = State {
        t: 0.0,
        y: vec![y],
        v: vec![v],
    };
    let schedule = Schedule::covering(8.0, 1.0, step).expect("valid");
    integrate(
        &mut system,
        method,
        &schedule,
        &mut state,
        &mut NoRecord,
        |_, _| Stepping::Continue,
    )
    .expect("stable");
    let (y, v) = steady(8.0);
    (state.y[0] - y).hypot(state.v[0] - v)
}

#[test]
fn both_methods_are_of_second_order() {
    for method in [Method::Exponential, Method::NewmarkExplicit] {
        for split in [0.0, 0.7] {
            let (coarse, fine) = (
                error_after(method, 1.0 / 50.0, split),
                error_after(method, 1.0 / 100.0, split),
            );
            let order = (coarse / fine).log2();
            assert!(
                (order - 2.0).abs() < 0.1,
                "{method:?} {split}: order {order}"
            );
        }
    }
}

#[test]
fn the_exponential_method_is_exact_without_a_changing_force() {
    let mut system = Oscillator::new(0.0);
    system.drive = 0.0;
    let mut state = State {
        t: 0.0,
        y: vec![1.0],
        v: vec![0.0],
    };
    // one step of 20 s, seven times the linear limit of central differences
    let schedule = Schedule::covering(20.0, 20.0, 20.0).expect("valid");
    integrate(
        &mut system,
        Method::Exponential,
        &schedule,
        &mut state,
        &mut NoRecord,
        |_, _| Stepping::Continue,
    )
    .expect("stable");
    let damped = (W * W - 0.25 * C * C).sqrt();
    let exact = (-0.5 * C * 20.0_f64).exp()
        * ((damped * 20.0).cos() + 0.5 * C / damped * (damped * 20.0).sin());
    assert!((state.y[0] - exact).abs() < 1e-14);
}

#[test]
fn newmark_refuses_a_step_beyond_its_limit() {
    let mut system = Oscillator::new(0.0);
    let mut state = State {
        t: 0.0,
        y: vec![0.0],
        v: vec![0.0],
    };
    let schedule = Schedule::covering(10.0, 0.7, 0.7).expect("valid");
    let error = integrate(
        &mut system,
        Method::NewmarkExplicit,
        &schedule,
        &mut state,
        &mut NoRecord,
        |_, _| Stepping::Continue,
    )
    .expect_err("2 / 3 s is the limit");
    assert!(matches!(error, TransientError::Unstable { .. }), "{error}");
}

#[test]
fn a_solution_that_blows_up_names_the_time_and_leaves_the_last_good_state() {
    // nearly all of the spring is outside the linear part: Verlet's limit holds for it
    let mut system = Oscillator::new(0.999);
    let mut state = State {
        t: 0.0,
        y: vec![1.0],
        v: vec![0.0],
    };
    let schedule = Schedule::covering(5000.0, 1.0, 1.0).expect("valid");
    let error = integrate(
        &mut system,
        Method::Exponential,
        &schedule,
        &mut state,
        &mut NoRecord,
        |_, _| Stepping::Continue,
    )
    .expect_err("unstable");
    let TransientError::BlewUp { time, .. } = error else {
        panic!("{error}");
    };
    assert!(state.t < time && state.y[0].is_finite());
}

#[test]
fn steps_divide_the_interval() {
    let schedule = Schedule::covering(2.6, 1e-5, 1.5e-8).expect("valid");
    assert_eq!(schedule.steps_per_interval, 667);
    assert_eq!(schedule.intervals, 260_000);
    assert_eq!(
        Schedule::covering(1.0, 1e-5, 1e-7)
            .expect("valid")
            .steps_per_interval,
        100
    );
    assert!(Schedule::covering(1.0, 1e-5, f64::NAN).is_err());
}
