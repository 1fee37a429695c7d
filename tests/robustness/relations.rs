//! Reference: the same question asked in another way, whose answer is known from that to the first.
//! Goal: numbers that are wrong for one way of asking alone are seen, where no closed form knows the right ones.
//! Sketch: an annulus of two parts on a foot, plane and solid, with a ring in its bore; numbers and order of nodes and elements, units, place,
//!   side, parts and materials are changed in turn.
//! Conditions: `modes` and `frf` as a user runs them.
//! Parameters: [`SAME`] between answers that are equal in exact arithmetic: modes are converged to relative residuals of 1e-5, the square of
//!   which is the error of a frequency, and meshes are written with all digits.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use serde_json::Value;

use super::Dice;
use super::mesh::{Mesh, Motion, annulus};
use super::program::{errors, plummer, scratch};

/// Largest relative difference of answers that are equal in exact arithmetic.
const SAME: f64 = 1e-8;

/// What is asked of a mesh: all of it follows the mesh's motion.
pub struct Question {
    pub mesh: Mesh,
    pub unit: &'static str,
    pub motion: Motion,
    /// Groups with their materials, in the order of the case.
    pub parts: Vec<(&'static str, &'static str)>,
    /// Factors of moduli and springs, and of densities.
    pub stiffness: f64,
    pub density: f64,
    /// How many equal supports and masses what stands on the foot is made of.
    pub pieces: usize,
}

impl Question {
    pub fn of(mesh: Mesh) -> Self {
        Self {
            mesh,
            unit: "m",
            motion: Motion::none(),
            parts: vec![("left", "hard"), ("right", "soft")],
            stiffness: 1.0,
            density: 1.0,
            pieces: 1,
        }
    }

    /// Writes mesh and case into a folder.
    pub fn write(&self, folder: &Path) {
        let place = |at: [f64; 3]| self.motion.place(at);
        let way = |along: [f64; 3]| self.motion.direction(along);
        fs::write(folder.join("mesh.msh"), self.mesh.text(&place)).unwrap();
        let mut text = String::new();
        for (name, young, density) in [("hard", 200e9, 8000.0), ("soft", 70e9, 2700.0)] {
            let (young, density) = (young * self.stiffness, density * self.density);
            writeln!(text, "[materials.{name}]\nyoung = {young:e}\npoisson = 0.3\ndensity = {density:e}").unwrap();
        }
        let parts: Vec<String> = self
            .parts
            .iter()
            .map(|(group, material)| format!("{{ group = '{group}', material = '{material}' }}"))
            .collect();
        let stiffness = 1e6 * self.stiffness / self.pieces as f64;
        let (plane, z) = match self.mesh.solid {
            true => ("", format!(", z = {:e}", stiffness)),
            false => ("plane = { assumption = 'stress', thickness = 4e-3 }\n", String::new()),
        };
        let spring = format!("{{ x = {stiffness:e}, y = {stiffness:e}{z} }}");
        let support = format!("{{ group = 'foot', spring = {spring}, per = 'group' }}");
        let mass = 2e-3 * self.density / self.pieces as f64;
        let mass = format!("{{ group = 'foot', mass = {mass:e} }}");
        let [supports, masses] = [support, mass].map(|one| vec![one; self.pieces].join(", "));
        // the force and the sensor's direction lie in no plane of symmetry
        write!(
            text,
            "[housing]\nmesh = 'mesh.msh'\nlength_unit = '{unit}'\n{plane}parts = [{parts}]\n\
             supports = [{supports}]\nmasses = [{masses}]\n\
             [ring]\nnodes = 16\nouter_radius = 6e-3\n\
             sections = [{{ material = 'hard', area = 5e-6, inertia = 9e-13, radius = 5.3e-3 }}]\n\
             tie = {{ group = 'bore', centre = {centre:?}, axis = {axis:?}, zero_deg = {zero:?} }}\n\
             [damping]\nratios = [{{ frequency_hz = 2000, ratio = 0.02 }}, {{ frequency_hz = 20000, ratio = 0.02 }}]\n\
             [[sensors]]\nname = 'P1'\npoint = {point:?}\ndirection = {seen:?}\n\
             [[sensors]]\nname = 'P2'\nring_deg = 135\ndirection = {felt:?}\n\
             [frf]\nfrom = [{{ name = 'F2', ring_deg = 135, direction = {felt:?} }}, {{ name = 'F1', point = {point:?}, direction = {seen:?} }}]\nto = ['P1', 'P2']\nband_hz = [0, 20000]\ncheck_hz = []\n\
             [condense]\nfixed_interface_modes = 12\n[modes]\ncount = 12\n",
            unit = self.unit,
            parts = parts.join(", "),
            centre = place([0.0; 3]),
            axis = way([0.0, 0.0, 1.0]),
            zero = way([1.0, 0.0, 0.0]),
            point = place([9e-3, 0.0, 0.0]),
            seen = way([0.6, 0.8, 0.0]),
            felt = way([0.8, -0.6, 0.0]),
        )
        .unwrap();
        fs::write(folder.join("case.toml"), text).unwrap();
    }

