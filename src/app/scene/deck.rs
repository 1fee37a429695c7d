//! Input files of Abaqus and CalculiX: what they say of materials, against the case, and advice where gmsh cannot read them.

use crate::app::case::{Case, Material};
use crate::fe::mesh::{ConsistentUnits, Mesh, MshVersion};
use crate::report::significant;

/// Difference of modulus or density that is told, relative.
const DIFFERENT: f64 = 0.01;

/// Parts of the case whose material is not that of the mesh file, and a length in another unit than the file's materials show.
pub(super) fn doubts(case: &Case, mesh: &Mesh) -> Vec<String> {
    let Some(housing) = case.meshed_housing() else { return Vec::new() };
    let mut found = Vec::new();
    for part in &housing.parts {
        let said = mesh.notes.material_of(&part.group);
        let Some((said, law)) = said.and_then(|said| Some((said, said.other_law.as_ref()?))) else { continue };
        if let Some(Material::Isotropic(_)) = case.material(&part.material) {
            found.push(format!(
                "part \"{}\": {} of the mesh file has {law}, {} of the case is isotropic",
                part.group, said.name, part.material
            ));
        }
    }
    let Some(units) = ConsistentUnits::of(&mesh.notes.materials) else { return found };
    let source = mesh.source.display();
    if units.length != housing.length_unit {
        let [own, given] = [units.length, housing.length_unit].map(|unit| unit.symbol());
        found.push(format!(
            "{source}: the materials of this file are in {}, a length in {own}, and housing.length_unit is \"{given}\"",
            units.name
        ));
    }
    for part in &housing.parts {
        let said = mesh.notes.material_of(&part.group);
        let Some((said, [young, _, density])) = said.and_then(|said| Some((said, units.to_si(said)?))) else {
            continue;
        };
        let Some(Material::Isotropic(given)) = case.material(&part.material) else { continue };
        let differs = |own: f64, other: f64| (own / other - 1.0).abs() >= DIFFERENT;
        if differs(given.young, young) || differs(given.density, density) {
            let words = |young: f64, density: f64| {
                format!("{} GPa and {} kg/m^3", significant(1e-9 * young, 4), significant(density, 4))
            };
            found.push(format!(
                "part \"{}\": {} of the mesh file has {}, {} of the case {}",
                part.group,
                said.name,
                words(young, density),
                part.material,
                words(given.young, given.density)
            ));
        }
    }
    found
}

/// How elements of second order are made.
pub(super) fn second_order(mesh: &Mesh) -> &'static str {
    match mesh.format.version {
        MshVersion::Inp => "C3D10, C3D15 or C3D20 in the program that wrote the file",
        _ => "gmsh IN.msh -3 -order 2 -o OUT.msh",
    }
}

/// How nodes in the same place are merged.
pub(super) fn merge_nodes(mesh: &Mesh) -> &'static str {
    match mesh.format.version {
        MshVersion::Inp => "in the program that wrote the file",
        _ => "echo 'Merge \"IN.msh\"; Coherence Mesh;' > x.geo; gmsh x.geo -save -o OUT.msh",
    }
}
