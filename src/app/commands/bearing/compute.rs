//! `plummer bearing`: where the shaft rests, and what becomes of it with load, speed and preload.

use crate::app::case::{Case, Preload};
use crate::app::commands::parts::without_round_off;
use crate::app::error::ComputeError;
use crate::app::scene::spatial::SpatialScene;
use crate::bearing::kinematics::{BallRow, DefectOrders};
use crate::bearing::life::STATIC_PRESSURE;
use crate::bearing::spatial::{BallState, RingDisplacement, ShaftEquilibrium, ShaftLoad, Thrust};
use crate::bearing::{BearingError, RatingLife};
use crate::numerics::Watch;
use schemars::JsonSchema;
use serde::Serialize;
use std::f64::consts::TAU;

/// Points of a curve.
pub(super) const POINTS: usize = 25;

/// Factors of the load from the first to the last point of the curve.
pub(super) const FACTORS: [f64; 2] = [0.1, 10.0];

/// Preloads of the curve: from this share of its middle to this multiple.
const PRELOADS: [f64; 2] = [0.1, 4.0];

/// Result of the command.
#[derive(Debug, Clone)]
pub struct BearingResult {
    /// Speed of the shaft, rpm.
    pub speed_rpm: f64,
    /// Instant of the loads, s.
    pub time_s: f64,
    /// Load on the shaft, weight and preload included.
    pub load: ShaftLoad,
    /// Thrust that the bearing holds.
    pub thrust: Thrust,
    /// Radial play, m, and free contact angle, rad, where there is one.
    pub play: f64,
    /// Free contact angle, rad; `None` for a bearing without play.
    pub free_contact_angle: Option<f64>,
    /// The equilibrium to which the load leads, then the others that were found.
    pub equilibria: Vec<ShaftEquilibrium>,
    /// Mean contact angle of the balls under load, each weighted by its load at the inner race, rad.
    pub contact_angle: f64,
    /// Orders at that angle.
    pub orders: DefectOrders,
    /// Load rating and rating life; `None` where the standard does not hold, which the doubts say.
    pub life: Option<RatingLife>,
    /// Over the factor of the load.
    pub over_load: Vec<CurvePoint>,
    /// Over the speed, rpm; empty without speed.
    pub over_speed: Vec<CurvePoint>,
    /// Over the preload: a force, N, or a displacement, m, where the case gives one.
    pub over_preload: Vec<CurvePoint>,
    /// Whether the preload is a displacement.
    pub preload_is_displacement: bool,
    /// What of the model may be meant otherwise, a sentence each.
    pub doubts: Vec<String>,
}

/// Displacement, stiffness and life at one point of a curve; `None` where no equilibrium was found.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CurvePoint {
    /// Factor of the load, speed (rpm), or preload (N, or m).
    pub at: f64,
    /// Displacement x, y, z (m) and tilt about x, y (rad).
    pub displacement: Option<[f64; 5]>,
    /// Stiffness along x, y, z (N/m) and against tilt about x, y (N m/rad).
    pub stiffness: Option<[f64; 5]>,
    /// Basic reference rating life, millions of revolutions; `None` also where it is not given.
    pub life: Option<f64>,
}

