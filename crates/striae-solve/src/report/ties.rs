//! What ties amount to in a state.

use striae_mesh::Vec3;

use crate::{problem::Problem, state::State};

/// What a tie amounts to.
#[derive(Clone, Debug, PartialEq)]
pub struct TieReport {
    /// Name of the tie.
    pub name: String,
    /// Resultants on the two sides.
    pub sides: [TieSide; 2],
    /// Reference area that is tied.
    pub area: f64,
    /// Length of the sum of both forces over what is transmitted.
    pub mismatch: f64,
    /// Length of the sum of both moments over what is transmitted times the root of the area.
    pub moment_mismatch: f64,
}

/// What a tie exerts on one of its sides.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TieSide {
    /// Force.
    pub force: Vec3,
    /// Moment about the origin.
    pub moment: Vec3,
    /// Sum of the lengths of the nodal forces.
    pub transmitted: f64,
}

/// Reports of all ties.
pub fn ties(problem: &Problem, state: &State) -> Vec<TieReport> {
    let ties = problem.ties.joints.iter().zip(&problem.model.ties);
    ties.enumerate()
        .map(|(tie, (joint, model))| {
            let forces = problem.ties.forces(tie, &state.forces.ties);
            let sides = forces.map(|forces| {
                let mut side = TieSide::default();
                for (node, force) in forces {
                    side.force += force;
                    side.transmitted += force.norm();
                    side.moment += state.positions[node].cross(&force);
                }
                side
            });
            let [a, b] = &sides;
            let largest = a.transmitted.max(b.transmitted);
            let over = |value: f64, scale: f64| if scale > 0.0 { value / scale } else { 0.0 };
            TieReport {
                name: model.name.clone(),
                area: joint.area,
                mismatch: over((a.force + b.force).norm(), largest),
                moment_mismatch: over((a.moment + b.moment).norm(), largest * joint.area.sqrt()),
                sides,
            }
        })
        .collect()
}
