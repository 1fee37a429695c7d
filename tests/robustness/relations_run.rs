//! Reference: the same bearing described in another way, whose signals are known from those of the first.
//! Goal: signals that are wrong for one description alone, for one side, or for one size, are seen.
//! Sketch: a preloaded bearing on springs that are not even left and right, and a dent into which the first ball comes; lengths, forces and
//!   times scaled, everything turned or mirrored, angles a turn further, loads and speeds in pieces.
//! Conditions: `run` with everything that the program chooses.
//! Parameters: [`SAME`] of the largest value: round-off that a dent lets grow, up to 7e-8 here; an error of a description is of the order of
//!   the change, 1e-3 and more.

use std::fs;
use std::path::Path;

use plummer::formats::NpzReader;

use super::program::scratch;
use super::relations::result;

/// Largest difference of signals that are equal in exact arithmetic, over the largest value.
const SAME: f64 = 1e-6;

/// Units of length, force and time that a case is written in, in SI.
#[derive(Clone, Copy)]
struct Units([f64; 3]);

impl Units {
    /// A number of these units' powers.
    fn of(&self, value: f64, powers: [i32; 3]) -> String {
        let factors = self.0.iter().zip(powers);
        let factor: f64 = factors.map(|(unit, power)| unit.powi(power)).product();
        format!("{:e}", value * factor)
    }
}

/// A bearing and what may be said of it in several ways.
#[derive(Clone)]
struct Scene {
    units: Units,
    /// Angle of everything, degrees; and 1, or -1 for a mirror on the vertical axis.
    turn: f64,
    side: f64,
    /// Added to every angle, and to the first ball's.
    more: f64,
    ball: f64,
    loads: &'static str,
    speed: &'static str,
    sensors: &'static str,
    more_keys: &'static str,
    /// What no mirror and no turn keeps: unbalance, a run-up and waves.
    uneven: bool,
}

const ONE: [f64; 2] = [3.0, -4.0];

impl Scene {
    fn new() -> Self {
        Self {
            units: Units([1.0; 3]),
            turn: 0.0,
            side: 1.0,
            more: 0.0,
            ball: 0.0,
            loads: "whole",
            speed: "one",
            sensors: "",
            more_keys: "",
            uneven: false,
        }
    }

    /// An angle as it is after mirror and turn, degrees.
    fn angle(&self, degrees: f64) -> f64 {
        let mirrored = if self.side < 0.0 { 180.0 - degrees } else { degrees };
        mirrored + self.turn + self.more
    }

    /// A vector after mirror and turn; turns are quarters, so that zeros stay.
    fn vector(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let x = self.side * x;
        match self.turn as i32 {
            0 => [x, y],
            90 => [-y, x],
            turn => panic!("{turn}"),
        }
    }

