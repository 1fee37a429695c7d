//! What is wrong with a signal before anything is judged: clipped samples, stretches that stand still, a speed of another time.

use crate::formats::MeasuredSignal;
use crate::numerics::series::{TimeSeries, TimeWindow};
use crate::report::significant;
use crate::signal::diagnosis::Kinematics;

/// Share of clipped samples that is said: fewer are a spike or two.
const CLIPPED: f64 = 1e-3;
/// Share of a signal that may stand still, and fewest equal samples in a row that are said.
const STILL: f64 = 0.01;
const STILL_SAMPLES: f64 = 100.0;

/// What a sensor or a converter did to a signal that is not constant, in its windows (s) or as a whole: a sentence each.
#[must_use]
pub fn signal_flaws(
    signal: &MeasuredSignal,
    windows: &[TimeWindow],
    kinematics: Option<&Kinematics<'_>>,
) -> Vec<String> {
    let all = [signal.series.span()];
    let windows = if windows.is_empty() { &all } else { windows };
    // a window outside the signal is named where it is analysed
    let parts = windows.iter().filter_map(|window| signal.series.window(window.from, window.to).ok());
    let gap = kinematics.and_then(|kinematics| speed_gap(kinematics, signal.series.span()));
    gap.into_iter().chain(parts.flat_map(|part| flaws_of(&signal.name, &part))).collect()
}

/// That a speed was given for other times than those of a signal (s), if it was.
fn speed_gap(kinematics: &Kinematics<'_>, span: TimeWindow) -> Option<String> {
    let Kinematics::Given { speed, .. } = kinematics else { return None };
    let knots: Vec<f64> = speed.knot_times().collect();
    let &[first, .., last] = knots.as_slice() else { return None };
    let covered = first <= span.from && span.to <= last;
    let [first, last, from, to] = [first, last, span.from, span.to].map(|value| significant(value, 5));
    (!covered).then(|| {
        format!("the speed is given from {first} to {last} s, and the signal lasts from {from} to {to} s: the speeds at the ends go on")
    })
}

fn flaws_of(name: &str, series: &TimeSeries) -> Vec<String> {
    let samples = series.values().len() as f64;
    let mut said = Vec::new();
    let clipped = series.clipped_share();
    if clipped >= CLIPPED {
        said.push(format!(
            "{name}: {} % of the samples stand at the end of a range: clipping makes lines and hides others",
            significant(100.0 * clipped, 2)
        ));
    }
    let still = series.longest_still();
    let count = ((still.to - still.from) / series.step_s()).round();
    if count >= STILL_SAMPLES.max(STILL * samples) && count < samples {
        said.push(format!(
            "{name}: nothing changes from {} to {} s: analyse the rest alone",
            significant(still.from, 5),
            significant(still.to, 5)
        ));
    }
    said
}
