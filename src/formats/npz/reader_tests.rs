//! Archives read back, archives of NumPy's other habits, damage.

use std::fs;
use std::io::{Cursor, Write};
use std::path::Path;

use proptest::prelude::*;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

use super::super::mode_shapes::samples::two_modes;
use super::super::{FormatError, ModeShapes};
use super::*;
use crate::numerics::linalg::SparseMatrix;

/// An archive of entries given as header text and bytes.
pub(super) fn archive(entries: &[(&str, &str, &[u8])], method: CompressionMethod) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, header, values) in entries {
        let options = SimpleFileOptions::DEFAULT.compression_method(method);
        zip.start_file(format!("{name}.npy"), options).unwrap();
        zip.write_all(b"\x93NUMPY\x01\x00").unwrap();
        zip.write_all(&(header.len() as u16).to_le_bytes()).unwrap();
        zip.write_all(header.as_bytes()).unwrap();
        zip.write_all(values).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

fn open(folder: &Path, bytes: &[u8]) -> Result<NpzReader, FormatError> {
    let path = folder.join("a.npz");
    fs::write(&path, bytes).unwrap();
    NpzReader::open(&path)
}

pub(super) fn le(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

#[test]
fn arrays_are_read_in_both_orders_stored_and_deflated() {
    let folder = tempfile::tempdir().unwrap();
    // value = 100 i + 10 j + k at [i, j, k], first index fastest
    let mut fortran = Vec::new();
    for k in 0..4 {
        for j in 0..3 {
            for i in 0..2 {
                fortran.push(f64::from(100 * i + 10 * j + k));
            }
        }
    }
    let mut c_order = fortran.clone();
    c_order.sort_by(f64::total_cmp);
    let integers: Vec<u8> = [-5_i64, i64::MAX].iter().flat_map(|n| n.to_le_bytes()).collect();
    let fortran_header = "{'descr': '<f8', 'fortran_order': True, 'shape': (2, 3, 4), }";
    let entries: [(&str, &str, &[u8]); 3] = [
        ("cube", fortran_header, &le(&fortran)),
        ("tags", "{'descr': '<i8', 'fortran_order': False, 'shape': (2,), }", &integers),
        ("one", "{'descr': '<f8', 'fortran_order': False, 'shape': (), }", &le(&[2.5])),
    ];
    for method in [CompressionMethod::Stored, CompressionMethod::Deflated] {
        let mut npz = open(folder.path(), &archive(&entries, method)).unwrap();
        let cube = npz.f64("cube").unwrap();
        assert_eq!((cube.shape.as_slice(), &cube.values), (&[2, 3, 4][..], &c_order));
        assert_eq!(npz.i64("tags").unwrap().values, [-5, i64::MAX]);
        let one = npz.f64("one").unwrap();
        assert_eq!((one.shape, one.values), (vec![], vec![2.5]));
        assert!(npz.has("tags") && !npz.has("tag"));
    }
}

#[test]
fn modes_come_back_bit_by_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("modes.npz");
    let bare = ModeShapes { node_tags: None, points: None, ..two_modes() };
    for modes in [two_modes(), bare] {
        write_modes_npz(&path, &modes).unwrap();
        assert_eq!(read_modes_npz(&path).unwrap(), modes);
    }
    let mut npz = NpzReader::open(&path).unwrap();
    assert_eq!(npz.f64("shapes").unwrap().shape, [2, 3, 3]);
    let eigenvalue = npz.f64("eigenvalues").unwrap().values[0];
    // (2 pi 12.5)^2, a few roundings
    assert!((eigenvalue / 6_168.502_750_680_849 - 1.0).abs() < 1e-14);
    let wrong = ModeShapes { frequencies_hz: vec![1.0], ..two_modes() };
    let error = write_modes_npz(&path, &wrong).unwrap_err();
    assert!(matches!(error, FormatError::Data(_)));
    assert_eq!(error.to_string(), "expected a shape for each of 1 frequencies, found 2 shapes");
}

/// Type, shape and bytes of an array, by the independent reader `npyz`.
#[test]
fn texts_bytes_and_sparse_matrices_have_scipy_s_layout() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("k.npz");
    let matrix = SparseMatrix::new_csc((3, 2), vec![0, 2, 3], vec![0, 2, 1], vec![1.5, -2.0, 1e-300]);
    write_sparse_npz(&path, &matrix).unwrap();
    let entry = |name: &str| {
        let file = fs::File::open(&path).unwrap();
        let mut zip = ZipArchive::new(file).unwrap();
        let mut bytes = Vec::new();
        let mut entry = zip.by_name(&format!("{name}.npy")).unwrap();
        std::io::Read::read_to_end(&mut entry, &mut bytes).unwrap();
        bytes
    };
    let integers = |name: &str| {
        let bytes = entry(name);
        let npy = npyz::NpyFile::new(&bytes[..]).unwrap();
        npy.into_vec::<i32>().unwrap()
    };
    assert_eq!(integers("indices"), [0, 2, 1]);
    assert_eq!(integers("indptr"), [0, 2, 3]);
    let bytes = entry("shape");
    let npy = npyz::NpyFile::new(&bytes[..]).unwrap();
    assert_eq!(npy.into_vec::<i64>().unwrap(), [3, 2]);
    let bytes = entry("data");
    let npy = npyz::NpyFile::new(&bytes[..]).unwrap();
    assert_eq!(npy.into_vec::<f64>().unwrap(), [1.5, -2.0, 1e-300]);
    let bytes = entry("format");
    let npy = npyz::NpyFile::new(&bytes[..]).unwrap();
    assert_eq!((npy.dtype().descr(), npy.shape()), ("'|S3'".to_owned(), &[][..]));
    assert!(bytes.ends_with(b"\ncsc"));
    let mut npz = NpzWriter::create(&path).unwrap();
    npz.texts("groups", &["body", "éèê", ""]).unwrap();
    npz.texts("empty", &[""]).unwrap();
    npz.finish().unwrap();
    let bytes = entry("empty");
    let npy = npyz::NpyFile::new(&bytes[..]).unwrap();
    // NumPy's shortest text
    assert_eq!(npy.dtype().descr(), "'<U1'");
    let bytes = entry("groups");
    let npy = npyz::NpyFile::new(&bytes[..]).unwrap();
    assert_eq!(npy.dtype().descr(), "'<U4'");
    assert_eq!(npy.into_vec::<String>().unwrap(), ["body", "éèê", ""]);
}

