//! Places of the stiffness of every element in the matrix, found once for a pattern.

use striae_sparse::{CliquePlaces, Structure};

use crate::{layout::Layout, problem::Problem};
use striae_model::Body;

/// Elements that are evaluated and added at a time: few enough for the cache.
const BATCH: usize = 128;

/// Places of the stiffness of every element in the matrices of a structure.
///
/// Elements with tied nodes have no place of their own there: their contributions go to the
/// coordinates of rigid bodies, too.
#[derive(Clone, Debug)]
pub struct ElementPlaces {
    /// Of every block of every body.
    blocks: Vec<Vec<CliquePlaces>>,
}

impl ElementPlaces {
    /// Places of the elements of a problem.
    pub fn new(problem: &Problem, layout: &Layout, structure: &Structure) -> Self {
        let bodies = problem.model.bodies.iter().enumerate();
        let of_body = |(body, model): (usize, &Body)| {
            let blocks = model.mesh.blocks.iter();
            let places = blocks.map(|block| {
                let nodes = block.nodes.iter().map(|node| problem.node(body, *node));
                let members = nodes.map(|node| layout.supervariable(node).0 as u32);
                let corners = block.kind.corner_count();
                CliquePlaces::new(structure, corners, BATCH, members.collect())
            });
            places.collect()
        };
        Self {
            blocks: bodies.map(of_body).collect(),
        }
    }

    /// Finds the places again in a pattern that has grown.
    pub fn find(&mut self, structure: &Structure) {
        let blocks = self.blocks.iter_mut().flatten();
        blocks.for_each(|places| places.find(structure));
    }

    /// Places of a block of a body.
    pub(super) fn of_block(&self, body: usize, block: usize) -> &CliquePlaces {
        &self.blocks[body][block]
    }
}
