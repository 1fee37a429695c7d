//! What a mode is: how much of its kinetic energy is a motion of the ring that has a name.

use plummer::numerics::linalg::DenseMatrix;
use plummer::system::{LoadedShapes, Structure, StructureModes};

/// Share of a motion from which on a mode is called by it: more than all others together.
const MOSTLY: f64 = 0.5;

/// The named motions of a ring.
#[derive(Debug, Clone)]
pub struct NamedMotions {
    /// Momentum of each motion of unit energy over the modes [modes x 5]: along x, along y, turning, two waves twice.
    momenta: DenseMatrix,
}

/// Shares of a mode's kinetic energy, 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShapeShares {
    /// Ring as a rigid body across the load, x.
    pub across: f64,
    /// Ring as a rigid body along the load, y.
    pub along: f64,
    /// Ring turning as a rigid body.
    pub turning: f64,
    /// Ring in two waves, without extension.
    pub two_waves: f64,
    /// Shaft.
    pub shaft: f64,
    /// Balls.
    pub balls: f64,
}

/// The paper's three frequencies as the shapes have them, Hz; `None` where no mode has the shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ByShape {
    /// "Bearing/housing-pedestal system": the ring across the load and turning, the higher of two such modes.
    pub sway: Option<f64>,
    /// "Shaft": the ring along the load, on the contacts.
    pub bounce: Option<f64>,
    /// "Outer ring": the first mode of two waves.
    pub two_waves: Option<f64>,
}

impl NamedMotions {
    /// The motions of a structure's ring over its modes.
    pub fn new(structure: &Structure, modes: &StructureModes) -> Self {
        let ring = structure.ring();
        let radius = ring.section().radius;
        let mut columns =
            vec![ring.rigid_motion(1.0, 0.0, 0.0), ring.rigid_motion(0.0, 1.0, 0.0), ring.rigid_motion(0.0, 0.0, 1.0)];
        for quarter in [0.0, 0.25 * std::f64::consts::PI] {
            // w = cos 2 phi', u = - sin 2 phi' / 2 has no extension (u' + w = 0); theta = (u - w') / R: no shear
            let mut motion = Vec::with_capacity(ring.dof());
            for node in 0..ring.nodes() {
                let angle = ring.node_angle(node);
                let (sin_2, cos_2) = (2.0 * (angle - quarter)).sin_cos();
                let (sin, cos) = angle.sin_cos();
                let (w, u) = (cos_2, -0.5 * sin_2);
                motion.extend([w * cos - u * sin, w * sin + u * cos, 1.5 * sin_2 / radius]);
            }
            columns.push(motion);
        }
        let motions = DenseMatrix::from_fn(structure.dof(), columns.len(), |row, column| {
            columns[column].get(row).copied().unwrap_or(0.0)
        });
        let momentum = structure.mass() * &motions;
        let mut momenta = modes.shapes.transpose() * &momentum;
        for column in 0..columns.len() {
            let energy: f64 = (0..structure.dof()).map(|row| motions[(row, column)] * momentum[(row, column)]).sum();
            for mode in 0..modes.count() {
                momenta[(mode, column)] /= energy.sqrt();
            }
        }
        Self { momenta }
    }

    /// Shares of one loaded mode.
    pub fn shares(&self, shapes: &LoadedShapes, number: usize) -> ShapeShares {
        let mode = &shapes.modes.modes[number];
        let amplitudes = &shapes.amplitudes[number];
        let count = self.momenta.nrows();
        let energy: f64 = amplitudes[..count].iter().map(|q| q * q).sum();
        let share = |column: usize| {
            if energy <= 0.0 {
                return 0.0;
            }
            let part: f64 = (0..count).map(|row| amplitudes[row] * self.momenta[(row, column)]).sum();
            mode.structure_share * part * part / energy
        };
        ShapeShares {
            across: share(0),
            along: share(1),
            turning: share(2),
            two_waves: share(3) + share(4),
            shaft: mode.shaft_share,
            balls: mode.ball_share,
        }
    }

    /// The paper's three by their shapes.
    pub fn by_shape(&self, shapes: &LoadedShapes) -> ByShape {
        let mut found = ByShape { sway: None, bounce: None, two_waves: None };
        let mut most_along = MOSTLY;
        for (number, mode) in shapes.modes.modes.iter().enumerate() {
            let shares = self.shares(shapes, number);
            if shares.across + shares.turning > MOSTLY {
                found.sway = Some(mode.frequency_hz);
            }
            if shares.along > most_along {
                most_along = shares.along;
                found.bounce = Some(mode.frequency_hz);
            }
            if shares.two_waves > MOSTLY && found.two_waves.is_none() {
                found.two_waves = Some(mode.frequency_hz);
            }
        }
        found
    }
}
