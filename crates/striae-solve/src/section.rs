//! Force and moment through a plane cut of a body.
//!
//! A plane of the reference configuration divides the elements of a body by the places of
//! their centroids. The section is the faces between both parts; they stay the same as the
//! body deforms. What the part in front of the plane exerts on the part behind it is the
//! sum of the internal forces `f_I` of the elements behind over the nodes of these faces,
//!
//! ```text
//! F = sum_I f_I,   M = sum_I (x_I - c) x f_I,
//! A n = sum of the area vectors of the faces, out of the part behind,
//! c   = centroid of the faces
//! ```
//!
//! in the current configuration. In equilibrium `F` and `M` balance what acts on the part
//! behind to the residual of Newton's method, however rough the faces are; loads on the
//! nodes of the section itself, and their inertia, count for the part in front. Tension is
//! positive along `n`.
//!
//! If ranks share a body, each has those elements behind the plane that it owns, and their faces.

mod borders;

use std::collections::BTreeSet;

use striae_law::bulk::Past;
use striae_mesh::{ElementId, Face, Mesh, NodeId, Vec3, sorted_face};

use crate::{problem::Problem, share::Share, state::State};
use borders::Borders;

/// A cut of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Elements behind the plane with a node of the section, and which of their corners are.
    elements: Vec<(ElementId, Vec<usize>)>,
    /// Faces of the section, out of the part behind; a triangle repeats its last corner.
    faces: Vec<[NodeId; 4]>,
}

/// Reason why a plane is not a section of a body.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SectionError {
    /// No direction.
    #[error("its normal is zero")]
    Normal,
    /// All elements are on one side.
    #[error("all elements of the body are {0}")]
    OneSided(Part),
    /// No face is shared by both parts.
    #[error("no element face lies between the parts in front of and behind the plane")]
    Apart,
}

/// Position of elements relative to a plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// On the side that the normal points to.
    Front,
    /// On the other one.
    Behind,
}

impl std::fmt::Display for Part {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Front => "in front of the plane",
            Self::Behind => "behind the plane",
        })
    }
}

/// Force and moment through a section, that the part in front exerts on the part behind.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionReport {
    /// Force.
    pub force: Vec3,
    /// Moment about the centre.
    pub moment: Vec3,
    /// Centroid of the section.
    pub centre: Vec3,
    /// Length of the sum of its area vectors: the area of a plane with the same edge.
    pub area: f64,
    /// Unit normal, out of the part behind.
    pub normal: Vec3,
}

impl SectionReport {
    /// Force along the normal, tension positive.
    pub fn normal_force(&self) -> f64 {
        self.force.dot(&self.normal)
    }

    /// Length of the force across the normal.
    pub fn shear_force(&self) -> f64 {
        (self.force - self.normal * self.normal_force()).norm()
    }
}

impl Section {
    /// The cut of a mesh by the plane through `point` with a `normal` of any length.
    ///
    /// # Errors
    /// When the plane does not divide the elements.
    pub fn new(mesh: &Mesh, point: &Vec3, normal: &Vec3) -> Result<Self, SectionError> {
        Self::cut(mesh, point, normal, &Borders::of_whole())
    }

    /// Part of the cut of a body that a rank holds; collective.
    ///
    /// # Errors
    /// If the plane does not divide the elements of the whole body.
    pub fn of(
        problem: &Problem,
        body: usize,
        point: &Vec3,
        normal: &Vec3,
    ) -> Result<Self, SectionError> {
        let mesh = &problem.model.bodies[body].mesh;
        Self::cut(mesh, point, normal, &Borders::new(problem, body))
    }

