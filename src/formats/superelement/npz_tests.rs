//! Superelements in archives: written and read back, as other programs write them, and what does not fit.

use std::path::Path;

use super::samples::{dense, record};
use super::*;
use crate::files::FileError;
use crate::formats::{DofBody, DofDirection, DofLabel, FormatError, NpzReader, NpzWriter};

/// Name, shape and values of an array.
type Array<'a> = (&'a str, &'a [usize], &'a [f64]);
/// Something done to a sound record.
type Change<'a> = &'a dyn Fn(&mut SuperelementRecord);

/// An archive of matrices, rows after one another.
fn archive(path: &Path, arrays: &[Array]) {
    let mut npz = NpzWriter::create(path).unwrap();
    for (name, shape, values) in arrays {
        let mut array = npz.begin(name, shape).unwrap();
        array.extend(values).unwrap();
        array.end().unwrap();
    }
    npz.array("n_interface", &[1_i64]).unwrap();
    npz.finish().unwrap();
}

const K: [f64; 4] = [3.0, 0.0, 0.0, 16.0];
const M: [f64; 4] = [2.0, 0.5, 0.5, 4.0];

#[test]
fn a_superelement_comes_back_bit_by_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("superelement.npz");
    let whole = record();
    write_superelement_npz(&path, &whole).unwrap();
    assert_eq!(read_superelement_npz(&path).unwrap(), whole);
    let mut npz = NpzReader::open(&path).unwrap();
    let dofs = npz.i64("interface_dofs").unwrap();
    assert_eq!((dofs.shape, dofs.values), (vec![2, 2], vec![7, 1, 7, 3]));
    let weight = npz.f64("weight").unwrap();
    assert_eq!(weight.shape, [4, 3]);
    assert_eq!(weight.values[..3], [1.5, 0.0, 0.25]);
    let names = npz.texts("sensor_names").unwrap().values;
    assert_eq!(names, ["foot", "Lager 2, außen"]);
    assert_eq!(npz.f64("field_recovery").unwrap().shape, [6, 4]);

    let bare =
        SuperelementRecord::of_matrices(whole.stiffness.clone(), whole.mass.clone(), whole.interface.clone()).unwrap();
    write_superelement_npz(&path, &bare).unwrap();
    let found = read_superelement_npz(&path).unwrap();
    assert_eq!(found, bare);
    assert!(found.sensors.is_empty() && found.field.is_none() && found.damping.is_none());
    let names = NpzReader::open(&path).unwrap().names();
    assert!(!names.contains(&"c".to_owned()), "{names:?}");
}

/// All bodies and directions; positions and axes that are not known.
#[test]
fn labels_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("superelement.npz");
    let known = record().interface[0];
    let interface = vec![
        DofLabel { body: DofBody::Ring, node: 0, direction: DofDirection::Polar(1), ..known },
        DofLabel { direction: DofDirection::About(2), position: [f64::NAN; 3], ..known },
        DofLabel::centre(1, 4, [0.1, -0.2, 0.3]),
    ];
    let sample = record();
    let record = SuperelementRecord::of_matrices(sample.stiffness, sample.mass, interface.clone()).unwrap();
    assert_eq!(record.modal_hz, [sample.modal_hz[1]]);
    let labels = record.labels();
    assert_eq!(labels.len(), 4);
    assert_eq!((labels[3].body, labels[3].node), (DofBody::Modal, 0));
    write_superelement_npz(&path, &record).unwrap();
    let found = read_superelement_npz(&path).unwrap().interface;
    let plain = |label: &DofLabel| {
        let bits = |vector: [f64; 3]| vector.map(f64::to_bits);
        let place = (bits(label.position), bits(label.axis));
        (label.body, label.node, label.direction, place)
    };
    let found: Vec<_> = found.iter().map(plain).collect();
    assert_eq!(found, interface.iter().map(plain).collect::<Vec<_>>());
}

