//! Which nodes of a pair carry traction unknowns, and how the others follow them.
//!
//! Roles are chosen at the start of an increment, see [`crate::roles`], from the
//! configuration it starts from and, where that shows too little, the one that it leads to.
//! They are frozen in the increment, as is the transfer to nodes that are not kept, see
//! `transfer`. Of facets that are paired in both configurations the mean
//! overlap counts.

mod approach;
mod before;
mod gathered;
mod sides;
mod traction_field;

pub use approach::approach;
pub(crate) use approach::compliances;
pub use before::{Before, Kept};
pub use traction_field::Selection;

use striae_surface::node::SurfaceNode;

use crate::{
    configuration::Configuration,
    pairing::Scope,
    partner::partners,
    side::Side,
    spot::Spot,
    tip::RigidPoint,
    traction_basis::{KeptNode, THETA_1},
    unknown::Prescribed,
};
use gathered::Gathered;

impl Selection {
    /// Chooses the kept nodes from the configuration that an increment starts from and, if
    /// it is known, the one that it is predicted to lead to.
    pub fn new(
        start: &Configuration,
        predicted: Option<&Configuration>,
        before: Before,
        prescribed: &Prescribed,
    ) -> Self {
        let compliances = compliances(start);
        let depth = predicted.map_or(0.0, |predicted| approach(start, predicted));
        let scope = Scope {
            compliances: &compliances,
            depth,
        };
        let mut gathered = Gathered::new(start, scope);
        if let Some(predicted) = predicted {
            gathered.add(Gathered::new(predicted, scope));
        }
        let mut basis = gathered.basis(start, before, prescribed);
        for (side, count) in Side::BOTH.into_iter().zip(start.pair.carriers()) {
            basis.index[side].resize(count, None);
            basis.rows[side].resize(count, Vec::new());
        }
        let of_b = basis.index[Side::B].len();
        let lodges = start.pair.is_rigid();
        let mut points = vec![None; if lodges { of_b } else { 0 }];
        let known = points.iter_mut().zip(before.points);
        known.for_each(|(point, before): (&mut Option<RigidPoint>, _)| *point = *before);
        let partners = partners(start, &basis);
        let mut selection = Self {
            of_field: basis.kept.len(),
            basis,
            compliances,
            depth,
            partners,
            homes: Vec::new(),
            offsets: [Vec::new(), Vec::new()],
            required: before.required.clone(),
            points,
        };
        for &side in start.pair.deformable_sides() {
            let nodes = before.pointed[side].iter().enumerate();
            for (node, _) in nodes.filter(|(_, pointed)| **pointed) {
                selection.add_pointed(start, predicted, prescribed, (side, SurfaceNode::new(node)));
            }
        }
        let lodged = (0..selection.points.len()).filter(|&node| selection.points[node].is_some());
        for node in lodged.collect::<Vec<_>>() {
            selection.add_pointed(
                start,
                predicted,
                prescribed,
                (Side::B, SurfaceNode::new(node)),
            );
        }
        selection
    }

    /// Gives a pointed node unknowns of its own.
    fn add_pointed(
        &mut self,
        start: &Configuration,
        predicted: Option<&Configuration>,
        prescribed: &Prescribed,
        (side, node): (Side, SurfaceNode),
    ) {
        let tip = self.tip(side, node);
        let known = [Some(start), predicted];
        let found = known.into_iter().flatten().find_map(|configuration| {
            let spot = Spot::new(configuration, tip)?;
            let partner = spot.partner(configuration, tip);
            Some((partner, spot.hit))
        });
        let size = start.size(side, node);
        let yields = |side: Side, node: SurfaceNode| {
            let first = 3 * node.index();
            let components = prescribed[side].get(first..first + 3);
            components.is_none_or(|components| components.contains(&false))
        };
        let moves = tip.unknown(start).is_some();
        let mut flexibility = if moves && yields(side, node) {
            size / start.pair.sides[side].stiffness
        } else {
            0.0
        };
        if let Some((_, Some(hit))) = found
            && tip.presses_on_deformable(start)
        {
            let mut corners = start.side(side.opposite()).corners(hit.facet).into_iter();
            if corners.any(|corner| yields(side.opposite(), corner)) {
                flexibility += self.compliances[side.opposite()][hit.facet.index()];
            }
        }
        let basis = &mut self.basis;
        basis.index[side][node] = Some(basis.kept.len() as u32);
        basis.kept.push(KeptNode { side, node });
        basis.pivots.push(THETA_1);
        basis.flexibility.push(flexibility);
        basis.weights.push(size * size);
        let hit = found.and_then(|(_, hit)| hit);
        self.homes.push(hit.map(|hit| hit.facet));
        self.partners.push(found.map(|(partner, _)| partner));
    }
}
