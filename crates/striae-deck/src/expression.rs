//! Arithmetic of parameters: `= 2*(E + 1e3)/L^2`.
//!
//! ```text
//! sum     = term, { ("+" | "-"), term }
//! term    = signed, { ("*" | "/"), signed }
//! signed  = { "-" | "+" }, power
//! power   = atom, [ "^", signed ]            from the right, before signs: -2^2 = -4
//! atom    = number | name | name "(" sum { "," sum } ")" | "(" sum ")"
//! ```
//!
//! Angles are in degrees, as everywhere in decks.

use std::{iter::Peekable, str::CharIndices};

/// Parentheses, signs and powers within each other that are read.
const DEEPEST: usize = 64;

/// Names of functions, for messages.
const FUNCTIONS: &str = "`sqrt`, `abs`, `exp`, `ln`, `log10`, `sin`, `cos`, `tan`, `asin`, `acos`, `atan`, `floor`, `ceil`, `round`, `min`, `max`";

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
    let mut reader = Reader {
        text,
        letters: text.char_indices().peekable(),
        value_of,
        depth: 0,
    };
    let value = reader.sum()?;
    match reader.next_letter() {
        None => Ok(value),
        found => Err(reader.expected("an operator", found)),
    }
}

struct Reader<'t, 'v> {
    text: &'t str,
    letters: Peekable<CharIndices<'t>>,
    value_of: &'v mut dyn FnMut(&str) -> Result<f64, String>,
    depth: usize,
}

impl<'t> Reader<'t, '_> {
    fn sum(&mut self) -> Result<f64, String> {
        let mut value = self.term()?;
        loop {
            match self.next_letter() {
                Some('+') => value += self.after(Self::term)?,
                Some('-') => value -= self.after(Self::term)?,
                _ => return finite(value),
            }
        }
    }

    fn term(&mut self) -> Result<f64, String> {
        let mut value = self.signed()?;
        loop {
            match self.next_letter() {
                Some('*') => value *= self.after(Self::signed)?,
                Some('/') => match self.after(Self::signed)? {
                    0.0 => return Err("division by zero".to_owned()),
                    divisor => value /= divisor,
                },
                _ => return finite(value),
            }
        }
    }

    fn signed(&mut self) -> Result<f64, String> {
        match self.next_letter() {
            Some('-') => Ok(-self.deeper(Self::signed)?),
            Some('+') => self.deeper(Self::signed),
            _ => self.power(),
        }
    }

    fn power(&mut self) -> Result<f64, String> {
        let base = self.atom()?;
        match self.next_letter() {
            Some('^') => {
                let exponent = self.deeper(Self::signed)?;
                defined(base.powf(exponent), || format!("({base})^({exponent})"))
            }
            _ => Ok(base),
        }
    }

    fn atom(&mut self) -> Result<f64, String> {
        match self.next_letter() {
            Some('(') => {
                let value = self.deeper(Self::sum)?;
                self.closed()?;
                Ok(value)
            }
            Some(letter) if letter.is_ascii_digit() || letter == '.' => self.number(),
            Some(letter) if is_name(letter) => self.named(),
            found => Err(self.expected("a number, a parameter or `(`", found)),
        }
    }

    fn number(&mut self) -> Result<f64, String> {
        let mut last = ' ';
        let word = self.word(&mut |letter| {
            let signs = "+-".contains(letter) && "eE".contains(last);
            let is_part = letter.is_ascii_digit() || ".eE_".contains(letter) || signs;
            last = letter;
            is_part
        });
        let plain = word.replace('_', "");
        let value = plain
            .parse()
            .map_err(|_| format!("`{word}` is not a number"))?;
        defined(value, || word.to_owned())
    }

    fn named(&mut self) -> Result<f64, String> {
        let name = self.word(&mut |letter| is_name(letter) || letter.is_ascii_digit());
        if self.next_letter() != Some('(') {
            return match name {
                "pi" => Ok(std::f64::consts::PI),
                name => (self.value_of)(name),
            };
        }
        let mut arguments = vec![self.deeper(Self::sum)?];
        while self.next_letter() == Some(',') {
            arguments.push(self.deeper(Self::sum)?);
        }
        self.closed()?;
        called(name, &arguments)
    }

    /// Value of what stands after the letter that comes next.
    fn after(&mut self, read: fn(&mut Self) -> Result<f64, String>) -> Result<f64, String> {
        self.letters.next();
        read(self)
    }

    /// Something within something else, after the letter that comes next.
    fn deeper(&mut self, read: fn(&mut Self) -> Result<f64, String>) -> Result<f64, String> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err("it is nested too deeply".to_owned());
        }
        let value = self.after(read)?;
        self.depth -= 1;
        Ok(value)
    }

    fn closed(&mut self) -> Result<(), String> {
        match self.next_letter() {
            Some(')') => {
                self.letters.next();
                Ok(())
            }
            found => Err(self.expected("`)`", found)),
        }
    }

    /// The next letter that is no blank, which is not taken.
    fn next_letter(&mut self) -> Option<char> {
        while self
            .letters
            .next_if(|(_, letter)| letter.is_whitespace())
            .is_some()
        {}
        self.letters.peek().map(|(_, letter)| *letter)
    }

    fn word(&mut self, is_part: &mut dyn FnMut(char) -> bool) -> &'t str {
        let text = self.text;
        let end = |reader: &mut Self| reader.letters.peek().map_or(text.len(), |at| at.0);
        let start = end(self);
        while self
            .letters
            .next_if(|(_, letter)| is_part(*letter))
            .is_some()
        {}
        let end = end(self);
        &text[start..end]
    }

    fn expected(&self, what: &str, found: Option<char>) -> String {
        match found {
            Some(found) => format!("expected {what}, found `{found}`"),
            None => format!("expected {what}, found the end"),
        }
    }
}