#[test]
fn errors_fire_with_their_exact_messages() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.npz");
    let head = |descr: &str, shape: &str| format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}");
    let values = le(&[1.0, 2.0]);
    let cases = [
        (head("<f4", "(4,)"), "expected numbers of type '<f8', found '<f4'"),
        (head("<f8", "(3,)"), "expected as many values as the shape has, found fewer values than shape [3] has"),
        (head("<f8", "(1,)"), "expected as many values as the shape has, found more values than shape [1] has"),
        (head("<f8", "(1, 1, 1, 2)"), "expected up to three dimensions, found 4"),
        (
            head("<f8", "(99999999999, 99999999999)"),
            "expected a shape that memory can hold, found [99999999999, 99999999999]",
        ),
        (head("<f8", "2"), "expected a NumPy array, found a damaged header"),
    ];
    for (header, expected) in cases {
        let bytes = archive(&[("x", &header, &values)], CompressionMethod::Stored);
        let error = open(folder.path(), &bytes).unwrap().f64("x").unwrap_err();
        let expected = format!("{}: array \"x\": {expected}", path.display());
        assert_eq!(error.to_string(), expected);
    }
    let bytes = archive(&[("x", &head("<f8", "(2,)"), &values)], CompressionMethod::Stored);
    fs::write(&path, &bytes).unwrap();
    let error = read_modes_npz(&path).unwrap_err().to_string();
    let expected = format!("{}: expected an array \"frequencies_hz\", found \"x\"", path.display());
    assert_eq!(error, expected);
    // a bit of the last value: the checksum tells
    let mut flipped = bytes.clone();
    let place = bytes.windows(16).position(|window| window == values).unwrap();
    flipped[place] ^= 1;
    let error = open(folder.path(), &flipped).unwrap().f64("x").unwrap_err();
    assert!(matches!(error, FormatError::Damaged { .. }), "{error}");
    let none = archive(&[], CompressionMethod::Stored);
    let error = open(folder.path(), &none).unwrap().f64("x").unwrap_err();
    let expected = format!("{}: expected an array \"x\", found no arrays", path.display());
    assert_eq!(error.to_string(), expected);
    let error = open(folder.path(), b"mode,frequency_hz").unwrap_err().to_string();
    let expected = format!("{}: expected a NumPy archive (.npz), found ", path.display());
    assert!(error.starts_with(&expected), "{error}");
}

/// Versions 2 and 3 have four bytes for the header's length, which is not believed beyond reason.
#[test]
fn later_versions_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }";
    let version = |version: u8, length: u32| {
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        zip.start_file("x.npy", SimpleFileOptions::DEFAULT).unwrap();
        zip.write_all(b"\x93NUMPY").unwrap();
        zip.write_all(&[version, 0]).unwrap();
        zip.write_all(&length.to_le_bytes()).unwrap();
        zip.write_all(header.as_bytes()).unwrap();
        zip.write_all(&le(&[1.5, -2.5])).unwrap();
        let bytes = zip.finish().unwrap().into_inner();
        open(folder.path(), &bytes).unwrap().f64("x")
    };
    for number in [2, 3] {
        let found = version(number, header.len() as u32).unwrap();
        assert_eq!(found.values, [1.5, -2.5]);
    }
    for (number, length) in [(4, header.len() as u32), (2, 1 << 20)] {
        let error = version(number, length).unwrap_err().to_string();
        assert!(error.ends_with("expected a NumPy array, found a damaged header"), "{error}");
    }
}

proptest! {
    /// Bytes replaced, removed and repeated: an error or mode shapes that are sound.
    #[test]
    fn damaged_archives_never_panic(
        deflated in any::<bool>(),
        edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4_u8), 0..6),
    ) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("m.npz");
        let f8 = |shape: &str| format!("{{'descr': '<f8', 'fortran_order': True, 'shape': {shape}, }}");
        let entries: [(&str, &str, &[u8]); 2] = [
            ("frequencies_hz", &f8("(2,)"), &le(&[1.0, 2.0])),
            ("shapes", &f8("(2, 2, 3)"), &le(&[1.0; 12])),
        ];
        let method = [CompressionMethod::Stored, CompressionMethod::Deflated][usize::from(deflated)];
        let mut bytes = archive(&entries, method);
        let whole = edits.is_empty();
        for (place, byte, what) in edits {
            let place = place.index(bytes.len().max(1)).min(bytes.len().saturating_sub(1));
            match what {
                0 | 1 if !bytes.is_empty() => bytes[place] = byte,
                2 => drop(bytes.drain(place..(place + usize::from(byte)).min(bytes.len()))),
                3 => bytes.extend_from_within(place..),
                _ => {}
            }
        }
        fs::write(&path, &bytes).unwrap();
        match read_modes_npz(&path) {
            Ok(modes) => prop_assert!(modes.check().is_ok()),
            Err(error) => prop_assert!(!whole, "{}", error),
        }
    }
}
