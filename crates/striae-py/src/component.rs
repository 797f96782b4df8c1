//! Contact for other finite-element programs: pairs, increments, evaluations and states.

mod evaluation;
mod pairs;
mod state;

pub use evaluation::Evaluation;
pub use pairs::{MeshPair, MeshSurface};
pub use state::State;

use std::sync::Arc;

use numpy::{PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use striae::{
    contact::{
        component::{self, Faults, Imposed},
        placement::Placement,
    },
    mesh::NodeId,
    nalgebra::Matrix3,
};

use crate::{
    array::{Array1, node_array, vectors},
    fault::model_error,
};

/// A pair, its rotation by rows and its shift.
type Placed = (usize, [[f64; 3]; 3], [f64; 3]);

/// Surfaces that may touch.
#[pyclass(frozen, module = "striae._striae")]
pub struct Contact(component::Contact);

#[pymethods]
impl Contact {
    #[new]
    fn new(points: PyReadonlyArray2<'_, f64>, pairs: Vec<PyRef<'_, MeshPair>>) -> PyResult<Self> {
        let pairs: Vec<_> = pairs.iter().map(|pair| pair.0.clone()).collect();
        let made = component::Contact::new(vectors(&points)?, &pairs);
        made.map(Self).map_err(refused)
    }

    /// The state in which nothing has touched yet.
    fn untouched(&self) -> State {
        State(self.0.untouched())
    }

    /// Begins an increment; rigid sides without a placement stay where they are.
    fn begin(
        &self,
        py: Python<'_>,
        state: &State,
        prescribed: Vec<bool>,
        positions: [Option<PyReadonlyArray2<'_, f64>>; 2],
        placed: Vec<Placed>,
        duration: f64,
    ) -> PyResult<Increment> {
        let given = |array: &Option<PyReadonlyArray2<'_, f64>>| {
            let given = array.as_ref().map(vectors).transpose();
            given.map(Option::unwrap_or_default)
        };
        let mut placements = state.0.placements().to_vec();
        for (pair, rotation, shift) in placed {
            if let Some(placement) = placements.get_mut(pair) {
                *placement = Placement {
                    rotation: Matrix3::from_fn(|row, column| rotation[row][column]),
                    shift: shift.into(),
                };
            }
        }
        let imposed = Imposed {
            prescribed,
            end: given(&positions[0])?,
            predicted: given(&positions[1])?,
            placements,
            duration,
        };
        let begun = py.detach(|| self.0.begin(&state.0, &imposed));
        begun.map(Increment).map_err(refused)
    }
}

/// An increment.
#[pyclass(frozen, module = "striae._striae")]
pub struct Increment(component::Increment);

#[pymethods]
impl Increment {
    /// Number of unknowns.
    fn unknowns(&self) -> usize {
        self.0.unknowns()
    }

    /// Traction unknowns at the start.
    fn tractions<'py>(&self, py: Python<'py>) -> Array1<'py, f64> {
        PyArray1::from_vec(py, self.0.tractions())
    }

    /// Pair, side and node of the kept nodes.
    fn kept<'py>(&self, py: Python<'py>) -> (Vec<usize>, Vec<usize>, Array1<'py, i64>) {
        let kept = self.0.kept();
        let nodes: Vec<NodeId> = kept.iter().map(|(_, _, node)| *node).collect();
        let pairs = kept.iter().map(|(pair, _, _)| *pair).collect();
        let sides = kept.iter().map(|(_, side, _)| side.index()).collect();
        (pairs, sides, node_array(py, &nodes))
    }

    fn evaluate(
        &self,
        py: Python<'_>,
        positions: PyReadonlyArray2<'_, f64>,
        tractions: PyReadonlyArray1<'_, f64>,
        after: Option<PyRef<'_, Evaluation>>,
    ) -> PyResult<Evaluation> {
        let (x, t) = (vectors(&positions)?, tractions.as_array().to_vec());
        let after = after.as_ref().map(|after| after.0.clone());
        let found = py.detach(|| self.0.evaluate(&x, &t, after.as_deref()));
        found
            .map(|found| Evaluation(Arc::new(found)))
            .map_err(refused)
    }

    /// Nodes that have met the other side without a share in the tractions.
    fn missed<'py>(&self, py: Python<'py>, found: &Evaluation) -> PyResult<Array1<'py, i64>> {
        let missed = self.0.missed(&found.0).map_err(refused)?;
        Ok(node_array(py, &missed))
    }

    fn reselected(&self, found: &Evaluation) -> PyResult<Self> {
        self.0.reselected(&found.0).map(Self).map_err(refused)
    }

    fn accept(&self, found: &Evaluation) -> PyResult<State> {
        self.0.accept(&found.0).map(State).map_err(refused)
    }
}

/// `striae.ModelError` with these faults.
fn refused(Faults(faults): Faults) -> PyErr {
    let faults = faults.into_iter();
    model_error(
        faults
            .map(|fault| (fault.place, fault.kind.to_string()))
            .collect(),
    )
}
