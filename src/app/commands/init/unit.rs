//! The unit of a mesh's coordinates, where nobody says it.

use super::bore::TOLERANCE;
use crate::bearing::catalogue::CatalogueBearing;
use crate::numerics::units::LengthUnit;

/// Longest side (in the mesh's unit) below which the unit is taken to be the metre: housings of ball bearings are longer than
/// 3 mm and shorter than 3 m.
const LONGEST_METRES: f64 = 3.0;

/// A unit of length and where it comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnitFrom {
    /// Said by the user.
    Given,
    /// The one in which the named bearing fits the bore.
    Bearing,
    /// Guessed by the extent.
    Extent,
}

/// The unit that was given, else the one in which a bearing fits a bore of this radius, else by the extent.
pub(crate) fn unit(
    given: Option<LengthUnit>,
    longest: f64,
    radius: Option<f64>,
    bearing: Option<&CatalogueBearing>,
) -> (LengthUnit, UnitFrom) {
    if let Some(unit) = given {
        return (unit, UnitFrom::Given);
    }
    if let (Some(radius), Some(bearing)) = (radius, bearing) {
        let fits = |unit: &LengthUnit| {
            let diameter = 2.0 * radius * unit.to_metres();
            (bearing.outer_diameter / diameter - 1.0).abs() <= TOLERANCE
        };
        if let Some(unit) = LengthUnit::ALL.into_iter().find(fits) {
            return (unit, UnitFrom::Bearing);
        }
    }
    let unit = if longest < LONGEST_METRES { LengthUnit::Metre } else { LengthUnit::Millimetre };
    (unit, UnitFrom::Extent)
}
