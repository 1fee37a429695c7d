//! Where condensation fails, from outside: each scene ends right or in an error that names what was found and what to do.
//!
//! Reference: closed forms where there are some, else the full model (`--compare-full`) or the same body meshed well.
//! Goal: no scene ends silently wrong; wrong input has exit code 2, a failed check or computation 1.
//! Sketch: a column of 3 x 3 x 5 cubes of 1 cm, a block of 2 x 2 x 2 beside it, an annulus 6-9 mm of 16 cells; written as
//!   MSH 2.2 and condensed by the program.
//! Conditions: named in each test.
//! Parameters: aluminium of the program's own.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use serde_json::Value;

use super::common::errors;

/// Side of a cube, m.
const SIDE: f64 = 0.01;

/// Density of the program's own aluminium, kg/m^3.
const DENSITY: f64 = 2700.0;

const FLOOR: &str = "{ group = \"floor\", fixed = [\"x\", \"y\", \"z\"] }";
const TOP: &str = "{ group = \"top\" }";

/// Hex8 cells on a lattice. Cells of one copy share the nodes of the lattice, those of different copies none.
struct Cells {
    place: fn([usize; 3]) -> [f64; 3],
    /// Cells around, where the first axis goes round.
    around: Option<usize>,
    tags: BTreeMap<(usize, [usize; 3]), usize>,
    /// Tag, point.
    nodes: Vec<[f64; 3]>,
    /// Group, gmsh's type, nodes.
    elements: Vec<(usize, u32, Vec<usize>)>,
    /// Dimension, name.
    groups: Vec<(usize, &'static str)>,
}

impl Cells {
    fn new(place: fn([usize; 3]) -> [f64; 3], around: Option<usize>) -> Self {
        Self { place, around, tags: BTreeMap::new(), nodes: Vec::new(), elements: Vec::new(), groups: Vec::new() }
    }

    /// Elements of the lattice from one corner to the other, a dimension for each axis along which these differ.
    fn add(mut self, group: &'static str, copy: usize, from: [usize; 3], to: [usize; 3]) -> Self {
        const RING: [[usize; 2]; 4] = [[0, 0], [1, 0], [1, 1], [0, 1]];
        let axes: Vec<usize> = (0..3).filter(|&axis| to[axis] > from[axis]).collect();
        let known = self.groups.iter().position(|known| known.1 == group);
        let number = known.unwrap_or_else(|| {
            self.groups.push((axes.len(), group));
            self.groups.len() - 1
        });
        let corners: Vec<Vec<usize>> = match axes.len() {
            0 => vec![vec![]],
            2 => RING.iter().map(|corner| corner.to_vec()).collect(),
            3 => (0..2).flat_map(|up| RING.map(|[i, j]| vec![i, j, up])).collect(),
            _ => panic!("points, faces or cells"),
        };
        let kind = [15, 0, 3, 5][axes.len()];
        let count = |axis: usize| (to[axis] - from[axis]).max(1);
        for cell in 0..count(0) * count(1) * count(2) {
            let first = [cell % count(0), cell / count(0) % count(1), cell / count(0) / count(1)];
            let nodes = corners.iter().map(|corner| {
                let mut at = [0, 1, 2].map(|axis| from[axis] + first[axis]);
                for (&axis, step) in axes.iter().zip(corner) {
                    at[axis] += step;
                }
                self.node(copy, at)
            });
            let nodes = nodes.collect();
            self.elements.push((number, kind, nodes));
        }
        self
    }

    fn node(&mut self, copy: usize, mut at: [usize; 3]) -> usize {
        if let Some(around) = self.around {
            at[0] %= around;
        }
        let nodes = &mut self.nodes;
        *self.tags.entry((copy, at)).or_insert_with(|| {
            nodes.push((self.place)(at));
            nodes.len()
        })
    }

