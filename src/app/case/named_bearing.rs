//! A bearing by its name: `bearing = "6204"`, or `[bearing] name = "6204"` with keys of one's own beside. The catalogue gives the keys that are
//! absent, and `ring.sections`, before the case is decoded, so that a case has all of them in every later stage and in its echo.

use serde_json::{Value as Json, json};

use super::check::{Rule, short};
use super::decode::Fault;
use super::error::names_help;
use super::schema::one_of;
use super::tree::{Mark, Node, Step, Value};
use crate::bearing::catalogue::{CatalogueBearing, GROOVES, OuterRingSection, UsualNumbers};

/// Keys of `[bearing]` that the catalogue gives, the play aside.
pub(super) const GIVEN: [&str; 6] =
    ["balls", "ball_radius", "inner_race_radius", "outer_race_radius", "inner_groove_radius", "outer_groove_radius"];

/// A name, or all keys that it stands for.
pub(super) fn named_or_numbers() -> Json {
    let [Json::Array(mut forms), numbers] = [one_of(&["name"]), json!({ "required": GIVEN })] else {
        return json!([]);
    };
    forms.push(numbers);
    forms.into()
}

/// A ring with sections, or a bearing with a name that gives them; a bearing that is no table is a name.
pub(super) fn named_or_sections() -> Json {
    let sections = json!({ "properties": { "ring": { "required": ["sections"] } } });
    let named = json!({ "required": ["bearing"], "properties": { "bearing": { "required": ["name"] } } });
    json!([{ "anyOf": [sections, named] }])
}

/// Writes a name in the place of the table as a table with a name, so that `--set bearing.KEY` finds one.
pub(super) fn as_table(root: &mut Node) {
    let to_table = |_, seat: &mut Node| {
        seat_as_table(seat);
        Ok(())
    };
    // a form is no fault
    let _ = each_seat(root, to_table);
}

/// Hands out the case itself, which has `bearing` and `ring`, and then the items of `bearings`, which have them too.
fn each_seat(
    root: &mut Node,
    mut take: impl FnMut(Option<usize>, &mut Node) -> Result<(), Fault>,
) -> Result<(), Fault> {
    take(None, root)?;
    let Value::Table(keys) = &mut root.value else { return Ok(()) };
    let Some(Value::List(items)) = keys.get_mut("bearings").map(|list| &mut list.value) else { return Ok(()) };
    items.iter_mut().enumerate().try_for_each(|(index, item)| take(Some(index), item))
}

fn seat_as_table(seat: &mut Node) {
    let Value::Table(keys) = &mut seat.value else { return };
    let Some(bearing) = keys.get_mut("bearing") else { return };
    if matches!(bearing.value, Value::Text(_) | Value::Integer(_)) {
        let name = bearing.clone();
        bearing.value = Value::Table([("name".to_owned(), name)].into());
    }
}

/// Adds what the catalogue says of a named bearing and the case does not.
///
/// # Errors
/// A [`Fault`] for a name that the catalogue does not have.
pub(super) fn fill(root: &mut Node) -> Result<(), Fault> {
    each_seat(root, |index, seat| {
        fill_seat(seat).map_err(|fault| match index {
            Some(index) => fault.under(Step::Index(index)).under(Step::Key("bearings".to_owned())),
            None => fault,
        })
    })
}

