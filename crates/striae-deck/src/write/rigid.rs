//! Rigid bodies.

use striae_declared::read_as;
use striae_model::{RigidInertia, RigidShape, RigidSurface, solid};

use super::Writer;
use super::mesh::corners;
use super::value::{direction, lines, list, number, text, vector};

impl Writer<'_> {
    /// A rigid body.
    pub(super) fn rigid(&mut self, at: usize) -> String {
        let rigid = &self.model.rigid_surfaces[at];
        let part = || format!("rigid body `{}`", rigid.name);
        let shape = match &rigid.shape {
            RigidShape::Plane { point, normal } => {
                let (point, normal) = (vector(point), vector(&direction(normal)));
                format!("plane = {{ point = {point}, normal = {normal} }}\n")
            }
            RigidShape::Facets { positions, facets } => {
                let positions = lines(positions.iter().map(vector));
                let facets = lines(facets.iter().map(|facet| corners(facet)));
                format!("mesh = {{ positions = {positions}, facets = {facets} }}\n")
            }
            RigidShape::Bare => {
                let ties = rigid.ties.iter().map(|(body, nodes)| {
                    let set = text(&self.meshes.nodes(*body, "", nodes));
                    let body = text(&self.model.bodies[body.0].name);
                    format!("{{ body = {body}, nodes = {set} }}")
                });
                format!("tied = {}\n", list(ties))
            }
        };
        if !rigid.ties.is_empty() && !matches!(rigid.shape, RigidShape::Bare) {
            self.refuse(part(), "it has both a shape and tied nodes");
        }
        let inertia = match &rigid.inertia {
            None => String::new(),
            Some(inertia) => stated(rigid, inertia).unwrap_or_else(|| {
                self.refuse(
                    part(),
                    "its mass is neither at its reference point nor that of its solid",
                );
                String::new()
            }),
        };
        let (name, reference) = (text(&rigid.name), vector(&rigid.reference));
        format!("\n[[rigid]]\nname = {name}\n{shape}reference = {reference}\n{inertia}")
    }
}

/// Mass and moments, or the density from which they follow.
fn stated(rigid: &RigidSurface, inertia: &RigidInertia) -> Option<String> {
    let RigidInertia { mass, moments, .. } = *inertia;
    if *inertia == RigidInertia::aligned(mass, rigid.reference, moments) {
        let (mass, moments) = (number(mass), list(moments.map(number)));
        return Some(format!("mass = {mass}\ninertia = {moments}\n"));
    }
    let RigidShape::Facets { positions, facets } = &rigid.shape else {
        return None;
    };
    let of = |density| solid::inertia(positions, facets, density).ok();
    let density = mass / of(1.0)?.mass;
    let density = read_as(mass, density, |density| {
        of(density).map_or(f64::NAN, |found| found.mass)
    });
    (of(density)? == *inertia).then(|| format!("density = {}\n", number(density)))
}
