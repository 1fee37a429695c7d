//! Decks as Abaqus/CAE, CalculiX and gmsh write them, what is refused, and damaged ones.

use crate::fe::mesh::{DeckMaterial, DeckSupport, ElementKind, Mesh};
use crate::numerics::units::LengthUnit;
use std::path::Path;

fn read(bytes: &[u8]) -> Result<Mesh, String> {
    Mesh::from_bytes(bytes, Path::new("a.inp"), LengthUnit::Millimetre).map_err(|error| error.to_string())
}

/// Whether a node is at a place, but for the rounding of the unit.
fn is_at(mesh: &Mesh, node: usize, place: [f64; 3]) -> bool {
    mesh.nodes[node].iter().zip(place).all(|(found, expected)| (found - expected).abs() < 1e-15)
}

/// Groups as `name dimension nodes elements`.
fn groups(mesh: &Mesh) -> Vec<String> {
    let of = |group: &crate::fe::mesh::PhysicalGroup| {
        format!("{} {} {} {}", group.name, group.dimension, group.nodes.len(), group.elements.len())
    };
    mesh.groups.iter().map(of).collect()
}

/// What was changed or left out, in sentences.
fn told(mesh: &Mesh) -> Vec<String> {
    mesh.notes.told.iter().map(ToString::to_string).collect()
}

/// Two cubes on each other, with what a hand-written deck has.
const CUBES: &str = "\
*HEADING
anything, at all
** a comment
*Node, nset=Nall
1, 0, 0, 0
2, 1.D0, 0.0, 0
 3 , 1., 1, .0E+00 ,
4, , 1
5,0,0,1
6,1,0,1
** in between
7,1,1,1
8,0,1,1
11, 0,0,2
12, 1,0,2
13, 1,1,2
14, 0,1,2
*ELEMENT, TYPE=c3d8r, ELSET = \"lower one\"
10, 1,2,3,4,
5,6,7,8
*Element, type=C3D8I,
 elset=Upper
20, 5,6,7,8,11,12,13,14
*ELSET, ELSET=both
LOWER ONE, upper
*NSET, NSET=Feet, GENERATE
1, 4
*nset, nset=sensor
7
*NSET, NSET=mixed, UNSORTED
feet, 11
*SURFACE, NAME=top
upper, S2
*SURFACE, NAME=side, TYPE=ELEMENT
both, s4
10, S1
*SURFACE, NAME=skin
upper,
*SURFACE, NAME=ground, TYPE=NODE
FEET, 1.0
*MATERIAL, NAME=STEEL
*ELASTIC
2.1e5, 0.3
*STEP
*INCLUDE, INPUT=loads.inp
";

#[test]
fn sets_and_surfaces_are_groups() {
    let mesh = read(CUBES.as_bytes()).unwrap();
    assert!(is_at(&mesh, 1, [1e-3, 0.0, 0.0]) && is_at(&mesh, 3, [0.0, 1e-3, 0.0]));
    let expected = [
        "sensor 0 1 1",
        "mixed 0 5 5",
        "top 2 4 1",
        "side 2 8 3",
        "skin 2 8 5",
        "ground 2 4 1",
        "Feet 2 4 1",
        "lower one 3 8 1",
        "Upper 3 8 1",
        "both 3 12 2",
    ];
    assert_eq!(groups(&mesh), expected);
    assert_eq!(mesh.notes.passed_over, ["*HEADING"]);
    assert_eq!(mesh.format.to_string(), "Abaqus or CalculiX input");
    assert!(mesh.notes.told.is_empty(), "{:?}", mesh.notes);
    let mixed =
        "the node set \"mixed\" is a group of points: beside whole faces (1) it holds other nodes (1, the first is 11)";
    assert_eq!(mesh.notes.as_points, [mixed]);
}

