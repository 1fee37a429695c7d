//! Tables: names, units, times, decimal signs, and what is refused.

use std::path::Path;

use super::super::tests::{assert_samples, only, request};
use super::super::{MeasuredError, MeasuredSignal, SignalRequest};
use super::from_bytes;

fn table(text: &str, request: &SignalRequest) -> Result<Vec<MeasuredSignal>, MeasuredError> {
    let path = Path::new("m.csv");
    let channels = from_bytes(text.as_bytes(), path, request)?;
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
    let point = only(table("time (s);P1 (g)\n0;1\n0.25;-2.5\n0.5;1e-3\n0.75;4\n", &any).unwrap());
    let german = "# Messung vom 3. Mai\r\nZeit (s);P1 (g)\r\n0;1\r\n0,25;-2,5\r\n0,5;1,0E-3\r\n0,75;4,000\r\n";
    assert_eq!(only(table(german, &any).unwrap()), point);
    // units below the names, tabs, quotes; without names
    let units = "Zeit\tP1\ns\tg\n0,00\t1\n0,25\t-2,5\n0,50\t0,001\n0,75\t4\n";
    assert_eq!(only(table(units, &any).unwrap()), point);
    let quoted = "time_s,P1 (g)\n\"0,00\",1\n\"0,25\",\"-2,5\"\n\"0,50\",\"0,001\"\n\"0,75\",4\n";
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
        ("time,P1\n0,1\n0,2\n0,1\n1,1\n", "m.csv: row 3: expected equal time steps above 0 s, found a step of 0 s"),
        ("time,P1\n3,1\n2,2\n1,1\n", "m.csv: row 3: expected equal time steps above 0 s, found a step of -1 s"),
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
    let twice = refused("time_s,top,top\n0,1,2\n1,2,3\n", &request(&["top"], None));
    assert_eq!(twice, "m.csv: expected a channel \"top\", found \"top (column 2)\", \"top (column 3)\"");
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
    let told = only(table("time (s);P1\n0;4,744\n1;-12,001\n", &any).unwrap());
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
        let read = only(table(&format!("time (s);P1;P2\n{shown}"), &request(&["P1"], None)).unwrap());
        assert_eq!(read.doubts, [""; 0], "{shown}");
    }
    // of whole numbers beside, another column shows it but for an exporter that writes counts with thousands and times with decimals
    for beside in ["0,5;4,744;1\n1,0;128;1\n", "0;4,744;1\n1;128;1,5E3\n"] {
        let told = only(table(&format!("time_s;P1;P2\n{beside}"), &request(&["P1"], None)).unwrap());
        let doubt = "P1: \"4,744\" in line 2 is read as 4.744, beside \"128\" in line 3: only another column shows that the comma does not stand between thousands";
        assert_eq!(told.doubts, [doubt], "{beside}");
    }
}

