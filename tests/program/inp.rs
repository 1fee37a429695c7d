//! A housing as an input file of CalculiX and Abaqus: written, read again, and computed by CalculiX.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use plummer::formats::read_modes_frd;
use serde_json::Value;

const CASE: &str = "[housing]\nmesh = \"MESH\"\nlength_unit = \"UNIT\"\n\
    parts = [{ group = \"housing\", material = \"aluminium\" }]\n\
    supports = [{ group = \"feet\", fixed = \"all\" }]\nintegration = \"4-point\"\n[modes]\ncount = 4\n";

/// A folder with the case of a pillow block, and its export.
fn exported(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("inp-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("meshes/pedestal.msh");
    fs::copy(mesh, folder.join("a.msh")).unwrap();
    fs::write(folder.join("a.toml"), CASE.replace("MESH", "a.msh").replace("UNIT", "mm")).unwrap();
    fs::write(folder.join("b.toml"), CASE.replace("MESH", "x/housing.inp").replace("UNIT", "m")).unwrap();
    plummer(&folder, "export a.toml --to inp --out x");
    folder
}

fn plummer(folder: &Path, words: &str) -> Output {
    let run = Command::new(env!("CARGO_BIN_EXE_plummer")).current_dir(folder).args(words.split(' ')).output().unwrap();
    assert!(run.status.success(), "{words}: {}", String::from_utf8_lossy(&run.stderr));
    run
}

fn frequencies(folder: &Path, case: &str) -> Vec<f64> {
    let run = plummer(folder, &format!("modes {case} --json --quiet --out m-{case}"));
    let result: Value = serde_json::from_slice(&run.stdout).unwrap();
    result["frequencies_hz"].as_array().unwrap().iter().map(|hz| hz.as_f64().unwrap()).collect()
}

/// The coordinates are written with 13 digits.
#[test]
fn a_housing_that_was_written_is_read_as_the_same() {
    let folder = exported("again");
    let [first, again] = ["a.toml", "b.toml"].map(|case| frequencies(&folder, case));
    assert_eq!(first.len(), 4);
    for (a, b) in first.iter().zip(&again) {
        assert!((a / b - 1.0).abs() < 1e-9, "{first:?} {again:?}");
    }
    let inspected = plummer(&folder, "inspect x/housing.inp");
    let text = String::from_utf8_lossy(&inspected.stdout);
    let groups: Vec<&str> = text.lines().skip_while(|line| *line != "groups").skip(1).take(3).collect();
    assert!(groups[0].contains("\"bore\"") && groups[0].contains("234 Tri6  3.7699"), "{text}");
    assert!(groups[1].contains("\"feet\"") && groups[1].contains("120 Tri6"), "{text}");
    assert!(groups[2].contains("\"housing\"") && groups[2].contains("1620 Tet10"), "{text}");
}

/// CalculiX integrates the mass of a C3D10 with four points as well, which makes 1.3e-4 here (docs/tutorials).
#[test]
fn calculix_finds_the_same_modes() {
    let folder = exported("ccx");
    let ran = Command::new("ccx").args(["-i", "housing"]).current_dir(folder.join("x")).output();
    if ran.is_err() {
        eprintln!("skipped: ccx is not installed");
        return;
    }
    let theirs = read_modes_frd(&folder.join("x/housing.frd"), 1.0).unwrap().frequencies_hz;
    let own = frequencies(&folder, "a.toml");
    assert_eq!(theirs.len(), 4);
    for (a, b) in own.iter().zip(&theirs) {
        assert!((a / b - 1.0).abs() < 3e-4, "{own:?} {theirs:?}");
    }
}

/// A held body is a set of nodes too, and of two groups of one name each key takes its own.
#[test]
fn held_bodies_and_shared_names_are_sets_of_their_own() {
    let folder = exported("names");
    let both = fs::read_to_string(folder.join("a.msh")).unwrap().replace("\"feet\"", "\"housing\"");
    fs::write(folder.join("a.msh"), both).unwrap();
    let case = CASE.replace("MESH", "a.msh").replace("UNIT", "mm");
    fs::write(folder.join("surface.toml"), case.replace("\"feet\"", "\"housing\"")).unwrap();
    fs::write(folder.join("body.toml"), case.replace("\"feet\"", "\"volume 1\"")).unwrap();
    for (name, held) in [("surface", "housing"), ("body", "volume_1")] {
        plummer(&folder, &format!("export {name}.toml --to inp --out {name}"));
        let deck = fs::read_to_string(folder.join(name).join("housing.inp")).unwrap();
        let sections: Vec<&str> = deck.lines().filter(|line| line.starts_with("*SOLID SECTION")).collect();
        assert_eq!(sections, ["*SOLID SECTION,ELSET=housing_2,MATERIAL=aluminium_1"], "{name}");
        assert!(deck.contains("*ELSET,ELSET=housing_2\n"), "{name}");
        assert!(deck.contains(&format!("*NSET,NSET={held}\n")), "{name}");
        assert!(deck.contains(&format!("*BOUNDARY\n{held},1,1\n")), "{name}");
    }
}

#[test]
fn what_the_file_cannot_hold_is_told() {
    let folder = exported("told");
    let springs = CASE.replace("fixed = \"all\"", "spring = { x = 1e6, y = 1e6, z = 1e6 }");
    let springs = springs.replace("MESH", "a.msh").replace("UNIT", "mm");
    fs::write(folder.join("c.toml"), springs).unwrap();
    let run = plummer(&folder, "export c.toml --to inp --out y");
    let told = String::from_utf8_lossy(&run.stdout) + String::from_utf8_lossy(&run.stderr);
    assert!(told.contains("warning: housing.inp has not: supports by springs"), "{told}");
    let deck = fs::read_to_string(folder.join("y/housing.inp")).unwrap();
    assert!(deck.contains("** not in this file: supports by springs\n"));
    // six rigid motions come first
    assert!(deck.contains("*FREQUENCY\n10\n"));
}

/// A deck of another program: what it says of material and supports is the case's, in SI.
#[test]
fn init_takes_material_and_supports_from_the_file() {
    let folder = exported("init");
    let text = plummer(&folder, "init x/housing.inp --out c.toml --length-unit m").stdout;
    let text = String::from_utf8_lossy(&text).into_owned();
    for sentence in [
        "Parts: \"housing\" of aluminium_1 (by the file).",
        "Materials of the file: aluminium_1 of 70 GPa and 2700 kg/m^3; by their numbers its units are m-kg-s.",
        "Held, as *BOUNDARY of the file says: \"feet\".",
    ] {
        assert!(text.contains(sentence), "{text}");
    }
    let case = fs::read_to_string(folder.join("c.toml")).unwrap();
    assert!(case.contains("{ group = \"feet\", fixed = [\"x\", \"y\", \"z\"] }"), "{case}");
    let alone = "c.toml --set housing.integration=\"4-point\" --set modes.count=4";
    let run = plummer(&folder, &format!("export {alone} --to inp --out y"));
    assert!(run.status.success());
    let [first, again] = ["x", "y"].map(|of| fs::read_to_string(folder.join(of).join("housing.inp")).unwrap());
    let of = |deck: &str, from: &str| deck.split(from).nth(1).unwrap_or_default().lines().nth(1).unwrap().to_owned();
    for keyword in ["*ELASTIC", "*DENSITY"] {
        assert_eq!(of(&first, keyword), of(&again, keyword));
    }
    // a case of another material, and of another unit than the file's numbers are in
    let steel = fs::read_to_string(folder.join("b.toml")).unwrap().replace("\"aluminium\"", "\"steel\"");
    fs::write(folder.join("d.toml"), steel.replace("\"m\"", "\"cm\"")).unwrap();
    let told = |case: &str| String::from_utf8_lossy(&plummer(&folder, &format!("modes {case}")).stdout).into_owned();
    let text = told("d.toml");
    let other = "part \"housing\": aluminium_1 of the mesh file has 70.00 GPa and 2700 kg/m^3, steel of the case 206.0 GPa and 7850 kg/m^3";
    assert!(text.contains(other), "{text}");
    assert!(
        text.contains("the materials of this file are in m-kg-s, a length in m, and housing.length_unit is \"cm\""),
        "{text}"
    );
    assert!(!told("b.toml").contains("of the mesh file"));
}

/// The same in mm, t and s, with what init cannot take: a material without density, single nodes, and steel beside.
#[test]
fn units_of_a_deck_are_known_by_its_materials() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("inp-units");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let deck = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,0,0,-1\n*ELEMENT,TYPE=C3D4,ELSET=upper\n1,1,2,3,4\n\
        *ELEMENT,TYPE=C3D4,ELSET=lower\n2,1,3,2,5\n*ELSET,ELSET=Eall\nupper,lower\n*NSET,NSET=top\n1,4\n\
        *MATERIAL,NAME=bearing steel\n*DENSITY\n7.85e-9\n*ELASTIC\n210000,0.3\n*MATERIAL,NAME=GG\n*ELASTIC\n110000,.27\n\
        *SOLID SECTION,ELSET=upper,MATERIAL=bearing steel\n*SOLID SECTION,ELSET=lower,MATERIAL=GG\n\
        *STEP\n*FREQUENCY\n3\n*BOUNDARY\ntop,2,3\n5,1,3\n*END STEP\n";
    fs::write(folder.join("a.inp"), deck).unwrap();
    let text = String::from_utf8_lossy(&plummer(&folder, "init a.inp").stdout).into_owned();
    for sentence in [
        "length_unit = \"mm\": that of the file's materials",
        "\"upper\" of bearing steel of the mesh (by the file) and \"lower\" of aluminium (a guess)",
        "by their numbers its units are mm-t-s",
        "The material \"GG\" of the file is not taken: it has no *DENSITY",
        "*BOUNDARY holds single nodes (1, first in line ",
    ] {
        assert!(text.contains(sentence), "{sentence}\n{text}");
    }
    let case = fs::read_to_string(folder.join("a.toml")).unwrap();
    for line in
        ["[materials.\"bearing steel of the mesh\"]", "young = 2.1e11 ", "density = 7850 ", "fixed = [\"y\", \"z\"]"]
    {
        assert!(case.contains(line), "{line}\n{case}");
    }
    // another of the name that the first one gets, and one that is not isotropic
    let clash = "*MATERIAL,NAME=bearing steel of the mesh\n*DENSITY\n2.7e-9\n*ELASTIC\n70000,.3\n";
    let clash = deck
        .replace("*MATERIAL,NAME=GG\n*ELASTIC\n110000,.27\n", clash)
        .replace("MATERIAL=GG", "MATERIAL=bearing steel of the mesh");
    fs::write(folder.join("b.inp"), clash).unwrap();
    let text = String::from_utf8_lossy(&plummer(&folder, "init b.inp").stdout).into_owned();
    let names = "\"upper\" of bearing steel of the mesh of the mesh (by the file) and \"lower\" of bearing steel of the mesh (by the file)";
    assert!(text.contains(names), "{text}");
    fs::write(
        folder.join("c.inp"),
        deck.replace("*ELASTIC\n110000,.27", "*DENSITY\n1e-9\n*ELASTIC,TYPE=ORTHO\n1,1,1,1,1,1,1,1\n1"),
    )
    .unwrap();
    plummer(&folder, "init c.inp");
    let text = String::from_utf8_lossy(&plummer(&folder, "modes c.toml --set modes.count=3").stdout).into_owned();
    let ortho = "part \"lower\": GG of the mesh file has *ELASTIC, TYPE=ORTHO, aluminium of the case is isotropic";
    assert!(text.contains(ortho), "{text}");
    let inspected = String::from_utf8_lossy(&plummer(&folder, "inspect a.inp").stdout).into_owned();
    assert!(
        inspected.contains("\"bearing steel\": E 210000, nu 0.3, density 7.85e-9 (mm-t-s) of \"upper\""),
        "{inspected}"
    );
    let told = String::from_utf8_lossy(&plummer(&folder, "modes a.toml --set modes.count=2").stdout).into_owned();
    assert!(
        told.contains("mesh with second order (C3D10, C3D15 or C3D20 in the program that wrote the file)"),
        "{told}"
    );
}
