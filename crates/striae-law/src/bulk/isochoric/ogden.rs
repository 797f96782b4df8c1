//! Ogden's law in principal stretches.
//!
//! With the principal stretches `l_a` of `F`, `J = l_1 l_2 l_3` and the isochoric
//! stretches `L_a = J^-1/3 l_a`,
//!
//! ```text
//! W = sum_p mu_p/alpha_p (L_1^alpha_p + L_2^alpha_p + L_3^alpha_p - 3) + U(J)
//! tau_a = l_a dW/dl_a = sum_p mu_p (m_a - mean m) + J U' ,   m_a = L_a^alpha_p
//! G = 1/2 sum_p mu_p alpha_p
//! ```
//!
//! In the principal axes `N_a` of `C` and `n_a = F N_a/l_a`, with `S_a = tau_a/l_a^2`,
//!
//! ```text
//! P = sum_a tau_a/l_a n_a (x) N_a
//! A = sum_ab (T_ab - d_ab tau_a)/(l_a l_b) (n_a N_a)(n_b N_b)
//!   + sum_a/=b (S_a + l_b^2 D_ab) (n_a N_b)(n_a N_b) + l_a l_b D_ab (n_a N_b)(n_b N_a)
//! T_ab = dtau_a/d ln l_b ,   D_ab = (S_a - S_b)/(l_a^2 - l_b^2)
//! ```
//!
//! The divided difference of powers in `D_ab` is `expm1(q r)/expm1(r)` with
//! `r = ln(l_a^2/l_b^2)`, exact to round-off for stretches however close.
//!
//! Sources: Ogden, Proc. R. Soc. Lond. A 326 (1972) 565-584,
//! doi:10.1098/rspa.1972.0026; Ogden, "Non-linear Elastic Deformations" (1984), section
//! 6.1, for the tangent. Abaqus writes `2 mu_i/alpha_i^2` for `mu_p/alpha_p`.

use super::{InadmissibleHyperelastic, Isochoric, finite};
use crate::bulk::{
    Material, RUBBER, Response, ResponseError, Tangent, Volumetric, invariants::inverse,
};
use nalgebra::{Matrix3, SVector, SymmetricEigen};
use serde::Serialize;
use striae_declared::{ANY, Declared, NO_UNIT, Parameter, Set, Values};

/// The law.
pub static OGDEN: Declared<Material> = Declared {
    name: "ogden",
    summary: "Rubber with the energy `sum mu/alpha (l1^alpha + l2^alpha + l3^alpha - 3)` of the isochoric stretches, nearly incompressible.",
    parameters: &[
        Parameter::tables(
            "terms",
            &Set {
                doc: "A term of Ogden's law. Other programs write `2 mu/alpha^2` where this one writes `mu/alpha`.",
                parameters: &[
                    Parameter::number("mu", ANY, "force per area", "Modulus."),
                    Parameter::number("alpha", ANY, NO_UNIT, "Exponent, not zero."),
                ],
            },
            "Terms; the shear modulus at rest, half the sum of `mu alpha`, must be positive.",
        ),
        RUBBER,
    ],
    build: |values| {
        let term = |values: &Values| OgdenTerm {
            mu: values.number("mu"),
            alpha: values.number("alpha"),
        };
        let terms = values.tables("terms").iter().map(term);
        Material::rubber(Isochoric::Ogden(terms.collect()), values)
    },
    fit: None,
};

/// Values that state terms.
pub(super) fn values(terms: &[OgdenTerm]) -> Values {
    let term = |term: &OgdenTerm| Values::from([("mu", term.mu), ("alpha", term.alpha)]);
    let terms: Vec<Values> = terms.iter().map(term).collect();
    Values::default().with("terms", terms)
}

pub(super) fn check(terms: &[OgdenTerm]) -> Result<(), InadmissibleHyperelastic> {
    if terms.is_empty() {
        return Err(InadmissibleHyperelastic::NoTerm);
    }
    for (at, term) in terms.iter().enumerate() {
        finite([("mu", term.mu), ("alpha", term.alpha)])?;
        if term.alpha == 0.0 {
            return Err(InadmissibleHyperelastic::NoExponent(at));
        }
    }
    Ok(())
}

/// A term of Ogden's law.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct OgdenTerm {
    /// `mu`, a stress.
    pub mu: f64,
    /// `alpha`, without unit.
    pub alpha: f64,
}

/// Shear modulus in the small-strain limit.
pub(super) fn shear(terms: &[OgdenTerm]) -> f64 {
    0.5 * terms.iter().map(|term| term.mu * term.alpha).sum::<f64>()
}

