//! Which nodes of a pair carry traction unknowns, and how the others follow them.
//!
//! Roles are chosen at the start of an increment, see [`crate::roles`], from the
//! configuration it starts from and, where that shows too little, the one that it leads to.
//! They are frozen in the increment, as is the transfer to nodes that are not kept, see
//! [`crate::transfer`]. Of facets that are paired in both configurations the mean
//! overlap counts.
//!
//! Longer than other files, as all that roles are chosen from is gathered here.

use std::collections::BTreeSet;

use std::ops::Range;

use striae_mesh::{FacetId, Vec3};
use striae_surface::facet::Shape;

use crate::{
    complementarity::Prescribed,
    configuration::Configuration,
    coverage::Place,
    interface::{
        ClampedProjection, FacetMass, Interface, LastIncrement, Opponent, Overlap, SurfaceNode,
    },
    pair::Enforcement,
    pairing::{PairedFacets, Scope, paired_facets},
    pointed::{RigidPoint, RigidPoints, Spot, Tip},
    segment::{Derivatives, FACING, Facet, plane_segment},
    traction_basis::{KeptNode, THETA_1, TractionBasis, Weak},
};

/// Opposing material point at the start of the increment, for collocated slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Partner {
    /// On a deformable facet, as weights of its corners.
    Corners([u32; 4], [f64; 4]),
    /// On a rigid surface, in its reference configuration.
    Rigid(Vec3),
}

impl Partner {
    /// Where the point is now, seen from a node of `side`.
    pub fn point(&self, configuration: &Configuration, side: usize) -> Vec3 {
        match self {
            Partner::Rigid(point) => configuration.placement.point(point),
            Partner::Corners(corners, weights) => {
                let x = &configuration.side(1 - side).x;
                (0..4).map(|c| x[corners[c] as usize] * weights[c]).sum()
            }
        }
    }
}

/// Nodes that were kept, by side.
pub type Kept = [Vec<bool>; 2];

/// The traction field of a pair in an increment.
#[derive(Clone, Debug, PartialEq)]
pub struct Selection {
    /// Unknowns and basis.
    pub basis: TractionBasis,
    /// Compliance `h/E` of the facets by side.
    pub compliances: [Vec<f64>; 2],
    /// How far the two sides move towards each other in the increment, at most.
    pub depth: f64,
    /// What is opposite to the kept nodes at the start, for collocated rows and pointed nodes.
    pub partners: Vec<Option<Partner>>,
    /// The facets that the pointed nodes are in at the start.
    pub homes: Vec<Option<FacetId>>,
    /// Number of kept nodes of the field; those after them are pointed.
    pub of_field: usize,
    /// Overlap of the meshes at the nodes that is not pressed out yet, by side; empty where
    /// there is none.
    pub offsets: [Vec<f64>; 2],
    /// Points of a rigid side that are pointed.
    pub points: RigidPoints,
}

/// What nodes are before the roles of an increment are chosen.
#[derive(Clone, Copy, Debug)]
pub struct Before<'a> {
    /// Nodes that were kept in the last increment.
    pub kept: &'a Kept,
    /// Nodes that are [pointed](crate::pointed) in this one.
    pub pointed: &'a Kept,
    /// The same of points of a rigid side; may be empty.
    pub points: &'a RigidPoints,
}

/// Common area below which a patch is dropped, over the square of the facet size.
const SLIVER: f64 = 1e-3;

