//! The inner ring's displacement, and where a ball stands as the inner ring sees it.
//!
//! ```text
//! X' = Rᵀ (X − t),   Rᵀ = I + h (−[g]× + [g]×²),   h = 2 / (1 + |g|²),   g = θ / 2        ρ' = |X'_xy|,  z' = X'_z
//! ```
//!
//! The rotation is exact (Cayley): a linear one would stretch the ring by half the square of the tilt. The groove is a torus in the inner
//! ring's frame, so that a contact needs ρ' and z' alone. All differences from the undisplaced place are computed as such: the
//! round-off of a penetration is that of microns, not of the pitch radius.

use nalgebra::{Matrix2, SMatrix, SVector, Vector2, Vector3};

/// Displacement of an inner ring's centre against the outer ring, and the ring's tilt.
///
/// The rotation by a tilt θ is that of the vector g = θ / 2 by Cayley: about θ by the angle `2 arctan(|θ| / 2)`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RingDisplacement {
    /// Along x, y and z, m.
    pub translation: [f64; 3],
    /// Tilt about x and y, rad.
    pub tilt: [f64; 2],
}

impl RingDisplacement {
    /// The five numbers in order.
    pub(crate) fn vector(&self) -> SVector<f64, 5> {
        let ([x, y, z], [a, b]) = (self.translation, self.tilt);
        SVector::from([x, y, z, a, b])
    }

    /// From the five numbers.
    pub(crate) fn of(vector: SVector<f64, 5>) -> Self {
        let [x, y, z, a, b] = vector.into();
        Self { translation: [x, y, z], tilt: [a, b] }
    }
}

/// The inner ring's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct InnerFrame {
    translation: Vector3<f64>,
    half_tilt: Vector3<f64>,
    /// h = 2 / (1 + |g|²).
    factor: f64,
}

/// The plane of a ball at one azimuth as the inner ring sees it: X' is linear in the ball's place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BallPlane {
    /// Radius ρ_o that the ball's radial place is counted from.
    base: f64,
    /// Radial direction.
    outwards: Vector3<f64>,
    /// X' − X at the base, and its change by the radial and the axial place.
    shift: [Vector3<f64>; 3],
}

/// ρ' less the ball's own radius, and z'; with derivatives by the ball's place (radial, axial).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SeenPlace {
    /// ρ' − ρ_o, z', m.
    pub place: Vector2<f64>,
    /// Rows: ρ', z'; columns: radial, axial.
    pub slope: Matrix2<f64>,
    /// Second derivatives of ρ'; z' has none.
    pub bend: Matrix2<f64>,
}

/// Derivatives of ρ' and z' by the seven coordinates: the ring's five, then the ball's two.
pub(crate) struct SeenByAll {
    /// Derivatives of X'.
    pub moved: [Vector3<f64>; 7],
    /// Unit vectors outwards and around at the ball, in the inner ring's frame.
    pub outwards: Vector3<f64>,
    pub around: Vector3<f64>,
    /// ρ', m.
    pub radius: f64,
    /// First derivatives of ρ' and z'.
    pub slope: SMatrix<f64, 2, 7>,
    /// Second derivatives of ρ' and z'.
    pub bend: [SMatrix<f64, 7, 7>; 2],
}

impl InnerFrame {
    pub(crate) fn new(displacement: &RingDisplacement) -> Self {
        let [a, b] = displacement.tilt;
        let half_tilt = 0.5 * Vector3::new(a, b, 0.0);
        Self { translation: displacement.translation.into(), half_tilt, factor: 2.0 / (1.0 + half_tilt.norm_squared()) }
    }

    /// w(p), which times h is the change of a vector by the rotation.
    #[inline]
    fn turned(&self, p: Vector3<f64>) -> Vector3<f64> {
        let g = self.half_tilt;
        g * g.dot(&p) - g.cross(&p) - g.norm_squared() * p
    }

    /// ∂w/∂g_a.
    fn turned_by(&self, axis: usize, p: Vector3<f64>) -> Vector3<f64> {
        let (g, e) = (self.half_tilt, unit(axis));
        e * g.dot(&p) + g * p[axis] - e.cross(&p) - 2.0 * g[axis] * p
    }

