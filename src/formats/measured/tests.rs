//! Measured signals: what the tests of each format share, universal files, damage.

use std::fs;
use std::path::{Path, PathBuf};

use proptest::prelude::*;

use super::super::NpzWriter;
use super::*;

/// `x_k = sin(0.7 k) + k / 8`.
pub(super) fn sample(k: usize) -> f64 {
    (0.7 * k as f64).sin() + k as f64 / 8.0
}

pub(super) fn samples(count: usize) -> Vec<f64> {
    (0..count).map(sample).collect()
}

pub(super) fn request(channels: &[&str], rate_hz: Option<f64>) -> SignalRequest {
    SignalRequest { channels: channels.iter().map(|&name| name.to_owned()).collect(), rate_hz }
}

pub(super) fn only(mut signals: Vec<MeasuredSignal>) -> MeasuredSignal {
    assert_eq!(signals.len(), 1);
    signals.remove(0)
}

/// A signal has these samples, to a part of their largest.
pub(super) fn assert_samples(signal: &MeasuredSignal, start_s: f64, step_s: f64, values: &[f64], part: f64) {
    let series = &signal.series;
    assert!((series.start_s() - start_s).abs() <= 1e-9 * step_s + part * start_s.abs());
    assert!((series.step_s() / step_s - 1.0).abs() < 1e-9 + part, "{}", series.step_s());
    assert_eq!(series.values().len(), values.len());
    let largest = values.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    for (found, expected) in series.values().iter().zip(values) {
        assert!((found - expected).abs() <= part * largest, "{found} {expected}");
    }
}
pub(super) fn archive(name: &str, write: impl FnOnce(&mut NpzWriter)) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    let mut npz = NpzWriter::create(&path).unwrap();
    write(&mut npz);
    npz.finish().unwrap();
    (folder, path)
}

pub(super) fn put(npz: &mut NpzWriter, name: &str, shape: &[usize], values: &[f64]) {
    let mut array = npz.begin(name, shape).unwrap();
    array.extend(values).unwrap();
    array.end().unwrap();
}

#[test]
fn universal_files_of_pyuff_are_read_as_text_and_binary() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/uff/times.uff");
    let values = samples(11);
    for (name, unit) in [("top", "m/s^2"), ("uneven", "m/s^2"), ("binary", "m/s^2"), ("FOOT", "g"), ("in g", "g")] {
        let found = only(read_signals(&path, &request(&[name], None)).unwrap());
        assert_eq!(found.series.unit(), unit, "{name}");
        // instants have six digits: 2e-6 of 2.5 s, 1e-4 of the step over ten steps; values have twelve
        let series = &found.series;
        assert!((series.start_s() - 2.5).abs() < 1e-5, "{name}");
        assert!((128.0 * series.step_s() - 1.0).abs() < 2e-4, "{name}");
        let step = series.step_s();
        assert_samples(&found, series.start_s(), step, &values, 1e-11);
    }
    let error = read_signals(&path, &request(&[], None)).unwrap_err();
    assert!(error.to_string().ends_with("found \"top\", \"uneven\", \"binary\", \"FOOT\", \"in g\""));
    let none = path.with_file_name("millimetre.uff");
    let error = read_signals(&none, &request(&[], None)).unwrap_err();
    assert!(error.to_string().ends_with("abscissa 17), found none"));
}

/// A dataset 58b of function type 1 over time with these words of its first line and these bytes.
fn binary_times(first: &str, form: &str, bytes: &[u8]) -> Vec<u8> {
    let head = format!(
        "    -1\n    58b {first}\nown\nNONE\nNONE\nNONE\nNONE\n    1         0    0         0       FOOT        17  -3       NONE         0   0\n\
         {form}\n        17    0    0    0 Time                 s\n        12    0    0    0 Acceleration         m/s2\n\
         \x20        0    0    0    0 NONE                 NONE\n         0    0    0    0 NONE                 NONE\n"
    );
    [head.as_bytes(), bytes, b"\n    -1\n"].concat()
}

