//! Values imposed in an increment, and their checks.

use nalgebra::Matrix3;
use striae_mesh::{NodeId, Vec3};

use super::{
    contact::Contact,
    fault::{FaultKind, Faults},
    numbers::nodes_of,
    shape,
    state::State,
};
use crate::{complementarity::Prescribed, placement::Placement, side::Side};

/// Deviation of `R^T R` from the identity that is round-off.
const TURNED: f64 = 1e-9;

/// Values known of an increment before it is solved.
#[derive(Clone, Debug)]
pub struct Imposed {
    /// `true` for prescribed components, three a node; empty where all are free.
    pub prescribed: Vec<bool>,
    /// Positions at the end, of which the prescribed components count; empty where they rest.
    pub end: Vec<Vec3>,
    /// Positions that the increment is expected to lead to, so that what is met within it takes
    /// part; empty to choose from its start alone.
    pub predicted: Vec<Vec3>,
    /// Placements of the rigid sides at the end, by pair; those of others are ignored. Empty where
    /// they stay.
    pub placements: Vec<Placement>,
    /// Duration (time); infinite where nothing depends on it.
    pub duration: f64,
}

impl Default for Imposed {
    /// Nothing prescribed, rigid surfaces at rest.
    fn default() -> Self {
        Self {
            prescribed: Vec::new(),
            end: Vec::new(),
            predicted: Vec::new(),
            placements: Vec::new(),
            duration: f64::INFINITY,
        }
    }
}

impl Imposed {
    /// Imposed values with an entry for everything.
    pub(super) fn completed(&self, contact: &Contact, state: &State) -> Result<Self, Faults> {
        let (nodes, pairs) = (contact.node_count(), contact.pair_count());
        let mut all = self.clone();
        if all.prescribed.is_empty() {
            all.prescribed = vec![false; 3 * nodes];
        }
        shape::count(all.prescribed.len(), 3 * nodes, "prescribed")?;
        if all.end.is_empty() {
            all.end.clone_from(&state.positions);
        }
        shape::vectors(&all.end, nodes, "end")?;
        if !all.predicted.is_empty() {
            shape::vectors(&all.predicted, nodes, "predicted")?;
            contact.areas(&all.predicted)?;
        }
        if all.placements.is_empty() {
            all.placements.clone_from(&state.placements);
        }
        shape::count(all.placements.len(), pairs, "placements")?;
        for (pair, Placement { rotation, shift }) in all.placements.iter().enumerate() {
            let place = format!("placements[{pair}]");
            shape::finite(&[*shift], &place)?;
            let off: f64 = (rotation.tr_mul(rotation) - Matrix3::identity()).amax();
            if !(off <= TURNED && rotation.determinant() > 0.0) {
                return Err(Faults::one(place, FaultKind::Rotation));
            }
        }
        let value = all.duration;
        if value.is_nan() || value <= 0.0 {
            return Err(Faults::one("duration", FaultKind::NotPositive { value }));
        }
        let mut members = contact.members().iter();
        let evolves = members.position(|of| of.friction.evolves());
        if let Some(pair) = evolves.filter(|_| value.is_infinite()) {
            return Err(Faults::one("duration", FaultKind::Endless { pair }));
        }
        Ok(all)
    }
}

/// Prescribed components of the nodes of every pair.
pub(super) fn prescribed(contact: &Contact, components: &[bool]) -> Vec<Prescribed> {
    let members = contact.members().iter();
    let of_pair = |pair| Prescribed {
        components: Side::BOTH.map(|side| {
            let nodes = nodes_of(pair, side);
            let of_node = |node: NodeId| [0, 1, 2].map(|c| components[3 * node.index() + c]);
            nodes.into_iter().flat_map(of_node).collect()
        }),
        axes: Default::default(),
    };
    members.map(|member| of_pair(&member.pair)).collect()
}
