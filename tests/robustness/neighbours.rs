//! Reference: none; the results themselves.
//! Goal: files that stand beside each other belong together, whoever wrote between them.
//! Sketch: a run whose folder another process holds, whose case or signals are changed afterwards, whose columns are damaged before it goes
//!   on, or whose folders are links.
//! Conditions: a file system with `flock`.
//! Parameters: a run of the reference bearing, 0.02 s or less.

use std::fs::{self, File};
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::program::{errors, plummer, scratch};

const CASE: &str = "case.toml";

/// A folder with a case of the healthy bearing alone.
fn folder(name: &str) -> PathBuf {
    let folder = scratch(name);
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/scenes/healthy.toml");
    fs::copy(scene, folder.join(CASE)).unwrap();
    folder
}

/// Words of a command line.
fn words(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}

const RUN: &str = "run case.toml --set transient.end=0.01 --quiet --out out";

fn refused(folder: &Path, line: &str, said: &str) {
    let output = plummer(folder, &words(line));
    assert_eq!(output.status.code(), Some(2), "{line}: {}", errors(&output));
    assert!(errors(&output).contains(said), "{line}: {}", errors(&output));
}

#[test]
fn a_folder_is_written_by_one_process_at_a_time() {
    let folder = folder("one-writer");
    let out = folder.join("out");
    fs::create_dir(&out).unwrap();
    let held = File::open(&out).unwrap();
    held.lock().unwrap();
    for line in [
        RUN,
        "run case.toml --resume --out out",
        "modes case.toml --out out",
        "chart case.toml --out out",
        "verify --out out",
        "man --out out",
        "export case.toml --to npz --out out",
        "sweep case.toml --command modes --vary ring.nodes=24,25 --out out",
    ] {
        refused(
            &folder,
            line,
            "another plummer writes into out\nhelp: wait for its end, or choose another folder with --out\n",
        );
    }
    assert_eq!(fs::read_dir(&out).unwrap().count(), 0);
    drop(held);
    assert!(plummer(&folder, &words(RUN)).status.success());
}

