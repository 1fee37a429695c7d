//! Eigenfrequencies with the contacts' stiffness at a static equilibrium.
//!
//! Loaded eigenfrequencies as the balls go round, and under more or less load.

use super::equilibrium::contact_rows;
use super::resting::RestingRaces;
use super::{BearingSetup, Equilibrium, Formulation, StaticCondition, Structure, StructureModes, SystemError};
use crate::numerics::Watch;
use crate::numerics::linalg::{DenseMatrix, GeneralSpectrum, general_spectrum, symmetric_eigen};
use faer::c64;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Serialize, Serializer};
use std::f64::consts::TAU;
use std::ops::Range;

/// One mode of the loaded system.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct LoadedMode {
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Share of ring and housing in the kinetic energy.
    pub structure_share: f64,
    /// Share of the shaft.
    pub shaft_share: f64,
    /// Share of the balls.
    pub ball_share: f64,
    /// Damping over critical; absent where damping is not in the equations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping_ratio: Option<f64>,
    /// How the shaft goes round: 1 with its rotation on a circle, -1 against it, 0 on a line; absent for a shaft that does not turn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub whirl: Option<f64>,
}

/// Modes of ring, housing, shaft and balls, linearised at an equilibrium.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LoadedModes {
    /// Modes with a positive frequency, ascending.
    pub modes: Vec<LoadedMode>,
    /// Balls that touch nothing or one race without load: modes without stiffness, left out.
    pub without_stiffness: usize,
    /// Eigenvalues with an imaginary part above 1e-6 of their size, or negative beyond round-off:
    /// not a stable equilibrium, or a formulation that is not conservative.
    pub unstable: usize,
}

/// Loaded modes with their shapes.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedShapes {
    /// The modes.
    pub modes: LoadedModes,
    /// For each of them the amplitudes of the structure's modes, of the shaft's x and y and of the balls, to one scale.
    pub amplitudes: Vec<Vec<f64>>,
}

impl LoadedModes {
    /// Linearises at `equilibrium`. With `consistent` equations the problem is symmetric; the
    /// `printed` ones couple the balls to the mean ring acceleration and need a general solver. Where the structure has more
    /// than these modes, its static response under the balls stands for the others.
    ///
    /// # Errors
    /// What the eigenvalue computation reports.
    pub fn at(
        structure: &Structure,
        modes: &StructureModes,
        setup: &BearingSetup,
        equilibrium: &Equilibrium,
    ) -> Result<Self, SystemError> {
        if !modes.has_more {
            return Ok(LoadedShapes::at(structure, modes, setup, equilibrium)?.modes);
        }
        let angles: Vec<f64> = equilibrium.balls.iter().map(|ball| ball.angle).collect();
        let loads = contact_rows(structure, setup, &angles);
        let basis = modes.with_static_response(structure, f64::INFINITY, &loads)?;
        Ok(LoadedShapes::at(structure, &basis, setup, equilibrium)?.modes)
    }

