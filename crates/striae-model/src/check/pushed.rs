//! Bodies and rigid bodies that contact can only push away.
//!
//! Contact pushes and never pulls. Where all faces of a body that can touch push it the same way
//! along an axis, no node is prescribed along that axis and the loads do not push it back, no
//! quasi-static equilibrium with a contact force exists: the body flies off. Every step is judged,
//! with the loads that it has from earlier ones: they may not pull on the way, and must press at
//! some time.
//!
//! ```text
//! d_j > mu |d - d_j e_j| for the push d = -n of every facet,  f_j >= 0  ->  pushed away along +j
//! ```
//!
//! With friction, forces lie in a cone about `d`: a block stands on a rough slope. A pair that is
//! stabilised carries a body that nothing loads, but none that is pulled: what it resists with is
//! gone at the end of the step. Inertia holds what has mass.

use crate::{
    fault::{Fault, FaultKind},
    initial::opposed,
    model::{
        Body, BodyId, CavityContent, ContactSurface, LoadExtent, LoadKind, Model, Moment, Mover,
        Procedure, RigidId, Step,
    },
    path::Path,
    plan::{Prescription, StepPlan, plans},
};
use striae_law::friction::Friction;
use striae_mesh::{Face, Mesh, NodeId, Vec3};

/// Component of a push that counts as zero.
const ACROSS: f64 = 0.17;
/// Friction over pressure at most, in multiples of the largest coefficient at rest.
const LARGEST: f64 = 3.0;
/// Resultant over the sum of the magnitudes of loads that counts as zero.
const NO_LOAD: f64 = 1e-9;
/// Parts of a step at whose ends loads are looked at.
const PARTS: usize = 8;

/// Every body, or piece of one, that can only be pushed away, in the first step in which it can.
pub(super) fn faults(model: &Model) -> Vec<Fault> {
    let plans = plans(model);
    let bodies = (0..model.bodies.len()).map(BodyId);
    let bodies = bodies.filter(|body| !is_joined(model, *body));
    let opposed: Vec<[Vec<Face>; 2]> = model.pairs.iter().map(|of| opposed(model, of)).collect();
    let pieces = bodies.flat_map(|body| pieces(model, body, &opposed));
    let rigid = (0..model.rigid_surfaces.len()).map(RigidId);
    let rigid = rigid.filter(|rigid| {
        let untied = model.rigid_surfaces[rigid.0].ties.is_empty();
        untied && !is_sprung(model, Mover::Rigid(*rigid))
    });
    let rigid = rigid.map(|rigid| Pushed::rigid(model, rigid, &opposed));
    let movers = pieces.chain(rigid);
    movers
        .filter_map(|mover| {
            // Directions of contact are those of the meshes: what has turned is not judged any more,
            // nor what may have come to face other surfaces.
            let steps = model.steps.iter().zip(&plans).enumerate();
            let mut steps = steps.take_while(|(index, _)| {
                let before = model.steps.iter().zip(&plans).take(*index);
                let is_known = *index == 0 || mover.is_expected_to_touch(model);
                is_known
                    && !before
                        .into_iter()
                        .any(|(step, plan)| mover.turns(model, step, plan))
            });
            steps.find_map(|(index, (step, plan))| {
                let kind = mover.away(model, step, plan)?;
                let path = Path::part("steps", index);
                Some(Fault { path, kind })
            })
        })
        .collect()
}

/// Returns whether a spring acts on a body; one without stiffness may be what presses it on.
fn is_sprung(model: &Model, mover: Mover) -> bool {
    let mut springs = model.springs.iter();
    springs.any(|spring| spring.ends().any(|end| end.is_on(mover)))
}

/// Returns whether ties or springs join a body to others or to ground.
fn is_joined(model: &Model, body: BodyId) -> bool {
    let mut to_rigid = model.rigid_surfaces.iter().flat_map(|rigid| &rigid.ties);
    is_sprung(model, Mover::Deformable(body))
        || to_rigid.any(|(tied, _)| *tied == body)
        || model.ties.iter().any(|tie| tie.joins(body))
}

/// A piece of a body or a rigid body, with what touches it.
struct Pushed<'m> {
    /// Its name, as the object of a sentence.
    name: String,
    of: Of<'m>,
    /// Position of a pair and unit directions along which its facets push.
    pairs: Vec<(usize, Vec<Vec3>)>,
}