/// Middle nodes lie between the corners that gmsh's order says, and the faces S1, S2, ... where the manual has them.
#[test]
fn nodes_and_faces_are_brought_into_gmsh_order() {
    let hex = "0 0 0/2 0 0/2 2 0/0 2 0/0 0 2/2 0 2/2 2 2/0 2 2/1 0 0/2 1 0/1 2 0/0 1 0/1 0 2/2 1 2/1 2 2/0 1 2/0 0 1/2 0 1/2 2 1/0 2 1";
    let wedge = "0 0 0/2 0 0/0 2 0/0 0 2/2 0 2/0 2 2/1 0 0/1 1 0/0 1 0/1 0 2/1 1 2/0 1 2/0 0 1/2 0 1/0 2 1";
    let tet = "0 0 0/2 0 0/0 2 0/0 0 2/1 0 0/1 1 0/0 1 0/0 0 1/1 0 1/0 1 1";
    // by each face the sum of coordinates of its corners
    let cases: [(&str, &str, ElementKind, &[[f64; 3]]); 3] = [
        (
            "C3D20R",
            hex,
            ElementKind::Hex20,
            &[[4., 4., 0.], [4., 4., 8.], [4., 0., 4.], [8., 4., 4.], [4., 8., 4.], [0., 4., 4.]],
        ),
        ("C3D15", wedge, ElementKind::Wedge15, &[[2., 2., 0.], [2., 2., 6.], [4., 0., 4.], [4., 4., 4.], [0., 4., 4.]]),
        ("C3D10M", tet, ElementKind::Tet10, &[[2., 2., 0.], [2., 0., 2.], [2., 2., 2.], [0., 2., 2.]]),
    ];
    for (name, places, kind, faces) in cases {
        let nodes: Vec<String> = (1..)
            .zip(places.split('/'))
            .map(|(tag, at): (u32, _)| format!("{tag},{}\n", at.replace(' ', ",")))
            .collect();
        let tags: Vec<String> = (1..=nodes.len()).map(|tag| tag.to_string()).collect();
        let surfaces: Vec<String> =
            (1..=faces.len()).map(|face| format!("*SURFACE,NAME=F{face}\n1,S{face}\n")).collect();
        // a long line as gmsh breaks it
        let (first, second) = tags.split_at(8);
        let deck = format!(
            "*NODE\n{}*ELEMENT,TYPE={name}\n1,{},\n{}\n{}",
            nodes.concat(),
            first.join(","),
            second.join(","),
            surfaces.concat()
        );
        let mesh = read(deck.as_bytes()).unwrap();
        let own = mesh.blocks[0].nodes_of(0);
        for (middle, [a, b]) in own[kind.corners()..].iter().zip(kind.middle_edges()) {
            for axis in 0..3 {
                let between = 0.5 * (mesh.nodes[own[*a]][axis] + mesh.nodes[own[*b]][axis]);
                assert!((mesh.nodes[*middle][axis] - between).abs() < 1e-15, "{name}");
            }
        }
        for (number, expected) in (1..).zip(faces) {
            let group = mesh.group(&format!("F{number}")).unwrap();
            let block = &mesh.blocks[group.elements[0].block];
            let corners = &block.nodes_of(group.elements[0].index)[..block.kind.corners()];
            let sum = [0, 1, 2].map(|axis| corners.iter().map(|&node| 1e3 * mesh.nodes[node][axis]).sum::<f64>());
            assert!((0..3).all(|axis| (sum[axis] - expected[axis]).abs() < 1e-12), "{name} S{number}: {sum:?}");
        }
        assert_eq!(mesh.groups.last().map(|group| group.name.as_str()), Some("body"));
    }
}

/// One part and one instance, reference points of the assembly, sets that CAE names alike.
const CAE: &str = "\
*Heading
*Part, name=Other
*Node
      1,           5.,           5.,           5.
*End Part
*Part, name=Block
*Node
      1,           0.,           0.,           0.
      2,           1.,           0.,           0.
      3,           0.,           1.,           0.
      4,           0.,           0.,           1.
      5,           0.,           0.,          -1.
*Element, type=C3D4
1, 1, 2, 3, 4
2, 1, 3, 2, 5
*Nset, nset=Set-1, generate
 1,  5,  1
*Elset, elset=Set-1
 1, 2
*Solid Section, elset=Set-1, material=Steel
,
*End Part
*Assembly, name=Assembly
*Instance, name=Block-1, part=Block
          0.,           0.,           0.
*End Instance
*Node
      1,         7.,           7.,           7.
*Nset, nset=RP
 1,
*Nset, nset=bore, instance=Block-1
 1, 3, 4
*Elset, elset=bore, instance=Block-1
 1,
*Nset, nset=tip
 Block-1.5,
*Elset, elset=_face_S3, internal, instance=Block-1
 1,
*Surface, type=ELEMENT, name=face
_face_S3, S3
*Coupling, constraint name=C, ref node=RP, surface=face
*End Assembly
*Step
";

