//! Laws, textures and mesh generators as they are declared: once, with everything that others say
//! of them.
//!
//! A [`Declared`] law, texture or generator has a name, parameters and a function that makes it of their
//! values. Decks, their schema and reference, the program and the Python package list, read,
//! check and write them from these tables and know none of them.
//!
//! Values are in the words of a deck: angles are in degrees.

pub mod magnitude;
mod parameter;
mod set;
mod terms;
mod value;

pub use parameter::{
    ANY, AXIS, Absent, Bound, Form, LENGTH, NO_UNIT, NOT_NEGATIVE, POISSONS_RATIO, POSITIVE,
    Parameter, Set,
};
pub use set::Choice;
pub use terms::{degrees, read_as, shown};
pub use value::{Value, Values};

use std::fmt;

/// A kind of laws, such as friction, or the textures, or the generators of meshes.
pub trait Kind: Sized + 'static {
    /// Reason to refuse a law.
    type Refusal: std::error::Error;
    /// Relation of constants to measurements; `Infallible` for kinds without one.
    type Fit: fmt::Debug + Sync;

    /// Returns the law with what it was made of, where it is to be written again.
    fn with_statement(self, _: Statement) -> Self {
        self
    }

    /// Returns what the law was made of, if it was made by a declared one and keeps it.
    fn statement(&self) -> Option<&Statement> {
        None
    }

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

/// A law by its name, and the values it was made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// Name of the law.
    pub law: &'static str,
    /// Values of its parameters, in their order.
    pub values: Values,
}

impl<L: Kind> Declared<L> {
    /// Returns the statement of a law by values of all its parameters.
    pub fn stated(&self, values: Values) -> Statement {
        Statement {
            law: self.name,
            values,
        }
    }

    /// Returns given values with the defaults of others, in the order of the parameters.
    pub fn completed(&self, given: &Values) -> Values {
        set::completed(self.parameters, given, Values::default())
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
        let values = self.completed(given);
        let law = (self.build)(&values)?;
        Ok(law.with_statement(self.stated(values)))
    }
}

/// Returns the law of a list that has a name.
pub fn named<L: Kind>(laws: &[&'static Declared<L>], name: &str) -> Option<&'static Declared<L>> {
    laws.iter().copied().find(|law| law.name == name)
}
