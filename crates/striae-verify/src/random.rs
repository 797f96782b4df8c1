//! Reproducible random numbers, vectors and rotations.
//!
//! The generator is `SplitMix64` (Steele, Lea & Flood 2014,
//! doi:10.1145/2660193.2660195): the same seed gives the same numbers on
//! every machine.

use nalgebra::{DVector, Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

/// A reproducible stream of random numbers.
#[derive(Clone, Debug)]
pub struct Random {
    state: u64,
}

impl Random {
    /// The stream that belongs to a seed.
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// A number uniform in `low..high`.
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        let fraction = (self.next_bits() >> 11) as f64 / (1u64 << 53) as f64;
        low + (high - low) * fraction
    }

    /// A normally distributed number of mean 0 and variance 1.
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform(0.0, 1.0)).ln()).sqrt();
        radius * self.uniform(0.0, std::f64::consts::TAU).cos()
    }

    /// A vector with components uniform in `-1..1`.
    pub fn vector3(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.uniform(-1.0, 1.0))
    }

    /// A unit vector, uniform on the sphere.
    pub fn unit3(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.normal()).normalize()
    }

    /// A unit vector of `n` components, uniform on the sphere.
    pub fn unit(&mut self, n: usize) -> DVector<f64> {
        DVector::from_fn(n, |_, _| self.normal()).normalize()
    }

    /// A rotation, uniform over all rotations.
    pub fn rotation(&mut self) -> Rotation3<f64> {
        let q = Quaternion::new(self.normal(), self.normal(), self.normal(), self.normal());
        UnitQuaternion::from_quaternion(q).to_rotation_matrix()
    }

    /// The identity with components disturbed by at most `amplitude`; the
    /// determinant stays positive for amplitudes below one third.
    pub fn near_identity(&mut self, amplitude: f64) -> Matrix3<f64> {
        Matrix3::identity() + Matrix3::from_fn(|_, _| self.uniform(-amplitude, amplitude))
    }

    fn next_bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_are_reproducible_and_differ_by_seed() {
        let draw = |seed| Random::new(seed).vector3();
        assert_eq!(draw(1), draw(1));
        assert_ne!(draw(1), draw(2));
    }

    #[test]
    fn moments_are_those_of_the_distributions() {
        let mut random = Random::new(3);
        let count = 20_000;
        let uniform: f64 = (0..count).map(|_| random.uniform(2.0, 4.0)).sum();
        let square: f64 = (0..count).map(|_| random.normal().powi(2)).sum();
        assert!((uniform / f64::from(count) - 3.0).abs() < 0.02);
        assert!((square / f64::from(count) - 1.0).abs() < 0.05);
    }

    #[test]
    fn rotations_are_proper_and_orthogonal() {
        let mut random = Random::new(4);
        for _ in 0..100 {
            let q = *random.rotation().matrix();
            assert!((q * q.transpose() - Matrix3::identity()).norm() < 1e-14);
            assert!((q.determinant() - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn disturbed_identities_keep_their_orientation() {
        let mut random = Random::new(5);
        assert!((0..1000).all(|_| random.near_identity(0.33).determinant() > 0.0));
    }
}
