//! Measured signals: each format read back, time, channels, damage.

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

fn table(text: &str, request: &SignalRequest) -> Result<Vec<MeasuredSignal>, MeasuredError> {
    let path = Path::new("m.csv");
    let channels = csv::from_bytes(text.as_bytes(), path, request)?;
    channels.into_iter().map(|channel| channel.signal(path, request)).collect()
}

fn refused(text: &str, request: &SignalRequest) -> String {
    table(text, request).unwrap_err().to_string()
}

#[test]
fn tables_are_read_with_names_units_and_separators() {
    let expected = [1.0, -2.5, 1e-3, 4.0];
    let plain = "# bench 3\ntime_s,P1 (m/s^2),P2\n\n0.5,1,9\n0.75,-2.5,9\n1,1e-3,9\n1.25,4,9\n";
    let found = only(table(plain, &request(&["P1"], None)).unwrap());
    assert_eq!((found.name.as_str(), found.series.unit()), ("P1", "m/s^2"));
    assert_samples(&found, 0.5, 0.25, &expected, 0.0);
    let both = table(plain, &request(&["P2", "P1"], None)).unwrap();
    assert_eq!(both[0].name, "P2");
    assert_eq!(both[1], found);
    // units in a row of their own, in milliseconds, a semicolon, a byte-order mark, empty cells at the end
    let rows = "\u{feff}Time;P1\r\nms;g\r\n500;1\r\n750;-2.5\r\n1000;1e-3\r\n1250;4\r\n;\r\n";
    let found = only(table(rows, &request(&[], None)).unwrap());
    assert_eq!(found.series.unit(), "g");
    assert_samples(&found, 0.5, 0.25, &expected, 1e-15);
    // without names: the first column is the time, or none is
    let bare = "0\t1\n0.25\t-2.5\n0.5\t1e-3\n0.75\t4\n";
    let found = only(table(bare, &request(&[], None)).unwrap());
    assert_eq!(found.name, "column 2");
    assert_samples(&found, 0.0, 0.25, &expected, 0.0);
    let found = only(table("1\n-2.5\n1e-3\n4\n", &request(&[], Some(4.0))).unwrap());
    assert_samples(&found, 0.0, 0.25, &expected, 0.0);
    // a rate goes before the time, the first instant stays
    let found = only(table(plain, &request(&["P1"], Some(8.0))).unwrap());
    assert_samples(&found, 0.5, 0.125, &expected, 0.0);
}

#[test]
fn decimal_commas_are_read_where_they_separate_no_columns() {
    let any = request(&[], None);
    let point = only(table("time;P1 (g)\n0;1\n0.25;-2.5\n0.5;1e-3\n0.75;4\n", &any).unwrap());
    let german = "# Messung vom 3. Mai\r\nZeit;P1 (g)\r\n0;1\r\n0,25;-2,5\r\n0,5;1,0E-3\r\n0,75;4,000\r\n";
    assert_eq!(only(table(german, &any).unwrap()), point);
    // units below the names, tabs, quotes; without names
    let units = "Zeit\tP1\ns\tg\n0,00\t1\n0,25\t-2,5\n0,50\t0,001\n0,75\t4\n";
    assert_eq!(only(table(units, &any).unwrap()), point);
    let quoted = "time,P1 (g)\n\"0,00\",1\n\"0,25\",\"-2,5\"\n\"0,50\",\"0,001\"\n\"0,75\",4\n";
    assert_eq!(only(table(quoted, &any).unwrap()), point);
    let bare = only(table("0,00;1\n0,25;-2,5\n0,50;0,001\n0,75;4\n", &any).unwrap());
    assert_eq!(bare.series.values(), point.series.values());
}

