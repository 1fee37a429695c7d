//! Which mesh files a case rests on, told apart by their content.

use std::path::{Path, PathBuf};

use crate::app::case::{Case, Housing};
use crate::app::error::ComputeError;
use crate::fe::mesh::{Mesh, MeshError};
use crate::files;
use crate::files::FileDigest;
use crate::numerics::Watch;
use crate::report::MeshFile;

impl From<&FileDigest> for MeshFile {
    fn from(digest: &FileDigest) -> Self {
        Self { path: digest.path.display().to_string(), hash: Some(format!("SHA-256 {}", digest.sha256)) }
    }
}

/// Reads the mesh of a housing and tells which content it had.
///
/// # Errors
/// [`ComputeError::Mesh`].
pub(crate) fn read_mesh(housing: &Housing, watch: &impl Watch) -> Result<Mesh, ComputeError> {
    let path = &housing.mesh;
    let bytes = files::read(path).map_err(|cause| MeshError::Read { path: path.clone(), cause })?;
    watch.read(&FileDigest::of_bytes(path, &bytes));
    Ok(Mesh::from_gmsh_bytes(bytes, path, housing.length_unit)?)
}

/// The meshes of a case, of its variants and of its mesh convergence, each once; a superelement's file in the place of a
/// mesh.
///
/// # Errors
/// [`ComputeError::Mesh`] for a file that cannot be read, [`ComputeError::Case`] for a variant that is no case.
pub(crate) fn mesh_digests(case: &Case) -> Result<Vec<FileDigest>, ComputeError> {
    let variants = case.variants()?;
    let cases = std::iter::once(case).chain(variants.iter().map(|variant| &variant.case));
    let housings = cases.filter_map(|case| case.housing.as_ref());
    let others = case.modes.convergence.iter();
    let others = others.flat_map(|convergence| &convergence.meshes);
    let others = others.map(PathBuf::as_path);
    let mut paths: Vec<&Path> = Vec::new();
    for path in housings.map(|housing| housing.path()).chain(others) {
        if !paths.contains(&path) {
            paths.push(path);
        }
    }
    let digest = |path: &&Path| {
        FileDigest::of_file(path).map_err(|cause| {
            let path = path.to_path_buf();
            ComputeError::from(MeshError::Read { path, cause })
        })
    };
    paths.iter().map(digest).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::case::Source;

    #[test]
    fn every_mesh_is_told_once_by_its_standard_digest() {
        let folder = tempfile::tempdir().unwrap();
        // FIPS 180-4, examples of NIST: "abc", and the empty message
        let (abc, empty) = (
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad",
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855",
        );
        std::fs::write(folder.path().join("a.msh"), "abc").unwrap();
        std::fs::write(folder.path().join("b.msh"), "").unwrap();
        let text = "[housing]\nmesh = \"a.msh\"\nlength_unit = \"mm\"\n\
            parts = [{ group = \"housing\", material = \"steel\" }]\n\
            [modes]\nvariants = [{ what = \"softer\", set = [\"housing.parts[0].material=aluminium\"] }, \
            { what = \"finer\", set = [\"housing.mesh=b.msh\"] }]\n";
        let case =
            Case::from_source(Source { path: folder.path().join("a.toml"), text: text.to_owned(), set: Vec::new() })
                .unwrap();
        let found = mesh_digests(&case).unwrap();
        let expected = [("a.msh", abc), ("b.msh", empty)]
            .map(|(name, sha256)| FileDigest { path: folder.path().join(name), sha256: sha256.to_owned() });
        assert_eq!(found, expected);
        let file = MeshFile::from(&found[0]);
        assert_eq!(file.hash, Some(format!("SHA-256 {abc}")));
        std::fs::remove_file(folder.path().join("b.msh")).unwrap();
        let error = mesh_digests(&case).unwrap_err().to_string();
        assert!(error.contains("b.msh"), "{error}");
    }
}
