//! The directions in which friction of kept nodes is determined.
//!
//! If displacements are prescribed on both sides, or several pairs hold one node, positions are
//! left that answer to fewer tractions than there are unknowns: a plane of symmetry, the edge along
//! which two planes meet. With the positions `J` that contact moves, `P_J` that removes the
//! prescribed components and `kappa_J` of [`crate::roles`], the unknowns of a kept node `k` act by
//! the columns
//!
//! ```text
//! pressure   f_Jk  = sqrt(kappa_J) P_J sum_segments (+-) D_kJ n                / sqrt(w_k l_k)
//! friction   f_Jka = sqrt(kappa_J) P_J sum_segments (+-) D_kJ R(n, n_k) t_a    / sqrt(w_k l_k)
//! D_kJ = integral phi_k N_J
//! ```
//!
//! and `S = f^T f` is the Gram matrix of all columns of all pairs, with pivots of the scale of
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
//! Directions are components along the nodal tangents and constant in an increment.
//!
//! Null vectors of a mass matrix fade by .27 from node to node: columns further than two couplings
//! from a contested one have no effect.

mod gram;

use std::collections::BTreeMap;

use nalgebra::{Matrix2, Matrix3, SymmetricEigen, Vector2};
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{
    configuration::Configuration,
    coverage::Place,
    frame::{Frame, frame_of},
    pairing::{Corners, SIGNS, paired_facets},
    patch::kept_on,
    placement::Placement,
    segment::SegmentDerivatives,
    selection::Selection,
    side::Side,
    slip_freedom::SlipFreedom,
    traction_basis::KeptNode,
    transported::Transported,
};
use gram::{Column, Gram, Node, combination, product};

/// Eigenvalue from which a direction is determined, in the scale of pivots.
const DETERMINED: f64 = 1e-4;
/// Part of its free eigenvalue that a direction has where nothing disturbs it.
const UNDISTURBED: f64 = 1.0 - 1e-6;
/// Gap up to which a node touches, over the size of its segments.
const TOUCHING: f64 = 1e-6;
/// Motion of a node past what it faces, over the facet size, that is round-off.
const ROUND_OFF: f64 = 1e-9;
/// Square of the free part of a unit vector below which a node is prescribed along it, and weight of
/// such nodes above which a point is.
const MOSTLY: f64 = 0.5;

/// A position that contact moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mover {
    /// Number of the node, equal in all pairs.
    pub number: u32,
    /// Components that are prescribed.
    pub prescribed: [bool; 3],
    /// Axes of the components in columns, where they are not the coordinate axes.
    pub axes: Option<Matrix3<f64>>,
    /// Motion in the increment along the prescribed components; `None` if others move it.
    pub motion: Option<Vec3>,
}

impl Mover {
    /// Motion along a unit vector; `None` unless it is prescribed.
    fn imposed(&self, c: &Vec3) -> Option<f64> {
        let motion = self.motion?;
        let is_held = (self.free() * c).norm_squared() < MOSTLY;
        is_held.then(|| motion.dot(c))
    }

    /// Returns whether nothing moves it but displacements.
    fn is_rigid(&self) -> bool {
        self.prescribed == [true; 3]
    }

    /// Projection to the directions that are not prescribed.
    fn free(&self) -> Matrix3<f64> {
        let free = self.prescribed.map(|held| f64::from(u8::from(!held)));
        let along_axes = Matrix3::from_diagonal(&free.into());
        match self.axes {
            Some(axes) => axes * along_axes * axes.transpose(),
            None => along_axes,
        }
    }
}

/// A pair as it takes part in the choice.
pub struct Party<'a> {
    /// Configuration of the pair.
    pub configuration: &'a Configuration<'a>,
    /// Roles.
    pub selection: &'a Selection,
    /// The nodes of the deformable sides.
    pub movers: [Vec<Mover>; 2],
    /// Kept nodes that are known to be closed; those that touch are closed, too.
    pub closed: Vec<bool>,
    /// Has friction in this step.
    pub has_friction: bool,
    /// Placements of a rigid side at the start and the end of the increment; `None` where they are
    /// not prescribed.
    pub placements: Option<[Placement; 2]>,
}

