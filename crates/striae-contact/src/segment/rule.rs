//! Symmetric quadrature rules on a triangle.
//!
//! Degree 5 with 7 points: Radon, Monatsh. Math. 52 (1948). Degrees 6 and 8 with 12 and 16 points:
//! Dunavant, Int. J. Numer. Methods Eng. 21 (1985), doi:10.1002/nme.1620210612, table II, solved
//! again to all digits. They treat the corners of the triangle alike, so that a sum does not depend
//! on where a list of corners starts.

/// Barycentric coordinates of a point and its weight; weights sum to one.
pub(super) type Point = ([f64; 3], f64);

/// Exact to degree five.
pub(super) static DEGREE_5: [Point; 7] = orbits(
    &[0.225],
    &[
        [0.101_286_507_323_456_34, 0.125_939_180_544_827_15],
        [0.470_142_064_105_115_1, 0.132_394_152_788_506_2],
    ],
    &[],
);

/// Exact to degree six.
pub(super) static DEGREE_6: [Point; 12] = orbits(
    &[],
    &[
        [0.249_286_745_170_910_42, 0.116_786_275_726_379_37],
        [0.063_089_014_491_502_23, 0.050_844_906_370_206_82],
    ],
    &[[
        0.053_145_049_844_816_95,
        0.310_352_451_033_784_4,
        0.082_851_075_618_373_58,
    ]],
);

/// Exact to degree eight.
pub(super) static DEGREE_8: [Point; 16] = orbits(
    &[0.144_315_607_677_787_17],
    &[
        [0.459_292_588_292_723_2, 0.095_091_634_267_284_62],
        [0.170_569_307_751_760_2, 0.103_217_370_534_718_25],
        [0.050_547_228_317_030_98, 0.032_458_497_623_198_08],
    ],
    &[[
        0.008_394_777_409_957_605,
        0.263_112_829_634_638_1,
        0.027_230_314_174_434_994,
    ]],
);

/// Exact to degree five, with points at the corners: Chin-Joe-Kong, Mulder & van Veldhuizen, J.
/// Eng. Math. 35 (1999), doi:10.1023/A:1004420829610, solved again to all digits.
pub(super) static VERTEX_5: [Point; 12] = orbits(
    &[],
    &[
        [0.0, 0.014_872_913_024_820_582],
        [0.207_345_175_663_590_93, 0.220_777_057_840_410_74],
    ],
    &[[0.0, 0.293_469_555_909_040_2, 0.048_841_681_234_051_007]],
);

/// The points of a rule from the weight of the centre, points `(1 - 2a, a, a)` as
/// `[a, weight]` and points `(a, b, 1 - a - b)` as `[a, b, weight]`, in all orders.
const fn orbits<const N: usize>(
    centre: &[f64],
    threes: &[[f64; 2]],
    sixes: &[[f64; 3]],
) -> [Point; N] {
    let mut points = [([1.0 / 3.0; 3], 0.0); N];
    let mut count = centre.len();
    if count == 1 {
        points[0].1 = centre[0];
    }
    let mut orbit = 0;
    while orbit < threes.len() {
        let [a, weight] = threes[orbit];
        let mut lone = 0;
        while lone < 3 {
            let mut place = [a; 3];
            place[lone] = 1.0 - 2.0 * a;
            points[count] = (place, weight);
            count += 1;
            lone += 1;
        }
        orbit += 1;
    }
    orbit = 0;
    while orbit < sixes.len() {
        let [a, b, weight] = sixes[orbit];
        let mut first = 0;
        while first < 3 {
            let mut step = 1;
            while step < 3 {
                let mut place = [1.0 - a - b; 3];
                place[first] = a;
                place[(first + step) % 3] = b;
                points[count] = (place, weight);
                count += 1;
                step += 1;
            }
            first += 1;
        }
        orbit += 1;
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_exact(rule: &[Point], degree: i32) {
        let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
        for i in 0..=degree {
            for j in 0..=degree - i {
                let terms = rule.iter().map(|([_, u, v], w)| w * u.powi(i) * v.powi(j));
                let exact = 2.0 * factorial(i) * factorial(j) / factorial(i + j + 2);
                let sum: f64 = terms.sum();
                assert!((sum - exact).abs() < 4e-16, "u^{i} v^{j}: {sum} {exact}");
            }
        }
    }

    #[test]
    fn rules_are_exact_to_their_degree() {
        assert_exact(&DEGREE_5, 5);
        assert_exact(&VERTEX_5, 5);
        assert_exact(&DEGREE_6, 6);
        assert_exact(&DEGREE_8, 8);
    }
}
