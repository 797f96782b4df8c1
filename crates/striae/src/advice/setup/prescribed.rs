//! Loads on prescribed nodes, and contact of surfaces all of whose nodes are prescribed: neither
//! has an effect.

use std::collections::BTreeSet;

use striae_mesh::{Face, Mesh, NodeId};
use striae_model::{
    BodyId, ContactSurface, Freedom, Load, LoadKind, Model, NodalForce, Pair, Step, Value,
};

use super::super::{Advice, Topic};

/// Component of a normal that counts as zero.
const ACROSS: f64 = 0.1;
/// Names of the components.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Prescribed components of the nodes of every body.
type Prescribed = Vec<BTreeSet<(NodeId, usize)>>;

/// Warns of loads and pairs that do nothing, in the first step in which that is so.
pub(in crate::advice) fn look(model: &Model, advice: &mut Advice) {
    let mut prescribed: Prescribed = vec![BTreeSet::new(); model.bodies.len()];
    let mut free = vec![[false; 6]; model.rigid_surfaces.len()];
    let mut known = BTreeSet::new();
    for step in &model.steps {
        prescribe(&mut prescribed, step);
        for motion in &step.rigid_motions {
            let free = free[motion.surface.0].iter_mut();
            for (coordinate, free) in motion.coordinates.iter().zip(free) {
                *free = match coordinate {
                    Freedom::AsBefore => *free,
                    Freedom::To(_) => false,
                    Freedom::Free => true,
                };
            }
        }
        for load in &step.loads {
            idle(model, step, load, &prescribed, advice);
        }
        for force in &step.forces {
            idle_force(model, step, force, &prescribed, advice);
        }
        for (index, pair) in model.pairs.iter().enumerate() {
            let is_told = advice.warns_of(&pair.name, &[Topic::NeverMeets, Topic::Facing]);
            if !is_told && undecided(model, pair, &prescribed, &free) && known.insert(index) {
                undecided_text(model, pair, step, advice);
            }
        }
    }
}

fn prescribe(prescribed: &mut Prescribed, step: &Step) {
    for release in &step.releases {
        let nodes: BTreeSet<NodeId> = release.nodes.iter().copied().collect();
        prescribed[release.body.0]
            .retain(|(node, component)| !(release.components[*component] && nodes.contains(node)));
    }
    let stated = step.displacements.iter();
    for condition in stated.filter(|of| of.axes.are_global()) {
        for component in (0..3).filter(|at| condition.components[*at].is_some()) {
            let nodes = condition.nodes.iter().map(|node| (*node, component));
            prescribed[condition.body.0].extend(nodes);
        }
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

/// Warns of a load all of which acts on prescribed components.
fn idle(model: &Model, step: &Step, load: &Load, prescribed: &Prescribed, advice: &mut Advice) {
    let body = &model.bodies[load.body.0];
    let of_body = &prescribed[load.body.0];
    let Some(numbers) = load.kind.numbers().filter(|_| !of_body.is_empty()) else {
        return;
    };
    let mut acting = BTreeSet::new();
    let held = load.faces.iter().all(|&face| {
        let axes = axes(&body.mesh, face, &numbers);
        acting.extend(axes.iter().copied());
        let nodes = body.mesh.face_nodes(face);
        let held = |node: &NodeId| axes.iter().all(|axis| of_body.contains(&(*node, *axis)));
        nodes.iter().all(held)
    });
    if !held || acting.is_empty() {
        return;
    }
    let kind = match load.kind {
        LoadKind::Pressure(_) => "pressure",
        LoadKind::DeadTraction(_) | LoadKind::FollowerTraction(_) => "traction",
    };
    let what = format!("the {kind} on facets `{}`", load.set);
    idle_text(&body.name, step, &what, &acting, advice);
}

/// Warns of a force all of which acts on prescribed components.
fn idle_force(
    model: &Model,
    step: &Step,
    force: &NodalForce,
    prescribed: &Prescribed,
    advice: &mut Advice,
) {
    let of_body = &prescribed[force.body.0];
    let acts = |axis: &usize| force.force[*axis] != Value::Number(0.0);
    let acting: BTreeSet<usize> = (0..3).filter(acts).collect();
    let held = |node: &NodeId| acting.iter().all(|axis| of_body.contains(&(*node, *axis)));
    if !acting.is_empty() && force.nodes.iter().all(held) {
        let what = format!("the force at nodes `{}`", force.set);
        let name = &model.bodies[force.body.0].name;
        idle_text(name, step, &what, &acting, advice);
    }
}

fn idle_text(body: &str, step: &Step, what: &str, axes: &BTreeSet<usize>, advice: &mut Advice) {
    let along: Vec<&str> = axes.iter().map(|axis| AXES[*axis]).collect();
    let text = format!(
        "step `{}`: {what} of body `{body}` acts on nodes whose displacements along {} are all prescribed, so it only changes reactions; release these nodes, or remove the load",
        step.name,
        along.join(" and ")
    );
    advice.warn(Topic::Hold, body, text);
}

/// True where a rigid surface that nothing but the deck moves meets nodes that are all
/// prescribed along their normals. For two bodies that is a fault.
fn undecided(model: &Model, pair: &Pair, prescribed: &Prescribed, free: &[[bool; 6]]) -> bool {
    let ContactSurface::Rigid(rigid) = pair.b else {
        return false;
    };
    let tied = !model.rigid_surfaces[rigid.0].ties.is_empty();
    let ContactSurface::Deformable {
        body: BodyId(body),
        faces,
    } = &pair.a
    else {
        return false;
    };
    let (mesh, of_body) = (&model.bodies[*body].mesh, &prescribed[*body]);
    let held = |face: &Face| {
        let normal = mesh.area_vector(*face).normalize();
        let axes: Vec<usize> = (0..3).filter(|at| normal[*at].abs() > ACROSS).collect();
        let nodes = mesh.face_nodes(*face);
        let mut nodes = nodes.iter();
        nodes.all(|node| axes.iter().all(|axis| of_body.contains(&(*node, *axis))))
    };
    !tied && !free[rigid.0].contains(&true) && faces.iter().all(held)
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
