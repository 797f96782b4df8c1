//! Runs on several ranks, which are threads, against the same runs on one.

#[path = "../verification/scene.rs"]
#[allow(dead_code)]
mod scene;

mod contact;
mod endings;
mod motion;
mod told;
mod volume;
