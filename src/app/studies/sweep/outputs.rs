//! What of a point's result goes into the tables and plots.

use super::{Plan, SweptCommand};
use crate::signal::diagnosis::Fault;
use serde_json::Value;

/// Most frequencies of a point in the table; its own result has all of them.
const MOST_FREQUENCIES: usize = 20;

/// Title of the table of what is not a signal or a mode.
pub(super) const MODEL: &str = "Model";
/// The figure of the signals' estimated error.
pub(super) const ERROR: &str = "estimated_error";
/// What the plots of the parts' lines show.
pub(super) const LINES: &str = "Envelope amplitude";

/// One figure of a point.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    /// Name of its column and array: letters, digits, points.
    pub name: String,
    /// What it is, in words.
    pub label: String,
    /// Its unit, "" for none.
    pub unit: &'static str,
    /// Title of the page's table that it stands in; `None`: only the files have it.
    pub table: Option<String>,
    /// How it is plotted; `None`: not at all.
    pub plot: Option<PlotOf>,
    /// A number, null where the result has none, or a text.
    pub value: Value,
    /// Whether the verdict indicates the part that shows in it.
    pub indicated: bool,
}

/// The plot that a figure is drawn in.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotOf {
    /// Title of the plot; figures of one title share it.
    pub title: String,
    /// What its vertical axis shows.
    pub axis: &'static str,
    /// What its curve is called.
    pub curve: String,
}

/// The figures of a result: the content of `run.json` or `modes.json`.
///
/// Of a run: for each sensor and window k (from 1) `SENSOR.k.speed_hz`, `rms`, `rms_in_band`, `peak`, `kurtosis`, the amplitudes of the parts'
/// lines in the envelope (`BPFO.1` to `FTF.3`), `verdict` and `reason` as `plummer analyze` words them; the estimated error, the
/// equilibrium's shaft position and largest force, times. Of modes: mass, frequencies `frequency.k`, and `loaded.k` where
/// contacts are linearised.
pub(super) fn outputs_of(plan: &Plan, result: &Value) -> Vec<Output> {
    match plan.command {
        SweptCommand::Run => {
            // windows that are varied have no times in common
            let fixed = !plan.axes.iter().any(|axis| axis.key.starts_with("analysis"));
            of_run(result, fixed)
        }
        SweptCommand::Modes => of_modes(result),
    }
}

fn of_run(result: &Value, fixed: bool) -> Vec<Output> {
    let (mut outputs, mut first) = (Vec::new(), None);
    let windows = list(&result["windows"]);
    let sensor = |window: &'_ Value| window["sensor"].as_str().unwrap_or_default().to_owned();
    for (place, window) in windows.iter().enumerate() {
        let sensor_name = sensor(window);
        let count = windows[..=place].iter().filter(|other| sensor(other) == sensor_name).count();
        let title = match (window["from"].as_f64(), window["to"].as_f64()) {
            (Some(from), Some(to)) if fixed => format!("{sensor_name}, {from} to {to} s"),
            _ => format!("{sensor_name}, window {count}"),
        };
        first.get_or_insert_with(|| title.clone());
        let part = plain(&sensor_name, |letter| letter.is_alphanumeric() || "_-".contains(letter));
        outputs.extend(of_window(window, &format!("{part}.{count}"), &title));
    }
    let equilibrium = &result["equilibrium"];
    let forces = list(&equilibrium["outer_force_n"]).iter().filter_map(Value::as_f64);
    let largest = forces.reduce(f64::max).map_or(Value::Null, Value::from);
    let figures = [
        ("shaft_x", "shaft x", "m", &equilibrium["shaft_m"][0]),
        ("shaft_y", "shaft y", "m", &equilibrium["shaft_m"][1]),
        ("largest_static_force", "largest static force", "N", &largest),
        ("modes", "modes", "", &result["model"]["modes"]),
    ];
    let model = figures.map(|(name, label, unit, value)| Output::number(name, label, unit, value).in_table(MODEL));
    outputs.extend(model);
    let error = Output::number(ERROR, "estimated error", "", &result["estimated_error"]);
    outputs.push(error.in_table(first.as_deref().unwrap_or(MODEL)));
    let files_alone = [("stepping_s", "stepping"), ("estimate_held", "estimate held")]
        .map(|(name, label)| Output::number(name, label, "s", &result[name.trim_end_matches("_s").to_owned() + "_s"]));
    outputs.extend(files_alone);
    outputs
}

