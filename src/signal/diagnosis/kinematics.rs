//! How shaft and balls move: what orders and speeds of an analysis come from.

use super::{DiagnosisError, FaultOrders};
use crate::bearing::kinematics::DefectOrders;
use crate::bearing::{BearingGeometry, Cage, SpeedProfile};
use crate::numerics::series::TimeWindow;
use std::f64::consts::TAU;

/// Motion of a machine whose signal is analysed.
#[derive(Debug)]
pub enum Kinematics<'a> {
    /// A case's: the cage slips and the shaft turns as it says.
    Cage {
        /// The cage on its shaft.
        cage: &'a Cage,
        /// Number of balls.
        balls: u32,
        /// Orders of pure rolling.
        rolling: DefectOrders,
        /// Relative error of the orders, 0 to 0.1.
        error: f64,
    },
    /// Orders and a speed that were given.
    Given {
        /// The orders.
        orders: FaultOrders,
        /// The shaft's speed.
        speed: SpeedProfile,
    },
}

impl<'a> Kinematics<'a> {
    /// Of a simulated bearing, whose motion is known exactly.
    pub(crate) fn of(cage: &'a Cage, geometry: &BearingGeometry) -> Self {
        Self::Cage { cage, balls: geometry.balls(), rolling: geometry.orders(), error: 0.0 }
    }

    fn shaft(&self) -> &SpeedProfile {
        match self {
            Self::Cage { cage, .. } => cage.shaft(),
            Self::Given { speed, .. } => speed,
        }
    }

    /// Angle of the shaft at a time (s), in turns.
    pub(crate) fn turns(&self, time: f64) -> f64 {
        self.shaft().angle(time) / TAU
    }

    /// Mean speed of the shaft in a window, either way, Hz.
    pub(crate) fn mean_speed_hz(&self, window: TimeWindow) -> f64 {
        let turned = self.turns(window.to) - self.turns(window.from);
        (turned / (window.to - window.from)).abs()
    }

    /// How far the speed of the shaft changes in a window: the highest less the lowest, Hz.
    pub(crate) fn speed_spread_hz(&self, window: TimeWindow) -> f64 {
        let shaft = self.shaft();
        let (from, to) = (window.from, window.to);
        let knots = shaft.knot_times().filter(|&time| from < time && time < to);
        let speeds = knots.chain([from, to]).map(|time| shaft.speed(time) / TAU);
        let ends = [f64::INFINITY, f64::NEG_INFINITY];
        let [lowest, highest] = speeds.fold(ends, |[low, high], speed| [low.min(speed), high.max(speed)]);
        highest - lowest
    }

    /// Orders of the faults in a window. With the cage's slip: outer `N r`, inner `N (1 - r)` for a cage order r. The
    /// ball's own spin is not prescribed; its order stays that of pure rolling.
    ///
    /// # Errors
    /// [`DiagnosisError`] for orders that are none.
    pub(crate) fn orders(&self, window: TimeWindow) -> Result<FaultOrders, DiagnosisError> {
        match self {
            Self::Cage { cage, balls, rolling, error } => {
                let ratio = cage.ratio_between(window.from, window.to);
                let balls = f64::from(*balls);
                let orders =
                    DefectOrders { cage: ratio, outer: balls * ratio, inner: balls * (1.0 - ratio), ..*rolling };
                FaultOrders::of(&orders, *error)
            }
            Self::Given { orders, .. } => Ok(*orders),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing::SpeedKnot;

    #[test]
    fn the_spread_of_the_speed_is_that_within_the_window() {
        let knots = [(0.0, 10.0), (1.0, 30.0), (2.0, 20.0)];
        let knots = knots.map(|(time, frequency_hz)| SpeedKnot { time, frequency_hz });
        let motion = Kinematics::Given {
            orders: FaultOrders::new([Some(3.5), None, None, None], 0.01).unwrap(),
            speed: SpeedProfile::new(&knots).unwrap(),
        };
        for (from, to, expected) in [(0.0, 1.0, 20.0), (0.5, 1.5, 10.0), (1.25, 1.75, 5.0), (2.0, 9.0, 0.0)] {
            let spread = motion.speed_spread_hz(TimeWindow { from, to });
            assert!((spread - expected).abs() < 1e-9, "{from}-{to}: {spread}");
        }
    }
}
