//! Order, equilibrium and stability on oscillators with known answers.

use super::*;
use crate::numerics::ode::{Divergence, LinearCoordinate, NoRecord, SecondOrderSystem, State, Tangent};

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
            linear: [LinearCoordinate { squared_frequency: W * W * (1.0 - split), damping: C }],
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
    let mut state = State { t: 0.0, y: vec![y], v: vec![v] };
    let schedule = Schedule::covering(8.0, 1.0, step).expect("valid");
    integrate(&mut system, method, &schedule, &mut state, &mut NoRecord, |_, _| Stepping::Continue).expect("stable");
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
            let (coarse, fine) = (error_after(method, 1.0 / 50.0, split), error_after(method, 1.0 / 100.0, split));
            let order = (coarse / fine).log2();
            // the next power of the step adds a few percent at these steps
            assert!((order - expected).abs() < 0.15, "{method:?} {split}: order {order}");
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
    let schedule = Schedule { interval: h * f64::from(count), steps_per_interval: count, intervals: 1 };
    let on = |_, _| Stepping::Continue;
    integrate(system, method, &schedule, state, &mut NoRecord, on)
}

/// Amplitude after 2000 steps from 1, the spring outside the linear part, without damping.
fn amplitude_after(method: Method, phase: f64) -> f64 {
    let mut system = Oscillator::new(1.0);
    system.drive = 0.0;
    system.linear[0].damping = 0.0;
    let mut state = State { t: 0.0, y: vec![1.0], v: vec![0.0] };
    match take_steps(&mut system, method, &mut state, phase / W, 2000) {
        Ok(_) => state.y[0].hypot(state.v[0] / W),
        Err(_) => f64::INFINITY,
    }
}

#[test]
fn the_force_is_held_up_to_the_limit_and_not_beyond() {
    for (method, limit) in [(Method::Exponential, 2.0), (Method::Splitting, 2.0), (ADAMS, ADAMS_STABILITY_LIMIT)] {
        let (below, beyond) = (amplitude_after(method, 0.99 * limit), amplitude_after(method, 1.01 * limit));
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
        assert!((lost / said - 1.0).abs() < 2.0 * phase * phase, "{phase}: {lost} {said}");
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
    let mut system = Pressed([LinearCoordinate { squared_frequency: W * W, damping: C }]);
    let mut state = State { t: 0.0, y: vec![1.0], v: vec![0.0] };
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
        assert!((found - said).abs() < 0.02 * (1.0 - said), "{phase}: {found} {said}");
    }
}

#[test]
fn the_exponential_method_is_exact_without_a_changing_force() {
    let mut system = Oscillator::new(0.0);
    system.drive = 0.0;
    let mut state = State { t: 0.0, y: vec![1.0], v: vec![0.0] };
    // one step of 20 s, seven times the linear limit of central differences
    let schedule = Schedule::covering(20.0, 20.0, 20.0).expect("valid");
    integrate(&mut system, Method::Exponential, &schedule, &mut state, &mut NoRecord, |_, _| Stepping::Continue)
        .expect("stable");
    let damped = (W * W - 0.25 * C * C).sqrt();
    let exact = (-0.5 * C * 20.0_f64).exp() * ((damped * 20.0).cos() + 0.5 * C / damped * (damped * 20.0).sin());
    assert!((state.y[0] - exact).abs() < 1e-14);
}

#[test]
fn newmark_refuses_a_step_beyond_its_limit() {
    let mut system = Oscillator::new(0.0);
    let mut state = State { t: 0.0, y: vec![0.0], v: vec![0.0] };
    let schedule = Schedule::covering(10.0, 0.7, 0.7).expect("valid");
    let error = integrate(&mut system, Method::NewmarkExplicit, &schedule, &mut state, &mut NoRecord, |_, _| {
        Stepping::Continue
    })
    .expect_err("2 / 3 s is the limit");
    assert!(matches!(error, TransientError::Unstable { .. }), "{error}");
}

#[test]
fn a_solution_that_blows_up_names_the_time_and_leaves_the_last_good_state() {
    // nearly all of the spring is outside the linear part: Verlet's limit holds for it
    let mut system = Oscillator::new(0.999);
    let mut state = State { t: 0.0, y: vec![1.0], v: vec![0.0] };
    let schedule = Schedule::covering(5000.0, 1.0, 1.0).expect("valid");
    let error =
        integrate(&mut system, Method::Exponential, &schedule, &mut state, &mut NoRecord, |_, _| Stepping::Continue)
            .expect_err("unstable");
    let TransientError::BlewUp(blow_up) = error else {
        panic!("{error}");
    };
    assert!(state.t < blow_up.time && state.y[0].is_finite());
    assert!(state.t.to_bits() == blow_up.good_until.to_bits());
}

