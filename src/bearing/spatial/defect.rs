//! A defect in a groove: where it lies across the groove, and what a ball feels that rolls over it or beside it.
//!
//! ```text
//! V = κ ((1 − w) (2/5) k δ^{5/2} + w Σ (2/5) k_i δ_i^{5/2})        κ = k(cos α) / k
//! w = P((z_2 − z) / a) − P((z_1 − z) / a),   P(t) = 1/2 + (3 t − t³) / 4,   −1 ≤ t ≤ 1
//! ```
//!
//! δ_i and k_i are those of the profile in the bearing's plane at the same penetration δ and azimuth φ. The contact lies at the arc z from
//! the groove's bottom, the defect between z_1 and z_2, and the patch reaches by its half-axis a to both sides. w is the share of the
//! patch's load on the defect. The pressure `p_0 sqrt(1 − x²/a² − y²/b²)` (Hertz; K. L. Johnson, *Contact Mechanics*, 1985, (3.58) and
//! (4.24)) adds up over y to a load per length that goes with `1 − x²/a²`; its integral from −a to t a, over all of it, is P(t).
//!
//! w depends on the contact angle and on the penetration, and its derivatives are part of the force: V is a potential, but for k_i, which
//! is held as in the plane.

use super::contact::{GrooveContact, hertz_at};
use crate::bearing::defect::{DefectContacts, PolarPosition, RaceDefect};
use crate::bearing::error::{BearingError, positive, refused};
use crate::bearing::{BearingGeometry, Race};
use nalgebra::{Vector2, Vector3};
use std::f64::consts::PI;

/// Added to half the arc of a defect, rad: what the race's own displacement may carry a ball by.
const ARC_MARGIN: f64 = 2e-3;

/// Penetration at which the constant of the whole race is asked for, m: any.
const PROBE: f64 = 1e-6;

/// Half the time over which energies are compared, s: at the speeds of balls a part of what any feature is long.
const MOMENT: f64 = 1e-9;

/// A defect of a race as a bearing in space takes it.
#[derive(Debug, Clone, PartialEq)]
pub struct GrooveDefect {
    /// Its profile along the race.
    pub profile: RaceDefect,
    /// Where it lies across the groove; `None`: it reaches over all of it.
    pub across: Option<AcrossGroove>,
}

/// Where a defect lies across its groove.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AcrossGroove {
    /// Arc from the groove's bottom to its middle, m, positive towards +z.
    pub place: f64,
    /// Arc that it covers, m, positive.
    pub width: f64,
}

/// A defect in its groove, ready for queries.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DamagedGroove {
    profile: RaceDefect,
    /// Unit vector to the middle, and cosine of half the arc.
    middle: [f64; 2],
    reach: f64,
    /// Arcs of both edges from the groove's bottom, m.
    edges: Option<[f64; 2]>,
    /// Radius of the groove, m.
    groove: f64,
    /// Distance from the race's axis at which a ball touches the groove's bottom, m.
    touching: f64,
    /// Hertz constant of the whole race, N/m^{3/2}.
    stiffness: f64,
    /// Half-axis of the patch across over the root of the penetration, m^{1/2}.
    patch: f64,
    rise: f64,
}

/// What a ball on defects feels at one race: energy, and its gradient by the vector from the groove's centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DefectState {
    /// V, J.
    pub energy: f64,
    /// By the vector's radial and axial components, N, and by the azimuth, N m.
    pub gradient: Vector3<f64>,
    /// Sum of the contact forces' magnitudes, N.
    pub load: f64,
    /// Rate of penetration for rates of the same three: the gradient at a held share, over the load.
    pub push: Vector3<f64>,
}

impl DamagedGroove {
    /// The defect of a bearing whose contact at this race has the effective modulus E* (Pa).
    ///
    /// # Errors
    /// [`BearingError`]: a place or width out of range; a profile that was solved for another bearing.
    pub(crate) fn new(geometry: &BearingGeometry, defect: GrooveDefect, modulus: f64) -> Result<Self, BearingError> {
        let GrooveDefect { profile, across } = defect;
        let race = profile.race();
        let (groove, touching, side) = match race {
            Race::Inner => {
                let radius = geometry.effective_inner_race_radius() + geometry.ball_radius();
                (geometry.dimensions().inner_groove_radius, radius, -1.0)
            }
            Race::Outer => {
                let radius = geometry.outer_race_radius() - geometry.ball_radius();
                (geometry.dimensions().outer_groove_radius, radius, 1.0)
            }
        };
        let limit = 0.5 * PI * groove;
        let edges = match across {
            None => None,
            Some(AcrossGroove { place, width }) => {
                positive("width of a defect across the groove", width)?;
                if !(place.is_finite() && place.abs() <= limit) {
                    let rule = format!("m must be within {limit} m of the groove's bottom");
                    return refused("place of a defect across the groove", place, &rule);
                }
                Some([place - 0.5 * width, place + 0.5 * width])
            }
        };
        let beside = PolarPosition { radius: touching + side * PROBE, angle: profile.angle() + PI };
        let whole = profile.contacts(beside).pressing().next().copied().unwrap_or_default();
        if !(whole.delta.is_finite() && (whole.delta - PROBE).abs() < 1e-6 * PROBE) {
            let reason =
                format!("a defect of the {race} race was solved for another bearing: give it this one's geometry");
            return Err(BearingError(reason));
        }
        let hertz = hertz_at(geometry, race, 1.0, modulus)?;
        let (sin, cos) = profile.angle().sin_cos();
        Ok(Self {
            middle: [cos, sin],
            reach: (profile.contact_half_angle() + ARC_MARGIN).min(PI).cos(),
            edges,
            groove,
            touching,
            stiffness: whole.stiffness,
            // a goes with Q^(1/3), and Q with the penetration to 3/2
            patch: hertz.patch(1.0).longer * hertz.stiffness.cbrt(),
            rise: profile.rise(),
            profile,
        })
    }

