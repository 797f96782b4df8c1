//! A facet against an unbounded rigid plane.
//!
//! The segment is the whole facet seen along the plane's normal. With `n = -N` constant
//!
//! ```text
//! D_cd = int N_c N_d J dxi deta,   J = n . (x_,xi x x_,eta)
//! dJ = (N_k,xi x_,eta x n + N_k,eta n x x_,xi) . dx_k
//! ```
//!
//! of degree three in each coordinate: two by two Gauss points are exact. On a triangle
//! `D_cd = A/12 (1 + delta_cd)`.

use nalgebra::Matrix3;
use striae_mesh::Vec3;
use striae_surface::{
    facet::{Shape, Weights},
    scalar::combination,
};

use super::{
    FACING, Facet, Segment, SegmentDerivatives, Slopes,
    facing::{Facing, Faded},
    normal::{facet_normal, facet_slopes},
    pair_index,
};
use crate::quadrature::GAUSS_2;

/// The segment of a facet and an unbounded rigid plane with the unit normal
/// `plane_normal`; only the block of the facet, the first side, is not zero.
///
/// `None` where they do not face each other or the facet has no area. `D` is a
/// polynomial of the corners, so a facet that folds over in projection is counted
/// with the sign of its parts; the total area is positive.
pub fn plane_segment(
    facet: &Facet,
    plane_normal: &Vec3,
    derivatives: impl Into<SegmentDerivatives>,
) -> Option<Segment> {
    let own_normal = facet_normal(facet)?;
    let facing = Facing::of(own_normal.dot(plane_normal), FACING)?;
    let normal = -plane_normal;
    let mut mass = [[0.0; 8]; 8];
    let mut slopes = match derivatives.into() {
        SegmentDerivatives::None => None,
        SegmentDerivatives::OfPressure | SegmentDerivatives::All => Some(Box::new(Slopes {
            normal: [Matrix3::zeros(); 8],
            mass: vec![[0.0; 24]; 36],
        })),
    };
    let mut area = 0.0;
    for (weights, share) in points(facet.shape) {
        let [by_xi, by_eta] =
            [&weights.d_xi, &weights.d_eta].map(|d| combination(d, &facet.corners));
        let jacobian = normal.dot(&by_xi.cross(&by_eta));
        area += share * jacobian;
        let [turned_xi, turned_eta] = [normal.cross(&by_xi), by_eta.cross(&normal)];
        for c in 0..4 {
            for d in c..4 {
                let product = share * weights.value[c] * weights.value[d];
                mass[c][d] += product * jacobian;
                let Some(slopes) = &mut slopes else { continue };
                let row = &mut slopes.mass[pair_index(c, d)];
                for k in 0..4 {
                    let by_x = turned_eta * weights.d_xi[k] + turned_xi * weights.d_eta[k];
                    (0..3).for_each(|axis| row[3 * k + axis] += product * by_x[axis]);
                }
            }
        }
    }
    for c in 0..4 {
        (0..c).for_each(|d| mass[c][d] = mass[d][c]);
    }
    if area <= 0.0 {
        return None;
    }
    let faded = match facing {
        Facing::Whole => None,
        Facing::Part(share, by_cosine) => {
            let normals = [(*plane_normal, facet_slopes(facet, &own_normal))];
            let integrals = (&mut area, &mut mass);
            let slopes = slopes.as_deref_mut();
            let faded = Faded::new((share, by_cosine), &normals, integrals, slopes);
            Some(Box::new(faded))
        }
    };
    Some(Segment {
        normal,
        area,
        topology: 0,
        mass,
        slopes,
        polygon: None,
        faded,
    })
}

/// Points and weights of a rule that is exact for `N_c N_d J`.
fn points(shape: Shape) -> Vec<(Weights<f64>, f64)> {
    match shape {
        Shape::Triangle => [[0.5, 0.0], [0.5, 0.5], [0.0, 0.5]]
            .map(|[xi, eta]| (shape.weights(xi, eta), 1.0 / 6.0))
            .to_vec(),
        Shape::Quadrilateral => {
            let at = |(xi, w): (f64, f64)| GAUSS_2.map(|(eta, v)| (shape.weights(xi, eta), w * v));
            GAUSS_2.into_iter().flat_map(at).collect()
        }
    }
}
