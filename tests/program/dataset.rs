//! `plummer dataset` from outside: the same bytes however it is computed, what the manifest says against the signals, and what is refused.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::common::{errors, plummer, scratch};
use super::validator::Validator;
use serde_json::Value;

/// A ring on springs: no housing is condensed.
const SPEC: &str = r#"
seed = 7
count = 8
signals_per_specimen = 2

[[machines]]
case = "ring.toml"
weight = 2

[[machines]]
case = "ring.toml"
count = 2
per_machine = { "damping.modal" = { uniform = [0.02, 0.04] } }

[per_machine]
"accuracy.target" = 0.2

[per_specimen]
"bearing.radial_play" = { uniform = [1e-6, 3e-6] }

[per_signal]
"speed.profile" = [{ time = 0, hz = { uniform = [24, 26] } }]
"bearing.first_ball_deg" = { uniform = [0, 360] }

[fault]
none = 1
outer = { share = 1, angle_deg = 270, length = 0.5e-3, depth = { log_uniform = [5e-6, 15e-6] } }
inner = { share = 1, angle_deg = { uniform = [0, 360] }, length = 0.5e-3, depth = 10e-6 }

[recorder]
rate_hz = 12000
duration_s = 0.05
settle_s = 0.02
resonance_hz = 20e3
bits = 16
full_scale = 2000

[noise]
snr_db = 20
colour = { uniform = [0, 1] }
"#;

/// A folder with the ring and this specification.
fn folder(name: &str, spec: &str) -> PathBuf {
    let folder = scratch(&format!("dataset {name}"));
    let project = Path::new(env!("CARGO_MANIFEST_DIR"));
    fs::copy(project.join("examples/scenes/healthy.toml"), folder.join("ring.toml")).unwrap();
    fs::write(folder.join("spec.toml"), spec).unwrap();
    folder
}

fn dataset(folder: &Path, words: &[&str]) -> (i32, String) {
    let output = plummer(folder, &[&["dataset"], words].concat());
    (output.status.code().unwrap_or(-1), errors(&output) + &String::from_utf8_lossy(&output.stdout))
}

fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}

/// Every file below a folder but condensed housings and job scripts.
fn content(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for part in [folder.to_owned(), folder.join("dataset")] {
        for entry in fs::read_dir(&part).unwrap() {
            let path = entry.unwrap().path();
            let script = path.extension().is_some_and(|ending| ending == "sbatch" || ending == "sh");
            if path.is_file() && !script {
                files.insert(path.strip_prefix(folder).unwrap().display().to_string(), fs::read(&path).unwrap());
            }
        }
    }
    files
}

/// Checks that two data sets have the same files with the same bytes.
fn same(one: &BTreeMap<String, Vec<u8>>, other: &BTreeMap<String, Vec<u8>>) {
    assert!(one.keys().eq(other.keys()), "{:?}, {:?}", one.keys(), other.keys());
    let changed = one.iter().find(|(name, bytes)| other[*name] != **bytes);
    assert!(changed.is_none(), "{:?}", changed.map(|(name, _)| name));
}

/// An array of a data set's file, as it is there.
fn array(path: &Path, name: &str) -> Vec<u8> {
    let mut archive = zip::ZipArchive::new(fs::File::open(path).unwrap()).unwrap();
    let mut bytes = Vec::new();
    archive.by_name(&format!("{name}.npy")).unwrap().read_to_end(&mut bytes).unwrap();
    bytes
}

/// The samples of a data set's file, a row each.
fn signals(path: &Path) -> Vec<Vec<f64>> {
    let bytes = array(path, "signals");
    let array = npyz::NpyFile::new(&bytes[..]).unwrap();
    let columns = usize::try_from(array.shape()[1]).unwrap();
    let values: Vec<f64> = array.into_vec::<f32>().unwrap().into_iter().map(f64::from).collect();
    values.chunks(columns).map(<[f64]>::to_vec).collect()
}

