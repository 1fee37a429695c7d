//! Reference: the same command, not killed.
//! Goal: kill -9 at any moment leaves no half-written file under a valid name; the command runs again, or goes on, to the same result.
//! Sketch: every command that writes files is killed at a random moment of the time that it takes; then each file that does not end in
//!   `.partial` is compared with the whole run's: byte for byte, or, where times of day and of computing stand in it, by its form.
//! Conditions: SIGKILL; cases that take some tenths of a second.
//! Parameters: one kill of some commands with the other tests, 200 of each of the 18 in the long form.

use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use flate2::read::GzDecoder;

use super::program::scratch;
use super::{Dice, rounds};

/// A command line without `--out`, and what it takes to go on: nothing is `--force`.
struct Killed {
    name: &'static str,
    words: Vec<String>,
    resumes: bool,
}

fn commands(folder: &Path) -> Vec<Killed> {
    let project = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = |name: &str| project.join(name).display().to_string();
    let (beam, smooth) = (path("examples/tadina2011/beam.toml"), path("examples/scenes/smooth.toml"));
    let pedestal = path("examples/scenes/pedestal.toml");
    let transfer = path("examples/transfer/pedestal.toml");
    let run = folder.join("of-run").display().to_string();
    let command = |name, resumes, words: &[&str]| Killed {
        name,
        words: words.iter().map(|word| (*word).to_owned()).collect(),
        resumes,
    };
    vec![
        command("init", false, &["init", &path("meshes/pedestal.msh"), "--length-unit", "mm"]),
        command("inspect", false, &["inspect", &path("meshes/pedestal.msh"), "--length-unit", "mm"]),
        command("modes", false, &["modes", &beam, "--set", "modes.variants=[]"]),
        command("modes-mesh", false, &["modes", &pedestal]),
        command("condense", false, &["condense", &transfer]),
        command("frf", false, &["frf", &transfer]),
        command(
            "run",
            true,
            &[
                "run",
                &smooth,
                "--set",
                "transient.step=2.5e-7",
                "--set",
                "transient.end=0.05",
                "--checkpoint-every",
                "0",
            ],
        ),
        command("analyze", false, &["analyze", &run, "--window", "2.05:2.75"]),
        command("report", false, &["report", &run]),
        command(
            "chart",
            false,
            &[
                "chart",
                &smooth,
                "--quick",
                "--only",
                "accuracy",
                "--set",
                "ring.nodes=12",
                "--set",
                "transient.end=0.13e-3",
                "--set",
                "accuracy.band_hz=[0,160000]",
                "--set",
                "transient.ensemble.runs=2",
            ],
        ),
        command("export-mtx", false, &["export", &pedestal, "--to", "mtx"]),
        command("export-npz", false, &["export", &pedestal, "--to", "npz"]),
        command("export-op4", false, &["export", &pedestal, "--to", "op4"]),
        command("export-vtu", false, &["export", &pedestal, "--to", "vtu"]),
        command("export-uff", false, &["export", &pedestal, "--to", "uff"]),
        command("verify", false, &["verify"]),
        command(
            "sweep",
            true,
            &[
                "sweep",
                &beam,
                "--command",
                "modes",
                "--vary",
                "ring.nodes=24:72:4",
                "--set",
                "modes.variants=[]",
                "--set",
                "modes.expected=[]",
            ],
        ),
        command("dataset", true, &["dataset", &specification(folder)]),
    ]
}

/// Eight short signals of a ring on springs, two a file.
fn specification(folder: &Path) -> String {
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/scenes/healthy.toml");
    let text = format!(
        "seed = 3\ncount = 8\nsignals_per_specimen = 2\nsignals_per_file = 2\nmachines = [{{ case = {case:?} }}]\n\
         per_machine = {{ \"accuracy.target\" = 0.2 }}\n\
         per_signal = {{ \"speed.profile\" = [{{ time = 0, hz = {{ uniform = [20, 30] }} }}] }}\n\
         fault = {{ none = 1, outer = {{ share = 1, angle_deg = 270, length = 0.5e-3, depth = 10e-6 }} }}\n\
         recorder = {{ rate_hz = 12000, duration_s = 0.03, settle_s = 0.01 }}\nnoise = {{ snr_db = 20 }}\n"
    );
    let path = folder.join("signals.toml");
    fs::write(&path, text).unwrap();
    path.display().to_string()
}

