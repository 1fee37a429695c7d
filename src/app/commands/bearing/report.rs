//! The report of `plummer bearing`.

use super::compute::{BearingResult, CurvePoint, shown_degrees, shown_displacement};
use crate::app::case::{Case, Purpose};
use crate::app::commands::parts::{self, signed_report};
use crate::bearing::RatingLife;
use crate::bearing::spatial::{BallState, BearingState, ShaftEquilibrium};
use crate::report::{
    Abscissa, Axis, Cell, Column, Curve, CurveStyle, Fact, Plot, Report, Section, Table, Verdict, counted, significant,
};
use std::f64::consts::TAU;

/// Names of the five coordinates.
const COORDINATES: [&str; 5] = ["x", "y", "z", "tilt about x", "tilt about y"];

/// Composes the report; `command` is the line that made it.
pub(crate) fn bearing_report(case: &Case, result: &BearingResult, command: &str) -> Report {
    let mut report = signed_report(case, command, "Bearing at rest");
    let taken = result.equilibria.first();
    let state = taken.and_then(|taken| taken.bearings.first());
    let most = |of: fn(&BallState) -> f64| state.map_or(0.0, |state| state.balls.iter().map(of).fold(0.0, f64::max));
    let stable = taken.is_some_and(ShaftEquilibrium::is_stable);
    report = report
        .headline("Equilibrium", if stable { "stable" } else { "a saddle" }, Verdict::of(stable))
        .headline(
            "Mean contact angle",
            format!("{}\u{b0}", significant(shown_degrees(result.contact_angle), 4)),
            Verdict::None,
        )
        .headline(
            "Largest ball load",
            format!("{} N", significant(most(|ball| ball.load[0].max(ball.load[1])), 4)),
            Verdict::None,
        )
        .headline(
            "Largest pressure",
            format!(
                "{} MPa",
                significant(1e-6 * most(|ball| ball.patch[0].peak_pressure.max(ball.patch[1].peak_pressure)), 4)
            ),
            Verdict::None,
        );
    if let Some(hours) = result.life.and_then(|life| life.life_h) {
        report = report.headline("Rating life L10r", format!("{} h", significant(hours, 3)), Verdict::None);
    }
    report = report.section(inputs(case, result));
    if let (Some(taken), Some(state)) = (taken, state) {
        let rest = Section::new("At rest")
            .table(displacement_table(result, taken))
            .table(stiffness_table(taken))
            .table(equilibria_table(&result.equilibria));
        report = report.section(rest).section(balls_section(state));
        if let Some(life) = &result.life {
            report = report.section(Section::new("Rating life").table(life_table(life)));
        }
        report = report.section(orders_section(result));
    }
    let curves = [
        ("Over the load", "Load over that of the case", "", &result.over_load),
        ("Over the speed", "Speed of the shaft", "rpm", &result.over_speed),
        match result.preload_is_displacement {
            true => ("Over the preload", "Axial displacement", "m", &result.over_preload),
            false => ("Over the preload", "Axial preload force", "N", &result.over_preload),
        },
    ];
    for (title, axis, unit, points) in curves {
        if !points.is_empty() {
            report = report.section(curve_section(title, axis, unit, points));
        }
    }
    report.warnings.extend_from_slice(&result.doubts);
    report
}

/// The case in words.
fn inputs(case: &Case, result: &BearingResult) -> Section {
    let [x, y, z] = result.load.force.map(|part| significant(part, 5));
    let [a, b] = result.load.moment.map(|part| significant(part, 5));
    let angle = result.free_contact_angle.map_or_else(
        || "none: the bearing has no play".to_owned(),
        |angle| format!("{}\u{b0}", significant(angle.to_degrees(), 5)),
    );
    Section::new("Inputs").facts(parts::inputs(case, Purpose::Bearing, None)).facts([
        Fact::new("Free contact angle", angle),
        Fact::new("Load on the shaft", format!("({x}, {y}, {z}) N, moment ({a}, {b}) N m"))
            .note("weight and preload included; z is the bearing's axis"),
        Fact::new("Speed", format!("{} rpm", significant(result.speed_rpm, 6))),
        Fact::new("Rings", "rigid, the outer one fixed").note("the housing's flexibility does not count"),
    ])
}

/// Values of five coordinates, lengths in um and tilts in mrad.
fn displacement_table(result: &BearingResult, taken: &ShaftEquilibrium) -> Table {
    let columns = [
        Column::text("Coordinate"),
        Column::number("Displacement", ""),
        Column::text("Unit"),
        Column::number("Load that holds it", ""),
        Column::text("Unit"),
    ];
    let holding = result.holding_load(taken);
    let rows = shown_displacement(&taken.displacement).into_iter().enumerate().map(|(index, value)| {
        let length = index < 3;
        let (unit, load) = if length { ("\u{b5}m", "N") } else { ("mrad", "N m") };
        let held = holding[index];
        let holds = if held.abs() > 0.0 { Cell::number(held, 5) } else { Cell::text("none") };
        [Cell::text(COORDINATES[index]), Cell::number(value, 5), Cell::text(unit), holds, Cell::text(load)]
    });
    Table::new("Displacement of the inner ring against the outer ring", columns).rows(rows).footnote(format!(
        "The force out of balance is {} N after {} steps.",
        significant(taken.residual_n, 2),
        taken.iterations
    ))
}