#[test]
fn one_instance_of_cae_is_read() {
    let mesh = read(CAE.as_bytes()).unwrap();
    assert_eq!(mesh.nodes.len(), 5);
    assert_eq!(groups(&mesh), ["tip 0 1 1", "face 2 3 1", "bore 2 3 1", "Set-1 3 5 2"]);
    let moved = CAE.replace("          0.,           0.,           0.\n*End", "1.,,-2.\n*End");
    assert!(is_at(&read(moved.as_bytes()).unwrap(), 4, [1e-3, 0.0, -3e-3]));
    let [coupling] = &told(&mesh)[..] else { panic!("{:?}", mesh.notes) };
    assert!(coupling.starts_with("these are not taken from the file: *COUPLING (line 41); "), "{coupling}");
}

#[test]
fn elements_that_make_no_body_are_told() {
    let more = "*NODE\n90,0,0,9\n*ELEMENT,TYPE=SPRINGA,ELSET=S\n31,8,90\n32,7,90\n*ELEMENT,TYPE=S4R,ELSET=skin2\n40,1,2,3,4\n\
        *SHELL SECTION,ELSET=skin2\n1.\n*STEP";
    let mesh = read(CUBES.replace("*STEP", more).as_bytes()).unwrap();
    assert_eq!(
        told(&mesh),
        [
            "elements of type SPRINGA are not modelled and left out: 2, the first is 31",
            "the shells and membranes (the first is element 40 of type S4R) have no stiffness and no mass here"
        ]
    );
    assert!(groups(&mesh).contains(&"skin2 2 4 1".to_owned()));
}

/// Sections by sets, one of them internal; one body of no section; boundaries before the step and in it.
#[test]
fn materials_and_what_is_held_are_notes() {
    let case = "*MATERIAL, NAME=Steel\n*DENSITY\n7.85E-9\n*ELASTIC, TYPE=ISO\n2.1e5, 0.3\n*CONDUCTIVITY\n50.\n\
        *MATERIAL, NAME=Hot\n*ELASTIC\n7.e4, .33, 20.\n6.e4, .33, 200.\n*DENSITY\n2.7E-9,\n\
        *SOLID SECTION, ELSET=both, MATERIAL=hot\n*SOLID SECTION, ELSET=_p, MATERIAL=STEEL\n\
        *BOUNDARY\nfeet, 1, 2\nsensor, 2, 6\n11, 1\n11, 2\n12, 3\nsensor, 1, 1, 0.5\nmixed, XSYMM\nnall, 11, 11, 20.\n\
        *STEP\n*FREQUENCY\n10\n*BOUNDARY\nFEET, 3\nNall, 1\n*END STEP\n*STEP\n*BOUNDARY\nsensor, 1\n";
    let deck = CUBES.replace("*ELSET, ELSET=both", "*ELSET, ELSET=_p, INTERNAL\n20\n*ELSET, ELSET=both");
    let deck = deck.split("*MATERIAL").next().unwrap().to_owned() + case;
    let mesh = read(deck.as_bytes()).unwrap();
    let notes = &mesh.notes;
    let material = |name: &str, groups: &[&str], elastic, density| DeckMaterial {
        name: name.to_owned(),
        groups: groups.iter().map(|&group| group.to_owned()).collect(),
        elastic,
        density,
        first_line: name == "Hot",
    };
    // the second section takes one of two bodies from the first
    let steel = material("Steel", &["Upper", "_p"], Some([2.1e5, 0.3]), Some(7.85e-9));
    assert_eq!(notes.materials, [steel, material("Hot", &["lower one"], Some([7e4, 0.33]), Some(2.7e-9))]);
    assert_eq!(held(&mesh), ["Feet xyz", "mixed x", "sensor xyz"]);
    assert_eq!(
        notes.not_supports,
        [
            "the file has 2 steps: *BOUNDARY counts up to step 1, the first that has *FREQUENCY",
            "*BOUNDARY holds \"Nall\", the set of all nodes: no support holds a whole body",
            "*BOUNDARY has lines with values (1, first line 64): their directions are held, and the values are not used",
            "*BOUNDARY holds single nodes (2, first in line 61), which are no support: put them into an *NSET",
        ]
    );
    assert_eq!(notes.passed_over, ["*CONDUCTIVITY", "*HEADING"]);
    // in axes of their own only what is held all round is known; what a step begins anew is not held any more
    let turned =
        read(deck.replace("*BOUNDARY\nfeet", "*TRANSFORM, NSET=Nall\n0,1,0,1,0,0\n*BOUNDARY\nfeet").as_bytes());
    let turned = turned.unwrap();
    assert_eq!(held(&turned), [""; 0]);
    assert!(turned.notes.supports.iter().any(|named| named.group == "Feet"), "{:?}", turned.notes);
    let anew = read(deck.replace("*BOUNDARY\nFEET", "*BOUNDARY, OP=NEW\nFEET").as_bytes()).unwrap();
    assert_eq!(held(&anew), ["Feet z"]);
    // what was picked in Abaqus/CAE, and a surface of the set's name
    let picked = read(deck.replace("NSET=Feet, GENERATE", "NSET=Feet, GENERATE, INTERNAL").as_bytes()).unwrap().notes;
    assert_eq!(picked.supports[0].group, "Feet");
    let surface =
        read(deck.replace("*SURFACE, NAME=skin", "*SURFACE, NAME=FEET\nlower one, S1\n*SURFACE, NAME=skin").as_bytes());
    assert_eq!(surface.unwrap().notes.supports[0].group, "FEET");
    let moving = read(deck.replace("*BOUNDARY\nFEET", "*BOUNDARY, OP=NEW, TYPE=VELOCITY\nFEET").as_bytes());
    assert_eq!(held(&moving.unwrap()), [""; 0]);
}

