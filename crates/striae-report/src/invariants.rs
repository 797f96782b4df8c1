//! Scalars derived from a vector or a tensor for display, and their extremes.
//!
//! Principal values `s_1 >= s_2 >= s_3` of a symmetric tensor come from the trigonometric
//! solution of its characteristic equation: with `m = tr S/3`, `D = S - m I`,
//! `J = D:D/2`, `cos 3t = det D/2 (3/J)^(3/2)`: `s_k = m + 2 sqrt(J/3) cos(t - 2 pi k/3)`.

/// Views of an array with so many numbers a point, the first of which is shown at first.
pub fn views(components: usize) -> &'static [&'static str] {
    match components {
        3 => &["magnitude", "x", "y", "z"],
        6 => &[
            "von Mises",
            "largest principal",
            "middle principal",
            "least principal",
            "mean",
            "xx",
            "yy",
            "zz",
            "xy",
            "yz",
            "xz",
        ],
        9 => &[
            "magnitude",
            "xx",
            "xy",
            "xz",
            "yx",
            "yy",
            "yz",
            "zx",
            "zy",
            "zz",
        ],
        _ => &["value"],
    }
}

/// The values of all views of an array at a point.
pub fn shown(numbers: &[f64], out: &mut [f64]) {
    match numbers.len() {
        3 | 9 => {
            out[0] = numbers.iter().map(|v| v * v).sum::<f64>().sqrt();
            out[1..].copy_from_slice(numbers);
        }
        6 => {
            out[..5].copy_from_slice(&stress(numbers));
            out[5..].copy_from_slice(numbers);
        }
        _ => out[0] = numbers[0],
    }
}

/// Von Mises' equivalent, principal values in falling order and the mean of
/// `xx yy zz xy yz xz`.
fn stress(s: &[f64]) -> [f64; 5] {
    let mean = (s[0] + s[1] + s[2]) / 3.0;
    let d = [s[0] - mean, s[1] - mean, s[2] - mean];
    let shear = s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
    let j = 0.5 * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) + shear;
    let det = d[0] * (d[1] * d[2] - s[4] * s[4]) - s[3] * (s[3] * d[2] - s[4] * s[5])
        + s[5] * (s[3] * s[4] - d[1] * s[5]);
    let radius = (j / 3.0).sqrt();
    let cosine = if radius > 0.0 {
        (0.5 * det / (radius * radius * radius)).clamp(-1.0, 1.0)
    } else {
        0.0
    };
    let angle = cosine.acos() / 3.0;
    let third = std::f64::consts::TAU / 3.0;
    let principal = |turn: f64| mean + 2.0 * radius * turn.cos();
    let all = [
        principal(angle),
        principal(angle - third),
        principal(angle + third),
    ];
    [(3.0 * j).sqrt(), all[0], all[1], all[2], mean]
}

/// Least and largest value of every view; `None` of a view without finite values.
pub fn extremes(components: usize, numbers: &[f64]) -> Vec<Option<[f64; 2]>> {
    let count = views(components).len();
    let mut out = vec![0.0; count];
    let mut found = vec![[f64::INFINITY, f64::NEG_INFINITY]; count];
    for point in numbers.chunks_exact(components) {
        shown(point, &mut out);
        for (value, extreme) in out.iter().zip(&mut found) {
            if value.is_finite() {
                extreme[0] = extreme[0].min(*value);
                extreme[1] = extreme[1].max(*value);
            }
        }
    }
    found
        .into_iter()
        .map(|extreme| (extreme[0] <= extreme[1]).then_some(extreme))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix3;

    #[test]
    fn principal_values_are_eigenvalues() {
        for s in [
            [3.0, -1.0, 2.0, 0.5, -0.7, 1.1],
            [1.0, 1.0, 1.0, 0.0, 0.0, 0.0],
            [2.0, 2.0, -1.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
            [0.0; 6],
        ] {
            let m = Matrix3::new(s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]);
            let mut expected: Vec<f64> = m.symmetric_eigenvalues().iter().copied().collect();
            expected.sort_by(|a, b| b.total_cmp(a));
            let found = stress(&s);
            for (a, b) in expected.iter().zip(&found[1..4]) {
                assert!((a - b).abs() < 1e-7, "{expected:?} {found:?}");
            }
            let differences = [0, 1, 2].map(|i| expected[i] - expected[(i + 1) % 3]);
            let equivalent = (0.5 * differences.iter().map(|d| d * d).sum::<f64>()).sqrt();
            assert!((equivalent - found[0]).abs() < 1e-7);
        }
    }

    #[test]
    fn extremes_leave_out_what_is_no_number() {
        let numbers = [3.0, 4.0, 0.0, f64::NAN, 0.0, 0.0, 0.0, 0.0, -2.0];
        let found = extremes(3, &numbers);
        assert_eq!(found[0], Some([2.0, 5.0]));
        assert_eq!(found[1], Some([0.0, 3.0]));
        assert_eq!(extremes(1, &[f64::NAN]), [None]);
    }
}