#[test]
fn tables_are_refused_with_line_and_reason() {
    let any = request(&[], None);
    let cases = [
        ("time;P1\n0,1;2,5\n0,2;2.5\n", "m.csv:3: expected a decimal comma for P1, as in line 2, found \"2.5\""),
        ("time;P1\n0;2.5\n1;2,5\n", "m.csv:3: expected a decimal point for P1, as in line 2, found \"2,5\""),
        (
            "time;P1\n0,1;1.002,5\n",
            "m.csv:2: expected a number for P1 without a sign between thousands, found \"1.002,5\"",
        ),
        ("time;P1\n0,1;1,002,5\n", "m.csv:2: expected a finite number for P1, found \"1,002,5\""),
        (
            "time,P1\n0,1,2,5\n",
            "m.csv:2: expected 2 columns, as in the first line, found \"4\": are commas both separators and decimal signs?",
        ),
        ("time,P1\n0,1\n1,two\n", "m.csv:3: expected a finite number for P1, found \"two\""),
        ("time,P1\n0,1\n# a pause\n1,NaN\n", "m.csv:4: expected a finite number for P1, found \"NaN\""),
        ("time,P1\n0,1\n1,2,3\n", "m.csv:3: expected 2 columns, as in the first line, found \"3\""),
        (
            "time,P1\n0,1\n1,1\n2,1\n2,1\n3,1\n",
            "m.csv: row 5: expected equal time steps of 1 s (the median, within 10 %), found a step of 0 s",
        ),
        (
            "time,P1\n0,1\n1,1\n2,1\n4,1\n5,1\n",
            "m.csv: row 5: expected equal time steps of 1 s (the median, within 10 %), found a step of 2 s",
        ),
        ("P1,P2\n0,1\n", "m.csv: expected a time or a sampling rate, found neither"),
        ("time,P1\n0,1\n", "m.csv: expected a time or a sampling rate, found neither"),
        ("time,P1,P2\n0,1,2\n", "m.csv: expected one signal or the name of one, found \"P1\", \"P2\""),
        ("time_s\n0\n", "m.csv: expected one signal or the name of one, found no signals"),
        ("# nothing\n", "m.csv:1: expected a header and rows of numbers, found \"none\""),
        ("time,P1\nmin,g\n0,1\n", "m.csv:2: expected s, ms, us or ns as unit of the time, found \"min\""),
    ];
    for (text, expected) in cases {
        assert_eq!(refused(text, &any), expected, "{text}");
    }
    let error = table("time,top\n0,1\n", &request(&["tip"], None)).unwrap_err();
    assert_eq!(error.to_string(), "m.csv: expected a channel \"tip\", found \"top\"");
    assert_eq!(error.help().unwrap(), "did you mean --channel 'top'?");
}

/// A sign before three digits is a decimal one, or stands between thousands.
#[test]
fn numbers_that_may_have_thousands_are_told_or_refused() {
    let any = request(&[], None);
    for (table, line, text, whole, of) in [
        ("time,P1\n0,128\n1,\"4,744\"\n2,-12\n", 3, "4,744", "128", 2),
        ("Zeit;P1\n0;4.744\n1;-128\n2;3\n", 2, "4.744", "-128", 3),
        // another column that is not read shows the other sign
        ("time\tP1\tP2\n0\t4,744\t0.25\n1\t128\t0.5\n", 2, "4,744", "128", 3),
    ] {
        let sign = if text.contains(',') { "comma" } else { "point" };
        let expected = format!(
            "m.csv:{line}: expected numbers for P1 that show whether the {sign} is a decimal sign or stands between thousands, found \"{text}\", and \"{whole}\" in line {of}"
        );
        assert_eq!(refused(table, &request(&["P1"], None)), expected);
    }
    // a whole column is read, and told
    let told = only(table("time;P1\n0;4,744\n1;-12,001\n", &any).unwrap());
    assert_samples(&told, 0.0, 1.0, &[4.744, -12.001], 0.0);
    let doubt = "P1: \"4,744\" in line 2 is read as 4.744: nothing in the file shows whether its comma is a decimal sign or stands between thousands";
    assert_eq!(told.doubts, [doubt]);
    let times = only(table("time;P1\n1.000;4\n2.000;5\n", &any).unwrap());
    assert!(times.doubts[0].starts_with("the time: \"1.000\" in line 2 is read as 1.000: "), "{:?}", times.doubts);
    // one number anywhere shows what the sign is
    for shown in [
        "0;4,744;1\n1;128,001;0,5\n",
        "0;4,744;1\n1;0,128;5\n",
        "0;4,744;1\n1;1280,128;5\n",
        "0,5;4,744;1\n1,0;128,5;1\n",
    ] {
        let read = only(table(&format!("time;P1;P2\n{shown}"), &request(&["P1"], None)).unwrap());
        assert_eq!(read.doubts, [""; 0], "{shown}");
    }
    // of whole numbers beside, another column shows it but for an exporter that writes counts with thousands and times with decimals
    for beside in ["0,5;4,744;1\n1,0;128;1\n", "0;4,744;1\n1;128;1,5E3\n"] {
        let told = only(table(&format!("time;P1;P2\n{beside}"), &request(&["P1"], None)).unwrap());
        let doubt = "P1: \"4,744\" in line 2 is read as 4.744, beside \"128\" in line 3: only another column shows that the comma does not stand between thousands";
        assert_eq!(told.doubts, [doubt], "{beside}");
    }
}