/// The least that another program may write, a little asymmetric.
#[test]
#[allow(clippy::float_cmp)] // the same roundings
fn the_least_is_enough() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.npz");
    let m = [2.0, 0.5 + 1e-7, 0.5 - 1e-7, 4.0];
    archive(&path, &[("k", &[2, 2], &K), ("m", &[2, 2], &m)]);
    let found = read_superelement_npz(&path).unwrap();
    let [label] = found.interface[..] else {
        panic!("{:?}", found.interface);
    };
    let expected = (DofBody::Interface, 0, DofDirection::Generalised);
    assert_eq!((label.body, label.node, label.direction), expected);
    assert!(label.position.iter().all(|value| value.is_nan()));
    // sqrt(16 / 4) / 2 pi, the same two roundings
    assert_eq!(found.modal_hz, [2.0 / std::f64::consts::TAU]);
    // the mean of both triangles is exact here
    assert_eq!(found.mass, dense(&[[2.0, 0.5], [0.5, 4.0]]));

    let mut npz = NpzWriter::create(&path).unwrap();
    npz.matrix("k", 2, 2, &K).unwrap();
    npz.matrix("m", 2, 2, &M).unwrap();
    npz.matrix("interface_dofs", 1, 2, &[44_i32, 5]).unwrap();
    npz.matrix("sensors", 2, 2, &[1_i32, 0, 0, 1]).unwrap();
    npz.finish().unwrap();
    let found = read_superelement_npz(&path).unwrap();
    let label = found.interface[0];
    let expected = (DofBody::Housing, 44, DofDirection::About(1));
    assert_eq!((label.body, label.node, label.direction), expected);
    assert_eq!(label.axis, [0.0, 1.0, 0.0]);
    assert_eq!(found.sensors[1].name, "sensor 2");
    assert_eq!(found.sensors[1].row, [0.0, 1.0]);
}

