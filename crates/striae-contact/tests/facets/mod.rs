//! Facets for the tests of segments.
#![allow(dead_code)]

use nalgebra::Rotation3;
use striae_contact::segment::Facet;
use striae_mesh::Vec3;
use striae_surface::facet::Shape;
use striae_verify::Random;

/// A quadrilateral at this height.
pub fn facet(corners: &[[f64; 2]; 4], height: f64) -> Facet {
    Facet {
        corners: corners.map(|[x, y]| Vec3::new(x, y, height)),
        shape: Shape::Quadrilateral,
    }
}

/// The triangle of three of the corners.
pub fn triangle(corners: &[Vec3; 4], [i, j, k]: [usize; 3]) -> Facet {
    Facet {
        corners: [corners[i], corners[j], corners[k], corners[k]],
        shape: Shape::Triangle,
    }
}

/// A parallelogram that looks up.
pub fn parallelogram() -> Facet {
    facet(&[[0.0, 0.0], [1.0, 0.2], [1.3, 1.1], [0.3, 0.9]], 0.0)
}

/// A facet that looks up about the unit square: corners off by up to `offset` in the
/// plane of a parallelogram, by `warp` across.
pub fn random_quad(random: &mut Random, offset: f64, warp: f64) -> Facet {
    let skew = random.vector3() * 0.2;
    let base = [
        [0.0, 0.0],
        [1.0, skew.x],
        [1.0 + skew.y, 1.0 + skew.x],
        [skew.y, 1.0],
    ];
    Facet {
        corners: base.map(|[x, y]| {
            let r = random.vector3();
            Vec3::new(x + offset * r.x, y + offset * r.y, warp * r.z)
        }),
        shape: Shape::Quadrilateral,
    }
}

/// The facet turned to look down, moved aside and tilted by about `shift`.
pub fn mirrored(facet: &Facet, shift: f64) -> Facet {
    let [p, q, r, s] = facet.corners;
    let tilt = Rotation3::from_euler_angles(0.3 * shift, -0.2 * shift, 0.7 * shift);
    Facet {
        corners: [p, s, r, q].map(|x| tilt * x + Vec3::new(shift, 0.6 * shift, 0.02)),
        shape: facet.shape,
    }
}

/// A pair in planes across the third axis.
pub fn flat_pair(random: &mut Random) -> (Facet, Facet) {
    let a = random_quad(random, 0.2, 0.0);
    let [p, q, r, s] = random_quad(random, 0.2, 0.0).corners;
    let turn = Rotation3::from_axis_angle(&Vec3::z_axis(), random.uniform(-0.5, 0.5));
    let shift = Vec3::new(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), 0.0);
    let b = Facet {
        corners: [p, s, r, q].map(|x| turn * x + shift),
        shape: Shape::Quadrilateral,
    };
    (a, b)
}

/// The facet moved as a rigid body.
pub fn moved(facet: &Facet, rotation: &Rotation3<f64>, shift: &Vec3) -> Facet {
    Facet {
        corners: facet.corners.map(|x| rotation * x + shift),
        shape: facet.shape,
    }
}

/// The facet in other units.
pub fn scaled(facet: &Facet, scale: f64) -> Facet {
    Facet {
        corners: facet.corners.map(|x| x * scale),
        shape: facet.shape,
    }
}
