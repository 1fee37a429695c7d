//! Mesh to matrices of a housing, as the case asks for them, and which mesh files these are, by their content.

use crate::app::case::{self, Case, Hold, Housing, Interface, IsotropicMaterial, Rule};
use crate::app::error::ComputeError;
use crate::fe::assembly::SystemMatrices;
use crate::fe::material::{ElasticMaterial, Material, MaterialError, OrthotropicMaterial};
use crate::fe::mesh::{Mesh, MeshError};
use crate::fe::model::{
    Constraint, HousingDescription, HousingModel, HousingPart, HousingSupport, ModelError, RingFrame, SupportShare,
    straighten,
};
use crate::files::{self, FileDigest};
use crate::numerics::Watch;
use crate::report::MeshFile;
use std::path::{Path, PathBuf};

/// A housing, assembled.
#[derive(Debug, Clone)]
pub struct AssembledHousing {
    /// The mesh.
    pub mesh: Mesh,
    /// The mesh with properties and supports.
    pub model: HousingModel,
    /// Stiffness and mass over all its degrees of freedom.
    pub matrices: SystemMatrices,
}

impl AssembledHousing {
    /// Reads and assembles the case's housing; `None` without one.
    ///
    /// # Errors
    /// [`ComputeError`] of mesh, model and elements.
    pub fn build(case: &Case, watch: &impl Watch) -> Result<Option<Self>, ComputeError> {
        Self::assembled(case, watch, SystemMatrices::assemble)
    }

    /// The housing of a case without a ring, whose free degrees of freedom are factorised all together.
    ///
    /// # Errors
    /// As [`AssembledHousing::build`].
    pub(crate) fn of(case: &Case, watch: &impl Watch) -> Result<Self, ComputeError> {
        let nothing = || case.broken(&Rule::nothing_to_model().at("housing"));
        Self::ordered(case, watch)?.ok_or_else(|| nothing().into())
    }

    /// The housing of a case of which free degrees of freedom are factorised, all or most of them; `None` without one.
    ///
    /// # Errors
    /// As [`AssembledHousing::build`].
    pub(super) fn ordered(case: &Case, watch: &impl Watch) -> Result<Option<Self>, ComputeError> {
        Self::assembled(case, watch, SystemMatrices::assemble_and_order)
    }

    fn assembled(
        case: &Case,
        watch: &impl Watch,
        assemble: fn(&HousingModel) -> Result<SystemMatrices, ModelError>,
    ) -> Result<Option<Self>, ComputeError> {
        let Some(housing) = case.meshed_housing() else {
            return Ok(None);
        };
        watch.stage("read");
        let mesh = read_mesh(case, housing, watch)?;
        watch.stage("assemble");
        let model = HousingModel::new(&mesh, description(case, housing)?)?;
        let matrices = assemble(&model)?;
        Ok(Some(Self { mesh, model, matrices }))
    }
}

/// Everything that the case says of its housing.
///
/// # Errors
/// [`ComputeError`] of materials and of the tie's frame.
pub(crate) fn description(case: &Case, housing: &case::Housing) -> Result<HousingDescription, ComputeError> {
    let parts = housing
        .parts
        .iter()
        .map(|part| Ok(HousingPart { group: part.group.clone(), material: elastic_material(case, &part.material)? }));
    let (mut attached, attached_nodes) = match &case.condense.interface {
        Interface::Ring => (Vec::new(), Vec::new()),
        Interface::Group(group) => (vec![group.clone()], Vec::new()),
        Interface::Nodes(tags) => (Vec::new(), tags.clone()),
        Interface::Centres { centres, .. } => (centres.iter().map(|centre| centre.group.clone()).collect(), Vec::new()),
    };
    attached.extend(case.seats().iter().filter_map(|seat| seat.ring.tie.as_ref()).map(|tie| tie.group.clone()));
    Ok(HousingDescription {
        parts: parts.collect::<Result<_, ComputeError>>()?,
        plane: housing.plane,
        formulation: housing.formulation,
        supports: housing.supports.iter().map(|asked| support(asked, housing.plane.is_some())).collect(),
        masses: housing.masses.clone(),
        links: housing.links.clone(),
        overlap: housing.overlap,
        frame: case.seats().first().map_or_else(|| Ok(RingFrame::default()), frame)?,
        attached,
        attached_nodes,
    })
}

