//! The numbers of Tadina & Boltezar (2011), and what they rest on.

use super::section::{
    BEAM_CASE, BEARING, Check, GRAVITY, Information, Kind, SectionResult, VerificationError, built_in,
};
use crate::app::commands::modes::{ModesResult, compute_modes};
use crate::app::scene::bearing_setup;
use crate::bearing::hertz::{effective_modulus, sphere_on_flat};
use crate::bearing::impact::impact;
use crate::bearing::kinematics::BallRow;
use crate::bearing::{BearingGeometry, ContactMaterial, RaceContacts};
use crate::numerics::{Unwatched, Watch};
use crate::report::Section;
use std::f64::consts::PI;

/// Title of the section.
const TITLE: &str = "The paper's numbers";

/// Keys of the built-in case: without the variants that it lists.
const BASE: &str = "modes.variants=[]";

/// Keys of the consistent equations with two balls under the load, and with one.
const TWO_BALLS: [&str; 2] = [BASE, "bearing.formulation=consistent"];
const ONE_BALL: [&str; 3] = [TWO_BALLS[0], TWO_BALLS[1], "bearing.first_ball_deg=270"];

/// Where the choices behind the built-in case are studied.
const STUDY: &str = "The paper does not report all choices behind its eigenfrequencies. The example paper_readings computes 155,520 readings of it and finds those that fit: `cargo run --release --example paper_readings` in the source tree.";

/// Carries the section out.
///
/// # Errors
/// [`VerificationError`] if a built-in case cannot be computed; a number that is wrong is no error.
pub(super) fn paper(watch: &impl Watch) -> Result<SectionResult, VerificationError> {
    watch.stage("closed forms");
    let mut checks = [orders()?, contacts()?, sphere()?, second_bearing()?].concat();
    watch.stage("frequencies");
    let base = compute(&[BASE])?;
    watch.fraction(1.0 / 3.0);
    let two = compute(&TWO_BALLS)?;
    watch.fraction(2.0 / 3.0);
    let one = compute(&ONE_BALL)?;
    checks.extend(frequencies(&base));
    checks.extend(ball_pass(&two, &one)?);
    let mut information: Vec<Information> = ring_at_35(&base).into_iter().collect();
    information.extend(consistent_frequencies(&two));
    Ok(SectionResult {
        information,
        report: vec![Section::new("").paragraph(STUDY)],
        ..SectionResult::of_checks(TITLE, checks)
    })
}

/// `plummer modes` of the built-in case with keys set.
fn compute(set: &[&str]) -> Result<ModesResult, VerificationError> {
    let case = built_in("beam.toml", BEAM_CASE, set)?;
    Ok(compute_modes(&case, &Unwatched)?)
}

fn orders() -> Result<Vec<Check>, VerificationError> {
    let pitch = BEARING.inner_race_radius + BEARING.outer_race_radius;
    let ball = 2.0 * BEARING.ball_radius;
    let orders = BallRow::new(BEARING.balls, ball, pitch, 0.0)?.orders();
    let kind = Kind {
        unit: "per shaft turn",
        source: "Tadina & Boltezar 2011, Table 2",
        assumptions: "Rolling without slip, outer race at rest, contact angle zero; pitch diameter R + r = 7.5105 mm of Table 1.",
        reason: "One unit in the last of the four printed digits: the source cuts 3.48896 to 3.488 where rounding gives 3.489.",
    };
    let unit = 1e-3;
    Ok(vec![
        kind.check("Defect order, outer race", orders.outer, 2.568, unit / 2.568),
        kind.check("Defect order, inner race", orders.inner, 4.432, unit / 4.432),
        kind.check("Defect order, ball", orders.ball_defect, 3.488, unit / 3.488),
    ])
}

