//! Audits of converged increments, at nodes.
//!
//! Residuals show how well the rows are satisfied, not whether the result is plausible. The audits
//! use positions and nodal forces at both ends of an increment, independent of the rows it was
//! solved by.

mod coarse;
mod friction;
mod motion;

use crate::{outcome::CutBack, problem::Problem, state::State};

pub use coarse::{Coarse, coarse};
pub use friction::{Gain, LEAST_SHARE};
pub use motion::jump;

/// A body that moves far against its loads, driven by nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// The body.
    pub body: usize,
    /// Distance that it moves.
    pub way: f64,
    /// The longest way that is prescribed.
    pub driven: f64,
}

/// Reason to doubt an increment.
#[derive(Clone, Debug, PartialEq)]
pub enum Doubt {
    /// Friction pushes a node along its slip.
    Gain(Gain),
}

/// Reasons to doubt an increment from `before` to `after`.
pub fn doubts(problem: &Problem, before: &State, after: &State) -> Vec<Doubt> {
    let pairs = 0..problem.pairs.len();
    let gains = pairs.filter_map(|pair| friction::gain(problem, pair, [before, after]));
    gains.map(Doubt::Gain).collect()
}

impl Jump {
    /// The jump as a reason why an increment fails.
    pub fn cut_back(&self, problem: &Problem) -> CutBack {
        CutBack::Jump {
            body: problem.model.bodies[self.body].name.clone(),
            way: self.way,
            driven: self.driven,
        }
    }
}

impl Doubt {
    /// The doubt as a reason to try a smaller increment.
    pub fn cut_back(&self, problem: &Problem) -> CutBack {
        match self {
            Self::Gain(gain) => CutBack::Gain {
                pair: problem.model.pairs[gain.pair].name.clone(),
                body: problem.model.bodies[gain.body].name.clone(),
                node: gain.node,
                work: gain.work,
                share: gain.share,
            },
        }
    }
}
