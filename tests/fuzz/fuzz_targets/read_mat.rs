//! Any bytes as a MATLAB file: an error with a message, or signals that can be read.

#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use plummer::formats::measured::signals_from_mat;
use plummer::formats::{MeasuredError, SignalRequest};

fuzz_target!(|bytes: &[u8]| {
    let path = Path::new("fuzz.mat");
    for rate_hz in [None, Some(1e3)] {
        let mut request = SignalRequest { channels: Vec::new(), rate_hz };
        let known = match signals_from_mat(bytes, path, &request) {
            Err(MeasuredError::Choose { known, .. }) => known,
            Err(error) => return assert!(!error.to_string().is_empty()),
            Ok(_) => continue,
        };
        for name in known.into_iter().take(20) {
            request.channels = vec![name];
            if let Err(error) = signals_from_mat(bytes, path, &request) {
                assert!(!error.to_string().is_empty());
            }
        }
    }
});
