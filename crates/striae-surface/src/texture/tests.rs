//! Tests of textures by what they check.

mod convection;
mod declared;
mod interpolation;
mod refinement;
mod refusals;
mod rest;
mod shapes;
