//! Kinematics of balls rolling between two races: how often each part passes, per shaft turn.
//!
//! Outer race at rest, inner race turning with the shaft, no slip; `γ = D_b cos α / D_p`:
//!
//! ```text
//! cage        (1 − γ) / 2            outer pass   N (1 − γ) / 2       inner pass   N (1 + γ) / 2
//! ball spin   D_p / (2 D_b) · (1 − γ²)                                ball defect  2 × spin
//! ```
//!
//! Source: T. A. Harris, *Rolling Bearing Analysis*, chapter 8; the orders of the source paper's Table 2.
//! Convention: a defect on a ball meets a race twice a spin; "ball defect" counts both.

use super::error::BearingError;
use schemars::JsonSchema;
use serde::Serialize;
use std::f64::consts::FRAC_PI_2;

/// A row of balls: count, diameters and contact angle, checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BallRow {
    balls: f64,
    diameter_ratio: f64,
    projected_ratio: f64,
}

/// Events per shaft turn; multiply by the shaft's frequency to get Hz.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct DefectOrders {
    /// Turns of the cage, `(1 − γ) / 2`; between 0 and 1/2.
    pub cage: f64,
    /// Balls that pass a point of the outer race.
    pub outer: f64,
    /// Balls that pass a point of the inner race.
    pub inner: f64,
    /// Turns of a ball about its own axis, relative to the cage.
    #[serde(skip)]
    pub ball_spin: f64,
    /// Meetings of a point on a ball with either race: twice the spin.
    #[serde(rename = "ball")]
    pub ball_defect: f64,
}

impl DefectOrders {
    /// Of so many balls whose cage turns `cage` times in a turn of the shaft: `gamma = 1 - 2 cage` of the contact angle in force.
    pub(crate) fn of_cage(balls: f64, diameter_ratio: f64, cage: f64) -> Self {
        Self::of(balls, diameter_ratio, 1.0 - 2.0 * cage)
    }

    fn of(balls: f64, diameter_ratio: f64, gamma: f64) -> Self {
        let cage = 0.5 * (1.0 - gamma);
        let ball_spin = 0.5 / diameter_ratio * (1.0 - gamma * gamma);
        Self { cage, outer: balls * cage, inner: balls * (1.0 - cage), ball_spin, ball_defect: 2.0 * ball_spin }
    }
}

impl BallRow {
    /// A row of `balls` (1 or more) of `ball_diameter` (m) on a pitch circle of `pitch_diameter` (m)
    /// with `contact_angle` (rad, 0 for a radial bearing, below π/2).
    ///
    /// # Errors
    /// [`BearingError`], with the value that breaks its rule.
    pub fn new(balls: u32, ball_diameter: f64, pitch_diameter: f64, contact_angle: f64) -> Result<Self, BearingError> {
        let refused = |message| Err(BearingError(message));
        if balls == 0 {
            return refused(format!("balls = {balls} must be at least 1"));
        }
        let ordered = ball_diameter > 0.0 && ball_diameter < pitch_diameter;
        if !(ordered && pitch_diameter.is_finite()) {
            return refused(format!(
                "ball diameter {ball_diameter} must be positive and below the pitch diameter {pitch_diameter}, in the same unit"
            ));
        }
        if !(0.0..FRAC_PI_2).contains(&contact_angle) {
            let degrees = contact_angle.to_degrees();
            return refused(format!("contact angle {degrees:.4} degrees must be at least 0 and below 90"));
        }
        // neighbours on the pitch circle are pitch sin(pi / N) apart
        let most = std::f64::consts::PI / (ball_diameter / pitch_diameter).asin();
        // balls that touch fit, but for round-off
        let most = (most * (1.0 + 1e-9)) as u32;
        if balls > most {
            return refused(format!("{balls} balls of these diameters overlap: expected at most {most}"));
        }
        let diameter_ratio = ball_diameter / pitch_diameter;
        Ok(Self { balls: f64::from(balls), diameter_ratio, projected_ratio: diameter_ratio * contact_angle.cos() })
    }

    /// All defect orders.
    pub fn orders(&self) -> DefectOrders {
        DefectOrders::of(self.balls, self.diameter_ratio, self.projected_ratio)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn source_bearing_has_the_orders_of_its_table() {
        // Pitch diameter R_0 + r, ball diameter 2 mm.
        let orders = BallRow::new(7, 2e-3, 4.7565e-3 + 2.754e-3, 0.0).unwrap().orders();
        assert_relative_eq!(orders.outer, 2.568, epsilon = 5e-4);
        assert_relative_eq!(orders.inner, 4.432, epsilon = 5e-4);
        assert_relative_eq!(orders.ball_defect, 3.489, epsilon = 5e-4);
    }

    #[test]
    fn eight_balls_on_120_mm_at_25_hz() {
        let orders = BallRow::new(8, 20e-3, 120e-3, 0.0).unwrap().orders();
        assert_relative_eq!(25.0 * orders.cage, 10.416_7, epsilon = 5e-5);
        assert_relative_eq!(25.0 * orders.outer, 83.333_3, epsilon = 5e-5);
        assert_relative_eq!(25.0 * orders.inner, 116.666_7, epsilon = 5e-5);
        assert_relative_eq!(25.0 * orders.ball_spin, 72.916_7, epsilon = 5e-5);
    }

    /// Rolling without slip: the ball's surface speed equals each race's, seen from the cage.
    #[test]
    fn contact_points_roll_without_slip() {
        let (ball, pitch, angle) = (0.3_f64, 1.7_f64, 0.4_f64);
        let orders = BallRow::new(9, ball, pitch, angle).unwrap().orders();
        let outer_radius = 0.5 * (pitch + ball * angle.cos());
        let inner_radius = 0.5 * (pitch - ball * angle.cos());
        let surface = orders.ball_spin * 0.5 * ball;
        assert_relative_eq!(surface, orders.cage * outer_radius, max_relative = 1e-14);
        assert_relative_eq!(surface, (1.0 - orders.cage) * inner_radius, max_relative = 1e-14);
        assert_relative_eq!(orders.outer + orders.inner, 9.0, max_relative = 1e-15);
    }

    #[test]
    fn every_rule_fires() {
        assert_eq!(BallRow::new(0, 1.0, 2.0, 0.0).unwrap_err().to_string(), "balls = 0 must be at least 1");
        assert_eq!(
            BallRow::new(7, 2.0, 2.0, 0.0).unwrap_err().to_string(),
            "ball diameter 2 must be positive and below the pitch diameter 2, in the same unit"
        );
        // six on a circle of diameter 1 are sin(pi / 6) = 1 / 2 apart
        assert!(BallRow::new(6, 0.5, 1.0, 0.0).is_ok());
        assert_eq!(
            BallRow::new(7, 0.5, 1.0, 0.0).unwrap_err().to_string(),
            "7 balls of these diameters overlap: expected at most 6"
        );
        assert!(BallRow::new(7, f64::NAN, 2.0, 0.0).is_err());
        assert!(BallRow::new(7, 1.0, f64::INFINITY, 0.0).is_err());
        assert_eq!(
            BallRow::new(7, 1.0, 2.0, 2.0).unwrap_err().to_string(),
            "contact angle 114.5916 degrees must be at least 0 and below 90"
        );
    }
}
