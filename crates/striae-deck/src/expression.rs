//! Arithmetic of parameters: `= 2*(E + 1e3)/L^2`, read as `striae_model::formula` says.
//!
//! Angles are in degrees, as everywhere in decks.

use striae_model::formula::{Angles, Name, read};

/// True for a text that is to be computed.
pub(crate) fn is_expression(text: &str) -> bool {
    text.trim_start().starts_with('=')
}

/// Value of a text, with the values of the names in it.
///
/// # Errors
/// The reason, as the end of a sentence; an error of `value_of` is passed on.
pub(crate) fn evaluated(
    text: &str,
    value_of: &mut dyn FnMut(&str) -> Result<f64, String>,
) -> Result<f64, String> {
    let mut meaning = |name: &str| value_of(name).map(Name::Number);
    let formula = read(text, Angles::Degrees, &mut meaning).map_err(|mistake| mistake.cause)?;
    formula.checked()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> Result<f64, String> {
        evaluated(text, &mut |name| match name {
            "E" => Ok(2e6),
            "L_1" => Ok(0.5),
            _ => Err(format!("no `{name}`")),
        })
    }

    #[test]
    fn signs_powers_and_parentheses_bind_as_in_textbooks() {
        for (text, expected) in [
            ("2 + 3*4", 14.0),
            ("(2 + 3)*4", 20.0),
            ("-2^2", -4.0),
            ("2^-1", 0.5),
            ("2^3^2", 512.0),
            ("8/4/2", 1.0),
            ("1 - 2 - 3", -4.0),
            ("1.5e-3*1_000", 1.5),
            ("E/(2*(1 + 0.25))", 8e5),
            ("max(L_1, 2, -3) + min(1, L_1)", 2.5),
            ("+ - 2", -2.0),
            ("4*atan(1)/pi", 180.0 / std::f64::consts::PI),
        ] {
            let found = value(text).expect(text);
            assert!(
                (found - expected).abs() <= 1e-12 * expected.abs(),
                "{text}: {found}"
            );
        }
        assert!((value("sin(30)").unwrap() - 0.5).abs() < 1e-15, "degrees");
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (text, words) in [
            ("", "expected a number, a parameter or `(`, found the end"),
            ("2 +", "found the end"),
            ("2 3", "expected an operator, found `3`"),
            ("(2", "expected `)`, found the end"),
            ("2*)", "found `)`"),
            ("1.2.3", "`1.2.3` is not a number"),
            ("nu", "no `nu`"),
            (
                "sine(1)",
                "unknown function `sine` of one number; known functions are `sqrt`",
            ),
            ("sqrt(1, 2)", "unknown function `sqrt` of 2 numbers"),
            ("1/0", "division by zero"),
            ("1/(1/0)", "division by zero"),
            ("1/(1e200*1e200)", "its value is inf"),
            ("1/1e999", "`1e999` is not a finite number"),
            ("sqrt(-1)", "`sqrt(-1)` is not a finite number"),
            ("max(1, ln(0))", "`ln(0)` is not a finite number"),
            ("(-8)^(1/3)", "`(-8)^("),
            ("1/0^-1", "`(0)^(-1)` is not a finite number"),
            (&"(".repeat(100_000), "nested too deeply"),
            (&"-".repeat(100_000), "nested too deeply"),
            ("2;", "found `;`"),
        ] {
            let found = value(text).expect_err(words);
            assert!(found.contains(words), "{found}");
        }
    }
}
