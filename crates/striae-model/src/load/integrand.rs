//! The load at a point of a face, over any scalar.

use crate::model::LoadKind;
use nalgebra::Vector3;
use num_dual::DualNum;
use striae_mesh::Vec3;

/// Local coordinates of the corners of a face.
const CORNERS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

/// Tangents `[g_1, g_2]` of a face at a point.
pub(super) type Tangents<D> = [Vector3<D>; 2];

/// Force per current area of a load of these values at the local coordinates `(xi, eta)` of a
/// face with reference corners `X` and current corners `x`.
///
/// Not finite where the face has no current normal, and for a follower
/// traction where it is turned by 180 degrees.
pub fn traction<D: DualNum<Primitive = f64> + Copy>(
    kind: &LoadKind<D>,
    reference: &[Vec3; 4],
    current: &[Vector3<D>; 4],
    xi: D,
    eta: D,
) -> Vector3<D> {
    let slopes = shape_slopes(xi, eta);
    let current = tangents(current, &slopes);
    let reference = tangents(&reference.map(lift), &slopes);
    parametric_traction(kind, &reference, &current) / norm(&current[0].cross(&current[1]))
}

/// Force per `dxi deta` on a face with the given tangents.
pub(super) fn parametric_traction<D: DualNum<Primitive = f64> + Copy>(
    kind: &LoadKind<D>,
    reference: &Tangents<D>,
    current: &Tangents<D>,
) -> Vector3<D> {
    let reference_normal = reference[0].cross(&reference[1]);
    let normal = current[0].cross(&current[1]);
    match *kind {
        LoadKind::DeadTraction(traction) => traction * norm(&reference_normal),
        LoadKind::FollowerTraction(traction) => {
            let area = norm(&normal);
            let from = reference_normal / norm(&reference_normal);
            rotated(traction, &from, &(normal / area)) * area
        }
        LoadKind::Pressure(pressure) => normal * -pressure,
    }
}

/// Shape functions of the face.
pub(super) fn shape(xi: f64, eta: f64) -> [f64; 4] {
    CORNERS.map(|[x, y]| 0.25 * (1.0 + x * xi) * (1.0 + y * eta))
}

/// Derivatives of the shape functions by `xi` and `eta`.
pub(super) fn shape_slopes<D: DualNum<Primitive = f64> + Copy>(xi: D, eta: D) -> [[D; 2]; 4] {
    CORNERS.map(|[x, y]| [(eta * y + 1.0) * (0.25 * x), (xi * x + 1.0) * (0.25 * y)])
}

/// Tangents of the face with the given corners.
pub(super) fn tangents<D: DualNum<Primitive = f64> + Copy>(
    corners: &[Vector3<D>; 4],
    slopes: &[[D; 2]; 4],
) -> Tangents<D> {
    [0, 1].map(|direction| {
        (0..4).fold(lift(Vec3::zeros()), |sum, a| {
            sum + corners[a] * slopes[a][direction]
        })
    })
}

/// A constant vector.
pub(super) fn lift<D: DualNum<Primitive = f64> + Copy>(vector: Vec3) -> Vector3<D> {
    vector.map(D::from)
}

fn norm<D: DualNum<Primitive = f64> + Copy>(vector: &Vector3<D>) -> D {
    vector.dot(vector).sqrt()
}

/// `R(from, to) vector` for unit vectors `from` and `to`.
fn rotated<D: DualNum<Primitive = f64> + Copy>(
    vector: Vector3<D>,
    from: &Vector3<D>,
    to: &Vector3<D>,
) -> Vector3<D> {
    let axis = from.cross(to);
    let cosine = from.dot(to);
    vector * cosine + axis.cross(&vector) + axis * (axis.dot(&vector) / (cosine + 1.0))
}
