//! `plummer analyze` from outside, and the verdicts on the example cases.

mod program;

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::fs;
use std::process::Output;

use plummer::case::Case;
use plummer::stages::{Unwatched, WindowAnalysis, compute_run};
use program::{errors, plummer, scratch};
use serde_json::Value;

fn json(output: &Output) -> Value {
    assert_eq!(output.status.code(), Some(0), "{}", errors(output));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Parts that a window's verdict names.
fn named(window: &Value) -> Vec<&str> {
    let faults = window["verdict"]["faults"].as_array().unwrap().iter();
    let named = faults.filter(|fault| fault["conclusion"] == "named");
    named
        .map(|fault| fault["fault"].as_str().unwrap())
        .collect()
}

fn numbers(list: &Value) -> Vec<f64> {
    let list = list.as_array().unwrap().iter();
    list.map(|number| number.as_f64().unwrap()).collect()
}

/// What makes an example short: 44 Hz all the time, analysed as a whole.
fn short(seconds: f64) -> Vec<String> {
    let end = 0.1 + seconds;
    vec![
        "speed.profile=[{time=0,hz=44}]".to_owned(),
        "transient.start=0.1".to_owned(),
        format!("transient.end={end}"),
        format!("analysis.envelope=[{{from=0.1,to={end}}}]"),
    ]
}

fn example(name: &str) -> String {
    let root = env!("CARGO_MANIFEST_DIR");
    format!("{root}/examples/tadina2011/{name}.toml")
}

/// The analysed window of an example.
fn window(name: &str, set: &[String]) -> WindowAnalysis {
    let case = Case::load(example(name), set).unwrap();
    compute_run(&case, &Unwatched).unwrap().windows.remove(0)
}

fn faults(window: &WindowAnalysis) -> Vec<&'static str> {
    let diagnosis = window.diagnosis.as_ref().unwrap();
    println!("{}", diagnosis.sentence());
    diagnosis
        .named()
        .map(|verdict| verdict.fault.name())
        .collect()
}

#[test]
fn a_healthy_bearing_has_no_fault() {
    assert_eq!(faults(&window("healthy", &short(0.3))), [""; 0]);
}

/// Its outer race's line is there with all certainty under ten times its weight, and no fault.
#[test]
fn a_healthy_bearing_under_load_has_the_outer_races_line_and_no_fault() {
    let mut set = short(0.3);
    set.push("shaft.gravity=[0,-98.1]".to_owned());
    let loaded = window("healthy", &set);
    assert_eq!(faults(&loaded), [""; 0]);
    let outer = &loaded.diagnosis.unwrap().faults[0];
    assert!(outer.false_alarm.unwrap() < 1e-6, "{outer:#?}");
    assert!(outer.impulsiveness.unwrap() < 1.0, "{outer:#?}");
}

#[test]
fn a_dent_in_the_inner_race_is_named() {
    assert_eq!(faults(&window("inner-dent", &short(0.3))), ["inner race"]);
}

/// A ball strikes where the load is only: a longer window.
#[test]
fn a_flat_on_a_ball_is_named() {
    assert_eq!(faults(&window("ball-flat", &short(0.6))), ["ball"]);
}

#[test]
fn a_run_and_its_folder_have_the_same_verdict() {
    let folder = scratch("analyze-run");
    let (case, set) = (example("outer-dent"), short(0.3));
    let mut words = vec!["run", &case, "--out", "dent", "--json"];
    words.extend(set.iter().flat_map(|set| ["--set", set]));
    let run = json(&plummer(&folder, &words));
    let found = json(&plummer(&folder, &["analyze", "dent", "--json"]));
    assert_eq!(named(&found["windows"][0]), ["outer race"]);
    // the same samples through the same code; read from a file, filtered with other margins
    assert_eq!(named(&run["windows"][0]), ["outer race"]);
    let rms = |result: &Value| result["windows"][0]["rms"].as_f64().unwrap();
    assert!((rms(&run) / rms(&found) - 1.0).abs() < 1e-12);
    assert_eq!(found["command"], "analyze");
    assert!((found["defect_orders"]["outer"].as_f64().unwrap() - 2.568).abs() < 1e-3);
    assert!((found["windows"][0]["speed_hz"].as_f64().unwrap() - 44.0).abs() < 1e-9);
    assert!(found["windows"][0]["envelope_peaks"][0]["frequency_hz"].is_f64());
    // the run's own report stays
    for name in ["report.html", "analysis-report.html", "analysis.json"] {
        assert!(folder.join("dent").join(name).is_file(), "{name}");
    }
    let again = plummer(&folder, &["analyze", "dent"]);
    assert_eq!(again.status.code(), Some(2));
    assert!(errors(&again).contains("is the result of an earlier run"));
    // a window that is too short for any part
    let words = ["analyze", "dent", "--force", "--window", "0.2:0.25"];
    let brief = plummer(&folder, &words);
    assert_eq!(brief.status.code(), Some(1), "{}", errors(&brief));
    assert!(
        errors(&brief).contains("no part could be judged"),
        "{}",
        errors(&brief)
    );
    let outside = plummer(
        &folder,
        &["analyze", "dent", "--force", "--window", "0.2:9"],
    );
    assert_eq!(outside.status.code(), Some(2));
    assert!(
        errors(&outside).contains("is not inside the series"),
        "{}",
        errors(&outside)
    );
}

