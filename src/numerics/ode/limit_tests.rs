use super::*;
use crate::numerics::ode::{LinearCoordinate, NoRecord};
use crate::numerics::ode::{Schedule, Stepping, integrate};

/// Largest `h omega` of the exponential Adams method under `-omega^2 y`.
const ADAMS_LIMIT: f64 = crate::numerics::ode::ADAMS_STABILITY_LIMIT;

const ADAMS: Method = Method::ExponentialAdams { tolerance: None };

/// A body of 1 kg on a spring, and one of 0.01 kg that hangs on it by a contact of 1 N/m: positions of both.
struct Pair([LinearCoordinate; 2]);

const MASSES: [f64; 2] = [1.0, 0.01];

impl Pair {
    fn new(squared_frequency: f64) -> Self {
        let of = |squared_frequency| LinearCoordinate { squared_frequency, damping: 0.0 };
        Self([of(squared_frequency), of(0.0)])
    }
}

impl SecondOrderSystem for Pair {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.0
    }

    fn force_into(&mut self, _t: f64, y: &[f64], _v: &[f64], g: &mut [f64]) {
        let pull = y[1] - y[0];
        (g[0], g[1]) = (pull / MASSES[0], -pull / MASSES[1]);
    }

    fn tangent_into(&mut self, _t: f64, _y: &[f64], _v: &[f64], tangent: &mut Tangent) {
        let term = tangent.add();
        (term.left[0], term.left[1]) = (1.0 / MASSES[0], -1.0 / MASSES[1]);
        (term.position[0], term.position[1]) = (-1.0, 1.0);
    }
}

fn rest() -> State {
    State { t: 0.0, y: vec![0.0; 2], v: vec![0.0; 2] }
}

#[test]
fn frequencies_are_those_of_unequal_masses() {
    // by hand: the contact alone has the reduced mass 0.01 / 1.01 kg; with a spring of 40 N/m
    // w^4 - (40 + 101) w^2 + 4000 = 0
    let contact = 101.0_f64.sqrt();
    let both = (0.5 * (141.0 + (141.0_f64 * 141.0 - 16_000.0).sqrt())).sqrt();
    for (method, phase, spring, highest) in [
        (Method::Exponential, 2.0, 1e-6, contact),
        (Method::Splitting, 2.0, 1e-6, contact),
        (ADAMS, ADAMS_LIMIT, 1e-6, contact),
        (Method::NewmarkExplicit, 2.0, 40.0, both),
    ] {
        let mut pair = Pair::new(spring);
        let limit = method.step_limit(&mut pair, &rest()).expect("a limit");
        // halvings of the search to 4e-4; at that distance beyond the limit the least growing of these has 1e-3 a step
        assert!((limit.step_s * highest / phase - 1.0).abs() < 1e-3, "{method:?}");
        // round-off of an eigenvalue
        assert!((limit.highest_hz * TAU / highest - 1.0).abs() < 1e-6);
    }
    let mut pair = Pair::new(40.0);
    for method in [
        Method::Newmark,
        Method::GeneralizedAlpha { spectral_radius: 0.8 },
        Method::Dop853 { tolerance: 1e-6, events: false },
    ] {
        assert_eq!(method.step_limit(&mut pair, &rest()), None);
    }
}

#[test]
fn what_does_not_vibrate_or_is_no_number_has_no_limit() {
    struct Free([LinearCoordinate; 1], f64);
    impl SecondOrderSystem for Free {
        fn linear(&self) -> &[LinearCoordinate] {
            &self.0
        }
        fn force_into(&mut self, _t: f64, _y: &[f64], _v: &[f64], g: &mut [f64]) {
            g[0] = 1.0;
        }
        fn tangent_into(&mut self, _t: f64, _y: &[f64], _v: &[f64], tangent: &mut Tangent) {
            let term = tangent.add();
            (term.left[0], term.position[0]) = (1.0, self.1);
        }
    }
    let still = LinearCoordinate { squared_frequency: 0.0, damping: 0.0 };
    let state = State { t: 0.0, y: vec![0.0], v: vec![0.0] };
    for slope in [0.0, 4.0, f64::NAN] {
        let mut free = Free([still], slope);
        for method in [Method::Exponential, Method::NewmarkExplicit] {
            assert_eq!(method.step_limit(&mut free, &state), None, "{slope}");
        }
    }
}

/// A body on a spring and a damper that the force holds: `y'' = -y - damping y'`.
struct Damped(f64);

const FREE: [LinearCoordinate; 1] = [LinearCoordinate { squared_frequency: 0.0, damping: 0.0 }];

impl SecondOrderSystem for Damped {
    fn linear(&self) -> &[LinearCoordinate] {
        &FREE
    }
    fn force_into(&mut self, _t: f64, y: &[f64], v: &[f64], g: &mut [f64]) {
        g[0] = -y[0] - self.0 * v[0];
    }
    fn tangent_into(&mut self, _t: f64, _y: &[f64], _v: &[f64], tangent: &mut Tangent) {
        let term = tangent.add();
        (term.left[0], term.position[0], term.velocity[0]) = (1.0, -1.0, -self.0);
    }
}

