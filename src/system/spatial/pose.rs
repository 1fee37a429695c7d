//! Where a rigid shaft is: its centre of mass, and its tilt by an exact rotation.
//!
//! ```text
//! R = I + 2 / (1 + |g|^2) ([g]x + [g]x^2),   g = theta / 2           (Cayley)
//! work of a moment m: dtheta . (m - g x m) / (1 + |g|^2)
//! ```

use nalgebra::{Matrix3, Vector3};

/// The shaft's displacement as the forces need it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pose {
    /// Of the centre of mass, m.
    pub centre: Vector3<f64>,
    /// g.
    half_tilt: Vector3<f64>,
    /// 1 / (1 + |g|^2).
    factor: f64,
    /// R.
    pub rotation: Matrix3<f64>,
}

impl Pose {
    /// From x, y, z (m) and the tilts about x and y (rad).
    #[inline(always)]
    pub(crate) fn new(coordinates: &[f64]) -> Self {
        let &[x, y, z, a, b, ..] = coordinates else {
            return Self::new(&[0.0; 5]);
        };
        let (p, q) = (0.5 * a, 0.5 * b);
        let factor = 1.0 / (1.0 + p * p + q * q);
        let h = 2.0 * factor;
        // [g]x^2 = g g^T - |g|^2
        let rotation = Matrix3::new(
            1.0 - h * q * q,
            h * p * q,
            h * q,
            h * p * q,
            1.0 - h * p * p,
            -h * p,
            -h * q,
            h * p,
            1.0 - h * (p * p + q * q),
        );
        Self { centre: Vector3::new(x, y, z), half_tilt: Vector3::new(p, q, 0.0), factor, rotation }
    }

    /// The arm from the centre of mass to a place on the axis (m), turned, and its change by the tilt, without loss of digits.
    #[inline(always)]
    pub(crate) fn arm(&self, place: f64) -> [Vector3<f64>; 2] {
        let axis = self.rotation.column(2);
        let h = 2.0 * self.factor;
        let moved = Vector3::new(axis[0], axis[1], -h * self.half_tilt.norm_squared()) * place;
        [axis * place, moved]
    }

    /// Generalised forces on the tilts of a moment (N m) about the centre of mass.
    #[inline(always)]
    pub(crate) fn on_tilts(&self, moment: Vector3<f64>) -> [f64; 2] {
        let [m, g] = [moment, self.half_tilt];
        [self.factor * (m.x - g.y * m.z), self.factor * (m.y + g.x * m.z)]
    }

    /// Angular velocity (rad/s) for rates of the tilts.
    #[inline(always)]
    pub(crate) fn angular_velocity(&self, [a, b]: [f64; 2]) -> Vector3<f64> {
        let g = self.half_tilt;
        Vector3::new(a, b, g.x * b - g.y * a) * self.factor
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rotation_is_one_and_its_rate_is_the_angular_velocity() {
        let at = |a: f64, b: f64| Pose::new(&[0.0, 0.0, 0.0, a, b]);
        let pose = at(0.02, -0.03);
        assert!((pose.rotation * pose.rotation.transpose() - Matrix3::identity()).amax() < 1e-15);
        let (rates, step) = ([0.7, 0.4], 1e-5);
        let [before, after] = [-step, step].map(|h| at(0.02 + h * rates[0], -0.03 + h * rates[1]).rotation);
        let spin = (after - before) / (2.0 * step) * pose.rotation.transpose();
        let omega = pose.angular_velocity(rates);
        let found = Vector3::new(spin[(2, 1)], spin[(0, 2)], spin[(1, 0)]);
        // central differences over 1e-5: 1e-10, and round-off
        assert!((found - omega).amax() < 1e-9, "{found} {omega}");
        // power of a moment
        let moment = Vector3::new(3.0, -2.0, 5.0);
        let [x, y] = pose.on_tilts(moment);
        assert!((x * rates[0] + y * rates[1] - moment.dot(&omega)).abs() < 1e-13);
        let [arm, moved] = pose.arm(0.3);
        assert!((arm - Vector3::new(0.0, 0.0, 0.3) - moved).amax() < 1e-16);
    }
}
