//! How long a window has to be for a part's lines to be told from the floor and from the shaft's.

use super::comb::{LEAST_FREE, SHOWN_HARMONICS};
use super::fault::{Fault, FaultOrders};
use super::known::{SHORT_WIDTH, STRONG_HALF_WIDTH};
use super::line_spectrum::REVOLUTIONS;
use super::search::turns_needed;

impl FaultOrders {
    /// Revolutions of the shaft that a window needs for a verdict on a part whose order is exact. `None` where its order is not known,
    /// or where its lines lie so close to the shaft's that no window tells them apart.
    pub(crate) fn turns_to_judge(&self, fault: Fault) -> Option<f64> {
        let order = self.order(fault)?;
        let distance = |harmonic: u32| {
            let line = f64::from(harmonic) * order;
            (line - line.round().max(1.0)).abs()
        };
        let mut distances: Vec<f64> = (1..=SHOWN_HARMONICS).map(distance).collect();
        let first = distances[0].max(distances[1]);
        distances.sort_by(|a, b| b.total_cmp(a));
        let least = distances[LEAST_FREE - 1].min(first);
        // of longer windows stretches of 64 revolutions are averaged, which are no finer
        let apart = SHORT_WIDTH * STRONG_HALF_WIDTH / least;
        (apart < 1.5 * REVOLUTIONS).then(|| apart.max(turns_needed(order)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_close_to_the_shafts_need_long_windows() {
        let turns = |order: f64| {
            let orders = FaultOrders::new([Some(order), None, None, None], 0.0).unwrap();
            orders.turns_to_judge(Fault::OuterRace)
        };
        // the second harmonic is 0.09 from the shaft's sixth: 2 / 0.09
        assert!((turns(3.045).unwrap() - 22.2).abs() < 0.1);
        // the third harmonic that is farthest from the shaft's, the fourth: 2 / 0.34
        assert!((turns(3.585).unwrap() - 5.88).abs() < 0.05);
        // the floor decides, 16 / 2.4
        assert!((turns(2.4).unwrap() - 6.67).abs() < 0.01);
        // the ball of 6203: 2 / 0.026
        assert!((turns(3.987).unwrap() - 76.9).abs() < 0.1);
        assert_eq!(turns(3.005), None);
        assert_eq!(turns(4.0), None);
        let orders = FaultOrders::new([None; 4], 0.0).unwrap();
        assert_eq!(orders.turns_to_judge(Fault::OuterRace), None);
    }
}
