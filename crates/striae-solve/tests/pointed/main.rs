//! Edges and corners that pierce a face between its nodes.

mod edge;
mod home;
mod ridge;
mod scene;
mod tangent;
mod valley;
