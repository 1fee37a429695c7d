//! A case's keys as a reader knows them: what each is, in words, and its unit.

use crate::app::case::Case;
use serde_json::Value;

/// Keys whose names end with their unit.
const ENDINGS: [(&str, &str); 4] = [("_radius", "m"), ("hz", "Hz"), ("rpm", "rpm"), ("_deg", "°")];

/// Keys with a unit, by the last name on their path. Springs of housings are left out: theirs depends on what they are per.
#[rustfmt::skip]
const NAMES: [(&str, &[&str]); 15] = [
    ("m", &["across", "amplitude", "at", "ball_radius_differences", "centre", "depth", "displacement", "length", "offset", "point", "points_within",
            "radial_play", "radius", "thickness", "width"]),
    ("s", &["beta", "end", "from", "start", "step", "time", "to"]),
    ("kg", &["ball_mass", "mass"]),
    ("kg*m", &["unbalance"]),
    ("kg m^2", &["polar_inertia", "transverse_inertia"]),
    ("kg/m^3", &["density"]),
    ("Pa", &["shear", "young"]),
    ("m^2", &["area"]),
    ("m^4", &["axial_inertia", "inertia", "torsion"]),
    ("m/s^2", &["gravity"]),
    ("N", &["force"]),
    ("N m", &["moment"]),
    ("1/s", &["alpha"]),
    ("s/m", &["contact_damping"]),
    ("", &["spectral_radius", "zero_deg"]), // of a method; a direction
];

/// What a key of a name is, where its name does not say it.
#[rustfmt::skip]
const WHAT: [(&str, &str); 26] = [
    ("alpha", "damping by mass"), ("angle_deg", "angle"), ("band_hz", "band"), ("balls", "number of balls"),
    ("beta", "damping by stiffness"), ("count", "number"), ("end", "end"),
    ("first_ball_deg", "angle of the first ball"), ("from", "begin"), ("from_deg", "first angle"), ("hz", "speed"),
    ("inertia", "second moment of area"), ("inner", "stiffness at the inner race"),
    ("modal", "share of critical damping"), ("nodes", "number of nodes"), ("outer", "stiffness at the outer race"),
    ("output_hz", "sampling rate"), ("poisson", "Poisson's ratio"), ("ring_deg", "angle on the ring"),
    ("rpm", "speed"), ("to", "end"), ("to_deg", "last angle"), ("torsion", "torsion constant"),
    ("x", "stiffness along x"), ("y", "stiffness along y"), ("young", "Young's modulus"),
];

/// Tables and items of a case by other names, "" where the key says all without them.
#[rustfmt::skip]
const OF: [(&str, &str); 15] = [
    ("accuracy", ""), ("analysis", ""), ("condense", "condensation"), ("damping", ""), ("envelope", "window"),
    ("frf", "response"), ("masses", "added mass"), ("profile", "point"), ("report", ""), ("spring", ""), ("spot", ""),
    ("stiffness", ""), ("transient", "run"), ("unbalance", ""), ("waviness", "wave"),
];

/// What a key of a case is, as `--set` names it: "length of the first dent".
pub(super) fn words_of(key: &str, case: &Case) -> String {
    let case = serde_json::to_value(case).unwrap_or_default();
    let names = key.split(['.', '[', ']']).map(|name| name.trim().trim_matches(['"', '\'']));
    let mut steps: Vec<&str> = names.filter(|name| !name.is_empty()).collect();
    let place = steps.pop_if(|name| is_index(name)).and_then(|index| index.parse::<usize>().ok());
    let name = steps.pop().unwrap_or(key);
    let mut words = listed(&WHAT, name).map_or_else(|| plain(name), str::to_owned);
    words += &match place {
        Some(index) if name == "band_hz" => format!(", {} end", ["lower", "upper"][index.min(1)]),
        Some(index @ 0..3) => format!(" along {}", ["x", "y", "z"][index]),
        Some(index) => format!(", number {}", index + 1),
        None => String::new(),
    };
    if let ["materials", material, ..] = steps[..] {
        return format!("{words} of {material}");
    }
    // from the innermost table out; an item of a list is known without what holds it, but for ring and housing
    let known_alone = !matches!(steps.first(), Some(&("ring" | "housing")));
    while let Some(step) = steps.pop() {
        let item = is_index(step).then(|| steps.pop()).flatten();
        let of = item.unwrap_or(step);
        let noun = listed(&OF, of).map_or_else(|| plain(of), str::to_owned);
        let Some(list) = item else {
            if !noun.is_empty() {
                words += &format!(" of the {noun}");
            }
            continue;
        };
        let all = steps.iter().chain([&list]).try_fold(&case, |inside, step| match step.parse::<usize>() {
            Ok(index) => inside.get(index),
            Err(_) => inside.get(step),
        });
        let index: usize = step.parse().unwrap_or_default();
        let noun = match all.and_then(|all| all.get(index)) {
            Some(defect) if list == "defects" => kind_of(defect),
            _ => noun.strip_suffix('s').unwrap_or(&noun),
        };
        let one = index == 0 && all.and_then(Value::as_array).is_some_and(|all| all.len() == 1);
        words += &if one { format!(" of the {noun}") } else { format!(" of the {} {noun}", ordinal(index + 1)) };
        if known_alone {
            break;
        }
    }
    words
}

/// What a defect is called.
fn kind_of(defect: &Value) -> &'static str {
    match (&defect["flat_radius"], &defect["length"]) {
        (Value::Number(_), _) => "flat",
        (_, Value::Number(_)) => "dent",
        _ => "measured profile",
    }
}

