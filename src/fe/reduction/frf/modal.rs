//! Responses as a sum of modes, with what each of them contributes.
//!
//! With `phi_r` normalised to `phi^T m phi = 1`, path from load f to sensor row d:
//!
//! ```text
//! H(w) = sum_r (d phi_r)(phi_r^T f) / (w_r^2 - w^2 + i (w c_r + s_r)) + R
//! c_r = 2 zeta_r w_r + phi_r^T c phi_r,   s_r = phi_r^T k_s phi_r
//! R = sum over the modes left out of (d phi)(phi^T f) / w^2, and the statics of motions without mass
//! ```
//!
//! Exact but for the statics of R where damping does not couple modes (Ewins, Modal Testing, 2nd ed. (2000), sections 2.4 to
//! 2.6); where it does, the coupling is neglected and measured.
//!
//! Which mode carries a path.

use super::band::Window;
use super::error::{check_frequencies, unbounded};
use super::response::check_path;
use super::{FrequencyResponse, FrfError, FrfPaths, ModalDamping, ReducedSystem};
use crate::numerics::linalg::{ComplexMatrix, DenseCholesky, DenseMatrix, acting_generalised_eigen};
use faer::{Scale, c64};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;
use std::f64::consts::TAU;

/// Undamped modes of a system.
#[derive(Debug, Clone)]
pub struct ModalBasis {
    /// omega^2, 1/s^2, ascending; those with mass.
    squared: Vec<f64>,
    omegas: Vec<f64>,
    frequencies_hz: Vec<f64>,
    /// Mode shapes [n x modes], `phi^T m phi = 1`.
    pub(in crate::fe::reduction) shapes: DenseMatrix,
    /// Whether some motion has no mass.
    has_massless: bool,
}

/// Modes with damping, on the paths of loads and sensors.
#[derive(Debug, Clone)]
pub struct ModalSuperposition {
    squared: Vec<f64>,
    pub(super) omegas: Vec<f64>,
    /// c_r, 1/s.
    rates: Vec<f64>,
    /// s_r, 1/s^2.
    losses: Vec<f64>,
    /// `d phi_r` [s x modes].
    seen: DenseMatrix,
    /// `phi_r^T f` [modes x p].
    driven: DenseMatrix,
    /// R, statics of the modes left out [s x p], m/N.
    pub(in crate::fe::reduction) residual: DenseMatrix,
    /// Largest `|c_rs| / sqrt(c_rr c_ss)` between kept modes, of viscous or structural damping: what the sum of modes
    /// neglects. Round-off for proportional damping; at most 1 for a damping matrix that is positive semidefinite.
    pub(crate) coupling: f64,
}

impl ModalBasis {
    /// All modes of a system, by a dense solver.
    ///
    /// # Errors
    /// [`FrfError`].
    pub fn new(system: &ReducedSystem) -> Result<Self, FrfError> {
        let spectrum = acting_generalised_eigen(system.stiffness(), system.mass())?;
        let count = spectrum.values.iter().take_while(|value| value.is_finite()).count();
        let squared = spectrum.values[..count].to_vec();
        let omegas: Vec<f64> = squared.iter().map(|value| value.max(0.0).sqrt()).collect();
        Ok(Self {
            frequencies_hz: omegas.iter().map(|omega| omega / TAU).collect(),
            omegas,
            squared,
            shapes: spectrum.vectors.subcols(0, count).to_owned(),
            has_massless: count < spectrum.values.len(),
        })
    }

    /// Natural frequencies, ascending, Hz; rigid modes within round-off of zero.
    pub fn frequencies_hz(&self) -> &[f64] {
        &self.frequencies_hz
    }

    /// Viscous matrix `c = m Phi diag(2 zeta_r w_r) Phi^T m` [n x n] of modal damping, for the direct response. Motions
    /// without mass stay undamped.
    ///
    /// # Errors
    /// As [`ModalDamping::rates`].
    pub(crate) fn viscous_matrix(
        &self,
        system: &ReducedSystem,
        damping: &ModalDamping,
    ) -> Result<DenseMatrix, FrfError> {
        let rates = damping.rates(&self.squared)?;
        let heavy = system.mass() * &self.shapes;
        let scaled = DenseMatrix::from_fn(heavy.nrows(), heavy.ncols(), |row, mode| heavy[(row, mode)] * rates[mode]);
        Ok(scaled * heavy.transpose())
    }
}

