//! The case file's text, and the findings in sentences.

use super::found::{Found, FoundCylinder};
use super::page::{COMPUTED_DIGITS, Page, list, number, numbers, quoted};
use super::scene::UnitFrom;
use super::scene::{BALANCE, BearingNumbers, SHAFT_LENGTHS, SPEED_HZ, shaft};

/// Significant digits of what is measured in the mesh: far more than a drawing has.
const MEASURED_DIGITS: usize = 9;

/// Distance of nodes from a cylinder, over its radius, that is not worth a number.
const ROUND_OFF: f64 = 1e-9;

fn unit_origin(found: &Found<'_>) -> String {
    let sides = found.extent.map(|side| number(side, 3));
    let [x, y, z] = &sides;
    let size = format!("the mesh is {x} x {y} x {z} units wide");
    match found.unit_from {
        UnitFrom::Given => format!("given; {size}"),
        UnitFrom::Bearing => format!("the unit in which the bearing fits the bore; {size}"),
        UnitFrom::Extent => format!("guess: {size}; the file does not say its unit"),
    }
}

/// "a cylinder of radius 6 mm about z, all round, its nodes within ..."
fn describe(cylinder: &FoundCylinder, plane: bool) -> String {
    let what = if plane { "circle" } else { "cylinder" };
    let millimetre = |metres: f64| number(1e3 * metres, 6);
    let [x, y, z] = cylinder.axis;
    let axis = super::scene::Directions::of(cylinder.axis).axis;
    let about = ["x", "y", "z"]
        .into_iter()
        .zip(axis)
        .find(|(_, part)| part.abs() > 1.0 - 1e-12)
        .map_or_else(|| format!("({}, {}, {})", number(x, 4), number(y, 4), number(z, 4)), |(name, _)| name.to_owned());
    let turn = if cylinder.turn > 0.999 {
        "all round".to_owned()
    } else {
        format!("over {} % of the turn", number(100.0 * cylinder.turn, 3))
    };
    let off = if cylinder.farthest_m < ROUND_OFF * cylinder.radius_m {
        "its nodes on it but for round-off".to_owned()
    } else {
        format!("its nodes within {} m of it (rms {} m)", number(cylinder.farthest_m, 2), number(cylinder.rms_m, 2))
    };
    format!("a {what} of radius {} mm about {about}, {turn}, {off}", millimetre(cylinder.radius_m))
}

fn names(cylinders: &[FoundCylinder]) -> String {
    let names = cylinders.iter().map(|cylinder| {
        let radius = number(1e3 * cylinder.radius_m, 4);
        format!("{} (radius {radius} mm)", quoted(&cylinder.group))
    });
    list(&names.collect::<Vec<_>>())
}

/// Why the bore is the bore, or why there is none.
fn bore_sentence(found: &Found<'_>) -> String {
    let mut sentence = match &found.bore {
        Some(bore) => format!("Group {} is {}.", quoted(&bore.group), describe(bore, found.plane)),
        None => format!(
            "No group is a {} hole within 1 % of its radius: no bore is known. If there is one, name it in gmsh: \
             Physical {}(\"bore\").",
            if found.plane { "round" } else { "cylindrical" },
            if found.plane { "Curve" } else { "Surface" }
        ),
    };
    if !found.holes.is_empty() {
        sentence.push_str(&format!(" Other round holes: {}.", names(&found.holes)));
    } else if found.bore.is_some() {
        sentence.push_str(" No other group is a round hole.");
    }
    if !found.outside.is_empty() {
        sentence.push_str(&format!(" Round outsides: {}.", names(&found.outside)));
    }
    sentence
}

