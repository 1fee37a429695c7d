//! What no mesh says: numbers of bearing, ring, shaft and run from the catalogue, usual ones and guesses; the unit of length;
//! where the bearing's angle 0 and its "up" point.

use crate::app::case::FIT;
use crate::bearing::catalogue::{CatalogueBearing, OuterRingSection, UsualNumbers};
use crate::fe::mesh::ConsistentUnits;
use crate::numerics::units::LengthUnit;
use nalgebra::Vector3;
use serde::Serialize;

/// Speed of the shaft (Hz): a machine on a motor of four poles at 50 Hz mains, without its slip.
pub(crate) const SPEED_HZ: f64 = 25.0;

/// Balance quality G 6.3 of ISO 21940-11 (machines in general): eccentricity times angular speed, m/s.
pub(crate) const BALANCE: f64 = 6.3e-3;

/// Preload over the smallest bearing's bore, N/m: 5 N a millimetre, the least that makers recommend for small electric motors.
pub(crate) const PRELOAD: f64 = 5e3;

/// Density of shaft and balls, kg/m^3: steel.
pub(crate) const STEEL: f64 = 7850.0;

/// The bearing as a case file has it. SI.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct BearingNumbers {
    pub bearing: &'static CatalogueBearing,
    /// What the catalogue does not say.
    #[serde(flatten)]
    pub usual: UsualNumbers,
}

impl BearingNumbers {
    pub(crate) fn of(bearing: &'static CatalogueBearing) -> Self {
        Self { bearing, usual: UsualNumbers::of(bearing) }
    }
}

/// The ring's section, that of a bearing scaled to the bore.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct RingNumbers {
    /// Whose section it is.
    pub of: &'static CatalogueBearing,
    /// Bore over the bearing's outer diameter.
    pub scale: f64,
    pub section: OuterRingSection,
}

impl RingNumbers {
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

/// Longest side (in the mesh's unit) below which the unit is taken to be the metre: housings of ball bearings are longer than
/// 3 mm and shorter than 3 m.
const LONGEST_METRES: f64 = 3.0;

/// A unit of length and where it comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub(crate) enum UnitFrom {
    /// Said by the user.
    Given,
    /// The one in which the named bearing fits the bore.
    Bearing,
    /// The one that the file's materials are in.
    Materials,
    /// Guessed by the extent.
    Extent,
}

/// The unit that was given, else the one in which a bearing fits a bore of this radius, else that of the file's materials, else by
/// the extent.
pub(crate) fn unit_of(
    given: Option<LengthUnit>,
    longest: f64,
    radius: Option<f64>,
    bearing: Option<&CatalogueBearing>,
    units: Option<ConsistentUnits>,
) -> (LengthUnit, UnitFrom) {
    if let Some(unit) = given {
        return (unit, UnitFrom::Given);
    }
    if let (Some(radius), Some(bearing)) = (radius, bearing) {
        let fits = |unit: &LengthUnit| {
            let diameter = 2.0 * radius * unit.to_metres();
            (bearing.outer_diameter / diameter - 1.0).abs() <= FIT
        };
        if let Some(unit) = LengthUnit::ALL.into_iter().find(fits) {
            return (unit, UnitFrom::Bearing);
        }
    }
    if let Some(units) = units {
        return (units.length, UnitFrom::Materials);
    }
    let unit = if longest < LONGEST_METRES { LengthUnit::Metre } else { LengthUnit::Millimetre };
    (unit, UnitFrom::Extent)
}

/// Directions of a bearing in the mesh's axes, unit vectors.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct Directions {
    /// Along the shaft.
    pub axis: [f64; 3],
    /// The bearing's x, its angle 0.
    pub zero: [f64; 3],
    /// The bearing's y, against gravity.
    pub up: [f64; 3],
    /// Whether a foot says what is up.
    pub by_foot: bool,
}

/// Angle (rad) below which a fitted axis counts as one of the mesh's: gmsh writes 16 digits, a drawing is not skewed by less.
const SNAP: f64 = 1e-6;

/// The same of a foot, whose faces need not be even: meshes stand upright.
const UPRIGHT: f64 = 0.25;

/// Least sine of the angle between foot and shaft by which the foot tells what is up: a flange that is bolted to a wall does not.
const ACROSS: f64 = 0.5;

impl Directions {
    /// Up is from the `foot` into the housing (a unit vector). Without one, or where it faces along the shaft, it is the mesh's y, as
    /// gmsh's models have it, or its z for a shaft along y.
    pub(crate) fn of(axis: [f64; 3], foot: Option<Vector3<f64>>) -> Self {
        let axis = snapped(Vector3::from(axis).normalize(), SNAP);
        let foot = foot.filter(|foot| axis.cross(foot).norm() > ACROSS);
        let usual = if axis.y.abs() > 0.9 { Vector3::z() } else { Vector3::y() };
        let upwards = foot.map_or(usual, |foot| snapped(foot, UPRIGHT));
        let up = (upwards - axis * axis.dot(&upwards)).normalize();
        // without negative zeros
        let plain = |vector: Vector3<f64>| -> [f64; 3] { vector.map(|part| part + 0.0).into() };
        Self { axis: plain(axis), zero: plain(up.cross(&axis)), up: plain(up), by_foot: foot.is_some() }
    }
}

/// A unit vector, or the axis of the mesh that it is `within` an angle (rad).
fn snapped(vector: Vector3<f64>, within: f64) -> Vector3<f64> {
    let mut axes = (0..3).map(|place| {
        let mut unit = Vector3::zeros();
        unit[place] = vector[place].signum();
        unit
    });
    axes.find(|unit| (vector - unit).norm() < within).unwrap_or(vector)
}

#[cfg(test)]
mod tests {
    use super::Directions;
    use crate::fe::model::RingFrame;

    #[test]
    fn the_frame_that_the_case_makes_has_its_y_upwards() {
        let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        for (axis, foot, up) in [
            (z, None, y),
            ([1.0, 0.0, 1e-8], None, y),
            (y, None, z),
            ([0.6, 0.0, 0.8], None, y),
            (x, Some(z), z),
            (x, Some([0.0, 0.0872, 0.9962]), z),
            (y, Some(z), z),
            (y, Some(x), x),
            (z, Some(y), y),
            (z, Some([0.0, -1.0, 0.0]), [0.0, -1.0, 0.0]),
            // a flange
            (x, Some([-1.0, 0.0, 0.0]), y),
            (z, Some(z), y),
        ] {
            let found = Directions::of(axis, foot.map(Into::into));
            let frame = RingFrame::new([0.0; 3], found.axis, found.zero).unwrap();
            let y = frame.vector_to_mesh([0.0, 1.0, 0.0]);
            for place in 0..3 {
                assert!((y[place] - up[place]).abs() < 1e-12, "{axis:?}: {y:?}");
                assert!((y[place] - found.up[place]).abs() < 1e-12, "{axis:?}: {y:?}");
            }
        }
        let snapped = Directions::of([1.0, 0.0, 1e-8], None).axis;
        assert_eq!(snapped.map(f64::to_bits), [1.0_f64, 0.0, 0.0].map(f64::to_bits));
        let kept = Directions::of([1.0, 0.0, 1e-4], None).axis;
        assert!(kept[2] > 9e-5);
    }
}
