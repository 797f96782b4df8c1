//! Interference of the two sides of a pair, independent of what contact detected.
//!
//! Interference is found from two converged configurations on *all* facets, without a search
//! distance and without a contact formulation:
//!
//! - **inside**: a point of one side is behind the other one, by less than the body is
//!   thick there, see [`nearest`](Nearest) and [`Thickness`];
//! - **passed**: a point passes through a facet of the other side on its way, both moving along
//!   straight lines, and is behind it for some time. This also finds bodies that went through a
//!   thin one.
//!
//! Points are the nodes of the surfaces and the centres of their facets. Depths below a share of
//! the local facet size (or of 2.5 times the thickness, if that is smaller) are ignored, as
//! weighted contact lets nodes penetrate a little, and so are depths that were no smaller before.
//! Against a rigid plane the distance decides. Bodies whose swept boxes do not meet cost nothing,
//! others `O(n log n)`. Points of a rotating rigid body move along chords, so an increment should
//! rotate it by much less than half a turn.
//!
//! Longer than other files, as it holds the whole audit of where the points of a pair are.

mod crossing;
mod facing;
mod nearest;
mod overlap;
mod passage;
mod thickness;
mod triangle;

use rayon::prelude::*;
use striae_mesh::{FacetId, Vec3};
use striae_surface::{
    node::SurfaceNode,
    topology::{Surface, distinct_corners},
};

pub use crossing::{Crossing, MovingSkins};
pub use facing::{Facing, across, facing};
pub use nearest::{Nearest, Standing};
pub use overlap::{Overlap, PlacedSkins, Skins};
pub use thickness::{Fibre, Thickness, fibres, lengths};

use crate::{
    configuration::{Configuration, Enclosed, Snapshot},
    pair::Enclosure,
    segment::FACING,
    side::Side,
};
use nearest::Placed;
use passage::{Moving, Through};

/// Share of the local facet size that a point may be in by default.
pub const SHARE: f64 = 0.1;
/// Depth in which facets are paired over the deepest overlap of nodes: along the normal of two
/// facets overlaps are longer than the nearest distances that are measured.
pub const AHEAD: f64 = 1.25;

/// Facet size over thickness from which on a body is thin.
const THIN: f64 = 2.5;

/// A configuration and how thick the bodies are in it.
#[derive(Clone, Copy, Debug)]
pub struct Stage<'a> {
    /// Configuration of the sides.
    pub configuration: &'a Configuration<'a>,
    /// Thickness of the bodies behind them.
    pub thickness: &'a Thickness,
}

/// A point of one side that is where the other one is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interference {
    /// Side of the point.
    pub side: Side,
    /// The point.
    pub spot: Spot,
    /// Surface node that is the point, or the corner of its facet that is in deepest.
    pub node: SurfaceNode,
    /// Position of the point at the end.
    pub point: Vec3,
    /// Distance behind the other surface; the largest on its way for what passed, and
    /// the distance on the other side for what has gone through a body.
    pub depth: f64,
    /// Local facet size, by which depth is judged.
    pub size: f64,
    /// Body or surface that the point is in.
    pub place: Place,
    /// Kind of interference.
    pub kind: Kind,
}

impl Interference {
    /// Depth over the local facet size.
    pub fn share(&self) -> f64 {
        self.depth / self.size
    }
}

/// A point of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Spot {
    /// Surface node.
    Node(SurfaceNode),
    /// Centre of a facet.
    Centre(FacetId),
}

/// Part of the other side that a point is behind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A rigid plane.
    Plane,
    /// A facet.
    Facet(FacetId),
}

/// Kind of interference, by how the point got there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The point is inside.
    Inside,
    /// The point has passed through the surface and is not inside any more.
    Passed,
    /// The point has passed through the body and left it on the other side.
    Crossed,
}

/// Interference that is deeper than `share` of the facet size at the end and was less at
/// the start, side by side.
///
/// None within one body; see [`Skins`].
pub fn interferences(start: &Stage, end: &Stage, share: f64) -> Vec<Interference> {
    if end.configuration.pair.is_in_one_body() {
        return Vec::new();
    }
    if let Some(plane) = end.configuration.plane() {
        return behind_plane(start.configuration, end.configuration, plane, share);
    }
    let sides = Side::BOTH.map(|side| {
        let at = [start, end].map(|stage| stage.configuration.side(side));
        Moving::new(at, end.thickness.largest(side))
    });
    if !sides[0].may_meet(&sides[1]) {
        return Vec::new();
    }
    Side::BOTH
        .into_iter()
        .flat_map(|side| of_side(start, end, &sides, side, share))
        .collect()
}