pub(crate) fn findings(found: &Found<'_>) -> Vec<String> {
    let mut lines =
        vec![format!("length_unit = \"{}\": {}", found.unit.symbol(), unit_origin(found)), bore_sentence(found)];
    lines.push(match (&found.bearing, &found.bore) {
        (Some(numbers), _) => format!("Bearing {}.", bearing_origin(found, numbers)),
        (None, Some(bore)) => format!(
            "No bearing of the catalogue has an outer diameter within 1 % of the bore's, {} mm: [bearing] is a template.",
            number(2e3 * bore.radius_m, 6)
        ),
        (None, None) => "[ring] and [bearing] are templates.".to_owned(),
    });
    let parts = found.groups.parts.iter().map(|part| {
        let sure = if part.by_name { "by its name" } else { "a guess" };
        format!("{} of {} ({sure})", quoted(&part.group), part.material)
    });
    lines.push(format!("Parts: {}.", list(&parts.collect::<Vec<_>>())));
    let supports: Vec<String> = found.groups.supports.iter().map(|name| quoted(name)).collect();
    let at_bore: Vec<String> = found.groups.at_bore.iter().map(|name| quoted(name)).collect();
    lines.push(match (supports.is_empty(), at_bore.is_empty()) {
        (false, _) => format!("Held, by their names: {}.", list(&supports)),
        (true, true) => "Nothing is held: no group is named like a support.".to_owned(),
        (true, false) => "Nothing is held.".to_owned(),
    });
    if !at_bore.is_empty() {
        lines.push(format!(
            "Not held: {} shares nodes with the bore, and these follow the ring. Give it faces beside the bore in gmsh, or hold it by springs.",
            list(&at_bore)
        ));
    }
    if found.groups.without_part > 0 {
        lines.push(format!(
            "{} elements are in no part: every command will ask for their group.",
            found.groups.without_part
        ));
    }
    if found.bodies > 1 {
        lines.push(format!("The mesh has {} bodies that share no nodes: join them under housing.links.", found.bodies));
    }
    lines
}

pub(crate) fn head(page: &mut Page, found: &Found<'_>) {
    page.line("#:schema plummer.schema.json");
    page.note(&format!(
        "Written by `plummer init` from {}. Behind each value: where it comes from.",
        quoted(found.request.mesh_in_case)
    ));
    page.note("mesh: measured there; catalogue: published; usual: with its source; guess: for you to check.");
    page.note("A line that begins with # and no blank is a value to be switched on.");
    page.line("#");
    page.note("`plummer schema > plummer.schema.json`: editors then complete and check this file.");
    page.line("");
    page.value("title", quoted(found.request.title));
}

pub(crate) fn housing(page: &mut Page, found: &Found<'_>) {
    page.table("[housing]");
    page.value_from("mesh", quoted(found.request.mesh_in_case), "relative to this file");
    page.value_from("length_unit", quoted(found.unit.symbol()), &unit_origin(found));
    if found.plane {
        let thickness = found.ring.section_width();
        page.value_from(
            "plane",
            format!("{{ assumption = \"stress\", thickness = {} }}", number(thickness, COMPUTED_DIGITS)),
            "guess: as thick as the bearing is wide, m",
        );
    }
    page.note("materials without a table of their own: steel, bearing steel, aluminium");
    page.line("parts = [");
    for part in &found.groups.parts {
        let origin = if part.by_name { "by its name" } else { "guess" };
        let item = format!("  {{ group = {}, material = \"{}\" }},", quoted(&part.group), part.material);
        page.line(&format!("{item:<58} # material: {origin}"));
    }
    page.line("]");
    if found.groups.without_part > 0 {
        page.note(&format!(
            "{} elements are in none of these groups, and every command will say so: give them one in gmsh",
            found.groups.without_part
        ));
    }
    supports(page, found);
    if found.bodies > 1 {
        page.note(&format!("{} bodies share no nodes; surfaces that touch move as one with", found.bodies));
        page.line("#links = [{ between = [\"GROUP A\", \"GROUP B\"], tie = true }]");
    }
    others(page, found);
}

fn supports(page: &mut Page, found: &Found<'_>) {
    let axes = if found.plane { "\"x\", \"y\"" } else { "\"x\", \"y\", \"z\"" };
    let named = &found.groups.supports;
    if let ([], Some(group)) = (named.as_slice(), found.groups.at_bore.first()) {
        page.note("the housing is free; nodes of the bore follow the ring and cannot be fixed too, but springs may hold them (N/m, a guess):");
        let along = if found.plane { "x = 1e8, y = 1e8" } else { "x = 1e8, y = 1e8, z = 1e8" };
        let item = format!("supports = [{{ group = {}, spring = {{ {along} }}, per = \"group\" }}]", quoted(group));
        page.template(true, |page| page.line(&item));
        return;
    }
    if named.is_empty() {
        page.note("no group is named like a support, so that the housing is free; to hold one:");
        let group = quoted(found.surface().unwrap_or("GROUP"));
        let item = format!("supports = [{{ group = {group}, fixed = [{axes}] }}]");
        page.template(true, |page| page.line(&item));
        return;
    }
    page.line("supports = [");
    for group in named {
        let item = format!("  {{ group = {}, fixed = [{axes}] }},", quoted(group));
        page.line(&format!("{item:<58} # guess, by its name"));
    }
    page.line("]");
}

