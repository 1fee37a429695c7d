//! Rings and condensed housing of a case in one structure, with its sensors and its modes.
//!
//! Housing and rings of a case in full (nothing condensed): the bodies, and stiffness and mass over their free degrees of freedom.

use super::condensed::{CondensedHousing, basis_choice};
use super::damping::refuse_structural_damping;
use super::housing::AssembledHousing;
use super::in_full::RingsInHousing;
use super::kept::{Kept, OnRings};
use super::places::{Place, of_housing, of_rings};
use super::ring::{Boundary, rings_and_tie};
use crate::app::case;
use crate::app::case::{Case, Interface, ModesKept};
use crate::app::error::ComputeError;
use crate::fe::assembly::CoupledMatrices;
use crate::fe::mesh::Mesh;
use crate::fe::modal::{FullModes, ModeSet, RingShapes, mode_set};
use crate::fe::model::{HousingModel, RingTie, Rings};
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

/// Part of the target that this may be in a run whose vectors are chosen, and the most numbers that its fixed-interface modes have, ten
/// seconds' work: 300 of 13 000 degrees of freedom.
pub(crate) const LEFT_OUT_SHARE: f64 = 0.5;
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
    /// Rings and housing, in full.
    pub bodies: RingsInHousing,
    /// Number of vectors of the condensed housing's interior.
    pub fixed_interface_modes: usize,
    /// Frequency of the lowest vector of the housing's interior that was left out, Hz; of a superelement by
    /// `ImportedHousing::complete_hz`, zero where its file does not tell; infinite without a housing.
    pub complete_hz: f64,
    /// Rings and housing with the case's sensors.
    pub structure: Structure,
    /// All its modes, or the lowest ones of a ring of many nodes.
    pub modes: StructureModes,
}

impl CoupledStructure {
    /// Builds rings and housing of a case, with as many modes as it needs; `None` without a ring.
    ///
    /// # Errors
    /// [`ComputeError`] of the stages that it goes through.
    pub fn build(case: &Case, watch: &impl Watch) -> Result<Option<Self>, ComputeError> {
        case.has_rings().then(|| Self::around_rings(case, needed_modes(case), watch)).transpose()
    }

    /// What [`for_run`](Self::for_run) follows from, for cases whose files are the same: those with the same text have the same structure.
    pub(crate) fn values(case: &Case) -> Option<String> {
        let seats = case.seats();
        let rings: Vec<_> =
            seats.iter().map(|seat| (seat.ring, seat.bearing.map(|own| (&own.name, own.outer_race_radius)))).collect();
        let gravity = case.shaft.as_ref().map(|shaft| shaft.gravity);
        let basis =
            (&case.condense, case.band_or_default(), case.target(), case.transient.is_some(), needed_modes(case));
        serde_json::to_string(&(&case.housing, rings, &case.materials, &case.sensors, gravity, basis)).ok()
    }

    /// Rings and housing of a run.
    ///
    /// # Errors
    /// As [`build`](Self::build), and for structural damping, which a run does not know.
    pub(crate) fn for_run(case: &Case, watch: &impl Watch) -> Result<Self, ComputeError> {
        refuse_structural_damping(case)?;
        Self::around_rings(case, needed_modes(case), watch)
    }

