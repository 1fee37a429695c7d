//! Contacts of dents in three dimensions against a dense search over their surfaces.
//!
//! Goal: the same pressing contacts, overlaps and directions as a search that knows points of the surface and nothing
//! else: torus, tube and floor are sampled in two parameters each. In one of them the distance to the ball's centre is
//! least at each value of the other; local minima of that over the other are refined by golden section in both, and
//! count if they lie on what of the part is surface.

use super::super::surface::Outline;
use super::surface::{RACES, subjects, surface_dent};
use super::*;

/// Samples along and across.
const ALONG: usize = 400;
const ACROSS: usize = 120;

/// Parameter across below which golden section means zero: rounding of a distance over the curvature there.
const IN_PLANE: f64 = 1e-4;

type Point = [f64; 3];

fn minus(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|i| a[i] - b[i])
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

fn unit(a: Point) -> Point {
    let length = dot(a, a).sqrt();
    a.map(|part| part / length)
}

/// Parts of the surface; z ≥ 0.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Part {
    Race,
    Tube,
    Floor,
}

/// x out along the dent's middle, y along the race, z across.
struct Sampled<'a> {
    outline: &'a Outline,
    half_angle: f64,
    samples: Vec<(Part, Vec<Vec<Point>>)>,
}

/// A minimum that presses, and how near it is to an end of its part.
#[derive(Debug)]
struct Found {
    delta: f64,
    normal: [f64; 2],
    doubtful: bool,
}

impl<'a> Sampled<'a> {
    fn new(outline: &'a Outline, half_angle: f64) -> Self {
        let mut all = Self { outline, half_angle, samples: Vec::new() };
        for part in [Part::Race, Part::Tube, Part::Floor] {
            let row = |i: usize| {
                let u = i as f64 / ALONG as f64;
                (0..=ACROSS).map(|j| all.point(part, u, j as f64 / ACROSS as f64)).collect()
            };
            let rows = (0..=ALONG).map(row).collect();
            all.samples.push((part, rows));
        }
        all
    }

    /// Point on a part from two parameters in 0..1, neighbourhoods of the ends u included.
    fn point(&self, part: Part, u: f64, v: f64) -> Point {
        let o = self.outline;
        let (r, side) = (o.circles.carrier, o.circles.side);
        let spoke = |radius: f64, phi: f64, z: f64| [radius * phi.cos(), radius * phi.sin(), z];
        match part {
            Part::Race => {
                let phi = 1.5 * self.half_angle * (2.0 * u - 1.0);
                let psi = 0.9 * v;
                spoke(r - side * o.groove * (1.0 - psi.cos()), phi, o.groove * psi.sin())
            }
            Part::Tube => {
                let tau = 1.02 * std::f64::consts::PI * u - 0.01 * std::f64::consts::PI;
                let tilt = 1.2 * v * v;
                let (centre, down) = self.centre(tau);
                let h = 1e-6;
                let along = minus(self.centre(tau + h).0, self.centre(tau - h).0);
                // out of the dent: along the race at its end, to higher z at its side
                let outward = unit(cross(along, down)).map(|part| side * part);
                [0, 1, 2].map(|i| centre[i] - o.rim * (tilt.cos() * down[i] + tilt.sin() * outward[i]))
            }
            Part::Floor => {
                let (x, y) = (2.0 * u - 1.0, v);
                let z = o.half_width * y * (1.0 - x * x).max(0.0).sqrt();
                let rest = (1.0 - x * x - (z / o.half_width).powi(2)).max(0.0);
                let sag = o.groove - (o.groove * o.groove - z * z).sqrt();
                spoke(r + side * (o.depth * rest.sqrt() - sag), o.half_length * x / r, z)
            }
        }
    }

    /// Point of the tube's centre curve, and the groove's normal into the material there.
    fn centre(&self, tau: f64) -> (Point, Point) {
        let o = self.outline;
        let (r, side) = (o.circles.carrier, o.circles.side);
        let phi = o.half_length * tau.cos() / r;
        let psi = (o.half_width * tau.sin() / o.groove).asin();
        let normal = [side * psi.cos() * phi.cos(), side * psi.cos() * phi.sin(), psi.sin()];
        let radius = r - side * o.groove;
        let q = o.groove + o.rim;
        let centre = [radius * phi.cos() + q * normal[0], radius * phi.sin() + q * normal[1], q * normal[2]];
        (centre, normal)
    }

    /// Below one inside the outline, and how deep a point lies below the race as a fraction of the floor there.
    fn place(&self, point: Point) -> (f64, f64) {
        let o = self.outline;
        let phi = point[1].atan2(point[0]);
        let inside = (o.circles.carrier * phi / o.half_length).powi(2) + (point[2] / o.half_width).powi(2);
        let sag = o.groove - (o.groove * o.groove - point[2] * point[2]).sqrt();
        let below = o.circles.side * (point[0].hypot(point[1]) - o.circles.carrier) + sag;
        (inside, below / (o.depth * (1.0 - inside).max(1e-300).sqrt()))
    }

