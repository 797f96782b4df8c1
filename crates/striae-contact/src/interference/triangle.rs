//! A triangle: its point nearest to another point, and a point that passes through it.
//!
//! Nearest points after Ericson, *Real-Time Collision Detection* (2005), section 5.1.5.
//! Where all vertices and the point move in straight lines, the point passes the plane
//! of the triangle `a b c` at the roots of a cubic,
//!
//! ```text
//! f(t) = (x - a) . ((b - a) x (c - a)) = 0,   0 <= t <= 1
//! ```
//!
//! which is positive in front. The roots are bracketed by those of `f'` and halved down.

use striae_mesh::Vec3;

/// Part of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// A vertex.
    Vertex(usize),
    /// The edge from this vertex to the next one.
    Edge(usize),
    /// The inside.
    Inside,
}

/// Barycentric coordinates of the point of the triangle nearest to `x`, and where it is.
pub(super) fn nearest([a, b, c]: &[Vec3; 3], x: &Vec3) -> ([f64; 3], Part) {
    let (ab, ac) = (b - a, c - a);
    let [to_a, to_b, to_c] = [x - a, x - b, x - c];
    let [a1, a2] = [ab.dot(&to_a), ac.dot(&to_a)];
    if a1 <= 0.0 && a2 <= 0.0 {
        return ([1.0, 0.0, 0.0], Part::Vertex(0));
    }
    let [b1, b2] = [ab.dot(&to_b), ac.dot(&to_b)];
    if b1 >= 0.0 && b2 <= b1 {
        return ([0.0, 1.0, 0.0], Part::Vertex(1));
    }
    let [c1, c2] = [ab.dot(&to_c), ac.dot(&to_c)];
    if c2 >= 0.0 && c1 <= c2 {
        return ([0.0, 0.0, 1.0], Part::Vertex(2));
    }
    let of_c = a1 * b2 - b1 * a2;
    if of_c <= 0.0 && a1 >= 0.0 && b1 <= 0.0 {
        let s = a1 / (a1 - b1);
        return ([1.0 - s, s, 0.0], Part::Edge(0));
    }
    let of_b = c1 * a2 - a1 * c2;
    if of_b <= 0.0 && a2 >= 0.0 && c2 <= 0.0 {
        let s = a2 / (a2 - c2);
        return ([1.0 - s, 0.0, s], Part::Edge(2));
    }
    let of_a = b1 * c2 - c1 * b2;
    if of_a <= 0.0 && b2 >= b1 && c1 >= c2 {
        let s = (b2 - b1) / ((b2 - b1) + (c1 - c2));
        return ([0.0, 1.0 - s, s], Part::Edge(1));
    }
    let sum = of_a + of_b + of_c;
    ([of_a / sum, of_b / sum, of_c / sum], Part::Inside)
}

/// Direction in which a point passes through a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// From the front to the back.
    In,
    /// From the back to the front.
    Out,
}

/// Barycentric coordinates that count as inside the triangle.
const ROUND_OFF: f64 = 1e-9;

/// Times at which a point passes through a triangle, ascending. Points and vertices
/// are given at both ends of the motion.
pub(super) fn passages(x: &[Vec3; 2], vertices: &[[Vec3; 3]; 2]) -> Vec<(f64, Way)> {
    let at = |end: usize| {
        let [a, b, c] = &vertices[end];
        [x[end] - a, b - a, c - a]
    };
    let ([p0, u0, v0], [p1, u1, v1]) = (at(0), at(1));
    let (dp, du, dv) = (p1 - p0, u1 - u0, v1 - v0);
    let volume = |p: &Vec3, u: &Vec3, v: &Vec3| p.dot(&u.cross(v));
    let cubic = [
        volume(&p0, &u0, &v0),
        volume(&dp, &u0, &v0) + volume(&p0, &du, &v0) + volume(&p0, &u0, &dv),
        volume(&dp, &du, &v0) + volume(&dp, &u0, &dv) + volume(&p0, &du, &dv),
        volume(&dp, &du, &dv),
    ];
    sign_changes(&cubic)
        .into_iter()
        .filter(|&(t, _)| is_inside(&(p0 + dp * t), &(u0 + du * t), &(v0 + dv * t)))
        .collect()
}