/// A mover.
enum Of<'m> {
    Piece {
        body: BodyId,
        mesh: &'m Mesh,
        nodes: Vec<NodeId>,
    },
    Rigid(RigidId),
}

fn pieces<'m>(model: &'m Model, body: BodyId, opposed: &[[Vec<Face>; 2]]) -> Vec<Pushed<'m>> {
    let Body { name, mesh, .. } = &model.bodies[body.0];
    let pieces = mesh.pieces();
    let count = pieces.len();
    let is_own = |side: &ContactSurface| matches!(side, ContactSurface::Deformable { body: of, .. } if *of == body);
    let mut pairs = model.pairs.iter();
    if count > 1 && pairs.any(|pair| pair.is_within_a_body() && is_own(&pair.a)) {
        // They may push each other.
        return Vec::new();
    }
    let pushed = pieces.into_iter().map(|nodes| {
        let own = |face: &&Face| nodes.binary_search(&mesh.face_nodes(**face)[0]).is_ok();
        let pushes = |(side, faces): (&ContactSurface, &Vec<Face>)| match side {
            ContactSurface::Deformable { body: of, .. } if *of == body => {
                let faces = faces.iter().filter(own);
                faces.map(|face| -mesh.area_vector(*face).normalize()).collect()
            }
            _ => Vec::new(),
        };
        // A piece does not push itself anywhere.
        let pairs = model.pairs.iter().zip(opposed).enumerate();
        let pairs = pairs.filter(|(_, (pair, _))| !pair.is_within_a_body());
        let pairs = pairs.map(|(at, (pair, [on_a, on_b]))| {
            (at, [pushes((&pair.a, on_a)), pushes((&pair.b, on_b))].concat())
        });
        Pushed {
            name: match count {
                1 => format!("body `{name}`"),
                _ => format!(
                    "the piece with {} of body `{name}`, which is made of {count} pieces that share no nodes (merge coincident nodes in the mesh if they belong together),",
                    nodes[0]
                ),
            },
            pairs: pairs.filter(|(_, pushes)| !pushes.is_empty()).collect(),
            of: Of::Piece { body, mesh, nodes },
        }
    });
    pushed.collect()
}

impl<'m> Pushed<'m> {
    fn rigid(model: &'m Model, rigid: RigidId, opposed: &[[Vec<Face>; 2]]) -> Self {
        let is = |side: &ContactSurface| matches!(side, ContactSurface::Rigid(of) if *of == rigid);
        let pushes = |(side, faces): (&ContactSurface, &Vec<Face>)| match side {
            ContactSurface::Deformable { body, .. } => {
                let mesh = &model.bodies[body.0].mesh;
                let faces = faces.iter();
                faces
                    .map(|face| mesh.area_vector(*face).normalize())
                    .collect()
            }
            ContactSurface::Rigid(_) | ContactSurface::Itself => Vec::new(),
        };
        let pairs = model.pairs.iter().zip(opposed).enumerate();
        let pairs = pairs.filter_map(|(at, (pair, [on_a, on_b]))| {
            let pushes = match (is(&pair.a), is(&pair.b)) {
                (true, _) => pushes((&pair.b, on_b)),
                (_, true) => pushes((&pair.a, on_a)),
                _ => return None,
            };
            (!pushes.is_empty()).then_some((at, pushes))
        });
        Self {
            name: format!("rigid body `{}`", model.rigid_surfaces[rigid.0].name),
            of: Of::Rigid(rigid),
            pairs: pairs.collect(),
        }
    }

    /// The fault that a step lets it be pushed away.
    fn away(&self, model: &Model, step: &Step, plan: &StepPlan) -> Option<FaultKind> {
        if self.has_inertia(model, step) || self.is_uncertain(model, plan) {
            return None;
        }
        let free = (0..3).filter(|axis| !self.is_held(plan, *axis));
        let mut found = free.filter_map(|axis| {
            let sign = self.sign(&plan.frictions, axis)?;
            let load = self.pull(model, plan, axis, sign)?;
            let side = if sign > 0.0 { '+' } else { '-' };
            Some((load, format!("{side}{}", ["x", "y", "z"][axis])))
        });
        let (load, direction) = found.next()?;
        let pairs = self.pairs.iter();
        Some(FaultKind::PushedAway {
            mover: self.name.clone(),
            direction,
            step: step.name.clone(),
            load,
            pairs: pairs.map(|(at, _)| model.pairs[*at].name.clone()).collect(),
        })
    }

