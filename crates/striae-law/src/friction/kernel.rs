//! The common form of every friction law at a contact point.
//!
//! ```text
//! -tau = L z + varpi eta ,   |z| <= varpi rho ,   slip du parallel to K z when |z| = varpi rho
//! ```
//!
//! `rho` is 1 but for tabulated friction, where it depends on the direction of `z` and
//! `L = K = I`, `eta = 0`. In the variable `z` all other laws are isotropic Coulomb friction,
//! so stick and slip are the two sides of one projection, `z = Proj(z + r K^-1 du)` onto the
//! disc of radius `varpi`, and of one towards the centre for a table. `L` and `K` act on
//! vectors of the common tangent plane; they are stored as regular 3x3 matrices, `eta` as a
//! tangent vector. `z`, `varpi` and `tau` are stresses, the rest has no unit.
//!
//! Source: closed form of the slip rule (36) of Jones & Papadopoulos (2006),
//! "Simulating anisotropic frictional response using smoothly interpolated
//! traction fields", Comput. Methods Appl. Mech. Engrg.

use nalgebra::{Matrix3, Vector3};
use num_dual::DualNum;

use super::tabulated::{Radial, Tabulated};

/// A friction law at a contact point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kernel<'a, D> {
    /// `L`.
    pub l: Matrix3<D>,
    /// `eta`, the offset of the slip surface over `varpi`.
    pub eta: Vector3<D>,
    /// `K`, from `z` to the direction of slip; identity for laws stated in the slip direction.
    pub k: Matrix3<D>,
    /// The inverse of `K`.
    pub k_inverse: Matrix3<D>,
    /// `rho`, where it is not 1.
    radial: Option<Radial<'a, D>>,
}

impl Tabulated {
    /// The law for the unit texture of the textured surface and the direction a
    /// quarter turn from it.
    pub fn kernel<D: DualNum<Primitive = f64> + Copy>(
        &self,
        axes: [Vector3<D>; 2],
    ) -> Kernel<'_, D> {
        Kernel::radial(Radial::new(self, axes))
    }
}

impl<'a, D: DualNum<Primitive = f64> + Copy> Kernel<'a, D> {
    /// Isotropic friction: `L = K = I`, `eta = 0`.
    pub fn identity() -> Self {
        Self::affine(Matrix3::identity(), Vector3::zeros())
    }

    /// `-tau = L z + varpi eta` with `K = I`: a law stated in the slip direction.
    pub fn affine(l: Matrix3<D>, eta: Vector3<D>) -> Self {
        Self {
            l,
            eta,
            k: Matrix3::identity(),
            k_inverse: Matrix3::identity(),
            radial: None,
        }
    }

    /// Copy of the law with slip along `K z`.
    pub fn with_slip_map(self, k: Matrix3<D>, k_inverse: Matrix3<D>) -> Self {
        Self {
            k,
            k_inverse,
            ..self
        }
    }

    /// Tabulated friction: `L = K = I`, `eta = 0`.
    pub(super) fn radial(radial: Radial<'a, D>) -> Self {
        Self {
            radial: Some(radial),
            ..Self::identity()
        }
    }

    /// Friction traction `tau` for the cap `varpi`.
    pub fn traction(&self, cap: D, z: &Vector3<D>) -> Vector3<D> {
        -(self.l * z + self.eta * cap)
    }

    /// `rho` in the direction of `z`: how far it reaches over `varpi`.
    pub fn reach(&self, z: &Vector3<D>) -> D {
        match &self.radial {
            None => D::one(),
            Some(radial) => radial.reach(z),
        }
    }
}