    fn cut(
        mesh: &Mesh,
        point: &Vec3,
        normal: &Vec3,
        borders: &Borders,
    ) -> Result<Self, SectionError> {
        if *normal == Vec3::zeros() {
            return Err(SectionError::Normal);
        }
        let is_behind: Vec<bool> = mesh
            .elements()
            .map(|corners| {
                let sum: Vec3 = corners.iter().map(|c| mesh.positions[c.index()]).sum();
                (sum / corners.len() as f64 - point).dot(normal) < 0.0
            })
            .collect();
        let [front, behind] = [false, true].map(|side| is_behind.contains(&side));
        match borders.any_of([front, behind])[..] {
            [true, true] => {}
            [_, false] => return Err(SectionError::OneSided(Part::Front)),
            _ => return Err(SectionError::OneSided(Part::Behind)),
        }
        let faces = between(mesh, &is_behind, borders);
        if borders.any_of([!faces.is_empty()]) != [true] {
            return Err(SectionError::Apart);
        }
        let mut on_section = vec![false; mesh.positions.len()];
        for node in faces.iter().flatten() {
            on_section[node.index()] = true;
        }
        let on_section = borders.any_at_nodes(on_section);
        let behind = mesh.elements().enumerate().filter(|(at, _)| is_behind[*at]);
        let elements = behind.filter_map(|(at, corners)| {
            let corners = corners.iter().enumerate();
            let on_it = corners.filter(|(_, node)| on_section[node.index()]);
            let on_it: Vec<usize> = on_it.map(|(corner, _)| corner).collect();
            (!on_it.is_empty()).then(|| (ElementId::new(at), on_it))
        });
        Ok(Self {
            elements: elements.collect(),
            faces,
        })
    }

    /// Force and moment through the section of a body in a state; collective.
    pub fn report(&self, problem: &Problem, state: &State, body: usize) -> SectionReport {
        let mesh = &problem.model.bodies[body].mesh;
        let at = |node: NodeId| state.positions[problem.node(body, node)];
        let (normal, area, centre) = self.geometry(&problem.share, at);
        let mut sums = [Vec3::zeros(); 2];
        for (element, on_section) in &self.elements {
            let forces = internal_forces(problem, state, body, *element);
            let corners = mesh.corners(*element);
            for &corner in on_section {
                let f = forces[corner];
                sums[0] += f;
                sums[1] += (at(corners[corner]) - centre).cross(&f);
            }
        }
        problem.share.sum_vectors(&mut sums);
        let [force, moment] = sums;
        SectionReport {
            force,
            moment,
            centre,
            area,
            normal,
        }
    }

    /// Unit normal, area and centroid.
    fn geometry(&self, share: &Share, at: impl Fn(NodeId) -> Vec3) -> (Vec3, f64, Vec3) {
        let (mut vector, mut total, mut centre) = (Vec3::zeros(), 0.0, Vec3::zeros());
        for face in &self.faces {
            let [a, b, c, d] = face.map(&at);
            for [p, q, r] in [[a, b, c], [a, c, d]] {
                let area = (q - p).cross(&(r - p)) * 0.5;
                vector += area;
                total += area.norm();
                centre += (p + q + r) * (area.norm() / 3.0);
            }
        }
        let mut sums = [vector, centre];
        share.sum_vectors(&mut sums);
        let ([vector, centre], total) = (sums, share.sum(total));
        (vector.normalize(), vector.norm(), centre / total)
    }
}

/// Faces of elements behind that elements in front share, also those of other ranks.
fn between(mesh: &Mesh, is_behind: &[bool], borders: &Borders) -> Vec<[NodeId; 4]> {
    let faces_of = |at: usize| {
        let element = ElementId::new(at);
        let sides = 0..mesh.kind(element).shape().faces.len() as u8;
        sides.map(move |side| mesh.face_nodes(Face { element, side }))
    };
    let (behind, front): (Vec<usize>, Vec<usize>) =
        (0..is_behind.len()).partition(|at| is_behind[*at]);
    let in_front = front.into_iter().flat_map(faces_of).map(sorted_face);
    let mut in_front: BTreeSet<[NodeId; 4]> = in_front.collect();
    in_front.extend(borders.in_front(mesh, is_behind));
    let faces = behind.into_iter().flat_map(faces_of);
    faces
        .filter(|nodes| in_front.contains(&sorted_face(*nodes)))
        .collect()
}

/// Internal forces of an element on its corners; zero where it is turned inside out.
fn internal_forces(problem: &Problem, state: &State, body: usize, element: ElementId) -> Vec<Vec3> {
    let model = &problem.model.bodies[body];
    let corners = model.mesh.corners(element);
    let x: Vec<Vec3> = (problem.nodes(body, corners).into_iter())
        .map(|node| state.positions[node])
        .collect();
    let solid = problem.elements[body].get(element);
    let (driven, variables) = problem.made_of(state, body, element);
    let elapsed = 0.0;
    let past = Past { variables, elapsed };
    match solid.response(&x, driven, past) {
        Ok(response) => response.force.into_iter().map(Vec3::from).collect(),
        Err(_) => vec![Vec3::zeros(); corners.len()],
    }
}
