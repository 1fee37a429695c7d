//! How strong the lines of each part are in the envelope of a window: what can be compared between signals.

use crate::numerics::series::{TimeSeries, TimeWindow};
use crate::signal::diagnosis::{Diagnosis, EnvelopeOrderSpectrum, Fault, FaultOrders};
use schemars::JsonSchema;
use serde::Serialize;

/// Harmonics of each part's line.
const HARMONICS: u32 = 3;

/// A harmonic of a part's line in the order spectrum of a window's envelope.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FaultLine {
    /// The part.
    pub fault: Fault,
    /// What the field calls the line: "BPFO", "BPFI", "2 x BSF" or "FTF".
    pub line: &'static str,
    /// Which harmonic, from 1.
    pub harmonic: u32,
    /// Where it is expected, events per revolution of the shaft.
    pub expected_order: f64,
    /// Where the amplitude was found, events per revolution of the shaft.
    pub order: f64,
    /// The same at the mean speed, Hz.
    pub frequency_hz: f64,
    /// Largest amplitude within the uncertainty of the order, at least half of what the window separates, and no nearer to another
    /// part's line; in the unit of the signal, of a whitened one's squared envelope without.
    pub amplitude: f64,
}

/// The lines of all parts whose order is known, by an envelope over the shaft's angle, `turns` at a time (s): a speed that
/// changes smears nothing. The band is that of the envelope, always the same, where a verdict takes the one that shows most. The
/// order that a verdict measured, else the expected one, says which line a place is nearest to: each counts once.
/// None where the shaft rests or turns back, or the window is too short.
pub(super) fn fault_lines(
    envelope: &TimeSeries,
    window: TimeWindow,
    turns: impl Fn(f64) -> f64,
    orders: &FaultOrders,
    speed_hz: f64,
    diagnosis: Option<&Diagnosis>,
) -> Vec<FaultLine> {
    let highest = f64::from(HARMONICS + 1) * orders.highest();
    let Ok(spectrum) = EnvelopeOrderSpectrum::new(envelope, window, turns, highest) else {
        return Vec::new();
    };
    let resolved = 1.0 / spectrum.turns;
    let measured = |fault: Fault| {
        let found = diagnosis?;
        let verdict = found.faults.iter().find(|verdict| verdict.fault == fault)?;
        Some(verdict.order? * found.speed_hz / found.given_speed_hz)
    };
    let lines = || Fault::ALL.into_iter().flat_map(|fault| (1..=HARMONICS).map(move |harmonic| (fault, harmonic)));
    let places = lines().filter_map(|(fault, harmonic)| {
        let order = measured(fault).or_else(|| orders.order(fault))?;
        Some((fault, f64::from(harmonic) * order))
    });
    let places: Vec<(Fault, f64)> = places.collect();
    let nearest = |order: f64| {
        let distance = |place: &&(Fault, f64)| (place.1 - order).abs();
        places.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).map(|place| place.0)
    };
    let line = |fault: Fault, harmonic: u32| {
        let expected_order = f64::from(harmonic) * orders.order(fault)?;
        let reach = (orders.error(fault) * expected_order).max(0.5 * resolved);
        let bins = spectrum.order.iter().copied().zip(spectrum.amplitude.iter().copied());
        let near = bins.filter(|(order, _)| (order - expected_order).abs() <= reach && nearest(*order) == Some(fault));
        let (order, amplitude) = near.max_by(|a, b| a.1.total_cmp(&b.1))?;
        // below the first bin that is no mean, the window itself is seen; above the highest nothing is
        let seen = expected_order >= resolved && expected_order <= spectrum.highest;
        let line = fault.line();
        seen.then_some(FaultLine {
            fault,
            line,
            harmonic,
            expected_order,
            order,
            frequency_hz: order * speed_hz,
            amplitude,
        })
    };
    lines().filter_map(|(fault, harmonic)| line(fault, harmonic)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    /// A run-up from 10 to 40 Hz in 2 s.
    fn turns(t: f64) -> f64 {
        10.0 * t + 7.5 * t * t
    }

    #[test]
    fn amplitudes_of_a_run_up_are_those_of_its_lines() {
        let orders = FaultOrders::new([Some(3.57), Some(5.43), None, Some(0.397)], 0.0).unwrap();
        let values = (0..40_000).map(|k| {
            let angle = TAU * 3.57 * turns(f64::from(k) / 20e3);
            3.0 + 0.5 * angle.cos() + 0.2 * (2.0 * angle).cos()
        });
        let envelope = TimeSeries::new(0.0, 1.0 / 20e3, "g", values.collect()).unwrap();
        let window = TimeWindow { from: 0.0, to: 2.0 };
        let lines = fault_lines(&envelope, window, turns, &orders, 25.0, None);
        let amplitude = |fault: Fault, harmonic: u32| {
            let found = lines.iter().find(|line| line.fault == fault && line.harmonic == harmonic);
            found.unwrap().amplitude
        };
        let sinc = |x: f64| (PI * x).sin() / (PI * x);
        // half of the resolution of 50 turns is how far from its place a line is looked for
        let side_lobes = |order: f64| {
            let of = |(line, height): (f64, f64)| {
                let distances = [(order - line).abs() - 0.01, order + line - 0.01];
                distances.into_iter().filter(|d| *d > 0.0).map(|d| height / (PI * 50.0 * d)).sum::<f64>()
            };
            [(3.57, 0.5), (7.14, 0.2)].map(of).iter().sum::<f64>()
        };
        for (harmonic, height) in [(1, 0.5), (2, 0.2)] {
            let order = 3.57 * f64::from(harmonic);
            // a mean over 1 / P of a turn takes sinc(order / P), P 2.5 times the order after the third harmonic of the inner race
            let most = height * sinc(order / (2.5 * 4.0 * 5.43));
            // a line halfway between two of the bins, eight a resolution
            let least = most * sinc(1.0 / 16.0);
            let (found, lobes) = (amplitude(Fault::OuterRace, harmonic), side_lobes(order));
            assert!((least - lobes..=most + lobes).contains(&found), "{harmonic}: {found}, {least} to {most}");
        }
        assert!(amplitude(Fault::InnerRace, 1) < side_lobes(5.43));
        assert!(lines.iter().all(|line| line.fault != Fault::Ball), "its order is not known");
        assert!((lines[0].frequency_hz - 25.0 * lines[0].order).abs() < 1e-12);
        assert!(fault_lines(&envelope, window, |_| 0.0, &orders, 0.0, None).is_empty(), "a shaft at rest");
    }
    /// Twice the order of the inner race is within 1 % of three times that of the outer race.
    #[test]
    fn a_line_counts_for_the_part_that_it_is_nearest_to() {
        let orders = FaultOrders::new([Some(3.585), Some(5.415), None, None], 0.01).unwrap();
        let values = (0..80_000).map(|k| 3.0 + 0.5 * (TAU * 3.0 * 3.585 * 25.0 * f64::from(k) / 20e3).cos());
        let envelope = TimeSeries::new(0.0, 1.0 / 20e3, "g", values.collect()).unwrap();
        let window = TimeWindow { from: 0.0, to: 4.0 };
        let lines = fault_lines(&envelope, window, |t| 25.0 * t, &orders, 25.0, None);
        let amplitude = |fault: Fault, harmonic: u32| {
            lines.iter().find(|line| line.fault == fault && line.harmonic == harmonic).unwrap().amplitude
        };
        assert!(amplitude(Fault::OuterRace, 3) > 0.3, "{lines:?}");
        // 0.0375 of an order away, 3.75 times the resolution: side lobes alone
        assert!(amplitude(Fault::InnerRace, 2) < 0.1, "{lines:?}");
    }
}