    fn text(&self) -> String {
        let u = |value: f64, powers: [i32; 3]| self.units.of(value, powers);
        let list = |vector: [f64; 2], powers| {
            let [x, y] = self.vector(vector).map(|part| u(part, powers));
            format!("[{x}, {y}]")
        };
        let (length, modulus, density) = ([1, 0, 0], [-2, 1, 0], [-4, 1, 2]);
        let (mass, force, hz) = ([-1, 1, 2], [0, 1, 0], [0, 0, -1]);
        let mut ends = [190.0, 320.0].map(|end| self.angle(end));
        ends.sort_by(f64::total_cmp);
        let load = |part: f64| format!("{{ force = {} }}", list(ONE.map(|f| part * f), force));
        let loads = match self.loads {
            "whole" => load(1.0),
            "halves" => format!("{0}, {0}", load(0.5)),
            _ => {
                let point = |time: f64| format!("{{ time = {}, force = {} }}", u(time, [0, 0, 1]), list(ONE, force));
                format!("{{ profile = [{}, {}] }}", point(0.0), point(1.0))
            }
        };
        let at = |time: f64| format!("{{ time = {}, hz = {} }}", u(time, [0, 0, 1]), u(20.0 * self.side, hz));
        let speed = match (self.uneven, self.speed) {
            (true, _) => format!("{}, {{ time = {}, hz = {} }}", at(0.0), u(2e-3, [0, 0, 1]), u(24.0, hz)),
            (_, "one") => at(0.0),
            _ => format!("{}, {}", at(0.0), at(1.0)),
        };
        let [x, y] = self.vector([0.0, 1.0]);
        format!(
            "[materials.m]\nyoung = {young}\npoisson = 0.3\ndensity = {rho}\n\
             [ring]\nnodes = 24\n\
             sections = [{{ material = 'm', area = {area}, inertia = {inertia}, radius = {radius} }}]\n\
             supports = [{{ from_deg = {from}, to_deg = {to}, spring = {{ x = {spring}, y = {spring} }} }}]\n\
             [bearing]\nballs = 7\nball_radius = {ball}\nball_material = 'm'\nrace_material = 'm'\n\
             inner_race_radius = {inner}\nouter_race_radius = {outer}\ninner_groove_radius = {ig}\nouter_groove_radius = {og}\n\
             radial_play = {play}\ncontact_damping = {damping}\nfirst_ball_deg = {first}\n{keys}{rough}\n\
             [shaft]\nmass = {mass}\nunbalance = {unbalance}\ngravity = {gravity}\nloads = [{loads}]\n\
             [damping]\nmodal = 0.03\n[speed]\nprofile = [{speed}]\n\
             [[sensors]]\nname = 'P1'\nring_deg = {top}\ndirection = [{x:e}, {y:e}, 0]\n{sensors}\n\
             [accuracy]\nband_hz = [0, {band}]\ntarget = 0.01\n\
             [transient]\nstart = 0\nend = {end}\noutput_hz = {rate}\n",
            young = u(210e9, modulus),
            rho = u(7850.0, density),
            area = u(17e-6, [2, 0, 0]),
            inertia = u(9e-12, [4, 0, 0]),
            radius = u(6e-3, length),
            from = ends[0],
            to = ends[1],
            spring = u(1e5, [-1, 1, 0]),
            ball = u(1e-3, length),
            inner = u(2.754e-3, length),
            outer = u(4.7565e-3, length),
            ig = u(1.04e-3, length),
            og = u(1.07e-3, length),
            play = u(-1.5e-6, length),
            damping = u(1.0, [-1, 0, 1]),
            first = self.angle(277.0) + self.ball,
            keys = self.more_keys,
            rough = match self.uneven {
                true => format!(
                    "waviness = [{{ on = 'inner', order = 9, amplitude = {}, phase_deg = 40 }}]",
                    u(0.2e-6, length)
                ),
                false => format!(
                    "\n[[bearing.defects]]\non = 'outer'\nangle_deg = {}\nlength = {}\ndepth = {}\nrim_radius = {}",
                    self.angle(284.0),
                    u(0.75e-3, length),
                    u(4e-6, length),
                    u(0.05e-3, length)
                ),
            },
            unbalance = u(if self.uneven { 2e-5 } else { 0.0 }, [0, 1, 2]),
            mass = u(0.15, mass),
            gravity = list([0.0, -9.81], [1, 0, -2]),
            top = self.angle(90.0),
            sensors = self.sensors,
            band = u(20e3, hz),
            end = u(2e-3, [0, 0, 1]),
            rate = u(200e3, hz),
        )
    }

    /// Instants, shaft and sensor: `time_s`, `shaft_x`, `shaft_y`, `P1`.
    fn signals(&self, folder: &Path) -> [Vec<f64>; 4] {
        fs::write(folder.join("case.toml"), self.text()).unwrap();
        let found = result(folder, "run", &[]);
        assert_eq!(found["status"], "complete");
        ["time_s", "shaft_x", "shaft_y", "P1"].map(|name| column(folder, name))
    }
}

fn column(folder: &Path, name: &str) -> Vec<f64> {
    let mut file = NpzReader::open(&folder.join("out/signals.npz")).unwrap();
    file.f64(name).unwrap().values
}

/// Largest difference from a factor of other values, over the largest of these.
fn apart(found: &[f64], expected: &[f64], factor: f64) -> f64 {
    assert_eq!(found.len(), expected.len());
    let most = expected.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let pairs = found.iter().zip(expected);
    let differences = pairs.map(|(found, expected)| (found - factor * expected).abs());
    differences.fold(0.0, f64::max) / (factor.abs() * most)
}

fn assert_same(what: &str, found: &[f64], expected: &[f64], factor: f64) {
    let apart = apart(found, expected, factor);
    println!("{what}: {apart:.1e}");
    assert!(apart < SAME, "{what}: {apart:e}");
}