/// Level of a window up to the end of the case's band, in which the error is estimated.
const IN_BAND: &str = "rms_in_band";

fn of_window(window: &Value, name: &str, title: &str) -> Vec<Output> {
    let verdict = &window["verdict"];
    let named = named(verdict);
    let speed = Output::number(format!("{name}.speed_hz"), "shaft speed", "Hz", &window["speed_hz"]);
    let mut outputs = vec![speed];
    for (key, label, unit, axis) in [
        ("rms", "RMS", "m/s^2", "Root mean square"),
        (IN_BAND, "RMS in the band", "m/s^2", "Root mean square in the band"),
        ("peak", "peak", "m/s^2", "Peak"),
        ("kurtosis", "kurtosis", "", "Kurtosis"),
    ] {
        let plot = PlotOf { title: axis.to_owned(), axis, curve: title.to_owned() };
        let value = if key == IN_BAND { &window[key]["rms"] } else { &window[key] };
        let output = Output::number(format!("{name}.{key}"), label, unit, value);
        // a table with all of them is too wide for a page
        let table = (key == IN_BAND).then(|| title.to_owned());
        outputs.push(Output { plot: Some(plot), table, indicated: !named.is_empty(), ..output });
    }
    // that of a whitened signal has no unit
    let unit = if window["whitened"] == true { "" } else { "m/s^2" };
    for found in list(&window["fault_lines"]) {
        let line = found["line"].as_str().unwrap_or_default();
        let harmonic = found["harmonic"].as_u64().unwrap_or_default();
        let key = format!("{name}.{}.{harmonic}", line.replace(' ', ""));
        if harmonic > 1 {
            outputs.push(Output::number(key, format!("harmonic {harmonic} of {line}"), unit, &found["amplitude"]));
            continue;
        }
        let plot = PlotOf {
            title: format!("Envelope at the lines of the bearing's parts: {title}"),
            axis: LINES,
            curve: line.to_owned(),
        };
        let indicated = named.iter().any(|fault| found["fault"] == fault.name());
        let output = Output::number(key, line, unit, &found["amplitude"]).in_table(title);
        outputs.push(Output { plot: Some(plot), indicated, ..output });
    }
    for (key, text) in [("verdict", &verdict["headline"]), ("reason", &verdict["reason"])] {
        let output = Output::number(format!("{name}.{key}"), key, "", &Value::Null).in_table(title);
        outputs.push(Output { value: Value::String(text.as_str().unwrap_or_default().to_owned()), ..output });
    }
    outputs
}

/// The parts that a verdict names.
fn named(verdict: &Value) -> Vec<Fault> {
    let is_named = |fault: &&Value| fault["conclusion"] == "named";
    let named = list(&verdict["faults"]).iter().filter(is_named);
    let fault = |verdict: &Value| Fault::ALL.into_iter().find(|fault| verdict["fault"] == fault.name());
    named.filter_map(fault).collect()
}

fn of_modes(result: &Value) -> Vec<Output> {
    let mut outputs = vec![Output::number("mass", "mass", "kg", &result["mass_kg"]).in_table(MODEL)];
    let mut frequencies = |name: &str, title: &str, values: &mut dyn Iterator<Item = &Value>| {
        for (k, value) in (1..).zip(values.take(MOST_FREQUENCIES)) {
            let plot = PlotOf { title: title.to_owned(), axis: "Eigenfrequency", curve: format!("mode {k}") };
            let output = Output::number(format!("{name}.{k}"), format!("mode {k}"), "Hz", value).in_table(title);
            outputs.push(Output { plot: Some(plot), ..output });
        }
    };
    frequencies("frequency", "Eigenfrequencies", &mut list(&result["frequencies_hz"]).iter());
    let loaded = list(&result["loaded"]["modes"]).iter();
    frequencies("loaded", "Eigenfrequencies with contacts linearised", &mut loaded.map(|mode| &mode["frequency_hz"]));
    outputs
}

/// The items of a list; none of anything else.
fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[][..], Vec::as_slice)
}