/// Groups that the file holds, with the directions.
fn held(mesh: &Mesh) -> Vec<String> {
    let axes = |fixed: [bool; 3]| {
        ["x", "y", "z"].into_iter().zip(fixed).filter(|own| own.1).map(|own| own.0).collect::<String>()
    };
    let supports = mesh.notes.supports.iter().filter(|named| named.fixed.contains(&true));
    supports.map(|DeckSupport { group, fixed }| format!("{group} {}", axes(*fixed))).collect()
}

/// A static step before that of the frequencies, which adds a set, begins anew, or both in two boundaries; a step after it.
#[test]
fn boundaries_count_up_to_the_step_of_the_frequencies() {
    let deck = CUBES.split("*STEP").next().unwrap().to_owned()
        + "*BOUNDARY\nmixed,1\n*STEP\n*STATIC\n*BOUNDARY\nFeet,1,3\n*END STEP\n*STEP\n*FREQUENCY\n3\n*BOUNDARY\nsensor,2\n\
            *END STEP\n*STEP\n*FREQUENCY\n3\n*BOUNDARY, OP=NEW\nsensor,3\n*END STEP\n";
    let of = |deck: &str| held(&read(deck.as_bytes()).unwrap());
    assert_eq!(of(&deck), ["Feet xyz", "mixed x", "sensor y"]);
    assert_eq!(of(&deck.replacen("*BOUNDARY\nsensor", "*BOUNDARY, OP=NEW\nsensor", 1)), ["sensor y"]);
    let twice = deck.replacen("*BOUNDARY\nsensor", "*BOUNDARY, OP=NEW\nmixed,3\n*BOUNDARY, OP=NEW\nsensor", 1);
    assert_eq!(of(&twice), ["mixed z", "sensor y"]);
    assert_eq!(of(&deck.replace("*FREQUENCY", "*STATIC")), ["Feet xyz", "mixed x"]);
    let said = |deck: &str| read(deck.as_bytes()).unwrap().notes.not_supports.concat();
    assert_eq!(said(&deck), "the file has 3 steps: *BOUNDARY counts up to step 2, the first that has *FREQUENCY");
    assert!(said(&deck.replace("*FREQUENCY", "*STATIC")).ends_with("up to step 1, as none has *FREQUENCY"));
    // what only a later step names is named still
    let anew = read(deck.replacen("*BOUNDARY\nsensor,2", "*BOUNDARY, OP=NEW", 1).as_bytes()).unwrap();
    let named: Vec<_> = anew.notes.supports.iter().map(|named| named.group.as_str()).collect();
    assert_eq!((named, held(&anew)), (vec!["Feet", "mixed", "sensor"], Vec::new()));
}

/// Tags of entities are made up here, so that no name can mean one.
#[test]
fn a_set_is_no_entity() {
    let deck = CUBES.replace("*ELSET, ELSET=both", "*ELEMENT, TYPE=S4\n40, 1,2,3,4\n*ELSET, ELSET=both");
    let mut mesh = read(deck.as_bytes()).unwrap();
    let before = mesh.groups.len();
    mesh.add_entity_groups(["surface 1", "volume 1"]);
    assert_eq!(mesh.groups.len(), before);
    assert!(!mesh.names().iter().any(|name| name == "surface 1"), "{:?}", mesh.names());
}

