//! Stiffness of a cubic element with eight nodes, for tests.

/// Corners of the unit cube; bit `k` of the number is the coordinate along axis `k`.
pub fn corner(node: usize) -> [f64; 3] {
    [0, 1, 2].map(|axis| (node >> axis & 1) as f64)
}

/// Stiffness of an elastic unit cube of edge `h`, 24 by 24, by two quadrature points an axis.
pub fn cell(lambda: f64, shear: f64, h: f64) -> Vec<f64> {
    let mut stiffness = vec![0.0; 24 * 24];
    let places = [-1.0, 1.0].map(|sign| 0.5 + 0.5 * sign / 3.0_f64.sqrt());
    for point in 0..8 {
        let at = [0, 1, 2].map(|axis| places[point >> axis & 1]);
        let gradients: Vec<[f64; 3]> = (0..8).map(|node| gradient(node, at, h)).collect();
        let volume = h * h * h / 8.0;
        for (a, x) in gradients.iter().enumerate() {
            for (b, y) in gradients.iter().enumerate() {
                let dot: f64 = (0..3).map(|k| x[k] * y[k]).sum();
                for i in 0..3 {
                    for j in 0..3 {
                        let same = if i == j { dot } else { 0.0 };
                        let value = lambda * x[i] * y[j] + shear * (x[j] * y[i] + same);
                        stiffness[(3 * a + i) * 24 + 3 * b + j] += volume * value;
                    }
                }
            }
        }
    }
    stiffness
}

/// Gradient of a node's shape function.
fn gradient(node: usize, at: [f64; 3], h: f64) -> [f64; 3] {
    let side = corner(node);
    let factor = |k: usize| if side[k] > 0.5 { at[k] } else { 1.0 - at[k] };
    [0, 1, 2].map(|axis| {
        let slope = if side[axis] > 0.5 { 1.0 } else { -1.0 };
        let others = (0..3).filter(|&k| k != axis).map(factor);
        slope * others.product::<f64>() / h
    })
}
