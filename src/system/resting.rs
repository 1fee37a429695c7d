//! Both races with cage and shaft at rest: forces and their derivatives for given positions.

use super::bearing_setup::BearingSetup;
use super::inner::{InnerGap, InnerRace};
use super::race::{Damage, RaceContact, RaceForce, RacePlace};
use crate::bearing::Race;

/// Half the difference that gives derivatives on damage, in penetrations: its own error is the square, and the round-off of a
/// position 1e-6 of the smallest that a ball's weight causes.
const DIFFERENCE: f64 = 1e-4;

/// Both races as they stand.
#[derive(Debug, Clone)]
pub(super) struct RestingRaces {
    pub inner_race: InnerRace,
    inner: RaceContact,
    outer: RaceContact,
    /// rad
    shaft_angle: f64,
    /// Number of each ball's flat and its angle from the ball's radius vector, rad.
    spins: Vec<Option<(usize, f64)>>,
    /// How much larger than nominal each ball's radius is, m.
    oversizes: Vec<f64>,
}

/// Curvature of a contact's potential in the plane from its derivatives in polar coordinates about the race's centre, N/m:
/// (along the radius, mixed, across it). Across the radius a force turns with it.
pub(super) fn in_the_plane(force: &RaceForce, distance: f64) -> [f64; 3] {
    let [rr, rt, tt] = force.tangent;
    [rr, rt - force.tangential / distance, tt + force.radial / distance]
}

impl RestingRaces {
    pub(super) fn new(setup: &BearingSetup, shaft_angle: f64) -> Self {
        Self {
            inner_race: InnerRace::new(&setup.geometry),
            inner: RaceContact::new(setup, Race::Inner).undamped(),
            outer: RaceContact::new(setup, Race::Outer).undamped(),
            shaft_angle,
            spins: (0..setup.balls()).map(|ball| setup.spin(ball, shaft_angle)).collect(),
            oversizes: (0..setup.balls()).map(|ball| setup.oversize(ball)).collect(),
        }
    }

    /// Force of `ball` at the angle `angle` (rad) on the outer race that is displaced along increasing angle by `shift`
    /// (rad); derivatives by the ball's position relative to the race.
    pub(super) fn outer_force(&self, ball: usize, angle: f64, shift: f64, penetration: f64) -> RaceForce {
        self.force(&self.outer, ball, angle - shift, shift, penetration)
    }

    /// Force of `ball` at `angle` (rad) about the bearing's centre on the inner race.
    pub(super) fn inner_force(&self, ball: usize, angle: f64, gap: &InnerGap) -> RaceForce {
        let [x, y] = gap.normal;
        let (sin, cos) = angle.sin_cos();
        let turned = (cos * y - sin * x).atan2(cos * x + sin * y);
        let own = angle + turned - self.shaft_angle;
        self.force(&self.inner, ball, own, -turned, gap.penetration)
    }

    /// Force on a race at `angle` in its own frame; `spun` is what the ball's flat is turned by as seen from there.
    fn force(&self, race: &RaceContact, ball: usize, angle: f64, spun: f64, nominal: f64) -> RaceForce {
        let penetration = nominal + self.oversizes[ball];
        let (sin, cos) = angle.sin_cos();
        let flat = self.spins[ball].filter(|(flat, spin)| race.feels(*flat, spin + spun));
        let spin = flat.map_or(0.0, |(_, spin)| spin + spun);
        let damage = match (race.defect_at([cos, sin]), flat) {
            (Some(defect), _) => Damage::Race(defect),
            (None, Some((flat, _))) => Damage::Flat(flat),
            (None, None) => Damage::None,
        };
        let at = |pressed: f64, turned: f64| {
            let place = RacePlace {
                angle: angle + turned,
                penetration: penetration + pressed,
                spin: [spin - turned, 0.0],
                ..RacePlace::default()
            };
            race.force(damage, &place)
        };
        let mut force = at(0.0, 0.0);
        if damage != Damage::None && force.magnitude > 0.0 {
            let step = DIFFERENCE * race.usual_penetration(force.magnitude);
            // the profile turns the normals, which the contacts' own derivatives leave out
            let radius = race.radius(penetration);
            let outward = race.pressed_outward();
            let [less, more] = [-step, step].map(|step| at(outward * step, 0.0));
            let [before, after] = [-step, step].map(|step| at(0.0, step / radius));
            let slope = |a: f64, b: f64| (b - a) / (2.0 * step);
            let radial_by_turning = slope(before.radial, after.radial);
            let tangential_by_pressing = slope(less.tangential, more.tangential) + force.tangential / radius;
            force.tangent = [
                slope(less.radial, more.radial),
                0.5 * (radial_by_turning + tangential_by_pressing),
                slope(before.tangential, after.tangential),
            ];
        }
        force
    }
}
