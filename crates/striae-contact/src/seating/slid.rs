//! Faces that were seated and have slid along their curvature since.

use striae_mesh::Vec3;
use striae_surface::normal::nodal_normals;

use crate::{
    configuration::Configuration,
    pairing::{Scope, compliances, paired_facets},
    segment::SegmentDerivatives,
    side::Side,
};

/// Faces that have slid along their curvature since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slid {
    /// Mean of `t h/4`.
    pub error: f64,
    /// Mean of `t` (radians).
    pub turned: f64,
}

/// Errors of `g_0` where the faces of a pair are near each other in a configuration, by the places of
/// what faces each other now in that at the start; `None` if nothing is near, or against a plane.
pub fn slid(start: &Configuration, now: &Configuration) -> Option<Slid> {
    let surfaces = start.sides.each_ref().map(Option::as_ref);
    let [Some(a), Some(b)] = surfaces else {
        return None;
    };
    let normals = [a, b].map(|side| nodal_normals(side.surface, &side.x));
    let compliances = compliances(now);
    let scope = Scope {
        compliances: &compliances,
        depth: 0.0,
        start: None,
    };
    let none = |_: &[_]| SegmentDerivatives::None;
    let (mut area, mut turned, mut error) = (0.0, 0.0, 0.0);
    for paired in paired_facets(now, scope, &none, |_| true) {
        let normal = |side: Side| {
            let first = 4 * side.index();
            let at = |c: usize| {
                let n = normals[side][paired.corners[side][c].index()];
                n * paired.area_of(first + c)
            };
            (0..4).map(at).sum::<Vec3>().normalize()
        };
        let tilt = (normal(Side::A) + normal(Side::B)).norm();
        let of_segment = paired.segment.area;
        area += of_segment;
        turned += of_segment * tilt;
        error += of_segment * tilt * of_segment.sqrt() / 4.0;
    }
    (area > 0.0).then(|| Slid {
        error: error / area,
        turned: turned / area,
    })
}