fn contacts() -> Result<Vec<Check>, VerificationError> {
    let steel = ContactMaterial { young: 206e9, poisson: 0.3 };
    let geometry = BearingGeometry::new(BEARING)?;
    let contacts = RaceContacts::new(&geometry, steel, steel, steel)?;
    let kind = |unit, reason| Kind {
        unit,
        source: "an independent computation: Harris, Rolling Bearing Analysis, (6.23) to (6.41), elliptic integrals of SciPy",
        assumptions: "Table 1's radii; grooves concave across the rolling direction. The inner race is convex along it, the outer race concave. Ball and races of steel, 206 GPa, nu 0.3.",
        reason,
    };
    let k = kind("N/m^(3/2)", "The reference has four digits and is asked to 0.1 %.");
    let in_series = kind("N/m^(3/2)", "Half a unit in the last of three digits.");
    let shape = kind("", "Half a unit in the reference's last digit.");
    let (inner, outer) = (contacts.inner, contacts.outer);
    Ok(vec![
        k.check("Hertz stiffness, inner race", inner.stiffness, 1.257e10, 1e-3),
        k.check("Hertz stiffness, outer race", outer.stiffness, 1.129e10, 1e-3),
        in_series.check("Both contacts in series", contacts.stiffness().series(), 4.21e9, 0.5e-2 / 4.21),
        shape.check("Curvature difference F, inner race", inner.curvature_difference, 0.9451, 0.5e-4 / 0.9451),
        shape.check("Curvature difference F, outer race", outer.curvature_difference, 0.8470, 0.5e-4 / 0.8470),
        shape.check("Ellipticity, inner race", inner.ellipticity, 9.818, 0.5e-3 / 9.818),
        shape.check("Ellipticity, outer race", outer.ellipticity, 5.065, 0.5e-3 / 5.065),
    ])
}

fn sphere() -> Result<Vec<Check>, VerificationError> {
    let modulus = effective_modulus([2.1e11; 2], [0.3; 2])?;
    let radius: f64 = 5e-3;
    let contact = sphere_on_flat(radius, modulus)?;
    let mass = 7800.0 * 4.0 / 3.0 * PI * radius.powi(3);
    let peak = impact(contact.stiffness, mass, 1.0)?;
    let kind = |unit, reason| Kind {
        unit,
        source: "closed form: Johnson, Contact Mechanics, (11.22) to (11.24)",
        assumptions: "Steel sphere, diameter 10 mm, on a flat of the same steel: 210 GPa, nu 0.3, 7800 kg/m^3, at 1 m/s, elastic, quasi-static.",
        reason,
    };
    let exact = "Seven digits are given; 1e-6.";
    let force = kind("N", "Half a unit in the last of five digits.");
    Ok(vec![
        kind("N/m^(3/2)", exact).check("Sphere on a flat: stiffness", contact.stiffness, 1.087_857e10, 1e-6),
        kind("m", exact).check("Sphere on a flat: indentation", peak.indentation, 1.171_042e-5, 1e-6),
        force.check("Sphere on a flat: force", peak.force, 435.94, 0.5e-2 / 435.94),
        kind("s", exact).check("Sphere on a flat: contact time", peak.contact_time, 3.446_700e-5, 1e-6),
    ])
}

fn second_bearing() -> Result<Vec<Check>, VerificationError> {
    let orders = BallRow::new(8, 20e-3, 120e-3, 0.0)?.orders();
    let kind = Kind {
        unit: "Hz",
        source: "closed form: Harris, chapter 8",
        assumptions: "8 balls of 20 mm on a pitch circle of 120 mm, contact angle zero, shaft at 25 Hz, no slip.",
        reason: "Half a unit in the last printed digit.",
    };
    let check = |name: &str, order: f64, hz: f64| kind.check(name, 25.0 * order, hz, 0.5e-4 / hz);
    Ok(vec![
        check("Second bearing: cage", orders.cage, 10.416_7),
        check("Second bearing: outer race", orders.outer, 83.333_3),
        check("Second bearing: inner race", orders.inner, 116.666_7),
        check("Second bearing: ball spin", orders.ball_spin, 72.916_7),
    ])
}

/// The three frequencies of the built-in case.
fn frequencies(result: &ModesResult) -> Vec<Check> {
    let kind = Kind {
        unit: "Hz",
        source: "Tadina & Boltezar 2011, section 4.2",
        assumptions: "The built-in case examples/tadina2011/beam.toml: the source's own equations (misprints put right), k from the geometry. Rings slip on each other but bend about their common centroid, without shear. The housing ring is 4 mm wide; steel has 210 GPa, aluminium 72 GPa. Springs in x and y stand on the housing ring's centre line. Two balls are under the load, at rest. One of many readings: see the example paper_readings.",
        reason: "The source gives two to three digits and says \"around\": half a unit of 8.2 kHz is 0.6 %, of 36 kHz 1.4 %.",
    };
    let expected = result.base.expected.iter();
    expected
        .map(|expected| {
            let found = expected.found_hz.unwrap_or(f64::NAN);
            let name = format!("Eigenfrequency: {}", expected.what);
            kind.check(&name, found, expected.hz, 0.015)
        })
        .collect()
}

