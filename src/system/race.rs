//! Contact of a ball with a race, healthy or not: forces, and what they store and take.
//!
//! Contact of a ball with a race, healthy or not: force and tangent for one ball position.
//!
//! What the contacts of one ball with a race store, and what their damping takes.

use super::bearing_setup::BearingSetup;
use crate::bearing::defect::{BallFlat, DefectContact, DefectContacts, Feature, PolarPosition, RaceDefect};
use crate::bearing::{HertzContact, Race, Waviness};
use crate::numerics::lanes::{Lanes, each};
use std::f64::consts::PI;

/// Force of a ball on a race, in the ball's polar frame about the race's centre (radial outward, tangential
/// counter-clockwise).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::system) struct RaceForce {
    /// Radial force on the race, N; negative on the inner one.
    pub radial: f64,
    /// Tangential force on the race, N.
    pub tangential: f64,
    /// Derivatives by the ball's radial and tangential position relative to the race, N/m:
    /// (radial by radial, radial by tangential = tangential by radial, tangential by tangential).
    pub tangent: [f64; 3],
    /// Derivatives by the ball's radial and tangential velocity relative to the race, N s/m, in the same order.
    pub by_rate: [f64; 3],
    /// Rate of the radial force by the ball's motion along the race at its velocity there, N/s.
    pub growth: f64,
    /// Sum of the contact forces' magnitudes, N.
    pub magnitude: f64,
}

/// Where a ball stands to a race, and how it moves.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::system) struct RacePlace {
    /// Angle of the ball about the race's centre in the race's own frame, rad.
    pub angle: f64,
    /// How far the ball is pressed beyond touching the undamaged race, m.
    pub penetration: f64,
    /// Rate of that, m/s.
    pub rate: f64,
    /// Velocity of the ball's centre along increasing angle about the race's centre, m/s: the distance from there that
    /// `penetration` says times the rate of `angle` and `turning`.
    pub along: f64,
    /// Angle and speed of the ball's flat, if it has one: from its radius vector, rad, and in the fixed frame, rad/s.
    pub spin: [f64; 2],
    /// Angular speed of the race, rad/s.
    pub turning: f64,
}

/// What a ball touches at a place.
#[derive(Debug, Clone)]
pub(in crate::system) struct Touch {
    /// How far it was pressed there, m; not a number where nothing was found yet.
    pub penetration: f64,
    contacts: DefectContacts,
    /// How fast its centre moves along what carries them, m/s.
    along: f64,
    /// What waves take of the rate of the penetration, m/s.
    climbing: f64,
    lean: Option<Lean>,
}

/// How waves lean there.
#[derive(Debug, Clone, Copy)]
struct Lean {
    /// Their slope along the race, and its derivative along it, 1/m.
    lean: f64,
    bend: f64,
    /// How fast the ball's centre moves along the race, m/s.
    sliding: f64,
}

impl Default for Touch {
    fn default() -> Self {
        Self { penetration: f64::NAN, contacts: DefectContacts::none(), along: 0.0, climbing: 0.0, lean: None }
    }
}

/// What damage a ball feels in one place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(in crate::system) enum Damage {
    /// None.
    #[default]
    None,
    /// A defect of the race, by its number.
    Race(usize),
    /// The flat of the ball, by its number.
    Flat(usize),
}

impl Damage {
    /// A defect of the race before a flat of the ball.
    #[inline]
    pub(in crate::system) fn of(defect: Option<usize>, flat: Option<usize>) -> Self {
        match (defect, flat) {
            (Some(defect), _) => Self::Race(defect),
            (None, Some(flat)) => Self::Flat(flat),
            (None, None) => Self::None,
        }
    }
}

/// One race of a bearing.
#[derive(Debug, Clone)]
pub(in crate::system) struct RaceContact {
    race: Race,
    /// +1 if a ball is pressed onto the race by moving outwards, -1 if inwards.
    pub sign: f64,
    /// Contact with the undamaged race.
    pub plain: HertzContact,
    /// Distance from the race's centre at which a ball touches it, m.
    touching_radius: f64,
    waviness: Waviness,
    /// How far it rises towards the balls at most, m: a ball farther than this from touching the undamaged race touches
    /// nothing.
    pub rise: f64,
    /// The same of defects alone, m, and what a ball moves by while what it touches stays.
    clear: f64,
    /// Whether a ball may meet anything but a plain circle.
    pub irregular: bool,
    defects: Vec<DefectArc>,
    flats: Vec<BallFlat>,
}

/// By what part of its radius a ball moves at most while what it touches stays the same: normals turn by so much, and stiffnesses at
/// the ends of rims change by twenty times that.
pub(in crate::system) const SAME_TOUCH: f64 = 1e-7;

/// A defect with the arc in which a ball may feel it.
#[derive(Debug, Clone)]
struct DefectArc {
    defect: RaceDefect,
    middle: [f64; 2],
    /// Cosine of half the arc.
    reach: f64,
}

