//! Ranks that solve a problem together, each with a [share](crate::share::Share) of its volume.
//!
//! All ranks run the same program on the same model and decide from reduced values, so
//! that they decide alike. Every function here is collective: all ranks call it, in the same
//! order. A reduction adds in the order of the ranks and has the same bits on all.

mod gathered;
mod together;

use std::fmt::Debug;

pub use gathered::Gathered;
pub use together::Together;

/// The ranks of a run, as one of them sees them.
pub trait Team: Debug + Send + Sync {
    /// Number of this rank, from 0.
    fn rank(&self) -> usize;

    /// Number of ranks.
    fn size(&self) -> usize;

    /// Gathers the bytes of every rank, in the order of the ranks; all ranks receive equal lists.
    fn gather(&self, own: &[u8]) -> Vec<Vec<u8>>;

    /// Gives every rank what is meant for it, and returns what came from each.
    fn exchange(&self, parcels: Vec<Vec<f64>>) -> Vec<Vec<f64>>;

    /// Replaces values by their sums over all ranks.
    fn sum(&self, values: &mut [f64]);

    /// Replaces values by the largest ones of all ranks; not-a-number wins.
    fn largest(&self, values: &mut [f64]);
}

/// A rank that is alone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Alone;

impl Team for Alone {
    fn rank(&self) -> usize {
        0
    }

    fn size(&self) -> usize {
        1
    }

    fn gather(&self, own: &[u8]) -> Vec<Vec<u8>> {
        vec![own.to_vec()]
    }

    fn exchange(&self, parcels: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
        parcels
    }

    fn sum(&self, _: &mut [f64]) {}

    fn largest(&self, _: &mut [f64]) {}
}