#[test]
fn bytes_do_not_depend_on_threads_tasks_and_stops() {
    // four files of two signals
    let spec = SPEC.replace("count = 8", "count = 8\nsignals_per_file = 2");
    let folder = folder("bytes", &spec);
    let whole = |out: &str, words: &[&str]| {
        let (code, said) = dataset(&folder, &[&["spec.toml", "--out", out, "--quiet"], words].concat());
        assert!(code == 0 && !said.contains("warning:"), "{said}");
        content(&folder.join(out))
    };
    let one = whole("one", &["--threads", "1"]);
    let files = one.keys().filter(|name| name.starts_with("signals-")).count();
    assert_eq!(files, 4, "{:?}", one.keys());
    same(&one, &whole("two", &["--threads", "2"]));
    // tasks in another order
    assert_eq!(dataset(&folder, &["spec.toml", "--out", "tasks", "--slurm=2"]).0, 0);
    assert_eq!(dataset(&folder, &["tasks", "--task", "2/2"]).0, 0);
    let (code, said) = dataset(&folder, &["tasks", "--merge"]);
    assert_eq!(code, 1, "{said}");
    assert!(
        said.contains("2 of 4 files are not there or were changed: signals-00000.npz, signals-00002.npz"),
        "{said}"
    );
    assert_eq!(dataset(&folder, &["tasks", "--task", "1/2"]).0, 0);
    assert_eq!(dataset(&folder, &["tasks", "--merge"]).0, 0);
    same(&one, &content(&folder.join("tasks")));
    // what is named in the place of the folder
    for words in [["spec.toml", "--merge"].as_slice(), &["spec.toml", "--task", "1/2"], &[".", "--merge"]] {
        let (code, said) = dataset(&folder, words);
        assert!(code == 2 && said.contains("name the folder that `plummer dataset SPEC.toml` wrote"), "{said}");
    }
    // a label that was changed by hand
    let edited = folder.join("tasks/dataset/00002.json");
    let text = fs::read_to_string(&edited).unwrap();
    let label = text.lines().find(|line| line.contains("\"label\"")).unwrap();
    fs::write(&edited, text.replacen(label, "\"label\": \"several\",", 1)).unwrap();
    let (code, said) = dataset(&folder, &["tasks", "--merge"]);
    assert!(code == 1 && said.contains("1 of 4 files are not there or were changed: signals-00002.npz"), "{said}");
    same(&one, &whole("tasks", &["--resume"]));
    // a file that is lost, one that is damaged, one whose record is lost
    let at = folder.join("two");
    fs::remove_file(at.join("signals-00000.npz")).unwrap();
    fs::write(at.join("signals-00001.npz"), b"damaged").unwrap();
    fs::remove_file(at.join("dataset/00002.json")).unwrap();
    fs::remove_file(at.join("manifest.json")).unwrap();
    same(&one, &whole("two", &["--resume"]));
    // what more signals begin with
    let more = whole("two", &["--resume", "--count", "9"]);
    for (name, bytes) in one.iter().filter(|(name, _)| name.starts_with("signals-")) {
        assert!(more[name] == *bytes, "{name}");
    }
    let (code, said) = dataset(&folder, &["spec.toml", "--out", "two", "--resume"]);
    assert!(code == 2 && said.contains("was begun with 9 signals: expected as many or more, found 8"), "{said}");
    let (code, said) = dataset(&folder, &["spec.toml", "--out", "two", "--resume", "--count", "9", "--set", "seed=8"]);
    assert!(code == 2 && said.contains("begun with something else: no --set, now --set seed=8"), "{said}");
    fs::write(folder.join("spec.toml"), spec.replace("seed = 7", "seed = 8")).unwrap();
    let (code, said) = dataset(&folder, &["spec.toml", "--out", "two", "--resume"]);
    assert!(code == 2 && said.contains("was begun with something else: another specification"), "{said}");
    let other = whole("two", &["--force"]);
    assert!(other["signals-00000.npz"] != one["signals-00000.npz"]);
    assert!(!other.contains_key("signals-00004.npz"), "of the data set before");
    // files of another program by the names of these
    for name in ["signals-00000.npz", "manifest.csv", "dataset/00000.json"] {
        let strange = folder.join("strange");
        fs::create_dir_all(strange.join("dataset")).unwrap();
        fs::write(strange.join(name), "mine").unwrap();
        let (code, said) = dataset(&folder, &["spec.toml", "--out", "strange"]);
        assert!(code == 2 && said.contains(&format!("strange has {name} by the names of results")), "{said}");
        assert_eq!(fs::read_to_string(strange.join(name)).unwrap(), "mine");
        fs::remove_dir_all(strange).unwrap();
    }
}

