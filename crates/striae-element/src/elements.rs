//! The elements of a mesh, in blocks of one kind.

use super::{
    Element, ElementFault, Formulation,
    block::{ElementBlock, block},
};
use std::sync::Arc;
use striae_mesh::{ElementId, Mesh, Vec3};

/// The reference elements of a mesh.
#[derive(Clone, Debug)]
pub struct Elements {
    /// With the first element and the first quadrature point of each.
    blocks: Vec<([usize; 2], Arc<dyn ElementBlock>)>,
}

impl Elements {
    /// The reference elements of a mesh, in the order of its elements.
    ///
    /// # Errors
    ///
    /// The first element whose reference shape is degenerate.
    pub fn new(mesh: &Mesh, formulation: Formulation) -> Result<Self, ElementFault> {
        let (mut first, mut first_point) = (0, 0);
        let mut blocks = Vec::with_capacity(mesh.blocks.len());
        for cells in &mesh.blocks {
            let corners: Vec<Vec3> = (cells.nodes.iter())
                .map(|node| mesh.positions[node.index()])
                .collect();
            let block =
                block(cells.kind, formulation, &corners).map_err(|(at, error)| ElementFault {
                    element: ElementId::new(first + at),
                    error,
                })?;
            let points = block.count() * block.points();
            blocks.push(([first, first_point], block));
            first += cells.len();
            first_point += points;
        }
        Ok(Self { blocks })
    }

    /// The blocks, each with the numbers of its first element and its first quadrature point.
    pub fn blocks(&self) -> impl Iterator<Item = ([usize; 2], &dyn ElementBlock)> {
        self.blocks.iter().map(|(first, block)| (*first, &**block))
    }

    /// How many quadrature points there are.
    pub fn points(&self) -> usize {
        let counts = self.blocks.iter();
        let points = counts.map(|(_, block)| block.count() * block.points());
        points.sum()
    }

    /// All elements in the order of the mesh.
    pub fn iter(&self) -> impl Iterator<Item = Element<'_>> {
        self.blocks().flat_map(|([_, first_point], block)| {
            (0..block.count()).map(move |at| Element {
                block,
                at,
                first_point: first_point + at * block.points(),
            })
        })
    }

    /// An element of the mesh.
    pub fn get(&self, element: ElementId) -> Element<'_> {
        let index = element.index();
        let place = self
            .blocks
            .partition_point(|([first, _], _)| *first <= index)
            - 1;
        let ([first, first_point], block) = &self.blocks[place];
        let at = index - first;
        Element {
            block: &**block,
            at,
            first_point: first_point + at * block.points(),
        }
    }
}
