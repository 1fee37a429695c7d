//! `plummer sweep` from outside: the table of many runs, points that fail, going on, and shares of a job array.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use super::common::{errors, plummer, scratch};
use serde_json::Value;

/// A folder of a test's own, spaces and other letters in its name, with a ring on springs in it that has no checks of its own.
fn ring(name: &str) -> PathBuf {
    let folder = scratch(&format!("sweep {name} Gehäuse"));
    let project = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(project.join("examples/tadina2011/beam.toml")).unwrap();
    let end = text.find("expected = [").unwrap();
    fs::write(folder.join("Ring ä.toml"), &text[..end]).unwrap();
    folder
}

/// `plummer sweep` of the ring's modes.
fn sweep(folder: &Path, words: &[&str]) -> (i32, String, String) {
    let words = [&["sweep", "Ring ä.toml", "--command", "modes"], words].concat();
    told(plummer(folder, &words))
}

fn told(output: std::process::Output) -> (i32, String, String) {
    let out = String::from_utf8(output.stdout.clone()).unwrap();
    (output.status.code().unwrap_or(-1), out, errors(&output))
}

fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}

/// Lines of the table without the column of wall times.
fn rows(folder: &Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(folder.join("sweep.csv")).unwrap();
    let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
    let mut rows: Vec<Vec<String>> = text.lines().map(cells).collect();
    let wall = rows[0].iter().position(|name| name == "wall_s [s]").unwrap();
    for row in &mut rows {
        row.remove(wall);
    }
    rows
}

#[test]
fn points_that_fail_are_listed_and_the_others_are_as_if_run_alone() {
    let folder = ring("table");
    let vary = ["--vary", "ring.nodes=36,1,72", "--vary", "ring.shear=true,false"];
    let (code, out, err) = sweep(&folder, &vary);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    assert!(out.contains("4 of 6 points done"), "{out}");
    assert!(out.contains("point 3 (1, true): failed "), "{out}");
    let results = folder.join("out/Ring ä");
    let rows = rows(&results);
    assert_eq!(rows.len(), 7);
    assert_eq!(rows[0][..4], ["point", "ring.nodes", "ring.shear", "state"]);
    assert_eq!(rows[6][..4], ["6", "72", "false", "done"]);
    assert_eq!(rows[3][..4], ["3", "1", "true", "failed"]);
    let sweep = json(&results.join("sweep.json"));
    assert_eq!(sweep["failed"], 2);
    assert_eq!(sweep["points"][2]["exit_code"], 2);
    let message = sweep["points"][2]["message"].as_str().unwrap();
    assert!(message.contains("ring.nodes"), "{message}");
    // the same point by hand
    let alone = ["modes", "Ring ä.toml", "--set", "ring.nodes=72", "--set", "ring.shear=false"];
    let alone = [&alone[..], &["--out", "alone"]].concat();
    assert!(plummer(&folder, &alone).status.success());
    let alone = json(&folder.join("alone/modes.json"));
    let point = json(&results.join("sweep/6/modes.json"));
    assert_eq!(point["frequencies_hz"], alone["frequencies_hz"]);
    let place = rows[0].iter().position(|name| name == "frequency.4 [Hz]").unwrap();
    let found: f64 = rows[6][place].parse().unwrap();
    assert_eq!(Value::from(found), alone["frequencies_hz"][3]);
    let html = fs::read_to_string(results.join("report.html")).unwrap();
    assert!(html.contains("Points that are not done") && html.contains("Eigenfrequencies"));
    assert!(results.join("sweep.npz").exists());
}

#[test]
fn what_no_point_can_be_is_an_error_before_anything_is_written() {
    let folder = ring("wrong");
    for (words, code, part) in [
        (
            &["--vary", "ring.nods=36"][..],
            2,
            "no point of the sweep is a valid case; point 1: --set ring.nods=36: unknown key `ring.nods`",
        ),
        (&["--vary", "ring.nodes"], 2, "--vary ring.nodes: expected KEY=VALUES"),
        (&["--vary", "ring.nodes=1:5"], 2, "expected FROM:TO:COUNT"),
        (&["--vary", "ring.nodes=36", "--vary", "ring.nodes=72"], 2, "varied twice"),
        (&[], 2, "--vary"),
        (&["--vary", "ring.nodes=36", "--resume"], 2, "holds no sweep"),
    ] {
        let (found, _, err) = sweep(&folder, words);
        assert_eq!(found, code, "{words:?}: {err}");
        assert!(err.contains(part), "{words:?}: {err}");
    }
    assert!(!folder.join("out").exists());
    // every point is refused: nothing has a result
    let (code, _, err) = sweep(&folder, &["--vary", "ring.nodes=1,2"]);
    assert_eq!(code, 2, "{err}");
    for words in [&["sweep", "--merge", "."][..], &["sweep", ".", "--task", "1/2"]] {
        let (code, _, err) = told(plummer(&folder, words));
        assert_eq!(code, 2, "{err}");
        assert!(err.contains("holds no sweep"), "{err}");
    }
}

