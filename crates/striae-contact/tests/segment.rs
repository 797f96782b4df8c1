//! Values of segments: areas, integrals, invariances.

mod facets;

use facets::{facet, flat_pair, mirrored, moved, parallelogram, random_quad, scaled, triangle};
use nalgebra::Rotation3;
use striae_contact::segment::{Derivatives, Facet, Segment, pair_index, plane_segment, segment};
use striae_mesh::Vec3;
use striae_surface::facet::Shape;
use striae_verify::Random;

fn values(a: &Facet, b: &Facet) -> Option<Segment> {
    segment(a, b, [1.0, 0.4], Derivatives::None)
}

fn largest_difference(one: &[[f64; 8]; 8], other: &[[f64; 8]; 8]) -> f64 {
    let pairs = one.iter().flatten().zip(other.iter().flatten());
    pairs.map(|(u, v)| (u - v).abs()).fold(0.0, f64::max)
}

#[test]
fn pairs_are_packed_row_by_row() {
    let mut expected = 0;
    for c in 0..8 {
        for d in c..8 {
            assert_eq!((pair_index(c, d), pair_index(d, c)), (expected, expected));
            expected += 1;
        }
    }
}

#[test]
fn two_offset_rectangles_have_the_closed_form() {
    // On [.25, 1] x [.5, 1] with the facets [0, 1]^2 and [.25, 1.25] x [.5, 1.5].
    let a = facet(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], 0.0);
    let b = facet(&[[0.25, 0.5], [0.25, 1.5], [1.25, 1.5], [1.25, 0.5]], 0.01);
    let found = values(&a, &b).expect("they overlap");
    assert!((found.normal - Vec3::z()).norm() < 1e-15);
    assert!((found.area - 0.375).abs() < 1e-15);
    type Linear = fn(f64) -> f64;
    let (one, zero): (Linear, Linear) = (|s| s, |s| 1.0 - s);
    let by_x: [Linear; 2] = [one, |x| x - 0.25];
    let by_y: [Linear; 2] = [one, |y| y - 0.5];
    // Corner signs of x and y.
    let a_corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
    let b_corners = [[0, 0], [0, 1], [1, 1], [1, 0]];
    let factor = |function: usize, axis: usize, at: f64| {
        let (side, corner) = (function / 4, function % 4);
        let s = [by_x, by_y][axis][side](at);
        let up = [a_corners, b_corners][side][corner][axis];
        [zero, one][up](s)
    };
    let simpson = |c: usize, d: usize, axis: usize, from: f64, to: f64| {
        let f = |at: f64| factor(c, axis, at) * factor(d, axis, at);
        (to - from) / 6.0 * (f(from) + 4.0 * f(0.5 * (from + to)) + f(to))
    };
    for c in 0..8 {
        for d in 0..8 {
            let exact = simpson(c, d, 0, 0.25, 1.0) * simpson(c, d, 1, 0.5, 1.0);
            assert!((found.mass[c][d] - exact).abs() < 1e-16, "{c} {d}");
        }
    }
}

