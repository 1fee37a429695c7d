//! Reference: none; what is wrong with each signal is known.
//! Goal: signals that no sensor gives, and words against the file's own, are refused or said.
//! Sketch: noise of 0.5 s at 8 kHz in a table, spoiled in one way each.
//! Conditions: none.
//! Parameters: 4000 samples.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use plummer::formats::NpzWriter;
use serde_json::Value;

use super::Dice;
use super::program::{errors, plummer, scratch};

/// Writes a table of a time and a signal `x`, each sample what `spoil` makes of noise in -1 to 1.
fn table(folder: &Path, name: &str, spoil: impl Fn(usize, f64) -> f64) -> PathBuf {
    let mut dice = Dice(7);
    let mut text = "time_s,x\n".to_owned();
    for place in 0..4000_usize {
        let noise = 2.0 * dice.fraction() - 1.0;
        writeln!(text, "{},{:e}", place as f64 / 8000.0, spoil(place, noise)).unwrap();
    }
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    path
}

fn analyze(folder: &Path, file: &str, more: &str) -> Output {
    let line = format!("analyze {file} --channel x --speed 29.95 --out out --force {more}");
    plummer(folder, &line.split_whitespace().collect::<Vec<_>>())
}

const BEARING: &str = "--bearing 6205";

#[test]
fn what_a_converter_did_is_said() {
    let folder = scratch("flawed-signals");
    table(&folder, "good.csv", |_, noise| noise);
    table(&folder, "clipped.csv", |_, noise| (3.0 * noise).clamp(-1.0, 1.0));
    table(&folder, "dead.csv", |place, noise| if place < 1000 { 0.0 } else { noise });
    let said = |file: &str, more: &str| {
        let output = analyze(&folder, file, &format!("{BEARING} {more}"));
        assert!(output.status.code().is_some_and(|code| code < 2), "{}", errors(&output));
        let text = errors(&output);
        let warnings = text.lines().filter(|line| line.starts_with("warning: "));
        warnings.map(str::to_owned).collect::<Vec<_>>()
    };
    assert!(said("good.csv", "").is_empty());
    let clipped = said("clipped.csv", "");
    assert!(clipped.len() == 1 && clipped[0].contains(" % of the samples stand at the end of a range"), "{clipped:?}");
    assert_eq!(said("dead.csv", ""), ["warning: x: nothing changes from 0.0000 to 0.12500 s: analyse the rest alone"]);
    assert!(said("dead.csv", "--window 0.2:0.5").is_empty());
}

#[test]
fn magnitudes_whose_squares_are_no_numbers_are_refused() {
    let folder = scratch("magnitudes");
    for (name, size) in [("large.csv", 1e200), ("small.csv", 1e-200)] {
        table(&folder, name, |_, noise| size * noise);
        let output = analyze(&folder, name, BEARING);
        assert_eq!(output.status.code(), Some(2), "{}", errors(&output));
        assert!(errors(&output).contains("expected a largest magnitude from 1e-60 to 1e60"), "{}", errors(&output));
    }
}

#[test]
fn words_against_the_file_are_said() {
    let folder = scratch("overruled");
    table(&folder, "good.csv", |_, noise| noise);
    for (more, expected) in [
        ("--bearing 6205 --rate 4000", Some("--rate takes 4000.00 Hz for what the file says are 8000.00 Hz")),
        ("--bearing 6205 --rate 8001", None),
        ("--orders outer=3.585,inner=5.145", Some("sum up to 8.730, which is no whole number of balls")),
        ("--orders outer=3.585,inner=5.415", None),
        ("--orders outer=4.5,inner=4.501", Some("their lines can hardly be told apart")),
    ] {
        let output = analyze(&folder, "good.csv", more);
        assert!(output.status.code().is_some_and(|code| code < 2), "{}", errors(&output));
        let text = errors(&output);
        match expected {
            Some(expected) => assert!(text.contains(expected), "{more}: {text}"),
            None => assert!(!text.contains("warning: "), "{more}: {text}"),
        }
    }
    let line = "analyze good.csv --channel x --bearing 6205 --speed 0:10,0.2:30 --out out --force";
    let output = plummer(&folder, &line.split_whitespace().collect::<Vec<_>>());
    assert!(errors(&output).contains("the speed is given from 0.0000 to 0.20000 s"), "{}", errors(&output));
    let mut file = NpzWriter::create(folder.join("own.npz")).unwrap();
    let mut dice = Dice(7);
    let values: Vec<f64> = (0..4000).map(|_| dice.fraction() - 0.5).collect();
    file.array("x", &values).unwrap();
    file.array("speed_hz", &[30.5]).unwrap();
    file.finish().unwrap();
    let output = analyze(&folder, "own.npz", "--bearing 6205 --rate 8000");
    let said =
        "--speed takes 29.9500 Hz (1797.00 rpm), on the average, for what the file says are 30.5000 Hz (1830.00 rpm)";
    assert!(errors(&output).contains(said), "{}", errors(&output));
    let output = analyze(&folder, "good.csv", "--orders outer=3.585,inner=3.585");
    assert_eq!(output.status.code(), Some(2));
    assert!(errors(&output).contains("outer and inner are equal"), "{}", errors(&output));
}

