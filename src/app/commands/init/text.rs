//! The case file's text, and the findings in sentences.

use super::found::Found;
use super::groups::{BY_FILE, BY_NAME, BY_SHAPE};
use super::page::{ORIGIN, list, number, numbers, page, quoted};
use super::pit::Pit;
use super::run_text::Window;
use super::scene::{BALANCE, BearingNumbers, Directions, PRELOAD, SPEED_HZ, UnitFrom};
use super::seat::{FoundCylinder, Seat};
use super::shaft::{SHAFT_LENGTHS, ShaftNumbers};
use crate::app::scene::size_doubt;
use crate::fe::mesh::DeckMaterial;
use crate::numerics::units::LengthUnit;
use crate::report::{mass_in_words, size_in_words};
use minijinja::syntax::SyntaxConfig;
use minijinja::value::Serde;
use minijinja::{Environment, UndefinedBehavior, Value, context};

/// Distance of nodes from a cylinder, over its radius, that is not worth a number.
const ROUND_OFF: f64 = 1e-9;

fn unit_origin(found: &Found<'_>) -> String {
    let [x, y, z] = found.extent.map(|side| number(side, 3));
    let size = format!("the mesh is {x} x {y} x {z} units wide");
    match found.unit_from {
        UnitFrom::Given => format!("given; {size}"),
        UnitFrom::Bearing => format!("the unit in which the bearing fits the bore; {size}"),
        UnitFrom::Materials => format!("that of the file's materials; {size}"),
        UnitFrom::Extent => format!("guess: {size}; the file does not say its unit"),
    }
}

/// How large and heavy the housing is by what the file says.
fn size_sentence(found: &Found<'_>) -> String {
    let size = size_in_words(found.extent.map(|side| side * found.unit.to_metres()));
    let thick = if found.plane { " and the thickness guessed" } else { "" };
    format!(
        "By this unit the housing is {size} large, and by the materials{thick} its mass is {}.",
        mass_in_words(found.mass, 3)
    )
}

/// "a cylinder of radius 6 mm about z, all round, its nodes within ..."
fn describe(cylinder: &FoundCylinder, plane: bool) -> String {
    let what = if plane { "circle" } else { "cylinder" };
    let axis = Directions::of(cylinder.axis, None).axis;
    let along = ["x", "y", "z"].into_iter().zip(axis).find(|(_, part)| part.abs() > 1.0 - 1e-12);
    let about = match along {
        Some((name, _)) => name.to_owned(),
        None => format!("({})", cylinder.axis.map(|part| number(part, 4)).join(", ")),
    };
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
    format!("a {what} of radius {} mm about {about}, {turn}, {off}", number(1e3 * cylinder.radius_m, 6))
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
    let bore = |bore: &FoundCylinder| format!("Group {} is {}.", quoted(&bore.group), describe(bore, found.plane));
    let mut sentence = match &found.seat.bore {
        Some(first) => bore(first),
        None => format!(
            "No group is a {} hole within 1 % of its radius: no bore is known.{}",
            if found.plane { "round" } else { "cylindrical" },
            match (found.partly.is_empty() && found.surfaces == 0, found.plane) {
                (false, _) => "",
                (true, true) => " If there is one, name it in gmsh: Physical Curve(\"bore\").",
                (true, false) => " If there is one, name it in gmsh: Physical Surface(\"bore\").",
            }
        ),
    };
    for further in found.further.iter().filter_map(|seat| seat.bore.as_ref()) {
        sentence.push_str(&format!(" On the same axis: {}", bore(further)));
    }
    if found.seat.bore.is_none() && found.surfaces > 0 {
        let what = if found.plane { "curves" } else { "surfaces" };
        sentence.push_str(&format!(
            " None of the CAD {what} ({}) is one all round either. A case may name some together, group = \"{what} 12, 13\"; plummer inspect lists them.",
            found.surfaces
        ));
    }
    for (hole, share, shoulder) in &found.partly {
        sentence.push_str(&format!(
            " {} % of the {} of group {} is {}; the rest {}: name the round part alone in gmsh, Physical {}(\"bore\").",
            number(100.0 * share, 2),
            if found.plane { "length" } else { "area" },
            quoted(&hole.group),
            describe(hole, found.plane),
            if *shoulder { "is flat and lies across its axis, as a shoulder does" } else { "lies beside it" },
            if found.plane { "Curve" } else { "Surface" }
        ));
    }
    if !found.holes.is_empty() {
        sentence.push_str(&format!(" Other round holes: {}.", names(&found.holes)));
    } else if found.seat.bore.is_some() {
        sentence.push_str(" No other group is a round hole.");
    }
    if !found.outside.is_empty() {
        sentence.push_str(&format!(" Round outsides: {}.", names(&found.outside)));
    }
    sentence
}

