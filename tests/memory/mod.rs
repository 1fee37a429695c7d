//! What tests of the memory that a reader takes have in common: an allocator's peak, and files damaged at random.

use peak_alloc::PeakAlloc;

/// Bytes that were allocated meanwhile, at most.
pub fn peak(allocator: &PeakAlloc, read: impl FnOnce()) -> usize {
    let before = allocator.current_usage();
    allocator.reset_peak_usage();
    read();
    allocator.peak_usage().saturating_sub(before)
}

/// A linear congruential sequence (Knuth's MMIX), so that failures repeat.
pub struct Random(pub u64);

impl Random {
    /// The next number.
    pub fn next(&mut self) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize
    }

    /// A file with one to four bytes changed, to one of two or to any; `place` chooses where.
    pub fn damaged(&mut self, whole: &[u8], likely: [u8; 2], mut place: impl FnMut(&mut Self) -> usize) -> Vec<u8> {
        let mut bytes = whole.to_vec();
        for _ in 0..1 + self.next() % 4 {
            let place = place(self);
            bytes[place] = [likely[0], likely[1], self.next() as u8][self.next() % 3];
        }
        bytes
    }
}
