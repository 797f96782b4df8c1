//! Values of the traction unknowns of a pair.

use serde::{Deserialize, Serialize};
use striae_law::friction::{Friction, RateAndState};
use striae_mesh::Vec3;

use crate::factor_states::FactorStates;

/// Traction unknowns of a pair; the same shape whatever the roles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tractions {
    /// Pressure `p` and the components of `z` along the nodal tangents, by side. Only those
    /// of kept nodes are unknowns.
    pub nodes: [Vec<[f64; 3]>; 2],
    /// Components of the converged friction traction `tau_n` along the nodal tangents, by side.
    pub tau_n: [Vec<[f64; 2]>; 2],
    /// `true` for each node that slipped in the last converged increment, by side.
    pub slipped: [Vec<bool>; 2],
    /// Closed share of the support of each node at the last converged state, by side, which its
    /// [bedding](crate::bedding) goes by.
    pub bedded: [Vec<f64>; 2],
    /// Slip `sum |du|` of each node up to the last converged state, by side.
    pub accumulated: [Vec<f64>; 2],
    /// Depth that has worn off each node up to the last converged state, by side.
    pub worn: [Vec<f64>; 2],
    /// State `theta` of friction of each node at the last converged state, by side; zero before
    /// there is friction that depends on one.
    pub states: [Vec<f64>; 2],
    /// States of a factor of friction at the last converged state; `None` before there is one.
    pub factors: Option<FactorStates>,
    /// Labels of the nodes after the iterations so far, by side; before the first iteration, slip
    /// for nodes that slipped in the last increment and open for all others. They matter with a
    /// corrector, and where friction falls with the slip rate.
    pub labels: [Vec<Label>; 2],
}

impl Tractions {
    /// No traction on sides with so many nodes.
    pub fn zero(nodes: [usize; 2]) -> Self {
        Self {
            nodes: nodes.map(|count| vec![[0.0; 3]; count]),
            slipped: nodes.map(|count| vec![false; count]),
            bedded: nodes.map(|count| vec![0.0; count]),
            accumulated: nodes.map(|count| vec![0.0; count]),
            worn: nodes.map(|count| vec![0.0; count]),
            states: nodes.map(|count| vec![0.0; count]),
            factors: None,
            tau_n: nodes.map(|count| vec![[0.0; 2]; count]),
            labels: nodes.map(|count| vec![Label::default(); count]),
        }
    }

    /// Adds the slip of an increment that has converged; open nodes do not slip.
    pub fn accumulate(&mut self, nodes: &[Vec<NodeResult>; 2]) {
        let sums = self.accumulated.iter_mut().flatten();
        for (sum, node) in sums.zip(nodes.iter().flatten()) {
            // The relative motion of an open node wears nothing.
            if node.status != Status::Open {
                *sum += node.slip.norm();
            }
        }
    }

    /// Adds the depth that an increment that has converged has worn off.
    pub fn wear_off(&mut self, depths: &[Vec<f64>; 2]) {
        let worn = self.worn.iter_mut().flatten();
        for (worn, depth) in worn.zip(depths.iter().flatten()) {
            *worn += depth;
        }
    }

    /// Lets the states of friction evolve over an increment that has converged and took the time
    /// `elapsed`; those of open nodes rest.
    pub fn evolve(&mut self, nodes: &[Vec<NodeResult>; 2], friction: &Friction, elapsed: f64) {
        let Some(law) = friction.rate_and_state() else {
            return;
        };
        let states = self.states.iter_mut().flatten();
        for (state, node) in states.zip(nodes.iter().flatten()) {
            let before = begun(law, *state);
            *state = match node.status {
                Status::Open => before,
                Status::Stick | Status::Slip => {
                    law.state_after(before, node.slip.norm() / elapsed, elapsed)
                }
            };
        }
    }

    /// Labels the nodes with their statuses in a converged state, whatever led to it.
    pub fn settle(&mut self, nodes: &[Vec<NodeResult>; 2]) {
        let settled = |node: &NodeResult| Label {
            status: node.status,
            apart: node.apart,
            ..Label::default()
        };
        self.labels = nodes
            .each_ref()
            .map(|side| side.iter().map(settled).collect());
    }

    /// Gives the nodes the labels that an iteration has found them to have.
    pub fn label(&mut self, nodes: &[Vec<NodeResult>; 2]) {
        let found = || self.labels.iter().flatten().zip(nodes.iter().flatten());
        let slips = |status| status == Status::Slip;
        // While other nodes begin or cease to slip, a swing of `|du|` may follow from them and says
        // nothing about this node.
        let rests = found().all(|(label, node)| slips(label.status) == slips(node.status));
        let after = match rests {
            true => Label::after,
            false => Label::anew,
        };
        let sides = self.labels.iter_mut().zip(nodes);
        for (label, node) in sides.flat_map(|(labels, nodes)| labels.iter_mut().zip(nodes)) {
            *label = after(*label, node);
        }
    }
}

/// The state at a node, that of the law at the start where there is none yet.
pub(crate) fn begun(law: &RateAndState, state: f64) -> f64 {
    match state > 0.0 {
        true => state,
        false => law.state,
    }
}

