//! Friction laws that functions of Python state.
//!
//! In the frame of the texture `a` of the surface that carries the point and of `t = n x a` a
//! kernel depends on nothing but the angle `theta` to the texture of the other surface, so it
//! is a Fourier series,
//!
//! ```text
//! (L, eta, K) = sum_k C_k cos(k theta) + S_k sin(k theta) ,
//! cos(theta) = a . b ,   sin(theta) = (a x b) . n
//! ```
//!
//! whose terms the Python part takes from samples of the function, once, when the law is made.
//! A run does not call the function. Of one textured surface there is the constant term only,
//! in the frame of that surface.

use nalgebra::{Matrix2, Matrix3, Vector3};
use striae::law::friction::{FrictionLaw, Kernel, Lane, RequiredTextures, Textures};

/// Components of `L` by rows, `eta` and `K` by rows.
const COMPONENTS: usize = 10;

/// Factors of the cosine and of the sine.
pub type Harmonic = [[f64; COMPONENTS]; 2];

/// A kernel as a Fourier series.
#[derive(Debug)]
pub struct Periodic {
    name: String,
    textures: RequiredTextures,
    harmonics: Vec<Harmonic>,
}

impl Periodic {
    /// A law of one or of two textured surfaces.
    pub fn new(name: String, two: bool, harmonics: Vec<Harmonic>) -> Self {
        let textures = if two {
            RequiredTextures::Both
        } else {
            RequiredTextures::One
        };
        Self {
            name,
            textures,
            harmonics,
        }
    }

    /// The sum of the series.
    fn at(&self, cosine: Lane, sine: Lane) -> [Lane; COMPONENTS] {
        let mut sum = [Lane::from(0.0); COMPONENTS];
        let (mut c, mut s) = (Lane::from(1.0), Lane::from(0.0));
        for [even, odd] in &self.harmonics {
            for (at, sum) in sum.iter_mut().enumerate() {
                *sum += c * even[at] + s * odd[at];
            }
            (c, s) = (cosine * c - sine * s, sine * c + cosine * s);
        }
        sum
    }
}

impl FrictionLaw for Periodic {
    fn name(&self) -> &str {
        &self.name
    }

    fn required_textures(&self) -> RequiredTextures {
        self.textures
    }

    fn kernel(&self, n: &Vector3<Lane>, textures: &Textures<Lane>) -> Kernel<'static, Lane> {
        let (frame, [cosine, sine]) = match textures.both() {
            Some((a, b)) => ([a, n.cross(&a)], [a.dot(&b), a.cross(&b).dot(n)]),
            None => {
                let frame = textures.only_axes(n);
                let frame = frame.expect("one surface has a texture");
                (frame, [Lane::from(1.0), Lane::from(0.0)])
            }
        };
        let [l0, l1, l2, l3, eta0, eta1, k0, k1, k2, k3] = self.at(cosine, sine);
        let matrix = |m: Matrix2<Lane>| in_space(&m, &frame, n);
        let k = Matrix2::new(k0, k1, k2, k3);
        let scale = Lane::from(1.0) / (k0 * k3 - k1 * k2);
        let inverse = Matrix2::new(k3, -k1, -k2, k0) * scale;
        let eta = frame[0] * eta0 + frame[1] * eta1;
        Kernel::affine(matrix(Matrix2::new(l0, l1, l2, l3)), eta)
            .with_slip_map(matrix(k), matrix(inverse))
    }
}

/// The matrix of the tangent plane, and one along the normal.
fn in_space(m: &Matrix2<Lane>, frame: &[Vector3<Lane>; 2], n: &Vector3<Lane>) -> Matrix3<Lane> {
    let mut sum = n * n.transpose();
    for (i, left) in frame.iter().enumerate() {
        for (j, right) in frame.iter().enumerate() {
            sum += left * right.transpose() * m[(i, j)];
        }
    }
    sum
}
