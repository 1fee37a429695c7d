//! A bearing: loads and stiffness against the inner ring's displacement, the balls following.
//!
//! ```text
//! load = ∂ΣV/∂q − friction,   K = K_aa − K_ab K_bb⁻¹ K_ba        q = (x, y, z, θ_x, θ_y)
//! ```

use super::ball::{BallLaw, RaceControl};
use super::contact::{AngleStiffness, GrooveContact, hertz_at};
use super::defect::{DamagedGroove, GrooveDefect};
use super::groove::{Grooves, Thrust};
use super::ring::{InnerFrame, RingDisplacement};
use crate::bearing::error::{BearingError, positive, refused};
use crate::bearing::hertz::{ContactPatch, HertzStiffness};
use crate::bearing::life::{LoadRating, RatingLife};
use crate::bearing::{BearingGeometry, ContactStiffness, Race};
use nalgebra::{Matrix2, SMatrix, SVector, Vector2};
use std::f64::consts::TAU;

/// Loads, N and N m, or the like of five coordinates.
pub(crate) type Five = SVector<f64, 5>;

/// A stiffness over five coordinates.
pub(crate) type FiveByFive = SMatrix<f64, 5, 5>;

/// A ball bearing whose inner ring moves in space; rigid rings.
#[derive(Debug, Clone, PartialEq)]
pub struct SpatialBearing {
    geometry: BearingGeometry,
    moduli: [f64; 2],
    pub(super) law: BallLaw,
    thrust: Thrust,
    /// Nominal contact angle of the load rating, rad.
    nominal_angle: f64,
    defects: Vec<DamagedGroove>,
}

/// Where the cage stands and how fast the inner ring turns.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BearingCondition {
    /// Azimuth of ball 0, rad.
    pub cage_angle: f64,
    /// Speed of the inner ring, rad/s; the outer ring stands still. 0: no inertia of the balls.
    pub shaft_speed: f64,
}

/// A bearing at one displacement, its balls in equilibrium.
#[derive(Debug, Clone, PartialEq)]
pub struct BearingState {
    /// Load on the inner ring that the balls hold: forces along x, y, z (N), moments about x, y at the bearing's centre (N m).
    ///
    /// Moments belong to the tilts as coordinates: they are those about the axes but for the square of the tilt.
    pub load: [f64; 5],
    /// Derivatives of the load by x, y, z and the tilts: N/m, N/rad, N, N m/rad.
    pub stiffness: [[f64; 5]; 5],
    /// The balls, in order.
    pub balls: Vec<BallState>,
}

/// A ball in equilibrium. Pairs are of the inner and the outer race.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BallState {
    /// Azimuth, rad.
    pub azimuth: f64,
    /// Contact force, N.
    pub load: [f64; 2],
    /// Contact angle, rad, positive where the inner ring is pushed along +z; `None` without contact.
    pub contact_angle: [Option<f64>; 2],
    /// Penetration, m, zero without contact.
    pub penetration: [f64; 2],
    /// Patch and peak pressure.
    pub patch: [ContactPatch; 2],
    /// Orbital speed, rad/s: that of the ball alone, without the cage.
    pub orbital_speed: f64,
    /// Speed about its own axis against the cage, rad/s.
    pub spin_speed: f64,
    /// Angle of that axis to the bearing's axis, rad.
    pub pitch_angle: f64,
    /// Centrifugal force, N.
    pub centrifugal_force: f64,
    /// Gyroscopic moment, N m.
    pub gyroscopic_moment: f64,
}

/// What one ball adds.
struct BallShare {
    load: Five,
    stiffness: FiveByFive,
    place: Vector2<f64>,
    seen: Vector2<f64>,
}

