//! Interference between the sides of the pairs of a problem.

use striae_contact::{
    configuration::Configuration,
    interference::{Interference, Kind, Stage, Thickness, interferences, resolved_inside},
    pair::ContactPair,
    placement::Placement,
    side::Side,
};
use striae_mesh::{NodeId, Vec3};

use crate::{problem::Problem, rigid::Pose, state::State};
use striae_model::pair_geometry::thickness_with;

/// Positions of nodes and rigid bodies.
#[derive(Clone, Copy, Debug)]
pub struct Positions<'a> {
    /// Positions of all global nodes.
    pub nodes: &'a [Vec3],
    /// Poses of the rigid bodies.
    pub rigid: &'a [Pose],
}

impl<'a> From<&'a State> for Positions<'a> {
    fn from(state: &'a State) -> Self {
        Self {
            nodes: &state.positions,
            rigid: &state.rigid,
        }
    }
}

/// Interference of a pair at `end` that is deeper than `share` of the facet size and
/// was less at `start`.
pub fn between(
    problem: &Problem,
    pair: usize,
    start: Positions,
    end: Positions,
    share: f64,
) -> Vec<Interference> {
    let configurations = [start, end].map(|at| configuration(problem, pair, at));
    let thickness = [start, end].map(|at| thickness(problem, pair, at.nodes));
    let [start, end] = [0, 1].map(|end| Stage {
        configuration: &configurations[end],
        thickness: &thickness[end],
    });
    interferences(&start, &end, share)
}

/// Interferences that are deeper than `meant` by more than `share` of the facet size, with the
/// excess depth; passages are returned unchanged.
pub fn beyond(found: Vec<Interference>, meant: f64, share: f64) -> Vec<Interference> {
    let of_one = |found: Interference| {
        if found.kind != Kind::Inside {
            return Some(found);
        }
        let depth = found.depth - meant;
        (depth > share * found.size).then_some(Interference { depth, ..found })
    };
    found.into_iter().filter_map(of_one).collect()
}

/// All of a pair that is deeper than `share` of the size of the smaller facets in one state.
pub fn within(problem: &Problem, pair: usize, at: Positions, share: f64) -> Vec<Interference> {
    let stage = Stage {
        configuration: &configuration(problem, pair, at),
        thickness: &thickness(problem, pair, at.nodes),
    };
    resolved_inside(&stage, share)
}

/// Configuration of a pair, with the skins of its bodies.
pub fn configuration<'a>(problem: &'a Problem, pair: usize, at: Positions) -> Configuration<'a> {
    let geometry = &problem.pairs[pair];
    placed(problem, pair, &geometry.contact, at).enclosed(|side, skin| {
        let body = geometry.bodies[side].expect("a side that is part of a skin has a body");
        let nodes = skin.nodes().iter();
        nodes
            .map(|&node| at.nodes[problem.node(body, node)])
            .collect()
    })
}

/// Configuration of a pair of the problem with another search distance.
pub(crate) fn placed<'a>(
    problem: &Problem,
    pair: usize,
    contact: &'a ContactPair,
    at: Positions,
) -> Configuration<'a> {
    let geometry = &problem.pairs[pair];
    let of_side = |side: Side| -> Vec<Vec3> {
        let surface = contact.sides[side].surface();
        match (geometry.bodies[side], surface) {
            (Some(body), Some(surface)) => {
                let nodes = surface.nodes().iter();
                nodes
                    .map(|&node| at.nodes[problem.node(body, node)])
                    .collect()
            }
            _ => geometry.rigid_reference.clone(),
        }
    };
    let placement = geometry.rigid.map_or_else(Placement::at_rest, |id| {
        at.rigid[id].placement(&problem.model.rigid_surfaces[id].reference)
    });
    Configuration::new(contact, Side::BOTH.map(of_side), placement)
}

/// Thickness of the bodies behind the facets of a pair.
pub fn thickness(problem: &Problem, pair: usize, positions: &[Vec3]) -> Thickness {
    let at = |body: usize, node: NodeId| positions[problem.node(body, node)];
    thickness_with(&problem.pairs[pair], at)
}
