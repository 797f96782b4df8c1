//! Binding to PETSc: safe on the outside, the only unsafe code of this crate.
//!
//! Vectors are slices of Rust that PETSc borrows for the time of a call. Objects keep the
//! library alive, so that they go before it is finalised. All calls are collective.
#![allow(unsafe_code)]

mod cycle;
mod factors;
mod ffi;
mod krylov;
mod library;
mod matrix;
mod vectors;

pub(crate) use cycle::Cycle;
pub(crate) use factors::{Factors, Made};
pub(crate) use krylov::Krylov;
pub(crate) use library::Library;
pub(crate) use matrix::{Entry, Matrix, Side, sum};
pub(crate) use vectors::{Lay, Scatter, Sum};
