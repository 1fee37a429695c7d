//! Signals in a sound file.
//!
//! The crate `hound` 3.5.1 does not read what our tests hold: it refuses doubles, and files with a part of odd length. Of 24 bits
//! in words of 32 it takes the lower bytes, where the format has the upper ones.

use std::path::Path;
use std::rc::Rc;

use super::channel::{Channel, Clock, choose};
use super::{MeasuredError, SignalRequest};
use crate::files::bytes_of;
use crate::formats::bytes::{ByteOrder, NumberType};

/// Format tags.
const PCM: u16 = 1;
const FLOAT: u16 = 3;
/// The tag is in a longer head, first in an identifier of 16 bytes that ends like this.
const EXTENSIBLE: u16 = 0xfffe;
const IDENTIFIER_END: [u8; 14] = [0, 0, 0, 0, 0x10, 0, 0x80, 0, 0, 0xaa, 0, 0x38, 0x9b, 0x71];

/// Reads the wanted channels of a RIFF WAVE file, full scale 1. Source: IBM and Microsoft, "Multimedia Programming Interface and
/// Data Specifications 1.0" (1991); extensible heads: Microsoft, "Multiple channel audio data and WAVE files" (2007).
pub(super) fn read(path: &Path, request: &SignalRequest) -> Result<Vec<Channel>, MeasuredError> {
    let bytes = bytes_of(path)?;
    let fault = |found: String| {
        const EXPECTED: &str = "a sound file (RIFF WAVE, PCM of 8 to 32 bits, float of 32 or 64)";
        MeasuredError::refused(format!("{}: expected {EXPECTED}, found: {found}", path.display()))
    };
    let (format, data) = parts(&bytes).map_err(fault)?;
    let names: Vec<String> = (1..=format.channels).map(|n| format!("channel {n}")).collect();
    let wanted = choose(path, &names, request)?;
    let Format { decode, width, .. } = format;
    let clock = Rc::new(Clock::Even { start_s: 0.0, step_s: 1.0 / f64::from(format.rate_hz) });
    let made = wanted.into_iter().map(|place| Channel {
        name: names[place].clone(),
        unit: "full scale".to_owned(),
        values: data
            .chunks_exact(width * format.channels)
            .map(|frame| decode(&frame[place * width..][..width]))
            .collect(),
        clock: Rc::clone(&clock),
        speed_hz: None,
        doubts: Vec::new(),
    });
    Ok(made.collect())
}

/// A sample of the bytes that it has, full scale 1.
type Decode = fn(&[u8]) -> f64;

/// How samples are written.
fn decode(tag: u16, bits: u16) -> Option<Decode> {
    match (tag, bits) {
        (PCM, 8) => Some(|bytes| (f64::from(bytes[0]) - 128.0) / 128.0),
        // an integer's bytes as the upper ones of 32 bits: full scale is 2^31 for all depths
        (PCM, 16 | 24 | 32) => Some(|bytes| {
            let mut word = [0; 4];
            word[4 - bytes.len()..].copy_from_slice(bytes);
            f64::from(i32::from_le_bytes(word)) / 2_f64.powi(31)
        }),
        (FLOAT, 32) => Some(|bytes| NumberType::F32.value(bytes, ByteOrder::Little)),
        (FLOAT, 64) => Some(|bytes| NumberType::F64.value(bytes, ByteOrder::Little)),
        _ => None,
    }
}

/// What the head says.
struct Format {
    decode: Decode,
    /// Bytes a sample.
    width: usize,
    channels: usize,
    rate_hz: u32,
}

/// The first four bytes as a number; of fewer those that there are.
fn word(bytes: &[u8]) -> u32 {
    ByteOrder::Little.u32(bytes)
}

fn half_word(bytes: &[u8]) -> u16 {
    (word(bytes) & 0xffff) as u16
}

/// Format and samples of a file, or what was found in their place.
fn parts(bytes: &[u8]) -> Result<(Format, &[u8]), String> {
    let is_wave = bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WAVE");
    let mut rest = bytes.get(12..).filter(|_| is_wave);
    let mut format = None;
    loop {
        let Some((head, after)) = rest.and_then(|rest| rest.split_at_checked(8)) else {
            return Err(match (is_wave, &format) {
                (false, _) => "no RIFF WAVE head".to_owned(),
                (true, None) => "no format".to_owned(),
                (true, Some(_)) => "no samples".to_owned(),
            });
        };
        let size = word(&head[4..]) as usize;
        let missing = || format!("a part of {size} bytes, of which {} are there", after.len());
        let body = after.get(..size).ok_or_else(missing)?;
        match &head[..4] {
            b"fmt " => format = Some(format_of(body)?),
            b"data" => {
                let format = format.ok_or("samples before their format")?;
                let frame = format.width * format.channels;
                return match body.len().is_multiple_of(frame) {
                    true => Ok((format, body)),
                    false => Err(format!("{size} bytes of samples, {frame} at each instant")),
                };
            }
            _ => {}
        }
        // parts begin at even places
        rest = after.get(size + size % 2..);
    }
}

fn format_of(body: &[u8]) -> Result<Format, String> {
    let at = |place: usize| half_word(body.get(place..).unwrap_or_default());
    let (channels, rate_hz) = (at(2), word(body.get(4..).unwrap_or_default()));
    let (align, bits) = (at(12), at(14));
    let tag = match at(0) {
        EXTENSIBLE if body.get(26..40) == Some(&IDENTIFIER_END) => at(24),
        tag => tag,
    };
    if rate_hz == 0 || channels == 0 {
        return Err(format!("{rate_hz} Hz and {channels} channels"));
    }
    let (width, channels) = (usize::from(bits) / 8, usize::from(channels));
    let decode = decode(tag, bits).filter(|_| usize::from(align) == width * channels);
    let decode = decode.ok_or_else(|| format!("format {tag} of {bits} bits, {align} bytes for {channels} channels"))?;
    Ok(Format { decode, width, channels, rate_hz })
}
