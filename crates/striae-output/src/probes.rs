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

use crate::{
    OutputError, Probe, ProbePlace,
    bodies::stress,
    history::History,
    ranks::{agreed, on_first, told},
};

/// Probes of a problem and their file, which rank 0 writes.
pub(crate) struct Probes {
    placed: Vec<Placed>,
    file: Option<History>,
}

struct Placed {
    name: String,
    body: usize,
    weights: Vec<(NodeId, f64)>,
}

impl Probes {
    /// Finds all probes, and continues their file after so many rows; collective.
    ///
    /// # Errors
    /// Returns the fault of the first probe that is nowhere, or an error if there are no such rows.
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
        let file = on_first(&problem.share, || History::after(path, rows))?;
        Ok(Self { placed, file })
    }

    /// Writes the row of an increment; collective.
    pub(crate) fn append(
        &mut self,
        problem: &Problem,
        progress: Progress,
        state: &State,
    ) -> Result<(), OutputError> {
        let row = self.row(problem, progress, state);
        let named: Vec<(&str, f64)> = row.iter().map(|(n, v)| (n.as_str(), *v)).collect();
        let appended = self
            .file
            .as_mut()
            .map_or(Ok(()), |file| file.append(&named));
        agreed(&problem.share, appended)
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
        let weights = match problem.share.is_alone() {
            true => weights(&bodies[body].mesh, &probe.place),
            false => shared_weights(problem, body, &probe.place),
        };
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
        let columns = [0, 1, 2].map(|column| sigma.column(column).into_owned());
        let mut sums = [u, columns[0], columns[1], columns[2]];
        problem.share.sum_vectors(&mut sums);
        let (u, sigma) = (sums[0], Matrix3::from_columns(&sums[1..]));
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

/// Nodes of a rank with their weights: those of a place in an element are on one rank, those
/// of a set are with the ranks that own them. Collective.
fn shared_weights(
    problem: &Problem,
    body: usize,
    place: &ProbePlace,
) -> Result<Vec<(NodeId, f64)>, String> {
    let (mesh, share) = (&problem.model.bodies[body].mesh, &problem.share);
    if let ProbePlace::Nodes(set) = place {
        let nodes = mesh.node_sets.get(set).map_or(&[][..], |nodes| nodes);
        let own = nodes.iter();
        let own = own.filter(|node| share.owns(problem.node(body, **node)));
        let count = share.sum(own.clone().count() as f64);
        return match count > 0.0 {
            true => Ok(own.map(|node| (*node, 1.0 / count)).collect()),
            false => Err(format!("the body has no node in a set `{set}`")),
        };
    }
    let own = weights(mesh, place);
    let depth = |weights: &[(NodeId, f64)]| {
        let values = weights.iter().map(|(_, weight)| *weight);
        values.fold(f64::INFINITY, f64::min)
    };
    let own_depth = own.as_deref().ok().map(depth);
    let deepest = told(share, &own_depth).into_iter().enumerate();
    let deepest = deepest.filter_map(|(rank, depth)| depth.map(|depth| (rank, depth)));
    let better = |best: (usize, f64), next: (usize, f64)| match next.1 > best.1 {
        true => next,
        false => best,
    };
    match deepest.reduce(better) {
        Some((rank, _)) if rank == share.team().rank() => own,
        Some(_) => Ok(Vec::new()),
        None => own,
    }
}

/// Nodes with their weights.
///
/// # Errors
/// Returns why there are none.
pub fn weights(mesh: &Mesh, place: &ProbePlace) -> Result<Vec<(NodeId, f64)>, String> {
    match place {
        ProbePlace::Point(x) => match mesh.locate(x) {
            Some(located) => Ok(located.weights),
            None => Err(format!("({}, {}, {}) is outside the body", x.x, x.y, x.z)),
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
