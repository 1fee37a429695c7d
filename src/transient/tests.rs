//! Order, equilibrium and stability on oscillators with known answers.

use super::*;
use crate::dynamics::{LinearCoordinate, NoRecord, SecondOrderSystem, State, Tangent};

/// A damped oscillator with part `split` of its spring outside the linear part, under a cosine
/// force: `y'' + c y' + w^2 y = cos(p t)`.
pub(super) struct Oscillator {
    pub linear: [LinearCoordinate; 1],
    pub outside: f64,
    pub drive: f64,
}

const ADAMS: Method = Method::ExponentialAdams { tolerance: None };

const W: f64 = 3.0;
const C: f64 = 0.3;
const P: f64 = 2.0;

impl Oscillator {
    pub fn new(split: f64) -> Self {
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

    fn tangent_into(&mut self, _t: f64, _y: &[f64], _v: &[f64], tangent: &mut Tangent) {
        let term = tangent.add();
        term.left[0] = 1.0;
        term.position[0] = -self.outside;
    }
}

/// Steady answer `y = A cos(p t) + B sin(p t)` of the driven oscillator.
pub(super) fn steady(t: f64) -> (f64, f64) {
    let (stiff, damp) = (W * W - P * P, C * P);
    let scale = 1.0 / (stiff * stiff + damp * damp);
    let (a, b) = (stiff * scale, damp * scale);
    let (sin, cos) = (P * t).sin_cos();
    (a * cos + b * sin, P * (b * cos - a * sin))
}

pub(super) fn error_after(method: Method, step: f64, split: f64) -> f64 {
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
fn orders_are_those_that_are_said() {
    let alpha = |spectral_radius| Method::GeneralizedAlpha { spectral_radius };
    for (method, expected) in [
        (Method::Exponential, 2.0),
        (Method::NewmarkExplicit, 2.0),
        (Method::Splitting, 2.0),
        (Method::Newmark, 2.0),
        (alpha(0.0), 2.0),
        (alpha(0.8), 2.0),
        (alpha(1.0), 2.0),
        (ADAMS, 3.0),
    ] {
        for split in [0.0, 0.7] {
            let (coarse, fine) = (
                error_after(method, 1.0 / 50.0, split),
                error_after(method, 1.0 / 100.0, split),
            );
            let order = (coarse / fine).log2();
            // the next power of the step adds a few percent at these steps
            assert!(
                (order - expected).abs() < 0.15,
                "{method:?} {split}: order {order}"
            );
        }
    }
}

/// Steps of length `h` (s) without a record.
fn take_steps(
    system: &mut impl SecondOrderSystem,
    method: Method,
    state: &mut State,
    h: f64,
    count: u32,
) -> Result<Statistics, TransientError> {
    let schedule = Schedule {
        interval: h * f64::from(count),
        steps_per_interval: count,
        intervals: 1,
    };
    let on = |_, _| Stepping::Continue;
    integrate(system, method, &schedule, state, &mut NoRecord, on)
}

/// Amplitude after 2000 steps from 1, the spring outside the linear part, without damping.
fn amplitude_after(method: Method, phase: f64) -> f64 {
    let mut system = Oscillator::new(1.0);
    system.drive = 0.0;
    system.linear[0].damping = 0.0;
    let mut state = State {
        t: 0.0,
        y: vec![1.0],
        v: vec![0.0],
    };
    match take_steps(&mut system, method, &mut state, phase / W, 2000) {
        Ok(_) => state.y[0].hypot(state.v[0] / W),
        Err(_) => f64::INFINITY,
    }
}

#[test]
fn the_force_is_held_up_to_the_limit_and_not_beyond() {
    for (method, limit) in [
        (Method::Exponential, 2.0),
        (Method::Splitting, 2.0),
        (ADAMS, ADAMS_STABILITY_LIMIT),
    ] {
        let (below, beyond) = (
            amplitude_after(method, 0.99 * limit),
            amplitude_after(method, 1.01 * limit),
        );
        // just below the limit Verlet's ellipse is ten times as long as wide; beyond it 1.01^2000 is 4e8 at least
        assert!(below < 20.0, "{method:?}: {below}");
        assert!(beyond > 1e6, "{method:?}: {beyond}");
    }
}

/// `exponential-adams` damps what it does not resolve, by the fourth power of the phase over 24 a step, and `exponential`
/// does not.
#[test]
fn amplitude_goes_as_the_page_says() {
    for phase in [0.1, 0.2] {
        let lost = -amplitude_after(ADAMS, phase).ln() / 2000.0;
        let said = f64::powi(phase, 4) / 24.0;
        // the next term is smaller by the square of the phase
        assert!(
            (lost / said - 1.0).abs() < 2.0 * phase * phase,
            "{phase}: {lost} {said}"
        );
        let kept = amplitude_after(Method::Exponential, phase);
        assert!((kept - 1.0).abs() < phase * phase, "{phase}: {kept}");
    }
}

/// Where a coordinate stays that a spring of the linear part pulls one way and a force the other.
fn rest_after(method: Method, phase: f64) -> f64 {
    struct Pressed([LinearCoordinate; 1]);
    impl SecondOrderSystem for Pressed {
        fn linear(&self) -> &[LinearCoordinate] {
            &self.0
        }
        fn force_into(&mut self, _t: f64, _y: &[f64], _v: &[f64], g: &mut [f64]) {
            g[0] = W * W;
        }
    }
    let mut system = Pressed([LinearCoordinate {
        squared_frequency: W * W,
        damping: C,
    }]);
    let mut state = State {
        t: 0.0,
        y: vec![1.0],
        v: vec![0.0],
    };
    take_steps(&mut system, method, &mut state, phase / W, 5000).expect("stable");
    state.y[0]
}

#[test]
fn an_equilibrium_is_kept_by_all_but_splitting() {
    for phase in [0.1, 1.0] {
        for method in [Method::Exponential, ADAMS, Method::NewmarkExplicit] {
            let moved = rest_after(method, phase) - 1.0;
            // round-off of some thousand steps
            assert!(moved.abs() < 1e-12, "{method:?} {phase}: {moved}");
        }
        let found = rest_after(Method::Splitting, phase);
        let said = 0.5 * phase / (0.5 * phase).tan();
        // said without damping, which moves it by its share of a step
        assert!(
            (found - said).abs() < 0.02 * (1.0 - said),
            "{phase}: {found} {said}"
        );
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
