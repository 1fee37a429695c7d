//! Ring and condensed housing of a case in one structure, with its sensors and modes.

use super::boundary::Boundary;
use super::condensed::{CondensedHousing, basis_choice};
use super::housing::AssembledHousing;
use super::imported::ImportedHousing;
use super::places::{Named, Place, PlaceBodies};
use super::ring::ring;
use crate::app::case::{self, Case, Interface, ModesKept};
use crate::app::error::ComputeError;
use crate::fe::model::{RingFrame, RingTie};
use crate::fe::reduction::{BasisChoice, BasisSize};
use crate::numerics::Watch;
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
const MOST_NUMBERS: usize = 4_000_000;

/// The relative error of a run in the band up to `band_hz` by the vectors of its housing that were left out, all above `complete_hz`.
pub(crate) fn left_out(band_hz: f64, complete_hz: f64) -> f64 {
    (LEFT_OUT * (band_hz / complete_hz).powi(3)).min(1.0)
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
    /// [`ImportedHousing::complete_hz`]; infinite without a housing.
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
        Self::with_modes(case, needed_modes(case), watch)
    }

    /// The same with at least so many modes, if it has them.
    ///
    /// # Errors
    /// As [`build`](Self::build).
    pub(crate) fn with_modes(case: &Case, count: usize, watch: &impl Watch) -> Result<Option<Self>, ComputeError> {
        let ring = case.ring.as_ref();
        ring.map(|asked| Self::around_ring(case, asked, count, watch)).transpose()
    }

    /// The same around the ring that is asked for.
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
            let mut structure = Structure::with_housing(ring, &imported.element, gravity)?;
            let rows = imported.sensor_rows(case, structure.ring())?;
            add_sensors(&mut structure, &case.sensors, rows)?;
            let around = Around::Imported(Box::new(imported));
            return Self::solved(structure, around, count, watch);
        }
        let asked_basis = basis_choice(case);
        let choice = BasisChoice {
            band_hz: MODELLED * asked_basis.band_hz,
            size: match (asked_basis.size, &case.transient) {
                (BasisSize::Auto(target), Some(_)) => {
                    let over_band = (LEFT_OUT / (LEFT_OUT_SHARE * target)).cbrt();
                    BasisSize::AtMost(over_band.max(MODELLED) * asked_basis.band_hz, MOST_NUMBERS)
                }
                (size, _) => size,
            },
            ..asked_basis
        };
        let Some(stage) = CondensedHousing::with_basis(case, choice, watch)? else {
            let ring = ring(case, asked, false)?;
            let mut structure = Structure::ring_alone(ring, gravity);
            let bodies =
                PlaceBodies { housing: None, ring: Some(structure.ring()), tie: None, frame: RingFrame::default() };
            let mut rows = Vec::with_capacity(case.sensors.len());
            for sensor in &case.sensors {
                let name = Named::Sensor(&sensor.name);
                let place = Place::new(bodies, name, &sensor.spot, sensor.direction)?;
                rows.push(place.on_ring(structure.dof()));
            }
            add_sensors(&mut structure, &case.sensors, rows)?;
            return Self::solved(structure, Around::Nothing, count, watch);
        };
        let mut rows = Vec::with_capacity(case.sensors.len());
        for sensor in &case.sensors {
            rows.push(stage.place_of(sensor)?.reduced(&stage.condensed));
        }
        let complete_hz = stage.condensed.basis.complete_below().sqrt() / TAU;
        let CondensedHousing { housing, boundary, condensed, .. } = stage;
        let Boundary::Ring(bodies) = boundary else {
            return Err(ComputeError::InterfaceOfRing);
        };
        let (ring, tie) = *bodies;
        let mut structure = Structure::with_housing(ring, &condensed.superelement, gravity)?;
        add_sensors(&mut structure, &case.sensors, rows)?;
        let around = Around::Housing(Box::new((housing, tie, condensed.basis.count())));
        let solved = Self::solved(structure, around, count, watch)?;
        Ok(Self { complete_hz, ..solved })
    }

    fn solved(structure: Structure, around: Around, modes: usize, watch: &impl Watch) -> Result<Self, ComputeError> {
        watch.stage("eigen");
        let mut stage = Self {
            modes: structure.lowest_modes(modes)?,
            housing: None,
            imported: None,
            tie: None,
            fixed_interface_modes: 0,
            complete_hz: f64::INFINITY,
            structure,
        };
        match around {
            Around::Nothing => {}
            Around::Imported(imported) => {
                stage.fixed_interface_modes = imported.element.modal_dof();
                stage.complete_hz = imported.complete_hz().max(f64::MIN_POSITIVE);
                stage.imported = Some(imported);
            }
            Around::Housing(parts) => {
                let (housing, tie, count) = *parts;
                (stage.housing, stage.tie) = (Some(housing), Some(tie));
                stage.fixed_interface_modes = count;
            }
        }
        Ok(stage)
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

/// What is around a ring.
enum Around {
    Nothing,
    /// A housing, the tie to it, and the number of vectors of its interior.
    Housing(Box<(AssembledHousing, RingTie, usize)>),
    Imported(Box<ImportedHousing>),
}

fn add_sensors(structure: &mut Structure, sensors: &[case::Sensor], rows: Vec<Vec<f64>>) -> Result<(), ComputeError> {
    for (sensor, row) in sensors.iter().zip(rows) {
        structure.add_sensor(Sensor { name: sensor.name.clone(), row })?;
    }
    Ok(())
}
