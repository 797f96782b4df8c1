//! Numbers and places in messages.

use crate::Vec3;

/// Least power of ten that is written without an exponent.
const LEAST: i32 = -4;
/// Digits before the point that are written without an exponent, significant or not.
const LONG: usize = 5;
/// Significant digits of the largest coordinate of a place.
const DIGITS: i32 = 7;

/// Returns a number with so many significant digits and no zeros behind them: `4000`, `0.25`,
/// `1.1e-9`.
///
/// ```
/// use striae_mesh::significant;
///
/// assert_eq!(significant(4000.0, 4), "4000");
/// assert_eq!(significant(1.0 / 3.0, 4), "0.3333");
/// assert_eq!(significant(1.1e-9, 4), "1.1e-9");
/// ```
pub fn significant(value: f64, digits: usize) -> String {
    let decimals = digits.saturating_sub(1);
    let scientific = format!("{value:.decimals$e}");
    let Some((mantissa, exponent)) = scientific.split_once('e') else {
        return scientific;
    };
    match exponent.parse::<i32>() {
        Ok(power) if (LEAST..digits.max(LONG) as i32).contains(&power) => {
            let decimals = (decimals as i32 - power).max(0) as usize;
            trimmed(&format!("{value:.decimals$}"))
        }
        _ => format!("{}e{exponent}", trimmed(mantissa)),
    }
}

/// Returns the coordinates of a place: `(10, 0.333333, 0)`. What is round-off beside the largest
/// coordinate is zero.
pub fn place(x: &Vec3) -> String {
    let largest = x.amax();
    if !largest.is_finite() || largest == 0.0 {
        return format!("({}, {}, {})", x.x, x.y, x.z);
    }
    let power = largest.log10().floor() as i32;
    let decimals = DIGITS - 1 - power;
    let coordinate = |value: f64| match (LEAST..DIGITS).contains(&power) {
        true => {
            let decimals = decimals.max(0) as usize;
            trimmed(&format!("{value:.decimals$}"))
        }
        false => {
            let unit = 10f64.powi(-decimals);
            let rounded = (value / unit).round();
            significant(rounded * unit, DIGITS as usize)
        }
    };
    let [x, y, z] = [x.x, x.y, x.z].map(coordinate);
    format!("({x}, {y}, {z})")
}

/// Takes away zeros behind the last digit, and the sign of zero.
fn trimmed(text: &str) -> String {
    let text = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => text,
    };
    match text {
        "-0" => "0".to_owned(),
        text => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_as_short_as_their_digits() {
        for (value, digits, text) in [
            (0.0, 4, "0"),
            (-0.0, 3, "0"),
            (4000.0, 7, "4000"),
            (-0.25, 4, "-0.25"),
            (123_456.7, 4, "1.235e5"),
            (12_345.6, 2, "12346"),
            (1.234_567e9, 4, "1.235e9"),
            (9.9999e-5, 3, "0.0001"),
            (2.5e-5, 3, "2.5e-5"),
            (0.999_96, 4, "1"),
            (f64::INFINITY, 3, "inf"),
        ] {
            assert_eq!(significant(value, digits), text);
        }
    }

    #[test]
    fn places_have_no_round_off() {
        for (x, text) in [
            ([10.0, 1.0 / 3.0, -1e-15], "(10, 0.33333, 0)"),
            ([0.0, 0.0, 0.0], "(0, 0, 0)"),
            ([2e-6, -1e-6, 1e-20], "(2e-6, -1e-6, 0)"),
            ([1.5, 2.0, 0.000_001], "(1.5, 2, 0.000001)"),
        ] {
            assert_eq!(place(&Vec3::from(x)), text);
        }
    }
}
