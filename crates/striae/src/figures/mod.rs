//! Pictures of what a model says before anything runs: friction laws, fits of them, materials and
//! textures.

pub mod fit;
pub mod law;
pub mod material;
mod surface;
pub mod texture;

pub use surface::TexturedSurface;

use striae_contact::side::Side;
use striae_model::{ContactSurface, Model};

/// Body or surface that a side of a pair belongs to, in words.
pub fn owner(model: &Model, pair: usize, side: Side) -> String {
    let pair = &model.pairs[pair];
    match pair.surfaces()[side.index()] {
        ContactSurface::Deformable { body, .. } => format!("body `{}`", model.bodies[body.0].name),
        ContactSurface::Rigid(rigid) => {
            format!("rigid surface `{}`", model.rigid_surfaces[rigid.0].name)
        }
        ContactSurface::Itself => "itself".to_owned(),
    }
}
