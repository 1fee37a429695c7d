//! MATLAB files made here, element by element: what is said beside signals, damage, odd things.

use std::path::Path;

use flate2::Compression;
use flate2::read::ZlibEncoder;

use super::super::tests::{only, request};
use super::super::{MeasuredSignal, SignalRequest};
use super::signals_from_mat;
use super::tests::names;

/// An element of its type and bytes, in the short form if they are few.
fn element(kind: u32, bytes: &[u8]) -> Vec<u8> {
    let size = bytes.len() as u32;
    let mut all = match size {
        0 | 5.. => [kind, size].into_iter().flat_map(u32::to_le_bytes).collect(),
        _ => (size << 16 | kind).to_le_bytes().to_vec(),
    };
    all.extend(bytes);
    all.resize(all.len().next_multiple_of(8), 0);
    all
}

fn matrix(parts: &[Vec<u8>]) -> Vec<u8> {
    element(14, &parts.concat())
}

fn words(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

/// An array of whole numbers in one byte each.
fn array(name: &str, sizes: &[u32], values: &[u8]) -> Vec<u8> {
    matrix(&[element(6, &words(&[6, 0])), element(5, &words(sizes)), element(1, name.as_bytes()), element(2, values)])
}

fn number(name: &str, value: u8) -> Vec<u8> {
    array(name, &[1, 1], &[value])
}

/// A struct, or several, with fields of 8 bytes a name.
fn structs(name: &str, sizes: &[u32], names: &[&str], values: &[Vec<u8>]) -> Vec<u8> {
    let fields: Vec<u8> = names.iter().flat_map(|name| [name.as_bytes(), &[0; 8]].concat()[..8].to_vec()).collect();
    matrix(&[
        element(6, &words(&[2, 0])),
        element(5, &words(sizes)),
        element(1, name.as_bytes()),
        element(5, &words(&[8])),
        element(1, &fields),
        values.concat(),
    ])
}

fn file(variables: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = b"MATLAB 5.0 MAT-file".to_vec();
    bytes.resize(124, b' ');
    bytes.extend(b"\x00\x01IM");
    bytes.extend(variables.concat());
    bytes
}

fn packed(bytes: &[u8]) -> Vec<u8> {
    let mut stream = Vec::new();
    let mut from = ZlibEncoder::new(bytes, Compression::best());
    std::io::Read::read_to_end(&mut from, &mut stream).unwrap();
    let mut all = words(&[15, stream.len() as u32]);
    all.extend(stream);
    all
}

fn from(variables: &[Vec<u8>], request: &SignalRequest) -> Result<MeasuredSignal, String> {
    let found = signals_from_mat(&file(variables), Path::new("m.mat"), request);
    found.map(only).map_err(|error| error.to_string())
}

/// What is said of a file that has one signal or none.
fn refused(variables: &[Vec<u8>]) -> String {
    from(variables, &SignalRequest::default()).unwrap_err()
}

#[test]
fn rates_and_speeds_are_taken_only_if_they_are_clear() {
    let x = || array("x", &[3, 1], &[1, 2, 3]);
    let found = |beside: &[Vec<u8>]| {
        let all = [&[x()], beside].concat();
        let found = from(&all, &SignalRequest::default());
        found.map(|signal| (signal.series.rate_hz(), signal.speed_hz))
    };
    let missing = Err("m.mat: expected a time or a sampling rate, found neither".to_owned());
    assert_eq!(found(&[]), missing);
    // as the records of a well-known bench, which have speeds and no rates
    assert_eq!(found(&[number("X105RPM", 60)]), missing);
    assert_eq!(found(&[number("rate", 25)]), missing);
    assert_eq!(found(&[number("FS", 8)]), Ok((8.0, None)));
    let rate = || number("Sampling_Rate", 8);
    assert_eq!(found(&[rate(), number("rate", 25)]), Ok((8.0, None)));
    assert_eq!(found(&[rate(), number("speed_hz", 2)]), Ok((8.0, Some(2.0))));
    assert_eq!(found(&[rate(), number("a_rpm", 60), number("b_rpm", 60)]), Ok((8.0, Some(1.0))));
    assert_eq!(found(&[rate(), number("a_rpm", 60), number("b_rpm", 90)]), Ok((8.0, None)));
    assert_eq!(found(&[rate(), number("rpm", 0)]), Ok((8.0, None)));
    let wrong = |end: &str| Err(format!("m.mat: array \"Sampling_Rate\": {end}"));
    assert_eq!(found(&[rate(), number("fs", 9)]), wrong("expected one sampling rate, found 8 and, in \"fs\", 9"));
    assert_eq!(found(&[number("Sampling_Rate", 0)]), wrong("expected one sampling rate above 0 Hz, found 0"));
    // a rate that is asked for needs none in the file
    let asked = request(&[], Some(4.0));
    let both = [x(), rate(), number("fs", 9)];
    assert_eq!(from(&both, &asked).unwrap().series.step_s().to_bits(), 0.25_f64.to_bits());
    // a struct's own goes before the file's, and another struct's is not there at all
    let field = |fs: &str| {
        let values = [array("", &[1, 3], &[1, 2, 3]), number("", 16), number("", 120)];
        structs("s", &[1, 1], &["x", fs, "rpm"], &values)
    };
    let other = structs("o", &[1, 1], &["fs", "rpm"], &[number("", 99), number("", 99)]);
    let own = from(&[rate(), number("rpm", 60), other.clone(), field("fs")], &SignalRequest::default());
    let own = own.unwrap();
    assert_eq!((own.series.rate_hz(), own.speed_hz), (16.0, Some(2.0)));
    let outer = from(&[rate(), other, field("y")], &SignalRequest::default()).unwrap();
    assert_eq!((outer.series.rate_hz(), outer.speed_hz), (8.0, Some(2.0)));
    // in one struct with a sampling rate `rate` is the speed, unless another number says so
    let beside = |last: &str| {
        let numbers = [number("", 25), number("", 16), number("", 60)];
        let values = [&[array("", &[1, 3], &[1, 2, 3])][..], &numbers].concat();
        let beside = structs("s", &[1, 1], &["x", "rate", "sr", last], &values);
        from(&[beside], &SignalRequest::default()).unwrap().speed_hz
    };
    assert_eq!((beside("load"), beside("rpm")), (Some(25.0), Some(1.0)));
    // and it is none by a sampling rate that stands elsewhere
    let values = [array("", &[1, 3], &[1, 2, 3]), number("", 25)];
    let apart = structs("s", &[1, 1], &["x", "rate"], &values);
    let apart = from(&[rate(), apart], &SignalRequest::default()).unwrap();
    assert_eq!((apart.series.rate_hz(), apart.speed_hz), (8.0, None));
}

#[test]
fn damage_is_said_with_its_place() {
    let flags = || element(6, &words(&[6, 0]));
    let sizes = || element(5, &words(&[3, 1]));
    let name = || element(1, b"x");
    let part = |parts: &[Vec<u8>]| refused(&[matrix(parts)]);
    let deep = (0..40).fold(number("", 1), |inside, _| structs("", &[1, 1], &["a"], &[inside]));
    let zip = packed(&array("x", &[3, 1], &[1, 2, 3]));
    let mut cut = zip.clone();
    cut[4] -= 6;
    cut.truncate(zip.len() - 6);
    let mut sum = zip.clone();
    let last = sum.len() - 1;
    sum[last] ^= 1;
    let many = vec![array("x", &[3, 1], &[1, 2, 3]); (1 << 16) + 1];
    let cases = [
        (refused(&[]), "m.mat: expected one signal or the name of one, found no signals"),
        (refused(&[vec![1; 5]]), "m.mat: byte 128: expected a variable, found 5 bytes"),
        (refused(&[element(9, &[0; 8])]), "m.mat: byte 128: expected a variable, found an element of type 9"),
        (
            refused(&[words(&[14, 80, 0, 0])]),
            "m.mat: byte 128: expected a variable, found 80 bytes, of which 8 are there",
        ),
        (refused(&[words(&[14 | 5 << 16, 0])]), "m.mat: byte 128: expected a variable, found 5 bytes in four"),
        (part(&[element(6, &words(&[6]))]), "m.mat: byte 136: expected 8 bytes of flags of an array, found 4 bytes"),
        (part(&[element(6, &words(&[99, 0]))]), "m.mat: byte 136: expected a class of arrays from 1 to 17, found 99"),
        (
            part(&[flags(), element(5, &words(&[3]))]),
            "m.mat: byte 152: expected 2 to 64 sizes of an array, found 4 bytes, or a size below 0",
        ),
        (
            part(&[flags(), element(5, &words(&[3, u32::MAX]))]),
            "m.mat: byte 152: expected 2 to 64 sizes of an array, found 8 bytes, or a size below 0",
        ),
        (part(&[flags(), sizes()]), "m.mat: byte 168: expected the name of an array, found 0 bytes"),
        (part(&[flags(), sizes(), name()]), "m.mat: array \"x\", byte 176: expected numbers, found 0 bytes"),
        (
            part(&[flags(), sizes(), name(), element(16, b"abc")]),
            "m.mat: array \"x\", byte 176: expected numbers, found an element of type 16",
        ),
        (
            part(&[flags(), sizes(), name(), element(9, &[0; 16])]),
            "m.mat: array \"x\", byte 176: expected 8 bytes each for sizes [3, 1], found 16 bytes",
        ),
        (
            refused(&[structs("s", &[9, 9], &["a"], &[number("", 1)])]),
            "m.mat: array \"s\", byte 176: expected structs of sizes [9, 9], found 1 fields in 56 bytes",
        ),
        (
            refused(&[structs("s", &[1, 1], &["a"], &[element(9, &[0; 8])])]),
            "m.mat: array \"s\", byte 200: expected a field of a struct, found an element of type 9",
        ),
        (
            refused(&[structs("s", &[1, 1], &["a"], &[array("", &[9, 1], &[0])])]),
            "m.mat: array \"s.a\", byte 248: expected 1 bytes each for sizes [9, 1], found 1 bytes",
        ),
        (
            refused(&[packed(&element(9, &[0; 8]))]),
            "m.mat: byte 0 of what byte 136 packs: expected a compressed variable, found an element of type 9",
        ),
        (
            refused(&[packed(&words(&[14, 1 << 20]))]),
            "m.mat: byte 0 of what byte 136 packs: expected a compressed variable of at most 13416 bytes, found 1048576 bytes",
        ),
        (
            refused(&[packed(&words(&[14, 80, 0]))]),
            "m.mat: byte 0 of what byte 136 packs: expected a compressed variable, found 80 bytes, of which 4 are there",
        ),
        (
            refused(&[packed(&words(&[14, 8, 0, 0, 0]))]),
            "m.mat: byte 8 of what byte 136 packs: expected the end of a compressed variable, found more than its size",
        ),
        (
            refused(&[packed(&array("x", &[9, 1], &[0]))]),
            "m.mat: array \"x\", byte 40 of what byte 136 packs: expected 1 bytes each for sizes [9, 1], found 1 bytes",
        ),
        (
            refused(&[cut]),
            "m.mat: byte 0 of what byte 136 packs: expected a compressed variable, found incomplete deflate stream",
        ),
        (
            refused(&[sum]),
            "m.mat: byte 0 of what byte 136 packs: expected a compressed variable, found corrupt deflate stream",
        ),
        (refused(&many), "m.mat: array \"x\", byte 3670192: expected at most 65536 signals, found more"),
    ];
    let (found, expected): (Vec<String>, Vec<&str>) = cases.into_iter().unzip();
    assert_eq!(found, expected);
    let deep = refused(&[deep]);
    assert!(deep.ends_with("found no signals"), "a variable without a name: {deep}");
    let deep = (0..40)
        .fold(number("", 1), |inside, level| structs(if level == 39 { "s" } else { "" }, &[1, 1], &["a"], &[inside]));
    let deep = refused(&[deep]);
    let expected = "expected structs in structs, up to 32 deep, found a deeper one";
    assert!(deep.ends_with(expected), "{deep}");
}

#[test]
fn odd_and_empty_things_are_passed_over() {
    let x = array("x", &[3, 1], &[1, 2, 3]);
    let class = |class: u32| matrix(&[element(6, &words(&[class, 0])), vec![7; 24]]);
    let nothing = element(14, &[]);
    let all = [
        class(17),
        class(1),
        array("", &[1, 3], &[1, 2, 3]),
        structs("none", &[1, 1], &[], &[]),
        structs("zero", &[0, 0], &["a"], &[]),
        structs("s", &[2, 1], &["a", "b"], &[nothing.clone(), nothing.clone(), nothing, x.clone()]),
        array(&"n".repeat(600), &[1, 3], &[1, 2, 3]),
        array("bell\u{7}", &[1, 3], &[1, 2, 3]),
        x,
    ];
    assert_eq!(names(&file(&all)), ["s(2).b", "bell\u{fffd}", "x"]);
}