/// What is changed in the deck of the cubes, or of CAE, and the message.
#[test]
fn what_cannot_be_read_is_refused_by_line() {
    let cases = [
        ("7,1,1,1", "6,1,1,1", "line 12, *NODE: node 6 occurs a second time in another place"),
        ("7,1,1,1", "7,1,x,1", "line 12, *NODE: node 7: expected a coordinate, found \"x\""),
        ("7,1,1,1", "7,1,1e400,1", "line 12, *NODE: node 7: expected a coordinate, found \"1e400\""),
        ("7,1,1,1", "7,1,nan,1", "found \"nan\""),
        ("7,1,1,1", "0,1,1,1", "expected the number of a node, 1 to 999999999, found \"0\""),
        ("7,1,1,1", "70,1,1,1", "line 19, *ELEMENT: element 10 refers to node 7: expected one that *NODE lists"),
        ("20, 5,6", "10, 5,6", "line 23, *ELEMENT: element 10 occurs a second time with other nodes"),
        ("20, 5,6", "20, 5,5", "element 20 has the node 5 twice"),
        ("20, 5,6,7,", "20, 5,6,", "element 20 has 7 nodes: expected 8"),
        ("20, 5,6,7,", "20, 5,6,7,7,", "element 20 has 9 nodes: expected 8"),
        ("c3d8r", "C3D27", "line 18, *ELEMENT: TYPE=C3D27 cannot be read: expected C3D4"),
        ("TYPE=c3d8r, ", "", "line 18, *ELEMENT: expected TYPE=..., found none"),
        (
            "LOWER ONE, upper",
            "LOWER ONE, upper2",
            "line 25, *ELSET: expected the number of an element or the name of a set that stands before, found \"upper2\"",
        ),
        ("1, 4\n", "4, 1\n", "line 27, *NSET: expected first, last and step, found \"4, 1\""),
        ("1, 4\n", "1, 4, 0\n", "line 27, *NSET: expected the number of a node"),
        (
            "sensor\n7",
            "sensor\n77",
            "line 29, *NSET: the set \"sensor\" has 77: expected the number of a node that the file lists",
        ),
        ("upper, S2", "upper, S7", "line 33, *SURFACE: expected a face of element 20 (Hex8), S1 to S6, found \"S7\""),
        (
            "upper, S2",
            "uper, S2",
            "line 33, *SURFACE: expected an element or a set of elements that the file has, found \"uper\"",
        ),
        ("*MATERIAL", "*INCLUDE, INPUT=m.inp\n*MATERIAL", "line 41, *INCLUDE: found another file, \"m.inp\""),
        ("*MATERIAL", "*NGEN\n1,2\n*MATERIAL", "line 41, *NGEN: nodes and elements that are generated cannot be read"),
        ("*Node, nset", "*Node, system=C, nset", "line 4, *NODE: found SYSTEM=C: expected rectangular coordinates"),
    ];
    for (text, other, expected) in cases {
        assert!(CUBES.contains(text), "{text}");
        let message = read(CUBES.replacen(text, other, 1).as_bytes()).unwrap_err();
        assert!(message.starts_with("a.inp: ") && message.contains(expected), "{message}\n{expected}");
    }
    let cases = [
        (
            "          0.,           0.,           0.\n*End",
            "0.,0.,1.\n0.,0.,0.,1.,0.,0.,90.\n*End",
            "line 26, *INSTANCE: an instance that is turned cannot be read",
        ),
        (
            "*End Instance\n",
            "*End Instance\n*Instance, name=B-2, part=Other\n*End Instance\n",
            "line 27, *INSTANCE: found a second instance, \"B-2\" after \"Block-1\": expected one",
        ),
        ("type=C3D4", "type=S4R", "element 1 of type S4R is a shell or membrane and the file has no solids"),
        (
            "type=C3D4",
            "type=MASS",
            "the file has no element that a body is made of: expected solids (C3D4 to C3D20), or plane elements (CPS, CPE), found MASS",
        ),
    ];
    for (text, other, expected) in cases {
        let message = read(CAE.replacen(text, other, 1).as_bytes()).unwrap_err();
        assert!(message.contains(expected), "{message}\n{expected}");
    }
    assert!(read(b"*NODE\n1,0,0,0\n").unwrap_err().contains("the file has no *ELEMENT with data"));
    assert!(read(b"").unwrap_err().contains("the file has no *NODE with data"));
}

