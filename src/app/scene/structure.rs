//! Ring and condensed housing of a case in one structure, with its sensors and its modes.
//!
//! Housing and ring of a case in full (nothing condensed): the bodies, and stiffness and mass over their free degrees of freedom.

use super::condensed::{CondensedHousing, basis_choice};
use super::housing::AssembledHousing;
use super::in_full::RingInHousing;
use super::kept::{Kept, OnRing};
use super::places::{Place, of_housing, of_ring};
use super::ring::{Boundary, ring_and_tie};
use crate::app::case;
use crate::app::case::{Case, Interface, ModesKept};
use crate::app::error::ComputeError;
use crate::fe::assembly::CoupledMatrices;
use crate::fe::mesh::Mesh;
use crate::fe::modal::{FullModes, ModeSet, RingShapes, mode_set};
use crate::fe::model::{HousingModel, Ring, RingFrame, RingTie};
use crate::fe::reduction::{BasisChoice, BasisSize, CraigBampton, Superelement};
use crate::formats::DofLabel;
use crate::numerics::Watch;
use crate::numerics::linalg::{SparseMatrix, submatrix};
use crate::system::{Formulation, Sensor, Structure, StructureModes};
use std::f64::consts::TAU;
use std::time::Instant;

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
    /// Ring and housing, in full.
    pub bodies: RingInHousing,
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
        if case.condense.interface != Interface::Ring {
            return Err(ComputeError::InterfaceOfRing);
        }
        let bodies = RingInHousing::build(case, asked, watch)?;
        let (bodies, housing) = OnRing::of(case, bodies, watch)?;
        let gravity = case.shaft.as_ref().map_or([0.0, -9.81], |shaft| shaft.gravity);
        let ring = bodies.ring.clone();
        let mut structure = match &housing.element {
            Some(element) => Structure::with_housing(ring, element, gravity)?,
            None => Structure::ring_alone(ring, gravity),
        };
        for (sensor, row) in case.sensors.iter().zip(housing.sensors) {
            structure.add_sensor(Sensor { name: sensor.name.clone(), row })?;
        }
        watch.stage("eigen");
        Ok(Self {
            modes: structure.lowest_modes(count)?,
            fixed_interface_modes: housing.element.as_ref().map_or(0, Superelement::modal_dof),
            complete_hz: housing.complete_hz,
            bodies,
            structure,
        })
    }
}

impl OnRing {
    fn of_mesh(condensed: CraigBampton, places: &[Place]) -> Self {
        Self {
            sensors: places.iter().map(|place| place.reduced(&condensed)).collect(),
            complete_hz: condensed.basis.complete_below.sqrt() / TAU,
            element: Some(Superelement { structural: None, ..condensed.superelement }),
        }
    }

    /// Condenses the housing, if it is of a mesh and not kept from an earlier computation, and hands the bodies back.
    ///
    /// # Errors
    /// [`ComputeError`] of sensors and reduction.
    fn of(case: &Case, bodies: RingInHousing, watch: &impl Watch) -> Result<(RingInHousing, Self), ComputeError> {
        let alone = |dof: usize, places: Vec<Place>| Self {
            element: None,
            sensors: places.iter().map(|place| place.on_ring(dof)).collect(),
            complete_hz: f64::INFINITY,
        };
        if let Some(imported) = &bodies.imported {
            let row = |sensor: &case::Sensor| imported.row(sensor.into(), &bodies.ring);
            let of_file = Self {
                sensors: case.sensors.iter().map(row).collect::<Result<_, _>>()?,
                complete_hz: imported.complete_hz(),
                element: Some(imported.element.clone()),
            };
            return Ok((bodies, of_file));
        }
        let places = bodies.sensors(case)?;
        let (housing, ring, tie) = match bodies {
            RingInHousing { housing: Some(housing), tie: Some(tie), ring, .. } => (housing, ring, tie),
            bodies => {
                let of_ring = alone(bodies.ring.dof(), places);
                return Ok((bodies, of_ring));
            }
        };
        let boundary = Boundary::Ring(Box::new((ring, tie)));
        let choice = run_basis(case);
        let kept = Kept::of(&boundary.matrices(&housing), &boundary, choice, &places, watch);
        let (housing, boundary, of_mesh) = match kept.as_ref().and_then(|kept| kept.read(watch)) {
            Some(found) => (housing, boundary, found),
            None => {
                let begun = Instant::now();
                let stage = CondensedHousing::on(housing, boundary, choice, watch)?;
                let of_mesh = Self::of_mesh(stage.condensed, &places);
                kept.iter().for_each(|kept| kept.write(&of_mesh, begun.elapsed(), watch));
                (stage.housing, stage.boundary, of_mesh)
            }
        };
        match boundary {
            Boundary::Ring(on_ring) => {
                let (ring, tie) = *on_ring;
                let bodies = RingInHousing { housing: Some(housing), tie: Some(tie), ..RingInHousing::alone(ring) };
                Ok((bodies, of_mesh))
            }
            Boundary::Nodes(_) => Err(ComputeError::InterfaceOfRing),
        }
    }
}

/// The basis of a run: of frequencies above the band too, and of as many as the contacts need where the case leaves it to the program.
fn run_basis(case: &Case) -> BasisChoice {
    let asked = basis_choice(case);
    BasisChoice {
        band_hz: MODELLED * asked.band_hz,
        size: match (wanted_hz(case), &case.transient) {
            (Some(wanted_hz), Some(_)) => BasisSize::AtMost(wanted_hz, MOST_NUMBERS),
            _ => asked.size,
        },
        ..asked
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
            let bodies = RingInHousing::around_file(case, asked, path, watch)?;
            let matrices = bodies.matrices()?;
            let mut rows = of_ring(&bodies.ring, &bodies.frame());
            let modes = (0..(matrices.mass.rows() - rows.len()) as u64).map(DofLabel::modal);
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
