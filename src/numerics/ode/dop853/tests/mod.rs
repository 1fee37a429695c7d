//! The embedded Runge-Kutta method of order 8.

mod contact;
mod order;
mod steps;

use super::super::Method;
use crate::numerics::ode::LinearCoordinate;

fn method(tolerance: f64) -> Method {
    Method::Dop853 { tolerance, events: false }
}

/// A coordinate without spring and damper.
fn free() -> [LinearCoordinate; 1] {
    [LinearCoordinate { squared_frequency: 0.0, damping: 0.0 }]
}