    /// The same of a case with rings, with at least so many modes, if it has them.
    ///
    /// # Errors
    /// As [`build`](Self::build), and for a case without a ring.
    pub(crate) fn around_rings(case: &Case, count: usize, watch: &impl Watch) -> Result<Self, ComputeError> {
        if case.condense.interface != Interface::Ring {
            return Err(ComputeError::InterfaceOfRing);
        }
        let bodies = RingsInHousing::build(case, watch)?;
        let (bodies, housing) = OnRings::of(case, bodies, watch)?;
        let gravity = case.shaft.as_ref().map_or([0.0, -9.81], |shaft| shaft.gravity);
        let rings = bodies.rings.clone();
        let mut structure = match &housing.element {
            Some(element) => Structure::with_housing(rings, element, gravity)?,
            None => Structure::ring_alone(rings, gravity),
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

impl OnRings {
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
    fn of(case: &Case, bodies: RingsInHousing, watch: &impl Watch) -> Result<(RingsInHousing, Self), ComputeError> {
        let alone = |dof: usize, places: Vec<Place>| Self {
            element: None,
            sensors: places.iter().map(|place| place.on_rings(dof)).collect(),
            complete_hz: f64::INFINITY,
        };
        if let Some(imported) = &bodies.imported {
            let row = |sensor: &case::Sensor| imported.row(sensor.into(), &bodies.rings);
            let of_file = Self {
                sensors: case.sensors.iter().map(row).collect::<Result<_, _>>()?,
                complete_hz: imported.complete_hz(),
                element: Some(imported.element.clone()),
            };
            return Ok((bodies, of_file));
        }
        let places = bodies.sensors(case)?;
        let (housing, rings, tie) = match bodies {
            RingsInHousing { housing: Some(housing), tie: Some(tie), rings, .. } => (housing, rings, tie),
            bodies => {
                let of_rings = alone(bodies.rings.dof(), places);
                return Ok((bodies, of_rings));
            }
        };
        let boundary = Boundary::Rings(Box::new((rings, tie)));
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
            Boundary::Rings(tied) => {
                let (rings, tie) = *tied;
                let bodies = RingsInHousing { housing: Some(housing), tie: Some(tie), ..RingsInHousing::alone(rings) };
                Ok((bodies, of_mesh))
            }
            Boundary::Nodes(_) | Boundary::Centres(_) | Boundary::Both(_) => Err(ComputeError::InterfaceOfRing),
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

/// Housing and rings of a case, of which one may be missing.
pub(crate) struct Bodies {
    pub housing: Option<(Mesh, HousingModel)>,
    pub rings: Option<Rings>,
    pub tie: Option<RingTie>,
}

impl Bodies {
    /// The bodies and the matrices of all together; those of the housing alone are gone.
    ///
    /// # Errors
    /// [`ComputeError`] of mesh, model, elements, ring and tie.
    pub(crate) fn assemble(case: &Case, watch: &impl Watch) -> Result<(Self, CoupledMatrices), ComputeError> {
        if !case.has_rings() {
            let housing = AssembledHousing::of(case, watch)?;
            let matrices = CoupledMatrices::of_housing(housing.matrices, &housing.model);
            let bodies = Self { housing: Some((housing.mesh, housing.model)), rings: None, tie: None };
            return Ok((bodies, matrices));
        }
        let housing = AssembledHousing::build(case, watch)?;
        let (rings, tie) = rings_and_tie(case, housing.as_ref())?;
        watch.stage("couple");
        let matrices = match (&housing, &tie) {
            (Some(housing), Some(tie)) => CoupledMatrices::new(&housing.matrices, tie, &rings),
            _ => CoupledMatrices::of_rings(&rings),
        };
        let bodies = Self { housing: housing.map(|housing| (housing.mesh, housing.model)), rings: Some(rings), tie };
        Ok((bodies, matrices))
    }

    /// Modes at the nodes of the mesh and of the rings.
    pub(crate) fn mode_set(&self, modes: &FullModes) -> ModeSet {
        let all = modes.over_all_rows();
        let housing = self.housing.as_ref();
        let moved = housing.map(|(_, model)| modes.motions.housing(model, &all));
        let of_rings = self.rings.as_ref().map(|rings| RingShapes::of_all(rings, &modes.motions.rings(&all)));
        let housing = housing.zip(moved.as_ref()).map(|((mesh, model), moved)| (mesh, model, moved));
        mode_set(&modes.basis.frequencies_hz, housing, &of_rings.unwrap_or_default())
    }
}

/// `K x = (2 pi f)^2 M x` of a housing, of rings, or of both coupled in full (nothing condensed); its f are the case's
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
            && case.has_rings()
        {
            let bodies = RingsInHousing::around_file(case, path, watch)?;
            let matrices = bodies.matrices()?;
            let mut rows = of_rings(&bodies.rings);
            let modes = (0..(matrices.mass.rows() - rows.len()) as u64).map(DofLabel::modal);
            rows.extend(modes);
            return Ok(Self { stiffness: matrices.stiffness, mass: matrices.mass, rows });
        }
        let (bodies, matrices) = Bodies::assemble(case, watch)?;
        let mut labels = Vec::with_capacity(matrices.mass.rows());
        if let Some((_, model)) = &bodies.housing {
            labels.extend(of_housing(model, bodies.tie.as_ref()));
        }
        labels.extend(bodies.rings.iter().flat_map(of_rings));
        let free = &matrices.free_dofs;
        Ok(Self {
            stiffness: submatrix(&matrices.stiffness, free, free),
            mass: submatrix(&matrices.mass, free, free),
            rows: free.iter().map(|&dof| labels[dof]).collect(),
        })
    }
}