fn fill_seat(seat: &mut Node) -> Result<(), Fault> {
    seat_as_table(seat);
    let Value::Table(keys) = &mut seat.value else { return Ok(()) };
    let Some(Value::Table(keys)) = keys.get_mut("bearing").map(|bearing| &mut bearing.value) else { return Ok(()) };
    let Some(name) = keys.get_mut("name") else { return Ok(()) };
    if let Value::Integer(number) = name.value {
        name.value = Value::Text(number.to_string());
    }
    let mark = name.mark;
    // another kind of value is for the decoder to refuse
    let Value::Text(name) = &name.value else { return Ok(()) };
    let Some(bearing) = CatalogueBearing::named(name) else {
        let expected = "a bearing of the catalogue, or no name and all its numbers";
        let mut fault = Fault::wrong(format!("\"{name}\""), &expected);
        let numbers = GIVEN.join(", ");
        fault.help = Some(format!(
            "{}; or write its data sheet's numbers into [bearing] instead of a name: {numbers}",
            bearing_help(name)
        ));
        let fault = fault.at(mark).under(Step::Key("name".to_owned()));
        return Err(fault.under(Step::Key("bearing".to_owned())));
    };
    let own_races = ["inner_race_radius", "outer_race_radius"].iter().any(|key| keys.contains_key(*key));
    let ball_radius = match keys.get("ball_radius").map(|given| &given.value) {
        Some(Value::Float(own)) => *own,
        _ => 0.5 * bearing.ball_diameter,
    };
    let by_angle = keys.contains_key("contact_angle_deg");
    let mut add = |key: &str, value: Value| {
        keys.entry(key.to_owned()).or_insert(Node { mark, value });
    };
    add("balls", Value::Integer(i64::from(bearing.balls)));
    for (key, number) in GIVEN[1..].iter().zip(lengths(bearing, ball_radius)) {
        add(key, Value::Float(number));
    }
    // races of one's own have their own play, and a contact angle gives it
    if !own_races && !by_angle {
        add("radial_play", Value::Float(UsualNumbers::of(bearing).play));
    }
    let Value::Table(keys) = &mut seat.value else { return Ok(()) };
    if let Some(Value::Table(ring)) = keys.get_mut("ring").map(|ring| &mut ring.value) {
        let list = || Node { mark, value: Value::List(vec![Node { mark, value: section(bearing, mark) }]) };
        ring.entry("sections".to_owned()).or_insert_with(list);
    }
    Ok(())
}

/// The outer ring of a bearing, as one of `ring.sections`.
fn section(bearing: &CatalogueBearing, mark: Mark) -> Value {
    let OuterRingSection { area, radius, inertia, axial_inertia } = OuterRingSection::of(bearing);
    let numbers = [("area", area), ("radius", radius), ("inertia", inertia), ("axial_inertia", axial_inertia)];
    let numbers = numbers.into_iter().map(|(key, number)| (key, Value::Float(number)));
    let material = ("material", Value::Text("bearing steel".to_owned()));
    Value::Table(numbers.chain([material]).map(|(key, value)| (key.to_owned(), Node { mark, value })).collect())
}

/// What to do about a designation that the catalogue does not have.
pub(in crate::app) fn bearing_help(name: &str) -> String {
    let names: Vec<&str> = CatalogueBearing::all().iter().map(|bearing| bearing.name).collect();
    let help = names_help(name, &names, "bearings");
    // a designation of the same length is another bearing, not a slip of the pen
    let other = [3, 4].contains(&name.len()) && name.bytes().all(|digit| digit.is_ascii_digit());
    let list = help.split_once("? ").map_or(&*help, |(_, list)| list);
    let help = match CatalogueBearing::other_type(name) {
        Some(kind) => format!(
            "\"{name}\" is {kind} by the designations of DIN 623-1, and those of the catalogue are single-row deep groove ball bearings; {list}"
        ),
        None if other => list.to_owned(),
        None => help,
    };
    format!("{help}; plummer init --list-bearings says their dimensions")
}

/// Lengths of [`GIVEN`], without the number of balls, about balls of a radius, m.
pub(super) fn lengths(bearing: &CatalogueBearing, ball_radius: f64) -> [f64; 5] {
    let pitch_radius = 0.5 * bearing.pitch_diameter;
    let [inner, outer] = GROOVES.map(|ratio| 2.0 * ratio * ball_radius);
    [ball_radius, pitch_radius - ball_radius, pitch_radius + ball_radius, inner, outer]
}

/// How far the outer diameter of a bearing may be from that of its bore, relative: the tie takes nodes that are so far off, a fit as tight
/// as R7 of ISO 286 takes 0.1 %, and the next diameter of the catalogue differs by 3 %.
pub(in crate::app) const FIT: f64 = 0.01;

