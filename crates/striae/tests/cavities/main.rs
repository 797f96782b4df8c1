//! Cavities against closed forms.

mod contents;
mod faults;
mod resume;
mod scene;
mod sphere;
