//! Division of an edge into intervals.
//!
//! Interval lengths `l_0 .. l_{n-1}` are scaled so that they sum up to the
//! length of the edge, and the nodes lie at their partial sums.

use crate::MeshError;
use striae_declared::{Absent, NO_UNIT, POSITIVE, Parameter, Set, Values};

/// Parameters of a [`Grading`].
pub(super) static GRADING: Set = Set {
    doc: "Interval lengths along an edge.",
    parameters: &[Parameter::one_of(
        "intervals",
        &[
            Set {
                doc: "A geometric sequence from one end to the other.",
                parameters: &[Parameter::number(
                    "one_sided",
                    POSITIVE,
                    NO_UNIT,
                    "Last length over the first.",
                )],
            },
            Set {
                doc: "A geometric sequence from both ends to the middle.",
                parameters: &[Parameter::number(
                    "symmetric",
                    POSITIVE,
                    NO_UNIT,
                    "Length in the middle over the length at the ends.",
                )],
            },
            Set {
                doc: "Chosen lengths.",
                parameters: &[Parameter::numbers(
                    "lengths",
                    POSITIVE,
                    NO_UNIT,
                    "One length a division, up to a common factor.",
                )],
            },
        ],
    )],
};

/// Equal lengths where there is no grading.
pub(super) const EQUAL: Absent = Absent::Otherwise("equal");

/// Lengths of the intervals along an edge.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Grading {
    /// Equal lengths.
    #[default]
    Uniform,
    /// A geometric sequence; `ratio` is the last length over the first.
    OneSided {
        /// Last length over first, positive.
        ratio: f64,
    },
    /// A geometric sequence from both ends to the middle; `ratio` is the
    /// middle length over the lengths at the ends.
    Symmetric {
        /// Middle length over end length, positive.
        ratio: f64,
    },
    /// Lengths up to a common factor, one for each division.
    Lengths(Vec<f64>),
}

impl Grading {
    /// The grading that a table of [`GRADING`] states; equal lengths if there is none.
    pub(super) fn stated(table: Option<&Values>) -> Self {
        let Some(table) = table else {
            return Self::Uniform;
        };
        let ratio = |name| table.number_if_any(name);
        match (ratio("one_sided"), ratio("symmetric")) {
            (Some(ratio), _) => Self::OneSided { ratio },
            (_, Some(ratio)) => Self::Symmetric { ratio },
            _ => Self::Lengths(table.numbers("lengths").to_vec()),
        }
    }

    /// Positions of the `divisions + 1` nodes on an edge from 0 to 1.
    ///
    /// # Errors
    /// [`MeshError::Parameter`] when a ratio or length is not positive or there
    /// are no divisions; [`MeshError::IntervalCount`] when the number of
    /// lengths is not that of divisions.
    pub fn nodes(&self, divisions: usize) -> Result<Vec<f64>, MeshError> {
        MeshError::require(divisions > 0, "divisions", 0.0, "at least 1 is needed")?;
        let lengths = self.lengths(divisions)?;
        for &length in &lengths {
            let positive = length > 0.0 && length.is_finite();
            MeshError::require(positive, "interval length", length, "it must be positive")?;
        }
        Ok(unit_partial_sums(&lengths))
    }

    fn lengths(&self, divisions: usize) -> Result<Vec<f64>, MeshError> {
        match self {
            Self::Uniform => Ok(vec![1.0; divisions]),
            Self::OneSided { ratio } => {
                check_ratio(*ratio)?;
                let steps = (divisions - 1).max(1) as f64;
                Ok((0..divisions)
                    .map(|i| ratio.powf(i as f64 / steps))
                    .collect())
            }
            Self::Symmetric { ratio } => {
                check_ratio(*ratio)?;
                let steps = ((divisions - 1) / 2).max(1) as f64;
                Ok((0..divisions)
                    .map(|i| ratio.powf(i.min(divisions - 1 - i) as f64 / steps))
                    .collect())
            }
            Self::Lengths(lengths) if lengths.len() == divisions => Ok(lengths.clone()),
            Self::Lengths(lengths) => Err(MeshError::IntervalCount {
                lengths: lengths.len(),
                divisions,
            }),
        }
    }
}

/// Interval lengths of an edge that is fine at its start.
///
/// Intervals of `size` fill at least the first `fine` of `length`; behind them
/// each is longer than the one before by the same factor, at most `growth`,
/// chosen so that the sum is exact. All intervals are equal and at most `size`
/// where less than one interval is left.
///
/// # Errors
/// [`MeshError::Parameter`] when `length` or `size` is not positive, `fine`
/// negative, `growth` less than 1, or `size` less than a ten-thousandth of `length`.
pub fn refined_lengths(
    length: f64,
    fine: f64,
    size: f64,
    growth: f64,
) -> Result<Vec<f64>, MeshError> {
    MeshError::require(length > 0.0, "length", length, "it must be positive")?;
    MeshError::require(size > 0.0, "element size", size, "it must be positive")?;
    MeshError::require(fine >= 0.0, "fine zone", fine, "it must not be negative")?;
    MeshError::require(growth >= 1.0, "growth", growth, "it must be at least 1")?;
    MeshError::require(
        length / size <= 1e4,
        "element size",
        size,
        "it must be at least a ten-thousandth of the length",
    )?;
    let fine_count = whole(fine / size).max(1);
    let rest = length - fine_count as f64 * size;
    if rest < size {
        let count = whole(length / size).max(1);
        return Ok(vec![length / count as f64; count]);
    }
    let count = (1..)
        .scan((1.0, 0.0), |(length, sum), count| {
            *length *= growth;
            *sum += *length * size;
            Some((count, *sum))
        })
        .find(|&(_, sum)| sum >= rest * (1.0 - ROUNDING))
        .map_or(1, |(count, _)| count);
    let (first, factor) = if count as f64 * size > rest {
        (rest / count as f64, 1.0)
    } else {
        let factor = factor_of_sum(rest / size, count, growth);
        (size * factor, factor)
    };
    let grown = (0..count).map(|k| first * factor.powi(k as i32));
    Ok(std::iter::repeat_n(size, fine_count).chain(grown).collect())
}

