//! Frequency responses: written and read back, files of pyuff, damage.

use std::fs;
use std::path::{Path, PathBuf};

use proptest::prelude::*;

use super::*;

/// Something done to a sound response.
type Change<'a> = &'a dyn Fn(&mut FrequencyResponse);

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/uff").join(name)
}

fn point(name: &str, node: Option<u64>, direction: Option<[f64; 3]>) -> ResponsePoint {
    ResponsePoint { name: name.to_owned(), node, direction }
}

/// An oscillator of 10 Hz and 1 kg, 1 % of critical damping: accelerance.
fn oscillator(frequency_hz: Vec<f64>) -> FrequencyResponse {
    let value = |f: &f64| {
        let (a, b) = (100.0 - f * f, 0.2 * f);
        let square = a * a + b * b;
        [-f * f * a / square, f * f * b / square]
    };
    FrequencyResponse {
        name: "housing, foot by shaft".to_owned(),
        value: frequency_hz.iter().map(value).collect(),
        frequency_hz,
        kind: ResponseKind::Accelerance,
        from: point("centre of the bearing", Some(4), Some([0.0, -1.0, 0.0])),
        to: point("foot", Some(9_999_999_999), Some([0.0, 0.0, 1.0])),
    }
}

/// `found` has the values of `expected` but for 13 digits.
fn assert_close(found: &FrequencyResponse, expected: &FrequencyResponse) {
    assert_eq!(found.value.len(), expected.value.len());
    for (found, expected) in found.value.iter().zip(&expected.value) {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() <= 5e-13 * expected.abs(), "{found} {expected}");
        }
    }
    for (found, expected) in found.frequency_hz.iter().zip(&expected.frequency_hz) {
        // six digits
        assert!((found - expected).abs() <= 5e-6 * expected, "{found} {expected}");
    }
    let bare = |response: &FrequencyResponse| FrequencyResponse {
        frequency_hz: Vec::new(),
        value: Vec::new(),
        ..response.clone()
    };
    assert_eq!(bare(found), bare(expected));
}

#[test]
fn what_six_digits_do_not_tell_apart_is_left_out() {
    let close = vec![1.0, 39_053.516_2, 39_053.516_3, 39_053.7, 39_054.0];
    let thinned = oscillator(close.clone()).told_apart();
    assert_eq!(thinned.frequency_hz, [1.0, 39_053.516_2, 39_053.7, 39_054.0]);
    let all = oscillator(close);
    assert_eq!(thinned.value[1..], [all.value[1], all.value[3], all.value[4]]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("close.uff");
    write_responses_uff(&path, "", &[thinned]).unwrap();
    // even steps need no digits of their own
    let even: Vec<f64> = (0..5).map(|k| 1e5 + 0.125 * f64::from(k)).collect();
    assert_eq!(oscillator(even.clone()).told_apart().frequency_hz, even);
}

#[test]
fn responses_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frf.uff");
    let even = oscillator((0..101).map(|n| 5.0 + 0.125 * f64::from(n)).collect());
    let uneven = FrequencyResponse {
        name: String::new(),
        kind: ResponseKind::Mobility,
        from: point("", None, Some([-1.0, 0.0, 0.0])),
        to: point("NONE", None, None),
        ..oscillator(vec![0.0, 1.0, 3.0, 1.0 / 0.3, 5e4])
    };
    let one = FrequencyResponse { kind: ResponseKind::Receptance, ..oscillator(vec![50.0]) };
    write_responses_uff(&path, "test", &[even.clone(), uneven.clone(), one.clone()]).unwrap();
    let found = read_responses_uff(&path).unwrap();
    assert_close(&found[0], &even);
    let uneven = FrequencyResponse {
        // what means that there is none
        to: point("", None, None),
        ..uneven
    };
    assert_close(&found[1], &uneven);
    assert_close(&found[2], &one);
    assert_eq!(found.len(), 3);
    // no file of mode shapes, and no trouble for their reader
    let error = read_modes_uff(&path).unwrap_err();
    assert!(error.to_string().contains(": expected mode shapes (dataset 55"));
}

