//! Where a ball stands to the inner race: penetration without loss of digits.

use crate::bearing::BearingGeometry;
use crate::numerics::lanes::{LANES, Lanes, each};

/// Inner contact of one ball: position by the outward displacement `s` from touching the undeformed
/// outer race, `rho = R_0 - rho_b + s`.
#[derive(Debug, Clone, Copy)]
pub(super) struct InnerRace {
    /// Ball position at s = 0, R_0 - rho_b, m.
    pub touching_radius: f64,
    /// Radial play c, m.
    pub play: f64,
}

/// Where a ball and the inner race, or balls side by side and the race, stand to each other.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct InnerGap<T = f64> {
    /// Penetration delta_i, m; positive in contact.
    pub penetration: T,
    /// Distance chi from inner race centre to ball centre, m.
    pub distance: T,
    /// Unit vector from inner race centre to ball centre.
    pub normal: [T; 2],
}

impl InnerGap<Lanes> {
    /// That of one of the balls.
    #[inline]
    pub(super) fn get(&self, lane: usize) -> InnerGap {
        InnerGap {
            penetration: self.penetration[lane],
            distance: self.distance[lane],
            normal: self.normal.map(|component| component[lane]),
        }
    }
}

impl InnerRace {
    pub(super) fn new(geometry: &BearingGeometry) -> Self {
        Self { touching_radius: geometry.outer_race_radius() - geometry.ball_radius(), play: geometry.radial_play() }
    }

    /// Gap for a ball in direction `e` at outward displacement `s`, the inner race at `centre`.
    pub(super) fn gap(&self, e: [f64; 2], s: f64, centre: [f64; 2]) -> InnerGap {
        let [cos, sin] = e.map(|component| [component; LANES]);
        self.gaps([&cos, &sin], &[s; LANES], centre).get(0)
    }

    /// Not less than the penetration of balls in directions (`cos`, `sin`) at outward displacements `s`: what it would be in
    /// front of a plane.
    #[inline(always)]
    pub(super) fn penetration_bounds(&self, [cos, sin]: [&Lanes; 2], s: &Lanes, [x, y]: [f64; 2]) -> Lanes {
        each(|l| (cos[l] * x + sin[l] * y) - (self.play + s[l]))
    }

    /// Gaps for balls in directions (`cos`, `sin`) at outward displacements `s`, the inner race at `centre`.
    ///
    /// `delta_i = r + rho_b - chi = -(play + s) + (rho - chi)` with
    /// `rho - chi = (2 rho e.centre - |centre|^2) / (rho + chi)`: no difference of large numbers.
    #[inline(always)]
    pub(super) fn gaps(&self, [cos, sin]: [&Lanes; 2], s: &Lanes, centre: [f64; 2]) -> InnerGap<Lanes> {
        let [x, y] = centre;
        let square = x * x + y * y;
        let rho = each(|l| self.touching_radius + s[l]);
        let b = [each(|l| rho[l] * cos[l] - x), each(|l| rho[l] * sin[l] - y)];
        let distance = each(|l| (b[0][l] * b[0][l] + b[1][l] * b[1][l]).sqrt());
        // one division for 1 / chi and 1 / (rho + chi)
        let both = each(|l| 1.0 / (distance[l] * (rho[l] + distance[l])));
        InnerGap {
            penetration: each(|l| {
                let along = cos[l] * x + sin[l] * y;
                (2.0 * rho[l] * along - square) * (both[l] * distance[l]) - (self.play + s[l])
            }),
            normal: b.map(|b| each(|l| b[l] * (both[l] * (rho[l] + distance[l])))),
            distance,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gap_is_the_plain_difference() {
        let race = InnerRace { touching_radius: 3.7565e-3, play: 2.5e-6 };
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
