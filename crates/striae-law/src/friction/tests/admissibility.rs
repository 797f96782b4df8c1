//! Exact admissibility against brute force and against the closed conditions.

use nalgebra::Vector3;
use striae_verify::Random;

use crate::friction::{
    Analysis, Ellipse, Friction, FrictionError, LeastDissipation, Nap, SlipRule, TwoTextures,
};

/// Dissipation of slip at the angle `phi` from the first of two textures at the
/// angle `theta`, from the kernel.
fn dissipation(law: &TwoTextures, theta: f64, phi: f64) -> f64 {
    let unit = |angle: f64| Vector3::new(angle.cos(), angle.sin(), 0.0);
    let d = unit(phi);
    -law.kernel(&unit(0.0), &unit(theta))
        .traction(1.0, &d)
        .dot(&d)
}

/// The least dissipation on a grid, then refined by a pattern search.
fn brute_force(law: &TwoTextures) -> f64 {
    let (rows, columns) = (40, 60);
    let mut least = (f64::INFINITY, 0.0, 0.0);
    let mut look = |theta: f64, phi: f64| {
        let value = dissipation(law, theta, phi);
        if value < least.0 {
            least = (value, theta, phi);
        }
        least
    };
    let mut step = std::f64::consts::PI / f64::from(rows);
    for i in 0..=rows {
        for j in 0..columns {
            look(
                f64::from(i) * step,
                f64::from(j) * std::f64::consts::TAU / f64::from(columns),
            );
        }
    }
    let mut best = look(0.0, 0.0);
    while step > 1e-7 {
        let (value, theta, phi) = best;
        for (dt, dp) in [
            (1., 0.),
            (-1., 0.),
            (0., 1.),
            (0., -1.),
            (1., 0.5),
            (-1., -0.5),
        ] {
            best = look(theta + dt * step, phi + dp * step);
        }
        if best.0 >= value {
            step *= 0.5;
        }
    }
    best.0
}

/// Constants over a range that holds many admissible and many inadmissible ones,
/// with what the law makes of them.
fn sampled(random: &mut Random) -> ([f64; 3], Result<TwoTextures, FrictionError>) {
    let c_cen = random.uniform(-8.0, 8.0);
    let reach = 4.0 / (1.0 + c_cen * c_cen);
    let c = [
        random.uniform(-1.3, 1.3),
        random.uniform(-0.5, 1.0) * reach,
        c_cen,
    ];
    (c, TwoTextures::new(c[0], c[1], c[2]))
}

#[test]
fn least_dissipation_is_that_of_brute_force() {
    let mut random = Random::new(11);
    let (mut admissible, mut refused) = (0, 0);
    for _ in 0..4000 {
        let (c, law) = sampled(&mut random);
        match law {
            Ok(law) => {
                admissible += 1;
                let exact = law.least_dissipation().value;
                let found = brute_force(&law);
                assert!((exact - found).abs() < 1e-9, "{c:?}: {exact} {found}");
            }
            Err(FrictionError::CreatesEnergy {
                i0,
                i1,
                dissipation,
            }) => {
                refused += 1;
                assert!(dissipation <= 0.0);
                assert!((-1.0..=1.0).contains(&i0) && i1 * i1 <= 2.0 + 2.0 * i0 + 1e-12);
                let [c_mag, c_ang, c_cen] = c;
                let there = 1.0 + c_mag * i0 + c_ang * (1.0 + i0) * (c_cen + i1) * i1;
                assert!((there - dissipation).abs() < 1e-12);
            }
            Err(other) => panic!("{other}"),
        }
    }
    assert!(
        admissible > 1000 && refused > 1000,
        "{admissible} {refused}"
    );
}

/// The exact conditions, written as inequalities of the constants: the least over
/// `I1` as a function of `t = |a_ba|`, at its ends and stationary points.
fn conditions([c_mag, c_ang, c_cen]: [f64; 3]) -> bool {
    let c = c_cen.abs();
    if c_ang < 0.0 {
        return c_mag < 1.0 && -c_ang * (8.0 + 4.0 * c) < 1.0 + c_mag;
    }
    if c_ang == 0.0 || c <= 4.0 {
        return c_mag.abs() < 1.0 && c_ang * c * c < 2.0 * (1.0 + c_mag);
    }
    let quartic =
        |t: f64| 1.0 - c_mag + 0.5 * c_mag * t * t + 0.5 * c_ang * (t.powi(4) - c * t.powi(3));
    let root = (2.25 * c_ang * c_ang * c * c - 8.0 * c_ang * c_mag).sqrt();
    let t = (1.5 * c_ang * c + root) / (4.0 * c_ang);
    let inside = t > 0.0 && t < 2.0;
    c_mag < 1.0 && quartic(2.0) > 0.0 && (!inside || quartic(t) > 0.0)
}

