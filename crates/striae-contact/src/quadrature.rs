//! Gauss rules.

/// `(point, weight)` of the two-point rule on `[-1, 1]`.
pub const GAUSS_2: [(f64, f64); 2] = [
    (-0.577_350_269_189_625_8, 1.0),
    (0.577_350_269_189_625_8, 1.0),
];

/// `(point, weight)` of the four-point rule on `[0, 1]`.
const GAUSS_4: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Barycentric coordinates of the second and third corner and weights, summing
/// to one, of the collapsed 4x4 rule on a triangle; exact to degree six.
pub fn collapsed_triangle() -> [([f64; 2], f64); 16] {
    std::array::from_fn(|index| {
        let (s, ws) = GAUSS_4[index / 4];
        let (r, wr) = GAUSS_4[index % 4];
        ([s, r * (1.0 - s)], 2.0 * ws * wr * (1.0 - s))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn collapsed_rule_is_exact_to_degree_six() {
        let factorial = |n: u32| (1..=n).map(f64::from).product::<f64>();
        for i in 0..=6_u32 {
            for j in 0..=6 - i {
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
