//! A bearing at rest, in tables and plots.

use crate::report::{Abscissa, Axis, Bars, Cell, Column, Curve, Plot, Section, Table, significant};
use crate::system::{BallLoad, BearingSetup, Equilibrium, Statics, stiffness_along};

/// Share of the largest force from which on a ball counts as loaded: more than its own weight.
const LOADED: f64 = 1e-2;

/// The section of a report.
pub(crate) fn statics_section(setup: &BearingSetup, statics: &Statics) -> Section {
    let section = Section::new("At rest");
    let Some(taken) = statics.equilibria.first() else {
        return section;
    };
    let section = section
        .table(equilibrium_table(taken))
        .bars(load_distribution(taken))
        .table(equilibria_table(&statics.equilibria));
    ball_pass(section, setup, statics)
}

/// Forces and positions at rest.
fn equilibrium_table(equilibrium: &Equilibrium) -> Table {
    let [x, y] = without_round_off(equilibrium.shaft.map(|x| 1e6 * x)).map(|x| significant(x, 4));
    let columns = [
        Column::number("Ball", ""),
        Column::number("Angle", "deg"),
        Column::number("Outward displacement", "\u{b5}m"),
        Column::number("Inner force", "N"),
        Column::number("Outer force", "N"),
    ];
    let rows = equilibrium.balls.iter().enumerate().map(|(index, ball)| {
        [
            Cell::text(index.to_string()),
            Cell::number(degrees(ball.angle), 5),
            Cell::number(ball.displacement * 1e6, 4),
            Cell::number(ball.inner, 4),
            Cell::number(ball.outer, 4),
        ]
    });
    Table::new(format!("Static equilibrium: shaft at ({x}, {y}) \u{b5}m"), columns).rows(rows)
}

fn degrees(angle: f64) -> f64 {
    angle.to_degrees().rem_euclid(360.0)
}

/// Values beside which some are nothing but round-off, those as zero.
pub(crate) fn without_round_off<const N: usize>(values: [f64; N]) -> [f64; N] {
    let largest = values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    values.map(|value| if value.abs() < 1e-9 * largest { 0.0 } else { value })
}

fn load_distribution(equilibrium: &Equilibrium) -> Bars {
    let mut balls: Vec<(usize, &BallLoad)> = equilibrium.balls.iter().enumerate().collect();
    balls.sort_by(|a, b| degrees(a.1.angle).total_cmp(&degrees(b.1.angle)));
    let labels = balls.iter().map(|(index, ball)| format!("{index} at {}\u{b0}", significant(degrees(ball.angle), 4)));
    let force = Axis::new("Contact force", "N");
    let bars = Bars {
        caption: Some("Contact forces at rest, ball by ball. The tallest bars are the balls that carry the shaft; a ball without a bar is unloaded.".to_owned()),
        ..Bars::new("Load distribution at rest", "Ball and its angle", labels, force)
    };
    bars.series("inner race", balls.iter().map(|(_, ball)| ball.inner).collect())
        .series("outer race", balls.iter().map(|(_, ball)| ball.outer).collect())
}

/// All equilibria that were found.
fn equilibria_table(equilibria: &[Equilibrium]) -> Table {
    let columns = [
        Column::text("Which"),
        Column::number("Shaft x", "\u{b5}m"),
        Column::number("Shaft y", "\u{b5}m"),
        Column::number("Largest inner force", "N"),
        Column::number("Balls under load", ""),
        Column::number("Stiffness xx", "N/\u{b5}m"),
        Column::number("Stiffness yy", "N/\u{b5}m"),
        Column::number("Stiffness xy", "N/\u{b5}m"),
        Column::text("Kind"),
    ];
    let rows = equilibria.iter().enumerate().map(|(number, rest)| {
        let largest = rest.balls.iter().map(|ball| ball.inner).fold(0.0, f64::max);
        let loaded = rest.balls.iter().filter(|ball| ball.inner > LOADED * largest).count();
        let [[xx, xy], [_, yy]] = rest.shaft_stiffness.map(|row| row.map(|k| 1e-6 * k));
        let [x, y] = without_round_off(rest.shaft.map(|x| 1e6 * x)).map(|x| Cell::number(x, 4));
        let [xx, yy, xy] = without_round_off([xx, yy, xy]).map(|k| Cell::number(k, 4));
        let kind = match rest.directions_down {
            0 => "stable",
            _ => "saddle: the shaft leaves it",
        };
        let which = Cell::text(if number == 0 { "taken" } else { "other" });
        [which, x, y, Cell::number(largest, 4), Cell::text(loaded.to_string()), xx, yy, xy, Cell::text(kind)]
    });
    Table::new("Equilibria that were found", columns).rows(rows).footnote(
        "The one is taken that the load pushes the shaft into from a start 0.01 \u{b5}m to its counter-clockwise side; a ball that nothing pushes stays where it touches the undeformed outer race.",
    )
}

/// Loads and stiffness while the cage turns by one ball spacing.
fn ball_pass(section: Section, setup: &BearingSetup, statics: &Statics) -> Section {
    let turned: Vec<f64> = statics.ball_pass.iter().map(|point| point.turned.to_degrees()).collect();
    let over_angle = |value: &dyn Fn(&Equilibrium) -> f64| -> Vec<f64> {
        let points = statics.ball_pass.iter();
        points.map(|point| point.equilibrium.as_ref().map_or(f64::NAN, value)).collect()
    };
    let axis = || Axis::new("Cage turned by", "deg");
    let mut forces = Plot::new("Load of every ball over a ball pass", axis(), Axis::new("Inner contact force", "N"))
        .caption("Load of each ball while the cage turns by one ball spacing. A curve that falls to zero is a ball that leaves the load zone.");
    for ball in 0..setup.balls() {
        let force = over_angle(&|rest| rest.balls.get(ball).map_or(f64::NAN, |ball| ball.inner));
        if force.iter().any(|force| *force > 0.0) {
            let curve = Curve::new(format!("ball {ball}"), Abscissa::Points(turned.clone()), force);
            forces = forces.curve(curve);
        }
    }
    let mut stiffness = Plot::new(
        "Stiffness of the bearing over a ball pass",
        axis(),
        Axis::new("Force over displacement", "N/m"),
    )
    .caption("Stiffness against a further force along x and along y, with balls, ring and housing following; linearised at the equilibrium of each angle. Its changes excite vibration at the ball pass frequency.");
    for (name, direction) in [("along x", [1.0, 0.0]), ("along y", [0.0, 1.0])] {
        let values = over_angle(&|rest| stiffness_along(rest, direction));
        stiffness = stiffness.curve(Curve::new(name, Abscissa::Points(turned.clone()), values));
    }
    section.plot(forces).plot(stiffness)
}
