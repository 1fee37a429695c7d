//! Sound files: depths, heads, parts, damage.

use std::fs;
use std::path::Path;

use super::tests::{assert_samples, only, request, samples};
use super::{MeasuredError, read_signals};

#[test]
fn sound_files_are_read_in_every_depth() {
    let folder = tempfile::tempdir().unwrap();
    let values: Vec<f64> = (0..100).map(|k| 0.9 * (0.3 * f64::from(k)).sin()).collect();
    let write = |name: &str, bits: u16, format: hound::SampleFormat| {
        let path = folder.path().join(name);
        let spec = hound::WavSpec { channels: 2, sample_rate: 44_100, bits_per_sample: bits, sample_format: format };
        let mut to = hound::WavWriter::create(&path, spec).unwrap();
        for value in &values {
            match format {
                hound::SampleFormat::Float => {
                    to.write_sample(0.0_f32).unwrap();
                    to.write_sample(*value as f32).unwrap();
                }
                hound::SampleFormat::Int => {
                    to.write_sample(0_i32).unwrap();
                    let full = f64::from(bits - 1).exp2();
                    to.write_sample((value * full).round() as i32).unwrap();
                }
            }
        }
        to.finalize().unwrap();
        path
    };
    for (name, bits, format) in [
        ("8.wav", 8, hound::SampleFormat::Int),
        ("16.wav", 16, hound::SampleFormat::Int),
        ("24.wav", 24, hound::SampleFormat::Int),
        ("32-int.wav", 32, hound::SampleFormat::Int),
        ("32.WAV", 32, hound::SampleFormat::Float),
    ] {
        let path = write(name, bits, format);
        let found = only(read_signals(&path, &request(&["channel 2"], None)).unwrap());
        assert_eq!(found.series.unit(), "full scale");
        // half a step of the depth; a float has 24 bits
        let part = (-f64::from(bits.min(24) - 1)).exp2();
        assert_samples(&found, 0.0, 1.0 / 44_100.0, &values, part);
        let error = read_signals(&path, &request(&[], None)).unwrap_err();
        assert!(
            error.to_string().ends_with("expected one signal or the name of one, found \"channel 1\", \"channel 2\"")
        );
    }
    // half a file, and a head that promises 4 GiB
    let mut bytes = fs::read(folder.path().join("16.wav")).unwrap();
    bytes.truncate(200);
    let path = folder.path().join("cut.wav");
    fs::write(&path, &bytes).unwrap();
    let error = read_signals(&path, &request(&["channel 1"], None)).unwrap_err();
    assert!(matches!(error, MeasuredError::Refused { .. }), "{error}");
    let size = bytes.windows(4).position(|word| word == b"data").unwrap() + 4;
    bytes[size..size + 4].copy_from_slice(&[0xfc, 0xff, 0xff, 0xff]);
    fs::write(&path, &bytes).unwrap();
    let error = read_signals(&path, &request(&["channel 1"], None)).unwrap_err();
    assert!(matches!(error, MeasuredError::Refused { .. }), "{error}");
}

#[test]
fn doubles_of_a_sound_file_keep_their_digits() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/wav/float64.wav");
    let both = read_signals(&path, &request(&["channel 2", "channel 1"], None)).unwrap();
    // NumPy's sine differs in the last digit at most
    assert_samples(&both[1], 0.0, 1.0 / 48e3, &samples(12), 1e-15);
    let above_one = 1.0 + (-40_f64).exp2();
    assert_samples(&both[0], 0.0, 1.0 / 48e3, &[above_one; 12], 0.0);
}

/// A sound file of one part after another, each with its name.
fn sound(parts: &[(&[u8; 4], &[u8])]) -> Vec<u8> {
    let mut bytes = b"RIFF\0\0\0\0WAVE".to_vec();
    for (name, body) in parts {
        bytes.extend_from_slice(*name);
        bytes.extend_from_slice(&(body.len() as u32).to_le_bytes());
        bytes.extend_from_slice(body);
        bytes.resize(bytes.len().next_multiple_of(2), 0);
    }
    bytes
}

/// The head of a format: tag, channels, 8 kHz, bytes an instant, bits.
fn sound_head(tag: u16, channels: u16, align: u16, bits: u16) -> Vec<u8> {
    let words = [tag, channels, 8000, 0, 0, 0, align, bits];
    words.into_iter().flat_map(u16::to_le_bytes).collect()
}

#[test]
fn sound_files_with_other_parts_and_longer_heads_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.wav");
    let read = |bytes: &[u8]| {
        fs::write(&path, bytes).unwrap();
        let found = read_signals(&path, &request(&[], None));
        found.map_err(|error| error.to_string())
    };
    // 24 bits left-justified in 32, behind a part of odd length
    let mut head = sound_head(0xfffe, 1, 4, 32);
    head.extend([22, 0, 24, 0, 0, 0, 0, 0, 1, 0]);
    head.extend([0, 0, 0, 0, 0x10, 0, 0x80, 0, 0, 0xaa, 0, 0x38, 0x9b, 0x71]);
    let samples = [0, 0, 0, 0x80, 0, 0, 0, 0x40];
    let found = read(&sound(&[(b"LIST", b"odd"), (b"fmt ", &head), (b"data", &samples)]));
    assert_samples(&only(found.unwrap()), 0.0, 1.0 / 8e3, &[-1.0, 0.5], 0.0);
    let pcm = sound_head(1, 2, 4, 16);
    for (bytes, found) in [
        (b"RIFX".to_vec(), "no RIFF WAVE head"),
        (sound(&[]), "no format"),
        (sound(&[(b"fmt ", &pcm)]), "no samples"),
        (sound(&[(b"data", &[0; 4])]), "samples before their format"),
        (sound(&[(b"fmt ", &pcm), (b"data", &[0; 6])]), "6 bytes of samples, 4 at each instant"),
        (sound(&[(b"fmt ", &sound_head(2, 2, 1, 4)), (b"data", &[])]), "format 2 of 4 bits, 1 bytes for 2 channels"),
        (sound(&[(b"fmt ", &sound_head(1, 1, 4, 24)), (b"data", &[])]), "format 1 of 24 bits, 4 bytes for 1 channels"),
        (sound(&[(b"fmt ", &sound_head(1, 0, 0, 16))]), "8000 Hz and 0 channels"),
    ] {
        let error = read(&bytes).unwrap_err();
        let expected = format!(
            "{}: expected a sound file (RIFF WAVE, PCM of 8 to 32 bits, float of 32 or 64), found: {found}",
            path.display()
        );
        assert_eq!(error, expected);
    }
}
