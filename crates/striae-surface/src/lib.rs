//! Geometry of a deforming surface: facets, nodal normals, transport, textures.

pub mod facet;
mod graph;
pub mod node;
pub mod normal;
pub mod scalar;
pub mod texture;
pub mod topology;
pub mod transport;
