//! Resultants, reactions and counts of a state. Those of pairs, ties and rigid bodies follow
//! from what all ranks hold; reactions and those of bodies are collective.

mod cavities;
mod springs;
mod surfaces;
mod ties;

pub use cavities::{CavityReport, cavities};
pub use springs::{SpringReport, springs};
pub use surfaces::surfaces;
pub use ties::{TieReport, TieSide, TieTraction, tie_surface, tie_tractions, ties};

use std::collections::BTreeSet;

use striae_contact::{
    field::FacetForces,
    side::Side,
    unknowns::{NodeResult, Status},
};
use striae_mesh::{ElementId, FacetId, NodeId, Vec3};
use striae_surface::node::SurfaceNode;

use crate::{problem::Problem, rigid::Wrench, state::State};

/// Resultants of a contact pair.
#[derive(Clone, Debug, PartialEq)]
pub struct PairReport {
    /// Name of the pair.
    pub name: String,
    /// Resultants of the two sides.
    pub sides: [SideReport; 2],
    /// Length of the sum of both resultants over the [load](Self::load).
    pub mismatch: f64,
    /// Length of the sum of both moments, over the load times the root of the covered area.
    pub moment_mismatch: f64,
    /// Sticking nodes of both sides.
    pub stick: usize,
    /// Slipping nodes.
    pub slip: usize,
    /// All other nodes.
    pub open: usize,
    /// Largest nodal pressure.
    pub max_pressure: f64,
    /// Friction work since the start.
    pub dissipated: f64,
}

impl PairReport {
    /// Load that the pair transmits, `|(integral p da, integral |tau| da)|` of the side with more
    /// of it: unlike resultants, it does not vanish where contact is all round a body.
    pub fn load(&self) -> f64 {
        self.sides.iter().map(SideReport::load).fold(0.0, f64::max)
    }
}

/// Integrals over one side of a pair. In self-contact side `a` has the forces on both walls, which
/// cancel, and what one of them adds up to of all that has no sign.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SideReport {
    /// Force of the contact tractions on the side.
    pub force: Vec3,
    /// Moment of the contact tractions about the origin.
    pub moment: Vec3,
    /// `integral p da`.
    pub pressure: f64,
    /// `integral |tau| da`.
    pub friction: f64,
    /// Covered area.
    pub area: f64,
    /// Area of the points under pressure.
    pub pressed: f64,
    /// Centre of pressure: `integral p x da` over that of `p`; zero without pressure.
    pub centre: Vec3,
}

impl SideReport {
    fn load(&self) -> f64 {
        self.pressure.hypot(self.friction)
    }
}

/// Reports of all pairs.
pub fn pairs(problem: &Problem, state: &State) -> Vec<PairReport> {
    (0..problem.pairs.len())
        .map(|pair| report(problem, state, pair))
        .collect()
}

/// Sum of the reactions at the nodes of every named node set, as
/// `body.set`, and the force that holds every rigid surface, by its name. Collective.
pub fn reactions(problem: &Problem, state: &State) -> Vec<(String, Vec3)> {
    let (mut names, mut sums) = (Vec::new(), Vec::new());
    for (body, model) in problem.model.bodies.iter().enumerate() {
        for (name, nodes) in model.mesh.node_sets.iter() {
            let nodes = nodes.iter().map(|&node| problem.node(body, node));
            let own = nodes.filter(|node| problem.share.owns(*node));
            sums.push(own.map(|node| state.forces.reaction[node]).sum());
            names.push(format!("{}.{name}", model.name));
        }
    }
    problem.share.sum_vectors(&mut sums);
    let mut all: Vec<(String, Vec3)> = names.into_iter().zip(sums).collect();
    for (index, rigid) in problem.model.rigid_surfaces.iter().enumerate() {
        all.push((rigid.name.clone(), wrench(problem, state, index).force));
    }
    all
}