/// What stands above the numbers in the files of recorders.
#[test]
fn lines_above_the_names_are_left_out() {
    let labview = "LabVIEW Measurement\t\nSeparator\tTab\nDecimal_Separator\t,\nTime\t11:31:20,4\n***End_of_Header***\t\n\t\n\
        Channels\t1\t\nSamples\t3\t\nDelta_X\t0,25\t\n***End_of_Header***\t\t\nX_Value\tP1\tComment\n0,000000\t1,5\n0,250000\t-2\n0,500000\t3\n";
    let dewesoft = "Data1\nSample rate: 4 Hz\nStart time: 03.05.2026 12:00:00,5\n\nTime (s);P1 (m/s²)\n0,00;1,5\n0,25;-2\n0,50;3\n";
    let catman = "CATMAN 5.4;;\nBench;3;\n\"Zeit  1 - Standardmessrate [s]\";\"P1 [g]\"\n0,00;1,5\n0,25;-2\n0,50;3\n";
    let famos = "Zeit in s;P1 / (m/s²)\n0,00;1,5\n0,25;-2\n0,50;3\n";
    let tektronix = "Model,DPO4054\nFirmware Version,2.13\nRecord Length,3\nSample Interval,0.25\n,\nLabel,\nTIME,P1\n0.00e+00,1.5\n0.25,-2\n0.50,3\n";
    let older =
        "Record Length,2.5e+03,,0.000,1.50,\nSample Interval,2.5e-1,,0.25,-2.00,\n,,,0.50,3.00,\n,,,0.75,4.00,\n";
    let keysight = "x-axis,1\nsecond,Volt\n0.0E+00,1.5\n0.25,-2\n0.50,3\n";
    let pico = "Time,P1\n(ms),(mV)\n\n0.0,1.5\n250.0,-2\n500.0,3\n";
    let any = request(&[], None);
    for (text, name, unit, count) in [
        (labview, "P1", "", 3),
        (dewesoft, "P1", "m/s²", 3),
        (catman, "P1", "g", 3),
        (famos, "P1", "m/s²", 3),
        (tektronix, "P1", "", 3),
        (older, "column 5", "", 4),
        (keysight, "1", "Volt", 3),
        (pico, "P1", "mV", 3),
        // a title above numbers without names
        ("Bench 3\n0,00;1,5\n0,25;-2\n0,50;3\n", "column 2", "", 3),
    ] {
        let found = table(text, &any).map(only);
        let found = found.unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!((found.name.as_str(), found.series.unit()), (name, unit), "{text}");
        assert_samples(&found, 0.0, 0.25, &[1.5, -2.0, 3.0, 4.0][..count], 1e-12);
    }
    // the line is that of the file
    let damaged = tektronix.to_owned() + "0.75,?\n";
    assert_eq!(refused(&damaged, &any), "m.csv:11: expected a finite number for P1, found \"?\"");
}

/// Files of instruments are often Latin-1, those of spreadsheets UTF-16.
#[test]
fn units_of_other_encodings_are_read() {
    let text = "t [µs];P1 [m/s²]\n0;1,5\n250000;-2\n";
    let latin: Vec<u8> = text.chars().map(|letter| letter as u8).collect();
    let wide: Vec<u8> = std::iter::once(0xfeff).chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    for bytes in [latin, wide] {
        let channels = csv::from_bytes(&bytes, Path::new("m.csv"), &request(&[], None)).unwrap();
        let found = only(
            channels.into_iter().map(|own| own.signal(Path::new("m.csv"), &request(&[], None)).unwrap()).collect(),
        );
        assert_eq!(found.series.unit(), "m/s²");
        assert_samples(&found, 0.0, 0.25, &[1.5, -2.0], 1e-12);
    }
}

