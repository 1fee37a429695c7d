//! Contacts against a dense search over the profile.
//!
//! Goal: the same set of pressing contacts, overlaps and normals as a search that knows nothing of rims,
//! floors, splines or derivatives. The profile is sampled in angle; each local minimum of the distance to a
//! convex circle (maximum, to the centre of a concave one) is refined by golden section. Places more concave than
//! the rolling circle (curvature by differences of the profile) are left out, as documented: their stiffness is zero.

use super::*;

/// Intervals of the angle to begin with; each is halved where the profile turns by more than [`TURN`] in it.
const SAMPLES: u32 = 1000;
const TURN: f64 = 3e-4;
const HALVINGS: u32 = 9;

/// A dense sample of one subject's profile.
struct Dense<'a> {
    subject: &'a Subject,
    circles: Circles,
    places: Vec<f64>,
    points: Vec<Vector>,
}

/// What the search finds: overlap and normal in the ball's polar frame.
type Found = (f64, [f64; 2]);

impl<'a> Dense<'a> {
    fn new(subject: &'a Subject) -> Self {
        let wide = 0.3 * subject.half_angle() + 1.2 * subject.contact_half_angle();
        let step = 2.0 * wide / f64::from(SAMPLES);
        let mut dense = Self { subject, circles: subject.circles, places: vec![-wide], points: Vec::new() };
        for i in 0..SAMPLES {
            let low = step * f64::from(i) - wide;
            dense.sample([low, low + step], HALVINGS);
        }
        dense.points = dense.places.iter().map(|&phi| dense.point(phi)).collect();
        dense
    }

    /// Appends the end of an interval, and places within it where the profile turns.
    fn sample(&mut self, [low, high]: [f64; 2], halvings: u32) {
        let middle = 0.5 * (low + high);
        let [a, b, c] = [low, middle, high].map(|phi| self.point(phi));
        let (before, after) = (b.minus(a), c.minus(b));
        let turn = before.dot(after.normal()) / before.dot(after);
        if turn.abs() > TURN && halvings > 0 {
            self.sample([low, middle], halvings - 1);
            self.sample([middle, high], halvings - 1);
        } else {
            self.places.push(high);
        }
    }

    fn point(&self, phi: f64) -> Vector {
        Vector::radial(phi).scaled(self.subject.polar_radius(phi))
    }

    /// Concave curvature of the profile by differences in angle.
    fn concavity(&self, phi: f64) -> f64 {
        let h = 1e-5;
        let r = |phi: f64| self.subject.polar_radius(phi);
        let (before, here, after) = (r(phi - h), r(phi), r(phi + h));
        let first = (after - before) / (2.0 * h);
        let second = (after - 2.0 * here + before) / (h * h);
        let bend = here * here + 2.0 * first * first - here * second;
        self.circles.side * bend / (here * here + first * first).powf(1.5)
    }

    /// Whether the profile comes to be as concave as the roller within a sample of a contact.
    fn folds_near(&self, contact: &DefectContact, offset: f64) -> bool {
        let Circles { carrier, roller, .. } = self.circles;
        let across = roller.signum() * contact.normal_tangential * (roller - contact.delta) / carrier;
        let place = offset + across;
        let step = self.places[1] - self.places[0];
        let near = (-4..=4).map(|i| place + 0.25 * step * f64::from(i));
        near.into_iter().any(|phi| self.concavity(phi) > 0.98 / roller)
    }

