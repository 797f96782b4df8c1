//! Springs that have no force, no direction or too many ends.

use crate::{
    fault::FaultKind,
    model::{Spring, SpringEnd, SpringLine, SpringRest},
    path::Path,
};
use striae_mesh::{Vec3, place};

use super::{Draft, List, numbers};

/// Notes faults of all springs whose ends are known.
pub(super) fn check(draft: &Draft<'_>, faults: &mut List) {
    for (index, named) in draft.springs.iter().enumerate() {
        let Some(spring) = named.part else { continue };
        let path = Path::part("springs", index);
        let cause = cause(draft, spring);
        if let Some((field, cause)) = cause {
            let spring = spring.name.clone();
            faults.push(
                path.clone().field(field),
                FaultKind::Spring { spring, cause },
            );
        }
        numbers::of_spring(spring, &path, faults);
    }
}

/// The field of a spring that is wrong, with what is found and needed.
fn cause(draft: &Draft<'_>, spring: &Spring) -> Option<(&'static str, String)> {
    let is_slack = match spring.rest {
        SpringRest::Slack | SpringRest::Length(_) => true,
        SpringRest::Preload(tension) => tension == 0.0,
    };
    if spring.stiffness == 0.0 && spring.damping == 0.0 && is_slack {
        let cause = "it has no force; give it a `stiffness`, a `damping` or a `preload`";
        return Some(("stiffness", cause.into()));
    }
    if let (SpringLine::Along(_), SpringRest::Length(_)) = (&spring.line, spring.rest) {
        let cause = "a spring along a fixed direction has no length; state a `preload` instead of `free_length`";
        return Some(("rest", cause.into()));
    }
    let from = match &spring.line {
        SpringLine::Along(_) => return None,
        SpringLine::ToPoint(point) => *point,
        SpringLine::To(end) => match places(draft, end)?[..] {
            [place] => place,
            ref places => {
                let cause = format!(
                    "its end `b` has {} nodes; name a set of a single node, or a point of a rigid body",
                    places.len()
                );
                return Some(("b", cause));
            }
        },
    };
    let mut places = places(draft, &spring.a)?.into_iter();
    let common = places.find(|other| *other == from)?;
    let cause = format!(
        "both of its ends are at {}, so it has no direction; give it a `direction`, or ends that are apart",
        place(&common)
    );
    Some(("b", cause))
}

/// Positions of an end at the start.
fn places(draft: &Draft<'_>, end: &SpringEnd) -> Option<Vec<Vec3>> {
    match end {
        SpringEnd::Nodes { body, nodes } => {
            let mesh = draft.bodies[body.0].mesh?;
            let nodes = nodes.iter();
            Some(nodes.map(|node| mesh.positions[node.index()]).collect())
        }
        SpringEnd::Rigid { point, .. } => Some(vec![*point]),
    }
}
