//! What of a point's result goes into the table.

use serde_json::Value;

use super::SweptCommand;

/// Most frequencies of a point in the table; its own result has all of them.
const MOST_FREQUENCIES: usize = 20;

/// One figure of a point.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    /// Name of its column and array: letters, digits, points.
    pub name: String,
    /// Its unit, "" for none.
    pub unit: &'static str,
    /// What it belongs to in plots: outputs of one group share an axis. `None`: not plotted.
    pub group: Option<&'static str>,
    /// A number, null where the result has none, or a text.
    pub value: Value,
}

/// The figures of a result: the content of `run.json` or `modes.json`.
///
/// Of a run: for each sensor and window k (from 1) `SENSOR.k.speed_hz`, `rms`, `peak`, `kurtosis` and `named` (the parts that
/// are called damaged), the estimated error, the equilibrium's shaft position and largest force, times. Of modes: mass,
/// frequencies `frequency.k`, and `loaded.k` where contacts are linearised.
pub(crate) fn outputs_of(command: SweptCommand, result: &Value) -> Vec<Output> {
    match command {
        SweptCommand::Run => of_run(result),
        SweptCommand::Modes => of_modes(result),
    }
}

fn of_run(result: &Value) -> Vec<Output> {
    let mut outputs = Vec::new();
    let windows = result["windows"].as_array().map_or(&[][..], Vec::as_slice);
    let sensor = |window: &'_ Value| window["sensor"].as_str().unwrap_or_default().to_owned();
    for (place, window) in windows.iter().enumerate() {
        let sensor_name = sensor(window);
        let count = windows[..=place].iter().filter(|other| sensor(other) == sensor_name).count();
        let part = plain(&sensor_name, |letter| letter.is_alphanumeric() || "_-".contains(letter));
        let name = |what: &str| format!("{part}.{count}.{what}");
        outputs.push(number(name("speed_hz"), "Hz", None, &window["speed_hz"]));
        for (what, unit, group) in
            [("rms", "m/s^2", "Root mean square"), ("peak", "m/s^2", "Peak"), ("kurtosis", "", "Kurtosis")]
        {
            outputs.push(number(name(what), unit, Some(group), &window[what]));
        }
        outputs.push(Output {
            name: name("named"),
            unit: "",
            group: None,
            value: Value::String(named(&window["verdict"])),
        });
    }
    let equilibrium = &result["equilibrium"];
    let forces = equilibrium["outer_force_n"].as_array();
    let largest = forces.into_iter().flatten().filter_map(Value::as_f64);
    let largest = largest.reduce(f64::max).map_or(Value::Null, Value::from);
    let model = &result["model"];
    outputs.extend([
        number("shaft_x", "m", None, &equilibrium["shaft_m"][0]),
        number("shaft_y", "m", None, &equilibrium["shaft_m"][1]),
        number("largest_static_force", "N", None, &largest),
        number("modes", "", None, &model["modes"]),
        number("estimated_error", "", None, &result["estimated_error"]),
        number("estimate_held", "s", None, &result["estimate_held_s"]),
        number("stepping_s", "s", None, &result["stepping_s"]),
    ]);
    outputs
}

/// Parts that a verdict names, "none" if it names none, nothing where there is no verdict.
fn named(verdict: &Value) -> String {
    let Some(faults) = verdict["faults"].as_array() else {
        return String::new();
    };
    let named =
        faults.iter().filter(|fault| fault["conclusion"] == "named").filter_map(|fault| fault["fault"].as_str());
    let names: Vec<&str> = named.collect();
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

fn of_modes(result: &Value) -> Vec<Output> {
    let mut outputs = vec![number("mass", "kg", None, &result["mass_kg"])];
    let mut frequencies = |name: &str, group, values: &mut dyn Iterator<Item = &Value>| {
        for (k, value) in (1..).zip(values.take(MOST_FREQUENCIES)) {
            outputs.push(number(format!("{name}.{k}"), "Hz", Some(group), value));
        }
    };
    let list = |value: &'_ Value| value.as_array().map_or(&[][..], Vec::as_slice).to_vec();
    let unloaded = list(&result["frequencies_hz"]);
    frequencies("frequency", "Eigenfrequencies", &mut unloaded.iter());
    let loaded = list(&result["loaded"]["modes"]);
    frequencies(
        "loaded",
        "Eigenfrequencies with contacts linearised",
        &mut loaded.iter().map(|mode| &mode["frequency_hz"]),
    );
    outputs
}

fn number(name: impl Into<String>, unit: &'static str, group: Option<&'static str>, value: &Value) -> Output {
    Output { name: name.into(), unit, group, value: value.as_f64().map_or(Value::Null, Value::from) }
}

/// A name with `_` in the place of all letters but the allowed ones.
pub(super) fn plain(name: &str, allowed: impl Fn(char) -> bool) -> String {
    name.chars().map(|letter| if allowed(letter) { letter } else { '_' }).collect()
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::{SweptCommand, Value, outputs_of};

    fn found(command: SweptCommand, result: &Value) -> Vec<(String, Value)> {
        let outputs = outputs_of(command, result).into_iter();
        outputs.map(|output| (output.name, output.value)).collect()
    }

    #[test]
    fn windows_are_counted_for_each_sensor() {
        let window = |sensor: &str, rms: f64, conclusion: &str| {
            json!({
                "sensor": sensor, "speed_hz": 22.0, "rms": rms, "peak": 2.0, "kurtosis": 3.0,
                "verdict": { "faults": [{ "fault": "ball", "conclusion": conclusion },
                                        { "fault": "cage", "conclusion": conclusion }] },
            })
        };
        let result = json!({
            "windows": [window("P 1", 1.0, "named"), window("P 1", 4.0, "not seen"), window("top", 5.0, "named")],
            "equilibrium": { "shaft_m": [1e-6, -2e-6], "outer_force_n": [0.0, 3.0, 1.0] },
            "model": { "modes": 7 }, "estimated_error": null, "stepping_s": 0.5,
        });
        let found = found(SweptCommand::Run, &result);
        let value = |name: &str| {
            let found = found.iter().find(|(other, _)| other == name);
            found.map(|(_, value)| value.clone())
        };
        let text = |text: &str| Some(Value::from(text));
        assert_eq!(value("P_1.1.rms"), Some(Value::from(1.0)));
        assert_eq!(value("P_1.2.rms"), Some(Value::from(4.0)));
        assert_eq!(value("top.1.rms"), Some(Value::from(5.0)));
        assert_eq!(value("P_1.1.named"), text("ball, cage"));
        assert_eq!(value("P_1.2.named"), text("none"));
        assert_eq!(value("largest_static_force"), Some(Value::from(3.0)));
        assert_eq!(value("shaft_y"), Some(Value::from(-2e-6)));
        assert_eq!(value("estimated_error"), Some(Value::Null));
    }

    #[test]
    fn frequencies_are_numbered() {
        let result = json!({
            "mass_kg": 0.1, "frequencies_hz": (1..30).map(f64::from).collect::<Vec<_>>(),
            "loaded": { "modes": [{ "frequency_hz": 7.5 }] },
        });
        let found = found(SweptCommand::Modes, &result);
        assert_eq!(found[0], ("mass".to_owned(), Value::from(0.1)));
        assert_eq!(found[20], ("frequency.20".to_owned(), Value::from(20.0)));
        assert_eq!(found[21], ("loaded.1".to_owned(), Value::from(7.5)));
        assert_eq!(found.len(), 22);
    }
}