fn stiffness_table(taken: &ShaftEquilibrium) -> Table {
    let columns = [Column::text("Load by displacement")].into_iter();
    let columns = columns.chain(COORDINATES.iter().map(|name| Column::number(*name, "")));
    let rows = taken.stiffness.iter().enumerate().map(|(index, row)| {
        let name = if index < 3 {
            format!("force along {}", COORDINATES[index])
        } else {
            format!("moment {}", &COORDINATES[index][5..])
        };
        let largest = row.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let cells =
            row.iter().map(move |&value| Cell::number(if value.abs() < 1e-12 * largest { 0.0 } else { value }, 5));
        [Cell::text(name)].into_iter().chain(cells).collect::<Vec<_>>()
    });
    Table::new("Stiffness, the balls following", columns).rows(rows).footnote(
        "N/m for forces over displacements, N/rad and N beside tilts, N m/rad for moments over tilts, about the bearing's centre. Without speed the matrix is symmetric; friction and inertia of the balls make it lopsided.",
    )
}

fn equilibria_table(equilibria: &[ShaftEquilibrium]) -> Table {
    let columns = [
        Column::text("Which"),
        Column::number("x", "\u{b5}m"),
        Column::number("y", "\u{b5}m"),
        Column::number("z", "\u{b5}m"),
        Column::number("Tilt about x", "mrad"),
        Column::number("Tilt about y", "mrad"),
        Column::text("Kind"),
    ];
    let rows = equilibria.iter().enumerate().map(|(number, rest)| {
        let kind = match (rest.directions_down, rest.directions_loose) {
            (0, 0) => "stable".to_owned(),
            (0, loose) => format!("stable, {} held by nothing", counted(loose, "direction")),
            (down, _) => format!("saddle, {} down", counted(down, "direction")),
        };
        let moved = shown_displacement(&rest.displacement).map(|part| Cell::number(part, 4));
        let which = Cell::text(if number == 0 { "taken" } else { "other" });
        [which].into_iter().chain(moved).chain([Cell::text(kind)]).collect::<Vec<_>>()
    });
    Table::new("Equilibria that were found", columns).rows(rows)
}

fn balls_section(state: &BearingState) -> Section {
    let columns = [
        Column::number("Azimuth", "deg"),
        Column::number("Inner load", "N"),
        Column::number("Outer load", "N"),
        Column::number("Inner angle", "deg"),
        Column::number("Outer angle", "deg"),
        Column::number("Inner pressure", "MPa"),
        Column::number("Outer pressure", "MPa"),
        Column::number("Spin", "rpm"),
        Column::number("Orbit", "rpm"),
        Column::number("Centrifugal force", "N"),
        Column::number("Gyroscopic moment", "N mm"),
    ];
    let mut balls: Vec<&BallState> = state.balls.iter().collect();
    let degrees = |ball: &BallState| ball.azimuth.to_degrees().rem_euclid(360.0);
    balls.sort_by(|a, b| degrees(a).total_cmp(&degrees(b)));
    let rpm = |speed: f64| speed * 60.0 / TAU;
    let rows = balls.iter().map(|ball| {
        let angles = ball.contact_angle.map(|angle| Cell::number_or(angle.map(shown_degrees), 4, "no contact"));
        let [inner_angle, outer_angle] = angles;
        let [inner, outer] = ball.patch.map(|patch| Cell::number(1e-6 * patch.peak_pressure, 4));
        [
            Cell::number(degrees(ball), 5),
            Cell::number(ball.load[0], 5),
            Cell::number(ball.load[1], 5),
            inner_angle,
            outer_angle,
            inner,
            outer,
            Cell::number(rpm(ball.spin_speed), 5),
            Cell::number(rpm(ball.orbital_speed), 5),
            Cell::number(ball.centrifugal_force, 4),
            Cell::number(1e3 * ball.gyroscopic_moment, 4),
        ]
    });
    let azimuth = || Axis::new("Azimuth", "deg").range(0.0, 360.0);
    let over = |name: &str, of: &dyn Fn(&BallState) -> f64| {
        let at = balls.iter().map(|ball| degrees(ball)).collect();
        Curve::new(name, Abscissa::Points(at), balls.iter().map(|ball| of(ball)).collect())
    };
    let angle = |race: usize| move |ball: &BallState| ball.contact_angle[race].map_or(f64::NAN, shown_degrees);
    let loads = Plot::new("Ball loads", azimuth(), Axis::new("Contact force", "N"))
        .curve(over("inner race", &|ball| ball.load[0]))
        .curve(over("outer race", &|ball| ball.load[1]).style(CurveStyle::Dashed))
        .caption("Contact force of every ball over its azimuth. Balls at zero carry nothing; the outer race bears the centrifugal force too.");
    let angles = Plot::new("Contact angles", azimuth(), Axis::new("Contact angle", "deg"))
        .curve(over("inner race", &angle(0)))
        .curve(over("outer race", &angle(1)).style(CurveStyle::Dashed))
        .caption("Contact angle of every ball that touches, at both races. With speed the two part: the outer angle falls, the inner one grows.");
    let section = Section::new("Balls").plot(loads);
    // no ball touches a bearing without load
    let section = if angles.has_points() { section.plot(angles) } else { section };
    section.table(Table::new("Balls", columns).rows(rows))
}