impl SpatialBearing {
    /// A bearing with effective moduli E* (Pa) of the inner and the outer contact ([`crate::bearing::hertz::effective_modulus`]).
    ///
    /// # Errors
    /// [`BearingError`]: a modulus out of range; play that the thrust does not allow; Hertz constants that cannot be computed.
    pub fn new(
        geometry: BearingGeometry,
        moduli: [f64; 2],
        thrust: Thrust,
        race_control: RaceControl,
    ) -> Result<Self, BearingError> {
        let grooves = Grooves::new(&geometry, thrust)?;
        let contact = |race: Race, modulus: f64, seat: f64, side: f64| {
            positive(format_args!("effective modulus of the {race} race"), modulus)?;
            let stiffness = AngleStiffness::fit(|cosine| Ok(hertz_at(&geometry, race, cosine, modulus)?.stiffness))?;
            Ok(GrooveContact { stiffness, seat, side })
        };
        let law = BallLaw {
            grooves,
            inner: contact(Race::Inner, moduli[0], grooves.seats[0], -1.0)?,
            outer: contact(Race::Outer, moduli[1], grooves.seats[1], 1.0)?,
            mass: geometry.ball_mass(),
            diameter: 2.0 * geometry.ball_radius(),
            pitch_diameter: 2.0 * geometry.pitch_radius(),
            race_control,
        };
        Ok(Self { geometry, moduli, law, thrust, nominal_angle: 0.0, defects: Vec::new() })
    }

    /// The same bearing with Hertz constants that are given, the same at every angle. Patches stay those of the moduli.
    #[must_use]
    pub fn with_stiffness(mut self, stiffness: ContactStiffness) -> Self {
        self.law.inner.stiffness = AngleStiffness::constant(stiffness.inner());
        self.law.outer.stiffness = AngleStiffness::constant(stiffness.outer());
        self
    }

    /// The same bearing with defects in its grooves, which a transient feels; a rest is that on whole races.
    ///
    /// # Errors
    /// [`BearingError`]: a place or width out of range; defects that overlap.
    pub fn with_defects(mut self, defects: Vec<GrooveDefect>) -> Result<Self, BearingError> {
        for defect in defects {
            let modulus = self.moduli[usize::from(defect.profile.race() == Race::Outer)];
            let defect = DamagedGroove::new(&self.geometry, defect, modulus)?;
            if self.defects.iter().any(|other| other.overlaps(&defect)) {
                return Err(BearingError(format!(
                    "two defects of the {} race overlap: give one of both",
                    defect.race()
                )));
            }
            self.defects.push(defect);
        }
        Ok(self)
    }

    /// The same bearing with whole grooves.
    #[must_use]
    pub(crate) fn without_defects(self) -> Self {
        Self { defects: Vec::new(), ..self }
    }

    /// Its defects.
    pub(crate) fn defects(&self) -> &[DamagedGroove] {
        &self.defects
    }

    /// Its dimensions.
    pub(crate) fn law(&self) -> &BallLaw {
        &self.law
    }

    /// Number of balls.
    pub(crate) fn balls(&self) -> usize {
        self.geometry.balls() as usize
    }

    /// Its geometry.
    pub(crate) fn geometry(&self) -> &BearingGeometry {
        &self.geometry
    }

    /// Which way it may be pushed.
    pub(crate) fn thrust(&self) -> Thrust {
        self.thrust
    }

    /// Hertz's contact at a contact angle (rad); `None` for curvatures that make none.
    pub(crate) fn hertz_at(&self, race: Race, angle: f64) -> Option<HertzStiffness> {
        let modulus = self.moduli[usize::from(race == Race::Outer)];
        hertz_at(&self.geometry, race, angle.cos().max(0.0), modulus).ok()
    }

    /// The same with a nominal contact angle (rad), which the load rating takes; 0 without: play alone makes no angular contact bearing.
    #[must_use]
    pub(crate) fn with_nominal_angle(self, nominal_angle: f64) -> Self {
        Self { nominal_angle, ..self }
    }

    /// Load rating, and life under the loads of all balls at both races (N), with the largest contact pressure (Pa), at a speed of the
    /// shaft (rad/s).
    ///
    /// # Errors
    /// [`BearingError`]: what the standard does not hold for.
    pub(crate) fn rating_life(
        &self,
        loads: &[[f64; 2]],
        peak_pressure: f64,
        speed: f64,
    ) -> Result<RatingLife, BearingError> {
        let rating = LoadRating::new(&self.geometry, self.nominal_angle, self.moduli)?;
        Ok(rating.life(loads, peak_pressure, speed))
    }

    /// How far the inner groove's centres stand from the outer ones along the thrust, m, at an axial `displacement`; below zero the
    /// rings are pushed apart. Not limited for thrust both ways.
    pub(crate) fn engagement(&self, displacement: f64) -> f64 {
        match self.thrust {
            Thrust::Both => f64::INFINITY,
            thrust => thrust.sign() * (self.law.grooves.axial_gap + displacement),
        }
    }

