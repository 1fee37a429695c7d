//! Faults and the orders at which they show.

use schemars::JsonSchema;
use serde::Serialize;

use super::DiagnosisError;
use crate::bearing::kinematics::DefectOrders;

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
        let known = [orders.outer, orders.inner, orders.ball_defect, orders.cage];
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
