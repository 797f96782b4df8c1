//! Vectors and rotations in space.

/// A point or a vector.
pub type Vector = [f64; 3];

/// Rows of a matrix.
pub type Matrix = [Vector; 3];

/// `a + b`.
pub fn plus(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// `a - b`.
pub fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `f a`.
pub fn times(f: f64, a: Vector) -> Vector {
    a.map(|x| f * x)
}

/// `a . b`.
pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `a x b`.
pub fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// `|a|`.
pub fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// `a/|a|`, or zero.
pub fn unit(a: Vector) -> Vector {
    let length = length(a);
    if length > 0.0 {
        times(1.0 / length, a)
    } else {
        a
    }
}

/// The mean of several points.
pub fn mean(points: &[Vector]) -> Vector {
    let sum = points.iter().copied().fold([0.0; 3], plus);
    times(1.0 / points.len() as f64, sum)
}

/// `M a`.
pub fn applied(m: &Matrix, a: Vector) -> Vector {
    m.map(|row| dot(row, a))
}

/// The transpose.
pub fn transposed(m: &Matrix) -> Matrix {
    [0, 1, 2].map(|i| [m[0][i], m[1][i], m[2][i]])
}

/// `A B`.
pub fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let columns = transposed(b);
    a.map(|row| columns.map(|column| dot(row, column)))
}

/// The determinant.
pub fn determinant(m: &Matrix) -> f64 {
    dot(m[0], cross(m[1], m[2]))
}

/// The solution of `M x = b`, where there is one.
pub fn solved(m: &Matrix, b: Vector) -> Option<Vector> {
    let [c0, c1, c2] = transposed(m);
    let d = determinant(m);
    let x = [
        dot(b, cross(c1, c2)) / d,
        dot(c0, cross(b, c2)) / d,
        dot(c0, cross(c1, b)) / d,
    ];
    x.iter().all(|x| x.is_finite()).then_some(x)
}

/// The rotation about an axis by an angle in radians (Rodrigues' formula).
pub fn rotation(axis: Vector, angle: f64) -> Matrix {
    let k = unit(axis);
    let (s, c) = angle.sin_cos();
    let turned = |v: Vector| {
        let along = times(dot(k, v) * (1.0 - c), k);
        plus(plus(times(c, v), times(s, cross(k, v))), along)
    };
    let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(turned);
    transposed(&columns)
}

/// Axis and angle in radians of a rotation.
pub fn axis_and_angle(m: &Matrix) -> (Vector, f64) {
    let skew = [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]];
    let sine = 0.5 * length(skew);
    let cosine = 0.5 * (m[0][0] + m[1][1] + m[2][2] - 1.0);
    if sine > 1e-9 {
        (unit(skew), sine.atan2(cosine))
    } else if cosine > 0.0 {
        ([0.0, 0.0, 1.0], 0.0)
    } else {
        // A half turn: M = 2 k k^T - I.
        let largest = (0..3).fold(0, |best, i| if m[i][i] > m[best][best] { i } else { best });
        let mut column = transposed(m)[largest];
        column[largest] += 1.0;
        (unit(column), std::f64::consts::PI)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axis_and_angle_belong_to_the_rotation() {
        for angle in [0.0, 1e-3, 1.0, 3.0, std::f64::consts::PI] {
            let m = rotation([1.0, -2.0, 0.5], angle);
            let (axis, found) = axis_and_angle(&m);
            let again = rotation(axis, found);
            for i in 0..3 {
                assert!(length(minus(m[i], again[i])) < 1e-8, "{angle}");
            }
        }
    }

    #[test]
    fn systems_are_solved() {
        let m = [[2.0, 1.0, 0.0], [0.0, 3.0, 1.0], [1.0, 0.0, 4.0]];
        let x = solved(&m, applied(&m, [1.0, -2.0, 3.0])).unwrap();
        assert!(length(minus(x, [1.0, -2.0, 3.0])) < 1e-12);
        assert_eq!(solved(&[[0.0; 3]; 3], [1.0; 3]), None);
    }
}
