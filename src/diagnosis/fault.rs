//! Faults and the orders at which they show.

use serde::Serialize;

use super::DiagnosisError;
use crate::closed_form::race::DefectOrders;

/// Highest order that is believed: 200 balls.
const HIGHEST_ORDER: f64 = 200.0;
/// Largest relative error of the orders: beyond, neighbouring faults cannot be told apart.
const LARGEST_ERROR: f64 = 0.1;

/// A part that may be damaged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Fault {
    /// The outer race, at rest: each ball that passes strikes.
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
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::OuterRace => "outer race",
            Self::InnerRace => "inner race",
            Self::Ball => "ball",
            Self::Cage => "cage",
        }
    }
}

/// How often the parts strike, in events per shaft turn, and how well that is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaultOrders {
    orders: [Option<f64>; 4],
    error: f64,
}

impl FaultOrders {
    /// Orders of the faults that are known, in the order of [`Fault::ALL`], each above 0 and at most 200, and their relative
    /// error, 0 to 0.1: from the geometry, from slip, from the speed.
    ///
    /// # Errors
    /// [`DiagnosisError::Order`], [`DiagnosisError::Tolerance`].
    pub fn new(orders: [Option<f64>; 4], error: f64) -> Result<Self, DiagnosisError> {
        for (fault, order) in Fault::ALL.into_iter().zip(orders) {
            if let Some(found) = order.filter(|order| !(*order > 0.0 && *order <= HIGHEST_ORDER)) {
                return Err(DiagnosisError::Order {
                    fault: fault.name(),
                    found,
                    most: HIGHEST_ORDER,
                });
            }
        }
        if !(0.0..=LARGEST_ERROR).contains(&error) {
            return Err(DiagnosisError::Tolerance {
                found: error,
                most: LARGEST_ERROR,
            });
        }
        Ok(Self { orders, error })
    }

    /// Orders of a row of balls.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn of(orders: &DefectOrders, error: f64) -> Result<Self, DiagnosisError> {
        let known = [orders.outer, orders.inner, orders.ball_defect, orders.cage];
        Self::new(known.map(Some), error)
    }

    /// Order of a fault, if it is known.
    #[must_use]
    pub fn order(&self, fault: Fault) -> Option<f64> {
        self.orders[fault as usize]
    }

    /// Relative error of the orders.
    #[must_use]
    pub fn error(&self) -> f64 {
        self.error
    }

    /// The highest order.
    pub(super) fn highest(&self) -> f64 {
        self.orders
            .iter()
            .flatten()
            .fold(1.0, |most, &o| most.max(o))
    }
}