/// Amplitude of the squared signal at the first harmonics of a frequency, Hz.
fn comb(signal: &[f64], rate_hz: f64, hz: f64) -> f64 {
    let mean = signal.iter().map(|x| x * x).sum::<f64>() / signal.len() as f64;
    let harmonic = |k: usize| {
        let step = TAU * hz * k as f64 / rate_hz;
        let sum = signal.iter().enumerate().fold([0.0, 0.0], |[re, im], (n, x)| {
            // Hann's window
            let window = 0.5 - 0.5 * (TAU * (n as f64 + 0.5) / signal.len() as f64).cos();
            let value = window * (x * x - mean);
            let angle = step * n as f64;
            [re + value * angle.cos(), im + value * angle.sin()]
        });
        sum[0].hypot(sum[1])
    };
    (1..=6).map(harmonic).sum()
}

#[test]
fn lines_are_where_the_manifest_says() {
    let spec = SPEC
        .replace("count = 8", "count = 4")
        .replace("signals_per_specimen = 2", "signals_per_specimen = 1")
        .replace("none = 1", "none = 0")
        .replace("duration_s = 0.05", "duration_s = 1.0")
        .replace("snr_db = 20", "snr_db = 40")
        .replace("[recorder]", "[slip]\nmean = { uniform = [0.005, 0.03] }\n\n[recorder]");
    let folder = folder("lines", &spec);
    let (code, said) = dataset(&folder, &["spec.toml", "--out", "out", "--quiet"]);
    assert_eq!(code, 0, "{said}");
    let manifest = json(&folder.join("out/manifest.json"));
    let rows = signals(&folder.join("out/signals-00000.npz"));
    let mut seen = BTreeSet::new();
    for signal in manifest["signals"].as_array().unwrap() {
        let label = signal["label"].as_str().unwrap();
        let key = if label == "outer" { "bpfo_hz" } else { "bpfi_hz" };
        let hz = signal[key].as_f64().unwrap();
        let row = &rows[signal["row"].as_u64().unwrap() as usize];
        // 1.5 % to either side, the range in which slip and speed move it
        let near = (-300..=300).map(|k| hz * (1.0 + 5e-5 * f64::from(k)));
        let found = near.max_by(|a, b| comb(row, 12e3, *a).total_cmp(&comb(row, 12e3, *b))).unwrap();
        assert!((found / hz - 1.0).abs() < 1e-3, "{label}: {found} Hz, by the manifest {hz} Hz");
        let slip = signal["drawn"]["slip.mean"].as_f64().unwrap();
        let [cage, outer, inner] = ["ftf_hz", "bpfo_hz", "bpfi_hz"].map(|key| signal[key].as_f64().unwrap());
        let speed = signal["speed_hz"].as_f64().unwrap();
        let rolling = 0.5 * (1.0 - 2.0 / (2.754 + 4.7565));
        assert!((cage / (rolling * (1.0 - slip) * speed) - 1.0).abs() < 1e-9);
        assert!((outer / (7.0 * cage) - 1.0).abs() < 1e-9 && (inner / (7.0 * (speed - cage)) - 1.0).abs() < 1e-9);
        seen.insert(label.to_owned());
    }
    assert_eq!(seen.len(), 2, "{seen:?}");
}

