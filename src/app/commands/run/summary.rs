//! What `run.json` says, and `plummer run --explain`.

use super::choice::{ChosenPart, Covered, ModelChoice};
use super::{Machine, Recording, RunEnd, RunResult};
use crate::app::commands::analyze::WindowAnalysis;
use crate::app::commands::parts::SuperelementSummary;
use crate::bearing::RatingLife;
use crate::bearing::kinematics::DefectOrders;
use crate::system::{
    BallLoad, BallsInertia, BearingInPlace, EnergyBalance, Equilibrium, SpatialBallLoad, SpatialEquilibrium,
};
use schemars::JsonSchema;
use serde::{Serialize, Serializer};

/// A simulated run.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct RunSummary<'a> {
    /// Integration method.
    pub method: &'static str,
    /// Length of a step, s; of a method that chooses its steps their mean.
    pub step_s: f64,
    /// Steps taken.
    pub steps: u64,
    /// Steps rejected.
    pub rejected: u64,
    /// Simulated time, s.
    pub simulated_s: f64,
    /// Simulated time over the wall time of the stepping.
    #[schemars(with = "Option<f64>")]
    pub realtime_factor: f64,
    /// Wall time of the stepping alone, s.
    pub stepping_s: f64,
    /// "complete", or how the solution blew up.
    pub status: String,
    /// What of the case was modelled.
    pub model: ModelSummary<'a>,
    /// Estimated relative error in the band, root mean square since the start, of what `estimate_covers` says; `None` where a part of the
    /// model has no estimate, and where nearby solutions part at once.
    pub estimated_error: Option<f64>,
    /// What of the run the estimate covers; `None` where this was not measured, as of the next ones.
    pub estimate_covers: Option<Covered>,
    /// Until when the estimate was seen to hold, s.
    pub estimate_held_s: Option<f64>,
    /// Where it was looked at from, s.
    pub estimate_from_s: Option<f64>,
    /// Until when it was looked at, s.
    pub estimate_looked_s: Option<f64>,
    /// How many times a small perturbation of the start grows until `estimate_held_s`.
    pub estimate_held_growth: Option<f64>,
    /// The same until `estimate_looked_s`.
    pub estimate_looked_growth: Option<f64>,
    /// The energy balance; `None` where it was not asked for, where the equations have none, and after a blow-up.
    pub energy: Option<EnergySummary>,
    /// Where the run of a bearing in its plane began.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub equilibrium: Option<EquilibriumSummary>,
    /// Other equilibria that were found.
    pub other_equilibria: Vec<OtherEquilibrium>,
    /// How often the parts of the bearing in its plane strike in a turn of the shaft.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub defect_orders: Option<DefectOrders>,
    /// Where the run of a shaft in space began.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shaft: Option<ShaftSummary>,
    /// Its bearings.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub bearings: Vec<RunBearingSummary<'a>>,
    /// Analysed windows of all sensors.
    pub windows: &'a [WindowAnalysis],
    /// The superelement in the housing's place, if there is one.
    pub superelement: Option<SuperelementSummary<'a>>,
    /// Windows or sensors that could not be analysed, and why.
    pub not_analysed: &'a [String],
    /// What of the case may be meant otherwise, and what of the model errs, a sentence each.
    pub warnings: &'a [String],
}

/// What of a case was modelled.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct ModelSummary<'a> {
    /// "in its plane" or "in space": the model of the bearing.
    pub bearing: &'static str,
    /// Why it is this one.
    pub bearing_why: &'a str,
    /// Kept modes of ring and housing.
    pub modes: usize,
    /// Of how many.
    pub of_modes: usize,
    /// Number of vectors of the condensed housing's interior.
    pub fixed_interface_modes: usize,
    /// How balls follow their radial motion.
    pub balls: BallsInertia,
    /// Whether the static residual of the other modes was in use.
    pub residual: bool,
    /// Its parts, and why they are these.
    pub why: &'a [ChosenPart],
}

/// The energy balance of a run, J.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct EnergySummary {
    /// What flowed.
    #[serde(flatten)]
    pub flows: EnergyBalance,
    /// Work done on the system, J.
    pub input: f64,
    /// Taken out by damping, J.
    pub dissipated: f64,
    /// What does not add up, in units of what was exchanged.
    pub balance_error: f64,
}