/// All points of both sides that are inside the other one by more than `share` of the
/// facet size.
pub fn inside(stage: &Stage, share: f64) -> Vec<Interference> {
    inside_by(stage, share, judged_by)
}

/// All points of both sides that are inside the other one by more than `share` of the size of the
/// smaller facets there.
pub fn resolved_inside(stage: &Stage, share: f64) -> Vec<Interference> {
    inside_by(stage, share, resolved_by)
}

fn inside_by(
    stage: &Stage,
    share: f64,
    sized: impl Fn(&Stage, Side, Spot, FacetId) -> f64 + Sync,
) -> Vec<Interference> {
    let configuration = stage.configuration;
    if configuration.pair.is_in_one_body() {
        return Vec::new();
    }
    if let Some(plane) = configuration.plane() {
        let snapshot = configuration.side(Side::A);
        let spots = spots(snapshot.surface);
        let found = spots.into_iter().filter_map(|spot| {
            let depth = -height(snapshot, spot, &plane);
            let size = size(snapshot, spot);
            let found = || at_plane(snapshot, spot, depth, size);
            (depth > share * size).then(found)
        });
        return found.collect();
    }
    let within = |side: Side| {
        let spots = spots(configuration.side(side).surface);
        let found: Vec<_> = spots
            .into_par_iter()
            .with_min_len(16)
            .filter_map(|spot| {
                let found = depth_inside(stage, side, spot)?;
                let size = sized(stage, side, spot, found.facet);
                let point = position(configuration.side(side), spot);
                (found.distance > share * size)
                    .then(|| interference(stage, side, spot, (point, &found), size, Kind::Inside))
            })
            .collect();
        found
    };
    Side::BOTH.into_iter().flat_map(within).collect()
}

/// Position of a point relative to the facets of a side; `None` where another part of its skin is
/// nearer.
pub fn nearest_of(snapshot: &Snapshot, x: &Vec3) -> Option<Nearest> {
    let Some(enclosed) = &snapshot.enclosed else {
        return placed(snapshot).nearest(x);
    };
    of_side_itself(enclosed.enclosure, skin(enclosed).nearest(x)?)
}

/// Position relative to the facets of a side alone that are opposed to one of the directions
/// `normals`; `None` where another such part of its skin is nearer.
///
/// Behind is only what is inside the body, or by up to `round_off` outside.
pub(crate) fn nearest_facing(
    snapshot: &Snapshot,
    x: &Vec3,
    (normals, round_off): (&[Vec3], f64),
) -> Option<Nearest> {
    let nearest = placed(snapshot).nearest_facing(x, normals)?;
    let Some(enclosed) = &snapshot.enclosed else {
        return Some(nearest);
    };
    let skin = skin(enclosed);
    of_side_itself(enclosed.enclosure, skin.nearest_facing(x, normals)?)?;
    let is_inside = || {
        let of_all = skin.nearest(x);
        of_all.is_some_and(|of_all| {
            of_all.standing == Standing::Behind || of_all.distance <= round_off
        })
    };
    (nearest.standing != Standing::Behind || is_inside()).then_some(nearest)
}

/// The nearest point of a skin as one of the side; `None` if it belongs to another part.
fn of_side_itself(enclosure: &Enclosure, nearest: Nearest) -> Option<Nearest> {
    let facet = enclosure.facets[nearest.facet.index()]?;
    Some(Nearest { facet, ..nearest })
}

/// Nodes and facet centres of a surface.
pub(crate) fn spots(surface: &Surface) -> Vec<Spot> {
    let nodes = SurfaceNode::all(surface.nodes().len()).map(Spot::Node);
    let centres = (0..surface.facets().len()).map(|at| Spot::Centre(FacetId::new(at)));
    nodes.chain(centres).collect()
}

