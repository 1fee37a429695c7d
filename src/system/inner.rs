//! Where a ball stands to the inner race: penetration without loss of digits.

use crate::bearing::BearingGeometry;

/// Inner contact of one ball: position by the outward displacement `s` from touching the undeformed
/// outer race, `rho = R_0 - rho_b + s`.
#[derive(Debug, Clone, Copy)]
pub(super) struct InnerRace {
    /// Ball position at s = 0, R_0 - rho_b, m.
    pub touching_radius: f64,
    /// Radial play c, m.
    pub play: f64,
}

/// Where ball and inner race stand to each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct InnerGap {
    /// Penetration delta_i, m; positive in contact.
    pub penetration: f64,
    /// Distance chi from inner race centre to ball centre, m.
    pub distance: f64,
    /// Unit vector from inner race centre to ball centre.
    pub normal: [f64; 2],
}

impl InnerRace {
    pub fn new(geometry: &BearingGeometry) -> Self {
        Self {
            touching_radius: geometry.outer_race_radius() - geometry.ball_radius(),
            play: geometry.radial_play(),
        }
    }

    /// Gap for a ball in direction `e` at outward displacement `s`, the inner race at `centre`.
    ///
    /// `delta_i = r + rho_b - chi = -(play + s) + (rho - chi)` with
    /// `rho - chi = (2 rho e.centre - |centre|^2) / (rho + chi)`: no difference of large numbers.
    #[inline]
    pub fn gap(&self, e: [f64; 2], s: f64, centre: [f64; 2]) -> InnerGap {
        let rho = self.touching_radius + s;
        let b = [rho * e[0] - centre[0], rho * e[1] - centre[1]];
        let distance = (b[0] * b[0] + b[1] * b[1]).sqrt();
        let along = e[0] * centre[0] + e[1] * centre[1];
        let square = centre[0] * centre[0] + centre[1] * centre[1];
        InnerGap {
            penetration: (2.0 * rho * along - square) / (rho + distance) - (self.play + s),
            distance,
            normal: [b[0] / distance, b[1] / distance],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gap_is_the_plain_difference() {
        let race = InnerRace {
            touching_radius: 3.7565e-3,
            play: 2.5e-6,
        };
        let angle: f64 = 4.1;
        let e = [angle.cos(), angle.sin()];
        let (s, centre) = (3.2e-7, [1.1e-6, -2.9e-6]);
        let gap = race.gap(e, s, centre);
        let rho = 3.7565e-3 + s;
        let chi = (rho * e[0] - centre[0]).hypot(rho * e[1] - centre[1]);
        let plain = (3.7565e-3 - 2.5e-6) - chi;
        // the plain difference keeps 1e-18 m of a length of 4e-3 m
        assert!((gap.penetration - plain).abs() < 2e-18);
        assert!((gap.distance - chi).abs() < 1e-18);
    }
}