/// A static equilibrium.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct EquilibriumSummary {
    /// Shaft displacement x, y, m.
    pub shaft_m: [f64; 2],
    /// Angle of each ball, rad.
    pub ball_angle_rad: Vec<f64>,
    /// Force of the inner race on each ball, N.
    pub inner_force_n: Vec<f64>,
    /// Force of the outer race on each ball, N.
    pub outer_force_n: Vec<f64>,
    /// Largest force out of balance, N.
    pub residual_n: f64,
    /// Smallest curvature of the potential among directions that a contact holds, N/m.
    #[schemars(with = "Option<f64>")]
    pub least_curvature_n_per_m: f64,
    /// Stiffness that a further force on the shaft meets, `dF_i / dx_j`, N/m.
    #[schemars(with = "[[Option<f64>; 2]; 2]")]
    pub shaft_stiffness_n_per_m: [[f64; 2]; 2],
    /// Newton iterations.
    pub iterations: usize,
}

/// Where a shaft in space begins.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct ShaftSummary {
    /// Displacement of its centre of mass along x, y, z, m.
    pub displacement_m: [f64; 3],
    /// Tilt about x and y, rad.
    pub tilt_rad: [f64; 2],
    /// Stiffness that a further load on it meets, over x, y, z and the tilts: N/m, N/rad, N, N m/rad.
    pub stiffness: [[f64; 5]; 5],
    /// Directions in which the potential falls: none in a stable equilibrium.
    pub directions_down: usize,
    /// Largest force out of balance, N.
    pub residual_n: f64,
}

/// A bearing of a shaft in space.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct RunBearingSummary<'a> {
    /// What results call it; empty for the only one.
    pub label: &'a str,
    /// Place along the shaft from its centre of mass, m.
    pub place_m: f64,
    /// How often its parts strike in a turn of the shaft, at the contact angles in force.
    pub defect_orders: DefectOrders,
    /// What its damage adds to a stretch of the signals, over the RMS without it, the largest sensor's; null where no stretch was
    /// compared.
    pub damage_share: Option<f64>,
    /// Load rating, and rating life under the loads at rest and at the speed at the start; null where the standard does not hold.
    pub rating: Option<RatingLife>,
    /// Azimuth of each ball, rad.
    pub ball_angle_rad: Vec<f64>,
    /// Contact angle of each ball at the inner and the outer race, rad; null without contact.
    pub contact_angle_rad: Vec<[Option<f64>; 2]>,
    /// Force of the inner race on each ball, N.
    pub inner_force_n: Vec<f64>,
    /// Force of the outer race on each ball, N.
    pub outer_force_n: Vec<f64>,
}

/// An equilibrium beside that of the run.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct OtherEquilibrium {
    /// Shaft displacement x, y, and z in space, m.
    pub shaft_m: Vec<f64>,
    /// Its tilts about x and y in space, rad.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tilt_rad: Option<[f64; 2]>,
    /// Force of the inner race on each ball, N, bearing by bearing.
    pub inner_force_n: Vec<f64>,
    /// Whether it is stable.
    pub stable: bool,
}

/// The model that the run of a case would take.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct ExplainSummary<'a> {
    /// "run --explain".
    pub command: &'static str,
    /// Its parts, and why they are these.
    pub parts: &'a [ChosenPart],
    /// Estimated relative error in the band; `None` where a part has no estimate.
    pub estimated_error: Option<f64>,
    /// What of the case may be meant otherwise, and what of the model errs, a sentence each.
    pub warnings: &'a [String],
}

impl ModelChoice {
    /// What `plummer run --explain --json` says of it, with warnings.
    pub(crate) fn summary<'a>(&'a self, warnings: &'a [String]) -> ExplainSummary<'a> {
        ExplainSummary { command: "run --explain", parts: &self.parts, estimated_error: self.estimated_error, warnings }
    }
}

