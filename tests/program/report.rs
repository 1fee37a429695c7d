//! `plummer report` from outside: the pages of earlier results drawn again from their content, the same to the byte by the same version.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use super::common::{errors, plummer, scratch};
use serde_json::Value;

const RING: &str = "[ring]\nnodes = 24\nouter_radius = 6e-3\n\
    sections = [{ material = \"steel\", area = 5.37e-6, inertia = 8.88e-13, radius = 5.314e-3 }]\n\
    supports = [{ from_deg = 180, to_deg = 360, spring = { x = 1e5, y = 1e5 } }]\n";

/// A folder with a case in it.
fn with_case(name: &str) -> PathBuf {
    let folder = scratch(name);
    fs::write(folder.join("ring.toml"), format!("{RING}[modes]\ncount = 6\n")).unwrap();
    folder
}

fn good(folder: &Path, words: &[&str]) -> String {
    let output = plummer(folder, words);
    assert_eq!(output.status.code(), Some(0), "{words:?}: {}", errors(&output));
    String::from_utf8(output.stdout).unwrap()
}

/// Every page, table and figure below a folder.
fn drawn(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    for below in ["", "tables", "figures"] {
        for entry in fs::read_dir(folder.join(below)).into_iter().flatten() {
            let path = entry.unwrap().path();
            let ending = path.extension().unwrap_or_default();
            if ending == "html" || ending == "csv" || ending == "svg" {
                let name = path.strip_prefix(folder).unwrap().to_owned();
                files.insert(name, fs::read(&path).unwrap());
            }
        }
    }
    files
}

#[test]
fn pages_tables_and_figures_come_back_to_the_byte() {
    let folder = scratch("report-again");
    // mode shapes, and a second command in the same folder
    for (command, case) in [("modes", "housings/ring.toml"), ("run", "scenes/smooth.toml")] {
        let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(case);
        good(&folder, &[command, case.to_str().unwrap(), "--out", "out"]);
    }
    let out = folder.join("out");
    let first = drawn(&out);
    for (start, least) in
        [("report.html", 1), ("run-report.html", 1), ("tables/modes-", 2), ("tables/run-", 2), ("figures/run-", 1)]
    {
        let count = first.keys().filter(|name| name.to_string_lossy().starts_with(start)).count();
        assert!(count >= least, "{start}: {:?}", first.keys());
    }
    let results = fs::read(out.join("modes.json")).unwrap();
    for name in first.keys() {
        fs::write(out.join(name), "gone").unwrap();
    }
    let said = good(&folder, &["report", "out"]);
    assert!(said.contains("modes: ") && said.contains("wrote out/report.html"), "{said}");
    for (name, bytes) in drawn(&out) {
        assert!(first[&name] == bytes, "{} differs", name.display());
    }
    assert_eq!(fs::read(out.join("modes.json")).unwrap(), results);
    // elsewhere, and nothing but what is drawn
    let json = good(&folder, &["report", "out", "--out", "elsewhere", "--json"]);
    let json: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["reports"].as_array().unwrap().len(), 2, "{json}");
    assert!(drawn(&folder.join("elsewhere")) == first);
    assert!(!folder.join("elsewhere/modes.json").exists());
}

#[test]
fn what_is_no_content_of_a_report_is_named() {
    let folder = with_case("report-broken");
    good(&folder, &["modes", "ring.toml", "--out", "out"]);
    let refused = |words: &[&str]| {
        let output = plummer(&folder, words);
        assert_eq!(output.status.code(), Some(2), "{}", errors(&output));
        errors(&output)
    };
    assert!(refused(&["report", "no-such"]).contains("cannot read no-such"));
    fs::create_dir(folder.join("empty")).unwrap();
    assert!(refused(&["report", "empty"]).contains("no content of a report"));
    let record = folder.join("out/report.cbor.gz");
    let bytes = fs::read(&record).unwrap();
    let page = fs::read(folder.join("out/report.html")).unwrap();
    fs::write(&record, &bytes[..bytes.len() / 2]).unwrap();
    let said = refused(&["report", "out"]);
    assert!(said.contains("out/report.cbor.gz") && said.contains("--force"), "{said}");
    fs::write(&record, b"<html>").unwrap();
    refused(&["report", "out"]);
    assert_eq!(fs::read(folder.join("out/report.html")).unwrap(), page, "as it was");
}

/// The folder of a table is made of what the content says of itself.
#[test]
fn content_that_means_harm_writes_nothing_beside_its_folder() {
    let folder = with_case("report-harm");
    fs::create_dir(folder.join("out")).unwrap();
    for prefix in ["../../evil", "/evil", "modes/../../evil", "evil"] {
        let report = plummer::report::Report::new("t", "c", "0").tables_in("../..", prefix);
        let bytes = report.to_record().unwrap();
        fs::write(folder.join("out/report.cbor.gz"), bytes).unwrap();
        let output = plummer(&folder, &["report", "out"]);
        assert_eq!(output.status.code(), Some(2), "{prefix}");
        assert!(errors(&output).contains("expected one of run, modes"), "{}", errors(&output));
    }
    let column = plummer::report::Column::text("a");
    let table = plummer::report::Table::new("../../../evil", [column])
        .row([plummer::report::Cell::text("<script>alert(1)</script>")]);
    let report = plummer::report::Report::new("<script>", "c", "0")
        .section(plummer::report::Section::new("S").table(table))
        .tables_in("../..", "modes");
    fs::write(folder.join("out/report.cbor.gz"), report.to_record().unwrap()).unwrap();
    good(&folder, &["report", "out"]);
    let page = fs::read_to_string(folder.join("out/report.html")).unwrap();
    assert!(!page.contains("<script>alert"));
    let names = |path: &Path| {
        let mut names: Vec<_> =
            fs::read_dir(path).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    };
    assert_eq!(names(&folder), ["out", "ring.toml"]);
    assert_eq!(names(&folder.join("out")), ["report.cbor.gz", "report.html", "tables"]);
    assert_eq!(names(&folder.join("out/tables")), ["modes-1-evil.csv"]);
}