#[test]
fn a_sweep_goes_on_with_what_is_missing_and_with_nothing_else() {
    let folder = ring("resume");
    let vary = ["--vary", "ring.nodes=36,72"];
    assert_eq!(sweep(&folder, &vary).0, 0);
    let results = folder.join("out/Ring ä");
    let expected = rows(&results);
    let (code, _, err) = sweep(&folder, &vary);
    assert_eq!(code, 2);
    assert!(err.contains("holds a sweep") && err.contains("--resume"), "{err}");
    let (code, _, err) = sweep(&folder, &["--vary", "ring.nodes=36", "--resume"]);
    assert_eq!(code, 2);
    assert!(err.contains("--vary ring.nodes=36,72, now --vary ring.nodes=36"), "{err}");
    // one point is lost, the other marked
    fs::remove_dir_all(results.join("sweep/2")).unwrap();
    fs::write(results.join("sweep/1/mark"), "kept").unwrap();
    let (code, _, err) = sweep(&folder, &[&vary[..], &["--resume"]].concat());
    assert_eq!((code, err.as_str()), (0, ""));
    assert_eq!(rows(&results), expected);
    assert!(results.join("sweep/1/mark").exists());
    let (code, _, err) = sweep(&folder, &[&vary[..], &["--force"]].concat());
    assert_eq!((code, err.as_str()), (0, ""));
    assert_eq!(rows(&results), expected);
    assert!(!results.join("sweep/1/mark").exists());
}

#[test]
fn shares_of_a_job_array_merge_to_the_same_table() {
    let folder = ring("array");
    let vary = ["--vary", "ring.nodes=24:72:5"];
    assert_eq!(sweep(&folder, &vary).0, 0);
    let scripts = [&vary[..], &["--out", "ar ray", "--slurm=2"]].concat();
    let (code, out, err) = sweep(&folder, &scripts);
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(out.contains("5 points in 2 tasks"), "{out}");
    let array = fs::read_to_string(folder.join("ar ray/sweep/array.sbatch")).unwrap();
    assert!(array.contains("#SBATCH --array=1-2\n"), "{array}");
    let share = |share: &str| told(plummer(&folder, &["sweep", "--task", share, "ar ray"]));
    let merge = || told(plummer(&folder, &["sweep", "--merge", "ar ray"]));
    assert_eq!(share("1/2").0, 0);
    let (code, _, err) = merge();
    assert_eq!(code, 1);
    assert!(err.contains("2 of 5 points are not computed"), "{err}");
    let (code, out, _) = share("2/2");
    assert_eq!((code, out.lines().next()), (0, Some("point 2: done")));
    let (code, _, err) = merge();
    assert_eq!((code, err.as_str()), (0, ""));
    assert_eq!(rows(&folder.join("ar ray")), rows(&folder.join("out/Ring ä")));
    // the case is not the one that was planned
    let case = folder.join("Ring ä.toml");
    let text = fs::read_to_string(&case).unwrap();
    fs::write(&case, text.replace("72e9", "70e9")).unwrap();
    let (code, _, err) = share("1/2");
    assert_eq!(code, 2);
    assert!(err.contains("other values in the case file"), "{err}");
}

