//! Everything about a bearing in one table: geometry, orders, contacts.

use crate::bearing::defect::{Dent, DentShape, RaceDefect, RaceProfile, SurfaceDent};
use crate::bearing::hertz::HertzStiffness;
use crate::bearing::{BearingGeometry, ContactStiffness, Race, RaceContacts};
use crate::report::{Cell, Column, Table, significant};
use crate::system::{BallLoad, BearingSetup, Equilibrium};

/// Name, cells of the whole bearing, of inner and of outer race, unit.
type Row = [Cell; 5];

fn row(name: &str, unit: &str, [whole, inner, outer]: [Cell; 3]) -> Row {
    [Cell::text(name), whole, inner, outer, Cell::text(unit)]
}

/// A quantity of the whole bearing.
fn one(name: &str, unit: &str, value: f64, digits: usize) -> Row {
    row(name, unit, [Cell::number(value, digits), blank(), blank()])
}

/// A quantity of each race.
fn both(name: &str, unit: &str, values: [f64; 2], digits: usize) -> Row {
    let [inner, outer] = values.map(|value| Cell::number(value, digits));
    row(name, unit, [blank(), inner, outer])
}

/// A length of one race, m, in micrometres.
fn on_race(name: &str, race: Race, length: f64) -> Row {
    let cell = Cell::number(1e6 * length, 4);
    let cells = match race {
        Race::Inner => [blank(), cell, blank()],
        Race::Outer => [blank(), blank(), cell],
    };
    row(name, "\u{b5}m", cells)
}

fn blank() -> Cell {
    Cell::text("")
}

/// Geometry, orders and contacts; the patches under the largest forces at rest where there is an equilibrium.
pub(crate) fn bearing_table(setup: &BearingSetup, contacts: &RaceContacts, equilibrium: Option<&Equilibrium>) -> Table {
    let columns = [
        Column::text("Quantity"),
        Column::number("Value", ""),
        Column::number("Inner race", ""),
        Column::number("Outer race", ""),
        Column::text("Unit"),
    ];
    let mut rows = geometry_rows(&setup.geometry);
    rows.extend(order_rows(setup));
    rows.extend(contact_rows(setup, contacts));
    rows.extend(equilibrium.into_iter().flat_map(|equilibrium| patch_rows(contacts, equilibrium)));
    rows.extend(setup.waves.iter().map(|wave| {
        let name = format!("Amplitude of the wave of order {}", wave.order);
        on_race(&name, wave.race, wave.amplitude)
    }));
    let largest = setup.oversizes.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
    if largest > 0.0 {
        rows.push(one("Largest difference of a ball's radius", "\u{b5}m", 1e6 * largest, 4));
    }
    for defect in &setup.race_defects {
        let drops = drops(&setup.geometry, setup.stiffness, defect).into_iter();
        rows.extend(drops.map(|(name, drop)| on_race(name, defect.race(), drop)));
    }
    for flat in &setup.flats {
        let drop = [Race::Inner, Race::Outer].map(|race| 1e6 * flat.shape.ball_drop(race));
        let name = |what: &str| format!("{what} of the flat on ball {}", flat.ball);
        let angle = flat.shape.included_angle().to_degrees();
        rows.extend([both(&name("Drop"), "\u{b5}m", drop, 4), one(&name("Included angle"), "deg", angle, 4)]);
    }
    Table::new("Bearing", columns).rows(rows)
}

fn geometry_rows(geometry: &BearingGeometry) -> Vec<Row> {
    let dimensions = geometry.dimensions();
    let radii = [dimensions.inner_race_radius, dimensions.outer_race_radius].map(|r| 1e3 * r);
    let grooves = [dimensions.inner_groove_radius, dimensions.outer_groove_radius].map(|r| 1e3 * r);
    let conformities = [geometry.inner_conformity(), geometry.outer_conformity()];
    let mut rows = vec![
        row("Balls", "", [Cell::text(geometry.balls().to_string()), blank(), blank()]),
        one("Ball diameter", "mm", 2e3 * geometry.ball_radius(), 6),
        one("Ball mass", "g", 1e3 * geometry.ball_mass(), 5),
        one("Pitch diameter", "mm", 2e3 * geometry.pitch_radius(), 6),
        one("Ball over pitch diameter", "", geometry.diameter_ratio(), 5),
        both("Race radius", "mm", radii, 6),
        both("Groove radius", "mm", grooves, 6),
        both("Conformity (groove radius over ball diameter)", "", conformities, 4),
        one("Radial play", "\u{b5}m", 1e6 * geometry.radial_play(), 4),
        one("Diametral clearance", "\u{b5}m", 1e6 * geometry.diametral_clearance(), 4),
        one("Contact angle (radial load)", "deg", 0.0, 3),
    ];
    let free = geometry.free_contact_angle();
    rows.extend(free.map(|angle| one("Free contact angle (axial load)", "deg", angle.to_degrees(), 4)));
    rows
}

fn order_rows(setup: &BearingSetup) -> [Row; 5] {
    let orders = setup.geometry.orders();
    let unit = "per shaft turn";
    let [least, most] = setup.cage.slip.range().map(|slip| 1e2 * slip);
    let slip = if least < most {
        Cell::text(format!("{} to {}", significant(least, 4), significant(most, 4)))
    } else {
        Cell::number(most, 4)
    };
    [
        one("Cage order without slip", unit, orders.cage, 5),
        both("Defect order without slip", unit, [orders.inner, orders.outer], 5),
        one("Ball spin order", unit, orders.ball_spin, 5),
        one("Ball defect order (two hits a spin)", unit, orders.ball_defect, 5),
        row("Slip of the cage", "%", [slip, blank(), blank()]),
    ]
}

