//! Parts that the sides of pairs and their textures refer to.

use super::body::Bodies;
use crate::{names::Names, raw};
use std::path::Path;
use striae_model::RigidSurface;

/// Parts that a side of a pair may refer to.
pub(super) struct Surfaces<'r> {
    pub(super) bodies: &'r Bodies,
    pub(super) rigid_names: &'r Names,
    pub(super) rigid: &'r [Option<RigidSurface>],
    /// The deck as written, whose meshes know the numbers of their nodes.
    pub(super) written: &'r raw::Simulation,
    /// Folder that paths are relative to.
    pub(super) base: &'r Path,
}
