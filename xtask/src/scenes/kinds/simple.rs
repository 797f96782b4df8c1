//! Plain parts of scenes that have a formula: nothing about them is random.

use crate::scenes::{
    grid::Grid,
    scene::{Beside, Block, Body, Material, Shape},
    vector::Vector,
};

/// A material of linear elasticity.
pub fn elastic(modulus: f64, poisson: f64) -> Material {
    Material {
        law: "linear-elastic",
        modulus,
        poisson,
        density: None,
        beside: Beside::Nothing,
    }
}

/// A material for large strains.
pub fn rubbery(modulus: f64, poisson: f64) -> Material {
    Material {
        law: "neo-hookean",
        ..elastic(modulus, poisson)
    }
}

/// A block of equal elements.
pub fn plain_block(origin: Vector, size: Vector, divisions: [usize; 3]) -> Block {
    Block {
        origin,
        size,
        divisions,
        ..Block::default()
    }
}

/// A body of a mesh in the deck.
pub fn gridded(name: &'static str, material: Material, grid: Grid) -> Body {
    Body {
        name,
        material,
        shape: Shape::Grid(Box::new(grid)),
        union: None,
        nearest: Vec::new(),
        formulation: None,
    }
}
