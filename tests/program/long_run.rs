//! Runs that are stopped from outside and go on.
//!
//! Reference: the same run without a stop.
//! Goal: whatever ends the program, `--resume` comes to the same signals, byte for byte; nothing else goes on or is lost.
//! Sketch: `plummer run` on a dented bearing is killed (SIGKILL) at odd moments and resumed until it is done; another is
//!   interrupted (SIGINT) and asked to go on with something else.
//! Conditions: a checkpoint as often as the program allows.
//! Parameters: none; signals are compared to the last bit.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

use super::common::errors;

const DENT: &str =
    "bearing.defects=[{on='outer',angle_deg=270,length=0.75e-3,width=0.41e-3,depth=15e-6,rim_radius=0.05e-3}]";

/// `plummer run` of a scene with an end, its results in a folder of this test's own.
struct Run {
    folder: PathBuf,
    end: &'static str,
    step: &'static str,
}

impl Run {
    fn new(name: &str, end: &'static str) -> Self {
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
        let _ = fs::remove_dir_all(&folder);
        Self { folder, end, step: "2.5e-7" }
    }

    fn command(&self, more: &[&str]) -> Command {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let end = format!("transient.end={}", self.end);
        let step = format!("transient.step={}", self.step);
        let mut command = Command::new(env!("CARGO_BIN_EXE_plummer"));
        command
            .arg("run")
            .arg(root.join("examples/scenes/smooth.toml"))
            .args(["--set", DENT, "--set", "bearing.radial_play=2.5e-6"])
            .args(["--set", &step, "--set", &end])
            .args(["--checkpoint-every", "0", "--out"])
            .arg(&self.folder)
            .args(more)
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        command
    }

    fn partial(&self) -> PathBuf {
        self.folder.join(".run.partial")
    }

    fn checkpoint(&self) -> Option<Vec<u8>> {
        fs::read(self.partial().join("checkpoint")).ok()
    }

    /// Begins, and waits until there is a checkpoint that was not there before, or the end.
    fn begin(&self, more: &[&str]) -> Child {
        let before = self.checkpoint();
        let mut child = self.command(more).spawn().unwrap();
        while child.try_wait().unwrap().is_none() {
            let now = self.checkpoint();
            if now.is_some() && now != before {
                break;
            }
            sleep(Duration::from_millis(2));
        }
        child
    }

    fn ended(&self, more: &[&str]) -> (i32, String) {
        told(self.command(more).output().unwrap())
    }
}

fn told(output: Output) -> (i32, String) {
    (output.status.code().unwrap_or(-1), errors(&output))
}

#[test]
fn a_run_that_is_killed_again_and_again_comes_to_the_same_bytes() {
    let (whole, killed) = (Run::new("never-killed", "0.06"), Run::new("killed", "0.06"));
    assert_eq!(whole.ended(&[]), (0, String::new()));
    assert!(!whole.partial().exists());
    let signals = |run: &Run| fs::read(run.folder.join("signals.npz")).unwrap();
    let mut kills = 0;
    // at odd moments after a first checkpoint, ms
    for (number, pause) in [3, 41, 0, 67, 23, 11].into_iter().enumerate() {
        let more: &[&str] = if number == 0 { &[] } else { &["--resume"] };
        let mut child = killed.begin(more);
        sleep(Duration::from_millis(pause));
        kills += u32::from(child.try_wait().unwrap().is_none());
        child.kill().unwrap();
        let _ = child.wait().unwrap();
        // written whole at the end, before run.json
        if killed.folder.join("signals.npz").exists() {
            assert!(signals(&whole) == signals(&killed), "half written");
            break;
        }
    }
    println!("killed {kills} times");
    assert!(kills >= 2, "{kills}");
    if killed.partial().exists() {
        assert_eq!(killed.ended(&["--resume"]), (0, String::new()));
    }
    assert!(signals(&whole) == signals(&killed), "other bytes");
    assert!(!killed.partial().exists());
    let (code, text) = killed.ended(&["--resume"]);
    assert_eq!(code, 2);
    assert!(text.contains("run.json is the result of a finished run: there is nothing to go on with\nhelp: leave --resume out to compute it anew\n"), "{text}");
}