    /// Its profile along the race.
    pub(crate) fn profile(&self) -> &RaceDefect {
        &self.profile
    }

    /// The race that carries it.
    pub(crate) fn race(&self) -> Race {
        self.profile.race()
    }

    /// Zero or positive for a ball in this direction (unit vector in the race's frame) that may feel it.
    #[inline(always)]
    pub(crate) fn inside(&self, [cos, sin]: [f64; 2]) -> f64 {
        (cos * self.middle[0] + sin * self.middle[1]) - self.reach
    }

    /// Whether two defects of one race share a part of it.
    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        let half = |defect: &Self| defect.profile.contact_half_angle() + ARC_MARGIN;
        let apart = (self.middle[0] * other.middle[0] + self.middle[1] * other.middle[1]).clamp(-1.0, 1.0).acos();
        let across = match (self.edges, other.edges) {
            (Some([a, b]), Some([c, d])) => a < d && c < b,
            _ => true,
        };
        self.race() == other.race() && apart < half(self) + half(other) && across
    }

    /// Share of the patch's load on the defect for a contact at an arc from the groove's bottom (m) and a penetration (m), with its
    /// derivatives by both.
    fn share(&self, arc: f64, penetration: f64) -> [f64; 3] {
        let Some(edges) = self.edges else {
            return [1.0, 0.0, 0.0];
        };
        let depth = penetration + self.rise;
        if depth <= 0.0 {
            return [0.0; 3];
        }
        let half = self.patch * depth.sqrt();
        let [before, after] = edges.map(|edge| {
            let t = (edge - arc) / half;
            if t.abs() >= 1.0 {
                return [if t > 0.0 { 1.0 } else { 0.0 }, 0.0, 0.0];
            }
            let slope = 0.75 * (1.0 - t * t);
            [0.5 + 0.25 * t * (3.0 - t * t), -slope / half, -0.5 * slope * t / depth]
        });
        std::array::from_fn(|k| after[k] - before[k])
    }

    /// Energy of the profile's contacts without the angle's factor, its derivatives by penetration and azimuth, and the sum of forces.
    fn profile_at(&self, side: f64, penetration: f64, azimuth: f64) -> [f64; 4] {
        let radius = self.touching + side * penetration;
        let mut contacts = DefectContacts::none();
        self.profile.contacts_into(PolarPosition { radius, angle: azimuth }, &mut contacts);
        contacts.pressing().fold([0.0; 4], |[energy, by_depth, by_azimuth, load], contact| {
            let force = contact.stiffness * contact.delta * contact.delta.sqrt();
            [
                energy + 0.4 * force * contact.delta,
                by_depth + side * force * contact.normal_radial,
                by_azimuth + force * contact.normal_tangential * radius,
                load + force,
            ]
        })
    }
}

