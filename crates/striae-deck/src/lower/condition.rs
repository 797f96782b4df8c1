//! Displacement conditions, releases and loads of a step.

use super::{Listed, Scope, list};
use crate::{
    faults::FaultList,
    raw,
    read::At,
    value::{Number, Text, vector},
};
use std::collections::BTreeSet;
use striae_mesh::NodeId;
use striae_model::{
    Axes, BodyId, Curve, Displacement, Load, LoadExtent, LoadKind, NodalForce, Release, Value,
    shared_force, usual_curve,
};

/// One component of one node of a body.
type Freedom = (BodyId, NodeId, usize);

/// Components that are prescribed after the steps so far.
#[derive(Default)]
pub(super) struct History(BTreeSet<Freedom>);

/// The releases of a step; one without components releases all that are prescribed.
pub(super) fn releases(
    raw: &[At<raw::Release>],
    scope: &Scope<'_>,
    history: &mut History,
    faults: &mut FaultList<'_>,
) -> Listed<Release> {
    Listed::new(raw, |release| {
        let (body, _, nodes) = nodes(&release.value.body, &release.value.nodes, scope, faults)?;
        let prescribed = |component| {
            let mut nodes = nodes.iter();
            nodes.any(|node| history.0.contains(&(body, *node, component)))
        };
        let components = match &release.value.components {
            Some(list) => [raw::Component::X, raw::Component::Y, raw::Component::Z]
                .map(|component| list.value.iter().any(|listed| listed.value == component)),
            None => [0, 1, 2].map(prescribed),
        };
        for component in (0..3).filter(|component| components[*component]) {
            for &node in &nodes {
                history.0.remove(&(body, node, component));
            }
        }
        Some(Release {
            body,
            nodes,
            components,
        })
    })
}

/// The displacement conditions of a step.
pub(super) fn displacements(
    raw: &[At<raw::Displacement>],
    scope: &Scope<'_>,
    history: &mut History,
    faults: &mut FaultList<'_>,
) -> Listed<Displacement> {
    Listed::new(raw, |displacement| {
        let value = &displacement.value;
        let stated = [&value.x, &value.y, &value.z];
        let components = scope.parameters.components(stated, faults);
        let moves = components.iter().flatten().flatten().any(Value::moves);
        let usual = usual_curve(moves);
        let curve = scope.curves.find_or(usual, value.curve.as_ref(), faults);
        let axes = value.axes.as_ref().map_or(Some(Axes::Global), axes);
        let (body, set, nodes) = nodes(&value.body, &value.nodes, scope, faults)?;
        for component in (0..3).filter(|component| stated[*component].is_some()) {
            history
                .0
                .extend(nodes.iter().map(|node| (body, *node, component)));
        }
        Some(Displacement {
            set: set.into(),
            body,
            nodes,
            axes: axes?,
            components: components?,
            // A condition that prescribes nothing is a fault whatever its curve.
            curve: match curve {
                None if stated.iter().all(|target| target.is_none()) => Curve::Ramp,
                curve => curve?,
            },
        })
    })
}

/// Axes of the components of a displacement, where they are known.
fn axes(raw: &At<raw::DisplacementAxes>) -> Option<Axes> {
    let known = |raw: &Option<At<[Number; 3]>>| Some(vector(&raw.as_ref()?.value));
    let axes = match &raw.value {
        raw::DisplacementAxes::Two([x, y]) => Axes::Skew {
            x: vector(x),
            y: vector(y),
        },
        raw::DisplacementAxes::Stated(raw::StatedAxes::Normal(of)) => {
            Axes::Normal(known(&of.normal)?)
        }
        raw::DisplacementAxes::Stated(raw::StatedAxes::Cylindrical(of)) => Axes::Cylindrical {
            point: known(&of.point)?,
            axis: known(&of.axis)?,
        },
    };
    Some(axes)
}

/// The loads of a step.
pub(super) fn loads(
    raw: &raw::Step,
    scope: &Scope<'_>,
    faults: &mut FaultList<'_>,
) -> Listed<Load> {
    let tractions = Listed::new(list(&raw.traction), |At { value: raw, .. }| {
        let target = raw.vector.as_ref();
        let target = target.and_then(|target| scope.parameters.vector(target, faults));
        let direction = raw.direction.as_ref().map(|direction| direction.value);
        let kind = target.map(|target| match direction {
            None | Some(raw::Direction::Dead) => LoadKind::DeadTraction(target.into()),
            Some(raw::Direction::Follower) => LoadKind::FollowerTraction(target.into()),
        });
        let place = (&raw.body, &raw.facets);
        load(place, kind, &raw.extent, &raw.curve, scope, faults)
    });
    let pressures = Listed::new(list(&raw.pressure), |At { value: raw, .. }| {
        let target = raw.value.as_ref();
        let target = target.and_then(|at| scope.parameters.value(&at.value, &at.span, faults));
        let kind = target.map(LoadKind::Pressure);
        let place = (&raw.body, &raw.facets);
        load(place, kind, &raw.extent, &raw.curve, scope, faults)
    });
    tractions.and(pressures)
}

/// The forces at nodes of a step.
pub(super) fn forces(
    raw: &[At<raw::Force>],
    scope: &Scope<'_>,
    faults: &mut FaultList<'_>,
) -> Listed<NodalForce> {
    Listed::new(raw, |At { value: raw, .. }| {
        let stated = match raw.target.as_ref() {
            Some(raw::ForceTarget::Total(of)) => of.total.as_ref(),
            Some(raw::ForceTarget::Each(of)) => of.each.as_ref(),
            None => None,
        };
        let target = stated.and_then(|target| scope.parameters.vector(target, faults));
        let moves = target.iter().flatten().any(Value::moves);
        let usual = usual_curve(moves);
        let curve = scope.curves.find_or(usual, raw.curve.as_ref(), faults);
        let (body, set, nodes) = nodes(&raw.body, &raw.nodes, scope, faults)?;
        let target = target?.into();
        Some(NodalForce {
            set: set.into(),
            body,
            force: match raw.target.as_ref()? {
                raw::ForceTarget::Total(_) => shared_force(&target, nodes.len()),
                raw::ForceTarget::Each(_) => target,
            },
            nodes,
            curve: curve?,
        })
    })
}

fn load(
    (body, facets): (&Option<At<Text>>, &Option<At<Text>>),
    kind: Option<LoadKind<Value>>,
    extent: &Option<At<raw::Extent>>,
    curve: &Option<At<Text>>,
    scope: &Scope<'_>,
    faults: &mut FaultList<'_>,
) -> Option<Load> {
    let usual = usual_curve(kind.as_ref().is_some_and(LoadKind::moves));
    let curve = scope.curves.find_or(usual, curve.as_ref(), faults);
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
