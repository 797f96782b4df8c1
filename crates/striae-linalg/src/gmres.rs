//! One cycle of right-preconditioned GMRES (Saad & Schultz, doi:10.1137/0907058).

/// Result of a cycle.
pub(crate) struct Correction {
    pub(crate) solution: Vec<f64>,
    pub(crate) iterations: usize,
}

/// When a cycle ends.
#[derive(Clone, Copy)]
pub(crate) struct Ends {
    /// Number of iterations.
    pub(crate) iterations: usize,
    /// Size of the residual over that of the right-hand side.
    pub(crate) reduction: f64,
}

/// Approximate solution of `A x = b` in the Krylov space of `A M^-1` from zero.
pub(crate) fn solve(
    multiply: &dyn Fn(&[f64], &mut [f64]),
    precondition: &dyn Fn(&mut [f64]),
    b: &[f64],
    ends: Ends,
) -> Correction {
    let n = b.len();
    let size = norm(b);
    if size == 0.0 || !size.is_finite() {
        return Correction {
            solution: vec![0.0; n],
            iterations: 0,
        };
    }
    let mut basis = vec![b.iter().map(|b| b / size).collect::<Vec<f64>>()];
    let mut hessenberg: Vec<Vec<f64>> = Vec::new();
    let mut rotations: Vec<(f64, f64)> = Vec::new();
    let mut residual = vec![size];
    for k in 0..ends.iterations.min(n) {
        let mut direction = basis[k].clone();
        precondition(&mut direction);
        let mut image = vec![0.0; n];
        multiply(&direction, &mut image);
        let mut column = orthogonalise(&mut image, &basis);
        let length = norm(&image);
        if !length.is_finite() {
            break;
        }
        residual.push(0.0);
        for (i, &(c, s)) in rotations.iter().enumerate() {
            rotate(&mut column, i, c, s);
        }
        let radius = column[k].hypot(length);
        if radius == 0.0 {
            residual.pop();
            break;
        }
        let (c, s) = (column[k] / radius, length / radius);
        column[k] = radius;
        rotations.push((c, s));
        hessenberg.push(column);
        rotate(&mut residual, k, c, s);
        if length == 0.0 || residual[k + 1].abs() <= ends.reduction * size {
            break;
        }
        basis.push(image.iter().map(|v| v / length).collect());
    }
    let mut solution = combination(&basis, &hessenberg, &residual, n);
    precondition(&mut solution);
    Correction {
        solution,
        iterations: hessenberg.len(),
    }
}

/// Coefficients on the basis, which are taken off the vector (twice, for stability).
fn orthogonalise(vector: &mut [f64], basis: &[Vec<f64>]) -> Vec<f64> {
    let mut coefficients = vec![0.0; basis.len()];
    for _ in 0..2 {
        for (coefficient, q) in coefficients.iter_mut().zip(basis) {
            let h: f64 = vector.iter().zip(q).map(|(v, q)| v * q).sum();
            vector.iter_mut().zip(q).for_each(|(v, q)| *v -= h * q);
            *coefficient += h;
        }
    }
    coefficients
}

/// Givens rotation of entries `i` and `i + 1`.
fn rotate(v: &mut [f64], i: usize, c: f64, s: f64) {
    (v[i], v[i + 1]) = (c * v[i] + s * v[i + 1], c * v[i + 1] - s * v[i]);
}

/// Basis times the solution of the triangular system.
fn combination(
    basis: &[Vec<f64>],
    hessenberg: &[Vec<f64>],
    residual: &[f64],
    n: usize,
) -> Vec<f64> {
    let mut y = residual[..hessenberg.len()].to_vec();
    for k in (0..y.len()).rev() {
        y[k] /= hessenberg[k][k];
        for i in 0..k {
            y[i] -= hessenberg[k][i] * y[k];
        }
    }
    let mut sum = vec![0.0; n];
    for (y, q) in y.iter().zip(basis) {
        sum.iter_mut().zip(q).for_each(|(sum, q)| *sum += y * q);
    }
    sum
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|v| v * v).sum::<f64>().sqrt()
}
