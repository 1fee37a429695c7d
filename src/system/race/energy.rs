//! What the contacts of one ball with a race store, and what their damping takes.

use super::contact::{Damage, RaceContact, RacePlace};
use crate::bearing::HertzContact;

/// Half the time over which energies are compared, s: at the speeds of balls a part of what any feature is long.
const MOMENT: f64 = 1e-9;

/// Energy of a ball's contacts with a race.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::system) struct RaceEnergy {
    /// `(2/5) k delta^(5/2)` of all contacts, J.
    pub elastic: f64,
    /// Power of their elastic forces into them, W.
    pub pressed: f64,
    /// Power that their damping takes, W.
    pub dissipated: f64,
    /// What damping adds to the radial force on the race, N.
    pub damping: f64,
    /// Power of their tangential forces at the velocity of what carries the damage against the race, W: that of the ball's turning
    /// on a flat.
    pub carried: f64,
}

impl RaceContact {
    /// Energy of a ball at a place, its damping forces those of the place's rates; they work where the penetration's rate is
    /// `moving`, m/s, which a race that gives way to the forces may make another.
    pub(crate) fn energy(&self, damage: Damage, at: &RacePlace, moving: f64) -> RaceEnergy {
        let (rate, against) = (at.rate, at.along - self.radius(at.penetration) * at.turning);
        let at = self.on_waves(at);
        let moving = moving + (at.rate - rate);
        let Some((contacts, along)) = self.contacts(damage, &at) else {
            let law = self.plain;
            let damping = law.force(at.penetration, at.rate) - law.force(at.penetration, 0.0);
            return RaceEnergy {
                elastic: law.energy(at.penetration),
                pressed: law.force(at.penetration, 0.0) * moving,
                dissipated: damping * moving,
                damping: self.sign * damping,
                carried: 0.0,
            };
        };
        let mut sum = RaceEnergy::default();
        for contact in contacts.pressing() {
            let law = HertzContact { stiffness: contact.stiffness, damping: self.plain.damping };
            let evaluated = contact.rate(self.sign * at.rate, along);
            let rate = contact.rate(self.sign * moving, along);
            let elastic = law.force(contact.delta, 0.0);
            let damping = law.force(contact.delta, evaluated) - elastic;
            sum.elastic += law.energy(contact.delta);
            sum.pressed += elastic * rate;
            sum.dissipated += damping * rate;
            sum.damping += damping * contact.normal_radial;
            sum.carried += (elastic + damping) * contact.normal_tangential * (against - along);
        }
        sum
    }

    /// Power that a ball's contacts get without being pressed, W: what their stiffness changes by as they move along a profile,
    /// `(2/5) delta^(5/2) dk/dt`; from a difference of their energy along the motion.
    pub(crate) fn blending(&self, damage: Damage, at: &RacePlace, moving: f64) -> f64 {
        if damage == Damage::None {
            return 0.0;
        }
        let turn = at.along / self.radius(at.penetration);
        let elastic = |time: f64| {
            let [spin, speed] = at.spin;
            let place = RacePlace {
                penetration: at.penetration + time * moving,
                angle: at.angle + time * (turn - at.turning),
                spin: [spin + time * (speed - turn), speed],
                ..*at
            };
            self.energy(damage, &place, moving).elastic
        };
        let change = (elastic(MOMENT) - elastic(-MOMENT)) / (2.0 * MOMENT);
        change - self.energy(damage, at, moving).pressed
    }
}