/// Spectral radius of a step of velocity Verlet with the damping at the velocity under the held force, by its matrix on position,
/// velocity and force.
fn radius(damping: f64, h: f64) -> f64 {
    let position = [1.0, h, 0.5 * h * h];
    let predicted = [0.0, 1.0, h];
    let force = std::array::from_fn::<f64, 3, _>(|k| -position[k] - damping * predicted[k]);
    let velocity =
        std::array::from_fn::<f64, 3, _>(|k| predicted[k] + 0.5 * h * (force[k] - f64::from(u8::from(k == 2))));
    let rows = [position, velocity, force];
    let matrix = DenseMatrix::from_fn(3, 3, |i, j| rows[i][j]);
    let spectrum = general_spectrum(&matrix).expect("finite");
    let sizes = spectrum.values.iter().map(|value| value.re.hypot(value.im));
    sizes.fold(0.0, f64::max)
}

/// A damper that the force holds shortens the step: a tenth of critical damping by a tenth, critical damping to a third.
#[test]
fn damping_in_the_force_shortens_the_step_as_the_matrix_says() {
    let state = State { t: 0.0, y: vec![0.0], v: vec![0.0] };
    let mut last = 2.0;
    for damping in [0.02, 0.2, 0.6, 2.0, 20.0] {
        let limit = Method::Exponential.step_limit(&mut Damped(damping), &state);
        let limit = limit.expect("a limit").step_s;
        // the search ends within 4e-4, and takes growth below UNSTABLE for none
        assert!(radius(damping, 0.998 * limit) < 1.0 + 5e-4, "{damping}");
        assert!(radius(damping, 1.002 * limit) > 1.0 + 5e-4, "{damping}");
        assert!(limit < last, "{damping}: {limit}");
        last = limit;
    }
    assert!(last < 0.1);
}

/// A mode that is held exactly, with a soft contact between it and a body: its phase reaches pi before the body's reaches 2, where
/// it is 2.5 pi.
#[test]
fn a_resonance_is_told_from_the_limit() {
    struct Held([LinearCoordinate; 2]);
    impl SecondOrderSystem for Held {
        fn linear(&self) -> &[LinearCoordinate] {
            &self.0
        }
        fn force_into(&mut self, _t: f64, y: &[f64], _v: &[f64], g: &mut [f64]) {
            let pull = 0.065 * (y[1] - y[0]);
            (g[0], g[1]) = (pull, -pull);
        }
        fn tangent_into(&mut self, _t: f64, _y: &[f64], _v: &[f64], tangent: &mut Tangent) {
            let term = tangent.add();
            (term.left[0], term.left[1]) = (0.065, -0.065);
            (term.position[0], term.position[1]) = (-1.0, 1.0);
        }
    }
    let held = LinearCoordinate { squared_frequency: 1.0, damping: 0.0 };
    let mut system = Held([held, FREE[0]]);
    let method = Method::Exponential;
    let limit = method.step_limit(&mut system, &rest()).expect("a limit");
    // of the body alone 2 / sqrt(0.065) = 7.84; the mode moves it a little
    assert!((7.2..8.5).contains(&limit.step_s), "{limit:?}");
    let found = method.resonance(&mut system, &rest(), 3.1).expect("near pi");
    assert_eq!(found.multiple, 1);
    assert!((found.mode_hz * TAU - 1.0).abs() < 1e-12);
    // at 2 pi the force has no hold on the mode
    for h in [1.0, 2.0, TAU] {
        assert_eq!(method.resonance(&mut system, &rest(), h), None, "{h}");
    }
}

/// Two bodies on contacts of which the method knows no spring, beside a force so large that a tolerance sees nothing of them.
struct BesideLarge;

impl BesideLarge {
    const STIFFNESS: [f64; 2] = [1.0, 0.4];
}

impl SecondOrderSystem for BesideLarge {
    fn linear(&self) -> &[LinearCoordinate] {
        const TWO: [LinearCoordinate; 2] = [FREE[0]; 2];
        &TWO
    }
    fn force_into(&mut self, _t: f64, y: &[f64], _v: &[f64], g: &mut [f64]) {
        for ((g, y), stiffness) in g.iter_mut().zip(y).zip(Self::STIFFNESS) {
            *g = -stiffness * y;
        }
    }
    fn tangent_into(&mut self, _t: f64, _y: &[f64], _v: &[f64], tangent: &mut Tangent) {
        for (place, stiffness) in Self::STIFFNESS.into_iter().enumerate() {
            let term = tangent.add();
            (term.left[place], term.position[place]) = (stiffness, -1.0);
        }
    }
    fn own_springs_into(&self, springs: &mut [f64], sizes: &mut [f64]) {
        springs.fill(0.0);
        sizes.fill(1e9);
    }
}

/// A tolerance refers to the largest force: what is small beside it grows in steps beyond the limit, unseen.
#[test]
fn steps_by_tolerance_have_a_limit_for_what_is_small() {
    let method = Method::ExponentialAdams { tolerance: Some(1e-2) };
    let start = || State { t: 0.0, y: vec![1.0, 0.5], v: vec![0.0; 2] };
    let limit = method.step_limit(&mut BesideLarge, &start());
    let limit = limit.expect("a limit").step_s;
    for (part, grows) in [(0.95, false), (1.05, true)] {
        let step = part * limit;
        let mut state = start();
        let went = integrate(
            &mut BesideLarge,
            method,
            &Schedule::covering(400.0 * step, step, step).unwrap(),
            &mut state,
            &mut NoRecord,
            |_, _| Stepping::Continue,
        );
        let size = state.y.iter().fold(0.0_f64, |most, y| most.max(y.abs()));
        assert_eq!(went.is_err() || size > 10.0, grows, "{part}: {size}");
    }
}
