//! Bearing geometry and defects.

use std::f64::consts::PI;

use super::super::{
    Bearing, Case, ContactStiffness, Defect, DentDefect, DentProfile, FlatDefect, MeasuredDefect, Preload, Ring, Slip,
};
use super::range::{
    self, ABOVE_ZERO, ACUTE, DEGREES, RATIO, ZERO_OR_MORE, above, below, count, kept, known_isotropic, not_beside,
    not_empty, repeated,
};
use super::rule::{BrokenRule, Rule, short};
use crate::bearing::Race;
use crate::bearing::spatial::Thrust;
use crate::system::{BallsInertia, Formulation};

pub(super) fn bearing(case: &Case, bearing: &Bearing, ring: Option<&Ring>) -> Result<(), BrokenRule> {
    count("bearing.balls", bearing.balls, 3..=40, "3 to 40 balls")?;
    ball(case, bearing)?;
    races(case, bearing, ring)?;
    room(bearing)?;
    DEGREES.check("bearing.first_ball_deg", bearing.first_ball_deg)?;
    ZERO_OR_MORE.check("bearing.contact_damping", bearing.contact_damping)?;
    range::CONTACT_DAMPING.check("bearing.contact_damping", bearing.contact_damping)?;
    if bearing.balls_inertia == Some(BallsInertia::QuasiStatic) {
        let other = "bearing.balls_inertia = \"quasi-static\"";
        not_beside("bearing.contact_damping", other, bearing.contact_damping > 0.0)?;
        not_beside("bearing.formulation", other, bearing.formulation == Formulation::Printed)?;
    }
    if let ContactStiffness::Given { inner, outer } = bearing.stiffness {
        for (key, stiffness) in [("bearing.stiffness.inner", inner), ("bearing.stiffness.outer", outer)] {
            ABOVE_ZERO.check(key, stiffness)?;
            range::STIFFNESS.check(key, stiffness)?;
        }
    }
    irregular(bearing)?;
    slip(&bearing.slip)?;
    defects(bearing)
}

/// Waves of the races and differences of the balls.
fn irregular(bearing: &Bearing) -> Result<(), BrokenRule> {
    for (index, wave) in bearing.waviness.iter().enumerate() {
        let at = |key: &str| format!("bearing.waviness[{index}].{key}");
        count(at("order"), wave.order as usize, 1.., "at least 1")?;
        DEGREES.check(at("phase_deg"), wave.phase_deg)?;
        ZERO_OR_MORE.check(at("amplitude"), wave.amplitude)?;
        below(at("amplitude"), wave.amplitude, "a tenth of the ball's radius", 0.1 * bearing.ball_radius)?;
    }
    let differences = &bearing.ball_radius_differences;
    let key = "bearing.ball_radius_differences";
    if !differences.is_empty() {
        count(key, differences.len(), bearing.balls..=bearing.balls, "as many numbers as there are balls")?;
    }
    let limit = 0.01 * bearing.ball_radius;
    for (index, &difference) in differences.iter().enumerate() {
        let key = format!("{key}[{index}]");
        above(key.as_str(), difference, "minus a hundredth of the ball's radius", -limit)?;
        below(key, difference, "a hundredth of the ball's radius", limit)?;
    }
    Ok(())
}

fn slip(slip: &Slip) -> Result<(), BrokenRule> {
    let (name, points) = match slip {
        Slip::Constant(slip) => return RATIO.check("bearing.slip", *slip),
        Slip::OverTime(points) => ("time", points),
        Slip::OverSpeed(points) => ("hz", points),
        Slip::OverRpm(points) => ("rpm", points),
    };
    let key = "bearing.slip.profile";
    not_empty(key, points.len(), "at least one point")?;
    for (index, &(place, slip)) in points.iter().enumerate() {
        if name != "time" {
            ZERO_OR_MORE.check(format!("{key}[{index}].{name}"), place)?;
        }
        RATIO.check(format!("{key}[{index}].slip"), slip)?;
    }
    for (index, pair) in points.windows(2).enumerate() {
        let key = format!("{key}[{}].{name}", index + 1);
        above(key, pair[1].0, "the one before it", pair[0].0)?;
    }
    Ok(())
}