/// Principal values at a deformation.
struct Principal {
    energy: f64,
    /// Squares of the stretches.
    square: [f64; 3],
    /// Kirchhoff stresses `tau_a`.
    tau: [f64; 3],
    /// `dtau_a/d ln l_b`.
    slope: Matrix3<f64>,
}

#[allow(non_snake_case)]
pub(in crate::bulk) fn response(
    terms: &[OgdenTerm],
    volumetric: Volumetric,
    bulk: f64,
    F: &Matrix3<f64>,
) -> Result<Response, ResponseError> {
    let (J, _) = inverse(F)?;
    let eigen = SymmetricEigen::new(F.transpose() * F);
    let square: [f64; 3] = eigen.eigenvalues.into();
    if square.iter().any(|square| *square <= 0.0) {
        return Err(ResponseError::Inverted { determinant: J });
    }
    let principal = principal(terms, volumetric, bulk, J, square);
    let stretch = square.map(f64::sqrt);
    let N = eigen.eigenvectors;
    let n: Matrix3<f64> = Matrix3::from_columns(&[0, 1, 2].map(|a| F * N.column(a) / stretch[a]));
    let mut first_piola = Matrix3::zeros();
    for a in 0..3 {
        first_piola += n.column(a) * N.column(a).transpose() * (principal.tau[a] / stretch[a]);
    }
    Ok(Response {
        energy: principal.energy,
        first_piola,
        tangent: tangent(terms, J, &principal, &n, &N),
    })
}

#[allow(non_snake_case)]
fn principal(
    terms: &[OgdenTerm],
    volumetric: Volumetric,
    bulk: f64,
    J: f64,
    square: [f64; 3],
) -> Principal {
    let (pressure, stiffness) = volumetric.pressure(bulk, J);
    let mut values = Principal {
        energy: volumetric.energy(bulk, J),
        square,
        tau: [pressure; 3],
        slope: Matrix3::repeat(stiffness),
    };
    for &OgdenTerm { mu, alpha } in terms {
        let m = square.map(|square| (square * J.powf(-2.0 / 3.0)).powf(0.5 * alpha));
        let sum: f64 = m.iter().sum();
        values.energy += mu / alpha * (sum - 3.0);
        for a in 0..3 {
            values.tau[a] += mu * (m[a] - sum / 3.0);
            values.slope[(a, a)] += mu * alpha * m[a];
            for b in 0..3 {
                values.slope[(a, b)] += mu * alpha * (sum / 9.0 - (m[a] + m[b]) / 3.0);
            }
        }
    }
    values
}

#[allow(non_snake_case)]
fn tangent(
    terms: &[OgdenTerm],
    J: f64,
    principal: &Principal,
    n: &Matrix3<f64>,
    N: &Matrix3<f64>,
) -> Tangent {
    let Principal { square, tau, .. } = principal;
    let dyad =
        |a: usize, b: usize| SVector::<f64, 9>::from_fn(|row, _| n[(row / 3, a)] * N[(row % 3, b)]);
    let mut sum = Tangent::zeros();
    for (a, b) in (0..3).flat_map(|a| (0..3).map(move |b| (a, b))) {
        let product = (square[a] * square[b]).sqrt();
        let own = if a == b { tau[a] } else { 0.0 };
        let direct = (principal.slope[(a, b)] - own) / product;
        sum += dyad(a, a) * dyad(b, b).transpose() * direct;
        if a == b {
            continue;
        }
        let difference = difference(terms, J, square[a], square[b]) / square[a]
            - tau[b] / (square[a] * square[b]);
        let shear = tau[a] / square[a] + square[b] * difference;
        sum += dyad(a, b) * dyad(a, b).transpose() * shear;
        sum += dyad(a, b) * dyad(b, a).transpose() * (product * difference);
    }
    // The eigenvectors leave it symmetric to round-off only.
    (sum + sum.transpose()) * 0.5
}

/// `(tau_a - tau_b)/(x - y)` for the squares `x`, `y` of two stretches.
#[allow(non_snake_case)]
fn difference(terms: &[OgdenTerm], J: f64, x: f64, y: f64) -> f64 {
    let r = ((x - y) / y).ln_1p();
    let term = |&OgdenTerm { mu, alpha }: &OgdenTerm| {
        let q = 0.5 * alpha;
        let ratio = if r == 0.0 {
            q
        } else {
            (q * r).exp_m1() / r.exp_m1()
        };
        mu * J.powf(-alpha / 3.0) * y.powf(q - 1.0) * ratio
    };
    terms.iter().map(term).sum()
}