#[test]
fn binary_numbers_of_both_orders_and_precisions_are_read() {
    use super::super::uff::times_from_bytes;
    let values: Vec<f64> = (0..7).map(|k| f64::from(k) - 2.5).collect();
    let form =
        |kind: u32, spacing: u32| format!("{kind:>10}{:>10}{spacing:>10}  0.00000e+00  2.50000e-01  0.00000e+00", 7);
    let path = Path::new("b.uff");
    let big: Vec<u8> = values.iter().flat_map(|v| v.to_be_bytes()).collect();
    let small: Vec<u8> = values.iter().flat_map(|&v| (v as f32).to_le_bytes()).collect();
    let pairs = (0_u8..).map(|k| 0.25 * f64::from(k)).zip(&values);
    let uneven: Vec<u8> = pairs.flat_map(|(t, v)| [t.to_le_bytes(), v.to_le_bytes()].concat()).collect();
    for (first, form, bytes) in [
        ("2 2 11 56 0 0 0 0", form(4, 1), &big),
        ("1 2 11 28 0 0 0 0", form(2, 1), &small),
        ("1 2 11 112 0 0 0 0", form(4, 0), &uneven),
    ] {
        let found = times_from_bytes(&binary_times(first, &form, bytes), path).unwrap();
        assert_eq!(found[0].values, values, "{first}");
    }
    let message = |first: &str, form: &str, bytes: &[u8]| {
        let error = times_from_bytes(&binary_times(first, form, bytes), path);
        error.unwrap_err().to_string()
    };
    assert_eq!(
        message("1 1 11 56 0 0 0 0", &form(4, 1), &big),
        "b.uff:2: expected numbers of IEEE 754 (number format 2), found \"58b 1 1 11 56 0 0 0 0\""
    );
    assert_eq!(
        message("1 2 11 48 0 0 0 0", &form(4, 1), &big[..48]),
        "b.uff:2: expected as many values as the data has, found 6 of 7"
    );
    let huge = form(4, 1).replacen("         7", "1152921504606846976", 1);
    assert!(message("1 2 11 56 0 0 0 0", &huge, &big).contains("expected"));
}

#[test]
fn files_of_other_kinds_and_none_are_refused() {
    let any = request(&[], None);
    let error = read_signals(Path::new("signal.xls"), &any).unwrap_err();
    assert_eq!(
        error.to_string(),
        "signal.xls: expected a file .npz, .mat, .csv, .txt, .tsv, .asc, .lvm, .wav, .uff or .unv, or a folder with results of `plummer run`"
    );
    for name in ["no.npz", "no.mat", "no.csv", "no.wav", "no.uff"] {
        let error = read_signals(Path::new(name), &any).unwrap_err().to_string();
        assert!(error.starts_with(&format!("cannot read {name}: ")), "{error}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn damaged_files_never_panic(
        format in 0..4_usize,
        cut in 0..1000_usize,
        changes in prop::collection::vec((0..4000_usize, any::<u8>()), 0..6),
    ) {
        let folder = tempfile::tempdir().unwrap();
        let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/uff/times.uff");
        let path = folder.path().join(["f.uff", "f.csv", "f.wav", "f.npz"][format]);
        match format {
            0 => { fs::copy(&data, &path).unwrap(); }
            1 => fs::write(&path, "time,P1\n0,1\n1,2\n2,5\n").unwrap(),
            2 => {
                let spec = hound::WavSpec {
                    channels: 1, sample_rate: 8000, bits_per_sample: 16, sample_format: hound::SampleFormat::Int,
                };
                let mut to = hound::WavWriter::create(&path, spec).unwrap();
                (0..40_i16).for_each(|k| to.write_sample(k).unwrap());
                to.finalize().unwrap();
            }
            _ => {
                let mut npz = NpzWriter::create(&path).unwrap();
                put(&mut npz, "time_s", &[3], &[0.0, 1.0, 2.0]);
                put(&mut npz, "P1", &[3], &[0.0, 1.0, 2.0]);
                npz.finish().unwrap();
            }
        }
        let mut bytes = fs::read(&path).unwrap();
        for (place, byte) in changes {
            let length = bytes.len();
            bytes[place % length] = byte;
        }
        bytes.truncate(bytes.len().saturating_sub(cut % 97));
        fs::write(&path, &bytes).unwrap();
        for rate in [None, Some(1e3)] {
            for name in [&[][..], &["P1"], &["top"], &["binary"]] {
                if let Ok(found) = read_signals(&path, &request(name, rate)) {
                    for signal in found {
                        prop_assert!(signal.series.values().len() <= bytes.len());
                    }
                }
            }
        }
    }
}
