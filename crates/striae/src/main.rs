//! The `striae` program.
fn main() {}
