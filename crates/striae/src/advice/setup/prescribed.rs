//! Loads on prescribed nodes, and contact of surfaces all of whose nodes are prescribed: neither
//! has an effect.

use std::collections::BTreeSet;

use striae_contact::initial::Fit;
use striae_mesh::{Face, Mesh, NodeId};
use striae_model::{
    ContactSurface, LoadKind, Model, Pair, Step, Value,
    initial::opposed,
    plan::{PlannedForce, PlannedLoad, Prescription, StepPlan, plans},
};

use super::super::{Advice, Topic, hold::touches};

/// Component of a normal that counts as zero.
const ACROSS: f64 = 0.1;
/// Names of the components.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Warns of loads and pairs that do nothing, in the first step in which that is so.
pub(in crate::advice) fn look(model: &Model, fits: &[Option<Fit>], advice: &mut Advice) {
    let mut told = BTreeSet::new();
    let mut known = BTreeSet::new();
    for (step, plan) in model.steps.iter().zip(plans(model)) {
        let idle = Idle::all(model, step, &plan);
        for load in &idle {
            load.tell(step, &told, advice);
        }
        told = idle
            .into_iter()
            .map(|load| (load.body, load.what))
            .collect();
        for (index, (pair, fit)) in model.pairs.iter().zip(fits).enumerate() {
            let is_told = advice.warns_of(&pair.name, &[Topic::NeverMeets, Topic::Facing]);
            if !is_told && undecided(model, pair, fit.as_ref(), &plan) && known.insert(index) {
                undecided_text(model, pair, step, advice);
            }
        }
    }
}

/// A load all of which acts on prescribed components.
struct Idle<'m> {
    /// Name of the body.
    body: &'m str,
    /// Kind and place.
    what: String,
    /// Components on which it acts.
    axes: BTreeSet<usize>,
    /// `true` if this step states it, `false` if an earlier one does.
    is_stated: bool,
}

impl<'m> Idle<'m> {
    /// Loads in force in a step that act on prescribed components only.
    fn all(model: &'m Model, step: &Step, plan: &StepPlan) -> Vec<Self> {
        let loads = plan.loads.iter().filter_map(|load| {
            let kind = match load.to {
                LoadKind::Pressure(_) => "pressure",
                LoadKind::DeadTraction(_) | LoadKind::FollowerTraction(_) => "traction",
            };
            let mut stated = step.loads.iter().filter(|of| of.body == load.body);
            Some(Self {
                body: &model.bodies[load.body.0].name,
                what: format!("the {kind} on facets `{}`", load.set),
                axes: idle(model, load, plan)?,
                is_stated: stated.any(|of| of.set == load.set && of.kind.is_like(&load.to)),
            })
        });
        let forces = plan.forces.iter().filter_map(|force| {
            let mut stated = step.forces.iter().filter(|of| of.body == force.body);
            Some(Self {
                body: &model.bodies[force.body.0].name,
                what: format!("the force at nodes `{}`", force.set),
                axes: idle_force(force, plan)?,
                is_stated: stated.any(|of| of.set == force.set),
            })
        });
        loads.chain(forces).collect()
    }

    /// Warns of it, and of one of an earlier step only if it was not idle before.
    fn tell(&self, step: &Step, told: &BTreeSet<(&str, String)>, advice: &mut Advice) {
        let Self { body, what, .. } = self;
        let along: Vec<&str> = self.axes.iter().map(|axis| AXES[*axis]).collect();
        let (step, along) = (&step.name, along.join(" and "));
        let text = match self.is_stated {
            true => format!(
                "step `{step}`: {what} of body `{body}` acts on nodes whose displacements along {along} are all prescribed, so it only changes reactions; release these nodes, or remove the load"
            ),
            false if told.contains(&(*body, what.clone())) => return,
            false => format!(
                "step `{step}` prescribes the displacements along {along} of all nodes on which {what} of body `{body}` acts, which goes on from an earlier step and now only changes reactions; release these nodes, or set the load to zero"
            ),
        };
        advice.warn(Topic::Hold, body, text);
    }
}

/// Axes along which a load acts on a face.
fn axes(mesh: &Mesh, face: Face, kind: &LoadKind) -> Vec<usize> {
    let along = match kind {
        LoadKind::DeadTraction(t) | LoadKind::FollowerTraction(t) => *t,
        LoadKind::Pressure(p) => mesh.area_vector(face).normalize() * *p,
    };
    let size = along.norm();
    let axes = (0..3).filter(|axis| along[*axis].abs() > ACROSS * size);
    axes.collect()
}

