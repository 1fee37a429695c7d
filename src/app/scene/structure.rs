//! Ring and condensed housing of a case in one structure, with its sensors, its modes, and its modes in full.
//!
//! Housing and ring of a case in full (nothing condensed): the bodies, and stiffness and mass over their free degrees of freedom.

use super::condensed::{CondensedHousing, basis_choice};
use super::housing::AssembledHousing;
use super::imported::ImportedHousing;
use super::places::{Place, PlaceBodies, Spot, of_housing, of_ring};
use super::ring::{Boundary, ring, ring_and_tie};
use crate::app::case;
use crate::app::case::{Case, Interface, ModesKept};
use crate::app::error::ComputeError;
use crate::fe::assembly::CoupledMatrices;
use crate::fe::mesh::Mesh;
use crate::fe::modal::{FullModes, ModalSurvey, ModeRange, ModeSet, RingShapes, mode_set};
use crate::fe::model::{HousingModel, Ring, RingFrame, RingTie};
use crate::fe::reduction::{BasisChoice, BasisSize};
use crate::formats::DofLabel;
use crate::numerics::Watch;
use crate::numerics::linalg::{SparseMatrix, submatrix};
use crate::system::{Formulation, Sensor, Structure, StructureModes};
use std::f64::consts::TAU;

/// Modes of a ring of many nodes where a part of them is enough: as many as a ring of 72 nodes in a solid housing has of its own.
const LOWEST: usize = 432;

/// Frequencies up to so many times the band take part in a run: contact shakes ring and housing above the band too.
pub(crate) const MODELLED: f64 = 3.0;

/// What a run errs by at a frequency f where the housing's vectors are complete up to g, over `(f / g)^3`. Contacts strike at frequencies far
/// above the band, and the housing answers there with the vectors that it has. The first 2.4 ms of a dented bearing in a plate err by 0.12,
/// 0.022, 0.0032 and 0.0003 for g of 3, 5, 10 and 20 times the band (formula: 0.12, 0.026, 0.0032, 0.0004), 2.5 ms in the end shield of
/// `examples/housings` by 0.24 and 0.007 for 2.3 and 7.9 times (0.26, 0.0065). Preloaded bearings err by less.
const LEFT_OUT: f64 = 3.2;

/// Part of the target that this may be in a run whose vectors are chosen, and the most numbers that they have, ten seconds' work: 300
/// vectors of 13 000 degrees of freedom.
const LEFT_OUT_SHARE: f64 = 0.5;
pub(crate) const MOST_NUMBERS: usize = 4_000_000;

/// The relative error of a run in the band up to `band_hz` by the vectors of its housing that were left out, all above `complete_hz`.
pub(crate) fn left_out(band_hz: f64, complete_hz: f64) -> f64 {
    (LEFT_OUT * (band_hz / complete_hz).powi(3)).min(1.0)
}

/// Up to which frequency a housing's vectors have to be complete for [`left_out`] to be this error, Hz.
pub(crate) fn complete_for(band_hz: f64, error: f64) -> f64 {
    band_hz * (LEFT_OUT / error).cbrt()
}

/// Frequency up to which a run's housing has all its vectors by the target; `None` where the case says how many.
pub(crate) fn wanted_hz(case: &Case) -> Option<f64> {
    let BasisChoice { size: BasisSize::Auto(target), band_hz, .. } = basis_choice(case) else {
        return None;
    };
    Some(complete_for(band_hz, LEFT_OUT_SHARE * target).max(MODELLED * band_hz))
}

/// The linear model of a case.
#[derive(Debug, Clone)]
pub struct CoupledStructure {
    /// The housing, if the case has one.
    pub housing: Option<AssembledHousing>,
    /// The superelement that stands for the housing, if the case has one.
    pub imported: Option<Box<ImportedHousing>>,
    /// How the ring sits in the housing, if there is one.
    pub tie: Option<RingTie>,
    /// Number of vectors of the condensed housing's interior.
    pub fixed_interface_modes: usize,
    /// Frequency of the lowest vector of the housing's interior that was left out, Hz; of a superelement by
    /// `ImportedHousing::complete_hz`, zero where its file does not tell; infinite without a housing.
    pub complete_hz: f64,
    /// Ring and housing with the case's sensors.
    pub structure: Structure,
    /// All its modes, or the lowest ones of a ring of many nodes.
    pub modes: StructureModes,
}

