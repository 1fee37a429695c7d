//! Reference: the modes that the program finds by its own factor, with their error bounds.
//!
//! Goal: the same modes and the same count by MUMPS, whatever way it keeps its factor, on one process and on two.
//!
//! Conditions: the features `mumps` or `mumps-mpi` (`cargo test --features mumps-mpi --test mumps`); for two processes OpenMPI.

use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const MODES: usize = 12;

/// A folder with a case of the pillow block.
fn case() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("meshes/pedestal.msh");
    let text = format!(
        r#"title = "Pillow block"
[housing]
mesh = {mesh:?}
length_unit = "mm"
parts = [{{ group = "housing", material = "aluminium" }}]
supports = [{{ group = "feet", fixed = ["x", "y", "z"] }}]
[modes]
count = {MODES}
"#
    );
    fs::write(folder.path().join("case.toml"), text).expect("a case");
    folder
}

/// Runs `plummer modes` in the folder of a case, with files of factors below it.
fn run(folder: &Path, factor: &str, launcher: &[&str]) -> Output {
    let program = env!("CARGO_BIN_EXE_plummer");
    let out = if factor.is_empty() { "unforced" } else { factor };
    let words: Vec<&str> = launcher.iter().copied().chain([program, "modes", "case.toml", "--out", out]).collect();
    let files = folder.join("files");
    fs::create_dir_all(&files).expect("a folder for files");
    let mut command = Command::new(words[0]);
    command.args(&words[1..]).current_dir(folder).env("MUMPS_OOC_TMPDIR", &files);
    if !factor.is_empty() {
        command.env("PLUMMER_FACTOR", factor);
    }
    let output = command.output().expect("it starts");
    let left = fs::read_dir(&files).expect("a folder").count();
    assert_eq!(left, 0, "files of factors are left");
    output
}

fn result(folder: &Path, factor: &str, launcher: &[&str]) -> Value {
    let output = run(folder, factor, launcher);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{factor}: {errors}");
    let by_mumps = factor != "own";
    assert_eq!(errors.contains("factorised by MUMPS"), by_mumps, "{errors}");
    let text = fs::read_to_string(folder.join(factor).join("modes.json")).expect("a result");
    let result: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(result["factor"]["by"].is_string(), by_mumps);
    result
}

fn numbers(result: &Value, key: &str) -> Vec<f64> {
    result[key].as_array().expect(key).iter().filter_map(Value::as_f64).collect()
}

fn assert_same(found: &Value, expected: &Value) {
    let [values, bounds] = ["frequencies_hz", "error_bounds_hz"].map(|key| [found, expected].map(|r| numbers(r, key)));
    assert_eq!([values[0].len(), values[1].len()], [MODES; 2]);
    for mode in 0..MODES {
        let apart = (values[0][mode] - values[1][mode]).abs();
        let allowed = bounds[0][mode] + bounds[1][mode];
        assert!(apart <= allowed, "mode {mode}: {apart} Hz apart, bounds {allowed} Hz");
    }
    let count = |result: &Value| ["counted", "found"].map(|key| result["count_check"][key].as_u64());
    assert_eq!(count(found)[0], count(found)[1]);
    assert!(count(found)[0] >= Some(MODES as u64));
}

#[test]
fn every_way_of_mumps_finds_the_modes_of_our_own_factor() {
    let folder = case();
    let expected = result(folder.path(), "own", &[]);
    for factor in ["mumps", "mumps-low-rank", "mumps-out-of-core"] {
        assert_same(&result(folder.path(), factor, &[]), &expected);
    }
}

#[test]
fn a_choice_that_is_none_is_told() {
    let folder = case();
    let output = run(folder.path(), "mumbs", &[]);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{errors}");
    assert!(errors.contains("mumps-low-rank"), "{errors}");
    // at the start: what the case says does not matter
    fs::write(folder.path().join("case.toml"), "title = 1").expect("a case");
    let output = run(folder.path(), "mumbs", &[]);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{errors}");
    assert!(errors.starts_with("error: the variable PLUMMER_FACTOR is \"mumbs\"; expected own"), "{errors}");
}

