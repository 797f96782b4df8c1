//! Displacement conditions, releases and loads of a step.

use super::{Read, Scope, list};
use crate::{
    fault::FaultKind,
    faults::FaultList,
    raw,
    read::At,
    value::{Text, vector},
};
use std::collections::{BTreeMap, BTreeSet};
use striae_mesh::NodeId;
use striae_solve::model::{BodyId, Curve, Displacement, Load, LoadExtent, LoadKind, Release};

/// Names of the components.
const COMPONENTS: [char; 3] = ['x', 'y', 'z'];

/// One component of one node of a body.
type Freedom = (BodyId, NodeId, usize);

/// Which components are prescribed after the steps so far.
pub(super) struct History {
    prescribed: BTreeSet<Freedom>,
    read: Read,
}

impl History {
    /// Nothing is prescribed before the first step.
    pub(super) fn new(read: Read) -> Self {
        Self {
            prescribed: BTreeSet::new(),
            read,
        }
    }
}

/// What a step has stated for a component so far.
struct Statement<'r> {
    set: &'r str,
    target: f64,
    curve: Curve,
}

/// The releases of a step, or `None` after faults.
pub(super) fn releases(
    raw: &[At<raw::Release>],
    step: &str,
    scope: &Scope<'_>,
    history: &mut History,
    faults: &mut FaultList<'_>,
) -> Option<Vec<Release>> {
    let mut all = Vec::new();
    for release in raw {
        let Some((body, set, nodes)) =
            nodes(&release.value.body, &release.value.nodes, scope, faults)
        else {
            continue;
        };
        let prescribed = |component| {
            nodes
                .iter()
                .any(|node| history.prescribed.contains(&(body, *node, component)))
        };
        let components = match &release.value.components {
            Some(list) => [raw::Component::X, raw::Component::Y, raw::Component::Z]
                .map(|component| list.value.iter().any(|listed| listed.value == component)),
            None => [0, 1, 2].map(prescribed),
        };
        let wrong = match components {
            [false, false, false] => Some(None),
            _ => (0..3).find(|c| components[*c] && !prescribed(*c)).map(Some),
        };
        if let Some(component) = wrong.filter(|_| history.read == Read::Whole) {
            faults.push(
                &release.span,
                FaultKind::NotPrescribed {
                    step: step.into(),
                    body: scope.bodies.name(body).into(),
                    set: set.into(),
                    component: component.map_or("all components".into(), |c| {
                        format!("component `{}`", COMPONENTS[c])
                    }),
                },
            );
        }
        for component in (0..3).filter(|component| components[*component]) {
            for &node in &nodes {
                history.prescribed.remove(&(body, node, component));
            }
        }
        all.push(Release {
            body,
            nodes,
            components,
        });
    }
    (all.len() == raw.len()).then_some(all)
}

/// The displacement conditions of a step, or `None` after faults.
pub(super) fn displacements(
    raw: &[At<raw::Displacement>],
    step: &str,
    scope: &Scope<'_>,
    history: &mut History,
    faults: &mut FaultList<'_>,
) -> Option<Vec<Displacement>> {
    let mut stated = BTreeMap::new();
    let mut all = Vec::new();
    for displacement in raw {
        let value = &displacement.value;
        let components = [&value.x, &value.y, &value.z]
            .map(|target| target.as_ref().map(|target| target.value.0));
        let curve = scope.curves.find(value.curve.as_ref(), faults);
        let Some((body, set, nodes)) = nodes(&value.body, &value.nodes, scope, faults) else {
            continue;
        };
        if components == [None; 3] {
            let kind = FaultKind::NoComponent {
                body: scope.bodies.name(body).into(),
                set: set.into(),
            };
            faults.push(&displacement.span, kind);
            continue;
        }
        let Some(curve) = curve else { continue };
        let condition = Displacement {
            set: set.into(),
            body,
            nodes,
            components,
            curve,
        };
        if let Some(kind) = state(&condition, set, step, scope, &mut stated) {
            faults.push(&displacement.span, kind);
        }
        all.push(condition);
    }
    history.prescribed.extend(stated.into_keys());
    if all.len() < raw.len() {
        history.read = Read::InPart;
        return None;
    }
    Some(all)
}

/// Notes what a condition states; the first contradiction to an earlier one is returned.
fn state<'r>(
    condition: &Displacement,
    set: &'r str,
    step: &str,
    scope: &Scope<'_>,
    stated: &mut BTreeMap<Freedom, Statement<'r>>,
) -> Option<FaultKind> {
    let mut contradiction = None;
    let (body, curve) = (condition.body, &condition.curve);
    for (component, target) in condition.components.iter().enumerate() {
        let Some(target) = *target else { continue };
        for &node in &condition.nodes {
            let earlier = stated
                .entry((body, node, component))
                .or_insert_with(|| Statement {
                    set,
                    target,
                    curve: curve.clone(),
                });
            if (earlier.target != target || earlier.curve != *curve) && contradiction.is_none() {
                contradiction = Some(FaultKind::PrescribedTwice {
                    step: step.into(),
                    body: scope.bodies.name(body).into(),
                    node,
                    component: COMPONENTS[component],
                    first: along(earlier.target, &earlier.curve, curve),
                    first_set: earlier.set.into(),
                    second: along(target, curve, &earlier.curve),
                    second_set: set.into(),
                });
            }
        }
    }
    contradiction
}

