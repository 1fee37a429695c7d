//! Stability, energy and damping of the implicit methods, and contacts solved by them.

use super::error::TransientError;
use super::tests::Oscillator;
use crate::numerics::linalg::SmallLu;
use crate::numerics::ode::{
    Divergence, Instant, LinearCoordinate, NoRecord, Observer, SecondOrderSystem, State, Tangent,
};
use crate::numerics::ode::{Method, Schedule, Statistics, Stepping, integrate};

const FREE: LinearCoordinate = LinearCoordinate { squared_frequency: 0.0, damping: 0.0 };

/// Mass 1 on a spring `F = y^1.5 (1 + c v)` that only pushes.
pub(super) struct Impact {
    linear: [LinearCoordinate; 1],
    damping: f64,
}

impl Impact {
    pub fn new(damping: f64) -> Self {
        Self { linear: [FREE], damping }
    }
}

impl SecondOrderSystem for Impact {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.linear
    }

    fn force_into(&mut self, _t: f64, y: &[f64], v: &[f64], g: &mut [f64]) {
        g[0] = -y[0].max(0.0).powf(1.5) * (1.0 + self.damping * v[0]).max(0.0);
    }

    fn tangent_into(&mut self, _t: f64, y: &[f64], v: &[f64], tangent: &mut Tangent) {
        let factor = 1.0 + self.damping * v[0];
        if y[0] > 0.0 && factor > 0.0 {
            let term = tangent.add();
            term.left[0] = -1.0;
            term.position[0] = 1.5 * y[0].sqrt() * factor;
            term.velocity[0] = y[0].powf(1.5) * self.damping;
        }
    }
}

/// Positions at all samples.
#[derive(Default)]
struct Path(Vec<f64>);

impl<S> Observer<S> for Path {
    fn observe(&mut self, _system: &S, now: Instant<'_>) {
        self.0.push(now.y[0]);
    }
}

fn steps<S: SecondOrderSystem>(
    system: &mut S,
    method: Method,
    [h, count]: [f64; 2],
    state: &mut State,
    observer: &mut impl Observer<S>,
) -> Result<Statistics, TransientError> {
    let schedule = Schedule { interval: h * count, steps_per_interval: count as u32, intervals: 1 };
    let go_on = |_, _| Stepping::Continue;
    integrate(system, method, &schedule, state, observer, go_on)
}

fn at(y: &[f64], v: &[f64]) -> State {
    State { t: 0.0, y: y.to_vec(), v: v.to_vec() }
}

fn alpha(spectral_radius: f64) -> Method {
    Method::GeneralizedAlpha { spectral_radius }
}

/// Undamped, `w = 1`, no drive, part of the spring in the force.
fn unit_oscillator(split: f64) -> Oscillator {
    let mut system = Oscillator::new(0.0);
    system.linear[0] = LinearCoordinate { squared_frequency: 1.0 - split, damping: 0.0 };
    (system.outside, system.drive) = (split, 0.0);
    system
}

#[test]
fn average_acceleration_keeps_the_energy_of_an_oscillator() {
    for split in [0.0, 0.7] {
        for h in [0.1, 3.0, 100.0] {
            let (mut system, mut state) = (unit_oscillator(split), at(&[1.0], &[0.5]));
            let run = [h, 1e4];
            steps(&mut system, Method::Newmark, run, &mut state, &mut NoRecord).unwrap();
            let energy = |y: f64, v: f64| 0.5 * (y * y + v * v);
            let change = energy(state.y[0], state.v[0]) / energy(1.0, 0.5) - 1.0;
            println!("split {split}, h w = {h}: {change:.1e}");
            // round-off of 1e4 steps if it all had one sign, times some operations
            assert!(change.abs() < 1e4 * 4.0 * f64::EPSILON, "{h}: {change:e}");
        }
    }
}