#[test]
fn what_does_not_fit_is_told_with_file_and_array() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.npz");
    let whole: [f64; 6] = [1.0; 6];
    let near = [3.0, 1e-3, 0.0, 16.0];
    let cases: [(&[Array], &str); 12] = [
        (
            &[("k", &[2, 3], &whole), ("m", &[2, 2], &M)],
            "array \"k\": expected a square matrix of at least one row, found 2 x 3",
        ),
        (&[("k", &[4], &K), ("m", &[2, 2], &M)], "array \"k\": expected two dimensions, found shape [4]"),
        (&[("k", &[2, 2], &K), ("m", &[1, 1], &M[..1])], "array \"m\": expected 1 x 2, found 1 x 1"),
        (&[("k", &[2, 2], &K), ("m", &[3, 2], &whole)], "array \"m\": expected 2 x 2, found 3 x 2"),
        (
            &[("k", &[2, 2], &[3.0, f64::NAN, 0.0, 1.0]), ("m", &[2, 2], &M)],
            "array \"k\": expected finite numbers, found NaN at [0, 1]",
        ),
        (
            &[("k", &[2, 2], &near), ("m", &[2, 2], &M)],
            "array \"k\": expected a symmetric matrix, found 0 at [1, 0] and 0.001 at [0, 1], which differ by more than \
             0.000016",
        ),
        (
            &[("k", &[2, 2], &K), ("m", &[2, 2], &K[..]), ("modal_hz", &[2], &[1.0, 2.0])],
            "array \"modal_hz\": expected 1 entries, found 2",
        ),
        (
            &[("k", &[2, 2], &K), ("m", &[2, 2], &M), ("modal_hz", &[1], &[2.0])],
            "array \"modal_hz\": expected sqrt(k/m)/2pi = 0.3183098861837907 Hz at [0], found 2 (interface coordinates \
             come first, modes after them)",
        ),
        (
            &[("k", &[2, 2], &K), ("m", &[2, 2], &[1.0, 0.0, 0.0, 0.0])],
            "array \"m\": expected a mass > 0 of modal coordinate 1, found 0",
        ),
        (
            &[("k", &[2, 2], &K), ("m", &[2, 2], &M), ("weight", &[2, 2], &K)],
            "array \"weight\": expected 2 x 3, found 2 x 2",
        ),
        (
            &[("k", &[2, 2], &K), ("m", &[2, 2], &M), ("band_hz", &[1], &[-1.0])],
            "array \"band_hz\": expected one number above zero, found [-1.0]",
        ),
        (&[("k", &[2, 2], &K)], "expected an array \"m\", found \"k\", \"n_interface\""),
    ];
    for (arrays, expected) in cases {
        archive(&path, arrays);
        let error = read_superelement_npz(&path).unwrap_err().to_string();
        assert_eq!(error, format!("{}: {expected}", path.display()));
    }
    // interfaces
    let message = |fill: &dyn Fn(&mut NpzWriter)| {
        let mut npz = NpzWriter::create(&path).unwrap();
        npz.matrix("k", 2, 2, &K).unwrap();
        npz.matrix("m", 2, 2, &M).unwrap();
        fill(&mut npz);
        npz.finish().unwrap();
        let error = read_superelement_npz(&path).unwrap_err().to_string();
        error[path.display().to_string().len() + 2..].to_owned()
    };
    assert_eq!(message(&|_| ()), "expected an array \"interface_dofs\" or \"n_interface\", found \"k\", \"m\"");
    assert_eq!(
        message(&|npz| npz.array("n_interface", &[3_i64]).unwrap()),
        "array \"n_interface\": expected a number from 0 to that of the rows of \"k\", found 3"
    );
    assert_eq!(
        message(&|npz| npz.array("n_interface", &[1.0]).unwrap()),
        "array \"n_interface\": expected whole numbers (i8, i4 or u4), found '<f8'"
    );
    assert_eq!(
        message(&|npz| npz.matrix("interface_dofs", 3, 2, &[1_i64; 6]).unwrap()),
        "array \"interface_dofs\": expected at most as many rows as \"k\", found 3 rows, where \"k\" has 2"
    );
    assert_eq!(
        message(&|npz| npz.matrix("interface_dofs", 2, 2, &[1_i64; 4]).unwrap()),
        "array \"interface_dofs\": expected each once, found rows 0 and 1 alike"
    );
    assert_eq!(
        message(&|npz| npz.matrix("interface_dofs", 1, 2, &[1_i64, 10]).unwrap()),
        "array \"interface_dofs\": expected components 0 to 9, found 10"
    );
    assert_eq!(
        message(&|npz| npz.matrix("interface_dofs", 1, 2, &[-1_i64, 1]).unwrap()),
        "array \"interface_dofs\": expected nodes >= 0, found -1"
    );
    assert_eq!(
        message(&|npz| {
            npz.matrix("interface_dofs", 1, 2, &[1_i64, 1]).unwrap();
            npz.texts("interface_bodies", &["shaft"]).unwrap();
        }),
        "array \"interface_bodies\": expected \"housing\", \"ring\", \"interface\" or \"modal\", found \"shaft\""
    );
    assert_eq!(
        message(&|npz| {
            npz.matrix("interface_dofs", 1, 2, &[1_i64, 1]).unwrap();
            npz.array("interface_positions", &[1.0, 2.0, 3.0]).unwrap();
        }),
        "array \"interface_positions\": expected three numbers for each of its nodes, found shape [3]"
    );
}