    /// Frequencies of the modes in Hz, then magnitudes of the four paths at their largest.
    pub fn answer(&self, folder: &Path) -> Vec<f64> {
        self.write(folder);
        let mut found = frequencies(&result(folder, "modes", &[]));
        let responses = result(folder, "frf", &[]);
        found.extend(paths(&responses).iter().map(|path| {
            let sizes = path.iter().map(|[re, im]| re.hypot(*im));
            sizes.fold(0.0, f64::max)
        }));
        found
    }
}

/// What a command prints with `--json`.
pub fn result(folder: &Path, command: &str, more: &[&str]) -> Value {
    let words = [command, "case.toml", "--json", "--force", "--out", "out"];
    let output = plummer(folder, &[&words, more].concat());
    let said = errors(&output);
    assert_eq!(output.status.code(), Some(0), "{command} {more:?}: {said}");
    serde_json::from_slice(&output.stdout).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    let values = value.as_array().unwrap().iter();
    values.map(|number| number.as_f64().unwrap()).collect()
}

fn frequencies(result: &Value) -> Vec<f64> {
    numbers(&result["frequencies_hz"])
}

fn paths(result: &Value) -> Vec<Vec<[f64; 2]>> {
    let paths = result["paths"].as_array().unwrap().iter();
    let pairs = |path: &Value| {
        let both = numbers(&path["re"]).into_iter().zip(numbers(&path["im"]));
        both.map(|(re, im)| [re, im]).collect()
    };
    paths.map(pairs).collect()
}

/// Largest relative difference of positive numbers from factors of others.
pub fn apart(found: &[f64], expected: &[f64], factor: f64) -> f64 {
    assert_eq!(found.len(), expected.len());
    let pairs = found.iter().zip(expected);
    pairs.map(|(found, expected)| (found / (factor * expected) - 1.0).abs()).fold(0.0, f64::max)
}

/// The plane and the solid question.
fn questions() -> [Question; 2] {
    [false, true].map(|solid| Question::of(annulus(solid)))
}

#[test]
fn numbers_and_order_of_nodes_elements_and_parts_play_no_part() {
    let folder = scratch("relations-order");
    for mut question in questions() {
        let before = question.answer(&folder);
        question.mesh.shuffle(&mut Dice(3));
        question.parts.reverse();
        let after = question.answer(&folder);
        assert!(apart(&after, &before, 1.0) < SAME, "{before:?} {after:?}");
    }
}

#[test]
fn place_side_and_unit_of_a_mesh_play_no_part() {
    let folder = scratch("relations-place");
    for mut question in questions() {
        let solid = question.mesh.solid;
        let before = question.answer(&folder);
        question.motion = Motion::turned(solid);
        let after = question.answer(&folder);
        assert!(apart(&after, &before, 1.0) < SAME, "{before:?} {after:?}");
        question.motion = Motion::none();
        for (unit, metre) in [("mm", 1e3), ("in", 1.0 / 0.0254)] {
            (question.unit, question.mesh.metre) = (unit, metre);
            let after = question.answer(&folder);
            assert!(apart(&after, &before, 1.0) < SAME, "{before:?} {after:?}");
        }
        // the other side: what a mirror shows vibrates alike; `y` of the frame is that of the mirror by axis and zero alone
        (question.unit, question.mesh.metre) = ("m", 1.0);
        question.mesh.mirror();
        let after = frequencies(&{
            question.write(&folder);
            result(&folder, "modes", &[])
        });
        assert!(apart(&after, &before[..after.len()], 1.0) < SAME, "{before:?} {after:?}");
    }
}

#[test]
fn pieces_of_parts_springs_and_masses_add_up() {
    let folder = scratch("relations-materials");
    for mut question in questions() {
        let before = question.answer(&folder);
        let count = before.len() - 4;
        question.mesh.split("left", "rest");
        question.parts.push(("rest", "hard"));
        question.pieces = 2;
        let after = question.answer(&folder);
        assert!(apart(&after, &before, 1.0) < SAME, "{before:?} {after:?}");
        // twice of both: the same frequencies, half of the responses
        (question.stiffness, question.density) = (2.0, 2.0);
        let after = question.answer(&folder);
        assert!(apart(&after[..count], &before[..count], 1.0) < SAME);
        assert!(apart(&after[count..], &before[count..], 0.5) < 1e-6);
        // four times as stiff: twice the frequencies
        (question.stiffness, question.density) = (4.0, 1.0);
        question.write(&folder);
        let after = frequencies(&result(&folder, "modes", &[]));
        assert!(apart(&after, &before[..count], 2.0) < SAME);
    }
}

