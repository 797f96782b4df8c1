//! Battery of properties that every friction law must satisfy, checked in one call.
//!
//! A law is checked against mechanics at random places: tractions stay inside the slip surface,
//! slip dissipates, the response rotates with its arguments, is independent of the side it is seen
//! from and tangential to both surfaces, `K^-1` is the inverse of `K`, and derivatives are exact,
//! judged by the order at which finite-difference errors decrease. Factors by healing and of one's
//! own are judged in `battery/factors.rs`.

mod factors;

use nalgebra::{DMatrix, DVector, Matrix3, SVector, Vector2, Vector3};
use num_dual::{DualNum, jacobian};
use striae_verify::derivative::directional;
use striae_verify::{Difference, Random};

use super::{FactorFailure, Friction, Kernel, RequiredTextures, Textures};

/// Something a friction law gets wrong.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Violation {
    /// A force `-tau` is not where its slip surface says.
    #[error("a force -tau has the gauge {gauge:.6e} instead of {expected:.6e}")]
    SlipSurface {
        /// `Gamma(-tau)` by the slip surface.
        gauge: f64,
        /// Value given by the kernel.
        expected: f64,
    },
    /// Slip dissipates nothing, or friction creates energy.
    #[error("slip dissipates {0:.6e} times varpi |K z|, but it must dissipate a positive amount")]
    Dissipation(f64),
    /// A force out of the tangent plane.
    #[error("a force has the normal component {0:.3e} of varpi, but it must be tangential")]
    NotTangential(f64),
    /// Force or slip differ from those of the closed form.
    #[error("force or slip differ by {0:.3e} from those on the slip surface")]
    ClosedForm(f64),
    /// A rotation of normal and textures does more than turn the answer.
    #[error("a rotation of normal, textures and slip changes the response by {0:.3e}")]
    NotObjective(f64),
    /// Forces on the two surfaces are not opposite.
    #[error("seen from the other surface force or slip differ by {0:.3e}")]
    Sides(f64),
    /// `K^-1` is not the inverse of `K`.
    #[error("K K^-1 differs from the identity by {0:.3e}")]
    Inverse(f64),
    /// A derivative is wrong.
    #[error("derivatives by pressure, slip rate, z, textures or normal are wrong\n{0}")]
    Derivative(String),
    /// A factor of one's own is negative or not finite, or its law has failed.
    #[error("{0}")]
    Factor(FactorFailure),
    /// Friction by a factor falls with the pressure, so that an increment has several solutions.
    #[error(
        "the factor lets friction fall as the pressure rises, at {0}: make the pressure times the \
         factor ascend"
    )]
    FactorFallsWithPressure(String),
    /// A factor has an infinite slope by the slip rate at rest.
    #[error(
        "the factor jumps or has no finite slope where slip begins, at {0}; the rate of a node that \
         sticks is round-off: let it leave rest with a finite slope, as by `v + v_0` for `v`, or use \
         friction by rate and state"
    )]
    FactorSteepAtRest(String),
    /// A factor jumps with the pressure or the slip rate.
    #[error(
        "the factor jumps by {change:.3e} where the {by} is {value:.6e}, at {at}: equilibrium may \
         have no solution there; make it pass from one value to the other over a range of the {by}"
    )]
    FactorJumps {
        /// Its argument, in words.
        by: &'static str,
        /// Value of the argument at the jump.
        value: f64,
        /// Change of the factor there.
        change: f64,
        /// Point in words.
        at: String,
    },
    /// A factor differs between the two surfaces, or turns with them.
    #[error(
        "the factor changes by {0:.3e} as seen from the other surface, or with a rotation of normal \
         and textures: let it depend on them by angles that both surfaces see alike"
    )]
    FactorSides(f64),
    /// A derivative of a factor is wrong.
    #[error(
        "derivatives of the factor by pressure, slip rate, normal or textures, with those of the \
         state at the end of the increment, are wrong\n{0}"
    )]
    FactorDerivative(String),
    /// A state changes in no time.
    #[error(
        "the state changes by {0:.3e} in an increment of no duration: what is added must be \
         proportional to the duration or to the slip"
    )]
    FactorStateJumps(f64),
    /// A state depends on how time is divided.
    #[error(
        "the state after an increment and after its two halves differ by more than errors of second \
         order in the duration: make the update one of an evolution in time and slip\n{0}"
    )]
    FactorState(String),
}

