//! Nodes that are prescribed along other directions than the coordinate axes in a step, see
//! [`striae_model::axes`].

use std::collections::BTreeMap;

use nalgebra::Matrix3;
use striae_contact::side::Side;
use striae_mesh::{NodeId, Vec3};

use super::StepContext;
use crate::{dynamics::ImposedRate, problem::Problem, state::State};
use striae_model::{
    Moment,
    axes::NodeFrame,
    node::GlobalNode,
    plan::{Prescription, StepPlan},
};

/// Nodes with frames of their own.
#[derive(Clone, Debug, Default)]
pub(crate) struct Turned<'a> {
    nodes: Vec<TurnedNode<'a>>,
    /// Place of each global node among them; empty where there are none.
    place: Vec<Option<u32>>,
}

#[derive(Clone, Debug)]
struct TurnedNode<'a> {
    node: GlobalNode,
    frame: NodeFrame,
    /// Directions with what is prescribed along them.
    stated: Vec<(Vec3, &'a Prescription)>,
}

impl<'a> Turned<'a> {
    pub(super) fn new(problem: &Problem, plan: &'a StepPlan) -> Self {
        let mut turned = Self::default();
        for (&(body, node), oblique) in &plan.oblique {
            let along_axes = (0..3).filter_map(|axis| {
                let how = plan.displacements.get(&(body, node, axis))?;
                Some((Vec3::ith(axis, 1.0), how))
            });
            let oblique = oblique.iter().map(|of| (of.direction, &of.how));
            let stated: Vec<_> = along_axes.chain(oblique).collect();
            let directions: Vec<Vec3> = stated.iter().map(|(direction, _)| *direction).collect();
            let frame = NodeFrame::new(&directions);
            turned.nodes.push(TurnedNode {
                node: problem.node(body, NodeId::new(node)),
                frame: frame.expect("the model has been checked for independent directions"),
                stated,
            });
        }
        if !turned.nodes.is_empty() {
            turned.place = vec![None; problem.reference.len()];
        }
        for (at, of) in turned.nodes.iter().enumerate() {
            turned.place[of.node] = Some(at as u32);
        }
        turned
    }

    /// Returns whether no node has a frame of its own.
    pub(crate) fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Frame of a node, if it has one of its own.
    pub(crate) fn frame(&self, node: GlobalNode) -> Option<&NodeFrame> {
        let at = self.place.get(node.0).copied().flatten()?;
        Some(&self.nodes[at as usize].frame)
    }

    /// Nodes with frames of their own.
    pub(crate) fn frames(&self) -> impl Iterator<Item = (GlobalNode, &NodeFrame)> {
        self.nodes.iter().map(|of| (of.node, &of.frame))
    }

    /// Notes the prescribed components.
    pub(super) fn fix(&self, fixed: &mut [bool]) {
        for (node, frame) in self.frames() {
            for axis in 0..3 {
                fixed[node.component(axis)] = axis < frame.held();
            }
        }
    }

    /// Axes of the nodes of a side of a pair that have frames of their own.
    pub(super) fn on_side(
        &self,
        problem: &Problem,
        pair: usize,
        side: Side,
    ) -> BTreeMap<usize, Matrix3<f64>> {
        let surface = problem.pairs[pair].contact.sides[side].surface();
        let Some((surface, body)) = surface.zip(problem.pairs[pair].bodies[side]) else {
            return BTreeMap::new();
        };
        if self.is_empty() {
            return BTreeMap::new();
        }
        let nodes = surface.nodes().iter().enumerate();
        let axes = nodes.filter_map(|(at, node)| {
            let frame = self.frame(problem.node(body, *node))?;
            Some((at, *frame.axes()))
        });
        axes.collect()
    }

    /// Prescribed components at a moment of the step, and their rates.
    pub(super) fn imposed(
        &self,
        problem: &Problem,
        start: &State,
        moment: Moment,
    ) -> (Vec<(GlobalNode, usize, f64)>, Vec<ImposedRate>) {
        let (mut positions, mut rates) = (Vec::new(), Vec::new());
        for of in &self.nodes {
            let reference = &problem.reference[of.node];
            let (mut along, mut first, mut second) = (Vec::new(), Vec::new(), Vec::new());
            for (direction, how) in &of.stated {
                let ends = [reference, &start.positions[of.node]].map(|x| direction.dot(x));
                along.push(how.at(ends, reference, moment));
                let [velocity, acceleration] = how.rate(ends, reference, moment);
                first.push(velocity / moment.duration);
                second.push(acceleration / (moment.duration * moment.duration));
            }
            let [along, first, second] =
                [along, first, second].map(|values| of.frame.components(&values));
            for axis in 0..of.frame.held() {
                positions.push((of.node, axis, along[axis]));
                rates.push(ImposedRate {
                    node: of.node,
                    axis,
                    direction: Some(of.frame.axis(axis)),
                    velocity: first[axis],
                    acceleration: second[axis],
                });
            }
        }
        (positions, rates)
    }
}

impl StepContext<'_> {
    /// Component of a vector along an axis of a node.
    pub(crate) fn along(&self, node: GlobalNode, axis: usize, vector: &Vec3) -> f64 {
        match self.turned.frame(node) {
            Some(frame) => frame.axis(axis).dot(vector),
            None => vector[axis],
        }
    }

    /// Unit vector along an axis of a node.
    pub(crate) fn axis(&self, node: GlobalNode, axis: usize) -> Vec3 {
        match self.turned.frame(node) {
            Some(frame) => frame.axis(axis),
            None => Vec3::ith(axis, 1.0),
        }
    }

    /// Components of a vector along the axes of a node.
    pub fn components(&self, node: GlobalNode, vector: &Vec3) -> Vec3 {
        match self.turned.frame(node) {
            Some(frame) => frame.axes().tr_mul(vector),
            None => *vector,
        }
    }

    /// Vector with these components along the axes of a node.
    pub fn vector(&self, node: GlobalNode, components: &Vec3) -> Vec3 {
        match self.turned.frame(node) {
            Some(frame) => frame.axes() * components,
            None => *components,
        }
    }

    /// Projection to the directions that are free at a node.
    pub(crate) fn free(&self, node: GlobalNode) -> Matrix3<f64> {
        let fixed = |axis: usize| self.fixed[node.component(axis)];
        match self.turned.frame(node) {
            Some(frame) => frame.free(),
            None => Matrix3::from_diagonal(&Vec3::from_fn(|axis, _| f64::from(!fixed(axis)))),
        }
    }

    /// Part of a vector at a node along which it is prescribed.
    pub(crate) fn prescribed_part(&self, node: GlobalNode, vector: &Vec3) -> Vec3 {
        let components = self.components(node, vector);
        let fixed = |axis: usize| f64::from(u8::from(self.fixed[node.component(axis)]));
        let held = Vec3::from_fn(|axis, _| fixed(axis) * components[axis]);
        self.vector(node, &held)
    }
}
