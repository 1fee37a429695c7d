//! Reference: none; two squares on each other in closed words, the upper one made wrong.
//! Goal: nodes that elements, groups, links and sensors do not share as they seem to are never computed in silence.
//! Sketch: squares of 0.1 m in MSH 2.2, held at the bottom: 4 - 3 is the edge between them, 9 its middle node.
//! Conditions: the program as a user runs it. Parameters: none; there is no tolerance.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Output;

use super::program::{errors, plummer, scratch};

const NODES: [[f64; 2]; 14] = [
    [0.0, 0.0],
    [0.1, 0.0],
    [0.1, 0.1],
    [0.0, 0.1],
    [0.1, 0.2],
    [0.0, 0.2],
    [0.05, 0.0],
    [0.1, 0.05],
    [0.05, 0.1],
    [0.0, 0.05],
    [0.1, 0.15],
    [0.05, 0.2],
    [0.0, 0.15],
    [0.05, 0.1],
];

const GROUPS: [&str; 6] = ["2 6 \"b\"", "2 1 \"a\"", "1 2 \"foot\"", "1 3 \"side\"", "1 4 \"lower\"", "1 5 \"top\""];

/// Type, group and nodes of an element.
type Element = (usize, usize, &'static str);

const LOWER: Element = (16, 1, "1 2 3 4 7 8 9 10");
const UPPER: Element = (16, 1, "4 3 5 6 9 11 12 13");
const FOOT: Element = (8, 2, "1 2 7");
const SIDE: [Element; 2] = [(8, 3, "2 3 8"), (8, 3, "3 5 11")];

/// Writes the mesh, `height` times as high, and a case of it, with further lines of `[housing]` and what follows.
fn write(folder: &Path, height: f64, elements: &[Element], more: &str) {
    let nodes = NODES.map(|[x, y]| [x, height * y]);
    write_mesh(folder, &nodes, elements, more);
}

fn write_mesh(folder: &Path, nodes: &[[f64; 2]], elements: &[Element], more: &str) {
    let mut mesh = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n{}\n$EndPhysicalNames\n$Nodes\n{}\n",
        GROUPS.len(),
        GROUPS.join("\n"),
        nodes.len()
    );
    for (tag, [x, y]) in (1..).zip(nodes) {
        let _ = writeln!(mesh, "{tag} {x} {y} 0");
    }
    let _ = writeln!(mesh, "$EndNodes\n$Elements\n{}", elements.len());
    for (tag, (kind, group, nodes)) in (1..).zip(elements) {
        let _ = writeln!(mesh, "{tag} {kind} 2 {group} {group} {nodes}");
    }
    mesh.push_str("$EndElements\n");
    fs::write(folder.join("squares.msh"), mesh).unwrap();
    let parts = ["a", "b"].into_iter().zip([1, 6]);
    let parts = parts.filter(|(_, group)| elements.iter().any(|element| element.1 == *group));
    let parts: String = parts.map(|(part, _)| format!("{{ group = '{part}', material = 'steel' }},")).collect();
    let case = format!(
        "[housing]\nmesh = 'squares.msh'\nlength_unit = 'm'\nplane = {{ assumption = 'stress', thickness = 0.01 }}\nparts = [{parts}]\nsupports = [{{ group = 'foot', fixed = ['x', 'y'] }}]\n{more}\n[modes]\ncount = 3\n"
    );
    fs::write(folder.join("case.toml"), case).unwrap();
}

fn command(folder: &Path, name: &str) -> Output {
    plummer(folder, &[name, "case.toml", "--out", "out", "--force"])
}

fn text(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(0), "{}", errors(output));
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn refused(output: &Output, code: i32, words: &[&str]) {
    let said = errors(output);
    assert_eq!(output.status.code(), Some(code), "{said}");
    for word in words {
        assert!(said.contains(word), "{word} in: {said}");
    }
}

#[test]
fn elements_of_two_orders_on_one_edge_are_refused() {
    let folder = scratch("orders-mixed");
    // four nodes, and another middle node in the same place
    for upper in [(3, 1, "4 3 5 6"), (16, 1, "4 3 5 6 14 11 12 13")] {
        write(&folder, 1.0, &[LOWER, upper, FOOT], "");
        let words = ["1 edge is without a middle node that all", "elements 1 and 2 of \"a\" at (0.05"];
        refused(&command(&folder, "modes"), 2, &words);
        let inspect = plummer(&folder, &["inspect", "squares.msh", "--length-unit", "m"]);
        refused(&inspect, 1, &words);
    }
    write(&folder, 1.0, &[LOWER, UPPER, FOOT], "");
    text(&command(&folder, "modes"));
}

#[test]
fn groups_without_the_middle_nodes_of_the_elements_are_refused() {
    let folder = scratch("orders-group");
    let words = ["1 of its edges differ in the middle node", "element 3 of the group on element 1"];
    write(&folder, 1.0, &[LOWER, UPPER, (1, 2, "1 2")], "");
    refused(&command(&folder, "modes"), 2, &[words[0], words[1], "the support would"]);
    let mass = "masses = [{ group = 'side', mass = 1.0 }]";
    write(&folder, 1.0, &[LOWER, UPPER, (1, 3, "2 3"), FOOT], mass);
    refused(&command(&folder, "modes"), 2, &[words[0], words[1], "the mass would"]);
}

