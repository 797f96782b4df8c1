//! Whole problems held against closed forms, invariances and each other.

mod scene;

mod patch_frictionless;
