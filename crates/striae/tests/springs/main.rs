//! Springs and dashpots against closed forms.

mod faults;
mod motion;
mod rest;
mod resume;
mod scene;
