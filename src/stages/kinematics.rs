//! How shaft and balls move: what orders and speeds of an analysis come from.

use super::StageError;
use crate::bearing::{Cage, SpeedProfile};
use crate::closed_form::race::DefectOrders;
use crate::diagnosis::FaultOrders;
use crate::series::TimeWindow;
use crate::system::BearingSetup;
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
    #[must_use]
    pub fn of(setup: &'a BearingSetup) -> Self {
        Self::Cage {
            cage: &setup.cage,
            balls: setup.geometry.balls(),
            rolling: setup.geometry.orders(),
            error: 0.0,
        }
    }

    fn shaft(&self) -> &SpeedProfile {
        match self {
            Self::Cage { cage, .. } => cage.shaft(),
            Self::Given { speed, .. } => speed,
        }
    }

    /// Angle of the shaft at a time (s), in turns.
    #[must_use]
    pub fn turns(&self, time: f64) -> f64 {
        self.shaft().angle(time) / TAU
    }

    /// Mean speed of the shaft in a window, either way, Hz.
    #[must_use]
    pub fn mean_speed_hz(&self, window: TimeWindow) -> f64 {
        let turned = self.turns(window.to) - self.turns(window.from);
        (turned / (window.to - window.from)).abs()
    }

    /// Orders of the faults in a window. With the cage's slip: outer `N r`, inner `N (1 - r)` for a cage order r. The
    /// ball's own spin is not prescribed; its order stays that of pure rolling.
    ///
    /// # Errors
    /// [`StageError::Diagnosis`] for orders that are none.
    pub fn orders(&self, window: TimeWindow) -> Result<FaultOrders, StageError> {
        match self {
            Self::Cage {
                cage,
                balls,
                rolling,
                error,
            } => {
                let ratio = cage.ratio_between(window.from, window.to);
                let balls = f64::from(*balls);
                let orders = DefectOrders {
                    cage: ratio,
                    outer: balls * ratio,
                    inner: balls * (1.0 - ratio),
                    ..*rolling
                };
                Ok(FaultOrders::of(&orders, *error)?)
            }
            Self::Given { orders, .. } => Ok(*orders),
        }
    }
}
