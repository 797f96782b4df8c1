//! What every friction law must do, in one call.

use nalgebra::{DMatrix, DVector, SVector, Vector2, Vector3};
use num_dual::{DualNum, jacobian};
use striae_verify::{Random, assert_derivative};

use super::slipping;
use crate::friction::{Friction, RequiredTextures, Textures};

/// Runs the battery on a law that is not frictionless.
pub(super) fn check(friction: &Friction) {
    let mut random = Random::new(7);
    for _ in 0..50 {
        for place in Place::of(friction, &mut random) {
            keeps_inside_the_slip_surface(friction, &place, &mut random);
            dissipates(friction, &place, &mut random);
            meets_the_closed_form(friction, &place, &mut random);
            is_equivariant_under_rotation(friction, &place, &mut random);
            gives_opposite_forces_to_the_two_sides(friction, &place, &mut random);
            inverts_the_slip_map(friction, &place);
        }
    }
    for place in Place::of(friction, &mut random) {
        has_exact_derivatives(friction, &place, &mut random);
    }
}

/// A contact point: normal and textures.
struct Place {
    normal: Vector3<f64>,
    textures: Textures<f64>,
}

impl Place {
    /// A random place for each way the textures can be distributed.
    fn of(friction: &Friction, random: &mut Random) -> Vec<Self> {
        let normal = random.unit3();
        let own = Some(unit_tangent(&normal, random));
        let opposite = Some(unit_tangent(&normal, random));
        let layouts = match friction.required_textures() {
            RequiredTextures::Any => vec![(None, None), (own, None), (own, opposite)],
            RequiredTextures::One => vec![(own, None), (None, opposite)],
            RequiredTextures::Both => vec![(own, opposite)],
        };
        layouts
            .into_iter()
            .map(|(own, opposite)| Self {
                normal,
                textures: Textures { own, opposite },
            })
            .collect()
    }

    /// The same place seen from the other surface.
    fn swapped(&self) -> Self {
        Self {
            normal: -self.normal,
            textures: Textures {
                own: self.textures.opposite.map(|a| -a),
                opposite: self.textures.own.map(|a| -a),
            },
        }
    }

    /// The frame `(e, e_perp)` of the slip surface and the angle between the textures.
    /// It turns about the outward normal of the textured surface, which is that of the
    /// other one if only that has a texture.
    fn frame(&self) -> (Vector3<f64>, Vector3<f64>, f64) {
        let (e, theta) = match (self.textures.own, self.textures.opposite) {
            (Some(own), Some(opposite)) => ((own + opposite).normalize(), own.angle(&opposite)),
            (Some(only), None) | (None, Some(only)) => (only, 0.0),
            (None, None) => (unit_tangent(&self.normal, &mut Random::new(1)), 0.0),
        };
        let turns_about = match (self.textures.own, self.textures.opposite) {
            (None, Some(_)) => -self.normal,
            _ => self.normal,
        };
        (e, turns_about.cross(&e), theta)
    }
}

fn unit_tangent(normal: &Vector3<f64>, random: &mut Random) -> Vector3<f64> {
    normal.cross(&random.unit3()).normalize()
}