#[test]
fn facets_of_a_mesh_partition_an_opposing_facet() {
    let mut random = Random::new(1);
    for trial in 0..40 {
        let flush = trial % 4;
        let a = match trial % 2 {
            0 => facet(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], 0.0),
            _ => facet(&[[0.0, 0.0], [1.0, 0.1], [1.2, 1.2], [-0.1, 0.9]], 0.0),
        };
        // A mesh of 5 x 5 over [-.5, 2]^2: lines at multiples of 1/2 for flush ones.
        let amount = if flush < 2 { 0.0 } else { 0.15 };
        let mut nodes = [[Vec3::zeros(); 6]; 6];
        for (i, row) in nodes.iter_mut().enumerate() {
            for (j, node) in row.iter_mut().enumerate() {
                let inner = (1..5).contains(&i) && (1..5).contains(&j);
                let shift = random.vector3() * if inner { amount } else { 0.0 };
                let place = [i, j].map(|at| at as f64 * 0.5 - 0.5);
                *node = Vec3::new(place[0] + shift.x, place[1] + shift.y, 0.0);
            }
        }
        let motion = random.rotation();
        let a = moved(&a, &motion, &Vec3::zeros());
        let mut area = 0.0;
        let mut by_function = [0.0; 4];
        for i in 0..5 {
            for j in 0..5 {
                let corners = [
                    nodes[i][j],
                    nodes[i][j + 1],
                    nodes[i + 1][j + 1],
                    nodes[i + 1][j],
                ];
                let quad = Facet {
                    corners,
                    shape: Shape::Quadrilateral,
                };
                let parts = if trial % 3 == 0 {
                    vec![triangle(&corners, [0, 1, 2]), triangle(&corners, [0, 2, 3])]
                } else {
                    vec![quad]
                };
                for part in parts {
                    let part = moved(&part, &motion, &Vec3::zeros());
                    let Some(found) = values(&a, &part) else {
                        continue;
                    };
                    area += found.area;
                    for c in 0..4 {
                        by_function[c] += found.mass[c][..4].iter().sum::<f64>();
                    }
                }
            }
        }
        let diagonals = [a.corners[2] - a.corners[0], a.corners[3] - a.corners[1]];
        let exact = 0.5 * diagonals[0].cross(&diagonals[1]).norm();
        assert!((area - exact).abs() < 1e-12, "{trial}: {area} {exact}");
        let sum: f64 = by_function.iter().sum();
        assert!((sum - exact).abs() < 1e-12, "{trial}: {sum} {exact}");
    }
}

#[test]
fn areas_and_integrals_agree_with_brute_force() {
    let mut random = Random::new(2);
    for _ in 0..6 {
        let (a, b) = flat_pair(&mut random);
        let Some(found) = values(&a, &b) else {
            continue;
        };
        // Midpoints of a grid in the coordinates of a, kept where they lie in b.
        let count = 600;
        let mut area = 0.0;
        let mut mass = [[0.0; 4]; 4];
        for i in 0..count * count {
            let [xi, eta] =
                [i / count, i % count].map(|at| (at as f64 + 0.5) * 2.0 / count as f64 - 1.0);
            let weights = Shape::Quadrilateral.weights(xi, eta);
            let x: Vec3 = (0..4).map(|c| a.corners[c] * weights.value[c]).sum();
            let inside = (0..4).all(|c| {
                let (from, to) = (b.corners[c], b.corners[(c + 1) % 4]);
                (to - from).cross(&(x - from)).z < 0.0
            });
            if !inside {
                continue;
            }
            let sum = |d: &[f64; 4]| -> Vec3 { (0..4).map(|c| a.corners[c] * d[c]).sum() };
            let weight =
                sum(&weights.d_xi).cross(&sum(&weights.d_eta)).z * 4.0 / (count * count) as f64;
            area += weight;
            for c in 0..4 {
                for d in 0..4 {
                    mass[c][d] += weight * weights.value[c] * weights.value[d];
                }
            }
        }
        assert!((found.area - area).abs() < 2e-4, "{} {area}", found.area);
        for c in 0..4 {
            for d in 0..4 {
                assert!((found.mass[c][d] - mass[c][d]).abs() < 1e-4);
            }
        }
    }
}

#[test]
fn the_error_of_quadrature_is_small_on_distorted_facets() {
    // Cut along a triangle mesh of b's outline: finer parts, the same functions of a.
    let mut random = Random::new(3);
    for (offset, allowed) in [
        (4e-7, 1e-13),
        (0.01, 1e-9),
        (0.02, 1e-9),
        (0.1, 1e-8),
        (0.3, 1e-5),
    ] {
        let mut worst = 0.0_f64;
        for _ in 0..10 {
            let a = random_quad(&mut random, offset, 0.0);
            let b = facet(&[[0.1, 0.2], [0.2, 3.2], [3.3, 3.5], [3.2, 0.5]], 0.0);
            let whole = values(&a, &b).expect("they overlap");
            let mut fine = [[0.0; 8]; 8];
            let count = 24;
            let at = |i: usize, j: usize| {
                let [xi, eta] = [i, j].map(|at| at as f64 * 2.0 / f64::from(count) - 1.0);
                let w = Shape::Quadrilateral.weights(xi, eta).value;
                (0..4).map(|c| b.corners[c] * w[c]).sum::<Vec3>()
            };
            for i in 0..count as usize {
                for j in 0..count as usize {
                    let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                    let part = Facet {
                        corners,
                        shape: Shape::Quadrilateral,
                    };
                    let Some(found) = values(&a, &part) else {
                        continue;
                    };
                    for c in 0..4 {
                        (0..4).for_each(|d| fine[c][d] += found.mass[c][d]);
                    }
                }
            }
            for c in 0..4 {
                for d in 0..4 {
                    worst = worst.max((fine[c][d] - whole.mass[c][d]).abs() / whole.area);
                }
            }
        }
        println!("{offset}: {worst:.2e}");
        assert!(worst < allowed, "{offset}: {worst}");
    }
}