    /// The plane at an azimuth with these `[cos, sin]`, radial places counted from the radius `base`.
    #[inline]
    pub(crate) fn plane(&self, azimuth: [f64; 2], base: f64) -> BallPlane {
        let outwards = Vector3::new(azimuth[0], azimuth[1], 0.0);
        let h = self.factor;
        BallPlane {
            base,
            outwards,
            shift: [
                h * self.turned(base * outwards - self.translation) - self.translation,
                h * self.turned(outwards),
                h * self.turned(Vector3::z()),
            ],
        }
    }

    /// ∂ω/∂θ_a of the rotation vector in the ring's own frame, h (e − g × e) / 2, with its derivative by θ_b.
    pub(crate) fn spin(&self, axis: usize) -> Vector3<f64> {
        let e = unit(axis);
        0.5 * self.factor * (e - self.half_tilt.cross(&e))
    }

    /// ∂/∂θ_b of [`Self::spin`].
    pub(crate) fn spin_by(&self, axis: usize, by: usize) -> Vector3<f64> {
        let e = unit(axis);
        let h = self.factor;
        let of_factor = -h * h * self.half_tilt[by] * (e - self.half_tilt.cross(&e));
        0.25 * (of_factor - h * unit(by).cross(&e))
    }

    /// All derivatives at a ball's place (radial from the plane's base, axial).
    pub(crate) fn seen_by_all(&self, plane: &BallPlane, place: Vector2<f64>) -> SeenByAll {
        let (g, h) = (self.half_tilt, self.factor);
        let radius = plane.base + place.x;
        let p = radius * plane.outwards + place.y * Vector3::z() - self.translation;
        let turned = self.turned(p);
        let rows = [plane.outwards, Vector3::z()];
        let mut moved = [Vector3::zeros(); 7];
        let mut bent = [[Vector3::zeros(); 7]; 7];
        // the five straight directions: the ring's three, then the ball's two
        let straight: [(usize, Vector3<f64>); 5] =
            [(0, -unit(0)), (1, -unit(1)), (2, -unit(2)), (5, rows[0]), (6, rows[1])];
        for (index, direction) in straight {
            moved[index] = direction + h * self.turned(direction);
        }
        let h_by = |axis: usize| -h * h * g[axis];
        for axis in 0..2 {
            let by = self.turned_by(axis, p);
            // tilts are twice g
            moved[3 + axis] = 0.5 * (h_by(axis) * turned + h * by);
            for (index, direction) in straight {
                let mixed = 0.5 * (h_by(axis) * self.turned(direction) + h * self.turned_by(axis, direction));
                bent[3 + axis][index] = mixed;
                bent[index][3 + axis] = mixed;
            }
            for other in 0..2 {
                let same = if axis == other { 1.0 } else { 0.0 };
                let h_both = 2.0 * h * h * h * g[axis] * g[other] - same * h * h;
                let both = unit(axis) * p[other] + unit(other) * p[axis] - 2.0 * same * p;
                bent[3 + axis][3 + other] =
                    0.25 * (h_both * turned + h_by(axis) * self.turned_by(other, p) + h_by(other) * by + h * both);
            }
        }
        let seen = p + h * turned;
        let radius = seen.xy().norm();
        let outwards = Vector3::new(seen.x / radius, seen.y / radius, 0.0);
        let mut slope = SMatrix::zeros();
        let mut bend = [SMatrix::zeros(); 2];
        for a in 0..7 {
            slope[(0, a)] = outwards.dot(&moved[a]);
            slope[(1, a)] = moved[a].z;
        }
        for a in 0..7 {
            for b in 0..7 {
                let along = moved[a].xy().dot(&moved[b].xy()) - slope[(0, a)] * slope[(0, b)];
                bend[0][(a, b)] = along / radius + outwards.dot(&bent[a][b]);
                bend[1][(a, b)] = bent[a][b].z;
            }
        }
        let around = Vector3::new(-outwards.y, outwards.x, 0.0);
        SeenByAll { moved, outwards, around, radius, slope, bend }
    }
}

