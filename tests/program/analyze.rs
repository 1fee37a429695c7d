//! `plummer analyze` from outside, and the verdicts on the example cases.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::fs;
use std::process::Output;

use super::common::{errors, plummer, scratch};
use plummer::app::case::Case;
use plummer::app::commands::analyze::WindowAnalysis;
use plummer::app::commands::run::compute_run;
use plummer::formats::NpzWriter;
use plummer::numerics::Unwatched;
use plummer::signal::diagnosis::Fault;
use serde_json::Value;

fn json(output: &Output) -> Value {
    assert_eq!(output.status.code(), Some(0), "{}", errors(output));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Parts that a window's verdict names.
fn named(window: &Value) -> Vec<&str> {
    let faults = window["verdict"]["faults"].as_array().unwrap().iter();
    let named = faults.filter(|fault| fault["conclusion"] == "named");
    named.map(|fault| fault["fault"].as_str().unwrap()).collect()
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
    diagnosis.named().map(|verdict| verdict.fault.name()).collect()
}

#[test]
fn a_healthy_bearing_has_no_fault() {
    assert_eq!(faults(&window("healthy", &short(0.3))), [""; 0]);
}

/// Its outer race's line is there under ten times its weight, and no fault. Balls strike, so that each start is another signal: the chance of
/// one scatters from 6e-14 to 6e-4 over forty starts, and in nine of them impulsiveness is 1 to 2.3.
#[test]
fn a_healthy_bearing_under_load_has_the_outer_races_line_and_no_fault() {
    let of_start = |start: f64| {
        let end = start + 0.3;
        let mut set = short(0.3);
        set.extend([
            "shaft.gravity=[0,-98.1]".to_owned(),
            format!("transient.start={start}"),
            format!("transient.end={end}"),
            format!("analysis.envelope=[{{from={start},to={end}}}]"),
        ]);
        let loaded = window("healthy", &set);
        assert_eq!(faults(&loaded), [""; 0]);
        let outer = &loaded.diagnosis.unwrap().faults[0];
        (outer.impulsiveness.unwrap(), outer.false_alarm.unwrap())
    };
    let (mut impulsiveness, mut chances): (Vec<f64>, Vec<f64>) =
        [0.1, 0.1003, 0.1011, 0.1027, 0.1042].map(of_start).into_iter().unzip();
    impulsiveness.sort_by(f64::total_cmp);
    chances.sort_by(f64::total_cmp);
    println!("{impulsiveness:?} {chances:?}");
    // four of five starts above 1 are one chance in a hundred
    assert!(impulsiveness[1] < 1.0, "{impulsiveness:?}");
    // medians of twenty starts are 1.6e-7 and 4.9e-8 with two kinds of round-off; a part without lines has 0.1 and more
    assert!(chances[2] < 1e-3, "{chances:?}");
}

/// Under thirty times its shaft's weight its balls strike as they cross the play and enter the load. That is told from a dent by no signal.
#[test]
fn strikes_of_balls_that_enter_a_large_load_are_no_verdict() {
    let mut set = short(0.6);
    set.push("shaft.loads=[{force=[0,-42.7]}]".to_owned());
    let told = |name: &str, set: &[String], expected: &str| {
        let loaded = window(name, set);
        assert_eq!(faults(&loaded), [""; 0], "{name}");
        let diagnosis = loaded.diagnosis.as_ref().unwrap();
        let why = &diagnosis.faults[0].why;
        assert!(why.contains(expected), "{name}: {why}");
        assert_eq!(diagnosis.by_signal_alone, [Fault::OuterRace], "{name}");
        let headline = diagnosis.headline();
        assert!(headline.starts_with("not enough evidence: outer race"), "{headline}");
    };
    let sound = "The case has no damage there, and the play is 2.5 µm";
    let hidden = "Its lines cannot be told from those of play: the play is 2.5 µm";
    told("healthy", &set, sound);
    told("outer-dent", &set, hidden);
    // a shaft that is as heavy itself is such a load
    let heavy = ["bearing.defects=[]", "shaft.mass=1.5", "bearing.first_ball_deg=270"].map(str::to_owned);
    told("../housings/ring", &heavy, sound);
    // without play no ball strikes
    set.push("bearing.radial_play=-1e-7".to_owned());
    assert_eq!(faults(&window("outer-dent", &set)), ["outer race"]);
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
    // 18 revolutions: of 13 one in four trajectories, which part by round-off, lacks evidence
    let (case, set) = (example("outer-dent"), short(0.4));
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
    // the same again loses nothing; another signal, or other values, need --force
    assert_eq!(plummer(&folder, &["analyze", "dent"]).status.code(), Some(0));
    let words = ["analyze", "dent/signals.npz", "--bearing", &case, "--channel", "P1", "--window", "0.1:0.3"];
    let other = plummer(&folder, &[&words[..], &["--out", "dent"]].concat());
    assert_eq!(other.status.code(), Some(2));
    assert!(
        errors(&other).contains("analysis.json is the result of an earlier run of another signal"),
        "{}",
        errors(&other)
    );
    // a window that is too short for any part
    let words = ["analyze", "dent", "--window", "0.2:0.25"];
    let other = plummer(&folder, &words);
    assert_eq!(other.status.code(), Some(2));
    assert!(
        errors(&other).contains("analysis.json is the result of an earlier run of other values"),
        "{}",
        errors(&other)
    );
    let words = [&words[..], &["--force"]].concat();
    let brief = plummer(&folder, &words);
    assert_eq!(brief.status.code(), Some(1), "{}", errors(&brief));
    assert!(errors(&brief).contains("no part could be judged"), "{}", errors(&brief));
    let outside = plummer(&folder, &["analyze", "dent", "--force", "--window", "0.2:9"]);
    assert_eq!(outside.status.code(), Some(2));
    assert!(errors(&outside).contains("is not inside the series"), "{}", errors(&outside));
}

/// A table as a recorder may write it: rings of 3 kHz, struck 3.585 times a turn of 25 Hz, and noise.
fn recorded(header: &str) -> String {
    let (mut text, mut state) = (format!("{header}\n"), 1_u64);
    for k in 0..16_000_u32 {
        let t = f64::from(k) / 16e3;
        let since = t - (t * 89.625).floor() / 89.625;
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
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
    let bearing = ["--balls", "9", "--pitch-diameter", "39.04", "--ball-diameter", "7.94"];
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
    let command = "plummer analyze bench.csv --balls 9 --pitch-diameter 39.04 --ball-diameter 7.94 --speed 25";
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
    assert!((order / (4.5 * (1.0 - 7.938 / 39.1)) - 1.0).abs() < 1e-12, "{order}");
    let report = fs::read_to_string(folder.join("out/bench/report.html")).unwrap();
    assert!(report.contains("9 balls of 7.938 mm on a circle of 39.10 mm (GMN, "));
    // under thrust, at a contact angle
    let found = json(&analyze(&[&named_bearing[..], &["--contact-angle", "15", "--json"]].concat()));
    let order = found["defect_orders"]["outer"].as_f64().unwrap();
    let expected = 4.5 * (1.0 - 7.938 / 39.1 * 15_f64.to_radians().cos());
    assert!((order / expected - 1.0).abs() < 1e-12, "{order}");
    let report = fs::read_to_string(folder.join("out/bench/report.html")).unwrap();
    assert!(report.contains(", at a contact angle of 15 degrees ("), "the assumption");
    assert!(report.contains("--bearing 6205"), "the command line");
    // a file of that name goes first
    fs::write(folder.join("6205"), "[bearing]\n").unwrap();
    let file = analyze(&named_bearing);
    assert_eq!(file.status.code(), Some(2));
    assert!(errors(&file).starts_with("error: 6205:1: "), "{}", errors(&file));
    fs::remove_file(folder.join("6205")).unwrap();
    // by orders alone, and a speed over time that is constant all the same
    let orders = ["--orders", "outer=3.585,inner=5.415", "--speed", "0:25,1:25"];
    let found = json(&analyze(&[&orders[..], &["--json", "--band", "2000:5000"]].concat()));
    assert_eq!(named(&found["windows"][0]), ["outer race"]);
    assert!(found["defect_orders"]["ball"].is_null());
    assert_eq!(numbers(&found["windows"][0]["band_hz"]), [2e3, 5e3]);
    assert!(found["windows"][0]["kurtosis_limit"].is_null());
    // the band that rings, found by its kurtosis: wide enough for the eighth harmonic of the highest order, 1083 Hz
    let found = json(&by(&["--speed", "25", "--json", "--band", "kurtogram"]));
    let window = &found["windows"][0];
    assert_eq!(named(window), ["outer race"]);
    let band = numbers(&window["band_hz"]);
    assert!(band[0] >= 1083.0 && band[0] < 3e3 && band[1] > 3e3, "{band:?}");
    assert_eq!(window["high_pass_hz"].as_f64(), Some(band[0]));
    let kurtosis = window["kurtosis_of_band"].as_f64().unwrap();
    assert!(kurtosis > window["kurtosis_limit"].as_f64().unwrap());
    let report = fs::read_to_string(folder.join("out/bench/report.html")).unwrap();
    assert!(report.contains("--speed 25 --band kurtogram"), "the command line");
    assert!(report.contains("Kurtogram of P1") && report.contains("Kurtosis of that band"));
    // the whitened signal's squared envelope: a number without unit, and what is drawn of it
    assert_eq!(window["whitened"], false);
    let found = json(&by(&["--speed", "25", "--json", "--whiten"]));
    let window = &found["windows"][0];
    assert_eq!((&window["whitened"], named(window)), (&Value::from(true), vec!["outer race"]));
    let strongest = &peaks(window)[0];
    assert_eq!(strongest["labels"][0], "1 x outer race", "{strongest}");
    assert!(strongest["above_median_db"].as_f64().unwrap() > 12.0, "{strongest}");
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
            "error: bench.csv: nothing says how fast the shaft turns\nhelp: --speed 29.95Hz or 1797rpm, or over time --speed T:SPEED,T:SPEED,...\n",
        ),
        (
            analyze(&["--speed", "25"]),
            "error: bench.csv: nothing says which bearing it is\nhelp: --bearing CASE.toml or NAME (6205), or --balls N --pitch-diameter D --ball-diameter D [--contact-angle DEG], or --orders outer=..,inner=.. (or BPFO=.., BPFI=..)\n",
        ),
        (
            analyze(&["--speed", "25", "--contact-angle", "15"]),
            "error: --contact-angle: found 15 beside no bearing, expected --balls or a bearing of the catalogue (--bearing 6205)\nhelp: leave it out, or add --bearing NAME or --balls, --pitch-diameter and --ball-diameter\n",
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
            "error: --high-pass 9000: expected frequencies below half the sampling rate of bench.csv, channel \"P1\", which is 8000 Hz, found 9000 Hz\nhelp: lower --high-pass; is the sampling rate right (--rate)?\n",
        ),
        (
            by(&["--speed", "25", "--band", "1000:9000"]),
            "error: --band 1000:9000: expected frequencies below half the sampling rate of bench.csv, channel \"P1\", which is 8000 Hz, found 9000 Hz\nhelp: lower --band; is the sampling rate right (--rate)?\n",
        ),
        (
            by(&["--speed", "25", "--band", "9000:2000"]),
            "error: invalid value '9000:2000' for '--band <FROM:TO|kurtogram>': expected FROM:TO in Hz, 0 < FROM < TO, or kurtogram, found \"9000:2000\"\n\nFor more information, try '--help'.\n",
        ),
        (
            plummer(&folder, &["analyze", "."]),
            "error: . has no run.json and signals.npz: expected a folder with results of `plummer run`, or a file of signals\nhelp: run `plummer run CASE.toml --out .` first\n",
        ),
    ] {
        assert_eq!(output.status.code(), Some(2), "{expected}");
        assert_eq!(errors(&output), expected);
    }
    let unknown = analyze(&["--speed", "25", "--bearing", "6299"]);
    assert_eq!(unknown.status.code(), Some(2));
    let expected = "error: --bearing: found \"6299\", expected a case file or a bearing of the catalogue\nhelp: bearings here: 625, ";
    assert!(errors(&unknown).starts_with(expected), "{}", errors(&unknown));
    let still = by(&["--speed", "0"]);
    assert_eq!(still.status.code(), Some(1));
    assert!(errors(&still).contains("found one that rests or turns back at 0 s"), "{}", errors(&still));
}

