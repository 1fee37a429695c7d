//! Order, tolerance, samples, jumps of the force.

use super::super::tests::{Oscillator, error_after, steady};
use super::super::{Method, Schedule, Statistics, Stepping, integrate};
use super::*;
use crate::dynamics::{Instant, LinearCoordinate, NoRecord, Observer, State};

fn method(tolerance: f64) -> Method {
    Method::Dop853 {
        tolerance,
        events: false,
    }
}

/// Number of halvings of the step between two errors by which the second is smaller.
fn order(coarse: f64, fine: f64) -> f64 {
    (coarse / fine).log2()
}

/// States of the driven oscillator by equal steps without control.
fn fixed(steps: u32, end: f64) -> f64 {
    let mut system = Oscillator::new(0.7);
    let mut stages = Stages::new(system.linear());
    let ((y, v), mut g) = (steady(0.0), [0.0]);
    system.force_into(0.0, &[y], &[v], &mut g);
    stages.begin(&[y], &[v], &g);
    let h = end / f64::from(steps);
    for step in 0..steps {
        let span = Span::new(f64::from(step) * h, f64::from(step + 1) * h, f64::INFINITY);
        stages.turn_over();
        stages.attempt(&mut system, &span);
        stages.close(&mut system, &span);
    }
    let [y, v] = stages.end();
    let exact = steady(end);
    (y[0] - exact.0).hypot(v[0] - exact.1)
}

#[test]
fn equal_steps_are_of_order_8() {
    // coarser steps do better, finer ones end in round-off: 1e-14
    for steps in [48, 64] {
        let found = order(fixed(steps, 8.0), fixed(2 * steps, 8.0));
        assert!((found - 8.0).abs() < 0.3, "{steps}: {found}");
    }
}

/// Largest error inside one step of `h` from the exact state.
fn between(h: f64) -> f64 {
    let mut system = Oscillator::new(0.7);
    let mut stages = Stages::new(system.linear());
    let mut dense = Dense::new(stages.length());
    let ((y, v), mut g) = (steady(0.0), [0.0]);
    system.force_into(0.0, &[y], &[v], &mut g);
    stages.begin(&[y], &[v], &g);
    stages.turn_over();
    let span = Span::new(0.0, h, f64::INFINITY);
    stages.attempt(&mut system, &span);
    stages.close(&mut system, &span);
    let errors = (1..20).map(|i| {
        let place = f64::from(i) / 20.0;
        let [y, v] = dense.at(&mut system, &mut stages, &span, place);
        let exact = steady(place * h);
        (y[0] - exact.0).hypot(v[0] - exact.1)
    });
    errors.fold(0.0, f64::max)
}

#[test]
fn dense_output_is_of_order_7() {
    // in one step it is wrong by h^8
    let mut last = between(0.4);
    for h in [0.2, 0.1, 0.05] {
        let error = between(h);
        let found = order(last, error) - 1.0;
        assert!((found - 7.0).abs() < 0.3, "{h}: {found}");
        last = error;
    }
}

#[test]
fn errors_go_with_the_tolerance() {
    // three periods of drive: few steps at the loose end, and their errors add up at the tight one; 0.05 to 4 were found
    for exponent in 4..=10 {
        let tolerance = 10.0_f64.powi(-exponent);
        let ratio = error_after(method(tolerance), 0.1, 0.7) / tolerance;
        assert!((0.02..8.0).contains(&ratio), "{tolerance:e}: {ratio}");
    }
}

/// A ball of unit mass that falls on a Hertz contact.
struct Bouncing {
    linear: [LinearCoordinate; 1],
}

const GRAVITY: f64 = 9.81;
const STIFFNESS: f64 = 1e5;

impl Bouncing {
    fn new() -> Self {
        Self {
            linear: [LinearCoordinate {
                squared_frequency: 0.0,
                damping: 0.0,
            }],
        }
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
    let mut state = State {
        t: 0.0,
        y: vec![1.0],
        v: vec![0.0],
    };
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
        let ((across, plain), (ending, located)) =
            (bounced(tolerance, false), bounced(tolerance, true));
        // 3 to 50 times were found, for up to 30 % more evaluations
        assert!(2.0 * ending < across, "{tolerance:e}: {ending} {across}");
        assert!(
            2 * located.evaluations < 3 * plain.evaluations,
            "{tolerance:e}"
        );
        // each of the ten bounces begins and ends once
        assert_eq!((plain.events, located.events), (0, 20), "{tolerance:e}");
    }
}

