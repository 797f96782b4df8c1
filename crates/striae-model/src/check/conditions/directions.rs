//! Directions of displacement conditions in axes of their own: those of a node must exist, be
//! independent, and not be stated twice in a step.

use std::collections::BTreeMap;

use crate::{
    axes::{Axes, NodeFrame, are_parallel},
    check::Draft,
    fault::FaultKind,
    model::{BodyId, Curve, Displacement, Release, Step, Value},
};
use striae_mesh::{NodeId, Vec3};

use super::{COMPONENTS, Freedom, along};

/// A direction along which a node is prescribed.
struct Direction {
    component: usize,
    along: Vec3,
    /// Of the present step.
    stated: Option<(String, Value, Curve)>,
}

/// Directions of the nodes of all bodies, where a model has conditions in axes of their own.
#[derive(Default)]
pub(super) struct Directions {
    of_nodes: BTreeMap<(BodyId, NodeId), Vec<Direction>>,
    are_needed: bool,
}

impl Directions {
    pub(super) fn new(draft: &Draft<'_>) -> Self {
        let mut all = draft.steps.iter().flat_map(|of| &of.step.displacements);
        Self {
            of_nodes: BTreeMap::new(),
            are_needed: all.any(|condition| !condition.axes.are_global()),
        }
    }

    /// Returns whether a component of a node is prescribed, in whatever axes it was stated.
    pub(super) fn hold(&self, (body, node, component): Freedom) -> bool {
        let known = self.of_nodes.get(&(body, node));
        known.is_some_and(|known| known.iter().any(|of| of.component == component))
    }

    pub(super) fn release(&mut self, release: &Release) {
        for node in &release.nodes {
            if let Some(known) = self.of_nodes.get_mut(&(release.body, *node)) {
                known.retain(|of| !release.components[of.component]);
            }
        }
    }

    /// Forgets in which step directions were stated.
    pub(super) fn end_of_step(&mut self) {
        let all = self.of_nodes.values_mut().flatten();
        all.for_each(|of| of.stated = None);
    }

    /// Notes what a condition states; returns the first fault of it.
    pub(super) fn state(
        &mut self,
        draft: &Draft<'_>,
        step: &Step,
        condition: &Displacement,
    ) -> Option<FaultKind> {
        let (body, mut fault) = (condition.body, None);
        let mesh = draft.bodies[body.0].mesh.filter(|_| self.are_needed)?;
        for node in &condition.nodes {
            let directions = condition.axes.directions(&mesh.positions[node.index()]);
            let known = self.of_nodes.entry((body, *node)).or_default();
            for (component, direction) in directions.into_iter().enumerate() {
                let target = condition.components[component].as_ref();
                let (Some(direction), Some(target)) = (direction, target) else {
                    continue;
                };
                let same = known
                    .iter()
                    .position(|of| are_parallel(&of.along, &direction));
                let before = same.map(|at| known.remove(at));
                let twice = before.and_then(|before| {
                    let (set, first, curve) = before.stated?;
                    let turned = before.along.dot(&direction) < 0.0;
                    let zero = target.number() == Some(0.0) && first.number() == Some(0.0);
                    let agree = first == *target && curve == condition.curve && !turned || zero;
                    (!agree).then(|| FaultKind::PrescribedTwice {
                        step: step.name.clone(),
                        body: draft.bodies[body.0].name.into(),
                        node: *node,
                        component: COMPONENTS[component],
                        first: along(&first, &curve, &condition.curve),
                        first_set: set,
                        second: along(target, &condition.curve, &curve),
                        second_set: condition.set.clone(),
                    })
                });
                fault = fault.or(twice);
                known.push(Direction {
                    component,
                    along: direction,
                    stated: Some((
                        condition.set.clone(),
                        target.clone(),
                        condition.curve.clone(),
                    )),
                });
                let all: Vec<Vec3> = known.iter().map(|of| of.along).collect();
                if fault.is_none() && NodeFrame::new(&all).is_none() {
                    fault = Some(FaultKind::DependentDirections {
                        step: step.name.clone(),
                        body: draft.bodies[body.0].name.into(),
                        node: *node,
                        count: all.len(),
                        set: condition.set.clone(),
                        component: COMPONENTS[component],
                    });
                }
            }
        }
        fault
    }
}

/// Fault of a condition along an axis that does not exist.
pub(super) fn no_direction(draft: &Draft<'_>, condition: &Displacement) -> Option<FaultKind> {
    let kind = |component: usize, node, reason| FaultKind::NoDirection {
        body: draft.bodies[condition.body.0].name.into(),
        set: condition.set.clone(),
        component: COMPONENTS[component],
        node,
        reason,
    };
    let stated = |component: &usize| condition.components[*component].is_some();
    let zero = |vector: &Vec3| !(vector.norm() > 0.0 && vector.norm().is_finite());
    match &condition.axes {
        Axes::Global => None,
        Axes::Normal(normal) if zero(normal) => {
            Some(kind(0, None, "the normal is zero; give a vector of any other length"))
        }
        Axes::Normal(_) => (1..3).find(stated).map(|component| {
            let reason = "a normal determines the first axis only; give two vectors as `axes`, or leave the component out";
            kind(component, None, reason)
        }),
        Axes::Skew { x, y } => are_in_line(x, y).then(|| {
            let component = (0..3).find(stated).unwrap_or(0);
            let reason = "the two vectors of its axes are zero or parallel; give two that span a plane";
            kind(component, None, reason)
        }),
        Axes::Cylindrical { axis, .. } if zero(axis) => {
            let component = (0..3).find(stated).unwrap_or(0);
            Some(kind(component, None, "the axis is zero; give a vector of any other length"))
        }
        axes => {
            let mesh = draft.bodies[condition.body.0].mesh?;
            condition.nodes.iter().find_map(|node| {
                let directions = axes.directions(&mesh.positions[node.index()]);
                let component = (0..3).find(|at| stated(at) && directions[*at].is_none())?;
                let reason = "the node is on the axis, where no direction is radial or tangential; prescribe it in other axes";
                Some(kind(component, Some(*node), reason))
            })
        }
    }
}

/// Returns whether vectors span no plane.
fn are_in_line(x: &Vec3, y: &Vec3) -> bool {
    let area = x.cross(y).norm();
    !(area > 1e-9 * x.norm() * y.norm() && area.is_finite())
}
