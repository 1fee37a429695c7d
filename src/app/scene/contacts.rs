//! Contacts of balls and races at rest, against what Hertz theory and bearing steel allow: refusals and doubts.

use super::ring::metres;
use crate::app::error::ComputeError;
use crate::bearing::hertz::{ContactPatch, HertzStiffness};
use crate::bearing::life::STATIC_PRESSURE;
use crate::bearing::spatial::SpatialBearing;
use crate::bearing::{BearingGeometry, Race, RaceContacts};
use crate::numerics::Brief;
use crate::system::{BallLoad, BearingSetup, Equilibrium, SpatialBallLoad};

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
pub(super) struct Contact {
    race: Race,
    force: f64,
    patch: ContactPatch,
    effective_modulus: f64,
    groove: f64,
    ball_radius: f64,
}

/// The contacts at the inner and the outer race of a bearing in its plane.
fn in_plane(setup: &BearingSetup, contacts: &RaceContacts, equilibrium: &Equilibrium) -> [Contact; 2] {
    let of = |race, hertz: &HertzStiffness, force: fn(&BallLoad) -> f64| {
        let force = equilibrium.balls.iter().map(force).fold(0.0, f64::max);
        Contact::new(&setup.geometry, race, force, hertz)
    };
    [of(Race::Inner, &contacts.inner, |ball| ball.inner), of(Race::Outer, &contacts.outer, |ball| ball.outer)]
}

/// The same of a bearing in space, each patch at its ball's contact angle; none of a race that no ball touches.
pub(super) fn in_space(bearing: &SpatialBearing, balls: &[SpatialBallLoad]) -> Vec<Contact> {
    let of = |(index, race): (usize, Race)| {
        let ball = balls.iter().max_by(|a, b| a.load[index].total_cmp(&b.load[index]))?;
        let hertz = bearing.hertz_at(race, ball.contact_angle[index]?)?;
        Some(Contact::new(bearing.geometry(), race, ball.load[index], &hertz))
    };
    [Race::Inner, Race::Outer].into_iter().enumerate().filter_map(of).collect()
}

impl Contact {
    fn new(geometry: &BearingGeometry, race: Race, force: f64, hertz: &HertzStiffness) -> Self {
        let dimensions = geometry.dimensions();
        Self {
            race,
            force,
            patch: hertz.patch(force),
            effective_modulus: hertz.effective_modulus,
            groove: match race {
                Race::Inner => dimensions.inner_groove_radius,
                Race::Outer => dimensions.outer_groove_radius,
            },
            ball_radius: geometry.ball_radius(),
        }
    }

    /// Refuses one that cannot be: a patch as wide as the ball, a pressure beyond the strength of any solid. `prefix` stands before the
    /// bearing's keys, `when` says under which loads.
    ///
    /// # Errors
    /// [`ComputeError::Input`].
    pub(super) fn accept(&self, prefix: &str, when: &str) -> Result<(), ComputeError> {
        let Self { race, force, patch, ball_radius, .. } = *self;
        let newtons = Brief::rounded(force, 4);
        if patch.longer >= ball_radius {
            let (half_axis, ball) = (metres(patch.longer), metres(ball_radius));
            let (groove, part) = (metres(self.groove), Brief(0.5 * self.groove / ball_radius));
            return Err(ComputeError::wrong(format!(
                "{prefix}bearing.{race}_groove_radius: the contact of a ball with the {race} race would have a half-axis of {half_axis} under the largest force {when}, {newtons} N, and the ball's radius is {ball}: expected a patch well below it, found a groove of {groove}, {part} of the ball's diameter (0.51 to 0.54 are built); check the groove, the ball and the load on the shaft"
            )));
        }
        let limit = STRENGTH * self.effective_modulus;
        if patch.peak_pressure > limit {
            return Err(ComputeError::wrong(format!(
                "{prefix}bearing: the pressure between a ball and the {race} race would be {:.0} MPa under the largest force {when}, {newtons} N: expected below {:.0} MPa, a tenth of the effective modulus, beyond which no solid is elastic (bearing steel is rated to 4200 MPa, ISO 76); check the load on the shaft, {prefix}bearing.ball_radius and the groove radii",
                1e-6 * patch.peak_pressure,
                1e-6 * limit
            )));
        }
        Ok(())
    }

    /// What of it is possible and in doubt, a sentence each.
    pub(super) fn doubts(&self) -> Vec<String> {
        let Self { race, force, patch, ball_radius, .. } = *self;
        let newtons = Brief::rounded(force, 4);
        let conformity = 0.5 * self.groove / ball_radius;
        let mut found = Vec::new();
        if !(CONFORMITY[0]..=CONFORMITY[1]).contains(&conformity) {
            found.push(format!(
                "bearing.{race}_groove_radius is {conformity:.7} of the ball's diameter; bearings are built with 0.51 to 0.54: check it and bearing.ball_radius"
            ));
        }
        if patch.longer > WIDE * ball_radius {
            found.push(format!(
                "the patch at the {race} race has a half-axis of {} under {newtons} N at rest, {:.0} % of the ball's radius: Hertz theory holds for small patches; check the load and bearing.{race}_groove_radius",
                metres(patch.longer),
                100.0 * patch.longer / ball_radius
            ));
        }
        if patch.peak_pressure > STATIC_PRESSURE {
            found.push(format!(
                "the pressure at the {race} race is {:.0} MPa under {newtons} N at rest, above the {:.0} MPa of the static load rating (ISO 76): the races keep dents, which the elastic contact leaves out; check the load and the bearing's size",
                1e-6 * patch.peak_pressure,
                1e-6 * STATIC_PRESSURE
            ));
        }
        found
    }
}

/// Refuses contacts of a bearing in its plane that cannot be. Where the stiffness is given, grooves and materials do not act, and nothing
/// is refused.
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
    in_plane(setup, hertz, equilibrium).iter().try_for_each(|contact| contact.accept("", "at rest"))
}

/// What of the contacts of a bearing in its plane is possible and in doubt, a sentence each.
pub(super) fn contact_doubts(setup: &BearingSetup, hertz: &RaceContacts, equilibrium: &Equilibrium) -> Vec<String> {
    in_plane(setup, hertz, equilibrium).iter().flat_map(Contact::doubts).collect()
}
