//! The directions in which friction of kept nodes is determined.
//!
//! If displacements are prescribed on both sides, or several pairs hold one node, positions are
//! left that answer to fewer tractions than there are unknowns: a plane of symmetry, the edge along
//! which two planes meet. With the actions `f` of [`crate::moved_pair`] on what positions are free,
//! `S = f^T f` is the Gram matrix of all columns of all pairs, with pivots of the scale of
//! those of the roles. Pressures of closed nodes go first; then the directions that nothing
//! disturbs; what is left is *contested*. Of the contested nodes that one is taken next whose
//! 2x2 remainder after elimination has the largest eigenvalue, and the direction of that
//! eigenvector is kept, while the eigenvalue is at least 1e-4. Axis by axis would depend on the
//! frame. Positions of which all components are prescribed have `kappa_J = 0`, as rigid ones have:
//! what is left acts on all directions alike, so they disturb none.
//!
//! In a direction that is not kept the row of friction is `z = 0`, and slip there does not
//! count: in a plane of symmetry it is the slip of neighbours, which a mirror image opposes. Only
//! where prescribed motions move a node along such a direction, past what it faces, its own slip is
//! known and the law determines its friction; it is *driven*. With the imposed motion `v_J` of
//! positions that are prescribed along `c`, and the interpolation `N_J` of the opposing facet at the
//! projection of the node,
//!
//! ```text
//! (v_k - sum N_J v_J/sum N_J) . c != 0
//! ```
//!
//! A node that displacements hold along such a direction, past something deformable that is free
//! there, slips by an amount that is unknown and matters: its friction follows that of its
//! neighbours, see `directions/following.rs`. So does that of a free node whose direction other
//! frictions take, but not one whose direction pressures take: elimination of pressures alone leaves
//! less than 1e-4 of it, and it does not slip.
//!
//! Directions are components along the nodal tangents and constant in an increment.
//!
//! Null vectors of a mass matrix fade by .27 from node to node: columns further than two couplings
//! from a contested one have no effect.

mod following;
mod gram;
mod remainder;

use std::collections::BTreeMap;

use nalgebra::{Matrix2, Matrix3, SymmetricEigen, Vector2};
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{
    coverage::Place,
    frame::frame_of,
    moved_pair::{Actions, MOSTLY, MovedPair, product},
    pair::Enforcement,
    placement::Placement,
    side::Side,
    slip_freedom::SlipFreedom,
    traction_basis::{KeptNode, Weak},
};
use following::Following;
use gram::{Gram, Node, Turn, combination};

/// Eigenvalue from which a direction is determined, in the scale of pivots.
const DETERMINED: f64 = 1e-4;
/// Part of its free eigenvalue that a direction has where nothing disturbs it.
const UNDISTURBED: f64 = 1.0 - 1e-6;
/// Motion of a node past what it faces, over the facet size, that is round-off.
const ROUND_OFF: f64 = 1e-9;
/// A pair as it takes part in the choice.
pub struct Party<'a> {
    /// The pair and the positions that it moves.
    pub moved: MovedPair<'a>,
    /// Kept nodes that are known to be closed; those that touch are closed, too.
    pub closed: Vec<bool>,
    /// Has friction in this step.
    pub has_friction: bool,
    /// Placements of a rigid side at the start and the end of the increment; `None` where they are
    /// not prescribed.
    pub placements: Option<[Placement; 2]>,
}

/// Directions of friction of the kept nodes of a pair.
pub struct Directions {
    /// Directions in which friction is determined.
    pub slip_freedoms: Vec<SlipFreedom>,
    /// Nodes whose friction follows that of others.
    pub following: Vec<Weak>,
}

/// Motion of a node along a direction that is not kept, past what it faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Passing {
    /// Prescribed, and none.
    None,
    /// Prescribed.
    Prescribed,
    /// The node is held, what it faces is not; or other frictions alone take the direction.
    Open,
    /// Pressures hold the direction, or nobody knows.
    Unknown,
}

/// The directions of all kept nodes of all pairs; none where nothing is prescribed and no node is
/// in two pairs, so that all are determined.
pub fn directions(parties: &[Party]) -> Option<Vec<Directions>> {
    let disturbed = disturbed(parties)?;
    let mut gram = Gram::default();
    let mut nodes = Vec::new();
    let actions: Vec<Vec<Actions>> = parties.iter().map(|party| party.moved.actions()).collect();
    for (party, actions) in parties.iter().zip(&actions) {
        for (actions, closed) in actions.iter().zip(&party.closed) {
            nodes.push(Node::new(
                actions,
                (actions.touches || *closed, party.has_friction),
                &disturbed,
                &mut gram,
            ));
        }
    }
    gram.contest(&mut nodes);
    let mut left = nodes.as_slice();
    let of_party = |(party, actions): (&Party, &Vec<Actions>)| {
        let (own, others) = left.split_at(actions.len());
        left = others;
        party.directions(actions, own)
    };
    Some(parties.iter().zip(&actions).map(of_party).collect())
}

