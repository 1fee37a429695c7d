//! Reference: masses of blocks in closed form; the places where the meshes below were made wrong.
//! Goal: a mesh that counts material twice, or whose bodies touch unconnected, is never computed in silence.
//! Sketch: blocks of Hex8 in MSH 2.2, written here, with one thing wrong each; every block is held, so that no free body
//!   gives it away.
//! Conditions: the program as a user runs it. Parameters: none; there is no tolerance.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Output;

use super::program::{errors, plummer, scratch};

/// A mesh under construction: nodes, elements as their lines without a number, names of groups.
#[derive(Default)]
struct Blocks {
    nodes: Vec<[f64; 3]>,
    elements: Vec<String>,
    names: String,
}

impl Blocks {
    /// Adds a cube of side 0.1 m from `corner` (m), in `cells` along each side, as the volumes of one group and entity, and its
    /// bottom as the group `NAME_bottom`. Returns the lines of the volumes.
    fn cube(&mut self, group: usize, name: &str, corner: [f64; 3], cells: usize) -> Vec<String> {
        let first = self.nodes.len() + 1;
        let side = cells + 1;
        for z in 0..side {
            for y in 0..side {
                for x in 0..side {
                    let at = [x, y, z].map(|i| 0.1 * i as f64 / cells as f64);
                    self.nodes.push([0, 1, 2].map(|axis| corner[axis] + at[axis]));
                }
            }
        }
        let node = |x: usize, y: usize, z: usize| first + x + side * (y + side * z);
        let _ = writeln!(self.names, "3 {group} \"{name}\"\n2 {} \"{name}_bottom\"", group + 10);
        let mut volumes = Vec::new();
        for z in 0..cells {
            for y in 0..cells {
                for x in 0..cells {
                    let ring = |z| {
                        format!(
                            "{} {} {} {}",
                            node(x, y, z),
                            node(x + 1, y, z),
                            node(x + 1, y + 1, z),
                            node(x, y + 1, z)
                        )
                    };
                    if z == 0 {
                        let bottom = group + 10;
                        self.elements.push(format!("3 2 {bottom} {bottom} {}", ring(0)));
                    }
                    volumes.push(format!("{} {}", ring(z), ring(z + 1)));
                }
            }
        }
        for nodes in &volumes {
            self.volume(group, group, nodes);
        }
        volumes
    }

    /// Adds a Hex8 of a group on an entity.
    fn volume(&mut self, group: usize, entity: usize, nodes: &str) {
        self.elements.push(format!("5 2 {group} {entity} {nodes}"));
    }

    /// Writes the mesh and a case of these parts, all of aluminium, each on springs at its bottom.
    fn write(&self, folder: &Path, parts: &[&str], more: &str) {
        let mut text = format!(
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n{}$EndPhysicalNames\n$Nodes\n{}\n",
            self.names.lines().count(),
            self.names,
            self.nodes.len()
        );
        for (tag, [x, y, z]) in (1..).zip(&self.nodes) {
            let _ = writeln!(text, "{tag} {x} {y} {z}");
        }
        let _ = writeln!(text, "$EndNodes\n$Elements\n{}", self.elements.len());
        for (tag, element) in (1..).zip(&self.elements) {
            let _ = writeln!(text, "{tag} {element}");
        }
        text.push_str("$EndElements\n");
        fs::write(folder.join("blocks.msh"), text).unwrap();
        let each = |form: &str| -> String {
            let all = parts.iter().map(|part| form.replace("PART", part));
            all.collect::<Vec<_>>().join(", ")
        };
        let bottoms = parts.iter().filter(|part| self.names.contains(&format!("\"{part}_bottom\"")));
        let bottoms =
            bottoms.map(|part| format!("{{ group = '{part}_bottom', spring = {{ x = 1e9, y = 1e9, z = 1e9 }} }}"));
        let case = format!(
            "[housing]\nmesh = 'blocks.msh'\nlength_unit = 'm'\nparts = [{}]\nsupports = [{}]\n{more}\n[modes]\ncount = 4\n",
            each("{ group = 'PART', material = 'aluminium' }"),
            bottoms.collect::<Vec<_>>().join(", ")
        );
        fs::write(folder.join("case.toml"), case).unwrap();
    }
}

