//! Numbers of bearing, ring, shaft and run that no mesh says: from the catalogue, usual ones, and guesses.

use std::f64::consts::PI;

use crate::bearing::catalogue::{CatalogueBearing, GROOVES, OuterRingSection, normal_clearance};

/// Speed of the shaft (Hz): a machine on a motor of four poles at 50 Hz mains, without its slip.
pub(crate) const SPEED_HZ: f64 = 25.0;

/// Balance quality G 6.3 of ISO 21940-11 (machines in general): eccentricity times angular speed, m/s.
pub(crate) const BALANCE: f64 = 6.3e-3;

/// The shaft is as thick as the bearing's bore, and so many times longer on each bearing's share. A guess.
pub(crate) const SHAFT_LENGTHS: f64 = 10.0;

/// Density of the shaft, kg/m^3: steel.
const STEEL: f64 = 7850.0;

/// The bearing as a case file has it. SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BearingNumbers {
    pub bearing: &'static CatalogueBearing,
    /// Half the middle of the normal clearance.
    pub play: f64,
    pub inner_groove: f64,
    pub outer_groove: f64,
}

impl BearingNumbers {
    pub(crate) fn of(bearing: &'static CatalogueBearing) -> Self {
        let [least, most] = normal_clearance(bearing.bore).unwrap_or_default();
        let [inner, outer] = GROOVES;
        Self {
            bearing,
            // the clearance is of the diameter, and half way between its limits
            play: 0.25 * (least + most),
            inner_groove: inner * bearing.ball_diameter,
            outer_groove: outer * bearing.ball_diameter,
        }
    }
}

/// The ring's section, that of a bearing scaled to the bore.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RingNumbers {
    /// Whose section it is.
    pub of: &'static CatalogueBearing,
    /// Bore over the bearing's outer diameter.
    pub scale: f64,
    pub section: OuterRingSection,
}

impl RingNumbers {
    /// Width of the bearing, scaled, m.
    pub(crate) fn section_width(&self) -> f64 {
        self.of.width * self.scale
    }

    /// Lengths grow with the bore, areas with its square, second moments with its fourth power.
    pub(crate) fn of(bearing: &'static CatalogueBearing, bore_diameter: f64) -> Self {
        let scale = bore_diameter / bearing.outer_diameter;
        let own = OuterRingSection::of(bearing);
        Self {
            of: bearing,
            scale,
            section: OuterRingSection {
                area: own.area * scale.powi(2),
                radius: own.radius * scale,
                inertia: own.inertia * scale.powi(4),
                axial_inertia: own.axial_inertia * scale.powi(4),
            },
        }
    }
}

/// Mass (kg) and unbalance (kg m) of a shaft of this diameter (m).
pub(crate) fn shaft(diameter: f64) -> [f64; 2] {
    let mass = STEEL * 0.25 * PI * diameter.powi(3) * SHAFT_LENGTHS;
    [mass, mass * BALANCE / (2.0 * PI * SPEED_HZ)]
}
