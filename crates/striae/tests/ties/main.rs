//! Ties of surfaces whose meshes do not match.

mod borders;
mod dynamics;
mod faults;
mod floor;
mod meeting;
mod motion;
mod order;
mod patch;
mod prescribed;
mod scene;
mod swap;
mod tractions;
