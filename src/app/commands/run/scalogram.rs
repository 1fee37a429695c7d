//! Amplitude of a sensor's acceleration over time and frequency, in the window that the case names.

use super::recording::Recording;
use super::simulation::Simulation;
use crate::app::case::ScalogramWindow;
use crate::app::error::ComputeError;
use crate::numerics::series::TimeWindow;
use crate::report::{Abscissa, Axis, Curve, CurveStyle, Plot, Raster, Section, given, significant};
use crate::signal::{FrequencyAxis, Scalogram, WaveletTransform};
use std::f64::consts::TAU;

/// Frequencies of a scalogram, and instants of it at most: what a picture on a page can show.
const FREQUENCIES: usize = 200;
const INSTANTS: f64 = 1200.0;

/// What is read of a signal before and after the window, in standard deviations of the wavelet at the lowest frequency: its amplitudes
/// then depend on nothing beyond what is read.
const MARGIN: f64 = 8.6;

/// Decades of amplitude that the colours show.
const DECADES: f64 = 2.0;

/// The scalogram of a sensor in a window.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorScalogram {
    /// Name of the sensor.
    pub sensor: String,
    /// What was asked for.
    pub window: ScalogramWindow,
    /// Amplitudes in the window, m/s^2.
    pub scalogram: Scalogram,
    /// What of the signal was read, s: the cone of influence begins at its ends.
    pub read: TimeWindow,
}

impl SensorScalogram {
    /// Of sensor number `index` of a simulation.
    ///
    /// # Errors
    /// [`ComputeError::Series`] for a window that is not in the record, [`ComputeError::Signal`] for a band that its length or its sampling
    /// rate does not hold, and what reading it returns.
    pub(crate) fn of<R: Recording>(
        simulation: &Simulation<R>,
        index: usize,
        window: ScalogramWindow,
    ) -> Result<Self, ComputeError> {
        let (from, to) = (window.from, window.to);
        let [from_hz, to_hz] = window.band_hz;
        let margin_s = MARGIN * window.cycles / (TAU * from_hz);
        let stretch = simulation.stretch(index, TimeWindow { from, to }, margin_s)?;
        let samples = (to - from) / stretch.step_s();
        let transform = WaveletTransform {
            frequencies: FrequencyAxis::Logarithmic { from_hz, to_hz, count: FREQUENCIES },
            cycles: window.cycles,
            decimation: (samples / INSTANTS).ceil().max(1.0) as usize,
        };
        let sensors = simulation.record.layout().sensors;
        Ok(Self {
            sensor: sensors.get(index).cloned().unwrap_or_default(),
            window,
            scalogram: transform.scalogram(&stretch)?.within(from, to),
            read: stretch.span(),
        })
    }

    /// The section of a report.
    pub fn section(&self) -> Section {
        let (sensor, scalogram) = (&self.sensor, &self.scalogram);
        let ScalogramWindow { from, to, .. } = self.window;
        let largest = scalogram.amplitude.iter().copied().fold(0.0, f64::max);
        let section = Section::new(format!("Scalogram of {sensor}"));
        let [.., before, last] = scalogram.time_s[..] else {
            return section.paragraph("The window holds less than two instants.");
        };
        if largest <= 0.0 {
            return section.paragraph("The signal is zero throughout.");
        }
        let half = 0.5 * (last - before);
        let colours = Axis::new("Amplitude", scalogram.unit.clone());
        let plot = Plot::new(
            format!("Scalogram of {sensor}, {} to {} s", given(from), given(to)),
            Axis::new("Time", "s").range(from, to),
            Axis::new("Frequency", "Hz").log(),
        )
        .raster(Raster {
            x: [scalogram.time_s[0] - half, last + half],
            y: self.window.band_hz,
            columns: scalogram.time_s.len(),
            values: scalogram.amplitude.clone(),
            colours: colours.decades_below(largest, DECADES),
        })
        .tall()
        .caption(format!(
            "Continuous wavelet transform, analytic Morlet wavelet of {} cycles, calibrated: a vibration of one frequency reads its amplitude. Outside the dashed line, if there is one, amplitudes depend on what lies beyond the ends of the signal.",
            significant(self.window.cycles, 3)
        ));
        let plot = self.cone().into_iter().fold(plot, Plot::curve);
        section.plot(plot)
    }

    /// Its cone of influence at those ends of what was read that lie in the window.
    fn cone(&self) -> Vec<Curve> {
        let (window, scalogram) = (self.window, &self.scalogram);
        let at = |end: f64, sign: f64| {
            let times = scalogram.cone_s.iter().map(|cone| end + sign * cone);
            let x = Abscissa::Points(times.collect());
            Curve::new("", x, scalogram.frequency_hz.clone()).style(CurveStyle::Dashed)
        };
        let furthest = scalogram.cone_s.iter().copied().fold(0.0, f64::max);
        let begins = self.read.from + furthest > window.from;
        let ends = self.read.to - furthest < window.to;
        let first = begins.then(|| at(self.read.from, 1.0));
        let last = ends.then(|| at(self.read.to, -1.0));
        first.into_iter().chain(last).collect()
    }
}

#[cfg(test)]
mod tests {
    use crate::app::case::Case;
    use crate::app::commands::run::compute_run;
    use crate::numerics::Unwatched;

    #[test]
    fn a_run_has_the_scalogram_that_its_case_names() {
        let asked = "analysis.scalogram={from=0.5e-3,to=2.5e-3,band_hz=[4000,40000],cycles=4}";
        let case = Case::example("scenes/impact", &["transient.end=3e-3", asked]);
        let result = compute_run(&case, &Unwatched).unwrap();
        let [of_sensor] = &result.scalograms[..] else {
            panic!("{} scalograms", result.scalograms.len());
        };
        let scalogram = &of_sensor.scalogram;
        let (first, last) = (scalogram.time_s[0], *scalogram.time_s.last().unwrap());
        assert!(first >= 0.5e-3 && last <= 2.5e-3 && last - first > 1.9e-3);
        assert_eq!(scalogram.amplitude.len(), 200 * scalogram.time_s.len());
        // what is read begins in the run, three wavelets long: both cones are outside but for the lowest frequencies
        let signal = result.simulation.signal(0).unwrap();
        let largest = signal.values().iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        let most = scalogram.amplitude.iter().copied().fold(0.0, f64::max);
        assert!(most > 0.05 * largest && most < 2.0 * largest, "{most} of {largest}");
        let section = of_sensor.section();
        assert_eq!(section.title, "Scalogram of P1");
    }

    #[test]
    fn a_band_that_the_window_does_not_hold_is_named() {
        let asked = "analysis.scalogram={from=0.5e-3,to=0.6e-3,band_hz=[20,40000]}";
        let case = Case::example("scenes/smooth", &["transient.end=1e-3", asked]);
        let result = compute_run(&case, &Unwatched).unwrap();
        assert!(result.scalograms.is_empty());
        let [why] = &result.not_analysed[..] else {
            panic!("{:?}", result.not_analysed);
        };
        assert!(why.starts_with("P1: ") && why.contains("20 Hz"), "{why}");
    }
}