#[test]
fn rows_sum_to_the_integrals_of_the_functions() {
    let mut random = Random::new(4);
    for _ in 0..50 {
        let a = random_quad(&mut random, 0.2, 0.1);
        let b = mirrored(&random_quad(&mut random, 0.2, 0.1), 0.3);
        let Some(found) = values(&a, &b) else {
            continue;
        };
        for c in 0..8 {
            let sums = [0, 4].map(|from| found.mass[c][from..from + 4].iter().sum::<f64>());
            assert!((sums[0] - sums[1]).abs() < 1e-15);
        }
        let all: f64 = found.mass.iter().flatten().sum();
        assert!((all - 4.0 * found.area).abs() < 1e-14);
    }
}

#[test]
fn sides_scale_and_frame_do_not_matter() {
    let mut random = Random::new(5);
    let mut seen = 0;
    for trial in 0..60 {
        let offset = [0.0, 0.05, 0.3][trial % 3];
        let a = random_quad(&mut random, offset, 0.5 * offset);
        let mut b = mirrored(&random_quad(&mut random, offset, 0.5 * offset), 0.4);
        if trial % 4 == 0 {
            b = triangle(&b.corners, [0, 1, 2]);
        }
        let compliance = [1.0, [0.0, 0.3, 2.0][trial % 3]];
        let Some(found) = segment(&a, &b, compliance, Derivatives::None) else {
            continue;
        };
        seen += 1;
        let [c_a, c_b] = compliance;
        let swapped = segment(&b, &a, [c_b, c_a], Derivatives::None).expect("as before");
        assert!((swapped.normal + found.normal).norm() < 1e-15);
        let permuted = std::array::from_fn(|c| {
            std::array::from_fn(|d| swapped.mass[(c + 4) % 8][(d + 4) % 8])
        });
        assert!(largest_difference(&permuted, &found.mass) < 1e-15);
        let (rotation, shift) = (random.rotation(), random.vector3());
        let [a_moved, b_moved] = [&a, &b].map(|f| moved(f, &rotation, &shift));
        let turned = segment(&a_moved, &b_moved, compliance, Derivatives::None).expect("as before");
        assert!((turned.normal - rotation * found.normal).norm() < 1e-14);
        assert!(largest_difference(&turned.mass, &found.mass) < 1e-14);
        for scale in [1e-6, 1e6] {
            let [a, b] = [&a, &b].map(|f| scaled(f, scale));
            let other = segment(&a, &b, compliance, Derivatives::None).expect("as before");
            let mass = other
                .mass
                .map(|row| row.map(|value| value / (scale * scale)));
            assert!(largest_difference(&mass, &found.mass) < 1e-14);
        }
    }
    assert!(seen > 40, "{seen}");
}

#[test]
fn flush_and_coinciding_outlines_are_clipped_whole() {
    let mut random = Random::new(6);
    for trial in 0..100 {
        let a = random_quad(&mut random, 0.2, 0.0);
        let noise = [0.0, 1e-15, 1e-9, 1e-7][trial % 4];
        // The same outline, and halves of it that end on its edges.
        let jitter = |x: Vec3, random: &mut Random| x + random.vector3() * noise;
        let same = [0, 3, 2, 1].map(|c| jitter(a.corners[c], &mut random));
        let same = Facet {
            corners: same,
            shape: Shape::Quadrilateral,
        };
        let whole = values(&a, &same).expect("they coincide");
        assert!((whole.area - a_area(&a)).abs() < 8.0 * noise + 1e-14);
        let share = random.uniform(0.1, 0.9);
        let on = |c: usize, d: usize| a.corners[c] + (a.corners[d] - a.corners[c]) * share;
        let halves = [
            [a.corners[0], a.corners[3], on(3, 2), on(0, 1)],
            [on(0, 1), on(3, 2), a.corners[2], a.corners[1]],
        ];
        let areas = halves.map(|half| {
            let corners = half.map(|x| jitter(x, &mut random));
            let half = Facet {
                corners,
                shape: Shape::Quadrilateral,
            };
            values(&a, &half).expect("they overlap").area
        });
        assert!((areas[0] + areas[1] - whole.area).abs() < 40.0 * noise + 1e-14);
    }
}

