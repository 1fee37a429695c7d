//! Reads the reference values in `tests/data/signal`, which `make.py` there writes.

use serde_json::Value;

/// The file NAME.json.
pub(super) fn load(name: &str) -> Value {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/signal");
    let text = std::fs::read_to_string(format!("{folder}/{name}.json")).expect("a reference file");
    serde_json::from_str(&text).expect("valid JSON")
}

/// Numbers of an array.
pub(super) fn numbers(value: &Value) -> Vec<f64> {
    let items = value.as_array().expect("an array").iter();
    items.map(|v| v.as_f64().expect("a number")).collect()
}

/// Items of an array.
pub(super) fn items(value: &Value) -> &[Value] {
    value.as_array().expect("an array")
}

/// Largest |a - b| over largest |b|.
pub(super) fn worst(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len(), "lengths");
    let size = b.iter().fold(0.0, |w: f64, b| w.max(b.abs()));
    let apart = a
        .iter()
        .zip(b)
        .fold(0.0, |w: f64, (a, b)| w.max((a - b).abs()));
    apart / size
}
