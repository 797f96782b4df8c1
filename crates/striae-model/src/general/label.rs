//! Labels of surfaces: `tread`, `road`, `tread.zmin`.

use crate::{
    check::Draft,
    fault::{Fault, FaultKind},
    model::{BodyId, ContactSurface, RigidId},
    names::nearest,
    path::Path,
};
use striae_mesh::Face;

/// Owner of a surface, by position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Owner {
    /// A deformable body.
    Body(usize),
    /// A rigid surface.
    Rigid(usize),
}

/// Meaning of a label.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// The label.
    pub(super) label: String,
    /// Body or rigid surface.
    pub(super) owner: Owner,
    /// Facets, ascending; `None`: all of it.
    pub(super) faces: Option<Vec<Face>>,
}

impl Draft<'_> {
    /// The surface of a label, such as `tread`, `road` or `tread.zmin`, if it stands for one.
    pub fn surface(&self, label: &str) -> Option<ContactSurface> {
        let part = found(self, label)?.ok()?;
        match part.owner {
            Owner::Rigid(rigid) => Some(ContactSurface::Rigid(RigidId(rigid))),
            Owner::Body(body) => {
                let mesh = self.bodies[body].mesh?;
                let faces = part.faces.unwrap_or_else(|| mesh.boundary_faces());
                let body = BodyId(body);
                Some(ContactSurface::Deformable { body, faces })
            }
        }
    }
}

/// Looks up what a label at a path stands for; a fault where that is nothing or not one thing.
pub(super) fn part(
    draft: &Draft<'_>,
    label: &str,
    path: &Path,
    faults: &mut Vec<Fault>,
) -> Option<Part> {
    let found = found(draft, label)?;
    let note = |kind: Box<FaultKind>| {
        faults.push(Fault {
            path: path.clone(),
            kind: *kind,
        });
    };
    found.map_err(note).ok()
}

/// `None` where it may be what could not be read.
fn found(draft: &Draft<'_>, label: &str) -> Option<Result<Part, Box<FaultKind>>> {
    let part = |owner: Owner, faces: Option<Vec<Face>>| Part {
        label: label.to_owned(),
        owner,
        faces,
    };
    let body = |name: &str| draft.bodies.iter().position(|body| body.name == name);
    let rigid = |name: &str| draft.rigid_surfaces.iter().position(|of| of.name == name);
    match (body(label), rigid(label)) {
        (Some(at), None) => return Some(Ok(part(Owner::Body(at), None))),
        (None, Some(at)) => return Some(Ok(part(Owner::Rigid(at), None))),
        (Some(_), Some(_)) => {
            let label = label.to_owned();
            return Some(Err(Box::new(FaultKind::TwoMeanings { label })));
        }
        (None, None) => {}
    }
    for (dot, _) in label.match_indices('.') {
        let (owner, set) = (&label[..dot], &label[dot + 1..]);
        if let Some(at) = body(owner) {
            let sets = &draft.bodies[at].mesh?.facet_sets;
            let faces = FaultKind::members("facet", sets, owner, set);
            return Some(faces.map(|faces| part(Owner::Body(at), Some(faces.to_vec()))));
        }
        if rigid(owner).is_some() {
            let (label, rigid) = (label.to_owned(), owner.to_owned());
            return Some(Err(Box::new(FaultKind::PartOfRigid { label, rigid })));
        }
    }
    let bodies = draft.bodies.iter().map(|body| body.name);
    let rigid = draft.rigid_surfaces.iter().map(|rigid| rigid.name);
    let mut known: Vec<String> = bodies.chain(rigid).map(str::to_owned).collect();
    if known.iter().any(String::is_empty) {
        return None;
    }
    known.sort();
    known.dedup();
    Some(Err(Box::new(FaultKind::UnknownName {
        kind: "body or rigid surface",
        name: label.to_owned(),
        nearest: nearest(label, known.iter().map(String::as_str)),
        known,
    })))
}
