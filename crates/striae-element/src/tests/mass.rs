//! Mass: closed forms, the whole, and what is moved from corners that are to have none.

use super::*;
use crate::redistributed;

#[test]
fn the_mass_of_a_hexahedron_is_that_of_the_closed_form_on_a_parallelepiped() {
    // m_ab = rho V prod_j (1 + xi_aj xi_bj / 3) / 4.
    let map = Random::new(18).near_identity(0.3);
    let corners = CellKind::Hexahedron.shape().corners;
    let reference = corners.iter().map(|x| map * Vec3::from(*x) * 0.5);
    let single = Single::new(
        CellKind::Hexahedron,
        Formulation::Standard,
        reference.collect(),
    );
    let volume = map.determinant();
    assert!((single.element().volume() - volume).abs() < 1e-15);
    let mass = single.element().mass(2.5);
    for (a, corner_a) in corners.iter().enumerate() {
        for (b, corner_b) in corners.iter().enumerate() {
            let share: f64 = (0..3)
                .map(|j| (1.0 + corner_a[j] * corner_b[j] / 3.0) / 4.0)
                .product();
            assert!((mass[a][b] - 2.5 * volume * share).abs() < 1e-15);
        }
    }
}

#[test]
fn the_mass_of_a_tetrahedron_is_that_of_the_closed_form() {
    // m_ab = rho V (1 + d_ab) / 20.
    let mut random = Random::new(21);
    let kind = CellKind::Tetrahedron;
    let single = Single::distorted(kind, Formulation::Standard, &mut random, 0.1);
    let [a, b, c, d]: [Vec3; 4] = single.reference[..].try_into().unwrap();
    let volume = (b - a).dot(&(c - a).cross(&(d - a))) / 6.0;
    assert!((single.element().volume() - volume).abs() < 1e-16);
    let mass = single.element().mass(2.5);
    for a in 0..4 {
        for b in 0..4 {
            let share = if a == b { 0.1 } else { 0.05 };
            assert!((mass[a][b] - 2.5 * volume * share).abs() < 1e-15);
        }
    }
}

#[test]
fn the_whole_mass_is_density_times_volume() {
    for kind in CellKind::ALL {
        let single = Single::distorted(kind, Formulation::Standard, &mut Random::new(22), 0.1);
        let total: f64 = single.element().mass(2.5).iter().flatten().sum();
        assert!((total - 2.5 * single.element().volume()).abs() < 1e-14);
    }
}

#[test]
fn corners_without_mass_leave_the_whole_mass_to_the_others() {
    let single = Single::distorted(
        CellKind::Hexahedron,
        Formulation::Standard,
        &mut Random::new(23),
        0.1,
    );
    let mass = single.element().mass(2.5);
    let face = [true, true, true, true, false, false, false, false];
    let (corner, mut one) = (
        [false, true, true, true, true, true, true, true],
        [false; 8],
    );
    one[5] = true;
    for massless in [face, corner, one] {
        let moved = redistributed(single.kind, &mass, &massless);
        let total: f64 = moved.iter().flatten().sum();
        assert!((total - 2.5 * single.element().volume()).abs() < 1e-14);
        for a in 0..8 {
            for b in 0..8 {
                assert!((moved[a][b] - moved[b][a]).abs() < 1e-15);
                assert!(!(massless[a] || massless[b]) || moved[a][b] == 0.0);
            }
        }
    }
    // Along edges: the corner above gets all of the one below.
    let moved = redistributed(single.kind, &mass, &face);
    let sum = mass[0][0] + mass[0][4] + mass[4][0] + mass[4][4];
    assert!((moved[4][4] - sum).abs() < 1e-15);
}