#[test]
fn work_is_what_it_was() {
    // a change of these numbers is a change of efficiency: to be looked at, and then to be written here
    let counts = |statistics: Statistics| {
        [
            statistics.steps,
            statistics.rejected,
            statistics.evaluations,
            statistics.events,
        ]
    };
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
                assert!(
                    height.abs() <= 0.01 * tolerance,
                    "{tolerance:e}: {height:e}"
                );
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

/// Keeps the largest error of all samples, and counts them.
#[derive(Default)]
struct Samples {
    count: u64,
    worst: f64,
}

impl Observer<Oscillator> for Samples {
    fn observe(&mut self, _system: &Oscillator, now: Instant<'_>) {
        let (y, v) = steady(now.t);
        assert_eq!(now.step, self.count);
        self.count += 1;
        self.worst = self.worst.max((now.y[0] - y).hypot(now.v[0] - v));
    }
}

#[test]
fn samples_are_all_taken_and_change_nothing() {
    let sampled = |interval: f64, step: f64| {
        let ((y, v), mut samples) = (steady(0.0), Samples::default());
        let mut state = State {
            t: 0.0,
            y: vec![y],
            v: vec![v],
        };
        let statistics = integrate(
            &mut Oscillator::new(0.7),
            method(1e-8),
            &Schedule::covering(12.0, interval, step).unwrap(),
            &mut state,
            &mut samples,
            |_, _| Stepping::Continue,
        )
        .unwrap();
        (samples, statistics)
    };
    let (many, often) = sampled(1.0, 0.01);
    let (few, rarely) = sampled(4.0, 4.0);
    assert_eq!((many.count, few.count), (1201, 4));
    // tens of samples a step, steps between samples: the same steps, three more stages where a sample is, which is in all but
    // the first
    assert_eq!(often.steps, rarely.steps);
    assert!((20..120).contains(&often.steps), "{often:?}");
    assert_eq!(
        often.evaluations - rarely.evaluations,
        (1200 - 3) + 3 * (often.steps - 1 - 3)
    );
    // found 5 tolerances at the ends of steps that add up to 12 s, 20 between them: order 7
    assert!(
        few.worst < 8e-8 && many.worst < 4e-7,
        "{:e} {:e}",
        few.worst,
        many.worst
    );
}

/// A force that jumps from 1 to -2 at an instant, told or not.
struct Jump {
    linear: [LinearCoordinate; 1],
    told: bool,
    after: f64,
    calls: u64,
}

const JUMP: f64 = 0.7;

impl SecondOrderSystem for Jump {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.linear
    }

    fn force_into(&mut self, t: f64, _y: &[f64], _v: &[f64], g: &mut [f64]) {
        self.calls += 1;
        g[0] = if t < JUMP { 1.0 } else { self.after };
    }

    fn next_change(&self, t: f64) -> f64 {
        if self.told && t < JUMP {
            JUMP
        } else {
            f64::INFINITY
        }
    }
}

/// Error at 2 s of a body at rest under that force, what it took, and how often it was evaluated.
fn jumped(told: bool) -> (f64, Statistics, u64) {
    let mut system = Jump {
        linear: Bouncing::new().linear,
        told,
        after: -2.0,
        calls: 0,
    };
    let mut state = State {
        t: 0.0,
        y: vec![0.0],
        v: vec![0.0],
    };
    let statistics = integrate(
        &mut system,
        method(1e-6),
        &Schedule::covering(2.0, 1.0, 0.1).unwrap(),
        &mut state,
        &mut NoRecord,
        |_, _| Stepping::Continue,
    )
    .unwrap();
    let (after, speed) = (2.0 - JUMP, JUMP);
    let exact = 0.5 * JUMP * JUMP + speed * after - after * after;
    ((state.y[0] - exact).abs(), statistics, system.calls)
}

#[test]
fn no_step_passes_a_jump_of_the_force() {
    let (error, statistics, calls) = jumped(true);
    // powers up to 7 are exact
    assert!(error < 1e-14, "{error:e}");
    assert_eq!(statistics.rejected, 0);
    assert_eq!(statistics.evaluations, calls);
    let (untold, statistics, calls) = jumped(false);
    assert!(untold > 1e-10, "{untold:e}");
    assert!(statistics.rejected > 5);
    assert_eq!(statistics.evaluations, calls);
}

/// Springs in balance with large forces: nothing moves but by round-off.
struct Resting {
    linear: [LinearCoordinate; 3],
}

impl SecondOrderSystem for Resting {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.linear
    }

    fn force_into(&mut self, _t: f64, y: &[f64], _v: &[f64], g: &mut [f64]) {
        g[0] = 9.81 + 1e-3 * (y[2] - 1e-6 / 3.0);
        g[1] = (1e6 / 7.0 - 1e12 * y[1]) * 1e-6;
        g[2] = 1e4 * (1e-6 / 3.0 - y[2]);
    }
}

#[test]
fn what_stands_still_does_not_shorten_the_steps() {
    let coordinate = |squared_frequency: f64| LinearCoordinate {
        squared_frequency,
        damping: 0.0,
    };
    let mut system = Resting {
        linear: [coordinate(1e6), coordinate(0.0), coordinate(0.0)],
    };
    let mut state = State {
        t: 0.0,
        y: vec![9.81e-6, 1e-6 / 7.0, 1e-6 / 3.0],
        v: vec![0.0; 3],
    };
    let statistics = integrate(
        &mut system,
        method(1e-8),
        &Schedule::covering(1.0, 1.0, 1.0).unwrap(),
        &mut state,
        &mut NoRecord,
        |_, _| Stepping::Continue,
    )
    .unwrap();
    // 1e3 rad of the spring: at the limit of stability, about 5.3 rad a step
    assert!(statistics.steps < 220, "{statistics:?}");
    assert!(state.v.iter().all(|v| v.abs() < 1e-13), "{state:?}");
}

#[test]
fn what_no_step_is_short_enough_for_is_said() {
    let run = |system: &mut Jump, tolerance: f64| {
        let mut state = State {
            t: 0.0,
            y: vec![0.1],
            v: vec![0.3],
        };
        let schedule = Schedule::covering(2.0, 1.0, 0.1).unwrap();
        let method = method(tolerance);
        let mut record = NoRecord;
        integrate(
            system,
            method,
            &schedule,
            &mut state,
            &mut record,
            |_, _| Stepping::Continue,
        )
        .unwrap_err()
        .to_string()
    };
    let mut system = Jump {
        linear: Bouncing::new().linear,
        told: false,
        after: 1e20,
        calls: 0,
    };
    assert_eq!(
        run(&mut system, 0.0),
        "tolerance must be at least 1e-14 and below 1, found 0"
    );
    assert!(run(&mut system, f64::NAN).contains("found NaN"));
    assert!(run(&mut system, 1e-3).contains("no step is short enough for the tolerance"));
    system.linear[0].squared_frequency = f64::NAN;
    assert!(run(&mut system, 1e-6).contains("not a number"));
}
