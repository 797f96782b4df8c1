//! Laws and mesh generators as they are declared: once, with everything that others say of them.
//!
//! A [`Declared`] law or generator has a name, parameters and a function that makes it of their
//! values. Decks, their schema and reference, the program and the Python package list, read,
//! check and write them from these tables and know none of them.
//!
//! Values are in the words of a deck: angles are in degrees.

mod set;
mod terms;
mod value;

pub use set::{Choice, Set};
pub use terms::{degrees, read_as};
pub use value::{Value, Values};

use std::fmt;

/// A kind of laws, such as friction.
pub trait Kind: Sized + 'static {
    /// Reason to refuse a law.
    type Refusal: std::error::Error;
    /// Relation of constants to measurements; `Infallible` for kinds without one.
    type Fit: fmt::Debug + Sync;

    /// Returns the law with what it was made of.
    fn with_statement(self, statement: Statement) -> Self;

    /// Returns what the law was made of, if it was made by a declared one.
    fn statement(&self) -> Option<&Statement>;

    /// Returns the parameter that a refusal is about, if it is about one.
    fn refused(_: &Self::Refusal) -> Option<&'static str> {
        None
    }
}

/// A law that can be called by its name.
#[derive(Debug)]
pub struct Declared<L: Kind> {
    /// Name in decks, words joined by `-`.
    pub name: &'static str,
    /// Description in one sentence.
    pub summary: &'static str,
    /// Parameters in the order in which they are stated.
    pub parameters: &'static [Parameter],
    /// Makes the law of the values of all parameters that are given or have a default.
    pub build: fn(&Values) -> Result<L, L::Refusal>,
    /// Relation of its constants to measurements, if there is one.
    pub fit: Option<L::Fit>,
}

/// A parameter of a law, or several in one.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Name in decks; of [`Form::OneOf`] a name for those who read the code.
    pub name: &'static str,
    /// Form of its value.
    pub form: Form,
    /// Unit, such as `force per area`, or [`NO_UNIT`]; empty for a word.
    pub unit: &'static str,
    /// Value where none is given.
    pub absent: Absent,
    /// Description, one sentence or more, without unit and default.
    pub doc: &'static str,
}

