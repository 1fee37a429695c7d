//! Any bytes as a NumPy archive, by each of its readers: an error with a message or arrays of the stated shape.

#![no_main]

use std::path::PathBuf;

use libfuzzer_sys::fuzz_target;
use plummer::formats::{NpzReader, SignalRequest, read_modes_npz, read_signals, read_superelement_npz};

fuzz_target!(|bytes: &[u8]| {
    let path = file();
    std::fs::write(&path, bytes).expect("the folder for temporary files can be written");
    if let Ok(mut reader) = NpzReader::open(&path) {
        for name in reader.names() {
            if let Ok(values) = reader.real(&name) {
                assert_eq!(values.values.len(), values.shape.iter().product::<usize>());
            }
            let _ = (reader.whole(&name), reader.texts(&name));
        }
    }
    if let Ok(modes) = read_modes_npz(&path) {
        modes.check().expect("shapes that were read fit together");
    }
    let _ = read_superelement_npz(&path);
    let _ = read_signals(&path, &SignalRequest::default());
});

/// A file of this process's own, in memory where the system has a folder for that.
fn file() -> PathBuf {
    let memory = PathBuf::from("/dev/shm");
    let folder = if memory.is_dir() { memory } else { std::env::temp_dir() };
    folder.join(format!("plummer-fuzz-{}.npz", std::process::id()))
}
