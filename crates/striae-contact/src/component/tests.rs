//! Blocks of springs in contact: closed forms, the tangent, wrong uses.

mod faults;
mod springs;
mod tangent;