impl Output {
    fn number(name: impl Into<String>, label: impl Into<String>, unit: &'static str, value: &Value) -> Self {
        let value = value.as_f64().map_or(Value::Null, Value::from);
        Self { name: name.into(), label: label.into(), unit, table: None, plot: None, value, indicated: false }
    }

    fn in_table(mut self, title: &str) -> Self {
        self.table = Some(title.to_owned());
        self
    }
}

/// A name with `_` in the place of all letters but the allowed ones.
pub(super) fn plain(name: &str, allowed: impl Fn(char) -> bool) -> String {
    name.chars().map(|letter| if allowed(letter) { letter } else { '_' }).collect()
}

#[cfg(test)]
mod tests {
    use super::{Output, Value, of_modes, of_run};
    use serde_json::json;

    fn value(found: &[Output], name: &str) -> Option<Value> {
        let found = found.iter().find(|output| output.name == name);
        found.map(|output| output.value.clone())
    }

    #[test]
    fn windows_are_counted_for_each_sensor() {
        let window = |sensor: &str, rms: f64, conclusion: &str| {
            json!({
                "sensor": sensor, "speed_hz": 22.0, "rms": rms, "peak": 2.0, "kurtosis": 3.0, "from": 0.5, "to": 1.5,
                "fault_lines": [
                    { "fault": "ball", "line": "2 x BSF", "harmonic": 1, "amplitude": 7.5 },
                    { "fault": "ball", "line": "2 x BSF", "harmonic": 2, "amplitude": 2.5 },
                    { "fault": "inner race", "line": "BPFI", "harmonic": 1, "amplitude": 0.5 },
                ],
                "verdict": { "headline": conclusion, "reason": "Since.", "faults": [
                    { "fault": "ball", "conclusion": conclusion, "false_alarm": 1e-4 },
                    { "fault": "cage", "conclusion": conclusion, "false_alarm": null },
                ] },
            })
        };
        let result = json!({
            "windows": [window("P 1", 1.0, "named"), window("P 1", 4.0, "not seen"), window("top", 5.0, "named")],
            "equilibrium": { "shaft_m": [1e-6, -2e-6], "outer_force_n": [0.0, 3.0, 1.0] },
            "model": { "modes": 7 }, "estimated_error": null, "stepping_s": 0.5,
        });
        let found = of_run(&result, true);
        let value = |name: &str| value(&found, name);
        let text = |text: &str| Some(Value::from(text));
        assert_eq!(value("P_1.1.rms"), Some(Value::from(1.0)));
        assert_eq!(value("P_1.2.rms"), Some(Value::from(4.0)));
        assert_eq!(value("top.1.rms"), Some(Value::from(5.0)));
        assert_eq!([value("P_1.1.verdict"), value("P_1.2.verdict")], [text("named"), text("not seen")]);
        assert_eq!(value("P_1.1.reason"), text("Since."));
        assert_eq!(value("P_1.1.2xBSF.1"), Some(Value::from(7.5)));
        assert_eq!(value("P_1.1.2xBSF.2"), Some(Value::from(2.5)));
        assert_eq!(value("largest_static_force"), Some(Value::from(3.0)));
        assert_eq!(value("shaft_y"), Some(Value::from(-2e-6)));
        assert_eq!(value("estimated_error"), Some(Value::Null));
        let output = |name: &str| found.iter().find(|output| output.name == name).unwrap();
        assert!(output("P_1.1.2xBSF.1").indicated && !output("P_1.1.BPFI.1").indicated);
        assert_eq!(output("top.1.rms_in_band").table.as_deref(), Some("top, 0.5 to 1.5 s"));
        let varied = of_run(&result, false);
        assert_eq!(varied[2].table.as_deref(), Some("P 1, window 1"));
    }

    #[test]
    fn frequencies_are_numbered() {
        let result = json!({
            "mass_kg": 0.1, "frequencies_hz": (1..30).map(f64::from).collect::<Vec<_>>(),
            "loaded": { "modes": [{ "frequency_hz": 7.5 }] },
        });
        let found = of_modes(&result);
        let of = |place: usize| (found[place].name.as_str(), found[place].value.clone());
        assert_eq!(of(0), ("mass", Value::from(0.1)));
        assert_eq!(of(20), ("frequency.20", Value::from(20.0)));
        assert_eq!(of(21), ("loaded.1", Value::from(7.5)));
        assert_eq!(found.len(), 22);
    }
}