fn life_table(life: &RatingLife) -> Table {
    let columns = [Column::text("Quantity"), Column::number("Value", ""), Column::text("Unit")];
    let rows = [
        ("Basic dynamic load rating C", Some(life.load_rating_n), "N"),
        ("Dynamic equivalent reference load", life.reference_load_n, "N"),
        ("Basic reference rating life L10r", life.life_mrev, "million revolutions"),
        ("The same at this speed", life.life_h, "h"),
    ];
    let rows = rows
        .into_iter()
        .filter_map(|(name, value, unit)| Some([Cell::text(name), Cell::number(value?, 4), Cell::text(unit)]));
    Table::new("Rating life", columns).rows(rows).footnote(parts::LIFE_NOTE)
}

fn orders_section(result: &BearingResult) -> Section {
    let orders = result.orders;
    let columns = [Column::text("Part"), Column::number("Order", "1/turn"), Column::number("Frequency", "Hz")];
    let hz = result.speed_rpm.abs() / 60.0;
    let rows = [
        ("Outer race (BPFO)", orders.outer),
        ("Inner race (BPFI)", orders.inner),
        ("Ball spin (BSF)", orders.ball_spin),
        ("Cage (FTF)", orders.cage),
    ]
    .map(|(part, order)| [Cell::text(part), Cell::number(order, 6), Cell::number(order * hz, 6)]);
    let caption =
        format!("Orders at the mean contact angle of {}\u{b0}", significant(shown_degrees(result.contact_angle), 4));
    Section::new("Orders").table(Table::new(caption, columns).rows(rows))
}

fn curve_section(title: &str, axis: &str, unit: &str, points: &[CurvePoint]) -> Section {
    let x = || match unit {
        "rpm" => Axis::new(axis, unit),
        _ => Axis::new(axis, unit).log(),
    };
    let over = |name: &str, of: &dyn Fn(&CurvePoint) -> Option<f64>| {
        let at = points.iter().map(|point| point.at).collect();
        Curve::new(name, Abscissa::Points(at), points.iter().map(|point| of(point).unwrap_or(f64::NAN)).collect())
    };
    let mut lengths = Plot::new("Displacement", x(), Axis::new("Displacement", "\u{b5}m"))
        .caption("Displacement of the inner ring. A gap is a point without equilibrium.");
    let mut tilts = Plot::new("Tilt", x(), Axis::new("Tilt", "mrad")).caption("Tilt of the inner ring.");
    let mut stiffness = Plot::new("Radial and axial stiffness", x(), Axis::new("Stiffness", "N/\u{b5}m"))
        .caption("Stiffness along each axis, the other coordinates held.");
    let mut tilting = Plot::new("Tilting stiffness", x(), Axis::new("Stiffness", "N m/rad"))
        .caption("Stiffness against tilt about each axis, the other coordinates held.");
    for (index, name) in COORDINATES.iter().enumerate() {
        let length = index < 3;
        let (scale, by) = if length { (1e6, 1e-6) } else { (1e3, 1.0) };
        let moved = over(name, &|point| Some(scale * point.displacement?[index]));
        let stiff = over(name, &|point| Some(by * point.stiffness?[index]));
        if length {
            (lengths, stiffness) = (lengths.curve(moved), stiffness.curve(stiff));
        } else {
            (tilts, tilting) = (tilts.curve(moved), tilting.curve(stiff));
        }
    }
    let life = Plot::new("Rating life", x(), Axis::new("L10r", "million revolutions").log())
        .curve(over("L10r", &|point| point.life))
        .caption("Basic reference rating life (ISO/TS 16281). A gap is a point without life or without load.");
    let plots = [lengths, tilts, stiffness, tilting, life];
    plots.into_iter().filter(Plot::has_points).fold(Section::new(title), Section::plot)
}