/// Form of the value of a parameter.
#[derive(Clone, Copy, Debug)]
pub enum Form {
    /// A finite number within bounds.
    Number(&'static [Bound]),
    /// A list of them.
    Numbers(&'static [Bound]),
    /// One of a few words, each with its description.
    Word(&'static [(&'static str, &'static str)]),
    /// A list of pairs of finite numbers.
    Pairs,
    /// Values of its own parameters.
    Table(&'static Set),
    /// A list of them.
    Tables(&'static Set),
    /// No value of its own: parameters beside the others, exactly one of several sets of them.
    OneOf(&'static [Set]),
}

/// A bound of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// Larger than.
    Above(f64),
    /// Not smaller than.
    AtLeast(f64),
    /// Smaller than.
    Below(f64),
    /// Not larger than.
    AtMost(f64),
}

/// Value of a parameter that is not given.
#[derive(Clone, Copy, Debug)]
pub enum Absent {
    /// There is none: the parameter is required.
    Refused,
    /// A number.
    Number(f64),
    /// A word.
    Word(&'static str),
    /// A number that follows from the parameters before it, and the formula in words.
    Computed(&'static str, fn(&Values) -> f64),
    /// The law does without.
    Nothing,
}

/// A law by its name, and the values it was made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// Name of the law.
    pub law: &'static str,
    /// Values of its parameters, in their order.
    pub values: Values,
}

/// Unit of a ratio.
pub const NO_UNIT: &str = "no unit";
/// Bounds of a number greater than zero.
pub const POSITIVE: &[Bound] = &[Bound::Above(0.0)];
/// Bounds of a number of at least zero.
pub const NOT_NEGATIVE: &[Bound] = &[Bound::AtLeast(0.0)];
/// Bounds of any finite number.
pub const ANY: &[Bound] = &[];
/// Bounds of Poisson's ratio of a compressible solid.
pub const POISSONS_RATIO: &[Bound] = &[Bound::Above(-1.0), Bound::Below(0.5)];

impl Bound {
    /// Returns whether a number respects the bound.
    pub fn admits(self, value: f64) -> bool {
        match self {
            Self::Above(limit) => value > limit,
            Self::AtLeast(limit) => value >= limit,
            Self::Below(limit) => value < limit,
            Self::AtMost(limit) => value <= limit,
        }
    }
}

impl Parameter {
    /// Returns a number that must be given.
    pub const fn number(
        name: &'static str,
        bounds: &'static [Bound],
        unit: &'static str,
        doc: &'static str,
    ) -> Self {
        Self {
            name,
            form: Form::Number(bounds),
            unit,
            absent: Absent::Refused,
            doc,
        }
    }

    /// Returns a list of numbers that must be given.
    pub const fn numbers(
        name: &'static str,
        bounds: &'static [Bound],
        unit: &'static str,
        doc: &'static str,
    ) -> Self {
        Self {
            form: Form::Numbers(bounds),
            ..Self::number(name, bounds, unit, doc)
        }
    }

    /// Returns a word, the first one by default.
    pub const fn word(
        name: &'static str,
        words: &'static [(&'static str, &'static str)],
        doc: &'static str,
    ) -> Self {
        Self {
            form: Form::Word(words),
            absent: Absent::Word(words[0].0),
            ..Self::number(name, ANY, "", doc)
        }
    }

    /// Returns a list of pairs of numbers that must be given.
    pub const fn pairs(name: &'static str, doc: &'static str) -> Self {
        Self {
            form: Form::Pairs,
            ..Self::number(name, ANY, "", doc)
        }
    }

    /// Returns a table of parameters that must be given.
    pub const fn table(name: &'static str, set: &'static Set, doc: &'static str) -> Self {
        Self {
            form: Form::Table(set),
            ..Self::number(name, ANY, "", doc)
        }
    }

    /// Returns a list of tables of parameters that must be given.
    pub const fn tables(name: &'static str, set: &'static Set, doc: &'static str) -> Self {
        Self {
            form: Form::Tables(set),
            ..Self::number(name, ANY, "", doc)
        }
    }

    /// Returns the parameters of exactly one of several sets, or those of the only one.
    pub const fn one_of(name: &'static str, sets: &'static [Set]) -> Self {
        Self {
            form: Form::OneOf(sets),
            ..Self::number(name, ANY, "", "")
        }
    }

    /// Returns the parameter with another value where none is given.
    pub const fn or(self, absent: Absent) -> Self {
        Self { absent, ..self }
    }

    /// Returns whether a value must be given.
    pub fn is_required(&self) -> bool {
        matches!(self.absent, Absent::Refused)
    }

    /// Returns the description with unit and default.
    pub fn told(&self) -> String {
        let doc = match self.unit {
            "" | NO_UNIT => self.doc.to_owned(),
            unit => format!("{} ({unit}).", self.doc.trim_end_matches('.')),
        };
        let default = match self.absent {
            Absent::Refused => return doc,
            Absent::Number(number) => number.to_string(),
            Absent::Word(told) | Absent::Computed(told, _) => format!("`{told}`"),
            Absent::Nothing => "none".to_owned(),
        };
        format!("{doc} Default: {default}.")
    }

    fn default(&self, values: &Values) -> Option<Value> {
        match self.absent {
            Absent::Refused | Absent::Nothing => None,
            Absent::Number(number) => Some(number.into()),
            Absent::Word(word) => Some(word.into()),
            Absent::Computed(_, value) => Some(value(values).into()),
        }
    }
}

impl<L: Kind> Declared<L> {
    /// Returns the statement of a law by values of all its parameters.
    pub fn stated(&self, values: Values) -> Statement {
        Statement {
            law: self.name,
            values,
        }
    }

    /// Makes the law of given values, in any order; others have their defaults.
    ///
    /// # Errors
    /// When the law refuses them.
    ///
    /// # Panics
    /// When a value that is required is not given, or has not the form it must have; see
    /// [`Set::chosen`] for those of several sets.
    pub fn made(&self, given: &Values) -> Result<L, L::Refusal> {
        let values = set::completed(self.parameters, given, Values::default());
        let law = (self.build)(&values)?;
        Ok(law.with_statement(self.stated(values)))
    }
}

/// Returns the law of a list that has a name.
pub fn named<L: Kind>(laws: &[&'static Declared<L>], name: &str) -> Option<&'static Declared<L>> {
    laws.iter().copied().find(|law| law.name == name)
}
