//! Any text and any `--set` argument: an error with a message or a case that holds its own rules, never a panic.

#![no_main]

use std::path::PathBuf;

use libfuzzer_sys::fuzz_target;
use plummer::app::case::{Case, Purpose, Source};

fuzz_target!(|bytes: &[u8]| {
    // what stands behind the first NUL is an argument of --set
    let mut parts = bytes.splitn(2, |&byte| byte == 0);
    let Ok(text) = std::str::from_utf8(parts.next().unwrap_or_default()) else {
        return;
    };
    let set = parts.next().and_then(|argument| std::str::from_utf8(argument).ok());
    let source = Source {
        path: PathBuf::from("cases/fuzz.toml"),
        text: text.to_owned(),
        set: set.into_iter().map(str::to_owned).collect(),
    };
    match Case::from_source(source) {
        Ok(case) => check(&case),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
});

/// What later stages rely on.
fn check(case: &Case) {
    case.validate().expect("a case that was read holds its rules");
    for purpose in [Purpose::Modes, Purpose::Condense, Purpose::Frf, Purpose::Run, Purpose::Chart, Purpose::Bearing] {
        let _ = case.ready_for(purpose);
    }
    assert!(case.target() > 0.0);
    let _ = (case.ball_mass(), case.band_hz(), case.name());
    serde_json::to_string(case).expect("a case can be written");
}
