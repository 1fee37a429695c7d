//! How deep a ball sinks into a measured profile: for the report, not for the hot loop.

use super::spline::Profile;
use super::vector::Vector;

/// Ball positions that are tried first.
const POSITIONS: usize = 200;

/// Longest way from point to point in ball radii: a ball between two sinks 5e-7 of its radius too deep.
const SPACING: f64 = 2e-3;

/// Steps of the golden section about the deepest of them.
const SECTIONS: usize = 40;

/// Greatest displacement (m) of a ball beyond its place on the race that some angle within `half_angle` (rad) of
/// the middle allows: everywhere the nearest part of the profile holds it. Zero or more.
pub(super) fn deepest(profile: &Profile, half_angle: f64) -> f64 {
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
