//! Tensions, elongations and forces of springs in a state.

use striae_mesh::Vec3;

use crate::{problem::Problem, state::State};
use striae_model::Spring;

/// Result of springs.
#[derive(Clone, Debug, PartialEq)]
pub struct SpringReport {
    /// Their name.
    pub name: String,
    /// Sum of the tensions.
    pub tension: f64,
    /// Mean of the elongations since the start.
    pub elongation: f64,
    /// Force on the first end.
    pub force: Vec3,
}

/// Reports of all springs.
pub fn springs(problem: &Problem, state: &State) -> Vec<SpringReport> {
    let report = |(spring, of): (usize, &Spring)| {
        let links = problem.links.iter().zip(&state.forces.tensions);
        let own = links.filter(|(link, _)| link.spring == spring);
        let (mut tension, mut elongation, mut force) = (0.0, 0.0, Vec3::zeros());
        let mut count = 0.0;
        for (link, of_link) in own {
            count += 1.0;
            tension += of_link;
            if let Some(length) = link.length(&state.positions) {
                elongation += length.value - link.length;
                force -= length.gradient * *of_link;
            }
        }
        SpringReport {
            name: of.name.clone(),
            tension,
            elongation: elongation / f64::max(count, 1.0),
            force,
        }
    };
    problem
        .model
        .springs
        .iter()
        .enumerate()
        .map(report)
        .collect()
}
