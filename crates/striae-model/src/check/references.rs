//! Ids, nodes and faces that are there.

use crate::{
    fault::{Fault, FaultKind},
    model::{BodyId, ContactSurface, Model, Mover, RigidId, RigidShape, SpringEnd},
    path::Path,
};
use striae_mesh::{Face, Mesh, NodeId};

use super::List;

/// Every id of a model that nothing has.
pub(super) fn faults(model: &Model) -> Vec<Fault> {
    let mut check = Check {
        model,
        faults: List::default(),
    };
    for (index, body) in model.bodies.iter().enumerate() {
        let (count, path) = (body.mesh.element_count(), Path::part("bodies", index));
        for (at, section) in body.sections.iter().enumerate() {
            let elements = section.elements.iter().map(|element| element.index());
            let path = path.clone().field("sections").index(at);
            check.within("element", elements, count, &path);
        }
    }
    for index in 0..model.rigid_surfaces.len() {
        check.rigid_surface(index);
    }
    for (index, pair) in model.pairs.iter().enumerate() {
        let path = Path::part("pairs", index);
        check.side(&pair.a, path.clone().field("a"));
        check.side(&pair.b, path.field("b"));
    }
    for (index, tie) in model.ties.iter().enumerate() {
        let path = Path::part("ties", index);
        check.side(&tie.a, path.clone().field("a"));
        check.side(&tie.b, path.field("b"));
    }
    for (index, spring) in model.springs.iter().enumerate() {
        for (end, field) in spring.ends().zip(["a", "b"]) {
            let path = Path::part("springs", index).field(field);
            match end {
                SpringEnd::Nodes { body, nodes } => check.nodes(*body, nodes, path),
                SpringEnd::Rigid { rigid, .. } => check.rigid(*rigid, &path),
            }
        }
    }
    for (index, cavity) in model.cavities.iter().enumerate() {
        for (part, (body, faces)) in cavity.parts.iter().enumerate() {
            let path = Path::part("cavities", index).field("parts").index(part);
            check.faces(*body, faces, path);
        }
    }
    for index in 0..model.steps.len() {
        check.step(index);
    }
    check.faults.0
}

struct Check<'m> {
    model: &'m Model,
    faults: List,
}

impl Check<'_> {
    fn rigid_surface(&mut self, index: usize) {
        let model = self.model;
        let (rigid, path) = (
            &model.rigid_surfaces[index],
            Path::part("rigid_surfaces", index),
        );
        for (tie, (body, nodes)) in rigid.ties.iter().enumerate() {
            self.nodes(*body, nodes, path.clone().field("ties").index(tie));
        }
        if let RigidShape::Facets { positions, facets } = &rigid.shape {
            let corners = facets.iter().flatten().map(|corner| corner.index());
            let path = path.field("shape");
            self.within("node", corners, positions.len(), &path);
        }
    }

    fn step(&mut self, index: usize) {
        let model = self.model;
        let (step, path) = (&model.steps[index], Path::part("steps", index));
        let at = |list: &'static str, index: usize| path.clone().field(list).index(index);
        for (index, condition) in step.displacements.iter().enumerate() {
            let path = at("displacements", index);
            self.nodes(condition.body, &condition.nodes, path);
        }
        for (index, release) in step.releases.iter().enumerate() {
            self.nodes(release.body, &release.nodes, at("releases", index));
        }
        for (index, load) in step.loads.iter().enumerate() {
            self.faces(load.body, &load.faces, at("loads", index));
        }
        for (index, force) in step.forces.iter().enumerate() {
            self.nodes(force.body, &force.nodes, at("forces", index));
        }
        for (index, actuation) in step.actuations.iter().enumerate() {
            let path = at("actuations", index);
            if self.body(actuation.body, &path).is_some() {
                let count = model.bodies[actuation.body.0].sections.len() + 1;
                self.within("section", actuation.section, count, &path);
            }
        }
        for (index, filling) in step.fillings.iter().enumerate() {
            let count = model.cavities.len();
            let path = at("fillings", index);
            self.within("cavity", [filling.cavity.0], count, &path);
        }
        for (index, velocity) in step.velocities.iter().enumerate() {
            match velocity.body {
                Mover::Deformable(body) => _ = self.body(body, &at("velocities", index)),
                Mover::Rigid(rigid) => self.rigid(rigid, &at("velocities", index)),
            }
        }
        for (index, motion) in step.rigid_motions.iter().enumerate() {
            self.rigid(motion.surface, &at("rigid_motions", index));
        }
        for (index, (pair, _)) in step.frictions.iter().enumerate() {
            let count = model.pairs.len();
            self.within("pair", [pair.0], count, &at("frictions", index));
        }
    }

    fn side(&mut self, side: &ContactSurface, path: Path) {
        match side {
            ContactSurface::Deformable { body, faces } => self.faces(*body, faces, path),
            ContactSurface::Rigid(rigid) => self.rigid(*rigid, &path),
            ContactSurface::Itself => {}
        }
    }

    fn rigid(&mut self, rigid: RigidId, path: &Path) {
        let count = self.model.rigid_surfaces.len();
        self.within("rigid surface", [rigid.0], count, path);
    }

    fn body(&mut self, body: BodyId, path: &Path) -> Option<&Mesh> {
        let bodies = &self.model.bodies;
        self.within("body", [body.0], bodies.len(), path);
        bodies.get(body.0).map(|body| &body.mesh)
    }

    fn nodes(&mut self, body: BodyId, nodes: &[NodeId], path: Path) {
        if let Some(mesh) = self.body(body, &path) {
            let count = mesh.positions.len();
            self.within("node", nodes.iter().map(|node| node.index()), count, &path);
        }
    }

    fn faces(&mut self, body: BodyId, faces: &[Face], path: Path) {
        if let Some(mesh) = self.body(body, &path) {
            let count = mesh.element_count();
            let elements = faces.iter().map(|face| face.element.index());
            self.within("element", elements, count, &path);
        }
    }

    /// Notes the first index that is out of range.
    fn within(
        &mut self,
        what: &'static str,
        indices: impl IntoIterator<Item = usize>,
        count: usize,
        path: &Path,
    ) {
        if let Some(index) = indices.into_iter().find(|index| *index >= count) {
            let kind = FaultKind::Missing { what, index, count };
            self.faults.push(path.clone(), kind);
        }
    }
}