/// Lengths mirrored about the start, from the far end to the far end.
pub(super) fn mirrored(lengths: &[f64]) -> Vec<f64> {
    lengths.iter().rev().chain(lengths).copied().collect()
}

/// Partial sums of lengths over their total, from 0 to exactly 1.
pub(super) fn unit_partial_sums(lengths: &[f64]) -> Vec<f64> {
    let total: f64 = lengths.iter().sum();
    let mut nodes = vec![0.0];
    let mut sum = 0.0;
    for length in &lengths[..lengths.len() - 1] {
        sum += length;
        nodes.push(sum / total);
    }
    nodes.push(1.0);
    nodes
}

/// The least whole number of intervals that is `quotient` up to rounding or more.
pub(super) fn whole(quotient: f64) -> usize {
    (quotient - ROUNDING * quotient.max(1.0)).ceil().max(0.0) as usize
}

const ROUNDING: f64 = 1e-9;

fn check_ratio(ratio: f64) -> Result<(), MeshError> {
    let positive = ratio > 0.0 && ratio.is_finite();
    MeshError::require(positive, "grading ratio", ratio, "it must be positive")
}

/// `q + q^2 + ... + q^count`.
fn geometric_sum(q: f64, count: usize) -> f64 {
    (0..count).fold(0.0, |sum, _| (sum + 1.0) * q)
}

/// The factor in `[1, growth]` whose geometric sum is `sum`, by bisection.
fn factor_of_sum(sum: f64, count: usize, growth: f64) -> f64 {
    let (mut low, mut high) = (1.0, growth);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if geometric_sum(middle, count) < sum {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn lengths(grading: &Grading, divisions: usize) -> Vec<f64> {
        let nodes = grading.nodes(divisions).unwrap();
        nodes.windows(2).map(|pair| pair[1] - pair[0]).collect()
    }

    #[test]
    fn one_sided_is_geometric() {
        let l = lengths(&Grading::OneSided { ratio: 8.0 }, 4);
        for pair in l.windows(2) {
            assert!((pair[1] / pair[0] - 2.0).abs() < 1e-12);
        }
    }

    #[test]
    fn symmetric_is_a_mirror_image() {
        for divisions in 1..9 {
            let l = lengths(&Grading::Symmetric { ratio: 3.0 }, divisions);
            for i in 0..divisions {
                assert!((l[i] - l[divisions - 1 - i]).abs() < 1e-14);
            }
            if divisions > 2 {
                assert!((l[(divisions - 1) / 2] / l[0] - 3.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn explicit_lengths_are_scaled() {
        let nodes = Grading::Lengths(vec![1.0, 3.0]).nodes(2).unwrap();
        assert_eq!(nodes, [0.0, 0.25, 1.0]);
        assert_eq!(
            Grading::Lengths(vec![1.0]).nodes(2),
            Err(MeshError::IntervalCount {
                lengths: 1,
                divisions: 2
            })
        );
    }

    #[test]
    fn impossible_parameters_are_refused() {
        for grading in [
            Grading::OneSided { ratio: 0.0 },
            Grading::Symmetric { ratio: f64::NAN },
            Grading::Lengths(vec![1.0, -1.0]),
        ] {
            assert!(matches!(grading.nodes(2), Err(MeshError::Parameter { .. })));
        }
        assert!(Grading::Uniform.nodes(0).is_err());
        assert!(refined_lengths(1.0, 0.1, 0.1, 0.9).is_err());
    }

    proptest! {
        #[test]
        fn refined_lengths_keep_their_promise(
            length in 0.5..50.0f64,
            fine in 0.0..3.0f64,
            size in 0.02..2.0f64,
            growth in 1.0..1.6f64,
        ) {
            let l = refined_lengths(length, fine, size, growth).unwrap();
            prop_assert!((l.iter().sum::<f64>() - length).abs() < 1e-9 * length);
            prop_assert!(l[0] <= size * (1.0 + 1e-8));
            if length >= 2.0 * size + fine {
                prop_assert!((l[0] - size).abs() < 1e-12);
            }
            let mut position = 0.0;
            for pair in l.windows(2) {
                position += pair[0];
                prop_assert!(pair[1] <= pair[0] * growth * (1.0 + 1e-9));
                if position < fine * (1.0 - 1e-8) {
                    prop_assert!(pair[1] <= size * (1.0 + 1e-8));
                }
            }
        }
    }
}
