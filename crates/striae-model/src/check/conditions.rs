//! Displacement conditions and their releases.

mod directions;

use std::collections::{BTreeMap, BTreeSet};

use crate::{
    fault::FaultKind,
    model::{BodyId, Curve, Displacement, Release, Step, Value},
    path::Path,
};
use striae_mesh::NodeId;

use super::{Draft, DraftStep, Known, List};
use directions::{Directions, no_direction};

/// Names of the components.
pub(super) const COMPONENTS: [char; 3] = ['x', 'y', 'z'];

/// One component of one node of a body.
type Freedom = (BodyId, NodeId, usize);

/// Components that are prescribed after the steps so far.
pub(super) struct History {
    prescribed: BTreeSet<Freedom>,
    directions: Directions,
    known: Known,
}

impl History {
    /// Nothing is prescribed before the first step.
    pub(super) fn new(draft: &Draft<'_>) -> Self {
        Self {
            prescribed: BTreeSet::new(),
            directions: Directions::new(draft),
            known: draft.known,
        }
    }
}

/// Value that a step has stated for a component so far.
struct Statement<'s> {
    set: &'s str,
    target: &'s Value,
    curve: &'s Curve,
}

/// Notes releases of what is free.
pub(super) fn releases(
    draft: &Draft<'_>,
    step: &Step,
    path: &Path,
    history: &mut History,
    faults: &mut List,
) {
    for (index, release) in step.releases.iter().enumerate() {
        let Release {
            body,
            nodes,
            components,
        } = release;
        let prescribed = |component: usize| {
            let mut nodes = nodes.iter();
            nodes.any(|node| {
                let freedom = (*body, *node, component);
                history.prescribed.contains(&freedom) || history.directions.hold(freedom)
            })
        };
        let wrong = match components {
            [false, false, false] => Some("all components".to_owned()),
            _ => (0..3)
                .find(|&component| components[component] && !prescribed(component))
                .map(|component| format!("component `{}`", COMPONENTS[component])),
        };
        if let Some(component) = wrong.filter(|_| history.known == Known::Whole) {
            let kind = FaultKind::NotPrescribed {
                step: step.name.clone(),
                body: draft.bodies[body.0].name.into(),
                set: set_of(draft, release),
                component,
            };
            faults.push(path.clone().field("releases").index(index), kind);
        }
        for component in (0..3).filter(|component| components[*component]) {
            for &node in nodes {
                history.prescribed.remove(&(*body, node, component));
            }
        }
        history.directions.release(release);
    }
}

/// Name of the node set that is released, if one has these nodes.
fn set_of(draft: &Draft<'_>, release: &Release) -> String {
    let mesh = draft.bodies[release.body.0].mesh;
    let sets = mesh.into_iter().flat_map(|mesh| mesh.node_sets.iter());
    let mut named = sets.filter(|(_, nodes)| *nodes == release.nodes);
    named
        .next()
        .map_or("its nodes", |(name, _)| name)
        .to_owned()
}

/// Notes conditions without a component and contradictions; returns whether all
/// conditions of the step are known.
pub(super) fn displacements(
    draft: &Draft<'_>,
    of: &DraftStep<'_>,
    path: &Path,
    history: &mut History,
    faults: &mut List,
) -> Known {
    let step = of.step;
    let mut known = of.displacements;
    let mut stated = BTreeMap::new();
    for (index, condition) in step.displacements.iter().enumerate() {
        let path = path.clone().field("displacements").index(index);
        if condition.components.iter().all(Option::is_none) {
            let kind = FaultKind::NoComponent {
                body: draft.bodies[condition.body.0].name.into(),
                set: condition.set.clone(),
            };
            faults.push(path, kind);
            known = Known::InPart;
        } else if let Some(kind) = no_direction(draft, condition) {
            faults.push(path, kind);
            known = Known::InPart;
        } else if let Some(kind) = state(draft, step, condition, &mut stated) {
            faults.push(path, kind);
        } else if let Some(kind) = history.directions.state(draft, step, condition) {
            faults.push(path, kind);
        }
    }
    history.prescribed.extend(stated.into_keys());
    history.directions.end_of_step();
    if known == Known::InPart {
        history.known = Known::InPart;
    }
    known
}

/// Notes what a condition states; the first contradiction to an earlier one is returned.
fn state<'s>(
    draft: &Draft<'_>,
    step: &Step,
    condition: &'s Displacement,
    stated: &mut BTreeMap<Freedom, Statement<'s>>,
) -> Option<FaultKind> {
    let mut contradiction = None;
    let (body, set, curve) = (condition.body, &condition.set, &condition.curve);
    for (component, target) in condition.components.iter().enumerate() {
        let Some(target) = target else { continue };
        if !condition.axes.are_global() {
            continue;
        }
        for &node in &condition.nodes {
            let freedom = (body, node, component);
            let statement = || Statement { set, target, curve };
            let earlier = stated.entry(freedom).or_insert_with(statement);
            if (earlier.target != target || earlier.curve != curve) && contradiction.is_none() {
                contradiction = Some(FaultKind::PrescribedTwice {
                    step: step.name.clone(),
                    body: draft.bodies[body.0].name.into(),
                    node,
                    component: COMPONENTS[component],
                    first: along(earlier.target, earlier.curve, curve),
                    first_set: earlier.set.into(),
                    second: along(target, curve, earlier.curve),
                    second_set: set.clone(),
                });
            }
        }
    }
    contradiction
}

/// The target, and the curve where that is what differs.
fn along(target: &Value, curve: &Curve, other: &Curve) -> String {
    let name = match curve {
        _ if curve == other => return target.to_string(),
        Curve::Ramp => "`ramp`",
        Curve::Constant => "`constant`",
        Curve::Smooth => "`smooth`",
        Curve::Table(_) | Curve::History(_) => "a curve",
    };
    format!("{target} along {name}")
}
