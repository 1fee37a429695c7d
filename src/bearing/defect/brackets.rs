//! Where on a measured profile a ball can touch: stretches with one foot each, found by the ball's angle.
//!
//! On a stretch of the profile less concave than the ball, the centre of a ball that touches it moves on with
//! the point of contact. So a ball has at most one foot on it, and has it if and only if `(P − C)·P'` changes
//! sign between its ends. The stretches are cut short enough ([`STRETCH`]) for this to hold for a ball pressed
//! in as well, and are kept in order of angle; a grid over the ball's angle says which come into question.

use super::circles::Circles;
use super::curve::{self, CurvePoint};
use super::spline::Piece;
use super::spline::Profile;
use super::stiffness::Fade;
use super::vector::Vector;

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