/// Position of a point of a surface.
pub fn position(snapshot: &Snapshot, spot: Spot) -> Vec3 {
    located(snapshot.surface, spot, |node| snapshot.x[node])
}

/// Unit normal at a point of a surface.
pub(crate) fn normal_at(snapshot: &Snapshot, spot: Spot) -> Vec3 {
    match spot {
        Spot::Node(node) => snapshot.normals[node],
        Spot::Centre(facet) => {
            let [a, b, c, d] = snapshot.corner_positions(facet);
            (c - a).cross(&(d - b)).normalize()
        }
    }
}

fn located(surface: &Surface, spot: Spot, x: impl Fn(SurfaceNode) -> Vec3) -> Vec3 {
    match spot {
        Spot::Node(node) => x(node),
        Spot::Centre(facet) => thickness::centre(&surface.facets()[facet.index()], x),
    }
}

fn skin<'a>(enclosed: &'a Enclosed) -> Placed<'a, impl Fn(SurfaceNode) -> Vec3 + 'a> {
    Placed {
        surface: &enclosed.enclosure.surface,
        tree: enclosed.tree(),
        x: |node| enclosed.x[node],
    }
}

/// Facets of a side alone, without the rest of its skin.
fn placed<'a>(snapshot: &'a Snapshot) -> Placed<'a, impl Fn(SurfaceNode) -> Vec3 + 'a> {
    Placed {
        surface: snapshot.surface,
        tree: snapshot.tree(),
        x: |node| snapshot.x[node],
    }
}

/// Local facet size at a point.
fn size(snapshot: &Snapshot, spot: Spot) -> f64 {
    match spot {
        Spot::Node(node) => snapshot.sizes[node],
        Spot::Centre(facet) => facet_size(snapshot, facet),
    }
}

fn facet_size(snapshot: &Snapshot, facet: FacetId) -> f64 {
    let corners = snapshot.corners(facet);
    let ring = distinct_corners(&corners);
    ring.iter().map(|&node| snapshot.sizes[node]).sum::<f64>() / ring.len() as f64
}

/// Size that depth behind a facet is judged by: that of the facets of the deformable
/// side, the larger of two; less where the body is thin, so that a point that has come
/// to its middle is inside.
fn judged_by(stage: &Stage, side: Side, spot: Spot, facet: FacetId) -> f64 {
    let [own, other] = sizes(stage, side, spot, facet);
    let size = match (stage.configuration.pair.is_rigid(), side) {
        (false, _) => own.max(other),
        (true, Side::A) => own,
        (true, _) => other,
    };
    size.min(thin(stage, side, facet))
}

/// Size that results are judged by: that of the smaller facets, beside which depth is seen in them;
/// less where the body is thin.
fn resolved_by(stage: &Stage, side: Side, spot: Spot, facet: FacetId) -> f64 {
    let [own, other] = sizes(stage, side, spot, facet);
    let size = match (stage.configuration.pair.is_rigid(), side) {
        (false, _) => own.min(other),
        (true, Side::A) => own,
        (true, _) => other,
    };
    size.min(thin(stage, side, facet))
}

/// Facet sizes at a point and behind it.
fn sizes(stage: &Stage, side: Side, spot: Spot, facet: FacetId) -> [f64; 2] {
    let configuration = stage.configuration;
    let own = size(configuration.side(side), spot);
    let other = facet_size(configuration.side(side.opposite()), facet);
    [own, other]
}

fn thin(stage: &Stage, side: Side, facet: FacetId) -> f64 {
    THIN * stage.thickness.0[side.opposite()][facet.index()]
}

/// Depth of a point inside the other side, with the nearest point.
fn depth_inside(stage: &Stage, side: Side, spot: Spot) -> Option<Nearest> {
    let x = position(stage.configuration.side(side), spot);
    let other = stage.configuration.side(side.opposite());
    let thickness = &stage.thickness.0[side.opposite()];
    let most = stage.thickness.largest(side.opposite());
    let near = other.tree().bounds()?.squared_distance(&x) <= most * most;
    let nearest = near.then(|| nearest_of(other, &x))??;
    // Behind a part of a skin is its own body; only what faces a facet has come through it.
    let faces = || {
        let cosine =
            normal_at(stage.configuration.side(side), spot).dot(&nearest.normal.normalize());
        !stage.configuration.pair.has_faces || cosine <= FACING
    };
    let inside = nearest.standing == Standing::Behind
        && nearest.distance < thickness[nearest.facet.index()]
        && faces();
    inside.then_some(nearest)
}

