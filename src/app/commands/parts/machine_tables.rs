//! A shaft in its bearings, in tables and plots.

use super::without_round_off;
use crate::app::scene::MachineScene;
use crate::bearing::RatingLife;
use crate::bearing::kinematics::DefectOrders;
use crate::bearing::spatial::Thrust;
use crate::report::{Abscissa, Axis, Cell, Column, Curve, CurveStyle, Plot, Section, Table, significant};
use crate::system::{BearingInPlace, SpatialBallLoad, SpatialEquilibrium, SpatialSetup};

/// What a reader must know of a rating life.
pub(crate) const LIFE_NOTE: &str = "C by ISO 281 for bearing steel; grooves wider than 0.52 (outer 0.53) of the ball lower it. A maker's own C changes the life by the cube of the ratio. L10r by ISO/TS 16281 from these ball loads, for a load at rest against the outer ring: no unbalance, shoulders, lubricant or contamination. With few balls it hangs on where they stand (first_ball_deg).";

/// Every bearing in a column: geometry, contact angle, loads, life and orders.
pub(crate) fn bearings_table(scene: &MachineScene) -> Table {
    let MachineScene { setup, orders, equilibrium: rest, .. } = scene;
    let columns = [Column::text("Quantity"), Column::text("Unit")].into_iter();
    let columns = columns.chain(setup.bearings.iter().map(|own| Column::number(heading(own), "")));
    let all =
        || setup.bearings.iter().zip(orders).zip(&rest.bearings).map(|((own, orders), balls)| (own, orders, balls));
    type Bearing<'a> = (&'a BearingInPlace, &'a DefectOrders, &'a Vec<SpatialBallLoad>);
    let life = |of: fn(RatingLife) -> Option<f64>| {
        move |(own, _, balls): Bearing<'_>| {
            Cell::number_or(scene.rating_life(own, balls).ok().and_then(of), 4, "not given")
        }
    };
    let row = |name: &str, unit: &str, of: &dyn Fn(Bearing<'_>) -> Cell| {
        [Cell::text(name), Cell::text(unit)].into_iter().chain(all().map(of)).collect::<Vec<_>>()
    };
    let number = |of: fn(Bearing<'_>) -> f64, digits: usize| move |own: Bearing<'_>| Cell::number(of(own), digits);
    let rows = [
        row("Balls", "", &|(own, ..)| Cell::text(own.bearing.balls().to_string())),
        row("Ball diameter", "mm", &number(|(own, ..)| 2e3 * own.bearing.geometry().ball_radius(), 6)),
        row("Pitch diameter", "mm", &number(|(own, ..)| 2e3 * own.bearing.geometry().pitch_radius(), 6)),
        row("Place along the shaft from its centre of mass", "mm", &number(|(own, ..)| 1e3 * own.place, 6)),
        row("Holds thrust on the shaft", "", &|(own, ..)| {
            Cell::text(match own.bearing.thrust() {
                Thrust::Both => "both ways",
                thrust if thrust.sign() > 0.0 => "along +z",
                _ => "along -z",
            })
        }),
        row("Free contact angle", "deg", &|(own, ..)| {
            Cell::number_or(own.bearing.geometry().free_contact_angle().map(f64::to_degrees), 4, "no play")
        }),
        row("Mean contact angle at rest, by the loads", "deg", &|(.., balls)| {
            Cell::number_or(mean_angle(balls), 4, "no load")
        }),
        row("Axial force of the inner race on the balls at rest", "N", &number(|(.., balls)| axial_force(balls), 4)),
        row("Balls that carry load at rest", "", &|(.., balls)| {
            Cell::text(balls.iter().filter(|ball| ball.load[0].max(ball.load[1]) > 0.0).count().to_string())
        }),
        row("Largest ball load at rest", "N", &number(|(.., balls)| balls.iter().map(larger).fold(0.0, f64::max), 4)),
        row(
            "Largest pressure at rest",
            "MPa",
            &number(|(own, _, balls)| 1e-6 * MachineScene::largest_pressure(own, balls), 4),
        ),
        row("Basic dynamic load rating C", "N", &life(|life| Some(life.load_rating_n))),
        row("Rating life L10r under the loads at rest", "million revolutions", &life(|life| life.life_mrev)),
        row("The same at the speed at the start", "h", &life(|life| life.life_h)),
        row("Outer race (BPFO)", "per turn", &number(|(_, orders, _)| orders.outer, 5)),
        row("Inner race (BPFI)", "per turn", &number(|(_, orders, _)| orders.inner, 5)),
        row("Ball (2 x BSF)", "per turn", &number(|(_, orders, _)| orders.ball_defect, 5)),
        row("Cage (FTF)", "per turn", &number(|(_, orders, _)| orders.cage, 5)),
    ];
    Table::new("Bearings", columns)
        .rows(rows)
        .footnote("Orders are those without slip at the contact angles in force at the highest speed of the run.")
        .footnote(LIFE_NOTE)
}

