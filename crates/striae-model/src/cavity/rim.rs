//! Rims of cavities: edges at which their surfaces end.
//!
//! Each edge of a closed surface belongs to two of its faces, which pass it in opposite directions;
//! corners of several bodies that are in one place count as one. An edge of one face only is a rim.
//! It must stay in a plane, so both of its nodes have to be held along one direction in all steps,
//! which is normal to the edge. Volumes are counted by a field `D (x - x_0)` of divergence one that
//! lies in all of these planes: `D = I/3` if they have a point `x_0` in common, `D = (I - e e)/2` if
//! some are parallel, with the normal `e`, and the others are at right angles to these.

use std::collections::BTreeMap;

use nalgebra::Matrix3;
use striae_mesh::Vec3;

use crate::{
    axes::are_parallel,
    model::{Model, Value},
    plan::{Prescription, StepPlan},
};

/// Distance from a plane, over the size of the surface, that is round-off.
const ROUND_OFF: f64 = 1e-8;

/// Reason why a surface is not that of a cavity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RimFault {
    /// An edge at which it ends without being held there.
    Open([Vec3; 2]),
    /// An edge of more than two faces, or of two that look to opposite sides.
    Branched([Vec3; 2]),
    /// The planes of its rims neither have a point in common nor are those of a slice.
    Planes,
}

/// A place, by its bits.
type Place = [u64; 3];
/// Body and node.
type Node = (usize, usize);

/// A field by which volumes are counted, `D (x - x_0)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field {
    /// `x_0`.
    pub origin: Vec3,
    /// `D`.
    pub slope: Matrix3<f64>,
}

/// Field that counts the volume of a cavity.
pub(super) fn field(model: &Model, cavity: usize, plans: &[StepPlan]) -> Result<Field, RimFault> {
    let edges = edges(model, cavity)?;
    let place = |(body, node): Node| model.bodies[body].mesh.positions[node];
    let ends = edges.iter().flat_map(|edge| edge.ends.map(place));
    let places: Vec<Vec3> = ends.collect();
    let middle = places.iter().sum::<Vec3>() / places.len().max(1) as f64;
    let size = places
        .iter()
        .map(|x| (x - middle).norm())
        .fold(0.0, f64::max);
    let mut planes: Vec<(Vec3, f64)> = Vec::new();
    for edge in edges
        .iter()
        .filter(|edge| edge.passes == [1, 0] || edge.passes == [0, 1])
    {
        let [a, b] = edge.ends.map(place);
        let held = |node: Node| held(node, plans);
        let normal = held(edge.ends[0]).into_iter().find(|direction| {
            let common = held(edge.ends[1])
                .iter()
                .any(|other| are_parallel(direction, other));
            common && direction.dot(&(b - a)).abs() <= ROUND_OFF * size
        });
        let normal = normal.ok_or(RimFault::Open([a, b]))?;
        let known = planes.iter().any(|(other, offset)| {
            are_parallel(&normal, other) && (other.dot(&a) - offset).abs() <= ROUND_OFF * size
        });
        if !known {
            planes.push((normal, normal.dot(&a)));
        }
    }
    let whole = common_point(&planes, middle, size).map(|origin| Field {
        origin,
        slope: Matrix3::identity() / 3.0,
    });
    whole
        .or_else(|| slice(&planes, middle, size))
        .ok_or(RimFault::Planes)
}

/// Field of a slice between parallel planes.
fn slice(planes: &[(Vec3, f64)], middle: Vec3, size: f64) -> Option<Field> {
    planes.iter().find_map(|(along, _)| {
        let is_across = |(normal, _): &&(Vec3, f64)| !are_parallel(normal, along);
        let across: Vec<(Vec3, f64)> = planes.iter().filter(is_across).copied().collect();
        let is_square = across
            .iter()
            .all(|(normal, _)| normal.dot(along).abs() <= ROUND_OFF);
        let origin = common_point(&across, middle, size).filter(|_| is_square)?;
        let slope = (Matrix3::identity() - along * along.transpose()) * 0.5;
        Some(Field { origin, slope })
    })
}

/// The point nearest to the middle that is in all planes.
fn common_point(planes: &[(Vec3, f64)], middle: Vec3, size: f64) -> Option<Vec3> {
    let mut matrix = Matrix3::zeros();
    let mut right = Vec3::zeros();
    for (normal, offset) in planes {
        matrix += normal * normal.transpose();
        right += normal * (offset - normal.dot(&middle));
    }
    let inverse = matrix.pseudo_inverse(ROUND_OFF);
    let point = middle + inverse.map_or_else(|_| Vec3::zeros(), |inverse| inverse * right);
    let off = |(normal, offset): &(Vec3, f64)| normal.dot(&point) - offset;
    let holds = planes
        .iter()
        .all(|plane| off(plane).abs() <= ROUND_OFF * size);
    holds.then_some(point)
}

/// An edge, and how often faces pass it in each direction.
struct Edge {
    ends: [Node; 2],
    passes: [usize; 2],
}

fn edges(model: &Model, cavity: usize) -> Result<Vec<Edge>, RimFault> {
    let mut edges: BTreeMap<[Place; 2], Edge> = BTreeMap::new();
    for (body, faces) in &model.cavities[cavity].parts {
        let mesh = &model.bodies[body.0].mesh;
        for face in faces {
            let mut corners = mesh.face_nodes(*face).to_vec();
            corners.dedup();
            for (at, from) in corners.iter().enumerate() {
                let to = corners[(at + 1) % corners.len()];
                let ends = [*from, to].map(|node| node.index());
                let places = ends.map(|node| bits(&mesh.positions[node]));
                let turned = places[0] > places[1];
                let key = if turned {
                    [places[1], places[0]]
                } else {
                    places
                };
                let edge = edges.entry(key).or_insert(Edge {
                    ends: ends.map(|node| (body.0, node)),
                    passes: [0; 2],
                });
                edge.passes[usize::from(turned)] += 1;
            }
        }
    }
    let place = |(body, node): Node| model.bodies[body].mesh.positions[node];
    let edges: Vec<Edge> = edges.into_values().collect();
    match edges
        .iter()
        .find(|edge| edge.passes.iter().any(|count| *count > 1))
    {
        Some(edge) => Err(RimFault::Branched(edge.ends.map(place))),
        None => Ok(edges),
    }
}

fn bits(place: &Vec3) -> Place {
    // So that minus zero is zero.
    [place.x, place.y, place.z].map(|x| (x + 0.0).to_bits())
}

/// Directions along which a node stays in all steps.
fn held((body, node): Node, plans: &[StepPlan]) -> Vec<Vec3> {
    let along = |plan: &StepPlan| {
        let axes = (0..3).filter(|axis| {
            let how = plan.displacements.get(&(body, node, *axis));
            how.is_some_and(stays)
        });
        let mut all: Vec<Vec3> = axes.map(|axis| Vec3::ith(axis, 1.0)).collect();
        let oblique = plan.oblique.get(&(body, node)).into_iter().flatten();
        let oblique = oblique.filter(|of| stays(&of.how));
        all.extend(oblique.map(|of| of.direction));
        all
    };
    let mut plans = plans.iter().map(along);
    let first = plans.next().unwrap_or_default();
    plans.fold(first, |mut held, later| {
        held.retain(|one| later.iter().any(|other| are_parallel(one, other)));
        held
    })
}

fn stays(how: &Prescription) -> bool {
    match how {
        Prescription::Hold => true,
        Prescription::Go { target, .. } => *target == Value::Number(0.0),
    }
}
