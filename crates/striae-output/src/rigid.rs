//! Rigid surfaces as grids, with their textures.
//!
//! Facets are those of the model. A plane has no end: what is shown of it covers the
//! bodies of the pairs it belongs to, seen along its normal, wherever prescribed
//! displacements take them, and a margin of [`MARGIN`] times the longer edge. It is
//! divided into squares, [`SQUARES`] along that edge.

use std::path::{Path, PathBuf};

use striae_contact::{pair::Geometry, texture::SideTexture};
use striae_mesh::{NodeId, Vec3};
use striae_model::{Freedom, RigidId, RigidShape, plan::starts};
use striae_solve::{problem::Problem, state::State};
use striae_surface::{node::SurfaceNode, normal::nodal_normals};

use crate::{
    OutputError,
    parts::{Parts, file},
    vtk::{self, Array, Cells, Grid, Values},
};

/// Squares along the longer edge of a plane.
const SQUARES: f64 = 24.0;

/// By how much a plane reaches beyond its bodies on every edge, over the longer edge.
const MARGIN: f64 = 0.15;

/// A rigid surface at rest, with its texture.
#[derive(Clone, Debug)]
pub(crate) struct RigidGrid {
    name: String,
    rigid: usize,
    positions: Vec<Vec3>,
    facets: Vec<Vec<NodeId>>,
    /// `s` and `a = n x s`, where a pair has painted it; zero where they have no direction.
    texture: Option<[Vec<Vec3>; 2]>,
}

impl RigidGrid {
    /// All rigid bodies that have a surface.
    pub(crate) fn all(problem: &Problem) -> Vec<Self> {
        let count = problem.model.rigid_surfaces.len();
        (0..count)
            .filter_map(|rigid| Self::new(problem, rigid))
            .collect()
    }

    fn new(problem: &Problem, rigid: usize) -> Option<Self> {
        let surface = &problem.model.rigid_surfaces[rigid];
        let (positions, facets) = match &surface.shape {
            RigidShape::Bare => return None,
            RigidShape::Plane { point, normal } => {
                patch(*point, normal.normalize(), &covered(problem, rigid))?
            }
            RigidShape::Facets { positions, facets } => {
                let open = facets.iter().map(|corners| {
                    let mut corners = corners.to_vec();
                    corners.dedup();
                    corners
                });
                (positions.clone(), open.collect())
            }
        };
        Some(Self {
            name: surface.name.clone(),
            texture: painted(problem, rigid, &positions),
            rigid,
            positions,
            facets,
        })
    }

    /// Writes the surface after so many increments; returns its name and its file.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub(crate) fn write(
        &self,
        folder: &Path,
        (problem, parts): (&Problem, &Parts),
        state: &State,
        count: usize,
    ) -> Result<(String, PathBuf), OutputError> {
        let file = file(&parts.rigid[self.rigid], count);
        let points = self.points(problem, state);
        vtk::write(&folder.join(&file), &self.grid(&points, state))?;
        Ok((self.name.clone(), file))
    }

    /// Positions where the surface is in a state.
    fn points(&self, problem: &Problem, state: &State) -> Vec<Vec3> {
        let reference = problem.model.rigid_surfaces[self.rigid].reference;
        let pose = &state.rigid[self.rigid];
        let moved = |x: &Vec3| pose.rotation * (x - reference) + reference + pose.displacement;
        self.positions.iter().map(moved).collect()
    }

    /// The surface at these points.
    fn grid<'a>(&'a self, points: &'a [Vec3], state: &State) -> Grid<'a> {
        let displacement = points.iter().zip(&self.positions).map(|(x, rest)| x - rest);
        let vectors = |name, vectors: Vec<Vec3>| Array::new(name, Values::Vectors(vectors));
        let mut point_arrays = vec![vectors("displacement", displacement.collect())];
        if let Some(axes) = &self.texture {
            let rotation = state.rigid[self.rigid].rotation;
            for (name, axis) in ["texture", "structural_vector"].into_iter().zip(axes) {
                let turned = axis.iter().map(|vector| rotation * vector);
                point_arrays.push(vectors(name, turned.collect()));
            }
        }
        Grid {
            points,
            cells: Cells::Polygons(&self.facets),
            point_arrays,
            cell_arrays: Vec::new(),
            time: state.time,
        }
    }
}

/// Squares of a plane that cover what stands before it; none where nothing does.
fn patch(point: Vec3, normal: Vec3, covered: &[Vec3]) -> Option<(Vec<Vec3>, Vec<Vec<NodeId>>)> {
    let axes = in_plane(normal);
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for x in covered {
        for (axis, e) in axes.iter().enumerate() {
            let place = e.dot(&(x - point));
            low[axis] = low[axis].min(place);
            high[axis] = high[axis].max(place);
        }
    }
    let widest = (high[0] - low[0]).max(high[1] - low[1]);
    if !(widest > 0.0 && widest.is_finite()) {
        return None;
    }
    let margin = MARGIN * widest;
    let edges = [0, 1].map(|axis| high[axis] - low[axis] + 2.0 * margin);
    let size = edges[0].max(edges[1]) / SQUARES;
    let counts = edges.map(|edge| ((edge / size).round() as usize).max(1));
    let place = |axis: usize, index: usize| {
        axes[axis] * (low[axis] - margin + edges[axis] * index as f64 / counts[axis] as f64)
    };
    let rows = (0..=counts[1]).flat_map(|j| (0..=counts[0]).map(move |i| (i, j)));
    let positions = rows.map(|(i, j)| point + place(0, i) + place(1, j));
    let row = counts[0] + 1;
    let squares = (0..counts[1]).flat_map(|j| (0..counts[0]).map(move |i| j * row + i));
    let corners = |first: usize| [first, first + 1, first + row + 1, first + row];
    let facets = squares.map(|first| corners(first).map(NodeId::new).to_vec());
    Some((positions.collect(), facets.collect()))
}

