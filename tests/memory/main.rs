//! Memory that readers and runs take, under an allocator that counts for the whole process: each test holds [`alone`].

mod mat;
mod mesh;
mod npz;
mod op4;
mod run;

use std::sync::{Mutex, MutexGuard, PoisonError};

use peak_alloc::PeakAlloc;

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// What keeps the other tests of this process from allocating while it lives.
fn alone() -> MutexGuard<'static, ()> {
    static ONE: Mutex<()> = Mutex::new(());
    ONE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Bytes that were allocated meanwhile, at most.
fn peak(read: impl FnOnce()) -> usize {
    let before = ALLOCATOR.current_usage();
    ALLOCATOR.reset_peak_usage();
    read();
    ALLOCATOR.peak_usage().saturating_sub(before)
}

/// A linear congruential sequence (Knuth's MMIX), so that failures repeat.
struct Random(u64);

impl Random {
    /// The next number.
    fn next(&mut self) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize
    }

    /// A file with one to four bytes changed, to one of two or to any; `place` chooses where.
    fn damaged(&mut self, whole: &[u8], likely: [u8; 2], mut place: impl FnMut(&mut Self) -> usize) -> Vec<u8> {
        let mut bytes = whole.to_vec();
        for _ in 0..1 + self.next() % 4 {
            let place = place(self);
            bytes[place] = [likely[0], likely[1], self.next() as u8][self.next() % 3];
        }
        bytes
    }
}