/// What says something of the case.
const HELD: &str = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4,ELSET=E\n1,1,2,3,4\n*NSET,NSET=N\n1,2,3\n\
    *MATERIAL,NAME=M\n*DENSITY\n7.8\n*ELASTIC\n2.,.3\n*SOLID SECTION,ELSET=E,MATERIAL=M\n*BOUNDARY\nN,1,3\n1,2\n*STEP\n*END STEP\n";

/// What later stages rely on, whatever the file held.
fn is_sound(bytes: &[u8]) -> bool {
    match read(bytes) {
        Err(message) => !message.is_empty() && message.len() < 1000,
        Ok(mesh) => {
            let nodes = mesh.nodes.len();
            mesh.blocks.iter().all(|block| {
                block.connectivity.iter().all(|&node| node < nodes)
                    && block.connectivity.len() == block.len() * block.kind.nodes()
            }) && mesh.nodes.iter().flatten().all(|x| x.is_finite())
                && mesh.node_tags.len() == nodes
                && mesh.groups.iter().all(|group| {
                    group.nodes.iter().all(|&node| node < nodes)
                        && group.nodes.is_sorted()
                        && group.elements.iter().all(|id| mesh.blocks[id.block].element(id.index).is_some())
                })
        }
    }
}

#[test]
fn damage_is_an_error_or_a_mesh() {
    for deck in [CUBES, CAE, HELD] {
        let bytes = deck.as_bytes();
        for length in 0..bytes.len() {
            assert!(is_sound(&bytes[..length]), "cut to {length}");
        }
        for position in 0..bytes.len() {
            for value in [0, b' ', b'\n', b'-', b'9', b'*', b',', b'=', b'"', 0x80, 0xff] {
                let mut damaged = bytes.to_vec();
                damaged[position] = value;
                assert!(is_sound(&damaged), "byte {position} replaced by {value}");
            }
            let mut damaged = bytes.to_vec();
            damaged.remove(position);
            assert!(is_sound(&damaged), "without byte {position}");
        }
        let words: Vec<&str> = deck.split_inclusive([',', '\n']).collect();
        for huge in ["18446744073709551616", "999999999", "2147483648", "-1", "1e309"] {
            for position in 0..words.len() {
                let mut damaged = words.clone();
                let replaced = format!("{huge}{}", if words[position].ends_with('\n') { "\n" } else { "," });
                damaged[position] = &replaced;
                assert!(is_sound(damaged.concat().as_bytes()), "word {position} replaced by {huge}");
            }
        }
    }
}

/// Sets of sets that grow without end, and ranges that are wider than the mesh.
#[test]
fn sets_take_no_more_memory_than_the_file_allows() {
    let wide = CUBES.replace("1, 4\n", "1, 999999999\n");
    assert!(groups(&read(wide.as_bytes()).unwrap()).iter().any(|group| !group.starts_with("Feet")));
    let line = "A,".repeat(20_000);
    let deck =
        CUBES.replace("*MATERIAL", &format!("*NSET,NSET=A\n1,2,3,4\n{}\n*MATERIAL", format!("{line}\n").repeat(4)));
    let message = read(deck.as_bytes()).unwrap_err();
    assert!(message.contains("too many for a file of"), "{message}");
}

/// gmsh names surface elements and their nodes alike; a set of nodes may be called as the body; an editor's mark stands first.
#[test]
fn sets_of_one_name_are_kept_by_their_dimension() -> Result<(), String> {
    // a set within a larger one of the bodies gives way, as CAE's of the elements behind a face
    let cubes = CUBES
        .replace("\"lower one\"", "lower")
        .replace("*ELSET, ELSET=both\nLOWER ONE, upper\n", "")
        .replace("both, s4", "upper, s4");
    let named = |more: &str| {
        format!("\u{feff}{}", cubes.replace("*NSET, NSET=Feet, GENERATE", &format!("{more}*NSET, NSET=Feet, GENERATE")))
    };
    let mesh = read(named("*NSET, NSET=LOWER\n1, 2, 3, 4\n").as_bytes())?;
    let lower =
        groups(&mesh).into_iter().filter(|group| group.to_lowercase().starts_with("lower ")).collect::<Vec<_>>();
    assert_eq!(lower, ["LOWER 2 4 1", "lower 3 8 1"]);
    let mesh = read(named("*ELEMENT, TYPE=CPS4, ELSET=feet\n90, 1, 2, 3, 4\n").as_bytes())?;
    let feet = groups(&mesh).into_iter().filter(|group| group.to_lowercase().starts_with("feet ")).count();
    assert_eq!(feet, 1);
    Ok(())
}
