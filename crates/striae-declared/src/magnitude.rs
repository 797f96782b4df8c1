//! Magnitudes of numbers that can be computed with.
//!
//! Squares and cubes of stated numbers, their products and quotients, are computed all over a run.
//! They neither overflow nor vanish if each number is far from the ends of what floating-point
//! numbers can represent. Numbers beyond that are mistakes of units, or of an exponent.

use std::ops::RangeInclusive;

use super::{ANY, Bound, Form, Parameter, Value, Values};

/// Magnitudes of numbers that can be computed with.
pub const MAGNITUDES: RangeInclusive<f64> = 1e-50..=1e50;

/// Advice on a number of another magnitude.
pub const ADVICE: &str = "check its unit and its exponent";

/// Returns what a number must be, if it has a magnitude that cannot be computed with. It may be as
/// small as it likes where it may be zero.
pub fn needed(bounds: &[Bound], number: f64) -> Option<&'static str> {
    let may_be_zero = bounds.iter().all(|bound| bound.admits(0.0));
    // Bounds refuse zero themselves.
    let is_small = number != 0.0 && number.abs() < *MAGNITUDES.start() && !may_be_zero;
    let is_large = number.abs() > *MAGNITUDES.end();
    (is_small || is_large).then_some(match may_be_zero {
        true => "at most 1e50 in magnitude",
        false => "from 1e-50 to 1e50",
    })
}

/// Returns the first parameter with a number that cannot be computed with, the number, and what it
/// must be.
pub fn beyond(
    parameters: &[Parameter],
    values: &Values,
) -> Option<(&'static str, f64, &'static str)> {
    parameters.iter().find_map(|parameter| {
        let of = |bounds: &[Bound], numbers: &[f64]| {
            let mut each = numbers.iter();
            each.find_map(|number| Some((parameter.name, *number, needed(bounds, *number)?)))
        };
        let value = values.get(parameter.name);
        match (parameter.form, value) {
            (Form::OneOf(sets), _) => sets.iter().find_map(|set| beyond(set.parameters, values)),
            (Form::Number(bounds), Some(Value::Number(number))) => of(bounds, &[*number]),
            (Form::Numbers(bounds) | Form::Several(_, bounds), Some(Value::Numbers(numbers))) => {
                of(bounds, numbers)
            }
            (Form::Table(set), Some(Value::Table(values))) => beyond(set.parameters, values),
            (Form::Tables(set), Some(Value::Tables(all))) => {
                all.iter().find_map(|values| beyond(set.parameters, values))
            }
            (_, Some(Value::Numbers(numbers))) => of(ANY, numbers),
            (_, Some(Value::Pairs(pairs))) => of(ANY, pairs.as_flattened()),
            (_, Some(Value::Vectors(vectors))) => of(ANY, vectors.as_flattened()),
            _ => None,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::{beyond, needed};
    use crate::{ANY, LENGTH, NOT_NEGATIVE, POSITIVE, Parameter, Set, Values};

    #[test]
    fn numbers_that_may_be_zero_may_be_small() {
        let positive = Some("from 1e-50 to 1e50");
        for (number, expected) in [
            (0.0, None),
            (1e-50, None),
            (1e50, None),
            (1e-320, positive),
            (1e51, positive),
        ] {
            assert_eq!(needed(POSITIVE, number), expected, "{number}");
        }
        let any = Some("at most 1e50 in magnitude");
        for (number, expected) in [(0.0, None), (1e-320, None), (-1e300, any)] {
            assert_eq!(needed(ANY, number), expected, "{number}");
        }
        assert_eq!(needed(NOT_NEGATIVE, 1e-320), None);
    }

    #[test]
    fn numbers_are_found_in_tables_and_lists() {
        static ROW: Set = Set {
            doc: "A row.",
            parameters: &[Parameter::numbers("lengths", POSITIVE, LENGTH, "Lengths.")],
        };
        let parameters = [Parameter::tables("rows", &ROW, "Rows.")];
        let rows = [vec![1.0, 2.0], vec![3.0, 1e-60]];
        let rows = rows.map(|lengths| Values::default().with("lengths", lengths));
        let values = Values::default().with("rows", rows.to_vec());
        let found = beyond(&parameters, &values);
        assert_eq!(found, Some(("lengths", 1e-60, "from 1e-50 to 1e50")));
    }
}
