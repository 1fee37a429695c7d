//! `plummer verify` from outside: it needs no file, and says what it compared with what.

use std::fs;
use std::path::Path;
use std::process::Output;

use super::common::{errors, plummer, scratch};
use plummer::app::verification::BEAM_CASE;
use serde_json::Value;

fn verify(folder: &Path, words: &[&str]) -> Output {
    plummer(folder, &[&["verify"], words].concat())
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

#[test]
fn every_check_passes_in_an_empty_folder_and_stands_in_the_result() {
    let folder = scratch("verify-passes");
    let output = verify(&folder, &[]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let shown = text(&output.stdout);
    assert!(shown.contains("The paper's numbers: checks"), "{shown}");
    let json = fs::read_to_string(folder.join("out/verify/verify.json")).unwrap();
    let json: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["command"], "verify");
    for key in ["plummer", "wall_s", "stages_s", "threads", "tables"] {
        assert!(!json[key].is_null(), "{key}");
    }
    let checks = json["checks"].as_array().unwrap();
    let of = |section: &str| checks.iter().filter(|check| check["section"] == section).count();
    assert_eq!(of("The paper's numbers"), 25);
    for section in ["Curved beams", "Whole housings", "Condensation", "Simulation", "Signals"] {
        assert!(of(section) >= 6, "{section}");
    }
    for check in checks {
        for key in ["name", "section", "source", "assumptions", "limit_reason"] {
            assert!(!check[key].as_str().unwrap().is_empty(), "{key}: {check}");
        }
        let number = |key: &str| check[key].as_f64().unwrap();
        let error = (number("computed") - number("reference")) / number("reference");
        assert!((error - number("relative_error")).abs() < 1e-12, "{check}");
        assert!(error.abs() <= number("limit"), "{check}");
        assert_eq!(check["ok"], true);
    }
    let named = |name: &str| {
        let found = checks.iter().find(|check| check["name"] == name);
        found.expect(name)["computed"].as_f64().unwrap()
    };
    assert!((named("Defect order, ball") - 3.4889).abs() < 1e-4);
    assert!((named("Eigenfrequency: shaft bounce on the contacts") - 11265.0).abs() < 1.0);
    let page = fs::read_to_string(folder.join("out/verify/report.html")).unwrap();
    assert!(page.contains("cargo run --release --example paper_readings"));
}

#[test]
fn an_earlier_result_is_not_replaced_and_json_is_all_there_is() {
    let folder = scratch("verify-again");
    fs::create_dir_all(folder.join("o")).unwrap();
    fs::write(folder.join("o/verify.json"), "{}").unwrap();
    let again = verify(&folder, &["--out", "o"]);
    assert_eq!(again.status.code(), Some(2));
    assert!(text(&again.stderr).contains("--force"));
    let forced = verify(&folder, &["--out", "o", "--force", "--json"]);
    assert_eq!(forced.status.code(), Some(0));
    let printed: Value = serde_json::from_str(&text(&forced.stdout)).unwrap();
    let written = fs::read_to_string(folder.join("o/verify.json")).unwrap();
    assert_eq!(printed, serde_json::from_str::<Value>(&written).unwrap());
}

#[test]
fn the_built_in_case_is_the_example() {
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/tadina2011/beam.toml");
    assert_eq!(fs::read_to_string(example).unwrap(), BEAM_CASE);
}
