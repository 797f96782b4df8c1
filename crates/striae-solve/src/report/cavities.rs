//! Pressures and volumes of cavities in a state.

use crate::{problem::Problem, state::State};

/// Result of a cavity.
#[derive(Clone, Debug, PartialEq)]
pub struct CavityReport {
    /// Its name.
    pub name: String,
    /// Pressure over that of the surroundings.
    pub pressure: f64,
    /// Volume.
    pub volume: f64,
}

/// Reports of all cavities.
pub fn cavities(problem: &Problem, state: &State) -> Vec<CavityReport> {
    let report = |(cavity, pressure): (usize, &f64)| CavityReport {
        name: problem.model.cavities[cavity].name.clone(),
        pressure: *pressure,
        volume: problem.cavity_volume(cavity, &state.positions),
    };
    state.pressures.iter().enumerate().map(report).collect()
}