#[test]
#[allow(clippy::float_cmp)] // parsed decimals are exact
fn the_columns_are_those_of_the_format() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frf.uff");
    let mut response = oscillator(vec![1.0, 2.0, 3.0]);
    response.value = vec![[1.5, -2e-7], [0.0, 1e-100], [-1e100, 3.0]];
    response.to.node = None;
    let third = 1.0 / 3.0_f64;
    response.to.direction = Some([third.sqrt(); 3]);
    let mut uneven = response.clone();
    uneven.frequency_hz[2] = 30.0;
    write_responses_uff(&path, "test", &[response, uneven]).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    let sets: Vec<&str> = text.split("    -1\n    58\n").collect();
    let expected = "housing, foot by shaft\n\
        Accelerance, m/s2/N\n\
        NONE\n\
        Force at centre of the bearing\n\
        Response at foot\n\
        \x20   4         1    0         0 foot               0   0 centre of          4  -2\n\
        \x20        6         3         1  1.00000E+00  1.00000E+00  0.00000E+00\n\
        \x20       18    0    0    0 Frequency            Hz                  \n\
        \x20       12    0    0    0 Acceleration         m/s2                \n\
        \x20       13    0    0    0 Force                N                   \n\
        \x20        0    0    0    0 NONE                 NONE                \n\
        \x20 1.500000000000E+00 -2.000000000000E-07  0.000000000000E+00  0.000000000000E+00\n\
        -1.000000000000E+100  3.000000000000E+00\n\
        \x20   -1\n";
    assert_eq!(sets[1], expected);
    let expected = "         6         3         0  0.00000E+00  0.00000E+00  0.00000E+00\n";
    assert!(sets[2].contains(expected), "{}", sets[2]);
    let expected = "  3.00000E+01-1.000000000000E+100  3.000000000000E+00\n    -1\n";
    assert!(sets[2].ends_with(expected), "{}", sets[2]);
    // numbers that run together
    let found = read_responses_uff(&path).unwrap();
    assert_eq!(found[1].value[2], [-1e100, 3.0]);
    assert_eq!(found[1].frequency_hz, [1.0, 2.0, 30.0]);
    assert_eq!(found[0].to.direction, None);
}

/// As make.py has it, by itself or 1000 times as large.
fn value(f: f64, factor: f64) -> [f64; 2] {
    let denominator = (3.25 - f) * 1e6 / factor;
    [1.0 / denominator, 0.25 * f / denominator]
}

#[test]
fn files_of_pyuff_are_read() {
    let even: Vec<f64> = (0..7).map(|n| 2.5 + 0.5 * f64::from(n)).collect();
    let uneven = vec![1.0, 2.5, 10.25, 400.5];
    let expected = |kind, frequencies: &[f64], to| FrequencyResponse {
        name: "from pyuff".to_owned(),
        frequency_hz: frequencies.to_vec(),
        value: frequencies.iter().map(|&f| value(f, 1.0)).collect(),
        kind,
        from: point("SHAFT", Some(4), Some([1.0, 0.0, 0.0])),
        to,
    };
    let foot = point("FOOT", Some(17), Some([0.0, 0.0, -1.0]));
    let check = |found: &FrequencyResponse, expected: &FrequencyResponse, digits: f64| {
        for (found, expected) in found.value.iter().zip(&expected.value) {
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() <= digits * expected.abs(), "{found} {expected}");
            }
        }
        let without = |response: &FrequencyResponse| FrequencyResponse {
            value: vec![[0.0; 2]; response.value.len()],
            ..response.clone()
        };
        assert_eq!(without(found), without(expected));
    };
    let found = read_responses_uff(&data("responses.uff")).unwrap();
    let [accelerance, receptance, mobility] = found.as_slice() else {
        panic!("{found:?}");
    };
    // pyuff writes 12 digits, and 6 in single precision
    let kind = ResponseKind::Accelerance;
    check(accelerance, &expected(kind, &even, foot.clone()), 5e-12);
    let kind = ResponseKind::Receptance;
    let own = expected(kind, &uneven, foot.clone());
    check(receptance, &own, 5e-12);
    let nowhere = point("", None, None);
    check(mobility, &expected(ResponseKind::Mobility, &even, nowhere), 5e-6);
    // mm/N become m/N
    let found = read_responses_uff(&data("millimetre.uff")).unwrap();
    check(&found[0], &own, 5e-12);
    let error = read_responses_uff(&data("binary.uff")).unwrap_err().to_string();
    let expected = ":2: expected frequency responses as text (dataset 58), found \"58b";
    assert!(error.contains(expected), "{error}");
}