fn modes(folder: &Path) -> Output {
    plummer(folder, &["modes", "case.toml", "--out", "out", "--force"])
}

fn inspect(folder: &Path) -> Output {
    plummer(folder, &["inspect", "blocks.msh", "--length-unit", "m"])
}

fn text(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

/// The input is refused with these words, by `modes` as wrong input and by `inspect` as a bad mesh.
fn refused(folder: &Path, words: &[&str]) {
    let (modes, inspect) = (modes(folder), inspect(folder));
    for (output, code) in [(&modes, 2), (&inspect, 1)] {
        let said = errors(output);
        assert_eq!(output.status.code(), Some(code), "{said}");
        for word in words {
            assert!(said.contains(word), "{word} in: {said}");
        }
    }
}

#[test]
fn an_element_of_two_parts_is_refused() {
    let folder = scratch("doubled-two-parts");
    let mut blocks = Blocks::default();
    let volumes = blocks.cube(1, "a", [0.0; 3], 3);
    let _ = writeln!(blocks.names, "3 2 \"b\"");
    // the same nodes, begun elsewhere, on another entity
    let turned: Vec<&str> = volumes[13].split(' ').collect();
    let turned = [&turned[1..4], &turned[..1], &turned[5..], &turned[4..5]].concat();
    blocks.volume(2, 7, &turned.join(" "));
    blocks.write(&folder, &["a", "b"], "");
    refused(&folder, &["1 element stands", "elements 23 and 37", "\"a\" and \"b\""]);
}

#[test]
fn an_element_listed_twice_in_one_part_is_refused() {
    let folder = scratch("doubled-one-part");
    let mut blocks = Blocks::default();
    let volumes = blocks.cube(1, "a", [0.0; 3], 3);
    blocks.volume(1, 1, &volumes[0]);
    blocks.write(&folder, &["a"], "");
    refused(&folder, &["1 element stands", "of \"a\"", "0.016667"]);
}

#[test]
fn a_mesh_of_nothing_but_doubles_is_refused_as_such() {
    let folder = scratch("doubled-all");
    let mut blocks = Blocks::default();
    for nodes in blocks.cube(1, "a", [0.0; 3], 3) {
        blocks.volume(1, 1, &nodes);
    }
    blocks.write(&folder, &["a"], "");
    refused(&folder, &["27 elements stand"]);
}

/// A block upon itself with nodes of its own: in the same cells, and in others, of which no node coincides but the corners.
#[test]
fn a_body_in_another_is_refused_unless_allowed() {
    for cells in [3, 4] {
        let folder = scratch(&format!("doubled-bodies-{cells}"));
        let mut blocks = Blocks::default();
        blocks.cube(1, "a", [0.0; 3], 3);
        blocks.cube(2, "b", [0.0; 3], cells);
        blocks.write(&folder, &["a", "b"], "");
        refused(&folder, &["the parts \"a\" and \"b\" lie in one another", "0.001 m^3", "housing.overlap"]);
        blocks.write(&folder, &["a", "b"], "overlap = 'allow'");
        let output = modes(&folder);
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        assert!(text(&output).contains("warning: the parts \"a\" and \"b\" lie in one another"));
    }
}

/// Two blocks side by side, with the same cells and with others: said on the terminal, in the result and in the report, with
/// a place on the common face, which is at x = 0.1 m; not where a tie or springs join them.
#[test]
fn parts_that_touch_without_a_link_are_said() {
    for (cells, pairs) in [(3, 16), (2, 4)] {
        let folder = scratch(&format!("doubled-touching-{cells}"));
        let mut blocks = Blocks::default();
        blocks.cube(1, "a", [0.0; 3], 3);
        blocks.cube(2, "b", [0.1, 0.0, 0.0], cells);
        blocks.write(&folder, &["a", "b"], "");
        let output = modes(&folder);
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        let words = [
            "the parts \"a\" and \"b\" touch without common nodes".to_owned(),
            format!("{} faces on 0.01 m^2,", 9 + cells * cells),
            format!("{pairs} pairs of nodes in one place"),
            "the first at (0.1".to_owned(),
        ];
        let json = fs::read_to_string(folder.join("out/modes.json")).unwrap();
        let json: serde_json::Value = serde_json::from_str(&json).unwrap();
        let warning = json["warnings"][0].as_str().unwrap();
        let page = fs::read_to_string(folder.join("out/report.html")).unwrap();
        let seen = inspect(&folder);
        assert_eq!(seen.status.code(), Some(0), "{}", errors(&seen));
        for word in &words {
            assert!(text(&output).contains(word), "{}", text(&output));
            assert!(text(&seen).contains(word), "{}", text(&seen));
            assert!(warning.contains(word), "{warning}");
        }
        assert!(page.contains("touch without common nodes"));
        for link in ["tie = true", "spring = { x = 1e9 }"] {
            blocks.write(&folder, &["a", "b"], &format!("links = [{{ between = ['a', 'b'], {link} }}]"));
            let output = modes(&folder);
            assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
            assert!(!text(&output).contains("warning"), "{}", text(&output));
        }
    }
}

/// Commands that hand a model on say what is doubtful of it: on the terminal, in the result and, of a sweep, in the report.
#[test]
fn export_and_sweep_say_what_modes_say() {
    let folder = scratch("doubled-handed-on");
    let mut blocks = Blocks::default();
    blocks.cube(1, "a", [0.0; 3], 2);
    blocks.cube(2, "b", [0.1, 0.0, 0.0], 2);
    blocks.write(&folder, &["a", "b"], "");
    let vary = ["--vary", "modes.count=4,5"];
    for (command, words) in
        [("export", &["--to", "mtx"][..]), ("sweep", &[&["--command", "modes"], &vary[..]].concat())]
    {
        let line = [&[command, "case.toml", "--out", command], words].concat();
        let output = plummer(&folder, &line);
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        let said = "the parts \"a\" and \"b\" touch without common nodes";
        assert!(text(&output).contains(said), "{}", text(&output));
        let json = fs::read_to_string(folder.join(format!("{command}/{command}.json"))).unwrap();
        let json: serde_json::Value = serde_json::from_str(&json).unwrap();
        let warning = &json["warnings"][0];
        let warning = warning.as_str().or(warning["text"].as_str()).unwrap();
        assert!(warning.contains(said), "{warning}");
    }
    let page = fs::read_to_string(folder.join("sweep/report.html")).unwrap();
    assert!(page.contains("touch without common nodes"));
}

/// Reaching into one another by 1.3 mm, a twenty-fifth of a cell: no centre of an element lies in another one.
#[test]
fn parts_that_reach_into_one_another_by_little_are_said() {
    let folder = scratch("doubled-little");
    let mut blocks = Blocks::default();
    blocks.cube(1, "a", [0.0; 3], 3);
    blocks.cube(2, "b", [0.0987, 0.0, 0.0], 3);
    blocks.write(&folder, &["a", "b"], "");
    for output in [modes(&folder), inspect(&folder)] {
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        let words = "the parts \"a\" and \"b\" reach into one another: 9 pairs of elements do, by up to 0.0013 m";
        assert!(text(&output).contains(words), "{}", text(&output));
    }
}

/// Apart by less than a hundredth of a cell, or joined by common nodes: nothing is said.
#[test]
fn parts_that_do_not_touch_are_not_said_to() {
    let folder = scratch("doubled-apart");
    let mut blocks = Blocks::default();
    blocks.cube(1, "a", [0.0; 3], 3);
    blocks.cube(2, "b", [0.1003, 0.0, 0.0], 3);
    blocks.write(&folder, &["a", "b"], "");
    for output in [modes(&folder), inspect(&folder)] {
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        assert!(!text(&output).contains("warning"), "{}", text(&output));
    }
}