/// Whether a bearing is of another size than a bore (nearest and farthest node from the axis, m), which messages call `bore`; `unit`
/// says the mesh's unit.
pub(in crate::app) fn other_size(
    bearing: &CatalogueBearing,
    bore: &str,
    [near, far]: [f64; 2],
    unit: &str,
) -> Option<Rule> {
    let own = bearing.outer_diameter;
    if (1.0 - FIT) * 2.0 * near <= own && own <= (1.0 + FIT) * 2.0 * far {
        return None;
    }
    let bore_diameter = if near > 0.0 { near + far } else { 2.0 * far };
    // what a mesh rounds is no digit of a diameter
    let millimetres = |length: f64| short((1e7 * length).round() * 1e-4);
    let nearest = CatalogueBearing::nearest(bore_diameter);
    let nearest = nearest.iter().map(|(other, _)| format!("{} ({} mm)", other.name, millimetres(other.outer_diameter)));
    let found = format!("the outer diameter of {}, {} mm", bearing.name, millimetres(own));
    let expected = format!("that of {bore}, {} mm, within 1 %", millimetres(bore_diameter));
    Some(Rule::found(found, &expected).with_help(format!(
        "nearest of the catalogue: {}; is {unit} right? plummer init --list-bearings lists the catalogue",
        nearest.collect::<Vec<_>>().join(", ")
    )))
}

#[cfg(test)]
mod tests {
    use crate::app::case::tests::{FULL, near, read};
    use crate::app::case::{Case, CaseError};
    use crate::bearing::catalogue::{CatalogueBearing, OuterRingSection};

    const RING: &str = "[ring]\nouter_radius = 40e-3\n\
        sections = [{ material = \"steel\", area = 4e-5, inertia = 8e-11, radius = 35e-3 }]\n";

    /// A case with a ring that is wide enough, and with this bearing: a key, or a table.
    fn with(bearing: &str, set: &[&str]) -> Result<Case, CaseError> {
        let table = bearing.starts_with('[');
        let text = if table { format!("{RING}{bearing}\n") } else { format!("{bearing}\n{RING}") };
        read(&text, set)
    }

    #[test]
    fn a_name_gives_what_the_catalogue_has() {
        for (written, set) in [
            ("bearing = \"6204\"", vec![]),
            ("bearing = 6204", vec![]),
            ("[bearing]\nname = \"6204-2RS\"", vec![]),
            ("bearing = 608", vec!["bearing=6204"]),
            ("bearing = 608", vec!["bearing.name=6204"]),
        ] {
            let case = with(written, &set).unwrap_or_else(|error| panic!("{written}: {error}"));
            let bearing = case.bearing.as_ref().unwrap();
            assert_eq!(bearing.balls, 8, "{written}");
            // GMN: 8 balls of 7.938 mm on 33.5 mm; clearance 5 to 20 um
            for (found, expected) in [
                (bearing.ball_radius, 3.969e-3),
                (bearing.inner_race_radius, 0.5 * (33.5e-3 - 7.938e-3)),
                (bearing.outer_race_radius, 0.5 * (33.5e-3 + 7.938e-3)),
                (bearing.inner_groove_radius, 0.52 * 7.938e-3),
                (bearing.outer_groove_radius, 0.53 * 7.938e-3),
                (bearing.radial_play.unwrap(), 6.25e-6),
            ] {
                assert!(near(found, expected), "{written}: {found} {expected}");
            }
            let told = bearing.taken_from().unwrap();
            assert!(told.starts_with("bearing 6204: balls and diameters are those of GMN, "), "{told}");
            for part in
                ["0.52 (inner) and 0.53 (outer)", "a radial play of 6.25 µm is half", "give your own in [bearing]"]
            {
                assert!(told.contains(part), "{part}: {told}");
            }
            assert!(!told.contains("but for") && !told.contains("mean of bore"), "{told}");
            // the echo reads back as the same case
            let echo = toml::to_string(&case).unwrap();
            assert_eq!(read(&echo, &[]).unwrap().bearing.as_ref(), Some(bearing));
        }
    }