fn heading(own: &BearingInPlace) -> String {
    if own.label.is_empty() { "Value".to_owned() } else { format!("Bearing {}", own.label) }
}

fn larger(ball: &SpatialBallLoad) -> f64 {
    ball.load[0].max(ball.load[1])
}

/// Mean contact angle at both races by the loads, degrees; `None` where no ball is loaded.
fn mean_angle(balls: &[SpatialBallLoad]) -> Option<f64> {
    let contacts = balls.iter().flat_map(|ball| ball.contact_angle.into_iter().zip(ball.load));
    let (sum, loads) = contacts
        .filter_map(|(angle, load)| Some((angle?, load)))
        .fold((0.0, 0.0), |(sum, loads), (angle, load)| (sum + load * angle.abs(), loads + load));
    (loads > 0.0).then(|| (sum / loads).to_degrees())
}

/// Axial part of the inner race's forces on the balls, N: with preload alone what is left of it in elastic rings.
fn axial_force(balls: &[SpatialBallLoad]) -> f64 {
    balls.iter().map(|ball| ball.load[0] * ball.contact_angle[0].unwrap_or(0.0).sin()).sum()
}

/// Where the shaft rests, and what the balls carry.
pub(crate) fn shaft_at_rest(setup: &SpatialSetup, equilibria: &[SpatialEquilibrium]) -> Section {
    let Some(rest) = equilibria.first() else {
        return Section::new("At rest");
    };
    let names = ["x", "y", "z", "tilt about x", "tilt about y"];
    let columns = [
        Column::text("Coordinate"),
        Column::number("Displacement", ""),
        Column::text("Unit"),
        Column::number("Stiffness", ""),
        Column::text("Unit"),
    ];
    let rows = names.into_iter().enumerate().map(|(index, name)| {
        let (scale, unit, by, stiffness) = match index < 3 {
            true => (1e6, "\u{b5}m", 1e-6, "N/\u{b5}m"),
            false => (1e3, "mrad", 1.0, "N m/rad"),
        };
        [
            Cell::text(name),
            Cell::number(scale * rest.shaft[index], 5),
            Cell::text(unit),
            Cell::number(by * rest.shaft_stiffness[index][index], 4),
            Cell::text(stiffness),
        ]
    });
    let stable = if rest.directions_down == 0 { "stable" } else { "not stable" };
    let table = Table::new("The shaft's centre of mass at rest", columns).rows(rows).footnote(format!(
        "The equilibrium is {stable}. The force out of balance is {} N. Stiffness is against the ground, balls, rings and housing following.",
        significant(rest.residual_n, 2)
    ));
    let degrees = |ball: &SpatialBallLoad| ball.azimuth.to_degrees().rem_euclid(360.0);
    let azimuth = || Axis::new("Azimuth", "deg").range(0.0, 360.0);
    let mut loads = Plot::new("Ball loads at rest", azimuth(), Axis::new("Contact force", "N"))
        .caption("Force of the outer race on every ball over its azimuth. Balls at zero carry nothing.");
    let mut angles = Plot::new("Contact angles at rest", azimuth(), Axis::new("Contact angle", "deg"))
        .caption("Contact angle at the outer race of every ball that touches.");
    for (number, (own, balls)) in setup.bearings.iter().zip(&rest.bearings).enumerate() {
        let mut balls: Vec<&SpatialBallLoad> = balls.iter().collect();
        balls.sort_by(|a, b| degrees(a).total_cmp(&degrees(b)));
        let style = if number == 0 { CurveStyle::Line } else { CurveStyle::Dashed };
        let curve = |of: &dyn Fn(&SpatialBallLoad) -> f64| {
            let at = balls.iter().map(|ball| degrees(ball)).collect();
            Curve::new(heading(own), Abscissa::Points(at), balls.iter().map(|ball| of(ball)).collect()).style(style)
        };
        loads = loads.curve(curve(&|ball| ball.load[1]));
        angles = angles.curve(curve(&|ball| ball.contact_angle[1].map_or(f64::NAN, f64::to_degrees)));
    }
    let section = Section::new("At rest").table(table).plot(loads).table(equilibria_table(equilibria));
    if angles.has_points() { section.plot(angles) } else { section }
}

