//! The methods by name, and what limits their steps.

/// Integration method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Exponential velocity Verlet.
    Exponential,
    /// Exponential Adams method.
    ExponentialAdams {
        /// Largest part of the force, in units of the largest that a coordinate has seen, that a step may leave out of its
        /// prediction: steps are halved until it is less, and of fourth order where that predicts better. Equal steps of third
        /// order without it.
        tolerance: Option<f64>,
    },
    /// Central differences with implicit damping, the source paper's.
    NewmarkExplicit,
    /// Impulses of the force between exact flows: keeps no equilibrium between a force and a spring.
    Splitting,
    /// Newmark's method of average acceleration, implicit: stable at every step, keeps energy.
    Newmark,
    /// Generalized-alpha, implicit: stable at every step, damps what the step does not resolve.
    GeneralizedAlpha {
        /// Share of the amplitude that a step leaves of a motion far too fast for it, 0 to 1.
        spectral_radius: f64,
    },
    /// Explicit Runge-Kutta of order 8(5,3) with a step of its own.
    Dop853 {
        /// Largest error of a step in units of what each coordinate reaches in the run, from [`LEAST_TOLERANCE`] to 1.
        tolerance: f64,
        /// Whether steps end where the force is not smooth, as far as the system tells.
        events: bool,
    },
}

/// Least tolerance of a method with a step of its own: below this round-off alone would shorten the steps.
pub const LEAST_TOLERANCE: f64 = 1e-14;

/// How long a step may be at a state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepLimit {
    /// Largest step below which no small motion about the state grows, resonances left out, s.
    pub step_s: f64,
    /// Highest frequency of what the method meets explicitly there, Hz.
    pub highest_hz: f64,
}

/// A mode that grows because its phase in a step is near a multiple of pi.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct Resonance {
    /// Frequency of the mode, Hz.
    pub mode_hz: f64,
    /// Of pi, at least 1.
    pub multiple: u32,
}

impl Method {
    /// Whether steps follow from a tolerance instead of the schedule.
    pub(crate) fn chooses_its_steps(self) -> bool {
        matches!(self, Self::Dop853 { .. } | Self::ExponentialAdams { tolerance: Some(_) })
    }

    /// Whether a step is solved for: no step is too long for a linear system.
    pub(crate) fn is_implicit(self) -> bool {
        matches!(self, Self::Newmark | Self::GeneralizedAlpha { .. })
    }

    /// Name in case files and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Exponential => "exponential",
            Self::ExponentialAdams { .. } => "exponential-adams",
            Self::NewmarkExplicit => "newmark-explicit",
            Self::Splitting => "splitting",
            Self::Newmark => "newmark",
            Self::GeneralizedAlpha { .. } => "generalized-alpha",
            Self::Dop853 { .. } => "dop853",
        }
    }
}