#[test]
fn an_interrupted_run_says_how_to_go_on_and_refuses_anything_else() {
    let run = Run::new("interrupted", "50");
    let (code, text) = run.ended(&["--resume"]);
    assert_eq!(code, 2);
    assert!(text.contains("there is no unfinished run to go on with"), "{text}");
    let child = run.begin(&["--threads", "1"]);
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    let (code, text) = told(child.wait_with_output().unwrap());
    assert_eq!(code, 1, "{text}");
    assert!(text.starts_with("error: interrupted at t = "), "{text}");
    assert!(text.contains(" s of 50 s; the signals so far and a checkpoint are in "), "{text}");
    assert!(text.contains("help: go on with: plummer run "), "{text}");
    assert!(text.trim_end().ends_with("--resume"), "{text}");
    let checkpoint = run.checkpoint().unwrap();
    // neither a new run nor a changed one touches it
    let (code, text) = run.ended(&[]);
    assert_eq!(code, 2);
    let way =
        ".run.partial holds an unfinished run\nhelp: go on with --resume, or give it up and begin anew with --force\n";
    assert!(text.contains(way), "{text}");
    let (code, text) = run.ended(&["--resume", "--set", "shaft.mass=0.2"]);
    assert_eq!(code, 2);
    assert!(text.contains("was begun with something else: --set "), "{text}");
    let help = "--set shaft.mass=0.2\nhelp: go on with what it was begun with, or begin anew with --force\n";
    assert!(text.contains(help), "{text}");
    let (code, text) = run.ended(&["--resume", "--force"]);
    assert_eq!(code, 2, "{text}");
    assert!(run.checkpoint().unwrap() == checkpoint);
    // before stepping, while the model is built
    for (signal, pause) in [("-INT", 100), ("-TERM", 300), ("-INT", 600)] {
        let child = run.command(&["--resume"]).spawn().unwrap();
        let id = child.id().to_string();
        // from the first instant on at which a signal is caught
        let catches = |signal: u64| {
            let status = fs::read_to_string(format!("/proc/{id}/status")).unwrap();
            let mask = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap().trim().to_owned();
            u64::from_str_radix(&mask, 16).unwrap() >> (signal - 1) & 1 == 1
        };
        while !(catches(2) && catches(15)) {
            sleep(Duration::from_millis(2));
        }
        sleep(Duration::from_millis(pause));
        assert!(Command::new("kill").args([signal, &id]).status().unwrap().success());
        let (code, text) = told(child.wait_with_output().unwrap());
        assert_eq!(code, 1, "{pause} ms: {text}");
        assert!(text.starts_with("error: interrupted") && text.contains("\nhelp: go on with: plummer run "), "{text}");
    }
    let checkpoint = run.checkpoint().unwrap_or(checkpoint);
    // rows that the checkpoint counts are gone
    fs::write(run.partial().join("time_s.f64"), "").unwrap();
    let (code, text) = run.ended(&["--resume"]);
    assert_eq!(code, 2, "{text}");
    assert!(text.contains("time_s.f64 has 0 bytes"), "{text}");
    fs::remove_file(run.partial().join("time_s.f64")).unwrap();
    let (code, text) = run.ended(&["--resume"]);
    assert_eq!(code, 2, "{text}");
    assert!(text.contains("time_s.f64") && text.ends_with("help: begin anew with --force\n"), "{text}");
    fs::write(run.partial().join("checkpoint"), &checkpoint[..checkpoint.len() - 1]).unwrap();
    let (code, text) = run.ended(&["--resume"]);
    assert_eq!(code, 2);
    assert!(text.contains("is no whole checkpoint"), "{text}");
    // --force gives it up and begins anew
    let mut anew = run.begin(&["--force"]);
    anew.kill().unwrap();
    let _ = anew.wait().unwrap();
    assert!(run.checkpoint().unwrap() != checkpoint);
}

#[test]
fn a_run_that_blows_up_leaves_what_it_had_and_names_a_step() {
    let run = Run { step: "2.5e-6", ..Run::new("blown-up", "0.01") };
    let (code, text) = run.ended(&[]);
    assert_eq!(code, 1, "{text}");
    assert!(text.starts_with("error: the solution blew up at t = "), "{text}");
    assert!(text.contains("contacts there vibrate at up to "), "{text}");
    assert!(text.contains(" kHz, exponential-adams is stable up to "), "{text}");
    assert!(text.contains("--set transient.step="), "{text}");
    assert!(text.contains(" instants computed until then are in signals.npz"), "{text}");
    assert!(run.folder.join("signals.npz").exists() && run.folder.join("run.json").exists());
    assert!(!run.partial().exists());
}
