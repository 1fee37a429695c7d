//! Elements of solids on standing waves in a box.

use std::f64::consts::{PI, TAU};

use super::super::structured_mesh::{BODY, StructuredMesh};
use super::{Family, series};
use crate::app::verification::section::{OrdersSummary, VerificationError};
use crate::fe::assembly::SystemMatrices;
use crate::fe::element::continuum::{Formulation, Integration, LinearFormulation};
use crate::fe::material::Material;
use crate::fe::mesh::ElementKind;
use crate::fe::modal::{ModalBasis, ModeRange};
use crate::fe::model::{HousingDescription, HousingModel, HousingPart};
use crate::numerics::linalg::EigenProblem;

/// The box, m.
const BOX: [f64; 3] = [1.0, 0.8, 0.25];
/// Cells along the edges of the coarsest mesh.
const CELLS: [usize; 3] = [4, 3, 1];
/// Young's modulus, Pa, Poisson's ratio, density, kg/m^3: any will do.
const MATERIAL: [f64; 3] = [2.5, 0.3, 1.6];
/// Modes compared: shear waves, and the pressure waves along the two longer sides.
const MODES: usize = 4;
/// Half waves along an edge that are looked at.
const HALF_WAVES: usize = 9;

/// An element, how its stiffness is formed, how often each mesh divides the coarsest, and the limit of the order.
type Row = (ElementKind, LinearFormulation, &'static [usize], f64);

const ROWS: [Row; 4] = [
    (ElementKind::Hex8, LinearFormulation::Plain, &[1, 2, 4], 0.05),
    (ElementKind::Hex8, LinearFormulation::Incompatible, &[1, 2, 4], 0.05),
    (ElementKind::Hex20, LinearFormulation::Plain, &[1, 2, 3], 0.025),
    (ElementKind::Tet10, LinearFormulation::Plain, &[1, 2, 3], 0.075),
];

/// What a size is, and its unit.
const SIZE: [&str; 2] = ["Element size", "m"];

pub(super) fn solids() -> Result<Family, VerificationError> {
    let mut all = Vec::new();
    for (kind, linear, divisions, limit) in ROWS {
        all.extend(of_element(kind, linear, divisions, limit)?);
    }
    Ok(Family {
        title: "Frequencies of solids",
        source: "Strang and Fix, An Analysis of the Finite Element Method, ch. 6: eigenvalues converge with order 2 p, p the degree. Standing waves in closed form",
        assumptions: "Box of 1 x 0.8 x 0.25 m between frictionless rigid walls. Frequencies: f = c |k| / (2 pi), k = pi (l/L, m/W, n/H). The speed c is that of shear waves and of pressure waves. Meshes of 4 x 3 x 1 cells, divided further.",
        reason: "Theory is for sizes that go to zero: 0.1 of the order with hexahedra. Six tetrahedra a cell are coarser along one diagonal and 0.3 away at three divisions, rising.",
        series: all,
    })
}

fn of_element(
    kind: ElementKind,
    linear: LinearFormulation,
    divisions: &[usize],
    limit: f64,
) -> Result<Vec<OrdersSummary>, VerificationError> {
    let exact = standing_waves()?;
    let found = divisions.iter().map(|&n| frequencies(kind, linear, n));
    let found = found.collect::<Result<Vec<_>, _>>()?;
    let incompatible = kind == ElementKind::Hex8 && linear == LinearFormulation::Incompatible;
    let name = if incompatible { "Hex8 incompatible" } else { kind.name() };
    let degree = kind.order() as f64;
    let of_mode = |mode: usize| {
        let sizes = divisions.iter().map(|&n| BOX[2] / n as f64).collect();
        let errors = found.iter().map(|found| found[mode] / exact[mode] - 1.0).collect();
        series(format!("{name}, wave {}", mode + 1), SIZE, sizes, errors, [2.0 * degree, limit])
    };
    Ok((0..MODES).map(of_mode).collect())
}

fn material() -> Result<Material, VerificationError> {
    let [young, poisson, density] = MATERIAL;
    Ok(Material::new(young, poisson, density)?)
}

/// Frequencies of standing waves in the box, Hz, rising.
fn standing_waves() -> Result<Vec<f64>, VerificationError> {
    let material = material()?;
    let mu = material.shear_modulus();
    let pressure = ((material.lame_lambda() + 2.0 * mu) / material.density).sqrt();
    let shear = (mu / material.density).sqrt();
    let mut found = Vec::new();
    for index in 1..HALF_WAVES.pow(3) {
        let count = [index % HALF_WAVES, index / HALF_WAVES % HALF_WAVES, index / HALF_WAVES.pow(2)];
        let k = (0..3).map(|i| (PI * count[i] as f64 / BOX[i]).powi(2)).sum::<f64>().sqrt();
        // u_i = A_i sin(k_i x_i) cos cos: across k, without the directions whose sine vanishes
        let shear_waves = count.iter().filter(|&&n| n > 0).count() - 1;
        found.push(pressure * k / TAU);
        found.extend(std::iter::repeat_n(shear * k / TAU, shear_waves));
    }
    found.sort_by(f64::total_cmp);
    Ok(found)
}

/// The lowest frequencies of a mesh, Hz.
fn frequencies(kind: ElementKind, linear: LinearFormulation, divisions: usize) -> Result<Vec<f64>, VerificationError> {
    let mesh = StructuredMesh::new(kind, CELLS.map(|n| n * divisions), |x| [0, 1, 2].map(|i| BOX[i] * x[i]));
    let description = HousingDescription {
        parts: vec![HousingPart { group: BODY.to_owned(), material: material()?.into() }],
        formulation: Formulation { integration: Integration::Full, linear },
        ..HousingDescription::default()
    };
    let model = HousingModel::new(&mesh.mesh, description)?;
    let matrices = SystemMatrices::assemble(&model)?;
    let mut free = model.free_dofs();
    free.retain(|dof| !mesh.is_on_face(dof / 3, dof % 3));
    let problem = EigenProblem::restricted(&matrices.stiffness, &matrices.mass, &free)?;
    Ok(ModalBasis::of(&problem, ModeRange::Count(MODES))?.frequencies_hz)
}
