//! Dense matrices of a system, and where forces act and motions are read.
//!
//! Damping given mode by mode.

use super::FrfError;
use super::error::{check_coefficients, check_frequencies};
use crate::numerics::linalg::DenseMatrix;
use faer::Scale;
use std::f64::consts::TAU;

/// `Z(w) = k - w^2 m + i (w c + k_s)` in dense real symmetric matrices.
#[derive(Debug, Clone)]
pub struct ReducedSystem {
    stiffness: DenseMatrix,
    mass: DenseMatrix,
    viscous: Option<DenseMatrix>,
    structural: Option<DenseMatrix>,
}

/// Where forces act and motions are read.
#[derive(Debug, Clone)]
pub struct FrfPaths {
    /// Load vectors in columns [n x p]: the coordinates' forces for a unit of each load.
    pub loads: DenseMatrix,
    /// Sensor rows [s x n]: displacement read for a unit of each coordinate.
    pub sensors: DenseMatrix,
}

impl ReducedSystem {
    /// A system without damping from stiffness and mass [n x n].
    ///
    /// # Errors
    /// [`FrfError`].
    pub fn new(stiffness: DenseMatrix, mass: DenseMatrix) -> Result<Self, FrfError> {
        let order = stiffness.nrows();
        square("stiffness", &stiffness, order)?;
        square("mass", &mass, order)?;
        Ok(Self { stiffness, mass, viscous: None, structural: None })
    }

    /// Adds viscous damping c [n x n], N s/m, to what there is.
    ///
    /// # Errors
    /// [`FrfError`].
    pub fn with_viscous(mut self, viscous: DenseMatrix) -> Result<Self, FrfError> {
        square("viscous damping", &viscous, self.order())?;
        self.viscous = sum(self.viscous, viscous);
        Ok(self)
    }

    /// Adds structural damping k_s [n x n], N/m (sum of loss factor times stiffness), to what there is.
    ///
    /// # Errors
    /// [`FrfError`].
    pub fn with_structural(mut self, structural: DenseMatrix) -> Result<Self, FrfError> {
        square("structural damping", &structural, self.order())?;
        self.structural = sum(self.structural, structural);
        Ok(self)
    }

    /// Adds `alpha m + beta k` to the viscous damping; alpha in 1/s, beta in s, both >= 0.
    ///
    /// # Errors
    /// [`FrfError`].
    pub fn with_rayleigh(self, alpha: f64, beta: f64) -> Result<Self, FrfError> {
        super::error::check_coefficients(&[("alpha", alpha), ("beta", beta)])?;
        let damping = &self.mass * Scale(alpha) + &self.stiffness * Scale(beta);
        self.with_viscous(damping)
    }

    /// Number of coordinates.
    pub fn order(&self) -> usize {
        self.stiffness.nrows()
    }

    /// k [n x n].
    pub fn stiffness(&self) -> &DenseMatrix {
        &self.stiffness
    }

    /// m [n x n].
    pub fn mass(&self) -> &DenseMatrix {
        &self.mass
    }

    /// c [n x n], if there is any.
    pub fn viscous(&self) -> Option<&DenseMatrix> {
        self.viscous.as_ref()
    }

    /// k_s [n x n], if there is any.
    pub fn structural(&self) -> Option<&DenseMatrix> {
        self.structural.as_ref()
    }

    /// Whether the paths are over this system's coordinates.
    pub(super) fn check(&self, paths: &FrfPaths) -> Result<(), FrfError> {
        same("rows of the loads", self.order(), paths.loads.nrows())?;
        same("columns of the sensors", self.order(), paths.sensors.ncols())
    }
}

fn sum(before: Option<DenseMatrix>, more: DenseMatrix) -> Option<DenseMatrix> {
    match before {
        Some(before) => Some(before + more),
        None => Some(more),
    }
}

fn square(what: &'static str, matrix: &DenseMatrix, order: usize) -> Result<(), FrfError> {
    same(what, order, matrix.nrows())?;
    same(what, order, matrix.ncols())
}

pub(super) fn same(what: &'static str, expected: usize, found: usize) -> Result<(), FrfError> {
    if found == expected { Ok(()) } else { Err(FrfError(format!("{what}: expected {expected}, found {found}"))) }
}

/// Viscous damping of modes, of a frequency response as of a run.
#[derive(Debug, Clone, PartialEq)]
pub enum ModalDamping {
    /// The same ratio for every mode, >= 0 and < 1.
    Uniform(f64),
    /// `alpha + beta w_r^2`: that of `C = alpha M + beta K`; alpha in 1/s, beta in s, both >= 0.
    Rayleigh {
        /// 1/s.
        alpha: f64,
        /// s.
        beta: f64,
    },
    /// One ratio a mode, in the order of the modes, >= 0 and < 1.
    Each(Vec<f64>),
    /// Ratios at frequencies, (Hz, ratio), frequencies ascending: straight lines between them, constant outside.
    Points(Vec<(f64, f64)>),
}

impl ModalDamping {
    /// Rayleigh damping with the given ratios at two frequencies (Hz):
    /// `zeta = alpha / (2 w) + beta w / 2`.
    pub(crate) fn rayleigh_through(first: (f64, f64), second: (f64, f64)) -> Self {
        let (w1, w2) = (TAU * first.0, TAU * second.0);
        let beta = 2.0 * (second.1 * w2 - first.1 * w1) / (w2 * w2 - w1 * w1);
        Self::Rayleigh { alpha: 2.0 * first.1 * w1 - beta * w1 * w1, beta }
    }