/// A table with these channels, rings of 3 kHz as of [`recorded`] in the first of them and its noise in the others.
fn channels(names: &[&str], with_time: bool) -> String {
    let table = recorded("");
    let rows: Vec<(&str, &str)> = table.lines().skip(1).filter_map(|row| row.split_once(',')).collect();
    let mut text = if with_time { "time,".to_owned() } else { String::new() };
    text.push_str(&names.join(","));
    for (place, (time, ring)) in rows.iter().enumerate() {
        text.push('\n');
        if with_time {
            write!(text, "{time},").unwrap();
        }
        text.push_str(ring);
        for _ in 1..names.len() {
            // no order that any part has
            let far = (place * 7_919) % rows.len();
            write!(text, ",{}", rows[far].1).unwrap();
        }
    }
    text + "\n"
}

const ORDERS: &str = "outer=3.585,inner=5.415,ball=4.713,cage=0.398";

#[test]
fn a_speed_has_a_unit_and_a_large_one_without_is_doubted() {
    let folder = scratch("analyze-speed");
    fs::write(folder.join("bench.csv"), recorded("time,P1 (g)")).unwrap();
    let at = |speed: &str, more: &[&str]| {
        let words = ["analyze", "bench.csv", "--force", "--orders", ORDERS, "--speed", speed];
        plummer(&folder, &[&words[..], more].concat())
    };
    for speed in ["1500rpm", "1500 RPM", "25 hz", "25", "1500 1/min", "0:1500rpm,1:1500rpm"] {
        let output = at(speed, &["--json"]);
        assert_eq!(errors(&output), "", "{speed}");
        let found = json(&output);
        assert_eq!(named(&found["windows"][0]), ["outer race"], "{speed}");
        let hz = found["windows"][0]["speed_hz"].as_f64().unwrap();
        assert!((hz - 25.0).abs() < 1e-9, "{speed}: {hz}");
    }
    let report = || fs::read_to_string(folder.join("out/bench/report.html")).unwrap();
    at("1500 rpm", &[]);
    assert!(report().contains("--speed &#x27;1500 rpm&#x27;"));
    assert!(report().contains("The shaft turns as --speed says: 1500 rpm."));
    let doubted = at("1797", &[]);
    let words = "--speed 1797 is read as 1797 Hz (107 820 rpm): write 1797rpm if revolutions per minute were meant";
    assert!(errors(&doubted).starts_with(&format!("warning: {words}\n")), "{}", errors(&doubted));
    assert!(report().contains(words));
    assert!(!errors(&at("1797", &["--quiet"])).contains("warning"));
    let unknown = at("1797 rps", &[]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(
        errors(&unknown).contains("SPEED in Hz, or 1797rpm, \"1797 1/min\", 29.95Hz), found \"1797 rps\""),
        "{}",
        errors(&unknown)
    );
}

#[test]
fn orders_have_the_names_of_catalogues_too() {
    let folder = scratch("analyze-orders");
    fs::write(folder.join("bench.csv"), recorded("time,P1 (g)")).unwrap();
    let by = |orders: &str| {
        let words = ["analyze", "bench.csv", "--force", "--speed", "25", "--json", "--orders", orders];
        plummer(&folder, &words)
    };
    let orders = |output: &Output| json(output)["defect_orders"].clone();
    let usual = by("outer=3.585,inner=5.415,ball=4.714,cage=0.398");
    let output = by("BPFO=3.585,bpfi=5.415,Bsf=2.357,FTF=0.398");
    assert_eq!(orders(&output), orders(&usual));
    assert_eq!(errors(&output), "");
    let report = fs::read_to_string(folder.join("out/bench/report.html")).unwrap();
    let command = "BPFO=3.585,bpfi=5.415,Bsf=2.357,FTF=0.398";
    assert!(report.contains(command), "the command line");
    let spin = by("outer=3.585,inner=5.415,ball=2.357");
    assert!(errors(&spin).contains("write BSF=2.357 if the spin of a ball is meant"), "{}", errors(&spin));
}

#[test]
fn all_that_is_missing_is_said_at_once() {
    let folder = scratch("analyze-missing");
    fs::write(folder.join("two.csv"), channels(&["P1", "P2"], false)).unwrap();
    let bearing = "help: --bearing CASE.toml or NAME (6205), or --balls N --pitch-diameter D --ball-diameter D [--contact-angle DEG], or --orders outer=..,inner=.. (or BPFO=.., BPFI=..)\n";
    let speed = "help: --speed 29.95Hz or 1797rpm, or over time --speed T:SPEED,T:SPEED,...\n";
    let channel = "help: --channel NAME (repeatable), of \"P1\", \"P2\"\n";
    let rate = "help: --rate HZ, the sampling rate\n";
    for (more, expected) in [
        (
            &[][..],
            format!("error: two.csv: nothing says which channel is meant, how fast it was sampled, which bearing it is and how fast the shaft turns\n{channel}{rate}{bearing}{speed}"),
        ),
        (
            &["--rate", "16000", "--speed", "25"],
            format!("error: two.csv: nothing says which channel is meant and which bearing it is\n{channel}{bearing}"),
        ),
        (
            &["--channel", "P1", "--bearing", "6205"],
            format!("error: two.csv: nothing says how fast it was sampled and how fast the shaft turns\n{rate}{speed}"),
        ),
        (
            &["--rate", "16000", "--speed", "25", "--bearing", "6205"],
            "error: two.csv: expected one signal or the name of one, found \"P1\", \"P2\"\nhelp: name it with --channel NAME (repeatable)\n".to_owned(),
        ),
        (
            &["--channel", "P1", "--speed", "25", "--bearing", "6205"],
            "error: two.csv: expected a time or a sampling rate, found neither\nhelp: give the sampling rate with --rate HZ\n".to_owned(),
        ),
    ] {
        let output = plummer(&folder, &[&["analyze", "two.csv"][..], more].concat());
        assert_eq!(output.status.code(), Some(2));
        assert_eq!(errors(&output), expected);
        assert!(!folder.join("out").exists());
    }
}

/// Rows of `analysis.csv`, without the head.
fn rows(folder: &std::path::Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(folder.join("analysis.csv")).unwrap();
    let rows = text.lines().skip(1);
    rows.map(|row| row.split(',').map(str::to_owned).collect()).collect()
}

#[test]
fn many_files_are_one_table() {
    let folder = scratch("analyze-many");
    fs::write(folder.join("a.csv"), recorded("time,P1 (g)")).unwrap();
    fs::write(folder.join("b.csv"), channels(&["P1", "P2"], true)).unwrap();
    let shared = ["--orders", ORDERS, "--speed", "1500rpm"];
    let analyze = |files: &[&str], more: &[&str]| plummer(&folder, &[&["analyze"], files, &shared[..], more].concat());
    let all = analyze(&["b.csv", "a.csv"], &["--window", "0:0.5", "--window", "0.5:0.9"]);
    assert_eq!(all.status.code(), Some(0), "{}", errors(&all));
    assert_eq!(errors(&all), "");
    let text = String::from_utf8(all.stdout.clone()).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines[1].starts_with("  File   Channel  Window        Speed [Hz]"), "{text}");
    assert!(lines[2].starts_with("  b.csv  P1       0 to 0.5 s"), "{text}");
    assert!(lines[2].contains("fault indicated: outer race "), "{text}");
    assert!(lines[8].starts_with("wrote out/analysis/analysis.json"), "{text}");
    let out = folder.join("out/analysis");
    let found: Vec<[String; 4]> =
        rows(&out).iter().map(|row| [&row[0], &row[1], &row[2], &row[8]].map(String::clone)).collect();
    let outer = "fault indicated: outer race";
    let expected = [
        ["b.csv", "P1", "0", outer],
        ["b.csv", "P1", "0.5", outer],
        ["b.csv", "P2", "0", "no fault indicated"],
        ["b.csv", "P2", "0.5", "not enough evidence: inner race"],
        ["a.csv", "P1", "0", outer],
        ["a.csv", "P1", "0.5", outer],
    ];
    assert_eq!(found, expected.map(|row| row.map(str::to_owned)));
    let written = fs::read_to_string(out.join("analysis.json")).unwrap();
    let written: Value = serde_json::from_str(&written).unwrap();
    let windows = written["windows"].as_array().unwrap();
    assert_eq!(windows.len(), 6);
    assert_eq!((&windows[0]["input"], &windows[4]["input"]), (&"b.csv".into(), &"a.csv".into()));
    assert_eq!(named(&windows[4]), ["outer race"]);
    assert_eq!(written["inputs"][1]["input"], "a.csv");
    assert!((written["inputs"][1]["defect_orders"]["outer"].as_f64().unwrap() - 3.585).abs() < 1e-12);
    // the report has the inputs first, then the verdicts and the windows
    let inputs = fs::read_to_string(out.join("tables/analysis-1-inputs.csv")).unwrap();
    let inputs: Vec<Vec<&str>> = inputs.lines().skip(1).map(|row| row.split(',').collect()).collect();
    assert_eq!(inputs.len(), 3);
    for (row, [file, channel, unit]) in
        inputs.iter().zip([["b.csv", "P1", ""], ["b.csv", "P2", ""], ["a.csv", "P1", "g"]])
    {
        assert_eq!([row[0], row[1], row[4]], [file, channel, unit]);
        for (place, expected) in [(2, 1.0), (3, 16e3), (5, 25.0)] {
            // instants of the table are rounded
            assert!((row[place].parse::<f64>().unwrap() / expected - 1.0).abs() < 1e-9, "{row:?}");
        }
    }
    let report = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(report.contains("plummer analyze b.csv a.csv --orders"), "the command line");
    assert!(report.contains("a.csv: P1, 0 to 0.5 s"));
    let first = fs::read_to_string(out.join("tables/analysis-2-verdicts.csv")).unwrap();
    let start = "File,Channel,Window,Speed [Hz],RMS,Kurtosis,Verdict,Reason\r\nb.csv,P1,0 to 0.5 s,25,0.213,";
    assert!(first.starts_with(start), "{first}");
    assert_eq!(first.lines().count(), 7, "{first}");
    // whatever the number of threads
    let same = |threads| {
        let output = analyze(&["b.csv", "a.csv", "b.csv"], &["--force", "--json", "--threads", threads]);
        json(&output)["windows"].clone()
    };
    assert_eq!(same("1"), same("3"));
    // a named channel is the only one
    let named = analyze(&["a.csv", "b.csv"], &["--force", "--channel", "P1"]);
    assert_eq!(named.status.code(), Some(0), "{}", errors(&named));
    assert_eq!(rows(&out).len(), 2);
    // each file gives those of several that it has, and a row for each that it has not
    let parts = analyze(&["a.csv", "b.csv", "a.xyz"], &["--force", "--channel", "P1", "--channel", "P2"]);
    assert_eq!(parts.status.code(), Some(2));
    assert!(errors(&parts).contains("\n  a.csv: expected a channel \"P2\", found \"P1\"\n"), "{}", errors(&parts));
    let found: Vec<String> = rows(&out).iter().map(|row| format!("{} {} {}", row[0], row[1], row[8])).collect();
    let expected = [
        "a.csv P2 not analysed",
        "a.csv P1 fault indicated: outer race",
        "b.csv P1 fault indicated: outer race",
        "b.csv P2 not enough evidence: inner race",
        "a.xyz  not analysed",
    ];
    assert_eq!(found, expected);
    // more than a report shows
    let many = analyze(&["a.csv"; 13], &["--force", "--window", "0:0.5"]);
    assert_eq!(many.status.code(), Some(0), "{}", errors(&many));
    let report = fs::read_to_string(out.join("report.html")).unwrap();
    let few = "This report has no plots of windows: there are 13, and it shows at most 12.";
    assert!(report.contains(few));
    assert!(!out.join("tables/analysis-3-verdict.csv").exists());
    // an array that is no signal is left out
    let values =
        recorded("").lines().skip(1).filter_map(|row| row.split_once(',')?.1.parse().ok()).collect::<Vec<f64>>();
    let mut npz = NpzWriter::create(folder.join("m.npz")).unwrap();
    npz.array("rate_hz", &[16e3]).unwrap();
    npz.matrix("map", 2, 3, &[0.0; 6]).unwrap();
    npz.array("P1", &values).unwrap();
    npz.finish().unwrap();
    let arrays = analyze(&["m.npz", "a.csv"], &["--force"]);
    assert_eq!(arrays.status.code(), Some(0), "{}", errors(&arrays));
    let found: Vec<String> = rows(&out).iter().map(|row| row[..2].join(" ")).collect();
    assert_eq!(found, ["m.npz P1", "a.csv P1"]);
    let report = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(report.contains("is left out: it is no signal (shape [2, 3])"));
    // of one file as well; the head of a report has names without a case too
    let names = ["--set", "report.customer=ACME", "--set", "report.title=Pump 3"];
    for (files, out) in [(&["a.csv"][..], "out/a"), (&["a.csv", "b.csv"][..], "out/analysis")] {
        let one = analyze(files, &[&names[..], &["--force"]].concat());
        assert_eq!(one.status.code(), Some(0), "{}", errors(&one));
        assert_eq!(rows(&folder.join(out))[0][8], outer);
        let report = fs::read_to_string(folder.join(out).join("report.html")).unwrap();
        assert!(report.contains("ACME") && report.contains("<title>Pump 3"), "{out}");
        assert!(
            report.contains("--set &#x27;report.customer=ACME&#x27; --set &#x27;report.title=Pump 3&#x27;"),
            "the command line"
        );
    }
    for (set, expected) in [
        ("bearing.balls=8", "error: --set bearing.balls=8: unknown key `bearing`"),
        ("report.client=A", "error: --set report.client=A: unknown key `report.client`"),
        ("report.title=''", "error: --set report.title='': `report.title`: found an empty text, expected some text"),
    ] {
        let wrong = analyze(&["a.csv"], &["--force", "--set", set]);
        assert_eq!(wrong.status.code(), Some(2));
        assert!(errors(&wrong).starts_with(expected), "{}", errors(&wrong));
    }
}

