//! Contacts against a dense search over the profile.
//!
//! Goal: the same set of pressing contacts and the same overlap as a search that knows nothing of rims,
//! floors or derivatives. The profile is sampled in angle; each local minimum of the distance is refined
//! by golden section. Minima on a floor curved more tightly than the ball (curvature by differences of
//! the profile) are left out, as documented: their stiffness is zero.

use super::tests::{MIDDLE, at, kinds};
use super::*;

const SAMPLES: u32 = 3000;
const POSITIONS: u32 = 2500;

/// Distance from a ball to the profile at offset `phi` from the dent's middle.
fn distance(dent: &OuterDent, ball: PolarPosition, phi: f64) -> f64 {
    let radius = dent.profile_radius(MIDDLE + phi);
    let (sin, cos) = (phi - (ball.angle - MIDDLE)).sin_cos();
    (radius * cos - ball.radius).hypot(radius * sin)
}

fn golden_section(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let ratio = 0.5 * (5f64.sqrt() - 1.0);
    let mut inner = [high - ratio * (high - low), low + ratio * (high - low)];
    let mut value = inner.map(&f);
    for _ in 0..60 {
        if value[0] < value[1] {
            high = inner[1];
            inner = [high - ratio * (high - low), inner[0]];
            value = [f(inner[0]), value[0]];
        } else {
            low = inner[0];
            inner = [inner[1], low + ratio * (high - low)];
            value = [value[1], f(inner[1])];
        }
    }
    0.5 * (low + high)
}

/// Concave curvature of the profile by differences in angle.
fn curvature(dent: &OuterDent, phi: f64) -> f64 {
    let h = 1e-5;
    let r = |phi: f64| dent.profile_radius(MIDDLE + phi);
    let (before, here, after) = (r(phi - h), r(phi), r(phi + h));
    let first = (after - before) / (2.0 * h);
    let second = (after - 2.0 * here + before) / (h * h);
    (here * here + 2.0 * first * first - here * second) / (here * here + first * first).powf(1.5)
}

/// Overlaps of all minima that press, in order of angle, and whether one is too near an edge to call.
fn searched(dent: &OuterDent, ball: PolarPosition) -> (Vec<f64>, bool) {
    let wide = 1.8 * dent.half_angle();
    let step = 2.0 * wide / f64::from(SAMPLES);
    let place = |i: u32| -wide + step * f64::from(i);
    let sampled: Vec<f64> = (0..=SAMPLES)
        .map(|i| distance(dent, ball, place(i)))
        .collect();
    let (mut found, mut doubtful) = (Vec::new(), false);
    for i in 1..SAMPLES {
        let j = i as usize;
        if sampled[j] < sampled[j - 1] && sampled[j] <= sampled[j + 1] {
            let phi = golden_section(place(i - 1), place(i + 1), |phi| distance(dent, ball, phi));
            let delta = dent.ball_radius - distance(dent, ball, phi);
            let bend = curvature(dent, phi);
            doubtful |= (bend * dent.ball_radius - 1.0).abs() < 0.02;
            if delta > 0.0 && bend < 1.0 / dent.ball_radius {
                found.push(delta);
            }
        }
    }
    (found, doubtful)
}

/// Deterministic numbers in 0..1 (a 64-bit linear congruential generator, Knuth's constants).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

#[test]
fn same_contacts_and_overlaps_as_a_dense_search() {
    let mut numbers = Numbers(20_110_417);
    for (kind, dent) in kinds().iter().enumerate() {
        let (mut several, mut skipped, mut worst) = (0, 0, 0.0_f64);
        for _ in 0..POSITIONS {
            let sunk = -1e-6 + 25e-6 * numbers.next();
            let offset = 1.5 * dent.half_angle() * (2.0 * numbers.next() - 1.0);
            let ball = at(dent, sunk, offset);
            let (expected, mut doubtful) = searched(dent, ball);
            let found = dent.contacts(ball);
            let computed: Vec<f64> = found.pressing().map(|c| c.delta).collect();
            // Near a fold the minimum is shallower than the samples resolve; its stiffness is fading there.
            doubtful |= found
                .pressing()
                .any(|c| c.stiffness < 0.02 * dent.race_stiffness);
            if computed.len() != expected.len() && doubtful {
                skipped += 1;
                continue;
            }
            assert_eq!(
                computed.len(),
                expected.len(),
                "kind {kind}, sunk {sunk}, offset {offset}: {computed:?} {expected:?}"
            );
            several += u32::from(computed.len() > 1);
            for (a, b) in computed.iter().zip(&expected) {
                worst = worst.max((a - b).abs());
            }
        }
        // Both come to rounding: 1e-18 m on 1 mm; the profile joins to 1e-17.
        assert!(
            worst < 1e-9 * 1e-6,
            "kind {kind}: overlaps differ by {worst} m"
        );
        assert!(
            skipped <= POSITIONS / 100,
            "kind {kind}: {skipped} too near an edge to call"
        );
        assert!(
            several > 20 || kind == 4,
            "kind {kind}: only {several} positions with several contacts"
        );
    }
}