/// Before anything is computed: the case does not exist.
#[test]
fn files_that_cannot_be_written_are_told() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("file"), "").expect("a file");
    let long = "long".repeat(60);
    fs::create_dir(folder.path().join(&long)).expect("a folder");
    for (files, words) in [
        ("missing", "No such file"),
        ("file", "no folder"),
        // takes no folders
        ("/proc", "No such file"),
        (&long, "longer than 255 bytes"),
    ] {
        for (factor, is_checked) in [("", true), ("mumps-out-of-core", true), ("own", false)] {
            let output = Command::new(env!("CARGO_BIN_EXE_plummer"))
                .args(["modes", "case.toml"])
                .current_dir(folder.path())
                .env("PLUMMER_FACTOR", factor)
                .env("MUMPS_OOC_TMPDIR", folder.path().join(files))
                .output()
                .expect("it starts");
            let errors = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{errors}");
            let said = errors.starts_with("error: the variable MUMPS_OOC_TMPDIR is") && errors.contains(words);
            assert_eq!(said, is_checked, "{files} {factor}: {errors}");
        }
    }
}

/// Address space that leaves no room for our own factor beside the work, but for that of MUMPS: among limits that are tried one after the other,
/// for what libraries reserve differs by machine.
#[test]
fn mumps_steps_in_where_a_limit_of_the_process_is_too_low() {
    let folder = tempfile::tempdir().expect("a folder");
    // so large that MUMPS out of core needs less than our own factor even beside OpenBLAS's and MPI's libraries
    let (edge, mut nodes, mut elements) = (28, String::new(), String::new());
    let number = |x: usize, y: usize, z: usize| 1 + x + (edge + 1) * (y + (edge + 1) * z);
    for (z, y, x) in cells(edge + 1) {
        nodes += &format!("{} {x} {y} {z}\n", number(x, y, z));
    }
    let corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
    let mut count = 0;
    for (z, y, x) in cells(edge) {
        let of = |z: usize| corners.map(|[i, j]| number(x + i, y + j, z).to_string()).join(" ");
        count += 1;
        elements += &format!("{count} 5 2 1 1 {} {}\n", of(z), of(z + 1));
    }
    let mesh = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"block\"\n$EndPhysicalNames\n$Nodes\n{}\n{nodes}$EndNodes\n\
         $Elements\n{count}\n{elements}$EndElements\n",
        (edge + 1).pow(3)
    );
    fs::write(folder.path().join("block.msh"), mesh).expect("a mesh");
    let case = "[housing]\nmesh = 'block.msh'\nlength_unit = 'mm'\nparts = [{ group = 'block', material = 'aluminium' }]\n[modes]\ncount = 8\n";
    fs::write(folder.path().join("case.toml"), case).expect("a case");
    let found = (10..80).find_map(|step| {
        let line = format!(
            "ulimit -v {}; exec {} modes case.toml --threads 1 --force",
            20_000 * step,
            env!("CARGO_BIN_EXE_plummer")
        );
        let mut command = Command::new("sh");
        command
            .args(["-c", &line])
            .current_dir(folder.path())
            .env("OPENBLAS_NUM_THREADS", "1")
            .env("RUST_BACKTRACE", "0");
        let output = command.output().expect("a shell");
        output.status.success().then(|| String::from_utf8_lossy(&output.stderr).into_owned())
    });
    let said = found.expect("a limit with room");
    assert!(said.contains("factorised by MUMPS") && said.contains("process's address space (ulimit -v)"), "{said}");
}

/// All places of a cube.
fn cells(edge: usize) -> impl Iterator<Item = (usize, usize, usize)> {
    (0..edge).flat_map(move |z| (0..edge).flat_map(move |y| (0..edge).map(move |x| (z, y, x))))
}

#[cfg(feature = "mumps-mpi")]
mod processes {
    use super::*;

    /// Two processes on this machine, as root too.
    const TWO: &[&str] = &["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "2"];

    #[test]
    fn two_processes_find_the_modes_of_one() {
        let folder = case();
        let expected = result(folder.path(), "own", &[]);
        for factor in ["mumps", "mumps-low-rank", "mumps-out-of-core"] {
            assert_same(&result(folder.path(), factor, TWO), &expected);
        }
    }

    #[test]
    fn two_processes_write_one_report() {
        let folder = case();
        let output = run(folder.path(), "", TWO);
        let errors = String::from_utf8_lossy(&output.stderr);
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{errors}");
        assert_eq!(said.matches("degrees of freedom").count(), 1, "{said}");
    }

    /// The other process ends too: nothing waits for ever.
    #[test]
    fn an_error_ends_both_processes() {
        let folder = case();
        let words: Vec<&str> =
            TWO[1..].iter().copied().chain([env!("CARGO_BIN_EXE_plummer"), "modes", "none.toml"]).collect();
        let output = Command::new(TWO[0]).args(words).current_dir(folder.path()).output().expect("it starts");
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{errors}");
        assert!(errors.contains("none.toml"), "{errors}");
    }
}
