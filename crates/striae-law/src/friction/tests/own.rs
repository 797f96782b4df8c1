//! Laws from outside the crate: a copy of each built-in form gives the same answers.

use nalgebra::{Matrix3, Vector3};
use striae_verify::Random;

use crate::friction::{
    Friction, FrictionError, FrictionLaw, Kernel, Lane, Law, RequiredTextures, SlipRule, Textures,
    Violation, battery,
};

/// A law written as a function.
struct Written {
    textures: RequiredTextures,
    kernel: fn(&Vector3<Lane>, &Textures<Lane>) -> Kernel<'static, Lane>,
}

impl std::fmt::Debug for Written {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("written")
    }
}

impl FrictionLaw for Written {
    fn name(&self) -> &str {
        "written"
    }

    fn required_textures(&self) -> RequiredTextures {
        self.textures
    }

    fn kernel(&self, n: &Vector3<Lane>, textures: &Textures<Lane>) -> Kernel<'static, Lane> {
        (self.kernel)(n, textures)
    }
}

fn own(
    textures: RequiredTextures,
    kernel: fn(&Vector3<Lane>, &Textures<Lane>) -> Kernel<'static, Lane>,
) -> Result<Friction, FrictionError> {
    Friction::own(Written { textures, kernel }, 0.4)
}

/// The orthotropic law with the associated rule: 0.2 along, 0.4 across.
fn associated() -> Friction {
    own(RequiredTextures::One, |_, textures| {
        let a = textures.only().unwrap();
        let diagonal = |along: f64, across: f64| {
            Matrix3::identity() * Lane::from(along) + a * a.transpose() * Lane::from(across - along)
        };
        Kernel::affine(diagonal(0.5, 1.0), Vector3::zeros())
            .with_slip_map(diagonal(2.0, 1.0), diagonal(0.5, 1.0))
    })
    .unwrap()
}

/// Herringbone: a shear of `z` towards one side of the texture, no mirror symmetry.
fn herringbone(n: &Vector3<Lane>, textures: &Textures<Lane>) -> Kernel<'static, Lane> {
    let [a, t] = textures.only_axes(n).unwrap();
    let shear = a * t.transpose() * Lane::from(0.3);
    Kernel::affine(Matrix3::identity() + shear, (a + t) * Lane::from(0.1))
}

/// The law of two textures with its published constants.
fn two_textures(_: &Vector3<Lane>, textures: &Textures<Lane>) -> Kernel<'static, Lane> {
    let (own, opposite) = textures.both().unwrap();
    let (sum, i0) = (own + opposite, own.dot(&opposite));
    let b = (i0 + 1.0) * 0.1;
    let l = Matrix3::identity() * (i0 * 0.1 + 1.0) + sum * sum.transpose() * b;
    Kernel::affine(l, sum * (b * 0.5))
}

#[test]
fn sound_laws_pass_the_battery() {
    assert_eq!(battery(&associated()), []);
    let friction = own(RequiredTextures::One, herringbone).unwrap();
    assert_eq!(battery(&friction), []);
    assert_eq!(
        battery(&own(RequiredTextures::Both, two_textures).unwrap()),
        []
    );
    let decaying = friction.with_decay(0.5, 2.0).unwrap();
    assert_eq!(battery(&decaying.with_shear_cap(0.3).unwrap()), []);
}

#[test]
fn a_copy_of_a_law_gives_its_answers() {
    let pairs = [
        (
            associated(),
            Friction::orthotropic(0.2, 0.4, SlipRule::Associated).unwrap(),
        ),
        (
            own(RequiredTextures::Both, two_textures).unwrap(),
            Friction::two_textures(0.4, 0.1, 0.1, 0.5).unwrap(),
        ),
    ];
    let mut random = Random::new(3);
    for (copy, original) in pairs {
        for _ in 0..20 {
            let n = random.unit3();
            let tangent = |random: &mut Random| n.cross(&random.unit3()).normalize();
            let both = original.required_textures() == RequiredTextures::Both;
            let textures = Textures {
                own: Some(tangent(&mut random)),
                opposite: both.then(|| tangent(&mut random)),
            };
            let z = tangent(&mut random) * 0.3;
            let [found, expected] =
                [&copy, &original].map(|friction| friction.kernel(&n, &textures));
            assert!((found.traction(0.4, &z) - expected.traction(0.4, &z)).norm() < 1e-15);
            assert!((found.k * z - expected.k * z).norm() < 1e-15);
        }
    }
}

#[test]
fn the_battery_finds_what_a_law_gets_wrong() {
    let lopsided = own(RequiredTextures::Both, |_, textures| {
        let (own, _) = textures.both().unwrap();
        let l = Matrix3::identity() + own * own.transpose() * Lane::from(0.5);
        Kernel::affine(l, Vector3::zeros())
    });
    let found = battery(&lopsided.unwrap());
    assert!(matches!(found[..], [Violation::Sides(_)]), "{found:?}");
    let fixed = own(RequiredTextures::Any, |_, _| {
        let x: Vector3<Lane> = Vector3::<f64>::x().map(Lane::from_re);
        Kernel::affine(Matrix3::identity() + x * x.transpose(), Vector3::zeros())
    });
    let found = battery(&fixed.unwrap());
    let objective = |v: &Violation| matches!(v, Violation::NotObjective(_));
    assert!(found.iter().any(objective), "{found:?}");
    let inverse = own(RequiredTextures::Any, |_, _| {
        Kernel::identity().with_slip_map(Matrix3::identity() * Lane::from(2.0), Matrix3::identity())
    });
    let found = battery(&inverse.unwrap());
    assert!(matches!(found[..], [Violation::Inverse(_)]), "{found:?}");
}

#[test]
fn laws_that_create_energy_or_have_no_slip_surface_are_refused() {
    let backwards = own(RequiredTextures::One, |_, textures| {
        let a = textures.only().unwrap();
        let l = Matrix3::identity() - a * a.transpose() * Lane::from(1.5);
        Kernel::affine(l, Vector3::zeros())
    });
    assert!(matches!(
        backwards,
        Err(FrictionError::CreatesEnergyAt { theta, degrees, dissipation })
            if theta == 0.0 && degrees == 0.0 && (dissipation + 0.5).abs() < 1e-12
    ));
    let flat = own(RequiredTextures::Any, |_, _| {
        Kernel::affine(Matrix3::zeros(), Vector3::zeros())
    });
    assert_eq!(
        flat.unwrap_err().to_string(),
        "law `written` has no slip surface at 0.000 degrees between the textures: `L` must be \
         regular in the tangent plane and `|L^-1 eta|` below 1"
    );
}

#[test]
fn laws_of_ones_own_are_known_by_their_name_and_equal_to_themselves() {
    let friction = own(RequiredTextures::One, herringbone).unwrap();
    assert_eq!(friction.law().name(), "written");
    assert_eq!(friction, friction.clone());
    assert_ne!(friction, own(RequiredTextures::One, herringbone).unwrap());
    let surface = friction.slip_surface(0.0);
    let sample = surface.at(1.0);
    assert!((surface.gauge(&sample.traction) - 1.0).abs() < 1e-14);
    assert!((surface.angle(&sample.traction) - 1.0).abs() < 1e-14);
    assert!(matches!(friction.law(), Law::Own(_)));
}