impl BallPlane {
    /// Where the inner ring sees a ball at a place (radial from the base, axial).
    #[inline]
    pub(crate) fn seen(&self, place: Vector2<f64>) -> SeenPlace {
        let [fixed, radial, axial] = self.shift;
        let shift = fixed + place.x * radial + place.y * axial;
        let own = self.base + place.x;
        let at = own * self.outwards + shift;
        let radius = at.xy().norm();
        let change = (2.0 * own * self.outwards.dot(&shift) + shift.xy().norm_squared()) / (radius + own);
        let outwards = at.xy() / radius;
        let by = [(self.outwards + radial).xy(), axial.xy()];
        let slope = [outwards.dot(&by[0]), outwards.dot(&by[1])];
        let bend = |a: usize, b: usize| (by[a].dot(&by[b]) - slope[a] * slope[b]) / radius;
        SeenPlace {
            place: Vector2::new(place.x + change, place.y + shift.z),
            slope: Matrix2::new(slope[0], slope[1], radial.z, 1.0 + axial.z),
            bend: Matrix2::new(bend(0, 0), bend(0, 1), bend(1, 0), bend(1, 1)),
        }
    }
}

fn unit(axis: usize) -> Vector3<f64> {
    let mut unit = Vector3::zeros();
    unit[axis] = 1.0;
    unit
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::{Rotation3, Unit};

    const DISPLACEMENT: RingDisplacement = RingDisplacement { translation: [0.02, -0.03, 0.05], tilt: [0.3, -0.2] };

    /// ρ' and z' against a rotation by angle and axis, which is another formula.
    #[test]
    fn the_inner_ring_sees_a_ball_through_an_exact_rotation() {
        let [a, b] = DISPLACEMENT.tilt;
        let tilt = Vector3::new(a, b, 0.0);
        let rotation = Rotation3::from_axis_angle(&Unit::new_normalize(tilt), 2.0 * (0.5 * tilt.norm()).atan());
        let frame = InnerFrame::new(&DISPLACEMENT);
        for degrees in [0.0_f64, 40.0, 200.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let plane = frame.plane([cos, sin], 0.9);
            let place = Vector2::new(0.1, 0.04);
            let point = Vector3::new(cos, sin, 0.04) - Vector3::from(DISPLACEMENT.translation);
            let seen = rotation.inverse() * point;
            let found = plane.seen(place);
            assert_relative_eq!(0.9 + found.place.x, seen.xy().norm(), max_relative = 1e-14);
            assert_relative_eq!(found.place.y, seen.z, max_relative = 1e-13);
        }
    }

    /// All derivatives against central differences over the seven coordinates, and the short form against the long one.
    #[test]
    fn derivatives_by_ring_and_ball_are_those_of_the_place() {
        let azimuth = [0.6, 0.8];
        let base = 0.9;
        let all = |q: [f64; 7]| {
            let frame = InnerFrame::new(&RingDisplacement { translation: [q[0], q[1], q[2]], tilt: [q[3], q[4]] });
            let plane = frame.plane(azimuth, base);
            let place = Vector2::new(q[5], q[6]);
            (plane.seen(place), frame.seen_by_all(&plane, place), frame)
        };
        let q = [0.02, -0.03, 0.05, 0.3, -0.2, 0.1, 0.04];
        let (short, long, frame) = all(q);
        assert_relative_eq!(long.radius, base + short.place.x, max_relative = 1e-14);
        for row in 0..2 {
            for a in 0..2 {
                assert_relative_eq!(short.slope[(row, a)], long.slope[(row, 5 + a)], epsilon = 1e-14);
                for b in 0..2 {
                    let bend = if row == 0 { short.bend[(a, b)] } else { 0.0 };
                    assert_relative_eq!(bend, long.bend[row][(5 + a, 5 + b)], epsilon = 1e-14);
                }
            }
        }
        let step = 1e-5;
        for a in 0..7 {
            let [mut low, mut high] = [q; 2];
            low[a] -= step;
            high[a] += step;
            let [(before, before_all, frame_before), (after, after_all, frame_after)] = [all(low), all(high)];
            // differences over 1e-5: 1e-10 of derivatives of order one, round-off 1e-11
            let rate = (after.place - before.place) / (2.0 * step);
            assert!((rate - long.slope.column(a)).norm() < 1e-9, "{a}");
            for b in 0..7 {
                for row in 0..2 {
                    let rate = (after_all.slope[(row, b)] - before_all.slope[(row, b)]) / (2.0 * step);
                    assert_relative_eq!(rate, long.bend[row][(a, b)], epsilon = 1e-9);
                }
            }
            if (3..5).contains(&a) {
                for b in 0..2 {
                    let rate = (frame_after.spin(b) - frame_before.spin(b)) / (2.0 * step);
                    assert!((rate - frame.spin_by(b, a - 3)).norm() < 1e-9);
                }
            }
        }
    }
}
