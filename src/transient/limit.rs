//! Largest stable step of a method at a state: the part of the motion that the method meets explicitly, and how fast it is.
//!
//! ```text
//! d g = sum_k left_k (position_k . d y) = -K d y       omega^2 the largest eigenvalue of K, or of diag(omega_i^2) + K
//! ```
//!
//! The coordinates have unit mass, so that eigenvalues are squared frequencies; K is symmetric only in coordinates scaled by
//! the square roots of the masses, and the general problem is solved. With r terms and n coordinates the eigenvalues of K
//! that are not zero are those of the [r x r] matrix `-position_k . left_l`. Damping is left out.

use super::adams;
use super::driver::Method;
use crate::dynamics::{SecondOrderSystem, State, Tangent};
use crate::linalg::{DenseMatrix, general_spectrum};
use std::f64::consts::TAU;

/// Phase in a step at which central differences and velocity Verlet have the root -1.
const VERLET: f64 = 2.0;

/// How long a step may be at a state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepLimit {
    /// Largest step at which no small motion about the state grows, s.
    pub step_s: f64,
    /// The frequency that sets it, Hz.
    pub highest_hz: f64,
}

/// What of a motion a method meets explicitly.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Explicit {
    /// What the force holds: the linear part is exact.
    Force,
    /// All of it.
    Motion,
}

impl Method {
    /// The method's limit at a state of a system: `2 / omega` of what the force holds for `exponential` and `splitting`,
    /// sqrt(3) / omega for `exponential-adams` with equal steps, `2 / omega` of linear part and force together for `newmark-explicit`.
    ///
    /// None for the implicit methods, which have no limit, for methods that choose their steps, and where nothing vibrates.
    /// A system that does not tell its tangent has the limit of what it tells. Modes with a large `omega h` move the limit of
    /// the exponential methods by a few percent.
    pub fn step_limit<S: SecondOrderSystem>(
        self,
        system: &mut S,
        state: &State,
    ) -> Option<StepLimit> {
        let (phase, explicit) = match self {
            Self::Exponential | Self::Splitting => (VERLET, Explicit::Force),
            Self::ExponentialAdams { tolerance: None } => (adams::STABILITY_LIMIT, Explicit::Force),
            Self::NewmarkExplicit => (VERLET, Explicit::Motion),
            Self::Newmark
            | Self::GeneralizedAlpha { .. }
            | Self::Dop853 { .. }
            | Self::ExponentialAdams { tolerance: Some(_) } => return None,
        };
        let mut tangent = Tangent::new(state.y.len());
        system.tangent_into(state.t, &state.y, &state.v, &mut tangent);
        let stiffness = match explicit {
            Explicit::Force => of_terms(&tangent),
            Explicit::Motion => of_coordinates(system, &tangent),
        };
        let highest = largest_eigenvalue(&stiffness)?.sqrt();
        (highest > 0.0).then(|| StepLimit {
            step_s: phase / highest,
            highest_hz: highest / TAU,
        })
    }
}

/// `-position_k . left_l`, \[terms x terms\].
fn of_terms(tangent: &Tangent) -> DenseMatrix {
    let terms = tangent.terms();
    DenseMatrix::from_fn(terms, terms, |k, l| {
        let pairs = tangent.position(k).iter().zip(tangent.left(l));
        -pairs.map(|(position, left)| position * left).sum::<f64>()
    })
}

/// Linear part and tangent, \[dof x dof\].
fn of_coordinates(system: &impl SecondOrderSystem, tangent: &Tangent) -> DenseMatrix {
    let dof = tangent.dof();
    let mut matrix = DenseMatrix::zeros(dof, dof);
    for (i, linear) in system.linear().iter().enumerate() {
        matrix[(i, i)] = linear.squared_frequency;
    }
    for term in 0..tangent.terms() {
        for (j, position) in tangent.position(term).iter().enumerate() {
            for (i, left) in tangent.left(term).iter().enumerate() {
                matrix[(i, j)] -= left * position;
            }
        }
    }
    matrix
}

/// Largest real part, at least zero; none of a matrix with a value that is not finite.
fn largest_eigenvalue(matrix: &DenseMatrix) -> Option<f64> {
    if matrix.nrows() == 0 {
        return Some(0.0);
    }
    let spectrum = general_spectrum(matrix).ok()?;
    let parts = spectrum.values.iter().map(|value| value.re);
    Some(parts.fold(0.0, f64::max))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::LinearCoordinate;

    const ADAMS: Method = Method::ExponentialAdams { tolerance: None };

    /// A body of 1 kg on a spring, and one of 0.01 kg that hangs on it by a contact of 1 N/m: positions of both.
    struct Pair([LinearCoordinate; 2]);

    const MASSES: [f64; 2] = [1.0, 0.01];

    impl Pair {
        fn new(squared_frequency: f64) -> Self {
            let of = |squared_frequency| LinearCoordinate {
                squared_frequency,
                damping: 0.0,
            };
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
        State {
            t: 0.0,
            y: vec![0.0; 2],
            v: vec![0.0; 2],
        }
    }

    #[test]
    fn frequencies_are_those_of_unequal_masses() {
        let mut pair = Pair::new(40.0);
        // by hand: the contact alone has the reduced mass 0.01 / 1.01 kg; with the spring of 40 N/m
        // w^4 - (40 + 101) w^2 + 4000 = 0
        let contact = 101.0_f64.sqrt();
        let both = (0.5 * (141.0 + (141.0_f64 * 141.0 - 16_000.0).sqrt())).sqrt();
        for (method, phase, highest) in [
            (Method::Exponential, 2.0, contact),
            (Method::Splitting, 2.0, contact),
            (ADAMS, 3.0_f64.sqrt(), contact),
            (Method::NewmarkExplicit, 2.0, both),
        ] {
            let limit = method.step_limit(&mut pair, &rest()).expect("a limit");
            // round-off of an eigenvalue
            assert!((limit.step_s * highest / phase - 1.0).abs() < 1e-13);
            assert!((limit.highest_hz * TAU / highest - 1.0).abs() < 1e-13);
        }
        for method in [
            Method::Newmark,
            Method::GeneralizedAlpha {
                spectral_radius: 0.8,
            },
            Method::Dop853 {
                tolerance: 1e-6,
                events: false,
            },
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
        let still = LinearCoordinate {
            squared_frequency: 0.0,
            damping: 0.0,
        };
        let state = State {
            t: 0.0,
            y: vec![0.0],
            v: vec![0.0],
        };
        for slope in [0.0, 4.0, f64::NAN] {
            let mut free = Free([still], slope);
            for method in [Method::Exponential, Method::NewmarkExplicit] {
                assert_eq!(method.step_limit(&mut free, &state), None, "{slope}");
            }
        }
    }
}
