//! Arithmetic in texts, such as `0.1*sin(2*pi*t)*x`.
//!
//! ```text
//! sum     = term, { ("+" | "-"), term }
//! term    = signed, { ("*" | "/"), signed }
//! signed  = { "-" | "+" }, power
//! power   = atom, [ "^", signed ]            from the right, before signs: -2^2 = -4
//! atom    = number | name | name "(" sum { "," sum } ")" | "(" sum ")"
//! ```
//!
//! A text is read once into operations on a stack, which are evaluated over any scalar, so that
//! derivatives are exact. Who reads it says what names mean, and the unit of angles.

mod reader;

use num_dual::DualNum;

pub use reader::{Mistake, Name, read};

/// Unit of the angles of trigonometric functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Angles {
    /// Degrees, as in all numbers of decks.
    Degrees,
    /// Radians, as in functions of time.
    Radians,
}

/// Operations on a stack, in the order in which they are done.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Formula {
    operations: Vec<Operation>,
}

/// A step of a formula.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Operation {
    Number(f64),
    Variable(usize),
    Negate,
    Add,
    Subtract,
    Multiply,
    Divide,
    Power(Exponent),
    Call(Function),
}

/// Parts of an exponent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Exponent {
    /// Numbers only, so that bases may be negative.
    Numbers,
    /// Variables too.
    Variables,
}

/// A function with so many arguments.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Function {
    name: &'static str,
    arguments: usize,
    angles: Angles,
}

/// Names of the functions of one argument.
const OF_ONE: [&str; 14] = [
    "sqrt", "abs", "exp", "ln", "log10", "sin", "cos", "tan", "asin", "acos", "atan", "floor",
    "ceil", "round",
];
/// Names of the functions of any number of arguments.
const OF_ANY: [&str; 2] = ["min", "max"];

impl Formula {
    /// Value with the values of its variables.
    pub fn evaluated<D: DualNum<Primitive = f64> + Copy>(&self, variables: &[D]) -> D {
        let mut stack = Vec::with_capacity(8);
        for operation in &self.operations {
            operation.perform(&mut stack, variables);
        }
        stack.pop().expect("a formula leaves its value")
    }

    /// Value of a formula without variables, every part of which has to be a finite number.
    ///
    /// # Errors
    /// The reason, as the end of a sentence.
    pub fn checked(&self) -> Result<f64, String> {
        let mut stack: Vec<f64> = Vec::with_capacity(8);
        for operation in &self.operations {
            let before = stack.clone();
            if *operation == Operation::Divide && before.last() == Some(&0.0) {
                return Err("division by zero".to_owned());
            }
            operation.perform(&mut stack, &[]);
            let value = *stack.last().expect("an operation leaves a value");
            if !value.is_finite() {
                return Err(operation.undefined(&before, value));
            }
        }
        Ok(stack.pop().expect("a formula leaves its value"))
    }

    /// Returns whether it depends on a variable.
    pub fn depends_on(&self, variable: usize) -> bool {
        self.operations.contains(&Operation::Variable(variable))
    }

    /// The formula with a number in place of a variable.
    pub fn with(&self, variable: usize, value: f64) -> Self {
        let put = |operation: &Operation| match operation {
            Operation::Variable(known) if *known == variable => Operation::Number(value),
            other => *other,
        };
        Self {
            operations: self.operations.iter().map(put).collect(),
        }
    }

    /// `from + c (to - from)`.
    pub fn between(from: &Self, to: &Self, c: f64) -> Self {
        use Operation::{Add, Multiply, Number, Subtract};
        let mut operations = from.operations.clone();
        operations.extend(&to.operations);
        operations.extend(&from.operations);
        operations.extend([Subtract, Number(c), Multiply, Add]);
        Self { operations }
    }

    /// The formula times a number.
    pub fn times(&self, factor: f64) -> Self {
        let mut operations = self.operations.clone();
        operations.extend([Operation::Number(factor), Operation::Multiply]);
        Self { operations }
    }

    /// The formula of a number.
    pub fn number(value: f64) -> Self {
        Self {
            operations: vec![Operation::Number(value)],
        }
    }
}

impl Operation {
    fn perform<D: DualNum<Primitive = f64> + Copy>(self, stack: &mut Vec<D>, variables: &[D]) {
        let mut pop = || stack.pop().expect("operations have their operands");
        let value = match self {
            Self::Number(value) => D::from(value),
            Self::Variable(at) => variables[at],
            Self::Negate => -pop(),
            Self::Add | Self::Subtract | Self::Multiply | Self::Divide | Self::Power(_) => {
                let (right, left) = (pop(), pop());
                match self {
                    Self::Add => left + right,
                    Self::Subtract => left - right,
                    Self::Multiply => left * right,
                    Self::Divide => left / right,
                    Self::Power(Exponent::Numbers) => power(left, right.re()),
                    _ => left.powd(right),
                }
            }
            Self::Call(function) => {
                let arguments = stack.split_off(stack.len() - function.arguments);
                function.of(&arguments)
            }
        };
        stack.push(value);
    }

    /// Reason for which an operation makes no number of the top of the stack.
    fn undefined(self, stack: &[f64], value: f64) -> String {
        match (self, stack) {
            (Self::Power(_), [.., base, exponent]) => {
                format!("`({base})^({exponent})` is not a finite number")
            }
            (Self::Call(function), stack) => {
                let arguments = &stack[stack.len() - function.arguments..];
                let arguments: Vec<String> = arguments.iter().map(f64::to_string).collect();
                let (name, arguments) = (function.name, arguments.join(", "));
                format!("`{name}({arguments})` is not a finite number")
            }
            _ => format!("its value is {value}, which is not a finite number"),
        }
    }
}

/// `base^exponent`; whole exponents have derivatives at zero.
fn power<D: DualNum<Primitive = f64> + Copy>(base: D, exponent: f64) -> D {
    const WHOLE: f64 = 64.0;
    match D::NDERIV > 0 && exponent.fract() == 0.0 && exponent.abs() <= WHOLE {
        true => base.powi(exponent as i32),
        false => base.powf(exponent),
    }
}

impl Function {
    fn of<D: DualNum<Primitive = f64> + Copy>(self, arguments: &[D]) -> D {
        const DEGREE: f64 = std::f64::consts::PI / 180.0;
        const RADIAN: f64 = 180.0 / std::f64::consts::PI;
        let first = arguments[0];
        let angle = |x: D| match self.angles {
            Angles::Degrees => x * DEGREE,
            Angles::Radians => x,
        };
        let turned = |x: D| match self.angles {
            Angles::Degrees => x * RADIAN,
            Angles::Radians => x,
        };
        let pick = |better: fn(f64, f64) -> bool| {
            let others = arguments.iter().copied();
            others.fold(first, |known, other| match better(other.re(), known.re()) {
                true => other,
                false => known,
            })
        };
        match self.name {
            "sqrt" => first.sqrt(),
            "abs" => first.abs(),
            "exp" => first.exp(),
            "ln" => first.ln(),
            "log10" => first.log10(),
            "sin" => angle(first).sin(),
            "cos" => angle(first).cos(),
            "tan" => angle(first).tan(),
            "asin" => turned(first.asin()),
            "acos" => turned(first.acos()),
            "atan" => turned(first.atan()),
            "floor" => D::from(first.re().floor()),
            "ceil" => D::from(first.re().ceil()),
            "round" => D::from(first.re().round()),
            "min" => pick(|a, b| a < b),
            "max" => pick(|a, b| a > b),
            name => unreachable!("`{name}` is not read as a function"),
        }
    }
}
