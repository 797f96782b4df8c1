//! Random numbers of a scene: the same seed gives the same scene everywhere.
//!
//! SplitMix64, the state going up by the odd constant `2^64/golden ratio` and mixed
//! on the way out. Source: Steele, Lea & Flood (2014), "Fast splittable pseudorandom
//! number generators", OOPSLA, doi:10.1145/2660193.2660195.

use std::ops::RangeInclusive;

/// A sequence of random numbers.
#[derive(Clone, Debug)]
pub struct Random {
    state: u64,
}

impl Random {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform in `[0, 1)`.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform between two numbers.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Between two positive numbers, all decades alike.
    pub fn decade(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    /// A whole number of a range.
    pub fn whole(&mut self, range: RangeInclusive<usize>) -> usize {
        let (low, high) = (*range.start(), *range.end());
        low + (self.unit() * (high - low + 1) as f64) as usize
    }

    /// True with the given probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    /// One of several values, all with the same probability.
    pub fn one_of<T: Copy>(&mut self, values: &[T]) -> T {
        values[self.whole(0..=values.len() - 1)]
    }

    /// One of two signs.
    pub fn sign(&mut self) -> f64 {
        self.one_of(&[-1.0, 1.0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sequence_is_the_published_one() {
        // First numbers of the reference implementation for the seed 1234567.
        let mut random = Random::new(1_234_567);
        let found: Vec<u64> = (0..3).map(|_| random.bits()).collect();
        let expected = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn numbers_stay_in_their_ranges() {
        let mut random = Random::new(5);
        for _ in 0..1000 {
            assert!((2..=4).contains(&random.whole(2..=4)));
            assert!((1e-4..1e4).contains(&random.decade(1e-4, 1e4)));
        }
    }
}
