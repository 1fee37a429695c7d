//! The three frequencies of every reading on a grid.

use crate::choices::{
    ContactSource, Equations, FACTORS, Grid, Levels, RingBond, STRUCTURE_FACTORS, SpringArc, Springs,
};
use crate::paper::{BOUNCE, Failure, SWAY, TABLE_ONE, beam_case, outside_of_ring};
use crate::shapes::{ByShape, NamedMotions, ShapeShares};
use plummer::app::scene::bearing_setup;
use plummer::bearing::{ContactMaterial, ContactStiffness, RaceContacts};
use plummer::fe::element::curved_beam::RingInterpolation;
use plummer::fe::material::{BeamSection, Bond, Material, RadiusRule, RingLayer};
use plummer::fe::model::{RadialSupport, Ring, RingSupport, SpringShare};
use plummer::numerics::linalg::DenseMatrix;
use plummer::system::{
    BearingSetup, Equilibrium, Formulation, LoadedModes, LoadedShapes, StaticCondition, Structure, StructureModes,
};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Ring nodes, as the paper has them.
const NODES: usize = 72;

/// Stiffness of each spring, N/m: the paper's.
const SPRING: f64 = 1e5;

/// Part of it that radial springs have along the ring: they would leave the ring free to turn. It moves the other modes by
/// half as much relatively.
const HELD: f64 = 1e-5;

/// The structure's modes up to here stand for themselves, those above by their static response, Hz.
const KEPT_HZ: f64 = 300e3;

/// One reading and its frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReadingResult {
    /// Its choices.
    pub levels: Levels,
    /// Modes nearest to the paper's three, Hz.
    pub nearest_hz: [f64; 3],
    /// The same by mode shape, Hz.
    pub by_shape: ByShape,
    /// Shapes of the nearest three.
    pub shapes: [ShapeShares; 3],
}

/// All readings of a grid.
#[derive(Debug, Clone)]
pub struct Study {
    /// The values tried.
    pub grid: Grid,
    /// Readings in the order of the grid.
    pub readings: Vec<ReadingResult>,
    /// Readings without an equilibrium.
    pub without_equilibrium: usize,
}

/// What all readings share.
pub struct SharedBearing {
    pub setup: BearingSetup,
    geometry: ContactStiffness,
    table_one: ContactStiffness,
}

impl Study {
    /// Computes every reading of `grid`, on as many threads as there are.
    ///
    /// # Errors
    /// What stops a structure from being built. A reading without an equilibrium is counted, not an error.
    pub fn compute(grid: Grid) -> Result<Self, Failure> {
        let bearing = SharedBearing::new()?;
        let parts: Vec<Vec<Option<ReadingResult>>> = grid
            .structures()
            .par_iter()
            .map(|levels| bearing.readings_of(&grid, levels))
            .collect::<Result<_, Failure>>()?;
        let all = parts.into_iter().flatten();
        let readings: Vec<ReadingResult> = all.flatten().collect();
        Ok(Self { without_equilibrium: grid.readings() - readings.len(), grid, readings })
    }
}

impl SharedBearing {
    pub fn new() -> Result<Self, Failure> {
        let setup = bearing_setup(&beam_case(&[])?)?.ok_or("the built-in case has no bearing")?;
        let [inner, outer] = TABLE_ONE;
        Ok(Self { geometry: hertz(&setup, 206e9)?, table_one: ContactStiffness::given(inner, outer)?, setup })
    }

    /// All readings of one structure, in the order of the grid; `None`: no equilibrium.
    fn readings_of(&self, grid: &Grid, structure_levels: &Levels) -> Result<Vec<Option<ReadingResult>>, Failure> {
        let ring = ring(grid, structure_levels)?;
        let structure = Structure::ring_alone(ring, self.setup.gravity);
        let modes = structure.modes()?;
        let mut bases = Vec::with_capacity(grid.cages.len());
        for &place in &grid.cages {
            bases.push(self.basis(&structure, &modes, place)?);
        }
        let ring_steel = hertz(&self.setup, grid.steel[structure_levels[6]])?;
        let mut found = Vec::with_capacity(grid.bearings().len());
        for bearing in grid.bearings() {
            let mut levels = *structure_levels;
            levels[STRUCTURE_FACTORS..FACTORS].copy_from_slice(&bearing[STRUCTURE_FACTORS..]);
            let (basis, motions) = &bases[levels[11]];
            let setup = BearingSetup {
                formulation: match grid.equations[levels[8]] {
                    Equations::Printed => Formulation::Printed,
                    Equations::Consistent => Formulation::Consistent,
                },
                stiffness: match grid.contacts[levels[9]] {
                    ContactSource::Geometry => self.geometry,
                    ContactSource::TableOne => self.table_one,
                    ContactSource::RingSteel => ring_steel,
                },
                ..self.setup.clone()
            };
            let condition = self.condition(grid.cages[levels[11]]);
            let condition = condition.loaded(grid.loads[levels[10]]);
            let Ok(rest) = Equilibrium::find(&structure, &setup, condition) else {
                found.push(None);
                continue;
            };
            let shapes = LoadedShapes::at(&structure, basis, &setup, &rest)?;
            found.push(result(levels, &shapes, motions));
        }
        Ok(found)
    }

