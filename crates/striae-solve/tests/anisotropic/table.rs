//! Tables of friction, interpolated as the solver is to do it, by Hermite's basis.

/// Angles in degrees with a coefficient each.
pub type Table = &'static [[f64; 2]];

/// Nearly six times as much friction in one direction as in another.
pub const STRONG: Table = &[
    [-60.0, 0.08],
    [0.0, 0.4],
    [40.0, 0.16],
    [90.0, 0.07],
    [150.0, 0.2],
    [180.0, 0.13],
    [250.0, 0.3],
];

/// Coefficients at 24 angles.
pub const MEASURED: Table = &[
    [0.0, 0.42],
    [15.0, 0.40],
    [30.0, 0.35],
    [45.0, 0.33],
    [60.0, 0.25],
    [75.0, 0.18],
    [90.0, 0.20],
    [105.0, 0.24],
    [120.0, 0.24],
    [135.0, 0.27],
    [150.0, 0.31],
    [165.0, 0.29],
    [180.0, 0.26],
    [195.0, 0.21],
    [210.0, 0.17],
    [225.0, 0.16],
    [240.0, 0.12],
    [255.0, 0.14],
    [270.0, 0.19],
    [285.0, 0.27],
    [300.0, 0.28],
    [315.0, 0.34],
    [330.0, 0.41],
    [345.0, 0.44],
];

/// The coefficient at an angle: monotone between the points, with the slopes of
/// Fritsch & Butland (1984).
pub fn coefficient(table: Table, degrees: f64) -> f64 {
    let count = table.len();
    let first = table[0][0];
    let degrees = (degrees - first).rem_euclid(360.0) + first + 360.0;
    // Twice around, so that every point used has one before it.
    let point = |i: usize| {
        [
            table[i % count][0] + 360.0 * (i / count) as f64,
            table[i % count][1],
        ]
    };
    let secant = |i: usize| {
        let ([x, y], [x_1, y_1]) = (point(i), point(i + 1));
        (x_1 - x, (y_1 - y) / (x_1 - x))
    };
    let slope = |i: usize| {
        let ((h_0, s_0), (h, s)) = (secant(i - 1), secant(i));
        let alpha = (h_0 + 2.0 * h) / (3.0 * (h_0 + h));
        if s_0 * s > 0.0 {
            s_0 * s / (alpha * s + (1.0 - alpha) * s_0)
        } else {
            0.0
        }
    };
    let i = (count..2 * count)
        .rfind(|i| point(*i)[0] <= degrees)
        .unwrap();
    let ([x, y], [x_1, y_1]) = (point(i), point(i + 1));
    let (h, t) = (x_1 - x, (degrees - x) / (x_1 - x));
    let (square, cube) = (t * t, t * t * t);
    (2.0 * cube - 3.0 * square + 1.0) * y
        + (3.0 * square - 2.0 * cube) * y_1
        + (cube - 2.0 * square + t) * h * slope(i)
        + (cube - square) * h * slope(i + 1)
}