#[test]
fn a_file_that_cannot_be_analysed_does_not_stop_the_others() {
    let folder = scratch("analyze-some");
    fs::write(folder.join("a.csv"), recorded("time,P1 (g)")).unwrap();
    fs::write(folder.join("empty.csv"), "").unwrap();
    fs::write(folder.join("other.csv"), recorded("time,P2 (g)")).unwrap();
    fs::create_dir(folder.join("folder")).unwrap();
    let analyze = |files: &[&str], more: &[&str]| {
        let shared = ["--orders", ORDERS, "--channel", "P1"];
        plummer(&folder, &[&["analyze"], files, &shared[..], more].concat())
    };
    let files = ["empty.csv", "folder", "a.csv", "missing.csv", "other.csv"];
    let output = analyze(&files, &["--speed", "25"]);
    assert_eq!(output.status.code(), Some(2));
    let expected = "\
error: 4 of 5 inputs could not be analysed in full:
  empty.csv:1: expected a header and rows of numbers, found \"none\"
  folder has no run.json and signals.npz: expected a folder with results of `plummer run`, or a file of signals
  cannot read missing.csv: No such file or directory (os error 2)
  other.csv: expected a channel \"P1\", found \"P2\"
help: run `plummer run CASE.toml --out folder` first
help: did you mean --channel 'P2'?
";
    assert_eq!(errors(&output), expected);
    let out = folder.join("out/analysis");
    let rows = rows(&out);
    let found: Vec<[&str; 2]> = rows.iter().map(|row| [row[0].as_str(), row[8].as_str()]).collect();
    let expected = [
        ["empty.csv", "not analysed"],
        ["folder", "not analysed"],
        ["a.csv", "fault indicated: outer race"],
        ["missing.csv", "not analysed"],
        ["other.csv", "not analysed"],
    ];
    assert_eq!(found, expected);
    assert!(rows[3].last().unwrap().contains("No such file"), "{rows:?}");
    let written = fs::read_to_string(out.join("analysis.json")).unwrap();
    let written: Value = serde_json::from_str(&written).unwrap();
    assert_eq!(written["windows"].as_array().unwrap().len(), 1);
    assert_eq!(written["failures"][1]["input"], "folder");
    // of no use at all: nothing is written
    let none = analyze(&["a.csv", "other.csv"], &["--out", "none"]);
    assert_eq!(none.status.code(), Some(2));
    assert!(errors(&none).contains("a.csv: nothing says how fast the shaft turns\n"), "{}", errors(&none));
    assert!(errors(&none).contains("\nhelp: --speed 29.95Hz or 1797rpm"), "{}", errors(&none));
    assert!(!folder.join("none/analysis.json").exists());
}

