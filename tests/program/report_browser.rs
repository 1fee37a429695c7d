//! The plots of a report in a browser: zoom, reading, cursors A and B, harmonics.
//!
//! Reference: abscissas and ordinates of straight lines, worked out by hand.
//! Goal: what a reader does with pointer and keys is what the page then says, and names stay text.
//! Sketch: a plot over 0 to 200 Hz with y = x / 100 and y = 5, and a family at 25 Hz with side lines 14 Hz apart. A script
//!   sends the events and writes what the page says into an element, which is read back.
//! Conditions: Chromium or Chrome without a window; without one the test passes with a message.
//! Parameters: none.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use plummer::report::{Abscissa, Axis, Curve, Family, Marker, Plot, Report, Section};
use serde_json::Value;

const BROWSERS: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];

/// What a reader does. `done` is read back as JSON.
const SCRIPT: &str = r#"
addEventListener("load", () => setTimeout(() => {
  // events that a script sends have no pointer to capture
  Element.prototype.setPointerCapture = () => {};
  const figure = document.querySelector("figure.plot"), svg = figure.querySelector("svg.plot"), { plot, cursors } = figure;
  const done = {};
  const client = (x, y) => {
    const box = svg.getBoundingClientRect(), d = plot.data;
    return { clientX: box.left + plot.xPixel(x) * box.width / d.width, clientY: box.top + plot.yPixel(y) * box.height / d.height };
  };
  const fire = (type, x, y, more = {}) => {
    const Kind = type === "wheel" ? WheelEvent : PointerEvent;
    svg.dispatchEvent(new Kind(type, { ...client(x, y), pointerId: 1, button: 0, bubbles: true, cancelable: true, ...more }));
  };
  const drag = (from, to) => { fire("pointerdown", from, 1); fire("pointermove", to, 1); fire("pointerup", to, 1); };
  const key = (target, name, more = {}) => target.dispatchEvent(new KeyboardEvent("keydown", { key: name, bubbles: true, cancelable: true, ...more }));
  const range = () => [plot.x.low, plot.x.high];
  const marks = (kind) => [...svg.querySelectorAll(kind)].map((line) => plot.value(plot.x, (Number(line.getAttribute("x1")) - plot.data.left) / (plot.data.right - plot.data.left)));
  const harmonics = () => marks(".mark:not(.side) line");
  const set = (field, value) => { field.value = value; field.dispatchEvent(new Event("change", { bubbles: true })); };
  const status = figure.querySelector(".readings p"), output = figure.querySelector("output");
  const rows = () => [...figure.querySelectorAll(".readings tr")].map((row) => [...row.cells].map((cell) => cell.textContent));
  const [fieldA, fieldB, fundamental] = figure.querySelectorAll("input[type=number]"), select = figure.querySelector("select");

  drag(50, 100);
  done.dragged = range();
  const elements = () => figure.querySelectorAll("b.name, i.name").length;
  done.elements = [elements()];
  fire("wheel", 75, 1, { deltaY: -1 });
  done.wheeled = range();
  fire("dblclick", 75, 1);
  done.reset = range();
  fire("pointermove", 120, 4.8);
  done.above = output.textContent;
  fire("pointermove", 120, 1.4);
  done.below = output.textContent;

  figure.querySelector(".cursors button").click();
  done.places = [fieldA.value, fieldB.value].map(Number);
  set(fieldA, 40.2); set(fieldB, 90);
  done.pair = status.textContent;
  drag(90, 60);
  done.pairDragged = Number(fieldB.value);
  fire("pointermove", 150, 1);
  done.notZoomed = [...range(), svg.querySelectorAll(".select").length];
  key(svg, "ArrowRight", { shiftKey: true });
  done.pairStepped = (Number(fieldB.value) - 60) / (200 / (plot.data.right - plot.data.left));
  figure.querySelector(".cursors button").click();
  done.pairLeft = [fieldA.parentElement.hidden, status.textContent, harmonics().length];

  done.options = [...select.options].map((option) => option.textContent);
  set(select, "0");
  done.harmonics = harmonics();
  done.rows = rows();
  done.coloured = svg.querySelectorAll(".mark.m1 line").length;
  done.markers = getComputedStyle(svg.querySelector(".marker")).display;
  drag(100, 80);
  done.fourthDragged = [Number(fundamental.value), ...harmonics()];
  key(svg, "ArrowLeft");
  done.fourthStepped = 4 * (Number(fundamental.value) - 20) / (200 / (plot.data.right - plot.data.left));
  set(fundamental, 30);
  key(fundamental, "ArrowUp");
  done.stepped = (Number(fundamental.value) - 30) / (200 / (plot.data.right - plot.data.left));
  set(fundamental, 25);
  const sides = figure.querySelector("input[type=checkbox]");
  done.sidesLabel = [sides.parentElement.hidden, sides.parentElement.textContent.trim()];
  sides.click();
  const beside = marks(".mark.side line");
  done.sides = [...beside.slice(3, 7), beside.at(-1)];
  done.sideRow = rows()[2];
  set(select, "1");
  done.noSides = [sides.parentElement.hidden, marks(".mark.side line").length];
  done.least = (set(fundamental, 0), Number(fundamental.value));
  set(select, "");
  done.none = [harmonics().length, figure.querySelector(".readings").hidden, getComputedStyle(svg.querySelector(".marker")).display !== "none"];
  done.elements.push(elements());
  document.body.append(Object.assign(document.createElement("pre"), { id: "done", textContent: JSON.stringify(done) }));
}, 500));
"#;