#[test]
fn errors_fire_with_their_exact_messages() {
    let whole = fs::read_to_string(data("responses.uff")).unwrap();
    let message = |from: &str, to: &str| {
        assert!(whole.contains(from));
        let text = whole.replacen(from, to, 1);
        let error = responses_from_bytes(text.as_bytes(), Path::new("f.uff")).unwrap_err();
        error.to_string()
    };
    let cases = [
        (
            "         7         1  2.5",
            "         8         1  2.5",
            "f.uff:18: expected as many values as the data has, found 7 of 8",
        ),
        (
            "         7         1  2.5",
            "         6         1  2.5",
            "f.uff:17: expected as many values as the data has, found \"-4.44444444444e-07  -6.11111111111e-07\"",
        ),
        (
            "         6         7         1  2.5",
            "         3         7         1  2.5",
            "f.uff:9: expected type, number, spacing, first abscissa and step of the data, found \"3         7         1  \
             2.50000e+00  5.00000e-01  0.00000e+00\"",
        ),
        (
            "         6         7         1  2.5",
            "         4         7         1  2.5",
            "f.uff:9: expected complex values of a frequency response, found \"4         7         1  2.50000e+00  5.00000e-01  \
             0.00000e+00\"",
        ),
        (
            "m/s2",
            "g",
            "f.uff:11: expected an acceleration in units of length, not in g, found \"12    0    0    0 Acceleration         g\"",
        ),
        (
            "  17  -3      SHAFT",
            "  17   z      SHAFT",
            "f.uff:8: expected function, its number, version, load case, then name, node and direction of response and \
             reference, found \"4         0    0         0       FOOT        17   z      SHA...\"",
        ),
        (
            "1.33333333333e-06",
            "1.333x3333333e-06",
            "f.uff:14: expected real numbers of a function, found \"1.333x3333333e-06   8.33333333333e-07   \
             4.00000000000e-06   ...\"",
        ),
        (
            " 5.00000e-01",
            "-5.00000e-01",
            "frequency response 0: expected ascending frequencies >= 0 Hz, found 2 at [1]",
        ),
        ("    58 ", "    5x ", "f.uff:2: expected the number of a dataset, found \"5x\""),
    ];
    for (from, to, expected) in cases {
        assert_eq!(message(from, to), expected);
    }
    // rotations and other functions are passed over
    let other =
        whole.replace("  17  -3 ", "  17   4 ").replace("         0   0      SHAFT", "         0   6      SHAFT");
    let error = responses_from_bytes(other.as_bytes(), Path::new("f.uff")).unwrap_err();
    assert_eq!(
        error.to_string(),
        "f.uff: expected frequency responses (dataset 58, function type 4, of displacement, velocity or acceleration by \
         force), found none"
    );

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("f.uff");
    let message = |change: Change| {
        let mut response = oscillator(vec![1.0, 2.0, 4.0]);
        change(&mut response);
        let error = write_responses_uff(&path, "", &[response]).unwrap_err();
        assert!(!path.exists());
        error.to_string()
    };
    let cases: [(Change, &str); 6] = [
        (
            &|own| own.value.truncate(2),
            "frequency response 0: expected at least one frequency and a value for each, found 3 frequencies and 2 values",
        ),
        (
            &|own| own.frequency_hz[2] = 2.0,
            "frequency response 0: expected ascending frequencies >= 0 Hz, found 2 at [2]",
        ),
        (
            &|own| own.frequency_hz[2] = 2.000_001,
            "frequency response 0: expected uneven frequencies that differ in six digits, found two like 2 Hz",
        ),
        (
            &|own| own.value[1] = [0.5, f64::NAN],
            "frequency response 0: expected finite values, found [0.5, NaN] at [1]",
        ),
        (
            &|own| own.from.direction = Some([1.0, 1.0, 0.0]),
            "frequency response 0: expected a unit vector as direction of \"centre of the bearing\", found [1.0, 1.0, 0.0]",
        ),
        (&|own| own.to.node = Some(10_000_000_000), "expected labels of at most 10 digits, found 10000000000"),
    ];
    for (change, expected) in cases {
        assert_eq!(message(change), expected);
    }
}

/// Each file cut everywhere, and each byte replaced by others: an error, or responses that are sound.
#[test]
fn damaged_files_never_panic() {
    for name in ["responses.uff", "millimetre.uff", "binary.uff"] {
        let whole = fs::read(data(name)).unwrap();
        let read = |bytes: &[u8]| {
            for response in responses_from_bytes(bytes, Path::new("d.uff")).unwrap_or_default() {
                response.check().unwrap();
            }
        };
        for end in 0..whole.len() {
            read(&whole[..end]);
        }
        for place in 0..whole.len() {
            for byte in [0xff, b' ', b'-', b'9'] {
                let mut bytes = whole.clone();
                bytes[place] = byte;
                read(&bytes);
            }
        }
    }
}

proptest! {
    /// A sound head, then lines of any length with what numbers are made of, and a character of two bytes.
    #[test]
    fn random_values_never_panic(
        text in "    -1\n    58\n(a\n){5}4 0 0 0 A 1 [0-4] B 2 2\n[2-6] [0-3] [01] 1.0 1.0 0.0\n18 0 0 0\n\
                 (8|11|12) 0 0 0\n13 0 0 0\n0 0 0 0\n([0-9 .E+é-]{0,60}\n){0,4}    -1\n",
    ) {
        let _ = responses_from_bytes(text.as_bytes(), Path::new("r.uff"));
    }
}
