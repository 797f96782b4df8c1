//! Thin bodies that bend, with elements too long for it.
//!
//! Linear elements that bend also shear: in a body of the thickness `t` the spurious energy over
//! that of bending is
//!
//! ```text
//! G (l/t)^2 / E = (l/t)^2 / (2 (1 + nu)),
//! ```
//!
//! however many elements there are over the thickness (the parasitic shear of Hughes, The Finite
//! Element Method, section 4.4). A body counts as bending if it is thin, something pushes it
//! across, and neither of its large sides is supported from the start.

use std::collections::BTreeSet;

use nalgebra::{Matrix3, SymmetricEigen};
use striae_contact::initial::Fit;
use striae_mesh::{CellKind, Face, Mesh, NodeId, Vec3, significant};
use striae_model::{
    Body, BodyId, ContactSurface, Formulation, LoadKind, Model, RigidShape, Step, Value,
};

use super::{Advice, Topic, parts::Part};

/// Thickness over length of a thin body.
const THIN: f64 = 0.2;
/// Spurious stiffness worth a note, and a warning.
const LIMITS: [f64; 2] = [0.1, 2.0];
/// Ratio of gap to thickness that counts as zero.
const TOUCHING: f64 = 1e-3;
/// Cosine of normals that are across.
const ACROSS: f64 = 0.7;
/// Part of a side that must be held for it to be supported.
const HALF: f64 = 0.5;
/// Part of the length and width of a side that another one covers when it supports it.
const COVERED: f64 = 0.8;

/// Notes and warns of bodies that are too stiff in bending.
pub(super) fn look(model: &Model, fits: &[Option<Fit>], advice: &mut Advice) {
    for (index, body) in model.bodies.iter().enumerate() {
        let frame = Frame::of(&body.mesh);
        let Some(share) = frame.spurious(body).filter(|share| *share > LIMITS[0]) else {
            continue;
        };
        let id = BodyId(index);
        if !is_pushed(model, id, &frame.axes[0]) || is_supported(model, fits, id, &frame) {
            continue;
        }
        let name = &body.name;
        let text = format!(
            "body `{name}` is {} thick and {} long; in bending its elements, {} long, are about {} times too stiff",
            significant(frame.lengths[0], 4),
            significant(frame.lengths[2], 4),
            significant(frame.element(&body.mesh), 4),
            significant(1.0 + share, 3)
        );
        match share > LIMITS[1] {
            true => advice.warn(
                Topic::Bending,
                name,
                format!("{text}; make them at most half as long as the body is thick, or use hexahedra with `formulation = \"assumed-strain\"`"),
            ),
            false => advice.note(Topic::Bending, name, text),
        }
    }
}

/// Axes of a body, the one across its thickness first, the longest last.
struct Frame {
    axes: [Vec3; 3],
    lengths: [f64; 3],
}

impl Frame {
    /// The coordinate axes, or the principal axes of the nodes where the body is smaller
    /// along these.
    fn of(mesh: &Mesh) -> Self {
        let plain = Self::along(mesh, Matrix3::identity());
        let count = mesh.positions.len().max(1) as f64;
        let middle = mesh.positions.iter().sum::<Vec3>() / count;
        let arms = mesh.positions.iter().map(|x| x - middle);
        let spread: Matrix3<f64> = arms.map(|arm| arm * arm.transpose()).sum();
        let turned = Self::along(mesh, SymmetricEigen::new(spread).eigenvectors);
        let volume = |frame: &Self| frame.lengths.iter().product::<f64>();
        match volume(&turned) < 0.99 * volume(&plain) {
            true => turned,
            false => plain,
        }
    }

    fn along(mesh: &Mesh, axes: Matrix3<f64>) -> Self {
        let mut all = [0, 1, 2].map(|at| {
            let axis: Vec3 = axes.column(at).into();
            let [low, high] = range(mesh.positions.iter().copied(), &axis);
            (axis, high - low)
        });
        all.sort_by(|a, b| a.1.total_cmp(&b.1));
        Self {
            axes: all.map(|(axis, _)| axis),
            lengths: all.map(|(_, length)| length),
        }
    }