/// Section 4.1 has another figure for the ring than section 4.2.
fn ring_at_35(result: &ModesResult) -> Option<Information> {
    let loaded = result.base.loaded.as_ref()?;
    let lower = loaded.modes.iter().find(|mode| !mode.is_ball_mode() && mode.frequency_hz > 20e3)?;
    Some(Information {
        name: "Eigenfrequency: ring, two waves, the lower of the pair".to_owned(),
        section: TITLE.to_owned(),
        computed: lower.frequency_hz,
        source_value: Some(35e3),
        unit: "Hz".to_owned(),
        assumptions:
            "As above. Tadina & Boltezar 2011 says 35 kHz in section 4.1 and 36 kHz in section 4.2, and not of which model.".to_owned(),
    })
}

/// What the consistent equations give where the source has its three.
fn consistent_frequencies(result: &ModesResult) -> Vec<Information> {
    let expected = result.base.expected.iter();
    expected
        .filter_map(|expected| {
            Some(Information {
                name: format!("Consistent equations, nearest to: {}", expected.what),
                section: TITLE.to_owned(),
                computed: expected.found_hz?,
                source_value: Some(expected.hz),
                unit: "Hz".to_owned(),
                assumptions: "The built-in case with bearing.formulation = \"consistent\" and nothing else changed; not judged: the source's numbers do not belong to these equations.".to_owned(),
            })
        })
        .collect()
}

/// Two balls share the weight; over one the shaft leans on a neighbour.
fn ball_pass(two: &ModesResult, one: &ModesResult) -> Result<Vec<Check>, VerificationError> {
    let case = built_in("beam.toml", BEAM_CASE, &[BASE])?;
    let setup = bearing_setup(&case)?.ok_or("the built-in case has no bearing")?;
    let weight = setup.shaft.mass * GRAVITY;
    let spacing = 2.0 * PI / f64::from(BEARING.balls);
    let equilibria = |result: &ModesResult| {
        let statics = result.statics.iter();
        statics.flat_map(|statics| statics.equilibria.clone()).collect::<Vec<_>>()
    };
    let kind = |unit, source, reason| Kind {
        unit,
        source,
        assumptions: "Consistent equations; Table 1's bearing with k from the geometry. The ring is on its springs at the housing ring's centre line. The shaft of 0.15 kg is at rest, 9.81 m/s^2.",
        reason,
    };
    let share = weight / (2.0 * (0.5 * spacing).cos());
    let balance = kind("N", "statics", "Balls above rest on the inner race: 7e-4 N in all, 5e-4 of the weight.");
    let shared = equilibria(two);
    let force = |ball: usize| {
        let rest = shared.first();
        rest.and_then(|rest| rest.balls.get(ball)).map_or(f64::NAN, |ball| ball.inner)
    };
    let last = BEARING.balls as usize - 1;
    let over_one = equilibria(one);
    let saddle = over_one.iter().find(|rest| rest.directions_down == 1);
    let below = saddle.and_then(|saddle| saddle.balls.first());
    let lean = match (over_one.first(), saddle) {
        (Some(rest), Some(saddle)) => (rest.shaft[0] - saddle.shaft[0]).abs(),
        _ => f64::NAN,
    };
    // the shaft rests on the ball below, pressed in by delta, and moves aside until the neighbour's clearance is gone
    let play = setup.geometry.radial_play();
    let sunk = play + (weight / setup.stiffness.series()).powf(2.0 / 3.0);
    let expected = (play - sunk * spacing.cos()) / spacing.sin();
    let geometry = kind(
        "m",
        "geometry: (c - (c + delta) cos(360/7 deg)) / sin(360/7 deg), delta of Hertz",
        "The ring's own bending under the ball and the weight of the balls are left out of the closed form: 1 %.",
    );
    Ok(vec![
        balance.check("Two balls below: force on the one", force(0), share, 1e-3),
        balance.check("Two balls below: force on the other", force(last), share, 1e-3),
        balance.check("One ball below (a saddle): its force", below.map_or(f64::NAN, |ball| ball.inner), weight, 1e-3),
        geometry.check("One ball below: the shaft leans by", lean, expected, 1e-2),
    ])
}