    /// The mesh file, MSH 2.2 ASCII.
    fn text(&self) -> String {
        let mut text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n".to_owned();
        writeln!(text, "{}", self.groups.len()).unwrap();
        for (number, (dimension, name)) in (1..).zip(&self.groups) {
            writeln!(text, "{dimension} {number} \"{name}\"").unwrap();
        }
        writeln!(text, "$EndPhysicalNames\n$Nodes\n{}", self.nodes.len()).unwrap();
        for (tag, [x, y, z]) in (1..).zip(&self.nodes) {
            writeln!(text, "{tag} {x:e} {y:e} {z:e}").unwrap();
        }
        writeln!(text, "$EndNodes\n$Elements\n{}", self.elements.len()).unwrap();
        for (tag, (group, kind, nodes)) in (1..).zip(&self.elements) {
            let nodes: Vec<String> = nodes.iter().map(ToString::to_string).collect();
            let group = group + 1;
            writeln!(text, "{tag} {kind} 2 {group} {group} {}", nodes.join(" ")).unwrap();
        }
        text + "$EndElements\n"
    }
}

/// A column with groups at its top, which has corners, and floor, of which there is one half.
fn column_of(layers: usize, place: fn([usize; 3]) -> [f64; 3]) -> Cells {
    Cells::new(place, None)
        .add("body", 0, [0; 3], [3, 3, layers])
        .add("top", 0, [0, 0, layers], [3, 3, layers])
        .add("floor", 0, [0; 3], [3, 3, 0])
        .add("half", 0, [0; 3], [2, 3, 0])
        .add("corner", 0, [0, 0, layers], [0, 0, layers])
        .add("edge", 0, [0, 0, layers], [0, 0, layers])
        .add("edge", 0, [3, 0, layers], [3, 0, layers])
}

fn column() -> Cells {
    column_of(5, |at| at.map(|step| SIDE * step as f64))
}

/// The column and a lid whose floor is at the height of the column's.
fn column_and_lid() -> Cells {
    column().add("lid", 1, [5, 0, 0], [7, 2, 2]).add("lid floor", 1, [5, 0, 0], [7, 2, 0])
}

/// A bore of 12 mm, 4 mm long.
fn annulus() -> Cells {
    let place = |[around, out, along]: [usize; 3]| {
        let (sin, cos) = (TAU * around as f64 / 16.0).sin_cos();
        let radius = 6e-3 + 1.5e-3 * out as f64;
        // clockwise, so that the cells are not inside out
        [radius * cos, -radius * sin, 2e-3 * along as f64 - 2e-3]
    };
    Cells::new(place, Some(16))
        .add("body", 0, [0; 3], [16, 2, 2])
        .add("bore", 0, [0; 3], [16, 0, 2])
        .add("outside", 0, [0, 2, 0], [16, 2, 2])
        .add("cut", 0, [0; 3], [1, 2, 0])
}

/// What the program says of a case.
struct Said {
    code: i32,
    summary: String,
    /// Lines of standard error.
    error: String,
    json: Option<Value>,
}

impl Said {
    fn number(&self, list: &str, place: usize) -> f64 {
        self.json.as_ref().unwrap()[list][place].as_f64().unwrap()
    }
}

/// A folder of its own for a scene, with a mesh.
fn scene(name: &str, cells: &Cells) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("scene-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("a.msh"), cells.text()).unwrap();
    folder
}

fn run(folder: &PathBuf, case: &str, words: &[&str]) -> Said {
    fs::write(folder.join("a.toml"), case).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_plummer"))
        .current_dir(folder)
        .args(["condense", "a.toml", "--out", "out", "--force"])
        .args(words)
        .output()
        .unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    let code = output.status.code().unwrap();
    let json = fs::read_to_string(folder.join("out/condense.json")).ok();
    let json = json.filter(|_| code < 2);
    let _ = fs::remove_dir_all(folder.join("out"));
    Said {
        code,
        error: errors(&output),
        summary: text(output.stdout),
        json: json.map(|json| serde_json::from_str(&json).unwrap()),
    }
}

fn housing(parts: &[&str], supports: &str) -> String {
    let part = |name: &&str| format!("{{ group = \"{name}\", material = \"aluminium\" }}");
    let parts: Vec<String> = parts.iter().map(part).collect();
    format!(
        "[housing]\nmesh = \"a.msh\"\nlength_unit = \"m\"\nparts = [{}]\nsupports = [{supports}]\n",
        parts.join(", ")
    )
}

/// Of the column alone.
fn on(interface: &str, supports: &str) -> String {
    format!("{}[condense]\ninterface = {interface}\n", housing(&["body"], supports))
}

/// Of column and lid.
fn with_lid(interface: &str, supports: &str) -> String {
    let housing = housing(&["body", "lid"], supports);
    format!("{housing}[condense]\ninterface = {interface}\n")
}

fn refused(said: &Said, lines: &str) {
    assert_eq!(said.error, lines);
    assert_eq!((said.code, said.summary.as_str()), (2, ""));
}

#[test]
fn a_band_above_the_kept_modes_fails_its_certificate() {
    let folder = scene("band", &column());
    let case = |modes: &str, top: f64| {
        let on = on(TOP, FLOOR);
        format!("{on}fixed_interface_modes = {modes}\n[accuracy]\nband_hz = [0, {top}]\n")
    };
    // the lowest fixed-interface mode is at 28.3 kHz
    for modes in ["0", "2", "{ up_to_hz = 1000 }"] {
        let said = run(&folder, &case(modes, 60e3), &["--quiet"]);
        assert_eq!(said.code, 1, "{modes}");
        for part in [
            "error: band covered: found 0.472, expected at least 1 (frequency up to which all fixed-interface modes are kept (28321 Hz) / top of the band (60000 Hz))",
            "; estimated error: found ",
            "expected at most 0.01 (largest estimated relative error of the 10 frequencies in the band)",
            "\nhelp: more vectors (condense.fixed_interface_modes) or a narrower band (accuracy.band_hz)",
        ] {
            assert!(said.error.contains(part), "{modes}: {}", said.error);
        }
        assert!(said.json.is_some(), "the results are written");
    }
    // all vectors that there are: nothing is left above
    let said = run(&folder, &case("400", 60e3), &[]);
    assert_eq!((said.code, said.error.as_str()), (0, ""));
    let count = |name: &str| said.json.as_ref().unwrap()[name].as_u64().unwrap();
    let vectors = count("fixed_interface_modes") + count("residual_vectors");
    assert_eq!(vectors, count("interior_dof"));
}

/// An interface of which a support holds all, half, or one direction.
#[test]
fn an_interface_that_a_support_clamps() {
    let folder = scene("clamped", &column());
    refused(
        &run(&folder, &on("{ group = \"floor\" }", FLOOR), &[]),
        "error: condense.interface: all 48 displacements of its nodes are held by the support \"floor\": expected at \
         least one that is free\n\
         help: name other nodes in condense.interface, or take the support off them\n",
    );
    for (fixed, held, left) in [("[\"x\", \"y\", \"z\"]", 36, 12), ("[\"z\"]", 12, 36), ("[\"x\", \"y\"]", 24, 24)] {
        let support = format!("{{ group = \"half\", fixed = {fixed} }}");
        let case = on("{ group = \"floor\" }", &support);
        let said = run(&folder, &case, &["--compare-full"]);
        assert_eq!((said.code, said.error.as_str()), (0, ""), "{fixed}");
        let line =
            format!("{held} displacements of the interface's nodes are no coordinates: held by the support \"half\"\n");
        assert!(said.summary.contains(&line), "{}", said.summary);
        let json = said.json.unwrap();
        assert_eq!(json["interface_dof"], left);
        let errors = json["relative_error"].as_array().unwrap().iter();
        let errors: Vec<f64> = errors.filter_map(Value::as_f64).collect();
        assert!(!errors.is_empty());
        // the default target of condense.fixed_interface_modes = "auto"
        assert!(errors.iter().all(|error| *error < 0.01), "{errors:?}");
    }
}

/// Every mesh with a ring: the annulus and a ring of steel in its bore.
fn ring(supports: &str, outer_radius: f64, centre: &str) -> String {
    let housing = housing(&["body"], supports);
    format!(
        "{housing}[ring]\nnodes = 16\nouter_radius = {outer_radius}\n\
         sections = [{{ material = \"steel\", area = 5.37e-6, inertia = 8.88e-13, radius = 5.314e-3 }}]\n\
         tie = {{ group = \"bore\", centre = {centre}, axis = [0, 0, 1], zero_deg = [1, 0, 0] }}\n"
    )
}

const OUTSIDE: &str = "{ group = \"outside\", fixed = [\"x\", \"y\", \"z\"] }";

#[test]
fn a_bore_that_a_support_clamps_or_that_the_ring_does_not_reach() {
    let folder = scene("bore", &annulus());
    let centre = "[0, 0, 0]";
    // a sliding bore turns about the axis and moves along it, whatever the ring does
    let sliding = ring("", 6e-3, centre).replace("tie = {", "tie = { fit = \"sliding\",");
    let springs = "supports = [{ from_deg = 0, to_deg = 360, spring = { x = 1e6, y = 1e6, z = 1e6 } }]\n";
    let sliding = sliding + springs;
    let said = run(&folder, &sliding, &[]);
    let body = "is held, but can still move: 2 motions without stiffness\nhelp: join the part";
    assert!(said.error.contains(body) && said.code == 2, "{}", said.error);
    let cut = "{ group = \"cut\", fixed = [\"x\"] }";
    refused(
        &run(&folder, &ring(cut, 6e-3, centre), &[]),
        "error: a.msh: node 1 is tied by group \"bore\" and fixed by group \"cut\": a node can be one or the other; take \
         it out of one of the groups in gmsh, or support the housing elsewhere\n",
    );
    refused(
        &run(&folder, &ring(OUTSIDE, 6.1e-3, centre), &[]),
        "error: the tie finds no nodes of group \"bore\" (a.msh) at the ring's outer radius 0.0061 m: they lie \
         0.006 to 0.006 m from the axis through (0, 0, 0) m along (0, 0, 1); check length_unit, \
         tie.centre, tie.axis and ring.outer_radius\n",
    );
    refused(
        &run(&folder, &ring(OUTSIDE, 6e-3, "[1e-3, 0, 0]"), &[]),
        "error: the tie finds no nodes of group \"bore\" (a.msh) at the ring's outer radius 0.006 m: they lie \
         0.005 to 0.007 m from the axis through (0.001, 0, 0) m along (0, 0, 1); check length_unit, \
         tie.centre, tie.axis and ring.outer_radius\n",
    );
    refused(
        &run(&folder, &ring(OUTSIDE, 6e-3, "[0, 0, 5e-3]"), &[]),
        "error: the ring's plane, through (0, 0, 0.005) m across (0, 0, 1), does not cut the group \"bore\" (a.msh) \
         that it is tied to: its nodes lie -0.007 to -0.003 m from there along the axis, expected on both \
         sides; check length_unit and tie.centre\n",
    );
    // a ring 0.8 % of the radius beside the bore, and one at the bore's end, are in it
    for (outer_radius, centre) in [(6.05e-3, centre), (6e-3, "[0, 0, 2e-3]")] {
        let said = run(&folder, &ring(OUTSIDE, outer_radius, centre), &[]);
        assert_eq!((said.code, said.error.as_str()), (0, ""));
    }
}

const JOIN: &str = "help: join the part (merge its nodes in gmsh, housing.links), hold it (housing.supports), put three of \
    its nodes that are not in line into the interface, or leave it out of housing.parts\n";

#[test]
fn a_part_that_hangs_on_nothing_is_named() {
    let start = "error: with the interface held, the housing can still move, so that it cannot be condensed: ";
    let folder = scene("loose", &column_and_lid());
    let lid = "part \"lid\" (8 elements, near x = 0.0600, y = 0.0100, z = 0.0100 m)";
    refused(
        &run(&folder, &with_lid(TOP, FLOOR), &[]),
        &format!("{start}{lid} is not connected: 6 extra rigid modes\n{JOIN}"),
    );
    // what hangs on the interface alone may be free, but not beside a part that is held
    let held = "{ group = \"lid floor\", fixed = [\"x\", \"y\", \"z\"] }";
    let said = run(&folder, &with_lid(TOP, held), &["--quiet"]);
    assert_eq!(said.code, 1);
    let body =
        "part \"body\" (45 elements, near x = 0.0150, y = 0.0150, z = 0.0250 m) is not connected: 6 extra rigid modes";
    assert!(said.error.starts_with("error: held: found "), "{}", said.error);
    assert!(said.error.contains(body), "{}", said.error);
    // joined along an edge
    let folder = scene("hinged", &column().add("lid", 0, [3, 0, 5], [5, 3, 7]));
    let said = run(&folder, &with_lid(TOP, FLOOR), &[]);
    let hinge = format!("{start}\"body\" and \"lid\" are joined along an edge only (nodes ");
    assert!(said.error.starts_with(&hinge), "{}", said.error);
    assert!(said.error.ends_with(&format!("): 1 mechanism\n{JOIN}")));
    assert_eq!(said.code, 2);
}

/// A lid on springs of any stiffness: its frequency up and down is that of a rigid body, or it is refused by name.
#[test]
fn a_part_on_soft_springs_is_right_or_refused() {
    let folder = scene("soft", &column_and_lid());
    let mass = DENSITY * 8.0 * SIDE.powi(3);
    let mut ends = Vec::new();
    for exponent in [-6, -3, -1, 1, 3, 5] {
        let k = 10_f64.powi(exponent);
        let spring = format!(
            "{FLOOR}, {{ group = \"lid floor\", per = \"group\", spring = {{ x = {k:e}, y = {k:e}, z = {k:e} }} }}"
        );
        let case = with_lid(TOP, &spring) + "[accuracy]\nband_hz = [0, 20000]\n";
        let said = run(&folder, &case, &["--quiet"]);
        ends.push(said.code);
        match said.code {
            0 => {
                // up and down is the third: it swings and turns below
                let found = said.number("interior_frequencies_hz", 2);
                let exact = (k / mass).sqrt() / TAU;
                // the lid is not rigid: 1e5 N/m on its floor shift 5e-4 of it, in proportion to k
                let tolerance = 1e-7 + 5e-9 * k;
                assert!((found / exact - 1.0).abs() < tolerance, "{k:e}: {found} {exact}");
            }
            1 => assert!(
                said.error.starts_with("error: vectors diagonalise: found ")
                    && said.error.contains("a part is loose or held very softly"),
                "{k:e}: {}",
                said.error
            ),
            _ => {
                let start = "error: part \"lid\", near node ";
                let what =
                    ": with the interface held, part of the housing is held so softly, or has elements so flat, that ";
                let help =
                    "help: check the units of the springs that hold it and its flattest elements (`plummer inspect`)";
                for part in [start, what, help] {
                    assert!(said.error.contains(part), "{k:e}: {}", said.error);
                }
            }
        }
    }
    // too soft and stiff enough are both met
    assert_eq!((ends.first(), ends.last()), (Some(&2), Some(&0)), "{ends:?}");
}

/// A layer of the column, thinner and thinner: the frequencies of the column without it, or an error. From about 1e-10 m on,
/// round-off of its stiffness is that of the checks.
#[test]
fn flat_elements_are_right_or_refused() {
    let meshes: [fn([usize; 3]) -> [f64; 3]; 5] = [
        |at| layered(at, 1e-4),
        |at| layered(at, 1e-7),
        |at| layered(at, 1e-9),
        |at| layered(at, 1e-12),
        |at| layered(at, 1e-15),
    ];
    let reference = run(&scene("no-layer", &column()), &on(TOP, FLOOR), &["--quiet"]);
    let mut ends = Vec::new();
    for place in meshes {
        let said = run(&scene("flat", &column_of(6, place)), &on(TOP, FLOOR), &["--quiet"]);
        if said.code == 0 {
            for list in ["interior_frequencies_hz", "frequencies_hz"] {
                let (found, expected) = (said.number(list, 0), reference.number(list, 0));
                // the layer takes its thickness from the next one: 0.1 mm shift 3e-4
                assert!((found / expected - 1.0).abs() < 5e-4, "{found} {expected}");
            }
        }
        ends.push((said.code, said.error.split([':', '\n']).nth(1).unwrap_or("").to_owned()));
    }
    assert_eq!(ends.iter().map(|end| end.0).collect::<Vec<_>>(), [0, 0, 0, 1, 2], "{ends:?}");
}

/// The full model of a flat layer has no modes that satisfy their equation: what was condensed is written, and a check says so.
#[test]
fn a_comparison_that_cannot_be_computed_is_a_check_that_fails() {
    let flat = column_of(6, |at| layered(at, 1e-12));
    let said = run(&scene("no-full-model", &flat), &on(TOP, FLOOR), &["--quiet", "--compare-full"]);
    assert_eq!(said.code, 1);
    for part in [
        "error: vectors diagonalise: found ",
        "; frequencies: found \u{221e}, expected at most 0.01 (the comparison with the full model could not be computed: mode 0 \
         leaves a relative residual of ",
    ] {
        assert!(said.error.contains(part), "{}", said.error);
    }
    let json = said.json.unwrap();
    assert!(json["full_frequencies_hz"].is_null() && !json["frequencies_hz"].as_array().unwrap().is_empty());
}

fn layered([x, y, z]: [usize; 3], thin: f64) -> [f64; 3] {
    let height = match z {
        0..3 => SIDE * z as f64,
        3 => 2.0 * SIDE + thin,
        _ => SIDE * (z - 1) as f64,
    };
    [SIDE * x as f64, SIDE * y as f64, height]
}

#[test]
fn an_interface_of_all_nodes_or_of_too_few() {
    let folder = scene("few", &column());
    refused(
        &run(&folder, &on("{ group = \"body\" }", ""), &[]),
        "error: the interface takes every free displacement of the housing, so that nothing is left to condense: expected \
         an interface of fewer nodes, or a finer mesh\n",
    );
    let start = "error: with the interface held, the housing can still move, so that it cannot be condensed: part \"body\" \
        (45 elements, near x = 0.0150, y = 0.0150, z = 0.0250 m) is held, but can still move: ";
    refused(
        &run(&folder, &on("{ group = \"corner\" }", ""), &[]),
        &format!("{start}3 motions without stiffness\n{JOIN}"),
    );
    refused(&run(&folder, &on("{ group = \"edge\" }", ""), &[]), &format!("{start}1 motion without stiffness\n{JOIN}"));
    // one node is enough for a housing that is held
    let said = run(&folder, &on("{ group = \"corner\" }", FLOOR), &["--compare-full"]);
    assert_eq!((said.code, said.error.as_str()), (0, ""));
    assert_eq!(said.json.unwrap()["interface_dof"], 3);
}

#[test]
fn nodes_twice_or_none_are_refused_by_place() {
    let folder = scene("nodes", &column());
    let line = |nodes: &str| run(&folder, &on(&format!("{{ nodes = [{nodes}] }}"), FLOOR), &[]);
    refused(
        &line("81, 82, 81"),
        "error: a.toml:7: `condense.interface.nodes[2]`: \"81\" stands here a second time, expected each once\n",
    );
    refused(&line(""), "error: a.toml:7: `condense.interface.nodes`: found nothing, expected at least one node\n");
    refused(&line("81, 1000"), "error: condense.interface.nodes[1]: the mesh has no node 1000\n");
}