#[test]
fn admissible_constants_are_those_of_the_closed_conditions() {
    let mut random = Random::new(12);
    for _ in 0..100_000 {
        let (c, law) = sampled(&mut random);
        assert_eq!(law.is_ok(), conditions(c), "{c:?}");
    }
}

#[test]
fn refusal_names_textures_slip_and_dissipation() {
    let refused = |c: [f64; 3]| TwoTextures::new(c[0], c[1], c[2]).unwrap_err();
    let by = |i0, i1, dissipation| FrictionError::CreatesEnergy {
        i0,
        i1,
        dissipation,
    };
    assert_eq!(refused([0.0, 3.0, 1.0]), by(1.0, -0.5, -0.5));
    assert_eq!(refused([0.0, -1.0, 0.0]), by(1.0, 2.0, -7.0));
    assert_eq!(
        refused([0.0, 3.0, 1.0]).to_string(),
        "friction would create energy: textures with a_a . a_b' = I0 = 1.000000 and slip with \
         a_ba . d = I1 = -0.500000 give a dissipation -tau . d / varpi = -0.500000"
    );
}

#[test]
fn the_edge_of_the_admissible_range_is_sharp() {
    // c_ang c_cen^2 = 2 (1 + c_mag) with c_mag = 0.5, c_cen = 2.
    assert!(TwoTextures::new(0.5, 0.75, 2.0).is_err());
    assert!(TwoTextures::new(0.5, 0.75 - 1e-12, 2.0).is_ok());
    assert!(TwoTextures::new(1.0, 0.0, 0.0).is_err());
    assert!(TwoTextures::new(-1.0, 0.0, 0.0).is_err());
}

#[test]
fn one_ellipse_dissipates_as_brute_force_and_closed_condition_say() {
    let mut random = Random::new(13);
    let (mut positive, mut negative) = (0, 0);
    for _ in 0..4000 {
        let (p, a) = (random.uniform(0.05, 1.0), random.uniform(0.02, 1.0));
        let h = random.uniform(-1.1, 1.1) * p;
        let surface = Ellipse {
            along: p,
            across: a,
            offset: h,
            rule: SlipRule::Opposing,
        };
        let least = surface.least_dissipation().dissipation();
        let found = (0..720).map(|i| surface.at(f64::from(i).to_radians() / 2.0).dissipation());
        let found = found.fold(f64::INFINITY, f64::min);
        assert!(
            least <= found + 1e-15 && found - least < 1e-4,
            "{least} {found}"
        );
        let vertex = p > a && h.abs() < 2.0 * (p - a);
        let condition = p > h.abs() && (!vertex || a > h * h / (4.0 * (p - a)));
        assert_eq!(least > 0.0, condition, "{p} {a} {h}");
        *(if condition {
            &mut positive
        } else {
            &mut negative
        }) += 1;
    }
    assert!(positive > 400 && negative > 400, "{positive} {negative}");
}

#[test]
fn nap_that_creates_energy_is_refused_with_the_slip_direction() {
    let (mu_f, mu_b, mu_t) = (0.05, 0.6, 0.05);
    let Err(FrictionError::CreatesEnergyAlong {
        degrees,
        dissipation,
    }) = Nap::new(mu_f, mu_b, mu_t)
    else {
        panic!("not refused");
    };
    let (mean, h) = (0.5 * (mu_b + mu_f), 0.5 * (mu_b - mu_f));
    let x = degrees.to_radians().cos();
    let expected = mu_t + h * x + (mean - mu_t) * x * x;
    assert!((dissipation - expected).abs() < 1e-12 && dissipation < 0.0);
    assert!((mu_t - h * h / (4.0 * (mean - mu_t)) - dissipation).abs() < 1e-12);
}

#[test]
fn analysis_reports_the_margin_over_all_textures() {
    let friction = Friction::two_textures(0.5, 0.1, 0.1, 0.5).unwrap();
    let analysis = Analysis::new(&friction, 0.3, 36);
    let LeastDissipation { i0, i1, value } = analysis.least_over_textures.unwrap();
    assert!((i0, i1) == (-1.0, 0.0) && (value - 0.9).abs() < 1e-15);
    assert!(analysis.least.dissipation() >= value);
    assert_eq!(analysis.samples.len(), 36);
    let isotropic = Analysis::new(&Friction::coulomb(0.2).unwrap(), 0.0, 8);
    assert_eq!(isotropic.least_over_textures, None);
    assert_eq!(isotropic.extremes.deviation, 0.0);
}
