//! Part of a model held by a rank, with local numbers.

use striae_mesh::{CellBlock, ElementId, Mesh, NodeId, Sets};

use super::numbers::Numbers;
use striae_model::{
    Body, BodyId, BodySection, ContactSurface, Displacement, Load, Model, NodalForce, Pair,
    Release, RigidSurface, Step, Tie,
};

/// The part of a model that is made of elements and nodes which are here, and all else.
pub(super) fn local(model: &Model, numbers: &Numbers) -> Model {
    let bodies = model.bodies.iter().enumerate();
    let side = |side: &ContactSurface| local_side(side, numbers);
    let pair = |pair: &Pair| Pair {
        a: side(&pair.a),
        b: side(&pair.b),
        ..pair.clone()
    };
    let tie = |tie: &Tie| Tie {
        a: side(&tie.a),
        b: side(&tie.b),
        ..tie.clone()
    };
    let steps = model.steps.iter();
    Model {
        title: model.title.clone(),
        bodies: bodies
            .map(|(at, body)| local_body(at, body, numbers))
            .collect(),
        rigid_surfaces: (model.rigid_surfaces.iter())
            .map(|rigid| local_rigid(rigid, numbers))
            .collect(),
        pairs: model.pairs.iter().map(pair).collect(),
        ties: model.ties.iter().map(tie).collect(),
        // Ranks have neither of these, see `Problem::shared`.
        springs: Vec::new(),
        cavities: Vec::new(),
        steps: steps.map(|step| local_step(step, numbers)).collect(),
        solver: model.solver.clone(),
    }
}

fn local_body(at: usize, body: &Body, numbers: &Numbers) -> Body {
    let element = |element: &ElementId| numbers.element(at, *element);
    let section = |section: &BodySection| BodySection {
        set: section.set.clone(),
        elements: section.elements.iter().filter_map(element).collect(),
        material: section.material.clone(),
        formulation: section.formulation,
        density: section.density,
    };
    Body {
        name: body.name.clone(),
        mesh: local_mesh(at, &body.mesh, numbers),
        material: body.material.clone(),
        formulation: body.formulation,
        density: body.density,
        contact_mass: body.contact_mass,
        sections: body.sections.iter().map(section).collect(),
    }
}

/// The elements of a body that are here, in as many blocks as there are in the whole, and the
/// nodes that are held.
fn local_mesh(body: usize, mesh: &Mesh, numbers: &Numbers) -> Mesh {
    let mut first = 0;
    let block = |block: &CellBlock| {
        let cells = (first..).map(ElementId::new).zip(block.cells());
        first += block.len();
        let own = cells.filter(|(id, _)| numbers.element(body, *id).is_some());
        let nodes = own.flat_map(|(_, corners)| corners);
        CellBlock {
            kind: block.kind,
            nodes: nodes
                .map(|node| numbers.held_in_mesh(body, *node))
                .collect(),
        }
    };
    let blocks = mesh.blocks.iter().map(block).collect();
    let nodes = (0..mesh.positions.len()).map(NodeId::new);
    let held = nodes.filter(|node| numbers.in_mesh(body, *node).is_some());
    Mesh {
        positions: held.map(|node| mesh.positions[node.index()]).collect(),
        blocks,
        node_sets: local_sets(&mesh.node_sets, |node| numbers.in_mesh(body, node)),
        facet_sets: local_sets(&mesh.facet_sets, |face| numbers.face(body, face)),
        element_sets: local_sets(&mesh.element_sets, |id| numbers.element(body, id)),
    }
}

fn local_sets<T: Ord + Copy>(sets: &Sets<T>, local: impl Fn(T) -> Option<T>) -> Sets<T> {
    let mut found = Sets::default();
    for (name, members) in sets.iter() {
        found.insert(name, members.iter().filter_map(|member| local(*member)));
    }
    found
}

fn local_side(side: &ContactSurface, numbers: &Numbers) -> ContactSurface {
    match side {
        ContactSurface::Deformable { body, faces } => ContactSurface::Deformable {
            body: *body,
            faces: (faces.iter())
                .filter_map(|face| numbers.face(body.0, *face))
                .collect(),
        },
        ContactSurface::Rigid(rigid) => ContactSurface::Rigid(*rigid),
        ContactSurface::Itself => ContactSurface::Itself,
    }
}

fn local_nodes(body: BodyId, nodes: &[NodeId], numbers: &Numbers) -> Vec<NodeId> {
    let nodes = nodes.iter();
    let local = nodes.filter_map(|node| numbers.in_mesh(body.0, *node));
    local.collect()
}

fn local_rigid(rigid: &RigidSurface, numbers: &Numbers) -> RigidSurface {
    let ties = rigid.ties.iter();
    let ties = ties.map(|(body, nodes)| (*body, local_nodes(*body, nodes, numbers)));
    RigidSurface {
        ties: ties.collect(),
        ..rigid.clone()
    }
}

fn local_step(step: &Step, numbers: &Numbers) -> Step {
    let displacement = |of: &Displacement| Displacement {
        nodes: local_nodes(of.body, &of.nodes, numbers),
        set: of.set.clone(),
        body: of.body,
        axes: of.axes,
        components: of.components.clone(),
        curve: of.curve.clone(),
    };
    let release = |of: &Release| Release {
        nodes: local_nodes(of.body, &of.nodes, numbers),
        body: of.body,
        components: of.components,
    };
    let load = |of: &Load| Load {
        faces: (of.faces.iter())
            .filter_map(|face| numbers.face(of.body.0, *face))
            .collect(),
        set: of.set.clone(),
        body: of.body,
        kind: of.kind.clone(),
        extent: of.extent,
        curve: of.curve.clone(),
    };
    let force = |of: &NodalForce| NodalForce {
        nodes: local_nodes(of.body, &of.nodes, numbers),
        ..of.clone()
    };
    Step {
        forces: step.forces.iter().map(force).collect(),
        displacements: step.displacements.iter().map(displacement).collect(),
        releases: step.releases.iter().map(release).collect(),
        loads: step.loads.iter().map(load).collect(),
        name: step.name.clone(),
        duration: step.duration,
        procedure: step.procedure,
        increments: step.increments,
        velocities: step.velocities.clone(),
        gravity: step.gravity.clone(),
        actuations: step.actuations.clone(),
        fillings: step.fillings.clone(),
        rigid_motions: step.rigid_motions.clone(),
        frictions: step.frictions.clone(),
    }
}
