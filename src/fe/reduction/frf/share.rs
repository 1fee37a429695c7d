//! Which mode carries a path.

use super::band::Window;
use super::{FrfError, ModalSuperposition};
use faer::c64;
use schemars::JsonSchema;
use serde::Serialize;
use std::f64::consts::TAU;

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
