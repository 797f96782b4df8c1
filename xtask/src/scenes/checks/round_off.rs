//! Round-off of forces and energies that should vanish.
//!
//! Programs sum forces of elements that are differences of stresses in doubles. For a body with
//! Young's modulus `E`, elements of size `h` and volume `V` they leave about
//!
//! ```text
//! force:  1e-12 E h^2        energy:  1e-14 E V
//! ```
//!
//! some thousand and some ten roundings. Forces of a run without pressure are to be compared with
//! that, not with each other. Beside a much softer body this would be large: no floor is above
//! `1e-8 E h^2` and `1e-9 E V` of the softest one, where a strain of one part in a thousand makes
//! `1e-3 E h^2` on every facet and `1e-6 E V`.

use crate::scenes::scene::{Body, Scene, Shape};

const FORCE: f64 = 1e-12;
const FORCE_OF_SOFTEST: f64 = 1e-8;
const ENERGY: f64 = 1e-14;
const ENERGY_OF_SOFTEST: f64 = 1e-9;

/// Force on a body below which it is none.
pub fn of_force(scene: &Scene, body: &str) -> f64 {
    let own = scene.bodies.iter().filter(|found| found.name == body);
    let own: f64 = own.map(|body| FORCE * of_element(body)).sum();
    let softest = scene.bodies.iter().map(of_element);
    own.min(FORCE_OF_SOFTEST * softest.fold(f64::INFINITY, f64::min))
}

/// Energy of a scene below which it is none.
pub fn of_energy(scene: &Scene) -> f64 {
    let all: f64 = scene.bodies.iter().map(of_volume).sum();
    let softest = scene.bodies.iter().map(of_volume);
    (ENERGY * all).min(ENERGY_OF_SOFTEST * softest.fold(f64::INFINITY, f64::min))
}

/// `E h^2` with the least edge of elements of a uniform mesh.
pub fn of_element(body: &Body) -> f64 {
    let size = match &body.shape {
        Shape::Block(block) => {
            let edges = (0..3).map(|axis| block.size[axis] / block.divisions[axis] as f64);
            edges.fold(f64::INFINITY, f64::min)
        }
        Shape::Cap(cap) => cap.element,
        Shape::Grid(grid) => grid.edge,
    };
    body.material.modulus * size * size
}

/// `E V`, a cap taken for a block.
fn of_volume(body: &Body) -> f64 {
    let volume: f64 = match &body.shape {
        Shape::Block(block) => block.size.iter().product(),
        Shape::Cap(cap) => cap.size[0] * cap.size[1] * cap.height,
        Shape::Grid(grid) => grid.volume,
    };
    body.material.modulus * volume
}
