//! What a run simulated: one bearing in its plane, or a shaft in bearings in space.

use crate::app::case::SpatialCase;
use crate::app::commands::analyze::DamageShown;
use crate::app::scene::{CoupledStructure, MachineScene, Scene};
use crate::bearing::kinematics::DefectOrders;
use crate::bearing::{Cage, SpeedProfile};
use crate::signal::diagnosis::Fault;
use crate::system::{LoadedModes, SpatialEquilibrium, Statics};

/// Orders of two bearings nearer than this, relative, belong together in windows of up to some hundred revolutions.
const ALIKE: f64 = 5e-3;

/// What was simulated.
#[derive(Debug)]
pub enum Machine {
    /// One bearing in its plane.
    InPlane(Box<PlaneMachine>),
    /// A shaft in bearings that carry axial load and tilt.
    InSpace(Box<SpatialMachine>),
}

/// A bearing in its plane.
#[derive(Debug)]
pub struct PlaneMachine {
    /// The scene.
    pub scene: Scene,
    /// Its equilibrium among the others, and over a ball pass.
    pub statics: Statics,
    /// Modes linearised there.
    pub loaded: LoadedModes,
}

/// A shaft in bearings in space.
#[derive(Debug)]
pub struct SpatialMachine {
    /// The scene.
    pub scene: MachineScene,
    /// All equilibria that were found; the first one is taken.
    pub equilibria: Vec<SpatialEquilibrium>,
    /// Modes linearised where it rests.
    pub loaded: LoadedModes,
    /// Of each bearing what its damage adds to a stretch of the signals, over the RMS without it, the largest sensor's; zero of a sound
    /// bearing, `None` where no stretch could be compared.
    pub damage: Vec<Option<f64>>,
}

/// Which model of the bearing a run has, and why.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BearingModel {
    /// "in its plane" or "in space".
    pub chosen: &'static str,
    /// Why.
    pub why: String,
}

/// A bearing of a machine as an analysis of signals sees it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BearingMotion<'a> {
    /// What results call it; empty for the only one.
    pub label: &'a str,
    pub cage: &'a Cage,
    pub balls: u32,
    /// Orders without slip.
    pub orders: DefectOrders,
    /// What of its damage the signals show.
    pub damage: DamageShown,
}

impl BearingModel {
    pub(super) fn in_plane() -> Self {
        let why =
            "one bearing, loaded across its axis alone: it does not tilt, and its contact angle is zero".to_owned();
        Self { chosen: "in its plane", why }
    }

    pub(super) fn in_space(run: &SpatialCase<'_>) -> Self {
        Self { chosen: "in space", why: run.reason.clone() }
    }
}

impl Machine {
    /// Ring and housing.
    pub(crate) fn stage(&self) -> &CoupledStructure {
        match self {
            Self::InPlane(machine) => &machine.scene.stage,
            Self::InSpace(machine) => &machine.scene.stage,
        }
    }

    /// The bearing in its plane, if it is one.
    pub fn in_plane(&self) -> Option<&PlaneMachine> {
        match self {
            Self::InPlane(machine) => Some(machine),
            Self::InSpace(_) => None,
        }
    }

    /// The shaft in space, if it is one.
    pub(crate) fn in_space(&self) -> Option<&MachineScene> {
        match self {
            Self::InPlane(_) => None,
            Self::InSpace(machine) => Some(&machine.scene),
        }
    }

    /// Modes linearised where it rests.
    pub(crate) fn loaded(&self) -> &LoadedModes {
        match self {
            Self::InPlane(machine) => &machine.loaded,
            Self::InSpace(machine) => &machine.loaded,
        }
    }

    /// Speed of the shaft.
    #[must_use]
    pub fn shaft_speed(&self) -> &SpeedProfile {
        match self {
            Self::InPlane(machine) => machine.scene.setup.cage.shaft(),
            Self::InSpace(machine) => machine.scene.setup.bearings[0].cage.shaft(),
        }
    }

    /// What of the model may be meant otherwise, a sentence each.
    pub(super) fn doubts(&self) -> &[String] {
        match self {
            Self::InPlane(machine) => &machine.scene.doubts,
            Self::InSpace(machine) => &machine.scene.doubts,
        }
    }

