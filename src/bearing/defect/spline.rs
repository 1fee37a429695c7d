//! Cubic spline through the samples of a profile, with continuous curvature onto the race at both ends.
//!
//! Between samples D is a cubic polynomial; value, slope and second derivative are continuous. At the first and
//! the last sample all three are zero, as on the race. Two conditions more at each end than a cubic spline has
//! room for are made room for by one knot in the middle of the first and of the last interval, where nothing is
//! prescribed: with x from the end, `D = c x³` up to `h/2` and `c x³ + e (x − h/2)³` beyond, so that at the
//! next sample
//!
//! ```text
//! D'' = (6/h) D' − (12/h²) D
//! ```
//!
//! closes the tridiagonal system for D'' at the samples in between (diagonally dominant: always solvable).
//!
//! Where on a measured profile a ball can touch: stretches with one foot each, found by the ball's angle.
//!
//! On a stretch of the profile less concave than the ball, the centre of a ball that touches it moves on with
//! the point of contact. So a ball has at most one foot on it, and has it if and only if `(P − C)·P'` changes
//! sign between its ends. The stretches are cut short enough ([`STRETCH`]) for this to hold for a ball pressed
//! in as well, and are kept in order of angle; a grid over the ball's angle says which come into question.

use super::circles::Circles;
use super::curve;
use super::curve::{CurvePoint, Vector};
use super::stiffness::Fade;

/// A cubic polynomial on one interval of the angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Piece {
    /// Start and end of the interval, rad.
    pub ends: [f64; 2],
    /// Coefficients of rising powers of the angle from the start, m/rad^n.
    coefficients: [f64; 4],
    /// Number of the sample before the piece, from 0.
    pub sample: usize,
}

impl Piece {
    /// D and its first two derivatives with respect to the angle.
    #[inline]
    pub(super) fn at(&self, angle: f64) -> [f64; 3] {
        let x = angle - self.ends[0];
        let [c0, c1, c2, c3] = self.coefficients;
        [c0 + x * (c1 + x * (c2 + x * c3)), c1 + x * (2.0 * c2 + x * (3.0 * c3)), 2.0 * c2 + x * (6.0 * c3)]
    }
}

/// Fewest knots that a spline with these ends needs.
pub(super) const LEAST_KNOTS: usize = 4;

/// The spline through `knots`, [`LEAST_KNOTS`] at least (angle strictly ascending, depth; zero depth at both ends).
pub(super) fn through(knots: &[(f64, f64)]) -> Vec<Piece> {
    let last = knots.len() - 1;
    let width = |i: usize| knots[i + 1].0 - knots[i].0;
    let depth = |i: usize| knots[i].1;
    let slope = |i: usize| (depth(i + 1) - depth(i)) / width(i);
    let bend = second_derivatives(knots);
    let mut pieces = Vec::with_capacity(last + 2);
    let (h, y) = (width(0), depth(1));
    let end = EndPair::new(h, y, bend[1]);
    let middle = knots[0].0 + 0.5 * h;
    pieces.push(Piece { ends: [knots[0].0, middle], coefficients: [0.0, 0.0, 0.0, end.c], sample: 0 });
    pieces.push(Piece { ends: [middle, knots[1].0], coefficients: end.past_half(1.0, end.c + end.e), sample: 0 });
    for i in 1..last - 1 {
        let h = width(i);
        pieces.push(Piece {
            ends: [knots[i].0, knots[i + 1].0],
            coefficients: [
                depth(i),
                slope(i) - h * (2.0 * bend[i] + bend[i + 1]) / 6.0,
                0.5 * bend[i],
                (bend[i + 1] - bend[i]) / (6.0 * h),
            ],
            sample: i,
        });
    }
    let (h, y) = (width(last - 1), depth(last - 1));
    let end = EndPair::new(h, y, bend[last - 1]);
    let middle = knots[last].0 - 0.5 * h;
    pieces.push(Piece {
        ends: [knots[last - 1].0, middle],
        coefficients: [y, -3.0 * h * h * (end.c + 0.25 * end.e), 0.5 * bend[last - 1], -(end.c + end.e)],
        sample: last - 1,
    });
    pieces.push(Piece { ends: [middle, knots[last].0], coefficients: end.past_half(-1.0, -end.c), sample: last - 1 });
    pieces
}

/// The two cubics of an end interval of width h, counted from the end.
struct EndPair {
    h: f64,
    c: f64,
    e: f64,
}

