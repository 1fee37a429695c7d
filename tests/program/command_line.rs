//! The program from outside: exit codes, where text goes, and that nothing is overwritten.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::common::{errors, plummer};

/// A folder of this test's own with a small case file in it.
fn scratch(name: &str) -> PathBuf {
    let folder = super::common::scratch(name);
    let ring = "title = \"ring\"\n\n[ring]\nsections = [{ material = \"steel\", area = 5e-6, inertia = 9e-13, radius = 5.3e-3 }]\n";
    fs::write(folder.join("ring.toml"), ring).unwrap();
    folder
}

#[test]
fn help_goes_to_standard_output_and_a_misspelt_command_to_standard_error() {
    let folder = scratch("help");
    let help = plummer(&folder, &["--help"]);
    assert_eq!(help.status.code(), Some(0));
    assert!(String::from_utf8(help.stdout).unwrap().contains("--set <KEY=VALUE>"));
    // what every command takes stands together, below what the command alone takes
    let help = String::from_utf8(plummer(&folder, &["analyze", "--help"]).stdout).unwrap();
    let (own, of_every) = help.split_once("Options of every command:").unwrap();
    assert!(own.contains("--baseline-window") && !own.contains("--out"), "{own}");
    assert!(of_every.contains("--out <DIR>") && !of_every.contains("--baseline"), "{of_every}");
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
    assert_eq!(errors(&set), "error: --set ring.nodes=4: `ring.nodes`: found 4, expected 8 to 2000 nodes\n");
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

/// Computing the same again loses nothing; results of other values or of another mesh would be lost.
#[test]
fn the_same_case_replaces_its_own_result() {
    let folder = super::common::scratch("again");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mesh = |name: &str| fs::copy(root.join("meshes").join(name), folder.join("ring.msh")).unwrap();
    mesh("ring_6_9.msh");
    let case = "[housing]\nmesh = \"ring.msh\"\nlength_unit = \"mm\"\nplane = { assumption = \"stress\", thickness = 4e-3 }\n\
                parts = [{ group = \"housing\", material = \"aluminium\" }]\n[modes]\ncount = 5\n";
    fs::write(folder.join("ring.toml"), case).unwrap();
    let modes = |more: &[&str]| {
        let output = plummer(&folder, &[&["modes", "ring.toml", "--quiet"], more].concat());
        (output.status.code(), errors(&output))
    };
    let lost = |of: &str| {
        let said = format!("error: out/ring/modes.json is the result of an earlier run{of}\n");
        (Some(2), said + "help: replace it with --force, or choose another folder with --out\n")
    };
    assert_eq!(modes(&[]), (Some(0), String::new()));
    // words and order are no values, and [analysis] says how signals are looked at
    fs::write(folder.join("ring.toml"), format!("# again\n{case}[analysis]\nenergy = true\n")).unwrap();
    assert_eq!(modes(&[]), (Some(0), String::new()));
    assert_eq!(modes(&["--set", "modes.count=6"]), lost(" of other values"));
    fs::write(folder.join("ring.msh"), format!("{}\n", fs::read_to_string(folder.join("ring.msh")).unwrap())).unwrap();
    assert_eq!(modes(&[]), lost(" of another mesh"));
    assert_eq!(modes(&["--force"]), (Some(0), String::new()));
    // what is no result of the command
    fs::write(folder.join("out/ring/modes.json"), "{\"command\":\"run\"}").unwrap();
    assert_eq!(modes(&[]), lost(""));
    // the page keeps its name where another command has come into the folder
    assert_eq!(modes(&["--force"]), (Some(0), String::new()));
    fs::write(folder.join("out/ring/analysis.json"), "{}").unwrap();
    assert_eq!(modes(&[]), (Some(0), String::new()));
    assert!(!folder.join("out/ring/modes-report.html").exists());
}

/// What has the name of a result, and no result in the folder speaks of it, is somebody's.
#[test]
fn files_of_others_are_not_replaced() {
    let folder = super::common::scratch("foreign");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let case = root.join("examples/modal/ring.toml").display().to_string();
    let modes = |more: &[&str]| {
        let output = plummer(&folder, &[&["modes", &case, "--out", "o", "--quiet"], more].concat());
        (output.status.code(), errors(&output))
    };
    for name in ["modes.npz", "report.html", "report.cbor.gz", "tables/modes-1-mine.csv", "figures/modes-2-mine.svg"] {
        let path = folder.join("o").join(name);
        let _ = fs::remove_dir_all(folder.join("o"));
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, "mine").unwrap();
        let said = format!("error: o has {name} by the names of results, which no result there speaks of\n");
        let help = "help: replace them with --force, or choose another folder with --out\n";
        assert_eq!(modes(&[]), (Some(2), said + help));
        assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
        assert!(!folder.join("o/modes.json").exists());
        assert_eq!(modes(&["--force"]), (Some(0), String::new()));
        // the program's own from then on, also after an end before the last file
        for _ in 0..2 {
            assert_eq!(modes(&[]), (Some(0), String::new()), "{name}");
            fs::remove_file(folder.join("o/modes.json")).unwrap();
        }
    }
    // of another command, and of a page drawn elsewhere
    fs::write(folder.join("o/frf.uff"), "mine").unwrap();
    assert_eq!(modes(&[]), (Some(0), String::new()));
    fs::create_dir(folder.join("p")).unwrap();
    fs::write(folder.join("p/report.html"), "mine").unwrap();
    let drawn = |more: &[&str]| plummer(&folder, &[&["report", "o", "--out", "p"], more].concat()).status.code();
    assert_eq!((drawn(&[]), drawn(&["--force"]), drawn(&[])), (Some(2), Some(0), Some(0)));
    fs::create_dir(folder.join("m")).unwrap();
    fs::write(folder.join("m/plummer-run.1"), "mine").unwrap();
    assert_eq!(plummer(&folder, &["man", "--out", "m"]).status.code(), Some(2));
    // a folder of points without a plan
    fs::create_dir_all(folder.join("s/sweep/1")).unwrap();
    let swept = plummer(&folder, &["sweep", &case, "--command", "modes", "--vary", "modes.count=4,5", "--out", "s"]);
    assert_eq!(swept.status.code(), Some(2));
    assert!(errors(&swept).starts_with("error: s has sweep/1 by the names"), "{}", errors(&swept));
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

/// A look at a mesh: sizes in metres once the unit is known, the verdict in the exit code.
#[test]
fn a_mesh_is_inspected() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let look = |words: &[&str]| {
        let output = plummer(&folder, &[&["inspect"], words].concat());
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        String::from_utf8(output.stdout).unwrap()
    };
    let plain = look(&["meshes/pedestal.msh"]);
    assert!(plain.contains("1620 Tet10"), "{plain}");
    assert!(plain.contains("give --length-unit mm"), "{plain}");
    let json = look(&["meshes/pedestal.msh", "--length-unit", "mm", "--density", "2700", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    // foot and seat less bore and bolt holes; curved edges of Tet10 miss 1.1e-4 of it
    let drawn = 44.0 * 5.0 + 20.0 * 8.0 + std::f64::consts::PI * (50.0 - 36.0);
    let drawn = 1e-9 * (10.0 * drawn - 40.0 * std::f64::consts::PI);
    let volume = json["size"].as_f64().unwrap();
    assert!((volume / drawn - 1.0).abs() < 2e-4, "{volume} {drawn}");
    let mass = json["mass_kg"].as_f64().unwrap();
    assert!((mass / (2700.0 * volume) - 1.0).abs() < 1e-14);
    assert_eq!(json["parts"].as_array().unwrap().len(), 1);
    assert_eq!(json["invalid_elements"], 0);
    assert!(json["worst"]["scaled_jacobian"].as_f64().unwrap() > 0.05);
}

/// An inverted tetrahedron: exit code 1 and its tag.
#[test]
fn a_mesh_with_folded_elements_is_a_bad_answer() {
    let folder = scratch("folded");
    let text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n\
        0 0 0\n1 0 0\n0 1 0\n0 0 -1\n$EndNodes\n$Elements\n1 1 7 7\n3 1 4 1\n7 1 2 3 4\n$EndElements\n";
    fs::write(folder.join("inverted.msh"), text).unwrap();
    let output = plummer(&folder, &["inspect", "inverted.msh", "--length-unit", "mm"]);
    assert_eq!(output.status.code(), Some(1));
    let shown = String::from_utf8(output.stdout.clone()).unwrap();
    assert!(shown.contains("INVALID           1 element: 7"), "{shown}");
    assert!(errors(&output).contains("(the first is element 7)"));
    let missing = plummer(&folder, &["inspect", "no.msh"]);
    assert_eq!(missing.status.code(), Some(2));
}

#[test]
fn a_model_is_explained_without_a_run() {
    let folder = scratch("explain");
    let case = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/scenes/smooth.toml");
    let output = plummer(&folder, &["run", case, "--explain", "--out", "out"]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    for part in ["modes", "balls", "method", "largest step", "together", "exponential-adams"] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(!folder.join("out").exists(), "nothing is written");
    // a warning too
    let damped = plummer(&folder, &["run", case, "--explain", "--set", "bearing.contact_damping=1e6"]);
    let damped = String::from_utf8(damped.stdout).unwrap();
    let told = "warning: bearing.contact_damping is 1e6 s/m, ";
    assert!(damped.contains(told), "{damped}");
    for line in text.lines().chain(damped.lines()) {
        assert!(line.chars().count() <= 100, "{line}");
    }
}

#[test]
fn threads_beyond_the_cores_are_left_out() {
    let folder = scratch("threads");
    let case = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/tadina2011/healthy.toml");
    let output = plummer(&folder, &["modes", case, "--threads", "1024", "--out", "out"]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let cores = std::thread::available_parallelism().unwrap();
    let told =
        format!("note: --threads 1024 is more than this process has cores, which would take turns: {cores} compute");
    let said = |output: &std::process::Output| String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said(&output).contains(&told), "{}", said(&output));
    let result = std::fs::read_to_string(folder.join("out/modes.json")).unwrap();
    let result: serde_json::Value = serde_json::from_str(&result).unwrap();
    assert_eq!(result["threads"], cores.get());
    let output = plummer(&folder, &["modes", case, "--threads", "1", "--out", "one"]);
    assert!(!said(&output).contains("take turns"), "{}", said(&output));
}