#[test]
fn a_signal_that_cannot_be_computed_has_its_reason() {
    let spec = SPEC.replace("[per_signal]", "[per_signal]\n\"shaft.mass\" = { choice = [0.15, -1] }");
    let folder = folder("reasons", &spec);
    let (code, said) = dataset(&folder, &["spec.toml", "--out", "out"]);
    assert_eq!(code, 1, "{said}");
    let manifest = json(&folder.join("out/manifest.json"));
    let signals_of = manifest["signals"].as_array().unwrap();
    let (mut there, mut failed, mut inaccurate, mut trusted) = (0, 0, 0, Vec::new());
    for signal in signals_of {
        if signal["drawn"]["shaft.mass"].as_f64().unwrap() < 0.0 {
            let reason = signal["reason"].as_str().unwrap();
            assert!(reason.contains("`shaft.mass`: found -1, expected"), "{reason}");
            assert!(signal["file"].is_null() && signal["sha256"].is_null() && signal["trusted"] == false);
            failed += 1;
        } else {
            assert_eq!(signal["row"].as_u64(), Some(there));
            there += 1;
            let error = signal["estimated_error"].as_f64().unwrap();
            inaccurate += u64::from(error > 2.0 * 0.2);
            // as large as the signal
            let is_trusted = error < 1.0;
            assert_eq!(signal["trusted"], is_trusted, "{signal}");
            let reason = signal["reason"].as_str().unwrap_or_default();
            assert_eq!(reason.starts_with("its estimated error is "), !is_trusted, "{signal}");
            trusted.push(i64::from(is_trusted));
        }
    }
    assert!(there > 0 && failed > 0 && inaccurate > 0);
    let told =
        format!("warning: {inaccurate} of {there} signals miss accuracy.target by more than twice (estimated errors");
    assert!(said.matches(&told).count() == 1 && !said.contains("largest estimated error"), "{said}");
    assert!(said.contains(&format!("{failed} of 8 signals are not there")), "{said}");
    let untrusted = trusted.iter().filter(|trusted| **trusted == 0).count();
    assert!(
        untrusted > 0 && said.contains(&format!("warning: {untrusted} of {there} signals cannot be trusted: ")),
        "{said}"
    );
    let in_file = array(&folder.join("out/signals-00000.npz"), "trusted");
    assert_eq!(npyz::NpyFile::new(&in_file[..]).unwrap().into_vec::<i64>().unwrap(), trusted);
    assert_eq!(signals(&folder.join("out/signals-00000.npz")).len() as u64, there);
    let csv = fs::read_to_string(folder.join("out/manifest.csv")).unwrap();
    assert_eq!(csv.lines().count(), 9);
    // what samples cannot hold
    let tones = "tones = [{ order = { choice = [2, 500] }, rms = 1 }]";
    let spec = SPEC.replace("bits = 16\nfull_scale = 2000", "gain = { choice = [1, 1e38, 1e-45] }");
    fs::write(folder.join("spec.toml"), spec.replace("[noise]", &format!("[noise]\n{tones}"))).unwrap();
    let (code, said) = dataset(&folder, &["spec.toml", "--out", "held"]);
    assert_eq!(code, 1, "{said}");
    let mut seen = BTreeSet::new();
    for signal in json(&folder.join("held/manifest.json"))["signals"].as_array().unwrap() {
        let [order, gain] = ["noise.tones.0.order", "recorder.gain"].map(|key| signal["drawn"][key].as_f64().unwrap());
        let expected = match (order > 2.0, gain > 1.0) {
            (true, _) => "a tone of order 500 is at ",
            (false, true) => "m/s^2: 32 bits hold 1.2e-38 to 3.4e38",
            (false, false) => "",
        };
        // of those that are there it is the estimated error
        let reason = signal["reason"].as_str().filter(|_| signal["file"].is_null()).unwrap_or_default();
        assert!(reason.contains(expected) && reason.is_empty() == expected.is_empty(), "{signal}");
        assert_eq!(signal["file"].is_null(), !expected.is_empty(), "{signal}");
        seen.insert(expected);
    }
    assert_eq!(seen.len(), 3, "{seen:?}");
}

