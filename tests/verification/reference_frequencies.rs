//! Reference: CalculiX 2.20 and, independently, a NumPy assembly with shift-invert ARPACK, which agree to
//!   2e-7..4e-6 where they integrate alike; tests/data/frequencies.json holds both. FV32 and FV52 are NAFEMS
//!   benchmarks: their published values (secondary sources) are checked mesh for mesh.
//! Goal: mesh import, element matrices, assembly and eigenvalues of a whole housing, element by element.
//! Sketch: annulus 6-9 mm, plane and solid; pillow block of tet10, some of them curved; tapered membrane (FV32);
//!   thick plate held on its four bottom edges (FV52).
//! Conditions: free, root fixed, feet fixed, u_z = 0 on the edges.
//! Parameters: in the file, beside the frequencies.
//!
//! Limits: 1e-6 relative, 1e-5 for pairs that the geometry makes equal and the mesh splits; both programs integrate
//! the same matrices, what remains is the eigensolvers' rounding. Rigid modes: right in number and below 1e-5 of
//! the first elastic one. The reference integrates Tet10 and Tri6 stiffness with the rule for straight sides (4 and
//! 3 points): on curved elements the full rules differ, by what `full_integration_of_curved_elements` states.
//! Trap: gmsh's node order of tet10 and hex20 is its own; CalculiX's "plane stress" is a 3D layer.

use plummer::fe::assembly::SystemMatrices;
use plummer::fe::element::continuum::{Formulation, Integration, LinearFormulation, PlaneAssumption};
use plummer::fe::material::Material;
use plummer::fe::mesh::Mesh;
use plummer::fe::modal::{ModeRange, housing_modes};
use plummer::fe::model::{
    Constraint, HousingDescription, HousingModel, HousingPart, HousingSupport, PlaneModel, SupportShare,
};
use plummer::numerics::units::LengthUnit;
use std::path::{Path, PathBuf};

/// Frequencies of a mesh as published with it.
struct Reference {
    young: f64,
    poisson: f64,
    density: f64,
    thickness: Option<f64>,
    mass: f64,
    hz: Vec<f64>,
}

/// A file of tests/data.
pub fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

fn reference(mesh: &str, condition: &str) -> Reference {
    let text = std::fs::read_to_string(data("frequencies.json")).unwrap();
    let all: serde_json::Value = serde_json::from_str(&text).unwrap();
    let entry = all.as_array().unwrap().iter().find(|entry| entry["mesh"] == mesh && entry["bc"] == condition).unwrap();
    let material = &entry["material"];
    let hz = entry["exact_quadrature_hz"].as_array().unwrap().iter();
    Reference {
        young: material["E"].as_f64().unwrap(),
        poisson: material["nu"].as_f64().unwrap(),
        density: material["rho"].as_f64().unwrap(),
        thickness: material["thickness"].as_f64(),
        mass: entry["mass_kg"].as_f64().unwrap(),
        hz: hz.map(|value| value.as_f64().unwrap()).collect(),
    }
}

/// What the reference fixes: group and components.
fn supports(condition: &str) -> Vec<HousingSupport> {
    let fixed = |group: &str, components| HousingSupport {
        group: group.to_owned(),
        constraint: Constraint::Fixed(components),
        share: SupportShare::PerNode,
    };
    match condition {
        "root" => vec![fixed("root", [true; 3])],
        "feet" => vec![fixed("feet", [true; 3])],
        "fv52" => vec![fixed("bottom_edges", [false, false, true])],
        _ => Vec::new(),
    }
}

/// The group that holds all elements of the highest dimension.
fn body(mesh: &Mesh) -> String {
    let largest = mesh.groups.iter().max_by_key(|group| (group.dimension, group.elements.len()));
    largest.unwrap().name.clone()
}

fn model(file: &str, unit: LengthUnit, condition: &str, formulation: Formulation) -> HousingModel {
    let name = file.trim_end_matches("_mm").trim_end_matches("_bin").trim_end_matches("_v22");
    let given = reference(name, condition);
    let mesh = Mesh::read_gmsh(&data(&format!("{file}.msh")), unit).unwrap();
    let material = Material::new(given.young, given.poisson, given.density).unwrap();
    // the plane annulus is 4 mm thick, which no frequency depends on
    let solid = mesh.blocks.iter().any(|block| block.kind.dimension() == 3);
    let plane = (!solid)
        .then(|| PlaneModel { assumption: PlaneAssumption::Stress, thickness: given.thickness.unwrap_or(4e-3) });
    let description = HousingDescription {
        parts: vec![HousingPart { group: body(&mesh), material: material.into() }],
        plane,
        formulation,
        supports: supports(condition),
        ..HousingDescription::default()
    };
    HousingModel::new(&mesh, description).unwrap()
}

/// As the reference integrates: plain linear elements, Tet10 stiffness with four points.
const AS_REFERENCE: Formulation = Formulation { integration: Integration::FourPoint, linear: LinearFormulation::Plain };

/// Relative differences of the elastic modes, after the number of rigid ones was checked.
fn differences(file: &str, unit: LengthUnit, condition: &str, formulation: Formulation) -> Vec<f64> {
    let name = file.trim_end_matches("_mm").trim_end_matches("_bin").trim_end_matches("_v22");
    let given = reference(name, condition);
    let model = model(file, unit, condition, formulation);
    let matrices = SystemMatrices::assemble(&model).unwrap();
    let mass_error = matrices.total_mass() / given.mass - 1.0;
    assert!(mass_error.abs() < 1e-12, "{file}: mass {mass_error:e}");
    let modes = housing_modes(&model, matrices, ModeRange::Count(given.hz.len())).unwrap();
    let first_elastic = given.hz.iter().position(|hz| *hz > 1.0).unwrap();
    assert_eq!(modes.rigid_modes, first_elastic, "{file} {condition}");
    for value in &modes.eigenvalues[..first_elastic] {
        let ratio = (value.abs() / modes.eigenvalues[first_elastic]).sqrt();
        assert!(ratio < 1e-5, "{file}: rigid mode at {ratio:e} of the first elastic one");
    }
    let pairs = modes.frequencies_hz.iter().zip(&given.hz).skip(first_elastic);
    pairs.map(|(found, hz)| found / hz - 1.0).collect()
}

