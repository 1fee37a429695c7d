//! Eigenfrequencies with the contacts' stiffness at a static equilibrium.

use super::bearing_setup::{BearingSetup, Formulation};
use super::equilibrium::{Equilibrium, contact_rows};
use super::error::SystemError;
use super::resting::{RestingRaces, in_the_plane};
use super::structure::{Structure, StructureModes};
use crate::numerics::linalg::{DenseMatrix, GeneralSpectrum, general_spectrum, symmetric_eigen};
use schemars::JsonSchema;
use serde::Serialize;
use std::f64::consts::TAU;

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

/// Blocks of the linearised equations over (modes, shaft, balls), divided by the masses.
struct Linearised {
    /// Stiffness, rows divided by the mass of their coordinate [n x n].
    matrix: DenseMatrix,
    modes: usize,
    /// Mass of each coordinate, kg; 1 for a mode.
    masses: Vec<f64>,
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
        let linearised = Linearised::new(structure, modes, setup, equilibrium);
        let pairs = match setup.formulation {
            Formulation::Consistent => linearised.symmetric_pairs()?,
            Formulation::Printed => linearised.general_pairs()?,
        };
        // contacts of 1e6 N/m make 1e10 1/s^2; what is a million times softer is not held
        let held = 1e4;
        let mut found = Vec::new();
        let (mut without_stiffness, mut unstable) = (0, 0);
        for pair in pairs {
            if pair.value.abs() < held {
                without_stiffness += 1;
            } else if pair.value < 0.0 || pair.imaginary.abs() > 1e-6 * pair.value.abs() {
                unstable += 1;
            } else {
                found.push((linearised.describe(&pair), pair.amplitudes));
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

/// Eigenvalue with its vector.
struct Pair {
    value: f64,
    imaginary: f64,
    /// Amplitude of each coordinate.
    amplitudes: Vec<f64>,
}

impl Linearised {
    fn new(structure: &Structure, modes: &StructureModes, setup: &BearingSetup, equilibrium: &Equilibrium) -> Self {
        let (count, balls) = (modes.count(), setup.balls());
        let order = count + 2 + balls;
        let printed = setup.formulation == Formulation::Printed;
        let mut k = DenseMatrix::zeros(order, order);
        for mode in 0..count {
            k[(mode, mode)] = modes.squared_frequencies[mode];
        }
        let angles: Vec<f64> = equilibrium.balls.iter().map(|ball| ball.angle).collect();
        let rows = modes.shapes.transpose() * contact_rows(structure, setup, &angles);
        let centre = centre_rows(structure, modes, printed);
        let races = RestingRaces::new(setup, equilibrium.shaft_angle);
        add_outer(&mut k, &races, setup, structure, equilibrium, &rows, count);
        add_inner(&mut k, &races, setup, equilibrium, &centre, count);
        let mut masses = vec![1.0; count];
        masses.extend([setup.shaft.mass; 2]);
        masses.extend(vec![setup.geometry.ball_mass(); balls]);
        let mut matrix = DenseMatrix::from_fn(order, order, |i, j| k[(i, j)] / masses[i]);
        if printed {
            // s'' + e . centre'' = ...: take the centre's acceleration to the right-hand side
            let accelerations = DenseMatrix::from_fn(2, order, |component, column| {
                (0..count).map(|mode| centre[(component, mode)] * matrix[(mode, column)]).sum()
            });
            for (j, angle) in angles.iter().enumerate() {
                let (sin, cos) = angle.sin_cos();
                for column in 0..order {
                    matrix[(count + 2 + j, column)] -=
                        cos * accelerations[(0, column)] + sin * accelerations[(1, column)];
                }
            }
        }
        Self { matrix, modes: count, masses }
    }

    fn symmetric_pairs(&self) -> Result<Vec<Pair>, SystemError> {
        let order = self.masses.len();
        let root = |i: usize| self.masses[i].sqrt();
        let scaled = DenseMatrix::from_fn(order, order, |i, j| {
            0.5 * (self.matrix[(i, j)] * root(i) / root(j) + self.matrix[(j, i)] * root(j) / root(i))
        });
        let spectrum = symmetric_eigen(&scaled)?;
        Ok((0..order)
            .map(|pair| Pair {
                value: spectrum.values[pair],
                imaginary: 0.0,
                amplitudes: (0..order).map(|i| spectrum.vectors[(i, pair)] / root(i)).collect(),
            })
            .collect())
    }

    fn general_pairs(&self) -> Result<Vec<Pair>, SystemError> {
        let order = self.masses.len();
        let root = |i: usize| self.masses[i].sqrt();
        // scaled as the symmetric problem is, so that rows and columns have one size
        let scaled = DenseMatrix::from_fn(order, order, |i, j| self.matrix[(i, j)] * root(i) / root(j));
        let spectrum = general_spectrum(&scaled)?;
        Ok((0..order)
            .map(|pair| Pair {
                value: spectrum.values[pair].re,
                imaginary: spectrum.values[pair].im,
                amplitudes: real_part(&spectrum, pair).iter().enumerate().map(|(i, entry)| entry / root(i)).collect(),
            })
            .collect())
    }

    fn describe(&self, pair: &Pair) -> LoadedMode {
        let energy =
            |range: std::ops::Range<usize>| -> f64 { range.map(|i| pair.amplitudes[i].powi(2) * self.masses[i]).sum() };
        let (n, order) = (self.modes, self.masses.len());
        let total = energy(0..order);
        LoadedMode {
            frequency_hz: pair.value.sqrt() / TAU,
            structure_share: energy(0..n) / total,
            shaft_share: energy(n..n + 2) / total,
            ball_share: energy(n + 2..order) / total,
        }
    }
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

/// Mean ring displacement over the modes [2 x modes]; zero unless the formulation uses it.
fn centre_rows(structure: &Structure, modes: &StructureModes, printed: bool) -> DenseMatrix {
    let nodes = structure.ring().nodes();
    DenseMatrix::from_fn(2, modes.count(), |component, mode| {
        if !printed {
            return 0.0;
        }
        let sum: f64 = (0..nodes).map(|node| modes.shapes[(3 * node + component, mode)]).sum();
        sum / nodes as f64
    })
}

/// Outer contacts: the relative motion is s - w (radial) and -u (tangential).
fn add_outer(
    k: &mut DenseMatrix,
    races: &RestingRaces,
    setup: &BearingSetup,
    structure: &Structure,
    equilibrium: &Equilibrium,
    rows: &DenseMatrix,
    modes: usize,
) {
    let response = race_displacement(structure, equilibrium, setup);
    let touching = setup.geometry.outer_race_radius() - setup.geometry.ball_radius();
    for (j, ball) in equilibrium.balls.iter().enumerate() {
        let shift = response[2 * j + 1] / (touching + ball.displacement);
        let s = ball.displacement - response[2 * j];
        let force = races.outer_force(j, ball.angle, shift, s);
        let [rr, rt, tt] = force.tangent;
        let place = modes + 2 + j;
        let (w, u) = (rows.col(2 * j), rows.col(2 * j + 1));
        for a in 0..modes {
            for b in 0..modes {
                k[(a, b)] += rr * w[a] * w[b] + rt * (w[a] * u[b] + u[a] * w[b]) + tt * u[a] * u[b];
            }
            let cross = rr * w[a] + rt * u[a];
            k[(a, place)] -= cross;
            k[(place, a)] -= cross;
        }
        k[(place, place)] += rr;
    }
}

/// Displacement of the race under every ball in the equilibrium [2 balls], m.
fn race_displacement(structure: &Structure, equilibrium: &Equilibrium, setup: &BearingSetup) -> Vec<f64> {
    let load = &equilibrium.structure_load;
    let column = DenseMatrix::from_fn(load.len(), 1, |row, _| load[row]);
    let angles: Vec<f64> = equilibrium.balls.iter().map(|ball| ball.angle).collect();
    structure.static_response(&column).map_or_else(
        |_| vec![0.0; 2 * angles.len()],
        |response| {
            let at = contact_rows(structure, setup, &angles).transpose() * response;
            at.col(0).iter().copied().collect()
        },
    )
}

/// Inner contacts with the geometric term -F/chi; in `printed` the inner race's position is
/// relative to the ring's mean and the ring does not feel the force.
fn add_inner(
    k: &mut DenseMatrix,
    races: &RestingRaces,
    setup: &BearingSetup,
    equilibrium: &Equilibrium,
    centre: &DenseMatrix,
    modes: usize,
) {
    let relative = [0, 1].map(|i| equilibrium.shaft[i] - equilibrium.centre[i]);
    let spin = equilibrium.cage_speed.powi(2);
    for (j, ball) in equilibrium.balls.iter().enumerate() {
        let (sin, cos) = ball.angle.sin_cos();
        k[(modes + 2 + j, modes + 2 + j)] -= setup.geometry.ball_mass() * spin;
        let gap = races.inner_race.gap([cos, sin], ball.displacement, relative);
        let force = races.inner_force(j, ball.angle, &gap);
        if force.magnitude <= 0.0 {
            continue;
        }
        let curvature = in_the_plane(&force, gap.distance);
        let n = gap.normal;
        let along = [-n[0], -n[1], n[0] * cos + n[1] * sin];
        let across = [n[1], -n[0], n[0] * sin - n[1] * cos];
        let place = [modes, modes + 1, modes + 2 + j];
        for a in 0..3 {
            for b in 0..3 {
                let value = curvature[0] * along[a] * along[b]
                    + curvature[1] * (along[a] * across[b] + across[a] * along[b])
                    + curvature[2] * across[a] * across[b];
                k[(place[a], place[b])] += value;
                if b < 2 {
                    for mode in 0..modes {
                        k[(place[a], mode)] -= value * centre[(b, mode)];
                    }
                }
            }
        }
    }
}