    /// Returns whether all its faces are stated because they touch.
    fn is_expected_to_touch(&self, model: &Model) -> bool {
        let mut pairs = self.pairs.iter();
        pairs.all(|(pair, _)| model.pairs[*pair].is_expected_to_touch())
    }

    /// True where a step may turn it, or a rigid body that it touches.
    fn turns(&self, model: &Model, step: &Step, plan: &StepPlan) -> bool {
        let is_turned = |rigid: RigidId| {
            let angle = |how: &Prescription| how.at([0.0; 2], &Vec3::zeros(), plan.end());
            let mut turns = plan.rigid[rigid.0][3..].iter();
            turns.any(|turn| turn.as_ref().is_none_or(|how| angle(how) != 0.0))
        };
        let is_own = match self.of {
            Of::Piece { body, .. } => {
                let mut conditions = step.displacements.iter();
                conditions.any(|of| of.body == body && of.varies())
            }
            Of::Rigid(rigid) => is_turned(rigid),
        };
        let mut pairs = self.pairs.iter().map(|(pair, _)| &model.pairs[*pair]);
        is_own
            || pairs.any(|pair| {
                let mut sides = pair.surfaces().into_iter();
                sides.any(|side| matches!(side, ContactSurface::Rigid(of) if is_turned(*of)))
            })
    }

    /// True where inertia resists.
    fn has_inertia(&self, model: &Model, step: &Step) -> bool {
        let has_mass = match self.of {
            Of::Piece { .. } => true,
            Of::Rigid(rigid) => model.rigid_surfaces[rigid.0].inertia.is_some(),
        };
        has_mass && step.procedure != Procedure::QuasiStatic
    }

    /// True of loads that turn, act on what is exposed or come from a cavity: they have no force
    /// that is known before a run.
    fn is_uncertain(&self, model: &Model, plan: &StepPlan) -> bool {
        let Of::Piece { body, .. } = &self.of else {
            return false;
        };
        let mut loads = plan.loads.iter().filter(|load| load.body == *body);
        let mut cavities = model.cavities.iter().zip(&plan.cavities);
        loads.any(|load| {
            matches!(load.to, LoadKind::FollowerTraction(_)) || load.extent != LoadExtent::Whole
        }) || cavities.any(|(cavity, of)| {
            let filled = of.curve.is_some() || of.content != CavityContent::Pressure(0.0);
            filled && cavity.parts.iter().any(|(of, _)| of == body)
        })
    }

    /// True where something is prescribed along an axis.
    fn is_held(&self, plan: &StepPlan, axis: usize) -> bool {
        let (body, nodes) = match &self.of {
            Of::Rigid(rigid) => return plan.rigid[rigid.0][axis].is_some(),
            Of::Piece { body, nodes, .. } => (body.0, nodes),
        };
        nodes.iter().any(|node| {
            let node = node.index();
            let oblique = plan.oblique.get(&(body, node)).into_iter().flatten();
            let mut across = oblique.filter(|of| of.direction[axis].abs() > ACROSS);
            plan.displacements.contains_key(&(body, node, axis)) || across.next().is_some()
        })
    }

    /// Sign of the pushes along an axis where all have the same.
    fn sign(&self, frictions: &[Friction], axis: usize) -> Option<f64> {
        let pushes = self.pairs.iter().flat_map(|(pair, pushes)| {
            let coefficient = frictions[*pair].coefficient();
            let factors = [
                coefficient.by_pressure().largest_factor(),
                coefficient.by_slip().largest_factor(),
            ];
            let mu = LARGEST * coefficient.at_rest() * factors.iter().product::<f64>();
            pushes.iter().map(move |push| (push[axis], mu))
        });
        let mut pushes = pushes.peekable();
        let sign = pushes.peek()?.0.signum();
        let beyond = |(push, mu): (f64, f64)| {
            let across = (1.0 - push * push).max(0.0).sqrt();
            push * sign > ACROSS.max(mu * across)
        };
        pushes.all(beyond).then_some(sign)
    }