/// The contact of a ball with a race on which these defects lie, each with its share: at a vector `d` (m) from the groove's centre and
/// an azimuth in the race's frame (rad). None of a ball that runs beside them all.
pub(crate) fn felt_on(
    defects: &[DamagedGroove],
    contact: &GrooveContact,
    d: Vector2<f64>,
    azimuth: f64,
) -> Option<DefectState> {
    let distance = d.norm().max(f64::MIN_POSITIVE);
    let normal = d / distance;
    let (penetration, side) = (distance - contact.seat, contact.side);
    let [k, k_x, _] = contact.stiffness.at(side * normal.x);
    let deep = penetration.max(0.0);
    let power = deep * deep.sqrt();
    // everything over k(cos α): energy, by penetration, by the arc's angle, by azimuth, load; push by penetration and azimuth
    let (mut energy, mut by_depth, mut by_angle, mut by_azimuth, mut load) =
        (0.4 * deep * power, power, 0.0, 0.0, power);
    let mut push = [power, 0.0];
    let angle = normal.y.atan2(side * normal.x);
    let mut met = false;
    for defect in defects {
        let [share, by_arc, by_penetration] = defect.share(defect.groove * angle, penetration);
        if share <= 0.0 {
            continue;
        }
        met = true;
        let own = defect.profile_at(side, penetration, azimuth).map(|part| part / defect.stiffness);
        let change = own[0] - 0.4 * deep * power;
        energy += share * change;
        by_depth += share * (own[1] - power) + by_penetration * change;
        by_angle += defect.groove * by_arc * change;
        by_azimuth += share * own[2];
        load += share * (own[3] - power);
        push[0] += share * (own[1] - power);
        push[1] += share * own[2];
    }
    // the angle grows with side (−n_z, n_r) over the distance, and the cosine falls with its sine n_z
    let turning = (k * by_angle - k_x * normal.y * energy) * side / distance;
    let along = k * by_depth;
    let per_load = 1.0 / load.max(f64::MIN_POSITIVE);
    met.then(|| DefectState {
        energy: k * energy,
        gradient: Vector3::new(
            along * normal.x - turning * normal.y,
            along * normal.y + turning * normal.x,
            k * by_azimuth,
        ),
        load: k * load,
        push: Vector3::new(push[0] * normal.x, push[0] * normal.y, push[1]) * per_load,
    })
}

