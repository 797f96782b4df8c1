//! Interference between the sides of the pairs of a problem.

use striae_contact::{
    configuration::Configuration,
    interference::{Fibre, Interference, Stage, Thickness, fibres, inside, interferences, lengths},
    placement::Placement,
};
use striae_mesh::{NodeId, Vec3};
use striae_surface::topology::Surface;

use crate::{
    model::Model,
    problem::{PairGeometry, Problem},
    rigid::Pose,
    state::State,
};

/// Where nodes and rigid bodies are.
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

/// All of a pair that is deeper than `share` of the facet size in one state.
pub fn within(problem: &Problem, pair: usize, at: Positions, share: f64) -> Vec<Interference> {
    let stage = Stage {
        configuration: &configuration(problem, pair, at),
        thickness: &thickness(problem, pair, at.nodes),
    };
    inside(&stage, share)
}

/// Where the sides of a pair are.
pub fn configuration<'a>(problem: &'a Problem, pair: usize, at: Positions) -> Configuration<'a> {
    let geometry = &problem.pairs[pair];
    let of_side = |side: usize| -> Vec<Vec3> {
        let surface = geometry.contact.sides[side].surface();
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
    Configuration::new(&geometry.contact, [of_side(0), of_side(1)], placement)
}

/// How thick the bodies behind the facets of a pair are.
pub fn thickness(problem: &Problem, pair: usize, positions: &[Vec3]) -> Thickness {
    let at = |body: usize, node: NodeId| positions[problem.node(body, node)];
    thickness_with(&problem.pairs[pair], at)
}

/// The same with the nodes of bodies anywhere.
pub(crate) fn thickness_with(
    geometry: &PairGeometry,
    at: impl Fn(usize, NodeId) -> Vec3,
) -> Thickness {
    Thickness([0, 1].map(|side| {
        let Some(surface) = geometry.contact.sides[side].surface() else {
            return Vec::new();
        };
        let rigid = &geometry.rigid_reference;
        let x: Vec<Vec3> = match geometry.bodies[side] {
            Some(body) => surface.nodes().iter().map(|&node| at(body, node)).collect(),
            None => rigid.clone(),
        };
        let end = |node: u32| match geometry.bodies[side] {
            Some(body) => at(body, NodeId(node)),
            None => rigid[node as usize],
        };
        lengths(surface, &x, &geometry.fibres[side], end)
    }))
}

/// Fibres through what is behind the facets of all pairs. They end at nodes of the
/// body, or at surface nodes of a rigid side.
pub(crate) fn add_fibres(model: &Model, pairs: &mut [PairGeometry]) {
    let skin = |body: usize| {
        let mesh = &model.bodies[body].mesh;
        let faces = mesh.boundary_faces().into_iter();
        Surface::new(&faces.map(|face| mesh.face_nodes(face)).collect::<Vec<_>>())
    };
    let mut skins: Vec<Option<Surface>> = vec![None; model.bodies.len()];
    for pair in pairs {
        pair.fibres = [0, 1].map(|side| {
            let Some(surface) = pair.contact.sides[side].surface() else {
                return Vec::new();
            };
            let Some(body) = pair.bodies[side] else {
                let x = &pair.rigid_reference;
                return fibres(surface, x, surface, x);
            };
            let skin = skins[body].get_or_insert_with(|| skin(body));
            of_body(&model.bodies[body].mesh.positions, surface, skin)
        });
    }
}

fn of_body(positions: &[Vec3], surface: &Surface, skin: &Surface) -> Vec<Option<Fibre>> {
    let at = |surface: &Surface| -> Vec<Vec3> {
        let nodes = surface.nodes().iter();
        nodes.map(|node| positions[node.index()]).collect()
    };
    let mut fibres = fibres(surface, &at(surface), skin, &at(skin));
    for fibre in fibres.iter_mut().flatten() {
        fibre.nodes = fibre.nodes.map(|node| skin.nodes()[node as usize].0);
    }
    fibres
}
