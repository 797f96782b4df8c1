//! Friction laws from outside the crate.

use serde::{Serialize, Serializer};
use std::fmt;
use std::sync::Arc;

use nalgebra::{Matrix2, Matrix3, Rotation3, Vector2, Vector3};
use num_dual::{DualNum, DualSVec64};

use super::oblique::Oblique;
use super::{FrictionError, Kernel, RequiredTextures, Textures};

/// First-order dual numbers over the normal and the textures of the two surfaces.
pub type Lane = DualSVec64<9>;

/// A user-defined friction law, for [`Friction::own`](super::Friction::own).
///
/// A law states its [`Kernel`], `-tau = L z + varpi eta` with `|z| <= varpi` and slip along
/// `K z`, at a point with a unit normal and unit textures. It is asked with dual numbers,
/// so the derivatives by normal and textures are those of its own formulas.
///
/// The law must be the same seen from both surfaces (normal and textures change their signs
/// and the textures their places), turn with its arguments, and keep tangent vectors
/// tangent. [`battery`](super::battery) finds out.
///
/// ```
/// use striae_law::friction::{Friction, FrictionLaw, Kernel, Lane, RequiredTextures, Textures};
/// use nalgebra::{Matrix3, Vector3};
///
/// /// Friction that grows with the angle between slip and the texture `a` of one surface.
/// #[derive(Debug)]
/// struct Ribbed {
///     excess: f64,
/// }
///
/// impl FrictionLaw for Ribbed {
///     fn name(&self) -> &str {
///         "ribbed"
///     }
///
///     fn required_textures(&self) -> RequiredTextures {
///         RequiredTextures::One
///     }
///
///     fn kernel(&self, _: &Vector3<Lane>, textures: &Textures<Lane>) -> Kernel<'static, Lane> {
///         let a = textures.only().expect("one surface has a texture");
///         let l = Matrix3::identity() + a * a.transpose() * Lane::from(self.excess);
///         Kernel::affine(l, Vector3::zeros())
///     }
/// }
///
/// let friction = Friction::own(Ribbed { excess: 0.5 }, 0.3)?;
/// assert_eq!(striae_law::friction::battery(&friction), []);
/// # Ok::<(), striae_law::friction::FrictionError>(())
/// ```
pub trait FrictionLaw: fmt::Debug + Send + Sync {
    /// The name of the law in messages and figures.
    fn name(&self) -> &str;

    /// Surfaces that must carry a texture.
    fn required_textures(&self) -> RequiredTextures;

    /// The law at a point with the unit normal of the surface that carries it.
    fn kernel(&self, normal: &Vector3<Lane>, textures: &Textures<Lane>) -> Kernel<'static, Lane>;
}

/// A shared user-defined law; equal to itself only.
#[derive(Clone, Debug)]
pub struct Own(Arc<dyn FrictionLaw>);

/// Written as its own description.
impl Serialize for Own {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&format_args!("{:?}", self.0))
    }
}

impl PartialEq for Own {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// Number of angles between the textures at which a law is checked when it is made.
const TEXTURE_ANGLES: u32 = 72;

impl Own {
    /// Shares a law, if friction dissipates in all slip directions and at all angles
    /// between the textures (in steps of five and of half a degree).
    pub(super) fn new(law: impl FrictionLaw + 'static) -> Result<Self, FrictionError> {
        let own = Self(Arc::new(law));
        let angles = match own.law().required_textures() {
            RequiredTextures::Both => TEXTURE_ANGLES,
            _ => 1,
        };
        for step in 0..angles {
            let theta = f64::from(step) * std::f64::consts::TAU / f64::from(angles);
            let least = own.slip_surface(theta)?.least_dissipation();
            let dissipates = least.dissipation() > 0.0;
            if !dissipates {
                return Err(FrictionError::CreatesEnergyAt {
                    theta: theta.to_degrees(),
                    degrees: least.slip.y.atan2(least.slip.x).to_degrees(),
                    dissipation: least.dissipation(),
                });
            }
        }
        Ok(own)
    }

    /// The law.
    pub fn law(&self) -> &dyn FrictionLaw {
        &*self.0
    }

    pub(super) fn kernel<D: DualNum<Primitive = f64> + Copy>(
        &self,
        normal: &Vector3<D>,
        textures: &Textures<D>,
    ) -> Kernel<'static, D> {
        debug_assert!(D::NDERIV <= 1, "user-defined laws have first derivatives");
        let none = Vector3::zeros();
        let (own, opposite) = (textures.own, textures.opposite);
        let given = [*normal, own.unwrap_or(none), opposite.unwrap_or(none)];
        let lanes = [0, 1, 2].map(|at| seeded(&given[at].map(|x| x.re()), 3 * at));
        let textures = Textures {
            own: own.map(|_| lanes[1]),
            opposite: opposite.map(|_| lanes[2]),
        };
        let kernel = self.0.kernel(&lanes[0], &textures);
        let changes = change(&given);
        let lift = |x: Lane| lifted(&x, &changes);
        Kernel::affine(kernel.l.map(lift), kernel.eta.map(lift))
            .with_slip_map(kernel.k.map(lift), kernel.k_inverse.map(lift))
    }

    /// The slip surface, in the frame of the only texture or of the bisector of the two,
    /// from which that of the carrying surface is at `-theta/2`.
    pub(super) fn slip_surface(&self, theta: f64) -> Result<Oblique, FrictionError> {
        let at = |angle: f64| Rotation3::from_axis_angle(&Vector3::z_axis(), angle) * Vector3::x();
        let (own, opposite) = match self.0.required_textures() {
            RequiredTextures::Any => (None, None),
            RequiredTextures::One => (Some(at(0.0)), None),
            RequiredTextures::Both => (Some(at(-0.5 * theta)), Some(at(0.5 * theta))),
        };
        let kernel = self.kernel(&Vector3::z(), &Textures { own, opposite });
        let eta = Vector2::new(kernel.eta.x, kernel.eta.y);
        let surface = Oblique::new(plane(&kernel.l), eta, plane(&kernel.k));
        surface.ok_or_else(|| FrictionError::NoSlipSurface {
            law: self.0.name().to_owned(),
            theta: theta.to_degrees(),
        })
    }
}

fn plane(matrix: &Matrix3<f64>) -> Matrix2<f64> {
    matrix.fixed_view::<2, 2>(0, 0).into_owned()
}

/// Dual numbers of three coordinates, the derivatives by which start at `first`.
fn seeded(x: &Vector3<f64>, first: usize) -> Vector3<Lane> {
    Vector3::from_fn(|i, _| Lane::from_re(x[i]).derivative(first + i))
}

/// Derivative parts of the arguments: each argument minus its value.
fn change<D: DualNum<Primitive = f64> + Copy>(given: &[Vector3<D>; 3]) -> [D; 9] {
    std::array::from_fn(|at| {
        let x = given[at / 3][at % 3];
        x - x.re()
    })
}

/// `f + df/dx (x - re x)`: the same number over the variables of the arguments.
fn lifted<D: DualNum<Primitive = f64> + Copy>(f: &Lane, changes: &[D; 9]) -> D {
    let slopes = f
        .eps
        .unwrap_generic(nalgebra::Const::<9>, nalgebra::Const::<1>);
    changes
        .iter()
        .zip(slopes.iter())
        .fold(D::from(f.re), |sum, (change, slope)| sum + *change * *slope)
}