#[test]
fn a_record_that_contradicts_itself_is_not_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.npz");
    let message = |change: Change| {
        let mut record = record();
        change(&mut record);
        let error = write_superelement_npz(&path, &record).unwrap_err();
        assert!(matches!(error, FormatError::Data(_)));
        assert!(!path.exists());
        error.to_string()
    };
    let cases: [(Change, &str); 9] = [
        (
            &|record| record.interface = vec![record.interface[0]; 5],
            "expected at most 4 interface coordinates (rows of \"k\"), found 5",
        ),
        (
            &|record| record.interface[1].direction = DofDirection::Along(3),
            "array \"interface_dofs\": expected an axis 0, 1 or 2 in row 1, found 3",
        ),
        (
            &|record| record.interface[1].position[2] = f64::NAN,
            "array \"interface_positions\": expected three finite numbers or NaN for all in row 1, found [0.1, 0.2, NaN]",
        ),
        (
            &|record| record.sensors[1].name = "foot".to_owned(),
            "array \"sensor_names\": expected each name once, found \"foot\" twice",
        ),
        (&|record| record.sensors[0].row.truncate(3), "array \"sensors\": expected 2 x 4, found 2 x 3"),
        (
            &|record| record.sensors[1].row[2] = f64::INFINITY,
            "array \"sensors\": expected finite numbers, found inf at [1, 2]",
        ),
        (
            &|record| record.field.as_mut().unwrap().node_tags[1] = 7,
            "array \"field_node_tags\": expected each node once, found 7 twice",
        ),
        (
            &|record| record.field.as_mut().unwrap().positions.truncate(1),
            "array \"field_positions\": expected 2 entries, found 1",
        ),
        (
            &|record| record.structural.as_mut().unwrap()[(3, 0)] = 7.0,
            "array \"structural\": expected a symmetric matrix, found 7 at [3, 0] and 0 at [0, 3], which differ by more \
             than 6",
        ),
    ];
    for (change, expected) in cases {
        assert_eq!(message(change), expected);
    }
    let mut far = record();
    far.interface[0].node = u64::MAX;
    let error = write_superelement_npz(&path, &far).unwrap_err();
    assert!(error.to_string().ends_with("found 18446744073709551615"));
    let error = read_superelement_npz(&path).unwrap_err();
    assert!(matches!(error, FormatError::File(FileError::Read { .. })));
}

/// A superelement on modes of an interface of three coordinates.
fn on_modes() -> SuperelementRecord {
    let whole = record();
    let third = DofLabel { direction: DofDirection::About(1), ..whole.interface[0] };
    SuperelementRecord {
        interface_recovery: Some(InterfaceRecovery {
            labels: [whole.interface.clone(), vec![third]].concat(),
            modes: dense(&[[0.5, 0.1], [0.25, -1.0], [3.0, 1.0 / 3.0]]),
        }),
        interface: vec![DofLabel::interface(0), DofLabel::interface(1)],
        ..whole
    }
}

#[test]
fn the_way_back_to_an_interface_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("superelement.npz");
    let whole = on_modes();
    write_superelement_npz(&path, &whole).unwrap();
    let found = read_superelement_npz(&path).unwrap();
    assert_eq!(found.interface_recovery, whole.interface_recovery);
    let mut npz = NpzReader::open(&path).unwrap();
    let modes = npz.f64("interface_modes").unwrap();
    assert_eq!(modes.shape, [3, 2]);
    assert_eq!(modes.values[..2], [0.5, 0.1]);
    let dofs = npz.i64("recovered_dofs").unwrap();
    assert_eq!(dofs.values, [7, 1, 7, 3, 7, 5]);
    assert_eq!(npz.i64("interface_dofs").unwrap().values, [0, 0, 1, 0]);
}

#[test]
fn a_way_back_that_does_not_fit_is_named() {
    let fault = |change: Change| {
        let mut whole = on_modes();
        change(&mut whole);
        whole.check().unwrap_err().to_string()
    };
    fn recovery(record: &mut SuperelementRecord) -> &mut InterfaceRecovery {
        record.interface_recovery.as_mut().unwrap()
    }
    for (change, message) in [
        (
            &(|r: &mut SuperelementRecord| recovery(r).labels.truncate(2)) as Change,
            "array \"interface_modes\": expected 2 x 2, found 3 x 2",
        ),
        (
            &|r| recovery(r).labels[2] = recovery(r).labels[0],
            "array \"recovered_dofs\": expected each once, found rows 0 and 2 alike",
        ),
        (
            &|r| recovery(r).modes[(2, 1)] = f64::INFINITY,
            "array \"interface_modes\": expected finite numbers, found inf at [2, 1]",
        ),
    ] {
        assert_eq!(fault(change), message);
    }
}
