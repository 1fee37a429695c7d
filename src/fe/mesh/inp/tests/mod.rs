//! Decks as Abaqus/CAE, CalculiX and gmsh write them, and their groups.

mod case;
mod refusals;

use crate::fe::mesh::{ElementKind, Mesh};
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
    let [coupling, section] = &told(&mesh)[..] else { panic!("{:?}", mesh.notes) };
    assert!(section.contains("(1, first line 20, MATERIAL=\"Steel\")"), "{section}");
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