/// The least cap whose slip surface holds `v`, from the kernel by bisection.
fn least_cap(friction: &Friction, place: &Place, v: &Vector3<f64>) -> f64 {
    let kernel = friction.kernel(&place.normal, &place.textures);
    let inverse = kernel.l.try_inverse().unwrap();
    let outside = |cap: f64| {
        let z = inverse * (v - kernel.eta * cap);
        z.norm() > cap * kernel.reach(&z)
    };
    let (mut low, mut high) = (0.0, 1.0);
    while outside(high) {
        high *= 2.0;
    }
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if outside(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

fn keeps_inside_the_slip_surface(friction: &Friction, place: &Place, random: &mut Random) {
    let cap = random.uniform(0.1, 2.0);
    let kernel = friction.kernel(&place.normal, &place.textures);
    let (e, s, theta) = place.frame();
    let surface = friction.slip_surface(theta);
    for share in [1.0, random.uniform(0.0, 1.0)] {
        let d = unit_tangent(&place.normal, random);
        let z = d * (share * cap * kernel.reach(&d));
        let v = -kernel.traction(cap, &z);
        let gauge = surface.gauge(&Vector2::new(v.dot(&e), v.dot(&s)));
        assert!((gauge - least_cap(friction, place, &v)).abs() < 1e-12);
        assert!(gauge <= cap * (1.0 + 1e-12));
        assert!(v.dot(&place.normal).abs() < 1e-14);
        if share == 1.0 {
            assert!((gauge - cap).abs() < 1e-12);
        }
    }
}

fn dissipates(friction: &Friction, place: &Place, random: &mut Random) {
    let kernel = friction.kernel(&place.normal, &place.textures);
    let z = unit_tangent(&place.normal, random);
    assert!((kernel.k * z).dot(&slipping(&kernel, 1.0, &z)) < 0.0);
}

fn meets_the_closed_form(friction: &Friction, place: &Place, random: &mut Random) {
    let kernel = friction.kernel(&place.normal, &place.textures);
    let (e, s, theta) = place.frame();
    let expected = friction.slip_surface(theta).at(random.uniform(0.0, 6.0));
    let (sine, cosine) = expected.angle.sin_cos();
    let z = e * cosine + s * sine;
    let in_plane = |v: Vector2<f64>| e * v.x + s * v.y;
    assert!((in_plane(expected.traction) + slipping(&kernel, 1.0, &z)).norm() < 1e-12);
    assert!((in_plane(expected.slip) - (kernel.k * z).normalize()).norm() < 1e-12);
}

fn is_equivariant_under_rotation(friction: &Friction, place: &Place, random: &mut Random) {
    let q = random.rotation();
    let turned = Place {
        normal: q * place.normal,
        textures: Textures {
            own: place.textures.own.map(|a| q * a),
            opposite: place.textures.opposite.map(|a| q * a),
        },
    };
    let z = unit_tangent(&place.normal, random) * 0.7;
    let kernel = friction.kernel(&place.normal, &place.textures);
    let image = friction.kernel(&turned.normal, &turned.textures);
    assert!((image.traction(0.9, &(q * z)) - q * kernel.traction(0.9, &z)).norm() < 1e-13);
    assert!((image.reach(&(q * z)) - kernel.reach(&z)).abs() < 1e-13);
    assert!((image.k * (q * z) - q * (kernel.k * z)).norm() < 1e-12);
}

fn gives_opposite_forces_to_the_two_sides(friction: &Friction, place: &Place, random: &mut Random) {
    let z = unit_tangent(&place.normal, random) * 0.7;
    let swapped = place.swapped();
    let a = friction.kernel(&place.normal, &place.textures);
    let b = friction.kernel(&swapped.normal, &swapped.textures);
    assert!((a.traction(0.9, &z) + b.traction(0.9, &-z)).norm() < 1e-14);
    assert!((a.reach(&z) - b.reach(&-z)).abs() < 1e-14);
    assert!((a.k * z - b.k * z).norm() < 1e-14);
}

fn inverts_the_slip_map(friction: &Friction, place: &Place) {
    let kernel = friction.kernel(&place.normal, &place.textures);
    assert!((kernel.k * kernel.k_inverse - nalgebra::Matrix3::identity()).norm() < 1e-13);
}

/// `(tau, K^-1 z, K z, rho)` as a function of pressure, slip rate, `z`, textures and
/// normal.
fn response<D: DualNum<Primitive = f64> + Copy>(
    friction: &Friction,
    place: &Place,
    x: &SVector<D, 14>,
) -> SVector<D, 10> {
    let vector = |i: usize| Vector3::new(x[i], x[i + 1], x[i + 2]);
    let textures = Textures {
        own: place.textures.own.map(|_| vector(5)),
        opposite: place.textures.opposite.map(|_| vector(8)),
    };
    let kernel = friction.kernel(&vector(11), &textures);
    let z = vector(2);
    let tau = kernel.traction(friction.cap(x[0], x[1]), &z);
    let (k_inverse_z, k_z) = (kernel.k_inverse * z, kernel.k * z);
    SVector::from_fn(|i, _| match i {
        0..3 => tau[i],
        3..6 => k_inverse_z[i - 3],
        6..9 => k_z[i - 6],
        _ => kernel.reach(&z),
    })
}

fn has_exact_derivatives(friction: &Friction, place: &Place, random: &mut Random) {
    let z = unit_tangent(&place.normal, random) * 0.6;
    let own = place.textures.own.unwrap_or_default();
    let opposite = place.textures.opposite.unwrap_or_default();
    let x = DVector::from_iterator(
        14,
        [1.2, 0.4].into_iter().chain(
            [z, own, opposite, place.normal]
                .iter()
                .flat_map(|v| v.iter().copied())
                .collect::<Vec<_>>(),
        ),
    );
    let fixed = |x: &DVector<f64>| SVector::<f64, 14>::from_column_slice(x.as_slice());
    assert_derivative(
        |x| DVector::from_column_slice(response(friction, place, &fixed(x)).as_slice()),
        |x| {
            let (_, slope) = jacobian(|x| response(friction, place, &x), &fixed(x));
            DMatrix::from_fn(10, 14, |i, j| slope[(i, j)])
        },
        &x,
    );
}