    /// The largest force of loads in the direction of the pushes if they pull in the step, zero if
    /// nothing presses in it.
    fn pull(&self, model: &Model, plan: &StepPlan, axis: usize, sign: f64) -> Option<f64> {
        let mut pairs = self.pairs.iter();
        let is_stabilised = pairs.any(|(pair, _)| model.pairs[*pair].stabilised);
        let load = |part: usize| {
            let moment = plan.start.later(part as f64 / PARTS as f64);
            self.load(model, plan, moment, (axis, sign))
        };
        let last = load(PARTS);
        if is_stabilised {
            return (last > 0.0).then_some(last);
        }
        let loads: Vec<f64> = (0..PARTS).map(load).chain([last]).collect();
        let largest = loads.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // A load that has come down to zero at the end of the step has held it until then.
        let presses = loads[1..].iter().any(|load| *load < 0.0);
        (largest > 0.0 || !presses).then_some(largest)
    }

    /// Force of all loads along an axis at a moment.
    fn load(
        &self,
        model: &Model,
        plan: &StepPlan,
        moment: Moment,
        (axis, sign): (usize, f64),
    ) -> f64 {
        let gravity = sign * plan.gravity.at(moment)[axis];
        let (mut loads, masses) = match &self.of {
            Of::Rigid(rigid) => {
                let of = &model.rigid_surfaces[rigid.0];
                let mass = of.inertia.map_or(0.0, |inertia| inertia.mass);
                let force = plan.driving[rigid.0][0].at(moment)[axis];
                (vec![force], [mass; 2])
            }
            Of::Piece { body, mesh, nodes } => {
                let of = &model.bodies[body.0];
                let loads = of_piece(plan, moment, (*body, *mesh), nodes, axis);
                (loads, masses(of, nodes))
            }
        };
        loads.iter_mut().for_each(|load| *load *= sign);
        // Of densities that differ, that which holds it best.
        loads.push(
            masses
                .map(|mass| mass * gravity)
                .into_iter()
                .fold(f64::INFINITY, f64::min),
        );
        let sum: f64 = loads.iter().sum();
        let all: f64 = loads.iter().map(|load| load.abs()).sum();
        if sum.abs() > NO_LOAD * all { sum } else { 0.0 }
    }
}

/// Components of the forces of loads on a piece of a body.
fn of_piece(
    plan: &StepPlan,
    moment: Moment,
    (body, mesh): (BodyId, &Mesh),
    nodes: &[NodeId],
    axis: usize,
) -> Vec<f64> {
    let mut all = Vec::new();
    let own = |node: &NodeId| nodes.binary_search(node).is_ok();
    for of in plan.forces.iter().filter(|of| of.body == body) {
        let force = of.at(moment);
        let on = of.nodes.iter().filter(|node| own(node));
        all.extend(on.map(|node| force[axis].at(&mesh.positions[node.index()], 0.0)));
    }
    for of in plan.loads.iter().filter(|load| load.body == body) {
        let load = of.at(moment);
        let on = of
            .faces
            .iter()
            .filter(|face| own(&mesh.face_nodes(**face)[0]));
        all.extend(on.map(|face| {
            let area = mesh.area_vector(*face);
            let corners = mesh.face_positions(*face);
            match load.at(&(corners.iter().sum::<Vec3>() / 4.0)) {
                LoadKind::DeadTraction(t) | LoadKind::FollowerTraction(t) => t[axis] * area.norm(),
                LoadKind::Pressure(pressure) => -pressure * area[axis],
            }
        }));
    }
    all
}

/// Least and largest mass that a piece of a body can have by the densities of the body.
fn masses(body: &Body, nodes: &[NodeId]) -> [f64; 2] {
    let part = nodes.len() as f64 / body.mesh.positions.len() as f64;
    let own = body.used_sections().contains(&0).then_some(body.density);
    let densities = own
        .into_iter()
        .chain(body.sections.iter().map(|of| of.density));
    let volume = part * body.mesh.volume();
    let [least, most] = densities.fold([f64::INFINITY, 0.0], |[least, most], density| {
        [density.min(least), density.max(most)]
    });
    [least.min(most), most].map(|density| density * volume)
}