#[test]
fn parts_share_no_background() {
    const GAIN: f64 = 1e6;
    let spec = SPEC.replace("bits = 16\nfull_scale = 2000", "");
    let spec = spec.replace("[noise]", &format!("[noise]\nbackground = {{ file = \"ramp.csv\", gain = {GAIN:?} }}"));
    let folder = folder("background", &spec);
    let rows: Vec<String> = (0..2400).map(|row| format!("{:?},{row}\n", f64::from(row) / 12e3)).collect();
    fs::write(folder.join("ramp.csv"), format!("time,x (m/s^2)\n{}", rows.concat())).unwrap();
    let (code, said) = dataset(&folder, &["spec.toml", "--out", "out"]);
    assert_eq!(code, 2, "{said}");
    let told =
        "found 0.2000 s, of which validation has 0.03000 s, expected at least 0.3333 s: 0.05000 s for validation";
    assert!(said.contains(told), "{said}");
    let (code, said) = dataset(&folder, &["spec.toml", "--out", "out", "--set", "split={train=1,test=1}"]);
    assert_eq!(code, 0, "{said}");
    let samples = signals(&folder.join("out/signals-00000.npz"));
    let mut places: BTreeMap<String, BTreeSet<i64>> = BTreeMap::new();
    for (signal, samples) in json(&folder.join("out/manifest.json"))["signals"].as_array().unwrap().iter().zip(samples)
    {
        let part = places.entry(signal["split"].as_str().unwrap().to_owned()).or_default();
        part.extend(samples.iter().map(|sample| (sample / GAIN + 1199.5).round() as i64));
    }
    let [test, train] = [&places["test"], &places["train"]];
    assert!(train.iter().all(|place| (0..1200).contains(place)), "{train:?}");
    assert!(test.iter().all(|place| (1200..2400).contains(place)), "{test:?}");
}

#[test]
fn a_flaw_is_on_a_ball_of_the_drawn_bearing() {
    let races = ["outer = ", "inner = "].map(|part| SPEC.lines().find(|line| line.starts_with(part)).unwrap());
    let spec = SPEC.replace(races[0], "ball = { share = 1, flat_radius = 1.5e-3, depth = 3e-6 }");
    let spec = spec.replace(races[1], "").replace("none = 1", "none = 0").replace("signals_per_specimen = 2", "");
    let few = "[per_machine]\n\"bearing.balls\" = 3";
    let folder = folder("few balls", &spec.replace("[per_machine]", few));
    let short = ["--set", "signals_per_specimen=1", "--set", "recorder.duration_s=0.01", "--set", "untrusted=keep"];
    let (code, said) = dataset(&folder, &[&["spec.toml", "--out", "out", "--count", "20"], short.as_slice()].concat());
    assert_eq!(code, 0, "{said}");
    let manifest = json(&folder.join("out/manifest.json"));
    let balls = manifest["signals"].as_array().unwrap().iter().map(|signal| signal["faults"][0]["ball"].as_u64());
    assert_eq!(balls.collect::<BTreeSet<_>>(), BTreeSet::from([Some(0), Some(1), Some(2)]));
}