/// Where a ring sits; the mesh's own frame without a tie.
///
/// # Errors
/// [`ComputeError::Input`] for an angle 0 along the axis.
pub(super) fn frame(seat: &case::Seat<'_>) -> Result<RingFrame, ComputeError> {
    match &seat.ring.tie {
        None => Ok(RingFrame::default()),
        Some(tie) => RingFrame::new(tie.centre, tie.axis, tie.zero_deg).ok_or_else(|| {
            let key = seat.key("ring.tie");
            ComputeError::wrong(format!("{key}: `zero_deg` lies along `axis`: expected a direction across it"))
        }),
    }
}

/// An isotropic material of the case, checked.
///
/// # Errors
/// [`ComputeError::Input`] for values out of range, [`ComputeError::Case`] for a name that `key` may not have.
pub(crate) fn material(case: &Case, key: &str, name: &str) -> Result<Material, ComputeError> {
    let IsotropicMaterial { young, poisson, density, .. } = *case.isotropic(key, name)?;
    Material::new(young, poisson, density).map_err(|source| named(name, source))
}

fn elastic_material(case: &Case, name: &str) -> Result<ElasticMaterial, ComputeError> {
    let material = match *case.known_material("housing.parts", name)? {
        case::Material::Orthotropic(given) => {
            let case::OrthotropicMaterial { young, poisson, shear, density, loss_factor, x_axis, y_axis } = given;
            OrthotropicMaterial::new(young, poisson, shear, density, x_axis, y_axis)
                .and_then(|material| material.with_loss_factor(loss_factor))
                .map(ElasticMaterial::Orthotropic)
        }
        case::Material::Isotropic(IsotropicMaterial { young, poisson, density, loss_factor }) => {
            let material = Material::new(young, poisson, density);
            material.and_then(|material| material.with_loss_factor(loss_factor)).map(ElasticMaterial::from)
        }
    };
    material.map_err(|source| named(name, source))
}

fn named(name: &str, source: MaterialError) -> ComputeError {
    ComputeError::wrong(format!("materials.{name}: {source}"))
}

fn support(support: &case::Support, plane: bool) -> HousingSupport {
    let (constraint, share) = match &support.hold {
        Hold::All => (Constraint::Fixed([true, true, !plane]), SupportShare::PerNode),
        Hold::Fixed(axes) => {
            let fixed = [case::Axis::X, case::Axis::Y, case::Axis::Z].map(|axis| axes.contains(&axis));
            (Constraint::Fixed(fixed), SupportShare::PerNode)
        }
        Hold::Spring(stiffness, share) => (Constraint::Spring(*stiffness), *share),
    };
    HousingSupport { group: support.group.clone(), constraint, share }
}

impl From<&FileDigest> for MeshFile {
    fn from(digest: &FileDigest) -> Self {
        Self { path: digest.path.display().to_string(), hash: Some(format!("SHA-256 {}", digest.sha256)) }
    }
}

/// Reads the mesh of a case's housing as the housing asks for, tells which content it had, and gives it the groups of CAD
/// entities that the case names.
///
/// # Errors
/// [`ComputeError::Mesh`]; [`ComputeError::Case`] for a group that the mesh lacks.
pub(crate) fn read_mesh(case: &Case, housing: &Housing, watch: &impl Watch) -> Result<Mesh, ComputeError> {
    let path = &housing.mesh;
    let mut mesh = match case.content(path) {
        Some(content) => {
            watch.read(&FileDigest::of_bytes(path, content));
            Mesh::from_bytes(content, path, housing.length_unit)?
        }
        None => {
            let bytes = files::read(path).map_err(|cause| MeshError::Read { path: path.clone(), cause })?;
            watch.read(&FileDigest::of_bytes(path, &bytes));
            Mesh::from_bytes(bytes, path, housing.length_unit)?
        }
    };
    if housing.straighten {
        straighten(&mut mesh)?;
    }
    mesh.add_entity_groups(case.groups().into_iter().map(|(_, name)| name));
    case.check_groups(&mesh.names())?;
    Ok(mesh)
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
    let digest = |path: &&Path| match case.content(path) {
        Some(content) => Ok(FileDigest::of_bytes(path, content)),
        None => FileDigest::of_file(path).map_err(|cause| {
            let path = path.to_path_buf();
            ComputeError::from(MeshError::Read { path, cause })
        }),
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
        let case = case.with_content("a.msh", b"".as_slice().into());
        // a variant reads what is at hand too
        assert!(
            case.variants().unwrap().iter().all(|variant| variant.case.content(&folder.path().join("a.msh")).is_some())
        );
        let case = case.with_content("a.msh", b"abc".as_slice().into());
        let at_hand = mesh_digests(&case.with_content("b.msh", b"abc".as_slice().into())).unwrap();
        assert_eq!(at_hand.iter().map(|digest| digest.sha256.as_str()).collect::<Vec<_>>(), [abc, abc]);
    }
}
