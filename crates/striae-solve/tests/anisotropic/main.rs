//! Anisotropic friction between textured surfaces, compared with closed forms, invariances and
//! finite differences.

mod dissipation;
mod oblique;
#[path = "../verification/scene.rs"]
#[allow(dead_code, reason = "shared with another test program")]
mod scene;
mod table;

mod convergence;
mod guided;
mod patch;
mod patch_pair;
mod sliding;
mod sticking;
