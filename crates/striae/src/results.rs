//! Results of a state: nodal fields as slices, forces of pairs, ties and springs, reactions.

use nalgebra::Matrix3;
use striae_contact::unknowns::NodeResult;
use striae_element::nodal_cauchy_stress;
use striae_mesh::{NodeId, Vec3};
use striae_solve::{
    problem::Problem,
    report::{self, CavityReport, PairReport, RigidReport, SpringReport, TieReport},
    state::State,
};

/// A side of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PairSide {
    /// Side `a`.
    A,
    /// Side `b`.
    B,
}

/// A state seen through the names of its model. Nodal fields of a body are in the
/// order of the nodes of its mesh.
#[derive(Clone, Copy, Debug)]
pub struct Results<'a> {
    /// The problem.
    pub problem: &'a Problem,
    /// The state.
    pub state: &'a State,
}

impl<'a> Results<'a> {
    /// Results of a state.
    pub fn new(problem: &'a Problem, state: &'a State) -> Self {
        Self { problem, state }
    }

    /// Time of the state.
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// Positions of the nodes of a body; `None` if there is no body of this name.
    pub fn positions(&self, body: &str) -> Option<&'a [Vec3]> {
        self.of_body(body, &self.state.positions)
    }

    /// Positions of the nodes of a body at rest.
    pub fn reference(&self, body: &str) -> Option<&'a [Vec3]> {
        self.of_body(body, &self.problem.reference)
    }

    /// Displacements of the nodes of a body.
    pub fn displacements(&self, body: &str) -> Option<Vec<Vec3>> {
        let positions = self.positions(body)?.iter();
        let reference = self.reference(body)?;
        Some(positions.zip(reference).map(|(x, rest)| x - rest).collect())
    }

    /// Cauchy stress at the nodes of a body, see [`nodal_cauchy_stress`].
    pub fn stresses(&self, body: &str) -> Option<Vec<Matrix3<f64>>> {
        let index = self.body_index(body)?;
        let model = &self.problem.model.bodies[index];
        let elements = &self.problem.elements[index];
        let positions = self.positions(body)?;
        let made_of = |element| self.problem.made_of(self.state, index, element);
        let stress = nodal_cauchy_stress(&model.mesh, elements, positions, made_of);
        Some(stress.expect("converged elements are not inverted"))
    }

    /// Velocities of the nodes of a body, zero without inertia.
    pub fn velocities(&self, body: &str) -> Option<&'a [Vec3]> {
        self.of_body(body, &self.state.velocities)
    }

    /// Contact forces on the nodes of a body.
    pub fn contact_forces(&self, body: &str) -> Option<&'a [Vec3]> {
        self.of_body(body, &self.state.forces.contact)
    }

    /// Forces of ties on the nodes of a body.
    pub fn tie_forces(&self, body: &str) -> Option<&'a [Vec3]> {
        self.of_body(body, &self.state.forces.ties)
    }

    /// Forces that hold the prescribed nodes of a body, zero at the others.
    pub fn nodal_reactions(&self, body: &str) -> Option<&'a [Vec3]> {
        self.of_body(body, &self.state.forces.reaction)
    }

    /// Gaps, pressures, friction and slips at the nodes of a side of a pair, in the
    /// order of [`Results::surface_nodes`].
    pub fn contact(&self, pair: &str, side: PairSide) -> Option<&'a [NodeResult]> {
        let pair = self.pair_index(pair)?;
        Some(&self.state.pairs[pair].nodes[side as usize])
    }

    /// Nodes of the mesh that a side of a pair is made of, in ascending order; `None`
    /// for a rigid side.
    pub fn surface_nodes(&self, pair: &str, side: PairSide) -> Option<&'a [NodeId]> {
        let contact = &self.problem.pairs[self.pair_index(pair)?];
        contact.bodies[side as usize]?;
        let surface = contact.contact.sides[side as usize].surface()?;
        Some(surface.nodes())
    }

    /// Resultants, mismatch, counts and work of a pair.
    pub fn pair(&self, pair: &str) -> Option<PairReport> {
        let at = self.pair_index(pair)?;
        report::pairs(self.problem, self.state).into_iter().nth(at)
    }

    /// Tension, elongation and force of springs.
    pub fn spring(&self, name: &str) -> Option<SpringReport> {
        let all = report::springs(self.problem, self.state);
        all.into_iter().find(|spring| spring.name == name)
    }

    /// Pressure and volume of a cavity.
    pub fn cavity(&self, name: &str) -> Option<CavityReport> {
        let all = report::cavities(self.problem, self.state);
        all.into_iter().find(|cavity| cavity.name == name)
    }

    /// Forces and moments of a tie.
    pub fn tie(&self, name: &str) -> Option<TieReport> {
        let all = report::ties(self.problem, self.state);
        all.into_iter().find(|tie| tie.name == name)
    }

    /// Displacement, angles and torque of a rigid body.
    pub fn rigid_body(&self, name: &str) -> Option<RigidReport> {
        let all = report::rigid_bodies(self.problem, self.state);
        all.into_iter().find(|rigid| rigid.name == name)
    }

    /// Force that holds a node set, `body.set`, or a rigid surface, by its name.
    pub fn reaction(&self, name: &str) -> Option<Vec3> {
        let all = report::reactions(self.problem, self.state);
        let found = all.into_iter().find(|(known, _)| known == name);
        found.map(|(_, force)| force)
    }

    fn pair_index(&self, name: &str) -> Option<usize> {
        let mut pairs = self.problem.model.pairs.iter();
        pairs.position(|pair| pair.name == name)
    }

    fn body_index(&self, name: &str) -> Option<usize> {
        let mut bodies = self.problem.model.bodies.iter();
        bodies.position(|body| body.name == name)
    }

    fn of_body(&self, name: &str, field: &'a [Vec3]) -> Option<&'a [Vec3]> {
        let body = self.body_index(name)?;
        field.get(self.problem.first_node[body]..self.problem.first_node[body + 1])
    }
}
