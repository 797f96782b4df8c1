//! Resultants and tractions of ties in a state.

use striae_contact::side::Side;
use striae_mesh::Vec3;
use striae_surface::{normal::nodal_normals, topology::Surface};

use crate::{problem::Problem, state::State};

/// Resultants of a tie.
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

/// Forces and torques that a tie exerts on one of its sides.
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

/// Traction that a tie exerts on a node of one of its sides.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TieTraction {
    /// Unit normal of the side, outward.
    pub normal: Vec3,
    /// Force of the tie on the node over the area that belongs to it now, `int N da` over what
    /// is tied; 0 without area.
    pub traction: Vec3,
}

impl TieTraction {
    /// Part along the normal; tension is positive.
    pub fn along_normal(&self) -> f64 {
        self.traction.dot(&self.normal)
    }

    /// Part along the surface.
    pub fn shear(&self) -> Vec3 {
        self.traction - self.normal * self.along_normal()
    }
}

/// The surface of a side of a tie, in nodes of the mesh of its body.
pub fn tie_surface(problem: &Problem, tie: usize, side: Side) -> Surface {
    problem.ties.surface(tie, side)
}

/// Tractions of a tie at the nodes of its surfaces, by side, in the order of
/// [`tie_surface`].
pub fn tie_tractions(problem: &Problem, state: &State, tie: usize) -> [Vec<TieTraction>; 2] {
    let forces = problem.ties.forces(tie, &state.forces.ties);
    let areas = problem
        .ties
        .areas(tie, &problem.reference, &state.positions);
    Side::BOTH.map(|side| {
        let surface = tie_surface(problem, tie, side);
        let body = problem.ties.joints[tie].bodies[side];
        let global = |local: usize| problem.node(body, surface.nodes()[local]);
        let count = surface.nodes().len();
        let x: Vec<Vec3> = (0..count).map(|at| state.positions[global(at)]).collect();
        let normals = nodal_normals(&surface, &x).into_iter();
        let tractions = normals.enumerate().map(|(at, normal)| {
            let force = forces[side].get(&global(at)).copied().unwrap_or_default();
            let area = areas[side].get(&global(at)).copied().unwrap_or_default();
            let over = |axis: usize| match area[axis] > 0.0 {
                true => force[axis] / area[axis],
                false => 0.0,
            };
            TieTraction {
                normal,
                traction: Vec3::from_fn(|axis, _| over(axis)),
            }
        });
        tractions.collect()
    })
}
