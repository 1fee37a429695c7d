//! MATLAB files: of SciPy, as published, of other versions, damaged.

use std::fs;
use std::path::{Path, PathBuf};

use super::super::tests::{assert_samples, only, request, samples};
use super::super::{MeasuredError, MeasuredSignal, SignalRequest, read_signals};
use super::signals_from_mat;

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/mat").join(name)
}

fn read(name: &str, request: &SignalRequest) -> Result<Vec<MeasuredSignal>, MeasuredError> {
    read_signals(&data(name), request)
}

fn one(name: &str, channel: &str) -> MeasuredSignal {
    only(read(name, &request(&[channel], None)).unwrap())
}

/// Names of all signals.
pub(super) fn names(bytes: &[u8]) -> Vec<String> {
    match signals_from_mat(bytes, Path::new("m.mat"), &request(&[""], None)) {
        Err(MeasuredError::NoChannel { known, .. }) => known,
        other => panic!("{other:?}"),
    }
}

/// Whole numbers near `10 x_k + 2`.
fn whole() -> Vec<f64> {
    let values = samples(12);
    values.iter().map(|x| (10.0 * x + 2.0).round()).collect()
}

#[test]
fn every_class_is_read_little_and_big_endian_and_packed() {
    let rate = |name: &'static str| request(&[name], Some(100.0));
    for name in ["int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64"] {
        let found = only(read("classes.mat", &rate(name)).unwrap());
        assert_samples(&found, 0.0, 0.01, &whole(), 0.0);
    }
    let flags: Vec<f64> = whole().iter().map(|x| f64::from(u8::from(*x > 5.0))).collect();
    let found = only(read("classes.mat", &rate("logical")).unwrap());
    assert_samples(&found, 0.0, 0.01, &flags, 0.0);
    for name in ["i1", "u1", "i2", "u2", "i4", "u4", "f4", "f8", "i8", "u8"] {
        assert_samples(&one("big.mat", name), 0.0, 2e-5, &whole(), 0.0);
    }
    // NumPy's sine differs in the last digit at most
    assert_samples(&one("big.mat", "packed"), 0.0, 2e-5, &samples(12), 1e-15);
}

#[test]
fn times_rates_and_speeds_stand_beside_signals() {
    let x = samples(12);
    let found = one("plain.mat", "x");
    assert_samples(&found, 0.5, 4e-3, &x, 1e-15);
    assert_eq!(found.speed_hz, Some(1797.0 / 60.0));
    // a rate that is asked for goes before the time, the first instant stays
    let asked = |name: &str| only(read("plain.mat", &request(&[name], Some(1e3))).unwrap());
    assert_samples(&asked("x"), 0.5, 1e-3, &x, 1e-15);
    assert_samples(&asked("short"), 0.0, 1e-3, &x[..5], 1e-15);
    let error = read("plain.mat", &request(&["short"], None)).unwrap_err();
    let expected = "array \"short\": expected a signal of 12 samples, as the time has, found 5 samples";
    assert!(error.to_string().ends_with(expected), "{error}");
    assert_eq!(names(&fs::read(data("plain.mat")).unwrap()), ["x", "short"]);
}

#[test]
fn tables_and_structs_have_the_names_of_matlab() {
    let x = samples(12);
    let double: Vec<f64> = x.iter().map(|x| 2.0 * x).collect();
    let minus: Vec<f64> = x.iter().map(|x| -x).collect();
    let expected = [
        ("tall(:,1)", 1e-3, &x[..], None),
        ("tall(:,2)", 1e-3, &double, None),
        ("wide(1,:)", 1e-3, &x, None),
        ("wide(2,:)", 1e-3, &double, None),
        // `rate` stands beside `sr`
        ("bearing.gs", 1.0 / 48_828.0, &x, Some(25.0)),
        // the rate is that of the struct around, the speed its own
        ("bearing.in.deep", 1.0 / 48_828.0, &minus, Some(1.5)),
        ("run(1).x", 0.01, &x, None),
        ("run(2).x", 0.005, &minus[..7], None),
    ];
    for (name, step_s, values, speed_hz) in expected {
        let found = one("bench.mat", name);
        assert_samples(&found, 0.0, step_s, values, 1e-15);
        assert_eq!((found.name.as_str(), found.speed_hz), (name, speed_hz));
    }
    // several at once, in any order
    let both = read("bench.mat", &request(&["run(2).x", "tall(:,2)", "tall(:,1)"], None)).unwrap();
    assert_eq!(both[1], one("bench.mat", "tall(:,2)"));
    // no cell, text, sparse, empty or solid array, no single number
    let mut known = names(&fs::read(data("bench.mat")).unwrap());
    known.retain(|name| expected.iter().all(|(other, ..)| name != other));
    assert_eq!(known, ["spectrum"]);
    let error = read("bench.mat", &request(&["spectrum"], None)).unwrap_err();
    let expected = "array \"spectrum\": expected a signal of real numbers, found complex numbers";
    assert!(error.to_string().ends_with(expected), "{error}");
    let error = read("bench.mat", &request(&["bearing.gd"], None)).unwrap_err();
    assert_eq!(error.help().unwrap(), "did you mean --channel 'bearing.gs'?");
}

