//! Bodies that have gone through each other without contact that saw it.
//!
//! A converged increment is audited, see [`striae_contact::interference`], on all facets. Contact
//! has missed what
//!
//! - went through a body and out on its other side,
//! - is or was inside by more than half the local facet size, or went in and out beside
//!   the surface, where no pressure acts, or
//! - by more than all of the facet size, whatever acts.
//!
//! Less is what weighted contact leaves between nodes, and a matter of [`crate::warning`]. Where no
//! pair sees bodies inside themselves or others, half the facet size is the limit as well, and
//! nothing may go through and come out, which thin sheets do long before they are that deep.

use striae_contact::{
    evaluation::Evaluation,
    interference::{Interference, Kind, Place, SHARE, Spot},
    pair::PairedSurface,
    selection::{approach, deepest},
    side::Side,
};
use striae_mesh::FacetId;
use striae_surface::{node::SurfaceNode, topology::distinct_corners};

use crate::{
    assembly::{Setting, Trial},
    interference::{Positions, between, beyond},
    offsets::meant_depth,
    outcome::{CutBack, Start},
    skin::{BodyOverlap, crossing, overlaps},
};
use striae_model::{PairId, initial::other_name, node::GlobalNode};

/// Depth over the facet size from which on points inside are missed where nothing acts.
const UNSEEN: f64 = 0.5;
/// Depth over the facet size from which on points inside are missed anywhere.
const DEEP: f64 = 1.0;

/// Interferences that arose on the way to a trial state, deeper than [`SHARE`] of the facet size,
/// by pair.
///
/// # Errors
/// If contact missed some of them.
pub(super) fn passage(
    setting: &Setting,
    trial: &Trial,
    contacts: &[Evaluation],
) -> Result<Vec<Vec<Interference>>, CutBack> {
    let mut all = Vec::new();
    for pair in 0..setting.selections.len() {
        let worn = deepest(&setting.selections[pair].worn) + deepest(&contacts[pair].worn.depths);
        let found = found(setting, trial, pair, worn);
        missed(setting, trial, pair, &contacts[pair], &found).map_or(Ok(()), Err)?;
        all.push(found);
    }
    Ok(all)
}

fn found(setting: &Setting, trial: &Trial, pair: usize, worn: f64) -> Vec<Interference> {
    let [start, end] = ends(setting, trial);
    let problem = setting.context.problem;
    let found = between(problem, pair, start, end, SHARE);
    if found.is_empty() {
        return found;
    }
    beyond(found, meant_depth(problem, pair, worn), SHARE)
}

/// Positions at the start of the increment and in the trial state.
fn ends<'a>(setting: &Setting<'a>, trial: &'a Trial) -> [Positions<'a>; 2] {
    let end = Positions {
        nodes: &trial.positions,
        rigid: &trial.rigid,
    };
    [Positions::from(setting.state), end]
}

/// Interferences, out of those found, that the contact of a pair has missed.
fn missed(
    setting: &Setting,
    trial: &Trial,
    pair: usize,
    contact: &Evaluation,
    found: &[Interference],
) -> Option<CutBack> {
    let context = setting.context;
    let model = &context.problem.model;
    let selection = &setting.selections[pair];
    // Overlaps of meshes that are being pressed out are meant.
    let is_meant = |found: &Interference| selection.has_offsets() && found.kind == Kind::Inside;
    let sides = &context.pairs[pair].sides;
    let missed = found.iter().filter(|found| {
        found.kind == Kind::Crossed || !is_meant(found) && is_missed(sides, contact, found)
    });
    let worst = missed.max_by(|a, b| a.share().total_cmp(&b.share()))?;
    let [start, end] =
        ends(setting, trial).map(|at| context.configuration(pair, at.nodes, at.rigid));
    let surface = sides[worst.side].surface()?;
    let id = PairId(pair);
    Some(CutBack::Passage {
        pair: context.pairs[pair].name.clone(),
        body: other_name(model, id, worst.side.opposite()).to_owned(),
        node: surface.nodes()[worst.node],
        other: other_name(model, id, worst.side).to_owned(),
        depth: worst.depth,
        way: approach(&start, &end),
        is_prescribed: is_prescribed(setting, pair, worst),
    })
}

/// Returns whether a node and the rigid surface that it went through are both prescribed.
fn is_prescribed(setting: &Setting, pair: usize, found: &Interference) -> bool {
    let context = setting.context;
    let node = context.problem.surface_node(pair, found.side, found.node);
    let is_known = |node: GlobalNode| (0..3).all(|axis| context.known[node.component(axis)]);
    let is_rigid_known = |rigid: usize| setting.imposed.rigid[rigid].iter().all(Option::is_some);
    node.is_some_and(is_known)
        && context.problem.pairs[pair]
            .rigid
            .is_some_and(is_rigid_known)
}

/// Overlaps of bodies that no pair detects and that arose on the way to a trial state; collective.
///
/// # Errors
/// If some of them are deeper than half the facet size, or a body has gone through another one.
pub(super) fn overlap(setting: &Setting, trial: &Trial) -> Result<Vec<BodyOverlap>, CutBack> {
    let problem = setting.context.problem;
    let name = |body: usize| problem.model.bodies[body].name.clone();
    let ends = [&setting.state.positions[..], &trial.positions[..]];
    if let Some(crossing) = crossing(&problem.skin, &problem.share, ends) {
        return Err(CutBack::Crossing {
            body: name(crossing.body),
            node: crossing.node,
            other: name(crossing.other),
            is_joined: crossing.is_joined,
        });
    }
    let overlaps = overlaps(&problem.skin, &problem.share, ends);
    let deep = overlaps
        .iter()
        .filter(|overlap| overlap.found.share() > UNSEEN);
    let share = |overlap: &&BodyOverlap| overlap.found.share();
    let Some(worst) = deep.max_by(|a, b| share(a).total_cmp(&share(b))) else {
        return Ok(overlaps);
    };
    Err(CutBack::Overlap {
        body: name(worst.body),
        node: worst.node,
        other: name(worst.other),
        depth: worst.found.depth,
        start: match worst.before > SHARE * worst.found.size {
            true => Start::Inside,
            false => Start::Apart,
        },
        is_joined: worst.is_joined,
    })
}

/// Returns whether a point is deeper inside than contact resolves.
fn is_missed(sides: &[PairedSurface; 2], contact: &Evaluation, found: &Interference) -> bool {
    let corners = |side: Side, facet: FacetId| -> Vec<SurfaceNode> {
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
        Place::Facet(facet) => corners(found.side.opposite(), facet),
    };
    let acts = |side: Side, nodes: &[SurfaceNode]| {
        let mut carried = nodes
            .iter()
            .filter_map(|&node| contact.carried[side].get(node.index()));
        carried.any(|[pressure, _, _]| *pressure > 0.0)
    };
    let limit = if acts(found.side, &own) || acts(found.side.opposite(), &others) {
        DEEP
    } else if found.kind == Kind::Inside {
        UNSEEN
    } else {
        0.0
    };
    found.share() > limit
}