impl EndPair {
    /// From depth and second derivative at the sample next to the end.
    fn new(h: f64, depth: f64, bend: f64) -> Self {
        let e = (bend - 6.0 * depth / (h * h)) * 4.0 / (9.0 * h);
        Self { h, c: depth / (h * h * h) - 0.125 * e, e }
    }

    /// Coefficients from the middle knot on, `way` +1 away from the start of the profile, −1 towards its end.
    fn past_half(&self, way: f64, third: f64) -> [f64; 4] {
        let x = 0.5 * self.h;
        let slope = 3.0 * self.c * x * x;
        [self.c * x * x * x, way * slope, 3.0 * self.c * x, third]
    }
}

/// D'' at the samples, zero at both ends: Thomas's algorithm.
fn second_derivatives(knots: &[(f64, f64)]) -> Vec<f64> {
    let last = knots.len() - 1;
    let width = |i: usize| knots[i + 1].0 - knots[i].0;
    let slope = |i: usize| (knots[i + 1].1 - knots[i].1) / width(i);
    // rows (below, diagonal, above, right-hand side) of samples 1 to last − 1
    let row = |i: usize| -> [f64; 4] {
        let (h, after) = (width(i - 1), width(i));
        if i == 1 {
            let right = 6.0 * slope(1) - 12.0 * knots[1].1 / h;
            [0.0, h + 2.0 * after, after, right]
        } else if i == last - 1 {
            let right = -6.0 * slope(i - 1) - 12.0 * knots[i].1 / after;
            [h, after + 2.0 * h, 0.0, right]
        } else {
            [h, 2.0 * (h + after), after, 6.0 * (slope(i) - slope(i - 1))]
        }
    };
    let mut bend = vec![0.0; last + 1];
    let mut above = vec![0.0; last + 1];
    for i in 1..last {
        let [below, diagonal, over, right] = row(i);
        let pivot = diagonal - below * above[i - 1];
        above[i] = over / pivot;
        bend[i] = (right - below * bend[i - 1]) / pivot;
    }
    for i in (1..last).rev() {
        bend[i] -= above[i] * bend[i + 1];
    }
    bend
}

/// A profile's curve: polynomials of the angle over a circle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Profile {
    pub circles: Circles,
    pub pieces: Vec<Piece>,
}

impl Profile {
    /// Point of `piece` at `angle` (rad) from the middle; the parameter is the angle.
    #[inline]
    pub(super) fn at(&self, piece: &Piece, angle: f64) -> CurvePoint {
        let [depth, slope, bend] = piece.at(angle);
        let Circles { carrier, side, .. } = self.circles;
        CurvePoint::polar(Vector::radial(angle), [carrier + side * depth, side * slope, side * bend], [1.0, 0.0])
    }
}

/// Longest stretch in ball radii: over it the distance to a ball changes by a few thousandths of the radius at
/// most, [`EARLY`].
const STRETCH: f64 = 0.02;

/// Contacts are gone at this fraction of the ball's curvature below it.
const EARLY: f64 = 2e-3;

/// Relative rounding of a squared distance, a hundred times over.
const ROUNDING: f64 = 1e-14;

/// Parts of a piece in which a change from touchable to not is looked for: curvature is nearly linear on a piece.
const PARTS: usize = 4;

/// An end of a stretch, or of two; both share it to the bit, so that a foot on it is found once.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    point: Vector,
    first: Vector,
    angle: f64,
    /// The piece on which a stretch begins here; none where the ball cannot touch what follows.
    piece: Option<usize>,
}

/// All stretches that a ball can touch: each from a node with a piece to the next one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Brackets {
    nodes: Vec<Node>,
    /// Half the arc of the profile itself, rad; its ends are the first and the last node.
    profile_angle: f64,
    /// Half the arc of ball angles in which any of them is pressed, rad.
    pub half_angle: f64,
    cells_per_radian: f64,
    /// First node and the one behind the last that come into question, cell by cell.
    cells: Vec<[usize; 2]>,
}

/// Where a contact begins to count: [`EARLY`] before the ball's curvature.
pub(super) fn fade(circles: &Circles) -> Fade {
    Fade::new(circles, EARLY * circles.roller_curvature())
}