impl Party<'_> {
    /// Directions of friction, from those that are kept.
    fn directions(&self, actions: &[Actions], nodes: &[Node]) -> Directions {
        let mut slip_freedoms: Vec<SlipFreedom> = nodes.iter().map(Node::freedom).collect();
        let mut following = Following::new(&self.moved, actions);
        if self.has_friction {
            let kept = self.moved.selection.kept().iter().zip(nodes);
            for (k, ((kept, node), freedom)) in kept.zip(&mut slip_freedoms).enumerate() {
                if let Some((now, c)) = self.passed(kept, node) {
                    *freedom = now;
                    c.into_iter().for_each(|c| following.add(k, c));
                }
            }
        }
        Directions {
            slip_freedoms,
            following: following.rows(),
        }
    }

    /// Freedom of a node whose slip along directions that are not kept matters, and one that is
    /// unknown; `None` where it keeps its freedom.
    fn passed(&self, kept: &KeptNode, node: &Node) -> Option<(SlipFreedom, Option<Vec3>)> {
        let freedom = node.freedom();
        if freedom == SlipFreedom::Plane {
            return None;
        }
        let (configuration, (side, own)) = (self.moved.configuration, kept.place());
        let (contact, _) = configuration.opposite(side, own)?;
        let frame = frame_of(configuration, side, own);
        let t = frame.t.each_ref().map(|t| t.value);
        let lost = match freedom {
            SlipFreedom::Line([q1, q2]) => vec![Vector2::new(-q2, q1)],
            _ if node.contested.is_empty() => self.principal(&contact.place, side, &t),
            _ => axes_of(node.beside_pressures),
        };
        let lost: Vec<(Vector2<f64>, Vec3)> = lost
            .into_iter()
            .map(|q| (q, t[0] * q.x + t[1] * q.y))
            .collect();
        let passings = lost
            .iter()
            .map(|(q, c)| self.passing(kept, &contact.place, c, node.is_left(q)));
        let passings: Vec<Passing> = passings.collect();
        if passings.contains(&Passing::Prescribed) {
            return Some((SlipFreedom::Driven, None));
        }
        let at = passings.iter().position(|of| *of == Passing::Open)?;
        let (q, c) = lost[at];
        let all = passings.iter().all(|of| *of == Passing::Open);
        let now = match all {
            true => SlipFreedom::Plane,
            false => SlipFreedom::Line(q.into()),
        };
        Some((now, Some(c)))
    }

    /// Directions along the tangents `t` in which what a node of a side faces is most and least
    /// free.
    fn principal(&self, place: &Place, side: Side, t: &[Vec3; 2]) -> Vec<Vector2<f64>> {
        let configuration = self.moved.configuration;
        let weights = match configuration.pair.is_rigid() {
            true => None,
            false => place.weights(configuration, side),
        };
        let Some((corners, weights)) = weights else {
            return vec![Vector2::x(), Vector2::y()];
        };
        let movers = &self.moved.movers[configuration.pair.opposing(side)];
        let corners = corners.iter().zip(weights);
        let free: Matrix3<f64> = corners
            .map(|(corner, weight)| movers[corner.index()].free() * weight)
            .sum();
        let free = Matrix2::from_fn(|i, j| t[i].dot(&(free * t[j])));
        axes_of(free)
    }

    fn passing(&self, kept: &KeptNode, place: &Place, c: &Vec3, is_left: bool) -> Passing {
        let (configuration, (side, node)) = (self.moved.configuration, kept.place());
        let open = match configuration.pair.enforcement {
            Enforcement::Weighted => Passing::Open,
            Enforcement::Collocated => Passing::Unknown,
        };
        let mover = &self.moved.movers[side][node];
        if mover.is_free(c) {
            // Other frictions have taken the direction. What pressures hold does not slip.
            return if is_left { open } else { Passing::Unknown };
        }
        let Some(own) = mover.imposed(c) else {
            return Passing::Unknown;
        };
        let round_off = ROUND_OFF * configuration.size(side, node);
        match self.imposed_on(place, side, c) {
            Some(opposing) if (own - opposing).abs() > round_off => Passing::Prescribed,
            Some(_) => Passing::None,
            // A rigid body has no positions of its own that an interpolation could go by.
            None if configuration.pair.is_rigid() => Passing::Unknown,
            None => open,
        }
    }

    /// Motion along a unit vector of the point that a node of a side faces; `None` unless most of
    /// it is prescribed.
    fn imposed_on(&self, place: &Place, side: Side, c: &Vec3) -> Option<f64> {
        let configuration = self.moved.configuration;
        if configuration.pair.is_rigid() {
            let at = place.point(configuration, side);
            let reference = configuration.placement.back(&at);
            let [start, end] = self.placements?.map(|at| at.point(&reference));
            return Some((end - start).dot(c));
        }
        let (corners, weights) = place.weights(configuration, side)?;
        let movers = &self.moved.movers[configuration.pair.opposing(side)];
        let corners = corners.iter().zip(weights);
        let known = corners.filter_map(|(&corner, weight)| {
            let motion = movers[corner.index()].imposed(c)?;
            Some((weight, weight * motion))
        });
        let (weight, sum) = known.fold((0.0, 0.0), |sum, of| (sum.0 + of.0, sum.1 + of.1));
        (weight > MOSTLY).then(|| sum / weight)
    }
}

