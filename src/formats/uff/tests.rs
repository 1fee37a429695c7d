//! Universal files: written and read back, files of other programs, damage.

use std::fs;
use std::path::Path;

use proptest::prelude::*;

use super::super::mode_shapes::samples::two_modes;
use super::*;
use crate::fe::mesh::{ElementId, ElementKind, Mesh};
use crate::formats::ModeShapes;
use crate::numerics::units::LengthUnit;

fn close(found: &[f64], expected: &[f64], relative: f64) -> bool {
    let largest = expected.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= relative * largest)
}

#[test]
fn modes_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("modes.unv");
    let expected = two_modes();
    write_modes_uff(&path, "housing", &expected).unwrap();
    let found = read_modes_uff(&path).unwrap();
    assert_eq!(found.node_tags, expected.node_tags);
    // 17 digits
    assert_eq!(found.points, expected.points);
    // 6 digits
    assert!(close(&found.frequencies_hz, &expected.frequencies_hz, 5e-6));
    for (found, expected) in found.shapes.iter().zip(&expected.shapes) {
        assert!(close(found, expected, 5e-6), "{found:?}");
    }
    assert_eq!(found.shapes.len(), 2);
}

#[test]
fn a_mesh_with_modes_is_written_in_the_format_s_columns() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cube.unv");
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/cube_hex20_msh41.msh");
    let mesh = Mesh::read_gmsh(&file, LengthUnit::Millimetre).unwrap();
    let kind = ElementKind::Hex20;
    let block = mesh.blocks.iter().position(|b| b.kind == kind).unwrap();
    let ids: Vec<ElementId> = (0..8).map(|index| ElementId { block, index }).collect();
    let modes = ModeShapes {
        frequencies_hz: vec![10.0],
        node_tags: Some(mesh.node_tags[..2].to_vec()),
        points: None,
        shapes: vec![vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]],
        directions: None,
    };
    write_uff(&path, "cube", &mesh, ids.clone(), &modes).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    let begins: Vec<&str> = text.split("    -1\n").filter_map(|part| part.lines().next()).map(str::trim).collect();
    assert_eq!(begins, ["151", "164", "2411", "2412", "55"]);
    let elements = text.split("  2412\n").nth(1).unwrap();
    let lines: Vec<&str> = elements.lines().take(4).collect();
    let tag = mesh.blocks[block].tags[0];
    assert_eq!(lines[0], format!("{tag:>10}       116         1         1         7        20"));
    // gmsh's own UNV export of this element
    assert_eq!(
        lines[1..],
        [
            "         1        10         9        46        45        47        18        20",
            "        34        51        76        66        33        52        50        77",
            "        75        78        65        69",
        ]
    );
    let found = read_modes_uff(&path).unwrap();
    let points = found.points.unwrap();
    assert_eq!(points, mesh.nodes[..2]);

    let strange = ModeShapes { node_tags: Some(vec![1, 999_999]), ..modes.clone() };
    let message = |ids: Vec<ElementId>, modes: &ModeShapes| {
        let error = write_uff(&path, "cube", &mesh, ids, modes).unwrap_err();
        error.to_string()
    };
    assert_eq!(message(ids.clone(), &strange), "expected mode shapes at nodes of the elements, found node 999999");
    let line = mesh.blocks.iter().position(|b| b.kind.dimension() < 2);
    if let Some(block) = line {
        assert!(
            message(vec![ElementId { block, index: 0 }], &modes)
                .starts_with("expected surface and solid elements, found a ")
        );
    }
    let far = ModeShapes { node_tags: Some(vec![1, 10_000_000_000]), ..modes };
    let error = write_modes_uff(&path, "", &far).unwrap_err().to_string();
    assert_eq!(error, "expected labels of at most 10 digits, found 10000000000");
}

/// As a measuring program may write it: millimetres, dataset 15, an unknown dataset, a binary one, complex modes at
/// translations and rotations, blank lines, D exponents, a conjugate, a static result.
fn measured() -> Vec<u8> {
    let mut text = "written by hand\n    -1\n   164\n         5mm                          1
  1.00000000000000000D+03  1.0D+03  1.0\n  2.7315D+02\n    -1
    -1\n    15\n         1         0         0         0  1.00000E+01  2.00000E+01  0.00000E+00
         2         0         0         0  3.00000D+01  0.00000E+00 -1.00000E+00\n    -1
    -1\n  1858\n nothing to read here\n    -1\n"
        .to_owned()
        .into_bytes();
    text.extend(b"    -1\n    58b     1     2     2           9     0     0           0           0\nid\nid\n");
    text.extend(b"\n    -1\n\xff\n    -1\n");
    let mode = |values: &str, analysis: u32, real: &str| {
        format!(
            "    -1\n    55\nid\n\nid\nid\nid\n         1{analysis:>10}         3         8         5         6\n\n\
             \x20        2         6         1         1\n{real}\n{values}\n    -1\n"
        )
    };
    // (1, 2, 3) and (-2, 0, 1) times exp(i pi / 6), with rotations of 9
    let nine = " 9. 9. 9. 9. 9. 9.";
    let (c, s) = (3.0_f64.sqrt() / 2.0, 0.5);
    let point = |u: [f64; 3]| {
        let [x, y, z] = u.map(|u| format!("{:e} {:e}", u * c, u * s).replace('e', "D"));
        format!("{x} {y} {z}\n\n{nine}")
    };
    let values = format!("         1\n{}\n         2\n{}", point([1.0, 2.0, 3.0]), point([-2.0, 0.0, 1.0]));
    text.extend(mode(&values, 3, "-3.00000E+00  4.00000E+00 0. 0. 0. 0.").into_bytes());
    text.extend(mode(&values, 3, "-3.00000E+00 -4.00000E+00 0. 0. 0. 0.").into_bytes());
    text.extend(mode(&values, 1, "0. 0. 0. 0. 0. 0.").into_bytes());
    text
}

