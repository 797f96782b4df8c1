//! Growth of a pattern beyond the couplings of elements.

use serde::{Deserialize, Serialize};
use striae_sparse::Supervariable;

/// Cliques of supervariables that contact and ties couple. The order in which they came
/// does not matter to a [`Partition`](crate::Partition) that has grown by them.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "Vec<Vec<usize>>", into = "Vec<Vec<usize>>")]
pub struct Growth(Vec<Vec<Supervariable>>);

impl Growth {
    /// Returns whether there are no cliques.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The cliques.
    pub(crate) fn cliques(&self) -> &[Vec<Supervariable>] {
        &self.0
    }
}

impl Extend<Vec<Supervariable>> for Growth {
    fn extend<T: IntoIterator<Item = Vec<Supervariable>>>(&mut self, cliques: T) {
        self.0.extend(cliques);
    }
}

impl FromIterator<Vec<Supervariable>> for Growth {
    fn from_iter<T: IntoIterator<Item = Vec<Supervariable>>>(cliques: T) -> Self {
        Self(cliques.into_iter().collect())
    }
}

impl IntoIterator for Growth {
    type Item = Vec<Supervariable>;
    type IntoIter = std::vec::IntoIter<Vec<Supervariable>>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

impl From<Vec<Vec<usize>>> for Growth {
    fn from(cliques: Vec<Vec<usize>>) -> Self {
        let clique = |clique: Vec<usize>| clique.into_iter().map(Supervariable).collect();
        cliques.into_iter().map(clique).collect()
    }
}

impl From<Growth> for Vec<Vec<usize>> {
    fn from(growth: Growth) -> Self {
        let clique = |clique: Vec<Supervariable>| clique.into_iter().map(|at| at.0).collect();
        growth.into_iter().map(clique).collect()
    }
}
