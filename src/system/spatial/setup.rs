//! A rigid shaft in several bearings as the coupled system takes it: inertia, loads, and each bearing in its place.

use super::pose::Pose;
use crate::bearing::Cage;
use crate::bearing::spatial::SpatialBearing;
use crate::system::LoadProfile;
use nalgebra::Vector3;

/// Coordinates of the shaft.
pub(super) const SHAFT: usize = 5;

/// The rigid shaft with all inner rings. Its coordinates are those of its centre of mass.
#[derive(Debug, Clone, PartialEq)]
pub struct SpatialShaft {
    /// Mass, kg, > 0.
    pub mass: f64,
    /// Moment of inertia about an axis across the shaft through the centre of mass, kg m^2, > 0.
    pub transverse_inertia: f64,
    /// Moment of inertia about the shaft's own axis, kg m^2, >= 0.
    pub polar_inertia: f64,
    /// Unbalances that turn with the shaft.
    pub unbalances: Vec<Unbalance>,
    /// Loads besides weight and unbalance.
    pub loads: Vec<SpatialLoad>,
}

/// An unbalance in one plane of the shaft.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unbalance {
    /// m e, kg m.
    pub moment: f64,
    /// Its angle when the shaft's angle is zero, rad.
    pub angle: f64,
    /// Axial place from the centre of mass, m.
    pub place: f64,
}

/// A load that keeps its direction.
#[derive(Debug, Clone, PartialEq)]
pub struct SpatialLoad {
    /// Axial place from the centre of mass at which the force acts, m.
    pub place: f64,
    /// Force along x, y, z (N), then moment about x and y (N m), over time.
    pub profile: LoadProfile<5>,
}

/// A bearing in its place.
#[derive(Debug, Clone)]
pub struct BearingInPlace {
    /// What results call it.
    pub label: String,
    /// Grooves, balls and contacts.
    pub bearing: SpatialBearing,
    /// Ball angles over time; all cages of a setup have the same shaft.
    pub cage: Cage,
    /// Axial place of its centre from the shaft's centre of mass, m.
    pub place: f64,
    /// Axial displacement of its outer ring along z, m: against the thrust it is preload.
    pub offset: f64,
    /// Hunt-Crossley coefficient, s/m; 0: none.
    pub contact_damping: f64,
}

/// Everything that the structure does not know. Bearing k sits in ring k of the structure.
#[derive(Debug, Clone)]
pub struct SpatialSetup {
    /// The shaft.
    pub shaft: SpatialShaft,
    /// At least one bearing.
    pub bearings: Vec<BearingInPlace>,
    /// Gravity, m/s^2.
    pub gravity: [f64; 3],
}

impl SpatialSetup {
    /// Balls of all bearings.
    pub(crate) fn balls(&self) -> usize {
        self.bearings.iter().map(|bearing| bearing.bearing.balls()).sum()
    }

    /// Whether a part of a bearing is damaged.
    pub(crate) fn has_defects(&self) -> bool {
        self.bearings.iter().any(|own| !own.bearing.defects().is_empty())
    }

    /// Generalised force on the shaft at `time` (s), N and N m, the weight included, the rotating unbalance not. Moments belong to the
    /// tilts.
    #[inline]
    pub(super) fn shaft_load(&self, pose: &Pose, time: f64) -> [f64; 5] {
        let [x, y, z] = self.gravity.map(|g| self.shaft.mass * g);
        self.shaft.loads.iter().fold([x, y, z, 0.0, 0.0], |sum, load| {
            let [x, y, z, a, b] = load.profile.at(time);
            let [arm, _] = pose.arm(load.place);
            let [p, q] = pose.on_tilts(arm.cross(&Vector3::new(x, y, z)));
            let own = [x, y, z, a + p, b + q];
            std::array::from_fn(|k| sum[k] + own[k])
        })
    }
}
