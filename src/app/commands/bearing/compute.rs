//! `plummer bearing`: where the shaft rests in its bearings, and what becomes of it with load, speed and preload.

use super::doubts::doubts;
use crate::app::case::{Case, Preload};
use crate::app::commands::parts::without_round_off;
use crate::app::error::ComputeError;
use crate::app::scene::spatial::{OwnBearing, SpatialScene};
use crate::bearing::kinematics::{BallRow, DefectOrders};
use crate::bearing::spatial::{BallState, BearingState, RingDisplacement, ShaftEquilibrium, ShaftLoad, Thrust};
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
    /// Every bearing, in the order of the case.
    pub bearings: Vec<BearingAtRest>,
    /// The equilibrium to which the load leads, then the others that were found.
    pub equilibria: Vec<ShaftEquilibrium>,
    /// Over the factor of the load.
    pub over_load: Vec<CurvePoint>,
    /// Over the speed, rpm; empty without speed.
    pub over_speed: Vec<CurvePoint>,
    /// Over the preload of the first bearing, the others' in proportion: a force, N, or a displacement, m, where the case gives one.
    pub over_preload: Vec<CurvePoint>,
    /// Whether the preload is a displacement.
    pub preload_is_displacement: bool,
    /// What of the model may be meant otherwise, a sentence each.
    pub doubts: Vec<String>,
}

/// A bearing where the shaft rests.
#[derive(Debug, Clone)]
pub struct BearingAtRest {
    /// What results call it; empty for the only one.
    pub label: String,
    /// Along the axis from the first one's centre, m.
    pub place: f64,
    /// Thrust that it holds.
    pub thrust: Thrust,
    /// Radial play, m.
    pub play: f64,
    /// Free contact angle, rad; `None` for a bearing without play.
    pub free_contact_angle: Option<f64>,
    /// Mean contact angle of the balls under load, each weighted by its load at the inner race, rad.
    pub contact_angle: f64,
    /// Orders at that angle.
    pub orders: DefectOrders,
    /// Load rating and rating life; `None` where the standard does not hold, which the doubts say.
    pub life: Option<RatingLife>,
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
    /// Basic reference rating life of the bearing that fails first, millions of revolutions; `None` also where one has none.
    pub life: Option<f64>,
}

