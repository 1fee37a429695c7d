//! The lines of an inner race that lie beside the shaft's multiples: at BPFI = 4.95 its harmonics and sidebands are a comb at 0.99 of the shaft's.

use super::fault::{Fault, FaultOrders};

/// Harmonics of the race, and sidebands on each side of one, that are looked for.
const HARMONICS: u32 = 2;
const SIDEBANDS: f64 = 3.0;
/// Times the shaft's comb that the race's lines have to score. The largest of 53 measured bearings whose shaft is known to turn at another speed
/// than the given one is 0.85 (0.86 to 0.97 where its lines are blurred); made inner races of four bearings score 1.07 to 1.57.
const BETTER: f64 = 1.05;

/// Whether the lines of these orders' inner race explain more of the `level` of an order than the comb of these multiples of the shaft at
/// another speed does, which scores `shafts`. The race turns at the given speed, whose relative uncertainty is the first of two errors; none
/// of its lines is farther from a multiple that it is taken for than the second, relative. Speeds are tried `step` apart.
pub(super) fn inner_race_explains_more(
    orders: &FaultOrders,
    [speed_error, farthest]: [f64; 2],
    shafts: f64,
    multiples: &[f64],
    step: f64,
    level: &impl Fn(f64) -> f64,
) -> bool {
    let (Some(order), Some(highest)) = (orders.order(Fault::InnerRace), multiples.last()) else {
        return false;
    };
    let step_of_order = 0.5 * step * highest / order;
    around(speed_error, step).any(|speed| {
        around(orders.error(Fault::InnerRace), step_of_order).any(|factor| {
            let lines = multiples.iter();
            let lines = lines.map(|&multiple| nearest(multiple, factor * order, farthest));
            lines.map(|line| level(speed * line)).sum::<f64>() > BETTER * shafts
        })
    })
}

/// The line of a race of this order that may be taken for a multiple of the shaft's, with the fewest sidebands between; the multiple itself
/// where there is none within the relative distance `farthest`.
fn nearest(multiple: f64, order: f64, farthest: f64) -> f64 {
    let lines = (1..=HARMONICS).map(|harmonic| {
        let carrier = f64::from(harmonic) * order;
        let sideband = (multiple - carrier).round();
        (carrier + sideband, sideband.abs())
    });
    let near = lines.filter(|(line, sideband)| *sideband <= SIDEBANDS && (line - multiple).abs() < farthest * multiple);
    let nearest = near.min_by(|a, b| a.1.total_cmp(&b.1));
    nearest.map_or(multiple, |(line, _)| line)
}

/// Factors within `reach` of 1, at most `step` apart.
fn around(reach: f64, step: f64) -> impl Iterator<Item = f64> {
    let steps = (reach / step).ceil().max(1.0);
    let places = -(steps as i32)..=steps as i32;
    places.map(move |place| 1.0 + reach * f64::from(place) / steps)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    /// BPFI = 4.95: sidebands of the first harmonic up to the seventh multiple, of the second from the eighth on.
    #[test]
    fn the_lines_beside_the_shafts_multiples() {
        let expected = [1.0, 1.95, 2.95, 3.95, 4.95, 5.95, 6.95, 7.9, 8.9, 9.9, 10.9, 11.9];
        for (multiple, expected) in (1..=12).zip(expected) {
            let line = nearest(f64::from(multiple), 4.95, 0.03);
            assert!((line - expected).abs() < 1e-12, "{multiple}: {line}");
        }
        // none of its lines is near a multiple
        assert!((nearest(5.0, 5.42, 0.03) - 5.0).abs() < 1e-12);
    }
}