    /// Load, stiffness and every ball at a displacement of the inner ring.
    ///
    /// # Errors
    /// [`BearingError`]: a displacement or condition that is not finite; a ball that finds no place.
    pub fn state(
        &self,
        displacement: &RingDisplacement,
        condition: BearingCondition,
    ) -> Result<BearingState, BearingError> {
        for value in displacement.vector().iter().chain([&condition.cage_angle, &condition.shaft_speed]) {
            if !value.is_finite() {
                return refused("displacement, cage angle or speed", *value, "must be finite");
            }
        }
        let mut balls = Vec::with_capacity(self.geometry.balls() as usize);
        let (load, stiffness) = self.sum(displacement, condition, |azimuth, share| {
            balls.push((azimuth, share.place, share.seen));
            Ok(())
        })?;
        let balls = balls.into_iter().map(|(azimuth, place, seen)| self.ball(azimuth, place, seen, condition));
        Ok(BearingState {
            load: load.into(),
            stiffness: std::array::from_fn(|row| std::array::from_fn(|column| stiffness[(row, column)])),
            balls: balls.collect::<Result<_, _>>()?,
        })
    }

    /// Load and stiffness alone.
    ///
    /// # Errors
    /// As [`Self::state`].
    pub(crate) fn load_and_stiffness(
        &self,
        displacement: &RingDisplacement,
        condition: BearingCondition,
    ) -> Result<(Five, FiveByFive), BearingError> {
        self.sum(displacement, condition, |_, _| Ok(()))
    }

    fn sum(
        &self,
        displacement: &RingDisplacement,
        condition: BearingCondition,
        mut each: impl FnMut(f64, &BallShare) -> Result<(), BearingError>,
    ) -> Result<(Five, FiveByFive), BearingError> {
        let frame = InnerFrame::new(displacement);
        let (mut load, mut stiffness) = (Five::zeros(), FiveByFive::zeros());
        let balls = self.geometry.balls();
        for ball in 0..balls {
            let azimuth = condition.cage_angle + TAU * f64::from(ball) / f64::from(balls);
            let share = self.share(&frame, azimuth, condition.shaft_speed)?;
            load += share.load;
            stiffness += share.stiffness;
            each(azimuth, &share)?;
        }
        Ok((load, stiffness))
    }

    /// What the ball at one azimuth adds: the balance over ring and ball, with the ball's two coordinates condensed.
    fn share(&self, frame: &InnerFrame, azimuth: f64, speed: f64) -> Result<BallShare, BearingError> {
        let (sin, cos) = azimuth.sin_cos();
        let plane = frame.plane([cos, sin], self.law.grooves.outer_centres);
        let place = self.law.place(&plane, speed).map_err(|BearingError(found)| {
            let [degrees, rpm] = [azimuth.to_degrees().rem_euclid(360.0), speed * 60.0 / TAU];
            BearingError(format!("at {rpm:.0} rpm the ball at {degrees:.1} degrees {found}"))
        })?;
        let seen = plane.seen(place).place;
        let forces = self.law.forces(place, seen, speed);
        if forces.inner.load <= 0.0 && forces.couple.abs() <= 0.0 {
            // nothing reaches the ring
            return Ok(BallShare { load: Five::zeros(), stiffness: FiveByFive::zeros(), place, seen });
        }
        let all = frame.seen_by_all(&plane, place);
        // u and y by the seven coordinates
        let mut slope = SMatrix::<f64, 4, 7>::zeros();
        slope[(0, 5)] = 1.0;
        slope[(1, 6)] = 1.0;
        slope.fixed_view_mut::<2, 7>(2, 0).copy_from(&all.slope);
        let mut load = -(slope.transpose() * forces.force);
        let mut stiffness = -(slope.transpose() * forces.tangent * slope)
            - forces.force[2] * all.bend[0]
            - forces.force[3] * all.bend[1];
        let couple_by = slope.transpose() * forces.couple_by;
        for axis in 0..2 {
            let spin = frame.spin(axis);
            let arm = all.around.dot(&spin);
            load[3 + axis] -= forces.couple * arm;
            for by in 0..7 {
                let turned = all.around.dot(&all.moved[by]) / all.radius;
                stiffness[(3 + axis, by)] -= couple_by[by] * arm - forces.couple * turned * all.outwards.dot(&spin);
            }
            for by in 0..2 {
                let change = all.around.dot(&frame.spin_by(axis, by));
                stiffness[(3 + axis, 3 + by)] -= forces.couple * change;
            }
        }
        let of_ball: Matrix2<f64> = stiffness.fixed_view::<2, 2>(5, 5).into();
        let through = stiffness.fixed_view::<2, 5>(5, 0).into_owned();
        let condensed = match of_ball.lu().solve(&through) {
            Some(following) => stiffness.fixed_view::<5, 5>(0, 0) - stiffness.fixed_view::<5, 2>(0, 5) * following,
            None => stiffness.fixed_view::<5, 5>(0, 0).into(),
        };
        Ok(BallShare { load: load.fixed_rows::<5>(0).into(), stiffness: condensed, place, seen })
    }