/// An oscillator on a spring that only the force holds, with a range that its position may not leave; sees its own samples.
struct Watched {
    oscillator: Oscillator,
    limit: f64,
    first_beyond: Option<u64>,
    seen: u64,
}

impl SecondOrderSystem for Watched {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.oscillator.linear
    }

    fn force_into(&mut self, t: f64, y: &[f64], v: &[f64], g: &mut [f64]) {
        self.oscillator.force_into(t, y, v, g);
        // each sample has one evaluation
        if y[0].abs() > self.limit && self.first_beyond.is_none() {
            self.first_beyond = Some(self.seen);
        }
        self.seen += 1;
    }

    fn tangent_into(&mut self, t: f64, y: &[f64], v: &[f64], tangent: &mut Tangent) {
        self.oscillator.tangent_into(t, y, v, tangent);
    }

    fn check(&self, y: &[f64], _v: &[f64]) -> Result<(), Divergence> {
        if y[0].abs() <= self.limit {
            return Ok(());
        }
        Err(Divergence::OutOfRange { what: "position".to_owned(), value: y[0], limit: self.limit, unit: "m" })
    }
}

#[test]
fn a_blow_up_is_noticed_within_a_few_steps_in_an_interval_of_thousands() {
    for method in [Method::Exponential, ADAMS, Method::Splitting, Method::NewmarkExplicit] {
        for limit in [10.0, 31.0, 100.0, 310.0] {
            let mut oscillator = Oscillator::new(1.0);
            oscillator.linear[0].damping = 0.0;
            let mut system = Watched { oscillator, limit, first_beyond: None, seen: 0 };
            let mut state = State { t: 0.0, y: vec![1.0], v: vec![0.0] };
            // a tenth beyond the limit of Verlet
            let h = 2.2 / W;
            let error = take_steps(&mut system, method, &mut state, h, 10_000).expect_err("grows");
            let TransientError::BlewUp(blow_up) = error else {
                panic!("{error}");
            };
            let first = system.first_beyond.expect("it left its range");
            let late = blow_up.statistics.steps - first;
            println!("{method:?}: {blow_up}");
            assert!(late < 6, "{method:?}: {late} steps late");
            let bad = (blow_up.time - blow_up.good_until) / h;
            assert!(bad < 6.5 && blow_up.good_until < blow_up.time, "{bad}");
            assert!(state.y[0].abs() <= limit);
            assert_eq!(blow_up.beyond_the_limit(), Some(true));
        }
    }
}

/// Largest stable phase in a step by bisection, to 1e-3 of it.
fn measured_limit(method: Method) -> f64 {
    let (mut stable, mut grows) = (0.5, 4.0);
    while grows - stable > 1e-3 {
        let middle = 0.5 * (stable + grows);
        if amplitude_after(method, middle) < 1e3 {
            stable = middle;
        } else {
            grows = middle;
        }
    }
    stable / W
}

#[test]
fn the_limit_that_is_named_is_the_one_that_is_found() {
    for method in [Method::Exponential, ADAMS, Method::Splitting, Method::NewmarkExplicit] {
        let state = State { t: 0.0, y: vec![1.0], v: vec![0.0] };
        let mut system = Oscillator::new(1.0);
        system.linear[0].damping = 0.0;
        let named = method.step_limit(&mut system, &state);
        let (named, found) = (named.expect("a limit").step_s, measured_limit(method));
        println!("{method:?}: {named} s named, {found} s found");
        // 2000 steps tell growth from none to some 1e-5; the bisection ends at 1e-3
        assert!((named / found - 1.0).abs() < 2e-3, "{method:?}");
    }
}

#[test]
fn a_blow_up_tells_step_limit_and_frequency() {
    let blow_up = BlowUp {
        method: ADAMS,
        time: 2.300_052,
        good_until: 2.300_048,
        good_intervals: 23,
        step_s: 4e-6,
        statistics: Statistics { steps: 575_013, ..Statistics::default() },
        limit: Some(StepLimit { step_s: 1.928e-6, highest_hz: 142_980.0 }),
        resonance: None,
        cause: Divergence::NotFinite,
    };
    assert_eq!(
        blow_up.to_string(),
        "the solution blew up at t = 2.300052000 s (step 575013 of 4.000e-6 s; good until 2.300048000 s): a value is infinite or not a number; contacts there vibrate at up to 143.0 kHz, exponential-adams is stable up to 1.93e-6 s"
    );
    let resonant =
        BlowUp { step_s: 1.5e-6, resonance: Some(Resonance { mode_hz: 333_210.0, multiple: 1 }), ..blow_up.clone() };
    assert!(
        resonant.to_string().ends_with(
            "is stable up to 1.93e-6 s but for resonances: in this step a mode of 333.2 kHz makes about half a turn"
        ),
        "{resonant}"
    );
    let of_dop853 = BlowUp { method: Method::Dop853 { tolerance: 1e-6, events: true }, limit: None, ..blow_up };
    assert_eq!(
        of_dop853.to_string(),
        "the solution blew up at t = 2.300052000 s (after 575013 steps by tolerance; good until 2.300048000 s): a value is infinite or not a number"
    );
}

