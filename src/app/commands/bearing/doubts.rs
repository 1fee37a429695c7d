//! What of a case `plummer bearing` leaves out, and what of its result is to be looked at.

use crate::app::case::{Case, Slip};
use crate::app::scene::spatial::{OwnBearing, SpatialScene, largest_pressure};
use crate::bearing::life::STATIC_PRESSURE;
use crate::bearing::spatial::{BearingState, ShaftEquilibrium, Thrust};

/// What of the case does not count here, and what of the result is to be looked at.
pub(super) fn doubts(case: &Case, scene: &SpatialScene, equilibria: &[ShaftEquilibrium]) -> Vec<String> {
    let mut doubts = does_not_count(case, scene);
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
    for (own, state) in scene.bearings.iter().zip(&taken.bearings) {
        let told = doubts_of(scene, own, state).into_iter();
        doubts.extend(told.map(|text| match own.label.as_str() {
            "" => text,
            label => format!("bearing {label}: {text}"),
        }));
    }
    doubts
}

/// Keys of the case that have no meaning at rest on rigid rings.
fn does_not_count(case: &Case, scene: &SpatialScene) -> Vec<String> {
    let mut keys = Vec::new();
    for (own, (_, asked)) in scene.bearings.iter().zip(case.all_bearings()) {
        let of_bearing = [
            ("defects", !asked.defects.is_empty()),
            ("waviness", !asked.waviness.is_empty()),
            ("ball_radius_differences", !asked.ball_radius_differences.is_empty()),
            ("slip", asked.slip != Slip::default()),
        ];
        let given = of_bearing.into_iter().filter(|(_, given)| *given);
        keys.extend(given.map(|(key, _)| format!("{}bearing.{key}", own.prefix)));
    }
    let of_shaft = [
        ("shaft.unbalance", case.shaft.as_ref().is_some_and(|shaft| shaft.unbalance > 0.0)),
        ("shaft.unbalances", case.shaft.as_ref().is_some_and(|shaft| !shaft.unbalances.is_empty())),
    ];
    keys.extend(of_shaft.into_iter().filter(|(_, given)| *given).map(|(key, _)| key.to_owned()));
    let mut told: Vec<String> = keys
        .iter()
        .map(|key| format!("{key} does not count: the bearing at rest has sound races, equal balls and pure rolling"))
        .collect();
    if case.housing.is_some() || case.has_rings() {
        let which = if case.bearings.is_empty() { "[housing] and [ring] do" } else { "the housing and its rings do" };
        told.push(format!("{which} not count: all rings of bearings are rigid here"));
    }
    told
}

/// What of a bearing's state is to be looked at.
fn doubts_of(scene: &SpatialScene, own: &OwnBearing, state: &BearingState) -> Vec<String> {
    let mut doubts = Vec::new();
    match own.rating_life(state, scene.speed) {
        Err(error) => doubts.push(format!("no rating life, ISO 281 does not hold: {error}")),
        Ok(life) => doubts.extend(life.doubt()),
    }
    let pressure = largest_pressure(state);
    if pressure > STATIC_PRESSURE {
        doubts.push(format!(
            "the largest contact pressure is {:.0} MPa; above {:.0} MPa, the static limit of ISO 76, races are dented for good and no rating life is given: reduce the load",
            1e-6 * pressure,
            1e-6 * STATIC_PRESSURE
        ));
    }
    let thrust = own.bearing.thrust();
    let wrong_side = state
        .balls
        .iter()
        .filter(|ball| thrust != Thrust::Both && thrust.sign() * ball.contact_angle[0].unwrap_or(0.0) < 0.0);
    let wrong_side = wrong_side.count();
    if wrong_side > 0 {
        doubts.push(format!(
            "{wrong_side} balls touch the inner race on the side where an angular contact bearing has no shoulder: such a bearing may lose these contacts"
        ));
    }
    doubts
}
