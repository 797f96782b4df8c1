//! Problems that ranks share, beside the whole: what is held and who owns it, and what it adds
//! up to. Ranks are threads.

mod division;
mod evaluated;
mod held;
mod numbering;
#[path = "../verification/scene.rs"]
#[allow(dead_code)]
mod scene;
mod scenes;
mod sections;
mod sums;
