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
    /// With the first element of each.
    blocks: Vec<(usize, Arc<dyn ElementBlock>)>,
}

impl Elements {
    /// The reference elements of a mesh, in the order of its elements.
    ///
    /// # Errors
    ///
    /// The first element whose reference shape is degenerate.
    pub fn new(mesh: &Mesh, formulation: Formulation) -> Result<Self, ElementFault> {
        Self::of_sections(mesh, |_| formulation)
    }

    /// As [`Elements::new`], where elements of a mesh differ in their formulation.
    ///
    /// # Errors
    ///
    /// The first element whose reference shape is degenerate.
    pub fn of_sections(
        mesh: &Mesh,
        formulation: impl Fn(ElementId) -> Formulation,
    ) -> Result<Self, ElementFault> {
        let mut first = 0;
        let mut blocks = Vec::with_capacity(mesh.blocks.len());
        for cells in &mesh.blocks {
            let corners: Vec<Vec3> = (cells.nodes.iter())
                .map(|node| mesh.positions[node.index()])
                .collect();
            let elements = (first..first + cells.len()).map(ElementId::new);
            let formulations = elements.map(&formulation).collect();
            let block =
                block(cells.kind, formulations, &corners).map_err(|(at, error)| ElementFault {
                    element: ElementId::new(first + at),
                    error,
                })?;
            blocks.push((first, block));
            first += cells.len();
        }
        Ok(Self { blocks })
    }

    /// The blocks, each with the number of its first element.
    pub fn blocks(&self) -> impl Iterator<Item = (usize, &dyn ElementBlock)> {
        self.blocks.iter().map(|(first, block)| (*first, &**block))
    }

    /// Number of quadrature points.
    pub fn points(&self) -> usize {
        let counts = self.blocks.iter();
        let points = counts.map(|(_, block)| block.count() * block.points());
        points.sum()
    }

    /// All elements in the order of the mesh.
    pub fn iter(&self) -> impl Iterator<Item = Element<'_>> {
        self.blocks()
            .flat_map(|(_, block)| (0..block.count()).map(move |at| Element { block, at }))
    }

    /// An element of the mesh.
    pub fn get(&self, element: ElementId) -> Element<'_> {
        let index = element.index();
        let place = self.blocks.partition_point(|(first, _)| *first <= index) - 1;
        let (first, block) = &self.blocks[place];
        Element {
            block: &**block,
            at: index - first,
        }
    }
}
