//! How small perturbations of a start grow along a run. They do so in every model of it, and whatever a model errs by grows as they do.

use super::pilot::{self, SHORTER, Stepped};
use crate::app::commands::run::Span;
use crate::app::scene::RunModel;
use crate::numerics::ode::Method;
use crate::numerics::series::TimeSeries;

/// Size of the perturbation, relative: far above round-off, far below what changes how it grows.
const SIZE: f64 = 1e-9;

/// How often equal steps are halved that impacts make unstable.
const HALVINGS: u32 = 3;

/// Periods of the band's highest frequency in a window.
const PERIODS: f64 = 10.0;

/// The distance of two runs whose starts differ by a small perturbation, in windows of equal length: the root mean square in the band of
/// the sensor whose distance grows most.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Growth {
    window_s: f64,
    /// Of each window its distance over that of the first one.
    by_window: Vec<f64>,
}

impl Growth {
    /// Over a stretch that begins (s) at rest. Both runs have `model` in equal steps: a tolerance would take other steps in one than in the other.
    ///
    /// # Errors
    /// Why one of them cannot be stepped.
    pub(crate) fn of(
        scene: &impl Stepped,
        model: &RunModel,
        span: Span,
        begin: f64,
        band_hz: f64,
    ) -> Result<Self, String> {
        let by_tolerance =
            matches!(model.method, Method::ExponentialAdams { tolerance: Some(_) } | Method::Dop853 { .. });
        let mut model = *model;
        let mut halvings = 0;
        if by_tolerance {
            model.method = Method::ExponentialAdams { tolerance: None };
            (model.step, halvings) = (SHORTER * model.step, HALVINGS);
        }
        let both = loop {
            let signals = |size| pilot::stretch(scene, &model, span, [begin, size], band_hz);
            let both = rayon::join(|| signals(0.0), || signals(SIZE));
            if halvings == 0 || both.0.is_ok() && both.1.is_ok() {
                break both;
            }
            halvings -= 1;
            model.step *= 0.5;
        };
        let (plain, perturbed) = (both.0?, both.1?);
        let sensors = plain.iter().zip(&perturbed);
        let window_s = PERIODS / band_hz;
        let mut by_window = Vec::new();
        for (plain, perturbed) in sensors {
            for (number, found) in relative_to_first(plain, perturbed, window_s).into_iter().enumerate() {
                match by_window.get_mut(number) {
                    None => by_window.push(found),
                    Some(most) => *most = f64::max(*most, found),
                }
            }
        }
        Ok(Self { window_s, by_window })
    }

    /// Until when it grows at most so many times, s since the begin; infinite where it never grows more.
    pub(crate) fn time_s(&self, times: f64) -> f64 {
        let windows = self.by_window.iter().position(|found| *found > times);
        windows.map_or(f64::INFINITY, |windows| windows as f64 * self.window_s)
    }

    /// How many times it has grown at most until a time since the begin, s; 1 where it shrinks.
    pub(crate) fn until(&self, time_s: f64) -> f64 {
        let windows = (time_s / self.window_s).ceil().max(1.0) as usize;
        self.by_window.iter().take(windows).copied().fold(1.0, f64::max)
    }
}

/// The distance of two series in each window over that in the first where there is one.
fn relative_to_first(a: &TimeSeries, b: &TimeSeries, window_s: f64) -> Vec<f64> {
    let length = ((window_s / a.step_s()).round() as usize).max(1);
    let windows = a.values().chunks(length).zip(b.values().chunks(length));
    let distance = |(a, b): (&[f64], &[f64])| {
        let squares: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
        (squares / a.len() as f64).sqrt()
    };
    let distances: Vec<f64> = windows.map(distance).collect();
    let first = distances.iter().copied().find(|distance| *distance > 0.0).unwrap_or(1.0);
    distances.into_iter().map(|distance| distance / first).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A distance that doubles from window to window: 2 to the power 3 is passed in the fifth.
    #[test]
    fn growth_is_that_of_the_distance_from_the_first_window_on() {
        let series = |size: f64| {
            let values = (0..80).map(|sample| 1.0 + size * f64::from(1 << (sample / 10)));
            TimeSeries::new(2.3, 1e-4, "m/s^2", values.collect()).unwrap()
        };
        let by_window = relative_to_first(&series(0.0), &series(1e-9), 1e-3);
        let growth = Growth { window_s: 1e-3, by_window };
        // but for the rounding of 1e-9 beside 1
        assert!((growth.until(3.5e-3) / 8.0 - 1.0).abs() < 1e-5, "{growth:?}");
        assert!((growth.time_s(9.0) - 4e-3).abs() < 1e-12, "{growth:?}");
        assert!(growth.time_s(1e3).is_infinite());
        let still = Growth { window_s: 1e-3, by_window: relative_to_first(&series(0.0), &series(0.0), 1e-3) };
        assert!((still.until(1.0) - 1.0).abs() < 1e-12, "{still:?}");
    }
}