/// Whether the reference has another frequency within 1e-5 of this one.
fn in_a_pair(hz: &[f64], mode: usize) -> bool {
    let near = |other: usize| (hz[other] / hz[mode] - 1.0).abs() < 1e-5;
    (mode > 0 && near(mode - 1)) || (mode + 1 < hz.len() && near(mode + 1))
}

fn agrees(file: &str, unit: LengthUnit, condition: &str, formulation: Formulation) {
    let name = file.trim_end_matches("_mm").trim_end_matches("_bin").trim_end_matches("_v22");
    let hz = reference(name, condition).hz;
    let found = differences(file, unit, condition, formulation);
    let first = hz.len() - found.len();
    for (place, difference) in found.iter().enumerate() {
        let mode = first + place;
        let limit = if in_a_pair(&hz, mode) { 1e-5 } else { 1e-6 };
        assert!(
            difference.abs() < limit,
            "{file} {condition}: mode {} at {} Hz differs by {difference:e}",
            mode + 1,
            hz[mode]
        );
    }
    let largest = found.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    println!("{file} {condition}: largest difference {largest:.2e}");
}

macro_rules! reference_meshes {
    ($($test:ident: $file:literal, $unit:ident, $condition:literal;)*) => {
        $(#[test]
        fn $test() {
            agrees($file, LengthUnit::$unit, $condition, AS_REFERENCE);
        })*
    };
}

reference_meshes! {
    fv32_quad8: "fv32_quad8", Metre, "root";
    fv32_tri6: "fv32_tri6", Metre, "root";
    fv52_hex20_4x4x1: "fv52_hex20_4x4x1", Metre, "fv52";
    fv52_hex20_10x10x2: "fv52_hex20_10x10x2", Metre, "fv52";
    pedestal_10k_feet: "pedestal_10k", Metre, "feet";
    pedestal_10k_free: "pedestal_10k", Metre, "free";
    pedestal_10k_binary: "pedestal_10k_bin", Metre, "feet";
    pedestal_10k_millimetres: "pedestal_10k_mm", Millimetre, "feet";
    pedestal_60k_feet: "pedestal_60k", Metre, "feet";
    pedestal_60k_free: "pedestal_60k", Metre, "free";
    ring2d_quad8: "ring2d_quad8", Metre, "free";
    ring2d_tri6: "ring2d_tri6", Metre, "free";
    ring2d_quad4: "ring2d_quad4_coarse", Metre, "free";
    ring3d_hex20: "ring3d_hex20", Metre, "free";
    ring3d_hex20_binary: "ring3d_hex20_bin", Metre, "free";
    ring3d_hex20_msh22: "ring3d_hex20_v22", Metre, "free";
    ring3d_hex8: "ring3d_hex8", Metre, "free";
    ring3d_tet10: "ring3d_tet10", Metre, "free";
    ring3d_tet4: "ring3d_tet4", Metre, "free";
}

/// Full integration of curved Tet10 is stiffer than four points, by less than 5e-4 on these meshes.
#[test]
fn full_integration_of_curved_elements() {
    for (file, condition) in [("pedestal_10k", "feet"), ("pedestal_10k", "free"), ("ring3d_tet10", "free")] {
        let full = Formulation { integration: Integration::Full, ..AS_REFERENCE };
        let found = differences(file, LengthUnit::Metre, condition, full);
        let largest = found.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
        println!("{file} {condition}: full integration differs by up to {largest:.2e}");
        assert!(largest < 5e-4, "{file}: {largest:e}");
        assert!(largest > 1e-6, "{file}: the rules should differ, {largest:e}");
    }
}

/// FV32 as published (secondary source): 44.623, 130.03, 162.70, 246.05, 379.90, 391.44 Hz, 16 x 8 Quad8.
#[test]
fn fv32_published() {
    published("fv32_quad8", "root", &[44.623, 130.03, 162.70, 246.05, 379.90, 391.44], 5e-5);
}

/// FV52 as published for 4 x 4 x 1 hex20 (secondary source). Trap: the usual target, 45.897 Hz, is thin-plate
/// theory; a solid held on lines softens without end under refinement (43.563 Hz with 10 x 10 x 2). The published
/// 44.762 Hz is 7.6e-4 below the exactly integrated 44.796 (reduced integration is softer).
#[test]
fn fv52_published_mesh_for_mesh() {
    let published_hz = [44.762, 110.52, 110.52, 169.08, 193.93, 206.64, 206.64];
    published("fv52_hex20_4x4x1", "fv52", &published_hz, 1e-3);
}

fn published(file: &str, condition: &str, hz: &[f64], limit: f64) {
    let model = model(file, LengthUnit::Metre, condition, AS_REFERENCE);
    let matrices = SystemMatrices::assemble(&model).unwrap();
    let modes = housing_modes(&model, matrices, ModeRange::Count(hz.len() + 3)).unwrap();
    let rigid = modes.rigid_modes;
    for (found, hz) in modes.frequencies_hz[rigid..].iter().zip(hz) {
        assert!((found / hz - 1.0).abs() < limit, "{file}: {found}, published {hz}");
    }
}
