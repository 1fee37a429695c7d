//! What of a shaft in its bearings is refused, and what may be meant otherwise.

use super::contacts::{Contact, in_space as contacts_in_space};
use crate::app::case::{Case, ContactStiffness, Defect, Rule, Seat};
use crate::app::error::ComputeError;
use crate::bearing::Race;
use crate::bearing::kinematics::DefectOrders;
use crate::numerics::Brief;
use crate::report::significant;
use crate::system::{
    BallsInertia, BearingInPlace, Formulation, SpatialCondition, SpatialEquilibrium, SpatialSetup, SystemError,
};
use std::f64::consts::TAU;

/// Change of an order, relative, that is told: a tooth of a verdict's comb is as wide by the slip that it allows for.
const SPREAD: f64 = 1e-3;

/// The contacts of every bearing whose stiffness is Hertz's: where one is given, grooves and materials do not act.
pub(super) fn by_hertz<'a>(
    seats: &'a [Seat<'a>],
    setup: &'a SpatialSetup,
    rest: &'a SpatialEquilibrium,
) -> impl Iterator<Item = (&'a Seat<'a>, Vec<Contact>)> {
    let bearings = seats.iter().zip(setup.bearings.iter().zip(&rest.bearings));
    let hertz = |seat: &Seat| seat.bearing.is_some_and(|asked| asked.stiffness == ContactStiffness::Hertz);
    let bearings = bearings.filter(move |(seat, _)| hertz(seat));
    bearings.map(|(seat, (own, balls))| (seat, contacts_in_space(&own.bearing, balls)))
}

/// Refuses contacts that cannot be.
pub(super) fn accept(
    seats: &[Seat<'_>],
    setup: &SpatialSetup,
    rest: &SpatialEquilibrium,
    when: &str,
) -> Result<(), ComputeError> {
    by_hertz(seats, setup, rest)
        .try_for_each(|(seat, contacts)| contacts.iter().try_for_each(|contact| contact.accept(&seat.key(""), when)))
}

/// Why nothing rests at the highest speed of a run, rad/s.
pub(super) fn nothing_rests(
    setup: &SpatialSetup,
    speed: f64,
    condition: &SpatialCondition,
    error: &SystemError,
) -> ComputeError {
    let forces = setup.bearings.iter().zip(&condition.cage_speeds).map(|(own, cage)| {
        let law = own.bearing.law();
        law.mass * cage * cage * law.grooves.outer_centres
    });
    ComputeError::Failed {
        what: format!(
            "equilibrium at the highest speed of the run, {} rpm: {error}",
            Brief::rounded(60.0 * speed / TAU, 4)
        ),
        help: Some(format!(
            "each ball presses on its outer race with up to {} N by its centrifugal force: check speed.profile, shaft.loads and the bearings",
            significant(forces.fold(0.0, f64::max), 3)
        )),
    }
}

/// Refuses a bearing that is pushed against the way in which it holds thrust: it would come apart, and the model has the other shoulder.
pub(super) fn refuse_other_shoulder(
    case: &Case,
    seats: &[Seat<'_>],
    setup: &SpatialSetup,
    rest: &SpatialEquilibrium,
) -> Result<(), ComputeError> {
    let Some((index, along)) = rest.pushed_apart(setup) else { return Ok(()) };
    let rule = Rule::found(
        format!("{} N of thrust at rest against the way in which the bearing holds it", significant(along, 3)),
        "bearings that hold each other: thrust both ways, or preload above the axial load",
    );
    Err(case.broken(&rule.at(seats[index].key("bearing.thrust"))).into())
}

/// That a ball starts on a defect, a sentence a bearing: the rest that a run begins with is one on whole races.
pub(super) fn starts_in_damage(setup: &SpatialSetup, start: f64) -> Vec<String> {
    let told = setup.bearings.iter().filter(|own| {
        let cage = own.cage.motion(start).angle;
        let shaft = own.cage.shaft().angle(start);
        let balls = (0..own.bearing.balls()).map(|ball| own.cage.ball_angle(cage, ball as u32));
        let on = |angle: f64| {
            own.bearing.defects().iter().any(|defect| {
                let turned = if defect.race() == Race::Inner { shaft } else { 0.0 };
                defect.profile().contains(angle - turned)
            })
        };
        balls.into_iter().any(on)
    });
    let told = told.map(|own| {
        let name = name_of(own);
        format!("a ball of {name} starts on a defect: it falls into it at the first instant, and the first samples ring; another bearing.first_ball_deg begins beside it")
    });
    told.collect()
}

/// Refuses what of a bearing only the model in the plane knows.
pub(super) fn refuse_plane_keys(case: &Case, seat: &Seat<'_>) -> Result<(), ComputeError> {
    let Some(bearing) = seat.bearing else { return Ok(()) };
    let given = [
        ("formulation", bearing.formulation != Formulation::Consistent),
        ("balls_inertia", bearing.balls_inertia == Some(BallsInertia::QuasiStatic)),
        ("waviness", !bearing.waviness.is_empty()),
        ("ball_radius_differences", !bearing.ball_radius_differences.is_empty()),
        ("defects", bearing.defects.iter().any(|defect| matches!(defect, Defect::Flat(_)))),
    ];
    match given.into_iter().find(|(_, given)| *given) {
        None => Ok(()),
        Some((key, _)) => {
            let rule = Rule::found(
                "a key of the bearing in its plane",
                "none where the shaft has several bearings, axial load or a contact angle",
            );
            Err(case.broken(&rule.at(seat.key(&format!("bearing.{key}")))).into())
        }
    }
}

/// That the contact angles at one end of the run make other orders, of the bearing where they differ most.
pub(super) fn other_orders(
    setup: &SpatialSetup,
    taken: &[DefectOrders],
    there: &[Option<DefectOrders>],
    when: &str,
) -> Option<String> {
    let bearings = setup.bearings.iter().zip(taken).zip(there);
    let lines = bearings.filter_map(|((own, taken), there)| Some((own, taken, there.as_ref()?)));
    let lines = lines.flat_map(|(own, taken, there)| {
        [("BPFO", taken.outer, there.outer), ("BPFI", taken.inner, there.inner)].map(|line| (own, line))
    });
    let change = |(_, taken, there): (&str, f64, f64)| there / taken - 1.0;
    let (own, line) = lines.max_by(|(_, a), (_, b)| change(*a).abs().total_cmp(&change(*b).abs()))?;
    let (change, (name, taken, there)) = (change(line), line);
    (change.abs() > SPREAD).then(|| {
        format!(
            "{}: cage and verdicts go by the contact angles at the highest speed, {name} {}; those at the {when} of the run make it {}, {} % {}: on a machine its lines smear by so much, in these signals they do not",
            name_of(own),
            significant(taken, 5),
            significant(there, 5),
            significant(100.0 * change.abs(), 2),
            if change > 0.0 { "more" } else { "less" }
        )
    })
}

/// What sentences call a bearing.
fn name_of(own: &BearingInPlace) -> String {
    if own.label.is_empty() { "the bearing".to_owned() } else { format!("bearing {}", own.label) }
}
