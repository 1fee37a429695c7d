//! The curve of an envelope's lines over orders, as reports draw it.

use crate::report::{Curve, CurveStyle};
use crate::signal::diagnosis::EnvelopeOrderSpectrum;

/// Points of an order spectrum that are drawn.
const DRAWN_POINTS: usize = 20_000;

/// Highest order that is drawn: three harmonics of usual races.
const DRAWN_ORDERS: f64 = 16.0;

/// An order spectrum as it is drawn: of a long window, so many neighbours' largest each, so that no line is lost.
pub(crate) fn order_curve(name: &str, spectrum: &EnvelopeOrderSpectrum) -> Curve {
    let step = spectrum.order.get(1).copied().unwrap_or(1.0);
    let count = ((last_order(spectrum) / step) as usize + 1).min(spectrum.amplitude.len());
    let group = count.div_ceil(DRAWN_POINTS).max(1);
    let largest = |group: &[f64]| group.iter().fold(0.0_f64, |most, &value| most.max(value));
    let drawn = spectrum.amplitude[..count].chunks(group).map(largest).collect();
    let even = crate::report::Abscissa::Even { start: 0.5 * (group - 1) as f64 * step, step: group as f64 * step };
    Curve::new(name, even, drawn).style(CurveStyle::Line)
}

/// Where the drawing of an order spectrum ends.
pub(crate) fn last_order(spectrum: &EnvelopeOrderSpectrum) -> f64 {
    spectrum.order.last().map_or(DRAWN_ORDERS, |last| last.min(DRAWN_ORDERS))
}