/// "first" to "sixth", then "7th"; a case has few of anything.
fn ordinal(number: usize) -> String {
    let words = ["first", "second", "third", "fourth", "fifth", "sixth"];
    number
        .checked_sub(1)
        .and_then(|place| words.get(place))
        .map_or_else(|| format!("{number}th"), |&word| word.to_owned())
}

fn is_index(name: &str) -> bool {
    name.bytes().all(|b| b.is_ascii_digit())
}

fn listed(list: &[(&str, &'static str)], name: &str) -> Option<&'static str> {
    list.iter().find(|(listed, _)| *listed == name).map(|(_, words)| *words)
}

/// A name without its unit, in words.
fn plain(name: &str) -> String {
    let name = name.strip_suffix("_deg").or_else(|| name.strip_suffix("_hz")).unwrap_or(name);
    name.replace('_', " ")
}

/// The unit of the numbers under a key, as `--set` names it ("" for none, or where it depends on other keys).
pub(super) fn unit_of(key: &str) -> &'static str {
    let mut names = key.split(['.', '[', ']']).map(str::trim);
    let name = names.rfind(|name| !name.is_empty() && !is_index(name));
    let name = name.unwrap_or_default();
    if key.starts_with("ring.supports") && matches!(name, "x" | "y" | "z") {
        return "N/m";
    }
    if key.starts_with("shaft.unbalances") && name == "moment" {
        return "kg*m";
    }
    let by_name = NAMES.iter().find(|(_, names)| names.contains(&name));
    let by_name = by_name.map(|(unit, _)| *unit);
    by_name
        .or_else(|| ENDINGS.iter().find(|(ending, _)| name.ends_with(ending)).map(|(_, unit)| *unit))
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::{unit_of, words_of};
    use crate::app::case::Case;
    use serde_json::Value;

    /// Keys of the case's schema that hold numbers, with their descriptions.
    fn numbers(schema: &Value, keys: &mut Vec<(String, String)>) {
        match schema {
            Value::Object(entries) => {
                for (key, of) in entries.get("properties").and_then(Value::as_object).into_iter().flatten() {
                    let kinds = of.to_string();
                    if kinds.contains("\"number\"") {
                        keys.push((key.clone(), of["description"].as_str().unwrap_or_default().to_owned()));
                    }
                }
                entries.values().for_each(|value| numbers(value, keys));
            }
            Value::Array(items) => items.iter().for_each(|item| numbers(item, keys)),
            _ => {}
        }
    }

    #[test]
    fn every_number_of_a_case_has_its_unit_or_none() {
        const WITHOUT: [&str; 25] = [
            "axis",
            "cycles",
            "direction",
            "inner",
            "loss_factor",
            "mac",
            "modal",
            "order",
            "outer",
            "perturbation",
            "poisson",
            "radial",
            "ratio",
            "shear_coefficient",
            "slip",
            "spectral_radius",
            "target",
            "tolerance",
            "within",
            "x",
            "x_axis",
            "y",
            "y_axis",
            "z",
            "zero_deg",
        ];
        let mut keys = Vec::new();
        numbers(&Case::schema(), &mut keys);
        assert!(keys.len() > 60, "{}", keys.len());
        for (key, description) in keys {
            let unit = unit_of(&key);
            let expected = !WITHOUT.contains(&key.as_str());
            assert_eq!(!unit.is_empty(), expected, "{key}: \"{unit}\" ({description})");
        }
    }

    #[test]
    fn keys_are_said_in_words() {
        let case = Case::example("tadina2011/outer-dent", &[]);
        for (key, words) in [
            ("bearing.defects[0].depth", "depth of the dent"),
            ("bearing.defects.1.length", "length of the second defect"),
            ("bearing.radial_play", "radial play of the bearing"),
            ("shaft.mass", "mass of the shaft"),
            ("shaft.gravity[1]", "gravity along y of the shaft"),
            ("ring.supports[0].spring.y", "stiffness along y of the first support of the ring"),
            ("materials.\"steel\".young", "Young's modulus of steel"),
            ("speed.profile[1].rpm", "speed of the second point"),
            ("damping.modal", "share of critical damping"),
            ("accuracy.band_hz[1]", "band, upper end"),
            ("transient.output_hz", "sampling rate of the run"),
            ("ring.nodes", "number of nodes of the ring"),
            ("title", "title"),
        ] {
            assert_eq!(words_of(key, &case), words, "{key}");
        }
        let two = Case::example(
            "tadina2011/outer-dent",
            &[
                "bearing.defects=[{on='outer',angle_deg=0,length=1e-3,depth=5e-6},{on='ball',ball=0,flat_radius=2e-3,depth=1e-6}]",
            ],
        );
        assert_eq!(words_of("bearing.defects.0.length", &two), "length of the first dent");
        assert_eq!(words_of("bearing.defects[1].depth", &two), "depth of the second flat");
    }

    #[test]
    fn units_are_those_of_the_last_name() {
        for (key, unit) in [
            ("bearing.defects[0].depth", "m"),
            ("bearing.defects.0.angle_deg", "°"),
            ("ring.supports[0].spring.y", "N/m"),
            ("housing.supports[0].spring.y", ""),
            ("speed.profile[1].hz", "Hz"),
            ("shaft.loads[0].force[1]", "N"),
            ("analysis.band_hz", "Hz"),
            ("damping.modal", ""),
            ("bearing.outer_race_radius", "m"),
            ("transient.output_hz", "Hz"),
        ] {
            assert_eq!(unit_of(key), unit, "{key}");
        }
    }
}