    /// All pressing contacts in order of angle, and whether one is too near an edge to call.
    fn contacts(&self, sunk: f64, offset: f64) -> (Vec<Found>, bool) {
        let distance = self.subject.distance(sunk);
        let (centre, radius_vector) = self.subject.place(distance, offset);
        let roller = self.circles.roller;
        let sign = roller.signum();
        // signed distance along the normal into the carrier
        let along = |point: Vector| sign * point.minus(centre).length();
        let near = 1e-6 + roller;
        let values: Vec<f64> = self.points.iter().map(|&point| along(point)).collect();
        let (mut found, mut doubtful) = (Vec::new(), false);
        for j in 1..values.len() - 1 {
            if values[j] < near && values[j] < values[j - 1] && values[j] <= values[j + 1] {
                let ends = [self.places[j - 1], self.places[j + 1]];
                let phi = golden_section(ends, |phi| along(self.point(phi)));
                let delta = roller - along(self.point(phi));
                let bend = self.concavity(phi);
                doubtful |= (bend * roller - 1.0).abs() < 0.02;
                if delta > 0.0 && bend < 1.0 / roller {
                    let into = self.point(phi).minus(centre);
                    let normal = into.scaled(1.0 / into.length());
                    // from the ball into the race: the carrier's outward normal if the ball carries the defect
                    let normal = match self.subject.kind {
                        Kind::Ball(_, Race::Inner) => normal.scaled(-1.0),
                        _ => normal,
                    };
                    found.push((delta, [normal.dot(radius_vector), normal.dot(radius_vector.tangent())]));
                }
            }
        }
        while found.len() > MOST_CONTACTS {
            let shallower = |a: &(usize, &Found), b: &(usize, &Found)| a.1.0.total_cmp(&b.1.0);
            let least = found.iter().enumerate().min_by(shallower).unwrap().0;
            found.remove(least);
        }
        (found, doubtful)
    }
}

