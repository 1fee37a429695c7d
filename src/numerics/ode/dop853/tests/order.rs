//! Order of the steps and of what is between them, errors against the tolerance, samples.

use super::super::*;
use super::method;
use crate::numerics::ode::tests::{Oscillator, error_after, steady};
use crate::numerics::ode::{Instant, Observer, State};
use crate::numerics::ode::{Schedule, Stepping, integrate};

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
        let mut state = State { t: 0.0, y: vec![y], v: vec![v] };
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
    assert_eq!(often.evaluations - rarely.evaluations, (1200 - 3) + 3 * (often.steps - 1 - 3));
    // found 5 tolerances at the ends of steps that add up to 12 s, 20 between them: order 7
    assert!(few.worst < 8e-8 && many.worst < 4e-7, "{:e} {:e}", few.worst, many.worst);
}