/// A run-up smears every line over Hz, and none over orders.
#[test]
fn peaks_of_a_run_up_are_not_compared_with_lines() {
    let folder = scratch("analyze-run-up");
    fs::write(folder.join("bench.csv"), recorded("time,P1 (g)")).unwrap();
    let at = |speed: &str| {
        let words = ["analyze", "bench.csv", "--force", "--json", "--orders", ORDERS, "--speed", speed];
        let output = plummer(&folder, &words);
        let window = json(&output)["windows"][0].clone();
        let report = fs::read_to_string(folder.join("out/bench/report.html")).unwrap();
        let peaks = fs::read_to_string(folder.join("out/bench/tables/analysis-2-strongest-peaks.csv"));
        (window, report, peaks.unwrap())
    };
    let why = "The speed changes in this window and smears all lines over Hz";
    let (steady, report, peaks) = at("0:25,1:25");
    assert_eq!(steady["envelope_peaks"][0]["nearest"], "outer race");
    assert!(steady["lines_smeared_above_order"].is_null());
    assert!(!report.contains(why));
    assert_eq!(report.matches("\">outer race</option>").count(), 2);
    assert!(peaks.contains("1 x outer race"), "{peaks}");
    // the mean is 25 Hz still
    let (rise, report, peaks) = at("0:20,1:30");
    for peak in rise["envelope_peaks"].as_array().unwrap() {
        assert!(peak["nearest"].is_null(), "{peak}");
        assert_eq!(peak["labels"], serde_json::json!([]), "{peak}");
    }
    let order = rise["lines_smeared_above_order"].as_f64().unwrap();
    assert!((order - 0.1).abs() < 1e-4, "{order}");
    assert!(report.contains(why));
    // the order spectrum's cursors stay
    assert_eq!(report.matches("\">outer race</option>").count(), 1);
    assert!(!peaks.contains(" x "), "{peaks}");
    // 0.2 Hz: sharp up to the order 5, so that the outer race's second harmonic is not compared
    let (some, report, _) = at("0:24.9,1:25.1");
    for peak in some["envelope_peaks"].as_array().unwrap() {
        let labels = peak["labels"].as_array().unwrap();
        let allowed = ["1 x outer race", "1 x shaft", "2 x shaft", "3 x shaft", "1 x ball"];
        let all = labels.iter().all(|label| allowed.contains(&label.as_str().unwrap()));
        assert!(all, "{peak}");
    }
    assert_eq!(some["envelope_peaks"][0]["labels"][0], "1 x outer race");
    assert!(report.contains("smears lines above the order 5.00 over Hz"));
}

