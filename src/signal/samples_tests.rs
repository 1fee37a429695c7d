//! Noise for the tests, the same in every run, and reference values in `tests/data/signal`, which `make.py` there writes.

use serde_json::Value;

/// Standard normal values, by Box and Muller.
pub(crate) fn gaussian(samples: usize, seed: u64) -> Vec<f64> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x1234_5678_9abc_def1;
    let mut uniform = || {
        // xorshift*, Marsaglia and Vigna
        state ^= state >> 12;
        state ^= state << 25;
        state ^= state >> 27;
        let bits = state.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11;
        (bits as f64 + 0.5) / (1_u64 << 53) as f64
    };
    let value = |_| (-2.0 * uniform().ln()).sqrt() * (std::f64::consts::TAU * uniform()).cos();
    (0..samples).map(value).collect()
}

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
    let apart = a.iter().zip(b).fold(0.0, |w: f64, (a, b)| w.max((a - b).abs()));
    apart / size
}
