//! What `bearing.json` says.

use super::compute::{BearingAtRest, BearingResult, CurvePoint};
use crate::bearing::RatingLife;
use crate::bearing::kinematics::DefectOrders;
use crate::bearing::spatial::{BallState, ShaftEquilibrium, Thrust};
use schemars::JsonSchema;
use serde::Serialize;
use std::f64::consts::TAU;

/// The shaft at rest in its bearings, rings rigid.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct BearingSummary<'a> {
    /// Speed of the shaft, rpm.
    pub speed_rpm: f64,
    /// Instant of the loads, s.
    pub time_s: f64,
    /// Force on the shaft along x, y, z, weight and preload included, N.
    pub force_n: [f64; 3],
    /// Moment about x and y through the first bearing's centre, N m.
    pub moment_nm: [f64; 2],
    /// Every bearing, in the order of the case.
    pub bearings: Vec<BearingAtRestSummary<'a>>,
    /// The equilibrium to which the load leads, then the others that were found.
    pub equilibria: Vec<EquilibriumSummary<'a>>,
    /// Over the factor of the load.
    pub over_load: &'a [CurvePoint],
    /// Over the speed in rpm; empty without speed.
    pub over_speed: &'a [CurvePoint],
    /// Over the preload of the first bearing, the others' in proportion: a force in N, or a displacement in m.
    pub over_preload: &'a [CurvePoint],
    /// Whether the preload is a displacement.
    pub preload_is_displacement: bool,
    /// What of the model may be meant otherwise, a sentence each.
    pub warnings: &'a [String],
}

/// A bearing where the shaft rests.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct BearingAtRestSummary<'a> {
    /// What results call it; empty for the only one.
    pub label: &'a str,
    /// Along the axis from the first one's centre, m.
    pub place_m: f64,
    /// Which way it holds thrust.
    pub thrust: Thrust,
    /// Radial play, m.
    pub radial_play_m: f64,
    /// Free contact angle, degrees; null without play.
    pub free_contact_angle_deg: Option<f64>,
    /// Mean contact angle at the inner race, weighted by the loads, degrees.
    pub mean_contact_angle_deg: f64,
    /// Orders at that angle, per turn of the shaft.
    pub orders: DefectOrders,
    /// Load rating and rating life; null where the standard does not hold, with a warning.
    pub rating: Option<RatingLife>,
}

/// Where the shaft rests.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct EquilibriumSummary<'a> {
    /// Displacement along x, y, z, m.
    pub displacement_m: [f64; 3],
    /// Tilt about x and y, rad.
    pub tilt_rad: [f64; 2],
    /// Load that holds prescribed displacements: N along x, y, z, N m about x, y; zero where the shaft is free.
    pub holding_load: [f64; 5],
    /// Stiffness over x, y, z and tilt about x, y: N/m, N/rad, N, N m/rad.
    pub stiffness: [[f64; 5]; 5],
    /// Directions in which the potential falls: none in a stable equilibrium.
    pub directions_down: usize,
    /// Directions that nothing holds.
    pub directions_loose: usize,
    /// Largest force out of balance, N.
    pub residual_n: f64,
    /// The balls, bearing by bearing, in order.
    pub balls: Vec<BallSummary<'a>>,
}

/// A ball in equilibrium. Pairs are of the inner and the outer race.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct BallSummary<'a> {
    /// Label of its bearing; empty for the only one.
    pub bearing: &'a str,
    /// Azimuth, degrees.
    pub azimuth_deg: f64,
    /// Contact force, N.
    pub load_n: [f64; 2],
    /// Contact angle, degrees; null without contact.
    pub contact_angle_deg: [Option<f64>; 2],
    /// Penetration, m.
    pub penetration_m: [f64; 2],
    /// Peak pressure, Pa.
    pub peak_pressure_pa: [f64; 2],
    /// Longer and shorter half-axis of the patch at the inner race, m.
    pub inner_patch_m: [f64; 2],
    /// Longer and shorter half-axis of the patch at the outer race, m.
    pub outer_patch_m: [f64; 2],
    /// Orbital speed, rpm.
    pub orbital_speed_rpm: f64,
    /// Speed about the ball's own axis against the cage, rpm.
    pub spin_speed_rpm: f64,
    /// Angle of that axis to the bearing's axis, degrees.
    pub pitch_angle_deg: f64,
    /// Centrifugal force, N.
    pub centrifugal_force_n: f64,
    /// Gyroscopic moment, N m.
    pub gyroscopic_moment_nm: f64,
}

impl<'a> BallSummary<'a> {
    fn of(bearing: &'a str, ball: &BallState) -> Self {
        let rpm = |speed: f64| speed * 60.0 / TAU;
        Self {
            bearing,
            azimuth_deg: ball.azimuth.to_degrees().rem_euclid(360.0),
            load_n: ball.load,
            contact_angle_deg: ball.contact_angle.map(|angle| angle.map(f64::to_degrees)),
            penetration_m: ball.penetration,
            peak_pressure_pa: ball.patch.map(|patch| patch.peak_pressure),
            inner_patch_m: [ball.patch[0].longer, ball.patch[0].shorter],
            outer_patch_m: [ball.patch[1].longer, ball.patch[1].shorter],
            orbital_speed_rpm: rpm(ball.orbital_speed),
            spin_speed_rpm: rpm(ball.spin_speed),
            pitch_angle_deg: ball.pitch_angle.to_degrees(),
            centrifugal_force_n: ball.centrifugal_force,
            gyroscopic_moment_nm: ball.gyroscopic_moment,
        }
    }
}

impl<'a> EquilibriumSummary<'a> {
    fn of(bearings: &'a [BearingAtRest], rest: &ShaftEquilibrium) -> Self {
        let balls = bearings.iter().zip(&rest.bearings);
        let balls = balls.flat_map(|(own, state)| state.balls.iter().map(|ball| BallSummary::of(&own.label, ball)));
        Self {
            displacement_m: rest.displacement.translation,
            tilt_rad: rest.displacement.tilt,
            holding_load: rest.holding_load,
            stiffness: rest.stiffness,
            directions_down: rest.directions_down,
            directions_loose: rest.directions_loose,
            residual_n: rest.residual_n,
            balls: balls.collect(),
        }
    }
}

impl BearingAtRest {
    fn summary(&self) -> BearingAtRestSummary<'_> {
        BearingAtRestSummary {
            label: &self.label,
            place_m: self.place,
            thrust: self.thrust,
            radial_play_m: self.play,
            free_contact_angle_deg: self.free_contact_angle.map(f64::to_degrees),
            mean_contact_angle_deg: self.contact_angle.to_degrees(),
            orders: self.orders,
            rating: self.life,
        }
    }
}

impl BearingResult {
    /// What `bearing.json` says.
    pub fn summary(&self) -> BearingSummary<'_> {
        BearingSummary {
            speed_rpm: self.speed_rpm,
            time_s: self.time_s,
            force_n: self.load.force,
            moment_nm: self.load.moment,
            bearings: self.bearings.iter().map(BearingAtRest::summary).collect(),
            equilibria: self.equilibria.iter().map(|rest| EquilibriumSummary::of(&self.bearings, rest)).collect(),
            over_load: &self.over_load,
            over_speed: &self.over_speed,
            over_preload: &self.over_preload,
            preload_is_displacement: self.preload_is_displacement,
            warnings: &self.doubts,
        }
    }
}
