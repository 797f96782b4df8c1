//! Structured hexahedra over a lattice `(i, j, k)` and the naming of sides.
//!
//! Local axes `xi, eta, zeta` of the elements run along `i, j, k`. A lattice may
//! close upon itself along `k`, so that its last layer meets its first.

use crate::{CellBlock, ElementId, Face, Mesh, MeshError, NodeId, Vec3};

/// A lattice of `divisions[0] x divisions[1] x divisions[2]` elements.
pub(super) struct Grid {
    divisions: [usize; 3],
    closure: Closure,
}

/// Closure of the grid: whether the last layer of nodes along `k` coincides with the first one.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Closure {
    Open,
    Ring,
}

/// The six sides of a lattice, with the values of [`Face::side`].
#[derive(Clone, Copy)]
pub(super) enum Side {
    FirstK = 0,
    LastK = 1,
    FirstJ = 2,
    LastI = 3,
    LastJ = 4,
    FirstI = 5,
}

impl Grid {
    /// Creates the grid if there are not too many elements once each is divided into `parts`.
    pub(super) fn new(
        divisions: [usize; 3],
        parts: usize,
        closure: Closure,
    ) -> Result<Self, MeshError> {
        check_element_count(divisions.into_iter().chain([parts]))?;
        Ok(Self { divisions, closure })
    }

    /// Positions of all nodes from their lattice coordinates, `i` running fastest.
    pub(super) fn positions(&self, mut position: impl FnMut([usize; 3]) -> Vec3) -> Vec<Vec3> {
        let [ni, nj, nk] = self.node_counts();
        let mut positions = Vec::with_capacity(ni * nj * nk);
        for k in 0..nk {
            for j in 0..nj {
                for i in 0..ni {
                    positions.push(position([i, j, k]));
                }
            }
        }
        positions
    }

    /// All elements, `i` running fastest.
    pub(super) fn elements(&self) -> CellBlock {
        let [ni, nj, nk] = self.divisions;
        let mut elements = Vec::with_capacity(ni * nj * nk);
        for k in 0..nk {
            for j in 0..nj {
                for i in 0..ni {
                    elements.push([
                        self.node([i, j, k]),
                        self.node([i + 1, j, k]),
                        self.node([i + 1, j + 1, k]),
                        self.node([i, j + 1, k]),
                        self.node([i, j, k + 1]),
                        self.node([i + 1, j, k + 1]),
                        self.node([i + 1, j + 1, k + 1]),
                        self.node([i, j + 1, k + 1]),
                    ]);
                }
            }
        }
        CellBlock::hexahedra(elements)
    }

    /// Element faces on one side.
    pub(super) fn faces(&self, side: Side) -> Vec<Face> {
        let [ni, nj, nk] = self.divisions;
        let (axis, layer) = match side {
            Side::FirstI => (0, 0),
            Side::LastI => (0, ni - 1),
            Side::FirstJ => (1, 0),
            Side::LastJ => (1, nj - 1),
            Side::FirstK => (2, 0),
            Side::LastK => (2, nk - 1),
        };
        (0..ni * nj * nk)
            .filter(|&index| [index % ni, index / ni % nj, index / (ni * nj)][axis] == layer)
            .map(|index| Face {
                element: ElementId::new(index),
                side: side as u8,
            })
            .collect()
    }

    fn node(&self, [i, j, k]: [usize; 3]) -> NodeId {
        let [ni, nj, nk] = self.node_counts();
        NodeId::new(i + ni * (j + nj * (k % nk)))
    }

    fn node_counts(&self) -> [usize; 3] {
        let [ni, nj, nk] = self.divisions;
        let last = match self.closure {
            Closure::Open => nk + 1,
            Closure::Ring => nk,
        };
        [ni + 1, nj + 1, last]
    }
}

/// Checks that measures are positive.
pub(super) fn all_positive(measures: &[(&'static str, f64)]) -> Result<(), MeshError> {
    measures.iter().try_for_each(|&(name, value)| {
        MeshError::require(value > 0.0, name, value, "it must be positive")
    })
}

/// Checks that so many elements go around an axis.
pub(super) fn goes_around(count: usize) -> Result<(), MeshError> {
    MeshError::require(
        count >= 3,
        "number of elements around",
        count as f64,
        "at least 3 are needed",
    )
}

/// The most elements that a generator makes.
pub const MOST_ELEMENTS: u128 = 20_000_000;

/// Checks that a product of divisions is not beyond all that can be solved for.
pub(super) fn check_element_count(
    divisions: impl IntoIterator<Item = usize>,
) -> Result<(), MeshError> {
    let divisions = divisions.into_iter().map(|count| count as u128);
    let elements = divisions.fold(1, u128::saturating_mul);
    if elements <= MOST_ELEMENTS {
        return Ok(());
    }
    Err(MeshError::TooLarge {
        elements,
        most: MOST_ELEMENTS,
    })
}

/// The checked mesh with its sides named as facet and node sets.
pub(super) fn named_mesh<'a>(
    positions: Vec<Vec3>,
    elements: CellBlock,
    sides: impl IntoIterator<Item = (&'a str, Vec<Face>)>,
) -> Result<Mesh, MeshError> {
    let mut mesh = Mesh::new(positions, vec![elements])?;
    for (name, faces) in sides {
        mesh.node_sets.insert(name, mesh.nodes_of_faces(&faces));
        mesh.facet_sets.insert(name, faces);
    }
    mesh.node_sets
        .insert("all", (0..mesh.positions.len()).map(NodeId::new));
    mesh.element_sets
        .insert("all", (0..mesh.element_count()).map(ElementId::new));
    mesh.check()?;
    mesh.check_shape()?;
    Ok(mesh)
}
