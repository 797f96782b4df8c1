//! Generators as decks and the Python package know them: by name, made of values.

use std::convert::Infallible;
use std::fmt::Debug;
use std::sync::Arc;

use crate::{Mesh, MeshError};
use striae_declared::Kind;

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
pub struct Generator(Arc<dyn Generate>);

impl Generator {
    /// Returns the generator as any.
    pub fn of(generator: impl Generate + 'static) -> Self {
        Self(Arc::new(generator))
    }
}

impl Generate for Generator {
    fn mesh(&self) -> Result<Mesh, MeshError> {
        self.0.mesh()
    }

    fn elements(&self) -> Option<u128> {
        self.0.elements()
    }

    fn nodes(&self) -> Option<u128> {
        self.0.nodes()
    }
}

impl Kind for Generator {
    type Refusal = MeshError;
    type Fit = Infallible;
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