impl ModalSuperposition {
    /// The lowest `kept` modes on the paths given; what is left out follows statically. `damping` adds to the diagonal of
    /// the system's own damping matrices in modal coordinates.
    ///
    /// # Errors
    /// [`FrfError`], what `ModalDamping::rates` refuses;
    /// [`FrfError`] for the statics of motions without mass.
    pub fn new(
        system: &ReducedSystem,
        basis: &ModalBasis,
        paths: &FrfPaths,
        kept: usize,
        damping: &ModalDamping,
    ) -> Result<Self, FrfError> {
        system.check(paths)?;
        let available = basis.squared.len();
        if kept > available {
            return Err(FrfError(format!("{kept} modes asked for, but the system has only {available} with mass")));
        }
        let mut rates = damping.rates(&basis.squared)?;
        rates.truncate(kept);
        let mut losses = vec![0.0; kept];
        let mut coupling = 0.0_f64;
        let mut add = |matrix: Option<&DenseMatrix>, diagonal: &mut [f64]| {
            if let Some(matrix) = matrix {
                let shapes = basis.shapes.subcols(0, kept);
                let modal = shapes.transpose() * (matrix * shapes);
                coupling = coupling.max(largest_coupling(&modal));
                for (mode, entry) in diagonal.iter_mut().enumerate() {
                    *entry += modal[(mode, mode)];
                }
            }
        };
        add(system.viscous(), &mut rates);
        add(system.structural(), &mut losses);
        let seen = &paths.sensors * &basis.shapes;
        let driven = basis.shapes.transpose() * &paths.loads;
        let mut residual = weighted(&seen, &driven, kept..available, |mode| 1.0 / basis.squared[mode]);
        if basis.has_massless {
            residual += massless_statics(system, basis, paths, &seen, &driven)?;
        }
        Ok(Self {
            squared: basis.squared[..kept].to_vec(),
            omegas: basis.omegas[..kept].to_vec(),
            rates,
            losses,
            seen: seen.subcols(0, kept).to_owned(),
            driven: driven.subrows(0, kept).to_owned(),
            residual,
            coupling,
        })
    }

    /// Number of modes kept.
    pub fn modes(&self) -> usize {
        self.squared.len()
    }

    /// Damping of a mode as a ratio of viscous damping at its own frequency, `(w_r c_r + s_r) / (2 w_r^2)`; none for a
    /// rigid mode.
    pub(crate) fn ratio(&self, mode: usize) -> Option<f64> {
        let omega = *self.omegas.get(mode)?;
        let loss = omega * self.rates[mode] + self.losses[mode];
        (omega > 0.0).then(|| loss / (2.0 * omega * omega))
    }

    /// Receptances at ascending frequencies, Hz. The frequencies are shared among threads; what is computed for one does
    /// not depend on their number.
    ///
    /// # Errors
    /// [`FrfError`].
    pub fn response(&self, frequencies_hz: &[f64]) -> Result<FrequencyResponse, FrfError> {
        check_frequencies(frequencies_hz)?;
        let (sensors, loads) = (self.seen.nrows(), self.driven.ncols());
        let receptance: Vec<Result<ComplexMatrix, FrfError>> = frequencies_hz
            .par_iter()
            .map(|&hz| {
                let amplitudes = self.amplitudes(hz)?;
                Ok(ComplexMatrix::from_fn(sensors, loads, |sensor, load| {
                    let carried: c64 =
                        (0..self.modes()).map(|mode| amplitudes[mode] * self.weight(sensor, load, mode)).sum();
                    carried + self.residual[(sensor, load)]
                }))
            })
            .collect();
        FrequencyResponse::new(frequencies_hz.to_vec(), receptance.into_iter().collect::<Result<_, _>>()?)
    }

    /// What each mode contributes to the receptance of one path at ascending frequencies (Hz) [modes + 1 x frequencies];
    /// the last row is the residual. The columns add up to the path's receptance.
    ///
    /// # Errors
    /// [`FrfError`], and as [`ModalSuperposition::response`].
    pub(crate) fn contributions(
        &self,
        sensor: usize,
        load: usize,
        frequencies_hz: &[f64],
    ) -> Result<ComplexMatrix, FrfError> {
        check_path("sensor", sensor, self.seen.nrows())?;
        check_path("load", load, self.driven.ncols())?;
        check_frequencies(frequencies_hz)?;
        let modes = self.modes();
        let columns: Vec<Vec<c64>> = frequencies_hz.iter().map(|&hz| self.amplitudes(hz)).collect::<Result<_, _>>()?;
        Ok(ComplexMatrix::from_fn(modes + 1, columns.len(), |mode, column| {
            if mode < modes {
                columns[column][mode] * self.weight(sensor, load, mode)
            } else {
                c64::new(self.residual[(sensor, load)], 0.0)
            }
        }))
    }

    fn weight(&self, sensor: usize, load: usize, mode: usize) -> f64 {
        self.seen[(sensor, mode)] * self.driven[(mode, load)]
    }

    /// `1 / (w_r^2 - w^2 + i (w c_r + s_r))` of each mode, s^2.
    fn amplitudes(&self, hz: f64) -> Result<Vec<c64>, FrfError> {
        let omega = TAU * hz;
        // the highest squared frequency, beside which a rigid one is round-off
        let elastic = self.squared.last().map_or(0.0, |last| last.abs());
        let of = |mode: usize| {
            let loss = omega * self.rates[mode] + self.losses[mode];
            let stiffness = c64::new(self.squared[mode] - omega * omega, loss);
            // an undamped mode is known to round-off of its own frequency; a rigid one of that of the first elastic ones
            let certain = f64::EPSILON / LARGEST_UNCERTAINTY * self.squared[mode].abs();
            let rigid = omega == 0.0 && self.squared[mode] <= RIGID * elastic;
            if stiffness.norm() <= certain || rigid { Err(unbounded(hz)) } else { Ok(1.0 / stiffness) }
        };
        (0..self.modes()).map(of).collect()
    }
}