/// The [`reactions`] without those of node sets of which no step prescribes a node and no
/// rigid body holds one: there is nothing but the residual. Collective.
pub fn held_reactions(problem: &Problem, state: &State) -> Vec<(String, Vec3)> {
    let prescribed = problem
        .plans
        .iter()
        .flat_map(|plan| plan.displacements.keys());
    let oblique = problem.plans.iter().flat_map(|plan| plan.oblique.keys());
    let prescribed = prescribed.map(|&(body, node, _)| (body, node));
    let prescribed: BTreeSet<(usize, usize)> = prescribed.chain(oblique.copied()).collect();
    let holds = |body: usize, node: NodeId| {
        let tied = problem.tie_of[problem.node(body, node)];
        tied.is_some() || prescribed.contains(&(body, node.index()))
    };
    let bodies = problem.model.bodies.iter().enumerate();
    let sets = bodies.flat_map(|(body, model)| {
        let sets = model.mesh.node_sets.iter();
        sets.map(move |(_, nodes)| (body, nodes))
    });
    let is_held = sets.map(|(body, nodes)| nodes.iter().any(|node| holds(body, *node)));
    let is_held = problem.share.any_of(is_held).into_iter();
    let rigid = problem.model.rigid_surfaces.iter().map(|_| true);
    let is_held = is_held.chain(rigid);
    let all = reactions(problem, state).into_iter().zip(is_held);
    all.filter_map(|(reaction, is_held)| is_held.then_some(reaction))
        .collect()
}

/// Middle of mass of a body and its velocity.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyReport {
    /// Name of the body.
    pub name: String,
    /// Middle of mass.
    pub centre: Vec3,
    /// Its velocity.
    pub velocity: Vec3,
}

/// Reports of all bodies; collective. The middle is that of the volume in bodies without mass, and
/// the velocity that of the momentum: nodes whose mass is redistributed count with what they have.
pub fn bodies(problem: &Problem, state: &State) -> Vec<BodyReport> {
    let bodies = problem.model.bodies.iter().enumerate();
    bodies
        .map(|(body, model)| {
            let (mut mass, mut centre, mut velocity) = (0.0, Vec3::zeros(), Vec3::zeros());
            let elements = model.mesh.elements().zip(problem.elements[body].iter());
            for (at, (corners, element)) in elements.enumerate() {
                let at = ElementId::new(at);
                let density = match model.has_mass() {
                    true => model.density_of(problem.compositions[body].section(at)),
                    false => 1.0,
                };
                let nodes = problem.nodes(body, corners);
                for (&node, share) in nodes.iter().zip(element.mass(density)) {
                    let share: f64 = share.iter().sum();
                    mass += share;
                    centre += state.positions[node] * share;
                    if !model.has_mass() {
                        velocity += state.velocities[node] * share;
                    }
                }
                let moving = problem.masses[body].of_element(at);
                for (&node, share) in nodes.iter().zip(moving.chunks_exact(nodes.len())) {
                    velocity += state.velocities[node] * share.iter().sum::<f64>();
                }
            }
            let mass = problem.share.sum(mass);
            let mut sums = [centre, velocity];
            problem.share.sum_vectors(&mut sums);
            let [centre, velocity] = sums;
            BodyReport {
                name: model.name.clone(),
                centre: centre / mass,
                velocity: velocity / mass,
            }
        })
        .collect()
}

/// Resultants of a rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct RigidReport {
    /// Name of the body.
    pub name: String,
    /// Displacement of the reference point.
    pub displacement: Vec3,
    /// Angles turned about the fixed axes, in degrees.
    pub angles: Vec3,
    /// Torque that drives or holds it, about the reference point.
    pub torque: Vec3,
}

/// Reports of all rigid bodies.
pub fn rigid_bodies(problem: &Problem, state: &State) -> Vec<RigidReport> {
    let poses = problem.model.rigid_surfaces.iter().zip(&state.rigid);
    poses
        .enumerate()
        .map(|(index, (rigid, pose))| RigidReport {
            name: rigid.name.clone(),
            displacement: pose.displacement,
            angles: pose.turned.map(f64::to_degrees),
            torque: wrench(problem, state, index).torque,
        })
        .collect()
}

