//! Joints within and between bodies: nodes at one place that are not joined, pieces that
//! share no nodes, and bodies that touch although no pair or tie joins them.

use striae_law::friction::Friction;
use striae_mesh::{Vec3, place};
use striae_model::{
    Body, BodyId, ContactSurface, Enforcement, Initial, Model, Pair, initial::fits,
};

use super::{Advice, Topic, shape::extent};

/// Distance over the size of an element within which bodies touch.
const TOUCHING: f64 = 1e-3;
/// Nodes of two bodies up to which it is looked whether they touch.
const COUNTED: usize = 60_000;

/// Warns of what seems to be joined and is not.
pub(super) fn look(model: &Model, advice: &mut Advice) {
    for body in &model.bodies {
        pieces(body, advice);
    }
    for second in 0..model.bodies.len() {
        for first in 0..second {
            touching(model, BodyId(first), BodyId(second), advice);
        }
    }
}

fn pieces(body: &Body, advice: &mut Advice) {
    let name = &body.name;
    let pieces = body.mesh.pieces();
    if pieces.len() > 1 {
        let shown = pieces.iter().take(4).map(|piece| {
            let x = body.mesh.positions[piece[0].index()];
            let place = place(&x);
            format!("{} nodes with {} at {place}", piece.len(), piece[0])
        });
        let shown = shown.collect::<Vec<_>>().join("; ");
        let count = pieces.len();
        let text = format!("body `{name}` is made of {count} pieces that share no nodes: {shown}");
        advice.note(Topic::Shape, name, text);
    }
    let coincident = body.mesh.coincident_nodes();
    if let Some([first, second]) = coincident.first() {
        let x = body.mesh.positions[first.index()];
        advice.warn(
            Topic::Shape,
            name,
            format!(
                "body `{name}`: pairs of coincident nodes that are not joined: {}, the first {first} and {second} at {}; elements separate there without resistance. Merge coincident nodes in the mesh generator, unless a slit is intended",
                coincident.len(), place(&x)
            ),
        );
    }
}

/// Warns of two bodies that touch without a pair or a tie.
fn touching(model: &Model, first: BodyId, second: BodyId, advice: &mut Advice) {
    let bodies = [first, second].map(|id| &model.bodies[id.0]);
    let nodes: usize = bodies.iter().map(|body| body.mesh.positions.len()).sum();
    let tolerance = bodies.map(|body| TOUCHING * body.mesh.characteristic_size());
    let tolerance = tolerance[0].min(tolerance[1]);
    let [[low, high], [from, to]] = bodies.map(|body| extent(&body.mesh));
    let apart = |a: &Vec3, b: &Vec3| (0..3).any(|axis| a[axis] > b[axis] + tolerance);
    let near = !apart(&low, &to) && !apart(&from, &high);
    if nodes > COUNTED || !near || joined(model, first, second) {
        return;
    }
    let trial = Model {
        bodies: Vec::from(bodies.map(Body::clone)),
        rigid_surfaces: Vec::new(),
        pairs: vec![whole(bodies)],
        ties: Vec::new(),
        springs: Vec::new(),
        cavities: Vec::new(),
        steps: Vec::new(),
        title: String::new(),
        solver: model.solver.clone(),
    };
    let fit = fits(&trial).into_iter().next().flatten();
    let touches = fit.is_some_and(|fit| fit.distance <= tolerance || fit.overlap.is_some());
    if touches {
        let [a, b] = bodies.map(|body| &body.name);
        advice.warn(
            Topic::Fit,
            a,
            format!(
                "bodies `{a}` and `{b}` touch or overlap as meshed, but no pair and no tie joins them, so they pass through each other; add a [[pair]] or a [[tie]], or in contact of everything remove the `exclude` of their contact"
            ),
        );
    }
}

/// A pair of the whole surfaces of two bodies.
fn whole(bodies: [&Body; 2]) -> Pair {
    let side = |body: usize| ContactSurface::Deformable {
        body: BodyId(body),
        faces: bodies[body].mesh.boundary_faces(),
    };
    Pair {
        name: String::new(),
        a: side(0),
        b: side(1),
        textures: [None, None],
        friction: Friction::frictionless(),
        enforcement: Enforcement::default(),
        search_distance: None,
        initial: Initial::AsMeshed,
        interference: None,
        wear: [0.0; 2],
        wear_across: 1.0,
        stabilised: false,
        feature_angle: None,
    }
}

/// True where a pair, a tie or a rigid body joins two bodies.
fn joined(model: &Model, first: BodyId, second: BodyId) -> bool {
    let is = |side: &ContactSurface, id: BodyId| matches!(side, ContactSurface::Deformable { body, .. } if *body == id);
    let mut pairs = model.pairs.iter();
    let mut ties = model.ties.iter();
    let mut rigid = model.rigid_surfaces.iter();
    let both = |a: &ContactSurface, b: &ContactSurface| {
        is(a, first) && is(b, second) || is(a, second) && is(b, first)
    };
    pairs.any(|pair| both(&pair.a, &pair.b))
        || ties.any(|tie| both(&tie.a, &tie.b))
        || rigid.any(|rigid| {
            let tied = |id: BodyId| rigid.ties.iter().any(|(of, _)| *of == id);
            tied(first) && tied(second)
        })
}
