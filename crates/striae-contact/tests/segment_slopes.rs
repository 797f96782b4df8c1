//! Derivatives of segments.

mod facets;

use facets::{mirrored, parallelogram, random_quad, triangle};
use nalgebra::{DMatrix, DVector, Rotation3};
use striae_contact::{
    segment::{Derivatives, Facet, Segment, Slopes, pair_index, plane_segment, segment},
    side::Side,
};
use striae_mesh::Vec3;
use striae_surface::facet::Shape;
use striae_verify::{Random, assert_derivative};

/// Corners from coordinates around a pair, such that changes of order one are large.
fn facets_at(x: &DVector<f64>, shapes: [Shape; 2]) -> [Facet; 2] {
    Side::BOTH.map(|side| {
        let corners =
            std::array::from_fn(|c| Vec3::from_fn(|i, _| x[12 * side.index() + 3 * c + i]));
        Facet {
            corners,
            shape: shapes[side],
        }
    })
}

fn coordinates([a, b]: [&Facet; 2]) -> DVector<f64> {
    let corners = a.corners.iter().chain(&b.corners);
    DVector::from_iterator(24, corners.flat_map(|x| [x.x, x.y, x.z]))
}

/// `n`, the upper triangle of `D`, the area.
fn all_values(found: &Segment) -> DVector<f64> {
    let mut values: Vec<f64> = found.normal.iter().copied().collect();
    for c in 0..8 {
        values.extend_from_slice(&found.mass[c][c..]);
    }
    DVector::from_vec(values)
}

fn all_slopes(slopes: &Slopes) -> DMatrix<f64> {
    DMatrix::from_fn(39, 24, |row, lane| match row {
        0..3 => slopes.normal[lane / 3][(row, lane % 3)],
        _ => slopes.mass[row - 3][lane],
    })
}

fn assert_slopes(a: &Facet, b: &Facet, compliance: [f64; 2]) {
    let shapes = [a.shape, b.shape];
    let at = |x: &DVector<f64>, derivatives| {
        let [a, b] = facets_at(x, shapes);
        segment(&a, &b, compliance, derivatives).expect("they overlap")
    };
    // The largest step of the differences is 1/64: coordinates in units that keep labels.
    let unit = 0.1;
    let origin = coordinates([a, b]);
    let place = |z: &DVector<f64>| &origin + z * unit;
    assert_derivative(
        |z| all_values(&at(&place(z), Derivatives::None)),
        |z| {
            let found = at(&place(z), Derivatives::First);
            all_slopes(&found.slopes.expect("asked for")) * unit
        },
        &DVector::zeros(24),
    );
}

#[test]
fn parallelograms_have_the_right_derivatives() {
    let a = parallelogram();
    for shift in [0.1, 0.3, 0.5] {
        let b = mirrored(&a, shift);
        for compliance in [[1.0, 1.0], [1.0, 0.0], [0.2, 1.0]] {
            // Any motion distorts them and changes the rule: all rules must agree.
            assert_slopes(&a, &b, compliance);
        }
    }
}

#[test]
fn warped_tilted_quadrilaterals_have_the_right_derivatives() {
    let mut random = Random::new(11);
    for compliance in [[1.0, 0.3], [1.0, 0.0], [0.1, 1.0]] {
        for shift in [0.15, 0.35, -0.3] {
            let a = random_quad(&mut random, 0.15, 0.1);
            let b = mirrored(&random_quad(&mut random, 0.15, 0.1), shift);
            assert_slopes(&a, &b, compliance);
        }
    }
}

#[test]
fn facets_that_hardly_face_each_other_have_the_right_derivatives() {
    let a = parallelogram();
    for cosine in [-0.27f64, -0.2, -0.14] {
        let turn = Rotation3::from_axis_angle(&Vec3::x_axis(), (-cosine).acos());
        let [p, q, r, s] = a.corners;
        let b = Facet {
            corners: [p, s, r, q].map(|x| turn * (x + Vec3::new(0.1, -0.4, 0.0))),
            shape: a.shape,
        };
        for compliance in [[1.0, 1.0], [1.0, 0.0], [0.2, 1.0]] {
            assert_slopes(&a, &b, compliance);
        }
    }
}

#[test]
fn triangles_have_the_right_derivatives() {
    let mut random = Random::new(12);
    for corners in [[0, 1, 2], [0, 2, 3], [1, 2, 3]] {
        let a = random_quad(&mut random, 0.15, 0.1);
        let b = mirrored(&random_quad(&mut random, 0.15, 0.1), 0.25);
        let b = triangle(&b.corners, corners);
        assert_slopes(&a, &b, [1.0, 0.3]);
        assert_slopes(&b, &a, [0.0, 1.0]);
        let a = triangle(&a.corners, [3, 0, 1]);
        if segment(&a, &b, [1.0, 0.5], Derivatives::None).is_some() {
            assert_slopes(&a, &b, [1.0, 0.5]);
        }
    }
}