    /// Damping `2 zeta_r w_r` of modes with the squares of their angular frequencies `squares` (1/s^2) \[modes\], 1/s.
    /// A rigid mode has the alpha of Rayleigh damping and nothing of a ratio.
    ///
    /// # Errors
    /// [`FrfError`] for ratios or coefficients out of range, and for another number of ratios than modes.
    pub fn rates(&self, squares: &[f64]) -> Result<Vec<f64>, FrfError> {
        let of_ratio = |ratio: f64, square: f64| 2.0 * ratio * square.max(0.0).sqrt();
        match self {
            Self::Uniform(ratio) => {
                let ratio = checked(*ratio)?;
                Ok(squares.iter().map(|&square| of_ratio(ratio, square)).collect())
            }
            Self::Rayleigh { alpha, beta } => {
                check_coefficients(&[("alpha", *alpha), ("beta", *beta)])?;
                Ok(squares.iter().map(|square| alpha + beta * square.max(0.0)).collect())
            }
            Self::Each(ratios) => {
                same("number of damping ratios", squares.len(), ratios.len())?;
                ratios.iter().zip(squares).map(|(&ratio, &square)| Ok(of_ratio(checked(ratio)?, square))).collect()
            }
            Self::Points(points) => {
                let frequencies: Vec<f64> = points.iter().map(|point| point.0).collect();
                check_frequencies(&frequencies)?;
                points.iter().try_for_each(|&(_, ratio)| checked(ratio).map(drop))?;
                let at = |&square: &f64| {
                    let hz = square.max(0.0).sqrt() / TAU;
                    Some(of_ratio(interpolated(points, hz)?, square))
                };
                squares
                    .iter()
                    .map(at)
                    .collect::<Option<_>>()
                    .ok_or_else(|| FrfError("damping ratios over frequency need at least one point".to_owned()))
            }
        }
    }
}

fn checked(ratio: f64) -> Result<f64, FrfError> {
    if (0.0..1.0).contains(&ratio) {
        return Ok(ratio);
    }
    Err(FrfError(format!("a damping ratio must be zero or more and below 1, found {ratio}")))
}

fn interpolated(points: &[(f64, f64)], hz: f64) -> Option<f64> {
    let above = points.partition_point(|point| point.0 <= hz);
    let (first, last) = (points.first()?, points.last()?);
    Some(match (above.checked_sub(1), points.get(above)) {
        (None, _) => first.1,
        (_, None) => last.1,
        (Some(below), Some(&(next, higher))) => {
            let (hz_below, lower) = points[below];
            lower + (higher - lower) * (hz - hz_below) / (next - hz_below)
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratios(damping: &ModalDamping, hz: &[f64]) -> Vec<f64> {
        let omegas: Vec<f64> = hz.iter().map(|hz| TAU * hz).collect();
        let squares: Vec<f64> = omegas.iter().map(|omega| omega * omega).collect();
        let rates = damping.rates(&squares).expect("in range");
        let pairs = rates.iter().zip(&omegas);
        pairs.map(|(rate, omega)| rate / (2.0 * omega)).collect()
    }

    #[test]
    fn points_are_joined_by_straight_lines() {
        let points = ModalDamping::Points(vec![(100.0, 0.01), (200.0, 0.03), (400.0, 0.02)]);
        let found = ratios(&points, &[50.0, 100.0, 150.0, 200.0, 300.0, 400.0, 900.0]);
        for (found, exact) in found.iter().zip([0.01, 0.01, 0.02, 0.03, 0.025, 0.02, 0.02]) {
            assert!((found - exact).abs() < 1e-15, "{found} {exact}");
        }
    }

    #[test]
    fn rayleigh_has_its_two_ratios() {
        // 1 % at 2 and 40 kHz
        let damping = ModalDamping::Rayleigh { alpha: 239.359_440_273_508_06, beta: 7.578_806_813_899_779e-8 };
        for found in ratios(&damping, &[2e3, 40e3]) {
            assert!((found - 0.01).abs() < 1e-12, "{found}");
        }
        assert_eq!(damping.rates(&[0.0]), Ok(vec![239.359_440_273_508_06]));
        assert_eq!(ModalDamping::Uniform(0.1).rates(&[0.0, 25.0]), Ok(vec![0.0, 1.0]));
    }

    #[test]
    fn each_rule_fires() {
        let message = |damping: ModalDamping| match damping.rates(&[1.0, 2.0]) {
            Ok(rates) => format!("{rates:?}"),
            Err(error) => error.to_string(),
        };
        let rule = "a damping ratio must be zero or more and below 1, found";
        assert_eq!(message(ModalDamping::Uniform(1.0)), format!("{rule} 1"));
        let each = |ratios: &[f64]| ModalDamping::Each(ratios.to_vec());
        assert_eq!(message(each(&[0.5, -0.5])), format!("{rule} -0.5"));
        assert_eq!(message(each(&[0.5])), "number of damping ratios: expected 2, found 1");
        let points = |points: &[(f64, f64)]| ModalDamping::Points(points.to_vec());
        assert_eq!(message(points(&[(1.0, f64::NAN)])), format!("{rule} NaN"));
        assert_eq!(message(points(&[])), "damping ratios over frequency need at least one point");
        assert_eq!(message(points(&[(2.0, 0.1), (2.0, 0.1)])), "frequencies must ascend, found 2 Hz after 2 Hz");
        assert_eq!(message(points(&[(-2.0, 0.1)])), "a frequency must be zero or more and finite, found -2 Hz");
        let rayleigh = ModalDamping::Rayleigh { alpha: 0.0, beta: -1e-9 };
        assert_eq!(
            message(rayleigh),
            "the damping coefficient beta must be zero or more and finite, found -0.000000001"
        );
    }
}