/// Components on which a load acts, where all of them are prescribed.
fn idle(model: &Model, load: &PlannedLoad, plan: &StepPlan) -> Option<BTreeSet<usize>> {
    let mesh = &model.bodies[load.body.0].mesh;
    let numbers = load.to.numbers()?;
    let mut acting = BTreeSet::new();
    let held = load.faces.iter().all(|&face| {
        let axes = axes(mesh, face, &numbers);
        acting.extend(axes.iter().copied());
        holds(plan, load.body.0, &mesh.face_nodes(face), &axes)
    });
    (held && !acting.is_empty()).then_some(acting)
}

/// Components on which forces at nodes act, where all of them are prescribed.
fn idle_force(force: &PlannedForce, plan: &StepPlan) -> Option<BTreeSet<usize>> {
    let acts = |axis: &usize| force.to[*axis] != Value::Number(0.0);
    let acting: Vec<usize> = (0..3).filter(acts).collect();
    let held = holds(plan, force.body.0, &force.nodes, &acting);
    (held && !acting.is_empty()).then(|| acting.into_iter().collect())
}

/// True where components of all of some nodes of a body are prescribed.
fn holds(plan: &StepPlan, body: usize, nodes: &[NodeId], axes: &[usize]) -> bool {
    let is_held = |node: &NodeId, axis: &usize| {
        let component = (body, node.index(), *axis);
        plan.displacements.contains_key(&component)
    };
    let mut nodes = nodes.iter();
    nodes.all(|node| axes.iter().all(|axis| is_held(node, axis)))
}

/// True where a rigid surface that nothing but the deck moves meets nodes that are all
/// prescribed along their normals. For two bodies that is a fault. Faces that are not stated
/// because they touch must do so, and not be at rest.
fn undecided(model: &Model, pair: &Pair, fit: Option<&Fit>, plan: &StepPlan) -> bool {
    let (ContactSurface::Deformable { body, .. }, ContactSurface::Rigid(rigid)) =
        (&pair.a, &pair.b)
    else {
        return false;
    };
    let tied = !model.rigid_surfaces[rigid.0].ties.is_empty();
    let coordinates = &plan.rigid[rigid.0];
    let is_free = coordinates.iter().any(Option::is_none);
    let mesh = &model.bodies[body.0].mesh;
    let touches = fit.is_some_and(|fit| touches(fit, mesh));
    if tied || is_free || !(touches || pair.is_expected_to_touch()) {
        return false;
    }
    let [faces, _] = opposed(model, pair);
    let held = |face: &Face| {
        let normal = mesh.area_vector(*face).normalize();
        let axes: Vec<usize> = (0..3).filter(|at| normal[*at].abs() > ACROSS).collect();
        holds(plan, body.0, &mesh.face_nodes(*face), &axes)
    };
    let rests = |how: Option<&Prescription>| match how {
        Some(Prescription::Hold) => true,
        Some(Prescription::Go { target, .. }) => *target == Value::Number(0.0),
        None => false,
    };
    let is_at_rest = |node: &NodeId| {
        let component = |axis| plan.displacements.get(&(body.0, node.index(), axis));
        (0..3).all(|axis| rests(component(axis)))
    };
    let are_at_rest = || {
        let mut nodes = faces.iter().flat_map(|face| mesh.face_nodes(*face));
        coordinates.iter().all(|how| rests(how.as_ref())) && nodes.all(|node| is_at_rest(&node))
    };
    faces.iter().all(held) && (pair.is_expected_to_touch() || !are_at_rest())
}

fn undecided_text(model: &Model, pair: &Pair, step: &Step, advice: &mut Advice) {
    let (ContactSurface::Deformable { body, .. }, ContactSurface::Rigid(rigid)) =
        (&pair.a, &pair.b)
    else {
        return;
    };
    let text = format!(
        "pair `{}`: in step `{}` displacements prescribe all nodes of the contact surface of `{}` along its normal, and `{}` is not free: contact has no effect there, whatever the overlap; prescribe nodes away from the contact surface, such as those of the opposite face",
        pair.name, step.name, model.bodies[body.0].name, model.rigid_surfaces[rigid.0].name
    );
    advice.warn(Topic::Hold, &pair.name, text);
}
