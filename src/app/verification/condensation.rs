//! A housing condensed onto a ring against the model that it was condensed from.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use super::beams::ring_of;
use super::section::{Check, Kind, SectionResult, VerificationError};
use crate::fe::assembly::{CoupledMatrices, SystemMatrices};
use crate::fe::element::continuum::PlaneAssumption;
use crate::fe::material::Material;
use crate::fe::mesh::Mesh;
use crate::fe::model::{
    Constraint, Fit, HousingDescription, HousingModel, HousingPart, HousingSupport, PlaneModel, Ring, RingTie,
    SpringStiffness, SupportShare,
};
use crate::fe::reduction::{BasisChoice, BasisSize, Superelement, craig_bampton};
use crate::numerics::linalg::{DenseMatrix, EigenProblem, SparseCholesky, SparseMatrix, submatrix};
use crate::numerics::units::LengthUnit;
use crate::system::Structure;

/// Title of the section.
const TITLE: &str = "Condensation";
/// Weight, m/s^2; what the structure is given, and nothing here depends on.
const GRAVITY: [f64; 2] = [0.0, -9.81];
/// Radius of the bore and outside of the annulus, m.
const RADII: [f64; 2] = [6e-3, 9e-3];
/// Thickness of the annulus, m.
const WIDTH: f64 = 4e-3;

/// An aluminium annulus as a mesh, tied to a steel ring of 72 beams.
struct Housing {
    model: HousingModel,
    ring: Ring,
    tie: RingTie,
    /// In the displacements that the tie's partition uses.
    matrices: SystemMatrices,
}

impl Housing {
    fn new(supported: bool) -> Result<Self, VerificationError> {
        let bytes = include_bytes!("../../../meshes/ring_6_9.msh");
        let mesh = Mesh::from_gmsh_bytes(bytes, Path::new("ring_6_9.msh"), LengthUnit::Millimetre)?;
        let springs = HousingSupport {
            group: "lower".to_owned(),
            constraint: Constraint::Spring(SpringStiffness::Global([3.6e6, 3.6e6, 0.0])),
            share: SupportShare::PerGroup,
        };
        let description = HousingDescription {
            parts: vec![HousingPart {
                group: "housing".to_owned(),
                material: Material::new(72e9, 0.33, 2700.0)?.into(),
            }],
            plane: Some(PlaneModel { assumption: PlaneAssumption::Stress, thickness: WIDTH }),
            supports: if supported { vec![springs] } else { Vec::new() },
            ..HousingDescription::default()
        };
        let model = HousingModel::new(&mesh, description)?;
        let ring = ring_of(72, Material::new(206e9, 0.3, 7850.0)?, [5.37e-6, 8.88e-13, 5.314e-3])?;
        let tie = RingTie::new(&mesh, &model, "bore", &ring, RADII[0], Fit::Bonded)?;
        let matrices = SystemMatrices::assemble(&model)?.for_tie(&tie);
        Ok(Self { model, ring, tie, matrices })
    }

    fn superelement(&self, fixed_interface_modes: usize) -> Result<Superelement, VerificationError> {
        let choice = BasisChoice { size: BasisSize::Count(fixed_interface_modes), enhanced: false, band_hz: 40e3 };
        let condensed = craig_bampton(&self.matrices, self.tie.partition(), choice, None)?;
        Ok(condensed.superelement)
    }

    fn structure(&self, fixed_interface_modes: usize) -> Result<Structure, VerificationError> {
        let element = self.superelement(fixed_interface_modes)?;
        Ok(Structure::with_housing(self.ring.clone(), &element, GRAVITY)?)
    }

    /// Ring and housing without any reduction: (K, M) over ring displacements, then interior ones.
    fn full(&self) -> Result<(SparseMatrix, SparseMatrix), VerificationError> {
        let matrices = SystemMatrices::assemble(&self.model)?;
        let coupled = CoupledMatrices::new(&matrices, &self.tie, &self.ring.clone().into());
        let first = coupled.stiffness.rows() - self.ring.dof();
        let (interior, ring): (Vec<usize>, Vec<usize>) = coupled.free_dofs.iter().partition(|&&dof| dof < first);
        let order = [ring, interior].concat();
        let part = |whole: &SparseMatrix| submatrix(whole, &order, &order);
        Ok((part(&coupled.stiffness), part(&coupled.mass)))
    }
}

