//! The program from outside: exit codes, where text goes, and that nothing is overwritten.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

/// A folder of this test's own with a small case file in it.
fn scratch(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let ring = "title = \"ring\"\n\n[ring]\nsections = [{ material = \"steel\", area = 5e-6, inertia = 9e-13, radius = 5.3e-3 }]\n";
    fs::write(folder.join("ring.toml"), ring).unwrap();
    folder
}

fn plummer(folder: &PathBuf, words: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_plummer"))
        .current_dir(folder)
        .args(words)
        .output()
        .unwrap()
}

fn errors(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

#[test]
fn help_goes_to_standard_output_and_a_misspelt_command_to_standard_error() {
    let folder = scratch("help");
    let help = plummer(&folder, &["--help"]);
    assert_eq!(help.status.code(), Some(0));
    assert!(
        String::from_utf8(help.stdout)
            .unwrap()
            .contains("--set <KEY=VALUE>")
    );
    let wrong = plummer(&folder, &["mods", "ring.toml"]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(wrong.stdout.is_empty());
    assert!(errors(&wrong).contains("'modes'"), "{}", errors(&wrong));
}

#[test]
fn wrong_input_is_exit_code_2_with_place_and_help() {
    let folder = scratch("wrong");
    let missing = plummer(&folder, &["modes", "rnig.toml"]);
    assert_eq!(missing.status.code(), Some(2));
    assert!(errors(&missing).starts_with("error: cannot read the case file rnig.toml: "));
    fs::write(folder.join("bad.toml"), "[ring]\nsectoins = []\n").unwrap();
    let bad = plummer(&folder, &["modes", "bad.toml"]);
    assert_eq!(bad.status.code(), Some(2));
    assert!(
        errors(&bad).starts_with(
            "error: bad.toml:2: unknown key `ring.sectoins`\nhelp: did you mean `sections`? keys here: nodes, sections,"
        ),
        "{}",
        errors(&bad)
    );
    let set = plummer(&folder, &["modes", "ring.toml", "--set", "ring.nodes=4"]);
    assert_eq!(set.status.code(), Some(2));
    assert_eq!(
        errors(&set),
        "error: --set ring.nodes=4: `ring.nodes`: found 4, expected 8 to 2000 nodes\n"
    );
    let lacking = plummer(&folder, &["run", "ring.toml"]);
    assert_eq!(lacking.status.code(), Some(2));
    assert_eq!(
        errors(&lacking),
        "error: ring.toml: `run` needs [bearing], which the case file lacks\nhelp: add [bearing] to the case file\n"
    );
    assert!(!folder.join("out").exists());
}

#[test]
fn an_earlier_result_is_not_touched_without_force() {
    let folder = scratch("earlier");
    let result = folder.join("out/ring/modes.json");
    fs::create_dir_all(result.parent().unwrap()).unwrap();
    fs::write(&result, "kept").unwrap();
    let refused = plummer(&folder, &["modes", "ring.toml"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(errors(&refused).contains("help: replace it with --force"));
    assert_eq!(fs::read_to_string(&result).unwrap(), "kept");
    let elsewhere = plummer(&folder, &["modes", "ring.toml", "--out", "other"]);
    assert_ne!(elsewhere.status.code(), Some(2));
    let forced = plummer(&folder, &["modes", "ring.toml", "--force"]);
    assert_ne!(forced.status.code(), Some(2));
}

#[test]
fn a_closed_pipe_does_not_make_it_panic() {
    let folder = scratch("pipe");
    let mut child = Command::new(env!("CARGO_BIN_EXE_plummer"))
        .current_dir(&folder)
        .args(["modes", "--help"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(errors(&output), "");
    assert_eq!(output.status.code(), Some(0));
}
