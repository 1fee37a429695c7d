//! Random numbers by counter: what the stream of a seed and a place gives, whoever asks first.
//!
//! Philox-4x32-10 of J. K. Salmon, M. A. Moraes, R. O. Dror and D. E. Shaw, "Parallel random numbers: as easy as 1, 2, 3" (SC11): a block
//! of numbers is a function of key and counter alone. Distributions are here too, since those of a crate may change with its version.

use std::f64::consts::TAU;

const MULTIPLIERS: [u64; 2] = [0xd251_1f53, 0xcd9e_8d57];
const WEYL: [u32; 2] = [0x9e37_79b9, 0xbb67_ae85];
const ROUNDS: usize = 10;

/// Words of a block.
const WORDS: usize = 4;

fn philox(mut counter: [u32; WORDS], mut key: [u32; 2]) -> [u32; WORDS] {
    for _ in 0..ROUNDS {
        let [a, b] = [MULTIPLIERS[0] * u64::from(counter[0]), MULTIPLIERS[1] * u64::from(counter[2])];
        let ([high_a, high_b], [low_a, low_b]) = ([a, b].map(|x| (x >> 32) as u32), [a, b].map(|x| x as u32));
        counter = [high_b ^ counter[1] ^ key[0], low_b, high_a ^ counter[3] ^ key[1], low_a];
        key = [key[0].wrapping_add(WEYL[0]), key[1].wrapping_add(WEYL[1])];
    }
    counter
}

/// The numbers of one place: of a seed, three words that say what they are for, and their order.
#[derive(Debug, Clone)]
pub(crate) struct Stream {
    key: [u32; 2],
    place: [u32; 3],
    block: u32,
    left: Vec<u32>,
    /// The second of a pair of normal numbers.
    normal: Option<f64>,
}

impl Stream {
    pub(crate) fn new(seed: u64, place: [u32; 3]) -> Self {
        Self { key: [seed as u32, (seed >> 32) as u32], place, block: 0, left: Vec::new(), normal: None }
    }

    fn word(&mut self) -> u32 {
        if let Some(word) = self.left.pop() {
            return word;
        }
        let [a, b, c] = self.place;
        let [first, rest @ ..] = philox([self.block, a, b, c], self.key);
        // 64 GB of numbers are more than any place takes
        self.block = self.block.wrapping_add(1);
        self.left.extend(rest.iter().rev());
        first
    }

    /// Evenly distributed from 0 to below 1, 53 bits.
    pub(crate) fn unit(&mut self) -> f64 {
        let high = u64::from(self.word()) << 32;
        ((high | u64::from(self.word())) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Normal of mean 0 and standard deviation 1 (G. E. P. Box and M. E. Muller, 1958).
    pub(crate) fn normal(&mut self) -> f64 {
        if let Some(second) = self.normal.take() {
            return second;
        }
        // from above 0 to 1
        let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        let (sin, cos) = (TAU * self.unit()).sin_cos();
        self.normal = Some(radius * sin);
        radius * cos
    }
}

#[cfg(test)]
mod tests {
    use super::{Stream, philox};

    /// `kat_vectors` of Random123 1.09, the authors' own.
    #[test]
    fn blocks_are_those_of_the_authors() {
        assert_eq!(philox([0; 4], [0; 2]), [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]);
        assert_eq!(philox([u32::MAX; 4], [u32::MAX; 2]), [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]);
        let counter = [0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344];
        let block = [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1];
        assert_eq!(philox(counter, [0xa409_3822, 0x299f_31d0]), block);
    }

    #[test]
    fn moments_are_those_of_the_distributions() {
        let mut stream = Stream::new(7, [1, 2, 3]);
        let normal: Vec<f64> = (0..100_000).map(|_| stream.normal()).collect();
        let moment = |power: i32| normal.iter().map(|x| x.powi(power)).sum::<f64>() / normal.len() as f64;
        // standard errors 0.003, 0.0045, 0.012 and 0.03
        assert!(moment(1).abs() < 0.015 && (moment(2) - 1.0).abs() < 0.02, "{} {}", moment(1), moment(2));
        assert!(moment(3).abs() < 0.06 && (moment(4) - 3.0).abs() < 0.15, "{} {}", moment(3), moment(4));
        let uniform: Vec<f64> = (0..100_000).map(|_| stream.unit()).collect();
        let mean = uniform.iter().sum::<f64>() / uniform.len() as f64;
        assert!((mean - 0.5).abs() < 0.005 && uniform.iter().all(|x| (0.0..1.0).contains(x)), "{mean}");
    }

    #[test]
    fn places_do_not_share_numbers() {
        let first = |seed, place| Stream::new(seed, place).unit().to_bits();
        let places = [first(1, [0, 0, 0]), first(2, [0, 0, 0]), first(1 << 32, [0, 0, 0]), first(1, [1, 0, 0])];
        let more = [first(1, [0, 1, 0]), first(1, [0, 0, 1])];
        let mut all = [&places[..], &more[..], &[first(0, [0, 0, 0])]].concat();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), 7);
    }
}
