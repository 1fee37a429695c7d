//! Reference: all 1029 modes of the same cube by the dense solver; elastic modes of a cube come in ones, twos and threes.
//! Goal: any number of modes, any limit and any band gives what exists there, counted, or an error that says what to do.
//! Sketch: a free cube of 6 x 6 x 6 bricks; one, a few, the rigid ones, half and all of its modes; limits and bands from zero, on
//!   frequencies, between them, above all.
//! Conditions: iterations end at relative residuals of 1e-5 and better, so that frequencies agree to 1e-8.
//! Parameters: edge 0.1 m, aluminium.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use serde_json::Value;

use super::program::{errors, plummer, scratch};

const CELLS: usize = 6;

/// A free cube of bricks.
fn cube(folder: &Path) {
    let nodes = CELLS + 1;
    let place = |i: usize| 0.1 * i as f64 / CELLS as f64;
    let mut text = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"c\"\n$EndPhysicalNames\n$Nodes\n{}\n",
        nodes.pow(3)
    );
    let number = |[i, j, k]: [usize; 3]| 1 + i + nodes * (j + nodes * k);
    let all = |count: usize| (0..count.pow(3)).map(move |n| [n % count, n / count % count, n / count.pow(2)]);
    for at in all(nodes) {
        let [x, y, z] = at.map(place);
        writeln!(text, "{} {x} {y} {z}", number(at)).unwrap();
    }
    writeln!(text, "$EndNodes\n$Elements\n{}", CELLS.pow(3)).unwrap();
    for (element, [i, j, k]) in all(CELLS).enumerate() {
        write!(text, "{} 5 2 1 1", element + 1).unwrap();
        for corner in 0..8 {
            let [a, b] = [[0, 0], [1, 0], [1, 1], [0, 1]][corner % 4];
            write!(text, " {}", number([i + a, j + b, k + corner / 4])).unwrap();
        }
        text.push('\n');
    }
    text.push_str("$EndElements\n");
    fs::write(folder.join("cube.msh"), text).unwrap();
    fs::write(
        folder.join("case.toml"),
        "[housing]\nmesh = \"cube.msh\"\nlength_unit = \"m\"\nparts = [{ group = \"c\", material = \"aluminium\" }]\n",
    )
    .unwrap();
}

