//! Both races with cage and shaft at rest: forces and their derivatives for given positions.

use super::bearing_setup::BearingSetup;
use super::inner::InnerRace;
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

/// A contact with the inner race, and its potential over the shaft's x and y and the ball's outward displacement.
pub(super) struct InnerContact {
    /// Sum of the contact forces' magnitudes, N.
    pub magnitude: f64,
    /// N.
    pub slope: [f64; 3],
    /// N/m.
    pub curvature: [[f64; 3]; 3],
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

    /// Contact with the inner race of `ball` at `angle` (rad) about the bearing's centre and the outward displacement `s` (m), the
    /// shaft at `centre` (m).
    pub(super) fn inner_contact(&self, ball: usize, angle: f64, s: f64, centre: [f64; 2]) -> InnerContact {
        let (sin, cos) = angle.sin_cos();
        let gap = self.inner_race.gap([cos, sin], s, centre);
        let [x, y] = gap.normal;
        let turned = (cos * y - sin * x).atan2(cos * x + sin * y);
        let own = angle + turned - self.shaft_angle;
        let force = self.force(&self.inner, ball, own, -turned, gap.penetration);
        // b = rho e - shaft over (x, y, s): along and across the normal
        let along = [-x, -y, x * cos + y * sin];
        let across = [y, -x, x * sin - y * cos];
        let [rr, rt, tt] = in_the_plane(&force, gap.distance);
        let curvature = |a: usize, b: usize| {
            rr * along[a] * along[b] + rt * (along[a] * across[b] + across[a] * along[b]) + tt * across[a] * across[b]
        };
        InnerContact {
            magnitude: force.magnitude,
            slope: [0, 1, 2].map(|a| force.radial * along[a] + force.tangential * across[a]),
            curvature: [0, 1, 2].map(|a| [0, 1, 2].map(|b| curvature(a, b))),
        }
    }

    /// Force on a race at `angle` in its own frame; `spun` is what the ball's flat is turned by as seen from there.
    fn force(&self, race: &RaceContact, ball: usize, angle: f64, spun: f64, nominal: f64) -> RaceForce {
        let penetration = nominal + self.oversizes[ball];
        let (sin, cos) = angle.sin_cos();
        let flat = self.spins[ball].filter(|(flat, spin)| race.feels(*flat, spin + spun));
        let spin = flat.map_or(0.0, |(_, spin)| spin + spun);
        let damage = Damage::of(race.defect_at([cos, sin]), flat.map(|(flat, _)| flat));
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
            // of the penetration of the undamaged race under this force
            let step = DIFFERENCE * (force.magnitude / race.plain.stiffness).cbrt().powi(2);
            // the profile turns the normals, which the contacts' own derivatives leave out
            let radius = race.radius(penetration);
            let outward = race.sign;
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
