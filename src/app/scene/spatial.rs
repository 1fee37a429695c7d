//! The bearings of a case in space on rigid rings, where they sit on the shaft, and what loads it.

use super::bearing::{contacts_of, geometry};
use super::housing::frame;
use crate::app::case::{self, Case, ContactStiffness, Preload, Rule, Seat};
use crate::app::error::ComputeError;
use crate::bearing::spatial::{BearingState, MountedBearing, RigidShaft, ShaftLoad, SpatialBearing, Thrust};
use crate::bearing::{BearingError, ContactStiffness as Stiffness, RatingLife};
use crate::fe::model::RingFrame;
use crate::system::LoadProfile;
use std::f64::consts::TAU;

/// How far from one line centres of bearings may be, m, and how far from parallel their axes, rad: what is written in six digits.
const OFF_LINE: f64 = 1e-7;
const OFF_AXIS: f64 = 1e-6;

/// Bearings on a rigid shaft, with the load that they carry.
#[derive(Debug, Clone)]
pub(crate) struct SpatialScene {
    /// In the order of the case.
    pub bearings: Vec<OwnBearing>,
    /// Speed of the shaft, rad/s.
    pub speed: f64,
    /// Instant of the loads, s.
    pub time: f64,
    /// Load of the case about the first bearing's centre, weight included, without preload.
    pub load: ShaftLoad,
    /// Whether the shaft's tilt is held at zero.
    pub holds_tilt: bool,
}

/// A bearing of a case with its place on the shaft.
#[derive(Debug, Clone)]
pub(crate) struct OwnBearing {
    /// What results call it; empty for the only one.
    pub label: String,
    /// What stands before its keys.
    pub prefix: String,
    /// The bearing by itself.
    pub bearing: SpatialBearing,
    /// Along the axis from the first one's centre, m.
    pub place: f64,
    /// Azimuth of ball 0, rad.
    pub cage_angle: f64,
    pub preload: Option<Preload>,
}

impl OwnBearing {
    /// Load rating and rating life under the loads of a state, at a speed (rad/s).
    ///
    /// # Errors
    /// [`BearingError`]: what the standard does not hold for.
    pub(crate) fn rating_life(&self, state: &BearingState, speed: f64) -> Result<RatingLife, BearingError> {
        let loads: Vec<[f64; 2]> = state.balls.iter().map(|ball| ball.load).collect();
        self.bearing.rating_life(&loads, largest_pressure(state), speed)
    }
}

/// Largest contact pressure of a bearing, Pa.
pub(crate) fn largest_pressure(state: &BearingState) -> f64 {
    let patches = state.balls.iter().flat_map(|ball| &ball.patch);
    patches.map(|patch| patch.peak_pressure).fold(0.0, f64::max)
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
        let places = match asked.len() {
            1 => vec![0.0],
            _ => {
                let seats = case.seats();
                let frames: Vec<RingFrame> = seats.iter().map(frame).collect::<Result<_, _>>()?;
                places(case, &frames, &seats)?
            }
        };
        let bearings =
            asked.into_iter().zip(places).zip(case.all_bearings()).map(|(((prefix, asked), place), (label, _))| {
                Ok(OwnBearing {
                    label,
                    prefix,
                    bearing: spatial_bearing(case, asked)?,
                    place,
                    cage_angle: asked.first_ball_deg.to_radians(),
                    preload: asked.preload,
                })
            });
        Ok(Self {
            bearings: bearings.collect::<Result<_, ComputeError>>()?,
            speed: TAU * rpm.map_or(hz, |rpm| rpm / 60.0),
            time,
            load: load_of(asked_shaft, time),
            holds_tilt,
        })
    }

    /// The shaft in its bearings and its load, with the preload of the case: of one bearing a force on the shaft or a place along the axis
    /// at which it is held, of several the places of their outer rings.
    ///
    /// # Errors
    /// [`ComputeError`] as of [`RigidShaft::new`]; for a preload that a bearing does not carry.
    pub(crate) fn shaft(&self) -> Result<(RigidShaft, ShaftLoad), ComputeError> {
        let several = self.bearings.len() > 1;
        let mounted = self.bearings.iter().map(|own| {
            let preload = own.preload.filter(|_| several);
            let offset = offset(&own.bearing, preload);
            Ok(MountedBearing {
                bearing: own.bearing.clone(),
                place: own.place,
                offset: offset.map_err(ComputeError::bearing(format!("{}bearing.preload: ", own.prefix)))?,
                cage_angle: own.cage_angle,
            })
        });
        let mounted = mounted.collect::<Result<_, ComputeError>>()?;
        let mut shaft = RigidShaft::new(mounted, self.speed).map_err(ComputeError::bearing("bearing: "))?;
        let mut load = self.load;
        if let [own] = self.bearings.as_slice() {
            let sign = own.bearing.thrust().sign();
            match own.preload {
                Some(Preload::Force(force)) => load.force[2] += sign * force,
                Some(Preload::Displacement(displacement)) => shaft.held[2] = Some(sign * displacement),
                None => {}
            }
        }
        if self.holds_tilt {
            shaft.held[3] = Some(0.0);
            shaft.held[4] = Some(0.0);
        }
        Ok((shaft, load))
    }

    /// The preload of the first bearing; `None` where a bearing has none, or another kind.
    pub(crate) fn preload(&self) -> Option<Preload> {
        let first = self.bearings.first()?.preload?;
        let alike = |own: &OwnBearing| {
            own.preload.is_some_and(|own| std::mem::discriminant(&own) == std::mem::discriminant(&first))
        };
        self.bearings.iter().all(alike).then_some(first)
    }

    /// The same with another preload of the first bearing (N, or m), and that of the others by the same factor.
    pub(crate) fn preloaded(&self, first: Preload) -> Self {
        let size = |preload: Preload| match preload {
            Preload::Force(value) | Preload::Displacement(value) => value,
        };
        let factor = self.preload().map_or(1.0, |own| size(first) / size(own));
        let mut scene = self.clone();
        for (index, own) in scene.bearings.iter_mut().enumerate() {
            own.preload = match own.preload {
                _ if index == 0 => Some(first),
                Some(Preload::Force(force)) => Some(Preload::Force(factor * force)),
                Some(Preload::Displacement(displacement)) => Some(Preload::Displacement(factor * displacement)),
                None => None,
            };
        }
        scene
    }
}