/// The directions of all kept nodes of all pairs; none where nothing is prescribed and no node is
/// in two pairs, so that all are determined.
pub fn slip_freedoms(parties: &[Party]) -> Option<Vec<Vec<SlipFreedom>>> {
    let disturbed = disturbed(parties)?;
    let mut gram = Gram::default();
    let mut nodes = Vec::new();
    for party in parties {
        for actions in actions(party) {
            nodes.push(Node::new(
                &actions,
                party.has_friction,
                &disturbed,
                &mut gram,
            ));
        }
    }
    gram.contest(&mut nodes);
    let mut freedoms = nodes.iter().map(Node::freedom);
    let of_party = |party: &Party| {
        let of_kept = party.selection.kept().iter().zip(freedoms.by_ref());
        of_kept
            .map(|(kept, freedom)| match party.drives(kept, freedom) {
                true => SlipFreedom::Driven,
                false => freedom,
            })
            .collect()
    };
    Some(parties.iter().map(of_party).collect())
}

impl Party<'_> {
    /// Returns whether prescribed motions move a node along a direction that is not kept.
    fn drives(&self, kept: &KeptNode, freedom: SlipFreedom) -> bool {
        if !self.has_friction || freedom == SlipFreedom::Plane {
            return false;
        }
        let (configuration, (side, node)) = (self.configuration, kept.place());
        let Frame { t: [t1, t2], .. } = frame_of(configuration, side, node);
        let lost = match freedom {
            SlipFreedom::Line([q1, q2]) => vec![t2.value * q1 - t1.value * q2],
            _ => vec![t1.value, t2.value],
        };
        let Some((contact, _)) = configuration.opposite(side, node) else {
            return false;
        };
        let round_off = ROUND_OFF * configuration.size(side, node);
        lost.iter().any(|c| {
            let own = self.movers[side][node].imposed(c);
            let opposing = own.and_then(|_| self.imposed_on(&contact.place, side, c));
            own.zip(opposing)
                .is_some_and(|(own, opposing)| (own - opposing).abs() > round_off)
        })
    }

    /// Motion along a unit vector of the point that a node of a side faces; `None` unless most of
    /// it is prescribed.
    fn imposed_on(&self, place: &Place, side: Side, c: &Vec3) -> Option<f64> {
        let configuration = self.configuration;
        if configuration.pair.is_rigid() {
            let at = place.point(configuration, side);
            let reference = configuration.placement.back(&at);
            let [start, end] = self.placements?.map(|at| at.point(&reference));
            return Some((end - start).dot(c));
        }
        let (corners, weights) = place.weights(configuration, side)?;
        let movers = &self.movers[configuration.pair.opposing(side)];
        let corners = corners.iter().zip(weights);
        let known = corners.filter_map(|(&corner, weight)| {
            let motion = movers[corner.index()].imposed(c)?;
            Some((weight, weight * motion))
        });
        let (weight, sum) = known.fold((0.0, 0.0), |sum, of| (sum.0 + of.0, sum.1 + of.1));
        (weight > MOSTLY).then(|| sum / weight)
    }
}