fn start(command: &Killed, out: &Path, more: &str) -> std::process::Child {
    let more = (!more.is_empty()).then_some(more);
    let out = match command.name {
        "init" => out.join("case.toml"), // writes one file
        _ => out.to_owned(),
    };
    Command::new(env!("CARGO_BIN_EXE_plummer"))
        .args(&command.words)
        .arg("--out")
        .arg(out)
        .args(["--quiet", "--threads", "1"])
        .args(more)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// All files below a folder, by their path from it.
fn files(folder: &Path) -> Vec<PathBuf> {
    let (mut found, mut folders) = (Vec::new(), vec![folder.to_owned()]);
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(&next).into_iter().flatten() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                found.push(path.strip_prefix(folder).unwrap().to_owned());
            }
        }
    }
    found.sort();
    found
}

/// What is wrong with a file under a valid name.
fn fault(whole: &Path, killed: &Path, name: &Path) -> Option<String> {
    let (expected, found) = (fs::read(whole.join(name)), fs::read(killed.join(name)));
    let (Ok(expected), Ok(found)) = (expected, found) else {
        return Some(format!("{} is not a file of the whole run", name.display()));
    };
    let text = String::from_utf8_lossy(&found);
    // records have no times
    let of_dataset = name.starts_with("dataset") || name.to_string_lossy().starts_with("manifest.");
    let sound = match name.extension().and_then(|ending| ending.to_str()) {
        _ if of_dataset => found == expected,
        // times of computing stand in these
        Some("json") => serde_json::from_slice::<serde_json::Value>(&found).is_ok(),
        // the content of a report, with times: whole by its checksum
        Some("gz") => std::io::copy(&mut GzDecoder::new(&found[..]), &mut std::io::sink()).is_ok(),
        Some("html") => text.trim_end().ends_with("</html>"),
        Some("svg") => text.trim_end().ends_with("</svg>"),
        // the table of a sweep has wall times; those of a chart depend on them, down to which points they list
        Some("csv") => {
            let rows = |bytes: &[u8]| String::from_utf8_lossy(bytes).lines().count();
            let of_chart = name.to_string_lossy().starts_with("tables/chart-");
            text.ends_with('\n') && (of_chart || rows(&found) == rows(&expected))
        }
        // arrays of wall times: as long
        Some("npz") if name.ends_with("sweep.npz") => found.len() == expected.len(),
        Some("uff" | "vtu" | "npz" | "mtx" | "op4" | "toml") => found == expected,
        _ => true,
    };
    (!sound).then(|| format!("{} is half written ({} of {} bytes)", name.display(), found.len(), expected.len()))
}

/// Below these names files are written piece by piece: a run that is not done, the log of a point.
fn unfinished(name: &Path) -> bool {
    let text = name.to_string_lossy();
    text.ends_with(".partial") || text.contains(".run.partial/") || text.ends_with("log.txt")
}

/// Signals for `plummer analyze`.
fn run_to_analyze(folder: &Path) {
    let project = Path::new(env!("CARGO_MANIFEST_DIR"));
    let made = Command::new(env!("CARGO_BIN_EXE_plummer"))
        .arg("run")
        .arg(project.join("examples/tadina2011/outer-dent.toml"))
        .args(["--set", "transient.start=2.0", "--set", "transient.end=2.8", "--set", "analysis.envelope=[]"])
        .args(["--set", "analysis.energy=false", "--quiet", "--out"])
        .arg(folder.join("of-run"))
        .status()
        .unwrap();
    assert!(made.success());
}