/// Returns whether `p` lies over the triangle `0 u v`.
fn is_inside(p: &Vec3, u: &Vec3, v: &Vec3) -> bool {
    let n = u.cross(v);
    let twice_area = n.norm_squared();
    let [s, r] = [p.cross(v).dot(&n), u.cross(p).dot(&n)];
    let least = -ROUND_OFF * twice_area;
    s >= least && r >= least && s + r <= twice_area - least
}

/// Sign changes of `c0 + c1 t + c2 t^2 + c3 t^3` in `[0, 1]`.
fn sign_changes(c: &[f64; 4]) -> Vec<(f64, Way)> {
    let f = |t: f64| ((c[3] * t + c[2]) * t + c[1]) * t + c[0];
    let mut ends = vec![0.0];
    ends.extend(quadratic_roots(3.0 * c[3], 2.0 * c[2], c[1]));
    ends.push(1.0);
    let mut changes = Vec::new();
    for pair in ends.windows(2) {
        let (mut low, mut high) = (pair[0], pair[1]);
        let way = match (f(low) >= 0.0, f(high) >= 0.0) {
            (true, false) => Way::In,
            (false, true) => Way::Out,
            _ => continue,
        };
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if (f(middle) >= 0.0) == (way == Way::In) {
                low = middle;
            } else {
                high = middle;
            }
        }
        changes.push((0.5 * (low + high), way));
    }
    changes
}

/// Roots of `a t^2 + b t + c` inside `(0, 1)`, ascending.
fn quadratic_roots(a: f64, b: f64, c: f64) -> Vec<f64> {
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return Vec::new();
    }
    let q = -0.5 * (b + discriminant.sqrt().copysign(b));
    let mut roots: Vec<f64> = [q / a, c / q]
        .into_iter()
        .filter(|root| *root > 0.0 && *root < 1.0)
        .collect();
    roots.sort_unstable_by(f64::total_cmp);
    roots
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vectors<const N: usize>() -> impl Strategy<Value = [Vec3; N]> {
        prop::array::uniform::<_, N>([-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64])
            .prop_map(|all| all.map(Vec3::from))
    }

    proptest! {
        #[test]
        fn no_point_of_the_triangle_is_nearer(
            [a, b, c, x] in vectors::<4>(),
            samples in prop::collection::vec([0.0..1.0_f64, 0.0..1.0_f64], 40),
        ) {
            let (weights, part) = nearest(&[a, b, c], &x);
            let point = |[i, j, k]: [f64; 3]| a * i + b * j + c * k;
            let least = (point(weights) - x).norm();
            prop_assert!(weights.iter().all(|w| *w >= 0.0));
            prop_assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            let zeros = weights.iter().filter(|w| **w == 0.0).count();
            prop_assert_eq!(zeros, match part {
                Part::Vertex(_) => 2,
                Part::Edge(_) => 1,
                Part::Inside => 0,
            });
            for [s, r] in samples {
                let (s, r) = if s + r > 1.0 { (1.0 - s, 1.0 - r) } else { (s, r) };
                prop_assert!((point([1.0 - s - r, s, r]) - x).norm() > least - 1e-12);
            }
        }

        #[test]
        fn passages_are_found_by_fine_sampling(
            start in vectors::<4>(),
            end in vectors::<4>(),
        ) {
            let split = |[x, a, b, c]: [Vec3; 4]| (x, [a, b, c]);
            let ((x0, t0), (x1, t1)) = (split(start), split(end));
            let found = passages(&[x0, x1], &[t0, t1]);
            let volume = |t: f64| {
                let at = |p: &Vec3, q: &Vec3| p + (q - p) * t;
                let [a, b, c] = [0, 1, 2].map(|k: usize| at(&t0[k], &t1[k]));
                let (p, u, v) = (at(&x0, &x1) - a, b - a, c - a);
                (p.dot(&u.cross(&v)), is_inside(&p, &u, &v))
            };
            const STEPS: usize = 4000;
            for k in 0..STEPS {
                let [low, high] = [k, k + 1].map(|k| k as f64 / STEPS as f64);
                let ((f, inside), (g, still)) = (volume(low), volume(high));
                if (f >= 0.0) != (g >= 0.0) && inside && still {
                    let way = if f >= 0.0 { Way::In } else { Way::Out };
                    prop_assert!(found.iter().any(|(t, w)| *w == way && *t >= low && *t <= high));
                }
            }
        }
    }
}
