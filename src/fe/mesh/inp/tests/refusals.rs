//! What is refused, and damaged files.

use super::{CAE, CUBES, groups, read};

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

#[test]
fn a_message_is_short_whatever_the_names() {
    let long = "\u{1f529}\u{7}a".repeat(3000);
    for (deck, text, other) in [
        (CUBES, "c3d8r", format!("C3D{}", "9".repeat(5000))),
        (CUBES, "*Node, nset", format!("*Node, system={long}, nset")),
        (CUBES, "nset=sensor\n7", format!("nset={long}\n77")),
        (CUBES, "LOWER ONE, upper", format!("LOWER ONE, {long}")),
        (CAE, "*End Instance\n", format!("*End Instance\n*Instance, name={long}, part=Other\n*End Instance\n")),
        (CAE, "type=C3D4", format!("type=MASS{long}")),
    ] {
        assert!(deck.contains(text), "{text}");
        let message = read(deck.replacen(text, &other, 1).as_bytes()).unwrap_err();
        assert!(message.len() < 1000 && !message.contains('\u{7}'), "{text}: {} bytes", message.len());
    }
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