    /// Spurious stiffness over that of bending, for a thin body.
    fn spurious(&self, body: &Body) -> Option<f64> {
        let [thickness, _, length] = self.lengths;
        let mut kinds = body.mesh.blocks.iter().map(|block| block.kind);
        let bends = |part: &Part| {
            let enhanced = part.formulation == Formulation::AssumedStrain;
            enhanced && part.kinds.iter().all(|kind| *kind == CellKind::Hexahedron)
        };
        let parts = Part::all(body).into_iter().filter(|part| !bends(part));
        let ratios = parts.map(|part| part.poissons_ratio());
        let nu = ratios.min_by(f64::total_cmp)?;
        // Composite tetrahedra shear as linear elements between their nodes do.
        let part = match kinds.all(|kind| kind == CellKind::CompositeTetrahedron) {
            true => 0.5,
            false => 1.0,
        };
        let ratio = part * self.element(&body.mesh) / thickness;
        let share = ratio * ratio / (2.0 * (1.0 + nu));
        (thickness < THIN * length).then_some(share)
    }

    /// Mean length of the elements along the longest axis.
    fn element(&self, mesh: &Mesh) -> f64 {
        let lengths = mesh.elements().map(|corners| {
            let corners = corners.iter().map(|node| mesh.positions[node.index()]);
            let [low, high] = range(corners, &self.axes[2]);
            high - low
        });
        lengths.sum::<f64>() / mesh.element_count().max(1) as f64
    }
}

/// Smallest and largest coordinate along an axis.
fn range(positions: impl Iterator<Item = Vec3>, axis: &Vec3) -> [f64; 2] {
    let along = positions.map(|x| x.dot(axis));
    along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
        [low.min(x), high.max(x)]
    })
}

/// Returns whether anything pushes a body along an axis.
fn is_pushed(model: &Model, body: BodyId, axis: &Vec3) -> bool {
    let mesh = &model.bodies[body.0].mesh;
    let across = |faces: &[Face]| {
        let mut vectors = faces.iter().map(|&face| mesh.area_vector(face));
        vectors.any(|v| v.dot(axis).abs() > ACROSS * v.norm())
    };
    let pushes = |step: &Step| {
        let gravity = step.gravity.as_ref();
        let loads = step.loads.iter().filter(|load| load.body == body);
        let forces = step.forces.iter().filter(|of| of.body == body);
        let moves = step.displacements.iter().filter(|of| of.body == body);
        gravity.is_some_and(|gravity| gravity.acceleration.dot(axis) != 0.0)
            || loads.into_iter().any(|load| match load.kind.numbers() {
                Some(LoadKind::DeadTraction(t)) => t.dot(axis) != 0.0,
                Some(LoadKind::FollowerTraction(t)) => t.norm() > 0.0 && across(&load.faces),
                Some(LoadKind::Pressure(p)) => p != 0.0 && across(&load.faces),
                None => true,
            })
            || forces.into_iter().any(|of| {
                let along = |(force, e): (&Value, &f64)| force.number() != Some(0.0) && *e != 0.0;
                of.force.iter().zip(axis.iter()).any(along)
            })
            || moves
                .into_iter()
                .any(|of| of.varies() || of.way(mesh).dot(axis) != 0.0)
    };
    let touches = |side: &ContactSurface| matches!(side, ContactSurface::Deformable { body: of, faces } if *of == body && across(faces));
    let mut pairs = model.pairs.iter();
    model.steps.iter().any(pushes) || pairs.any(|pair| touches(&pair.a) || touches(&pair.b))
}

