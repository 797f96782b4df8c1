//! Coefficients of friction that depend on pressure, slip rate and accumulated slip, beside closed
//! forms in full slip.

#[path = "../verification/scene.rs"]
#[allow(dead_code, reason = "shared with another test program")]
mod scene;

mod blocks;
mod slider;
mod sphere;
