//! Springs and dashpots.

use super::{nonzero::nonzero, surfaces::Surfaces};
use crate::{faults::FaultList, names::Names, raw, read::At, value::vector};
use striae_model::{FaultKind as ModelFault, RigidId, Spring, SpringEnd, SpringLine, SpringRest};

/// The springs; `None` for the faulty ones.
pub(super) fn springs(
    raw: &[At<raw::Spring>],
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Vec<Option<Spring>> {
    let names = raw.iter().map(|at| at.value.name.as_ref());
    Names::new("spring", names, faults);
    let lower = |spring: &At<raw::Spring>| lower(spring, surfaces, faults);
    raw.iter().map(lower).collect()
}

fn lower(
    at: &At<raw::Spring>,
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Option<Spring> {
    let raw = &at.value;
    let a = raw.a.as_ref().and_then(|end| match &end.value {
        raw::SpringEnd::Nodes(nodes) => of_nodes(nodes, surfaces, faults),
        raw::SpringEnd::Rigid(point) => of_rigid(point, surfaces, faults),
    });
    let line = line(at, surfaces, faults);
    let rest = rest(at, faults);
    Some(Spring {
        name: raw.name.as_ref()?.value.0.clone(),
        a: a?,
        line: line?,
        stiffness: raw.stiffness.as_ref().map_or(0.0, |at| at.value.0),
        damping: raw.damping.as_ref().map_or(0.0, |at| at.value.0),
        rest: rest?,
    })
}

fn line(
    at: &At<raw::Spring>,
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Option<SpringLine> {
    let raw = &at.value;
    match (&raw.b, &raw.direction) {
        (Some(end), None) => match &end.value {
            raw::SecondSpringEnd::Nodes(nodes) => {
                of_nodes(nodes, surfaces, faults).map(SpringLine::To)
            }
            raw::SecondSpringEnd::Rigid(point) => {
                of_rigid(point, surfaces, faults).map(SpringLine::To)
            }
            raw::SecondSpringEnd::Fixed(point) => {
                Some(SpringLine::ToPoint(vector(&point.fixed.as_ref()?.value)))
            }
        },
        (None, Some(direction)) => {
            let direction = nonzero(direction, "`direction` of a spring", faults)?;
            Some(SpringLine::Along(direction.normalize()))
        }
        (Some(_), Some(_)) => refuse(
            at,
            "it has both a `direction` and an end `b`; remove one of them",
            faults,
        ),
        (None, None) => refuse(
            at,
            "it has no second end; give it an end `b`, or a `direction` along which it acts against ground",
            faults,
        ),
    }
}

fn rest(at: &At<raw::Spring>, faults: &mut FaultList<'_>) -> Option<SpringRest> {
    match (&at.value.free_length, &at.value.preload) {
        (None, None) => Some(SpringRest::Slack),
        (Some(length), None) => Some(SpringRest::Length(length.value.0)),
        (None, Some(tension)) => Some(SpringRest::Preload(tension.value.0)),
        (Some(_), Some(_)) => refuse(
            at,
            "it has both a `free_length` and a `preload`, and each gives the tension at the start; remove one of them",
            faults,
        ),
    }
}

fn of_nodes(
    raw: &raw::SpringNodes,
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Option<SpringEnd> {
    let body = surfaces.bodies.find(raw.body.as_ref(), faults)?;
    let nodes = surfaces.bodies.nodes(body, raw.nodes.as_ref(), faults)?;
    Some(SpringEnd::Nodes { body, nodes })
}

fn of_rigid(
    raw: &raw::SpringPoint,
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Option<SpringEnd> {
    let rigid = surfaces.rigid_names.find(raw.rigid.as_ref()?, faults)?;
    let stated = raw.point.as_ref().map(|point| vector(&point.value));
    let point = match stated {
        Some(point) => point,
        None => surfaces.rigid[rigid].as_ref()?.reference,
    };
    let rigid = RigidId(rigid);
    Some(SpringEnd::Rigid { rigid, point })
}

fn refuse<T>(at: &At<raw::Spring>, cause: &str, faults: &mut FaultList<'_>) -> Option<T> {
    let name = at.value.name.as_ref();
    let kind = ModelFault::Spring {
        spring: name.map_or_else(String::new, |name| name.value.0.clone()),
        cause: cause.to_owned(),
    };
    faults.push(name.map_or(&at.span, |name| &name.span), kind);
    None
}