/// Finds where the shaft of a case rests in its bearings, at the highest speed of the case or at `rpm`.
///
/// # Errors
/// [`ComputeError`]: what is out of range; a load that the bearing cannot carry.
pub fn compute_bearing(
    case: &Case,
    rpm: Option<f64>,
    holds_tilt: bool,
    watch: &impl Watch,
) -> Result<BearingResult, ComputeError> {
    let scene = SpatialScene::build(case, rpm, holds_tilt)?;
    let alone = scene.bearings.len() == 1;
    if let (Some(Preload::Displacement(_)), true, true) = (scene.preload(), alone, scene.load.force[2].abs() > 0.0) {
        return Err(ComputeError::input(
            "bearing.preload.displacement: found beside a load along z, expected one of the two: the inner ring is held along z",
            "leave the load along z out, or give the preload as a force",
        ));
    }
    watch.stage("equilibrium");
    let (shaft, load) = scene.shaft()?;
    let equilibria = shaft.find_all(&load).map_err(no_equilibrium)?;
    let Some(taken) = equilibria.first() else {
        return Err(ComputeError::failed("no place was found where the shaft rests", REST_HELP));
    };
    let at_rest = scene.bearings.iter().zip(&taken.bearings).map(|(own, state)| at_rest(&scene, own, state));
    let mut result = BearingResult {
        speed_rpm: scene.speed * 60.0 / TAU,
        time_s: scene.time,
        load,
        bearings: at_rest.collect::<Result<_, BearingError>>().map_err(no_equilibrium)?,
        over_load: Vec::new(),
        over_speed: Vec::new(),
        over_preload: Vec::new(),
        preload_is_displacement: matches!(scene.preload(), Some(Preload::Displacement(_))),
        doubts: doubts(case, &scene, &equilibria),
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
    let (middle, by): (f64, fn(f64) -> Preload) = match scene.preload() {
        Some(Preload::Displacement(displacement)) => (displacement, Preload::Displacement),
        Some(Preload::Force(force)) => (force, Preload::Force),
        None if alone => (size, Preload::Force),
        None => (0.0, Preload::Force),
    };
    if middle > 0.0 {
        let preloads = geometric(PRELOADS.map(|share| share * middle));
        // the result itself has the middle, or no preload
        let first = match scene.preload() {
            Some(_) => preloads.partition_point(|preload| *preload < middle),
            None => 0,
        };
        result.over_preload = curve(&preloads, first, taken, |preload| {
            let scene = scene.preloaded(by(preload));
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

impl BearingAtRest {
    /// "bearing A"; `None` for the only one.
    pub(crate) fn named(&self) -> Option<String> {
        (!self.label.is_empty()).then(|| format!("bearing {}", self.label))
    }

    /// A title that names it where there are several.
    pub(super) fn titled(&self, title: &str) -> String {
        self.named().map_or_else(|| title.to_owned(), |name| format!("{title}, {name}"))
    }
}

impl BearingResult {
    /// What is to be said of each bearing in one line, with its label where there are several.
    pub(super) fn each(&self, words: impl Fn(&BearingAtRest) -> Option<String>) -> String {
        let told = self.bearings.iter().filter_map(|own| {
            let words = words(own)?;
            Some(if own.label.is_empty() { words } else { format!("{} {words}", own.label) })
        });
        told.collect::<Vec<_>>().join(", ")
    }

    /// The loads that hold prescribed displacements, what is nothing but round-off beside the load and the ball loads as zero.
    pub(crate) fn holding_load(&self, rest: &ShaftEquilibrium) -> [f64; 5] {
        let balls = rest.bearings.iter().flat_map(|state| &state.balls);
        let loads = self.load.force.iter().map(|part| part.abs()).chain(balls.map(|ball| ball.load[0]));
        let largest = loads.fold(0.0, f64::max);
        rest.holding_load.map(|load| if load.abs() < 1e-9 * largest { 0.0 } else { load })
    }
}

const REST_HELP: &str =
    "check loads, `bearing.thrust` and play; --hold-tilt holds the shaft's tilt, which one bearing alone hardly does";

/// A bearing that cannot be in balance: nothing is wrong with the numbers one by one.
fn no_equilibrium(error: BearingError) -> ComputeError {
    ComputeError::failed(format!("the bearing at rest: {error}"), REST_HELP)
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
            let lives = scene.bearings.iter().zip(&found.bearings);
            let lives: Option<Vec<f64>> =
                lives.map(|(own, state)| own.rating_life(state, scene.speed).ok()?.life_mrev).collect();
            point.life = lives.and_then(|lives| lives.into_iter().reduce(f64::min));
        }
        Ok(())
    };
    follow(&mut after.iter_mut())?;
    follow(&mut before.iter_mut().rev())?;
    Ok(points)
}

/// A bearing in its state.
fn at_rest(scene: &SpatialScene, own: &OwnBearing, state: &BearingState) -> Result<BearingAtRest, BearingError> {
    let geometry = own.bearing.geometry();
    let contact_angle = mean_angle(&state.balls);
    let diameters = [2.0 * geometry.ball_radius(), 2.0 * geometry.pitch_radius()];
    let row = BallRow::new(geometry.balls(), diameters[0], diameters[1], contact_angle.abs())?;
    Ok(BearingAtRest {
        label: own.label.clone(),
        place: own.place,
        thrust: own.bearing.thrust(),
        play: geometry.radial_play(),
        free_contact_angle: geometry.free_contact_angle(),
        contact_angle,
        orders: row.orders(),
        life: own.rating_life(state, scene.speed).ok(),
    })
}

/// Mean contact angle at the inner race, weighted by the loads; 0 without any.
fn mean_angle(balls: &[BallState]) -> f64 {
    let loaded = balls.iter().filter_map(|ball| Some((ball.load[0], ball.contact_angle[0]?)));
    let (sum, weight) =
        loaded.fold((0.0, 0.0), |(sum, weight), (load, angle)| (sum + load * angle.abs(), weight + load));
    if weight > 0.0 { sum / weight } else { 0.0 }
}