impl CoupledStructure {
    /// Builds ring and housing of a case, with as many modes as it needs; `None` without a ring.
    ///
    /// # Errors
    /// [`ComputeError`] of the stages that it goes through.
    pub fn build(case: &Case, watch: &impl Watch) -> Result<Option<Self>, ComputeError> {
        let ring = case.ring.as_ref();
        ring.map(|asked| Self::around_ring(case, asked, needed_modes(case), watch)).transpose()
    }

    /// The same around the ring that is asked for, with at least so many modes, if it has them.
    ///
    /// # Errors
    /// As [`build`](Self::build).
    pub(crate) fn around_ring(
        case: &Case,
        asked: &case::Ring,
        count: usize,
        watch: &impl Watch,
    ) -> Result<Self, ComputeError> {
        let gravity = case.shaft.as_ref().map_or([0.0, -9.81], |shaft| shaft.gravity);
        if case.condense.interface != Interface::Ring {
            return Err(ComputeError::InterfaceOfRing);
        }
        if let Some(path) = case.superelement() {
            watch.stage("read");
            let (imported, ring) = ImportedHousing::read(case, asked, path)?;
            imported.accept()?;
            let structure = Structure::with_housing(ring, &imported.element, gravity)?;
            let row = |spot| imported.row(spot, structure.ring());
            let rows = sensor_rows(case, row)?;
            return Ok(Self {
                fixed_interface_modes: imported.element.modal_dof(),
                complete_hz: imported.complete_hz(),
                imported: Some(Box::new(imported)),
                ..Self::solved(structure, case, rows, count, watch)?
            });
        }
        let asked_basis = basis_choice(case);
        let choice = BasisChoice {
            band_hz: MODELLED * asked_basis.band_hz,
            size: match (wanted_hz(case), &case.transient) {
                (Some(wanted_hz), Some(_)) => BasisSize::AtMost(wanted_hz, MOST_NUMBERS),
                _ => asked_basis.size,
            },
            ..asked_basis
        };
        let Some(stage) = CondensedHousing::with_basis(case, choice, watch)? else {
            let structure = Structure::ring_alone(ring(case, asked, false)?, gravity);
            let bodies = PlaceBodies::of_ring(structure.ring(), RingFrame::default());
            let rows = sensor_rows(case, |spot| Ok(Place::new(bodies, spot)?.on_ring(structure.dof())))?;
            return Self::solved(structure, case, rows, count, watch);
        };
        let rows = sensor_rows(case, |spot| Ok(Place::new(stage.bodies(), spot)?.reduced(&stage.condensed)))?;
        let CondensedHousing { housing, boundary, condensed, .. } = stage;
        let Boundary::Ring(bodies) = boundary else {
            return Err(ComputeError::InterfaceOfRing);
        };
        let (ring, tie) = *bodies;
        let structure = Structure::with_housing(ring, &condensed.superelement, gravity)?;
        Ok(Self {
            housing: Some(housing),
            tie: Some(tie),
            fixed_interface_modes: condensed.basis.count(),
            complete_hz: condensed.basis.complete_below.sqrt() / TAU,
            ..Self::solved(structure, case, rows, count, watch)?
        })
    }

    /// A structure with its sensors' rows and so many modes, nothing said of its housing.
    fn solved(
        mut structure: Structure,
        case: &Case,
        rows: Vec<Vec<f64>>,
        modes: usize,
        watch: &impl Watch,
    ) -> Result<Self, ComputeError> {
        for (sensor, row) in case.sensors.iter().zip(rows) {
            structure.add_sensor(Sensor { name: sensor.name.clone(), row })?;
        }
        watch.stage("eigen");
        Ok(Self {
            modes: structure.lowest_modes(modes)?,
            housing: None,
            imported: None,
            tie: None,
            fixed_interface_modes: 0,
            complete_hz: f64::INFINITY,
            structure,
        })
    }