pub(crate) fn findings(found: &Found<'_>) -> Vec<String> {
    let mut lines =
        vec![format!("length_unit = \"{}\": {}", found.unit.symbol(), unit_origin(found)), size_sentence(found)];
    let sides = found.extent.map(|side| side * found.unit.to_metres());
    lines.extend(size_doubt(sides, found.unit, "--length-unit").map(|told| format!("warning: {told}")));
    lines.push(bore_sentence(found));
    lines.extend(found.seats().map(|seat| match (&seat.bearing, &seat.bore) {
        (Some(numbers), Some(bore)) if !found.further.is_empty() => {
            format!("In {}: bearing {}.", quoted(&bore.group), bearing_origin(found, seat, numbers))
        }
        (Some(numbers), _) => format!("Bearing {}.", bearing_origin(found, seat, numbers)),
        (None, Some(bore)) => {
            let (of, table) = match found.further.is_empty() {
                true => ("the bore".to_owned(), "[bearing]"),
                false => (quoted(&bore.group), "its [bearings.bearing]"),
            };
            format!(
                "No bearing of the catalogue has an outer diameter within 1 % of {of}'s, {} mm: {table} is a template.",
                number(2e3 * bore.radius_m, 6)
            )
        }
        (None, None) => "[ring] and [bearing] are templates.".to_owned(),
    }));
    let parts = found.groups.parts.iter().map(|part| {
        let sure = match part.from {
            "mesh" => "by the file",
            "guess" => "a guess",
            by_name => by_name,
        };
        format!("{} of {} ({sure})", quoted(&part.group), part.material)
    });
    lines.push(format!("Parts: {}.", list(&parts.collect::<Vec<_>>())));
    lines.extend(materials(found));
    let all = |names: &[String]| list(&names.iter().map(|name| quoted(name)).collect::<Vec<_>>());
    let held: Vec<String> = found.groups.supports.iter().map(|support| support.group.clone()).collect();
    let (supports, at_bore) = (&held[..], &found.groups.at_bore[..]);
    lines.push(match (supports, at_bore) {
        ([], []) if found.groups.held_by == BY_NAME => "Nothing is held: no group is named like a support.".to_owned(),
        ([], []) => "Nothing is held: *BOUNDARY of the file names groups, and no line of it is a support.".to_owned(),
        ([], _) => "Nothing is held.".to_owned(),
        _ => match found.groups.held_by {
            BY_SHAPE => {
                format!(
                    "Held, a guess: {}, the largest flat outside that shares no nodes with the bore.",
                    all(supports)
                )
            }
            BY_FILE => format!("Held, as *BOUNDARY of the file says: {}.", all(supports)),
            _ => format!("Held, by their names: {}.", all(supports)),
        },
    });
    if !at_bore.is_empty() {
        lines.push(format!(
            "Not held: {} shares nodes with the bore, and the ring moves those nodes. In gmsh, draw its faces apart from the bore, or hold it by springs.",
            all(at_bore)
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

/// The materials that the file gives, and those that it does not give in full.
fn materials(found: &Found<'_>) -> Vec<String> {
    let mut lines = Vec::new();
    if let Some(units) = found.groups.units {
        let [length, unit] = [units.length, found.unit].map(LengthUnit::symbol);
        let known = found.groups.materials.iter().map(|own| {
            let [young, density] = [1e-9 * own.young[1], own.density[1]].map(|value| number(value, 4));
            format!("{} of {young} GPa and {density} kg/m^3", own.name)
        });
        let known = list(&known.collect::<Vec<_>>());
        lines.push(format!("Materials of the file: {known}; by their numbers its units are {}.", units.name));
        if length != unit {
            lines.push(format!(
                "warning: the file's materials are in {}, a length in {length}, and length_unit is \"{unit}\"",
                units.name
            ));
        }
    }
    for own in found.deck_materials.iter().filter(|own| !own.groups.is_empty()) {
        let name = quoted(&own.name);
        lines.push(match (lacks(own), found.groups.units) {
            (Some(lacks), _) => format!("The material {name} of the file is not taken: {lacks}."),
            (None, None) => {
                format!("The material {name} of the file is not taken: its numbers are in no usual system of units.")
            }
            _ if own.first_line => {
                format!("The material {name} of the file has several lines over temperature: the first is taken.")
            }
            _ => continue,
        });
    }
    lines
}

/// Why a material of the file is none of a case.
pub(super) fn lacks(own: &DeckMaterial) -> Option<String> {
    match (own.elastic, own.density) {
        (None, _) => Some(match &own.other_law {
            Some(law) if law.starts_with("*ELASTIC") => format!(
                "it has {law}. Write [materials.{}] by hand: young of x, y, z; poisson and shear of xy, yz, xz; x_axis and y_axis of its *ORIENTATION",
                quoted(&own.name)
            ),
            Some(law) => format!(
                "it has {law}, and a case has linear materials. Write young and poisson of small strains by hand"
            ),
            None => "it has no isotropic *ELASTIC".to_owned(),
        }),
        (_, None) => Some("it has no *DENSITY".to_owned()),
        (Some([young, _]), _) if young <= 0.0 => {
            Some(format!("its modulus is {}, expected more than 0", number(young, 4)))
        }
        (Some([_, poisson]), _) if !(poisson > -1.0 && poisson < 0.5) => {
            Some(format!("its Poisson's ratio is {}, expected more than -1 and less than 0.5", number(poisson, 17)))
        }
        (_, Some(density)) if density <= 0.0 => {
            Some(format!("its density is {}, expected more than 0", number(density, 4)))
        }
        _ => None,
    }
}

/// The groups that the file does not use, with what they may be.
fn others(found: &Found<'_>) -> Vec<String> {
    let others = found.groups.others.iter().map(|other| {
        let kind = ["point", "curve", "surface", "volume"][other.dimension.min(3)];
        let mut round = found.holes.iter().chain(&found.outside);
        let round = round.find(|cylinder| cylinder.group == other.group);
        let round = round.map(|cylinder| describe(cylinder, found.plane));
        let flat = found.flat.contains(&other.group).then(|| "flat, with the body behind it".to_owned());
        let notes = round.into_iter().chain(flat).chain(other.note.map(str::to_owned));
        // the name of an entity says its kind
        let entity = other.group.starts_with(&format!("{kind} ")) || other.group.starts_with(&format!("{kind}s "));
        let kind = if entity { String::new() } else { format!("{kind} ") };
        let words = std::iter::once(format!("{kind}{}", quoted(&other.group))).chain(notes);
        words.collect::<Vec<_>>().join(": ")
    });
    others.collect()
}

fn bearing_origin(found: &Found<'_>, seat: &Seat, numbers: &BearingNumbers) -> String {
    let bearing = numbers.bearing;
    let mut words = format!(
        "{} ({} x {} x {} mm), {}",
        bearing.name,
        number(1e3 * bearing.bore, 6),
        number(1e3 * bearing.outer_diameter, 6),
        number(1e3 * bearing.width, 6),
        bearing.source.citation()
    );
    if found.request.bearing.is_none_or(|asked| asked.name != bearing.name) {
        words.push_str("; guess: its outer diameter is that of the bore within 1 %");
        let others = seat.same_size.iter().filter(|name| **name != bearing.name);
        let others: Vec<String> = others.map(|name| (*name).to_owned()).collect();
        if !others.is_empty() {
            words.push_str(&format!(", as is that of {}", list(&others)));
        }
    }
    words
}

/// What the template says of one seat.
fn seat_values(found: &Found<'_>, seat: &Seat) -> Value {
    let numbers = seat.numbers();
    let bearing = numbers.bearing;
    // face to face, as the shims of a motor push the outer rings towards each other; others than the outermost hold no thrust
    let places = || found.seats().map(|seat| seat.place);
    let [low, high] = [places().fold(0.0, f64::min), places().fold(0.0, f64::max)];
    let thrust = if seat.place <= low {
        "negative"
    } else if seat.place >= high {
        "positive"
    } else {
        "both"
    };
    context! {
        found => Serde(seat),
        numbers => Serde(numbers),
        citation => bearing.source.citation(),
        races => Serde([bearing.inner_race_diameter(), bearing.outer_race_diameter()]),
        origin => bearing_origin(found, seat, &numbers),
        scale => seat.scale(),
        thrust,
        preload => PRELOAD * found.seats().map(Seat::shaft_bore).fold(f64::INFINITY, f64::min),
        pit => Serde(Pit::of(&numbers, seat.scale())),
    }
}

/// The case file: the template with what was found in it.
///
/// # Errors
/// Nothing that depends on the mesh: a template that does not fit its values.
pub(crate) fn case_text(found: &Found<'_>) -> Result<String, minijinja::Error> {
    // a group one dimension below the housing that may be held
    let below = if found.plane { 1 } else { 2 };
    let surface = found.groups.others.iter().find(|other| other.dimension == below && other.note.is_none());
    let values = context! {
        found => Serde(found),
        seats => found.seats().map(|seat| seat_values(found, seat)).collect::<Vec<_>>(),
        several => !found.further.is_empty(),
        unit_origin => unit_origin(found),
        bore_sentence => bore_sentence(found),
        others => others(found),
        surface => surface.map_or("GROUP", |other| &other.group),
        // a billionth of a length is round-off of the fit
        round_off => 1e-9,
        spot_round_off => 1e-9 * found.unit.to_metres() * found.extent.into_iter().fold(0.0, f64::max),
        shaft => Serde(ShaftNumbers::of(found)),
        lengths => SHAFT_LENGTHS,
        balance => BALANCE,
        preload_rate => PRELOAD,
        speed_hz => SPEED_HZ,
        window => Serde(Window::of(found)),
    };
    let mut environment = Environment::new();
    environment.add_filter("quoted", |text: String| quoted(&text));
    environment.add_filter("number", number);
    environment.add_filter("numbers", |list: Vec<f64>, digits: usize, floor: f64| numbers(&list, digits, floor));
    environment.set_undefined_behavior(UndefinedBehavior::Strict);
    environment.set_syntax(SyntaxConfig::builder().trim_blocks(true).build()?);
    // no text of the mesh has the mark
    let template = include_str!("case.toml.jinja").replace(" ## ", ORIGIN);
    Ok(page(&environment.render_str(&template, values)?))
}