/// Finds where the shaft of a case rests in its bearing, at the highest speed of the case or at `rpm`.
///
/// # Errors
/// [`ComputeError`]: what is out of range; a load that the bearing cannot carry.
pub fn compute_bearing(
    case: &Case,
    rpm: Option<f64>,
    holds_tilt: bool,
    watch: &impl Watch,
) -> Result<BearingResult, ComputeError> {
    let (asked, _) = case.for_bearing()?;
    let scene = SpatialScene::build(case, rpm, holds_tilt)?;
    if let (Some(Preload::Displacement(_)), true) = (scene.preload, scene.load.force[2].abs() > 0.0) {
        return Err(ComputeError::input(
            "bearing.preload.displacement: found beside a load along z, expected one of the two: the inner ring is held along z",
            "leave the load along z out, or give the preload as a force",
        ));
    }
    watch.stage("equilibrium");
    let (shaft, load) = scene.shaft()?;
    let equilibria = shaft.find_all(&load).map_err(no_equilibrium)?;
    let balls = equilibria.first().and_then(|taken| taken.bearings.first()).map_or(&[][..], |state| &state.balls);
    let geometry = scene.bearing.geometry();
    let contact_angle = mean_angle(balls);
    let diameters = [2.0 * geometry.ball_radius(), 2.0 * geometry.pitch_radius()];
    let row =
        BallRow::new(geometry.balls(), diameters[0], diameters[1], contact_angle.abs()).map_err(no_equilibrium)?;
    let mut result = BearingResult {
        speed_rpm: scene.speed * 60.0 / TAU,
        time_s: scene.time,
        load,
        thrust: scene.bearing.thrust(),
        play: geometry.radial_play(),
        free_contact_angle: geometry.free_contact_angle(),
        contact_angle,
        orders: row.orders(),
        life: equilibria.first().and_then(|taken| rating_life(&scene, taken).ok()),
        over_load: Vec::new(),
        over_speed: Vec::new(),
        over_preload: Vec::new(),
        preload_is_displacement: matches!(scene.preload, Some(Preload::Displacement(_))),
        doubts: doubts(case, asked, &scene, &equilibria),
        equilibria,
    };
    watch.stage("curves");
    let taken = result.equilibria[0].displacement;
    result.over_load = curve(&geometric(FACTORS), POINTS / 2, taken, |factor| {
        let by = |part: f64| factor * part;
        Ok((scene.clone(), ShaftLoad { force: load.force.map(by), moment: load.moment.map(by), ..load }))
    })?;
    watch.fraction(1.0 / 3.0);
    if scene.speed.abs() > 0.0 {
        let speeds: Vec<f64> =
            (0..POINTS).map(|point| 2.0 * result.speed_rpm * point as f64 / (POINTS - 1) as f64).collect();
        result.over_speed = curve(&speeds, POINTS / 2, taken, |rpm| {
            Ok((SpatialScene { speed: rpm * TAU / 60.0, ..scene.clone() }, load))
        })?;
    }
    watch.fraction(2.0 / 3.0);
    let size = scene.load.force.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
    let (middle, by): (f64, fn(f64) -> Preload) = match scene.preload {
        Some(Preload::Displacement(displacement)) => (displacement, Preload::Displacement),
        Some(Preload::Force(force)) => (force, Preload::Force),
        None => (size, Preload::Force),
    };
    if middle > 0.0 {
        let preloads = geometric(PRELOADS.map(|share| share * middle));
        // the result itself has the middle, or no preload
        let first = match scene.preload {
            Some(_) => preloads.partition_point(|preload| *preload < middle),
            None => 0,
        };
        result.over_preload = curve(&preloads, first, taken, |preload| {
            let scene = SpatialScene { preload: Some(by(preload)), ..scene.clone() };
            let (_, load) = scene.shaft()?;
            Ok((scene, load))
        })?;
    }
    Ok(result)
}

/// A displacement in um and mrad, as zero what is nothing but round-off beside the largest.
pub(crate) fn shown_displacement(displacement: &RingDisplacement) -> [f64; 5] {
    let ([x, y, z], [a, b]) = (displacement.translation, displacement.tilt);
    without_round_off([1e6 * x, 1e6 * y, 1e6 * z, 1e3 * a, 1e3 * b])
}

/// An angle in degrees, as zero where it is nothing but round-off.
pub(crate) fn shown_degrees(angle: f64) -> f64 {
    let degrees = angle.to_degrees();
    if degrees.abs() < 1e-9 { 0.0 } else { degrees }
}

impl BearingResult {
    /// The loads that hold prescribed displacements, what is nothing but round-off beside the load and the ball loads as zero.
    pub(crate) fn holding_load(&self, rest: &ShaftEquilibrium) -> [f64; 5] {
        let balls = rest.bearings.iter().flat_map(|state| &state.balls);
        let loads = self.load.force.iter().map(|part| part.abs()).chain(balls.map(|ball| ball.load[0]));
        let largest = loads.fold(0.0, f64::max);
        rest.holding_load.map(|load| if load.abs() < 1e-9 * largest { 0.0 } else { load })
    }
}

/// A bearing that cannot be in balance: nothing is wrong with the numbers one by one.
fn no_equilibrium(error: BearingError) -> ComputeError {
    ComputeError::failed(
        format!("the bearing at rest: {error}"),
        "check loads, `bearing.thrust` and play; --hold-tilt holds the shaft's tilt, which one bearing alone hardly does",
    )
}

/// Even steps of the logarithm.
pub(super) fn geometric([from, to]: [f64; 2]) -> Vec<f64> {
    let share = |point: usize| point as f64 / (POINTS - 1) as f64;
    (0..POINTS).map(|point| from * (to / from).powf(share(point))).collect()
}

/// Follows one branch of equilibria to both sides from place `first`, which is near the displacement `start`.
pub(super) fn curve(
    places: &[f64],
    first: usize,
    start: RingDisplacement,
    scene_at: impl Fn(f64) -> Result<(SpatialScene, ShaftLoad), ComputeError>,
) -> Result<Vec<CurvePoint>, ComputeError> {
    let mut points: Vec<CurvePoint> =
        places.iter().map(|&at| CurvePoint { at, displacement: None, stiffness: None, life: None }).collect();
    let first = first.min(places.len());
    let (before, after) = points.split_at_mut(first);
    let follow = |points: &mut dyn Iterator<Item = &mut CurvePoint>| -> Result<(), ComputeError> {
        let mut near = start;
        for point in points {
            let (scene, load) = scene_at(point.at)?;
            let (shaft, _) = scene.shaft()?;
            // a point without equilibrium is a gap
            let Ok(found) = shaft.equilibrium_near(&load, &near) else { continue };
            near = found.displacement;
            let ([x, y, z], [a, b]) = (near.translation, near.tilt);
            point.displacement = Some([x, y, z, a, b]);
            point.stiffness = Some(std::array::from_fn(|axis| found.stiffness[axis][axis]));
            point.life = rating_life(&scene, &found).ok().and_then(|life| life.life_mrev);
        }
        Ok(())
    };
    follow(&mut after.iter_mut())?;
    follow(&mut before.iter_mut().rev())?;
    Ok(points)
}