#[test]
fn measured_modes_are_turned_to_real_ones() {
    let found = modes_from_bytes(&measured(), Path::new("m.uff")).unwrap();
    assert_eq!(found.node_tags, Some(vec![1, 2]));
    assert_eq!(found.points, Some(vec![[0.01, 0.02, 0.0], [0.03, 0.0, -0.001]]));
    // |(-3, 4)| = 5; rounding of the division alone
    let expected = [5.0 / std::f64::consts::TAU];
    assert!(close(&found.frequencies_hz, &expected, 1e-15));
    // sums of a few products, each rounded
    assert!(close(&found.shapes[0], &[1.0, 2.0, 3.0, -2.0, 0.0, 1.0], 1e-14));
}

/// One real mode; `{}` are its data lines.
fn real_mode(data: &str) -> String {
    format!("    -1\n    55\na\nb\nc\nd\ne\n 1 2 2 8 2 3\n 2 4 1 1\n 7.5 1. 0. 0.\n{data}    -1\n")
}

#[test]
fn a_node_that_a_mode_leaves_out_stands_still() {
    let file = real_mode(" 5\n 1. 2. 3.\n 6\n 4. 5. 6.\n") + &real_mode(" 6\n 7. 8. 9.\n");
    let found = modes_from_bytes(file.as_bytes(), Path::new("m.uff")).unwrap();
    assert_eq!(found.node_tags, Some(vec![5, 6]));
    assert_eq!(found.points, None);
    assert_eq!(found.shapes[1], [0.0, 0.0, 0.0, 7.0, 8.0, 9.0]);
}

#[test]
fn turned_axes_are_refused_and_global_ones_are_not() {
    let node = "    -1\n  2411\n 5 1 3 1\n 0. 0. 0.\n    -1\n";
    let system = |row: &str| format!("    -1\n  2420\n 1\npart\n 3 0 8\nname\n{row}\n 0. 0. 1.\n 0. 0. 0.\n    -1\n");
    let mode = real_mode(" 5\n 1. 2. 3.\n");
    let read = |row: &str| {
        let file = format!("{node}{}{mode}", system(row));
        modes_from_bytes(file.as_bytes(), Path::new("m.uff"))
    };
    assert!(read(" 1. 0. 0.\n 0. 1. 0.").is_ok());
    assert_eq!(
        read(" 0. 1. 0.\n -1. 0. 0.").unwrap_err().to_string(),
        "m.uff:3: expected displacements along the global axes, found node 5 in the turned coordinate system 3"
    );
}

#[test]
fn errors_fire_with_their_exact_messages() {
    let cases = [
        (real_mode(" 5\n 1. x 3.\n"), "m.uff:12: expected values at a node, found \"1. x 3.\""),
        (real_mode(" 5\n 1. 2.\n"), "m.uff:13: expected values at a node, found \"-1\""),
        (
            real_mode(" 5\n 1. 2. 3.\n 5\n 1. 2. 3.\n"),
            "m.uff:13: expected the label of a node, once a mode, found \"5\"",
        ),
        (
            real_mode("").replace("    -1\n    55\n", "    -1\n    5x5\n"),
            "m.uff:2: expected the number of a dataset, found \"5x5\"",
        ),
        (
            real_mode("").replace(" 8 2 3", " 8 3 3"),
            "m.uff:8: expected data type 2 or 4 (real), 5 or 6 (complex) (fifth number), found \"1 2 2 8 3 3\"",
        ),
        (
            real_mode("").replace(" 8 2 3", " 8 2 2"),
            "m.uff:8: expected 3 or 6 values a node (sixth number), found \"1 2 2 8 2 2\"",
        ),
        (
            real_mode("").trim_end().trim_end_matches("-1").to_owned(),
            "m.uff:12: expected a node or -1, found the end of the file",
        ),
        (
            "    -1\n  2411\n 1 0 0 0\n 1. 2. z\n    -1\n".to_owned(),
            "m.uff:4: expected three coordinates of a node, found \"1. 2. z\"",
        ),
        (
            "nothing".to_owned(),
            "m.uff: expected mode shapes (dataset 55 of analysis type 2, 3 or 7 with displacements in space), found none",
        ),
        (real_mode(""), "m.uff: expected at least one mode at one point, found 1 modes at 0 points"),
    ];
    for (file, expected) in cases {
        let error = modes_from_bytes(file.as_bytes(), Path::new("m.uff")).unwrap_err();
        assert_eq!(error.to_string(), expected, "{file}");
    }
    let error = read_modes_uff(Path::new("no/such.uff")).unwrap_err().to_string();
    assert!(error.starts_with("cannot read no/such.uff: "), "{error}");
}

proptest! {
    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = modes_from_bytes(&bytes, Path::new("r.uff"));
    }

    /// Bytes of a file replaced, removed and repeated: an error or mode shapes that are sound.
    #[test]
    fn damaged_files_never_panic(
        edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4_u8), 1..6),
    ) {
        let mut bytes = measured();
        for (place, byte, what) in edits {
            let place = place.index(bytes.len());
            match what {
                0 => bytes[place] = byte,
                1 => bytes[place] = b"-10 \n9ED."[usize::from(byte) % 9],
                2 => drop(bytes.drain(place..(place + usize::from(byte)).min(bytes.len()))),
                _ => bytes.extend_from_within(place..),
            }
            if bytes.is_empty() {
                break;
            }
        }
        if let Ok(modes) = modes_from_bytes(&bytes, Path::new("d.uff")) {
            prop_assert!(modes.check().is_ok());
        }
    }
}