/// The target, and the curve where that is what differs.
fn along(target: f64, curve: &Curve, other: &Curve) -> String {
    let name = match curve {
        _ if curve == other => return target.to_string(),
        Curve::Ramp => "`ramp`",
        Curve::Constant => "`constant`",
        Curve::Smooth => "`smooth`",
        Curve::Table(_) => "a curve",
    };
    format!("{target} along {name}")
}

/// The loads of a step, or `None` after faults.
pub(super) fn loads(
    raw: &raw::Step,
    step: &str,
    scope: &Scope<'_>,
    faults: &mut FaultList<'_>,
) -> Option<Vec<Load>> {
    let (tractions, pressures) = (list(&raw.traction), list(&raw.pressure));
    let mut all: Vec<Load> = Vec::new();
    for At { span, value: raw } in tractions {
        let kind = raw.vector.as_ref().map(|target| {
            match raw.direction.as_ref().map(|direction| direction.value) {
                None | Some(raw::Direction::Dead) => LoadKind::DeadTraction(vector(&target.value)),
                Some(raw::Direction::Follower) => LoadKind::FollowerTraction(vector(&target.value)),
            }
        });
        if let Some(load) = load(
            (&raw.body, &raw.facets),
            kind,
            &raw.extent,
            &raw.curve,
            scope,
            faults,
        ) {
            if let Some(kind) = stated_twice(&all, &load, step, scope) {
                faults.push(span, kind);
            }
            all.push(load);
        }
    }
    for At { span, value: raw } in pressures {
        let kind = raw
            .value
            .as_ref()
            .map(|target| LoadKind::Pressure(target.value.0));
        if let Some(load) = load(
            (&raw.body, &raw.facets),
            kind,
            &raw.extent,
            &raw.curve,
            scope,
            faults,
        ) {
            if let Some(kind) = stated_twice(&all, &load, step, scope) {
                faults.push(span, kind);
            }
            all.push(load);
        }
    }
    (all.len() == tractions.len() + pressures.len()).then_some(all)
}

fn load(
    (body, facets): (&Option<At<Text>>, &Option<At<Text>>),
    kind: Option<LoadKind>,
    extent: &Option<At<raw::Extent>>,
    curve: &Option<At<Text>>,
    scope: &Scope<'_>,
    faults: &mut FaultList<'_>,
) -> Option<Load> {
    let curve = scope.curves.find(curve.as_ref(), faults);
    let body = scope.bodies.find(body.as_ref(), faults)?;
    let faces = scope.bodies.faces(body, facets.as_ref(), faults)?;
    let extent = match extent.as_ref().map(|extent| extent.value) {
        None | Some(raw::Extent::Whole) => LoadExtent::Whole,
        Some(raw::Extent::Exposed) => LoadExtent::Exposed,
    };
    Some(Load {
        set: facets.as_ref()?.value.0.clone(),
        body,
        faces,
        kind: kind?,
        extent,
        curve: curve?,
    })
}

/// The fault that a load of the same kind on the same set is stated already.
fn stated_twice(all: &[Load], load: &Load, step: &str, scope: &Scope<'_>) -> Option<FaultKind> {
    let same_kind =
        |other: &Load| std::mem::discriminant(&other.kind) == std::mem::discriminant(&load.kind);
    let twin = all
        .iter()
        .find(|other| other.body == load.body && other.set == load.set && same_kind(other))?;
    let kind = match twin.kind {
        LoadKind::DeadTraction(_) => "dead traction",
        LoadKind::FollowerTraction(_) => "follower traction",
        LoadKind::Pressure(_) => "pressure",
    };
    let what = format!(
        "the {kind} on `{}` of body `{}`",
        load.set,
        scope.bodies.name(load.body)
    );
    Some(FaultKind::StatedTwice {
        step: step.into(),
        what,
    })
}

fn nodes<'r>(
    body: &Option<At<Text>>,
    set: &'r Option<At<Text>>,
    scope: &Scope<'_>,
    faults: &mut FaultList<'_>,
) -> Option<(BodyId, &'r str, Vec<NodeId>)> {
    let body = scope.bodies.find(body.as_ref(), faults)?;
    let nodes = scope.bodies.nodes(body, set.as_ref(), faults)?;
    Some((body, &set.as_ref()?.value.0, nodes))
}
