//! Configuration of the two sides of a pair: positions, normals and search trees.

use std::sync::OnceLock;

use striae_mesh::{FacetId, Vec3};
use striae_surface::{
    node::SurfaceNode,
    normal::nodal_normals,
    topology::{Surface, distinct_corners},
};

use crate::{
    pair::{ContactPair, Enclosure, Geometry, local_sizes},
    placement::Placement,
    search::{Bounds, Tree},
    segment::{FACING, ON_EDGE},
    side::Side,
};

/// Part of the root of the area of a facet by which segments may stand out of both facets together.
///
/// Corners count as on edges that they are [`ON_EDGE`] away from, seen along the normal of the pair,
/// to which facets stand with a cosine of `-FACING` at least.
pub(crate) const BEYOND: f64 = 2.0 * ON_EDGE / -FACING;

/// Both sides of a pair in one configuration.
#[derive(Clone, Debug)]
pub struct Configuration<'a> {
    /// The pair.
    pub pair: &'a ContactPair,
    /// Snapshots of the sides; a plane has none, nor has side `b` of self-contact.
    pub sides: [Option<Snapshot<'a>>; 2],
    /// Placement of a rigid side `b`.
    pub placement: Placement,
    /// Time since the last converged configuration; infinite where it does not matter.
    pub elapsed: f64,
    /// Time; zero where it does not matter.
    pub time: f64,
    /// Depth by which the sides may overlap as they have worn, zero where it does not matter.
    pub worn: f64,
}

/// A surface of facets in one configuration.
#[derive(Clone, Debug)]
pub struct Snapshot<'a> {
    /// Topology.
    pub surface: &'a Surface,
    /// Current positions of the surface nodes.
    pub x: Vec<Vec3>,
    /// Unit outward nodal normals.
    pub normals: Vec<Vec3>,
    /// Local facet size at every node.
    pub sizes: Vec<f64>,
    /// The largest of them.
    pub largest_size: f64,
    /// Tree over the facets, once it was asked for.
    tree: OnceLock<Tree>,
    /// Tree over the boundary edges, once it was asked for.
    edge_tree: OnceLock<Tree>,
    /// Skin that the surface is part of, where it was asked for.
    pub enclosed: Option<Enclosed<'a>>,
}

/// The skin that a surface is part of in one configuration.
#[derive(Clone, Debug)]
pub struct Enclosed<'a> {
    /// Topology, and the facets of the surface that its facets are.
    pub enclosure: &'a Enclosure,
    /// Current positions of its nodes.
    pub x: Vec<Vec3>,
    /// Local facet size at every node.
    pub sizes: Vec<f64>,
    /// Tree over the facets, once it was asked for.
    tree: OnceLock<Tree>,
}

impl<'a> Configuration<'a> {
    /// The configuration with the surface nodes of side `s` at `positions[s]`;
    /// for a rigid side the reference positions, which are placed here.
    pub fn new(pair: &'a ContactPair, positions: [Vec<Vec3>; 2], placement: Placement) -> Self {
        let [a, mut b] = positions;
        if pair.is_rigid() {
            b.iter_mut().for_each(|x| *x = placement.point(x));
        }
        let snapshot = |side: Side, x: Vec<Vec3>| {
            pair.sides[side]
                .surface()
                .map(|surface| Snapshot::new(surface, x))
        };
        Self {
            pair,
            sides: [snapshot(Side::A, a), snapshot(Side::B, b)],
            placement,
            elapsed: f64::INFINITY,
            time: 0.0,
            worn: 0.0,
        }
    }

    /// Copy of the configuration with the skins that the sides are part of, by which
    /// [`crate::interference`] knows what is inside; `positions` are those of their nodes.
    pub fn enclosed(mut self, positions: impl Fn(Side, &Surface) -> Vec<Vec3>) -> Self {
        for side in Side::BOTH {
            let enclosure = self.pair.sides[side].enclosure.as_ref();
            if let (Some(snapshot), Some(enclosure)) = (&mut self.sides[side], enclosure) {
                let x = positions(side, &enclosure.surface);
                snapshot.enclosed = Some(Enclosed::new(enclosure, x));
            }
        }
        self
    }

    /// Depth behind a facet up to which the body there is its own: half its present thickness.
    ///
    /// A body that is pressed to half its height would otherwise touch itself through itself.
    pub(crate) fn depth(&self, side: Side, facet: FacetId) -> f64 {
        let Some(behind) = self.pair.sides[side].behind.get(facet.index()) else {
            return f64::INFINITY;
        };
        let thickness = match &behind.end {
            Some(end) => {
                let ends = end.nodes.iter().zip(end.weights);
                let x = &self.side(end.side).x;
                let end: Vec3 = ends.map(|(&node, weight)| x[node] * weight).sum();
                let own = self.side(side);
                let ring = distinct_corners(&own.surface.facets()[facet.index()]);
                let start = ring.iter().map(|&node| own.x[node]).sum::<Vec3>() / ring.len() as f64;
                (end - start).norm()
            }
            None => behind.thickness,
        };
        0.5 * thickness
    }

    /// Overlap up to which facets touch, and from which on they face each other through what is
    /// behind them, by their depths.
    ///
    /// Within one body layers are told apart by the thinner one. Outer faces of two bodies on top of
    /// each other overlap by all of both, those that touch by next to nothing: half of it divides
    /// them.
    pub(crate) fn deepest(&self, [own, other]: [f64; 2]) -> f64 {
        match self.pair.is_in_one_body() {
            true => own.min(other),
            false => own + other,
        }
    }

