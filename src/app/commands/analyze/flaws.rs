//! What is wrong with a signal before anything is judged: clipped samples, stretches that stand still, a spectrum that ends early, a
//! speed of another time.

use crate::formats::MeasuredSignal;
use crate::numerics::series::{TimeSeries, TimeWindow};
use crate::report::significant;
use crate::signal::diagnosis::{Kinematics, spectrum_end_hz};

/// Share of clipped samples that is said: fewer are a spike or two.
const CLIPPED: f64 = 1e-3;
/// Share of a signal that may stand still, and fewest equal samples in a row that are said.
const STILL: f64 = 0.01;
const STILL_SAMPLES: f64 = 100.0;

/// What a sensor or a converter did to a signal that is not constant, in its windows (s) or as a whole: a sentence each. Of a simulated
/// signal, which is accurate to `good_to_hz`, nothing is said of where its spectrum ends.
#[must_use]
pub fn signal_flaws(
    signal: &MeasuredSignal,
    windows: &[TimeWindow],
    good_to_hz: Option<f64>,
    kinematics: Option<&Kinematics<'_>>,
) -> Vec<String> {
    let all = [signal.series.span()];
    let windows = if windows.is_empty() { &all } else { windows };
    // a window outside the signal is named where it is analysed
    let parts = windows.iter().filter_map(|window| signal.series.window(window.from, window.to).ok());
    let gap = kinematics.and_then(|kinematics| speed_gap(kinematics, signal.series.span()));
    let flaws =
        parts.flat_map(|part| [flaws_of(&signal.name, &part), end_of(&signal.name, &part, good_to_hz)].concat());
    gap.into_iter().chain(flaws).collect()
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

fn end_of(name: &str, series: &TimeSeries, good_to_hz: Option<f64>) -> Vec<String> {
    let end_hz = spectrum_end_hz(series).filter(|_| good_to_hz.is_none());
    let said = end_hz.map(|end_hz| {
        format!(
            "{name}: nothing above {} Hz, as of a low-pass or a change to a higher sampling rate: verdicts look below, unless --band says otherwise",
            significant(end_hz, 2)
        )
    });
    said.into_iter().collect()
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::commands::analyze::{AnalysisSettings, compute_analysis};
    use crate::bearing::SpeedProfile;
    use crate::numerics::Unwatched;
    use crate::signal::band_limit;
    use crate::signal::diagnosis::FaultOrders;
    use crate::signal::samples::gaussian;

    #[test]
    fn a_signal_that_ends_early_is_told_and_judged_below() {
        let noise = TimeSeries::new(0.0, 1.0 / 24e3, "g", gaussian(96_000, 7)).unwrap();
        let series = band_limit(&noise, 8e3).unwrap();
        let signal =
            MeasuredSignal { name: "P1".to_owned(), series, speed_hz: None, own_rate_hz: None, doubts: Vec::new() };
        let said = signal_flaws(&signal, &[], None, None);
        assert_eq!(said.len(), 1);
        assert!(said[0].starts_with("P1: nothing above 8"), "{said:?}");
        assert!(signal_flaws(&signal, &[], Some(12e3), None).is_empty());
        let motion = Kinematics::Given {
            orders: FaultOrders::new([Some(3.5848), Some(5.4152), Some(4.7135), None], 0.01).unwrap(),
            speed: SpeedProfile::constant(30.0).unwrap(),
        };
        let highest = |good_to_hz: Option<f64>| {
            let settings = AnalysisSettings { good_to_hz, ..AnalysisSettings::default() };
            let windows = compute_analysis(std::slice::from_ref(&signal), &settings, &motion, &Unwatched).unwrap();
            let found = windows[0].diagnosis.as_ref().unwrap();
            found.faults.iter().filter_map(|verdict| verdict.band_hz).fold(0.0, |most: f64, band| most.max(band[1]))
        };
        assert!(highest(None) < 9e3);
        assert!((highest(Some(12e3)) - highest(None)).abs() > 1.0);
    }
}
