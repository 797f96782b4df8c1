//! The deck of a scene, brought to its place in space.
//!
//! With the rotation `R` and the shift `t` of the scene, a point `x` of the local frame
//! comes to `R x + t`. Blocks are rotated about the origin, so a block that is tilted
//! by `T` about `p` and placed has the rotation `R T` and the corner
//! `o - p + T^T (p + R^T t)`.

mod bodies;
mod everything;
mod pairs;
mod steps;

use super::{
    scene::{Placement, Scene, Statement},
    vector::{Matrix, Vector, applied, plus, rotation},
};

impl Placement {
    /// The rotation.
    pub fn matrix(&self) -> Matrix {
        rotation(self.axis, self.degrees.to_radians())
    }

    /// Image of a point.
    pub fn point(&self, x: Vector) -> Vector {
        plus(applied(&self.matrix(), x), self.shift)
    }

    /// Direction after the rotation of the deck.
    pub fn direction(&self, v: Vector) -> Vector {
        if self.degrees == 0.0 {
            return v;
        }
        applied(&self.matrix(), v)
    }
}

/// The text of the deck.
pub fn text(scene: &Scene) -> String {
    let mut lines = vec![
        format!(
            "title = \"Scene {} of the kind {}\"",
            scene.seed, scene.kind
        ),
        String::new(),
    ];
    for body in &scene.bodies {
        bodies::material(&mut lines, &scene.placement, body);
    }
    for body in &scene.bodies {
        bodies::mesh(&mut lines, &scene.placement, body);
    }
    for surface in &scene.rigid {
        bodies::rigid(&mut lines, &scene.placement, surface);
    }
    match &scene.statement {
        Statement::Pairs | Statement::PairsOfFaces => {
            for of_pair in &scene.pairs {
                pairs::pair(&mut lines, scene, of_pair);
            }
        }
        Statement::All(law) => everything::contact(&mut lines, scene, law),
    }
    for tie in &scene.ties {
        pairs::tie(&mut lines, tie);
    }
    for step in &scene.steps {
        steps::step(&mut lines, &scene.placement, step, scene.is_dynamic());
    }
    lines.join("\n") + "\n"
}
