//! What drives a bearing: speed, slip and loads of a case.

use crate::app::case::{self, Case, Load, Slip};
use crate::app::error::ComputeError;
use crate::bearing::{SlipProfile, SpeedProfile};
use crate::system::{LoadProfile, Shaft};

/// Shaft speed over time; at rest where the case says nothing.
///
/// # Errors
/// [`ComputeError::Input`].
pub(crate) fn speed(case: &Case) -> Result<SpeedProfile, ComputeError> {
    let profile = match &case.speed {
        Some(speed) => SpeedProfile::new(&speed.profile),
        None => SpeedProfile::constant(0.0),
    };
    profile.map_err(ComputeError::bearing("speed.profile: "))
}

/// Slip of the cage.
///
/// # Errors
/// [`ComputeError::Input`].
pub(crate) fn slip(asked: &Slip) -> Result<SlipProfile, ComputeError> {
    let profile = match asked {
        Slip::Constant(slip) => SlipProfile::constant(*slip),
        Slip::OverTime(points) => SlipProfile::over_time(points),
        Slip::OverSpeed(points) => SlipProfile::over_speed(points),
    };
    profile.map_err(ComputeError::bearing(""))
}

/// The shaft and its loads.
pub(crate) fn shaft(asked: &case::Shaft) -> Shaft {
    let load = |load: &Load| match load {
        Load::Constant(force) => LoadProfile::constant(*force),
        Load::Profile(points) => {
            let points: Vec<_> = points.iter().map(|p| (p.time, p.force)).collect();
            LoadProfile::through(&points)
        }
    };
    Shaft { mass: asked.mass, unbalance: asked.unbalance, loads: asked.loads.iter().map(load).collect() }
}
