//! Power laws fitted to points, for rates of convergence.
//!
//! Least squares of `ln y = ln factor + exponent ln x`.

/// `y = factor x^exponent`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// Value at `x = 1`.
    pub factor: f64,
    /// Slope in a doubly logarithmic plot.
    pub exponent: f64,
}

impl PowerLaw {
    /// Value at `x`.
    pub fn at(&self, x: f64) -> f64 {
        self.factor * x.powf(self.exponent)
    }
}

/// The power law nearest to the points with positive coordinates; none if
/// these have fewer than two different `x`.
pub fn power_law(points: &[[f64; 2]]) -> Option<PowerLaw> {
    let logarithms: Vec<[f64; 2]> = points
        .iter()
        .filter(|p| p.iter().all(|c| *c > 0.0 && c.is_finite()))
        .map(|p| p.map(f64::ln))
        .collect();
    let count = logarithms.len() as f64;
    let mean = |axis: usize| logarithms.iter().map(|p| p[axis]).sum::<f64>() / count;
    let (x_mean, y_mean) = (mean(0), mean(1));
    let sum = |f: &dyn Fn(f64, f64) -> f64| -> f64 {
        logarithms
            .iter()
            .map(|p| f(p[0] - x_mean, p[1] - y_mean))
            .sum()
    };
    let spread = sum(&|x, _| x * x);
    (spread > 1e-12).then(|| {
        let exponent = sum(&|x, y| x * y) / spread;
        PowerLaw {
            factor: (y_mean - exponent * x_mean).exp(),
            exponent,
        }
    })
}
