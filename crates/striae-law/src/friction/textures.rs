//! Textures at a contact point, as a law sees them.

use nalgebra::Vector3;
use num_dual::DualNum;

/// Textures of the two surfaces at a contact point, as unit tangent vectors
/// `a = n x s`, seen from the surface that carries the point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Textures<D> {
    /// `a_a`: of the surface that carries the point; `None` where it has no texture.
    pub own: Option<Vector3<D>>,
    /// `a_b' = -a_b`: of the other surface, for the normal of this one.
    pub opposite: Option<Vector3<D>>,
}

impl<D> Textures<D> {
    /// Neither surface has a texture.
    pub fn none() -> Self {
        Self {
            own: None,
            opposite: None,
        }
    }
}

impl<D: DualNum<Primitive = f64> + Copy> Textures<D> {
    /// The texture of the only textured surface.
    pub fn only(&self) -> Option<Vector3<D>> {
        self.own.xor(self.opposite)
    }

    /// The texture of the only textured surface, and the direction a quarter turn from
    /// it, counter-clockwise as seen from outside that surface; both as seen from the
    /// surface that carries the point, whose unit normal is `n`.
    pub fn only_axes(&self, n: &Vector3<D>) -> Option<[Vector3<D>; 2]> {
        match (self.own, self.opposite) {
            (Some(a), None) => Some([a, n.cross(&a)]),
            (None, Some(a)) => Some([a, a.cross(n)]),
            _ => None,
        }
    }

    /// The textures of both surfaces.
    pub fn both(&self) -> Option<(Vector3<D>, Vector3<D>)> {
        self.own.zip(self.opposite)
    }
}
