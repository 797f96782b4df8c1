//! Tangents of contact and of whole systems: the error of central differences falls with
//! the square of the step.

#[path = "../anisotropic/oblique.rs"]
#[allow(dead_code, reason = "shared with the tests of textured friction")]
mod oblique;
#[path = "../verification/scene.rs"]
#[allow(dead_code, reason = "shared with another test program")]
mod scene;
#[path = "../anisotropic/table.rs"]
#[allow(dead_code, reason = "shared with the tests of textured friction")]
mod table;

mod pair;
mod placed;
mod whole;
mod worn;

mod cavities;
mod contact;
mod creeping;
mod factored;
mod guided;
mod linearised;
mod springs;
mod system;
mod textured;
