//! Damaged files: an error or a mesh, never a panic, and never an index that leads outside.

use super::encode::{Layout, binary};
use super::{SMALL, read};

/// What later stages rely on, whatever the file held.
fn is_sound(bytes: &[u8]) -> bool {
    match read(bytes) {
        Err(message) => !message.is_empty() && message.len() < 1000,
        Ok(mesh) => {
            let nodes = mesh.nodes.len();
            let groups_inside = mesh.groups.iter().all(|group| {
                group.nodes.iter().all(|&node| node < nodes)
                    && group.nodes.is_sorted()
                    && group
                        .elements
                        .iter()
                        .all(|id| mesh.blocks.get(id.block).is_some_and(|b| b.element(id.index).is_some()))
            });
            let blocks_inside = mesh.blocks.iter().all(|block| {
                block.connectivity.iter().all(|&node| node < nodes)
                    && block.connectivity.len() == block.len() * block.kind.nodes()
            });
            let finite = mesh.nodes.iter().flatten().all(|x| x.is_finite());
            groups_inside && blocks_inside && finite && mesh.node_tags.len() == nodes
        }
    }
}

fn encodings() -> Result<Vec<Vec<u8>>, String> {
    let mut all = vec![SMALL.as_bytes().to_vec()];
    for big_endian in [false, true] {
        for size_bytes in [4, 8] {
            all.push(binary(SMALL, Layout { big_endian, size_bytes })?);
        }
    }
    Ok(all)
}

/// Knuth's linear congruential generator (MMIX): the same damage in every run.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % limit
    }
}

#[test]
fn cut_anywhere() -> Result<(), String> {
    for bytes in encodings()? {
        // the last byte is a line end that nobody needs
        for length in 0..bytes.len() - 1 {
            let message = read(&bytes[..length]);
            assert!(message.is_err(), "cut to {length} of {} bytes is accepted", bytes.len());
        }
    }
    Ok(())
}

#[test]
fn every_byte_replaced() -> Result<(), String> {
    for bytes in encodings()? {
        for position in 0..bytes.len() {
            for value in [0, 1, b' ', b'\n', b'-', b'9', b'$', 0x7f, 0x80, 0xff] {
                let mut damaged = bytes.clone();
                damaged[position] = value;
                assert!(is_sound(&damaged), "byte {position} replaced by {value}");
            }
        }
    }
    Ok(())
}

#[test]
fn random_damage() -> Result<(), String> {
    let mut random = Random(1);
    for bytes in encodings()? {
        for run in 0..4000 {
            let mut damaged = bytes.clone();
            for _ in 0..=random.below(4) {
                let position = random.below(damaged.len());
                match random.below(4) {
                    0 => damaged[position] ^= 1 << random.below(8),
                    1 => damaged[position] = random.below(256) as u8,
                    2 => drop(damaged.remove(position)),
                    _ => damaged.insert(position, random.below(256) as u8),
                }
            }
            assert!(is_sound(&damaged), "run {run}");
        }
    }
    Ok(())
}

/// Whole numbers replaced by the largest ones: counts that would fill the memory.
#[test]
fn every_number_made_huge() -> Result<(), String> {
    let words: Vec<&str> = SMALL.split_inclusive(char::is_whitespace).collect();
    for huge in ["18446744073709551615", "9223372036854775807", "4294967296", "2147483647", "99999"] {
        for position in 0..words.len() {
            let mut damaged = words.clone();
            let replaced = format!("{huge}{}", if words[position].ends_with('\n') { "\n" } else { " " });
            damaged[position] = &replaced;
            assert!(is_sound(damaged.concat().as_bytes()), "word {position} replaced by {huge}");
        }
    }
    let layout = Layout { big_endian: false, size_bytes: 8 };
    let bytes = binary(SMALL, layout)?;
    for position in 0..bytes.len() - 8 {
        for huge in [u64::MAX, i64::MAX as u64, 1 << 40, i32::MAX as u64] {
            let mut damaged = bytes.clone();
            damaged[position..position + 8].copy_from_slice(&huge.to_le_bytes());
            assert!(is_sound(&damaged), "8 bytes at {position} replaced by {huge}");
        }
    }
    Ok(())
}
