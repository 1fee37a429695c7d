//! A measured profile on a race: depth over arc length as samples, and where a ball touches it.

use std::f64::consts::FRAC_PI_2;

use super::circles::Circles;
use super::contacts::{
    DefectContacts, Feature, PolarPosition, RaceProfile, finite_angle, offset_from, reduced, within,
};
use super::curve::Vector;
use super::spline::{Brackets, Piece, Profile};
use super::stiffness::{CurvatureStiffness, Fade};
use super::{samples_check, spline};
use crate::bearing::error::BearingError;
use crate::bearing::geometry::BearingGeometry;
use crate::bearing::materials::{ContactStiffness, Race};

/// Places in each piece at which slope and curvature are looked at.
const LOOKS: usize = 8;

/// Greatest slope of the profile against the race: a ball of the race's own size touches 45° at most.
const STEEPEST: f64 = 1.0;

/// Ball positions that are tried first.
const POSITIONS: usize = 200;

/// Longest way from point to point in ball radii: a ball between two sinks 5e-7 of its radius too deep.
const SPACING: f64 = 2e-3;

/// Steps of the golden section about the deepest of them.
const SECTIONS: usize = 40;

/// A measured profile in one race of one bearing, ready for contact queries.
///
/// The samples are joined by a cubic spline that runs into the race with continuous curvature. Where the
/// profile is finer than the ball can follow, the ball bridges: it touches what is less concave than itself.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredProfile {
    race: Race,
    middle: f64,
    half_angle: f64,
    profile: Profile,
    brackets: Brackets,
    fade: Fade,
    stiffness: CurvatureStiffness,
}

impl MeasuredProfile {
    /// Profile through `samples` of arc length along the undeformed race and depth into its material (m;
    /// negative: raised), in a race of `bearing`. Half way between the first and the last sample lies at `angle`
    /// (rad, as [`super::DentShape::angle`]); arc length grows counter-clockwise.
    ///
    /// `stiffness` is that of the healthy races; on the profile it changes in the ratio of Hertz theory.
    ///
    /// # Errors
    /// [`BearingError`]: fewer than 4 samples; a sample (named by its number) that is not finite, not behind the
    /// one before, deeper than a quarter of the length, or not zero at the ends; a length above a quarter of the
    /// race; a slope above 1.
    pub fn new(
        bearing: &BearingGeometry,
        race: Race,
        angle: f64,
        samples: &[(f64, f64)],
        stiffness: ContactStiffness,
    ) -> Result<Self, BearingError> {
        finite_angle(angle)?;
        let circles = Circles::race(bearing, race, stiffness);
        let [first, last] = samples_check::span(samples, FRAC_PI_2 * circles.carrier)?;
        let start = 0.5 * (first + last);
        let knots: Vec<(f64, f64)> = samples.iter().map(|&(s, depth)| ((s - start) / circles.carrier, depth)).collect();
        let profile = Profile { circles, pieces: spline::through(&knots) };
        let sharpest = sharpest(&profile)?;
        let half_angle = 0.5 * (last - first) / circles.carrier;
        let most = circles.relative + (sharpest + circles.carrier_concavity()).max(0.0);
        Ok(Self {
            race,
            middle: reduced(angle),
            half_angle,
            brackets: Brackets::new(&profile, half_angle),
            fade: spline::fade(&circles),
            stiffness: CurvatureStiffness::new(&circles, most)?,
            profile,
        })
    }
}

impl RaceProfile for MeasuredProfile {
    fn race(&self) -> Race {
        self.race
    }

    /// Within ±π.
    fn angle(&self) -> f64 {
        self.middle
    }

    /// From the first to the last sample.
    fn half_angle(&self) -> f64 {
        self.half_angle
    }

    /// More than [`Self::half_angle`] where the profile leans outwards.
    fn contact_half_angle(&self) -> f64 {
        self.brackets.half_angle
    }

    fn profile_radius(&self, angle: f64) -> f64 {
        let offset = self.offset(angle);
        let Circles { carrier, side, .. } = self.profile.circles;
        let pieces = &self.profile.pieces;
        let next = pieces.partition_point(|piece| piece.ends[1] < offset);
        match pieces.get(next) {
            Some(piece) if piece.ends[0] <= offset => carrier + side * piece.at(offset)[0],
            _ => carrier,
        }
    }

    /// Searched anew on every call, in milliseconds.
    fn ball_drop(&self) -> f64 {
        deepest(&self.profile, self.half_angle)
    }

    fn rise(&self) -> f64 {
        let risen = |piece: &Piece| {
            let heights = (0..=LOOKS).map(|i| -piece.at(between(piece.ends, i))[0]);
            heights.fold(0.0, f64::max)
        };
        let seen = self.profile.pieces.iter().map(risen).fold(0.0, f64::max);
        // a cubic between two looks exceeds both by less
        1.01 * seen
    }

