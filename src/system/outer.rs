//! Contact of a ball with the outer race, dented or not: force and tangent for one ball position.

use super::BearingSetup;
use crate::bearing::HertzContact;
use crate::bearing::dent::{OuterDent, PolarPosition};

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
    dents: Vec<OuterDent>,
}

impl OuterRace {
    pub fn new(setup: &BearingSetup) -> Self {
        Self {
            plain: HertzContact {
                stiffness: setup.stiffness.outer(),
                damping: setup.contact_damping,
            },
            touching_radius: setup.geometry.outer_race_radius() - setup.geometry.ball_radius(),
            dents: setup.dents.clone(),
        }
    }

    /// The dent that a ball at this angle may feel.
    #[inline]
    pub fn dent_at(&self, angle: f64) -> Option<&OuterDent> {
        self.dents.iter().find(|dent| dent.contains(angle))
    }

    /// Force of a ball at `angle` (rad) whose centre is displaced outward by `s` (m) relative to the
    /// displaced race, moving at `rate` (radial, tangential; m/s) relative to it.
    #[inline]
    pub fn force(&self, angle: f64, s: f64, rate: [f64; 2]) -> OuterForce {
        match self.dent_at(angle) {
            Some(dent) => self.dented(dent, angle, s, rate),
            None => {
                let force = self.plain.linearised(s, rate[0]);
                OuterForce {
                    radial: force.force,
                    tangential: 0.0,
                    tangent: [force.by_penetration, 0.0, 0.0],
                    magnitude: force.force,
                }
            }
        }
    }

    /// The same inside a dent: all contacts with rim and floor, each along its own normal.
    pub fn dented(&self, dent: &OuterDent, angle: f64, s: f64, rate: [f64; 2]) -> OuterForce {
        let contacts = dent.contacts(PolarPosition {
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