/// Load rating and rating life where the shaft rests.
fn rating_life(scene: &SpatialScene, rest: &ShaftEquilibrium) -> Result<RatingLife, BearingError> {
    let balls = rest.bearings.iter().flat_map(|state| &state.balls);
    let loads: Vec<[f64; 2]> = balls.map(|ball| ball.load).collect();
    scene.bearing.rating_life(&loads, largest_pressure(rest), scene.speed)
}

/// Largest contact pressure, Pa.
fn largest_pressure(rest: &ShaftEquilibrium) -> f64 {
    let patches = rest.bearings.iter().flat_map(|state| &state.balls).flat_map(|ball| &ball.patch);
    patches.map(|patch| patch.peak_pressure).fold(0.0, f64::max)
}

/// Mean contact angle at the inner race, weighted by the loads; 0 without any.
fn mean_angle(balls: &[BallState]) -> f64 {
    let loaded = balls.iter().filter_map(|ball| Some((ball.load[0], ball.contact_angle[0]?)));
    let (sum, weight) =
        loaded.fold((0.0, 0.0), |(sum, weight), (load, angle)| (sum + load * angle.abs(), weight + load));
    if weight > 0.0 { sum / weight } else { 0.0 }
}

/// What of the case does not count here, and what of the result is to be looked at.
pub(super) fn doubts(
    case: &Case,
    asked: &crate::app::case::Bearing,
    scene: &SpatialScene,
    equilibria: &[ShaftEquilibrium],
) -> Vec<String> {
    let mut doubts = Vec::new();
    let slips = asked.slip != crate::app::case::Slip::default();
    for (key, given) in [
        ("bearing.defects", !asked.defects.is_empty()),
        ("bearing.waviness", !asked.waviness.is_empty()),
        ("bearing.ball_radius_differences", !asked.ball_radius_differences.is_empty()),
        ("bearing.slip", slips),
        ("shaft.unbalance", case.shaft.as_ref().is_some_and(|shaft| shaft.unbalance > 0.0)),
    ] {
        if given {
            doubts.push(format!(
                "{key} does not count: the bearing at rest has sound races, equal balls and pure rolling"
            ));
        }
    }
    if case.housing.is_some() || case.ring.is_some() {
        doubts.push("[housing] and [ring] do not count: both rings of the bearing are rigid here".to_owned());
    }
    let Some(taken) = equilibria.first() else { return doubts };
    if taken.directions_loose > 0 {
        doubts.push(format!(
            "{} of the shaft's five directions are held by nothing: its place along them is where the search ended",
            taken.directions_loose
        ));
    }
    if !taken.is_stable() {
        doubts.push("the equilibrium is a saddle: the shaft leaves it".to_owned());
    }
    let others = equilibria.iter().skip(1).filter(|rest| rest.is_stable()).count();
    if others > 0 {
        let others = if others == 1 { "another stable equilibrium" } else { "other stable equilibria" };
        doubts.push(format!("the load has {others}: the table shows all that were found"));
    }
    match rating_life(scene, taken) {
        Err(error) => doubts.push(format!("no rating life, ISO 281 does not hold: {error}")),
        // ISO 281:2007, 5.3: the life of heavier loads is the maker's to tell
        Ok(life) => doubts.extend(life.reference_load_n.filter(|load| *load > 0.5 * life.load_rating_n).map(|load| {
            format!("the reference load of {load:.0} N is above half the load rating: ISO 281 leaves such a life to the maker")
        })),
    }
    let pressure = largest_pressure(taken);
    if pressure > STATIC_PRESSURE {
        doubts.push(format!(
            "the largest contact pressure is {:.0} MPa; above {:.0} MPa, the static limit of ISO 76, races are dented for good and no rating life is given: reduce the load",
            1e-6 * pressure,
            1e-6 * STATIC_PRESSURE
        ));
    }
    let balls = taken.bearings.iter().flat_map(|state| &state.balls);
    let wrong_side = balls.filter(|ball| {
        let angle = ball.contact_angle[0].unwrap_or(0.0);
        scene.bearing.thrust() != Thrust::Both && scene.bearing.thrust().sign() * angle < 0.0
    });
    let wrong_side = wrong_side.count();
    if wrong_side > 0 {
        doubts.push(format!(
            "{wrong_side} balls touch the inner race on the side where an angular contact bearing has no shoulder: such a bearing may lose these contacts"
        ));
    }
    doubts
}