/// Added to half the arc, rad: the race's own tangential displacement (1e-6 m on 4e-3 m) must not
/// carry a ball out of the arc. Beyond the rims a defect's contact is that of the plain race.
const ARC_MARGIN: f64 = 2e-3;

impl RacePlace {
    /// Angular speed of what carries the damage, rad/s: of the race, or of the ball.
    pub(crate) fn carrier(&self, damage: Damage) -> f64 {
        match damage {
            Damage::Flat(_) => self.spin[1],
            Damage::None | Damage::Race(_) => self.turning,
        }
    }
}

impl RaceContact {
    /// The race of a bearing.
    pub(crate) fn new(setup: &BearingSetup, race: Race) -> Self {
        let geometry = &setup.geometry;
        let (sign, touching_radius) = match race {
            Race::Outer => (1.0, geometry.outer_race_radius() - geometry.ball_radius()),
            Race::Inner => (-1.0, geometry.effective_inner_race_radius() + geometry.ball_radius()),
        };
        let own = || setup.race_defects.iter().filter(|defect| defect.race() == race);
        let waviness = Waviness::of(race, &setup.waves);
        let arc = |defect: &RaceDefect| {
            let (sin, cos) = defect.angle().sin_cos();
            DefectArc {
                middle: [cos, sin],
                reach: (defect.contact_half_angle() + ARC_MARGIN).min(PI).cos(),
                defect: defect.clone(),
            }
        };
        let rise = own().fold(0.0, |most, defect| defect.rise().max(most));
        Self {
            race,
            sign,
            plain: HertzContact { stiffness: setup.stiffness.at(race), damping: setup.contact_damping },
            touching_radius,
            irregular: !waviness.is_empty() || own().next().is_some() || !setup.flats.is_empty(),
            rise: waviness.most() + rise,
            clear: rise + SAME_TOUCH * geometry.ball_radius(),
            waviness,
            defects: own().map(arc).collect(),
            flats: setup.flats.iter().map(|flat| flat.shape.clone()).collect(),
        }
    }

    /// The same without contact damping.
    pub(crate) fn undamped(mut self) -> Self {
        self.plain.damping = 0.0;
        self
    }

    /// Whether the race has waves.
    #[inline]
    pub(crate) fn is_wavy(&self) -> bool {
        !self.waviness.is_empty()
    }

    /// Distance (m) of a ball's centre from the race's when it is pressed so far beyond touching it.
    #[inline]
    pub(crate) fn radius(&self, penetration: f64) -> f64 {
        self.touching_radius + self.sign * penetration
    }

    /// Number of the defect that a ball in direction `e` (unit vector in the race's frame) may feel.
    #[inline]
    pub(crate) fn defect_at(&self, e: [f64; 2]) -> Option<usize> {
        self.defects.iter().position(|arc| e[0] * arc.middle[0] + e[1] * arc.middle[1] >= arc.reach)
    }

    /// Number of defects.
    #[inline(always)]
    pub(crate) fn defects(&self) -> usize {
        self.defects.len()
    }

    /// Zero or positive where balls in directions (`cos`, `sin`), unit vectors in the race's frame, may feel a defect.
    #[inline(always)]
    pub(crate) fn inside(&self, defect: usize, [cos, sin]: [&Lanes; 2]) -> Lanes {
        let arc = &self.defects[defect];
        let [c, s] = arc.middle;
        each(|l| (cos[l] * c + sin[l] * s) - arc.reach)
    }

    /// Whether the flat with this number can be felt at a spin angle (rad).
    #[inline]
    pub(crate) fn feels(&self, flat: usize, spin: f64) -> bool {
        self.flats[flat].contains(self.race, spin)
    }

    /// Force of a ball away from any damage.
    #[inline]
    pub(crate) fn plain_force(&self, penetration: f64, rate: f64) -> RaceForce {
        let force = self.plain.linearised(penetration, rate);
        RaceForce {
            radial: self.sign * force.force,
            tangential: 0.0,
            tangent: [force.by_penetration, 0.0, 0.0],
            by_rate: [force.by_rate, 0.0, 0.0],
            growth: 0.0,
            magnitude: force.force,
        }
    }

    /// Force of a ball at a place: on damage all contacts, each along its own normal; on waves along theirs.
    #[inline]
    pub(crate) fn force(&self, damage: Damage, at: &RacePlace) -> RaceForce {
        if damage == Damage::None && self.waviness.is_empty() {
            return self.plain_force(at.penetration, at.rate);
        }
        let mut touch = Touch::default();
        self.touch_into(damage, at, &mut touch);
        self.force_by(&touch, at.penetration, at.rate)
    }