#[test]
fn what_is_wrong_is_named_with_its_place() {
    let refused = |from: &str, to: &str| {
        assert!(SPEC.contains(from), "{from}");
        let spec = SPEC.replacen(from, to, 1);
        let folder = folder("refused", &spec);
        let (code, said) = dataset(&folder, &["spec.toml", "--out", "out"]);
        assert_eq!(code, 2, "{to}: {said}");
        assert!(!folder.join("out/dataset").exists());
        said
    };
    for (from, to, told) in [
        (
            "rate_hz = 12000",
            "rate_hertz = 12000",
            "spec.toml:31: unknown key `recorder.rate_hertz`\nhelp: did you mean `rate_hz`?",
        ),
        (
            "rate_hz = 12000",
            "rate_hz = 0",
            "spec.toml:31: `recorder.rate_hz`: found 0, expected a rate from 1 to 1e7 Hz",
        ),
        (
            "{ uniform = [1e-6, 3e-6] }",
            "{ uniform = [3e-6, 1e-6] }",
            "spec.toml:19: `per_specimen.\"bearing.radial_play\"`: found {\"uniform\":[3e-6,1e-6]}, expected two numbers, the lower one first",
        ),
        (
            "snr_db = 20",
            "snr_db = \"loud\"",
            "`noise.snr_db`: found \"loud\", expected a number, or a distribution of numbers",
        ),
        (
            "\"bearing.radial_play\"",
            "\"bearing.radial_plai\"",
            "spec.toml: what is drawn for machines[0] with fault \"none\" makes no valid case: --set bearing.radial_plai=",
        ),
        (
            "\"bearing.first_ball_deg\"",
            "\"bearing.radial_play\"",
            "found the key in per_signal and in per_specimen, expected each key at one level",
        ),
        ("\"bearing.first_ball_deg\"", "\"transient.end\"", "[recorder] sets it by settle_s and duration_s"),
        ("\"bearing.first_ball_deg\"", "\"bearing.defects\"", "found damage, expected none here: [fault] says it"),
        ("weight = 2", "sensor = \"P9\"", "`machines[0].sensor`: found \"P9\", expected one of the case's: P1"),
        ("depth = 10e-6 }", "depth = -1 }", "with fault \"inner\" makes no valid case"),
        (
            "full_scale = 2000",
            "",
            "`recorder.bits`: found it without full_scale, expected bits and full_scale, or neither",
        ),
        ("case = \"ring.toml\"", "case = \"gear.toml\"", "cannot read the case file gear.toml"),
        ("seed = 7", "seed = -7", "`seed`: found -7, expected a whole number, 0 or more"),
        (
            "snr_db = 20",
            "snr_db = 20\ntones = [{ hz = { uniform = [50, 6000] }, rms = 2 }]",
            "`noise.tones[0].hz`: found 6000, expected a frequency below half of recorder.rate_hz (6000)\nhelp: it would appear",
        ),
        ("snr_db = 20", "snr_db = 1e6", "`noise.snr_db`: found 1000000, expected -200 to 200 dB"),
        (
            "duration_s = 0.05",
            "duration_s = 1e6",
            "found 1000000 s, which is 12000000000 samples at rate_hz, expected a time of 2 to 1e9 samples",
        ),
        (
            "count = 2\n",
            "count = 1000000000000\n",
            "`machines`: found 1000000000001 machines by count, expected at most 1000000",
        ),
        ("count = 8", "count = 100000000", "`count`: found 100000000, expected a number from 1 to 10000000"),
        (
            "{ uniform = [1e-6, 3e-6] }",
            "{ repeat = 10000, of = { repeat = 10000, of = 1 } }",
            "found 100000000 values, expected at most 100000 values of one key",
        ),
        ("snr_db = 20", "snr_db = 20\nbackground = { file = \"none.npz\", gain = 1 }", "none.npz"),
    ] {
        let said = refused(from, to);
        assert!(said.contains(told), "{to}: {said}");
    }
    let folder = folder("refused", SPEC);
    let (code, said) = dataset(&folder, &["spec.toml", "--count", "100000000"]);
    assert!(code == 2 && said.contains("found --count 100000000, expected at most 10000000"), "{said}");
    fs::write(folder.join("spec.toml"), "seed = 1").unwrap();
    let (code, said) = dataset(&folder, &["spec.toml"]);
    assert!(code == 2 && said.contains("the specification lacks the required key `machines`"), "{said}");
}

#[test]
fn specifications_are_valid_by_their_schema() {
    let folder = scratch("dataset schema");
    let schema: Value = serde_json::from_slice(&plummer(&folder, &["schema", "--dataset"]).stdout).unwrap();
    let validator = Validator::new(&schema);
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/datasets/two_machines.toml");
    for text in [SPEC, &fs::read_to_string(example).unwrap()] {
        let mut spec: Value = toml::from_str(text).unwrap();
        assert_eq!(validator.check(&spec), Ok(()));
        spec["recorder"]["rate_hertz"] = 1.into();
        assert!(validator.check(&spec).is_err(), "an unknown key");
    }
}
