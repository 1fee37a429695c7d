//! The units of a case's keys, for what shows the values that a key takes.

/// Keys whose names end with their unit.
const ENDINGS: [(&str, &str); 4] = [("_radius", "m"), ("hz", "Hz"), ("rpm", "rpm"), ("_deg", "°")];

/// Keys with a unit, by the last name on their path. Springs of housings are left out: theirs depends on what they are per.
#[rustfmt::skip]
const NAMES: [(&str, &[&str]); 13] = [
    ("m", &["amplitude", "ball_radius_differences", "centre", "depth", "length", "offset", "point", "points_within",
            "radial_play", "radius", "thickness", "width"]),
    ("s", &["beta", "end", "from", "start", "step", "time", "to"]),
    ("kg", &["ball_mass", "mass"]),
    ("kg*m", &["unbalance"]),
    ("kg/m^3", &["density"]),
    ("Pa", &["shear", "young"]),
    ("m^2", &["area"]),
    ("m^4", &["axial_inertia", "inertia", "torsion"]),
    ("m/s^2", &["gravity"]),
    ("N", &["force"]),
    ("1/s", &["alpha"]),
    ("s/m", &["contact_damping"]),
    ("", &["spectral_radius", "zero_deg"]), // of a method; a direction
];

/// The unit of the numbers under a key, as `--set` names it ("" for none, or where it depends on other keys).
pub(super) fn unit_of(key: &str) -> &'static str {
    let mut names = key.split(['.', '[', ']']).map(str::trim);
    let name = names.rfind(|name| !name.is_empty() && !name.bytes().all(|b| b.is_ascii_digit()));
    let name = name.unwrap_or_default();
    if key.starts_with("ring.supports") && matches!(name, "x" | "y" | "z") {
        return "N/m";
    }
    let by_name = NAMES.iter().find(|(_, names)| names.contains(&name));
    let by_name = by_name.map(|(unit, _)| *unit);
    by_name
        .or_else(|| ENDINGS.iter().find(|(ending, _)| name.ends_with(ending)).map(|(_, unit)| *unit))
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::unit_of;
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
