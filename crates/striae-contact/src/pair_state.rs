//! State of a pair at the end of an increment, and the traction unknowns that the next one starts
//! from.
//!
//! Nodes that are kept go on with their unknowns, nodes that are newly kept with what the traction
//! field carried there, so that roles can change without a jump of the forces.

use serde::{Deserialize, Serialize};
use striae_law::friction::Friction;
use striae_mesh::FacetId;
use striae_surface::node::SurfaceNode;

use crate::{
    evaluation::Evaluation,
    field::FacetForces,
    pair::ContactPair,
    selection::{Kept, Selection},
    side::Side,
    unknowns::{Label, NodeResult, Status, Tractions},
};

/// State of a contact pair.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct PairState {
    /// Traction unknowns.
    pub tractions: Tractions,
    /// Nodes that were kept in the increment that led to this state.
    pub kept: Kept,
    /// Pressure and components of `-tau` along the nodal tangents of all nodes, by side.
    pub carried: [Vec<[f64; 3]>; 2],
    /// Results at every surface node, by side.
    pub nodes: [Vec<NodeResult>; 2],
    /// Forces on the facets in contact, by side.
    pub facets: [Vec<(FacetId, FacetForces)>; 2],
    /// Work dissipated by friction since the start.
    pub dissipated: f64,
    /// Volume that has worn off each side since the start.
    pub worn: [f64; 2],
}

/// Status in which contact starts an increment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Predicted {
    /// Nodes that slipped go on slipping.
    AsBefore,
    /// All nodes stick.
    Stick,
}

impl PairState {
    /// A pair that has never been in contact.
    pub fn untouched(pair: &ContactPair) -> Self {
        let counts = pair.carriers();
        Self {
            tractions: Tractions::zero(counts),
            kept: counts.map(|count| vec![false; count]),
            carried: counts.map(|count| vec![[0.0; 3]; count]),
            nodes: counts.map(|count| vec![NodeResult::default(); count]),
            facets: [Vec::new(), Vec::new()],
            dissipated: 0.0,
            worn: [0.0; 2],
        }
    }

    /// The traction unknowns that an increment from this state starts with.
    pub fn started(&self, selection: &Selection, predicted: Predicted) -> Tractions {
        let mut tractions = self.tractions.clone();
        tractions.tau_n = self
            .carried
            .each_ref()
            // The unknown is `z = -tau`.
            .map(|side| side.iter().map(|[_, t1, t2]| [-t1, -t2]).collect());
        let slips =
            |node: &NodeResult| predicted == Predicted::AsBefore && node.status == Status::Slip;
        let of_side = |side: &Vec<NodeResult>| side.iter().map(slips).collect();
        tractions.slipped = self.nodes.each_ref().map(of_side);
        let labelled = |side: &Vec<bool>| side.iter().map(|slipped| label(*slipped)).collect();
        tractions.labels = tractions.slipped.each_ref().map(labelled);
        tractions.bedded = self
            .nodes
            .each_ref()
            .map(|side| side.iter().map(|node| node.closed).collect());
        fit(selection, &self.kept, &self.carried, &mut tractions);
        tractions
    }

    /// The state after a converged increment that took the time `elapsed`.
    pub fn after(
        &self,
        mut tractions: Tractions,
        selection: &Selection,
        evaluation: Evaluation,
        friction: &Friction,
        elapsed: f64,
    ) -> Self {
        if let Some(evolving) = &evaluation.evolving {
            tractions.evolve_factor(&evaluation.nodes, friction, evolving);
        }
        tractions.accumulate(&evaluation.nodes);
        tractions.wear_off(&evaluation.worn.depths);
        tractions.evolve(&evaluation.nodes, friction, elapsed);
        Self {
            dissipated: self.dissipated + evaluation.dissipated,
            worn: [0, 1].map(|side| self.worn[side] + evaluation.worn.volumes[side]),
            kept: selection.kept_nodes(),
            tractions,
            carried: evaluation.carried,
            nodes: evaluation.nodes,
            facets: evaluation.facets,
        }
    }
}

/// The label that a node starts with which has slipped in the converged state, or not.
fn label(slipped: bool) -> Label {
    let status = match slipped {
        true => Status::Slip,
        false => Status::Open,
    };
    Label {
        status,
        ..Label::default()
    }
}

/// Gives nodes that are newly kept what the field carried there, and others nothing.
pub fn fit(
    selection: &Selection,
    before: &Kept,
    carried: &[Vec<[f64; 3]>; 2],
    tractions: &mut Tractions,
) {
    for side in Side::BOTH {
        for (node, unknowns) in tractions.nodes[side].iter_mut().enumerate() {
            let node = SurfaceNode::new(node);
            if !selection.is_kept(side, node) {
                *unknowns = [0.0; 3];
            } else if !before[side][node] {
                // A new node continues the previous field at its place, so that roles can change
                // without a jump of the forces.
                *unknowns = carried[side][node];
            }
        }
    }
}
