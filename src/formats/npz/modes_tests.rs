//! Mode shapes whose arrays do not fit each other.

use std::fs;

use zip::CompressionMethod;

use super::super::mode_shapes::samples::two_modes;
use super::reader_tests::{archive, le};
use super::{NpzReader, read_modes_npz, write_modes_npz};

#[test]
fn shapes_have_modes_nodes_and_directions() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.npz");
    let mut modes = two_modes();
    // as many nodes as directions would hide a wrong order
    modes.points.iter_mut().for_each(|points| points.truncate(2));
    modes.node_tags.iter_mut().for_each(|tags| tags.truncate(2));
    modes.shapes.iter_mut().for_each(|shape| shape.truncate(6));
    write_modes_npz(&path, &modes).unwrap();
    let mut npz = NpzReader::open(&path).unwrap();
    assert_eq!(npz.f64("shapes").unwrap().shape, [2, 2, 3]);
    assert_eq!(npz.f64("nodes").unwrap().shape, [2, 3]);
    assert_eq!(read_modes_npz(&path).unwrap(), modes);
    modes.node_tags = Some(vec![1, u64::MAX]);
    let error = write_modes_npz(&path, &modes).unwrap_err();
    assert_eq!(error.to_string(), "expected labels up to 9223372036854775807, found 18446744073709551615");
}

#[test]
fn arrays_that_do_not_fit_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.npz");
    let header =
        |descr: &str, shape: &str| format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}");
    let tags = |tags: [i64; 2]| tags.map(i64::to_le_bytes).concat();
    let fit = [
        ("frequencies_hz", "<f8", "(1,)", le(&[5.0])),
        ("shapes", "<f8", "(1, 2, 3)", le(&[1.0; 6])),
        ("nodes", "<f8", "(2, 3)", le(&[0.5; 6])),
        ("node_tags", "<i8", "(2,)", tags([4, 7])),
    ];
    let read = |entries: &[(&str, &str, &str, Vec<u8>)]| {
        let heads: Vec<String> = entries.iter().map(|(_, descr, shape, _)| header(descr, shape)).collect();
        let entries = entries.iter().zip(&heads);
        let entries: Vec<(&str, &str, &[u8])> =
            entries.map(|((name, _, _, bytes), head)| (*name, head.as_str(), bytes.as_slice())).collect();
        fs::write(&path, archive(&entries, CompressionMethod::Stored)).unwrap();
        read_modes_npz(&path)
    };
    assert_eq!(read(&fit).unwrap().node_tags, Some(vec![4, 7]));
    for (place, descr, shape, bytes, expected) in [
        (0, "<f8", "(1, 1)", le(&[5.0]), "array \"frequencies_hz\": expected one dimension, found shape [1, 1]"),
        (
            1,
            "<f8",
            "(2, 1, 3)",
            le(&[1.0; 6]),
            "array \"shapes\": expected a shape [modes, nodes, 3], found shape [2, 1, 3]",
        ),
        (
            1,
            "<f8",
            "(1, 3, 2)",
            le(&[1.0; 6]),
            "array \"shapes\": expected a shape [modes, nodes, 3], found shape [1, 3, 2]",
        ),
        (1, "<f8", "(1, 2, 3)", le(&[f64::NAN; 6]), "expected finite displacements in mode 1, found NaN at point 1"),
        (2, "<f8", "(3, 2)", le(&[0.5; 6]), "array \"nodes\": expected a shape [nodes, 3], found shape [3, 2]"),
        (3, "<i8", "(2, 1)", tags([4, 7]), "array \"node_tags\": expected a shape [nodes], found shape [2, 1]"),
        (3, "<i8", "(2,)", tags([4, -7]), "array \"node_tags\": expected labels >= 0, found -7"),
        (3, "<i8", "(2,)", tags([4, 4]), "expected each node once, found node 4 twice"),
    ] {
        let mut entries = fit.clone();
        entries[place] = (fit[place].0, descr, shape, bytes);
        let error = read(&entries).unwrap_err().to_string();
        assert_eq!(error, format!("{}: {expected}", path.display()));
    }
    let missing = read(&fit[2..]).unwrap_err().to_string();
    let expected = "expected an array \"frequencies_hz\", found \"nodes\", \"node_tags\"";
    assert_eq!(missing, format!("{}: {expected}", path.display()));
}