/// A line whose middle node stands as an end, and one across the square.
#[test]
fn lines_that_are_no_edges_are_refused() {
    let folder = scratch("orders-edges");
    for (line, nodes) in [((8, 2, "1 7 2"), "1, 7, 2"), ((8, 2, "1 3 8"), "1, 3, 8")] {
        write(&folder, 1.0, &[LOWER, UPPER, line], "");
        let words =
            ["group \"foot\" in squares.msh: its element 3 is no edge", &format!("found nodes {nodes}, expected")];
        refused(&command(&folder, "modes"), 2, &words);
    }
}

#[test]
fn what_a_group_lists_twice_counts_once() {
    let folder = scratch("orders-twice");
    let mass = "masses = [{ group = 'side', mass = 5.0 }]";
    let frequencies = |elements: &[Element]| {
        write(&folder, 1.0, elements, mass);
        let said = text(&command(&folder, "modes"));
        let line = said.lines().find(|line| line.starts_with("unloaded"));
        line.expect("frequencies").to_owned()
    };
    let once = frequencies(&[LOWER, UPPER, FOOT, SIDE[0], SIDE[1]]);
    let twice = frequencies(&[LOWER, UPPER, FOOT, SIDE[0], SIDE[1], SIDE[0]]);
    assert_eq!(once, twice);
}

#[test]
fn links_of_nodes_to_themselves_are_refused_or_said() {
    let folder = scratch("orders-link");
    let elements = [LOWER, UPPER, FOOT, SIDE[0], SIDE[1], (8, 4, "2 3 8"), (8, 5, "5 6 12")];
    for link in ["tie = true", "spring = { x = 1e6 }"] {
        let link = format!("links = [{{ between = ['side', 'lower'], {link} }}]");
        write(&folder, 1.0, &elements, &link);
        let words = ["joins \"lower\" to \"side\", and all 3 nodes"];
        refused(&command(&folder, "modes"), 2, &words);
    }
    let some = "links = [{ between = ['side', 'top'], spring = { x = 1e3 } }]";
    write(&folder, 1.0, &elements, some);
    let said = text(&command(&folder, "modes"));
    assert!(said.contains("\"side\" and \"top\" of a link share 1 of their nodes"), "{said}");
}

#[test]
fn a_sensor_that_cannot_move_is_refused() {
    let folder = scratch("orders-sensor");
    let elements = [LOWER, UPPER, FOOT, SIDE[1]];
    for (spot, code) in [("node = 7", 2), ("group = 'foot'", 2), ("node = 9", 0)] {
        let more = format!(
            "[condense]\ninterface = {{ nodes = [5, 6] }}\n[[sensors]]\nname = 'P1'\n{spot}\ndirection = [1, 1, 0]\n"
        );
        write(&folder, 1.0, &elements, &more);
        let output = command(&folder, "condense");
        match code {
            0 => _ = text(&output),
            _ => refused(&output, code, &["sensor \"P1\"", "the support \"foot\" holds"]),
        }
    }
}

/// Two layers of a tenth of an edge each, of four and of eight nodes.
#[test]
fn flat_layers_on_held_faces_are_said() {
    let folder = scratch("orders-flat");
    let linear = [(3, 1, "1 2 3 4"), (3, 1, "4 3 5 6"), (1, 2, "1 2")];
    for (height, elements, more, flat) in [
        (0.1, linear, "", true),
        (0.1, linear, "linear = 'plain'", false),
        (0.1, [LOWER, UPPER, FOOT], "", false),
        (0.5, linear, "", false),
    ] {
        write(&folder, height, &elements, more);
        let said = text(&command(&folder, "modes"));
        let words = "flat layers of first order with incompatible modes stand on held faces, 1 of their faces";
        assert_eq!(said.contains(words), flat, "{said}");
        assert_eq!(said.contains("is 5.0 times the height of the layer"), flat, "{said}");
    }
}

/// A square on a strip whose cells reach over both of its edges: tied as bodies, and by the faces that lie on each other.
#[test]
fn a_tie_of_bodies_is_that_of_their_faces() {
    let folder = scratch("orders-bodies");
    let row = |y: f64| (0..8).map(move |x| [0.04 * f64::from(x), y]);
    let body = [[0.05, 0.1], [0.15, 0.1], [0.15, 0.2], [0.05, 0.2]];
    let nodes: Vec<[f64; 2]> = row(0.0).chain(row(0.1)).chain(body).collect();
    let mut elements = vec![(3, 6, "17 18 19 20"), (1, 3, "17 18")];
    elements.extend([
        (3, 1, "1 2 10 9"),
        (3, 1, "2 3 11 10"),
        (3, 1, "3 4 12 11"),
        (3, 1, "4 5 13 12"),
        (3, 1, "5 6 14 13"),
        (3, 1, "6 7 15 14"),
        (3, 1, "7 8 16 15"),
    ]);
    elements.extend(["9 10", "10 11", "11 12", "12 13", "13 14", "14 15", "15 16"].map(|nodes| (1, 5, nodes)));
    elements.extend([(1, 2, "1 2"), (1, 2, "7 8")]);
    let found = [["a", "b"], ["side", "top"]].map(|[a, b]| {
        let link = format!("links = [{{ between = ['{a}', '{b}'], tie = true }}]");
        write_mesh(&folder, &nodes, &elements, &link);
        let said = text(&command(&folder, "modes"));
        let line = said.lines().find(|line| line.starts_with("unloaded"));
        line.expect("frequencies").to_owned()
    });
    assert_eq!(found[0], found[1]);
}
