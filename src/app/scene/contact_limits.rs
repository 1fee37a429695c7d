//! Contacts of balls and races under the load at rest, against what Hertz theory and bearing steel allow.

use crate::app::error::ComputeError;
use crate::bearing::hertz::{ContactPatch, HertzStiffness};
use crate::bearing::{Race, RaceContacts};
use crate::system::{BallLoad, BearingSetup, Equilibrium};

/// Largest pressure at the basic static load rating of a ball bearing, Pa: there a ball and its race keep dents of a
/// ten-thousandth of the ball's diameter (ISO 76:2006, 3.2).
const STATIC_RATING: f64 = 4.2e9;

/// Largest pressure that any solid bears elastically, over the effective modulus: a tenth, the theoretical strength.
/// Steel on steel comes to 11.5 GPa, whose mean 2/3 is the hardness of bearing steel, 7.7 GPa.
const STRENGTH: f64 = 0.1;

/// Half-axis of the patch over the ball's radius from which on Hertz theory is in doubt: it takes the ball for a
/// paraboloid, which is 7 % off there.
const WIDE: f64 = 0.5;

/// Groove radii over the ball's diameter that are built. Catalogue bearings have 0.51 to 0.54 (Harris, *Rolling Bearing
/// Analysis*, 4th edition, section 2.2).
const CONFORMITY: [f64; 2] = [0.505, 0.6];

/// Largest force on a ball at one race, and its patch.
struct Contact<'c> {
    race: Race,
    hertz: &'c HertzStiffness,
    force: f64,
    patch: ContactPatch,
    groove: f64,
}

fn contacts<'c>(setup: &BearingSetup, contacts: &'c RaceContacts, equilibrium: &Equilibrium) -> [Contact<'c>; 2] {
    let dimensions = setup.geometry.dimensions();
    let of = |race, hertz: &'c HertzStiffness, force: fn(&BallLoad) -> f64, groove| {
        let force = equilibrium.balls.iter().map(force).fold(0.0, f64::max);
        let patch = hertz.patch(force);
        Contact { race, hertz, force, patch, groove }
    };
    [
        of(Race::Inner, &contacts.inner, |ball| ball.inner, dimensions.inner_groove_radius),
        of(Race::Outer, &contacts.outer, |ball| ball.outer, dimensions.outer_groove_radius),
    ]
}

/// Refuses contacts that cannot be: a patch as wide as the ball, a pressure beyond the strength of any solid. Where the
/// stiffness is given, grooves and materials do not act, and nothing is refused.
///
/// # Errors
/// [`ComputeError::Input`].
pub(crate) fn accept_contacts(
    setup: &BearingSetup,
    hertz: &RaceContacts,
    equilibrium: &Equilibrium,
) -> Result<(), ComputeError> {
    if setup.stiffness != hertz.stiffness() {
        return Ok(());
    }
    let ball_radius = setup.geometry.ball_radius();
    for contact in contacts(setup, hertz, equilibrium) {
        let Contact { race, force, patch, .. } = contact;
        if patch.longer >= ball_radius {
            let (half_axis, groove) = (patch.longer, contact.groove);
            return Err(ComputeError::wrong(format!(
                "bearing.{race}_groove_radius: the contact of a ball with the {race} race would have a half-axis of {half_axis:.3e} m under the largest force at rest, {force:.3e} N, and the ball's radius is {ball_radius:.3e} m: expected a patch well below it, found a groove of {groove:e} m, {:.7} of the ball's diameter (0.51 to 0.54 are built); check the groove, the ball and the load on the shaft",
                0.5 * groove / ball_radius
            )));
        }
        let limit = STRENGTH * contact.hertz.effective_modulus;
        if patch.peak_pressure > limit {
            return Err(ComputeError::wrong(format!(
                "bearing: the pressure between a ball and the {race} race would be {:.0} MPa under the largest force at rest, {force:.3e} N: expected below {:.0} MPa, a tenth of the effective modulus, beyond which no solid is elastic (bearing steel is rated to 4200 MPa, ISO 76); check the load on the shaft, bearing.ball_radius and the groove radii",
                1e-6 * patch.peak_pressure,
                1e-6 * limit
            )));
        }
    }
    Ok(())
}

/// What of the contacts is possible and in doubt, a sentence each.
pub(crate) fn contact_doubts(setup: &BearingSetup, hertz: &RaceContacts, equilibrium: &Equilibrium) -> Vec<String> {
    let ball_radius = setup.geometry.ball_radius();
    let mut found = Vec::new();
    for contact in contacts(setup, hertz, equilibrium) {
        let Contact { race, force, patch, .. } = contact;
        let conformity = 0.5 * contact.groove / ball_radius;
        if !(CONFORMITY[0]..=CONFORMITY[1]).contains(&conformity) {
            found.push(format!(
                "bearing.{race}_groove_radius is {conformity:.7} of the ball's diameter; bearings are built with 0.51 to 0.54: check it and bearing.ball_radius"
            ));
        }
        if patch.longer > WIDE * ball_radius {
            found.push(format!(
                "the patch at the {race} race has a half-axis of {:.3e} m under {force:.3e} N at rest, {:.0} % of the ball's radius: Hertz theory holds for small patches; check the load and bearing.{race}_groove_radius",
                patch.longer,
                100.0 * patch.longer / ball_radius
            ));
        }
        if patch.peak_pressure > STATIC_RATING {
            found.push(format!(
                "the pressure at the {race} race is {:.0} MPa under {force:.3e} N at rest, above the {:.0} MPa of the static load rating (ISO 76): the races keep dents, which the elastic contact leaves out; check the load and the bearing's size",
                1e-6 * patch.peak_pressure,
                1e-6 * STATIC_RATING
            ));
        }
    }
    found
}
