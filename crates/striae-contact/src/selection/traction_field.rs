//! The traction field of a pair in an increment, as it was chosen.

use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use super::{Kept, approach::approach, gathered::without_slivers};
use crate::{
    bedding::bedding,
    configuration::Configuration,
    pairing::{PairedFacets, Scope, paired_facets},
    partner::Partner,
    seating::Fitted,
    segment::SegmentDerivatives,
    side::Side,
    slip_freedom::SlipFreedom,
    traction_basis::{KeptNode, TractionBasis, Weak},
};

/// Gap up to which facets count as in contact, over their common size.
const TOUCHING: f64 = 0.05;

/// Largest sum of the depths of both sides.
pub fn deepest(worn: &[Vec<f64>; 2]) -> f64 {
    let largest = |side: &Vec<f64>| side.iter().copied().fold(0.0, f64::max);
    worn.iter().map(largest).sum()
}

/// The traction field of a pair in an increment.
#[derive(Clone, Debug, PartialEq)]
pub struct Selection {
    /// Unknowns and basis.
    pub basis: TractionBasis,
    /// Compliance `h/E` of the facets by side.
    pub compliances: [Vec<f64>; 2],
    /// Largest approach of the two sides in the increment.
    pub depth: f64,
    /// Positions of the surface nodes at the start of the increment, by side.
    pub start: [Vec<Vec3>; 2],
    /// Points opposite to the kept nodes at the start, for collocated rows.
    pub partners: Vec<Option<Partner>>,
    /// Overlap of the meshes at the nodes that is not removed yet, by side; empty if there is none.
    pub offsets: [Vec<f64>; 2],
    /// Depth that has worn off the nodes at the start, by side; empty where nothing has.
    pub worn: [Vec<f64>; 2],
    /// In which directions friction of the kept nodes is determined; empty where it is in all.
    pub slip_freedoms: Vec<SlipFreedom>,
    /// Kept nodes whose friction follows that of others.
    pub following: Vec<Weak>,
    /// Faces that are taken as touching, and how much they interfere.
    pub fitted: Option<Fitted>,
    /// All of its nodes went to other pairs.
    pub has_yielded: bool,
}

impl Selection {
    /// Nodes with unknowns.
    pub fn kept(&self) -> &[KeptNode] {
        &self.basis.kept
    }

    /// Nodes that are kept.
    pub fn kept_nodes(&self) -> Kept {
        let index = self.basis.index.each_ref();
        index.map(|side| side.iter().map(Option::is_some).collect())
    }

    /// Returns whether the node has unknowns.
    pub fn is_kept(&self, side: Side, node: SurfaceNode) -> bool {
        let index = self.basis.index[side].get(node.index());
        index.is_some_and(Option::is_some)
    }

    /// Returns whether the node has a share in the traction field.
    pub fn carries(&self, side: Side, node: SurfaceNode) -> bool {
        let row = self.basis.rows[side].get(node.index());
        row.is_some_and(|row| !row.is_empty())
    }

    /// Shares of the kept nodes in the traction at a node.
    pub fn row(&self, side: Side, node: SurfaceNode) -> &[(u32, f64)] {
        &self.basis.rows[side][node]
    }

    /// Shares of the kept nodes in the friction at a node, in the order of [`Self::row`]: negative
    /// for those that face its surface.
    pub fn friction_row(&self, side: Side, node: SurfaceNode) -> &[f64] {
        &self.basis.friction_rows[side][node]
    }

    /// Number of nodes of a side.
    pub fn nodes(&self, side: Side) -> usize {
        self.basis.index[side].len()
    }

    /// `integral phi_k` of a kept node at the start of the increment.
    pub fn weight(&self, k: usize) -> f64 {
        self.basis.weights[k]
    }

    /// Pressure per gap and friction per slip, `[r_n, r_t]`, that scale the complementarity of
    /// a kept node; zero where nothing yields, as no row can hold there.
    ///
    /// The rows yield by `l_k` and by what the ramp adds, `E_kk/w_k`:
    /// `r_n = 1/(l_k + E_kk/w_k)`, `r_t = 1/(l_k/10 + E_kk/w_k)`. With `r_n = 1/l_k` a weak
    /// node under tension would count as closed, since the ramp takes the tension for a gap.
    pub fn stiffness(&self, k: usize) -> [f64; 2] {
        let flexibility = self.basis.flexibility[k];
        let own = self.coupling().get(k).and_then(|row| {
            let at = row.binary_search_by_key(&(k as u32), |entry| entry.0);
            at.ok().map(|at| row[at].1)
        });
        let ramp = own.unwrap_or(0.0) / self.weight(k);
        if flexibility > 0.0 {
            // Scaling factors only: solutions do not depend on them, the path of the iterations
            // does.
            [1.0 / (flexibility + ramp), 1.0 / (0.1 * flexibility + ramp)]
        } else {
            [0.0; 2]
        }
    }

    /// `l_k`.
    pub(crate) fn flexibility(&self, k: usize) -> f64 {
        self.basis.flexibility[k]
    }

    /// `r_k`, pressure per gap where the support of a kept node is open, at the share of it
    /// that is closed.
    pub fn bedding(&self, k: usize, closed: f64) -> f64 {
        bedding(self.basis.flexibility[k], closed)
    }

    /// In which directions friction of a kept node is determined.
    pub fn slip_freedom(&self, k: usize) -> SlipFreedom {
        self.slip_freedoms.get(k).copied().unwrap_or_default()
    }

