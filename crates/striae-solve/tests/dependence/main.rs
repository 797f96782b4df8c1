//! Coefficients of friction that depend on pressure, slip rate, accumulated slip and states, and
//! factors of one's own, beside closed forms in full slip.

#[path = "../verification/scene.rs"]
#[allow(dead_code, reason = "shared with another test program")]
mod scene;

mod blocks;
mod factors;
mod healing;
mod shared;
mod slider;
mod sphere;
