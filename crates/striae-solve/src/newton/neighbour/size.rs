//! Sizes of what neighbours differ by from the increment and from each other.

use striae_mesh::Vec3;

use crate::{layout::Layout, problem::Problem, state::State};

/// Part of what is corrected below which a correction is round-off.
const ROUND_OFF: f64 = 1e-11;

/// Kinds of unknowns, of one unit each: positions and displacements of rigid bodies, rotations of
/// these, and tractions with the pressures of cavities.
const POSITION: usize = 0;
const ROTATION: usize = 1;
const STRESS: usize = 2;

/// Largest components of a difference, by kind.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Size([f64; 3]);

impl Size {
    /// Differences of positions.
    pub(super) fn between(one: &[Vec3], other: &[Vec3]) -> Self {
        let differences = one
            .iter()
            .zip(other)
            .map(|(one, other)| (one - other).amax());
        Self([differences.fold(0.0, f64::max), 0.0, 0.0])
    }

    /// Components of a correction.
    pub(super) fn of(correction: &[f64], problem: &Problem, layout: &Layout) -> Self {
        let mut kinds = vec![STRESS; correction.len()];
        for node in problem.global_nodes() {
            let first = layout.position(node);
            kinds[first..first + 3].fill(POSITION);
        }
        for first in (0..problem.tied.len()).filter_map(|rigid| layout.rigid(rigid)) {
            kinds[first..first + 3].fill(POSITION);
            kinds[first + 3..first + 6].fill(ROTATION);
        }
        let mut size = [0.0_f64; 3];
        for (kind, value) in kinds.into_iter().zip(correction) {
            size[kind] = size[kind].max(value.abs());
        }
        Self(size)
    }

    /// Corrections that are round-off of the state an increment has come to.
    pub(super) fn round_off(state: &State) -> Self {
        let positions = state.positions.iter().map(|x| x.amax());
        let pairs = state.pairs.iter();
        let tractions = pairs.flat_map(|pair| pair.tractions.nodes.iter().flatten().flatten());
        let stresses = tractions.chain(&state.pressures);
        let displacements = state.rigid.iter().map(|pose| pose.displacement.amax());
        let largest = [
            positions.chain(displacements).fold(0.0, f64::max),
            // A rotation moves what is as far away as positions are large by as much as these.
            1.0,
            stresses.fold(0.0, |largest: f64, value| largest.max(value.abs())),
        ];
        Self(largest.map(|largest| ROUND_OFF * largest))
    }

    /// The larger components of both.
    pub(super) fn max(&self, other: &Self) -> Self {
        Self([0, 1, 2].map(|at| self.0[at].max(other.0[at])))
    }

    /// Without what does not exceed another one.
    pub(super) fn beyond(&self, other: &Self) -> Self {
        let beyond = |at: usize| Some(self.0[at]).filter(|size| *size > other.0[at]);
        Self([0, 1, 2].map(|at| beyond(at).unwrap_or(0.0)))
    }

    /// The largest of its shares in another one.
    pub(super) fn over(&self, first: &Self) -> f64 {
        let shares = self.0.iter().zip(first.0);
        let share = |(size, first): (&f64, f64)| if first > 0.0 { size / first } else { 0.0 };
        shares.map(share).fold(0.0, f64::max)
    }
}