    fn ball(
        &self,
        azimuth: f64,
        place: Vector2<f64>,
        seen: Vector2<f64>,
        condition: BearingCondition,
    ) -> Result<BallState, BearingError> {
        let forces = self.law.forces(place, seen, condition.shaft_speed);
        let contacts = [forces.inner, forces.outer];
        let patch = |race: Race, index: usize| {
            let contact = &contacts[index];
            let hertz = hertz_at(
                &self.geometry,
                race,
                contact.force_angle().map_or(1.0, f64::cos).max(0.0),
                self.moduli[index],
            )?;
            Ok(hertz.patch(contact.load))
        };
        Ok(BallState {
            azimuth,
            load: contacts.map(|contact| contact.load),
            contact_angle: contacts.map(|contact| contact.force_angle()),
            penetration: contacts.map(|contact| contact.penetration.max(0.0)),
            patch: [patch(Race::Inner, 0)?, patch(Race::Outer, 1)?],
            orbital_speed: forces.speeds.orbit,
            spin_speed: forces.speeds.spin,
            pitch_angle: forces.speeds.pitch,
            centrifugal_force: forces.centrifugal,
            gyroscopic_moment: forces.gyroscopic,
        })
    }

    /// Axial displacement at which the bearing at rest carries a thrust of this size (N, zero or more) in its own direction, along
    /// +z for thrust both ways; m, with its sign.
    ///
    /// # Errors
    /// [`BearingError`] for a force that is negative or not finite, or that no displacement below the groove's radius carries.
    pub(crate) fn axial_displacement(&self, force: f64) -> Result<f64, BearingError> {
        if !(force.is_finite() && force >= 0.0) {
            return refused("axial force", force, "N must be finite and zero or more");
        }
        let sign = self.thrust.sign();
        let at = |size: f64| -> Result<[f64; 2], BearingError> {
            let displacement = RingDisplacement { translation: [0.0, 0.0, sign * size], tilt: [0.0; 2] };
            let (load, stiffness) = self.load_and_stiffness(&displacement, BearingCondition::default())?;
            Ok([sign * load[2] - force, stiffness[(2, 2)]])
        };
        // from where the balls touch, to where they are pressed in by half a groove's radius
        let grooves = &self.law.grooves;
        let axial = |distance: f64| (distance * distance - grooves.radial_gap.powi(2)).max(0.0).sqrt();
        let touch = axial(grooves.centre_distance) - grooves.axial_gap.abs();
        let (mut low, mut high) = (touch, axial(1.5 * grooves.centre_distance) - grooves.axial_gap.abs());
        if at(high)?[0] < 0.0 {
            return refused("axial force", force, "N presses the balls through the grooves: expected a smaller one");
        }
        if at(low)?[0] >= 0.0 {
            // without play a bearing is loaded at once, or nothing is asked for
            high = low;
            low = 0.0_f64.min(touch);
        }
        let mut size = 0.5 * (low + high);
        for _ in 0..200 {
            let [error, slope] = at(size)?;
            if error < 0.0 {
                low = size
            } else {
                high = size
            }
            let newton = size - error / slope;
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - size).abs() <= 1e-15 * grooves.centre_distance {
                return Ok(sign * next);
            }
            size = next;
        }
        Ok(sign * size)
    }
}