    #[test]
    fn a_name_gives_the_ring_unless_the_case_has_it() {
        let own = "tie = { group = \"bore\" }";
        let mesh =
            "[housing]\nmesh = \"a.msh\"\nlength_unit = \"mm\"\nparts = [{ group = \"a\", material = \"steel\" }]";
        let text = format!("bearing = \"6204\"\n{mesh}\n[ring]\n{own}\n");
        for (set, name) in [(vec![], "6204"), (vec!["bearing=6303"], "6303"), (vec!["bearing.name=6303"], "6303")] {
            let ring = read(&text, &set).unwrap().ring.unwrap();
            let [section] = &ring.sections[..] else { panic!("{ring:?}") };
            let expected = OuterRingSection::of(CatalogueBearing::named(name).unwrap());
            assert!(near(section.area, expected.area) && near(section.radius, expected.radius), "{name}");
            assert!(near(section.inertia, expected.inertia), "{name}");
            assert_eq!(section.material, "bearing steel");
        }
        let given = with("bearing = \"6204\"", &[]).unwrap().ring.unwrap();
        assert!(near(given.sections[0].area, 4e-5));
        let error = read(&text, &["bearing={balls=8}"]).unwrap_err().to_string();
        assert!(
            error.ends_with("`ring` lacks the required key `sections`") || error.contains("`bearing` lacks"),
            "{error}"
        );
    }

    #[test]
    fn keys_beside_a_name_go_before_it() {
        let case = with("bearing = \"6305\"", &["bearing.balls=8", "bearing.outer_race_radius=27.71e-3"]).unwrap();
        let bearing = case.bearing.unwrap();
        assert_eq!((bearing.balls, bearing.radial_play), (8, None));
        // 11.906 mm on 43.5 mm and a race that is 7 um wider
        assert!((bearing.play() - 7e-6).abs() < 1e-6, "{}", bearing.play());
        let told = bearing.taken_from().unwrap();
        assert!(told.contains("Timken") && told.contains(", but for balls, outer_race_radius of the case; "), "{told}");
        assert!(told.contains("mean of bore and outer diameter") && !told.contains("radial play"), "{told}");
        // balls of one's own run on the catalogue's circle
        let case = with("bearing = \"6204\"", &["bearing.ball_radius=4e-3"]).unwrap();
        let bearing = case.bearing.unwrap();
        assert!(near(bearing.inner_race_radius, 12.75e-3) && near(bearing.inner_groove_radius, 0.52 * 8e-3));
        let told = bearing.taken_from().unwrap();
        assert!(told.contains(", but for ball_radius of the case; groove radii of 0.52"), "{told}");
        assert_eq!(read(FULL, &[]).unwrap().bearing.unwrap().taken_from(), None);
    }

    #[test]
    fn a_name_that_is_none_has_near_ones() {
        let error = with("bearing = \"62045\"", &[]).unwrap_err();
        assert!(error.to_string().ends_with(
            "case.toml:1: `bearing.name`: found \"62045\", expected a bearing of the catalogue, or no name and all its numbers"
        ), "{error}");
        let help = error.help().unwrap();
        assert!(help.starts_with("did you mean `6204`? bearings here: 625, 626, "), "{help}");
        let help = with("bearing = 6400", &[]).unwrap_err().help().unwrap();
        assert!(help.starts_with("bearings here: 625, ") && help.ends_with("instead of a name: balls, ball_radius, inner_race_radius, outer_race_radius, inner_groove_radius, outer_groove_radius"), "{help}");
        let help = with("bearing = \"NU204\"", &[]).unwrap_err().help().unwrap();
        assert!(
            help.starts_with("\"NU204\" is a cylindrical roller bearing by the designations of DIN 623-1, "),
            "{help}"
        );
        let error = with("bearing = 6204", &["bearing.name=9999"]).unwrap_err().to_string();
        assert!(error.starts_with("--set bearing.name=9999: `bearing.name`: found \"9999\""), "{error}");
        let error = with("[bearing]\nname = true", &[]).unwrap_err().to_string();
        assert!(error.contains("`bearing.name`: found true, expected a string"), "{error}");
        let error = with("bearing = true", &[]).unwrap_err().to_string();
        assert!(error.contains("`bearing`: found true, expected a table"), "{error}");
        let error = with("[bearing]\nballs = 7", &[]).unwrap_err().to_string();
        assert!(error.contains("`bearing` lacks the required key"), "{error}");
    }
}