/// Power that the contacts get without being pressed, W, for rates of `d` (m/s) and azimuth (rad/s): what their constants change by as
/// they move along the profile.
pub(crate) fn blending_on(
    defects: &[DamagedGroove],
    contact: &GrooveContact,
    d: Vector2<f64>,
    azimuth: f64,
    rates: Vector3<f64>,
) -> f64 {
    let distance = d.norm().max(f64::MIN_POSITIVE);
    let normal = d / distance;
    let (penetration, side) = (distance - contact.seat, contact.side);
    let growth = normal.dot(&rates.xy());
    let angle = normal.y.atan2(side * normal.x);
    let power = |defect: &DamagedGroove| {
        let [share, ..] = defect.share(defect.groove * angle, penetration);
        let at = |time: f64| defect.profile_at(side, penetration + time * growth, azimuth + time * rates.z);
        let change = (at(MOMENT)[0] - at(-MOMENT)[0]) / (2.0 * MOMENT);
        let [_, by_depth, by_azimuth, _] = at(0.0);
        share * (change - by_depth * growth - by_azimuth * rates.z) / defect.stiffness
    };
    contact.stiffness.at(side * normal.x)[0] * defects.iter().map(power).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing::defect::{CurvatureReading, DEFAULT_RIM_RADIUS, Dent, DentShape};
    use crate::bearing::samples::source_bearing;
    use crate::bearing::spatial::{RaceControl, SpatialBearing, Thrust};
    use crate::bearing::{ContactStiffness, RaceContacts, samples::steel};

    fn dent(race: Race, across: Option<AcrossGroove>) -> GrooveDefect {
        let geometry = source_bearing();
        let stiffness: ContactStiffness = RaceContacts::new(&geometry, steel(), steel(), steel()).unwrap().stiffness();
        let shape = DentShape {
            angle: 0.3,
            length: 0.4e-3,
            width: None,
            depth: 2e-6,
            rim_radius: DEFAULT_RIM_RADIUS,
            curvature: CurvatureReading::Total,
        };
        let profile = RaceDefect::Dent(Dent::new(&geometry, race, shape, stiffness).unwrap());
        GrooveDefect { profile, across }
    }

    fn bearing(defects: Vec<GrooveDefect>) -> Result<SpatialBearing, BearingError> {
        SpatialBearing::new(source_bearing(), [113e9; 2], Thrust::Both, RaceControl::Outer)?.with_defects(defects)
    }

    fn contact(bearing: &SpatialBearing, race: Race) -> &GrooveContact {
        if race == Race::Inner { &bearing.law().inner } else { &bearing.law().outer }
    }

    /// The share against the pressure of the ellipse, `3/4 (1 - x^2)` over the half-axis, summed strip by strip; its slopes against
    /// differences.
    #[test]
    fn the_share_is_the_load_on_the_defect() {
        let bearing = bearing(vec![dent(Race::Outer, Some(AcrossGroove { place: 1e-4, width: 5e-5 }))]).unwrap();
        let defect = &bearing.defects()[0];
        let depth = 1e-6;
        let half = defect.patch * f64::sqrt(depth);
        let count = 200_000;
        for arc in [-1e-4, 2e-5, 7e-5, 1e-4, 1.3e-4] {
            let strips = (0..count).map(|strip| 2.0 * (f64::from(strip) + 0.5) / f64::from(count) - 1.0);
            let on = strips.filter(|x| (arc + half * x - 1e-4).abs() < 2.5e-5);
            let load: f64 = on.map(|x| 0.75 * (1.0 - x * x) * 2.0 / f64::from(count)).sum();
            let [share, by_arc, by_depth] = defect.share(arc, depth);
            // a strip more or less at either edge
            assert!((share - load).abs() < 2e-5, "{arc}: {share} {load}");
            let slope = |change: &dyn Fn(f64) -> f64, step: f64| (change(step) - change(-step)) / (2.0 * step);
            let expected = slope(&|step| defect.share(arc + step, depth)[0], 1e-9);
            assert!((by_arc - expected).abs() < 1e-6 / half, "{arc}: {by_arc} {expected}");
            let expected = slope(&|step| defect.share(arc, depth + step)[0], 1e-12);
            assert!((by_depth - expected).abs() < 1e-6 / depth, "{arc}: {by_depth} {expected}");
        }
        assert!((0.0..1e-300).contains(&defect.share(1e-4, 0.0)[0]));
    }

    /// What the energy changes by along any motion is the work of the force and what the constants change by.
    #[test]
    fn the_force_is_the_gradient_of_the_energy() {
        for race in [Race::Outer, Race::Inner] {
            for across in [None, Some(AcrossGroove { place: 1.2e-4, width: 1.5e-4 })] {
                let bearing = bearing(vec![dent(race, across)]).unwrap();
                let (contact, defects) = (contact(&bearing, race), bearing.defects());
                let mut felt = 0;
                for (arc, depth, beside) in
                    [(1e-4, 2e-6, 0.0), (1.9e-4, 3e-6, 0.02), (2.1e-4, 2.5e-6, 0.05), (3e-5, 4e-6, -0.05)]
                {
                    let (sin, cos) = f64::sin_cos(arc / defects[0].groove);
                    let normal = Vector2::new(contact.side * cos, sin);
                    let (d, azimuth) = ((contact.seat + depth) * normal, 0.3 + beside);
                    let at = felt_on(defects, contact, d, azimuth).unwrap();
                    felt += usize::from((at.energy / contact.at(d).energy - 1.0).abs() > 0.01);
                    for rates in
                        [Vector3::new(0.03, 0.02, 0.0), Vector3::new(0.01, -0.02, 40.0), Vector3::new(0.0, 0.0, 200.0)]
                    {
                        let energy = |time: f64| {
                            let d = d + time * rates.xy();
                            felt_on(defects, contact, d, azimuth + time * rates.z).unwrap().energy
                        };
                        let expected = (energy(1e-9) - energy(-1e-9)) / 2e-9;
                        let found = at.gradient.dot(&rates) + blending_on(defects, contact, d, azimuth, rates);
                        let scale = contact.at(d).load * (rates.xy().norm() + 1e-3 * rates.z);
                        assert!((found - expected).abs() < 1e-6 * scale, "{race} {arc} {rates:?}: {found} {expected}");
                    }
                }
                assert!(felt >= 2, "{felt}");
            }
        }
    }

    #[test]
    fn a_ball_beside_a_defect_feels_nothing_of_it() {
        let across = Some(AcrossGroove { place: -3e-4, width: 1e-4 });
        let bearing = bearing(vec![dent(Race::Outer, across)]).unwrap();
        let contact = contact(&bearing, Race::Outer);
        let d = (contact.seat + 2e-6) * Vector2::new(1.0, 0.0);
        assert_eq!(felt_on(bearing.defects(), contact, d, 0.3), None);
    }

    #[test]
    fn each_rule_fires_with_its_message() {
        let message = |defects: Vec<GrooveDefect>| bearing(defects).unwrap_err().to_string();
        let at = |place: f64, width: f64| dent(Race::Outer, Some(AcrossGroove { place, width }));
        assert!(message(vec![at(0.0, 0.0)]).starts_with("width of a defect across the groove = 0"));
        assert!(
            message(vec![at(2e-3, 1e-4)]).starts_with("place of a defect across the groove = 0.002 m must be within")
        );
        let overlap = message(vec![at(0.0, 1e-4), at(5e-5, 1e-4)]);
        assert_eq!(overlap, "two defects of the outer race overlap: give one of both");
        let other = source_bearing().with_radial_play(2e-5).unwrap();
        let other = SpatialBearing::new(other, [113e9; 2], Thrust::Both, RaceControl::Outer).unwrap();
        let foreign = other.with_defects(vec![dent(Race::Inner, None)]).unwrap_err().to_string();
        assert_eq!(foreign, "a defect of the inner race was solved for another bearing: give it this one's geometry");
        assert!(bearing(vec![at(0.0, 1e-4), at(2e-4, 1e-4), dent(Race::Inner, None)]).is_ok());
    }
}