/// Of one column with decimal commas each line is two whole numbers.
#[test]
fn one_column_of_decimal_commas_is_told_how_to_be_written() {
    let error = table("P1\n0,12\n-0,13\n", &request(&[], Some(4.0))).unwrap_err();
    assert_eq!(
        error.to_string(),
        "m.csv:2: expected 1 column, as in the first line, found \"2\": is the comma a decimal sign?"
    );
    assert!(error.help().unwrap().starts_with("write decimal points, or quotes about each number"));
    for rate in [None, Some(4.0)] {
        let error = table("0,12\n-0,13\n1,5\n", &request(&["column 2"], rate)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "m.csv:2: expected whole numbers between commas, found \"-0,13\": are the commas decimal signs?"
        );
    }
    let quoted = only(table("P1\n\"0,12\"\n\"-0,13\"\n", &request(&[], Some(4.0))).unwrap());
    assert_samples(&quoted, 0.0, 0.25, &[0.12, -0.13], 0.0);
}

/// Steps that are each within the tolerance, and a clock that runs away all the same.
#[test]
fn a_clock_that_drifts_is_refused_and_a_rounded_one_is_not() {
    let times = |step: &dyn Fn(usize) -> f64| {
        let mut now = 0.0;
        let rows: String = (0..400)
            .map(|k| {
                let row = format!("{now},0\n");
                now += step(k);
                row
            })
            .collect();
        format!("t,P1\n{rows}")
    };
    let any = request(&[], None);
    let drifting = refused(&times(&|k| if k < 200 { 1.0 } else { 1.05 }), &any);
    assert!(drifting.starts_with("m.csv: row 23: expected equal time steps, so that t = "), "{drifting}");
    // 48 kHz in microseconds: steps of 20 and 21
    let rows: String = (0..500).map(|k| format!("{:.6},0\n", f64::from(k) / 48e3)).collect();
    let found = only(table(&format!("t,P1\n{rows}"), &any).unwrap());
    // the last of 500 instants is rounded by half a microsecond
    assert!((found.series.rate_hz() / 48e3 - 1.0).abs() < 1e-4);
}

fn archive(name: &str, write: impl FnOnce(&mut NpzWriter)) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    let mut npz = NpzWriter::create(&path).unwrap();
    write(&mut npz);
    npz.finish().unwrap();
    (folder, path)
}

fn put(npz: &mut NpzWriter, name: &str, shape: &[usize], values: &[f64]) {
    let mut array = npz.begin(name, shape).unwrap();
    array.extend(values).unwrap();
    array.end().unwrap();
}

#[test]
fn archives_are_read_with_a_time_or_a_rate() {
    let values = samples(50);
    let times: Vec<f64> = (0..50).map(|k| 2.0 + f64::from(k) / 1024.0).collect();
    let (_kept, path) = archive("run.npz", |npz| {
        put(npz, "time_s", &[50], &times);
        put(npz, "P1", &[50], &values);
        put(npz, "ball_radius", &[50, 2], &[0.0; 100]);
        put(npz, "short", &[49], &values[..49]);
    });
    let found = only(read_signals(&path, &request(&["P1"], None)).unwrap());
    assert_samples(&found, 2.0, 1.0 / 1024.0, &values, 0.0);
    let message = |name: &str| {
        let error = read_signals(&path, &request(&[name], None)).unwrap_err();
        error.to_string().replace(&path.display().to_string(), "F")
    };
    assert_eq!(
        message("ball_radius"),
        "F: array \"ball_radius\": expected a signal of 50 samples, as the time has, found shape [50, 2]"
    );
    assert_eq!(
        message("short"),
        "F: array \"short\": expected a signal of 50 samples, as the time has, found shape [49]"
    );
    for (rate, known) in [(Some(2048.0), None), (None, Some(2048.0))] {
        let (_kept, path) = archive("rate.npz", |npz| {
            put(npz, "x", &[50], &values);
            if let Some(rate) = known {
                put(npz, "fs", &[1], &[rate]);
            }
        });
        let found = only(read_signals(&path, &request(&[], rate)).unwrap());
        assert_samples(&found, 0.0, 1.0 / 2048.0, &values, 0.0);
    }
    let (_kept, path) = archive("none.npz", |npz| put(npz, "x", &[50], &values));
    let error = read_signals(&path, &request(&[], None)).unwrap_err();
    assert_eq!(error.help().unwrap(), "give the sampling rate with --rate HZ");
}