    /// Mesh and model of the housing, if it is of a mesh.
    pub(crate) fn mesh_and_model(&self) -> Option<(&Mesh, &HousingModel)> {
        self.housing.as_ref().map(|housing| (&housing.mesh, &housing.model))
    }

    /// Modes of a ring, in a housing if the case has one.
    ///
    /// # Errors
    /// [`ComputeError`] of eigenvalue computation and analysis.
    pub(crate) fn survey(&self, extent: ModeRange, watch: &impl Watch) -> Result<ModalSurvey, ComputeError> {
        let ring = self.structure.ring();
        Ok(match (&self.housing, &self.tie) {
            (Some(AssembledHousing { mesh, model, matrices }), Some(tie)) => {
                ModalSurvey::of_coupled((mesh, model, matrices), tie, ring, extent, watch)?
            }
            _ if self.imported.is_some() => self.survey_of_imported(extent, watch)?,
            _ => ModalSurvey::of_ring(ring, extent, watch)?,
        })
    }

    /// Of a superelement from a file there are frequencies, their proof and the ring's motion.
    fn survey_of_imported(&self, range: ModeRange, watch: &impl Watch) -> Result<ModalSurvey, ComputeError> {
        let ring = self.structure.ring();
        let modes = FullModes::of(self.full_matrices(), range, None, watch)?;
        let of_ring = modes.motions.ring(&modes.over_all_rows());
        Ok(ModalSurvey {
            ring: Some(RingShapes::new(ring, &self.frame(), &of_ring)),
            ..ModalSurvey::without_mass(self.structure.dof(), modes.free_dof(), modes.basis)
        })
    }

    /// Matrices of a ring, in a housing if the case has one: in full, or as a superelement has them.
    pub(crate) fn full_matrices(&self) -> CoupledMatrices {
        let structure = &self.structure;
        let ring = structure.ring();
        match (&self.housing, &self.tie) {
            (Some(housing), Some(tie)) => CoupledMatrices::new(&housing.matrices, tie, ring),
            _ if self.imported.is_some() => {
                CoupledMatrices::of_condensed(structure.stiffness(), structure.mass(), ring.dof())
            }
            _ => CoupledMatrices::of_ring(ring),
        }
    }

    /// Where the bearing sits in the mesh's axes; a ring alone has none but its own.
    pub(crate) fn frame(&self) -> RingFrame {
        match (&self.housing, &self.imported) {
            (Some(housing), _) => *housing.model.frame(),
            (None, Some(imported)) => imported.frame,
            (None, None) => RingFrame::default(),
        }
    }
}

/// How many modes a case asks for: the printed equations and the source's method take all.
pub(crate) fn needed_modes(case: &Case) -> usize {
    let bearing = case.bearing.as_ref();
    let transient = case.transient.as_ref();
    let source = transient.is_some_and(|asked| asked.method == case::Method::NewmarkExplicit);
    if source || bearing.is_some_and(|bearing| bearing.formulation == Formulation::Printed) {
        return usize::MAX;
    }
    match transient.map(|asked| asked.modes) {
        Some(ModesKept::All) => usize::MAX,
        Some(ModesKept::Count(count)) => count.max(LOWEST),
        Some(ModesKept::Auto) | None => LOWEST,
    }
}

/// Rows of the case's sensors over the coordinates of a structure, each by `row`.
fn sensor_rows<'c>(
    case: &'c Case,
    row: impl Fn(Spot<'c>) -> Result<Vec<f64>, ComputeError>,
) -> Result<Vec<Vec<f64>>, ComputeError> {
    case.sensors.iter().map(|sensor| row(sensor.into())).collect()
}

/// Housing and ring of a case, of which one may be missing.
pub(crate) struct Bodies {
    pub housing: Option<(Mesh, HousingModel)>,
    pub ring: Option<Ring>,
    pub tie: Option<RingTie>,
}