/// Carries the section out.
///
/// # Errors
/// [`VerificationError`] if a model cannot be computed.
pub(super) fn condensation() -> Result<SectionResult, VerificationError> {
    let held = Housing::new(true)?;
    let (k, m) = held.full()?;
    let mut checks = frequencies(&held, &k, &m)?;
    checks.push(statics(&held, &k)?);
    checks.extend(mass()?);
    Ok(SectionResult::of_checks(TITLE, checks))
}

const MODEL: &str = "Aluminium annulus 6-9 mm of Quad8, 4 mm wide, bonded to a steel ring of 72 beams";

fn frequencies(housing: &Housing, k: &SparseMatrix, m: &SparseMatrix) -> Result<Vec<Check>, VerificationError> {
    let full = EigenProblem::new(k, m)?.lowest(6)?;
    let reduced = housing.structure(100)?.modes()?;
    let assumptions = format!("{MODEL}, on springs; 100 fixed-interface modes.");
    let kind = Kind {
        unit: "Hz",
        source: "the model that is not reduced, through the same tie",
        assumptions: &assumptions,
        reason: "What the modes left out are worth: 1e-5 below 150 kHz.",
    };
    let rows = full.values.iter().enumerate();
    Ok(rows
        .map(|(mode, value)| {
            let name = format!("Condensed housing, mode {}", mode + 1);
            kind.check(&name, reduced.frequency_hz(mode), value.sqrt() / TAU, 1e-4)
        })
        .collect())
}

/// Displacement under a radial unit force.
fn statics(housing: &Housing, k: &SparseMatrix) -> Result<Check, VerificationError> {
    let rows = housing.ring.rows_at(1.1);
    let load = |dof: usize| {
        let mut load = DenseMatrix::zeros(dof, 1);
        for (&row, factor) in rows.dofs.iter().zip(rows.radial) {
            load[(row, 0)] += factor;
        }
        load
    };
    let mut full = load(k.rows());
    SparseCholesky::new(k)?.solve_columns(&mut full)?;
    let structure = housing.structure(0)?;
    let reduced = structure.static_response(&load(structure.dof()))?;
    let at =
        |x: &DenseMatrix| -> f64 { rows.dofs.iter().zip(rows.radial).map(|(&row, factor)| factor * x[(row, 0)]).sum() };
    let assumptions = format!("{MODEL}, on springs. No fixed-interface mode; radial force of 1 N at 63 degrees.");
    let kind = Kind {
        unit: "m",
        source: "the model that is not reduced, through the same tie",
        assumptions: &assumptions,
        reason: "Static response of the interface is exact: rounding times the condition of K is left.",
    };
    Ok(kind.check("Condensed housing: static displacement", at(&reduced), at(&full), 1e-9))
}

fn mass() -> Result<Vec<Check>, VerificationError> {
    let free = Housing::new(false)?;
    let element = free.superelement(10)?;
    let weigh = |x: f64, y: f64| {
        let mut motion = free.ring.rigid_motion(x, y, 0.0);
        motion.resize(element.order(), 0.0);
        let motion = DenseMatrix::from_fn(motion.len(), 1, |row, _| motion[row]);
        (motion.transpose() * &element.mass * &motion)[(0, 0)]
    };
    let drawn = PI * (RADII[1].powi(2) - RADII[0].powi(2)) * WIDTH * 2700.0;
    let assumptions = format!("{MODEL}, free. 10 fixed-interface modes; mass in a rigid translation.");
    let kind = |source, reason| Kind { unit: "kg", source, assumptions: &assumptions, reason };
    let own =
        kind("the mesh's own mass", "Constraint modes carry rigid motions to rounding times the condition of K_ii.");
    let geometry = kind("closed form: rho pi (r_o^2 - r_i^2) w", "Parabolas in the place of arcs: 2e-5 of the area.");
    let mesh = free.matrices.total_mass();
    Ok(vec![
        own.check("Condensed housing: mass along x", weigh(1.0, 0.0), mesh, 1e-10),
        own.check("Condensed housing: mass along y", weigh(0.0, 1.0), mesh, 1e-10),
        geometry.check("Mass of the annulus", mesh, drawn, 5e-5),
    ])
}
