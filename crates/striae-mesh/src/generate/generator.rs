//! Generators as decks and the Python package know them: by name, made of values.

use std::convert::Infallible;
use std::fmt::Debug;
use std::sync::Arc;

use crate::{Mesh, MeshError};
use striae_declared::{
    Declared, Form, Kind, LENGTH, POSITIVE, Parameter, Statement, Value, Values, named,
};

/// A generator with its parameters.
pub trait Generate: Debug + Send + Sync {
    /// Returns the mesh.
    ///
    /// # Errors
    /// When parameters are out of range or do not fit each other.
    fn mesh(&self) -> Result<Mesh, MeshError>;

    /// Returns about how many elements the mesh will have, as far as that is known before it is
    /// made.
    fn elements(&self) -> Option<u128>;

    /// Returns about how many nodes the mesh will have, likewise.
    fn nodes(&self) -> Option<u128> {
        self.elements()
    }
}

/// Any generator, as a declared one is made of values.
#[derive(Clone, Debug)]
pub struct Generator {
    generator: Arc<dyn Generate>,
    statement: Option<Statement>,
}

impl Generator {
    /// Returns the generator as any.
    pub fn of(generator: impl Generate + 'static) -> Self {
        Self {
            generator: Arc::new(generator),
            statement: None,
        }
    }
}

impl Generate for Generator {
    fn mesh(&self) -> Result<Mesh, MeshError> {
        let declared = self.statement.as_ref().and_then(|statement| {
            named(super::GENERATORS, statement.law).map(|declared| (declared, &statement.values))
        });
        let Some((declared, values)) = declared else {
            return self.generator.mesh();
        };
        check_lengths(declared.parameters, values)?;
        self.generator.mesh().map_err(|error| match error {
            MeshError::Inverted { count, element, .. } => match to_blame(declared, values) {
                Some(parameter) => MeshError::Distorted {
                    count,
                    element,
                    parameter: parameter.name,
                    doc: parameter.doc.trim_end_matches('.'),
                },
                None => error,
            },
            error => error,
        })
    }

    fn elements(&self) -> Option<u128> {
        self.generator.elements()
    }

    fn nodes(&self) -> Option<u128> {
        self.generator.nodes()
    }
}

impl Kind for Generator {
    type Refusal = MeshError;
    type Fit = Infallible;

    fn with_statement(self, statement: Statement) -> Self {
        Self {
            statement: Some(statement),
            ..self
        }
    }

    fn statement(&self) -> Option<&Statement> {
        self.statement.as_ref()
    }
}

/// Lengths of which products of three, and those divided by one, are numbers.
const LENGTHS: std::ops::RangeInclusive<f64> = 1e-100..=1e100;

/// Checks that lengths are not so large or small that volumes are no numbers.
fn check_lengths(parameters: &[Parameter], values: &Values) -> Result<(), MeshError> {
    let lengths = parameters.iter().filter(|one| one.unit == LENGTH);
    for parameter in lengths {
        let numbers = match values.get(parameter.name) {
            Some(Value::Number(number)) => std::slice::from_ref(number),
            Some(Value::Numbers(numbers)) => numbers,
            _ => continue,
        };
        let is_positive = match parameter.form {
            Form::Number(bounds) | Form::Several(_, bounds) => bounds == POSITIVE,
            _ => false,
        };
        for &number in numbers {
            let (holds, requirement) = match is_positive {
                true => (
                    LENGTHS.contains(&number),
                    "it must be at least 1e-100 and at most 1e100",
                ),
                false => (
                    number.abs() <= *LENGTHS.end(),
                    "it must be at most 1e100 in magnitude",
                ),
            };
            MeshError::require(holds, parameter.name, number, requirement)?;
        }
    }
    Ok(())
}

/// The first parameter that shapes elements, differs from its default and without which a mesh can
/// be made.
fn to_blame(declared: &Declared<Generator>, values: &Values) -> Option<&'static Parameter> {
    let mut parameters = declared.parameters.iter();
    parameters.find(|parameter| {
        let shapes = matches!(
            parameter.form,
            Form::Number(_) | Form::Numbers(_) | Form::Several(..) | Form::Table(_)
        );
        let others = values.iter().filter(|(name, _)| *name != parameter.name);
        let others = others.map(|(name, value)| (name, value.clone()));
        let others = declared.completed(&others.collect());
        let is_given = others.get(parameter.name) != values.get(parameter.name);
        let made = || (declared.build)(&others).and_then(|one| one.generator.mesh());
        shapes && !parameter.is_required() && is_given && made().is_ok()
    })
}

/// Returns the product of counts.
pub(super) fn product(counts: &[usize]) -> u128 {
    let counts = counts.iter().map(|count| *count as u128);
    counts.fold(1, u128::saturating_mul)
}

/// Returns the number of nodes of a lattice of so many intervals.
pub(super) fn lattice_nodes(divisions: &[usize; 3]) -> u128 {
    product(&divisions.map(|count| count.saturating_add(1)))
}
