//! Whole problems held against closed forms, invariances and each other.

#[allow(dead_code, reason = "shared with the tests of textured friction")]
mod scene;

mod driver;
mod dynamics;
mod energies;
mod friction_history;
mod hard_systems;
mod invariance;
mod patch_frictionless;
mod patch_stick;
mod pushed;
mod rigid;
mod rigid_facets;
mod round_off;
mod sliding;
mod table_1;
