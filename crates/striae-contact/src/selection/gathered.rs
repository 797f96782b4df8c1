//! Input of the choice of a basis: overlaps and projections in one or two configurations.

use std::collections::BTreeSet;

use striae_mesh::{FacetId, Vec3};
use striae_surface::{facet::Shape, node::SurfaceNode};

use super::{
    Roles,
    sides::{surface_nodes, whole_facets},
};
use crate::{
    configuration::Configuration,
    coverage::Place,
    interface::{ClampedProjection, Interface, Opponent, Overlap},
    pair::Geometry,
    pairing::{PairedFacets, Scope, paired_facets},
    segment::SegmentDerivatives,
    side::Side,
    traction_basis::TractionBasis,
    unknown::Prescribed,
};

/// Common area below which a patch is dropped, over the square of the smaller facet size.
const SLIVER: f64 = 1e-3;

/// Input of the choice of a basis, from one or two configurations.
pub(super) struct Gathered {
    is_self_contact: bool,
    /// Facets of every overlap.
    facets: Vec<[Option<FacetId>; 2]>,
    overlaps: Vec<Overlap>,
    opposing: [Vec<Option<ClampedProjection>>; 2],
    /// Integral of the segments' normal around the nodes of side `a`.
    facing: Vec<Vec3>,
}

impl Gathered {
    /// Overlaps and projections of one configuration.
    pub(super) fn new(configuration: &Configuration, scope: Scope) -> Self {
        let paired = paired_facets(configuration, scope, &|_| SegmentDerivatives::None, |_| {
            true
        });
        let paired = without_slivers(configuration, paired);
        let mut near = Side::BOTH.map(|side| {
            let count = configuration.sides[side].as_ref().map_or(0, |s| s.x.len());
            vec![false; count]
        });
        for paired in &paired {
            for corner in 0..8 {
                if let Some((side, node)) = paired.node(configuration, corner) {
                    near[side][node] = true;
                }
            }
        }
        let met = Met::new(configuration, &paired);
        let opposing = Side::BOTH.map(|side| {
            let nodes = near[side].iter().enumerate();
            nodes
                .map(|(node, near)| {
                    near.then(|| clamped(configuration, side, SurfaceNode::new(node), &met))
                        .flatten()
                })
                .collect()
        });
        let overlaps = paired.iter().map(|paired| Overlap {
            corners: paired.corners,
            mass: paired.segment.mass,
            normal: paired.segment.normal,
        });
        let mut facing = vec![Vec3::zeros(); near[0].len()];
        for paired in &paired {
            for node in paired.corners[0] {
                facing[node] += paired.segment.normal * paired.segment.area;
            }
        }
        Self {
            is_self_contact: configuration.pair.is_self_contact(),
            facets: paired.iter().map(|paired| paired.facets).collect(),
            overlaps: overlaps.collect(),
            opposing,
            facing,
        }
    }

    /// Takes a later configuration into account: the mean overlap of facets that are paired
    /// in both, and that of facets that are paired in one.
    pub(super) fn add(&mut self, mut later: Self) {
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
        let of_side = [0, 1].map(|at| self.facets.iter().filter_map(move |pair| pair[at]));
        match self.is_self_contact {
            true => {
                let both: BTreeSet<FacetId> = of_side.into_iter().flatten().collect();
                [both.clone(), both]
            }
            false => of_side.map(Iterator::collect),
        }
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

    /// The basis that all this leads to.
    pub(super) fn basis(
        &self,
        configuration: &Configuration,
        roles: Roles,
        prescribed: &Prescribed,
    ) -> TractionBasis {
        let (Roles::After(kept) | Roles::Given(kept)) = roles;
        let nodes = Side::BOTH
            .map(|side| surface_nodes(configuration, side, kept, &prescribed.components[side]));
        let (whole, mesh);
        let opponent = match &configuration.pair.sides[Side::B].geometry {
            Geometry::Deformable(_) => Opponent::Deformable,
            Geometry::Rigid(_) | Geometry::Plane { .. } => {
                whole = whole_facets(configuration, &self.facing);
                Opponent::Rigid { whole: &whole }
            }
            Geometry::Itself => {
                let own = configuration.side(Side::A);
                mesh = own
                    .surface
                    .nodes()
                    .iter()
                    .map(|node| node.0)
                    .collect::<Vec<u32>>();
                Opponent::Itself {
                    mesh: &mesh,
                    normals: &own.normals,
                }
            }
        };
        let interface = Interface {
            nodes: [&nodes[0], &nodes[1]],
            overlaps: &self.overlaps,
            opposing: [&self.opposing[0], &self.opposing[1]],
            opponent,
            wear: configuration.pair.wear,
        };
        match roles {
            Roles::After(_) => TractionBasis::new(&interface),
            Roles::Given(kept) => TractionBasis::with_kept(&interface, kept),
        }
    }
}

/// Facets that those around each node are paired with, by side, where surfaces consist of faces;
/// what faces a node there beside them belongs to another wall.
struct Met(Option<[Vec<BTreeSet<FacetId>>; 2]>);

impl Met {
    fn new(configuration: &Configuration, paired: &[PairedFacets]) -> Self {
        if !configuration.pair.is_by_faces() || configuration.pair.is_rigid() {
            return Self(None);
        }
        let mut met = configuration.sides.each_ref().map(|side| {
            let count = side.as_ref().map_or(0, |side| side.x.len());
            vec![BTreeSet::new(); count]
        });
        for paired in paired {
            let sides = paired.sides.iter();
            for ((side, corners), other) in sides
                .zip(&paired.corners)
                .zip([paired.facets[1], paired.facets[0]])
            {
                for node in corners {
                    met[*side][node.index()].extend(other);
                }
            }
        }
        Self(Some(met))
    }

    fn holds(&self, side: Side, node: SurfaceNode, facet: FacetId) -> bool {
        let met = self.0.as_ref();
        met.is_none_or(|met| met[side][node.index()].contains(&facet))
    }
}

/// Paired facets; none where all of them share next to no area.
pub(super) fn without_slivers(
    configuration: &Configuration,
    paired: Vec<PairedFacets>,
) -> Vec<PairedFacets> {
    let is_sliver = |paired: &PairedFacets| {
        let facets = paired.sides.iter().zip(&paired.corners);
        let deformable = facets.filter(|(side, _)| configuration.pair.is_deformable(**side));
        let size = |(side, corners): (&Side, &[SurfaceNode; 4])| {
            let sizes = &configuration.side(*side).sizes;
            let corners = corners.iter();
            corners.map(|&node| sizes[node]).fold(0.0, f64::max)
        };
        let size = deformable.map(size).fold(f64::INFINITY, f64::min);
        paired.segment.area < SLIVER * size * size
    };
    if paired.iter().all(is_sliver) {
        Vec::new()
    } else {
        paired
    }
}

/// Corners and weights at the projection of a node, clamped to the other side.
fn clamped(
    configuration: &Configuration,
    side: Side,
    node: SurfaceNode,
    met: &Met,
) -> Option<ClampedProjection> {
    let on = |facet: FacetId| met.holds(side, node, facet);
    let (contact, _) = configuration.opposite_on(side, node, on)?;
    match contact.place {
        Place::Facet(hit) if !configuration.pair.is_rigid() => {
            let corners = configuration.facing(side).corners(hit.facet);
            let weights = Shape::of(&corners).weights(hit.xi, hit.eta).value;
            let weights = weights.map(|weight| weight.max(0.0));
            let sum: f64 = weights.iter().sum();
            Some((corners, weights.map(|weight| weight / sum)))
        }
        _ => None,
    }
}