    /// What a ball touches at a place, in the place of what was found before.
    #[inline]
    pub(crate) fn touch_into(&self, damage: Damage, at: &RacePlace, touch: &mut Touch) {
        let level = self.on_waves(at);
        (touch.penetration, touch.climbing) = (at.penetration, at.rate - level.rate);
        touch.along = self.contacts_into(damage, &level, &mut touch.contacts);
        touch.lean = None;
        if !self.waviness.is_empty() {
            let radius = self.radius(at.penetration);
            let [_, slope, bend] = self.waviness.at(at.angle);
            touch.lean = Some(Lean {
                lean: slope / radius,
                bend: bend / (radius * radius),
                sliding: at.along - radius * at.turning,
            });
        }
    }

    /// Force of a ball by what it touches, at a penetration (m) next to that and any rate of it (m/s): contacts move along their
    /// normals, which stay.
    ///
    /// The waves h(φ) shift everything: the potential is that of the race without them at the penetration less σ h, σ = 1 on the
    /// outer and -1 on the inner race, and its slope along the race is `-h' / ρ` times the radial force.
    #[inline]
    pub(crate) fn force_by(&self, touch: &Touch, penetration: f64, rate: f64) -> RaceForce {
        let moved = self.sign * (penetration - touch.penetration);
        let mut force = self.sum(touch, moved, rate - touch.climbing);
        let Some(Lean { lean, bend, sliding }) = touch.lean else {
            return force;
        };
        let normal = force.radial;
        force.tangential -= lean * normal;
        force.growth -= lean * force.tangent[0] * sliding;
        let leaning = |[rr, rt, tt]: [f64; 3]| [rr, rt - lean * rr, tt - 2.0 * lean * rt + lean * lean * rr];
        force.tangent = leaning(force.tangent);
        force.tangent[2] -= bend * normal;
        force.by_rate = leaning(force.by_rate);
        force
    }

    /// The place on a race without waves that has the same contacts.
    #[inline]
    pub(super) fn on_waves(&self, at: &RacePlace) -> RacePlace {
        if self.waviness.is_empty() {
            return *at;
        }
        let [height, slope, _] = self.waviness.at(at.angle).map(|part| self.sign * part);
        let turn = at.along / self.radius(at.penetration);
        let penetration = at.penetration - height;
        RacePlace {
            penetration,
            rate: at.rate - slope * (turn - at.turning),
            along: turn * self.radius(penetration),
            ..*at
        }
    }

    /// Finds the contacts on a race without waves; gives how fast (m/s) the ball's centre moves along what carries them.
    #[inline]
    pub(super) fn contacts_into(&self, damage: Damage, at: &RacePlace, contacts: &mut DefectContacts) -> f64 {
        let radius = self.radius(at.penetration);
        contacts.clear();
        match damage {
            Damage::None => contacts.push(DefectContact {
                feature: Feature::Plain,
                delta: at.penetration,
                normal_radial: self.sign,
                normal_tangential: 0.0,
                stiffness: self.plain.stiffness,
            }),
            // of a ball that is clear of all that rises, none presses
            Damage::Race(_) | Damage::Flat(_) if at.penetration <= -self.clear => {}
            Damage::Race(defect) => {
                let place = PolarPosition { radius, angle: at.angle };
                self.defects[defect].defect.contacts_into(place, contacts);
            }
            Damage::Flat(flat) => self.flats[flat].contacts_into(self.race, at.spin[0], radius, contacts),
        }
        at.along - radius * at.carrier(damage)
    }

    /// Overlaps of all contacts that press at a place, m, and the rates of these by which damping goes, m/s.
    #[cfg(test)]
    pub(crate) fn overlaps(&self, damage: Damage, at: &RacePlace) -> Vec<[f64; 2]> {
        let mut touch = Touch::default();
        self.touch_into(damage, at, &mut touch);
        let radial = self.sign * (at.rate - touch.climbing);
        let pressing = touch.contacts.pressing();
        pressing.map(|contact| [contact.delta, contact.rate(radial, touch.along)]).collect()
    }

    /// Sum of the contacts' forces, the ball `moved` (m) outwards from where they were found.
    #[inline]
    fn sum(&self, touch: &Touch, moved: f64, rate: f64) -> RaceForce {
        let mut sum = RaceForce::default();
        let (radial, along) = (self.sign * rate, touch.along);
        for contact in touch.contacts.as_slice() {
            let [n_r, n_t] = [contact.normal_radial, contact.normal_tangential];
            let delta = contact.delta + n_r * moved;
            // what is not a number shows itself
            if delta <= 0.0 {
                continue;
            }
            let law = HertzContact { stiffness: contact.stiffness, damping: self.plain.damping };
            let force = law.linearised(delta, contact.rate(radial, along));
            sum.radial += force.force * n_r;
            sum.tangential += force.force * n_t;
            sum.magnitude += force.force;
            for (place, [a, b]) in [[n_r, n_r], [n_r, n_t], [n_t, n_t]].into_iter().enumerate() {
                sum.tangent[place] += force.by_penetration * a * b;
                sum.by_rate[place] += force.by_rate * a * b;
            }
        }
        sum.growth = sum.tangent[1] * along;
        sum
    }
}

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
        let mut contacts = DefectContacts::none();
        let along = self.contacts_into(damage, &at, &mut contacts);
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
