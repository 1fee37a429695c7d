//! Cross-section of an outer ring: a rectangle less the groove.

use super::entry::{CatalogueBearing, GROOVES};
use serde::Serialize;

/// Cross-section of an outer ring, without chamfers and seal grooves.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct OuterRingSection {
    /// Area A, m^2.
    pub area: f64,
    /// Radius of the centroid from the bearing's axis, m.
    pub radius: f64,
    /// Second moment of area about the axial line through the centroid, m^4: bending in the ring's plane.
    pub inertia: f64,
    /// Second moment of area about the radial line through the middle, m^4: bending out of the plane.
    pub axial_inertia: f64,
}

impl OuterRingSection {
    /// A rectangle between two diameters.
    pub fn rectangle(outer_diameter: f64, inner_diameter: f64, width: f64) -> Self {
        let height = 0.5 * (outer_diameter - inner_diameter);
        Self {
            area: width * height,
            radius: 0.25 * (outer_diameter + inner_diameter),
            inertia: width * height.powi(3) / 12.0,
            axial_inertia: height * width.powi(3) / 12.0,
        }
    }

    /// The section of a bearing's outer ring with a [typical groove](GROOVES): down to the shoulders where their diameter is
    /// published, else down to the groove's bottom alone, which leaves the shoulders out.
    pub fn of(bearing: &CatalogueBearing) -> Self {
        let bottom = bearing.outer_race_diameter();
        let Some(shoulder) = bearing.shoulder_diameter else {
            return Self::rectangle(bearing.outer_diameter, bottom, bearing.width);
        };
        let whole = Self::rectangle(bearing.outer_diameter, shoulder, bearing.width);
        let groove = GROOVES[1] * bearing.ball_diameter;
        whole.without_groove(groove, 0.5 * bottom, 0.5 * shoulder)
    }

    /// Takes a groove of this radius away: the part of a circle, tangent to the bottom's radius, that lies outside the shoulder's.
    fn without_groove(self, groove: f64, bottom: f64, shoulder: f64) -> Self {
        let centre = bottom - groove;
        // half the angle of the segment, seen from the groove's centre
        let half = ((shoulder - centre) / groove).clamp(-1.0, 1.0).acos();
        let (sin2, sin4) = ((2.0 * half).sin(), (4.0 * half).sin());
        // moments of the segment's area about its circle's centre: of order 0, 1 and 2 along the radius, and 2 across
        let cut = groove.powi(2) * (half - 0.5 * sin2);
        let cut_first = 2.0 / 3.0 * (groove * half.sin()).powi(3);
        let cut_second = 0.25 * groove.powi(4) * (half - 0.25 * sin4);
        let across = 2.0 / 3.0 * groove.powi(4) * (0.375 * half - 0.25 * sin2 + sin4 / 32.0);
        // about the bearing's axis, then back to the new centroid
        let area = self.area - cut;
        let first = self.area * self.radius - (cut_first + cut * centre);
        let second = self.inertia + self.area * self.radius.powi(2)
            - (cut_second + 2.0 * centre * cut_first + cut * centre.powi(2));
        let radius = first / area;
        Self { area, radius, inertia: second - area * radius.powi(2), axial_inertia: self.axial_inertia - across }
    }
}