/// Above nine tenths of half the rate there is nothing left to judge.
#[test]
fn a_band_at_the_end_of_the_signal_has_no_verdict() {
    let folder = scratch("narrow-band");
    table(&folder, "a.csv", |_, noise| noise);
    let with = |corner: f64| {
        let more = format!("{BEARING} --high-pass {corner}");
        let output = analyze(&folder, "a.csv", &more);
        (output.status.code(), errors(&output))
    };
    let told = "expected a band that begins below 3600 Hz";
    let (code, text) = with(3990.0);
    assert!(code == Some(1) && text.contains(told), "{text}");
    assert!(!with(2000.0).1.contains("expected a band"));
}

/// What a computed signal of tones alone says of a bearing rests on the rounding of its numbers.
#[test]
fn signals_without_noise_have_no_verdict() {
    let folder = scratch("no-noise");
    let time = |place: usize| place as f64 / 8000.0;
    let sine = |place: usize| (std::f64::consts::TAU * 107.3 * time(place)).sin();
    table(&folder, "sine.csv", |place, _| sine(place));
    table(&folder, "short.csv", |place, _| (32767.0 * sine(place)).round());
    table(&folder, "ramp.csv", |place, _| 9.81 + time(place));
    table(&folder, "step.csv", |place, _| f64::from(u8::from(place > 2000)));
    table(&folder, "offset.csv", |_, noise| f64::from((1e8 + noise) as f32));
    for file in ["sine.csv", "short.csv", "ramp.csv", "step.csv"] {
        let output = analyze(&folder, file, BEARING);
        let text = errors(&output);
        assert_eq!(output.status.code(), Some(1), "{file}: {text}");
        assert!(text.contains("expected noise beside the tones"), "{file}: {text}");
    }
    // nothing is left of the noise in the digits of single precision
    let output = analyze(&folder, "offset.csv", BEARING);
    assert_eq!(output.status.code(), Some(1));
    table(&folder, "double.csv", |_, noise| 1e8 + noise);
    let output = analyze(&folder, "double.csv", BEARING);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
}

#[test]
fn tables_that_are_no_signals_are_refused() {
    let folder = scratch("no-signals");
    let write = |name: &str, head: &str, row: &dyn Fn(usize) -> String| {
        let rows: String = (0..4000).map(row).collect();
        fs::write(folder.join(name), format!("{head}\n{rows}")).unwrap();
    };
    let time = |place: usize| place as f64 / 8000.0;
    let value = |place: usize| (place * 7919 % 1009) as f64;
    let gap = |place: usize| time(place) + if place > 2000 { 0.5 } else { 0.0 };
    write("gap.csv", "t,x", &|k| format!("{},{}\n", gap(k), value(k)));
    write("back.csv", "t,x", &|k| format!("{},{}\n", time(4000 - k), value(k)));
    write("still.csv", "t,x", &|k| format!("0,{}\n", value(k)));
    write("twice.csv", "t,x,x", &|k| format!("{},{},1\n", time(k), value(k)));
    write("commas.csv", "t,x", &|k| format!("{},0,5\n", time(k)));
    table(&folder, "nan.csv", |k, noise| if k == 2000 { f64::NAN } else { noise });
    for (file, expected) in [
        ("gap.csv", "expected equal time steps"),
        ("back.csv", "expected equal time steps"),
        ("still.csv", "expected equal time steps"),
        ("twice.csv", "found \"x (column 2)\", \"x (column 3)\""),
        ("commas.csv", "expected 2 columns"),
        ("nan.csv", "nan.csv:2002: expected a finite number"),
    ] {
        let output = analyze(&folder, file, BEARING);
        let text = errors(&output);
        assert_eq!(output.status.code(), Some(2), "{file}: {text}");
        assert!(text.contains(expected), "{file}: {text}");
    }
}