/// Maxwell and Betti: force and sensor may change places.
#[test]
fn responses_are_the_same_both_ways() {
    let folder = scratch("relations-reciprocity");
    for question in questions() {
        question.write(&folder);
        let found = result(&folder, "frf", &[]);
        let path = |from: &str, to: &str| {
            let all = found["paths"].as_array().unwrap();
            let ends = |path: &Value| path["from"] == *from && path["to"] == *to;
            let place = all.iter().position(ends);
            paths(&found)[place.unwrap_or_else(|| panic!("{from} to {to} of {all:?}"))].clone()
        };
        let (there, back) = (path("F1", "P2"), path("F2", "P1"));
        let most = there.iter().fold(0.0, |most: f64, [re, im]| most.max(re.hypot(*im)));
        for (there, back) in there.iter().zip(&back) {
            let apart = (there[0] - back[0]).hypot(there[1] - back[1]);
            assert!(apart < SAME * most, "{there:?} {back:?}");
        }
    }
}

/// A force in the plane of symmetry moves nothing across it: the path is said to be closed and is no error.
#[test]
fn a_path_that_symmetry_closes_is_said() {
    let folder = scratch("relations-closed");
    let mut question = Question::of(annulus(false));
    question.parts[1].1 = "hard";
    question.write(&folder);
    let force = "frf.from=[{ name = 'F', ring_deg = 90, direction = [0, 1, 0] }]";
    let sensor = "sensors=[{ name = 'P2', ring_deg = 90, direction = [1, 0, 0] }, { name = 'P1', ring_deg = 90, direction = [0, 1, 0] }]";
    let words = ["--set", force, "--set", sensor];
    let found = result(&folder, "frf", &words);
    let closed = found["paths"].as_array().unwrap().iter();
    let closed = closed.map(|path| (&path["to"], &path["closed"]));
    assert!(closed.eq([(&"P2".into(), &true.into()), (&"P1".into(), &false.into())]));
    let line = ["frf", "case.toml", "--force", "--out", "out"];
    let output = plummer(&folder, &[&line, &words[..]].concat());
    let said = "carries less than 1e-7 of the responses at its ends";
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains(&format!("F to P2: {said}")), "{text}");
    let page = fs::read_to_string(folder.join("out/report.html")).unwrap();
    assert!(page.contains(said));
}

/// A housing that was condensed is the housing, as far as its vectors go; with all of them it is the whole.
#[test]
fn a_superelement_vibrates_as_what_it_was_made_of() {
    let folder = scratch("relations-superelement");
    for question in questions() {
        question.write(&folder);
        let whole = frequencies(&result(&folder, "modes", &[]));
        // enough for all of the plane mesh, and for digits of the solid one
        let set = ["condense.fixed_interface_modes=120", "accuracy.band_hz=[0,5000]"];
        result(&folder, "condense", &["--set", set[0], "--set", set[1]]);
        fs::copy(folder.join("out/superelement.npz"), folder.join("element.npz")).unwrap();
        let case = fs::read_to_string(folder.join("case.toml")).unwrap();
        let (materials, ring) = (case.find("[housing]").unwrap(), case.find("[ring]").unwrap());
        let after = case[ring..].find("[damping]").unwrap() + ring;
        let ring = case[ring..after].lines().filter(|line| !line.starts_with("tie"));
        let text = format!(
            "{}[housing]\nsuperelement = 'element.npz'\n{}\n[modes]\ncount = 12\n",
            &case[..materials],
            ring.collect::<Vec<_>>().join("\n")
        );
        fs::write(folder.join("case.toml"), text).unwrap();
        let modes = result(&folder, "modes", &[]);
        // some of the twelve are above the band, which the file says
        let warning = modes["warnings"].to_string();
        let said = "good up to 5000.0 Hz, the band that it was condensed for";
        assert!(warning.contains(said), "{warning}");
        let condensed = frequencies(&modes);
        let limit = if question.mesh.solid { 1e-4 } else { 1e-6 };
        let apart = apart(&condensed, &whole, 1.0);
        println!("{apart:e}");
        assert!(apart < limit, "{whole:?} {condensed:?}");
        assert!(condensed.iter().zip(&whole).all(|(c, w)| *c > (1.0 - SAME) * w));
    }
}

/// A question in another order, another place and another unit.
pub fn ask_at_random(dice: &mut Dice) {
    let folder = scratch("relations-random");
    let mut question = Question::of(annulus(dice.below(2) == 0));
    question.mesh.scatter(dice);
    let before = question.answer(&folder);
    question.mesh.shuffle(dice);
    question.motion = Motion::at_random(question.mesh.solid, dice);
    (question.unit, question.mesh.metre) = *dice.of(&[("m", 1.0), ("cm", 1e2), ("mm", 1e3), ("um", 1e6)]);
    if dice.below(2) == 0 {
        question.mesh.split("right", "rest");
        question.parts.push(("rest", "soft"));
    }
    let after = question.answer(&folder);
    assert!(apart(&after, &before, 1.0) < SAME, "{before:?} {after:?}");
}
