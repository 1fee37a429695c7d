//! Everything about a bearing in one table: geometry, orders, contacts.

use crate::bearing::defect::{Dent, DentShape, RaceDefect, RaceProfile, SurfaceDent};
use crate::bearing::hertz::HertzStiffness;
use crate::bearing::{BearingGeometry, ContactStiffness, Race, RaceContacts};
use crate::report::{Cell, Column, Table, significant};
use crate::system::{BearingSetup, Equilibrium};

/// Rows of the table under construction.
struct Rows(Table);

impl Rows {
    /// A quantity of the whole bearing.
    fn one(self, name: &str, unit: &str, value: f64, digits: usize) -> Self {
        self.cells(name, unit, [Cell::number(value, digits), blank(), blank()])
    }

    /// A quantity of each race.
    fn both(self, name: &str, unit: &str, [inner, outer]: [f64; 2], digits: usize) -> Self {
        let cell = |value| Cell::number(value, digits);
        self.cells(name, unit, [blank(), cell(inner), cell(outer)])
    }

    fn cells(self, name: &str, unit: &str, [one, inner, outer]: [Cell; 3]) -> Self {
        let (name, unit) = (Cell::text(name), Cell::text(unit));
        Self(self.0.row([name, one, inner, outer, unit]))
    }
}

/// Cells of a quantity of one race.
fn on_race(race: Race, cell: Cell) -> [Cell; 3] {
    match race {
        Race::Inner => [blank(), cell, blank()],
        Race::Outer => [blank(), blank(), cell],
    }
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
    let mut rows = Rows(Table::new("Bearing", columns));
    rows = geometry_rows(rows, &setup.geometry);
    rows = order_rows(rows, setup);
    rows = contact_rows(rows, setup, contacts);
    if let Some(equilibrium) = equilibrium {
        rows = patch_rows(rows, contacts, equilibrium);
    }
    for wave in &setup.waves {
        let name = format!("Amplitude of the wave of order {}", wave.order);
        let amplitude = Cell::number(1e6 * wave.amplitude, 4);
        rows = rows.cells(&name, "\u{b5}m", on_race(wave.race, amplitude));
    }
    let largest = setup.oversizes.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
    if largest > 0.0 {
        rows = rows.one("Largest difference of a ball's radius", "\u{b5}m", 1e6 * largest, 4);
    }
    for defect in &setup.race_defects {
        for (name, drop) in drops(&setup.geometry, setup.stiffness, defect) {
            let drop = Cell::number(1e6 * drop, 4);
            rows = rows.cells(name, "\u{b5}m", on_race(defect.race(), drop));
        }
    }
    for flat in &setup.flats {
        let drop = |race| 1e6 * flat.shape.ball_drop(race);
        let angle = flat.shape.included_angle().to_degrees();
        let name = |what: &str| format!("{what} of the flat on ball {}", flat.ball);
        rows = rows.both(&name("Drop"), "\u{b5}m", [drop(Race::Inner), drop(Race::Outer)], 4).one(
            &name("Included angle"),
            "deg",
            angle,
            4,
        );
    }
    rows.0
}

fn geometry_rows(rows: Rows, geometry: &BearingGeometry) -> Rows {
    let dimensions = geometry.dimensions();
    let mut rows = rows
        .cells("Balls", "", [Cell::text(geometry.balls().to_string()), blank(), blank()])
        .one("Ball diameter", "mm", 2e3 * geometry.ball_radius(), 6)
        .one("Ball mass", "g", 1e3 * geometry.ball_mass(), 5)
        .one("Pitch diameter", "mm", 2e3 * geometry.pitch_radius(), 6)
        .one("Ball over pitch diameter", "", geometry.diameter_ratio(), 5)
        .both("Race radius", "mm", [dimensions.inner_race_radius, dimensions.outer_race_radius].map(|r| 1e3 * r), 6)
        .both(
            "Groove radius",
            "mm",
            [dimensions.inner_groove_radius, dimensions.outer_groove_radius].map(|r| 1e3 * r),
            6,
        )
        .both(
            "Conformity (groove radius over ball diameter)",
            "",
            [geometry.inner_conformity(), geometry.outer_conformity()],
            4,
        )
        .one("Radial play", "\u{b5}m", 1e6 * geometry.radial_play(), 4)
        .one("Diametral clearance", "\u{b5}m", 1e6 * geometry.diametral_clearance(), 4)
        .one("Contact angle (radial load)", "deg", 0.0, 3);
    if let Some(angle) = geometry.free_contact_angle() {
        rows = rows.one("Free contact angle (axial load)", "deg", angle.to_degrees(), 4);
    }
    rows
}

