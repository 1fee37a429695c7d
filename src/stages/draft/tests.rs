//! What is made of the numbers behind a case file.

use super::scene::{BALANCE, BearingNumbers, RingNumbers, SPEED_HZ, shaft};
use super::unit::{UnitFrom, unit};
use crate::catalogue::{CatalogueBearing, OuterRingSection};
use crate::units::LengthUnit;

fn named(name: &str) -> &'static CatalogueBearing {
    CatalogueBearing::named(name).unwrap_or_else(|| panic!("{name}"))
}

#[test]
fn a_unit_is_given_told_by_the_bearing_or_guessed() {
    let bearing = Some(named("6205"));
    for (given, longest, radius, bearing, expected) in [
        (
            Some(LengthUnit::Inch),
            44.0,
            Some(26.0),
            bearing,
            (LengthUnit::Inch, UnitFrom::Given),
        ),
        (
            None,
            44.0,
            Some(26.0),
            bearing,
            (LengthUnit::Millimetre, UnitFrom::Bearing),
        ),
        (
            None,
            4.4,
            Some(26.1 / 25.4),
            bearing,
            (LengthUnit::Inch, UnitFrom::Bearing),
        ),
        (
            None,
            4.4,
            Some(1.0),
            bearing,
            (LengthUnit::Millimetre, UnitFrom::Extent),
        ),
        (
            None,
            44.0,
            Some(26.0),
            None,
            (LengthUnit::Millimetre, UnitFrom::Extent),
        ),
        (
            None,
            0.044,
            None,
            None,
            (LengthUnit::Metre, UnitFrom::Extent),
        ),
    ] {
        assert_eq!(
            unit(given, longest, radius, bearing),
            expected,
            "{longest} {radius:?}"
        );
    }
}

/// The ring of the source paper's bearing of 12 mm (Table 1 and docs/paper-numbers.md: area 5.37e-6 m^2, second moment 8.88e-13 m^4,
/// radius 5.314 mm) against that of 625 scaled to 12 mm: another bearing, of the same kind.
#[test]
fn a_scaled_ring_is_like_that_of_a_bearing_of_this_size() {
    let found = RingNumbers::of(named("625"), 12e-3);
    assert!((found.scale - 0.75).abs() < 1e-12);
    let section = found.section;
    for (found, expected, within) in [
        (section.area, 5.37e-6, 0.2),
        (section.inertia, 8.88e-13, 0.5),
        (section.radius, 5.314e-3, 0.03),
    ] {
        assert!(
            (found / expected - 1.0).abs() < within,
            "{found} {expected}"
        );
    }
    // as a solid body grows: twice as large, four times the area, 16 times the second moment
    let twice = RingNumbers::of(named("625"), 24e-3).section;
    assert!((twice.area / section.area - 4.0).abs() < 1e-9);
    assert!((twice.inertia / section.inertia - 16.0).abs() < 1e-9);
    assert!((twice.axial_inertia / section.axial_inertia - 16.0).abs() < 1e-9);
    let own = RingNumbers::of(named("6205"), 52e-3);
    assert_eq!(own.section, OuterRingSection::of(named("6205")));
}

#[test]
fn numbers_of_6205() {
    let numbers = BearingNumbers::of(named("6205"));
    // clearance of 5 to 20 um: 12.5 um in the middle, half of it to either side
    assert!((numbers.play - 6.25e-6).abs() < 1e-12);
    assert!((numbers.inner_groove - 0.52 * 7.938e-3).abs() < 1e-12);
    assert!((numbers.outer_groove - 0.53 * 7.938e-3).abs() < 1e-12);
    let [mass, unbalance] = shaft(25e-3);
    // a bar of 25 mm and 250 mm: 0.963 kg; 6.3 mm/s at 25 Hz: 40.1 um
    assert!((mass - 0.9633).abs() < 1e-3, "{mass}");
    assert!(
        (unbalance / (mass * 40.107e-6) - 1.0).abs() < 1e-4,
        "{unbalance}"
    );
    assert!((BALANCE / SPEED_HZ - 2.52e-4).abs() < 1e-12);
}