/// What a reader must know of the model in space to judge the numbers.
pub(crate) fn assumptions_in_space(setup: &SpatialSetup) -> Vec<String> {
    let mut list = vec![
        "Balls follow a prescribed cage and move radially and along the axis; contact angles follow. The shaft is rigid: it moves along three axes and tilts about two.".to_owned(),
        "The cage turns as the balls roll at the contact angles in force at the highest speed of the run; orders do not follow the speed.".to_owned(),
        "The modes left out act by their static response under the balls, where transient.residual is true.".to_owned(),
    ];
    if !setup.has_defects() {
        list.push("Without damage a machine vibrates as its compliance varies along the races. That hangs on mesh and ring nodes, and the estimate does not cover it: compare with more ring.nodes.".to_owned());
    }
    let damping = setup.bearings.iter().map(|own| own.contact_damping).fold(0.0, f64::max);
    if damping > 0.0 {
        list.push(format!("Contact damping (Hunt-Crossley) up to {} s/m.", significant(damping, 4)));
    }
    list
}

/// All equilibria that were found.
fn equilibria_table(equilibria: &[SpatialEquilibrium]) -> Table {
    let columns = [
        Column::text("Which"),
        Column::number("Shaft x", "\u{b5}m"),
        Column::number("Shaft y", "\u{b5}m"),
        Column::number("Shaft z", "\u{b5}m"),
        Column::number("Tilt about x", "mrad"),
        Column::number("Tilt about y", "mrad"),
        Column::number("Largest inner force", "N"),
        Column::text("Kind"),
    ];
    let rows = equilibria.iter().enumerate().map(|(number, rest)| {
        let [x, y, z, a, b] = rest.shaft;
        let [x, y, z] = without_round_off([x, y, z].map(|x| 1e6 * x)).map(|x| Cell::number(x, 4));
        let [a, b] = without_round_off([a, b].map(|a| 1e3 * a)).map(|a| Cell::number(a, 4));
        let largest = rest.bearings.iter().flatten().map(|ball| ball.load[0]).fold(0.0, f64::max);
        let kind = if rest.is_stable() { "stable" } else { "saddle: the shaft leaves it" };
        let which = Cell::text(if number == 0 { "taken" } else { "other" });
        [which, x, y, z, a, b, Cell::number(largest, 4), Cell::text(kind)]
    });
    Table::new("Equilibria that were found", columns)
        .rows(rows)
        .footnote("The one is taken to which the loads lead from the rest of the same shaft in rigid outer rings.")
}