fn ball(case: &Case, bearing: &Bearing) -> Result<(), BrokenRule> {
    ABOVE_ZERO.check("bearing.ball_radius", bearing.ball_radius)?;
    ABOVE_ZERO.check("bearing.ball_mass", bearing.ball_mass)?;
    range::MASS.check("bearing.ball_mass", bearing.ball_mass)?;
    ABOVE_ZERO.check("bearing.density", bearing.density)?;
    not_beside("bearing.ball_mass", "bearing.density", bearing.ball_mass.is_some() && bearing.density.is_some())?;
    known_isotropic(case, "bearing.ball_material", &bearing.ball_material)?;
    Ok(())
}

fn races(case: &Case, bearing: &Bearing, ring: Option<&Ring>) -> Result<(), BrokenRule> {
    let races = &bearing.race_material;
    known_isotropic(case, "bearing.race_material", &races.inner)?;
    known_isotropic(case, "bearing.race_material", &races.outer)?;
    let (inner, ball) = (bearing.inner_race_radius, bearing.ball_radius);
    ABOVE_ZERO.check("bearing.inner_race_radius", inner)?;
    above("bearing.outer_race_radius", bearing.outer_race_radius, "`bearing.inner_race_radius`", inner)?;
    ring.map_or(Ok(()), |ring| race_in_ring(bearing, ring))?;
    for (key, groove) in [
        ("bearing.inner_groove_radius", bearing.inner_groove_radius),
        ("bearing.outer_groove_radius", bearing.outer_groove_radius),
    ] {
        above(key, groove, "`bearing.ball_radius`", ball)?;
    }
    Ok(())
}

/// The outer race lies in the bore; where the case does not say how large that is, within the outer face of the ring, which is
/// that of a rectangle in the place of the outermost section, of radial side `sqrt(12 I / A)`.
fn race_in_ring(bearing: &Bearing, ring: &Ring) -> Result<(), BrokenRule> {
    let face = || {
        let sections = ring.sections.iter();
        sections.map(|section| section.radius + 0.5 * (12.0 * section.inertia / section.area).sqrt()).reduce(f64::max)
    };
    let (what, limit) = match (ring.outer_radius, face()) {
        (Some(bore), _) => ("`ring.outer_radius`, the bore that the ring sits in", bore),
        (None, Some(face)) => {
            ("the outer face of the outermost of `ring.sections`, by its radius, area and inertia", face)
        }
        (None, None) => return Ok(()),
    };
    let race = bearing.outer_race_radius;
    kept(race < limit, "bearing.outer_race_radius", || {
        Rule::beyond(race, &format!("below {what}"), limit)
            .with_help("the raceway lies inside the ring, and the ring inside the bore: check that these are radii in m, not diameters, and of the same bearing")
    })
}

/// The balls fit between the races and side by side.
fn room(bearing: &Bearing) -> Result<(), BrokenRule> {
    let limit = 0.1 * bearing.ball_radius;
    let play = bearing.play_from_radii();
    // a given play replaces this one, and the balls have to fit all the same
    kept(play.abs() <= limit, "bearing.outer_race_radius", || {
        let (play, limit) = (short(play), short(limit));
        Rule::new(format!(
            "the radii leave a radial play of {play} m, expected at most a tenth of the ball's radius ({limit} m) either way"
        ))
        .with_help("check that all radii are in m and none is a diameter: `bearing.outer_race_radius` less `bearing.inner_race_radius` leaves room for a ball")
    })?;
    if let Some(found) = bearing.radial_play {
        kept(found.abs() <= limit, "bearing.radial_play", || {
            Rule::beyond(found, "at most a tenth of the ball's radius either way", limit)
        })?;
    }
    if let Some(angle) = bearing.contact_angle_deg {
        ACUTE.check("bearing.contact_angle_deg", angle)?;
        not_beside("bearing.contact_angle_deg", "bearing.radial_play", bearing.radial_play.is_some())?;
        let play = bearing.play();
        kept(play <= limit, "bearing.contact_angle_deg", || {
            let (play, limit) = (short(play), short(limit));
            Rule::new(format!(
                "the angle asks for a radial play of {play} m between these grooves, expected at most a tenth of the ball's radius ({limit} m)"
            ))
        })?;
    }
    let one_way = bearing.thrust_or_default() != Thrust::Both;
    kept(!one_way || bearing.play() > 0.0, "bearing.thrust", || {
        let found = format!("a one-way thrust with a radial play of {} m", short(bearing.play()));
        Rule::found(found, "play above 0, which gives a free contact angle")
            .with_help("set `bearing.contact_angle_deg`, or a positive `bearing.radial_play`")
    })?;
    match bearing.preload {
        Some(Preload::Force(force)) => {
            ABOVE_ZERO.check("bearing.preload.force", force)?;
            range::LOAD.check("bearing.preload.force", force)?;
        }
        Some(Preload::Displacement(displacement)) => {
            ABOVE_ZERO.check("bearing.preload.displacement", displacement)?;
            below("bearing.preload.displacement", displacement, "`bearing.ball_radius`", bearing.ball_radius)?;
        }
        None => {}
    }
    let pitch = 0.5 * (bearing.inner_race_radius + bearing.outer_race_radius);
    // A ball of the pitch radius or more leaves no angle: then none fits beside it.
    let half_angle = (bearing.ball_radius / pitch).min(1.0).asin();
    // A small positive number.
    let most = (PI / half_angle).floor() as usize;
    kept(bearing.balls <= most, "bearing.balls", || {
        Rule::found(bearing.balls, &format!("at most {most}: balls of this radius would overlap"))
    })
}