/// Force and torque that drive or hold a rigid body: against the nodes tied to it
/// and against contact.
fn wrench(problem: &Problem, state: &State, index: usize) -> Wrench {
    if problem.has_coordinates(index) {
        return state.forces.rigid[index];
    }
    let mut wrench = Wrench::default();
    let reference = problem.model.rigid_surfaces[index].reference;
    let point = reference + state.rigid[index].displacement;
    for pair in (0..problem.pairs.len()).filter(|&p| problem.pairs[p].rigid == Some(index)) {
        let side = side(problem, state, pair, Side::A);
        wrench.force += side.force;
        wrench.torque += side.moment - point.cross(&side.force);
    }
    wrench
}

fn report(problem: &Problem, state: &State, pair: usize) -> PairReport {
    let of_pair = &state.pairs[pair];
    let is_self_contact = problem.pairs[pair].contact.is_self_contact();
    let mut a = side(problem, state, pair, Side::A);
    let b = if problem.pairs[pair].rigid.is_some() {
        SideReport {
            force: -a.force,
            moment: -a.moment,
            ..a
        }
    } else {
        side(problem, state, pair, Side::B)
    };
    if is_self_contact {
        // Both walls are on side `a`, and their forces cancel: what one of them transmits.
        for sum in [
            &mut a.pressure,
            &mut a.friction,
            &mut a.area,
            &mut a.pressed,
        ] {
            *sum *= 0.5;
        }
    }
    let largest = a.load().max(b.load());
    let arm = a.area.max(b.area).sqrt();
    let over = |value: f64, scale: f64| if scale > 0.0 { value / scale } else { 0.0 };
    let nodes: Vec<&NodeResult> = of_pair.nodes.iter().flatten().collect();
    let count = |status| nodes.iter().filter(|node| node.status == status).count();
    PairReport {
        name: problem.model.pairs[pair].name.clone(),
        mismatch: over((a.force + b.force).norm(), largest),
        moment_mismatch: over((a.moment + b.moment).norm(), largest * arm),
        sides: [a, b],
        stick: count(Status::Stick),
        slip: count(Status::Slip),
        open: count(Status::Open),
        max_pressure: nodes.iter().map(|node| node.pressure).fold(0.0, f64::max),
        dissipated: of_pair.dissipated,
    }
}

fn side(problem: &Problem, state: &State, pair: usize, side: Side) -> SideReport {
    let mut sum = SideReport::default();
    let Some(surface) = problem.pairs[pair].contact.sides[side].surface() else {
        return sum;
    };
    let mut normal = 0.0;
    let facets: &[(FacetId, FacetForces)] = &state.pairs[pair].facets[side];
    for (facet, forces) in facets {
        sum.pressure += forces.pressure;
        sum.friction += forces.friction;
        sum.area += forces.area.iter().sum::<f64>();
        sum.pressed += forces.pressed;
        let corners = &surface.facets()[facet.index()];
        let n = normal_of(problem, state, (pair, side), corners);
        for (corner, force) in corners.iter().zip(&forces.force) {
            if let Some(node) = problem.surface_node(pair, side, *corner) {
                sum.force += force;
                sum.moment += state.positions[node].cross(force);
                normal -= force.dot(&n);
                sum.centre -= state.positions[node] * force.dot(&n);
            }
        }
    }
    sum.centre = match normal > 0.0 {
        true => sum.centre / normal,
        false => Vec3::zeros(),
    };
    sum
}

/// Unit normal of a facet, by its diagonals.
fn normal_of(
    problem: &Problem,
    state: &State,
    (pair, side): (usize, Side),
    corners: &[SurfaceNode; 4],
) -> Vec3 {
    let at = |corner: SurfaceNode| problem.surface_node(pair, side, corner);
    let [a, b, c, d] =
        corners.map(|corner| at(corner).map_or(Vec3::zeros(), |n| state.positions[n]));
    (c - a).cross(&(d - b)).normalize()
}