    /// Takes over the kinds of the directions of friction, and the senses of lines, from the field
    /// of a model that differs by a small change; returns `false` if that has other kept nodes.
    #[must_use]
    pub fn take_freedoms_like(&mut self, other: &Self) -> bool {
        if self.basis.kept != other.basis.kept {
            return false;
        }
        self.slip_freedoms = match other.slip_freedoms.is_empty() {
            true => Vec::new(),
            false => (0..self.kept().len())
                .map(|k| self.slip_freedom(k).like(other.slip_freedom(k)))
                .collect(),
        };
        let nodes = |of: &Self| -> Vec<u32> { of.following.iter().map(|weak| weak.kept).collect() };
        if nodes(self) != nodes(other) {
            self.following.clone_from(&other.following);
        }
        true
    }

    /// Weakly independent kept nodes.
    pub fn ramp(&self) -> &[Weak] {
        &self.basis.ramp
    }

    /// Rows of `E` by place among the kept nodes.
    pub fn coupling(&self) -> &[Vec<(u32, f64)>] {
        &self.basis.coupling
    }

    /// Rows of `M` by place among the kept nodes; empty for pairs without wear.
    pub fn wear(&self) -> &[Vec<(u32, f64)>] {
        &self.basis.wear
    }

    /// Point opposite to a kept node at the start.
    pub fn partner(&self, k: usize) -> Option<Partner> {
        self.partners[k]
    }

    /// Shares of the corners of paired facets in what is added to their gap: what is left of the
    /// overlap of the meshes, or an interference, and what has worn off.
    pub(crate) fn offsets_at(
        &self,
        configuration: &Configuration,
        paired: &PairedFacets,
    ) -> [f64; 8] {
        let mut offsets = self.fitted_at(configuration, paired);
        if self.worn.iter().any(|side| !side.is_empty()) {
            for (corner, offset) in offsets.iter_mut().enumerate() {
                if let Some((side, node)) = paired.node(configuration, corner) {
                    // All of it: the depth belongs to the material of its own side.
                    *offset += self.worn[side][node];
                }
            }
        }
        offsets
    }

    /// Shares of the corners in what is left of an overlap, or in an interference.
    fn fitted_at(&self, configuration: &Configuration, paired: &PairedFacets) -> [f64; 8] {
        let fitted = self.fitted.as_ref();
        let mut offsets = fitted.map_or([0.0; 8], |fitted| fitted.at_corners(paired));
        let share = configuration.pair.share();
        for (corner, offset) in offsets.iter_mut().enumerate() {
            if let Some((side, node)) = paired.node(configuration, corner) {
                *offset += share * self.offset(side, node);
            }
        }
        offsets
    }

    /// Returns whether initial overlaps of the meshes are being removed.
    pub fn has_offsets(&self) -> bool {
        self.offsets.iter().flatten().any(|offset| *offset > 0.0)
    }

    /// Offset of the gap at a node along its own normal.
    pub fn offset_along_normal(&self, side: Side, node: SurfaceNode) -> f64 {
        let fitted = self.fitted.as_ref();
        self.offset(side, node) + fitted.map_or(0.0, |fitted| fitted.at_node(side, node))
    }

    /// Part of the initial overlap that remains at a node.
    fn offset(&self, side: Side, node: SurfaceNode) -> f64 {
        let offset = self.offsets[side].get(node.index());
        offset.copied().unwrap_or(0.0)
    }

    /// Facets that are paired.
    pub fn scope(&self) -> Scope<'_> {
        Scope {
            compliances: &self.compliances,
            depth: self.depth,
            start: Some(&self.start),
        }
    }

    /// Returns whether facets of the two sides overlap.
    pub fn overlaps(&self, configuration: &Configuration) -> bool {
        !paired_facets(
            configuration,
            self.scope(),
            &|_| SegmentDerivatives::None,
            |_| true,
        )
        .is_empty()
    }

    /// Corners of facets that overlap with others without a share in the traction field, as side
    /// and node, in a configuration that was reached from `start`.
    pub fn left_out(
        &self,
        start: &Configuration,
        configuration: &Configuration,
    ) -> Vec<(Side, SurfaceNode)> {
        let scope = Scope {
            // Bodies that approached faster than foreseen may already be deeper than the search of
            // this increment.
            depth: (self.depth).max(approach(start, configuration) + deepest(&self.worn)),
            ..self.scope()
        };
        let paired = paired_facets(configuration, scope, &|_| SegmentDerivatives::None, |_| {
            true
        });
        let mut left_out: Vec<(Side, SurfaceNode)> = Vec::new();
        // Slivers alone would get no share either.
        for paired in &without_slivers(configuration, paired) {
            let gap = paired.mean_gap(configuration);
            let touching = paired.least_gap(configuration) < TOUCHING * paired.segment.area.sqrt();
            // Deeper than contact looks in this increment.
            let beyond = -gap > paired.reach + self.depth;
            let nodes = (0..8).filter_map(|corner| paired.node(configuration, corner));
            let found =
                nodes.filter(|&(side, node)| beyond || touching && !self.carries(side, node));
            left_out.extend(found);
        }
        left_out.sort_unstable();
        left_out.dedup();
        left_out
    }

    /// Returns whether nodes that have met and that a field chosen before leaves out are worth this
    /// one instead: not if all of its nodes went to other pairs, which hold what has met.
    pub fn gains_on(
        &self,
        before: &Self,
        start: &Configuration,
        configuration: &Configuration,
    ) -> bool {
        let is_same = self.has_yielded && before.basis.kept.is_empty();
        !is_same && !before.left_out(start, configuration).is_empty()
    }
}