    /// Its bearings, in the order of the case.
    pub(crate) fn bearings(&self) -> Vec<BearingMotion<'_>> {
        match self {
            Self::InPlane(machine) => {
                let setup = &machine.scene.setup;
                let (balls, orders) = (setup.geometry.balls(), setup.geometry.orders());
                vec![BearingMotion { label: "", cage: &setup.cage, balls, orders, damage: DamageShown::InPlane }]
            }
            Self::InSpace(machine) => {
                let scene = &machine.scene;
                let bearings = scene.setup.bearings.iter().zip(&scene.orders).zip(&machine.damage);
                let bearings = bearings.map(|((own, orders), damage)| {
                    let balls = own.bearing.geometry().balls();
                    BearingMotion {
                        label: &own.label,
                        cage: &own.cage,
                        balls,
                        orders: *orders,
                        damage: DamageShown::in_space(*damage),
                    }
                });
                bearings.collect()
            }
        }
    }

    /// That bearings strike at the same orders, a sentence a pair.
    pub(super) fn alike(&self) -> Vec<String> {
        let bearings = self.bearings();
        let pairs = bearings.iter().enumerate().flat_map(|(index, one)| {
            bearings[..index].iter().filter_map(|other| alike((other.label, &other.orders), (one.label, &one.orders)))
        });
        pairs.collect()
    }
}

/// That two bearings strike at the same orders, if they do.
pub(crate) fn alike((one, of_one): (&str, &DefectOrders), (other, of_other): (&str, &DefectOrders)) -> Option<String> {
    let near = |a: f64, b: f64| (a - b).abs() <= ALIKE * a;
    (near(of_one.outer, of_other.outer) && near(of_one.inner, of_other.inner)).then(|| {
        format!(
            "bearings {one} and {other} strike at the same orders: a verdict on one holds for the other as well, and only the sensors' levels tell them apart"
        )
    })
}

/// The parts of other bearings that strike at the order of one, each with its bearing's label.
pub(super) fn at_the_order_of<'a>(
    bearings: &[BearingMotion<'a>],
    (label, fault): (&str, Fault),
) -> Vec<(&'a str, Fault)> {
    let Some(own) = bearings.iter().find(|bearing| bearing.label == label) else { return Vec::new() };
    let order = fault.order(&own.orders);
    let others = bearings.iter().filter(|other| other.label != label);
    let parts = others.flat_map(|other| Fault::ALL.map(|part| (other, part)));
    let near = parts.filter(|(other, part)| (part.order(&other.orders) - order).abs() <= ALIKE * order);
    near.map(|(other, part)| (other.label, part)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing::SlipProfile;
    use crate::bearing::kinematics::BallRow;

    /// Two bearings of one size, one of another, and one whose inner race strikes as often as the outer one of the first.
    #[test]
    fn parts_of_other_bearings_at_the_same_order_are_found() {
        let row = |balls, degrees: f64| BallRow::new(balls, 2e-3, 7.5105e-3, degrees.to_radians()).unwrap().orders();
        let (speed, slip) = (SpeedProfile::constant(50.0).unwrap(), SlipProfile::constant(0.0).unwrap());
        let cage = Cage::rolling(0.37, 7, speed, slip, 0.0).unwrap();
        let alike = row(7, 17.0);
        let crossed = DefectOrders { inner: alike.outer, ..row(5, 0.0) };
        let motions = [("A", row(7, 15.0)), ("B", alike), ("C", row(8, 15.0)), ("D", crossed)];
        let motions = motions.map(|(label, orders)| {
            let damage = DamageShown::NotCompared;
            BearingMotion { label, cage: &cage, balls: 7, orders, damage }
        });
        let found = at_the_order_of(&motions, ("A", Fault::OuterRace));
        assert_eq!(found, [("B", Fault::OuterRace), ("D", Fault::InnerRace)]);
        assert_eq!(at_the_order_of(&motions, ("C", Fault::OuterRace)), []);
        let pair = |one: usize, other: usize| {
            let [one, other] = [one, other].map(|index| (motions[index].label, &motions[index].orders));
            super::alike(one, other)
        };
        assert!(pair(0, 1).unwrap().starts_with("bearings A and B strike at the same orders"));
        assert_eq!([pair(0, 2), pair(0, 3)], [None, None]);
    }
}