fn others(page: &mut Page, found: &Found<'_>) {
    if found.groups.others.is_empty() {
        return;
    }
    page.note("groups of the mesh that this file does not use:");
    for other in &found.groups.others {
        let kind = ["point", "curve", "surface", "volume"][other.dimension.min(3)];
        let round = found.holes.iter().chain(&found.outside);
        let round = round.clone().find(|cylinder| cylinder.group == other.group);
        let mut words = format!("  {kind} {}", quoted(&other.group));
        if let Some(cylinder) = round {
            words.push_str(&format!(": {}", describe(cylinder, found.plane)));
        }
        if let Some(note) = other.note {
            words.push_str(&format!(": {note}"));
        }
        page.note(&words);
    }
}

pub(crate) fn ring(page: &mut Page, found: &Found<'_>) {
    let template = found.bore.is_none();
    page.line("");
    page.note("the bearing's outer ring in the bore");
    page.note(&bore_sentence(found));
    let section = found.ring.section;
    let diameter = 2.0 * found.bore.as_ref().map_or(0.5 * found.ring.of.outer_diameter, |bore| bore.radius_m);
    page.template(template, |page| {
        page.line("[ring]");
        page.value_from("nodes", "72", "usual: an element every 5 degrees");
        page.note(&section_origin(found));
        let mut keys = vec![
            "material = \"bearing steel\"".to_owned(),
            format!("area = {}", number(section.area, COMPUTED_DIGITS)),
            format!("inertia = {}", number(section.inertia, COMPUTED_DIGITS)),
        ];
        if !found.plane {
            keys.push(format!("axial_inertia = {}", number(section.axial_inertia, COMPUTED_DIGITS)));
        }
        keys.push(format!("radius = {}", number(section.radius, COMPUTED_DIGITS + 2)));
        page.line(&format!("sections = [{{ {} }}]", keys.join(", ")));
        page.value_from("outer_radius", number(0.5 * diameter, MEASURED_DIGITS), "mesh: that of the bore, m");
        tie(page, found);
    });
}

fn section_origin(found: &Found<'_>) -> String {
    let ring = &found.ring;
    let shape = if ring.of.shoulder_diameter.is_some() {
        "down to its shoulders, less the groove"
    } else {
        "down to the groove's bottom: its shoulders are not published"
    };
    let scale = number(ring.scale, COMPUTED_DIGITS);
    let scaled = match scale.as_str() {
        "1" => String::new(),
        scale => format!(", scaled by {scale} to the bore"),
    };
    format!("catalogue: the outer ring of {}, {shape}{scaled} (m^2, m^4, m)", ring.of.name)
}

fn tie(page: &mut Page, found: &Found<'_>) {
    let group = found.bore.as_ref().map_or("GROUP", |bore| bore.group.as_str());
    let (centre, radius) = found.bore.as_ref().map_or(([0.0; 3], 1.0), |bore| (bore.centre_m, bore.radius_m));
    page.note(
        "mesh: centre (m) and axis of the cylinder; in the middle of its length; zero_deg: so that the bearing's 90 degrees point up",
    );
    let directions = found.directions;
    page.line(&format!(
        "tie = {{ group = {}, fit = \"bonded\", centre = {}, axis = {}, zero_deg = {} }}",
        quoted(group),
        // a billionth of the radius is round-off of the fit
        numbers(&centre, MEASURED_DIGITS, 1e-9 * radius),
        numbers(&directions.axis, MEASURED_DIGITS, 1e-9),
        numbers(&directions.zero, MEASURED_DIGITS, 1e-9)
    ));
}

fn bearing_origin(found: &Found<'_>, numbers: &BearingNumbers) -> String {
    let bearing = numbers.bearing;
    let mut words = format!(
        "{} ({} x {} x {} mm), {}",
        bearing.name,
        number(1e3 * bearing.bore, 6),
        number(1e3 * bearing.outer_diameter, 6),
        number(1e3 * bearing.width, 6),
        bearing.source.citation()
    );
    if found.request.bearing.is_none() {
        words.push_str("; guess: its outer diameter is that of the bore within 1 %");
        let others = found.same_size.iter().filter(|name| **name != bearing.name);
        let others: Vec<String> = others.map(|name| (*name).to_owned()).collect();
        if !others.is_empty() {
            words.push_str(&format!(", as is that of {}", list(&others)));
        }
    }
    words
}