#[test]
fn other_versions_are_refused_with_what_to_do() {
    let message = |bytes: &[u8]| {
        let error = signals_from_mat(bytes, Path::new("in/m.mat"), &SignalRequest::default());
        let error = error.unwrap_err();
        (error.to_string(), error.help())
    };
    let help = "write it again as version 7: in MATLAB m = load('m.mat'); save('m-v7.mat', '-struct', 'm', '-v7'), \
                or in Python scipy.io.savemat('m-v7.mat', {'x': x})";
    let refused = |version: &str| {
        (format!("in/m.mat: expected a MATLAB file of version 5 to 7, found version {version}"), Some(help.to_owned()))
    };
    let mut head = b"MATLAB 7.3 MAT-file, Platform: GLNXA64".to_vec();
    head.resize(124, b' ');
    head.extend(b"\x00\x02IM");
    let hdf5 = b"\x89HDF\r\n\x1a\n";
    let mut behind = vec![b'x'; 512];
    behind.extend(hdf5);
    let mut number = head.clone();
    number[..10].copy_from_slice(b"MATLAB 5.0");
    for bytes in [&head[..], &head[..20], hdf5, &behind, &number] {
        assert_eq!(message(bytes), refused("7.3 (HDF5)"));
    }
    assert_eq!(message(&fs::read(data("four.mat")).unwrap()), refused("4"));
    // 1000: big-endian
    let big: Vec<u8> = [1000_u32, 3, 1, 0, 2].into_iter().flat_map(u32::to_be_bytes).collect();
    assert_eq!(message(&big), refused("4"));
    number[125] = 7;
    assert_eq!(message(&number), refused("unknown"));
    let none = "in/m.mat: byte 126: expected the head of a MATLAB file, which ends in IM or MI, found";
    assert_eq!(message(b"").0, format!("{none} a file of 0 bytes"));
    assert_eq!(message(&[0; 300]).0, format!("{none} \"\\x00\\x00\""));
    assert_eq!(message(&[b'a'; 300]).0, format!("{none} \"aa\""));
}

/// Every length that a file may be cut to and every bit that may be flipped: an error or signals, no panic.
#[test]
fn damaged_files_never_panic() {
    let read = |bytes: &[u8]| {
        for rate_hz in [None, Some(1e3)] {
            let any = request(&[], rate_hz);
            let known = match signals_from_mat(bytes, Path::new("m.mat"), &any) {
                Err(MeasuredError::Choose { known, .. }) => known,
                Err(error) => return assert!(!error.to_string().is_empty()),
                Ok(_) => continue,
            };
            for name in known.into_iter().take(3) {
                if let Ok(found) = signals_from_mat(bytes, Path::new("m.mat"), &request(&[&name], rate_hz)) {
                    assert!(found[0].series.values().len() <= 1032 * bytes.len());
                }
            }
        }
    };
    for name in ["plain.mat", "bench.mat", "big.mat", "classes.mat", "four.mat"] {
        let whole = fs::read(data(name)).unwrap();
        for length in 0..whole.len() {
            read(&whole[..length]);
        }
        let mut bytes = whole.clone();
        for place in 0..whole.len() {
            for bit in 0..8 {
                bytes[place] ^= 1 << bit;
                read(&bytes);
                bytes[place] = whole[place];
            }
        }
    }
}

/// Two published records, which may not be copied; first numbers and sums by `scipy.io.loadmat`.
#[test]
fn published_records_are_read_as_scipy_reads_them() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/reference/measured");
    let cases = [
        (
            "105_0.mat",
            "X105_DE_time",
            121_265,
            [-0.08300435129740519, -0.19573433133732535, 0.23341928143712576],
            1_630.233_235_888_223_6,
            12e3,
            1797.0 / 60.0,
        ),
        (
            "105_0.mat",
            "X105_FE_time",
            121_265,
            [-0.40207454545454546, -0.004725454545454545, -0.10663090909090908],
            4_004.067_270_909_090_4,
            12e3,
            1797.0 / 60.0,
        ),
        (
            "105_0.mat",
            "X105_BA_time",
            121_265,
            [0.06466148367952523, -0.023096261127596444, -0.08852225519287835],
            739.418_269_673_590_7,
            12e3,
            1797.0 / 60.0,
        ),
        (
            "OuterRaceFault_vload_1.mat",
            "bearing.gs",
            146_484,
            [-0.06989686, 1.184481, 1.568139],
            -27333.8870526772,
            48_828.0,
            25.0,
        ),
    ];
    for (file, name, count, first, sum, rate_hz, speed_hz) in cases {
        let path = folder.join(file);
        if !path.is_file() {
            println!("left out: {file} is not there");
            continue;
        }
        let states_rate = name == "bearing.gs";
        let asked = request(&[name], Some(rate_hz).filter(|_| !states_rate));
        let found = only(read_signals(&path, &asked).unwrap());
        let values = found.series.values();
        assert_eq!(values.len(), count);
        for (found, expected) in values.iter().zip::<[f64; 3]>(first) {
            assert_eq!(found.to_bits(), expected.to_bits(), "{name}");
        }
        let own: f64 = values.iter().sum();
        assert!((own / sum - 1.0).abs() < 1e-10, "{name}: {own}");
        assert!((found.series.rate_hz() / rate_hz - 1.0).abs() < 1e-12);
        assert_eq!(found.speed_hz, Some(speed_hz));
        let bare = read_signals(&path, &request(&[name], None));
        assert_eq!(bare.is_ok(), states_rate);
        if let Err(error) = bare {
            assert!(error.to_string().ends_with("expected a time or a sampling rate, found neither"));
            assert_eq!(error.help().unwrap(), "give the sampling rate with --rate HZ");
        }
    }
}