/// Numbers of movers that displacements hold in part or that several pairs or faces move, and
/// whether these do; none if there are none, or no friction.
fn disturbed(parties: &[Party]) -> Option<BTreeMap<u32, bool>> {
    let mut seat_of = BTreeMap::new();
    let mut disturbed = BTreeMap::new();
    for (at, party) in parties.iter().enumerate() {
        for &side in party.configuration.pair.deformable_sides() {
            for (node, mover) in party.movers[side].iter().enumerate() {
                if !party.selection.carries(side, SurfaceNode::new(node)) {
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

/// Actions of the unknowns of a kept node: pressure, then friction along both tangents.
#[derive(Clone, Default)]
struct Actions {
    /// By number of the mover, with prescribed components.
    whole: BTreeMap<u32, [Vec3; 3]>,
    /// Projections to what is free of the movers.
    free: BTreeMap<u32, Matrix3<f64>>,
    is_closed: bool,
}

impl Actions {
    /// The part of an action that moves anything.
    fn column(&self, component: usize) -> Column {
        let free =
            |(number, whole): (&u32, &[Vec3; 3])| (*number, self.free[number] * whole[component]);
        self.whole.iter().map(free).collect()
    }
}

/// Actions of the kept nodes of a pair.
fn actions(party: &Party) -> Vec<Actions> {
    let (configuration, selection) = (party.configuration, party.selection);
    let kept = selection.kept();
    let normals: Vec<_> = kept
        .iter()
        .map(|kept| frame_of(configuration, kept.side, kept.node))
        .collect();
    let of_kept = |is_closed: &bool| Actions {
        is_closed: *is_closed,
        ..Actions::default()
    };
    let mut actions: Vec<Actions> = party.closed.iter().map(of_kept).collect();
    let none = |_: &[Corners]| SegmentDerivatives::None;
    for paired in paired_facets(configuration, selection.scope(), &none, |_| true) {
        let n = paired.segment.normal;
        let corners: Vec<_> = (0..8)
            .filter_map(|corner| Some((corner, paired.node(configuration, corner)?)))
            .collect();
        let touches = paired.least_gap(configuration) <= TOUCHING * paired.segment.area.sqrt();
        for on_segment in kept_on(configuration, selection, &paired) {
            let k = on_segment.k as usize;
            actions[k].is_closed |= touches;
            let frame = &normals[k];
            let turned = |axis: usize| {
                let t = &frame.t[axis].value;
                Transported::new(t, &(frame.n.value * on_segment.sign), &n).value
            };
            let directions = [turned(0), turned(1)];
            let scale = selection.weight(k) * selection.basis.flexibility[k];
            for &(corner, (side, node)) in &corners {
                let mover = &party.movers[side][node];
                let kappa = kappa(configuration, side, node);
                let by = SIGNS[corner] * (kappa / scale).sqrt();
                let mass = &paired.segment.mass[corner];
                let share = |shares: &[f64; 8]| -> f64 {
                    by * shares
                        .iter()
                        .zip(mass)
                        .map(|(share, m)| share * m)
                        .sum::<f64>()
                };
                let [pressure, friction] = [&on_segment.shares, &on_segment.slips].map(share);
                if scale == 0.0 || pressure == 0.0 || mover.is_rigid() {
                    continue;
                }
                let whole = actions[k].whole.entry(mover.number).or_default();
                whole[0] += n * pressure;
                for (sum, direction) in whole[1..].iter_mut().zip(&directions) {
                    *sum += direction * friction;
                }
                actions[k].free.insert(mover.number, mover.free());
            }
        }
    }
    actions
}

/// `1/(E h)` at a node.
fn kappa(configuration: &Configuration, side: Side, node: SurfaceNode) -> f64 {
    (configuration.pair.sides[side].stiffness * configuration.size(side, node)).recip()
}

impl Node {
    fn new(
        actions: &Actions,
        has_friction: bool,
        disturbed: &BTreeMap<u32, bool>,
        gram: &mut Gram,
    ) -> Self {
        let mut node = Self {
            is_closed: actions.is_closed,
            kept: Vec::new(),
            contested: Vec::new(),
        };
        if node.is_closed {
            gram.push(actions.column(0), true);
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
                    .for_each(|tangent| gram.push(tangent, true));
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
                    gram.push(column(), true);
                }
            } else if *value >= DETERMINED {
                node.contested.push((direction, gram.columns.len() as u32));
                gram.push(column(), false);
            }
        }
        node
    }
}
