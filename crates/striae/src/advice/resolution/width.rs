//! Width of the contact of two surfaces, one of which is curved, beside their facets.
//!
//! Along the direction `d` in which the first step moves the sides together, nodes of a side
//! stand back by `r`; where the sides are pressed by `u` beyond their gap, nodes with `r <= u`
//! touch. By the nearest node that does not, at a distance `l` from the middle of these, the
//! width of the undeformed shapes is
//!
//! ```text
//! 2a = 2 l sqrt(u / r)
//! ```
//!
//! as for a parabola. That of a Hertz contact is narrower by `sqrt 2`. A flat side does not
//! bound it.

use std::collections::BTreeSet;

use striae_contact::initial::Fit;
use striae_mesh::{Face, Mesh, NodeId, Vec3, place, significant};
use striae_model::{BodyId, ContactSurface, Freedom, Model, Pair, RigidShape, Step};

use super::super::{Advice, Topic};

/// Facets over the width of a contact that are few.
const FEW: f64 = 5.0;
/// Cosine between a facet and the direction from which on it looks that way.
const FACING: f64 = 0.2;
/// Distance between the gap along the direction and the smallest one, over the gap and the way,
/// up to which the tops of the sides are opposite each other.
const OPPOSITE: f64 = 0.5;

/// Notes contact of few facets; that with planes is counted by nodes.
pub(in crate::advice) fn look(
    model: &Model,
    pair: &Pair,
    step: &Step,
    fit: &Fit,
    advice: &mut Advice,
) {
    let w = of_side(model, step, &pair.a) - of_side(model, step, &pair.b);
    let Some(d) = w.try_normalize(0.0) else {
        return;
    };
    let sides = [(&pair.a, d), (&pair.b, -d)];
    let Some([a, b]) = both(sides.map(|(side, d)| Points::of(model, side, d))) else {
        return;
    };
    let gap = -(a.top + b.top);
    let smallest = fit.gap.as_ref().map_or(fit.distance, |gap| gap.gap);
    let press = w.norm() - gap.max(0.0);
    if press <= 0.0 || (gap - smallest).abs() > OPPOSITE * w.norm() {
        return;
    }
    let width = [&a, &b]
        .into_iter()
        .filter_map(|points| points.width(press));
    let Some((width, middle)) = width.min_by(|a, b| a.0.total_cmp(&b.0)) else {
        return;
    };
    let coarsest = sides.iter().filter_map(|(side, d)| {
        let ContactSurface::Deformable { body, faces } = side else {
            return None;
        };
        let body = &model.bodies[body.0];
        let size = facet_size(&body.mesh, faces, d, &middle, width)?;
        Some((size, body.name.as_str()))
    });
    let Some((size, name)) = coarsest.max_by(|a, b| a.0.total_cmp(&b.0)) else {
        return;
    };
    let count = width / size;
    if count < FEW {
        let text = format!(
            "pair `{}`: in step `{}` contact is about {width} wide at {}, {count:.1} facets of `{name}` of {size}; forces need about five facets over the contact, a size of {enough}, pressures ten: refine `{name}` there",
            pair.name,
            step.name,
            place(&middle),
            width = significant(width, 2),
            size = significant(size, 2),
            enough = significant(width / FEW, 2)
        );
        advice.note(Topic::Fit, &pair.name, text);
    }
}

fn both<T>([a, b]: [Option<T>; 2]) -> Option<[T; 2]> {
    Some([a?, b?])
}

