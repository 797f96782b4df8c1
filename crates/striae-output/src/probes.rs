//! Displacement and stress at chosen places, a row an increment.
//!
//! Values at a point are interpolated from the corners of its element, those of a set of
//! nodes are the mean over them. Columns are `NAME.displacement.x`, ...,
//! `NAME.stress.xx`, `.yy`, `.zz`, `.xy`, `.yz`, `.xz`, `NAME.von_mises`.

use std::path::PathBuf;

use nalgebra::Matrix3;
use striae_element::von_mises;
use striae_mesh::{Mesh, NodeId, Vec3};
use striae_solve::{drive::Progress, problem::Problem, state::State};

use crate::{OutputError, Probe, ProbePlace, bodies::stress, history::History};

/// Probes of a problem and their file.
pub(crate) struct Probes {
    placed: Vec<Placed>,
    file: History,
}

struct Placed {
    name: String,
    body: usize,
    weights: Vec<(NodeId, f64)>,
}

impl Probes {
    /// Finds all probes, and goes on with their file after so many rows.
    ///
    /// # Errors
    /// What is wrong with the first probe that is nowhere, or when there are no such rows.
    pub(crate) fn open(
        path: PathBuf,
        problem: &Problem,
        probes: &[Probe],
        rows: usize,
    ) -> Result<Self, OutputError> {
        let placed = probes.iter().map(|probe| Placed::new(problem, probe));
        let placed = placed.collect::<Result<_, String>>();
        let placed = placed.map_err(|cause| OutputError::Content {
            path: path.clone(),
            cause,
        })?;
        let file = History::after(path, rows)?;
        Ok(Self { placed, file })
    }

    /// Writes the row of an increment.
    pub(crate) fn append(
        &mut self,
        problem: &Problem,
        progress: Progress,
        state: &State,
    ) -> Result<(), OutputError> {
        let row = self.row(problem, progress, state);
        let named: Vec<(&str, f64)> = row.iter().map(|(n, v)| (n.as_str(), *v)).collect();
        self.file.append(&named)
    }

    fn row(&self, problem: &Problem, progress: Progress, state: &State) -> Vec<(String, f64)> {
        let mut row = vec![
            ("increment".to_owned(), progress.increment as f64),
            ("time".to_owned(), state.time),
        ];
        let mut stresses: Vec<Option<Vec<Matrix3<f64>>>> = vec![None; problem.model.bodies.len()];
        for probe in &self.placed {
            let stress = stresses[probe.body]
                .get_or_insert_with(|| stress(problem, state, probe.body).unwrap_or_default());
            probe.add(&mut row, problem, state, stress);
        }
        row
    }
}

impl Placed {
    fn new(problem: &Problem, probe: &Probe) -> Result<Self, String> {
        let name = &probe.name;
        let bodies = &problem.model.bodies;
        let body = bodies.iter().position(|body| body.name == probe.body);
        let body = body.ok_or_else(|| {
            let body = &probe.body;
            format!("there is no body `{body}`, in which probe `{name}` is")
        })?;
        let weights = weights(&bodies[body].mesh, &probe.place);
        Ok(Self {
            name: name.clone(),
            body,
            weights: weights.map_err(|cause| format!("probe `{name}`: {cause}"))?,
        })
    }

    /// Adds the columns of the probe; `stress` is that of its body.
    fn add(
        &self,
        row: &mut Vec<(String, f64)>,
        problem: &Problem,
        state: &State,
        stress: &[Matrix3<f64>],
    ) {
        let name = &self.name;
        let at = |node: NodeId| problem.node(self.body, node);
        let displacement = |node: NodeId| state.positions[at(node)] - problem.reference[at(node)];
        let weights = self.weights.iter();
        let u: Vec3 = weights
            .clone()
            .map(|(node, weight)| displacement(*node) * *weight)
            .sum();
        let of_node = |node: &NodeId| stress.get(node.index()).copied().unwrap_or_default();
        let sigma: Matrix3<f64> = weights.map(|(node, weight)| of_node(node) * *weight).sum();
        for (axis, value) in ["x", "y", "z"].iter().zip(u.iter()) {
            row.push((format!("{name}.displacement.{axis}"), *value));
        }
        for (component, at) in [
            ("xx", (0, 0)),
            ("yy", (1, 1)),
            ("zz", (2, 2)),
            ("xy", (0, 1)),
            ("yz", (1, 2)),
            ("xz", (0, 2)),
        ] {
            row.push((format!("{name}.stress.{component}"), sigma[at]));
        }
        row.push((format!("{name}.von_mises"), von_mises(&sigma)));
    }
}

/// Nodes with their weights.
///
/// # Errors
/// Why there are none.
pub fn weights(mesh: &Mesh, place: &ProbePlace) -> Result<Vec<(NodeId, f64)>, String> {
    match place {
        ProbePlace::Point(x) => match mesh.locate(x) {
            Some(located) => Ok(located.weights),
            None => Err(format!(
                "({}, {}, {}) is outside of the body",
                x.x, x.y, x.z
            )),
        },
        ProbePlace::Nodes(set) => match mesh.node_sets.get(set) {
            Some(nodes) if !nodes.is_empty() => {
                let weight = 1.0 / nodes.len() as f64;
                Ok(nodes.iter().map(|node| (*node, weight)).collect())
            }
            Some(_) => Err(format!("node set `{set}` is empty")),
            None => Err(format!("the body has no node set `{set}`")),
        },
    }
}