impl Bodies {
    /// The bodies and the matrices of all together; those of the housing alone are gone.
    ///
    /// # Errors
    /// [`ComputeError`] of mesh, model, elements, ring and tie.
    pub(crate) fn assemble(case: &Case, watch: &impl Watch) -> Result<(Self, CoupledMatrices), ComputeError> {
        let Some(asked) = &case.ring else {
            let housing = AssembledHousing::of(case, watch)?;
            let matrices = CoupledMatrices::of_housing(housing.matrices, &housing.model);
            let bodies = Self { housing: Some((housing.mesh, housing.model)), ring: None, tie: None };
            return Ok((bodies, matrices));
        };
        let housing = AssembledHousing::build(case, watch)?;
        let (ring, tie) = ring_and_tie(case, asked, housing.as_ref())?;
        watch.stage("couple");
        let matrices = match (&housing, &tie) {
            (Some(housing), Some(tie)) => CoupledMatrices::new(&housing.matrices, tie, &ring),
            _ => CoupledMatrices::of_ring(&ring),
        };
        let bodies = Self { housing: housing.map(|housing| (housing.mesh, housing.model)), ring: Some(ring), tie };
        Ok((bodies, matrices))
    }

    /// Modes at the nodes of the mesh and of the ring.
    pub(crate) fn mode_set(&self, modes: &FullModes) -> ModeSet {
        let all = modes.over_all_rows();
        let housing = self.housing.as_ref();
        let moved = housing.map(|(_, model)| modes.motions.housing(model, &all));
        let of_ring = self.ring.as_ref().map(|ring| RingShapes::new(ring, &self.frame(), &modes.motions.ring(&all)));
        let housing = housing.zip(moved.as_ref()).map(|((mesh, model), moved)| (mesh, model, moved));
        mode_set(&modes.basis.frequencies_hz, housing, of_ring.as_ref())
    }

    /// Where the ring sits: in the mesh's axes, or in its own.
    pub(crate) fn frame(&self) -> RingFrame {
        let housing = self.housing.as_ref();
        housing.map_or_else(RingFrame::default, |(_, model)| *model.frame())
    }
}

/// `K x = (2 pi f)^2 M x` of a housing, of a ring, or of both coupled in full (nothing condensed); its f are the case's
/// eigenfrequencies.
///
/// Rows that are fixed, or that a tie or a link drives, are left out: their share is with what drives them.
#[derive(Debug, Clone)]
pub struct FreeSystem {
    /// Stiffness with springs [n x n], N/m (N for a displacement against a rotation, N m for two rotations).
    pub stiffness: SparseMatrix,
    /// Mass with point masses [n x n], kg (kg m, kg m^2).
    pub mass: SparseMatrix,
    /// What each row is \[n\].
    pub rows: Vec<DofLabel>,
}

impl FreeSystem {
    /// Assembles the matrices of a case; nothing is factorised.
    ///
    /// # Errors
    /// [`ComputeError`] of mesh, model, elements, ring and tie.
    pub(crate) fn build(case: &Case, watch: &impl Watch) -> Result<Self, ComputeError> {
        if let Some(path) = case.superelement()
            && let Some(asked) = &case.ring
        {
            watch.stage("read");
            let (imported, ring) = ImportedHousing::read(case, asked, path)?;
            imported.accept()?;
            let structure = Structure::with_housing(ring, &imported.element, [0.0; 2])?;
            let (k, m) = (structure.stiffness(), structure.mass());
            let matrices = CoupledMatrices::of_condensed(k, m, structure.ring().dof());
            let modes = (0..imported.element.modal_dof() as u64).map(DofLabel::modal);
            let mut rows = of_ring(structure.ring(), &imported.frame);
            rows.extend(modes);
            return Ok(Self { stiffness: matrices.stiffness, mass: matrices.mass, rows });
        }
        let (bodies, matrices) = Bodies::assemble(case, watch)?;
        let mut labels = Vec::with_capacity(matrices.mass.rows());
        if let Some((_, model)) = &bodies.housing {
            labels.extend(of_housing(model, bodies.tie.as_ref()));
        }
        if let Some(ring) = &bodies.ring {
            labels.extend(of_ring(ring, &bodies.frame()));
        }
        let free = &matrices.free_dofs;
        Ok(Self {
            stiffness: submatrix(&matrices.stiffness, free, free),
            mass: submatrix(&matrices.mass, free, free),
            rows: free.iter().map(|&dof| labels[dof]).collect(),
        })
    }
}