    fn to_centre_curve(&self, point: Point) -> f64 {
        let of = |tau: f64| {
            let gap = minus(self.centre(tau).0, point);
            dot(gap, gap).sqrt()
        };
        let step = std::f64::consts::PI / 100.0;
        let best = (0..=100).min_by(|&a, &b| of(step * f64::from(a)).total_cmp(&of(step * f64::from(b))));
        let middle = step * f64::from(best.unwrap());
        of(golden([middle - step, middle + step], of))
    }

    fn contacts(&self, distance: f64, offset: f64) -> Vec<Found> {
        let (out, ahead) = ([offset.cos(), offset.sin(), 0.0], [-offset.sin(), offset.cos(), 0.0]);
        let ball = out.map(|part| distance * part);
        let to = |point: Point| {
            let gap = minus(point, ball);
            dot(gap, gap).sqrt()
        };
        let mut found = Vec::new();
        for (part, rows) in &self.samples {
            let least: Vec<(f64, usize)> = rows
                .iter()
                .map(|row| {
                    let values: Vec<f64> = row.iter().map(|&point| to(point)).collect();
                    // the floor may be nearer at its edge, where the tube covers it
                    let first = (0..ACROSS).find(|&j| values[j] <= values[j + 1]);
                    let j = match part {
                        Part::Floor => first.unwrap_or(ACROSS),
                        _ => (0..=ACROSS).min_by(|&a, &b| values[a].total_cmp(&values[b])).unwrap(),
                    };
                    // by a parabola through the neighbours: samples lie unevenly about the least
                    let mut value = values[j];
                    if j > 0 && j < ACROSS {
                        let [before, after] = [values[j - 1] - value, values[j + 1] - value];
                        let bend = before + after;
                        value -= (after - before).powi(2) / (8.0 * bend);
                    }
                    (value, j)
                })
                .collect();
            for i in 1..ALONG {
                let [before, here, after] = [i - 1, i, i + 1].map(|i| least[i].0);
                if here < before && here <= after && here < self.outline.circles.roller + 1e-9 {
                    found.extend(self.refined(*part, [i, least[i].1], &to, [ball, out, ahead]));
                }
            }
        }
        found
    }

    fn refined(
        &self,
        part: Part,
        [i, j]: [usize; 2],
        to: &impl Fn(Point) -> f64,
        [ball, out, ahead]: [Point; 3],
    ) -> Option<Found> {
        let near =
            |i: usize, count: usize, more: f64| [(i as f64 - more) / count as f64, (i as f64 + more) / count as f64];
        let across = |u: f64| {
            // the plane z = 0 and the race's side of the tube are ends
            let [low, high] = near(j, ACROSS, if part == Part::Floor { 1.0 } else { 4.0 });
            let v = golden([low.max(0.0), high.min(1.0)], |v| to(self.point(part, u, v)));
            let ends = if low <= 0.0 && to(self.point(part, u, 0.0)) <= to(self.point(part, u, v)) { 0.0 } else { v };
            (ends, to(self.point(part, u, ends)))
        };
        let ends = near(i, ALONG, 1.0);
        let u = golden(ends, |u| across(u).1);
        // samples of a valley that runs aslant have minima that the valley has not
        if ends.iter().any(|end| (u - end).abs() < 1e-3 / ALONG as f64) {
            return None;
        }
        let v = across(u).0;
        let point = self.point(part, u, v);
        let (inside, depth) = self.place(point);
        let mut doubtful = false;
        let on = match part {
            Part::Race => {
                doubtful |= (inside - 1.0).abs() < 1e-3;
                v < IN_PLANE && inside >= 1.0
            }
            Part::Tube => {
                // where the outline bends tightly one part of the tube runs within another
                let clear = self.to_centre_curve(point) / self.outline.rim - 1.0;
                doubtful |= (depth - 1.0).abs() < 0.1 || !(0.02..=0.98).contains(&u);
                v > 0.0 && inside < 1.0 && depth < 1.0 && clear > -1e-6
            }
            Part::Floor => {
                let clear = self.to_centre_curve(point) / self.outline.rim - 1.0;
                doubtful |= clear.abs() < 0.01;
                // where a ball of its own radius, not pressed in, nearly fits across or more, the contact has faded
                let beside = self.point(part, u, 0.02);
                let bend = 2.0 * (to(beside) - to(point)) / (beside[2] * beside[2]);
                let free = bend - 1.0 / to(point) + 1.0 / self.outline.circles.roller;
                doubtful |= free < 0.2 * self.outline.circles.across;
                v < IN_PLANE && clear > 0.0
            }
        };
        let delta = self.outline.circles.roller - to(point);
        (delta > 0.0 && on).then(|| {
            let normal = unit(minus(point, ball));
            Found { delta, normal: [dot(normal, out), dot(normal, ahead)], doubtful }
        })
    }
}