/// What was observed to fail without a lock: the results of one of two processes beside those of the other.
#[test]
fn of_two_runs_in_a_folder_one_is_refused_while_the_other_lasts() {
    let folder = folder("two-runs");
    let mut first = Command::new(env!("CARGO_BIN_EXE_plummer"))
        .current_dir(&folder)
        .args(words("run case.toml --set transient.end=5 --quiet --out out"))
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let partial = folder.join("out/.run.partial");
    while !partial.exists() && first.try_wait().unwrap().is_none() {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let other = "run case.toml --set transient.end=0.01 --set bearing.contact_damping=3 --force --quiet --out out";
    refused(
        &folder,
        other,
        "another plummer writes into out\nhelp: wait for its end, or choose another folder with --out\n",
    );
    // its death frees the folder
    first.kill().unwrap();
    first.wait().unwrap();
    let output = plummer(&folder, &words(other));
    assert!(output.status.success(), "{}", errors(&output));
}

#[test]
fn signals_are_not_read_beside_the_result_of_another_run() {
    let folder = folder("mixed");
    for (damping, out) in [(1, "out"), (3, "other")] {
        let line = format!(
            "run case.toml --set transient.end=0.01 --set bearing.contact_damping={damping} --quiet --out {out}"
        );
        assert!(plummer(&folder, &words(&line)).status.success());
    }
    let analyze = "analyze out --window 0.001:0.01 --quiet --out analysed --force";
    let whole = plummer(&folder, &words(analyze));
    // too short for a verdict, but analysed
    assert_eq!(whole.status.code(), Some(1), "{}", errors(&whole));
    // another case's orders and speed would be those of the same signals
    let case = fs::read_to_string(folder.join(CASE)).unwrap();
    let changed = case.replace("[bearing]", "[bearing]\nradial_play = 1e-6");
    fs::write(folder.join(CASE), changed).unwrap();
    refused(&folder, analyze, "out/run.json was computed with values that differ from those in case.toml now\n");
    // what is analysed may change, and words
    let viewed = format!("# a remark\n{case}");
    fs::write(folder.join(CASE), viewed).unwrap();
    let output = plummer(&folder, &words(&format!("{analyze} --set analysis.whiten=true")));
    assert_eq!(output.status.code(), Some(1), "{}", errors(&output));
    refused(
        &folder,
        &format!("{analyze} --set bearing.balls=8"),
        "out/run.json was computed with values that differ from those of --set",
    );
    fs::copy(folder.join("other/signals.npz"), folder.join("out/signals.npz")).unwrap();
    refused(&folder, analyze, "out/signals.npz is not the file that out/run.json speaks of: expected SHA-256 ");
}

#[test]
fn a_run_does_not_go_on_with_other_rows_than_it_had() {
    let folder = folder("columns");
    let line = "run case.toml --set transient.end=5 --checkpoint-every 0.05 --quiet --out out";
    let mut child = Command::new(env!("CARGO_BIN_EXE_plummer"))
        .current_dir(&folder)
        .args(words(line))
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let partial = folder.join("out/.run.partial");
    let rows = || {
        let bytes = fs::read(partial.join("checkpoint")).unwrap_or_default();
        let head = String::from_utf8_lossy(&bytes);
        let rows = head.split("\"rows\":").nth(1)?.split(',').next()?;
        rows.parse::<usize>().ok()
    };
    while rows().is_none_or(|rows| rows == 0) && child.try_wait().unwrap().is_none() {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let path = partial.join("shaft_x.f64");
    // rows, and then all of it, where a link leads
    let resume = "run case.toml --set transient.end=5 --resume --quiet --out out";
    for path in [&path, &partial] {
        let elsewhere = folder.join("elsewhere");
        fs::rename(path, &elsewhere).unwrap();
        symlink(&elsewhere, path).unwrap();
        let output = plummer(&folder, &words(resume));
        assert!(!output.status.success());
        let said = errors(&output);
        assert!(said.contains("expected no symbolic link"), "{said}");
        fs::remove_file(path).unwrap();
        fs::rename(&elsewhere, path).unwrap();
    }
    let mut bytes = fs::read(&path).unwrap();
    bytes[..8].copy_from_slice(&1.0_f64.to_le_bytes());
    fs::write(&path, bytes).unwrap();
    refused(
        &folder,
        resume,
        "the rows in its columns are not those that the checkpoint counts\nhelp: begin anew with --force\n",
    );
}

#[test]
fn links_in_a_folder_for_results_lead_nowhere() {
    let folder = folder("links");
    let elsewhere = folder.join("elsewhere");
    for (name, flag) in
        [("figures", "--force"), ("tables", "--force"), (".run.partial", "--force"), (".run.partial", "--resume")]
    {
        let _ = fs::remove_dir_all(folder.join("out"));
        fs::create_dir_all(folder.join("out")).unwrap();
        fs::create_dir_all(&elsewhere).unwrap();
        // what a report and a run would remove
        for file in ["run-1-a.svg", "run-1-a.csv", "checkpoint"] {
            fs::write(elsewhere.join(file), "kept").unwrap();
        }
        symlink(&elsewhere, folder.join("out").join(name)).unwrap();
        let output = plummer(&folder, &words(&format!("{RUN} {flag}")));
        assert_ne!(output.status.code(), Some(0), "{name} {flag}");
        assert!(errors(&output).contains("expected no symbolic link"), "{name}: {}", errors(&output));
        let mut names: Vec<_> = fs::read_dir(&elsewhere).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        assert_eq!(names, ["checkpoint", "run-1-a.csv", "run-1-a.svg"], "{name}");
    }
    // nor is a file written through one
    let _ = fs::remove_dir_all(folder.join("out"));
    fs::create_dir_all(folder.join("out")).unwrap();
    for name in ["signals.npz", "signals.npz.partial", "run.json.partial"] {
        symlink(elsewhere.join("checkpoint"), folder.join("out").join(name)).unwrap();
    }
    let output = plummer(&folder, &words(&format!("{RUN} --force")));
    assert!(output.status.success(), "{}", errors(&output));
    assert_eq!(fs::read_to_string(elsewhere.join("checkpoint")).unwrap(), "kept");
    assert!(!folder.join("out/signals.npz").is_symlink());
}

/// Every format is made of the mesh that the results name, whether it is read again or assembled anew.
#[test]
fn results_of_another_mesh_are_not_exported() {
    let folder = scratch("other-mesh");
    let of = |name: &str| Path::new(env!("CARGO_MANIFEST_DIR")).join("meshes").join(name);
    fs::copy(of("pedestal.msh"), folder.join("a.msh")).unwrap();
    fs::write(
        folder.join(CASE),
        "[housing]\nmesh = \"a.msh\"\nlength_unit = \"mm\"\nparts = [{ group = \"housing\", material = \"steel\" }]\n[modes]\ncount = 8\n",
    )
    .unwrap();
    let output = plummer(&folder, &words("modes case.toml --quiet --out out"));
    assert!(output.status.success(), "{}", errors(&output));
    let mut mesh = fs::OpenOptions::new().append(true).open(folder.join("a.msh")).unwrap();
    std::io::Write::write_all(&mut mesh, b"$Comments\nother\n$EndComments\n").unwrap();
    for format in ["mtx", "npz", "vtu", "uff"] {
        let line = format!("export out --to {format} --quiet");
        refused(&folder, &line, "a.msh is not the file that out/modes.json speaks of");
    }
}

/// Shapes that another model left beside a result are not written for it.
#[test]
fn shapes_are_not_read_beside_the_result_of_another_model() {
    let folder = folder("other-shapes");
    for nodes in [24, 25] {
        let line = format!("modes case.toml --set ring.nodes={nodes} --quiet --out {nodes}");
        let output = plummer(&folder, &words(&line));
        assert!(output.status.success(), "{}", errors(&output));
    }
    fs::copy(folder.join("25/modes.npz"), folder.join("24/modes.npz")).unwrap();
    let said = "24/modes.npz is not the file that 24/modes.json speaks of: expected SHA-256 ";
    refused(&folder, "export 24 --to uff --quiet", said);
}

#[test]
fn a_sweep_does_not_take_another_points_result() {
    let folder = folder("other-point");
    let line = "sweep case.toml --command modes --vary ring.nodes=24,25 --quiet --out out";
    let output = plummer(&folder, &words(line));
    assert!(output.status.success(), "{}", errors(&output));
    let point = |number: usize| folder.join(format!("out/sweep/{number}/modes.json"));
    fs::copy(point(1), point(2)).unwrap();
    let said = "is not the result of point 2: expected --set ring.nodes=25, found --set ring.nodes=24";
    refused(&folder, "sweep out --merge --force", said);
}
