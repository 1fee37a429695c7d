//! What can go wrong between structure and bearing.

use crate::fe::reduction::frf::FrfError;
use crate::numerics::Brief;
use crate::numerics::linalg::LinalgError;
use std::fmt;
use thiserror::Error;

/// Failure of a coupled computation.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SystemError {
    /// A linear algebra step failed.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
    /// Damping out of range.
    #[error(transparent)]
    Damping(#[from] FrfError),
    /// A superelement or a sensor row of another size than the structure's.
    #[error("{0}")]
    OtherSize(String),
    /// What the input asks for does not exist, and what to change.
    #[error("{0}")]
    Refused(&'static str),
    /// A selection without modes.
    #[error(
        "no mode of the structure is kept: the lowest is at {lowest_hz:.4e} Hz; raise accuracy.band_hz or set transient.modes"
    )]
    NoModesKept {
        /// Lowest frequency of the structure, Hz.
        lowest_hz: f64,
    },
    /// No stable equilibrium found.
    #[error(
        "no static equilibrium found after {iterations} iterations: the forces on shaft and balls are still {} N out of balance; {pressed}",
        Brief::rounded(*residual_n, 4)
    )]
    NoEquilibrium {
        /// Iterations made.
        iterations: usize,
        /// Largest force out of balance, N.
        residual_n: f64,
        /// What the load would do to one ball.
        pressed: Pressed,
    },
}

/// A ball that carries the whole load by itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pressed {
    /// The load, N.
    pub load_n: f64,
    /// Stiffness of both contacts in series, N/m^1.5.
    pub stiffness: f64,
    /// Half the ball's radius, m: beyond it neither Hertz theory nor the geometry holds.
    pub limit_m: f64,
}

/// What to check.
impl fmt::Display for Pressed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let pressed_m = (self.load_n / self.stiffness).powf(2.0 / 3.0);
        if pressed_m < self.limit_m {
            return f.write_str("check loads and clearance");
        }
        let [load, stiffness, pressed, limit] =
            [self.load_n, self.stiffness, pressed_m, self.limit_m].map(|value| Brief::rounded(value, 4));
        write!(
            f,
            "{load} N on contacts of {stiffness} N/m^1.5 press a ball by {pressed} m, and the model holds to {limit} m, half its radius: check loads, masses and bearing.stiffness"
        )
    }
}
