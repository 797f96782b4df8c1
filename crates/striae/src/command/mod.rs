//! The subcommands, one module each.

pub mod check;
pub mod new;
pub mod run;
pub mod schema;