/// The record of `examples/measured`, whose publisher says that the bearing is damaged, and not where. Both races have lines: the outer race five
/// harmonics, the inner race two with sidebands at twice the shaft's distance. Its line is within a hundredth of an order of a sideband of the outer race:
/// what is left to the inner race hangs on the last digit of the speed, and whether that suffices for a name is not known.
#[test]
fn both_races_of_a_measured_bearing_are_seen() {
    let folder = scratch("analyze-measured");
    let root = env!("CARGO_MANIFEST_DIR");
    let file = format!("{root}/examples/measured/nmb_1560kk.npz");
    let bearing = ["--balls", "7", "--pitch-diameter", "10.514", "--ball-diameter", "2.770"];
    // as its publisher rounds the speed, and as the shaft's lines have it
    for speed in ["306rpm", "304rpm"] {
        let words = [&["analyze", &file, "--json", "--force", "--speed", speed][..], &bearing].concat();
        let found = json(&plummer(&folder, &words));
        let named = named(&found["windows"][0]);
        assert_eq!(named[0], "outer race", "{speed}");
        let faults = found["windows"][0]["verdict"]["faults"].as_array().unwrap();
        let inner = faults.iter().find(|fault| fault["fault"] == "inner race").unwrap();
        assert!(inner["false_alarm"].as_f64().unwrap() < 1e-6, "{speed}: {inner}");
        let others = ["ball", "cage"].iter().any(|part| named.contains(part));
        assert!(!others, "{speed}: {named:?}");
    }
}

