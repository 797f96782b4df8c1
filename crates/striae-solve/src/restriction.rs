//! The problem of one rank: what it holds of a whole model, with local numbers.
//!
//! All that needs more of the whole than that is derived from the whole model first: ties,
//! pairs with their textures, moduli and fibres, nodes without mass, materials of bodies, how pairs
//! fit. So every rank has the meshes of the whole model for a while, with the facets and nodes
//! of its surfaces; elements with all that belongs to their quadrature points, which take
//! most of the memory of a run, are made of what the rank holds only. The meshes bound what ranks
//! that share the memory of a machine can begin with: some hundred bytes a node on each, where
//! elements and factors take tens of thousands.

mod agreement;
mod holding;
mod local;
mod numbers;

use std::sync::Arc;

use striae_contact::{pair::Geometry, side::Side};

use crate::{
    problem::{Frame, Problem, ProblemError},
    share::{Division, Share},
    team::Team,
};
use agreement::agreed;
use holding::holding;
use local::local;
use numbers::Numbers;
use striae_model::{Cavity, Model, Spring, pair_geometry::PairGeometry};

impl Problem {
    /// Prepares what this rank of a team holds of a model that is divided. All ranks call it
    /// with the same model and division.
    ///
    /// # Errors
    /// As [`Problem::new`], the same on all ranks, and where a model has springs or cavities.
    ///
    /// # Panics
    /// When the model is divided among more or fewer ranks than the team has.
    pub fn shared(
        model: Model,
        division: &Division,
        team: Arc<dyn Team>,
    ) -> Result<Self, ProblemError> {
        assert_eq!(division.ranks(), team.size(), "ranks with a share");
        if team.size() == 1 {
            return Self::new(model);
        }
        if let Some(Spring { name, .. }) = model.springs.first() {
            let spring = name.clone();
            return Err(ProblemError::SharedSpring { spring });
        }
        if let Some(Cavity { name, .. }) = model.cavities.first() {
            let cavity = name.clone();
            return Err(ProblemError::SharedCavity { cavity });
        }
        let whole = Frame::new(model)?;
        let frame = restricted(whole, division, team);
        let share = frame.share.clone();
        let names = frame.model.bodies.iter().map(|body| body.name.clone());
        let names: Vec<String> = names.collect();
        agreed(&share, &names, Self::on(frame))
    }
}

/// Part of the frame that a rank holds.
fn restricted(whole: Frame, division: &Division, team: Arc<dyn Team>) -> Frame {
    let numbers = Numbers::new(&whole, division, team.rank());
    let holding = holding(&whole, division, &numbers, team.rank());
    let count = holding.nodes.len();
    let node = |node| numbers.held(node);
    let ties = whole
        .ties
        .renumbered(count, node, |body, node| numbers.held_in_mesh(body, node));
    let pairs = whole.pairs.into_iter();
    Frame {
        model: local(&whole.model, &numbers),
        placed: whole.placed.map(|placed| local(&placed, &numbers)),
        ties,
        pairs: pairs.map(|pair| local_pair(pair, &numbers)).collect(),
        massless: numbers.of_bodies(&whole.massless),
        shadowed: whole.shadowed,
        materials: whole.materials,
        skin: whole.skin,
        share: Share::new(team, holding),
    }
}

/// A pair with local nodes, and the faces whose elements are here.
fn local_pair(mut pair: PairGeometry, numbers: &Numbers) -> PairGeometry {
    for side in Side::BOTH {
        let Some(body) = pair.bodies[side] else {
            continue;
        };
        let number = |node| numbers.held_in_mesh(body, node);
        let of_side = &mut pair.contact.sides[side];
        if let Geometry::Deformable(surface) = &mut of_side.geometry {
            *surface = surface.clone().renumbered(number);
        }
        if let Some(enclosure) = &mut of_side.enclosure {
            enclosure.surface = enclosure.surface.clone().renumbered(number);
        }
        for face in &mut pair.faces[side] {
            *face = face.and_then(|face| numbers.face(body, face));
        }
        let fibres = pair.fibres[side].iter_mut().flatten();
        for node in fibres.flat_map(|fibre| &mut fibre.nodes) {
            *node = number(*node);
        }
    }
    pair
}