/// A table as a recorder may write it: rings of 3 kHz, struck 3.585 times a turn of 25 Hz, and noise.
fn recorded(header: &str) -> String {
    let (mut text, mut state) = (format!("{header}\n"), 1_u64);
    for k in 0..16_000_u32 {
        let t = f64::from(k) / 16e3;
        let since = t - (t * 89.625).floor() / 89.625;
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        let noise = (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
        let ring = (-600.0 * since).exp() * (TAU * 3e3 * since).sin();
        writeln!(text, "{t},{:.6}", ring + 0.3 * noise).unwrap();
    }
    text
}

#[test]
fn a_table_is_judged_by_the_dimensions_of_its_bearing() {
    let folder = scratch("analyze-table");
    fs::write(folder.join("bench.csv"), recorded("time,P1 (g)")).unwrap();
    let bearing = [
        "--balls",
        "9",
        "--pitch-diameter",
        "39.04",
        "--ball-diameter",
        "7.94",
    ];
    let analyze = |more: &[&str]| {
        let words = [&["analyze", "bench.csv", "--force"][..], more].concat();
        plummer(&folder, &words)
    };
    let by = |more: &[&str]| analyze(&[&bearing[..], more].concat());
    let found = json(&by(&["--speed", "25", "--json"]));
    let window = &found["windows"][0];
    assert_eq!(named(window), ["outer race"]);
    assert_eq!(window["unit"], "g");
    // an eighth of the rate
    assert!((window["high_pass_hz"].as_f64().unwrap() - 2e3).abs() < 1e-9);
    let written = fs::read_to_string(folder.join("out/bench/analysis.json")).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&written).unwrap(), found);
    let report = fs::read_to_string(folder.join("out/bench/report.html")).unwrap();
    let command = "plummer analyze bench.csv --balls 9 --pitch-diameter 39.04 --ball-diameter 7.94 --contact-angle 0 --speed 25";
    assert!(report.contains(command), "the command line");
    assert!(report.contains("outer race"));
    // six harmonics of 89.6 Hz; the fourth is within 3 % of three times the ball's 117.8 Hz too
    let peaks = |window: &Value| window["envelope_peaks"].as_array().unwrap().clone();
    for peak in peaks(window) {
        let multiple = (peak["frequency_hz"].as_f64().unwrap() / 89.6).round();
        let expected = [format!("{multiple} x outer race")];
        assert_eq!(peak["labels"], serde_json::json!(expected), "{peak}");
    }
    let table = || {
        let tables = folder.join("out/bench/tables/analysis-2-strongest-peaks.csv");
        fs::read_to_string(tables).unwrap()
    };
    assert!(table().contains(",2 x outer race,"), "{}", table());
    // the order spectrum and the envelope spectrum offer the shaft and four parts
    for family in ["shaft", "outer race", "inner race", "ball", "cage"] {
        let option = format!("\">{family}</option>");
        assert_eq!(report.matches(&option).count(), 2, "{family}");
    }
    // by the name of its bearing, with the maker's numbers
    let named_bearing = ["--bearing", "6205", "--speed", "25"];
    let found = json(&analyze(&[&named_bearing[..], &["--json"]].concat()));
    assert_eq!(named(&found["windows"][0]), ["outer race"]);
    let order = found["defect_orders"]["outer"].as_f64().unwrap();
    assert!(
        (order / (4.5 * (1.0 - 7.938 / 39.1)) - 1.0).abs() < 1e-12,
        "{order}"
    );
    let report = fs::read_to_string(folder.join("out/bench/report.html")).unwrap();
    assert!(report.contains("9 balls of 7.938 mm on a circle of 39.10 mm (GMN, "));
    assert!(report.contains("--bearing 6205"), "the command line");
    // a file of that name goes first
    fs::write(folder.join("6205"), "[bearing]\n").unwrap();
    let file = analyze(&named_bearing);
    assert_eq!(file.status.code(), Some(2));
    assert!(
        errors(&file).starts_with("error: 6205:1: "),
        "{}",
        errors(&file)
    );
    fs::remove_file(folder.join("6205")).unwrap();
    // by orders alone, and a speed over time that is constant all the same
    let orders = [
        "--orders",
        "outer=3.585,inner=5.415",
        "--speed",
        "0:25,1:25",
    ];
    let found = json(&analyze(
        &[&orders[..], &["--json", "--band", "2000:5000"]].concat(),
    ));
    assert_eq!(named(&found["windows"][0]), ["outer race"]);
    assert!(found["defect_orders"]["ball"].is_null());
    assert_eq!(numbers(&found["windows"][0]["band_hz"]), [2e3, 5e3]);
    assert!(found["windows"][0]["kurtosis_limit"].is_null());
    // the band that rings, found by its kurtosis: wide enough for the eighth harmonic of the highest order, 1083 Hz
    let found = json(&by(&["--speed", "25", "--json", "--band", "kurtogram"]));
    let window = &found["windows"][0];
    assert_eq!(named(window), ["outer race"]);
    let band = numbers(&window["band_hz"]);
    assert!(
        band[0] >= 1083.0 && band[0] < 3e3 && band[1] > 3e3,
        "{band:?}"
    );
    assert_eq!(window["high_pass_hz"].as_f64(), Some(band[0]));
    let kurtosis = window["kurtosis_of_band"].as_f64().unwrap();
    assert!(kurtosis > window["kurtosis_limit"].as_f64().unwrap());
    let report = fs::read_to_string(folder.join("out/bench/report.html")).unwrap();
    assert!(
        report.contains("--speed 25 --band kurtogram"),
        "the command line"
    );
    assert!(report.contains("Kurtogram of P1") && report.contains("Kurtosis of that band"));
    // the whitened signal's squared envelope: a number without unit, and what is drawn of it
    assert_eq!(window["whitened"], false);
    let found = json(&by(&["--speed", "25", "--json", "--whiten"]));
    let window = &found["windows"][0];
    assert_eq!(
        (&window["whitened"], named(window)),
        (&Value::from(true), vec!["outer race"])
    );
    let strongest = &peaks(window)[0];
    assert_eq!(strongest["labels"][0], "1 x outer race", "{strongest}");
    assert!(
        strongest["above_median_db"].as_f64().unwrap() > 12.0,
        "{strongest}"
    );
    let report = fs::read_to_string(folder.join("out/bench/report.html")).unwrap();
    assert!(report.contains("Squared envelope spectrum, whitened, of P1"));
    assert!(report.contains("--speed 25 --whiten"), "the command line");
    // another speed, at which nothing strikes
    let found = json(&by(&["--speed", "31", "--json"]));
    assert_eq!(named(&found["windows"][0]), [""; 0]);
    // the nearest line, three times the shaft's, is 3.7 % away
    let strongest = &peaks(&found["windows"][0])[0];
    assert_eq!(strongest["nearest"], "shaft", "{strongest}");
    assert_eq!(strongest["labels"], serde_json::json!([]), "{strongest}");
    assert!(table().contains(",–,,"), "{}", table());

    for (output, expected) in [
        (
            by(&[]),
            "error: nothing says how fast the shaft turns\nhelp: --speed HZ, or --speed T:HZ,T:HZ,...\n",
        ),
        (
            analyze(&["--speed", "25"]),
            "error: nothing says which bearing it is\nhelp: --bearing CASE.toml or NAME (6205), or --balls N --pitch-diameter D --ball-diameter D [--contact-angle DEG], or --orders outer=..,inner=..\n",
        ),
        (
            analyze(&["--speed", "25", "--bearing", "no/6205"]),
            "error: cannot read the case file no/6205: No such file or directory (os error 2)\n",
        ),
        (
            by(&["--speed", "25", "--channel", "P2"]),
            "error: bench.csv: expected a channel \"P2\", found \"P1\"\nhelp: did you mean --channel 'P1'?\n",
        ),
        (
            by(&["--speed", "25", "--geometry-error", "0.5"]),
            "error: relative error of the orders: expected 0 to 0.1, found 0.5\n",
        ),
        (
            by(&["--speed", "25", "--high-pass", "9000"]),
            "error: analysis: cut-off must lie between 0 and 8000 Hz (half the sampling rate), found 9000 Hz\n",
        ),
        (
            by(&["--speed", "25", "--band", "9000:2000"]),
            "error: invalid value '9000:2000' for '--band <FROM:TO|kurtogram>': expected FROM:TO in Hz, 0 < FROM < TO, or kurtogram, found \"9000:2000\"\n\nFor more information, try '--help'.\n",
        ),
        (
            plummer(&folder, &["analyze", "."]),
            "error: . has no run.json and signals.npz: expected a folder with results of `plummer run`, or a file of signals\n",
        ),
    ] {
        assert_eq!(output.status.code(), Some(2), "{expected}");
        assert_eq!(errors(&output), expected);
    }
    let unknown = analyze(&["--speed", "25", "--bearing", "6299"]);
    assert_eq!(unknown.status.code(), Some(2));
    let expected = "error: --bearing: found \"6299\", expected a case file or a bearing of the catalogue\nhelp: bearings: 625, ";
    assert!(
        errors(&unknown).starts_with(expected),
        "{}",
        errors(&unknown)
    );
    let still = by(&["--speed", "0"]);
    assert_eq!(still.status.code(), Some(1));
    assert!(
        errors(&still).contains("found one that rests or turns back at 0 s"),
        "{}",
        errors(&still)
    );
}