#[test]
fn no_step_is_too_long_for_a_stiff_oscillator() {
    for method in [Method::Newmark, alpha(0.0), alpha(0.8), alpha(1.0)] {
        for split in [0.0, 0.7] {
            let (mut system, mut state) = (unit_oscillator(split), at(&[1.0], &[0.5]));
            let mut path = Path::default();
            steps(&mut system, method, [100.0, 1e4], &mut state, &mut path).unwrap();
            let largest = path.0.iter().fold(0.0, |most: f64, y| most.max(y.abs()));
            println!("{method:?}, {split}: largest {largest:.2}, last {:.1e}", state.y[0]);
            // sqrt(1.25) where energy is kept
            assert!(largest < 2.0, "{method:?} {split}: {largest}");
            if matches!(method, Method::GeneralizedAlpha { spectral_radius } if spectral_radius < 0.9) {
                assert!(state.y[0].abs() < 1e-12, "{method:?}: {}", state.y[0]);
            }
        }
    }
}

/// Three amplitudes at one instant make those at the next (position, velocity, acceleration): positions in a row obey a
/// recurrence whose coefficients are those of the characteristic polynomial.
#[test]
fn fast_motions_lose_what_was_published() {
    // at 0 and 1 fewer than three amplitudes show in the positions
    for radius in [0.2_f64, 0.5, 0.8] {
        let (mut system, mut state) = (unit_oscillator(0.0), at(&[1.0], &[1e-4]));
        let mut path = Path::default();
        steps(&mut system, alpha(radius), [1e3, 6.0], &mut state, &mut path).unwrap();
        let y = &path.0;
        let mut lu = SmallLu::default();
        let matrix = lu.fill(3);
        for row in 0..3 {
            matrix[3 * row..3 * row + 3].copy_from_slice(&y[row..row + 3]);
        }
        assert!(lu.factorise());
        let mut found = [-y[3], -y[4], -y[5]];
        lu.solve_in_place(&mut found);
        // (lambda + rho)^3
        let published = [radius.powi(3), 3.0 * radius * radius, 3.0 * radius];
        println!("rho {radius}: {found:?}, published {published:?}");
        for (found, published) in found.iter().zip(&published) {
            // of the order 1 / (h w)^2: found 1.5e-5 at most
            assert!((found - published).abs() < 2e-5, "{radius}: {found} {published}");
        }
    }
}

/// A spring of a mode, a ball pressed on it through a Hertz contact by its load.
struct Pressed {
    linear: [LinearCoordinate; 2],
}

const STIFFNESS: f64 = 1e3;
const MASS: f64 = 1e-2;
const LOAD: f64 = 1.0;

impl SecondOrderSystem for Pressed {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.linear
    }

    fn force_into(&mut self, _t: f64, y: &[f64], _v: &[f64], g: &mut [f64]) {
        let force = STIFFNESS * (y[1] - y[0]).max(0.0).powf(1.5);
        (g[0], g[1]) = (force, (LOAD - force) / MASS);
    }

    fn tangent_into(&mut self, _t: f64, y: &[f64], _v: &[f64], tangent: &mut Tangent) {
        let overlap = y[1] - y[0];
        if overlap > 0.0 {
            let slope = 1.5 * STIFFNESS * overlap.sqrt();
            let term = tangent.add();
            term.left.copy_from_slice(&[1.0, -1.0 / MASS]);
            term.position.copy_from_slice(&[-slope, slope]);
        }
    }
}

#[test]
fn an_equilibrium_stays_one() {
    let mode = LinearCoordinate { squared_frequency: 1e4, damping: 0.0 };
    let sag = LOAD / 1e4;
    let rest = [sag, sag + (LOAD / STIFFNESS).cbrt().powi(2)];
    for method in [Method::Newmark, alpha(0.0), alpha(0.8), alpha(1.0)] {
        // contact and mode at 1 and at 100 rad a step
        for h in [0.01, 1.0] {
            let mut system = Pressed { linear: [mode, FREE] };
            let mut state = at(&rest, &[0.0; 2]);
            let counts = steps(&mut system, method, [h, 1e3], &mut state, &mut NoRecord).unwrap();
            let moved = [0, 1].map(|i| (state.y[i] / rest[i] - 1.0).abs());
            println!("{method:?}, h = {h}: {moved:?}, {} solves", counts.solves);
            // round-off of the forces, which the stiffness makes one of the positions, kept by methods without damping
            assert!(moved[0] < 1e-12 && moved[1] < 1e-12, "{method:?}: {moved:?}");
            // what is balanced is solved at once
            assert_eq!(counts.solves, counts.steps);
        }
    }
}

