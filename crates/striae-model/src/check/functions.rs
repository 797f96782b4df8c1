//! Targets that are no finite numbers somewhere.

use crate::{
    fault::FaultKind,
    model::{BodyId, Course, Curve, History, LoadKind, Moment, Step, Value},
    path::Path,
};
use striae_mesh::{NodeId, Vec3};

use super::{Draft, List};

/// Moments of a step at which functions are looked at, but for its start.
const MOMENTS: usize = 40;

/// Moments spread over the step that starts then.
fn moments(start: Moment) -> impl Iterator<Item = Moment> + Clone {
    (0..=MOMENTS).map(move |at| start.later(at as f64 / MOMENTS as f64))
}

/// Notes every target of a step that is no finite number at a node or within a face.
pub(super) fn of_step(
    draft: &Draft<'_>,
    (step, start): (&Step, Moment),
    path: &Path,
    faults: &mut List,
) {
    let mesh_of = |body: BodyId| draft.bodies.get(body.0).and_then(|body| body.mesh);
    curves(step, start, path, faults);
    let mut look = |list, index, value: &Value, points: &mut dyn Iterator<Item = Vec3>| {
        if let Some(kind) = undefined(value, start, points) {
            faults.push(path.clone().field(list).index(index), kind);
        }
    };
    for (index, of) in step.displacements.iter().enumerate() {
        let mesh = mesh_of(of.body);
        for value in of.components.iter().flatten() {
            let at = |node: &NodeId| mesh?.positions.get(node.index()).copied();
            look(
                "displacements",
                index,
                value,
                &mut of.nodes.iter().filter_map(at),
            );
        }
    }
    for (index, of) in step.forces.iter().enumerate() {
        let mesh = mesh_of(of.body);
        for value in of.force.iter() {
            let at = |node: &NodeId| mesh?.positions.get(node.index()).copied();
            look("forces", index, value, &mut of.nodes.iter().filter_map(at));
        }
    }
    for (index, of) in step.loads.iter().enumerate() {
        let Some(mesh) = mesh_of(of.body) else {
            continue;
        };
        let values = match &of.kind {
            LoadKind::DeadTraction(t) | LoadKind::FollowerTraction(t) => t.as_slice(),
            LoadKind::Pressure(p) => std::slice::from_ref(p),
        };
        for value in values {
            // Within faces, as loads are: a function may have none at an edge.
            let points = of.faces.iter().flat_map(|face| {
                let corners = mesh.face_positions(*face);
                let middle = corners.iter().sum::<Vec3>() / 4.0;
                corners.map(|corner| (corner + middle) / 2.0)
            });
            look("loads", index, value, &mut { points });
        }
    }
}

/// Notes every curve that is a function of time without a finite value at some moment.
fn curves(step: &Step, start: Moment, path: &Path, faults: &mut List) {
    let displacements = step.displacements.iter().map(|of| &of.curve);
    let loads = step.loads.iter().map(|of| &of.curve);
    let forces = step.forces.iter().map(|of| &of.curve);
    let motions = step.rigid_motions.iter().map(|of| &of.curve);
    let lists: [(_, Vec<&Curve>); 4] = [
        ("displacements", displacements.collect()),
        ("loads", loads.collect()),
        ("forces", forces.collect()),
        ("rigid_motions", motions.collect()),
    ];
    for (list, curves) in lists {
        for (index, curve) in curves.into_iter().enumerate() {
            let Curve::History(History {
                course: Course::Function(function),
                ..
            }) = curve
            else {
                continue;
            };
            let lost = moments(start).find(|moment| !curve.at(*moment).is_finite());
            if let Some(moment) = lost {
                let (function, t) = (function.text().to_owned(), moment.time);
                let path = path.clone().field(list).index(index);
                faults.push(path, FaultKind::UndefinedCurve { function, t });
            }
        }
    }
}

fn undefined(
    value: &Value,
    start: Moment,
    points: &mut dyn Iterator<Item = Vec3>,
) -> Option<FaultKind> {
    let function = match value {
        Value::Function(function) => function,
        Value::Number(number) if number.is_finite() => return None,
        Value::Number(number) => {
            return Some(FaultKind::Range {
                what: "a target".to_owned(),
                expected: "a finite number",
                found: *number,
            });
        }
    };
    let times = if function.moves() { MOMENTS } else { 0 };
    let lost = |x: Vec3| {
        let mut times = moments(start).take(times + 1).map(|moment| moment.time);
        let t = times.find(|t| !function.at(&x, *t).is_finite())?;
        Some(FaultKind::Undefined {
            function: function.text().to_owned(),
            x: x.into(),
            t,
        })
    };
    points.filter_map(lost).next()
}
