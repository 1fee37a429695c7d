//! Damaged meshes: each is refused with the message of `tests/data/damaged/expected.txt`, without a panic.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use plummer::fe::mesh::{Mesh, MeshError};
use plummer::numerics::units::LengthUnit;

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/damaged")
}

/// The damaged meshes by name.
fn files() -> Result<BTreeMap<String, PathBuf>, std::io::Error> {
    let mut found = BTreeMap::new();
    for entry in std::fs::read_dir(folder())? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "msh") {
            let name = path.file_stem().unwrap_or_default();
            found.insert(name.to_string_lossy().into_owned(), path);
        }
    }
    Ok(found)
}

fn message(path: &Path) -> String {
    match Mesh::read_gmsh(path, LengthUnit::Metre) {
        Ok(_) => "accepted".to_owned(),
        Err(MeshError::Gmsh { fault, .. }) => fault.to_string(),
        Err(other) => other.to_string(),
    }
}

/// Lines of `name: message`; a file without a line, and a line without a file, are failures.
#[test]
fn every_message_is_the_one_expected() -> Outcome {
    let text = std::fs::read_to_string(folder().join("expected.txt"))?;
    let expected: Vec<&str> = text.lines().collect();
    let found: Vec<String> = files()?.iter().map(|(name, path)| format!("{name}: {}", message(path))).collect();
    assert!(found.len() >= 40);
    assert_eq!(found, expected);
    Ok(())
}

/// Line ends of Windows, big-endian numbers, comments: no damage, and the same mesh as always.
#[test]
fn unusual_files_give_the_usual_mesh() -> Outcome {
    let files = files()?;
    let usual = Mesh::read_gmsh(&files["ok_binary"], LengthUnit::Metre)?;
    let mut count = 0;
    for (name, path) in files.iter().filter(|(name, _)| name.starts_with("ok_")) {
        let mesh = Mesh::read_gmsh(path, LengthUnit::Metre)?;
        assert_eq!(mesh.nodes, usual.nodes, "{name}");
        assert_eq!(mesh.blocks, usual.blocks, "{name}");
        // 2.2 has no group 5: its element is not repeated in that file
        let named = |mesh: &Mesh| mesh.groups.iter().filter(|g| g.tag != 5).cloned().collect::<Vec<_>>();
        assert_eq!(named(&mesh), named(&usual), "{name}");
        count += 1;
    }
    assert_eq!(count, 10);
    Ok(())
}

#[test]
fn a_directory_is_no_mesh() {
    let path = folder();
    assert_eq!(message(&path), format!("cannot read the mesh {}: expected a file, found a folder", path.display()));
}
