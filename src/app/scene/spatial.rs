//! The bearing of a case in space, and what loads it.

use super::bearing::{contacts_of, geometry};
use crate::app::case::{self, Case, ContactStiffness, Preload};
use crate::app::error::ComputeError;
use crate::bearing::ContactStiffness as Stiffness;
use crate::bearing::spatial::{MountedBearing, RigidShaft, ShaftLoad, SpatialBearing};
use crate::system::LoadProfile;
use std::f64::consts::TAU;

/// A bearing on a rigid shaft, with the load that it carries.
#[derive(Debug, Clone)]
pub(crate) struct SpatialScene {
    /// The bearing by itself.
    pub bearing: SpatialBearing,
    /// Azimuth of ball 0, rad.
    pub cage_angle: f64,
    /// Speed of the shaft, rad/s.
    pub speed: f64,
    /// Instant of the loads, s.
    pub time: f64,
    /// Load of the case, weight included, without preload.
    pub load: ShaftLoad,
    pub preload: Option<Preload>,
    /// Whether the shaft's tilt is held at zero.
    pub holds_tilt: bool,
}

impl SpatialScene {
    /// The scene at the highest speed of the case, or at another one (rpm).
    ///
    /// # Errors
    /// [`ComputeError`] naming what is out of range.
    pub(crate) fn build(case: &Case, rpm: Option<f64>, holds_tilt: bool) -> Result<Self, ComputeError> {
        let (asked, asked_shaft) = case.for_bearing()?;
        let knots = case.speed.iter().flat_map(|speed| &speed.profile);
        let fastest = knots.max_by(|a, b| a.frequency_hz.abs().total_cmp(&b.frequency_hz.abs()));
        let time = fastest.map_or(0.0, |knot| knot.time);
        let hz = fastest.map_or(0.0, |knot| knot.frequency_hz);
        Ok(Self {
            bearing: spatial_bearing(case, asked)?,
            cage_angle: asked.first_ball_deg.to_radians(),
            speed: TAU * rpm.map_or(hz, |rpm| rpm / 60.0),
            time,
            load: load_of(asked_shaft, time),
            preload: asked.preload,
            holds_tilt,
        })
    }

    /// The shaft in its bearing and its load, with the preload of the case.
    ///
    /// # Errors
    /// [`ComputeError`] as of [`RigidShaft::new`].
    pub(crate) fn shaft(&self) -> Result<(RigidShaft, ShaftLoad), ComputeError> {
        let mounted =
            MountedBearing { bearing: self.bearing.clone(), place: 0.0, offset: 0.0, cage_angle: self.cage_angle };
        let mut shaft = RigidShaft::new(vec![mounted], self.speed).map_err(ComputeError::bearing("bearing: "))?;
        let mut load = self.load;
        let sign = self.bearing.thrust().sign();
        match self.preload {
            Some(Preload::Force(force)) => load.force[2] += sign * force,
            Some(Preload::Displacement(displacement)) => shaft.held[2] = Some(sign * displacement),
            None => {}
        }
        if self.holds_tilt {
            shaft.held[3] = Some(0.0);
            shaft.held[4] = Some(0.0);
        }
        Ok((shaft, load))
    }
}

/// The bearing that is asked for.
pub(super) fn spatial_bearing(case: &Case, asked: &case::Bearing) -> Result<SpatialBearing, ComputeError> {
    let geometry = geometry(case, asked)?;
    let contacts = contacts_of(case, asked)?;
    let moduli = [contacts.inner.effective_modulus, contacts.outer.effective_modulus];
    let control = asked.race_control.unwrap_or_default();
    let bearing = SpatialBearing::new(geometry, moduli, asked.thrust_or_default(), control)
        .map_err(ComputeError::bearing("bearing: "))?;
    Ok(match asked.stiffness {
        ContactStiffness::Hertz => bearing,
        ContactStiffness::Given { inner, outer } => {
            let given = Stiffness::given(inner, outer).map_err(ComputeError::bearing("bearing.stiffness: "))?;
            bearing.with_stiffness(given)
        }
    })
}

/// Loads and weight at an instant, about the bearing's centre.
fn load_of(asked: &case::Shaft, time: f64) -> ShaftLoad {
    let [gx, gy] = asked.gravity;
    let weight = [asked.mass * gx, asked.mass * gy];
    let mut load = ShaftLoad { force: [weight[0], weight[1], 0.0], ..ShaftLoad::default() };
    let mut turn = |at: f64, [x, y]: [f64; 2], [a, b]: [f64; 2]| {
        load.moment[0] += a - at * y;
        load.moment[1] += b + at * x;
    };
    turn(asked.centre.unwrap_or(0.0), weight, [0.0; 2]);
    for part in &asked.loads {
        let (at, profile) = spatial_load(part);
        let [x, y, z, a, b] = profile.at(time);
        turn(at, [x, y], [a, b]);
        load.force = [load.force[0] + x, load.force[1] + y, load.force[2] + z];
    }
    load
}

/// A load of the case: its place from the first bearing's centre (m), and force and moment over time.
pub(super) fn spatial_load(asked: &case::Load) -> (f64, LoadProfile<5>) {
    let (at, points) = asked.in_space();
    let profile = match (asked, points.as_slice()) {
        (case::Load::Constant(_) | case::Load::Spatial { .. }, [(_, only)]) => LoadProfile::constant(*only),
        (_, points) => LoadProfile::through(points),
    };
    (at, profile)
}