fn page() -> String {
    let even = || Abscissa::Even { start: 0.0, step: 0.5 };
    let rising = (0..=400).map(|k| 0.005 * f64::from(k)).collect();
    let frequency = Axis::new("Frequency", "Hz");
    let plot = Plot::new("Envelope", frequency, Axis::new("Amplitude", "m/s^2").range(0.0, 6.0))
        .curve(Curve::new("rising", even(), rising))
        .curve(Curve::new("<b class=name>five", even(), vec![5.0; 401]))
        .marker(Marker::new(25.0, "<i class=name>race"))
        .marker(Marker::new(75.0, "<i class=name>race"))
        .family(Family::new("<i class=name>race", 25.0, 1).sides("shaft", 14.0))
        .family(Family::new("cage", 60.0, 2));
    let report = Report::new("Browser", "none", "0").section(Section::new("S").plot(plot));
    let html = report.to_html().unwrap();
    html.replace("</body>", &format!("<script>{SCRIPT}</script></body>"))
}

/// What the page says after all events; `None` without a browser.
fn done(folder: &Path) -> Option<Value> {
    let path = folder.join("page.html");
    fs::write(&path, page()).unwrap();
    let output = BROWSERS.iter().find_map(|browser| {
        let mut command = Command::new(browser);
        command.args(["--headless", "--no-sandbox", "--disable-gpu", "--dump-dom"]);
        command.args(["--virtual-time-budget=2000", "--window-size=1280,900"]);
        command.arg(format!("--user-data-dir={}", folder.display()));
        command.arg(format!("file://{}", path.display())).output().ok()
    })?;
    let dom = String::from_utf8(output.stdout).unwrap();
    let found = dom.split("<pre id=\"done\">").nth(1);
    let errors = String::from_utf8_lossy(&output.stderr);
    let found = found.unwrap_or_else(|| panic!("the script did not end: {errors}"));
    let json = found.split("</pre>").next().unwrap();
    let json = json.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
    Some(serde_json::from_str(&json).unwrap())
}

fn numbers(value: &Value) -> Vec<f64> {
    let values = value.as_array().unwrap().iter();
    values.map(|value| value.as_f64().unwrap()).collect()
}

fn near(found: &Value, expected: &[f64], within: f64) {
    let found = numbers(found);
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= within, "{found} {expected}");
    }
}

#[test]
fn a_reader_zooms_reads_and_marks_harmonics() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("report-browser");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let Some(done) = done(&folder) else {
        eprintln!("skipped: none of {BROWSERS:?} is installed");
        return;
    };
    // pixels are worked out exactly; the inputs hold seven digits
    let exact = 1e-4;
    near(&done["dragged"], &[50.0, 100.0], exact);
    // the wheel takes a fifth off, about the pointer; its events have whole pixels, of 0.06 Hz here
    near(&done["wheeled"], &[55.0, 95.0], 0.2 * 0.06);
    near(&done["reset"], &[0.0, 200.0], exact);
    assert_eq!(done["above"], "<b class=name>five: (120.0; 5.000)");
    assert_eq!(done["below"], "rising: (120.0; 1.200)");

    near(&done["places"], &[66.666_67, 133.333_3], exact);
    assert_eq!(
        done["pair"],
        "rising: A (40.2; 0.402), B (90.0; 0.900), Δx = 49.8 Hz, 1/Δx = 0.02008 s, Δy = 0.498 m/s²"
    );
    assert!((done["pairDragged"].as_f64().unwrap() - 60.0).abs() < exact);
    near(&done["notZoomed"], &[0.0, 200.0, 0.0], exact);
    assert!((done["pairStepped"].as_f64().unwrap() - 10.0).abs() < 1e-3);
    assert_eq!(done["pairLeft"], serde_json::json!([true, "", 0]));

    assert_eq!(done["options"], serde_json::json!(["none", "<i class=name>race", "cage"]));
    let multiples = |f: f64, count: u32| (1..=count).map(|k| f64::from(k) * f).collect::<Vec<_>>();
    near(&done["harmonics"], &multiples(25.0, 8), exact);
    let header = ["Harmonic", "Frequency [Hz]", "Amplitude [m/s²]"];
    assert_eq!(done["rows"][0], serde_json::json!(header));
    assert_eq!(done["rows"][3], serde_json::json!(["3×", "75.000", "0.7500"]));
    assert_eq!(done["rows"].as_array().unwrap().len(), 9);
    assert_eq!(done["coloured"], 8);
    assert_eq!(done["markers"], "none");
    // the fourth is taken from 100 to 80 Hz: the fundamental to 20, and ten are in view
    let dragged = [vec![20.0], multiples(20.0, 10)].concat();
    near(&done["fourthDragged"], &dragged, exact);
    assert!((done["fourthStepped"].as_f64().unwrap() + 1.0).abs() < 1e-3);
    assert!((done["stepped"].as_f64().unwrap() - 1.0).abs() < 1e-3);
    assert_eq!(done["sidesLabel"], serde_json::json!([false, "side lines at ±1 and ±2 x shaft"]));
    // of the first harmonic one is below 0; of the ninth, at 225 Hz, one is in view
    near(&done["sides"], &[22.0, 36.0, 64.0, 78.0, 197.0], exact);
    assert_eq!(done["sideRow"], serde_json::json!(["2×", "50.000", "0.5000", "0.2200", "0.3600", "0.6400", "0.7800"]));
    assert_eq!(done["noSides"], serde_json::json!([true, 0]));
    // a four-hundredth of the plot
    assert!((done["least"].as_f64().unwrap() - 0.5).abs() < exact);
    assert_eq!(done["none"], serde_json::json!([0, true, true]));
    assert_eq!(done["elements"], serde_json::json!([0, 0]), "names are text");
}
