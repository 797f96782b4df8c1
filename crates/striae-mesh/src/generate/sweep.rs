//! Layers of hexahedra from a disc that is moved along a line or around an axis.

use super::disc::{Disc, Sector};
use super::generator::product;
use super::grid::{Closure, check_element_count};
use crate::{CellBlock, ElementId, Face, MeshError, NodeId, Vec3};

/// Number of elements of a disc, from the divisions of its core, of the band around it, and the
/// number of layers.
pub(super) fn swept_elements([core, band, layers]: [usize; 3], sector: Sector) -> u128 {
    let quarters = match sector {
        Sector::Whole => 4,
        Sector::Quarter => 1,
    };
    let deep = core.saturating_add(band.saturating_mul(2));
    product(&[quarters, core, deep, layers])
}

/// A disc and how often it is repeated.
pub(super) struct Sweep<'a> {
    disc: &'a Disc,
    layers: usize,
    closure: Closure,
}

impl<'a> Sweep<'a> {
    /// Layers from one disc to another.
    pub(super) fn along(disc: &'a Disc, layers: usize) -> Result<Self, MeshError> {
        Self::new(disc, layers, Closure::Open)
    }

    /// Layers of which the last meets the first.
    pub(super) fn around(disc: &'a Disc, layers: usize) -> Result<Self, MeshError> {
        Self::new(disc, layers, Closure::Ring)
    }

    fn new(disc: &'a Disc, layers: usize, closure: Closure) -> Result<Self, MeshError> {
        let divisions = [disc.core, disc.band, layers];
        for count in divisions {
            let what = "number of elements along an edge";
            MeshError::require(count > 0, what, count as f64, "at least 1 is needed")?;
        }
        let width = disc.core.saturating_add(disc.band);
        check_element_count([8, disc.core, width, layers])?;
        Ok(Self {
            disc,
            layers,
            closure,
        })
    }

    /// Positions of all nodes from those in the disc and the number of the layer.
    pub(super) fn positions(&self, position: impl Fn([f64; 2], usize) -> Vec3) -> Vec<Vec3> {
        let sheets = self.sheets();
        let sheet: Vec<[f64; 2]> = self.disc.positions().collect();
        let layers = (0..sheets).flat_map(|layer| sheet.iter().map(move |at| (*at, layer)));
        layers.map(|(at, layer)| position(at, layer)).collect()
    }

    /// All elements, layer by layer: the cells of the disc with those of the next layer.
    pub(super) fn elements(&self) -> CellBlock {
        let count = self.disc.node_count();
        let sheets = self.sheets();
        let quadrangles = self.disc.quadrangles();
        let cells = (0..self.layers).flat_map(|layer| quadrangles.iter().map(move |q| (layer, q)));
        CellBlock::hexahedra(cells.map(|(layer, &[a, b, c, d])| {
            let (near, far) = (layer * count, (layer + 1) % sheets * count);
            let near = [a, b, c, d].map(|node| NodeId::new(near + node));
            let far = [a, b, c, d].map(|node| NodeId::new(far + node));
            let ([a, b, c, d], [e, f, g, h]) = (near, far);
            [a, b, c, d, e, f, g, h]
        }))
    }

    /// Faces over edges of cells of the disc.
    pub(super) fn faces(&self, edges: &[(usize, u8)]) -> Vec<Face> {
        let count = self.disc.cell_count();
        let layers = (0..self.layers).flat_map(|layer| edges.iter().map(move |edge| (layer, edge)));
        let faces = layers.map(|(layer, &(cell, edge))| Face {
            element: ElementId::new(layer * count + cell),
            side: edge + 2,
        });
        faces.collect()
    }

    /// The first disc.
    pub(super) fn first(&self) -> Vec<Face> {
        self.sheet(0, 0)
    }

    /// The last disc.
    pub(super) fn last(&self) -> Vec<Face> {
        self.sheet(self.layers - 1, 1)
    }

    /// Number of different discs.
    fn sheets(&self) -> usize {
        match self.closure {
            Closure::Open => self.layers + 1,
            Closure::Ring => self.layers,
        }
    }

    fn sheet(&self, layer: usize, side: u8) -> Vec<Face> {
        let count = self.disc.cell_count();
        let cells = layer * count..(layer + 1) * count;
        let faces = cells.map(|cell| Face {
            element: ElementId::new(cell),
            side,
        });
        faces.collect()
    }
}
