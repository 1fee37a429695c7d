//! `[shaft]`, `[damping]`, `[speed]`: what moves and what slows it.

use serde::{Deserialize, Serialize};

use super::union::{Mismatch, written_as};

/// The rigid shaft with the inner ring. x to the right, y up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shaft {
    /// Mass in kg, > 0.
    pub mass: f64,
    /// Unbalance, mass times eccentricity, in kg m, >= 0.
    #[serde(default)]
    pub unbalance: f64,
    /// Gravity along x and y in m/s^2.
    #[serde(default = "downwards")]
    pub gravity: [f64; 2],
    /// Constant forces on the shaft; may be empty.
    #[serde(default)]
    pub loads: Vec<Load>,
}

fn downwards() -> [f64; 2] {
    [0.0, -9.81]
}

/// A constant force.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// Along x and y in N.
    pub force: [f64; 2],
}

/// Damping of housing and ring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Damping {
    /// C = alpha M + beta K through two points of the damping ratio over frequency.
    Ratios([RatioAt; 2]),
    /// C = alpha M + beta K.
    Rayleigh {
        /// In 1/s, >= 0.
        alpha: f64,
        /// In s, >= 0.
        beta: f64,
    },
    /// The same damping ratio for every mode, >= 0 and < 1.
    Modal(f64),
}

/// A damping ratio at a frequency.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RatioAt {
    /// In Hz, > 0.
    pub frequency_hz: f64,
    /// Share of critical damping, >= 0 and < 1.
    pub ratio: f64,
}

#[derive(Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct DampingForm {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    ratios: Option<[RatioAt; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    alpha: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    beta: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    modal: Option<f64>,
}

written_as!(Damping, DampingForm);

impl TryFrom<DampingForm> for Damping {
    type Error = Mismatch;

    fn try_from(form: DampingForm) -> Result<Self, Mismatch> {
        const ONE: &str = "exactly one of `ratios`, `alpha` with `beta`, `modal`";
        match (form.ratios, (form.alpha, form.beta), form.modal) {
            (Some(ratios), (None, None), None) => Ok(Self::Ratios(ratios)),
            (None, (None, None), Some(ratio)) => Ok(Self::Modal(ratio)),
            (None, (Some(alpha), Some(beta)), None) => Ok(Self::Rayleigh { alpha, beta }),
            (None, (Some(_), None), None) => Err(Mismatch::form("`alpha` without `beta`", ONE)),
            (None, (None, Some(_)), None) => Err(Mismatch::form("`beta` without `alpha`", ONE)),
            (None, (None, None), None) => Err(Mismatch::form("none of them", ONE)),
            _ => Err(Mismatch::form("several", ONE)),
        }
    }
}

impl From<Damping> for DampingForm {
    fn from(damping: Damping) -> Self {
        match damping {
            Damping::Ratios(ratios) => Self {
                ratios: Some(ratios),
                ..Self::default()
            },
            Damping::Rayleigh { alpha, beta } => Self {
                alpha: Some(alpha),
                beta: Some(beta),
                ..Self::default()
            },
            Damping::Modal(ratio) => Self {
                modal: Some(ratio),
                ..Self::default()
            },
        }
    }
}

/// Shaft speed over time: straight lines between points, constant before the first and after the last.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Speed {
    /// At least one point, times increasing.
    pub profile: Vec<SpeedPoint>,
}

/// Speed at a time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpeedPoint {
    /// In s.
    pub time: f64,
    /// Revolutions per second, >= 0, positive from +x towards +y.
    pub hz: f64,
}
