//! Where the outline is nearest to a ball.
//!
//! A function is monotone between the zeros of its derivative. So the zeros of F''' part −1..1 into stretches with at
//! most one zero of F'' each, those into stretches with at most one zero of F' each, and a minimum is a zero of F' with
//! F'' > 0. F''' itself is looked at on a grid; it changes sign once or twice. On the usual dent, longer than wide, F is
//! convex, which a bound shows at once.
//!
//! The floor in the plane z = 0, where a ball touches it if it touches it at all.
//!
//! Across the rolling direction the floor at t (`s = a sin t`) is more concave than the groove by `β = b / (c² cos t)`.
//! Where that reaches κ_t the ball cannot touch it: it rests on the edges, for which half of that is enough. So the
//! contact fades by β as it does by the curvature in the rolling direction, and where the floor runs under the rim.

use super::super::circles::Circles;
use super::super::contacts::{DefectContact, Feature};
use super::super::curve::{Ellipse, Vector, bisect};
use super::super::floor::Reach;
use super::super::rim::smoothstep;
use super::super::stiffness::{CurvatureStiffness, FLOOR_FADE, Fade};
use super::outline::{Outline, Over};

/// Most places of a list: two ends, and what a grid of [`GRID`] intervals leaves room for.
const MOST_PLACES: usize = 2 * GRID + 2;

/// Most minima: every second of the places between two zeros of F''' on the grid.
const MOST_MINIMA: usize = GRID + 1;

/// Intervals in which a sign of F''' is looked for.
const GRID: usize = 8;

/// Steps in all of a search for a zero: halving alone reaches rounding in 55.
const MOST_STEPS: usize = 80;

/// Newton steps after which the bracket is halved instead.
const NEWTON_STEPS: usize = 12;

/// Last step at which Newton ends: its next error is the square.
const STEP_TOLERANCE: f64 = 1e-7;

/// Bracket at which the search for a zero of F''' ends: F'' is flat there, so that it is found to the square.
const FLAT_TOLERANCE: f64 = 1e-6;

/// Places v in ascending order, without allocation.
#[derive(Debug, Clone, Copy)]
pub(super) struct Places {
    items: [f64; MOST_PLACES],
    count: usize,
}

impl Places {
    fn none() -> Self {
        Self { items: [0.0; MOST_PLACES], count: 0 }
    }

    fn push(&mut self, place: f64) {
        if let Some(item) = self.items.get_mut(self.count) {
            *item = place;
            self.count += 1;
        }
    }

    #[inline]
    pub(super) fn as_slice(&self) -> &[f64] {
        self.items.get(..self.count).unwrap_or(&self.items)
    }
}

/// A minimum within −1..1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Minimum {
    pub v: f64,
    /// F, m².
    pub square: f64,
    /// F'', m².
    pub bend: f64,
}

/// Minima of F within −1..1, ends excluded, for a ball at a place, in ascending order; `ends` are F and its derivatives
/// at −1 and 1.
#[inline]
pub(super) fn inner_minima(over: &Over<'_>, ends: [[f64; 4]; 2]) -> impl Iterator<Item = Minimum> + Clone {
    let places = inner_places(over, ends);
    let mut minima = [None; MOST_MINIMA];
    for (minimum, &v) in minima.iter_mut().zip(places.as_slice()) {
        let [square, _, bend, _] = over.squares(v);
        *minimum = Some(Minimum { v, square, bend });
    }
    minima.into_iter().flatten()
}

#[inline]
fn inner_places(over: &Over<'_>, ends: [[f64; 4]; 2]) -> Places {
    let mut minima = Places::none();
    let slope = |v: f64| {
        let [_, first, second, _] = over.squares(v);
        [first, second]
    };
    if over.least_bend() > 0.0 {
        let [low, high] = [ends[0][1], ends[1][1]];
        if low < 0.0 && high > 0.0 {
            minima.push(zero([-1.0, 1.0], [low, high], slope));
        }
        return minima;
    }
    let stretches = stretches(&curvature_breaks(over), |v| {
        let [_, _, second, third] = over.squares(v);
        [second, third]
    });
    for pair in stretches.as_slice().windows(2) {
        let ends = [pair[0], pair[1]];
        let [low, high] = ends.map(|v| slope(v)[0]);
        if low < 0.0 && high > 0.0 {
            minima.push(zero(ends, [low, high], slope));
        }
    }
    minima
}

/// Ends and zeros of F'''.
#[cold]
fn curvature_breaks(over: &Over<'_>) -> Places {
    let mut breaks = Places::none();
    breaks.push(-1.0);
    let third = |v: f64| over.squares(v)[3];
    let place = |i: usize| -1.0 + 2.0 * i as f64 / GRID as f64;
    let mut low = third(-1.0);
    for i in 0..GRID {
        let high = third(place(i + 1));
        if (low < 0.0) != (high < 0.0) {
            let (mut from, mut to) = (place(i), place(i + 1));
            while to - from > FLAT_TOLERANCE {
                let middle = 0.5 * (from + to);
                if (third(middle) < 0.0) == (low < 0.0) {
                    from = middle;
                } else {
                    to = middle;
                }
            }
            breaks.push(0.5 * (from + to));
        }
        low = high;
    }
    breaks.push(1.0);
    breaks
}

