//! Whole problems compared with closed forms, invariances and each other.

#[allow(dead_code, reason = "shared with the tests of textured friction")]
mod scene;

mod covered;
mod decay;
mod driver;
mod dynamics;
mod endings;
mod energies;
mod fibres;
mod friction_history;
mod hard_systems;
mod invariance;
mod memory;
mod moved_mass;
mod passages;
mod patch_frictionless;
mod patch_stick;
mod pushed;
mod rigid;
mod rigid_facets;
mod round_off;
mod sections;
mod self_contact;
mod self_contact_at_random;
mod shared_positions;
mod skins;
mod sliding;
mod stabilised;
mod strip;
mod table_1;
mod thick_sphere;
