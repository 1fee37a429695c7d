//! What the force has to do with a potential.

use super::*;

/// Envelope theorem: the gradient of δ over the ball's position is the normal, so that with k held the force is
/// the gradient of `(2/5) k δ^{5/2}`. By differences, with race and ball kept from turning.
#[test]
fn gradient_of_overlap_is_the_normal() {
    let mut numbers = Numbers(17);
    let mut compared = 0;
    for (name, subject) in every_subject() {
        for _ in 0..300 {
            let sunk = -2e-6 + 27e-6 * numbers.next();
            let offset = 1.1 * subject.contact_half_angle() * (2.0 * numbers.next() - 1.0);
            let distance = subject.distance(sunk);
            let h = 1e-9;
            let at = |out: f64, ahead: f64| subject.contacts_at(distance + out * h, offset + ahead * h / distance);
            let found = at(0.0, 0.0);
            let around = [at(1.0, 0.0), at(-1.0, 0.0), at(0.0, 1.0), at(0.0, -1.0)];
            let same = |other: &DefectContacts| {
                other.as_slice().len() == found.as_slice().len()
                    && other.as_slice().iter().zip(found.as_slice()).all(|(a, b)| a.feature == b.feature)
            };
            for c in found.pressing() {
                let norm = c.normal_radial.hypot(c.normal_tangential);
                let leaning = c.feature == Feature::SideEdges && norm < 1.0;
                assert!(leaning || (norm - 1.0).abs() < 1e-14, "{name}");
            }
            if !around.iter().all(same) {
                continue;
            }
            for (i, c) in found.as_slice().iter().enumerate().filter(|(_, c)| c.delta > 0.0) {
                let [out, back, ahead, behind] = around.map(|other| other.as_slice()[i].delta);
                // rounding of 1e-18 m over 2e-9 m, and the step times a curvature of 1e5/m on the sharpest rim
                let slack = 2e-6 + 1e-4 * c.normal_tangential.abs();
                assert!(((out - back) / (2.0 * h) - c.normal_radial).abs() < slack, "{name} {c:?}");
                let slope = (ahead - behind) / (2.0 * h);
                assert!((slope - c.normal_tangential).abs() < slack, "{name} {c:?} {slope}");
                compared += 1;
            }
        }
    }
    assert!(compared > 3000, "only {compared} compared");
}

/// Along any path the work on the contacts is the change of `V = Σ (2/5) k δ^{5/2}` less `Σ ∫ (2/5) δ^{5/2} dk`:
/// that, and nothing else, is what no potential accounts for.
#[test]
fn work_is_the_change_of_energy_less_that_of_stiffness() {
    const STEPS: u32 = 20_000;
    for (name, subject) in every_subject() {
        let wide = 0.8 * subject.contact_half_angle();
        let path = |x: f64| (4e-6 + 6e-6 * x, wide * (1.4 * x - 0.7));
        let at = |i: u32| {
            let (sunk, offset) = path(f64::from(i) / f64::from(STEPS));
            let distance = subject.distance(sunk);
            (distance, offset, subject.contacts_at(distance, offset))
        };
        let energy = |found: &DefectContacts| -> f64 {
            let of = |c: &DefectContact| 0.4 * c.stiffness * c.delta.powf(2.5);
            found.pressing().map(of).sum()
        };
        let (mut work, mut by_stiffness) = (0.0, 0.0);
        let mut before = at(0);
        let start = energy(&before.2);
        for i in 1..=STEPS {
            let after = at(i);
            let out = after.0 - before.0;
            let ahead = 0.5 * (after.0 + before.0) * (after.1 - before.1);
            for found in [&before.2, &after.2] {
                for c in found.pressing() {
                    let force = c.stiffness * c.delta.powf(1.5);
                    work += 0.5 * force * (c.normal_radial * out + c.normal_tangential * ahead);
                }
            }
            by_stiffness += energy_of_stiffness(&before.2, &after.2);
            before = after;
        }
        let change = energy(&before.2) - start;
        let scale = 0.4 * subject.circles.stiffness * (1e-5_f64).powf(2.5);
        let error = (work - (change - by_stiffness)).abs() / scale;
        // trapezoids of 20000 steps
        assert!(error < 1e-3, "{name}: {work} J against {change} - {by_stiffness}");
    }
}

/// `Σ (2/5) δ^{5/2} dk` over a step. A contact that fades within it (on a scratched profile in nanometres) gives up
/// its whole k, one that comes with an overlap brings it.
fn energy_of_stiffness(before: &DefectContacts, after: &DefectContacts) -> f64 {
    let power = |c: &DefectContact| 0.4 * c.delta.powf(2.5);
    // normals turn by 1e-4 in a step and overlaps change by 1e-8 m; they differ by 1e-2 from scratch to scratch, and by
    // microns from side edges to floor
    let same = |a: &DefectContact, b: &DefectContact| {
        (a.normal_tangential - b.normal_tangential).abs() < 2e-3 && (a.delta - b.delta).abs() < 5e-8
    };
    let gone = |c: &DefectContact, others: &DefectContacts| !others.pressing().any(|b| same(c, b));
    let mut sum = 0.0;
    for a in before.pressing() {
        if gone(a, after) {
            sum -= power(a) * a.stiffness;
        }
        for b in after.pressing().filter(|b| same(a, b)) {
            sum += 0.5 * (power(a) + power(b)) * (b.stiffness - a.stiffness);
        }
    }
    for b in after.pressing().filter(|b| gone(b, before)) {
        sum += power(b) * b.stiffness;
    }
    sum
}
