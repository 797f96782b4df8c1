//! Values that are functions of position and time.
//!
//! A function is a formula of `x`, `y`, `z`, the reference coordinates of a point, and `t`, the
//! time of the run, with angles in radians; its text is all that there is to it, so that it can
//! be written to decks and compared.

use nalgebra::Vector3;
use num_dual::{Dual2_64, DualNum};
use serde::{Serialize, Serializer};
use striae_mesh::Vec3;

use crate::formula::{Angles, Formula, Mistake, Name, read};

/// Names of the variables.
const VARIABLES: [&str; 4] = ["x", "y", "z", "t"];
/// Position of the time in them.
const TIME: usize = 3;

/// A function of position and time.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    text: String,
    formula: Formula,
}

/// A number, or one for every position and time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Value {
    /// One for everywhere and all times.
    Number(f64),
    /// One for every position and time.
    Function(Function),
}

/// A text that is no function.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{text}` is no function of `x`, `y`, `z` and `t`, at letter {letter}: {cause}; write one such as \"0.1*x*sin(2*pi*t)\", with angles in radians"
)]
pub struct NoFunction {
    /// The text.
    pub text: String,
    /// Number of the letter at which it cannot be read, counted from 1.
    pub letter: usize,
    /// Reason for which it cannot.
    pub cause: String,
}

impl Function {
    /// The function that a text says.
    ///
    /// # Errors
    /// The first mistake in the text.
    pub fn new(text: &str) -> Result<Self, NoFunction> {
        Self::with_names(text, &mut |name| Err(unknown(name)))
    }

    /// The function that a text with further names says, which are replaced by their numbers.
    ///
    /// # Errors
    /// The first mistake in the text; an error of `value_of` is passed on.
    pub fn with_names(
        text: &str,
        value_of: &mut dyn FnMut(&str) -> Result<f64, String>,
    ) -> Result<Self, NoFunction> {
        let text = replaced(text.trim(), value_of);
        let mut meaning = |name: &str| {
            let variable = VARIABLES.iter().position(|known| *known == name);
            match variable {
                Some(at) => Ok(Name::Variable(at)),
                // It has a number if it is known, and has been replaced by it.
                None => Err(value_of(name).err().unwrap_or_else(|| unknown(name))),
            }
        };
        let formula = read(&text, Angles::Radians, &mut meaning);
        match formula {
            Ok(formula) => Ok(Self { text, formula }),
            Err(Mistake { letter, cause }) => Err(NoFunction {
                text,
                letter,
                cause,
            }),
        }
    }

    /// Its text, without names but those of the variables.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Value at a point of the reference configuration and a time.
    pub fn at<D: DualNum<Primitive = f64> + Copy>(&self, x: &Vector3<D>, time: D) -> D {
        self.formula.evaluated(&[x.x, x.y, x.z, time])
    }

    /// First and second derivative by time; zero where there is none.
    pub fn rate(&self, x: &Vec3, time: f64) -> [f64; 2] {
        let time = Dual2_64::new(time, 1.0, 0.0);
        let value = self.at(&x.map(Dual2_64::from), time);
        [value.v1, value.v2].map(|rate| if rate.is_finite() { rate } else { 0.0 })
    }

    /// Returns whether it changes with time.
    pub fn moves(&self) -> bool {
        self.formula.depends_on(TIME)
    }

    /// Returns whether it is the same everywhere.
    pub fn is_uniform(&self) -> bool {
        (0..TIME).all(|axis| !self.formula.depends_on(axis))
    }
}

impl Serialize for Function {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.text.serialize(serializer)
    }
}

impl Value {
    /// The number, where it is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            Self::Function(_) => None,
        }
    }

    /// Value at a point of the reference configuration and a time.
    pub fn at<D: DualNum<Primitive = f64> + Copy>(&self, x: &Vector3<D>, time: D) -> D {
        match self {
            Self::Number(number) => D::from(*number),
            Self::Function(function) => function.at(x, time),
        }
    }

    /// First and second derivative by time.
    pub fn rate(&self, x: &Vec3, time: f64) -> [f64; 2] {
        match self {
            Self::Number(_) => [0.0; 2],
            Self::Function(function) => function.rate(x, time),
        }
    }

    /// Returns whether it changes with time.
    pub fn moves(&self) -> bool {
        matches!(self, Self::Function(function) if function.moves())
    }

    /// Value at a time, by position.
    pub fn frozen(&self, time: f64) -> Self {
        match self {
            Self::Function(function) if function.moves() => Self::Function(Function {
                text: replaced(&function.text, &mut |name| match name {
                    "t" => Ok(time),
                    _ => Err(String::new()),
                }),
                formula: function.formula.with(TIME, time),
            }),
            other => other.clone(),
        }
    }

    /// `from + c (self - from)`.
    pub fn between(&self, from: &Self, c: f64) -> Self {
        match (self, from) {
            (Self::Number(to), Self::Number(from)) => Self::Number(from + (to - from) * c),
            (to, _) if c == 1.0 => to.clone(),
            (_, from) if c == 0.0 => from.clone(),
            (to, from) => {
                let (from, to) = (from.function(), to.function());
                Self::Function(Function {
                    text: format!("({0}) + (({1}) - ({0}))*{c:?}", from.text, to.text),
                    formula: Formula::between(&from.formula, &to.formula, c),
                })
            }
        }
    }

    /// The value times a number.
    pub fn times(&self, factor: f64) -> Self {
        match self {
            Self::Number(number) => Self::Number(number * factor),
            Self::Function(function) => Self::Function(Function {
                text: format!("({})*{}", function.text, written(factor)),
                formula: function.formula.times(factor),
            }),
        }
    }

    fn function(&self) -> Function {
        match self {
            Self::Function(function) => function.clone(),
            Self::Number(number) => Function {
                text: written(*number),
                formula: Formula::number(*number),
            },
        }
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<Function> for Value {
    fn from(function: Function) -> Self {
        Self::Function(function)
    }
}

impl std::fmt::Display for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Function(function) => write!(f, "\"{}\"", function.text),
        }
    }
}

