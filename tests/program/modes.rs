//! `plummer modes` against files of other modes and on several meshes, from outside.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use plummer::fe::element::continuum::PlaneAssumption;
use plummer::fe::model::PlaneModel;
use plummer::prelude::*;
use serde_json::Value;

use super::common;

fn project(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// A folder of this test's own with the ring of examples/modal in it, on its coarse mesh and without checks.
fn scratch(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("modes_{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let example = fs::read_to_string(project("examples/modal/ring.toml")).unwrap();
    let end = example.find("# Modes of another program").unwrap();
    let meshes = project("meshes").display().to_string();
    let text = example[..end].replace("../../meshes", &meshes).replace("ring_6_9.msh", "ring_6_9_48.msh");
    fs::write(folder.join("ring.toml"), text).unwrap();
    let tri = "ring_6_9_tri.msh";
    fs::copy(project("meshes").join(tri), folder.join(tri)).unwrap();
    folder
}

fn modes(folder: &Path, set: &[&str]) -> Output {
    let set = set.iter().flat_map(|argument| ["--set", argument]);
    Command::new(env!("CARGO_BIN_EXE_plummer"))
        .current_dir(folder)
        .args(["modes", "ring.toml", "--force"])
        .args(set)
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn result(folder: &Path) -> Value {
    let text = fs::read_to_string(folder.join("out/ring/modes.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn report(folder: &Path) -> String {
    fs::read_to_string(folder.join("out/ring/report.html")).unwrap()
}

/// The exact modes of the ring, the frequency of mode `mode` multiplied.
fn write_exact(path: &Path, mode: &str, factor: f64) {
    let exact = fs::read_to_string(project("examples/modal/exact_ring.csv")).unwrap();
    let lines = exact.lines().map(|line| {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        if cells[0] == mode {
            cells[1] = (cells[1].parse::<f64>().unwrap() * factor).to_string();
        }
        cells.join(",") + "\n"
    });
    fs::write(path, lines.collect::<String>()).unwrap();
}

/// The library's frequencies are the program's, bit by bit, and so are the numbers of rigid modes.
#[test]
fn the_library_has_the_modes_of_the_program() {
    let folder = scratch("library");
    assert_eq!(modes(&folder, &[]).status.code(), Some(0));
    let json = result(&folder);
    let mesh = Mesh::read_gmsh(&project("meshes/ring_6_9_48.msh"), LengthUnit::Millimetre).unwrap();
    let aluminium = Material::new(72e9, 0.33, 2700.0).unwrap();
    let description = HousingDescription {
        parts: vec![HousingPart { group: "housing".to_owned(), material: aluminium.into() }],
        plane: Some(PlaneModel { assumption: PlaneAssumption::Stress, thickness: 4e-3 }),
        ..HousingDescription::default()
    };
    let found = HousingModel::new(&mesh, description).unwrap().modes(ModeRange::Count(12)).unwrap();
    let bits = |hz: f64| hz.to_bits();
    let of_program = json["frequencies_hz"].as_array().unwrap().iter().map(|hz| bits(hz.as_f64().unwrap()));
    let of_library = found.frequencies_hz.iter().copied().map(bits);
    assert_eq!(of_program.collect::<Vec<_>>(), of_library.collect::<Vec<_>>());
    assert_eq!(json["rigid_modes"].as_u64(), Some(found.rigid_modes as u64));
}

#[test]
fn parts_of_stiffness_too_far_apart_are_named() {
    let folder = scratch("contrast");
    let case = "[materials]\nfoam = { young = 2, poisson = 0.3, density = 1000 }\n\
        [housing]\nmesh = \"MESH\"\nlength_unit = \"mm\"\n\
        parts = [{ group = \"lower\", material = \"foam\" }, { group = \"upper\", material = \"steel\" }]\n\
        links = [{ between = [\"seat\", \"foot\"], tie = true }]\nsupports = [{ group = \"base\", fixed = \"all\" }]\n";
    let mesh = project("tests/data/two_blocks.msh").display().to_string();
    fs::write(folder.join("ring.toml"), case.replace("MESH", &mesh)).unwrap();
    let output = modes(&folder, &["modes.count=4"]);
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    for part in [
        "error: mode 0 leaves a relative residual of ",
        "\nhelp: part \"lower\" (foam, young = 2 Pa) is 1e11 times softer than part \"upper\" (steel, young = 2.06e11 Pa): ",
    ] {
        assert!(said.contains(part), "{said}");
    }
}

/// Tetrahedra of first order lock in bending; the program says so, and says nothing of those of second order.
#[test]
fn elements_that_are_too_stiff_in_bending_are_told() {
    for (mesh, told) in [("ring3d_tet4", true), ("ring3d_tet10", false)] {
        let folder = scratch(mesh);
        let path = project("tests/data").join(format!("{mesh}.msh"));
        let file = format!("housing.mesh=\"{}\"", path.display());
        let text_of_case = fs::read_to_string(folder.join("ring.toml")).unwrap();
        let solid = text_of_case.lines().filter(|line| !line.starts_with("plane ")).collect::<Vec<_>>().join("\n");
        fs::write(folder.join("ring.toml"), solid).unwrap();
        let output = modes(&folder, &[&file]);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let warnings = result(&folder)["warnings"].to_string();
        assert_eq!(warnings.contains("Tet4 elements, which are far too stiff in bending"), told, "{warnings}");
    }
}

#[test]
fn a_result_agrees_with_its_own_file() {
    let folder = scratch("own");
    assert_eq!(modes(&folder, &[]).status.code(), Some(0));
    fs::rename(folder.join("out/ring/modes.npz"), folder.join("before.npz")).unwrap();
    let compare = "modes.compare=[{file=\"before.npz\",what=\"itself\"}]";
    let output = modes(&folder, &[compare]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let shown = text(&output.stdout);
    assert!(
        shown.contains(
            "against itself (before.npz): 384 points in common (here 384, there 384), MAC >= 0.95, within 1 %"
        ),
        "{shown}"
    );
    let json = result(&folder);
    let comparison = &json["comparisons"][0];
    assert_eq!(comparison["ok"], true);
    assert_eq!(comparison["points"]["by"], "tag");
    let pairs = comparison["pairs"].as_array().unwrap();
    // the rigid motions, four pairs and the breathing mode
    assert_eq!(pairs.len(), 6);
    for pair in pairs {
        assert_eq!(pair["here"], pair["there"]);
        // shapes go through the file bit by bit: rounding of the products is left
        assert!(pair["mac"].as_f64().unwrap() > 1.0 - 1e-12);
        let difference = pair["relative_difference"].as_f64();
        assert!(difference.is_none_or(|difference| difference.abs() < 1e-15));
    }
    let page = report(&folder);
    assert!(page.contains("Comparison with itself"));
    assert!(page.contains("Agreement with itself") && page.contains("12 of 12 modes"));
}

/// One frequency 1 % off, one percent and a half allowed, half a percent not; the exact pairs lie at other angles.
#[test]
fn a_frequency_that_is_off_is_exit_code_1() {
    let folder = scratch("off");
    write_exact(&folder.join("bench.csv"), "5", 1.01);
    let with =
        |within: &str| format!("modes.compare=[{{file=\"bench.csv\",what=\"the bench\",mac=0.99,within={within}}}]");
    let wide = modes(&folder, &[&with("0.015")]);
    assert_eq!(wide.status.code(), Some(0), "{}", text(&wide.stdout));
    let narrow = modes(&folder, &[&with("0.005")]);
    assert_eq!(narrow.status.code(), Some(1));
    assert!(
        common::errors(&narrow).starts_with("error: 8 of 9 modes agree with the bench (bench.csv)\nhelp: "),
        "{}",
        common::errors(&narrow)
    );
    let shown = text(&narrow.stdout);
    assert_eq!(shown.matches("FAILS").count(), 1, "{shown}");
    assert!(shown.contains("FAILS: frequency"), "{shown}");
    let json = result(&folder);
    let pairs = json["comparisons"][0]["pairs"].as_array().unwrap();
    let failed: Vec<&Value> = pairs.iter().filter(|pair| pair["misses"] != serde_json::json!([])).collect();
    assert_eq!(failed.len(), 1);
    assert_eq!(failed[0]["misses"], serde_json::json!(["frequency"]));
    assert_eq!(failed[0]["here"], serde_json::json!([7]));
    // both what was expected and what was compared
    let expected = "modes.expected=[{hz=1000,within=0.01}]";
    let both = modes(&folder, &[&with("0.005"), expected]);
    assert_eq!(both.status.code(), Some(1));
    assert!(
        common::errors(&both).starts_with(
            "error: 1 of 1 expected eigenfrequencies were not found within their tolerance; 8 of 9 modes agree"
        ),
        "{}",
        common::errors(&both)
    );
}

#[test]
fn wrong_files_are_exit_code_2_with_file_and_line() {
    let folder = scratch("wrong");
    let errors = |file: &str| {
        let output = modes(&folder, &[&format!("modes.compare=[{{file=\"{file}\"}}]")]);
        assert_eq!(output.status.code(), Some(2), "{file}");
        common::errors(&output)
    };
    fs::write(folder.join("hz.csv"), "# a list\nmode,frequency_hz\n1,500\n").unwrap();
    assert_eq!(
        errors("hz.csv"),
        "error: hz.csv:2: expected the header mode,frequency_hz,x,y,z,ux,uy,uz or mode,frequency_hz,node,ux,uy,uz, found \"mode,frequency_hz\"\n\
         help: frequencies without shapes are checked by `modes.expected` in the case file\n"
    );
    assert_eq!(errors("no.csv"), "error: cannot read no.csv: No such file or directory (os error 2)\n");
    assert_eq!(
        errors("ring.toml"),
        "error: expected a file of mode shapes (.npz, .csv, .uff, .unv or .frd), found ring.toml\n"
    );
    let far = "mode,frequency_hz,x,y,z,ux,uy,uz\n1,500,9,0,0,1,0,0\n1,500,0,9,0,1,0,0\n1,500,6,0,0,1,0,0\n";
    fs::write(folder.join("far.csv"), far).unwrap();
    let far = errors("far.csv");
    assert!(far.starts_with("error: far.csv: only 0 points of the two sets of modes coincide"), "{far}");
    assert!(far.contains("help: points are in m; `points_within`"), "{far}");
    let missing = modes(&folder, &["modes.convergence.meshes=[\"no.msh\"]"]);
    assert_eq!(missing.status.code(), Some(2));
    assert!(
        common::errors(&missing)
            .starts_with("error: modes.convergence.meshes[0] (no.msh): cannot read the mesh no.msh: "),
        "{}",
        common::errors(&missing)
    );
    assert!(!folder.join("out/ring/modes.json").exists());
}

/// The shipped example as it stands: both checks in summary, JSON and report.
#[test]
fn the_example_compares_and_converges() {
    let folder = scratch("example");
    let output = Command::new(env!("CARGO_BIN_EXE_plummer"))
        .current_dir(project("."))
        .args(["modes", "examples/modal/ring.toml", "--force", "--out"])
        .arg(folder.join("out/ring"))
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let shown = text(&output.stdout);
    assert!(
        shown.contains("against the exact solution (examples/modal/exact_ring.csv): 48 points in common"),
        "{shown}"
    );
    assert!(
        shown.contains("convergence over 3 meshes, h = 2.43 mm, 1.21 mm, 0.809 mm (this case); order promised: 4"),
        "{shown}"
    );
    let json = result(&folder);
    assert_eq!(json["comparisons"][0]["ok"], true);
    assert_eq!(json["comparisons"][0]["lone_here"].as_array().unwrap().len(), 3);
    let exact = &json["comparisons"][0]["there_hz"];
    let converged = json["convergence"]["modes"].as_array().unwrap();
    assert_eq!(converged.len(), 9);
    for (place, mode) in converged.iter().enumerate() {
        let number = |key: &str| mode[key].as_f64().unwrap();
        let own = mode["frequencies_hz"][2].as_f64().unwrap();
        let real = own / exact[place].as_f64().unwrap() - 1.0;
        let [error, around] = [number("mesh_error"), number("mesh_error_uncertainty")];
        assert!((error - real).abs() <= around, "{error} {around} {real}");
        // measured: 0.1 to 0.4 of the mesh error is left
        assert!((error - real).abs() < 0.5 * real.abs(), "{error} {real}");
    }
    let page = report(&folder);
    for text in [
        "Comparison with the exact solution",
        "Convergence of the mesh",
        "Largest error of the mesh",
        "class=\"matrix\"",
    ] {
        assert!(page.contains(text), "{text}");
    }
}

/// Quadrilaterals and triangles: nothing to extrapolate from.
#[test]
fn what_is_not_extrapolated_is_told() {
    let folder = scratch("unlike");
    let output = modes(&folder, &["modes.convergence.meshes=[\"ring_6_9_tri.msh\"]"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let shown = text(&output.stdout);
    assert!(shown.contains("ring_6_9_tri.msh has Tri6 where this case's mesh has Quad8"), "{shown}");
    assert_eq!(shown.matches("not known, on no other mesh of its kind\n").count(), 9, "{shown}");
    let json = result(&folder);
    let converged = json["convergence"]["modes"].as_array().unwrap();
    assert!(converged.iter().all(|mode| mode["mesh_error"].is_null() && mode["frequencies_hz"][1].is_f64()));
    let page = report(&folder);
    assert!(page.contains("shown only") && page.contains("No other mesh has the elements of this case"));
}

/// A band in which nothing vibrates: no empty files, and what was asked for by name.
#[test]
fn a_band_without_modes_is_refused() {
    let folder = scratch("empty_band");
    for low in [100, 1000] {
        let high = low + 1;
        let band = format!("modes={{band_hz=[{low},{high}]}}");
        let within = format!("from {low} to {high} Hz (band_hz)");
        let output = modes(&folder, &[&band]);
        assert_eq!(
            text(&output.stderr),
            format!(
                "error: modes: expected at least one mode {within}, a count of eigenvalues finds none\n\
                 help: another band, or `modes.count = 1`, which finds the lowest wherever it is\n"
            )
        );
        assert_eq!(output.status.code(), Some(2));
        assert!(!folder.join("out/ring/modes.json").exists());
    }
}

/// The mesh is not read from the disk.
#[test]
fn a_mesh_at_hand_gives_the_modes_of_its_file() {
    let bytes = fs::read(project("meshes/pedestal.msh")).unwrap();
    let load = |set: &[&str]| {
        let set: Vec<String> = set.iter().map(|&key| key.to_owned()).collect();
        Case::load(project("examples/modal/pedestal.toml"), &set).unwrap()
    };
    let keys = ["modes.count=2"];
    let elsewhere = load(&[&keys[..], &["housing.mesh=nowhere.msh"]].concat());
    assert!(compute_modes(&elsewhere, &Unwatched).unwrap_err().to_string().contains("nowhere.msh"));
    let found = compute_modes(&elsewhere.with_content("nowhere.msh", bytes.into()), &Unwatched).unwrap();
    let expected = compute_modes(&load(&keys), &Unwatched).unwrap();
    assert_eq!(found.base.unloaded_hz, expected.base.unloaded_hz);
}
