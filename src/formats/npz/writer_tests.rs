//! Archives written, read back by an independent reader; what is refused.

use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

use zip::CompressionMethod;

use super::super::FormatError;
use super::NpzWriter;

/// A directory of its own for each test, removed at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("plummer-npz-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).expect("temporary directory");
        Self(path)
    }

    fn files(&self) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(&self.0)
            .expect("readable")
            .map(|e| e.expect("entry").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Shape, order and values of one array, by an independent reader.
fn read(path: &Path, name: &str) -> (Vec<u64>, npyz::Order, Vec<f64>) {
    let mut archive = zip::ZipArchive::new(File::open(path).expect("file")).expect("zip");
    let mut entry = archive.by_name(&format!("{name}.npy")).expect("entry");
    assert_eq!(entry.compression(), CompressionMethod::Stored);
    let mut bytes = Vec::new();
    entry.read_to_end(&mut bytes).expect("entry is readable");
    let npy = npyz::NpyFile::new(&bytes[..]).expect("npy");
    (npy.shape().to_vec(), npy.order(), npy.into_vec().expect("f64"))
}

#[test]
fn arrays_come_back_bit_by_bit() {
    let scratch = Scratch::new("back");
    let path = scratch.0.join("signals.npz");
    let time: Vec<f64> = (0..1500).map(|k| f64::from(k) * 1e-5).collect();
    let matrix = [1.5, -0.0, f64::MIN_POSITIVE, 4e300, f64::INFINITY, 6.0];
    let mut npz = NpzWriter::create(&path).expect("create");
    npz.array("time_s", &time).expect("array");
    npz.matrix("ball radius.1", 2, 3, &matrix).expect("matrix");
    npz.array::<f64>("nothing", &[]).expect("empty array");
    let mut pieces = npz.begin("pieces", &[7, 100]).expect("begin");
    for piece in time[..700].chunks(33) {
        pieces.extend(piece).expect("piece");
    }
    pieces.end().expect("all there");
    npz.finish().expect("finish");
    assert_eq!(scratch.files(), ["signals.npz"]);
    assert_eq!(read(&path, "time_s"), (vec![1500], npyz::Order::C, time.clone()));
    let (shape, order, values) = read(&path, "ball radius.1");
    assert_eq!((shape, order), (vec![2, 3], npyz::Order::C));
    assert!(values.iter().zip(&matrix).all(|(a, b)| a.to_bits() == b.to_bits()));
    assert_eq!(read(&path, "nothing").0, [0]);
    assert_eq!(read(&path, "pieces"), (vec![7, 100], npyz::Order::C, time[..700].to_vec()));
}

#[test]
fn an_unfinished_archive_leaves_the_earlier_one_alone() {
    let scratch = Scratch::new("unfinished");
    let path = scratch.0.join("signals.npz");
    let write = |value: f64| {
        let mut npz = NpzWriter::create(&path).expect("create");
        npz.array("x", &[value]).expect("array");
        npz
    };
    write(1.0).finish().expect("finish");
    let abandoned = write(2.0);
    assert_eq!(scratch.files(), ["signals.npz", "signals.npz.partial"]);
    drop(abandoned);
    assert_eq!(scratch.files(), ["signals.npz"]);
    assert_eq!(read(&path, "x").2, [1.0]);
    write(3.0).finish().expect("finish");
    assert_eq!(read(&path, "x").2, [3.0]);
}

#[test]
fn errors_fire_with_their_exact_messages() {
    let scratch = Scratch::new("errors");
    let mut npz = NpzWriter::create(scratch.0.join("e.npz")).expect("create");
    let mut other = NpzWriter::create(scratch.0.join("o.npz")).expect("create");
    let message = |r: Result<(), FormatError>| r.expect_err("must fail").to_string();
    assert_eq!(
        message(npz.array("a/b", &[1.0])),
        "array name must be letters, digits, '_', '-', '.' or spaces, found \"a/b\""
    );
    assert!(message(npz.array("", &[1.0])).starts_with("array name"));
    npz.array("x", &[1.0]).expect("array");
    assert_eq!(message(npz.array("x", &[1.0])), "array \"x\" is already in the archive");
    assert_eq!(message(npz.matrix("m", 2, 2, &[1.0; 3])), "array \"m\" of shape [2, 2] takes 4 values, found 3");
    assert_eq!(message(npz.array("n", &[1.0])), "array \"m\" was begun and not completed");
    assert_eq!(message(other.matrix("n", 2, 2, &[1.0; 5])), "array \"n\" of shape [2, 2] takes 4 values, found 5");
    let mut third = NpzWriter::create(scratch.0.join("t.npz")).expect("create");
    // at once, not only at the end
    let early = (third.begin("p", &[2]).expect("begin")).extend(&[1.0; 3]);
    assert_eq!(message(early), "array \"p\" of shape [2] takes 2 values, found 3");
    drop(third);
    drop(other);
    assert_eq!(message(npz.finish()), "array \"m\" was begun and not completed");
    assert!(scratch.files().is_empty());
    let nowhere = scratch.0.join("missing").join("e.npz");
    let found = NpzWriter::create(&nowhere).expect_err("no such directory").to_string();
    assert!(found.starts_with(&format!("cannot write {}.partial: ", nowhere.display())));
}