/// Returns whether one of the two large sides of a body is held transversely, or lies on something.
fn is_supported(model: &Model, fits: &[Option<Fit>], body: BodyId, frame: &Frame) -> bool {
    let mesh = &model.bodies[body.0].mesh;
    let axis = frame.axes[0];
    let held = held_nodes(model, body, &axis);
    let lies = supported_faces(model, fits, body, frame);
    let mut areas = [[0.0; 2]; 2];
    for face in mesh.boundary_faces() {
        let vector = mesh.area_vector(face);
        let (area, cosine) = (vector.norm(), vector.dot(&axis) / vector.norm());
        if cosine.abs() < ACROSS {
            continue;
        }
        let side = &mut areas[usize::from(cosine > 0.0)];
        let nodes = mesh.face_nodes(face);
        let holds = nodes.iter().all(|node| held.contains(node)) || lies.contains(&face);
        side[0] += area;
        side[1] += if holds { area } else { 0.0 };
    }
    areas
        .iter()
        .any(|[whole, part]| *part >= HALF * whole && *whole > 0.0)
}

/// Nodes whose motion along an axis is prescribed in some step.
fn held_nodes(model: &Model, body: BodyId, axis: &Vec3) -> BTreeSet<NodeId> {
    let conditions = model.steps.iter().flat_map(|step| &step.displacements);
    let conditions = conditions.filter(|of| of.body == body);
    let mesh = &model.bodies[body.0].mesh;
    let held = conditions.filter(|of| {
        let Some(first) = of.nodes.first() else {
            return false;
        };
        let directions = of.axes.directions(&mesh.positions[first.index()]);
        let stated = directions.into_iter().zip(&of.components);
        let left = stated.fold(*axis, |left, (direction, target)| match direction {
            Some(direction) if target.is_some() => left - direction * direction.dot(&left),
            _ => left,
        });
        left.amax() <= 0.1
    });
    held.flat_map(|of| of.nodes.iter().copied()).collect()
}

/// Faces that touch, at the start, a surface that is as long and wide as they are.
fn supported_faces(
    model: &Model,
    fits: &[Option<Fit>],
    body: BodyId,
    frame: &Frame,
) -> BTreeSet<Face> {
    let mesh = &model.bodies[body.0].mesh;
    let mut faces = BTreeSet::new();
    let near = frame.lengths[0];
    let touches = |fit: &Fit| fit.overlap.is_some() || fit.distance < TOUCHING * near;
    let pairs = model.pairs.iter().zip(fits);
    let pairs = pairs.filter(|(_, fit)| fit.as_ref().is_some_and(touches));
    for (pair, _) in pairs {
        for (own, other) in [(&pair.a, &pair.b), (&pair.b, &pair.a)] {
            let ContactSurface::Deformable {
                body: of,
                faces: own,
            } = own
            else {
                continue;
            };
            // Faces of another body would not be found in this mesh.
            if *of != body {
                continue;
            }
            let positions = || own.iter().flat_map(|&face| mesh.face_positions(face));
            let covers = frame.axes[1..].iter().all(|axis| {
                let [low, high] = range(positions(), axis);
                let [from, to] = side_range(model, other, axis);
                high.min(to) - low.max(from) >= COVERED * (high - low)
            });
            if covers {
                faces.extend(own.iter().copied());
            }
        }
    }
    faces
}

/// Extent of a side along an axis.
fn side_range(model: &Model, side: &ContactSurface, axis: &Vec3) -> [f64; 2] {
    match side {
        ContactSurface::Deformable { body, faces } => {
            let mesh = &model.bodies[body.0].mesh;
            let positions = faces.iter().flat_map(|&face| mesh.face_positions(face));
            range(positions, axis)
        }
        ContactSurface::Rigid(rigid) => match &model.rigid_surfaces[rigid.0].shape {
            RigidShape::Plane { .. } => [f64::NEG_INFINITY, f64::INFINITY],
            RigidShape::Facets { positions, .. } => range(positions.iter().copied(), axis),
            RigidShape::Bare => [f64::INFINITY, f64::NEG_INFINITY],
        },
        // It does not lie on itself.
        ContactSurface::Itself => [f64::INFINITY, f64::NEG_INFINITY],
    }
}
