//! Contact of a ball with the outer race, dented or not: force and tangent for one ball position.

use super::BearingSetup;
use crate::bearing::HertzContact;
use crate::bearing::defect::{Dent, PolarPosition};

/// Force of a ball on the outer race, in the ball's polar frame (radial outward, tangential
/// counter-clockwise).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct OuterForce {
    /// Radial force on the race, N.
    pub radial: f64,
    /// Tangential force on the race, N.
    pub tangential: f64,
    /// Derivatives by the ball's radial and tangential position relative to the race, N/m:
    /// (radial by radial, radial by tangential = tangential by radial, tangential by tangential).
    pub tangent: [f64; 3],
    /// Sum of the contact forces' magnitudes, N.
    pub magnitude: f64,
}

/// The outer race of a bearing.
#[derive(Debug, Clone)]
pub(super) struct OuterRace {
    plain: HertzContact,
    touching_radius: f64,
    dents: Vec<DentArc>,
}

/// A dent with the arc in which a ball may feel it.
#[derive(Debug, Clone)]
struct DentArc {
    dent: Dent,
    middle: [f64; 2],
    /// Cosine of half the arc.
    reach: f64,
}

/// Added to half the arc, rad: the race's own tangential displacement (1e-6 m on 4e-3 m) must not
/// carry a ball out of the arc. Beyond the rims a dent's contact is that of the plain race.
const ARC_MARGIN: f64 = 2e-3;

impl OuterRace {
    pub fn new(setup: &BearingSetup) -> Self {
        Self {
            plain: HertzContact {
                stiffness: setup.stiffness.outer(),
                damping: setup.contact_damping,
            },
            touching_radius: setup.geometry.outer_race_radius() - setup.geometry.ball_radius(),
            dents: setup
                .dents
                .iter()
                .map(|dent| {
                    let (sin, cos) = dent.shape().angle.sin_cos();
                    DentArc {
                        middle: [cos, sin],
                        reach: (dent.contact_half_angle() + ARC_MARGIN).cos(),
                        dent: dent.clone(),
                    }
                })
                .collect(),
        }
    }

    /// Number of the dent that a ball in direction `e` (unit vector) may feel.
    #[inline]
    pub fn dent_at(&self, e: [f64; 2]) -> Option<usize> {
        self.dents
            .iter()
            .position(|arc| e[0] * arc.middle[0] + e[1] * arc.middle[1] >= arc.reach)
    }

    /// Force of a ball at `angle` (rad) whose centre is displaced outward by `s` (m) relative to the
    /// displaced race, moving at `rate` (radial, tangential; m/s) relative to it.
    pub fn force(&self, angle: f64, s: f64, rate: [f64; 2]) -> OuterForce {
        let (sin, cos) = angle.sin_cos();
        match self.dent_at([cos, sin]) {
            Some(dent) => self.dented(dent, angle, s, rate),
            None => self.plain_force(s, rate[0]),
        }
    }

    /// The same away from any dent.
    #[inline]
    pub fn plain_force(&self, s: f64, rate: f64) -> OuterForce {
        let force = self.plain.linearised(s, rate);
        OuterForce {
            radial: force.force,
            tangential: 0.0,
            tangent: [force.by_penetration, 0.0, 0.0],
            magnitude: force.force,
        }
    }

    /// The same in the arc of a dent: all contacts with race, rim and floor, each along its own
    /// normal.
    pub fn dented(&self, dent: usize, angle: f64, s: f64, rate: [f64; 2]) -> OuterForce {
        let contacts = self.dents[dent].dent.contacts(PolarPosition {
            radius: self.touching_radius + s,
            angle,
        });
        let mut sum = OuterForce::default();
        for contact in contacts.pressing() {
            let [n_r, n_t] = [contact.normal_radial, contact.normal_tangential];
            let law = HertzContact {
                stiffness: contact.stiffness,
                damping: self.plain.damping,
            };
            let force = law.linearised(contact.delta, contact.rate(rate[0], rate[1]));
            sum.radial += force.force * n_r;
            sum.tangential += force.force * n_t;
            sum.magnitude += force.force;
            sum.tangent[0] += force.by_penetration * n_r * n_r;
            sum.tangent[1] += force.by_penetration * n_r * n_t;
            sum.tangent[2] += force.by_penetration * n_t * n_t;
        }
        sum
    }
}
