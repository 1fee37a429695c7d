//! The report of `plummer bearing`.

use super::compute::{BearingAtRest, BearingResult, CurvePoint, shown_degrees, shown_displacement};
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
    let mut report =
        signed_report(case, command, if result.bearings.len() > 1 { "Bearings at rest" } else { "Bearing at rest" });
    let taken = result.equilibria.first();
    let balls = || taken.into_iter().flat_map(|taken| &taken.bearings).flat_map(|state| &state.balls);
    let most = |of: fn(&BallState) -> f64| balls().map(of).fold(0.0, f64::max);
    let stable = taken.is_some_and(ShaftEquilibrium::is_stable);
    report = report
        .headline("Equilibrium", if stable { "stable" } else { "a saddle" }, Verdict::of(stable))
        .headline("Mean contact angle", result.each(|own| Some(degrees(own.contact_angle, 4))), Verdict::None)
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
    let hours = result.each(|own| own.life?.life_h.map(|hours| format!("{} h", significant(hours, 3))));
    if !hours.is_empty() {
        report = report.headline("Rating life L10r", hours, Verdict::None);
    }
    report = report.section(inputs(case, result));
    if let Some(taken) = taken {
        let rest = Section::new("At rest")
            .table(displacement_table(result, taken))
            .table(stiffness_table(taken))
            .table(equilibria_table(&result.equilibria));
        report = report.section(rest);
        for (own, state) in result.bearings.iter().zip(&taken.bearings) {
            report = report.section(balls_section(&own.titled("Balls"), state));
        }
        if result.bearings.iter().any(|own| own.life.is_some()) {
            report = report.section(Section::new("Rating life").table(life_table(&result.bearings)));
        }
        let orders = result.bearings.iter().map(|own| orders_table(own, result.speed_rpm));
        report = report.section(orders.fold(Section::new("Orders"), Section::table));
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
    let angle = result.each(|own| {
        let free = own.free_contact_angle.map(|angle| degrees(angle, 5));
        Some(free.unwrap_or_else(|| "none: the bearing has no play".to_owned()))
    });
    Section::new("Inputs").facts(parts::inputs(case, Purpose::Bearing, None)).facts([
        Fact::new("Free contact angle", angle),
        Fact::new("Load on the shaft", format!("({x}, {y}, {z}) N, moment ({a}, {b}) N m"))
            .note("weight included, and the preload of a bearing alone; z is the axis"),
        Fact::new("Speed", format!("{} rpm", significant(result.speed_rpm, 6))),
        Fact::new("Rings", "rigid, the outer ones fixed").note("the housing's flexibility does not count"),
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
        "N/m for forces over displacements, N/rad and N beside tilts, N m/rad for moments over tilts, about the first bearing's centre. Without speed the matrix is symmetric; friction and inertia of the balls make it lopsided.",
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

fn balls_section(title: &str, state: &BearingState) -> Section {
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
    let section = Section::new(title).plot(loads);
    // no ball touches a bearing without load
    let section = if angles.has_points() { section.plot(angles) } else { section };
    section.table(Table::new(title, columns).rows(rows))
}

/// What a bearing's life is made of.
type LifeRow = (&'static str, fn(&RatingLife) -> Option<f64>, &'static str);

fn life_table(bearings: &[BearingAtRest]) -> Table {
    let rows: [LifeRow; 4] = [
        ("Basic dynamic load rating C", |life| Some(life.load_rating_n), "N"),
        ("Dynamic equivalent reference load", |life| life.reference_load_n, "N"),
        ("Basic reference rating life L10r", |life| life.life_mrev, "million revolutions"),
        ("The same at this speed", |life| life.life_h, "h"),
    ];
    let values = bearings.iter().map(|own| Column::number(own.named().unwrap_or_else(|| "Value".to_owned()), ""));
    let columns = [Column::text("Quantity")].into_iter().chain(values).chain([Column::text("Unit")]);
    let rows = rows.into_iter().filter_map(|(name, of, unit)| {
        let values: Vec<Option<f64>> = bearings.iter().map(|own| of(own.life.as_ref()?)).collect();
        let cells = values.iter().map(|value| Cell::number_or(*value, 4, "not given"));
        let row = [Cell::text(name)].into_iter().chain(cells).chain([Cell::text(unit)]);
        values.iter().any(Option::is_some).then(|| row.collect::<Vec<_>>())
    });
    Table::new("Rating life", columns).rows(rows).footnote(parts::LIFE_NOTE)
}

fn orders_table(own: &BearingAtRest, speed_rpm: f64) -> Table {
    let orders = own.orders;
    let columns = [Column::text("Part"), Column::number("Order", "1/turn"), Column::number("Frequency", "Hz")];
    let hz = speed_rpm.abs() / 60.0;
    let rows = [
        ("Outer race (BPFO)", orders.outer),
        ("Inner race (BPFI)", orders.inner),
        ("Ball spin (BSF)", orders.ball_spin),
        ("Cage (FTF)", orders.cage),
    ]
    .map(|(part, order)| [Cell::text(part), Cell::number(order, 6), Cell::number(order * hz, 6)]);
    let caption = own.titled(&format!("Orders at the mean contact angle of {}", degrees(own.contact_angle, 4)));
    Table::new(caption, columns).rows(rows)
}

/// An angle (rad) in degrees.
fn degrees(angle: f64, digits: usize) -> String {
    format!("{}\u{b0}", significant(shown_degrees(angle), digits))
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