/// The farthest prescribed displacement of a side.
pub(in crate::advice) fn of_side(model: &Model, step: &Step, side: &ContactSurface) -> Vec3 {
    let mesh_of = |body: BodyId| &model.bodies[body.0].mesh;
    let mut ways: Vec<Vec3> = Vec::new();
    if let ContactSurface::Deformable { body, .. } = side {
        let own = step.displacements.iter().filter(|of| of.body == *body);
        ways.extend(own.map(|of| of.way(mesh_of(*body))));
    }
    if let ContactSurface::Rigid(rigid) = side {
        let own = step.rigid_motions.iter().filter(|of| of.surface == *rigid);
        let along = |coordinate: Freedom| match coordinate {
            Freedom::To(target) => target,
            Freedom::AsBefore | Freedom::Free => 0.0,
        };
        let own = own.map(|of| [0, 1, 2].map(|axis| along(of.coordinates[axis])));
        ways.extend(own.map(Vec3::from));
    }
    let longest = ways
        .into_iter()
        .max_by(|a, b| a.norm().total_cmp(&b.norm()));
    longest.unwrap_or_else(Vec3::zeros)
}

/// Nodes of the facets of a side that look along a direction.
struct Points {
    d: Vec3,
    at: Vec<Vec3>,
    /// Farthest extent along the direction.
    top: f64,
}

impl Points {
    fn of(model: &Model, side: &ContactSurface, d: Vec3) -> Option<Self> {
        let facing = |vector: &Vec3| vector.dot(&d) > FACING * vector.norm();
        let mut at: Vec<Vec3> = Vec::new();
        if let ContactSurface::Deformable { body, faces } = side {
            let mesh = &model.bodies[body.0].mesh;
            let faces = faces
                .iter()
                .filter(|face| facing(&mesh.area_vector(**face)));
            let nodes: BTreeSet<NodeId> = faces.flat_map(|face| mesh.face_nodes(*face)).collect();
            at.extend(nodes.iter().map(|node| mesh.positions[node.index()]));
        }
        if let ContactSurface::Rigid(rigid) = side
            && let RigidShape::Facets { positions, facets } = &model.rigid_surfaces[rigid.0].shape
        {
            let corners = facets.iter();
            let corners = corners.map(|facet| facet.map(|node| positions[node.index()]));
            let looks = |[a, b, c, d]: &[Vec3; 4]| facing(&(c - a).cross(&(d - b)));
            at.extend(corners.filter(looks).flatten());
        }
        let top = at.iter().map(|x| x.dot(&d)).reduce(f64::max)?;
        Some(Self { d, at, top })
    }

    /// Width and middle of what touches under pressing; `None` where all of it does.
    fn width(&self, press: f64) -> Option<(f64, Vec3)> {
        let touches = |x: &&Vec3| self.top - x.dot(&self.d) <= press;
        let (inside, outside): (Vec<&Vec3>, Vec<&Vec3>) = self.at.iter().partition(touches);
        let middle = inside.iter().copied().sum::<Vec3>() / inside.len() as f64;
        let away = |x: &Vec3| {
            let v = x - middle;
            (v - self.d * v.dot(&self.d)).norm()
        };
        let nearest = outside
            .into_iter()
            .min_by(|x, y| away(x).total_cmp(&away(y)))?;
        let back = self.top - nearest.dot(&self.d);
        Some((2.0 * away(nearest) * (press / back).sqrt(), middle))
    }
}

/// Size of the facets of a side that look along a direction, about a place.
fn facet_size(mesh: &Mesh, faces: &[Face], d: &Vec3, middle: &Vec3, width: f64) -> Option<f64> {
    let facing = faces.iter().filter_map(|face| {
        let vector = mesh.area_vector(*face);
        let looks = vector.dot(d) > FACING * vector.norm();
        let corners = mesh.face_positions(*face);
        let away = corners.iter().sum::<Vec3>() / 4.0 - middle;
        let away = (away - d * away.dot(d)).norm();
        looks.then(|| (away, vector.norm().sqrt()))
    });
    let facing: Vec<(f64, f64)> = facing.collect();
    let near: Vec<f64> = facing
        .iter()
        .filter(|(away, _)| *away < width)
        .map(|(_, size)| *size)
        .collect();
    if near.is_empty() {
        let nearest = facing.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
        return nearest.map(|(_, size)| size);
    }
    Some(near.iter().sum::<f64>() / near.len() as f64)
}