/// How far along z an outer ring is set so that its bearing, mounted and without load, has this preload, m.
pub(super) fn offset(bearing: &SpatialBearing, preload: Option<Preload>) -> Result<f64, BearingError> {
    match preload {
        None => Ok(0.0),
        Some(Preload::Displacement(displacement)) => Ok(-bearing.thrust().sign() * displacement),
        Some(Preload::Force(force)) => Ok(-bearing.axial_displacement(force)?),
    }
}

/// Refuses preload between bearings that all hold thrust the same way: nothing holds it, and it would vanish.
fn refuse_one_way_preload(case: &Case, seats: &[Seat<'_>]) -> Result<(), ComputeError> {
    let thrusts: Vec<Thrust> =
        seats.iter().filter_map(|seat| seat.bearing).map(case::Bearing::thrust_or_default).collect();
    for seat in seats {
        let Some(own) = seat.bearing.filter(|own| own.preload.is_some()) else { continue };
        let thrust = own.thrust_or_default();
        if seats.len() > 1 && thrust != Thrust::Both && thrusts.iter().all(|other| *other == thrust) {
            let rule = Rule::found(
                "a preload between bearings that all hold thrust the same way",
                "one that holds it the other way, or no preload",
            );
            return Err(case.broken(&rule.at(seat.key("bearing.preload"))).into());
        }
    }
    Ok(())
}

/// Places of the bearings along the first one's axis from its centre, m: they have to be on one line, their angles counted alike.
pub(super) fn places(case: &Case, frames: &[RingFrame], seats: &[Seat<'_>]) -> Result<Vec<f64>, ComputeError> {
    let Some(first) = frames.first() else { return Ok(Vec::new()) };
    refuse_one_way_preload(case, seats)?;
    let mut places = Vec::with_capacity(frames.len());
    for (frame, seat) in frames.iter().zip(seats) {
        let [x, y, z] = first.point(frame.centre());
        let off = x.hypot(y);
        if off > OFF_LINE {
            let rule = Rule::found(
                format!("a centre {:.3e} m beside the axis of the first bearing", off),
                "one on it: a rigid shaft runs through all bearings",
            );
            return Err(case.broken(&rule.at(seat.key("ring.tie.centre"))).into());
        }
        for (key, local) in [("axis", [0.0, 0.0, 1.0]), ("zero_deg", [1.0, 0.0, 0.0])] {
            let seen = first.vector(frame.vector_to_mesh(local));
            let apart = (0..3).map(|k| (seen[k] - local[k]).powi(2)).sum::<f64>().sqrt();
            if apart > OFF_AXIS {
                let rule = Rule::found("another direction than that of the first bearing", "the same for all bearings");
                return Err(case.broken(&rule.at(seat.key(&format!("ring.tie.{key}")))).into());
            }
        }
        if places.iter().any(|place: &f64| (place - z).abs() <= OFF_LINE) {
            let rule = Rule::found("a centre where another bearing has its own", "a place of its own along the axis");
            return Err(case.broken(&rule.at(seat.key("ring.tie.centre"))).into());
        }
        places.push(z);
    }
    Ok(places)
}

/// The bearing that is asked for.
pub(super) fn spatial_bearing(case: &Case, asked: &case::Bearing) -> Result<SpatialBearing, ComputeError> {
    let geometry = geometry(case, asked)?;
    let contacts = contacts_of(case, asked)?;
    let moduli = [contacts.inner.effective_modulus, contacts.outer.effective_modulus];
    let control = asked.race_control.unwrap_or_default();
    let bearing = SpatialBearing::new(geometry, moduli, asked.thrust_or_default(), control)
        .map_err(ComputeError::bearing("bearing: "))?
        .with_nominal_angle(asked.contact_angle_deg.unwrap_or(0.0).to_radians());
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