/// Results are UTF-8, and so are the names in them.
#[cfg(unix)]
#[test]
fn names_in_other_bytes_are_wrong_input() {
    use std::os::unix::ffi::OsStrExt;
    let name = std::ffi::OsStr::from_bytes(b"\xff.toml");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_plummer")).arg("modes").arg(name).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(errors(&output).contains("expected text in UTF-8"), "{}", errors(&output));
}

/// What is diagnosed is in no unit: a signal four times as large, turned over, or of a machine four times as fast says the same.
#[test]
fn a_signal_in_other_units_has_the_same_verdict() {
    let folder = scratch("signal-units");
    // 29.95 Hz and the outer race's 3.585 of a 6205, impacts that ring at 2.2 kHz
    let ring = |place: usize, noise: f64| {
        let pass = place as f64 / 8000.0 * 29.95 * 3.585;
        let since = pass.fract() / (29.95 * 3.585);
        0.2 * noise + (-900.0 * since).exp() * (since * 2200.0 * std::f64::consts::TAU).sin()
    };
    table(&folder, "one.csv", ring);
    table(&folder, "large.csv", |place, noise| -4.0 * ring(place, noise));
    let fast = fs::read_to_string(folder.join("one.csv")).unwrap();
    let values = fast.lines().skip(1).filter_map(|line| line.split_once(','));
    let fast = values.fold("x\n".to_owned(), |text, (_, value)| text + value + "\n");
    fs::write(folder.join("fast.csv"), fast).unwrap();
    let verdict = |words: &str, time: f64, size: f64| {
        let line = format!("analyze {words} --channel x {BEARING} --out out --force --json");
        let output = plummer(&folder, &line.split_whitespace().collect::<Vec<_>>());
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        let found: Value = serde_json::from_slice(&output.stdout).unwrap();
        let window = &found["windows"][0];
        let number = |value: &Value| value.as_f64().unwrap();
        let peaks = window["envelope_peaks"].as_array().unwrap().iter();
        let peaks = peaks.flat_map(|peak| [number(&peak["frequency_hz"]) * time, number(&peak["amplitude"]) / size]);
        let mut numbers = vec![number(&window["rms"]) / size, number(&window["kurtosis"])];
        numbers.extend(peaks);
        let parts = window["verdict"]["faults"].as_array().unwrap().iter();
        let parts = parts.map(|part| [&part["fault"], &part["conclusion"]].map(Value::to_string));
        (numbers, parts.collect::<Vec<_>>())
    };
    let (one, said) = verdict("one.csv --speed 29.95 --high-pass 1000", 1.0, 1.0);
    let outer = ["\"outer race\"", "\"named\""].map(str::to_owned);
    assert!(said.contains(&outer), "{said:?}");
    // round-off; and bins of 0.25 Hz whatever the rate, between which a peak is interpolated
    for (words, time, size, limit) in [
        ("large.csv --speed 29.95 --high-pass 1000", 1.0, 4.0, 1e-9),
        ("fast.csv --rate 32000 --speed 119.8 --high-pass 4000", 0.25, 1.0, 1e-3),
    ] {
        let (other, said_of_other) = verdict(words, time, size);
        for (other, one) in other.iter().zip(&one) {
            assert!((other / one - 1.0).abs() < limit, "{words}: {other} {one}");
        }
        assert_eq!(said, said_of_other, "{words}");
    }
}