fn order_rows(rows: Rows, setup: &BearingSetup) -> Rows {
    let orders = setup.geometry.orders();
    let unit = "per shaft turn";
    let [least, most] = setup.cage.slip.range().map(|slip| 1e2 * slip);
    let slip = if least < most {
        Cell::text(format!("{} to {}", significant(least, 4), significant(most, 4)))
    } else {
        Cell::number(most, 4)
    };
    rows.one("Cage order without slip", unit, orders.cage, 5)
        .both("Defect order without slip", unit, [orders.inner, orders.outer], 5)
        .one("Ball spin order", unit, orders.ball_spin, 5)
        .one("Ball defect order (two hits a spin)", unit, orders.ball_defect, 5)
        .cells("Slip of the cage", "%", [slip, blank(), blank()])
}

fn contact_rows(rows: Rows, setup: &BearingSetup, contacts: &RaceContacts) -> Rows {
    let unit = "N/m^1.5";
    let both = |value: fn(&HertzStiffness) -> f64| [&contacts.inner, &contacts.outer].map(value);
    rows.both("Curvature sum", "1/mm", both(|c| 1e-3 * c.curvature_sum), 5)
        .both("Curvature difference F", "", both(|c| c.curvature_difference), 4)
        .both("Ellipticity of the patch", "", both(|c| c.ellipticity), 4)
        .both("Effective modulus", "GPa", both(|c| 1e-9 * c.effective_modulus), 5)
        .both("k by Hertz from the geometry", unit, both(|c| c.stiffness), 4)
        .both("k in use", unit, [setup.stiffness.inner(), setup.stiffness.outer()], 4)
        .one("k in use, both races in series", unit, setup.stiffness.series(), 4)
}

/// Patches under the largest force at rest, by Hertz from the geometry whatever k is in use.
fn patch_rows(rows: Rows, contacts: &RaceContacts, equilibrium: &Equilibrium) -> Rows {
    let largest = |force: fn(&crate::system::BallLoad) -> f64| equilibrium.balls.iter().map(force).fold(0.0, f64::max);
    let forces = [largest(|ball| ball.inner), largest(|ball| ball.outer)];
    let patches = [contacts.inner.patch(forces[0]), contacts.outer.patch(forces[1])];
    rows.both("Largest static contact force", "N", forces, 4)
        .both(
            "Its patch, half-axis across the rolling direction",
            "\u{b5}m",
            patches.map(|patch| 1e6 * patch.longer),
            4,
        )
        .both("Its patch, half-axis in the rolling direction", "\u{b5}m", patches.map(|patch| 1e6 * patch.shorter), 4)
        .both("Its largest pressure", "MPa", patches.map(|patch| 1e-6 * patch.peak_pressure), 4)
}

/// Name of the drop and its value (m). A dent with a width has two, in the plane and in its surface, as far as its
/// shape allows both.
fn drops(geometry: &BearingGeometry, stiffness: ContactStiffness, defect: &RaceDefect) -> Vec<(&'static str, f64)> {
    let race = defect.race();
    let in_plane = |shape: &DentShape| {
        let dent = Dent::new(geometry, race, *shape, stiffness).ok()?;
        Some(("Drop of a ball in the dent, in the plane", dent.ball_drop()))
    };
    let surface = |shape: &DentShape| {
        let dent = SurfaceDent::new(geometry, race, *shape, stiffness).ok()?;
        let name = "Drop of a ball in the dent, in its surface";
        Some((name, dent.ball_drop()))
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