#[test]
fn slopes_do_not_see_rigid_motion() {
    let mut random = Random::new(13);
    for trial in 0..40 {
        let offset = [0.0, 0.02, 0.2][trial % 3];
        let a = random_quad(&mut random, offset, offset);
        let b = mirrored(&random_quad(&mut random, offset, offset), 0.3);
        let Some(found) = segment(&a, &b, [1.0, 0.4], Derivatives::First) else {
            continue;
        };
        let slopes = all_slopes(found.slopes.as_ref().expect("asked for"));
        let x = coordinates([&a, &b]);
        let spin = random.vector3();
        let shift = DVector::from_fn(24, |lane, _| spin[lane % 3]);
        assert!((&slopes * shift).amax() < 1e-13);
        let turn = DVector::from_fn(24, |lane, _| {
            let corner = Vec3::from_fn(|i, _| x[lane / 3 * 3 + i]);
            spin.cross(&corner)[lane % 3]
        });
        let mut expected = DVector::zeros(39);
        expected
            .rows_mut(0, 3)
            .copy_from(&spin.cross(&found.normal));
        assert!((&slopes * turn - expected).amax() < 1e-13);
        // Lengths scale D by their square.
        let mut grown = all_values(&found) * 2.0;
        grown.rows_mut(0, 3).fill(0.0);
        assert!((&slopes * x - grown).amax() < 1e-13);
    }
}

#[test]
fn swapped_sides_have_the_same_slopes() {
    let mut random = Random::new(14);
    for trial in 0..30 {
        let offset = [0.0, 0.02, 0.2][trial % 3];
        let a = random_quad(&mut random, offset, offset);
        let b = mirrored(&random_quad(&mut random, offset, offset), 0.3);
        let of = |a, b, c| segment(a, b, c, Derivatives::First).and_then(|found| found.slopes);
        let Some(own) = of(&a, &b, [1.0, 0.4]) else {
            continue;
        };
        let other = of(&b, &a, [0.4, 1.0]).expect("as before");
        assert_swapped(&own, &other);
    }
    // Also where corners coincide and edges are flush.
    let a = parallelogram();
    let [p, q, r, s] = a.corners;
    for corners in [[p, s, r, q], [p, s, (s + r) * 0.5, (p + q) * 0.5]] {
        let b = Facet {
            corners,
            shape: Shape::Quadrilateral,
        };
        let own = segment(&a, &b, [1.0, 0.4], Derivatives::First).expect("they overlap");
        let other = segment(&b, &a, [0.4, 1.0], Derivatives::First).expect("they overlap");
        assert_swapped(
            &own.slopes.expect("asked for"),
            &other.slopes.expect("asked for"),
        );
    }
}

fn assert_swapped(own: &Slopes, other: &Slopes) {
    for c in 0..8 {
        for d in c..8 {
            let row = &own.mass[pair_index(c, d)];
            let swapped = &other.mass[pair_index((c + 4) % 8, (d + 4) % 8)];
            for lane in 0..24 {
                let difference = (row[lane] - swapped[(lane + 12) % 24]).abs();
                assert!(difference < 1e-13, "{c} {d} {lane}: {difference}");
            }
        }
    }
}

#[test]
fn areas_of_a_flush_mesh_change_as_their_sum() {
    // Four facets in a two by two mesh, the opposing one flush with all outer edges.
    let a = parallelogram();
    let at = |xi: f64, eta: f64| -> Vec3 {
        let w = Shape::Quadrilateral.weights(xi, eta).value;
        (0..4).map(|c| a.corners[c] * w[c]).sum()
    };
    let mut by_a = [0.0; 12];
    for [x, y] in [[-1.0, -1.0], [0.0, -1.0], [-1.0, 0.0], [0.0, 0.0]] {
        let corners = [
            at(x, y),
            at(x, y + 1.0),
            at(x + 1.0, y + 1.0),
            at(x + 1.0, y),
        ];
        let part = Facet {
            corners,
            shape: Shape::Quadrilateral,
        };
        let found = segment(&a, &part, [0.0, 1.0], Derivatives::First).expect("they overlap");
        let slopes = found.slopes.expect("asked for");
        for c in 0..4 {
            for d in 0..4 {
                let row = &slopes.mass[pair_index(c, d)];
                (0..12).for_each(|lane| by_a[lane] += row[lane]);
            }
        }
    }
    // The outline's vertices are the corners, each half a's and half the mesh's, and the
    // midpoints of the edges, the mesh's: half of half of the change of the whole area.
    for corner in 0..4 {
        let before = a.corners[(corner + 3) % 4];
        let after = a.corners[(corner + 1) % 4];
        let whole = Vec3::z().cross(&(after - before)) * -0.5;
        let own = Vec3::from_row_slice(&by_a[3 * corner..3 * corner + 3]);
        assert!(
            (own.xy() - whole.xy() * 0.25).norm() < 1e-14,
            "{own} {whole}"
        );
    }
}

#[test]
fn a_plane_segment_has_the_right_derivatives() {
    let normal = Vec3::new(0.1, -0.2, -1.0).normalize();
    let quad = random_quad(&mut Random::new(15), 0.2, 0.2);
    for facet in [quad, triangle(&quad.corners, [0, 1, 2])] {
        let other = triangle(&quad.corners, [0, 1, 2]);
        let at = |x: &DVector<f64>, derivatives| {
            let [a, _] = facets_at(x, [facet.shape; 2]);
            plane_segment(&a, &normal, derivatives).expect("they face")
        };
        assert_derivative(
            |x| all_values(&at(x, Derivatives::None)),
            |x| all_slopes(&at(x, Derivatives::First).slopes.expect("asked for")),
            &coordinates([&facet, &other]),
        );
    }
}
