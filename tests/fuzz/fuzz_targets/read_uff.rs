//! Any bytes as a universal file, by each of its readers: an error with a message or data that fit together.

#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use plummer::formats::uff::{modes_from_bytes, responses_from_bytes, times_from_bytes};

fuzz_target!(|bytes: &[u8]| {
    let path = Path::new("fuzz.uff");
    match modes_from_bytes(bytes, path) {
        Ok(modes) => modes.check().expect("shapes that were read fit together"),
        Err(error) => assert!((1..1000).contains(&error.to_string().len())),
    }
    match responses_from_bytes(bytes, path) {
        Ok(responses) => {
            for response in responses {
                response.check().expect("a response that was read is one");
            }
        }
        Err(error) => assert!((1..1000).contains(&error.to_string().len())),
    }
    if let Err(error) = times_from_bytes(bytes, path) {
        assert!((1..1000).contains(&error.to_string().len()));
    }
});