fn a_area(a: &Facet) -> f64 {
    0.5 * (a.corners[2] - a.corners[0])
        .cross(&(a.corners[3] - a.corners[1]))
        .norm()
}

#[test]
fn facets_beside_each_other_or_facing_away_have_no_segment() {
    let a = facet(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], 0.0);
    let up = facet(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], 0.1);
    let beside = facet(&[[1.0, 0.0], [1.0, 1.0], [2.0, 1.0], [2.0, 0.0]], 0.0);
    let touching = facet(&[[1.0, 1.0], [1.0, 2.0], [2.0, 2.0], [2.0, 1.0]], 0.0);
    for other in [&up, &beside, &touching] {
        assert!(values(&a, other).is_none());
    }
    assert!(segment(&a, &beside, [0.0, 0.0], Derivatives::None).is_none());
}

#[test]
fn warped_and_broken_facets_give_nothing_or_numbers() {
    let mut random = Random::new(7);
    let mut nothing = 0;
    for trial in 0..20_000 {
        let spread = [0.5, 1.5, 4.0][trial % 3];
        let mut a = random_quad(&mut random, spread, 0.3 * spread);
        let b = mirrored(&random_quad(&mut random, spread, 0.3 * spread), spread);
        match trial % 50 {
            0 => a.corners[1] = a.corners[2],
            1 => a.corners[3] = a.corners[1],
            2 => a.corners[1] = (a.corners[0] + a.corners[2]) * 0.5,
            3 => a.corners[0].x = f64::NAN,
            4 => a.corners = [a.corners[0]; 4],
            _ => {}
        }
        let Some(found) = segment(&a, &b, [1.0, 1.0], Derivatives::First) else {
            nothing += 1;
            continue;
        };
        let slopes = found.slopes.expect("asked for");
        assert!(found.area > 0.0 && found.mass.iter().flatten().all(|v| v.is_finite()));
        assert!(slopes.mass.iter().flatten().all(|v| v.is_finite()));
        assert!(found.area < 1.001 * a_area(&a).min(a_area(&b)) / 0.19);
    }
    assert!((1000..19_000).contains(&nothing), "{nothing}");
}

#[test]
fn a_plane_sees_the_projected_facet() {
    let normal = Vec3::new(0.1, -0.2, -1.0).normalize();
    let quad = facet(&[[0.0, 0.0], [1.0, 0.1], [1.2, 1.2], [-0.1, 0.9]], 0.0);
    let found = plane_segment(&quad, &normal, Derivatives::None).expect("they face");
    assert!((found.normal + normal).norm() < 1e-15);
    assert!((found.area - a_area(&quad) * -normal.z).abs() < 1e-15);
    // The same by a segment with a rigid facet that covers it.
    let along = Rotation3::rotation_between(&-Vec3::z(), &normal).expect("not opposite");
    let big = facet(&[[-9.0, -9.0], [-9.0, 9.0], [9.0, 9.0], [9.0, -9.0]], 0.0);
    let big = moved(&big, &along, &Vec3::zeros());
    for quad in [quad, triangle(&quad.corners, [0, 1, 2]), parallelogram()] {
        let found = plane_segment(&quad, &normal, Derivatives::None).expect("they face");
        let covered = segment(&quad, &big, [1.0, 0.0], Derivatives::None).expect("they face");
        assert!((covered.normal + normal).norm() < 1e-14);
        assert!((covered.area - found.area).abs() < 1e-13);
        for c in 0..4 {
            for d in 0..4 {
                let difference = (covered.mass[c][d] - found.mass[c][d]).abs();
                assert!(difference < 1e-6, "{difference}");
            }
        }
    }
    assert!(plane_segment(&quad, &-normal, Derivatives::None).is_none());
}
