//! Heights of the corners of two facets, gaps of the surfaces between them, and their sizes.

use striae_mesh::Vec3;
use striae_surface::facet::Shape;

use crate::{
    pairing::{PairedFacets, SIGNS},
    segment::Facet,
};

/// Heights of the corners of two facets over a point along `n`, with the sign of their side in the
/// gap; a plane has none.
pub(super) fn heights(a: &Facet, b: Option<&Facet>, n: &Vec3, origin: &Vec3) -> [f64; 8] {
    std::array::from_fn(|d| match (b, d) {
        (_, 0..4) => SIGNS[d] * n.dot(&(a.corners[d] - origin)),
        (Some(b), _) => SIGNS[d] * n.dot(&(b.corners[d - 4] - origin)),
        (None, _) => 0.0,
    })
}

/// Gaps of curved surfaces in shares of the corners of two facets; `None` where a corner does not
/// face the other side.
pub(super) fn between(
    surfaces: &[Vec<Option<f64>>; 2],
    share: f64,
    paired: &PairedFacets,
) -> Option<[f64; 8]> {
    let mut gaps = [0.0; 8];
    for (c, gap) in gaps.iter_mut().enumerate() {
        let of_side = &surfaces[paired.sides[c / 4]];
        if !of_side.is_empty() {
            *gap = share * of_side[paired.corners[c / 4][c % 4].index()]?;
        }
    }
    Some(gaps)
}

pub(super) fn middle(facet: &Facet) -> Vec3 {
    let count = match facet.shape {
        Shape::Triangle => 3,
        Shape::Quadrilateral => 4,
    };
    facet.corners[..count].iter().sum::<Vec3>() / count as f64
}

/// Distance between the corners of a facet that are farthest apart, about.
pub(super) fn size(facet: &Facet) -> f64 {
    let middle = middle(facet);
    let distances = facet.corners.iter().map(|x| (x - middle).norm());
    2.0 * distances.fold(0.0, f64::max)
}
