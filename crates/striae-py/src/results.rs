//! Results of a state as arrays.

use std::sync::Arc;

use numpy::{PyArray1, PyArray3, PyArrayMethods};
use pyo3::{exceptions::PyValueError, prelude::*, types::PyDict};
use striae::{
    PairSide,
    element::von_mises,
    mesh::Vec3,
    solve::{drive::Progress, problem::Problem, state::State},
};

use crate::{array::rows, cells::by_kind, side::OfSide};

/// A converged state that is kept.
#[derive(Debug)]
pub struct Kept {
    /// Position of the run.
    pub progress: Progress,
    /// Iterations of Newton's method.
    pub iterations: usize,
    /// The state.
    pub state: State,
}

/// Results of one increment.
#[pyclass(frozen, module = "striae._striae")]
pub struct Results {
    /// The problem.
    pub problem: Arc<Problem>,
    /// The state.
    pub kept: Arc<Kept>,
}

#[pymethods]
impl Results {
    #[getter]
    fn time(&self) -> f64 {
        self.kept.state.time
    }

    #[getter]
    fn step(&self) -> usize {
        self.kept.progress.step
    }

    #[getter]
    fn number(&self) -> usize {
        self.kept.progress.increment
    }

    #[getter]
    fn fraction(&self) -> f64 {
        self.kept.progress.fraction
    }

    #[getter]
    fn iterations(&self) -> usize {
        self.kept.iterations
    }

