//! The subcommands, one module each.

pub mod check;
pub mod compare;
pub mod completions;
pub mod convert;
pub mod fit;
pub mod law;
pub mod man;
pub mod material;
pub mod mesh;
pub mod new;
pub mod picture;
pub mod report;
pub mod reproduce;
pub mod resume;
pub mod run;
pub mod schema;
pub mod sweep;
pub mod texture;
