//! What of a scene is modelled, and how it is stepped.

use super::structure::MODELLED;
use super::{Scene, StageError};
use crate::case::{self, Case, ModesKept, StepLength};
use crate::system::{BallsInertia, CoupledSystem, Formulation, ModeSelection};
use crate::transient::Method;

/// `auto` step of the exponential method: phase of the stiffest ball vibration in one step, rad.
const AUTO_PHASE: f64 = 0.1;

/// Largest ball force that `auto` prepares for, in units of the largest static one: impacts in a
/// dent of the source's size reach five to ten times.
const AUTO_FORCE: f64 = 10.0;

/// The source's step for explicit Newmark, s (section 4.1).
const NEWMARK_STEP: f64 = 1.5e-8;

/// Tolerance of `dop853` unless one is given: far below one percent after some milliseconds of impacts.
const TOLERANCE: f64 = 1e-6;

/// Default of generalized-alpha: takes what is not resolved out within some tens of steps, and of a motion of 0.1 rad a step
/// 7e-8 of the amplitude.
const SPECTRAL_RADIUS: f64 = 0.8;

/// What of a scene is modelled, and how it is stepped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunModel {
    /// Kept modes of ring and housing.
    pub modes: ModeSelection,
    /// Whether the static flexibility of the others acts in contacts and sensors.
    pub residual: bool,
    /// Integration method.
    pub method: Method,
    /// Largest step, or time between samples of a method that chooses its steps, s.
    pub step: f64,
}

impl RunModel {
    /// The model that a case asks for.
    ///
    /// # Errors
    /// [`StageError`] for modes or a residual that do not fit the scene.
    pub fn of_case(
        case: &Case,
        asked: &case::Transient,
        scene: &Scene,
    ) -> Result<Self, StageError> {
        let method = method(asked);
        let mut model = Self {
            modes: selection(case, asked, scene, method),
            residual: asked.residual,
            method,
            step: 0.0,
        };
        model.step = match asked.step {
            StepLength::Seconds(step) => step,
            StepLength::Auto => auto_step(method, scene, &scene.system(&model)?),
        };
        Ok(model)
    }
}

/// The method that a case asks for.
fn method(asked: &case::Transient) -> Method {
    match asked.method {
        case::Method::Auto | case::Method::Exponential => Method::Exponential,
        case::Method::NewmarkExplicit => Method::NewmarkExplicit,
        case::Method::ExponentialAdams => Method::ExponentialAdams {
            tolerance: asked.tolerance,
        },
        case::Method::Splitting => Method::Splitting,
        case::Method::Newmark => Method::Newmark,
        case::Method::GeneralizedAlpha => Method::GeneralizedAlpha {
            spectral_radius: asked.spectral_radius.unwrap_or(SPECTRAL_RADIUS),
        },
        case::Method::Dop853 => Method::Dop853 {
            tolerance: asked.tolerance.unwrap_or(TOLERANCE),
            events: true,
        },
    }
}

fn selection(case: &Case, asked: &case::Transient, scene: &Scene, method: Method) -> ModeSelection {
    let top = case.band_hz().map_or(40e3, |band| band[1]);
    match asked.modes {
        ModesKept::All => ModeSelection::All,
        ModesKept::Count(count) => ModeSelection::Count(count),
        // the source's method steps all ring displacements, and its equations need them
        ModesKept::Auto
            if method == Method::NewmarkExplicit
                || scene.setup.formulation == Formulation::Printed =>
        {
            ModeSelection::All
        }
        // the static residual stands for the rest
        ModesKept::Auto => ModeSelection::UpTo(MODELLED * top),
    }
}

/// Step that resolves the fastest motion on the contacts at [`AUTO_FORCE`] times the largest static force, with
/// `k' = 3/2 k^(2/3) F^(1/3)`: that of a ball between both, `h = AUTO_PHASE / sqrt((k_i' + k_o') / m_b)`, or without the
/// balls' inertia that of race and shaft on both in series.
fn auto_step(method: Method, scene: &Scene, system: &CoupledSystem) -> f64 {
    let setup = &scene.setup;
    let largest = scene
        .equilibrium
        .balls
        .iter()
        .map(|ball| ball.inner.max(ball.outer))
        .fold(setup.geometry.ball_mass() * 9.81, f64::max);
    let tangent = |stiffness: f64| 1.5 * stiffness.cbrt().powi(2) * (AUTO_FORCE * largest).cbrt();
    let [inner, outer] = [setup.stiffness.inner(), setup.stiffness.outer()].map(tangent);
    let stiffness = match setup.balls_inertia {
        BallsInertia::Dynamic => inner + outer,
        BallsInertia::QuasiStatic => inner * outer / (inner + outer),
    };
    let resolved = AUTO_PHASE / (stiffness * system.contact_mobility()).sqrt();
    if method == Method::NewmarkExplicit {
        let highest = system.highest_squared_frequency().sqrt();
        // half the stability limit, and never above the source's own step
        NEWMARK_STEP.min(1.0 / highest.max(f64::MIN_POSITIVE))
    } else {
        resolved
    }
}
