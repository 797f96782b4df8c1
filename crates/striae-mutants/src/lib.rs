//! Fuzz targets: decks and files, damaged by seed, read and judged.
//!
//! ```text
//! seed -> sample of the corpus -> mutant -> reader -> Refused, Accepted, Run
//!                                                     or a Finding
//! ```
//!
//! A seed gives the same mutant on every machine. The tests try some seeds; the program tries
//! ranges in processes of their own, which it ends where they take too long or too much memory.
//! Inputs that once failed are in `corpus/regressions`.
//!
//! `striae-fuzz` leaves the choice of inputs to libFuzzer, which keeps those that reach code for
//! the first time and changes them further, with the same damage and the same judges. Inputs that
//! it has found useful are in `corpus/fuzz`.

pub mod dictionary;
pub mod fuzzing;
pub mod judge;
pub mod mutation;
pub mod random;
pub mod target;
pub mod trial;
pub mod usage;