/// A value so far, before it vanishes in what is made of it, as in `1/(1e300*1e300)`.
fn finite(value: f64) -> Result<f64, String> {
    match value.is_finite() {
        true => Ok(value),
        false => Err(format!(
            "its value is {value}, which is not a finite number"
        )),
    }
}

/// The value of something that may have none.
fn defined(value: f64, words: impl FnOnce() -> String) -> Result<f64, String> {
    match value.is_finite() {
        true => Ok(value),
        false => Err(format!("`{}` is not a finite number", words())),
    }
}

fn is_name(letter: char) -> bool {
    letter.is_alphabetic() || letter == '_'
}

fn called(name: &str, arguments: &[f64]) -> Result<f64, String> {
    let value = match (name, arguments) {
        ("sqrt", [x]) => x.sqrt(),
        ("abs", [x]) => x.abs(),
        ("exp", [x]) => x.exp(),
        ("ln", [x]) => x.ln(),
        ("log10", [x]) => x.log10(),
        ("sin", [x]) => x.to_radians().sin(),
        ("cos", [x]) => x.to_radians().cos(),
        ("tan", [x]) => x.to_radians().tan(),
        ("asin", [x]) => x.asin().to_degrees(),
        ("acos", [x]) => x.acos().to_degrees(),
        ("atan", [x]) => x.atan().to_degrees(),
        ("floor", [x]) => x.floor(),
        ("ceil", [x]) => x.ceil(),
        ("round", [x]) => x.round(),
        ("min", all) => all.iter().copied().fold(f64::INFINITY, f64::min),
        ("max", all) => all.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        _ => {
            let count = arguments.len();
            return Err(format!(
                "unknown function `{name}` of {count} numbers; known functions are {FUNCTIONS}"
            ));
        }
    };
    defined(value, || {
        let arguments: Vec<String> = arguments.iter().map(f64::to_string).collect();
        format!("{name}({})", arguments.join(", "))
    })
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
                "unknown function `sine` of 1 numbers; known functions are `sqrt`",
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