/// Runs that take seconds are interrupted, and the sweep goes on to the signals that it would have had.
#[test]
fn interrupted_runs_go_on() {
    let folder = scratch("sweep_interrupted");
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/scenes/smooth.toml");
    let command = |out: &str, more: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_plummer"));
        command
            .current_dir(&folder)
            .args(["sweep"])
            .arg(&case)
            .args(["--vary", "shaft.mass=0.15,0.2", "--threads", "2", "--out", out])
            .args(["--set", "transient.step=2.5e-7", "--set", "transient.end=0.4"])
            .args(["--set", "analysis.envelope=[{from=0.05,to=0.2}]"])
            .args(more)
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        command
    };
    assert!(command("whole", &[]).status().unwrap().success());
    let mut child = command("parts", &[]).spawn().unwrap();
    let begun = |number: usize| folder.join(format!("parts/sweep/{number}/.run.partial")).exists();
    while !(begun(1) && begun(2)) {
        assert!(child.try_wait().unwrap().is_none(), "it ended before it could be stopped");
        sleep(Duration::from_millis(2));
    }
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-TERM", &id]).status().unwrap().success());
    let (code, _, err) = told(child.wait_with_output().unwrap());
    assert_eq!(code, 1, "{err}");
    assert!(err.contains("interrupted at 0 of 2 points"), "{err}");
    assert!(err.contains("--resume"), "{err}");
    assert!(!folder.join("parts/sweep.json").exists());
    let output = command("parts", &["--resume"]).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    for point in ["1", "2"] {
        let signals = |out: &str| fs::read(folder.join(out).join("sweep").join(point).join("signals.npz")).unwrap();
        assert!(signals("whole") == signals("parts"), "point {point}: other bytes");
    }
    let rms = |out: &str| json(&folder.join(out).join("sweep.json"))["done"].clone();
    assert_eq!(rms("parts"), rms("whole"));
    // page, CSV and JSON have the amplitudes of the parts' lines over what was varied, in its unit
    let sweep = json(&folder.join("whole/sweep.json"));
    assert_eq!(sweep["axes"][0]["unit"], "kg");
    let amplitude = |point: usize| sweep["points"][point]["figures"]["P1.1.BPFO.1"].as_f64().unwrap();
    assert!(amplitude(0) > 0.0 && amplitude(1) > 0.0);
    let page = fs::read_to_string(folder.join("whole/report.html")).unwrap();
    for text in ["Envelope at the lines of the bearing", "Mass of the shaft [kg]", "BPFO", "2 x BSF"] {
        assert!(page.contains(text), "{text}");
    }
    let header = fs::read_to_string(folder.join("whole/sweep.csv")).unwrap();
    assert!(header.contains(",P1.1.BPFO.1 [m/s²],"), "{header}");
    assert!(
        header.starts_with("point,shaft.mass [kg],state,wall_s [s],P1.1.speed_hz [Hz],P1.1.rms [m/s²],"),
        "{header}"
    );
}

/// Two dents in one housing of 10 000 degrees of freedom: it is condensed once, the other point takes it, and says so.
#[test]
fn points_of_one_housing_condense_it_once() {
    let folder = scratch("sweep of one housing");
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/scenes/pedestal.toml");
    let case = case.to_str().unwrap();
    let vary = "bearing.defects.0.length=0.5e-3,0.75e-3";
    let keys = ["--set", "condense.fixed_interface_modes=8", "--set", "modes.count=2", "--out", "out"];
    let words = [&["sweep", case, "--command", "modes", "--vary", vary], &keys[..]].concat();
    let (code, out, err) = told(plummer(&folder, &words));
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    let points = ["1", "2"].map(|point| json(&folder.join("out/sweep").join(point).join("modes.json")));
    let condensed = points.iter().filter(|point| point["stages_s"]["constraint modes"].is_number());
    assert_eq!(condensed.count(), 1);
    let said: Vec<&str> = points.iter().filter_map(|point| point["reused"][0].as_str()).collect();
    assert_eq!(said.len(), 1);
    assert!(said[0].starts_with("condensed housing: from out/cache/"), "{said:?}");
    let kept = fs::read_dir(folder.join("out/cache")).unwrap().map(|entry| entry.unwrap().path());
    assert_eq!(kept.filter(|path| path.extension().is_some_and(|end| end == "condensed")).count(), 1);
    // without it, the same to the last bit
    let alone =
        [&["modes", case, "--set", "bearing.defects.0.length=0.5e-3", "--no-cache", "--quiet"], &keys[..4]].concat();
    let (code, _, err) = told(plummer(&folder, &[&alone[..], &["--out", "alone"]].concat()));
    assert_eq!((code, err.as_str()), (0, ""));
    assert_eq!(json(&folder.join("alone/modes.json"))["loaded"], points[0]["loaded"]);
    assert!(!folder.join("alone/cache").exists());
}