    /// Cage at `place` between two balls symmetric about the load (0) and one under it (1), at rest.
    pub fn condition(&self, place: f64) -> StaticCondition {
        let at_rest = StaticCondition::at(&self.setup, 0.0);
        let spacing = TAU / f64::from(self.setup.geometry.balls());
        StaticCondition { cage_angle: 1.5 * PI + 0.5 * spacing * (1.0 - place), ..at_rest }
    }

    /// Modes that a bearing at this cage angle needs.
    pub fn basis(
        &self,
        structure: &Structure,
        modes: &StructureModes,
        place: f64,
    ) -> Result<(StructureModes, NamedMotions), Failure> {
        let balls = self.setup.balls();
        let condition = self.condition(place);
        let mut loads = DenseMatrix::zeros(structure.dof(), balls);
        for ball in 0..balls {
            let angle = self.setup.cage.ball_angle(condition.cage_angle, ball as u32);
            let (sin, cos) = angle.sin_cos();
            for (dof, factor) in structure.ring().displacement_row(angle, [cos, sin, 0.0]) {
                loads[(dof, ball)] += factor;
            }
        }
        let basis = modes.with_static_response(structure, KEPT_HZ, &loads)?;
        let motions = NamedMotions::new(structure, &basis);
        Ok((basis, motions))
    }
}

/// `None` for a reading without any mode.
fn result(levels: Levels, shapes: &LoadedShapes, motions: &NamedMotions) -> Option<ReadingResult> {
    let numbers = [
        nearest(&shapes.modes, |hz| (hz - SWAY).abs())?,
        nearest(&shapes.modes, |hz| (hz - BOUNCE).abs())?,
        nearest(&shapes.modes, |hz| outside_of_ring(hz).abs())?,
    ];
    Some(ReadingResult {
        levels,
        nearest_hz: numbers.map(|number| shapes.modes.modes[number].frequency_hz),
        by_shape: motions.by_shape(shapes),
        shapes: numbers.map(|number| motions.shares(shapes, number)),
    })
}

/// The mode with the smallest distance that is not a ball's own; of several at the same distance the lowest.
pub fn nearest(loaded: &LoadedModes, distance: impl Fn(f64) -> f64) -> Option<usize> {
    let own = loaded.modes.iter().enumerate().filter(|(_, mode)| !mode.is_ball_mode());
    own.min_by(|(_, a), (_, b)| distance(a.frequency_hz).total_cmp(&distance(b.frequency_hz))).map(|(number, _)| number)
}

/// Contact stiffness from Table 1's radii in steel of this modulus, Pa.
fn hertz(setup: &BearingSetup, young: f64) -> Result<ContactStiffness, Failure> {
    let steel = ContactMaterial { young, poisson: 0.3 };
    Ok(RaceContacts::new(&setup.geometry, steel, steel, steel)?.stiffness())
}

/// Both rings as one beam on its springs.
pub fn ring(grid: &Grid, levels: &Levels) -> Result<Ring, Failure> {
    let width = grid.widths[levels[0]];
    let layer = |young, poisson, density, [area, inertia, radius]: [f64; 3]| {
        Ok::<_, Failure>(RingLayer {
            material: Material::new(young, poisson, density)?,
            area,
            inertia,
            axial_inertia: None,
            torsion: None,
            radius,
            shear_coefficient: 5.0 / 6.0,
        })
    };
    let layers = [
        // Table 1
        layer(grid.steel[levels[6]], 0.3, 7850.0, [5.37e-6, 8.88e-13, 5.314e-3])?,
        // 3 mm thick: radii 6 to 9 mm
        layer(grid.aluminium[levels[7]], 0.33, 2700.0, [3e-3 * width, width * 27e-9 / 12.0, 7.5e-3])?,
    ];
    let bond = match grid.bonds[levels[3]] {
        RingBond::OwnRadius => Bond::Slip(RadiusRule::Own),
        RingBond::CommonCentroid => Bond::Slip(RadiusRule::CommonCentroid),
        RingBond::Composite => Bond::Composite,
    };
    let mut section = BeamSection::combine(&layers, bond)?;
    if !grid.shear[levels[4]] {
        section = section.without_shear();
    }
    if !grid.rotary_inertia[levels[5]] {
        section = section.without_rotary_inertia();
    }
    let mut ring = Ring::new(NODES, section, RingInterpolation::ExactArc)?;
    let from = PI;
    let to = match grid.arcs[levels[2]] {
        SpringArc::HalfOpen => TAU,
        // half a node further
        SpringArc::Closed => TAU + PI / NODES as f64,
    };
    let at = |radius: f64| RingSupport {
        from,
        to,
        spring: [SPRING, SPRING, 0.0],
        share: SpringShare::PerNode,
        offset: radius - section.radius,
    };
    match grid.springs[levels[1]] {
        Springs::CommonNodes => ring.add_support(&at(section.radius))?,
        Springs::CentreLine => ring.add_support(&at(7.5e-3))?,
        Springs::Outside => ring.add_support(&at(9e-3))?,
        Springs::Radial => {
            ring.add_radial_support(&RadialSupport { from, to, radial: SPRING, tangential: HELD * SPRING })?
        }
    }
    Ok(ring)
}

/// Whether the mode nearest to a frequency is the one that has its shape.
pub fn agrees(nearest_hz: f64, by_shape: Option<f64>) -> bool {
    by_shape.is_some_and(|hz| (hz / nearest_hz - 1.0).abs() < 1e-9)
}