/// Kills each command `kills` times and goes on each time; what was killed before its end.
fn torture(name: &str, kills: usize, seed: u64, wanted: impl Fn(&str) -> bool) -> usize {
    let folder = scratch(name);
    if wanted("analyze") || wanted("report") {
        run_to_analyze(&folder);
    }
    let mut dice = Dice(seed);
    let mut killed = 0;
    for command in commands(&folder).into_iter().filter(|command| wanted(command.name)) {
        let whole = folder.join(format!("{}-whole", command.name));
        let begun = Instant::now();
        let output = start(&command, &whole, "").wait_with_output().unwrap();
        let took = begun.elapsed();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{}: {said}", command.name);
        let mut early = 0;
        for round in 0..kills {
            let out = folder.join(format!("{}-{round}", command.name));
            let mut child = start(&command, &out, "");
            sleep(took.mul_f64(dice.below(1001) as f64 / 1000.0));
            let before_end = child.try_wait().unwrap().is_none();
            child.kill().unwrap();
            child.wait().unwrap();
            early += usize::from(before_end);
            let there = files(&out).into_iter().filter(|name| !unfinished(name));
            for file in there {
                if let Some(fault) = fault(&whole, &out, &file) {
                    panic!("{} after a kill in round {round}: {fault}", command.name);
                }
            }
            go_on(&command, &out);
            for file in files(&whole).into_iter().filter(|name| !unfinished(name)) {
                assert!(out.join(&file).exists(), "{}: {} is missing", command.name, file.display());
                if let Some(fault) = fault(&whole, &out, &file) {
                    panic!("{} run again after a kill: {fault}", command.name);
                }
            }
            let left = files(&out).into_iter().find(|name| unfinished(name) && !name.ends_with("log.txt"));
            assert!(left.is_none(), "{}: {left:?} is left", command.name);
            fs::remove_dir_all(&out).unwrap();
        }
        println!("{:10} {:6.2} s, {early} of {kills} kills before its end", command.name, took.as_secs_f64());
        killed += early;
    }
    killed
}

/// Runs a killed command again: goes on where it can, and begins anew where there is nothing to go on with.
fn go_on(command: &Killed, out: &Path) {
    // processes of a sweep outlive it for a moment
    sleep(Duration::from_millis(if command.name == "sweep" { 400 } else { 0 }));
    let begun = [".run.partial/checkpoint", "sweep/plan.json", "dataset/plan.json"];
    let resumable = command.resumes && begun.iter().any(|file| out.join(file).exists());
    let more = if resumable { "--resume" } else { "--force" };
    let output = start(command, out, more).wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{} {more} after a kill: {said}", command.name);
}

#[test]
fn a_kill_leaves_no_half_written_file() {
    // one that reads, one that solves, one that goes on, one of processes
    let few = ["inspect", "modes", "run", "export-npz", "sweep", "dataset"];
    torture("kills", 1, 5, |name| few.contains(&name));
}

#[test]
#[ignore = "long"]
fn two_hundred_kills_of_each_command() {
    // some of the commands, by their names here
    let only = std::env::var("PLUMMER_ONLY").unwrap_or_default();
    let killed =
        torture("kills-long", rounds(200), 99, |name| only.is_empty() || only.split(',').any(|one| one == name));
    println!("{killed} kills before the end");
}

/// While METIS orders the housing's unknowns, on another thread than the one that the signal reaches.
#[test]
fn a_request_to_end_is_heard_while_the_unknowns_are_ordered() {
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/housings/end_shield.toml");
    let folder = scratch("ordered");
    let ends = (2..20).map(|step: u64| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_plummer"));
        command.args(["condense", "--no-cache", "--quiet", "--force", "--threads", "2", "--out", "out"]);
        command.arg(&case).current_dir(&folder).stdout(Stdio::null()).stderr(Stdio::piped());
        let child = command.spawn().unwrap();
        std::thread::sleep(Duration::from_millis(20 * step));
        assert!(Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap().success());
        let output = child.wait_with_output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status, said)
    });
    let ends = ends.collect::<Vec<_>>();
    // by the signal itself where the program has not begun to listen
    let well = |status: &ExitStatus| matches!(status.code(), Some(0 | 1)) || status.signal() == Some(15);
    assert!(ends.iter().all(|(status, _)| well(status)), "{ends:?}");
    assert!(ends.iter().any(|(_, said)| said.contains("error: interrupted")), "{ends:?}");
}
