//! The automatic choice on matrices that are all bulk: what holds for the solvers it
//! chooses from.

#[path = "../../striae-sparse/tests/solvers/problems.rs"]
mod problems;
#[path = "../../striae-sparse/tests/solvers/refusals.rs"]
mod refusals;

use striae_condensed::{Automatic, Choice};
use striae_sparse::LinearSolver;

fn solvers() -> [(&'static str, Box<dyn LinearSolver>); 1] {
    [("automatic", Box::new(Automatic::new(Choice::ByCost)))]
}
