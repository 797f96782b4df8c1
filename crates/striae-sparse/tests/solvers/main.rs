//! The solvers against dense algebra and against what they must refuse.

mod problems;
mod refusals;

use striae_sparse::{FaerLu, LinearSolver, MultifrontalLu};

fn solvers() -> [(&'static str, Box<dyn LinearSolver>); 2] {
    [
        ("multifrontal", Box::new(MultifrontalLu::new())),
        ("faer", Box::new(FaerLu::new())),
    ]
}