/// Gap up to which facets count as in contact, over their common size.
const TOUCHING: f64 = 0.05;

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
        for (side, count) in start.pair.carriers().into_iter().enumerate() {
            basis.index[side].resize(count, None);
            basis.rows[side].resize(count, Vec::new());
        }
        let of_b = basis.index[1].len();
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
            points,
        };
        for &side in start.pair.deformable_sides() {
            let nodes = before.pointed[side].iter().enumerate();
            for (node, _) in nodes.filter(|(_, pointed)| **pointed) {
                selection.add_pointed(start, predicted, prescribed, (side, node as u32));
            }
        }
        let lodged = (0..selection.points.len()).filter(|&node| selection.points[node].is_some());
        for node in lodged.collect::<Vec<_>>() {
            selection.add_pointed(start, predicted, prescribed, (1, node as u32));
        }
        selection
    }

    /// Gives a pointed node unknowns of its own.
    fn add_pointed(
        &mut self,
        start: &Configuration,
        predicted: Option<&Configuration>,
        prescribed: &Prescribed,
        (side, node): (usize, u32),
    ) {
        let tip = self.tip(side, node);
        let known = [Some(start), predicted];
        let found = known.into_iter().flatten().find_map(|configuration| {
            let spot = Spot::new(configuration, tip)?;
            let partner = spot.partner(configuration, tip);
            Some((partner, spot.hit))
        });
        let size = start.size(side, node);
        let yields = |side: usize, node: u32| {
            let first = 3 * node as usize;
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
            let mut corners = start.side(1 - side).corners(hit.facet).into_iter();
            if corners.any(|corner| yields(1 - side, corner)) {
                flexibility += self.compliances[1 - side][hit.facet.index()];
            }
        }
        let basis = &mut self.basis;
        basis.index[side][node as usize] = Some(basis.kept.len() as u32);
        basis.kept.push(KeptNode { side, node });
        basis.pivots.push(THETA_1);
        basis.flexibility.push(flexibility);
        basis.weights.push(size * size);
        let hit = found.and_then(|(_, hit)| hit);
        self.homes.push(hit.map(|hit| hit.facet));
        self.partners.push(found.map(|(partner, _)| partner));
    }

    /// What a node with unknowns stands for.
    pub fn tip(&self, side: usize, node: u32) -> Tip {
        let point = self.points.get(node as usize).copied().flatten();
        match (side, point) {
            (1, Some(point)) => Tip::Rigid(point),
            _ => Tip::Node {
                side,
                node,
                home: self.home(side, node),
            },
        }
    }

    /// The facet that a pointed node was in at the start.
    fn home(&self, side: usize, node: u32) -> Option<FacetId> {
        let k = self.basis.index[side].get(node as usize).copied()??;
        let pointed = (k as usize).checked_sub(self.of_field)?;
        self.homes.get(pointed).copied()?
    }

    /// Nodes with unknowns: those kept in the field, then the pointed ones.
    pub fn kept(&self) -> &[KeptNode] {
        &self.basis.kept
    }

    /// Which nodes of the field are kept.
    pub fn kept_nodes(&self) -> Kept {
        self.nodes_at(0..self.of_field)
    }

    /// Which nodes are pointed.
    pub fn pointed_nodes(&self) -> Kept {
        self.nodes_at(self.pointed_places())
    }

    fn nodes_at(&self, places: Range<usize>) -> Kept {
        let within = |k: &Option<u32>| k.is_some_and(|k| places.contains(&(k as usize)));
        self.basis
            .index
            .each_ref()
            .map(|side| side.iter().map(within).collect())
    }

    /// Places of the pointed nodes among those with unknowns.
    pub fn pointed_places(&self) -> Range<usize> {
        self.of_field..self.basis.kept.len()
    }

    /// Whether the node is pointed.
    pub fn is_pointed(&self, side: usize, node: u32) -> bool {
        let index = self.basis.index[side].get(node as usize).copied();
        index.flatten().is_some_and(|k| k as usize >= self.of_field)
    }

    /// Whether the node has unknowns: it is kept, or pointed.
    pub fn is_kept(&self, side: usize, node: u32) -> bool {
        let index = self.basis.index[side].get(node as usize);
        index.is_some_and(Option::is_some)
    }

    /// Whether the node has a share in the traction field.
    pub fn carries(&self, side: usize, node: u32) -> bool {
        let row = self.basis.rows[side].get(node as usize);
        row.is_some_and(|row| !row.is_empty())
    }

    /// Shares of the kept nodes in the traction at a node.
    pub fn row(&self, side: usize, node: u32) -> &[(u32, f64)] {
        &self.basis.rows[side][node as usize]
    }

    /// Number of nodes of a side.
    pub fn nodes(&self, side: usize) -> usize {
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
            [1.0 / (flexibility + ramp), 1.0 / (0.1 * flexibility + ramp)]
        } else {
            [0.0; 2]
        }
    }

    /// Weakly independent kept nodes.
    pub fn ramp(&self) -> &[Weak] {
        &self.basis.ramp
    }

    /// Rows of `E` by place among the kept nodes of the field.
    pub fn coupling(&self) -> &[Vec<(u32, f64)>] {
        &self.basis.coupling
    }

    /// What was opposite to a kept node at the start.
    pub fn partner(&self, k: usize) -> Option<Partner> {
        self.partners[k]
    }

    /// Shares of the corners of paired facets in what is left of the overlap of the meshes.
    pub fn offsets_at(&self, configuration: &Configuration, paired: &PairedFacets) -> [f64; 8] {
        let share = if configuration.pair.is_rigid() {
            1.0
        } else {
            0.5
        };
        std::array::from_fn(|corner| {
            let node = paired.node(configuration, corner);
            node.map_or(0.0, |(side, node)| share * self.offset(side, node))
        })
    }

    /// Whether overlaps of the meshes are being pressed out.
    pub fn has_offsets(&self) -> bool {
        self.offsets.iter().flatten().any(|offset| *offset > 0.0)
    }

    /// What is left of the overlap of the meshes at a node.
    pub fn offset(&self, side: usize, node: u32) -> f64 {
        let offset = self.offsets[side].get(node as usize);
        offset.copied().unwrap_or(0.0)
    }

    /// Which facets are paired.
    pub fn scope(&self) -> Scope<'_> {
        Scope {
            compliances: &self.compliances,
            depth: self.depth,
        }
    }

    /// Whether facets of the two sides overlap.
    pub fn overlaps(&self, configuration: &Configuration) -> bool {
        !paired_facets(configuration, self.scope(), Derivatives::None, |_| true).is_empty()
    }

    /// Corners of facets that overlap with others without a share in the traction field,
    /// as side and node, in a configuration that was reached from `start`.
    pub fn left_out(
        &self,
        start: &Configuration,
        configuration: &Configuration,
    ) -> Vec<(usize, u32)> {
        let scope = Scope {
            depth: self.depth.max(approach(start, configuration)),
            ..self.scope()
        };
        let paired = paired_facets(configuration, scope, Derivatives::None, |_| true);
        let mut left_out: Vec<(usize, u32)> = Vec::new();
        for paired in &paired {
            let gap = paired.mean_gap(configuration);
            let touching = gap < TOUCHING * paired.segment.area.sqrt();
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
}

/// `h/E` of the facets of deformable sides.
pub(crate) fn compliances(configuration: &Configuration) -> [Vec<f64>; 2] {
    [0, 1].map(|side| {
        let of_side = &configuration.pair.sides[side];
        let Some(surface) = of_side.surface() else {
            return Vec::new();
        };
        let rigid = side == 1 && configuration.pair.is_rigid();
        let facets = surface.facets().iter();
        facets
            .map(|corners| {
                if rigid {
                    return 0.0;
                }
                let sizes = corners.map(|node| configuration.side(side).sizes[node as usize]);
                0.25 * sizes.iter().sum::<f64>() / of_side.stiffness
            })
            .collect()
    })
}

/// Largest motion of one side relative to the other.
pub fn approach(start: &Configuration, end: &Configuration) -> f64 {
    let moves = |side: usize| -> [Vec3; 2] {
        let (Some(from), Some(to)) = (&start.sides[side], &end.sides[side]) else {
            let way = start.plane().zip(end.plane());
            let way = way.map_or_else(Vec3::zeros, |((from, _), (to, _))| to - from);
            return [way; 2];
        };
        let mut moves = from.x.iter().zip(&to.x).map(|(from, to)| to - from);
        let first = moves.next().unwrap_or_default();
        moves.fold([first; 2], |[low, high], way| {
            [low.inf(&way), high.sup(&way)]
        })
    };
    let [a, b] = [moves(0), moves(1)];
    let apart = (a[1] - b[0]).abs().sup(&(b[1] - a[0]).abs());
    apart.norm()
}

/// What a basis is chosen from, in one or two configurations.
struct Gathered {
    /// Facets of every overlap.
    facets: Vec<[Option<FacetId>; 2]>,
    overlaps: Vec<Overlap>,
    opposing: [Vec<Option<ClampedProjection>>; 2],
    /// Integral of the segments' normal around the nodes of side `a`.
    facing: Vec<Vec3>,
}

impl Gathered {
    fn new(configuration: &Configuration, scope: Scope) -> Self {
        let paired = paired_facets(configuration, scope, Derivatives::None, |_| true);
        let paired = without_slivers(configuration, paired);
        let mut near = [0, 1].map(|side| {
            let count = configuration.sides[side].as_ref().map_or(0, |s| s.x.len());
            vec![false; count]
        });
        for paired in &paired {
            for corner in 0..8 {
                if let Some((side, node)) = paired.node(configuration, corner) {
                    near[side][node as usize] = true;
                }
            }
        }
        let opposing = [0, 1].map(|side| {
            let nodes = near[side].iter().enumerate();
            nodes
                .map(|(node, near)| {
                    near.then(|| clamped(configuration, side, node as u32))
                        .flatten()
                })
                .collect()
        });
        let overlaps = paired.iter().map(|paired| Overlap {
            corners: paired.corners,
            mass: paired.segment.mass,
        });
        let mut facing = vec![Vec3::zeros(); near[0].len()];
        for paired in &paired {
            for node in paired.corners[0] {
                facing[node as usize] += paired.segment.normal * paired.segment.area;
            }
        }
        Self {
            facets: paired.iter().map(|paired| paired.facets).collect(),
            overlaps: overlaps.collect(),
            opposing,
            facing,
        }
    }

    /// Takes a later configuration into account: the mean overlap of facets that are paired
    /// in both, and that of facets that are paired in one.
    fn add(&mut self, mut later: Self) {
        let paired = [self.paired(), later.paired()];
        self.share_with(&paired[1]);
        later.share_with(&paired[0]);
        self.facets.extend(later.facets);
        self.overlaps.extend(later.overlaps);
        for (sum, later) in self.facing.iter_mut().zip(later.facing) {
            *sum += later;
        }
        for (known, later) in self.opposing.iter_mut().zip(later.opposing) {
            for (known, later) in known.iter_mut().zip(later) {
                *known = known.or(later);
            }
        }
    }

    /// Facets that are paired, by side.
    fn paired(&self) -> [BTreeSet<FacetId>; 2] {
        [0, 1].map(|side| self.facets.iter().filter_map(|pair| pair[side]).collect())
    }

    /// Halves the overlaps of facets that are paired in another configuration too.
    fn share_with(&mut self, other: &[BTreeSet<FacetId>; 2]) {
        for (facets, overlap) in self.facets.iter().zip(&mut self.overlaps) {
            let of_side = facets.iter().zip(other);
            let mut known = of_side.filter_map(|(facet, paired)| Some(paired.contains(&(*facet)?)));
            if known.any(|known| known) {
                overlap.mass.iter_mut().flatten().for_each(|m| *m *= 0.5);
            }
        }
    }

    fn basis(
        &self,
        configuration: &Configuration,
        before: Before,
        prescribed: &Prescribed,
    ) -> TractionBasis {
        let nodes =
            [0, 1].map(|side| surface_nodes(configuration, side, before, &prescribed[side]));
        let whole = if configuration.pair.is_rigid() {
            whole_facets(configuration, &self.facing)
        } else {
            Vec::new()
        };
        TractionBasis::new(&Interface {
            nodes: [&nodes[0], &nodes[1]],
            overlaps: &self.overlaps,
            opposing: [&self.opposing[0], &self.opposing[1]],
            opponent: if configuration.pair.is_rigid() {
                Opponent::Rigid { whole: &whole }
            } else {
                Opponent::Deformable
            },
        })
    }
}

/// Paired facets without patches that share next to no area.
fn without_slivers(configuration: &Configuration, paired: Vec<PairedFacets>) -> Vec<PairedFacets> {
    let is_sliver = |paired: &PairedFacets| {
        let size = |corners: &[u32; 4], side: usize| {
            let sizes = &configuration.side(side).sizes;
            corners
                .iter()
                .map(|&node| sizes[node as usize])
                .fold(0.0, f64::max)
        };
        let size = size(&paired.corners[0], 0);
        paired.segment.area < SLIVER * size * size
    };
    if paired.iter().all(is_sliver) {
        Vec::new()
    } else {
        paired
    }
}

/// Corners and weights at the projection of a node, clamped to the other side.
fn clamped(configuration: &Configuration, side: usize, node: u32) -> Option<ClampedProjection> {
    let (contact, _) = configuration.opposite(side, node)?;
    match contact.place {
        Place::Facet(hit) if !configuration.pair.is_rigid() => {
            let corners = configuration.side(1 - side).corners(hit.facet);
            let weights = Shape::of(&corners).weights(hit.xi, hit.eta).value;
            let weights = weights.map(|weight| weight.max(0.0));
            let sum: f64 = weights.iter().sum();
            Some((corners, weights.map(|weight| weight / sum)))
        }
        _ => None,
    }
}

fn surface_nodes(
    configuration: &Configuration,
    side: usize,
    before: Before,
    prescribed: &[bool],
) -> Vec<SurfaceNode> {
    let Some(snapshot) = &configuration.sides[side] else {
        return Vec::new();
    };
    if side == 1 && configuration.pair.is_rigid() {
        return Vec::new();
    }
    let modulus = configuration.pair.sides[side].stiffness;
    let nodes = snapshot.x.iter().zip(&snapshot.sizes).enumerate();
    nodes
        .map(|(node, (position, size))| {
            let components = prescribed.get(3 * node..3 * node + 3);
            let yields = components.is_none_or(|components| components.contains(&false));
            let share = f64::from(u8::from(yields));
            SurfaceNode {
                position: *position,
                flexibility: share * size / modulus,
                compliance: share / (modulus * size),
                last: if before.pointed[side].get(node) == Some(&true) {
                    LastIncrement::Pointed
                } else if before.kept[side].get(node) == Some(&true) {
                    LastIncrement::Kept
                } else {
                    LastIncrement::NotKept
                },
            }
        })
        .collect()
}

/// Masses of the facets of side `a` as if they were covered wholly: of those that face what
/// touches at one of their corners. A wall next to a sole cannot be covered.
fn whole_facets(configuration: &Configuration, facing: &[Vec3]) -> Vec<FacetMass> {
    let own = configuration.side(0);
    (0..own.surface.facets().len())
        .filter_map(|facet| {
            let facet = FacetId::new(facet);
            let corners = own.corners(facet);
            let x = own.corner_positions(facet);
            let shape = Shape::of(&corners);
            let n = normal(&x, shape);
            let faces = |corner: &u32| {
                let towards = facing[*corner as usize];
                n.dot(&towards) > -FACING * towards.norm()
            };
            if !corners.iter().any(faces) {
                return None;
            }
            let segment = plane_segment(&Facet { corners: x, shape }, &-n, Derivatives::None)?;
            let mass = std::array::from_fn(|c| std::array::from_fn(|d| segment.mass[c][d]));
            Some(FacetMass { corners, mass })
        })
        .collect()
}

fn normal(x: &[Vec3; 4], shape: Shape) -> Vec3 {
    match shape {
        Shape::Triangle => (x[1] - x[0]).cross(&(x[2] - x[0])),
        Shape::Quadrilateral => (x[2] - x[0]).cross(&(x[3] - x[1])),
    }
    .normalize()
}

/// What is opposite to the kept nodes, where rows are collocated.
fn partners(configuration: &Configuration, basis: &TractionBasis) -> Vec<Option<Partner>> {
    if configuration.pair.enforcement == Enforcement::Weighted {
        return vec![None; basis.kept.len()];
    }
    let partner = |kept: &KeptNode| {
        let (contact, _) = configuration.opposite(kept.side, kept.node)?;
        match contact.place.weights(configuration, kept.side) {
            Some((corners, weights)) if !configuration.pair.is_rigid() => {
                Some(Partner::Corners(corners, weights))
            }
            _ => {
                let point = contact.place.point(configuration, kept.side);
                Some(Partner::Rigid(configuration.placement.back(&point)))
            }
        }
    };
    basis.kept.iter().map(partner).collect()
}
