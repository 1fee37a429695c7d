//! A rigid shaft in one or several bearings whose outer rings are rigid.
//!
//! The shaft's own displacement is that of its point on the axis at z = 0. A bearing at z_k meets `t + R z_k e_z − z_k e_z − offset e_z`.

use super::assembly::{BearingCondition, Five, FiveByFive, SpatialBearing};
use super::ring::RingDisplacement;
use crate::bearing::error::{BearingError, refused};
use nalgebra::{SMatrix, Vector3};

/// A bearing on a shaft.
#[derive(Debug, Clone, PartialEq)]
pub struct MountedBearing {
    /// The bearing.
    pub bearing: SpatialBearing,
    /// Axial place z_k of its centre, m.
    pub place: f64,
    /// Axial displacement of its outer ring along z, m: against the thrust it is preload.
    pub offset: f64,
    /// Azimuth of ball 0, rad.
    pub cage_angle: f64,
}

/// A load on a shaft that keeps its direction.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ShaftLoad {
    /// Along x, y and z, N.
    pub force: [f64; 3],
    /// About x and y, N m: about the axial `place` on the shaft.
    pub moment: [f64; 2],
    /// Axial place on the shaft that the force acts at, m.
    pub place: f64,
}

/// A rigid shaft on bearings with rigid outer rings.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidShaft {
    /// At least one.
    pub bearings: Vec<MountedBearing>,
    /// Displacements that are prescribed: x, y, z (m), tilts (rad); `None`: free.
    pub held: [Option<f64>; 5],
    /// Speed, rad/s.
    pub speed: f64,
}

/// Gradient and stiffness over the shaft's displacement.
#[derive(Clone)]
pub(super) struct Balance {
    /// Load that the bearings carry less the load applied.
    pub gradient: Five,
    pub stiffness: FiveByFive,
    /// Largest force that a bearing carries, N.
    pub carried: f64,
}

impl RigidShaft {
    /// A shaft that nothing holds but `bearings`.
    ///
    /// # Errors
    /// [`BearingError`]: no bearing; a place, an offset, an angle or a speed that is not finite.
    pub fn new(bearings: Vec<MountedBearing>, speed: f64) -> Result<Self, BearingError> {
        if bearings.is_empty() {
            return Err(BearingError("a shaft needs at least one bearing".to_owned()));
        }
        for mounted in &bearings {
            for value in [mounted.place, mounted.offset, mounted.cage_angle] {
                if !value.is_finite() {
                    return refused("axial place, offset or cage angle of a bearing", value, "must be finite");
                }
            }
        }
        if !speed.is_finite() {
            return refused("shaft speed", speed, "rad/s must be finite");
        }
        Ok(Self { bearings, held: [None; 5], speed })
    }

    /// The same shaft with every outer ring set so that each bearing, mounted and without load, carries this thrust (N, zero or
    /// more) in its own direction.
    ///
    /// # Errors
    /// [`BearingError`]: bearings that do not thrust against each other; a force that no displacement below the grooves' radii carries.
    pub fn preloaded(mut self, force: f64) -> Result<Self, BearingError> {
        let sum: f64 = self.bearings.iter().map(|mounted| mounted.bearing.thrust().sign()).sum();
        if sum.abs() > 0.5 {
            return Err(BearingError(
                "a preload needs as many bearings that thrust along +z as along -z: give each bearing its thrust"
                    .to_owned(),
            ));
        }
        for mounted in &mut self.bearings {
            mounted.offset = -mounted.bearing.axial_displacement(force)?;
        }
        Ok(self)
    }

    /// Displacement of each bearing's inner ring against its outer ring.
    pub(super) fn at_bearing(&self, index: usize, shaft: &RingDisplacement) -> RingDisplacement {
        let mounted = &self.bearings[index];
        let [x, y, z] = shaft.translation;
        let [dx, dy, dz]: [f64; 3] = Axis::new(shaft).moved(mounted.place).into();
        RingDisplacement { translation: [x + dx, y + dy, z + dz - mounted.offset], tilt: shaft.tilt }
    }

    pub(super) fn condition(&self, index: usize) -> BearingCondition {
        BearingCondition { cage_angle: self.bearings[index].cage_angle, shaft_speed: self.speed }
    }

    /// What is out of balance under a load.
    pub(super) fn balance(&self, shaft: &RingDisplacement, load: &ShaftLoad) -> Result<Balance, BearingError> {
        let axis = Axis::new(shaft);
        let mut gradient = axis.generalised(load.place, Vector3::from(load.force), load.moment) * -1.0;
        let mut stiffness = axis.turning(load.place, Vector3::from(load.force)) * -1.0;
        let mut carried = 0.0_f64;
        for (index, mounted) in self.bearings.iter().enumerate() {
            let (own, own_stiffness) =
                mounted.bearing.load_and_stiffness(&self.at_bearing(index, shaft), self.condition(index))?;
            let force = Vector3::new(own[0], own[1], own[2]);
            carried = carried.max(force.amax());
            gradient += axis.generalised(mounted.place, force, [own[3], own[4]]);
            let follow = axis.follow(mounted.place);
            stiffness += follow.transpose() * own_stiffness * follow + axis.turning(mounted.place, force);
        }
        Ok(Balance { gradient, stiffness, carried })
    }
}

