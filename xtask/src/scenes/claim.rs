//! Claims of a scene about its results, beside what always holds: a number between two others.

use super::vector::Vector;

/// A number of the results with its bounds.
#[derive(Clone, Debug)]
pub struct Claim {
    /// Check that it belongs to.
    pub check: &'static str,
    /// The number.
    pub quantity: Quantity,
    /// Step.
    pub step: usize,
    /// Share of the step from which on all increments count; 1 is its end alone.
    pub from: f64,
    /// Least value.
    pub low: f64,
    /// Largest value; may be infinite.
    pub high: f64,
}

/// A number of the results. Pairs and ties are counted from 0, directions local.
#[derive(Clone, Debug)]
pub enum Quantity {
    /// Force of a pair on a body, along a direction.
    Force(usize, &'static str, Vector),
    /// Force of a tie on a body, along a direction.
    Pull(usize, &'static str, Vector),
    /// Force of a pair on a body, along a direction, over that in the reference.
    Beside(usize, &'static str, Vector),
    /// Force of a pair on a body, along a direction, over that at the end of another step.
    Since(usize, &'static str, Vector, usize),
    /// Integral of friction over that of pressure.
    Friction(usize),
    /// Friction of the resultant over the largest of the law in its direction, with the mean
    /// normal of the surface.
    Law(usize),
    /// Place along a direction of the common force of several pairs on a body.
    Lever(Vec<usize>, &'static str, Vector),
    /// Vector in the columns of a name, along a direction.
    Column(String, Vector),
    /// Change of such a vector since the first increment.
    Drift(String, Vector),
}

impl Claim {
    /// A claim about the end of a step.
    pub fn at_end(check: &'static str, step: usize, quantity: Quantity, bounds: [f64; 2]) -> Self {
        Self {
            check,
            quantity,
            step,
            from: 1.0,
            low: bounds[0],
            high: bounds[1],
        }
    }

    /// A claim about all increments of a step from a share of it on.
    pub fn within(self, from: f64) -> Self {
        Self { from, ..self }
    }

    /// Value over bound: at most 1 where the value is within.
    pub fn measure(&self, value: f64) -> f64 {
        if self.high.is_infinite() {
            return if value >= self.low {
                0.0
            } else {
                1.0 + (self.low - value) / self.low.abs().max(f64::MIN_POSITIVE)
            };
        }
        let (middle, half) = (0.5 * (self.low + self.high), 0.5 * (self.high - self.low));
        (value - middle).abs() / half
    }
}

/// Bounds about a value, by a share of it.
pub fn about(value: f64, share: f64) -> [f64; 2] {
    let half = share * value.abs();
    [value - half, value + half]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measures_are_one_at_the_bounds() {
        let claim = |bounds| Claim::at_end("", 0, Quantity::Friction(0), bounds);
        let around = claim(about(-2.0, 0.1));
        for (value, expected) in [(-2.0, 0.0), (-2.2, 1.0), (-1.6, 2.0)] {
            assert!((around.measure(value) - expected).abs() < 1e-12, "{value}");
        }
        let above = claim([0.5, f64::INFINITY]);
        assert_eq!(above.measure(7.0), 0.0);
        assert!((above.measure(0.25) - 1.5).abs() < 1e-12);
    }
}
