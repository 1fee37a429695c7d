//! The report's section on loaded frequencies as the balls go round.

use crate::report::{Abscissa, Axis, Curve, CurveStyle, Plot, Section};
use crate::system::{LoadedPass, LoadedPoint};

/// The section of a report.
pub(crate) fn loaded_pass_section(pass: &LoadedPass) -> Section {
    let angle = chart(
        "Loaded frequencies over a ball pass",
        Axis::new("Cage turned by", "deg"),
        &pass.over_angle,
        f64::to_degrees,
    );
    let load = chart(
        "Loaded frequencies over the load",
        Axis::new("Load on the shaft, in units of the case's", "").log(),
        &pass.over_load,
        |factor| factor,
    );
    Section::new("Loaded frequencies as the balls go round").plot(angle).plot(load)
}

/// The lowest frequencies of modes that are not the balls' own, by their number.
fn chart(title: &str, x: Axis, points: &[LoadedPoint], show: impl Fn(f64) -> f64) -> Plot {
    let places: Vec<f64> = points.iter().map(|point| show(point.at)).collect();
    let frequencies: Vec<Vec<f64>> = points
        .iter()
        .map(|point| {
            let modes = point.modes.iter().flat_map(|loaded| &loaded.modes);
            let held = modes.filter(|mode| !mode.is_ball_mode());
            held.map(|mode| mode.frequency_hz).take(DRAWN).collect()
        })
        .collect();
    let mut plot = Plot::new(title, x, Axis::new("Frequency", "Hz").log()).caption(
        "Each angle and load at its own equilibrium, without the modes that are the balls' own; numbered by frequency, so that two curves that come close may exchange their modes.",
    );
    for mode in 0..DRAWN {
        let values = frequencies.iter().map(|found| found.get(mode).copied().unwrap_or(f64::NAN));
        let values: Vec<f64> = values.collect();
        if values.iter().any(|value| value.is_finite()) {
            let curve = Curve::new(format!("mode {}", mode + 1), Abscissa::Points(places.clone()), values);
            plot = plot.curve(curve.style(CurveStyle::Line));
        }
    }
    plot
}

/// Frequencies drawn.
const DRAWN: usize = 8;