    #[inline]
    fn offset(&self, angle: f64) -> f64 {
        offset_from(angle, self.middle)
    }

    /// Of more than [`super::MOST_CONTACTS`] those with the largest overlaps. Beside the profile the contact with the race (gap included)
    /// is among them. About a microsecond over the profile.
    #[inline]
    fn contacts_into(&self, ball: PolarPosition, found: &mut DefectContacts) {
        let offset = self.offset(ball.angle);
        let circles = &self.profile.circles;
        found.clear();
        if !within(offset, self.brackets.half_angle) || ball.radius.is_nan() {
            found.push(circles.plain(ball.radius));
            return;
        }
        if offset < -self.half_angle {
            found.push(circles.plain(ball.radius));
        }
        let (direction, centre) = circles.centre(ball.radius, offset);
        self.brackets.feet(&self.profile, centre, offset, |foot| {
            let inward = foot.inward(circles.side);
            let delta = circles.roller - foot.point.minus(centre).dot(inward);
            if delta > 0.0 {
                let concavity = foot.concavity(circles.side);
                let relative = circles.relative - (concavity - circles.carrier_concavity());
                let stiffness = self.fade.weight(concavity) * self.stiffness.at(relative);
                found.push(circles.contact(Feature::Measured, delta, inward, direction, stiffness));
            }
        });
        if offset >= self.half_angle {
            found.push(circles.plain(ball.radius));
        }
    }
}

/// Look `i` of [`LOOKS`] + 1 over a piece.
fn between([start, end]: [f64; 2], i: usize) -> f64 {
    start + (end - start) * (i as f64 / LOOKS as f64)
}

/// Greatest convex curvature of the profile, 1/m.
///
/// # Errors
/// [`BearingError`] names the samples between which the profile is steepest.
fn sharpest(profile: &Profile) -> Result<f64, BearingError> {
    let (mut sharpest, mut steepest, mut sample) = (f64::NEG_INFINITY, 0.0, 0);
    for piece in &profile.pieces {
        for i in 0..=LOOKS {
            let angle = between(piece.ends, i);
            let slope = piece.at(angle)[1].abs() / profile.circles.carrier;
            // a slope that overflowed counts as the steepest
            if slope > steepest || slope.is_nan() {
                (steepest, sample) = (slope, piece.sample);
            }
            let concavity = profile.at(piece, angle).concavity(profile.circles.side);
            sharpest = sharpest.max(-concavity);
        }
    }
    if steepest <= STEEPEST {
        Ok(sharpest)
    } else {
        let (sample, next) = (sample + 1, sample + 2);
        Err(BearingError(format!(
            "defect profile is as steep as {steepest:.2} between samples {sample} and {next}, at most {STEEPEST} is \
             possible: a measurement so steep is noise or a step; smooth it"
        )))
    }
}

/// For the report, not for the hot loop: greatest displacement (m) of a ball beyond its place on the race that some angle within `half_angle` (rad) of
/// the middle allows: everywhere the nearest part of the profile holds it. Zero or more.
fn deepest(profile: &Profile, half_angle: f64) -> f64 {
    let circles = &profile.circles;
    let longest = SPACING * circles.roller / circles.carrier;
    let mut points = Vec::new();
    for piece in &profile.pieces {
        let [start, end] = piece.ends;
        let parts = ((end - start) / longest).ceil().max(2.0);
        let place = |i: usize| start + (end - start) * (i as f64 / parts);
        points.extend((0..parts as usize).map(|i| profile.at(piece, place(i)).point));
    }
    let held = |offset: f64| {
        let e = Vector::radial(offset);
        let plain = circles.side * circles.carrier - circles.roller;
        points.iter().fold(f64::INFINITY, |least, point| {
            let across = point.dot(e.tangent());
            let rest = circles.roller * circles.roller - across * across;
            if rest > 0.0 { least.min(circles.side * point.dot(e) - rest.sqrt() - plain) } else { least }
        })
    };
    let step = 2.0 * half_angle / POSITIONS as f64;
    let place = |i: usize| -half_angle + step * i as f64;
    let best = (0..=POSITIONS).max_by(|&a, &b| held(place(a)).total_cmp(&held(place(b))));
    let middle = place(best.unwrap_or(0));
    let ratio = 0.5 * (5f64.sqrt() - 1.0);
    let (mut low, mut high) = (middle - step, middle + step);
    for _ in 0..SECTIONS {
        let inner = [high - ratio * (high - low), low + ratio * (high - low)];
        if held(inner[0]) > held(inner[1]) {
            high = inner[1];
        } else {
            low = inner[0];
        }
    }
    held(0.5 * (low + high)).max(held(middle)).max(0.0)
}
