//! Each rule: what breaks it and the exact message.

use super::{SMALL, read};

/// The message after one replacement in the small mesh; the text replaced must occur.
fn after(from: &str, to: &str) -> String {
    assert!(SMALL.contains(from), "the small mesh has no {from:?}");
    match read(SMALL.replacen(from, to, 1).as_bytes()) {
        Ok(_) => "accepted".to_owned(),
        Err(message) => message,
    }
}

/// The message of the small mesh cut before this text.
fn cut(before: &str) -> String {
    let end = SMALL.find(before).unwrap_or(SMALL.len());
    match read(&SMALL.as_bytes()[..end]) {
        Ok(_) => "accepted".to_owned(),
        Err(message) => message,
    }
}

#[test]
fn not_a_mesh() {
    let rule = "not a gmsh mesh: expected $MeshFormat at the start, found";
    assert_eq!(after("$MeshFormat", "solid cube"), format!("{rule} \"solid cube\""));
    assert_eq!(read(b"").err(), Some(format!("{rule} nothing")));
    assert_eq!(read(&[0x89, b'P', b'N', b'G', 13, 10]).err(), Some(format!("{rule} \"\u{fffd}PNG\"")));
    let step = read(b"ISO-10303-21;\nHEADER;").expect_err("a part");
    assert!(step.contains("gmsh PART.step -3 -order 2 -o PART.msh"), "{step}");
    assert_eq!(after("4.1 0", "four 0"), "$MeshFormat, line 2: expected the version, found \"four\"");
}

#[test]
fn other_versions_say_how_to_convert() {
    for (line, version) in [("1 0 8", "1"), ("2.3 0 8", "2.3"), ("3 0 8", "3"), ("5 0 8", "5")] {
        assert_eq!(
            after("4.1 0 8", line),
            format!(
                "MSH version {version}: expected 2.0 to 2.2, 4.0 or 4.1; convert it with: gmsh IN.msh -save -format \
                 msh41 -o OUT.msh"
            )
        );
    }
    assert!(after("$MeshFormat", "$NOD").starts_with("MSH version 1.0: expected 2.0 to 2.2,"));
}

#[test]
fn header() {
    assert_eq!(
        after("4.1 0 8", "4.1 2 8"),
        "$MeshFormat, line 2: expected the file type, 0 (ASCII) or 1 (binary), found \"2\""
    );
    assert_eq!(
        after("4.1 0 8", "4.1 0 99999999999"),
        "$MeshFormat, line 2: expected the size of size_t, 4 or 8, found \"99999999999\""
    );
    assert_eq!(
        after("4.1 0 8", "4.1 1 8"),
        "$MeshFormat, line 3: expected the integer 1 that shows the byte order, found \"$End\""
    );
}

#[test]
fn cut_files_name_the_section() {
    let cases = [
        ("4.1", "MeshFormat", "the version"),
        (" 0 8", "MeshFormat", "the file type, 0 (ASCII) or 1 (binary)"),
        ("ormat\n$PhysicalNames", "MeshFormat", "$EndMeshFormat"),
        ("4\n0 7", "PhysicalNames", "the number of physical names"),
        ("2 10 \"plate\"", "PhysicalNames", "dimension, tag and \"name\" of a physical group"),
        ("1 1 1 0", "Entities", "the number of points"),
        ("1 10 1 1", "Entities", "the number of physical tags"),
        ("Entities\n$Nodes", "Entities", "$EndEntities"),
        ("2 1 0\n$", "Nodes", "a coordinate of a node"),
        ("$EndNodes", "Nodes", "$EndNodes"),
        ("4 2 3 4 5", "Elements", "an element tag"),
        ("2 3 4 5\n$", "Elements", "the tag of a node of an element"),
    ];
    for (before, section, expected) in cases {
        let message = format!("the file ends inside ${section}: expected {expected}; is it complete?");
        assert_eq!(cut(before), message, "cut before {before:?}");
    }
    assert_eq!(
        cut("3\n2\n5"),
        "$Nodes, line 25: 4 announced as the number of nodes of a block, but only 1 bytes follow; is the \
         file complete?"
    );
    assert_eq!(cut("$Elements"), "the file has no $Elements section: expected one; is the file complete?");
    assert_eq!(cut("$Nodes"), "the file has no $Nodes section: expected one; is the file complete?");
    let open = format!("{SMALL}$Periodic\n0\n");
    assert_eq!(
        read(open.as_bytes()).err().as_deref(),
        Some("the file ends inside $Periodic: expected $EndPeriodic; is it complete?")
    );
}