/// Rings of 3 kHz of a strength, struck 3.585 times a turn of 25 Hz, in noise; 4 s.
fn rings(header: &str, strength: f64, rate: u32, seed: u64) -> String {
    let (mut text, mut state) = (format!("{header}\n"), seed);
    for k in 0..4 * rate {
        let t = f64::from(k) / f64::from(rate);
        // balls slip: each strikes up to a fiftieth of a period late
        let place = t * 89.625;
        let late = |n: f64| 0.02 * (n * 0.618).fract();
        let since = match place.fract() - late(place.floor()) {
            since if since >= 0.0 => since / 89.625,
            since => (since + 1.0) / 89.625,
        };
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        let noise = (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
        let ring = strength * (-600.0 * since).exp() * (TAU * 3e3 * since).sin();
        writeln!(text, "{t},{:.6}", ring + 0.3 * noise).unwrap();
    }
    text
}

#[test]
fn what_grew_since_a_baseline_is_said() {
    let folder = scratch("analyze-baseline");
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
    write("now.csv", &rings("time,P1 (g)", 1.0, 16_000, 1));
    write("weaker.csv", &rings("time,P1 (g)", 0.25, 16_000, 2));
    write("same.csv", &rings("time,P9 (g)", 1.0, 16_000, 3));
    write("slow.csv", &rings("time,P1 (g)", 1.0, 4000, 4));
    write("metric.csv", &rings("time,P1 (m/s^2)", 1.0, 16_000, 5));
    let two = rings("time,P1 (g)", 1.0, 16_000, 6).replace("\n", ",1\n");
    write("two.csv", &two.replacen("P1 (g),1", "P2 (g),P3 (g)", 1));
    let analyze = |files: &[&str], more: &[&str]| {
        let shared = ["--bearing", "6205", "--speed", "25", "--force"];
        plummer(&folder, &[&["analyze"], files, &shared[..], more].concat())
    };
    let against = |baseline: &str, more: &[&str]| {
        let words = [&["--json", "--baseline", baseline][..], more].concat();
        json(&analyze(&["now.csv"], &words))["windows"][0].clone()
    };
    let outer = |window: &Value| window["changes"]["lines"][0].clone();
    // four times the strength: 12 dB
    let window = against("weaker.csv", &[]);
    assert_eq!(named(&window), ["outer race"]);
    let line = outer(&window);
    assert_eq!(line["fault"], "outer race");
    assert_eq!(line["conclusion"], "grew", "{line:#}");
    let [low, high] = numbers(&line["interval_db"])[..] else { panic!("{line:#}") };
    assert!(low < 12.04 && 12.04 < high && high - low < 4.0, "{line:#}");
    let why = window["verdict"]["faults"][0]["why"].as_str().unwrap();
    assert!(why.contains("It grew since the earlier signal: +1"), "{why}");
    let rms = &window["changes"]["levels"][0];
    assert_eq!(rms["conclusion"], "grew", "{rms:#}");
    let report = fs::read_to_string(folder.join("out/now/report.html")).unwrap();
    for text in [
        "--speed 25 --baseline weaker.csv",
        "What grew since weaker.csv",
        "outer race since weaker.csv",
        "RMS, earlier and now",
    ] {
        assert!(report.contains(text), "{text}");
    }
    let table = fs::read_to_string(folder.join("out/now/analysis.csv")).unwrap();
    assert!(table.contains("outer race: since the baseline"), "{table}");
    assert!(table.contains(",grew,"), "{table}");
    // the only channel of the baseline, whatever its name; and no change
    let window = against("same.csv", &[]);
    let line = outer(&window);
    assert_eq!(line["conclusion"], "as before", "{line:#}");
    assert_eq!(window["changes"]["channel"], "P9");
    let why = window["verdict"]["faults"][0]["why"].as_str().unwrap();
    assert!(why.contains("It was as strong in the earlier signal"), "{why}");
    // the band that rings lies beyond half the rate of the baseline
    let line = outer(&against("slow.csv", &[]));
    assert_eq!(line["conclusion"], "cannot be compared", "{line:#}");
    let why = line["why"].as_str().unwrap();
    assert!(why.contains("ends at 2000 Hz, half its sampling rate"), "{why}");
    // a speed and a window of its own
    let window = against("same.csv", &["--baseline-speed", "28", "--baseline-window", "1:3"]);
    let changes = &window["changes"];
    assert_eq!((&changes["from"], &changes["to"]), (&1.0.into(), &3.0.into()));
    let warning = changes["warnings"][0].as_str().unwrap();
    assert!(warning.starts_with("The shaft turned at 28.00 Hz"), "{warning}");
    // without a baseline nothing is said of one
    let alone = json(&analyze(&["now.csv"], &["--json"]));
    assert!(alone["windows"][0].get("changes").is_none());
    let table = fs::read_to_string(folder.join("out/now/analysis.csv")).unwrap();
    assert!(!table.contains("baseline"), "{table}");
    // many against one, and a file against itself
    let many = analyze(&["now.csv", "weaker.csv"], &["--baseline", "weaker.csv", "--out", "many"]);
    let said = String::from_utf8_lossy(&many.stdout).into_owned();
    let row = |file: &str| said.lines().find(|line| line.trim_start().starts_with(file)).unwrap_or_default();
    assert!(row("now.csv").contains("outer race +12.0 dB"), "{said}{}", errors(&many));
    assert!(!row("weaker.csv").contains(" dB"), "{said}");
    let report = fs::read_to_string(folder.join("many/report.html")).unwrap();
    assert!(report.contains("weaker.csv: The baseline is the input itself or a copy of it"));

    for (baseline, more, expected) in [
        (
            "two.csv",
            &[][..],
            "error: --baseline two.csv: expected a channel \"P1\", or one channel alone; found 2 others\nhelp: --baseline-channel NAME; the baseline has \"P2\", \"P3\"\n",
        ),
        (
            "metric.csv",
            &[],
            "error: --baseline metric.csv, channel \"P1\": found m/s^2, expected g as in the signal that it is compared with\nhelp: scale one of the two signals to the unit of the other\n",
        ),
        ("same.csv", &["--baseline-window", "1:9"], "error: --baseline same.csv, channel \"P9\": "),
        ("none.csv", &[], "error: cannot read none.csv"),
    ] {
        let words = [&["--baseline", baseline][..], more].concat();
        let output = analyze(&["now.csv"], &words);
        assert_eq!(output.status.code(), Some(2), "{}", errors(&output));
        assert!(errors(&output).starts_with(expected), "{}", errors(&output));
    }
    let output = analyze(&["now.csv"], &["--baseline-window", "1:2"]);
    assert_eq!(output.status.code(), Some(2), "{}", errors(&output));
    // a rate that is typed is not the baseline's where that has times, and lost samples stay an error
    let typed = ["--rate", "16000", "--baseline"];
    let slow = analyze(&["now.csv"], &[&typed[..], &["slow.csv", "--json"]].concat());
    let changes = &json(&slow)["windows"][0]["changes"];
    assert!(changes["to"].as_f64().unwrap() > 3.9, "{changes:#}");
    let whole = rings("time,P1 (g)", 1.0, 16_000, 7);
    let gap = whole.lines().enumerate();
    let gap = gap.filter(|(line, _)| !(9000..9100).contains(line));
    let gap: Vec<&str> = gap.map(|(_, text)| text).collect();
    write("gap.csv", &gap.join("\n"));
    let lost = analyze(&["now.csv"], &[&typed[..], &["gap.csv"]].concat());
    assert_eq!(lost.status.code(), Some(2), "{}", errors(&lost));
    // another name, and a sensor that is dead
    let named = analyze(&["now.csv"], &["--baseline", "two.csv", "--baseline-channel", "P2", "--json"]);
    assert_eq!(json(&named)["windows"][0]["changes"]["channel"], "P2");
    let rows = (0..4000).map(|k| format!("{},0\n", f64::from(k) / 1e3));
    let dead = format!("time,P1 (g)\n{}", rows.collect::<String>());
    fs::write(folder.join("dead.csv"), dead).unwrap();
    let said = analyze(&["now.csv"], &["--baseline", "dead.csv"]);
    let said = String::from_utf8_lossy(&said.stdout).into_owned();
    assert!(said.contains("warning: The earlier signal, P1, is constant: nothing can be compared"), "{said}");
    assert!(said.contains("the lines of no part can be compared with dead.csv"), "{said}");
    assert!(!said.contains("nothing grew"), "{said}");
    let dead = analyze(&["dead.csv"], &[]);
    assert_eq!(dead.status.code(), Some(1));
    assert!(errors(&dead).contains("expected a signal that changes, found a constant"), "{}", errors(&dead));
}

#[test]
fn a_shaft_faster_than_the_samples_is_refused() {
    let folder = scratch("analyze-fast");
    fs::write(folder.join("now.csv"), rings("time,P1", 1.0, 4000, 1)).unwrap();
    for speed in ["1e9", "0:30,20:1e300"] {
        let words = ["analyze", "now.csv", "--orders", "outer=3.585", "--speed", speed];
        let output = plummer(&folder, &words);
        assert_eq!(output.status.code(), Some(2), "{}", errors(&output));
        assert!(
            errors(&output).contains("expected a shaft speed below half of the sampling rate"),
            "{}",
            errors(&output)
        );
    }
}
