//! Whole housings, from the gmsh file to frequencies, against published benchmarks and another program.

use std::path::Path;

use serde_json::Value;

use super::section::{Check, Kind, SectionResult, VerificationError};
use crate::app::error::ComputeError;
use crate::fe::assembly::SystemMatrices;
use crate::fe::element::continuum::{Formulation, Integration, LinearFormulation, PlaneAssumption};
use crate::fe::material::Material;
use crate::fe::mesh::Mesh;
use crate::fe::modal::{ModeRange, housing_modes};
use crate::fe::model::{
    Constraint, HousingDescription, HousingModel, HousingPart, HousingSupport, PlaneModel, SupportShare,
};
use crate::numerics::units::LengthUnit;

/// Title of the section.
const TITLE: &str = "Whole housings";

/// Frequencies of another program and of an assembly in NumPy, by mesh and conditions.
const FREQUENCIES: &str = include_str!("../../../tests/data/frequencies.json");

/// A mesh that is part of the program, and how it is held.
struct Model {
    mesh: &'static [u8],
    material: [f64; 3],
    /// Thickness of a plane one in plane stress, m.
    thickness: Option<f64>,
    /// Group that is fixed, and in which directions.
    fixed: Option<(&'static str, [bool; 3])>,
}

const FV32: Model = Model {
    mesh: include_bytes!("../../../tests/data/fv32_quad8.msh"),
    material: [200e9, 0.3, 8000.0],
    thickness: Some(0.05),
    fixed: Some(("root", [true; 3])),
};
const FV52: Model = Model {
    mesh: include_bytes!("../../../tests/data/fv52_hex20_4x4x1.msh"),
    material: [200e9, 0.3, 8000.0],
    thickness: None,
    fixed: Some(("bottom_edges", [false, false, true])),
};
const PILLOW_BLOCK: Model = Model {
    mesh: include_bytes!("../../../tests/data/pedestal_10k.msh"),
    material: [70e9, 0.33, 2700.0],
    thickness: None,
    fixed: Some(("feet", [true; 3])),
};
const ANNULUS: Model = Model {
    mesh: include_bytes!("../../../tests/data/ring2d_quad8.msh"),
    material: [70e9, 0.33, 2700.0],
    thickness: Some(4e-3),
    fixed: None,
};
const SDLS109: Model = Model {
    mesh: include_bytes!("../../../tests/data/sdls109_ring.msh"),
    material: [185e9, 0.3, 7800.0],
    thickness: None,
    fixed: None,
};

/// Carries the section out.
///
/// # Errors
/// [`VerificationError`] if a model cannot be computed.
pub(super) fn housings() -> Result<SectionResult, VerificationError> {
    let pillow_block = other_program("Pillow block", "pedestal_10k", "feet", &PILLOW_BLOCK);
    let annulus = other_program("Annulus", "ring2d_quad8", "free", &ANNULUS);
    Ok(SectionResult::of_checks(TITLE, [fv32()?, fv52()?, pillow_block?, annulus?, sdls109()?].concat()))
}

/// The lowest elastic frequencies, Hz, integrated as the other programs do.
fn elastic(model: &Model, count: usize) -> Result<Vec<f64>, VerificationError> {
    let mesh = Mesh::from_gmsh_bytes(model.mesh, Path::new("built-in mesh"), LengthUnit::Metre)?;
    let [young, poisson, density] = model.material;
    // the group that holds all elements of the highest dimension
    let body = mesh.groups.iter().max_by_key(|group| (group.dimension, group.elements.len()));
    let supports = model.fixed.map(|(group, components)| HousingSupport {
        group: group.to_owned(),
        constraint: Constraint::Fixed(components),
        share: SupportShare::PerNode,
    });
    let description = HousingDescription {
        parts: vec![HousingPart {
            group: body.map_or_else(String::new, |group| group.name.clone()),
            material: Material::new(young, poisson, density)?.into(),
        }],
        plane: model.thickness.map(|thickness| PlaneModel { assumption: PlaneAssumption::Stress, thickness }),
        formulation: Formulation { integration: Integration::FourPoint, linear: LinearFormulation::Plain },
        supports: supports.into_iter().collect(),
        ..HousingDescription::default()
    };
    let housing = HousingModel::new(&mesh, description)?;
    let matrices = SystemMatrices::assemble(&housing)?;
    let modes = housing_modes(&housing, matrices, ModeRange::Count(count + 6)).map_err(ComputeError::from)?;
    let elastic = modes.frequencies_hz.into_iter().skip(modes.rigid_modes);
    Ok(elastic.take(count).collect())
}

/// A check of each frequency, named by `what` and its number from 1.
fn in_order(
    kind: Kind,
    what: &str,
    found: impl IntoIterator<Item = f64>,
    expected: impl IntoIterator<Item = f64>,
    limit: f64,
) -> Vec<Check> {
    let rows = (1..).zip(found.into_iter().zip(expected));
    rows.map(|(number, (found, hz))| kind.check(&format!("{what} {number}"), found, hz, limit)).collect()
}

fn fv32() -> Result<Vec<Check>, VerificationError> {
    let published = [44.623, 130.03, 162.70, 246.05, 379.90, 391.44];
    let kind = Kind {
        unit: "Hz",
        source: "NAFEMS FV32 (secondary source)",
        assumptions: "Tapered membrane, 16 x 8 Quad8, plane stress, root held; 200 GPa, 0.3, 8000 kg/m^3.",
        reason: "Four to five published digits: 5e-5.",
    };
    Ok(in_order(kind, "FV32, mode", elastic(&FV32, published.len())?, published, 5e-5))
}

fn fv52() -> Result<Vec<Check>, VerificationError> {
    let published = [44.762, 110.52, 110.52, 169.08, 193.93, 206.64, 206.64];
    let kind = Kind {
        unit: "Hz",
        source: "NAFEMS FV52 for this mesh (secondary source)",
        assumptions: "Thick plate, 4 x 4 x 1 Hex20, u_z held on the four lower edges; 200 GPa, 0.3, 8000 kg/m^3. Not the usual target of 45.897 Hz, which is thin-plate theory.",
        reason: "The published values are integrated with fewer points, which is softer: up to 7.6e-4.",
    };
    Ok(in_order(kind, "FV52, mode", elastic(&FV52, published.len())?, published, 1e-3))
}

/// The first five elastic frequencies against CalculiX's, as it prints them.
fn other_program(name: &str, mesh: &str, condition: &str, model: &Model) -> Result<Vec<Check>, VerificationError> {
    let all: Value = serde_json::from_str(FREQUENCIES).unwrap_or_default();
    let mut entries = all.as_array().into_iter().flatten();
    let entry = entries.find(|entry| entry["mesh"] == mesh && entry["bc"] == condition);
    // the assembly's, which CalculiX confirms to 4e-6 where both integrate alike
    let given = entry.and_then(|entry| entry["exact_quadrature_hz"].as_array());
    let given = given.into_iter().flatten().filter_map(Value::as_f64);
    let given = given.filter(|hz| *hz > 1.0).take(5);
    let kind = Kind {
        unit: "Hz",
        source: "an independent assembly in NumPy with shift-invert ARPACK (tests/data/frequencies.json); CalculiX 2.20 agrees with it to 4e-6",
        assumptions: "The same mesh and material; Tet10 with four points, as the reference.",
        reason: "The same matrices, two eigensolvers; pairs that the geometry makes equal are split by the mesh: 1e-5.",
    };
    Ok(in_order(kind, &format!("{name}, mode"), elastic(model, 5)?, given, 1e-5))
}

fn sdls109() -> Result<Vec<Check>, VerificationError> {
    let elasticity = [205.127, 209.998, 586.290, 586.948];
    let kind = Kind {
        unit: "Hz",
        source: "three-dimensional elasticity by Fourier series and Legendre polynomials; code_aster's test SDLS109 publishes values of linear elements, 0.3 % above",
        assumptions: "Thick free ring, mean radius 0.369 m, section 48 x 50 mm, 64 x 3 x 3 Hex20; 185 GPa, 0.3, 7800 kg/m^3. The first of each pair.",
        reason: "The mesh's own error: 1.5e-4 to 5.5e-4 above, out-of-plane pairs most.",
    };
    let found = elastic(&SDLS109, 8)?;
    let pairs = found.chunks_exact(2).map(|pair| pair[0]);
    Ok(in_order(kind, "SDLS109, pair", pairs, elasticity, 8e-4))
}