#[test]
fn sections() {
    let twice = format!("{SMALL}$Nodes\n1 1 1 1\n0 1 0 1\n1\n0 0 0\n$EndNodes\n");
    assert_eq!(read(twice.as_bytes()).err().as_deref(), Some("line 45: a second $Nodes section, expected one"));
    let (start, rest) = SMALL.split_once("$Nodes").unwrap_or_default();
    let (nodes, elements) = rest.split_once("$Elements").unwrap_or_default();
    let swapped = format!("{start}$Elements{elements}$Nodes{nodes}");
    assert_eq!(
        read(swapped.as_bytes()).err().as_deref(),
        Some("the file has no $Nodes section: expected one before $Elements")
    );
    assert_eq!(
        after("$Nodes", "Nodes"),
        "$Entities, line 17: expected a section ($...) after $EndEntities, found \"Nodes\""
    );
    assert_eq!(after("$EndNodes", "$EndNode"), "$Nodes, line 34: expected $EndNodes, found \"$EndNode\"");
    assert_eq!(after("$EndNodes", "$EndNodes 1"), "$Nodes, line 34: expected nothing after $EndNodes, found \" 1\"");
}

#[test]
fn physical_names() {
    let rule = "$PhysicalNames, line 6: expected dimension, tag and \"name\" of a physical group, found";
    assert_eq!(after("0 7 \"corner point\"", "0 7 corner"), format!("{rule} \"0 7 corner\""));
    assert_eq!(after("0 7 \"corner", "0 x \"corner"), format!("{rule} \"0 x \"corner point\"\""));
    assert_eq!(after("0 7 \"corner", "4 7 \"corner"), format!("{rule} \"4 7 \"corner point\"\""));
    assert_eq!(
        after("4\n0 7", "four\n0 7"),
        "$PhysicalNames, line 5: expected the number of physical names, found \"four\""
    );
    assert_eq!(
        after("1 9 \"n", "1 1 \"n"),
        "$PhysicalNames, line 8: expected one name for group 1 of dimension 1, found \"1 1 \"nothing \
         there\"\""
    );
}

#[test]
fn numbers() {
    assert_eq!(after("1 1 1 0\n", "1 -1 1 0\n"), "$Entities, line 12: expected the number of curves, found \"-1\"");
    assert_eq!(
        after("1 0 0 0 1 7", "1 0 0,5 0 1 7"),
        "$Entities, line 13: expected a coordinate of an entity, found \"0,5\""
    );
    assert_eq!(after("2 1 -2", "2 1 two"), "$Entities, line 14: expected the tag of a bounding entity, found \"two\"");
    assert_eq!(
        after("2 1 0 4\n", "4 1 0 4\n"),
        "$Nodes, line 25: expected the dimension of an entity, 0 to 3, found \"4\""
    );
    assert_eq!(
        after("2 1 0 4\n", "2 1 2 4\n"),
        "$Nodes, line 25: expected the flag for parametric coordinates, 0 or 1, found \"2\""
    );
    assert_eq!(
        after("3 6 1 6\n", "3 7 1 7\n"),
        "$Nodes, line 33: expected 7 nodes as announced at the start of the section, found \"6\""
    );
    assert_eq!(
        after("3 4 1 4\n", "3 5 1 5\n"),
        "$Elements, line 43: expected 5 elements as announced at the start of the section, found \"4\""
    );
    assert_eq!(
        after("3 6 1 6\n", "3 6 6 1\n"),
        "$Nodes, line 18: expected the largest node tag, not below the smallest, found \"1\""
    );
}

#[test]
fn counts_are_checked_against_the_file() {
    let rest = |text: &str| SMALL.len() - SMALL.find(text).unwrap_or(0) - text.len();
    assert_eq!(
        after("2 1 0 4\n", "2 1 0 4000000000000\n"),
        format!(
            "$Nodes, line 25: 4000000000000 announced as the number of nodes of a block, but only \
             {} bytes follow; is the file complete?",
            rest("2 1 0 4")
        )
    );
    assert_eq!(
        after("3 4 1 4\n", "3 18446744073709551615 1 4\n"),
        format!(
            "$Elements, line 36: 18446744073709551615 announced as the number of elements, but \
             only {} bytes follow; is the file complete?",
            rest("$Elements\n3 4")
        )
    );
}