fn golden([mut low, mut high]: [f64; 2], f: impl Fn(f64) -> f64) -> f64 {
    let ratio = 0.5 * (5f64.sqrt() - 1.0);
    let mut inner = [high - ratio * (high - low), low + ratio * (high - low)];
    let mut value = inner.map(&f);
    for _ in 0..40 {
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

/// Whether a ball's centre is nearer to the outline beside a vertex than to the vertex itself.
fn leaves_vertex(sampled: &Sampled<'_>, ball: Point, feature: Feature) -> bool {
    let tau = match feature {
        Feature::RimAfter => 0.0,
        Feature::RimBefore => PI,
        _ => return false,
    };
    let to = |tau: f64| {
        let gap = minus(sampled.centre(tau).0, ball);
        dot(gap, gap)
    };
    to(tau + 1e-3) < to(tau)
}

/// Agreement over many ball positions.
#[derive(Debug, Default)]
struct Tally {
    positions: u32,
    skipped: u32,
    /// Positions with a vertex that shares the load although it is no minimum.
    shared: u32,
    several: u32,
    /// Largest differences of overlap (m) and of a normal's component.
    worst: [f64; 2],
}

impl Tally {
    fn compare(&mut self, name: &str, subject: &Subject, positions: u32, numbers: &mut Numbers) {
        let Kind::Race(defect) = &subject.kind else { panic!("{name}") };
        let RaceDefect::SurfaceDent(dent) = &**defect else { panic!("{name}") };
        let sampled = Sampled::new(&dent.outline, dent.contact_half_angle());
        for _ in 0..positions {
            let sunk = 25e-6 * numbers.next();
            let offset = 1.15 * subject.contact_half_angle() * (2.0 * numbers.next() - 1.0);
            let distance = subject.distance(sunk);
            let mut expected = sampled.contacts(distance, offset);
            let found = subject.contacts(sunk, offset);
            let mut computed: Vec<_> = found.pressing().collect();
            let ball = [distance * offset.cos(), distance * offset.sin(), 0.0];
            let all = computed.len();
            computed.retain(|c| !leaves_vertex(&sampled, ball, c.feature));
            self.shared += u32::from(computed.len() < all);
            self.positions += 1;
            if expected.len() > computed.len() {
                expected.retain(|one| !one.doubtful);
            }
            if computed.len() != expected.len() {
                self.skipped += 1;
                continue;
            }
            self.several += u32::from(computed.len() > 1);
            expected.sort_by(|a, b| a.delta.total_cmp(&b.delta));
            computed.sort_by(|a, b| a.delta.total_cmp(&b.delta));
            for (c, e) in computed.iter().zip(&expected) {
                self.worst[0] = self.worst[0].max((c.delta - e.delta).abs());
                let [radial, tangential] = e.normal;
                let off = (c.normal_radial - radial).hypot(c.normal_tangential - tangential);
                self.worst[1] = self.worst[1].max(off);
            }
        }
    }

    fn check(&self, name: &str) {
        let Self { positions, skipped, worst, .. } = self;
        // overlaps come to rounding, 1e-18 m; golden section finds the place of a minimum to the root of that, 1e-11 m on a
        // radius of curvature of 1e-5 m or more
        assert!(worst[0] < 1e-15 && worst[1] < 1e-5, "{name}: {self:?}");
        // at the corner of rim and floor, and where samples do not tell two places from one
        assert!(*skipped <= positions / 50, "{name}: {self:?}");
    }
}

#[test]
fn same_contacts_as_a_dense_search_in_space() {
    let mut numbers = Numbers(41);
    for (name, subject) in subjects() {
        let mut tally = Tally::default();
        tally.compare(name, subject, 300, &mut numbers);
        tally.check(name);
        let convex = !["short", "conforming", "widest"].iter().any(|word| name.starts_with(word));
        assert!(!convex || tally.shared == 0, "{name}: {tally:?}");
        let held_twice = ["even", "shallow", "short"].iter().any(|word| name.starts_with(word));
        assert!(!held_twice || tally.several > 10, "{name}: {tally:?}");
    }
}

#[test]
fn random_dents_agree_with_the_search_in_space() {
    let mut numbers = Numbers(43);
    let mut tally = Tally::default();
    for i in 0..60 {
        let length = numbers.between(0.1e-3, 2e-3);
        let depth = numbers.between(1e-6, 0.02 * length);
        let width = numbers.between(4.0 * depth, 1.9e-3);
        let shape = DentShape { width: Some(width), ..dent_shape(length, depth, numbers.between(10e-6, 0.2 * length)) };
        let dent = surface_dent(RACES[i % 2], shape);
        let subject = Subject::race(RaceDefect::SurfaceDent(dent));
        tally.compare("random", &subject, 30, &mut numbers);
    }
    tally.check("random dents");
    assert!(tally.several > 100, "{tally:?}");
}