    /// The mode nearest to a frequency (Hz) among those that are not the balls' own.
    pub fn nearest(&self, hz: f64) -> Option<&LoadedMode> {
        let distance = |mode: &&LoadedMode| (mode.frequency_hz - hz).abs();
        self.modes.iter().filter(|mode| !mode.is_ball_mode()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }
}

impl LoadedShapes {
    /// As [`LoadedModes::at`], with the shapes. `modes` may be fewer than the structure's own.
    ///
    /// # Errors
    /// As [`LoadedModes::at`].
    pub fn at(
        structure: &Structure,
        modes: &StructureModes,
        setup: &BearingSetup,
        equilibrium: &Equilibrium,
    ) -> Result<Self, SystemError> {
        let (matrix, masses) = linearised(structure, modes, setup, equilibrium);
        let (n, order) = (modes.count(), masses.len());
        let root = |i: usize| masses[i].sqrt();
        // rows and columns of one size
        let scaled = |i: usize, j: usize| matrix[(i, j)] * root(i) / root(j);
        let pairs: Vec<(c64, Vec<f64>)> = match setup.formulation {
            Formulation::Consistent => {
                let symmetric = DenseMatrix::from_fn(order, order, |i, j| 0.5 * (scaled(i, j) + scaled(j, i)));
                let spectrum = symmetric_eigen(&symmetric)?;
                let vector = |pair: usize| spectrum.vectors.col_as_slice(pair).to_vec();
                (0..order).map(|pair| (c64::new(spectrum.values[pair], 0.0), vector(pair))).collect()
            }
            Formulation::Printed => {
                let spectrum = general_spectrum(&DenseMatrix::from_fn(order, order, scaled))?;
                (0..order).map(|pair| (spectrum.values[pair], real_part(&spectrum, pair))).collect()
            }
        };
        // contacts of 1e6 N/m make 1e10 1/s^2; what is a million times softer is not held
        let held = 1e4;
        let mut found = Vec::new();
        let (mut without_stiffness, mut unstable) = (0, 0);
        for (value, vector) in pairs {
            if value.re.abs() < held {
                without_stiffness += 1;
            } else if value.re < 0.0 || value.im.abs() > 1e-6 * value.re.abs() {
                unstable += 1;
            } else {
                let amplitudes: Vec<f64> = vector.iter().enumerate().map(|(i, entry)| entry / root(i)).collect();
                let energy = |range: Range<usize>| -> f64 { range.map(|i| amplitudes[i].powi(2) * masses[i]).sum() };
                let total = energy(0..order);
                let mode = LoadedMode {
                    frequency_hz: value.re.sqrt() / TAU,
                    structure_share: energy(0..n) / total,
                    shaft_share: energy(n..n + 2) / total,
                    ball_share: energy(n + 2..order) / total,
                    damping_ratio: None,
                    whirl: None,
                };
                found.push((mode, amplitudes));
            }
        }
        found.sort_by(|(a, _), (b, _)| a.frequency_hz.total_cmp(&b.frequency_hz));
        let (modes, amplitudes) = found.into_iter().unzip();
        Ok(Self { modes: LoadedModes { modes, without_stiffness, unstable }, amplitudes })
    }
}

impl LoadedMode {
    /// Whether more than half of the kinetic energy is in the balls.
    pub fn is_ball_mode(&self) -> bool {
        self.ball_share > 0.5
    }
}

/// Stiffness over (modes, shaft, balls), rows divided by the mass of their coordinate [n x n], and these masses, kg; 1 for a mode.
fn linearised(
    structure: &Structure,
    modes: &StructureModes,
    setup: &BearingSetup,
    equilibrium: &Equilibrium,
) -> (DenseMatrix, Vec<f64>) {
    let (count, balls) = (modes.count(), setup.balls());
    let order = count + 2 + balls;
    let printed = setup.formulation == Formulation::Printed;
    // mean ring displacement by mode; zero unless the formulation uses it
    let mean = |mode: usize| if printed { structure.ring_mean(&modes.shapes, mode) } else { [0.0; 2] };
    let centre: Vec<[f64; 2]> = (0..count).map(mean).collect();
    let k = stiffness(structure, modes, setup, equilibrium, &centre);
    let mut masses = vec![1.0; count];
    masses.extend([setup.shaft.mass; 2]);
    masses.extend(vec![setup.geometry.ball_mass(); balls]);
    let mut matrix = DenseMatrix::from_fn(order, order, |i, j| k[(i, j)] / masses[i]);
    if printed {
        // s'' + e . centre'' = ...: take the centre's acceleration to the right-hand side
        let accelerations = DenseMatrix::from_fn(2, order, |component, column| {
            (0..count).map(|mode| centre[mode][component] * matrix[(mode, column)]).sum()
        });
        for (j, ball) in equilibrium.balls.iter().enumerate() {
            let (sin, cos) = ball.angle.sin_cos();
            for column in 0..order {
                matrix[(count + 2 + j, column)] -= cos * accelerations[(0, column)] + sin * accelerations[(1, column)];
            }
        }
    }
    (matrix, masses)
}

/// The vector of an eigenvalue, turned so that its largest entry is real: all of it where the eigenvalue is real.
fn real_part(spectrum: &GeneralSpectrum, pair: usize) -> Vec<f64> {
    let vector = spectrum.vectors.col(pair);
    let largest = vector.iter().copied().max_by(|a, b| a.norm_sqr().total_cmp(&b.norm_sqr()));
    let Some(largest) = largest.filter(|entry| entry.norm_sqr() > 0.0) else {
        return vec![0.0; vector.nrows()];
    };
    let phase = largest.conj() / largest.norm_sqr().sqrt();
    vector.iter().map(|entry| (entry * phase).re).collect()
}

/// Stiffness over (modes, shaft, balls), N/m. Outer contacts: the relative motion is s - w (radial) and -u (tangential). Inner
/// contacts with the geometric term -F/chi; in `printed` the inner race's position is relative to the ring's mean, by mode `centre`,
/// and the ring does not feel the force.
fn stiffness(
    structure: &Structure,
    modes: &StructureModes,
    setup: &BearingSetup,
    equilibrium: &Equilibrium,
    centre: &[[f64; 2]],
) -> DenseMatrix {
    let angles: Vec<f64> = equilibrium.balls.iter().map(|ball| ball.angle).collect();
    let contacts = contact_rows(structure, setup, &angles);
    let rows = modes.shapes.transpose() * &contacts;
    let load = DenseMatrix::from_fn(structure.dof(), 1, |row, _| equilibrium.structure_load[row]);
    // displacement of the race under every ball, m
    let moved = structure
        .static_response(&load)
        .map_or_else(|_| DenseMatrix::zeros(contacts.ncols(), 1), |response| contacts.transpose() * response);
    let races = RestingRaces::new(setup, equilibrium.shaft_angle);
    let relative = [0, 1].map(|i| equilibrium.shaft[i] - equilibrium.centre[i]);
    let spin = equilibrium.cage_speed.powi(2);
    let modes = &modes.squared_frequencies;
    let (count, order) = (modes.len(), modes.len() + 2 + angles.len());
    let mut k = DenseMatrix::zeros(order, order);
    for (mode, square) in modes.iter().enumerate() {
        k[(mode, mode)] = *square;
    }
    for (j, ball) in equilibrium.balls.iter().enumerate() {
        let own = count + 2 + j;
        let shift = moved[(2 * j + 1, 0)] / (races.inner_race.touching_radius + ball.displacement);
        let s = ball.displacement - moved[(2 * j, 0)];
        let [rr, rt, tt] = races.outer_force(j, ball.angle, shift, s).tangent;
        let (w, u) = (rows.col(2 * j), rows.col(2 * j + 1));
        for a in 0..count {
            for b in 0..count {
                k[(a, b)] += rr * w[a] * w[b] + rt * (w[a] * u[b] + u[a] * w[b]) + tt * u[a] * u[b];
            }
            let cross = rr * w[a] + rt * u[a];
            k[(a, own)] -= cross;
            k[(own, a)] -= cross;
        }
        k[(own, own)] += rr;
        k[(own, own)] -= setup.geometry.ball_mass() * spin;
        let contact = races.inner_contact(j, ball.angle, ball.displacement, relative);
        if contact.magnitude <= 0.0 {
            continue;
        }
        for (row, values) in [count, count + 1, own].into_iter().zip(contact.curvature) {
            for (column, value) in [count, count + 1, own].into_iter().zip(values) {
                k[(row, column)] += value;
            }
            for mode in 0..count {
                k[(row, mode)] -= values[0] * centre[mode][0];
                k[(row, mode)] -= values[1] * centre[mode][1];
            }
        }
    }
    k
}

/// Cage angles over one ball spacing, both ends included.
const ANGLES: usize = 29;

/// Loads, each in units of the case's, from a tenth to ten times.
const LOADS: usize = 17;

/// Loaded modes at one cage angle or load.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct LoadedPoint {
    /// Angle that the cage is turned on by, rad, or load in units of the case's.
    pub at: f64,
    /// `None` where no equilibrium was found. JSON results hold the frequencies alone, Hz.
    #[serde(rename = "frequencies_hz", serialize_with = "frequencies_alone")]
    #[schemars(with = "Option<Vec<f64>>")]
    pub modes: Option<LoadedModes>,
}