#[test]
fn an_impact_is_solved() {
    // Hertz: time of contact 2.943275 depth / v, depth (5/4 v^2)^(2/5)
    let (depth, factor) = (1.25_f64.powf(0.4), 2.943_275);
    let contact = factor * depth;
    for method in [Method::Newmark, alpha(0.8)] {
        let mut errors = Vec::new();
        for count in [100.0, 200.0, 400.0] {
            let mut state = at(&[-0.5], &[1.0]);
            let end = 1.0 + contact;
            let mut system = Impact::new(0.0);
            let run = [end / count, count];
            let counts = steps(&mut system, method, run, &mut state, &mut NoRecord).unwrap();
            // it left at the speed it came with, as long ago as its way out took
            let (speed, left) = (-state.v[0], end + state.y[0] / -state.v[0]);
            errors.push([speed - 1.0, left / (0.5 + contact) - 1.0]);
            let solves = counts.solves as f64 / counts.steps as f64;
            println!("{method:?}, {count} steps: {:?}, {solves} solves a step", errors.last());
            assert!(solves < 3.0, "{solves}");
        }
        // w h = pi / 77 to pi / 308: second order, with where the steps meet the contact in it
        assert!(errors[2].iter().all(|error| error.abs() < 1e-4), "{errors:?}");
    }
}

/// Steps longer than the contact: it opens and closes from iteration to iteration.
#[test]
fn contacts_that_come_and_go_within_a_step_are_solved() {
    for method in [Method::Newmark, alpha(0.0), alpha(0.8)] {
        for damping in [0.0, 0.3] {
            for h in [1.0, 10.0, 100.0] {
                for start in [-3.0, -0.5, 0.5, 3.0] {
                    let mut system = Impact::new(damping);
                    let mut state = at(&[start], &[1.0]);
                    let run = [h, 20.0];
                    let counts = steps(&mut system, method, run, &mut state, &mut NoRecord);
                    let solves = counts.map(|counts| counts.solves);
                    println!("{method:?} {damping} {h} {start}: {solves:?}");
                    assert!(solves.is_ok(), "{method:?} {damping} {h} {start}");
                }
            }
        }
    }
}

/// An oscillator that does not tell its tangent.
struct Silent(Oscillator);

impl SecondOrderSystem for Silent {
    fn linear(&self) -> &[LinearCoordinate] {
        self.0.linear()
    }

    fn force_into(&mut self, t: f64, y: &[f64], v: &[f64], g: &mut [f64]) {
        self.0.force_into(t, y, v, g);
    }
}

#[test]
fn a_tangent_left_out_costs_iterations_and_no_accuracy() {
    let mut ends = Vec::new();
    let run = [0.1, 100.0];
    let mut with = at(&[1.0], &[0.0]);
    let told = steps(&mut unit_oscillator(0.7), Method::Newmark, run, &mut with, &mut NoRecord);
    let mut without = at(&[1.0], &[0.0]);
    let mut silent = Silent(unit_oscillator(0.7));
    let untold = steps(&mut silent, Method::Newmark, run, &mut without, &mut NoRecord);
    ends.extend([with.y[0], without.y[0]]);
    let (told, untold) = (told.unwrap().solves, untold.unwrap().solves);
    println!("solves {told} and {untold}, difference {:e}", ends[1] - ends[0]);
    assert!(untold > told);
    // 100 steps of the tolerance
    assert!((ends[1] - ends[0]).abs() < 1e-8);
}

#[test]
fn what_cannot_be_solved_is_an_error() {
    // the force left out outgrows what is known at h w = 3: corrections grow by 9 / 4 times
    let mut silent = Silent(unit_oscillator(1.0));
    let mut state = at(&[1.0], &[0.0]);
    let error = steps(&mut silent, Method::Newmark, [3.0, 4.0], &mut state, &mut NoRecord);
    let Err(TransientError::BlewUp(blow_up)) = error else {
        panic!("{error:?}");
    };
    let cause = &blow_up.cause;
    assert!(matches!(cause, Divergence::NotSolved { iterations: 30, .. }), "{cause}");
    let wrong = steps(&mut silent, alpha(1.5), [3.0, 4.0], &mut state, &mut NoRecord);
    assert_eq!(wrong.unwrap_err().to_string(), "spectral radius must be from 0 to 1, found 1.5");
}
