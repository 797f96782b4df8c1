//! Elements, loads, the problem and its state, Newton's method and step control.

pub mod element;
pub mod load;
pub mod model;