impl<R: Recording> RunResult<R> {
    /// What `run.json` says of it.
    pub(crate) fn summary(&self) -> RunSummary<'_> {
        let (stage, simulation) = (self.machine.stage(), &self.simulation);
        let in_plane = self.machine.in_plane();
        let growth = self.horizon.and_then(|horizon| horizon.growth);
        RunSummary {
            method: simulation.method.name(),
            step_s: simulation.step_s(),
            steps: simulation.statistics.steps,
            rejected: simulation.statistics.rejected,
            simulated_s: simulation.simulated_s,
            realtime_factor: simulation.realtime_factor(),
            stepping_s: simulation.stepping_s,
            status: match &simulation.end {
                RunEnd::Complete => "complete".to_owned(),
                RunEnd::BlewUp(error) => error.to_string(),
            },
            model: ModelSummary {
                bearing: self.bearing_model.chosen,
                bearing_why: &self.bearing_model.why,
                modes: simulation.modes,
                of_modes: stage.structure.dof(),
                fixed_interface_modes: stage.fixed_interface_modes,
                balls: self.choice.model.balls_inertia,
                residual: simulation.residual,
                why: &self.choice.parts,
            },
            estimated_error: self.choice.estimated_error,
            estimate_covers: self.horizon.map(|horizon| horizon.covers(self.choice.estimated_error)),
            estimate_held_s: self.horizon.map(|horizon| horizon.held_s),
            estimate_from_s: self.horizon.map(|horizon| horizon.from_s),
            estimate_looked_s: self.horizon.map(|horizon| horizon.looked_s),
            estimate_held_growth: growth.map(|growth| growth[0]),
            estimate_looked_growth: growth.map(|growth| growth[1]),
            energy: simulation.energy.map(EnergySummary::of),
            equilibrium: in_plane.map(|machine| EquilibriumSummary::of(&machine.scene.equilibrium)),
            other_equilibria: match &self.machine {
                Machine::InPlane(machine) => of_others(&machine.statics.equilibria, OtherEquilibrium::in_plane),
                Machine::InSpace(machine) => of_others(&machine.equilibria, OtherEquilibrium::in_space),
            },
            defect_orders: in_plane.map(|machine| machine.scene.setup.geometry.orders()),
            shaft: self.machine.in_space().map(|scene| ShaftSummary::of(&scene.equilibrium)),
            bearings: RunBearingSummary::all_of(&self.machine),
            windows: &self.windows,
            superelement: SuperelementSummary::of(&stage.bodies),
            not_analysed: &self.not_analysed,
            warnings: &self.warnings,
        }
    }
}

fn of_others<E>(equilibria: &[E], other: impl Fn(&E) -> OtherEquilibrium) -> Vec<OtherEquilibrium> {
    equilibria.iter().skip(1).map(other).collect()
}

impl OtherEquilibrium {
    fn in_plane(other: &Equilibrium) -> Self {
        Self {
            shaft_m: other.shaft.to_vec(),
            tilt_rad: None,
            inner_force_n: other.balls.iter().map(|ball| ball.inner).collect(),
            stable: other.is_stable(),
        }
    }

    fn in_space(other: &SpatialEquilibrium) -> Self {
        let [x, y, z, a, b] = other.shaft;
        Self {
            shaft_m: vec![x, y, z],
            tilt_rad: Some([a, b]),
            inner_force_n: other.bearings.iter().flatten().map(|ball| ball.load[0]).collect(),
            stable: other.is_stable(),
        }
    }
}

impl EnergySummary {
    fn of(flows: EnergyBalance) -> Self {
        Self { input: flows.input_j(), dissipated: flows.dissipated_j(), balance_error: flows.error(), flows }
    }
}

impl ShaftSummary {
    fn of(rest: &SpatialEquilibrium) -> Self {
        let [x, y, z, a, b] = rest.shaft;
        Self {
            displacement_m: [x, y, z],
            tilt_rad: [a, b],
            stiffness: rest.shaft_stiffness,
            directions_down: rest.directions_down,
            residual_n: rest.residual_n,
        }
    }
}

impl<'a> RunBearingSummary<'a> {
    fn all_of(machine: &'a Machine) -> Vec<Self> {
        let Machine::InSpace(machine) = machine else { return Vec::new() };
        let scene = &machine.scene;
        let bearings = scene.setup.bearings.iter().zip(&scene.equilibrium.bearings).enumerate();
        let summary = |(index, (own, balls)): (usize, (&'a BearingInPlace, &Vec<SpatialBallLoad>))| Self {
            label: &own.label,
            place_m: own.place,
            defect_orders: scene.orders[index],
            damage_share: machine.damage[index],
            rating: scene.rating_life(own, balls).ok(),
            ball_angle_rad: balls.iter().map(|ball| ball.azimuth).collect(),
            contact_angle_rad: balls.iter().map(|ball| ball.contact_angle).collect(),
            inner_force_n: balls.iter().map(|ball| ball.load[0]).collect(),
            outer_force_n: balls.iter().map(|ball| ball.load[1]).collect(),
        };
        bearings.map(summary).collect()
    }
}

impl EquilibriumSummary {
    fn of(equilibrium: &Equilibrium) -> Self {
        let balls = |value: fn(&BallLoad) -> f64| equilibrium.balls.iter().map(value).collect();
        Self {
            shaft_m: equilibrium.shaft,
            ball_angle_rad: balls(|ball| ball.angle),
            inner_force_n: balls(|ball| ball.inner),
            outer_force_n: balls(|ball| ball.outer),
            residual_n: equilibrium.residual_n,
            least_curvature_n_per_m: equilibrium.least_curvature,
            shaft_stiffness_n_per_m: equilibrium.shaft_stiffness,
            iterations: equilibrium.iterations,
        }
    }
}

impl<R: Recording> Serialize for RunResult<R> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.summary().serialize(serializer)
    }
}