#[test]
fn a_time_and_a_rate_that_contradict_each_other_are_refused() {
    let (_kept, path) = archive("both.npz", |npz| {
        let times: Vec<f64> = (0..64).map(|k| f64::from(k) / 1000.0).collect();
        put(npz, "time", &[64], &times);
        put(npz, "fs", &[1], &[2000.0]);
        put(npz, "x", &[64], &samples(64));
    });
    let error = read_signals(&path, &request(&[], None)).unwrap_err().to_string();
    assert!(error.contains("found 2000 Hz in \"fs\" and 1000"), "{error}");
    let found = only(read_signals(&path, &request(&[], Some(2000.0))).unwrap());
    assert!((found.series.rate_hz() / 2000.0 - 1.0).abs() < 1e-12);
}

#[test]
fn archives_may_state_the_speed() {
    let values = samples(50);
    let found = |speeds: &[(&str, &[f64])], channels: &[&str]| {
        let (_kept, path) = archive("speed.npz", |npz| {
            put(npz, "x", &[50], &values);
            put(npz, "fs", &[1], &[2048.0]);
            for (name, speed) in speeds {
                put(npz, name, &[speed.len()], speed);
            }
        });
        let found = read_signals(&path, &request(channels, None)).unwrap();
        found.iter().map(|own| own.speed_hz).collect::<Vec<_>>()
    };
    assert_eq!(found(&[], &[]), [None]);
    // a number that states the speed is no signal
    assert_eq!(found(&[("speed_hz", &[29.5])], &[]), [Some(29.5)]);
    assert_eq!(found(&[("Motor_RPM", &[1770.0])], &[]), [Some(29.5)]);
    let both: [(&str, &[f64]); 2] = [("rpm", &[1770.0]), ("speed_hz", &[29.0])];
    assert_eq!(found(&both, &[]), [None]);
    // a speed over time is one, and states nothing
    let over_time = [("rpm", &values[..])];
    assert_eq!(found(&over_time, &["x", "rpm"]), [None, None]);
}

#[test]
fn sound_files_are_read_in_every_depth() {
    let folder = tempfile::tempdir().unwrap();
    let values: Vec<f64> = (0..100).map(|k| 0.9 * (0.3 * f64::from(k)).sin()).collect();
    let write = |name: &str, bits: u16, format: hound::SampleFormat| {
        let path = folder.path().join(name);
        let spec = hound::WavSpec { channels: 2, sample_rate: 44_100, bits_per_sample: bits, sample_format: format };
        let mut to = hound::WavWriter::create(&path, spec).unwrap();
        for value in &values {
            match format {
                hound::SampleFormat::Float => {
                    to.write_sample(0.0_f32).unwrap();
                    to.write_sample(*value as f32).unwrap();
                }
                hound::SampleFormat::Int => {
                    to.write_sample(0_i32).unwrap();
                    let full = f64::from(bits - 1).exp2();
                    to.write_sample((value * full).round() as i32).unwrap();
                }
            }
        }
        to.finalize().unwrap();
        path
    };
    for (name, bits, format) in [
        ("8.wav", 8, hound::SampleFormat::Int),
        ("16.wav", 16, hound::SampleFormat::Int),
        ("24.wav", 24, hound::SampleFormat::Int),
        ("32-int.wav", 32, hound::SampleFormat::Int),
        ("32.WAV", 32, hound::SampleFormat::Float),
    ] {
        let path = write(name, bits, format);
        let found = only(read_signals(&path, &request(&["channel 2"], None)).unwrap());
        assert_eq!(found.series.unit(), "full scale");
        // half a step of the depth; a float has 24 bits
        let part = (-f64::from(bits.min(24) - 1)).exp2();
        assert_samples(&found, 0.0, 1.0 / 44_100.0, &values, part);
        let error = read_signals(&path, &request(&[], None)).unwrap_err();
        assert!(
            error.to_string().ends_with("expected one signal or the name of one, found \"channel 1\", \"channel 2\"")
        );
    }
    // half a file, and a head that promises 4 GiB
    let mut bytes = fs::read(folder.path().join("16.wav")).unwrap();
    bytes.truncate(200);
    let path = folder.path().join("cut.wav");
    fs::write(&path, &bytes).unwrap();
    let error = read_signals(&path, &request(&["channel 1"], None)).unwrap_err();
    assert!(matches!(error, MeasuredError::Refused { .. }), "{error}");
    let size = bytes.windows(4).position(|word| word == b"data").unwrap() + 4;
    bytes[size..size + 4].copy_from_slice(&[0xfc, 0xff, 0xff, 0xff]);
    fs::write(&path, &bytes).unwrap();
    let error = read_signals(&path, &request(&["channel 1"], None)).unwrap_err();
    assert!(matches!(error, MeasuredError::Refused { .. }), "{error}");
}