impl Brackets {
    /// Finds the stretches of `profile`, whose ends lie `profile_angle` (rad) from its middle.
    pub(super) fn new(profile: &Profile, profile_angle: f64) -> Self {
        let mut nodes = Vec::new();
        for (number, piece) in profile.pieces.iter().enumerate() {
            for stretch in touchable(profile, piece) {
                cut(profile, number, stretch, &mut nodes);
            }
        }
        let windows: Vec<Option<[f64; 2]>> =
            nodes.windows(2).map(|pair| pair[0].piece.map(|_| window(&profile.circles, pair))).collect();
        let half_angle = windows.iter().flatten().flatten().fold(profile_angle, |most, angle| most.max(angle.abs()));
        let count = (2 * nodes.len()).clamp(16, 4096);
        let mut found = Self {
            nodes,
            profile_angle,
            half_angle,
            cells_per_radian: count as f64 / (2.0 * half_angle),
            cells: vec![[usize::MAX, 0]; count],
        };
        for (low, window) in windows.into_iter().enumerate() {
            let Some(window) = window else { continue };
            // a cell more on both sides covers rounding
            let [from, to] = window.map(|angle| found.cell(angle));
            for cell in &mut found.cells[from.saturating_sub(1)..(to + 2).min(count)] {
                *cell = [cell[0].min(low), cell[1].max(low + 2)];
            }
        }
        found
    }

    #[inline]
    fn cell(&self, offset: f64) -> usize {
        let place = (offset + self.half_angle) * self.cells_per_radian;
        (place as usize).min(self.cells.len() - 1)
    }

    /// Calls `touched` for every foot of `centre`, which lies at `offset` (rad) within the half angle, in order;
    /// feet that are seen to be out of the ball's reach are left out.
    #[inline]
    pub(super) fn feet(&self, profile: &Profile, centre: Vector, offset: f64, mut touched: impl FnMut(CurvePoint)) {
        let [first, past] = self.cells[self.cell(offset)];
        let Some(nodes) = self.nodes.get(first..past) else {
            return;
        };
        let reach = 0.5 * profile.circles.roller * profile.circles.roller * (1.0 + ROUNDING);
        let mut g_low = f64::INFINITY;
        for (index, node) in nodes.iter().enumerate() {
            let g = [g_low, self.slope(first + index, node, centre, offset)];
            g_low = g[1];
            if g[0] <= 0.0 && g[1] > 0.0 {
                let low = &nodes[index - 1];
                if let Some(number) = low.piece
                    && nearest(centre, [low, node], g) <= reach
                {
                    let ends = [low.angle, node.angle];
                    let start = ends[0] + (ends[1] - ends[0]) * (g[0] / (g[0] - g[1]));
                    let piece = &profile.pieces[number];
                    let curve = |angle: f64| profile.at(piece, angle);
                    touched(curve::foot(centre, ends, start, curve).1);
                }
            }
        }
    }

    /// `(P − C)·P'` at a node. At the profile's own ends, where the race goes on, the ball's angle says which side its
    /// foot is on, so that by no rounding it is on neither.
    #[inline]
    fn slope(&self, index: usize, node: &Node, centre: Vector, offset: f64) -> f64 {
        let g = node.point.minus(centre).dot(node.first);
        if index == 0 {
            if offset >= -self.profile_angle { g.min(0.0) } else { g.max(f64::MIN_POSITIVE) }
        } else if index + 1 == self.nodes.len() {
            if offset < self.profile_angle { g.max(f64::MIN_POSITIVE) } else { g.min(0.0) }
        } else {
            g
        }
    }
}

/// Lower bound of half the squared distance from `centre` to a stretch with derivatives `g` at its ends: the
/// distance is convex along a stretch, and no less than where its end tangents meet.
#[inline]
fn nearest(centre: Vector, [low, high]: [&Node; 2], g: [f64; 2]) -> f64 {
    let half_square = |node: &Node| {
        let gap = node.point.minus(centre);
        0.5 * gap.dot(gap)
    };
    let (at_low, at_high) = (half_square(low), half_square(high));
    let x = (at_high - at_low - g[1] * (high.angle - low.angle)) / (g[0] - g[1]);
    at_low + g[0] * x
}

