//! Sizes of what neighbours differ by from the increment and from each other.

use striae_mesh::Vec3;

use crate::{layout::Layout, problem::Problem, state::State};

/// Part of positions and tractions below which a correction is round-off.
const ROUND_OFF: f64 = 1e-11;

/// Largest components of a difference: of positions, and of everything else.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Size([f64; 2]);

impl Size {
    /// Differences of positions.
    pub(super) fn between(one: &[Vec3], other: &[Vec3]) -> Self {
        let differences = one
            .iter()
            .zip(other)
            .map(|(one, other)| (one - other).amax());
        Self([differences.fold(0.0, f64::max), 0.0])
    }

    /// Components of a correction.
    pub(super) fn of(correction: &[f64], problem: &Problem, layout: &Layout) -> Self {
        let mut is_position = vec![false; correction.len()];
        for node in problem.global_nodes() {
            let first = layout.position(node);
            is_position[first..first + 3].fill(true);
        }
        let mut size = [0.0_f64; 2];
        for (is_position, value) in is_position.iter().zip(correction) {
            let of = &mut size[usize::from(!is_position)];
            *of = of.max(value.abs());
        }
        Self(size)
    }

    /// Corrections that are round-off of the state an increment has come to.
    pub(super) fn round_off(state: &State) -> Self {
        let positions = state.positions.iter().map(|x| x.amax());
        let pairs = state.pairs.iter();
        let unknowns = pairs.flat_map(|pair| pair.tractions.nodes.iter().flatten().flatten());
        let largest = [
            positions.fold(0.0, f64::max),
            unknowns.fold(0.0, |largest: f64, value| largest.max(value.abs())),
        ];
        Self(largest.map(|largest| ROUND_OFF * largest))
    }

    /// The larger components of both.
    pub(super) fn max(&self, other: &Self) -> Self {
        Self([0, 1].map(|at| self.0[at].max(other.0[at])))
    }

    /// Without what does not exceed another one.
    pub(super) fn beyond(&self, other: &Self) -> Self {
        let beyond = |at: usize| Some(self.0[at]).filter(|size| *size > other.0[at]);
        Self([0, 1].map(|at| beyond(at).unwrap_or(0.0)))
    }

    /// The largest of its shares in another one.
    pub(super) fn over(&self, first: &Self) -> f64 {
        let shares = self.0.iter().zip(first.0);
        let share = |(size, first): (&f64, f64)| if first > 0.0 { size / first } else { 0.0 };
        shares.map(share).fold(0.0, f64::max)
    }
}
