//! What the program does when things go wrong around it: damaged cases, a full disk, folders that refuse, files that change,
//! files that mean harm, an end at any moment.
//!
//! Each test runs the program as a user would. The short forms run with the others; the long ones are ignored unless asked for
//! (`docs/robustness.md` says what they printed):
//!
//!     cargo test --release --test robustness -- --ignored --nocapture --test-threads 1

mod attacks;
mod bodies;
mod disk;
mod doubled;
mod folded;
mod grids;
mod impossible;
mod kills;
mod layers;
mod limits;
mod mesh;
mod mode_counts;
mod mutations;
mod neighbours;
mod orders;
mod plates;
#[path = "../program/common.rs"]
mod program;
mod relations;
mod relations_run;
mod replaced;
mod signals;
mod ties;
mod trapezoids;
mod turned;
mod untrusted;

use std::process::{Child, ExitStatus};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Random numbers that are the same everywhere: SplitMix64 (Steele, Lea and Flood 2014).
pub struct Dice(pub u64);

impl Dice {
    /// The next one.
    pub fn number(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// From 0 to below 1.
    pub fn fraction(&mut self) -> f64 {
        (self.number() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Below `end`, which is not 0.
    pub fn below(&mut self, end: usize) -> usize {
        (self.number() % end as u64) as usize
    }

    /// One of several.
    pub fn of<'a, T>(&mut self, items: &'a [T]) -> &'a T {
        &items[self.below(items.len())]
    }
}

/// Rounds of a long test: `PLUMMER_ROUNDS`, or this.
pub fn rounds(default: usize) -> usize {
    setting("PLUMMER_ROUNDS", default as u64) as usize
}

/// A whole number of the environment, or this.
pub fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |text| text.parse().unwrap())
}

/// Waits so long for a process; `None`: it was still running, and is killed.
pub fn ended_within(child: &mut Child, limit: Duration) -> Option<ExitStatus> {
    let begun = Instant::now();
    loop {
        if let Some(status) = child.try_wait().unwrap() {
            return Some(status);
        }
        if begun.elapsed() > limit {
            child.kill().unwrap();
            child.wait().unwrap();
            return None;
        }
        sleep(Duration::from_millis(2));
    }
}