fn defects(bearing: &Bearing) -> Result<(), BrokenRule> {
    let mut with_flat = Vec::new();
    for (index, defect) in bearing.defects.iter().enumerate() {
        let at = |key: &str| format!("bearing.defects[{index}].{key}");
        let (Defect::Dent(DentDefect { angle_deg, .. })
        | Defect::Measured(MeasuredDefect { angle_deg, .. })
        | Defect::Flat(FlatDefect { angle_deg, .. })) = defect;
        DEGREES.check(at("angle_deg"), *angle_deg)?;
        match defect {
            Defect::Dent(dent) => dent_rules(bearing, dent, at)?,
            // what is in the file is checked when it is read
            Defect::Measured(_) => {}
            Defect::Flat(flat) => {
                flat_rules(bearing, flat, at)?;
                let first = !with_flat.contains(&flat.ball);
                kept(first, at("ball"), || repeated(&format!("ball {}", flat.ball)))?;
                with_flat.push(flat.ball);
            }
        }
    }
    Ok(())
}

fn dent_rules(bearing: &Bearing, dent: &DentDefect, at: impl Fn(&str) -> String) -> Result<(), BrokenRule> {
    ABOVE_ZERO.check(at("length"), dent.length)?;
    ABOVE_ZERO.check(at("depth"), dent.depth)?;
    ABOVE_ZERO.check(at("rim_radius"), dent.rim_radius)?;
    ABOVE_ZERO.check(at("width"), dent.width)?;
    if let (Some(width), DentProfile::Surface) = (dent.width, dent.profile) {
        // every groove is wider than the ball
        below(at("width"), width, "twice `bearing.ball_radius`", 2.0 * bearing.ball_radius)?;
    }
    let radius = match dent.on {
        Race::Inner => bearing.inner_race_radius,
        Race::Outer => bearing.outer_race_radius,
    };
    below(at("length"), dent.length, "the race's circumference", 2.0 * PI * radius)?;
    // a run ends where a ball is farther from its place
    below(at("depth"), dent.depth, "half `bearing.ball_radius`", 0.5 * bearing.ball_radius)?;
    below(at("rim_radius"), dent.rim_radius, "half the defect's length", 0.5 * dent.length)
}

fn flat_rules(bearing: &Bearing, flat: &FlatDefect, at: impl Fn(&str) -> String) -> Result<(), BrokenRule> {
    count(at("ball"), flat.ball, ..bearing.balls, "the number of a ball, counted from 0")?;
    let ball = bearing.ball_radius;
    above(at("flat_radius"), flat.flat_radius, "`bearing.ball_radius`", ball)?;
    ABOVE_ZERO.check(at("depth"), flat.depth)?;
    below(at("depth"), flat.depth, "`bearing.ball_radius`", ball)?;
    ABOVE_ZERO.check(at("rim_radius"), flat.rim_radius)
}
