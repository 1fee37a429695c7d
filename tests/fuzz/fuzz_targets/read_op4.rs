//! Any bytes as Nastran OUTPUT4: an error with a message or matrices whose entries lie inside them, never a panic.

#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use plummer::formats::op4_from_bytes;

fuzz_target!(|bytes: &[u8]| {
    match op4_from_bytes(bytes, Path::new("fuzz.op4")) {
        Ok(matrices) => {
            for matrix in &matrices {
                let (rows, columns) = matrix.shape();
                assert!(matrix.entries().all(|(row, column, _)| row < rows && column < columns));
            }
        }
        Err(error) => assert!((1..1000).contains(&error.to_string().len())),
    }
});