/// What stands above the numbers in the files of recorders.
#[test]
fn lines_above_the_names_are_left_out() {
    let labview = "LabVIEW Measurement\t\nSeparator\tTab\nDecimal_Separator\t,\nTime\t11:31:20,4\n***End_of_Header***\t\n\t\n\
        Channels\t1\t\nSamples\t3\t\nY_Unit_Label\tm/s²\t\nX_Dimension\tTime\t\nDelta_X\t0,25\t\n***End_of_Header***\t\t\nX_Value\tP1 (peak)\tComment\n0,000000\t1,5\tok\n0,250000\t-2\n0,500000\t3\n";
    let dewesoft = "Data1\nSample rate: 4 Hz\nStart time: 03.05.2026 12:00:00,5\n\nTime (s);P1 (m/s²)\n0,00;1,5\n0,25;-2\n0,50;3\n";
    let catman = "CATMAN 5.4;;\nBench;3;\n\"Zeit  1 - Standardmessrate [s]\";\"P1 [g]\"\n0,00;1,5\n0,25;-2\n0,50;3\n";
    let famos = "Zeit in s;P1 / (m/s²)\n0,00;1,5\n0,25;-2\n0,50;3\n";
    let tektronix = "Model,DPO4054\nFirmware Version,2.13\nHorizontal Units,S\nRecord Length,3\nSample Interval,0.25\nVertical Units,V\n,\nLabel,\nTIME,P1\n0.00e+00,1.5\n0.25,-2\n0.50,3\n";
    let older = "Record Length,2.5e+03,,0.000,1.50,\nSample Interval,2.5e-1,,0.25,-2.00,\nVertical Units,mV,,0.50,3.00,\n,,,0.75,4.00,\n";
    let keysight = "x-axis,1\nsecond,Volt\n0.0E+00,1.5\n0.25,-2\n0.50,3\n";
    let rigol = "CH1,Start,Increment,\nVolt,0.0e+00,2.5e-01\n1.5,\n-2,\n3,\n";
    let siglent = "Vertical Units,CH1:V\nSource,CH1\nSecond,Volt\n0.00,1.5\n0.25,-2\n0.50,3\n";
    let rohde = "in s,CH1 in V\n0.00,1.5\n0.25,-2\n0.50,3\n";
    let pico = "Time,P1\n(ms),(mV)\n\n0.0,1.5\n250.0,-2\n500.0,3\n";
    let any = request(&[], None);
    for (text, name, unit, count) in [
        (labview, "P1 (peak)", "m/s²", 3),
        (dewesoft, "P1", "m/s²", 3),
        (catman, "P1", "g", 3),
        (famos, "P1", "m/s²", 3),
        (tektronix, "P1", "V", 3),
        (older, "column 5", "mV", 4),
        (keysight, "1", "Volt", 3),
        (pico, "P1", "mV", 3),
        (rigol, "CH1", "Volt", 3),
        (
            &rigol
                .replace("CH1,Start,Increment,", ",CH1")
                .replace("Volt,0.0e+00,2.5e-01", "Second,Volt")
                .replace("\n1.5,", "\n0,1.5")
                .replace("\n-2,", "\n0.25,-2")
                .replace("\n3,", "\n0.50,3"),
            "CH1",
            "Volt",
            3,
        ),
        (siglent, "Volt", "", 3),
        (rohde, "CH1", "V", 3),
        ("  0.00 1.5\n 0.25  -2\n 0.50   3\n", "column 2", "", 3),
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
    assert_eq!(refused(&damaged, &any), "m.csv:13: expected a finite number for P1, found \"?\"");
}

/// Files of instruments are often Latin-1, those of spreadsheets UTF-16.
#[test]
fn units_of_other_encodings_are_read() {
    let text = "t [µs];P1 [m/s²]\n0;1,5\n250000;-2\n";
    let latin: Vec<u8> = text.chars().map(|letter| letter as u8).collect();
    let wide: Vec<u8> = std::iter::once(0xfeff).chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    for bytes in [latin, wide] {
        let channels = from_bytes(&bytes, Path::new("m.csv"), &request(&[], None)).unwrap();
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
        "m.csv:2: expected 1 column, as in the first line, found \"2\": are commas both separators and decimal signs?"
    );
    assert!(error.help().unwrap().starts_with("write decimal points, semicolons"));
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

/// The head of LabVIEW's files: the settings of each channel in its column.
fn labview(settings: &str, names: &str, rows: &str) -> String {
    format!(
        "LabVIEW Measurement\nSeparator\tTab\nDecimal_Separator\t.\nTime\t09:54:07.28\n***End_of_Header***\n\n\
         Time\t09:54:07.28\t\t09:54:07.28\n{settings}***End_of_Header***\n{names}\tComment\n{rows}"
    )
}

/// Start, step and samples of a signal.
fn grid(text: &str, channel: &str) -> (f64, f64, Vec<f64>) {
    let found = only(table(text, &request(&[channel], None)).unwrap_or_else(|error| panic!("{text}: {error}")));
    (found.series.start_s(), found.series.step_s(), found.series.values().to_vec())
}

#[test]
fn each_channel_has_the_times_that_belong_to_it() {
    let catman = "CATMAN 5.4\nZeit  1 - Standardmessrate [s];P1 [g];Zeit  2 - Schnelle Messrate [s];P2 [g]\n\
        0,0;1,5;0,00;4\n0,5;2,5;0,25;5\n;;0,50;6\n;;0,75;7\n";
    let multi = labview(
        "X0\t0.0\t\t0.0\nDelta_X\t0.5\t\t0.25\n",
        "X_Value\tP1\tX_Value\tP2",
        "0.0\t1.5\t0.00\t4\n0.5\t2.5\t0.25\t5\n\t\t0.50\t6\n\t\t0.75\t7\n",
    );
    for text in [catman, &multi] {
        assert_eq!(grid(text, "P1"), (0.0, 0.5, vec![1.5, 2.5]));
        assert_eq!(grid(text, "P2"), (0.0, 0.25, vec![4.0, 5.0, 6.0, 7.0]));
        let both = table(text, &request(&["P2", "P1"], None)).unwrap();
        assert_eq!([both[0].own_rate_hz, both[1].own_rate_hz], [Some(4.0), Some(2.0)]);
    }
    let goes_on = format!("{catman}1,0;3,5;1,00;8\n");
    assert_eq!(
        refused(&goes_on, &request(&["P1"], None)),
        "m.csv:7: expected no numbers below the end of a channel, found \"1,0\""
    );
    // LabVIEW without times: its own start and step
    let settings = "X_Dimension\tTime\tTime\nX0\t2.0\t0\nDelta_X\t0.25\t0.5\n";
    let none = labview(settings, "X_Value\tP1\tP2", "\t1.5\t4\n\t2.5\t5\n");
    assert_eq!(grid(&none, "P1"), (2.0, 0.25, vec![1.5, 2.5]));
    assert_eq!(grid(&none, "P2"), (0.0, 0.5, vec![4.0, 5.0]));
    let one = labview("Delta_X\t0,5\n", "X_Value\tP1", "\t1,5\n\t2,25\n");
    assert_eq!(grid(&one, "P1"), (0.0, 0.5, vec![1.5, 2.25]));
}

#[test]
fn times_of_other_channels_are_refused_and_a_rate_takes_their_place() {
    let first = labview("Delta_X\t0.5\t0.25\n", "X_Value\tP1\tP2", "0\t1\t4\n0.5\t2\t5\n");
    let spectrum = labview("X_Dimension\tTime\tFrequency\n", "X_Value\tP1\tP2", "0\t1\t4\n0.5\t2\t5\n");
    let several = "expected one column of times, or each with its channels to its right, for P2, found";
    for (text, expected) in [
        (&*first, "m.csv:8: expected the step of the times for P2, found \"Delta_X 0.25\"".to_owned()),
        (&spectrum, "m.csv:8: expected times for P2, found \"X_Dimension Frequency\"".to_owned()),
        (
            "t1;Zeit 2 - a [s];Zeit 3 - b [s];P2\n5;0;0;1\n6;1;2;2\n",
            format!("m.csv:1: {several} \"Zeit 2 - a [s]\", \"Zeit 3 - b [s]\""),
        ),
        ("P1;time (s);P2;time (ms)\n5;0;1;0\n6;1;2;1\n", format!("m.csv:1: {several} \"time (s)\", \"time (ms)\"")),
    ] {
        let error = table(text, &request(&["P2"], None)).unwrap_err();
        assert_eq!(error.to_string(), expected);
        assert!(error.help().unwrap().starts_with("--rate HZ takes the place of the times"));
        let typed = only(table(text, &request(&["P2"], Some(8.0))).unwrap());
        assert_eq!((typed.series.step_s(), typed.series.values().len()), (0.125, 2));
    }
}

#[test]
fn units_of_the_time_are_found_about_the_names_or_told_or_refused() {
    let any = request(&[], None);
    for text in [
        "ms,g\nTime,P1\n500,1\n750,2\n",
        "bench,3\n(ms),(g)\nTime,P1\n500,1\n750,2\n",
        "Time,P1\nclock,top\n[ms],[g]\n500,1\n750,2\n",
        "Time (ms),P1 [g]\nbench 3,\n500,1\n750,2\n",
        "[ms],P1 in g\n500,1\n750,2\n",
        "x,P1\n[ms],[g]\n500,1\n750,2\n",
        "time (ms),x-axis,y-axis,P1 (g)\n500,8,9,1\n750,9,9,2\n",
        "Time,P1\n(\u{3bc}s),(g)\n500000,1\n750000,2\n",
    ] {
        let found = table(text, &request(&["P1"], None)).map(only);
        let found = found.unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!((&*found.name, found.series.unit(), found.doubts.len()), ("P1", "g", 0), "{text}");
        assert_samples(&found, 0.5, 0.25, &[1.0, 2.0], 1e-12);
    }
    for (text, expected) in [
        ("s,g\nTime (ms),P1\n0,1\n1,2\n", "m.csv:1: expected the unit of the time that the names state, found \"s\""),
        ("Time,P1\nclock,top\n0,1\n1,2\n", "m.csv:2: expected s, ms, us or ns as unit of the time, found \"clock\""),
        (
            "Horizontal Units,Hz\nTIME,P1\n0,1\n1,2\n",
            "m.csv:1: expected s, ms, us or ns as unit of the time, found \"Hz\"",
        ),
        (
            "Date,Time,P1,P2\n2026-05-03,12:00:00.0,1,2\n2026-05-03,12:00:00.1,2,3\n",
            "m.csv:2: expected a number for the time, found \"12:00:00.0\"",
        ),
    ] {
        assert_eq!(refused(text, &request(&["P1"], None)), expected);
        let typed = only(table(text, &request(&["P1"], Some(8.0))).unwrap());
        assert_eq!(typed.series.values(), [1.0, 2.0]);
    }
    // ms without their unit, and numbers of samples
    for (text, rate) in [("t,P1\n0.0,1\n0.05,2\n0.1,3\n", "20"), ("t;P1\n0;1\n1;2\n2;3\n", "1")] {
        let told = format!(
            "the time: nothing states its unit: it is read in s, which makes {rate} Hz; --rate HZ takes its place"
        );
        assert_eq!(only(table(text, &any).unwrap()).doubts, [told]);
        assert_eq!(only(table(text, &request(&[], Some(2e4))).unwrap()).doubts, [""; 0]);
    }
    assert_eq!(only(table("t,P1\n0,1\n1e-4,2\n", &any).unwrap()).doubts, [""; 0]);
}