/// Two unit vectors in a plane, along coordinate axes where that is possible, with
/// `e_1 x e_2 = n`.
fn in_plane(normal: Vec3) -> [Vec3; 2] {
    let axis = Vec3::ith(if normal.x.abs() < 0.9 { 0 } else { 1 }, 1.0);
    let first = (axis - normal * normal.dot(&axis)).normalize();
    [first, normal.cross(&first)]
}

/// Corners of the boxes about the bodies that may touch a rigid surface, at rest and
/// where each step takes them, relative to the surface.
fn covered(problem: &Problem, rigid: usize) -> Vec<Vec3> {
    let mut corners = Vec::new();
    for pair in problem
        .pairs
        .iter()
        .filter(|pair| pair.rigid == Some(rigid))
    {
        let Some(body) = pair.bodies[0] else { continue };
        let nodes = problem.first_node[body]..problem.first_node[body + 1];
        let positions = &problem.reference[nodes];
        let low = positions.iter().fold(positions[0], |low, x| low.inf(x));
        let high = positions.iter().fold(positions[0], |high, x| high.sup(x));
        for shift in travels(problem, body, rigid) {
            corners.extend([low + shift, high + shift]);
            for axis in 0..3 {
                let mut corner = low;
                corner[axis] = high[axis];
                corners.push(corner + shift);
                let mut corner = high;
                corner[axis] = low[axis];
                corners.push(corner + shift);
            }
        }
    }
    corners
}

/// Displacements of a body relative to a rigid surface at the ends of the steps, as far
/// as they are prescribed for it or for what it is tied to.
fn travels(problem: &Problem, body: usize, rigid: usize) -> Vec<Vec3> {
    let model = &problem.model;
    let holds_body = |at: usize| {
        let ties = &model.rigid_surfaces[at].ties;
        ties.iter().any(|(tied, _)| tied.0 == body)
    };
    let (mut travels, mut to) = (vec![Vec3::zeros()], [Vec3::zeros(); 2]);
    for (step, start) in model.steps.iter().zip(starts(model)) {
        for displacement in step.displacements.iter().filter(|d| d.body.0 == body) {
            // A function stands for what it is at one of the nodes.
            let node = displacement.nodes.first();
            let x = node.map(|node| model.bodies[body].mesh.positions[node.index()]);
            let Some(x) = x else { continue };
            let directions = displacement.axes.directions(&x).into_iter();
            let stated = directions.zip(&displacement.components).enumerate();
            for (axis, (direction, target)) in stated {
                if let (Some(direction), Some(target)) = (direction, target) {
                    let along = target.at(&x, start.later(1.0).time);
                    match displacement.axes.are_global() {
                        true => to[0][axis] = along,
                        false => to[0] += direction * (along - direction.dot(&to[0])),
                    }
                }
            }
        }
        for motion in &step.rigid_motions {
            let RigidId(moved) = motion.surface;
            let own = if moved == rigid {
                1
            } else if holds_body(moved) {
                0
            } else {
                continue;
            };
            for axis in 0..3 {
                if let Freedom::To(target) = motion.coordinates[axis] {
                    to[own][axis] = target;
                }
            }
        }
        travels.push(to[0] - to[1]);
    }
    travels
}

/// The texture of the first pair that paints a rigid surface, at these positions at rest.
fn painted(problem: &Problem, rigid: usize, positions: &[Vec3]) -> Option<[Vec<Vec3>; 2]> {
    let mut sides = problem.pairs.iter().filter_map(|pair| {
        let side = &pair.contact.sides[1];
        let texture = side
            .texture
            .as_ref()
            .filter(|_| pair.rigid == Some(rigid))?;
        Some((&side.geometry, texture, &pair.rigid_reference))
    });
    let (geometry, texture, reference) = sides.next()?;
    let mut axes = [(); 2].map(|()| vec![Vec3::zeros(); positions.len()]);
    match (geometry, texture) {
        (Geometry::Plane { normal, .. }, SideTexture::Plane(field)) => {
            for (at, x) in positions.iter().enumerate() {
                if let Some(found) = field.axes(*x, *normal) {
                    axes[0][at] = found.s;
                    axes[1][at] = found.a;
                }
            }
        }
        (Geometry::Rigid(surface), SideTexture::Nodal(texture)) => {
            let normals = nodal_normals(surface, reference);
            for (own, node) in surface.nodes().iter().enumerate() {
                if let Ok(found) = texture.at(SurfaceNode::new(own), reference, normals[own]) {
                    axes[0][node.index()] = found.s;
                    axes[1][node.index()] = found.a;
                }
            }
        }
        _ => return None,
    }
    Some(axes)
}