/// Label of a node from the iterations of an increment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Label {
    /// Status in the last iteration.
    pub status: Status,
    /// Number of times that it has begun to slip.
    pub begun: u32,
    /// `|du|` in the last iteration.
    pub slip: f64,
    /// `true` if the last change of `|du|` was a fall, counted from when the node last began or
    /// ceased to slip.
    pub fell: bool,
    /// Number of times that `|du|` rose after a fall, since then.
    pub turns: u32,
    /// `true` if its pressure is known to be zero.
    pub apart: bool,
}

impl Label {
    /// Part of `|du|` by which it changes where it falls or rises at all. A solution that
    /// Newton's method closes in on changes by less.
    const CHANGE: f64 = 0.1;

    /// Number of rises of `|du|` after a fall that is one too many.
    const TURNS: u32 = 2;

    /// The label after an iteration in which no node began or ceased to slip.
    fn after(self, node: &NodeResult) -> Self {
        let slip = node.slip.norm();
        let rises = self.rises_to(slip);
        let falls = slip < (1.0 - Self::CHANGE) * self.slip;
        Self {
            status: node.status,
            slip,
            fell: falls || self.fell && !rises,
            turns: self.turns + u32::from(self.fell && rises),
            apart: node.apart,
            ..self
        }
    }

    /// The label after any other iteration: slip that turns then proves nothing.
    fn anew(self, node: &NodeResult) -> Self {
        let begins = node.status == Status::Slip && self.status != Status::Slip;
        Self {
            status: node.status,
            begun: self.begun + u32::from(begins),
            slip: node.slip.norm(),
            apart: node.apart,
            ..Self::default()
        }
    }

    /// Returns whether slip has oscillated, given the new `|du|`.
    pub(crate) fn goes_back_and_forth(&self, slip: f64) -> bool {
        // Counted exactly, not at least: the node that sticks for this reason may slip again later.
        self.fell && self.rises_to(slip) && self.turns + 1 == Self::TURNS
    }

    fn rises_to(&self, slip: f64) -> bool {
        slip > (1.0 + Self::CHANGE) * self.slip
    }
}

/// Contact status of a node.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Status {
    /// Not in contact.
    #[default]
    Open,
    /// In contact without slip.
    Stick,
    /// In contact and slipping.
    Slip,
}

/// Results at a contact node in one configuration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct NodeResult {
    /// Gap to the other side, as the contact rows see it.
    pub gap: f64,
    /// Pressure.
    pub pressure: f64,
    /// Friction traction `tau` on the surface that carries the node.
    pub tau: Vec3,
    /// Slip `du` since the last converged configuration, relative to the other side.
    pub slip: Vec3,
    /// Unit normal.
    pub normal: Vec3,
    /// Direction `s` of the node's own texture, zero without one.
    pub texture: Vec3,
    /// Mean traction around the node: its contact force over the area `integral N da` that
    /// belongs to it, zero without area. On coarse curved contact it is smoother than the
    /// nodal values of the field.
    pub mean: Vec3,
    /// Status; of transferred nodes that of the kept node they follow most.
    pub status: Status,
    /// Closed share of the support, by the gap that opens a support at its full bedding.
    pub closed: f64,
    /// `true` if nothing gives a kept node pressure.
    pub apart: bool,
    /// Friction by which the rows of an iteration deviate from the law; of no account in a
    /// converged state.
    #[serde(skip)]
    pub deviation: f64,
}

impl NodeResult {
    /// Mean pressure around the node.
    pub fn mean_pressure(&self) -> f64 {
        -self.mean.dot(&self.normal)
    }

    /// Mean friction traction around the node.
    pub fn mean_friction(&self) -> Vec3 {
        self.mean + self.normal * self.mean_pressure()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slipping(slip: f64) -> [Vec<NodeResult>; 2] {
        let node = NodeResult {
            status: Status::Slip,
            slip: Vec3::new(slip, 0.0, 0.0),
            ..NodeResult::default()
        };
        [vec![node], Vec::new()]
    }

    #[test]
    fn slip_that_falls_and_rises_twice_goes_back_and_forth() {
        let mut tractions = Tractions::zero([1, 0]);
        for slip in [1.0, 0.5, 1.0, 0.7] {
            tractions.label(&slipping(slip));
            assert!(!tractions.labels[0][0].goes_back_and_forth(0.72));
        }
        assert_eq!(tractions.labels[0][0].begun, 1);
        assert!(tractions.labels[0][0].goes_back_and_forth(0.9));
        assert!(!tractions.labels[0][0].goes_back_and_forth(0.6));
    }

    #[test]
    fn slip_that_another_node_turns_proves_nothing() {
        let mut tractions = Tractions::zero([2, 0]);
        let beside = |status| NodeResult {
            status,
            ..NodeResult::default()
        };
        for (slip, status) in [
            (1.0, Status::Stick),
            (0.5, Status::Slip),
            (1.0, Status::Stick),
            (0.7, Status::Slip),
        ] {
            let [mut nodes, none] = slipping(slip);
            nodes.push(beside(status));
            tractions.label(&[nodes, none]);
        }
        assert!(!tractions.labels[0][0].goes_back_and_forth(0.9));
    }
}
