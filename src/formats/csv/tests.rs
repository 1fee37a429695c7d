//! Tables of mode shapes: written and read back, spellings, faults.

use std::fs;
use std::path::Path;

use proptest::prelude::*;

use super::super::ModeShapes;
use super::super::mode_shapes::samples::two_modes;
use super::read::modes_from_bytes;
use super::*;

fn read(text: &str) -> Result<ModeShapes, String> {
    modes_from_bytes(text.as_bytes(), Path::new("m.csv")).map_err(|error| error.to_string())
}

#[test]
fn modes_come_back_bit_by_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("modes.csv");
    let by_node = ModeShapes { points: None, ..two_modes() };
    let by_point = ModeShapes { node_tags: None, ..two_modes() };
    write_modes_csv(&path, &two_modes()).unwrap();
    assert_eq!(read_modes_csv(&path).unwrap(), by_node);
    write_modes_csv(&path, &by_point).unwrap();
    assert_eq!(read_modes_csv(&path).unwrap(), by_point);
    let nowhere = ModeShapes { node_tags: None, ..by_node };
    let error = write_modes_csv(&path, &nowhere).unwrap_err().to_string();
    assert_eq!(error, "expected mode shapes with node labels or points, found neither");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn comments_blank_lines_semicolons_and_decimal_commas_are_read() {
    let expected = ModeShapes {
        frequencies_hz: vec![10.5, 20.0],
        node_tags: Some(vec![4, 2]),
        points: None,
        shapes: vec![vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0], vec![-1.0, 0.5, 0.0, 1e-3, 0.0, 0.0]],
        directions: None,
    };
    let comma = "# bench; 3 March\n\n Mode, Frequency_Hz, node, ux, uy, uz\n1,10.5,4,1,2,3\n\n# half\n\
                 1,10.5,2,4,5,6\n7,20,4,-1,0.5,0\n7,20,2,1e-3,0,0\n";
    assert_eq!(read(comma), Ok(expected.clone()));
    let semicolon = "\u{feff}mode;frequency_hz;node;ux;uy;uz\r\n1;10,5;4;1;2;3\r\n7;20;4;-1;0,5;0\r\n1;10.5;2;4;5;6\r\n\
                     7;20;2;1e-3;0;0\r\n;;;;;\r\n";
    let mixed = read(semicolon);
    assert_eq!(mixed, Ok(expected));
}

#[test]
fn errors_fire_with_their_exact_messages() {
    let node = "mode,frequency_hz,node,ux,uy,uz\n1,10,4,1,2,3\n";
    let cases = [
        (
            "mode,node,ux\n".to_owned(),
            "m.csv:1: expected the header mode,frequency_hz,x,y,z,ux,uy,uz or mode,frequency_hz,node,ux,uy,uz, found \
             \"mode,node,ux\"",
        ),
        (format!("{node}1,10,5,1,2\n"), "m.csv:3: expected 6 columns, found 5"),
        (format!("{node}1,10,5,1,two,3\n"), "m.csv:3: expected a number for uy, found \"two\""),
        (format!("{node}1,10,5,1,NaN,3\n"), "m.csv:3: expected a number for uy, found \"NaN\""),
        (format!("{node}1,10,-5,1,2,3\n"), "m.csv:3: expected a whole number for node, found \"-5\""),
        (format!("{node}# why\n1,11,5,1,2,3\n"), "m.csv:4: expected 10 Hz as in line 2, found \"11\""),
        (format!("{node}2,20,5,1,2,3\n"), "m.csv:3: expected node 4 as in the first mode, found node 5"),
        (
            format!("{node}2,20,4,1,2,3\n2,20,5,1,2,3\n"),
            "m.csv:4: expected 1 points as in the first mode, found node 5",
        ),
        (format!("{node}1,10,5,1,2,3\n2,20,4,1,2,3\n"), "m.csv:4: expected 2 points in every mode, found 1 in mode 2"),
        (format!("{node}1,10,4,1,2,3\n"), "m.csv: expected each node once, found node 4 twice"),
        ("# nothing\n".to_owned(), "m.csv: expected at least one mode at one point, found 0 modes at 0 points"),
    ];
    for (text, expected) in cases {
        assert_eq!(read(&text).unwrap_err(), expected, "{text}");
    }
    let error = read_modes_csv(Path::new("no/such.csv")).unwrap_err().to_string();
    assert!(error.starts_with("cannot read no/such.csv: "), "{error}");
}

