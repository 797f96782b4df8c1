//! Contact surfaces that displacements move into a rigid plane: nothing is left for contact to
//! decide, and what is prescribed cannot be.

use std::collections::BTreeSet;

use crate::{
    fault::{Fault, FaultKind},
    initial::opposed,
    model::{ContactSurface, Model, Pair, RigidId, RigidShape},
    path::Path,
    plan::{Prescription, StepPlan, plans},
};
use striae_mesh::{Face, Mesh, NodeId, Vec3};

/// Depth over the size of elements that counts as none.
const NONE: f64 = 1e-6;
/// Component of a normal that counts as zero.
const ACROSS: f64 = 1e-9;

/// Every such pair, in the first step in which it is one.
pub(super) fn faults(model: &Model) -> Vec<Fault> {
    let plans = plans(model);
    let pairs = model.pairs.iter();
    pairs
        .filter_map(|pair| {
            let mut side = MovedSide::new(model, pair)?;
            plans.iter().enumerate().find_map(|(index, plan)| {
                let depth = side.depth(plan)?;
                let kind = FaultKind::PrescribedInto {
                    pair: pair.name.clone(),
                    step: model.steps[index].name.clone(),
                    depth,
                };
                let path = Path::part("steps", index);
                Some(Fault { path, kind })
            })
        })
        .collect()
}

/// A side that may be moved into a plane.
struct MovedSide<'m> {
    mesh: &'m Mesh,
    body: usize,
    nodes: BTreeSet<NodeId>,
    rigid: RigidId,
    point: Vec3,
    normal: Vec3,
    /// Displacement of the plane so far; `None` where it has been free or turned.
    moved: Option<Vec3>,
}

impl<'m> MovedSide<'m> {
    fn new(model: &'m Model, pair: &'m Pair) -> Option<Self> {
        let (ContactSurface::Deformable { body, .. }, ContactSurface::Rigid(rigid)) =
            (&pair.a, &pair.b)
        else {
            return None;
        };
        let of = &model.rigid_surfaces[rigid.0];
        let RigidShape::Plane { point, normal } = of.shape else {
            return None;
        };
        let mesh = &model.bodies[body.0].mesh;
        let nodes = |face: &Face| mesh.face_nodes(*face);
        let [faces, _] = opposed(model, pair);
        if faces.is_empty() {
            return None;
        }
        Some(Self {
            mesh,
            body: body.0,
            nodes: faces.iter().flat_map(nodes).collect(),
            rigid: *rigid,
            point,
            normal: normal.normalize(),
            moved: of.ties.is_empty().then(Vec3::zeros),
        })
    }

    /// Depth to which the step moves the side into the plane; `None` where it does not, or a node
    /// is not moved along the normal.
    fn depth(&mut self, plan: &StepPlan) -> Option<f64> {
        let end = plan.end();
        let coordinates = plan.rigid[self.rigid.0].iter().enumerate();
        for (at, how) in coordinates {
            let before = self
                .moved
                .map_or(0.0, |moved| if at < 3 { moved[at] } else { 0.0 });
            let now = how
                .as_ref()
                .map(|how| how.at([0.0, before], &self.point, end));
            self.moved = match (self.moved, now) {
                (Some(mut moved), Some(now)) if at < 3 => {
                    moved[at] = now;
                    Some(moved)
                }
                (moved, Some(0.0)) => moved,
                _ => None,
            };
        }
        let moved = self.moved?;
        let axes = (0..3).filter(|axis| self.normal[*axis].abs() > ACROSS);
        let axes: Vec<usize> = axes.collect();
        let depth = |node: &NodeId| {
            let x = self.mesh.positions[node.index()];
            let mut way = 0.0;
            for &axis in &axes {
                let how = plan.displacements.get(&(self.body, node.index(), axis))?;
                // What is held has come as far in an earlier step.
                if matches!(how, Prescription::Hold) {
                    return None;
                }
                way += how.at([0.0; 2], &x, end) * self.normal[axis];
            }
            let gap = (x - self.point - moved).dot(&self.normal) + way;
            (way < 0.0 || moved.dot(&self.normal) > 0.0).then_some(-gap)
        };
        let depths: Option<Vec<f64>> = self.nodes.iter().map(depth).collect();
        let deepest = depths?.into_iter().reduce(f64::max)?;
        (deepest > NONE * self.mesh.characteristic_size()).then_some(deepest)
    }
}