/// Parts of `piece` less concave than the ball.
fn touchable(profile: &Profile, piece: &Piece) -> Vec<[f64; 2]> {
    let fade = fade(&profile.circles);
    let side = profile.circles.side;
    let holds = |angle: f64| fade.touchable(profile.at(piece, angle).concavity(side));
    let [start, end] = piece.ends;
    let place = |i: usize| match i {
        PARTS => end,
        _ => start + (end - start) * (i as f64 / PARTS as f64),
    };
    let mut found: Vec<[f64; 2]> = Vec::new();
    for i in 0..PARTS {
        let (low, high) = (place(i), place(i + 1));
        let stretch = match (holds(low), holds(high)) {
            (true, true) => [low, high],
            (true, false) => [low, curve::bisect(low, high, holds)],
            (false, true) => [curve::bisect(low, high, |angle| !holds(angle)), high],
            (false, false) => continue,
        };
        match found.last_mut() {
            Some(last) if last[1].to_bits() == stretch[0].to_bits() => last[1] = stretch[1],
            _ => found.push(stretch),
        }
    }
    found
}

/// Cuts a stretch into short ones and appends their nodes.
fn cut(profile: &Profile, number: usize, [low, high]: [f64; 2], nodes: &mut Vec<Node>) {
    let piece = &profile.pieces[number];
    let node = |angle: f64, piece_behind| {
        let CurvePoint { point, first, .. } = profile.at(piece, angle);
        Node { point, first, angle, piece: piece_behind }
    };
    match nodes.last_mut() {
        Some(last) if last.angle.to_bits() == low.to_bits() => last.piece = Some(number),
        _ => nodes.push(node(low, Some(number))),
    }
    let longest = STRETCH * profile.circles.roller / profile.circles.carrier;
    let parts = ((high - low) / longest).ceil().max(1.0);
    for i in 1..parts as usize {
        let angle = low + (high - low) * (i as f64 / parts);
        nodes.push(node(angle, Some(number)));
    }
    nodes.push(node(high, None));
}

/// Ball angles from which a ball can press on a stretch: its centre lies on the normal, at most its radius away.
fn window(circles: &Circles, ends: &[Node]) -> [f64; 2] {
    let angle = |vector: Vector| vector.along.atan2(vector.outward);
    let mut window = [f64::INFINITY, f64::NEG_INFINITY];
    for node in ends {
        let inward = node.first.normal().scaled(circles.side / node.first.length());
        let farthest = angle(node.point.minus(inward.scaled(circles.roller)));
        for angle in [node.angle, farthest] {
            window = [window[0].min(angle), window[1].max(angle)];
        }
    }
    window
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Interpolation, and continuity of the value and two derivatives at every joint, both ends included.
        #[test]
        fn passes_through_the_samples_and_is_smooth(
            steps in prop::collection::vec((0.05..1.0_f64, -1.0..1.0_f64), 3..12),
        ) {
            let mut knots = vec![(-0.7, 0.0)];
            for (i, &(width, depth)) in steps.iter().enumerate() {
                let depth = if i + 1 == steps.len() { 0.0 } else { depth };
                knots.push((knots[i].0 + width, depth));
            }
            let pieces = through(&knots);
            prop_assert_eq!(pieces.len(), knots.len() + 1);
            for &(angle, depth) in &knots {
                let piece = pieces.iter().find(|p| p.ends[0] <= angle && angle <= p.ends[1]).unwrap();
                prop_assert!((piece.at(angle)[0] - depth).abs() < 1e-11);
            }
            let flat = [0.0; 3];
            let mut before = flat;
            let mut largest = 1.0_f64;
            for piece in &pieces {
                let after = piece.at(piece.ends[0]);
                largest = after.iter().fold(largest, |most, value| most.max(value.abs()));
                for (a, b) in before.iter().zip(after) {
                    prop_assert!((a - b).abs() < 1e-11 * largest, "{} and {} at {}", a, b, piece.ends[0]);
                }
                before = piece.at(piece.ends[1]);
            }
            for value in before {
                prop_assert!(value.abs() < 1e-11 * largest);
            }
        }
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let pieces = through(&[(0.0, 0.0), (1.0, 2.0), (1.5, -1.0), (3.0, 0.5), (4.0, 0.0)]);
        let h = 1e-5;
        for piece in &pieces {
            let x = 0.3 * piece.ends[0] + 0.7 * piece.ends[1];
            let (before, here, after) = (piece.at(x - h), piece.at(x), piece.at(x + h));
            for i in 0..2 {
                let difference = (after[i] - before[i]) / (2.0 * h);
                assert!((difference - here[i + 1]).abs() < 1e-7);
            }
        }
    }
}
