//! Overlaps that are pressed out in the course of the first step.
//!
//! Contact adds to the gap at a point, before it enforces `g >= 0`,
//!
//! ```text
//! left(step, s) o(x),   o = 1/2 (sum N_I^A o_I^A + sum N_J^B o_J^B),   left = 1 - s in the first step
//! ```
//!
//! with the interpolation functions of both sides at the pair of points; against a rigid
//! side, `o = sum N_I^A o_I^A`. So the pair starts without pressure, and from the second
//! step on nothing of this is left. Where facets overlap by more or less than the curved surfaces
//! whose chords they are, and these conform, `o` is that of the surfaces, and the difference is
//! added to the gap as long as the run lasts; so is an interference. See
//! [`striae_contact::seating`].
//!
//! Facets are paired up to a distance only, so in the first step contact is searched at least as
//! deep as the deepest overlap. An overlap of more than half the thickness of the body is refused:
//! its other side is nearer, so that contact would press it out there as well.

use std::sync::Arc;

use striae_contact::{
    initial::overlaps,
    interference::{AHEAD, Stage, inside},
    seating::{Fitted, Seating},
};

use crate::{
    interference::{Positions, configuration, thickness},
    problem::Problem,
    state::State,
};
use striae_model::{Initial, InterferenceFit, Moment};

/// Offsets of the gaps of a pair in a step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Offsets {
    /// `o_I` of the surface nodes, by side; empty where nothing is resolved.
    pub sides: [Vec<f64>; 2],
    seating: Option<Arc<Seating>>,
    /// Half the largest facet size.
    reach: f64,
}

impl Offsets {
    /// Offsets of a pair in a step; none unless the pair has an interference or is to resolve its
    /// overlaps, and after the first step none of overlaps that facets have as their surfaces do.
    pub fn new(problem: &Problem, step: usize, pair: usize) -> Self {
        let of_pair = &problem.model.pairs[pair];
        let resolves = of_pair.initial == Initial::Resolve;
        if !resolves && of_pair.interference.is_none() {
            return Self::default();
        }
        let start = State::undeformed(problem);
        let configuration = configuration(problem, pair, Positions::from(&start));
        let thickness = thickness(problem, pair, &start.positions);
        let stage = Stage {
            configuration: &configuration,
            thickness: &thickness,
        };
        let seating = match resolves {
            true => Seating::of_surfaces(&stage),
            false => Some(Seating::new(&stage)),
        };
        let left = || match &seating {
            Some(seating) => seating.overlaps(),
            None => overlaps(&stage),
        };
        let sides = match resolves && step == 0 {
            true => left(),
            false => Default::default(),
        };
        let reach = seating.as_ref().map_or(0.0, |_| {
            let sizes = configuration.sides.iter().flatten();
            0.5 * sizes.map(|side| side.largest_size).fold(0.0, f64::max)
        });
        Self {
            sides,
            seating: seating.map(Arc::new),
            reach,
        }
    }

    /// Returns whether anything is added to a gap.
    pub fn are_any(&self) -> bool {
        let mut all = self.sides.iter().flatten();
        self.seating.is_some() || all.any(|overlap| *overlap > 0.0)
    }

    /// Distance in which contact has to be looked for to see all of them, with the start of the
    /// first step.
    pub fn search(&self, interference: Option<&InterferenceFit>, first: Moment) -> f64 {
        let all = self.sides.iter().flatten().copied();
        let deepest = all.fold(0.0, f64::max);
        let Some(seating) = &self.seating else {
            return AHEAD * deepest;
        };
        let stated = interference.map_or(0.0, |interference| interference.largest(first));
        AHEAD * (seating.largest() + stated) + self.reach
    }

    /// The faces of the start, with an interference.
    pub fn fitted(&self, interference: f64) -> Option<Fitted> {
        let seating = self.seating.clone()?;
        Some(Fitted {
            seating,
            interference,
        })
    }
}

/// Depth in which faces of a pair are that interfere as they are meant to, after the depth `worn`
/// has worn off them: with an interference or a clearance that and the deepest overlap of their
/// meshes besides, after overlaps of curved surfaces were pressed out that of their facets.
pub fn meant_depth(problem: &Problem, pair: usize, worn: f64) -> f64 {
    let of_pair = &problem.model.pairs[pair];
    let resolves = of_pair.initial == Initial::Resolve;
    if !resolves && of_pair.interference.is_none() {
        return worn;
    }
    let start = State::undeformed(problem);
    let stage = Stage {
        configuration: &configuration(problem, pair, Positions::from(&start)),
        thickness: &thickness(problem, pair, &start.positions),
    };
    let Some(interference) = &of_pair.interference else {
        let seating = Seating::of_surfaces(&stage);
        return worn + seating.map_or(0.0, |seating| seating.correction());
    };
    let drawn = inside(&stage, 0.0).into_iter().map(|found| found.depth);
    drawn.fold(0.0, f64::max) + interference.deepest(problem.plans[0].start) + worn
}