fn contact_rows(setup: &BearingSetup, contacts: &RaceContacts) -> [Row; 7] {
    let unit = "N/m^(3/2)";
    let of = |value: fn(&HertzStiffness) -> f64| [&contacts.inner, &contacts.outer].map(value);
    [
        both("Curvature sum", "1/mm", of(|c| 1e-3 * c.curvature_sum), 5),
        both("Curvature difference F", "", of(|c| c.curvature_difference), 4),
        both("Ellipticity of the patch", "", of(|c| c.ellipticity), 4),
        both("Effective modulus", "GPa", of(|c| 1e-9 * c.effective_modulus), 5),
        both("k by Hertz from the geometry", unit, of(|c| c.stiffness), 4),
        both("k in use", unit, [setup.stiffness.inner(), setup.stiffness.outer()], 4),
        one("k in use, both races in series", unit, setup.stiffness.series(), 4),
    ]
}

/// Patches under the largest force at rest, by Hertz from the geometry whatever k is in use.
fn patch_rows(contacts: &RaceContacts, equilibrium: &Equilibrium) -> [Row; 4] {
    let largest = |force: fn(&BallLoad) -> f64| equilibrium.balls.iter().map(force).fold(0.0, f64::max);
    let forces = [largest(|ball| ball.inner), largest(|ball| ball.outer)];
    let patches = [contacts.inner.patch(forces[0]), contacts.outer.patch(forces[1])];
    let [across, along] = [patches.map(|patch| 1e6 * patch.longer), patches.map(|patch| 1e6 * patch.shorter)];
    [
        both("Largest static contact force", "N", forces, 4),
        both("Its patch, half-axis across the rolling direction", "\u{b5}m", across, 4),
        both("Its patch, half-axis in the rolling direction", "\u{b5}m", along, 4),
        both("Its largest pressure", "MPa", patches.map(|patch| 1e-6 * patch.peak_pressure), 4),
    ]
}

/// Name of the drop and its value (m). A dent with a width has two, in the plane and in its surface, as far as its
/// shape allows both.
fn drops(geometry: &BearingGeometry, stiffness: ContactStiffness, defect: &RaceDefect) -> Vec<(&'static str, f64)> {
    let race = defect.race();
    let in_plane = |shape: &DentShape| {
        let dent = Dent::new(geometry, race, *shape, stiffness).ok();
        dent.map(|dent| ("Drop of a ball in the dent, in the plane", dent.ball_drop()))
    };
    let surface = |shape: &DentShape| {
        let dent = SurfaceDent::new(geometry, race, *shape, stiffness).ok();
        dent.map(|dent| ("Drop of a ball in the dent, in its surface", dent.ball_drop()))
    };
    let used = |name| Some((name, defect.ball_drop()));
    let both = match defect {
        RaceDefect::Dent(dent) if dent.shape().width.is_some() => {
            [used("Drop of a ball in the dent, in the plane (in use)"), surface(dent.shape())]
        }
        RaceDefect::Dent(_) => [used("Drop of a ball in the dent"), None],
        RaceDefect::SurfaceDent(dent) => {
            [in_plane(dent.shape()), used("Drop of a ball in the dent, in its surface (in use)")]
        }
        RaceDefect::Measured(_) => [used("Drop of a ball in the measured profile"), None],
    };
    both.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing::Race;
    use crate::bearing::defect::CurvatureReading;
    use crate::bearing::samples::source_bearing;

    fn shape(width: Option<f64>) -> DentShape {
        DentShape {
            angle: 0.0,
            length: 0.75e-3,
            width,
            depth: 15e-6,
            rim_radius: 0.05e-3,
            curvature: CurvatureReading::Total,
        }
    }

    #[test]
    fn a_dent_with_a_width_has_both_drops() {
        let geometry = source_bearing();
        let stiffness = ContactStiffness::given(1e10, 1e10).unwrap();
        let of = |defect: &RaceDefect| {
            let drops = drops(&geometry, stiffness, defect).into_iter();
            drops.map(|(name, drop)| format!("{name}: {:.2}", 1e6 * drop)).collect::<Vec<_>>()
        };
        let in_plane = |width| {
            let dent = Dent::new(&geometry, Race::Outer, shape(width), stiffness);
            RaceDefect::Dent(dent.unwrap())
        };
        let surface = SurfaceDent::new(&geometry, Race::Outer, shape(Some(0.41e-3)), stiffness);
        assert_eq!(
            of(&in_plane(Some(0.41e-3))),
            [
                "Drop of a ball in the dent, in the plane (in use): 15.00",
                "Drop of a ball in the dent, in its surface: 1.41"
            ]
        );
        assert_eq!(
            of(&RaceDefect::SurfaceDent(surface.unwrap())),
            [
                "Drop of a ball in the dent, in the plane: 15.00",
                "Drop of a ball in the dent, in its surface (in use): 1.41"
            ]
        );
        assert_eq!(of(&in_plane(None)), ["Drop of a ball in the dent: 15.00"]);
        // no surface dent is as wide as the ball
        assert_eq!(of(&in_plane(Some(3e-3))), ["Drop of a ball in the dent, in the plane (in use): 15.00"]);
    }
}