    /// Energies since the start, by name.
    fn energies<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let energies = &self.kept.state.energies;
        let all = PyDict::new(py);
        all.set_item("kinetic", energies.kinetic)?;
        all.set_item("strain", energies.strain)?;
        all.set_item("external", energies.external)?;
        all.set_item("actuation", energies.actuation)?;
        all.set_item("inelastic", energies.inelastic)?;
        all.set_item("friction", energies.friction)?;
        all.set_item("contact", energies.contact)?;
        all.set_item("stabilisation", energies.stabilisation)?;
        all.set_item("numerical", energies.numerical)?;
        all.set_item("imbalance", energies.imbalance())?;
        Ok(all)
    }

    /// A field of vectors at the nodes of a body.
    fn body<'py>(&self, py: Python<'py>, body: &str, field: &str) -> PyResult<Bound<'py, PyAny>> {
        let results = self.results();
        let vectors = match field {
            "displacement" => results.displacements(body),
            "position" => results.positions(body).map(<[Vec3]>::to_vec),
            "velocity" => results.velocities(body).map(<[Vec3]>::to_vec),
            "contact_force" => results.contact_forces(body).map(<[Vec3]>::to_vec),
            "tie_force" => results.tie_forces(body).map(<[Vec3]>::to_vec),
            "reaction" => results.nodal_reactions(body).map(<[Vec3]>::to_vec),
            _ => None,
        };
        let vectors = vectors.ok_or_else(|| PyValueError::new_err("no such field"))?;
        Ok(rows(py, vectors.into_iter().map(Into::into))?.into_any())
    }

    /// Cauchy stress at the nodes of a body.
    fn stress<'py>(&self, py: Python<'py>, body: &str) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let stress = py.detach(|| self.results().stresses(body).unwrap_or_default());
        let count = stress.len();
        // Symmetric, so rows are columns.
        let numbers = stress.iter().flat_map(|sigma| sigma.iter().copied());
        PyArray1::from_vec(py, numbers.collect()).reshape([count, 3, 3])
    }

    /// Equivalent stress at the nodes of a body.
    fn von_mises<'py>(&self, py: Python<'py>, body: &str) -> Bound<'py, PyArray1<f64>> {
        let stress = py.detach(|| self.results().stresses(body).unwrap_or_default());
        PyArray1::from_vec(py, stress.iter().map(von_mises).collect())
    }

    /// Mean over each element of a body of what its points remember under a name.
    fn remembered<'py>(
        &self,
        py: Python<'py>,
        body: &str,
        name: &str,
    ) -> Option<Bound<'py, PyArray1<f64>>> {
        let bodies = &self.problem.model.bodies;
        let index = bodies.iter().position(|known| known.name == body)?;
        let has_it = bodies[index].remembered().iter().any(|known| known == name);
        let means = has_it.then(|| self.problem.remembered(&self.kept.state, index, name))?;
        let order = by_kind(&bodies[index].mesh).into_iter();
        Some(PyArray1::from_vec(py, order.map(|at| means[at]).collect()))
    }

    /// Nodes of a side of a pair and what is known there.
    fn side<'py>(&self, py: Python<'py>, pair: usize, b: bool) -> PyResult<Bound<'py, PyDict>> {
        let side = if b { PairSide::B } else { PairSide::A };
        let results = self.results();
        let name = &self.problem.model.pairs[pair].name;
        let (Some(nodes), Some(known)) = (
            results.surface_nodes(name, side),
            results.contact(name, side),
        ) else {
            return Ok(PyDict::new(py));
        };
        let body = self.problem.pairs[pair].bodies[side as usize];
        let first = body.map_or(0, |body| self.problem.first_node[body]);
        let positions = &self.kept.state.positions;
        let of_side = OfSide {
            nodes,
            facets: self.problem.pairs[pair].contact.sides[side as usize].surface(),
            positions: &positions[first..],
            known,
        };
        of_side.arrays(py)
    }

    /// Index of the body of a side of a pair.
    fn side_body(&self, pair: usize, b: bool) -> Option<usize> {
        self.problem.pairs[pair].bodies[usize::from(b)]
    }

    /// Resultants and counts of a pair.
    fn pair<'py>(&self, py: Python<'py>, pair: usize) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        let name = &self.problem.model.pairs[pair].name;
        let Some(report) = self.results().pair(name) else {
            return Ok(all);
        };
        for (side, letter) in report.sides.iter().zip(["a", "b"]) {
            let vector = |of: Vec3| PyArray1::from_vec(py, of.iter().copied().collect());
            all.set_item(format!("force_{letter}"), vector(side.force))?;
            all.set_item(format!("moment_{letter}"), vector(side.moment))?;
            all.set_item(format!("area_{letter}"), side.pressed)?;
        }
        all.set_item("mismatch", report.mismatch)?;
        all.set_item("stick", report.stick)?;
        all.set_item("slip", report.slip)?;
        all.set_item("open", report.open)?;
        all.set_item("largest_pressure", report.max_pressure)?;
        all.set_item("dissipated", report.dissipated)?;
        Ok(all)
    }

    /// Resultants of a tie.
    fn tie<'py>(&self, py: Python<'py>, tie: usize) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        let name = &self.problem.model.ties[tie].name;
        let Some(report) = self.results().tie(name) else {
            return Ok(all);
        };
        for (side, letter) in report.sides.iter().zip(["a", "b"]) {
            let vector = |of: Vec3| PyArray1::from_vec(py, of.iter().copied().collect());
            all.set_item(format!("force_{letter}"), vector(side.force))?;
            all.set_item(format!("moment_{letter}"), vector(side.moment))?;
        }
        all.set_item("area", report.area)?;
        all.set_item("mismatch", report.mismatch)?;
        all.set_item("moment_mismatch", report.moment_mismatch)?;
        Ok(all)
    }

    /// Pressure and volume of a cavity.
    fn cavity(&self, name: &str) -> Option<(f64, f64)> {
        let report = self.results().cavity(name)?;
        Some((report.pressure, report.volume))
    }

    /// Tension and elongation of springs, and force on their first end.
    fn spring(&self, name: &str) -> Option<(f64, f64, [f64; 3])> {
        let report = self.results().spring(name)?;
        Some((report.tension, report.elongation, report.force.into()))
    }

    /// Displacement, angles in degrees, force and torque of a rigid body.
    fn rigid(&self, name: &str) -> Option<[[f64; 3]; 4]> {
        let results = self.results();
        let report = results.rigid_body(name)?;
        let force = results.reaction(name)?;
        Some([report.displacement, report.angles, force, report.torque].map(Into::into))
    }

    /// Force that holds a node set, `body.set`, or a rigid body.
    fn reaction(&self, name: &str) -> Option<[f64; 3]> {
        self.results().reaction(name).map(Into::into)
    }
}

impl Results {
    fn results(&self) -> striae::Results<'_> {
        striae::Results::new(&self.problem, &self.kept.state)
    }
}
