//! Modes of a shaft in its bearings, linearised where it rests: gyroscopic moment, friction and damping included.
//!
//! ```text
//! y'' = g(y, y') - O^2 y - D y',   A = [0, I; dg/dy - O^2, dg/dy' - D],   A x = lambda x
//! ```
//!
//! The derivatives are central differences of the force that a run steps. With the cages held where they are the modes are those of an instant.

use super::setup::SHAFT;
use super::system::SpatialSystem;
use crate::numerics::linalg::{DenseMatrix, general_spectrum};
use crate::numerics::ode::{SecondOrderSystem, State};
use crate::system::{LoadedMode, LoadedModes, SystemError};
use faer::c64;
use std::f64::consts::TAU;

/// Steps of the differences: of an amplitude of a mode (kg^1/2 m), of a length (m), of a tilt (rad), and of velocities (m/s). Contacts are
/// pressed in by a micrometre: a ten-thousandth of it errs by 1e-8.
const OF_MODE: f64 = 1e-11;
const OF_LENGTH: f64 = 1e-10;
const OF_TILT: f64 = 1e-8;
const OF_VELOCITY: f64 = 1e-6;

/// Eigenvalues below this size are of motions without stiffness, 1/s: contacts of 1e6 N/m make 1e5.
const HELD: f64 = 1e2;

impl SpatialSystem {
    /// The modes at a state of rest, oscillating ones alone, by frequency.
    ///
    /// # Errors
    /// [`SystemError::Linalg`] if the eigenvalues are not found.
    pub(crate) fn loaded_modes(&self, rest: &State) -> Result<LoadedModes, SystemError> {
        let n = rest.y.len();
        let matrix = self.linearised(rest);
        let spectrum = general_spectrum(&matrix)?;
        let spin = self.setup.bearings[0].cage.shaft().motion(rest.t).speed;
        let (mut modes, mut without_stiffness, mut unstable) = (Vec::new(), 0, 0);
        for (pair, value) in spectrum.values.iter().enumerate() {
            let size = value.re.hypot(value.im);
            if size < HELD {
                without_stiffness += 1;
            } else if value.re > 1e-6 * size {
                unstable += 1;
            } else if value.im > 0.0 {
                let shape: Vec<c64> = (0..n).map(|row| spectrum.vectors[(row, pair)]).collect();
                modes.push(self.mode(*value, &shape, spin));
            }
        }
        modes.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
        // a motion without stiffness has two eigenvalues
        Ok(LoadedModes { modes, without_stiffness: without_stiffness / 2, unstable })
    }

    /// A [2n x 2n].
    fn linearised(&self, rest: &State) -> DenseMatrix {
        let (n, modes) = (rest.y.len(), self.modes);
        let mut system = self.clone();
        let mut force_at = |y: &[f64], v: &[f64]| {
            let mut force = vec![0.0; n];
            system.force_into(rest.t, y, v, &mut force);
            force
        };
        let mut matrix = DenseMatrix::zeros(2 * n, 2 * n);
        for column in 0..n {
            let step = match column {
                mode if mode < modes => OF_MODE,
                shaft if shaft < modes + 3 => OF_LENGTH,
                tilt if tilt < modes + SHAFT => OF_TILT,
                _ => OF_LENGTH,
            };
            let moved = |by: f64, values: &[f64]| {
                let mut values = values.to_vec();
                values[column] += by;
                values
            };
            let by_place = [step, -step].map(|by| force_at(&moved(by, &rest.y), &rest.v));
            let by_speed = [OF_VELOCITY, -OF_VELOCITY].map(|by| force_at(&rest.y, &moved(by, &rest.v)));
            for row in 0..n {
                matrix[(n + row, column)] = (by_place[0][row] - by_place[1][row]) / (2.0 * step);
                matrix[(n + row, n + column)] = (by_speed[0][row] - by_speed[1][row]) / (2.0 * OF_VELOCITY);
            }
            matrix[(column, n + column)] = 1.0;
            matrix[(n + column, column)] -= self.linear[column].squared_frequency;
            matrix[(n + column, n + column)] -= self.linear[column].damping;
        }
        matrix
    }

    /// A mode by its eigenvalue and the displacements of its vector.
    fn mode(&self, value: c64, shape: &[c64], spin: f64) -> LoadedMode {
        let (modes, own) = (self.modes, &self.setup.shaft);
        let square = |entry: &c64| entry.re * entry.re + entry.im * entry.im;
        let squares = |entries: &[c64]| entries.iter().map(square).sum::<f64>();
        let structure = squares(&shape[..modes]);
        let shaft = &shape[modes..modes + SHAFT];
        let (lengths, tilts) = shaft.split_at(3);
        let moving = own.mass * squares(lengths) + own.transverse_inertia * squares(tilts);
        let balls = self.ball_ranges().zip(&self.bearings);
        let balls: f64 =
            balls.map(|((first, count), own)| squares(&shape[first..first + 2 * count]) / own.mobility).sum();
        let total = structure + moving + balls;
        // x = Re(X e^iwt) and y go round from x to y where y lags by a quarter of a turn
        let round = |x: c64, y: c64| x.im * y.re - x.re * y.im;
        let turning = own.mass * round(shaft[0], shaft[1]) + own.transverse_inertia * round(shaft[3], shaft[4]);
        let across = own.mass * squares(&shaft[..2]) + own.transverse_inertia * squares(tilts);
        let whirl = (spin != 0.0 && across > 0.0).then(|| 2.0 * spin.signum() * turning / across);
        let size = value.re.hypot(value.im);
        LoadedMode {
            frequency_hz: size / TAU,
            structure_share: structure / total,
            shaft_share: moving / total,
            ball_share: balls / total,
            damping_ratio: Some(-value.re / size),
            whirl,
        }
    }
}