#[test]
fn a_coordinate_out_of_its_range_is_told_briefly() {
    let what = "shaft displacement x".to_owned();
    let cause = Divergence::OutOfRange { what, value: 1.427_06, limit: 5e-4, unit: "m" };
    assert_eq!(cause.to_string(), "shaft displacement x is 1.427 m, beyond 5e-4 m");
}

#[test]
fn steps_divide_the_interval() {
    let schedule = Schedule::covering(2.6, 1e-5, 1.5e-8).expect("valid");
    assert_eq!(schedule.steps_per_interval, 667);
    assert_eq!(schedule.intervals, 260_000);
    assert_eq!(Schedule::covering(1.0, 1e-5, 1e-7).expect("valid").steps_per_interval, 100);
    assert!(Schedule::covering(1.0, 1e-5, f64::NAN).is_err());
}

/// `y'' = -k y - c y^3`, all of it in the force, with or without its spring told.
struct Hardening {
    linear: [LinearCoordinate; 1],
    cubic: f64,
    told: bool,
    place: f64,
}

impl SecondOrderSystem for Hardening {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.linear
    }

    fn force_into(&mut self, _t: f64, y: &[f64], _v: &[f64], g: &mut [f64]) {
        self.place = y[0];
        g[0] = -(W * W + self.cubic * y[0] * y[0]) * y[0];
    }

    fn own_springs_into(&self, springs: &mut [f64], sizes: &mut [f64]) {
        let own = W * W + 3.0 * self.cubic * self.place * self.place;
        springs[0] = if self.told { own } else { 0.0 };
        sizes[0] = 0.0;
    }
}

/// End position after ten time units from 1 at rest, and the counts.
fn hardening(cubic: f64, told: bool, tolerance: f64) -> (f64, Statistics) {
    let free = LinearCoordinate { squared_frequency: 0.0, damping: 0.0 };
    let mut system = Hardening { linear: [free], cubic, told, place: 0.0 };
    let mut state = State { t: 0.0, y: vec![1.0], v: vec![0.0] };
    let schedule = Schedule::covering(10.0, 0.25, 0.25).expect("valid");
    let method = Method::ExponentialAdams { tolerance: Some(tolerance) };
    let counts = integrate(&mut system, method, &schedule, &mut state, &mut NoRecord, |_, _| Stepping::Continue);
    (state.y[0], counts.expect("stable"))
}

#[test]
fn a_spring_that_is_told_is_stepped_exactly() {
    let exact = (10.0 * W).cos();
    let (told, counts) = hardening(0.0, true, 1e-2);
    // round-off of a hundred steps; steps of 0.75 rad
    assert!((told - exact).abs() < 1e-12, "{told} {exact}");
    assert!(counts.steps < 100, "{counts:?}");
    let (untold, more) = hardening(0.0, false, 1e-2);
    assert!((untold - exact).abs() > 1e-6 && more.steps > 2 * counts.steps);
}

#[test]
fn steps_follow_from_the_tolerance() {
    let (reference, _) = hardening(4.0, true, 1e-8);
    let errors = [1e-2, 1e-3, 1e-4].map(|tolerance| {
        let (end, counts) = hardening(4.0, true, tolerance);
        println!("{tolerance:e}: {:e} {counts:?}", end - reference);
        ((end - reference).abs(), counts)
    });
    let [(rough, few), _, (fine, many)] = errors;
    // the error falls with the tolerance to the power 4/3, 460 in two decades; halves are coarse
    assert!(fine < rough / 200.0, "{fine:e} {rough:e}");
    // and steps grow with its cube root, 4.6 times; ten times under lines alone
    let growth = many.steps as f64 / few.steps as f64;
    assert!(growth > 3.0 && growth < 7.0, "{growth}");
    assert!(errors[0].1.evaluations == 1 + errors[0].1.steps + errors[0].1.rejected);
}