    /// Copy of the configuration, reached in the time `elapsed`.
    pub fn lasting(self, elapsed: f64) -> Self {
        Self { elapsed, ..self }
    }

    /// Copy of the configuration, at a time.
    pub fn at_time(self, time: f64) -> Self {
        Self { time, ..self }
    }

    /// Copy of the configuration, of sides that may overlap by `worn`.
    pub fn worn(self, worn: f64) -> Self {
        Self { worn, ..self }
    }

    /// The snapshot of a side that has facets.
    ///
    /// # Panics
    /// For a side without facets.
    pub fn side(&self, side: Side) -> &Snapshot<'a> {
        self.sides[side].as_ref().expect("the side has facets")
    }

    /// The snapshot of the surface that a side faces.
    ///
    /// # Panics
    /// For a rigid plane.
    pub fn facing(&self, side: Side) -> &Snapshot<'a> {
        self.side(self.pair.opposing(side))
    }

    /// Distance within which the node looks for the other side: half the local facet size
    /// or, where that is larger, the search distance of the pair, and what has worn off.
    pub fn reach(&self, side: Side, node: SurfaceNode) -> f64 {
        self.reach_of(self.side(side).sizes[node])
    }

    /// Returns whether the sides are so far apart that none of their facets face each other within
    /// their reach and a depth.
    pub fn is_apart(&self, depth: f64) -> bool {
        let sides = self.pair.deformable_sides().iter();
        let reaches = sides.map(|&side| self.reach_of(self.side(side).largest_size));
        let reach = reaches.fold(0.0, f64::max);
        let own = &self.side(Side::A).x;
        if let Some((point, normal)) = self.plane() {
            return own.iter().all(|x| (x - point).dot(&normal) > reach);
        }
        let [own, facing] =
            [own, &self.facing(Side::A).x].map(|x| Bounds::around(x.iter().copied()));
        let beyond = BEYOND * (own.high - own.low).norm();
        !own.inflated(reach + depth + beyond).meets(&facing)
    }

    fn reach_of(&self, size: f64) -> f64 {
        self.pair.search_distance.unwrap_or(0.0).max(0.5 * size) + self.worn
    }

    /// Local facet size at a node of a deformable side.
    pub fn size(&self, side: Side, node: SurfaceNode) -> f64 {
        self.side(side).sizes[node]
    }

    /// Point and unit normal of the plane that is side `b`, if it is one.
    pub fn plane(&self) -> Option<(Vec3, Vec3)> {
        match self.pair.sides[Side::B].geometry {
            Geometry::Plane { point, normal } => Some((
                self.placement.point(&point),
                self.placement.direction(&normal),
            )),
            Geometry::Deformable(_) | Geometry::Rigid(_) | Geometry::Itself => None,
        }
    }
}

impl<'a> Enclosed<'a> {
    fn new(enclosure: &'a Enclosure, x: Vec<Vec3>) -> Self {
        let surface = &enclosure.surface;
        Self {
            enclosure,
            sizes: local_sizes(surface, &x),
            tree: OnceLock::new(),
            x,
        }
    }

    /// Tree over the facets.
    pub fn tree(&self) -> &Tree {
        let surface = &self.enclosure.surface;
        self.tree.get_or_init(|| facet_tree(surface, &self.x))
    }
}

/// Tree over the facets of a surface.
fn facet_tree(surface: &Surface, x: &[Vec3]) -> Tree {
    let facets = surface.facets().iter();
    let boxes = facets.map(|facet| Bounds::around(distinct_corners(facet).iter().map(|&n| x[n])));
    Tree::new(boxes.collect())
}

impl<'a> Snapshot<'a> {
    fn new(surface: &'a Surface, x: Vec<Vec3>) -> Self {
        let sizes = local_sizes(surface, &x);
        Self {
            surface,
            normals: nodal_normals(surface, &x),
            largest_size: sizes.iter().copied().fold(0.0, f64::max),
            sizes,
            // Of most pairs in contact of everything the sides are far apart, and nothing is
            // searched for.
            tree: OnceLock::new(),
            edge_tree: OnceLock::new(),
            enclosed: None,
            x,
        }
    }

    /// Tree over the facets.
    pub fn tree(&self) -> &Tree {
        self.tree.get_or_init(|| facet_tree(self.surface, &self.x))
    }

    /// Tree over the boundary edges.
    pub fn edge_tree(&self) -> &Tree {
        self.edge_tree.get_or_init(|| {
            let edges = self.surface.boundary_edges().iter();
            let boxes = edges.map(|edge| Bounds::around(edge.nodes.map(|n| self.x[n])));
            Tree::new(boxes.collect())
        })
    }

    /// Surface-local corners of a facet.
    pub fn corners(&self, facet: FacetId) -> [SurfaceNode; 4] {
        self.surface.facets()[facet.index()]
    }

    /// Current positions of the corners of a facet.
    pub fn corner_positions(&self, facet: FacetId) -> [Vec3; 4] {
        self.corners(facet).map(|node| self.x[node])
    }

    /// Box around a facet.
    pub fn bounds(&self, facet: FacetId) -> Bounds {
        Bounds::around(self.corner_positions(facet))
    }

    /// Longest distance of a corner from the first one.
    pub fn facet_size(&self, facet: FacetId) -> f64 {
        let x = self.corner_positions(facet);
        (1..4)
            .map(|corner| (x[corner] - x[0]).norm())
            .fold(0.0, f64::max)
    }
}
