//! Pairs of facets of one surface that are contact of the body with itself.
//!
//! Two facets of a body may face each other because the body lies between them, or another layer
//! of it does. With `t` the present thickness of the body behind a facet, `g` the mean gap of a segment
//! and `i`, `j`, `k` facets, a pair is left out
//!
//! ```text
//! back to back   -g_ij > min(t_i, t_j)/2; between two bodies -g_ij > (t_i + t_j)/2
//! hidden         {i, k} or {j, k} covers the middle of {i, j}, and is nearer by more than t_k/2
//! around a node  i and j share one, and n_i . n_j > -.71 or it is an edge of the body
//! ```
//!
//! Facets that share a node are folded onto each other once they stand at more than 135 degrees;
//! leaving all of them out would leave the root of a slit without pressure. At an edge of the body
//! the body itself lies between them, and is as thin there as they are apart, not as thick as
//! behind their middles. Which nodes are on edges is known from the reference configuration: a
//! body may fold along a surface or a notch of it, but not along an edge, whose elements would
//! have to be turned inside out.

use std::collections::BTreeMap;

use striae_mesh::{FacetId, Vec3};
use striae_surface::node::SurfaceNode;

use super::PairedFacets;
use crate::{
    configuration::{Configuration, Snapshot},
    segment::FACING,
    side::Side,
};

/// Cosine between the normals of facets that share a node from which on they are folded.
const FOLDED: f64 = -0.71;
/// Position of two facets of a body to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Neighbourhood {
    /// With a common node of the mesh.
    Around,
    /// Without one.
    Apart,
}

/// Returns whether two facets share a node of the mesh.
pub(super) fn neighbourhood(
    snapshots: [&Snapshot; 2],
    corners: [&[SurfaceNode; 4]; 2],
) -> Neighbourhood {
    let mesh = |at: usize, node: &SurfaceNode| snapshots[at].surface.nodes()[node.index()];
    let shares = |node: &SurfaceNode| {
        let mut others = corners[1].iter();
        others.any(|other| mesh(1, other) == mesh(0, node))
    };
    match corners[0].iter().any(shares) {
        true => Neighbourhood::Around,
        false => Neighbourhood::Apart,
    }
}

impl Neighbourhood {
    /// Returns the cosine between the normals of two facets up to which they touch: those that
    /// share a node have to be folded there.
    pub(super) fn facing_limit(self) -> f64 {
        match self {
            Self::Around => FOLDED,
            Self::Apart => FACING,
        }
    }
}

/// Returns whether no body lies between two facets.
pub(super) fn is_outside(configuration: &Configuration, paired: &PairedFacets) -> bool {
    let [Some(facet), Some(other)] = paired.facets else {
        return true;
    };
    let sides = paired.sides;
    let behind = configuration.pair.sides[sides[0]].behind.get(facet.index());
    let is_beyond_edge =
        behind.is_some_and(|behind| behind.beyond_edges.contains(&(sides[1], other)));
    let depths = [(sides[0], facet), (sides[1], other)];
    let depths = depths.map(|(side, facet)| configuration.depth(side, facet));
    !is_beyond_edge && -paired.mean_gap(configuration) <= configuration.deepest(depths)
}

/// Leaves out facets that face each other through another layer.
pub(super) fn drop_hidden(configuration: &Configuration, all: &mut Vec<PairedFacets>) {
    let mut of_facet: BTreeMap<(Side, FacetId), Vec<usize>> = BTreeMap::new();
    for (at, paired) in all.iter().enumerate() {
        for facet in places_of(paired) {
            of_facet.entry(facet).or_default().push(at);
        }
    }
    let gaps: Vec<f64> = all
        .iter()
        .map(|paired| paired.mean_gap(configuration))
        .collect();
    let depth = |(side, facet): (Side, FacetId)| configuration.depth(side, facet);
    let hides = |at: usize, facet: (Side, FacetId), by: usize| {
        let between = places_of(&all[by]).find(|other| *other != facet);
        by != at
            && between.is_some_and(|k| gaps[at] - gaps[by] > depth(k))
            && covers(&all[by], &all[at])
    };
    let is_hidden = |at: usize| {
        places_of(&all[at]).any(|facet| of_facet[&facet].iter().any(|&by| hides(at, facet, by)))
    };
    let hidden: Vec<bool> = (0..all.len()).map(is_hidden).collect();
    let mut hidden = hidden.into_iter();
    all.retain(|_| !hidden.next().unwrap_or(false));
}

/// Sides and facets of a pair.
fn places_of(paired: &PairedFacets) -> impl Iterator<Item = (Side, FacetId)> + use<> {
    let facets = paired.sides.into_iter().zip(paired.facets);
    facets.filter_map(|(side, facet)| Some((side, facet?)))
}

/// Returns whether a segment covers the middle of another one, seen along its own normal.
fn covers(segment: &PairedFacets, other: &PairedFacets) -> bool {
    let (Some(outline), Some(others)) = (places(segment), places(other)) else {
        return false;
    };
    let middle = others.iter().sum::<Vec3>() / others.len() as f64;
    let n = segment.segment.normal;
    let sides = (0..outline.len()).map(|at| {
        let (from, to) = (outline[at], outline[(at + 1) % outline.len()]);
        (to - from).cross(&(middle - from)).dot(&n)
    });
    let [low, high] = sides.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], side| {
        [low.min(side), high.max(side)]
    });
    low >= 0.0 || high <= 0.0
}

