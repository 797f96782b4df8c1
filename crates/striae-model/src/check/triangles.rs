//! Restrictions on facets with three corners.
//!
//! Collocated contact is integrated over parts of quadrilaterals only.

use crate::{
    fault::FaultKind,
    model::{BodyId, ContactSurface, Enforcement, Pair},
    path::Path,
};
use striae_mesh::{Face, Mesh};

use super::{Draft, List};

/// Notes pairs that need facets with four corners and have others.
pub(super) fn check(draft: &Draft<'_>, faults: &mut List) {
    let mut note = |body: BodyId, faces: &[Face], what: String, path: Path| {
        let body = &draft.bodies[body.0];
        if body.mesh.is_some_and(|mesh| has_triangles(mesh, faces)) {
            let body = body.name.to_owned();
            faults.push(path, FaultKind::Triangles { what, body });
        }
    };
    for (index, named) in draft.pairs.iter().enumerate() {
        let collocated = |pair: &&Pair| pair.enforcement == Enforcement::Collocated;
        let Some(pair) = named.pair.filter(collocated) else {
            continue;
        };
        for (field, side) in [("a", &pair.a), ("b", &pair.b)] {
            if let ContactSurface::Deformable { body, faces } = side {
                let what = format!("collocated contact in pair `{}`", pair.name);
                note(*body, faces, what, Path::part("pairs", index).field(field));
            }
        }
    }
}

fn has_triangles(mesh: &Mesh, faces: &[Face]) -> bool {
    faces.iter().any(|&face| {
        let nodes = mesh.face_nodes(face);
        nodes[2] == nodes[3]
    })
}
