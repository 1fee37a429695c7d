//! A dent in three dimensions, ready for contact queries.

use super::super::circles::Circles;
use super::super::contacts::{DefectContacts, PolarPosition, RaceProfile, offset_from, reduced, within};
use super::super::curve::bisect;
use super::super::dent::{DEPTH_LIMIT, DentShape};
use super::super::stiffness::CurvatureStiffness;
use super::super::{depression, rim, stiffness};
use super::minima::{Bottom, to_tube};
use super::outline;
use super::outline::Outline;
use crate::bearing::error::{BearingError, positive, refused};
use crate::bearing::geometry::BearingGeometry;
use crate::bearing::materials::{ContactStiffness, Race};
use std::f64::consts::FRAC_PI_2;

/// Places of half an outline at which the steepest contact with its rim is looked for.
const LOOKS: u32 = 32;

/// A dent in one race of one bearing that is as wide as it is: the ball bridges it where the groove lets it.
///
/// [`DentShape::width`] is felt, and the depth is that of the ellipsoid `b sqrt(1 − (s/a)² − (z/c)²)`. Unlike the rim
/// of [`super::super::Dent`], which opens its dent a little, this one fills the edge: the outline stays what was given.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceDent {
    shape: DentShape,
    race: Race,
    /// Angle of the middle within ±π, rad.
    middle: f64,
    pub(in super::super) outline: Outline,
    pub(super) bottom: Bottom,
    pub(super) stiffness: CurvatureStiffness,
    /// Half the arc within which the ball can press on rim or floor, rad.
    pub(super) contact_angle: f64,
}

impl SurfaceDent {
    /// Solves the dent of `shape` in a race of `bearing`; `stiffness` is that of the healthy races, computed or given:
    /// on the dent it changes in the ratio of Hertz theory.
    ///
    /// # Errors
    /// [`BearingError`]: no width; values that are not positive; a dent too deep for its length or width, as wide as the
    /// ball, or too long for the race; a rim radius out of range; with
    /// [`CurvatureReading::Paper`](super::super::CurvatureReading::Paper) on the inner race a floor that the ball touches
    /// although the ellipse alone is as tight as the ball.
    pub fn new(
        bearing: &BearingGeometry,
        race: Race,
        shape: DentShape,
        stiffness: ContactStiffness,
    ) -> Result<Self, BearingError> {
        shape.check()?;
        let circles = Circles::race(bearing, race, stiffness);
        let width = width(&shape, circles.roller)?;
        let dimensions = bearing.dimensions();
        let outline = Outline {
            circles,
            half_length: 0.5 * shape.length,
            half_width: 0.5 * width,
            depth: shape.depth,
            rim: shape.rim_radius,
            groove: match race {
                Race::Inner => dimensions.inner_groove_radius,
                Race::Outer => dimensions.outer_groove_radius,
            },
        };
        let limit = FRAC_PI_2 * circles.carrier;
        if shape.length > limit {
            return Err(depression::too_long(shape.length, shape.length, limit));
        }
        depression::rim_rules(&circles, shape.rim_radius)?;
        let base = shape.curvature.base(&circles);
        let bottom = Bottom::new(&outline, base);
        if base < circles.relative && bottom.reach.is_some() {
            stiffness::per_modulus(circles.across, bottom.base - bottom.ellipse.curvature(0.0))?;
        }
        let sharpest = circles.roller_curvature() + 1.0 / shape.rim_radius;
        Ok(Self {
            shape,
            race,
            middle: reduced(shape.angle),
            stiffness: CurvatureStiffness::for_pairs(&circles, sharpest)?,
            contact_angle: contact_angle(&outline),
            bottom,
            outline,
        })
    }

    /// What was asked for.
    pub fn shape(&self) -> &DentShape {
        &self.shape
    }
}

impl RaceProfile for SurfaceDent {
    fn race(&self) -> Race {
        self.race
    }

    fn angle(&self) -> f64 {
        self.shape.angle
    }

    /// Of the outline in the plane.
    fn half_angle(&self) -> f64 {
        self.outline.angle()
    }

    fn contact_half_angle(&self) -> f64 {
        self.contact_angle
    }

    fn profile_radius(&self, angle: f64) -> f64 {
        let (outline, offset) = (&self.outline, self.offset(angle));
        let Circles { carrier, side, .. } = outline.circles;
        if !within(offset, outline.angle()) {
            return carrier;
        }
        let depth = side * (self.bottom.ellipse.polar_radius(offset) - carrier);
        let clear = |depth: f64| to_tube(outline, carrier + side * depth, offset) > outline.rim;
        if clear(depth) { carrier + side * depth } else { carrier + side * bisect(0.0, depth, clear) }
    }

    fn ball_drop(&self) -> f64 {
        let Outline { circles, depth, .. } = self.outline;
        let held = |drop: f64| {
            let distance = circles.carrier - circles.side * (circles.roller - drop);
            let mut found = DefectContacts::none();
            self.contacts_at(distance, 0.0, &mut found);
            found.as_slice().iter().any(|contact| contact.delta >= 0.0)
        };
        bisect(0.0, depth, |drop| !held(drop))
    }

    #[inline]
    fn offset(&self, angle: f64) -> f64 {
        offset_from(angle, self.middle)
    }

    /// The rim before, pairs on the side edges, the floor, the rim after; beside the outline the race in the place of the nearer rim. A
    /// pair is one contact, [`Feature::SideEdges`](super::super::Feature::SideEdges). Of a ball that does not reach the race, the gap to
    /// the race. A few tenths of a microsecond over the dent, more where the outline is about as curved as the ball.
    #[inline]
    fn contacts_into(&self, ball: PolarPosition, found: &mut DefectContacts) {
        let offset = self.offset(ball.angle);
        self.contacts_at(ball.radius, offset, found);
    }
}

/// The width (m) that the dent must have.
fn width(shape: &DentShape, ball_radius: f64) -> Result<f64, BearingError> {
    let Some(width) = shape.width else {
        let message = "defect profile = \"surface\" needs width, the dent's extent across the race: give it, or use \
                       profile = \"in-plane\"";
        return Err(BearingError(message.to_owned()));
    };
    positive("defect width", width)?;
    // grooves are wider than the ball
    if width >= 2.0 * ball_radius {
        return refused("defect width", width, "must be less than the ball's diameter");
    }
    let depth = shape.depth;
    if depth > DEPTH_LIMIT * width {
        return Err(BearingError(format!(
            "defect depth {depth} m is more than a quarter of its width {width} m: take a shallower or a wider dent, or \
             profile = \"in-plane\""
        )));
    }
    Ok(width)
}

/// Angle from the middle within which the ball can press on rim or floor, rad: as [`rim::farthest_centre`] has it for
/// the far vertex and the steepest contact anywhere.
fn contact_angle(outline: &Outline) -> f64 {
    let steepest = |v: f64| bisect(0.0, 1.0, |sine| outline::ratio(outline, v, sine) < 1.0);
    let sine = (0..=LOOKS).map(|i| steepest(f64::from(i) / f64::from(LOOKS))).fold(0.0, f64::max);
    let angle = outline.angle();
    (rim::farthest_centre(&outline.circles, outline.rim, sine) - angle).max(angle)
}