#[test]
fn nodes() {
    let rule = "expected a finite number";
    for (text, shown) in [("nan", "NaN"), ("-inf", "-inf"), ("1e999", "inf")] {
        assert_eq!(
            after("1 1 0\n2 1 0\n$", &format!("1 {text} 0\n2 1 0\n$")),
            format!("$Nodes, line 32: node 5 has the coordinate {shown}: {rule}")
        );
    }
    assert_eq!(
        after("2\n5\n4\n", "2\n6\n4\n"),
        "$Nodes, line 28: node tag 6 occurs a second time: expected every tag once"
    );
    assert_eq!(after("2\n5\n4\n", "2\n0\n4\n"), "$Nodes, line 28: expected a node tag, greater than 0, found \"0\"");
    for tag in ["9223372036854775808", "18446744073709551615"] {
        assert_eq!(
            after("2\n5\n4\n", &format!("2\n{tag}\n4\n")),
            format!("$Nodes, line 28: expected a node tag, at most 9223372036854775807, found \"{tag}\"")
        );
    }
    assert_eq!(
        after("2\n5\n4\n", "2\n18446744073709551616\n4\n"),
        "$Nodes, line 28: expected a node tag, at most 18446744073709551615, found \"18446744073709551616\""
    );
}

#[test]
fn elements() {
    assert_eq!(
        after("4 2 3 4 5\n$", "3 2 3 4 5\n$"),
        "$Elements, line 43: element tag 3 occurs a second time: expected every tag once"
    );
    assert_eq!(
        after("4 2 3 4 5\n$", "4 2 3 7 5\n$"),
        "$Elements, line 43: element 4 refers to node 7: expected a tag listed in $Nodes"
    );
    assert_eq!(
        after("4 2 3 4 5\n$", "4 2 3 2 5\n$"),
        "$Elements, line 43: element 4 has the node 2 twice: expected different nodes"
    );
    // a curve's element beside a body is left out
    let mesh = read(SMALL.replace("\n2 6 1\n", "\n2 6 6\n").as_bytes()).unwrap();
    let left = crate::fe::mesh::LeftOut { tag: 2, dimension: 1, entity: 1, physical: 0 };
    assert_eq!(mesh.notes.told, [crate::fe::mesh::MeshNote::NodeTwice(vec![left])]);
    assert_eq!(mesh.element_ids(1).count(), 0);
    assert_eq!(
        after("2 1 3 2\n", "1 1 3 2\n"),
        "$Elements, line 41: expected elements of dimension 1 like their entity, found \"Quad4\""
    );
}

#[test]
fn no_elements() {
    let rule = "the mesh has no elements: expected at least one (is a Physical group defined, is the \
                geometry meshed?)";
    let (start, _) = SMALL.split_once("$Elements").unwrap_or_default();
    let none = format!("{start}$Elements\n0 0 0 0\n$EndElements\n");
    assert_eq!(read(none.as_bytes()).err().as_deref(), Some(rule));
    let (start, _) = SMALL.split_once("$Nodes").unwrap_or_default();
    let none = format!("{start}$Nodes\n0 0 0 0\n$EndNodes\n$Elements\n0 0 0 0\n$EndElements\n");
    assert_eq!(read(none.as_bytes()).err().as_deref(), Some(rule));
}

#[test]
fn unsupported_elements_are_named() {
    let known = "Point, Line2, Line3, Tri3, Tri6, Quad4, Quad8, Quad9, Tet4, Tet10, Hex8, Hex20, Hex27, Wedge6, Wedge15, Wedge18, Pyramid5, Pyramid13, Pyramid14";
    let order = "make it one of second order with: gmsh IN.msh -3 -order 2 -o OUT.msh (-2 for a plane mesh)";
    let cases = [
        (0, "unknown to gmsh", "is the file damaged?"),
        (21, "Tri10", order),
        (36, "Quad16", order),
        (37, "of higher order or special purpose", order),
        (141, "unknown to gmsh", "is the file damaged?"),
    ];
    for (number, name, advice) in cases {
        assert_eq!(
            after("2 1 3 2\n", &format!("2 1 {number} 2\n")),
            format!(
                "$Elements, line 41: element type {number} ({name}) on entity 1 of dimension 2: expected \
                 one of {known}; {advice}"
            )
        );
    }
}

/// Every element in every one of 5000 groups: refused before the lists are made.
#[test]
fn groups_that_multiply_the_file() {
    let tags: Vec<String> = (1..=5000).map(|tag| tag.to_string()).collect();
    let many = format!("5000 {} 1 1\n$EndEntities", tags.join(" "));
    let expected = "the physical groups would take 640384 bytes of memory or more, too many for a file of 24314 bytes: expected each entity in a few groups";
    assert_eq!(after("1 10 1 1\n$EndEntities", &many), expected);
}
