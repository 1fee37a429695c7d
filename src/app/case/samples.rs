//! The shipped cases, for tests.

use super::Case;

impl Case {
    /// The case of that name under `examples`, with these keys set.
    pub(crate) fn example(name: &str, set: &[&str]) -> Self {
        let path = format!("{}/examples/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let set: Vec<String> = set.iter().map(|&key| key.to_owned()).collect();
        Self::load(path, &set).unwrap()
    }
}