/// Places of the vertices of a segment on its first facet.
fn places(paired: &PairedFacets) -> Option<Vec<Vec3>> {
    let vertices = paired.segment.at_vertices()?;
    let place = |n: &[f64; 8]| (0..4).map(|c| paired.x[c] * n[c]).sum();
    Some(vertices.iter().map(place).collect())
}

#[cfg(test)]
mod tests {
    use striae_mesh::NodeId;
    use striae_surface::topology::Surface;

    use super::*;
    use crate::{
        body_edge::beyond_edges,
        pair::{Behind, ContactPair, Geometry, PairedSurface},
        pairing::{Corners, Scope, compliances, paired_facets, tests::pair_of},
        placement::Placement,
        segment::SegmentDerivatives,
    };

    /// Upper and lower faces of sheets on top of each other.
    fn sheets(count: usize, thickness: f64, gap: f64) -> (Vec<[NodeId; 4]>, Vec<Vec3>) {
        const CELLS: usize = 4;
        let (mut facets, mut x) = (Vec::new(), Vec::new());
        for sheet in 0..count {
            let z = (thickness + gap) * sheet as f64;
            // Unlike meshes of the two faces, so that no facets match.
            for (height, shift, up) in [(z, 0.0, false), (z + thickness, 0.07, true)] {
                let first = x.len();
                let node = |i: usize, j: usize| NodeId::new(first + i + (CELLS + 1) * j);
                for j in 0..=CELLS {
                    for i in 0..=CELLS {
                        let at = [i, j].map(|k| 0.2 * k as f64 + shift);
                        x.push(Vec3::new(at[0], at[1], height));
                    }
                }
                for j in 0..CELLS {
                    for i in 0..CELLS {
                        let ring = [
                            node(i, j),
                            node(i + 1, j),
                            node(i + 1, j + 1),
                            node(i, j + 1),
                        ];
                        let [a, b, c, d] = ring;
                        facets.push(if up { [a, b, c, d] } else { [a, d, c, b] });
                    }
                }
            }
        }
        (facets, x)
    }

    fn gaps(count: usize, thickness: f64, gap: f64, known: bool) -> Vec<f64> {
        let (facets, x) = sheets(count, thickness, gap);
        let of_facets = match known {
            true => vec![thickness; facets.len()],
            false => Vec::new(),
        };
        found(&facets, x, of_facets)
    }

    /// Mean gaps of the pairs of a surface with these thicknesses behind its facets.
    fn found(facets: &[[NodeId; 4]], x: Vec<Vec3>, of_facets: Vec<f64>) -> Vec<f64> {
        let surface = Surface::new(facets);
        let [beyond_edges, _] = beyond_edges([Some(&surface), None], |node| x[node.index()]);
        let side = |geometry: Geometry, thickness: Vec<f64>| PairedSurface {
            geometry,
            stiffness: 1.0,
            texture: None,
            behind: thickness
                .into_iter()
                .zip(&beyond_edges)
                .map(|(thickness, beyond_edges)| Behind {
                    thickness,
                    end: None,
                    beyond_edges: beyond_edges.clone(),
                })
                .collect(),
            enclosure: None,
        };
        let sides = [
            side(Geometry::Deformable(surface), of_facets),
            side(Geometry::Itself, Vec::new()),
        ];
        let pair = ContactPair {
            has_faces: true,
            ..pair_of(sides, Some(0.2))
        };
        let at = Configuration::new(&pair, [x, Vec::new()], Placement::at_rest());
        let compliances = compliances(&at);
        let scope = Scope {
            compliances: &compliances,
            depth: 0.0,
            start: None,
        };
        let none = |_: &[Corners]| SegmentDerivatives::None;
        let paired = paired_facets(&at, scope, &none, |_| true);
        paired.iter().map(|paired| paired.mean_gap(&at)).collect()
    }

    #[test]
    fn a_sheet_has_no_contact_through_itself_or_others() {
        let (thickness, gap) = (0.06, 0.02);
        for count in [1, 2, 3, 4] {
            let found = gaps(count, thickness, gap, true);
            assert!(
                found.iter().all(|found| (found - gap).abs() < 1e-12),
                "{found:?}"
            );
            assert!(found.len() >= 16 * (count - 1), "{count}: {}", found.len());
            let all = gaps(count, thickness, gap, false);
            assert!(all.len() > found.len(), "{count}: {}", all.len());
        }
    }

    /// Two squares with a common edge, at 20 degrees: outer sides of an edge of the body, or inner
    /// sides of a fold.
    #[test]
    fn the_sides_of_a_sharp_edge_do_not_touch_through_the_body() {
        let (sine, cosine) = 20f64.to_radians().sin_cos();
        let at = |x: f64, z: f64| [0.0, 0.5].map(|y| Vec3::new(x, y, z));
        let x = [at(0.0, 0.0), at(0.5, 0.0), at(0.5 * cosine, 0.5 * sine)].concat();
        let node = NodeId::new;
        let lower = [node(0), node(1), node(3), node(2)];
        let upper = [node(0), node(4), node(5), node(1)];
        let turned = |[a, b, c, d]: [NodeId; 4]| [a, d, c, b];
        let thick = vec![1.0; 2];
        let edge = found(&[lower, upper], x.clone(), thick.clone());
        assert!(edge.is_empty(), "{edge:?}");
        let fold = found(&[turned(lower), turned(upper)], x, thick);
        assert!(fold.len() == 1 && fold[0] > 0.0, "{fold:?}");
    }
}