fn unknown(name: &str) -> String {
    format!("there is no `{name}`")
}

/// A number as a part of a text, of which the sign must not end up before a power.
fn written(number: f64) -> String {
    match number.is_sign_negative() {
        true => format!("({number:?})"),
        false => format!("{number:?}"),
    }
}

/// A text with the numbers of all names that have one.
fn replaced(text: &str, value_of: &mut dyn FnMut(&str) -> Result<f64, String>) -> String {
    let is_part = |letter: char| letter.is_alphanumeric() || letter == '_' || letter == '.';
    let mut found = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(is_part) {
        found += &rest[..start];
        rest = &rest[start..];
        let end = rest.find(|letter| !is_part(letter)).unwrap_or(rest.len());
        let word = &rest[..end];
        rest = &rest[end..];
        let is_number = word.starts_with(|letter: char| letter.is_ascii_digit() || letter == '.');
        let is_called = rest.trim_start().starts_with('(');
        match value_of(word) {
            Ok(value) if !is_number && !is_called => found += &written(value),
            _ => found += word,
        }
    }
    found + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn function(text: &str) -> Function {
        Function::new(text).expect(text)
    }

    #[test]
    fn values_and_rates_are_those_of_the_formula() {
        let of = function("0.1*sin(2*pi*t)*x + y^2*t^3 - max(z, -1)*exp(-t)");
        let (x, t) = (Vec3::new(0.3, -0.7, 0.2), 0.4_f64);
        let w = 2.0 * std::f64::consts::PI;
        let expected = 0.1 * (w * t).sin() * x.x + 0.49 * t.powi(3) - 0.2 * (-t).exp();
        assert!((of.at(&x, t) - expected).abs() < 1e-15);
        let first = 0.1 * w * (w * t).cos() * x.x + 3.0 * 0.49 * t * t + 0.2 * (-t).exp();
        let second = -0.1 * w * w * (w * t).sin() * x.x + 6.0 * 0.49 * t - 0.2 * (-t).exp();
        let [one, two] = of.rate(&x, t);
        assert!((one - first).abs() < 1e-14 && (two - second).abs() < 1e-14);
        assert!(of.moves() && !of.is_uniform());
        assert_eq!(function("t^2").rate(&x, 0.0), [0.0, 2.0]);
        assert_eq!(function("sqrt(t)").rate(&x, 0.0), [0.0, 0.0]);
    }

    #[test]
    fn values_of_duals_have_derivatives_by_position() {
        let of = function("(x - 1)^3*y");
        let x = Vector3::new(Dual2_64::new(-1.0, 1.0, 0.0), 2.0.into(), 0.0.into());
        let value = of.at(&x, 0.0.into());
        assert_eq!([value.re, value.v1, value.v2], [-16.0, 24.0, -24.0]);
    }

    #[test]
    fn names_are_replaced_by_their_numbers() {
        let mut names = |name: &str| match name {
            "A" => Ok(-2.0),
            "e1" => Ok(5.0),
            _ => Err(format!("no `{name}`")),
        };
        let of = Function::with_names("A^2*x + 1e1*e1 - exp(t)", &mut names).unwrap();
        assert_eq!(of.text(), "(-2.0)^2*x + 1e1*5.0 - exp(t)");
        assert_eq!(of.at(&Vec3::x(), 0.0), 4.0 + 50.0 - 1.0);
        assert_eq!(function(of.text()), of);
        let wrong = Function::with_names("2*B", &mut names).unwrap_err();
        assert_eq!((wrong.letter, wrong.cause.as_str()), (3, "no `B`"));
    }

    #[test]
    fn mistakes_have_their_place() {
        for (text, letter, cause) in [
            ("2*u", 3, "there is no `u`"),
            ("sin(t", 6, "expected `)`, found the end"),
            ("x*(y + sine(t))", 8, "unknown function `sine`"),
            ("é + 2 2", 1, "there is no `é`"),
            ("x + 2 2", 7, "expected an operator, found `2`"),
            ("", 1, "found the end"),
        ] {
            let found = Function::new(text).expect_err(text);
            assert_eq!(found.letter, letter, "{found}");
            assert!(found.to_string().contains(cause), "{found}");
        }
    }

    #[test]
    fn frozen_values_and_those_between_read_back() {
        let value = Value::from(function("x*t + sqrt(t)"));
        let point = Vec3::new(2.0, 0.0, 0.0);
        let held = value.frozen(0.25);
        assert!(!held.moves());
        assert_eq!(held.at(&point, 9.0), 1.0);
        let between = held.between(&Value::Number(-1.0), 0.75);
        assert_eq!(between.at(&point, 9.0), 0.5);
        assert_eq!(between.times(-3.0).at(&point, 9.0), -1.5);
        let Value::Function(of) = between else {
            panic!("a function")
        };
        assert_eq!(function(of.text()).at(&point, 9.0), 0.5);
    }
}
