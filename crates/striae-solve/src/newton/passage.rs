//! Bodies that have gone through each other without contact that saw it.
//!
//! A converged increment is looked at from outside, see [`striae_contact::interference`], on
//! all facets. Contact has missed what
//!
//! - went through the other side on its way, or
//! - is inside it by more than half the local facet size where no traction acts, or by more
//!   than all of it.
//!
//! Less is what weighted contact leaves between nodes, and a matter of [`crate::warning`].

use striae_contact::{
    interference::{Interference, Kind, Place, SHARE, Spot},
    selection::{Selection, approach},
};
use striae_surface::topology::distinct_corners;

use crate::{
    assembly::{Setting, Trial},
    initial::other_name,
    interference::{Positions, between},
    model::PairId,
    outcome::CutBack,
};

/// Depth over the facet size from which on points inside are missed where nothing acts.
const UNSEEN: f64 = 0.5;
/// The same wherever they are.
const DEEP: f64 = 1.0;

/// What contact has missed on the way to a trial state.
pub(super) fn passage(setting: &Setting, trial: &Trial) -> Option<CutBack> {
    let (context, state) = (setting.context, setting.state);
    let problem = context.problem;
    let end = Positions {
        nodes: &trial.positions,
        rigid: &trial.rigid,
    };
    for (pair, selection) in setting.selections.iter().enumerate() {
        let found = between(problem, pair, Positions::from(state), end, SHARE);
        let missed = found.iter().filter(|found| match found.kind {
            Kind::Passed => true,
            // Overlaps of meshes that are being pressed out are meant.
            Kind::Inside => !selection.has_offsets() && is_missed(selection, setting, pair, found),
        });
        let Some(worst) = missed.max_by(|a, b| a.share().total_cmp(&b.share())) else {
            continue;
        };
        let [start, end] =
            [Positions::from(state), end].map(|at| context.configuration(pair, at.nodes, at.rigid));
        let surface = context.pairs[pair].sides[worst.side].surface()?;
        let id = PairId(pair);
        return Some(CutBack::Passage {
            pair: context.pairs[pair].name.clone(),
            body: other_name(&problem.model, id, 1 - worst.side).to_owned(),
            node: surface.nodes()[worst.node as usize],
            other: other_name(&problem.model, id, worst.side).to_owned(),
            depth: worst.depth,
            way: approach(&start, &end),
        });
    }
    None
}

/// Whether a point is deeper inside than contact resolves.
fn is_missed(selection: &Selection, setting: &Setting, pair: usize, found: &Interference) -> bool {
    let sides = &setting.context.pairs[pair].sides;
    let corners = |side: usize, facet: striae_mesh::FacetId| -> Vec<u32> {
        let surface = sides[side].surface();
        let corners = surface.map(|surface| surface.facets()[facet.index()]);
        corners.map_or_else(Vec::new, |corners| distinct_corners(&corners).to_vec())
    };
    let own = match found.spot {
        Spot::Node(node) => vec![node],
        Spot::Centre(facet) => corners(found.side, facet),
    };
    let others = match found.place {
        Place::Plane => Vec::new(),
        Place::Facet(facet) => corners(1 - found.side, facet),
    };
    let acts = |side: usize, nodes: &[u32]| {
        nodes
            .iter()
            .any(|&node| selection.carries(side, node) || selection.is_kept(side, node))
    };
    let seen = acts(found.side, &own) || acts(1 - found.side, &others);
    found.share() > if seen { DEEP } else { UNSEEN }
}