/// Loaded modes over a ball pass and over the load.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct LoadedPass {
    /// Over one ball spacing, each at an angle of the cage, rad.
    #[serde(rename = "over_angle_rad")]
    pub over_angle: Vec<LoadedPoint>,
    /// From a tenth of the force on the shaft to ten times.
    pub over_load: Vec<LoadedPoint>,
}

fn frequencies_alone<S: Serializer>(modes: &Option<LoadedModes>, to: S) -> Result<S::Ok, S::Error> {
    let frequencies = modes.as_ref().map(|loaded| loaded.modes.iter().map(|mode| mode.frequency_hz));
    frequencies.map(Iterator::collect::<Vec<f64>>).serialize(to)
}

impl LoadedPass {
    /// Linearises at the equilibrium of every angle and load, from cage and loads as they are at `time` (s).
    ///
    /// # Errors
    /// [`SystemError`] for what is no missing equilibrium.
    pub fn compute(
        (structure, modes): (&Structure, &StructureModes),
        setup: &BearingSetup,
        time: f64,
        watch: &impl Watch,
    ) -> Result<Self, SystemError> {
        watch.stage("ball pass");
        let condition = StaticCondition::at(setup, time);
        let point = |at: f64, condition: StaticCondition| -> Result<LoadedPoint, SystemError> {
            let rest = match Equilibrium::find(structure, setup, condition) {
                Err(SystemError::NoEquilibrium { .. }) => {
                    return Ok(LoadedPoint { at, modes: None });
                }
                found => found?,
            };
            let modes = LoadedModes::at(structure, modes, setup, &rest)?;
            Ok(LoadedPoint { at, modes: Some(modes) })
        };
        let over_angle = (0..ANGLES).into_par_iter().map(|place| {
            let turned = setup.cage.spacing * place as f64 / (ANGLES - 1) as f64;
            point(turned, condition.turned_by(setup, turned))
        });
        let over_load = (0..LOADS).into_par_iter().map(|place| {
            let factor = 10_f64.powf(2.0 * place as f64 / (LOADS - 1) as f64 - 1.0);
            point(factor, condition.loaded(factor))
        });
        Ok(Self { over_angle: over_angle.collect::<Result<_, _>>()?, over_load: over_load.collect::<Result<_, _>>()? })
    }
}
