//! Faults and the orders at which they show.
//!
//! How shaft and balls move: what orders and speeds of an analysis come from.

use super::DiagnosisError;
use crate::bearing::kinematics::DefectOrders;
use crate::bearing::{Cage, SpeedProfile};
use crate::numerics::series::TimeWindow;
use schemars::JsonSchema;
use serde::Serialize;
use std::f64::consts::TAU;

/// Highest order that is believed: 200 balls.
const HIGHEST_ORDER: f64 = 200.0;
/// Largest relative error of the orders: beyond, neighbouring faults cannot be told apart.
const LARGEST_ERROR: f64 = 0.1;

/// A part that may be damaged.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub enum Fault {
    /// The outer race, at rest: each ball that passes strikes.
    #[default]
    #[serde(rename = "outer race")]
    OuterRace,
    /// The inner race, turning with the shaft: struck harder where the load is.
    #[serde(rename = "inner race")]
    InnerRace,
    /// A ball: strikes each race once a spin, harder where the load is.
    #[serde(rename = "ball")]
    Ball,
    /// The cage.
    #[serde(rename = "cage")]
    Cage,
}

impl Fault {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::OuterRace, Self::InnerRace, Self::Ball, Self::Cage];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::OuterRace => "outer race",
            Self::InnerRace => "inner race",
            Self::Ball => "ball",
            Self::Cage => "cage",
        }
    }

    /// At which of these orders it strikes.
    pub(crate) fn order(self, orders: &DefectOrders) -> f64 {
        match self {
            Self::OuterRace => orders.outer,
            Self::InnerRace => orders.inner,
            Self::Ball => orders.ball_defect,
            Self::Cage => orders.cage,
        }
    }

    /// What the field calls its line. BSF is the spin of a ball, and a flaw meets both races once a spin.
    pub(crate) fn line(self) -> &'static str {
        match self {
            Self::OuterRace => "BPFO",
            Self::InnerRace => "BPFI",
            Self::Ball => "2 x BSF",
            Self::Cage => "FTF",
        }
    }
}

/// How often the parts strike, in events per shaft turn, and how well that is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaultOrders {
    orders: [Option<f64>; 4],
    error: f64,
    /// Error of the ball's order over that of the others.
    ball: f64,
}

impl FaultOrders {
    /// Orders of the faults that are known, in the order of [`Fault::ALL`], each above 0 and at most 200, and their relative
    /// error, 0 to 0.1: from the geometry, from slip, from the speed.
    ///
    /// # Errors
    /// [`DiagnosisError::Refused`].
    pub fn new(orders: [Option<f64>; 4], error: f64) -> Result<Self, DiagnosisError> {
        for (fault, order) in Fault::ALL.into_iter().zip(orders) {
            if let Some(found) = order.filter(|order| !(*order > 0.0 && *order <= HIGHEST_ORDER)) {
                return Err(DiagnosisError::Refused(format!(
                    "order of the {}: expected a number above 0 and at most {HIGHEST_ORDER}, found {found}",
                    fault.name()
                )));
            }
        }
        if !(0.0..=LARGEST_ERROR).contains(&error) {
            return Err(DiagnosisError::Refused(format!(
                "relative error of the orders: expected 0 to {LARGEST_ERROR}, found {error}"
            )));
        }
        Ok(Self { orders, error, ball: 1.0 })
    }

    /// Orders of a row of balls.
    ///
    /// An error e of a diameter changes `gamma = D_b / D_p` by as much and the order of a ball, `(1 - gamma^2) / gamma`, by
    /// `e (1 + gamma^2) / (1 - gamma^2)`, more than e; those of the races by less, where e leaves room for slip.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn of(orders: &DefectOrders, error: f64) -> Result<Self, DiagnosisError> {
        let known = Fault::ALL.map(|fault| fault.order(orders));
        // N (1 -+ gamma) / 2
        let gamma = (orders.inner - orders.outer) / (orders.inner + orders.outer);
        Ok(Self { ball: (1.0 + gamma * gamma) / (1.0 - gamma * gamma), ..Self::new(known.map(Some), error)? })
    }

    /// Order of a fault, if it is known.
    pub fn order(&self, fault: Fault) -> Option<f64> {
        self.orders[fault as usize]
    }

    /// Relative error of a fault's order.
    pub(crate) fn error(&self, fault: Fault) -> f64 {
        match fault {
            Fault::Ball => self.ball * self.error,
            Fault::OuterRace | Fault::InnerRace | Fault::Cage => self.error,
        }
    }

    /// Whether orders and speed are those of a simulation, known exactly.
    pub(crate) fn is_exact(&self) -> bool {
        self.error <= 0.0
    }

    /// The highest order that is known, at least 1.
    pub(crate) fn highest(&self) -> f64 {
        self.orders.iter().flatten().fold(1.0, |most, &o| most.max(o))
    }
}

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
    pub(crate) fn of(cage: &'a Cage, balls: u32, rolling: DefectOrders) -> Self {
        Self::Cage { cage, balls, rolling, error: 0.0 }
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
    use crate::bearing::kinematics::BallRow;

    #[test]
    fn a_wrong_diameter_is_worth_more_to_a_ball() {
        let row = |pitch: f64| BallRow::new(7, 2e-3, pitch, 0.0).unwrap().orders();
        let (given, real) = (row(7.51e-3), row(1.01 * 7.51e-3));
        let orders = FaultOrders::of(&given, 0.01).unwrap();
        let off = real.ball_defect / given.ball_defect - 1.0;
        // to first order in the error of one percent
        assert!((off / orders.error(Fault::Ball) - 1.0).abs() < 0.01, "{off}");
        assert!(off > 0.0113);
        assert!((real.outer / given.outer - 1.0).abs() < orders.error(Fault::OuterRace));
        assert!((real.inner / given.inner - 1.0).abs() < orders.error(Fault::InnerRace));
        let typed = FaultOrders::new([None, None, Some(3.5), None], 0.01).unwrap();
        assert!((typed.error(Fault::Ball) - 0.01).abs() < 1e-15);
    }
}

#[cfg(test)]
mod kinematics_tests {
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