/// What `plummer modes` finds with this in `[modes]`, or its exit code and what it says.
fn modes(folder: &Path, asked: &str) -> Result<Value, (Option<i32>, String)> {
    let output = plummer(
        folder,
        &["modes", "case.toml", "--json", "--force", "--out", "out", "--set", &format!("modes={{{asked}}}")],
    );
    if output.status.success() {
        Ok(serde_json::from_slice(&output.stdout).unwrap())
    } else {
        Err((output.status.code(), errors(&output)))
    }
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

/// These modes of all, and the count agrees.
fn assert_found(found: &Value, expected: &[f64], what: &str) {
    let hz = numbers(&found["frequencies_hz"]);
    assert_eq!(hz.len(), expected.len(), "{what}");
    for (hz, expected) in hz.iter().zip(expected) {
        // the first elastic one is at 14 565 Hz
        if *expected < 1.0 {
            assert!(*hz < 1e-3, "{what}: {hz} Hz");
        } else {
            assert!((hz / expected - 1.0).abs() < 1e-8, "{what}: {hz} {expected}");
        }
    }
    assert_eq!(found["count_check"]["counted"], found["count_check"]["found"], "{what}");
    assert!(found["count_check"]["found"].as_u64().unwrap() >= expected.len() as u64, "{what}");
    assert!(found["orthogonality"].as_f64().unwrap() < 1e-10, "{what}");
}

#[test]
fn any_number_of_modes_of_a_free_cube() {
    let folder = scratch("mode_counts");
    cube(&folder);
    let all = numbers(&modes(&folder, "count=1029").unwrap()["frequencies_hz"]);
    assert_eq!(all.len(), 1029);
    for count in [1, 5, 6, 7, 31, 33, 99, 101, 150, 200, 250, 300, 307] {
        let found = modes(&folder, &format!("count={count}")).unwrap();
        assert_found(&found, &all[..count], &format!("count {count}"));
        assert_eq!(found["rigid_modes"], count.min(6), "{count}");
    }
    let (code, text) = modes(&folder, "count=1030").unwrap_err();
    assert_eq!(code, Some(2), "{text}");
    assert!(text.contains("`modes.count`: found 1030, expected at most 1029"), "{text}");

    let up_to = |hz: f64| all.iter().filter(|&&mode| mode <= hz).count();
    let found = modes(&folder, "up_to_hz=70000").unwrap();
    assert_found(&found, &all[..up_to(70e3)], "up to 70 kHz");
    let found = modes(&folder, "band_hz=[0,20000]").unwrap();
    assert_found(&found, &all[..up_to(20e3)], "from zero");
    assert_eq!(found["rigid_modes"], 6);
    // what the matrices cannot tell from zero is not zero: no rigid mode lies above it
    for low in ["1e-9", "1e-3", "0.01"] {
        let found = modes(&folder, &format!("band_hz=[{low},20000]")).unwrap();
        assert_found(&found, &all[6..up_to(20e3)], low);
        assert_eq!(found["rigid_modes"], 0, "{low}");
        let (code, text) = modes(&folder, &format!("band_hz=[{low},1]")).unwrap_err();
        assert_eq!(code, Some(2), "{text}");
    }
    for rigid in ["band_hz=[0,1e-9]", "band_hz=[0,14000]", "up_to_hz=1e-9"] {
        assert_found(&modes(&folder, rigid).unwrap(), &all[..6], rigid);
    }
    assert_found(&modes(&folder, "band_hz=[0,1e300]").unwrap(), &all, "all");
    let found = modes(&folder, "band_hz=[1,20000]").unwrap();
    assert_found(&found, &all[6..up_to(20e3)], "from 1 Hz");
    assert_eq!(found["rigid_modes"], 0);
    let found = modes(&folder, "band_hz=[200000,1e9]").unwrap();
    assert_found(&found, &all[up_to(200e3)..], "far above all");
    let found = modes(&folder, "band_hz=[30000,80000]").unwrap();
    assert_found(&found, &all[up_to(30e3)..up_to(80e3)], "slices");
    // both ends on modes, of which the first is double and the second triple
    let found = modes(&folder, &format!("band_hz=[{},{}]", all[6], all[8])).unwrap();
    assert_found(&found, &all[6..11], "ends on modes");
    assert!(found["count_check"]["above_hz"].as_f64().unwrap() <= all[6]);
    for (none, place) in
        [("[15000,19000]", "from 15000 to 19000 Hz"), ("[1e9,2e9]", "from 1000000000 to 2000000000 Hz")]
    {
        let (code, text) = modes(&folder, &format!("band_hz={none}")).unwrap_err();
        assert_eq!(code, Some(2), "{text}");
        assert!(text.contains(place) && text.contains("help:"), "{text}");
    }
    let (code, text) = modes(&folder, "band_hz=[20000,10000]").unwrap_err();
    assert_eq!(code, Some(2), "{text}");
    assert!(text.contains("`modes.band_hz[1]`: found 10000"), "{text}");
}

/// A cube on springs so soft that the matrices cannot tell its six motions from rigid ones: a part of them is not a mixture of all.
#[test]
fn a_part_of_the_modes_near_zero_is_a_part() {
    let folder = scratch("modes_near_zero");
    cube(&folder);
    let case = fs::read_to_string(folder.join("case.toml")).unwrap();
    let springs = "supports = [{ group = \"c\", spring = { x = 1e-8, y = 2e-8, z = 3e-8 } }]\n";
    fs::write(folder.join("case.toml"), case + springs).unwrap();
    let all = numbers(&modes(&folder, "count=8").unwrap()["frequencies_hz"]);
    // the cube moves as a rigid one of 2.7 kg on 343 springs an axis: translations in closed form
    let closed = [1e-8, 2e-8, 3e-8].map(|k: f64| (343.0 * k / 2.7).sqrt() / std::f64::consts::TAU);
    for hz in closed {
        assert!(all[..6].iter().any(|mode| (mode / hz - 1.0).abs() < 1e-3), "{hz} {all:?}");
    }
    let between = |low: usize| 0.5 * (all[low] + all[low + 1]);
    let asked = [
        ("count=1".to_owned(), 0..1),
        ("count=3".to_owned(), 0..3),
        ("count=5".to_owned(), 0..5),
        (format!("up_to_hz={:e}", between(2)), 0..3),
        (format!("band_hz=[0,{:e}]", between(3)), 0..4),
        (format!("band_hz=[{:e},{:e}]", between(0), between(4)), 1..5),
        (format!("band_hz=[{:e},1]", between(2)), 3..6),
    ];
    for (asked, expected) in asked {
        let found = modes(&folder, &asked).unwrap();
        assert_eq!(found["rigid_modes"], 0, "{asked}");
        let hz = numbers(&found["frequencies_hz"]);
        assert_eq!(hz.len(), expected.len(), "{asked}: {hz:?} of {all:?}");
        for (hz, expected) in hz.iter().zip(&all[expected]) {
            // what rounding mixes in from the first elastic mode is far below
            assert!((hz / expected - 1.0).abs() < 1e-6, "{asked}: {hz} {expected}");
        }
    }
}

/// Fewer modes asked for than move without strain: the answer says how many there are.
#[test]
fn rigid_modes_that_were_not_asked_for_are_said() {
    let folder = scratch("rigid_modes_not_asked");
    cube(&folder);
    let output = plummer(&folder, &["modes", "case.toml", "--out", "out", "--set", "modes={count=1}"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("1 of the 6 modes without strain were asked for and computed: `modes.count = 7`"), "{text}");
    let found = modes(&folder, "count=1").unwrap();
    assert_eq!((&found["rigid_modes"], &found["count_check"]["counted"]), (&1.into(), &6.into()));
}

/// File, line and key of a count beyond the model.
#[test]
fn more_modes_than_degrees_of_freedom_are_refused_at_their_key() {
    let folder = scratch("too_many_modes");
    cube(&folder);
    let text = fs::read_to_string(folder.join("case.toml")).unwrap();
    let most = 3 * (CELLS + 1).pow(3);
    fs::write(folder.join("case.toml"), format!("{text}[modes]\ncount = {}\n", most + 1)).unwrap();
    let output = plummer(&folder, &["modes", "case.toml"]);
    assert_eq!(output.status.code(), Some(2));
    let expected = format!(
        "error: case.toml:6: `modes.count`: found {}, expected at most {most}, as many as the model has\nhelp: ask for fewer, ",
        most + 1
    );
    assert!(errors(&output).contains(&expected), "{}", errors(&output));
}

/// A short stack, as some batch systems give, is enough for the whole way.
#[cfg(target_os = "linux")]
#[test]
fn a_short_stack_is_enough() {
    let folder = scratch("short_stack");
    cube(&folder);
    let program = env!("CARGO_BIN_EXE_plummer");
    let line = format!("ulimit -s 100 && exec {program} modes case.toml --out out --quiet");
    let output = std::process::Command::new("sh").current_dir(&folder).args(["-c", &line]).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let output = plummer(&folder, &["modes", "case.toml", "--threads", "100000"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(errors(&output).contains("expected a whole number from 1 to 1024"), "{}", errors(&output));
}
