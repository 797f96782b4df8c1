//! Curves of a run, such as a force over a way, beside those of another mesh.

/// Points in the order of their first coordinate.
#[derive(Clone, Debug)]
pub struct Curve(pub Vec<[f64; 2]>);

impl Curve {
    /// A curve from two columns of a history, from zero.
    pub fn from_zero(ways: Vec<f64>, forces: Vec<f64>) -> Self {
        let rows = ways
            .into_iter()
            .zip(forces)
            .map(|(way, force)| [way, force]);
        Self(std::iter::once([0.0; 2]).chain(rows).collect())
    }

    /// Value at a place, linear between points.
    pub fn at(&self, place: f64) -> f64 {
        let next = self.0.partition_point(|row| row[0] < place);
        let next = next.clamp(1, self.0.len() - 1);
        let [from, to] = [self.0[next - 1], self.0[next]];
        from[1] + (to[1] - from[1]) * (place - from[0]) / (to[0] - from[0])
    }

    /// The last value.
    pub fn last(&self) -> f64 {
        self.0[self.0.len() - 1][1]
    }

    /// Largest difference from another curve up to a place, over the largest value there.
    pub fn apart(&self, other: &Self, upto: f64) -> f64 {
        let rows = || self.0.iter().take_while(|row| row[0] <= upto);
        let difference = rows().map(|row| (row[1] - other.at(row[0])).abs());
        let values = rows().map(|row| row[1].abs());
        difference.fold(0.0, f64::max) / values.fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_are_compared_where_both_are_known() {
        let one = Curve::from_zero(vec![1.0, 2.0, 3.0], vec![1.0, 2.0, 9.0]);
        let other = Curve::from_zero(vec![2.0, 3.0], vec![2.2, 3.0]);
        assert!((other.at(1.0) - 1.1).abs() < 1e-15);
        assert!((one.apart(&other, 2.0) - 0.1).abs() < 1e-15);
        assert_eq!(one.last(), 9.0);
    }
}
