//! Where on a measured profile a ball can touch: stretches with one foot each, found by the ball's angle.
//!
//! On a stretch of the profile less concave than the ball, the centre of a ball that touches it moves on with
//! the point of contact. So a ball has at most one foot on it, and has it if and only if `(P − C)·P'` changes
//! sign between its ends. The stretches are cut short enough ([`STRETCH`]) for this to hold for a ball pressed
//! in as well, and are kept in order of angle; a grid over the ball's angle says which come into question.

use super::circles::Circles;
use super::curve::{self, CurvePoint};
use super::fade::Fade;
use super::spline::Piece;
use super::vector::Vector;

/// Longest stretch in ball radii: over it the distance to a ball changes by a few thousandths of the radius at
/// most, [`EARLY`].
const STRETCH: f64 = 0.02;

/// Contacts are gone at this fraction of the ball's curvature below it.
const EARLY: f64 = 2e-3;

/// Parts of a piece in which a change from touchable to not is looked for.
const PARTS: usize = 12;

/// A profile's curve: polynomials of the angle over a circle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Profile {
    pub circles: Circles,
    pub pieces: Vec<Piece>,
}

impl Profile {
    /// Point of `piece` at `angle` (rad) from the middle; the parameter is the angle.
    #[inline]
    pub fn at(&self, piece: &Piece, angle: f64) -> CurvePoint {
        let [depth, slope, bend] = piece.at(angle);
        let Circles { carrier, side, .. } = self.circles;
        CurvePoint::polar(
            Vector::radial(angle),
            [carrier + side * depth, side * slope, side * bend],
            [1.0, 0.0],
        )
    }
}

/// One end of a stretch.
#[derive(Debug, Clone, Copy, PartialEq)]
struct End {
    point: Vector,
    first: Vector,
}

/// A stretch of one piece.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Bracket {
    ends: [End; 2],
    angles: [f64; 2],
    piece: usize,
}

/// All stretches that a ball can touch.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Brackets {
    brackets: Vec<Bracket>,
    /// Half the arc of ball angles in which any of them is pressed, rad.
    pub half_angle: f64,
    cells_per_radian: f64,
    /// First stretch and the one behind the last that come into question, cell by cell.
    cells: Vec<[usize; 2]>,
}

/// Where a contact begins to count: [`EARLY`] before the ball's curvature.
pub(super) fn fade(circles: &Circles) -> Fade {
    Fade::new(circles, EARLY * circles.roller_curvature())
}

impl Brackets {
    /// Finds the stretches of `profile`, whose ends lie `half_angle` (rad) from its middle.
    pub fn new(profile: &Profile, half_angle: f64) -> Self {
        let mut brackets = Vec::new();
        for (number, piece) in profile.pieces.iter().enumerate() {
            for stretch in touchable(profile, piece) {
                cut(profile, number, stretch, &mut brackets);
            }
        }
        let windows: Vec<[f64; 2]> = brackets
            .iter()
            .map(|bracket| window(&profile.circles, bracket))
            .collect();
        let half_angle = windows
            .iter()
            .flatten()
            .fold(half_angle, |most, angle| most.max(angle.abs()));
        let count = (2 * brackets.len()).clamp(16, 4096);
        let cells_per_radian = count as f64 / (2.0 * half_angle);
        let mut found = Self {
            brackets,
            half_angle,
            cells_per_radian,
            cells: vec![[usize::MAX, 0]; count],
        };
        for (number, window) in windows.into_iter().enumerate() {
            // a cell more on both sides covers rounding
            let [from, to] = window.map(|angle| found.cell(angle));
            for cell in &mut found.cells[from.saturating_sub(1)..(to + 2).min(count)] {
                *cell = [cell[0].min(number), cell[1].max(number + 1)];
            }
        }
        found
    }

    #[inline]
    fn cell(&self, offset: f64) -> usize {
        let place = (offset + self.half_angle) * self.cells_per_radian;
        (place as usize).min(self.cells.len() - 1)
    }

    /// Calls `touched` for every foot of `centre`, which lies at `offset` (rad) within the half angle, in order.
    #[inline]
    pub fn feet(
        &self,
        profile: &Profile,
        centre: Vector,
        offset: f64,
        mut touched: impl FnMut(CurvePoint),
    ) {
        let [first, past] = self.cells[self.cell(offset)];
        for bracket in self.brackets.get(first..past).unwrap_or(&[]) {
            let g = bracket
                .ends
                .map(|end| end.point.minus(centre).dot(end.first));
            if g[0] <= 0.0 && g[1] > 0.0 {
                let piece = &profile.pieces[bracket.piece];
                let [low, high] = bracket.angles;
                let start = low + (high - low) * (g[0] / (g[0] - g[1]));
                let curve = |angle: f64| profile.at(piece, angle);
                touched(curve::foot(centre, [low, high], start, curve).1);
            }
        }
    }
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

/// Cuts a stretch into short ones and appends them; an end shared with the one before is the same to the bit,
/// so that a foot on it is found once.
fn cut(profile: &Profile, number: usize, [low, high]: [f64; 2], brackets: &mut Vec<Bracket>) {
    let piece = &profile.pieces[number];
    let end = |angle: f64| {
        let CurvePoint { point, first, .. } = profile.at(piece, angle);
        End { point, first }
    };
    let longest = STRETCH * profile.circles.roller / profile.circles.carrier;
    let parts = ((high - low) / longest).ceil().max(1.0);
    let mut from = match brackets.last() {
        Some(last) if last.angles[1].to_bits() == low.to_bits() => (low, last.ends[1]),
        _ => (low, end(low)),
    };
    for i in 1..=parts as usize {
        let angle = low + (high - low) * (i as f64 / parts);
        let angle = if i as f64 >= parts { high } else { angle };
        let to = (angle, end(angle));
        brackets.push(Bracket {
            ends: [from.1, to.1],
            angles: [from.0, to.0],
            piece: number,
        });
        from = to;
    }
}

/// Ball angles from which a ball can press on a stretch: its centre lies on the normal, at most its radius away.
fn window(circles: &Circles, bracket: &Bracket) -> [f64; 2] {
    let angle = |vector: Vector| vector.along.atan2(vector.outward);
    let mut window = bracket.angles;
    for end in &bracket.ends {
        let inward = end.first.normal().scaled(circles.side / end.first.length());
        let farthest = angle(end.point.minus(inward.scaled(circles.roller)));
        window = [window[0].min(farthest), window[1].max(farthest)];
    }
    window
}