fn interference(
    stage: &Stage,
    side: Side,
    spot: Spot,
    (point, nearest): (Vec3, &Nearest),
    size: f64,
    kind: Kind,
) -> Interference {
    let snapshot = stage.configuration.side(side);
    Interference {
        side,
        spot,
        node: deepest_corner(snapshot, spot, &nearest.normal),
        point,
        depth: nearest.distance,
        size,
        place: Place::Facet(nearest.facet),
        kind,
    }
}

/// The node, or the corner of a facet that is farthest against `n`.
fn deepest_corner(snapshot: &Snapshot, spot: Spot, n: &Vec3) -> SurfaceNode {
    let facet = match spot {
        Spot::Node(node) => return node,
        Spot::Centre(facet) => facet,
    };
    let height = |node: &SurfaceNode| snapshot.x[*node].dot(n);
    let corners = snapshot.corners(facet).into_iter();
    let lowest = corners.min_by(|a, b| height(a).total_cmp(&height(b)));
    lowest.expect("a facet has corners")
}

fn height(snapshot: &Snapshot, spot: Spot, (point, normal): &(Vec3, Vec3)) -> f64 {
    (position(snapshot, spot) - point).dot(normal)
}

fn at_plane(snapshot: &Snapshot, spot: Spot, depth: f64, size: f64) -> Interference {
    Interference {
        side: Side::A,
        spot,
        node: match spot {
            Spot::Node(node) => node,
            Spot::Centre(facet) => snapshot.corners(facet)[0],
        },
        point: position(snapshot, spot),
        depth,
        size,
        place: Place::Plane,
        kind: Kind::Inside,
    }
}

/// Depth that is more than another one by more than round-off.
fn is_deeper(depth: f64, before: f64) -> bool {
    depth > before * (1.0 + 1e-9)
}

/// Points behind a plane. Its facets are flat enough for their nodes to say it all.
fn behind_plane(
    start: &Configuration,
    end: &Configuration,
    plane: (Vec3, Vec3),
    share: f64,
) -> Vec<Interference> {
    let before = start.plane().unwrap_or(plane);
    let [first, last] = [start, end].map(|configuration| configuration.side(Side::A));
    SurfaceNode::all(last.x.len())
        .map(Spot::Node)
        .filter_map(|spot| {
            let depth = -height(last, spot, &plane);
            let size = size(last, spot);
            let news = depth > share * size && is_deeper(depth, -height(first, spot, &before));
            news.then(|| at_plane(last, spot, depth, size))
        })
        .collect()
}

fn of_side(
    start: &Stage,
    end: &Stage,
    sides: &[Moving; 2],
    side: Side,
    share: f64,
) -> Vec<Interference> {
    let spots = spots(end.configuration.side(side).surface);
    spots
        .into_par_iter()
        .with_min_len(16)
        .filter_map(|spot| of_spot(start, end, sides, (side, spot), share))
        .collect()
}

fn of_spot(
    start: &Stage,
    end: &Stage,
    sides: &[Moving; 2],
    (side, spot): (Side, Spot),
    share: f64,
) -> Option<Interference> {
    let judged = |facet| judged_by(end, side, spot, facet);
    let before = || depth_inside(start, side, spot);
    let point = position(end.configuration.side(side), spot);
    if let Some(now) = depth_inside(end, side, spot)
        && now.distance > share * judged(now.facet)
    {
        let news = is_deeper(now.distance, before().map_or(0.0, |known| known.distance));
        let size = judged(now.facet);
        let found = || interference(end, side, spot, (point, &now), size, Kind::Inside);
        return news.then(found);
    }
    let (passed, size, kind) =
        match sides[side.opposite()].passed_by(&sides[side].path(spot), before)? {
            Through::Body(nearest) => (nearest, judged(nearest.facet), Kind::Crossed),
            Through::Surface(deepest) => {
                let size = judged(deepest.facet);
                (deepest.distance > share * size).then_some((deepest, size, Kind::Passed))?
            }
        };
    Some(interference(end, side, spot, (point, &passed), size, kind))
}