/// Share of an undamped response that round-off may change before it is refused: four digits must be certain.
const LARGEST_UNCERTAINTY: f64 = 1e-4;

/// Squared frequency of a rigid mode beside the highest kept.
const RIGID: f64 = 1e-12;

/// `sum_r seen_r weight(r) driven_r` over some modes [s x p].
fn weighted(
    seen: &DenseMatrix,
    driven: &DenseMatrix,
    modes: std::ops::Range<usize>,
    weight: impl Fn(usize) -> f64,
) -> DenseMatrix {
    DenseMatrix::from_fn(seen.nrows(), driven.ncols(), |sensor, load| {
        modes.clone().map(|mode| seen[(sensor, mode)] * weight(mode) * driven[(mode, load)]).sum()
    })
}

/// Statics of motions without mass [s x p]: `d (k + t m)^-1 f` less what the modes carry of it,
/// `sum (d phi)(phi^T f) / (w_r^2 + t)`. Any t > 0 gives the same: what has no mass does not know it.
fn massless_statics(
    system: &ReducedSystem,
    basis: &ModalBasis,
    paths: &FrfPaths,
    seen: &DenseMatrix,
    driven: &DenseMatrix,
) -> Result<DenseMatrix, FrfError> {
    let count = basis.squared.len();
    // among the modes, so that neither part of the difference drowns the other
    let shift = match basis.squared.get(count / 2) {
        Some(&value) if value > 0.0 => value,
        _ => 1.0,
    };
    let shifted = system.stiffness() + system.mass() * Scale(shift);
    let moved = DenseCholesky::new(&shifted)?.solve(&paths.loads);
    let carried = weighted(seen, driven, 0..count, |mode| 1.0 / (basis.squared[mode] + shift));
    Ok(&paths.sensors * moved - carried)
}

fn largest_coupling(modal: &DenseMatrix) -> f64 {
    let pairs = (0..modal.ncols()).flat_map(|column| (0..column).map(move |row| (row, column)));
    let couplings = pairs.map(|(row, column)| {
        let size = (modal[(row, row)] * modal[(column, column)]).abs().sqrt();
        if size > 0.0 { modal[(row, column)].abs() / size } else { 0.0 }
    });
    couplings.fold(0.0, f64::max)
}

/// What one mode carries of a path in a band.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ModeShare {
    /// Mode, from 0.
    pub mode: usize,
    /// Its natural frequency, Hz.
    pub frequency_hz: f64,
    /// Its damping ratio; none for a rigid mode.
    #[serde(rename = "damping_ratio")]
    pub ratio: Option<f64>,
    /// `int Re(conj(H) H_r) df / int |H|^2 df`: 1 for a mode that is the whole response, negative for one that works against
    /// it. The shares of all modes and of the residual add up to 1; where modes cancel, some are far above it and others as
    /// far below zero.
    pub share: f64,
    /// `int |H_r|^2 df / int |H|^2 df`: what the mode alone would bring. Above its share, other modes cancel it.
    pub alone: f64,
}

/// What carries a path in a band.
#[derive(Debug, Clone, PartialEq)]
pub struct PathShares {
    /// All modes kept, the largest share in magnitude first.
    pub modes: Vec<ModeShare>,
    /// Share of the static residual of the modes left out.
    pub residual: f64,
}

impl ModalSuperposition {
    /// Shares of all modes in the receptance of one path over a band (Hz), by the trapezoidal rule over ascending
    /// `frequencies_hz` that cover the band.
    ///
    /// # Errors
    /// [`FrfError`], and as [`ModalSuperposition::contributions`].
    pub(crate) fn shares(
        &self,
        sensor: usize,
        load: usize,
        band_hz: [f64; 2],
        frequencies_hz: &[f64],
    ) -> Result<PathShares, FrfError> {
        let parts = self.contributions(sensor, load, frequencies_hz)?;
        let window = Window::new(frequencies_hz, band_hz)?;
        let count = self.modes();
        let part = |mode: usize, place: usize| parts[(mode, place)];
        let whole: Vec<c64> =
            (0..frequencies_hz.len()).map(|place| (0..=count).map(|mode| part(mode, place)).sum()).collect();
        let total = window.integral(|place| whole[place].norm_sqr());
        // a path that does not respond is carried by nothing
        let relative = |value: f64| if total > 0.0 { value / total } else { 0.0 };
        let share = |mode: usize| {
            let along = |place: usize| (whole[place].conj() * part(mode, place)).re;
            relative(window.integral(along))
        };
        let mut modes: Vec<ModeShare> = (0..count)
            .map(|mode| ModeShare {
                mode,
                frequency_hz: self.omegas[mode] / TAU,
                ratio: self.ratio(mode),
                share: share(mode),
                alone: relative(window.integral(|place| part(mode, place).norm_sqr())),
            })
            .collect();
        modes.sort_by(|a, b| b.share.abs().total_cmp(&a.share.abs()));
        Ok(PathShares { modes, residual: share(count) })
    }
}