pub(crate) fn bearing(page: &mut Page, found: &Found<'_>) {
    let own = found.bearing;
    let numbers = own.unwrap_or_else(|| BearingNumbers::of(found.ring.of));
    let bearing = numbers.bearing;
    page.line("");
    match own {
        Some(_) => page.note(&format!("bearing {}", bearing_origin(found, &numbers))),
        None if found.bore.is_none() => page.note(&format!(
            "No bore, no bearing (plummer init --list-bearings). This is {}: {}.",
            bearing.name,
            bearing.source.citation()
        )),
        None => page.note(&format!(
            "No bearing of the catalogue fits (plummer init --list-bearings). This is {}, scaled by {} to the bore, which nobody \
             sells: to be replaced by your own. {}.",
            bearing.name,
            number(found.ring.scale, COMPUTED_DIGITS),
            bearing.source.citation()
        )),
    }
    let scale = if own.is_some() { 1.0 } else { found.ring.scale };
    let metres = |length: f64| number(scale * length, 6);
    page.template(own.is_none(), |page| {
        page.line("[bearing]");
        page.value_from("balls", bearing.balls.to_string(), "catalogue");
        let ball = metres(0.5 * bearing.ball_diameter);
        page.value_from("ball_radius", ball, "catalogue, m; mass by the density of bearing steel");
        let [inner, outer] = [bearing.inner_race_diameter(), bearing.outer_race_diameter()];
        let pitch = if bearing.pitch_published {
            "catalogue: pitch and ball diameter"
        } else {
            "catalogue's ball diameter on the mean of bore and outer diameter (a guess: no pitch diameter is published)"
        };
        page.value_from("inner_race_radius", metres(0.5 * inner), pitch);
        page.value_from("outer_race_radius", metres(0.5 * outer), pitch);
        let groove = "typical: 0.52 and 0.53 of the ball's diameter, the grooves of ISO 281's load ratings";
        page.value_from("inner_groove_radius", metres(numbers.inner_groove), groove);
        page.value_from("outer_groove_radius", metres(numbers.outer_groove), "as said");
        page.value_from(
            "radial_play",
            number(numbers.play, COMPUTED_DIGITS),
            "usual: half the middle of the normal clearance, less in warm or tight fits, m",
        );
        page.value_from("contact_damping", "2.0", "guess, s/m: without it unloaded balls bounce for ever");
    });
    page.note("a dent in the outer race under the load; a guess, to be set free");
    page.template(true, |page| {
        page.line("[[bearing.defects]]");
        page.value("on", "\"outer\"");
        page.value("angle_deg", "270");
        page.value_from("length", number(0.2 * scale * bearing.ball_diameter, 2), "along the race, m");
        page.value_from("depth", number(0.004 * scale * bearing.ball_diameter, 2), "m");
    });
}

pub(crate) fn motion(page: &mut Page, found: &Found<'_>) {
    let bore = found.bearing.map_or(found.ring.of.bore * found.ring.scale, |numbers| numbers.bearing.bore);
    let [mass, unbalance] = shaft(bore);
    page.table("[shaft]");
    page.value_from(
        "mass",
        number(mass, 3),
        &format!(
            "guess, kg: steel, as thick as the bearing's bore ({} mm) and {SHAFT_LENGTHS} times as long",
            number(1e3 * bore, 4)
        ),
    );
    page.value_from(
        "unbalance",
        number(unbalance, 3),
        &format!("usual, kg m: balance quality G {} of ISO 21940-11 at {SPEED_HZ} Hz", number(1e3 * BALANCE, 3)),
    );
    page.value_from("gravity", "[0, -9.81]", "down in the bearing's frame, m/s^2");
    page.note("another load, e.g. a belt's pull in N:");
    page.line("#loads = [{ force = [0, -100] }]");
    page.table("[damping]");
    page.value_from("modal", "0.02", "guess: 2 % of critical in every mode");
    page.table("[speed]");
    page.note("guess: a motor of four poles at 50 Hz mains, without slip; a run-up has several points");
    page.line(&format!("profile = [{{ time = 0, hz = {SPEED_HZ} }}]"));
}

pub(crate) fn sensors(page: &mut Page, found: &Found<'_>) {
    page.table("[[sensors]]");
    page.value("name", "\"P1\"");
    match (&found.groups.sensor, found.spot) {
        (Some(group), _) => page.value_from("group", quoted(group), "guess, by its name"),
        (None, Some(point)) => {
            let floor = 1e-9 * found.unit.to_metres() * found.extent.into_iter().fold(0.0, f64::max);
            page.value_from("point", numbers(&point, 6, floor), "guess: on the outside, above the bearing, m");
        }
        // a mesh has corners: this is for a mesh that lost them
        (None, None) => page.value_from("point", "[0, 0, 0]", "guess, m"),
    }
    page.value_from("direction", numbers(&found.directions.up, MEASURED_DIGITS, 1e-9), "up");
}