/// A program that knows a length, a force or a time of its own gives other signals to a bearing that is similar.
#[test]
fn similar_bearings_have_similar_signals() {
    let folder = scratch("relations-units");
    for uneven in [false, true] {
        let even = Scene { uneven, ..Scene::new() };
        let one = even.signals(&folder);
        for units in [[4.0, 1.0, 1.0], [1.0, 4.0, 1.0], [1.0, 1.0, 4.0]] {
            let [length, _, time] = units;
            let mut scene = even.clone();
            scene.units = Units(units);
            let other = scene.signals(&folder);
            let factors = [time, length, length, length / time / time];
            for ((other, one), factor) in other.iter().zip(&one).zip(factors) {
                assert_same(&format!("{units:?}"), other, one, factor);
            }
        }
    }
}

#[test]
fn turned_and_mirrored_bearings_have_the_same_signals() {
    let folder = scratch("relations-sides");
    let [time, x, y, top] = Scene::new().signals(&folder);
    for (turn, side, more, ball) in [
        (90.0, 1.0, 0.0, 0.0),
        (0.0, -1.0, 0.0, 0.0),
        (90.0, -1.0, 0.0, 0.0),
        (0.0, 1.0, 360.0, 0.0),
        (0.0, 1.0, -720.0, 0.0),
        // the second ball in the place of the first
        (0.0, 1.0, 0.0, -360.0 / 7.0),
    ] {
        let scene = Scene { turn, side, more, ball, ..Scene::new() };
        let what = format!("{turn} {side} {more} {ball}");
        let other = scene.signals(&folder);
        let expected = match turn {
            0.0 => [(&x, side), (&y, 1.0)],
            _ => [(&y, -1.0), (&x, side)],
        };
        assert_same(&what, &other[0], &time, 1.0);
        for (found, (expected, sign)) in other[1..].iter().zip(expected) {
            assert_same(&what, found, expected, sign);
        }
        assert_same(&what, &other[3], &top, 1.0);
    }
}

#[test]
fn loads_and_speeds_in_pieces_are_the_whole() {
    let folder = scratch("relations-pieces");
    let one = Scene::new().signals(&folder);
    let zero_slip = "slip = { profile = [{ time = 0, slip = 0.0 }] }";
    for (loads, speed, more_keys) in [
        ("halves", "one", ""),
        ("profile", "one", ""),
        ("whole", "two", ""),
        ("whole", "one", zero_slip),
        ("whole", "one", "ball_radius_differences = [0, 0, 0, 0, 0, 0, 0]"),
    ] {
        let scene = Scene { loads, speed, more_keys, ..Scene::new() };
        let other = scene.signals(&folder);
        for (other, one) in other.iter().zip(&one) {
            assert_same(&format!("{loads} {speed} {more_keys}"), other, one, 1.0);
        }
    }
}

/// A sensor more, in the same place or in another, changes nothing but its own column; nor does a thread more.
#[test]
fn sensors_and_threads_leave_the_other_signals_alone() {
    let folder = scratch("relations-sensors");
    let bytes = |folder: &Path| fs::read(folder.join("out/signals.npz")).unwrap();
    let mut scene = Scene::new();
    let one = scene.signals(&folder);
    for threads in ["1", "2"] {
        let before = bytes(&folder);
        result(&folder, "run", &["--threads", threads]);
        assert!(before == bytes(&folder), "{threads} threads");
    }
    scene.sensors = "[[sensors]]\nname = 'P2'\nring_deg = 90\ndirection = [0, 1, 0]\n\
        [[sensors]]\nname = 'P3'\nring_deg = 90\ndirection = [0, -7, 0]";
    let other = scene.signals(&folder);
    for (other, one) in other.iter().zip(&one) {
        assert_same("beside others", other, one, 1.0);
    }
    let own = column(&folder, "P1");
    assert!(own == column(&folder, "P2"));
    let turned: Vec<f64> = column(&folder, "P3").iter().map(|x| -x).collect();
    assert!(own == turned);
}

/// A bearing looks the same when each ball has come to where the next one was, and at each whole turn of a flaw.
#[test]
fn a_bearing_comes_back_after_each_ball() {
    let folder = scratch("relations-time");
    let scene = Scene::new();
    let one = scene.signals(&folder);
    let orders = &result(&folder, "run", &[])["defect_orders"];
    let pass = 1.0 / (20.0 * orders["outer"].as_f64().unwrap());
    let begin = [format!("transient.start={pass:e}"), format!("transient.end={:e}", pass + 2e-3)];
    let words = ["--set", &begin[0], "--set", &begin[1]];
    let found = result(&folder, "run", &words);
    assert_eq!(found["status"], "complete");
    for (name, one) in ["shaft_x", "shaft_y", "P1"].iter().zip(&one[1..]) {
        assert_same(name, &column(&folder, name), one, 1.0);
    }
}
