//! Wear that opens gaps, beside closed forms.

#[path = "../verification/scene.rs"]
#[allow(dead_code, reason = "shared with another test program")]
mod scene;

mod blocks;
mod passes;
mod sphere;