/// Random places where algebra is checked.
const PLACES: usize = 50;
/// Random directions of derivatives.
const DIRECTIONS: usize = 4;
/// Round-off.
const ROUND_OFF: f64 = 1e-12;

/// Everything a law gets wrong, empty for a sound one and for one without friction.
pub fn battery(friction: &Friction) -> Vec<Violation> {
    if friction.coefficient().at_rest() == 0.0 {
        return Vec::new();
    }
    let mut random = Random::new(7);
    let mut violations: Vec<Violation> = Vec::new();
    for _ in 0..PLACES {
        for place in Place::of(friction, &mut random) {
            let judged = [
                keeps_inside_the_slip_surface(friction, &place, &mut random),
                dissipates(friction, &place, &mut random),
                meets_the_closed_form(friction, &place, &mut random),
                is_equivariant_under_rotation(friction, &place, &mut random),
                gives_opposite_forces_to_the_two_sides(friction, &place, &mut random),
                inverts_the_slip_map(friction, &place),
            ];
            violations.extend(judged.into_iter().filter_map(Result::err));
        }
    }
    for place in Place::of(friction, &mut random) {
        violations.extend(has_exact_derivatives(friction, &place, &mut random).err());
    }
    if let Some(law) = friction.factor() {
        violations.extend(factors::violations(law, friction.required_textures()));
    }
    let mut kinds = Vec::new();
    violations.retain(|violation| {
        let kind = std::mem::discriminant(violation);
        let first = !kinds.contains(&kind);
        kinds.push(kind);
        first
    });
    violations
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

    /// Returns this place as seen from the other surface.
    fn swapped(&self) -> Self {
        Self {
            normal: -self.normal,
            textures: Textures {
                own: self.textures.opposite.map(|a| -a),
                opposite: self.textures.own.map(|a| -a),
            },
        }
    }

    /// The frame `(e, e_perp)` of the slip surface and the angle from own to opposite
    /// texture. It turns about the outward normal of the textured surface, which is that of
    /// the other one if only that has a texture.
    fn frame(&self) -> (Vector3<f64>, Vector3<f64>, f64) {
        let (e, theta) = match (self.textures.own, self.textures.opposite) {
            (Some(own), Some(opposite)) => {
                let turn = own.cross(&opposite).dot(&self.normal);
                ((own + opposite).normalize(), turn.atan2(own.dot(&opposite)))
            }
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

/// Friction traction of slip with `z` along the unit vector `d`.
fn slipping(kernel: &Kernel<'_, f64>, cap: f64, d: &Vector3<f64>) -> Vector3<f64> {
    kernel.traction(cap, &(d * (cap * kernel.reach(d))))
}

fn unit_tangent(normal: &Vector3<f64>, random: &mut Random) -> Vector3<f64> {
    normal.cross(&random.unit3()).normalize()
}

/// `Ok` for an error of round-off, written so that what is not a number is wrong.
fn small(error: f64, violation: impl FnOnce(f64) -> Violation) -> Result<(), Violation> {
    if error <= ROUND_OFF {
        Ok(())
    } else {
        Err(violation(error))
    }
}

/// The least cap whose slip surface holds `v`, from the kernel by bisection.
fn least_cap(friction: &Friction, place: &Place, v: &Vector3<f64>) -> f64 {
    let kernel = friction.kernel(&place.normal, &place.textures);
    let Some(inverse) = kernel.l.try_inverse() else {
        return f64::NAN;
    };
    let outside = |cap: f64| {
        let z = inverse * (v - kernel.eta * cap);
        z.norm() > cap * kernel.reach(&z)
    };
    let (mut low, mut high) = (0.0, 1.0);
    while outside(high) && high < 1e6 {
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

fn keeps_inside_the_slip_surface(
    friction: &Friction,
    place: &Place,
    random: &mut Random,
) -> Result<(), Violation> {
    let cap = random.uniform(0.1, 2.0);
    let kernel = friction.kernel(&place.normal, &place.textures);
    let (e, s, theta) = place.frame();
    let surface = friction.slip_surface(theta);
    for share in [1.0, random.uniform(0.0, 1.0)] {
        let d = unit_tangent(&place.normal, random);
        let z = d * (share * cap * kernel.reach(&d));
        let v = -kernel.traction(cap, &z);
        let gauge = surface.gauge(&Vector2::new(v.dot(&e), v.dot(&s)));
        let wrong = |expected: f64| Violation::SlipSurface { gauge, expected };
        let expected = least_cap(friction, place, &v);
        small((gauge - expected).abs(), |_| wrong(expected))?;
        small(gauge / cap - 1.0, |_| wrong(cap))?;
        small(v.dot(&place.normal).abs() / cap, Violation::NotTangential)?;
        if share == 1.0 {
            small((gauge - cap).abs(), |_| wrong(cap))?;
        }
    }
    Ok(())
}

fn dissipates(friction: &Friction, place: &Place, random: &mut Random) -> Result<(), Violation> {
    let kernel = friction.kernel(&place.normal, &place.textures);
    let z = unit_tangent(&place.normal, random);
    let slip = (kernel.k * z).normalize();
    let dissipation = -slip.dot(&slipping(&kernel, 1.0, &z));
    if dissipation > 0.0 {
        Ok(())
    } else {
        Err(Violation::Dissipation(dissipation))
    }
}

fn meets_the_closed_form(
    friction: &Friction,
    place: &Place,
    random: &mut Random,
) -> Result<(), Violation> {
    let kernel = friction.kernel(&place.normal, &place.textures);
    let (e, s, theta) = place.frame();
    let expected = friction.slip_surface(theta).at(random.uniform(0.0, 6.0));
    let (sine, cosine) = expected.angle.sin_cos();
    let z = e * cosine + s * sine;
    let in_plane = |v: Vector2<f64>| e * v.x + s * v.y;
    let force = (in_plane(expected.traction) + slipping(&kernel, 1.0, &z)).norm();
    let slip = (in_plane(expected.slip) - (kernel.k * z).normalize()).norm();
    small(force.max(slip), Violation::ClosedForm)
}

fn is_equivariant_under_rotation(
    friction: &Friction,
    place: &Place,
    random: &mut Random,
) -> Result<(), Violation> {
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
    let force = (image.traction(0.9, &(q * z)) - q * kernel.traction(0.9, &z)).norm();
    let reach = (image.reach(&(q * z)) - kernel.reach(&z)).abs();
    let slip = (image.k * (q * z) - q * (kernel.k * z)).norm();
    small(force.max(slip).max(reach), Violation::NotObjective)
}

fn gives_opposite_forces_to_the_two_sides(
    friction: &Friction,
    place: &Place,
    random: &mut Random,
) -> Result<(), Violation> {
    let z = unit_tangent(&place.normal, random) * 0.7;
    let swapped = place.swapped();
    let a = friction.kernel(&place.normal, &place.textures);
    let b = friction.kernel(&swapped.normal, &swapped.textures);
    let force = (a.traction(0.9, &z) + b.traction(0.9, &-z)).norm();
    let reach = (a.reach(&z) - b.reach(&-z)).abs();
    let slip = (a.k * z - b.k * z).norm();
    small(force.max(slip).max(reach), Violation::Sides)
}

fn inverts_the_slip_map(friction: &Friction, place: &Place) -> Result<(), Violation> {
    let kernel = friction.kernel(&place.normal, &place.textures);
    let error = (kernel.k * kernel.k_inverse - Matrix3::identity()).norm();
    small(error, Violation::Inverse)
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

fn has_exact_derivatives(
    friction: &Friction,
    place: &Place,
    random: &mut Random,
) -> Result<(), Violation> {
    let z = unit_tangent(&place.normal, random) * 0.6;
    let own = place.textures.own.unwrap_or_default();
    let opposite = place.textures.opposite.unwrap_or_default();
    let vectors = [z, own, opposite, place.normal];
    let coordinates = vectors.iter().flat_map(|v| v.iter().copied());
    let x = DVector::from_iterator(14, [1.2, 0.4].into_iter().chain(coordinates));
    let fixed = |x: &DVector<f64>| SVector::<f64, 14>::from_column_slice(x.as_slice());
    let (_, slope) = jacobian(|x| response(friction, place, &x), &fixed(&x));
    let slope = DMatrix::from_fn(10, 14, |i, j| slope[(i, j)]);
    let value = |x: &DVector<f64>| {
        DVector::from_column_slice(response(friction, place, &fixed(x)).as_slice())
    };
    for _ in 0..DIRECTIONS {
        let direction = random.unit(14);
        for difference in [Difference::Forward, Difference::Central] {
            directional(difference, value, &(&slope * &direction), &x, &direction)
                .map_err(|wrong| Violation::Derivative(wrong.to_string().trim_end().to_owned()))?;
        }
    }
    Ok(())
}