/// Eigenvectors of a symmetric matrix.
fn axes_of(matrix: Matrix2<f64>) -> Vec<Vector2<f64>> {
    let axes = SymmetricEigen::new(matrix).eigenvectors;
    axes.column_iter().map(Into::into).collect()
}

/// Numbers of movers that displacements hold in part or that several pairs or faces move, and
/// whether these do; none if there are none, or no friction.
fn disturbed(parties: &[Party]) -> Option<BTreeMap<u32, bool>> {
    let mut seat_of = BTreeMap::new();
    let mut disturbed = BTreeMap::new();
    for (at, party) in parties.iter().enumerate() {
        for &side in party.moved.configuration.pair.deformable_sides() {
            for (node, mover) in party.moved.movers[side].iter().enumerate() {
                if !party.moved.selection.carries(side, SurfaceNode::new(node)) {
                    continue;
                }
                if mover.is_rigid() {
                    continue;
                }
                let own = (at, side, node);
                let shared = *seat_of.entry(mover.number).or_insert(own) != own;
                if shared || mover.prescribed.contains(&true) {
                    *disturbed.entry(mover.number).or_insert(false) |= shared;
                }
            }
        }
    }
    let has_friction = parties.iter().any(|party| party.has_friction);
    (has_friction && !disturbed.is_empty()).then_some(disturbed)
}

impl Node {
    fn new(
        actions: &Actions,
        (is_closed, has_friction): (bool, bool),
        disturbed: &BTreeMap<u32, bool>,
        gram: &mut Gram,
    ) -> Self {
        let mut node = Self {
            is_closed,
            kept: Vec::new(),
            contested: Vec::new(),
            beside_pressures: Matrix2::zeros(),
        };
        if node.is_closed {
            gram.push(actions.column(0), Turn::Pressure);
        }
        let tangents = [actions.column(1), actions.column(2)];
        let disturbs = actions
            .whole
            .keys()
            .filter_map(|number| disturbed.get(number));
        let (mut is_disturbed, mut is_shared) = (false, false);
        for shared in disturbs {
            is_disturbed = true;
            is_shared |= shared;
        }
        if !has_friction || !is_disturbed {
            node.kept = vec![Vector2::x(), Vector2::y()];
            if node.is_closed && has_friction {
                tangents
                    .into_iter()
                    .for_each(|tangent| gram.push(tangent, Turn::Undisturbed));
            }
            return node;
        }
        let undisturbed: f64 = actions
            .whole
            .values()
            .map(|whole| whole[1].norm_squared())
            .sum();
        let block = Matrix2::from_fn(|i, j| product(&tangents[i], &tangents[j]));
        let eigen = SymmetricEigen::new(block);
        for (value, vector) in eigen
            .eigenvalues
            .iter()
            .zip(eigen.eigenvectors.column_iter())
        {
            let direction = Vector2::new(vector[0], vector[1]);
            let column = || combination(&tangents, &direction);
            if *value >= UNDISTURBED * undisturbed && !is_shared {
                node.kept.push(direction);
                if node.is_closed {
                    gram.push(column(), Turn::Undisturbed);
                }
            } else if *value >= DETERMINED {
                node.contested.push((direction, gram.columns.len() as u32));
                gram.push(column(), Turn::Contested);
            }
        }
        node
    }
}