/// The shaft's axis R e_z = (h g_y, −h g_x, 1 − h |g|²) with its derivatives by the two tilts.
pub(crate) struct Axis {
    /// R e_z − e_z.
    change: Vector3<f64>,
    by: [Vector3<f64>; 2],
    by_both: [[Vector3<f64>; 2]; 2],
}

impl Axis {
    pub(crate) fn new(shaft: &RingDisplacement) -> Self {
        let g = shaft.tilt.map(|tilt| 0.5 * tilt);
        let square = g[0] * g[0] + g[1] * g[1];
        let h = 2.0 / (1.0 + square);
        let at = Vector3::new(g[1], -g[0], -square);
        let at_by = |a: usize| {
            let cross = [Vector3::new(0.0, -1.0, 0.0), Vector3::new(1.0, 0.0, 0.0)][a];
            cross - Vector3::new(0.0, 0.0, 2.0 * g[a])
        };
        let h_by = |a: usize| -h * h * g[a];
        let by = |a: usize| 0.5 * (h_by(a) * at + h * at_by(a));
        let by_both = |a: usize, b: usize| {
            let same = if a == b { 1.0 } else { 0.0 };
            let h_both = 2.0 * h * h * h * g[a] * g[b] - same * h * h;
            let straight = Vector3::new(0.0, 0.0, -2.0 * same);
            0.25 * (h_both * at + h_by(a) * at_by(b) + h_by(b) * at_by(a) + h * straight)
        };
        Self {
            change: h * at,
            by: [by(0), by(1)],
            by_both: std::array::from_fn(|a| std::array::from_fn(|b| by_both(a, b))),
        }
    }

    /// How far a point of the axis moves by the tilt.
    pub(crate) fn moved(&self, place: f64) -> Vector3<f64> {
        place * self.change
    }

    /// Force at a place and moments, as loads on the shaft's five coordinates.
    pub(crate) fn generalised(&self, place: f64, force: Vector3<f64>, moment: [f64; 2]) -> Five {
        let turning = [0, 1].map(|a| moment[a] + place * force.dot(&self.by[a]));
        Five::from([force.x, force.y, force.z, turning[0], turning[1]])
    }

    /// Derivatives of a bearing's five coordinates at a place by the shaft's.
    pub(crate) fn follow(&self, place: f64) -> FiveByFive {
        let mut follow = SMatrix::identity();
        for a in 0..2 {
            for row in 0..3 {
                follow[(row, 3 + a)] = place * self.by[a][row];
            }
        }
        follow
    }

    /// Stiffness by a force whose lever turns with the shaft.
    pub(crate) fn turning(&self, place: f64, force: Vector3<f64>) -> FiveByFive {
        let mut stiffness = SMatrix::zeros();
        for a in 0..2 {
            for b in 0..2 {
                stiffness[(3 + a, 3 + b)] = place * force.dot(&self.by_both[a][b]);
            }
        }
        stiffness
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Rotation3, Unit};

    /// The axis against a rotation by angle and axis, its derivatives and the stiffness of a turned load against differences.
    #[test]
    fn the_axis_turns_with_its_loads() {
        let at = |tilt: [f64; 2]| Axis::new(&RingDisplacement { translation: [0.0; 3], tilt });
        let tilt = [0.4, -0.3];
        let axis = at(tilt);
        let vector = Vector3::new(tilt[0], tilt[1], 0.0);
        let rotation = Rotation3::from_axis_angle(&Unit::new_normalize(vector), 2.0 * (0.5 * vector.norm()).atan());
        assert!((rotation * Vector3::z() - Vector3::z() - axis.change).norm() < 1e-14);
        let (place, force) = (2.0, Vector3::new(3.0, -5.0, 7.0));
        let step = 1e-5;
        for a in 0..2 {
            let [mut low, mut high] = [tilt; 2];
            low[a] -= step;
            high[a] += step;
            let [before, after] = [at(low), at(high)];
            // differences over 1e-5: 1e-10 of derivatives of order one, round-off 1e-11
            assert!(((after.change - before.change) / (2.0 * step) - axis.by[a]).norm() < 1e-9);
            let loads = [&before, &after].map(|axis| axis.generalised(place, force, [0.1, 0.2]));
            let rate = (loads[1] - loads[0]) / (2.0 * step);
            let column = axis.turning(place, force).column(3 + a).into_owned();
            assert!((rate - column).norm() < 1e-8, "{rate} {column}");
        }
    }
}
