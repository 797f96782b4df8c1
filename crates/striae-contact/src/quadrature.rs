//! Gauss rules.

/// `(point, weight)` of the two-point rule on `[-1, 1]`.
pub const GAUSS_2: [(f64, f64); 2] = [
    (-0.577_350_269_189_625_8, 1.0),
    (0.577_350_269_189_625_8, 1.0),
];

/// `(point, weight)` of the five-point rule on `[0, 1]`.
const GAUSS_5: [(f64, f64); 5] = [
    (0.046_910_077_030_668_004, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_23),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_6, 0.239_314_335_249_683_23),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];

/// Barycentric coordinates of the second and third corner and weights, summing
/// to one, of the collapsed 5x5 rule on a triangle; exact to degree eight.
pub fn collapsed_triangle() -> [([f64; 2], f64); 25] {
    std::array::from_fn(|index| {
        let (s, ws) = GAUSS_5[index / 5];
        let (r, wr) = GAUSS_5[index % 5];
        ([s, r * (1.0 - s)], 2.0 * ws * wr * (1.0 - s))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn collapsed_rule_is_exact_to_degree_eight() {
        let factorial = |n: u32| (1..=n).map(f64::from).product::<f64>();
        for i in 0..=8_u32 {
            for j in 0..=8 - i {
                let sum: f64 = collapsed_triangle()
                    .iter()
                    .map(|([u, v], w)| w * u.powi(i as i32) * v.powi(j as i32))
                    .sum();
                let exact = 2.0 * factorial(i) * factorial(j) / factorial(i + j + 2);
                assert!((sum - exact).abs() < 1e-15, "u^{i} v^{j}: {sum} {exact}");
            }
        }
    }
}