#[test]
fn doubles_of_a_sound_file_keep_their_digits() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/wav/float64.wav");
    let both = read_signals(&path, &request(&["channel 2", "channel 1"], None)).unwrap();
    // NumPy's sine differs in the last digit at most
    assert_samples(&both[1], 0.0, 1.0 / 48e3, &samples(12), 1e-15);
    let above_one = 1.0 + (-40_f64).exp2();
    assert_samples(&both[0], 0.0, 1.0 / 48e3, &[above_one; 12], 0.0);
}

/// A sound file of one part after another, each with its name.
fn sound(parts: &[(&[u8; 4], &[u8])]) -> Vec<u8> {
    let mut bytes = b"RIFF\0\0\0\0WAVE".to_vec();
    for (name, body) in parts {
        bytes.extend_from_slice(*name);
        bytes.extend_from_slice(&(body.len() as u32).to_le_bytes());
        bytes.extend_from_slice(body);
        bytes.resize(bytes.len().next_multiple_of(2), 0);
    }
    bytes
}

/// The head of a format: tag, channels, 8 kHz, bytes an instant, bits.
fn sound_head(tag: u16, channels: u16, align: u16, bits: u16) -> Vec<u8> {
    let words = [tag, channels, 8000, 0, 0, 0, align, bits];
    words.into_iter().flat_map(u16::to_le_bytes).collect()
}

#[test]
fn sound_files_with_other_parts_and_longer_heads_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.wav");
    let read = |bytes: &[u8]| {
        fs::write(&path, bytes).unwrap();
        let found = read_signals(&path, &request(&[], None));
        found.map_err(|error| error.to_string())
    };
    // 24 bits left-justified in 32, behind a part of odd length
    let mut head = sound_head(0xfffe, 1, 4, 32);
    head.extend([22, 0, 24, 0, 0, 0, 0, 0, 1, 0]);
    head.extend([0, 0, 0, 0, 0x10, 0, 0x80, 0, 0, 0xaa, 0, 0x38, 0x9b, 0x71]);
    let samples = [0, 0, 0, 0x80, 0, 0, 0, 0x40];
    let found = read(&sound(&[(b"LIST", b"odd"), (b"fmt ", &head), (b"data", &samples)]));
    assert_samples(&only(found.unwrap()), 0.0, 1.0 / 8e3, &[-1.0, 0.5], 0.0);
    let pcm = sound_head(1, 2, 4, 16);
    for (bytes, found) in [
        (b"RIFX".to_vec(), "no RIFF WAVE head"),
        (sound(&[]), "no format"),
        (sound(&[(b"fmt ", &pcm)]), "no samples"),
        (sound(&[(b"data", &[0; 4])]), "samples before their format"),
        (sound(&[(b"fmt ", &pcm), (b"data", &[0; 6])]), "6 bytes of samples, 4 at each instant"),
        (sound(&[(b"fmt ", &sound_head(2, 2, 1, 4)), (b"data", &[])]), "format 2 of 4 bits, 1 bytes for 2 channels"),
        (sound(&[(b"fmt ", &sound_head(1, 1, 4, 24)), (b"data", &[])]), "format 1 of 24 bits, 4 bytes for 1 channels"),
        (sound(&[(b"fmt ", &sound_head(1, 0, 0, 16))]), "8000 Hz and 0 channels"),
    ] {
        let error = read(&bytes).unwrap_err();
        let expected = format!(
            "{}: expected a sound file (RIFF WAVE, PCM of 8 to 32 bits, float of 32 or 64), found: {found}",
            path.display()
        );
        assert_eq!(error, expected);
    }
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
        "signal.xls: expected a file .npz, .mat, .csv, .txt, .wav, .uff or .unv, or a folder with results of `plummer run`"
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