fn golden_section([mut low, mut high]: [f64; 2], f: impl Fn(f64) -> f64) -> f64 {
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

/// Agreement over many ball positions.
#[derive(Default)]
struct Tally {
    positions: u32,
    several: u32,
    skipped: u32,
    /// Largest differences of overlap (m) and of a normal's component.
    worst: [f64; 2],
}

impl Tally {
    fn compare(&mut self, name: &str, subject: &Subject, positions: u32, numbers: &mut Numbers) {
        let dense = Dense::new(subject);
        for _ in 0..positions {
            let sunk = -1e-6 + 25e-6 * numbers.next();
            let offset = 1.15 * subject.contact_half_angle() * (2.0 * numbers.next() - 1.0);
            let (expected, mut doubtful) = dense.contacts(sunk, offset);
            let found = subject.contacts(sunk, offset);
            let computed: Vec<_> = found.pressing().collect();
            self.positions += 1;
            // Near a fold the minimum is shallower than the samples resolve.
            doubtful |= computed.iter().any(|c| dense.folds_near(c, offset));
            if computed.len() != expected.len() && doubtful {
                self.skipped += 1;
                continue;
            }
            assert_eq!(
                computed.len(),
                expected.len(),
                "{name}, sunk {sunk}, offset {offset}: {computed:?} {expected:?}"
            );
            self.several += u32::from(computed.len() > 1);
            for (c, (delta, normal)) in computed.iter().zip(&expected) {
                self.worst[0] = self.worst[0].max((c.delta - delta).abs());
                let [radial, tangential] = normal;
                let off = (c.normal_radial - radial).hypot(c.normal_tangential - tangential);
                self.worst[1] = self.worst[1].max(off);
            }
        }
    }

    fn check(&self, name: &str, fewest_several: u32) {
        let Self { positions, several, skipped, worst } = self;
        // Overlaps come to rounding: 1e-18 m on a length of 1e-3 m, and the profile joins to 1e-17. Golden section
        // finds the place of a minimum to the root of that, 1e-11 m on a radius of curvature of 1e-5 m or more.
        assert!(worst[0] < 1e-15, "{name}: overlaps differ by {} m", worst[0]);
        assert!(worst[1] < 1e-5, "{name}: normals differ by {}", worst[1]);
        assert!(*skipped <= positions / 100, "{name}: {skipped} of {positions} too near an edge to call");
        assert!(*several >= fewest_several, "{name}: only {several} of {positions} with several contacts");
    }
}

#[test]
fn same_contacts_as_a_dense_search() {
    let mut numbers = Numbers(20_110_417);
    for (name, subject) in subjects() {
        let mut tally = Tally::default();
        tally.compare(name, subject, 1500, &mut numbers);
        let single = name.starts_with("smooth")
            || matches!(subject.kind, Kind::Ball(_, Race::Inner))
            || *name == "source's flat";
        tally.check(name, if single { 0 } else { 10 });
    }
}

#[test]
fn random_dents_agree_with_the_search() {
    let mut numbers = Numbers(3);
    let mut tally = Tally::default();
    for i in 0..150 {
        let race = [Race::Outer, Race::Inner][i % 2];
        let length = numbers.between(0.1e-3, 2e-3);
        let depth = numbers.between(1e-6, 40e-6);
        let shape = dent_shape(length, depth, numbers.between(10e-6, 1e-3));
        let Ok(dent) = Dent::new(&source_bearing(), race, shape, source_stiffness()) else {
            continue;
        };
        let subject = Subject::race(RaceDefect::Dent(dent));
        tally.compare("random dent", &subject, 60, &mut numbers);
    }
    tally.check("random dents", 100);
}

#[test]
fn random_flats_agree_with_the_search() {
    let mut numbers = Numbers(4);
    let mut tally = Tally::default();
    for i in 0..100 {
        let race = [Race::Outer, Race::Inner][i % 2];
        let shape = FlatShape {
            radius: numbers.between(1.2e-3, 50e-3),
            depth: numbers.between(1e-6, 30e-6),
            rim_radius: numbers.between(10e-6, 0.3e-3),
            ..source_flat()
        };
        let Ok(flat) = BallFlat::new(&source_bearing(), shape, source_stiffness()) else {
            continue;
        };
        let subject = Subject::ball(flat, race);
        tally.compare("random flat", &subject, 60, &mut numbers);
    }
    tally.check("random flats", 20);
}

/// Few samples, slopes up to the limit: polynomials on which curvature is far from linear.
#[test]
fn random_coarse_profiles_agree_with_the_search() {
    let mut numbers = Numbers(6);
    let mut tally = Tally::default();
    for i in 0..200 {
        let race = [Race::Outer, Race::Inner][i % 2];
        let length = numbers.between(0.2e-3, 3e-3);
        let count = numbers.between(4.0, 9.0) as u32;
        let depth = length * numbers.between(1e-3, 0.2);
        let noise: Vec<f64> = (0..=count).map(|_| numbers.next() - 0.3).collect();
        let samples = sampled(length, count, |x| {
            let i = (x * f64::from(count)).round() as usize;
            depth * noise[i]
        });
        let (bearing, stiffness) = (source_bearing(), source_stiffness());
        let Ok(measured) = MeasuredProfile::new(&bearing, race, MIDDLE, &samples, stiffness) else {
            continue;
        };
        let subject = Subject::race(RaceDefect::Measured(measured));
        tally.compare("coarse profile", &subject, 60, &mut numbers);
    }
    tally.check("coarse profiles", 100);
}

#[test]
fn random_profiles_agree_with_the_search() {
    let mut numbers = Numbers(5);
    let mut tally = Tally::default();
    for i in 0..100 {
        let race = [Race::Outer, Race::Inner][i % 2];
        let length = numbers.between(0.3e-3, 2e-3);
        let count = numbers.between(10.0, 80.0) as u32;
        let depth = numbers.between(2e-6, 20e-6);
        let rough = numbers.between(0.1e-6, 3e-6);
        let noise: Vec<f64> = (0..=count).map(|_| numbers.next() - 0.5).collect();
        let samples = sampled(length, count, |x| {
            let i = (x * f64::from(count)).round() as usize;
            depth * (PI * x).sin().powi(2) + rough * noise[i]
        });
        let (bearing, stiffness) = (source_bearing(), source_stiffness());
        let Ok(measured) = MeasuredProfile::new(&bearing, race, MIDDLE, &samples, stiffness) else {
            continue;
        };
        let subject = Subject::race(RaceDefect::Measured(measured));
        tally.compare("random profile", &subject, 60, &mut numbers);
    }
    tally.check("random profiles", 500);
}
