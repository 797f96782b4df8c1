//! Closed forms of elastic contact: Hertz, Cattaneo and Mindlin.
//!
//! Two bodies that are locally half spaces are pressed together by `P` and then
//! sheared by `Q < mu P`. Pressures and tractions are semi-ellipses,
//!
//! ```text
//! p(r) = p0 e(r/a)                          a, p0 from Hertz
//! q(r) = mu p0 [e(r/a) - c/a e(r/c)]        c, the edge of the stick zone, from Mindlin
//! e(s) = sqrt(1 - s^2) for |s| < 1, else 0
//! ```
//!
//! with `r` the distance from the middle. Assumed are small strains, contact
//! small beside the bodies, and no coupling of normal and tangential
//! tractions, which is exact for equal bodies only; Mindlin's traction also
//! neglects the slip across the direction of `Q`.
//!
//! Sources: Johnson, *Contact Mechanics*, Cambridge 1985
//! (doi:10.1017/CBO9781139171731), chapters 4 and 7; Mindlin, J. Appl. Mech. 16
//! (1949) 259-268. Units are the user's.

mod cylinder;
mod sphere;

pub use cylinder::{LineContact, LinePartialSlip};
pub use sphere::{PartialSlip, PointContact};

/// Modulus `E*` of a contact, `1/E* = sum (1 - nu^2)/E` over the deformable
/// bodies, each given by `E` and `nu`; a rigid body is left out.
pub fn contact_modulus(bodies: &[[f64; 2]]) -> f64 {
    let compliances = bodies.iter().map(|[e, nu]| (1.0 - nu * nu) / e);
    1.0 / compliances.sum::<f64>()
}

/// `e(s) = sqrt(1 - s^2)`, 0 outside of `[-1, 1]`.
fn semi_ellipse(s: f64) -> f64 {
    (1.0 - s * s).max(0.0).sqrt()
}

/// `e(r/a) - c/a e(r/c)`, the shape of Mindlin's traction.
fn partial_slip(r: f64, a: f64, c: f64) -> f64 {
    let taken = if c > 0.0 {
        c / a * semi_ellipse(r / c)
    } else {
        0.0
    };
    semi_ellipse(r / a) - taken
}

#[cfg(test)]
mod tests {
    use super::contact_modulus;

    #[test]
    fn moduli_of_equal_bodies_are_halved() {
        let body = [200.0, 0.3];
        assert!((contact_modulus(&[body]) - 200.0 / 0.91).abs() < 1e-12);
        assert!((contact_modulus(&[body, body]) - 100.0 / 0.91).abs() < 1e-12);
    }
}
