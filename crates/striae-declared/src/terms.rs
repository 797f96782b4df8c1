//! Numbers in the terms of a deck, so that the same bits are read again.

/// Range, in units in the last place, in which the number that was written is sought around the
/// one that is computed back.
const REACH: i64 = 16;

/// Returns the number near `about` that `read` turns into `value`; `about` if there is none.
pub fn read_as(value: f64, about: f64, read: impl Fn(f64) -> f64) -> f64 {
    let steps = (0..=REACH).flat_map(|far| [far, -far]);
    let mut near = steps.map(|far| f64::from_bits(about.to_bits().wrapping_add_signed(far)));
    near.find(|near| read(*near) == value).unwrap_or(about)
}

/// Returns the degrees of an angle in radians.
pub fn degrees(angle: f64) -> f64 {
    read_as(angle, angle.to_degrees(), f64::to_radians)
}

/// Magnitudes that are shown without an exponent.
const PLAIN: std::ops::Range<f64> = 1e-5..1e15;

/// Returns a number as messages show it: with the digits that tell it from all others, and with an
/// exponent if it is very large or small.
pub fn shown(value: f64) -> String {
    match !value.is_finite() || PLAIN.contains(&value.abs()) {
        _ if value == 0.0 => "0".to_owned(),
        true => value.to_string(),
        false => format!("{value:e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::{degrees, read_as, shown};

    #[test]
    fn numbers_are_shown_in_few_characters() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (-0.25, "-0.25"),
            (1e14, "100000000000000"),
            (1e300, "1e300"),
            (-1e-300, "-1e-300"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(shown(value), text);
        }
        assert!(shown(-1e300 / 6.0).len() < 25);
    }

    #[test]
    fn numbers_in_other_terms_are_read_as_the_same_bits() {
        for i in -3600..3600 {
            let angle = (0.1 * f64::from(i)).to_radians();
            assert_eq!(degrees(angle).to_radians().to_bits(), angle.to_bits());
            let density = (1.0 + f64::from(i).abs()) / 1e4 / 0.37;
            let found = read_as(density, density * 0.37, |mass| mass / 0.37);
            assert_eq!(found / 0.37, density);
        }
    }
}