proptest! {
    #[test]
    fn random_tables_never_panic(
        header in 0..3_usize,
        text in "[-0-9,;.e\n#\"a ]{0,200}",
        bytes in prop::collection::vec(any::<u8>(), 0..50),
    ) {
        let header = ["", "mode,frequency_hz,node,ux,uy,uz\n", "mode;frequency_hz;x;y;z;ux;uy;uz\n"][header];
        let mut file = format!("{header}{text}").into_bytes();
        file.extend(bytes);
        if let Ok(modes) = modes_from_bytes(&file, Path::new("r.csv")) {
            prop_assert!(modes.check().is_ok());
        }
    }
}

#[test]
fn one_direction_a_place_is_read() {
    let read = |text: &str| modes_from_bytes(text.as_bytes(), Path::new("bench.csv"));
    let real = "mode,frequency_hz,node,direction,value\n1,500,12,z,0.5\n1,500,12,-X,2\n1,500,17,3 0 4,-1\n";
    let modes = read(real).unwrap();
    assert_eq!(modes.node_tags, Some(vec![12, 12, 17]));
    assert_eq!(modes.directions, Some(vec![[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.6, 0.0, 0.8]]));
    assert_eq!(modes.shapes, [[0.0, 0.0, 0.5, -2.0, 0.0, 0.0, -0.6, 0.0, -0.8]]);
    // complex, at points, with semicolons and decimal commas: a real shape turned by 30 degrees is the real one, but for its sign
    let complex = "mode;frequency_hz;x;y;z;direction;value;imaginary\n\
                   1;500,5;0,01;0;0;z;0,866025403784439;0,5\n1;500,5;0,02;0;0;0,6 0,8 0;-1,732050807568877;-1\n";
    let modes = read(complex).unwrap();
    assert_eq!(modes.points, Some(vec![[0.01, 0.0, 0.0], [0.02, 0.0, 0.0]]));
    let expected = [0.0, 0.0, 1.0, -1.2, -1.6, 0.0];
    let apart = modes.shapes[0].iter().zip(expected).map(|(found, expected)| (found - expected).abs());
    assert!(apart.fold(0.0, f64::max) < 1e-12, "{:?}", modes.shapes);
    for (text, message) in [
        (
            "mode,frequency_hz,node,direction,value\n1,5,1,up,1\n",
            "bench.csv:2: expected a direction such as x, -y, +z or 0.6 0.8 0, found \"up\"",
        ),
        (
            "mode,frequency_hz,node,direction,value\n1,5,1,0 0 0,1\n",
            "bench.csv:2: expected a direction such as x, -y, +z or 0.6 0.8 0, found \"0 0 0\"",
        ),
        (
            "mode,frequency_hz,node,direction,value\n1,5,1,x,1\n1,5,1,-x,1\n",
            "bench.csv: expected each direction of a node once, found node 1 twice in one",
        ),
        (
            "mode,frequency_hz,node,direction,value\n1,5,1,x,1\n1,5,1,y,1\n2,6,1,y,1\n2,6,1,x,1\n",
            "bench.csv:4: expected node 1 along (1, 0, 0) as in the first mode, found node 1 along (0, 1, 0)",
        ),
        (
            "mode,frequency_hz,node,direction\n1,5,1,x\n",
            "bench.csv:1: expected the header mode,frequency_hz,x,y,z,direction,value or mode,frequency_hz,node,direction,value, and imaginary after it or not, found \"mode,frequency_hz,node,direction\"",
        ),
    ] {
        assert_eq!(read(text).unwrap_err().to_string(), message);
    }
}