/// Both ends, and between them the zeros of a function (given with its derivative) that is monotone between neighbouring
/// places.
fn stretches(places: &Places, function: impl Fn(f64) -> [f64; 2]) -> Places {
    let mut found = Places::none();
    found.push(-1.0);
    for pair in places.as_slice().windows(2) {
        let ends = [pair[0], pair[1]];
        let values = ends.map(|v| function(v)[0]);
        if (values[0] < 0.0) != (values[1] < 0.0) {
            found.push(zero(ends, values, &function));
        }
    }
    found.push(1.0);
    found
}

/// The zero between two ends with values of different sign: Newton kept inside the shrinking bracket.
#[inline]
fn zero(ends: [f64; 2], values: [f64; 2], function: impl Fn(f64) -> [f64; 2]) -> f64 {
    let [mut low, mut high] = ends;
    let rising = values[0] < 0.0;
    let mut v = low + (high - low) * (values[0] / (values[0] - values[1])).clamp(0.0, 1.0);
    for step in 0..MOST_STEPS {
        let [value, slope] = function(v);
        if (value < 0.0) == rising {
            low = v;
        } else {
            high = v;
        }
        let newton = v - value / slope;
        let inside = newton > low && newton < high && step < NEWTON_STEPS;
        let next = if inside { newton } else { 0.5 * (low + high) };
        let moved = (next - v).abs();
        v = next;
        if moved <= STEP_TOLERANCE && inside || high - low <= f64::EPSILON {
            break;
        }
    }
    v
}

/// Distance (m) to the tube's centre curve from a point at `distance` (m) from the axis and `offset` (rad) from the
/// middle, in the plane.
pub(super) fn to_tube(outline: &Outline, distance: f64, offset: f64) -> f64 {
    let over = Over::new(outline, distance, offset);
    let ends = [-1.0, 1.0].map(|v| over.squares(v));
    let least = inner_minima(&over, ends).map(|minimum| minimum.square).fold(ends[0][0].min(ends[1][0]), f64::min);
    (over.least() * over.least() + 2.0 * least).max(0.0).sqrt()
}

/// The floor's section in the plane, as far as a ball can touch it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Bottom {
    pub(super) ellipse: Ellipse,
    circles: Circles,
    fade: Fade,
    /// b/c², 1/m.
    spread: f64,
    /// Relative curvature from which the ellipse's is taken for the stiffness, 1/m, and what it lacks of the race's.
    pub(super) base: f64,
    shortfall: f64,
    /// Where the floor meets the rim, rad.
    corner: f64,
    /// Where a ball can touch it, if anywhere.
    pub(super) reach: Option<Reach>,
}

impl Bottom {
    /// The floor of `outline`; `base` (1/m) as [`super::super::depression::Depression::new`] takes it.
    pub(super) fn new(outline: &Outline, base: f64) -> Self {
        let circles = outline.circles;
        let ellipse = Ellipse {
            carrier: circles.carrier,
            side: circles.side,
            half_length: outline.half_length,
            depth: outline.depth,
        };
        let clear = |t: f64| {
            let point = ellipse.at(t).point;
            to_tube(outline, point.length(), point.along.atan2(point.outward)) > outline.rim
        };
        let corner = if clear(0.0) { bisect(0.0, Ellipse::WALL, clear) } else { 0.0 };
        let mut floor = Self {
            ellipse,
            circles,
            fade: Fade::new(&circles, 0.0),
            spread: outline.depth / (outline.half_width * outline.half_width),
            base,
            shortfall: (circles.relative - base).max(0.0),
            corner,
            reach: None,
        };
        let touchable = |t: f64| {
            t < corner
                && ellipse.at(t).concavity(circles.side) < circles.roller_curvature()
                && floor.across_left(t) > 0.0
        };
        if touchable(0.0) {
            let limit = bisect(0.0, corner, touchable);
            floor.reach = Some(Reach::new(limit, ellipse.at(limit), false));
        }
        floor
    }

    /// Relative curvature across the rolling direction, 1/m.
    #[inline]
    fn across_left(&self, t: f64) -> f64 {
        self.circles.across - self.spread / t.cos()
    }

    /// Contact of a ball at `centre`, in `direction` from the race's centre.
    #[inline]
    pub(super) fn contact(
        &self,
        centre: Vector,
        direction: Vector,
        stiffness: &CurvatureStiffness,
    ) -> Option<DefectContact> {
        let reach = self.reach.as_ref()?;
        if !(reach.holds(centre, 1.0) && reach.holds(centre.mirrored(), 1.0)) {
            return None;
        }
        let circles = &self.circles;
        let (t, foot) = self.ellipse.foot(centre, reach.parameter);
        let inward = foot.inward(circles.side);
        let delta = circles.roller - foot.point.minus(centre).dot(inward);
        let left = self.across_left(t);
        let fading = 1.0 - FLOOR_FADE;
        let weight = self.fade.weight(foot.concavity(circles.side) + self.shortfall)
            * smoothstep(left / (fading * circles.across))
            * smoothstep((t.cos() / self.corner.cos() - 1.0) / fading);
        let k = stiffness.of_pair([self.base - self.ellipse.curvature(t), left]);
        Some(circles.contact(Feature::Floor, delta, inward, direction, weight * k))
    }
}
