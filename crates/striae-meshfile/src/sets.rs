//! Sets of a mesh by what a file says of them.
//!
//! Sets of facets hold faces on the boundary of the body. Others, as those of a surface between
//! two volumes, are left out with a note; their nodes are in the set of nodes all the same.

use super::collected::{Collected, Divided, FileFace, corner_nodes, missing};
use super::ids::Ids;
use super::{MeshFileFault, Place, division};
use std::collections::HashMap;
use striae_mesh::{ElementId, Face, Mesh, NodeId, sorted_face};

impl Collected {
    /// Gives a mesh the sets of the file.
    pub(super) fn add_sets(
        &mut self,
        mesh: &mut Mesh,
        ids: &Ids,
        divided: &Divided,
    ) -> Result<(), MeshFileFault> {
        mesh.node_sets.insert("all", ids.nodes.values().copied());
        let elements = ids.elements.values().flatten().copied();
        mesh.element_sets.insert("all", elements);
        self.add_facet_sets(mesh, ids, divided)?;
        self.add_node_sets(mesh, ids)?;
        self.add_element_sets(mesh, ids)
    }

    fn add_facet_sets(
        &mut self,
        mesh: &mut Mesh,
        ids: &Ids,
        divided: &Divided,
    ) -> Result<(), MeshFileFault> {
        if self.facet_sets.is_empty() {
            return Ok(());
        }
        let outside = mesh.boundary_faces();
        let boundary: HashMap<[NodeId; 4], Face> = outside
            .iter()
            .map(|face| (sorted_face(mesh.face_nodes(*face)), *face))
            .collect();
        for (name, members) in &self.facet_sets {
            let (mut faces, mut nodes, mut inside) = (Vec::new(), Vec::new(), 0);
            for &(place, face) in members {
                if let FileFace::Free(number) = face {
                    let found = free(&outside, ids, place, number)?;
                    nodes.extend(found.iter().flat_map(|face| mesh.face_nodes(*face)));
                    faces.extend(found);
                    continue;
                }
                self.check_nodes(place, face)?;
                let facets = facets(mesh, ids, divided, place, face)?;
                let found = facets.iter();
                let found = found.map(|facet| boundary.get(&sorted_face(*facet)).copied());
                match found.collect::<Option<Vec<Face>>>() {
                    Some(found) if !found.is_empty() => faces.extend(found),
                    _ => inside += 1,
                }
                nodes.extend(facets.into_iter().flatten());
            }
            if inside > 0 {
                self.notes.push(format!(
                    "facet set `{name}`: {inside} of {} facets are not on the boundary of the \
                     body and are left out",
                    members.len()
                ));
            }
            if !faces.is_empty() {
                mesh.facet_sets.insert(name, faces);
            }
            if !nodes.is_empty() {
                mesh.node_sets.insert(name, nodes);
            }
        }
        Ok(())
    }

    /// Checks that a face is named by nodes that the file has.
    fn check_nodes(&self, place: Place, face: FileFace) -> Result<(), MeshFileFault> {
        let corners = match face {
            FileFace::Corners(corners) | FileFace::Eight(corners, _) => corners,
            FileFace::Side(..) | FileFace::Free(_) => return Ok(()),
        };
        let mut corners = corners.into_iter();
        match corners.find(|number| !self.nodes.contains_key(number)) {
            Some(number) => Err(missing(place, "node", &self.named(number))),
            None => Ok(()),
        }
    }

    fn add_node_sets(&mut self, mesh: &mut Mesh, ids: &Ids) -> Result<(), MeshFileFault> {
        for (name, members) in &self.node_sets {
            let mut all = members.iter();
            if let Some((place, number)) = all.find(|(_, number)| !self.nodes.contains_key(number))
            {
                return Err(missing(*place, "node", &self.named(*number)));
            }
            let used = members.iter();
            let used = used.filter_map(|(_, number)| ids.nodes.get(number).copied());
            let used: Vec<NodeId> = used.collect();
            if used.is_empty() {
                let note = format!("node set `{name}` has no node of the body and is left out");
                self.notes.push(note);
            } else {
                mesh.node_sets.insert(name, used);
            }
        }
        Ok(())
    }

    fn add_element_sets(&self, mesh: &mut Mesh, ids: &Ids) -> Result<(), MeshFileFault> {
        for (name, members) in &self.element_sets {
            let of_file = |&(place, number)| {
                let ids = ids.elements.get(&number);
                ids.ok_or_else(|| missing(place, "element", &self.named(number)))
            };
            let elements: Result<Vec<_>, MeshFileFault> = members.iter().map(of_file).collect();
            let elements: Vec<_> = elements?.into_iter().flatten().copied().collect();
            if !elements.is_empty() {
                mesh.element_sets.insert(name, elements);
            }
        }
        Ok(())
    }
}

/// Nodes of the facets that a face is, none where it is off the body.
fn facets(
    mesh: &Mesh,
    ids: &Ids,
    divided: &Divided,
    place: Place,
    face: FileFace,
) -> Result<Vec<[NodeId; 4]>, MeshFileFault> {
    let facets = match face {
        FileFace::Corners(corners) => vec![corners],
        FileFace::Eight(corners, on) => match divided.middles.of(corners) {
            Some(middle) => division::quartered(corners, on, middle),
            None => Vec::new(),
        },
        FileFace::Side(number, side) => match divided.wholes.get(&number) {
            Some((kind, nodes)) => division::facets(*kind, side.into(), nodes),
            None => return sides(mesh, ids, place, number, side),
        },
        FileFace::Free(_) => Vec::new(),
    };
    let facets = facets.into_iter();
    let facets: Option<_> = facets
        .map(|corners| corner_nodes(corners, &ids.nodes))
        .collect();
    Ok(facets.unwrap_or_default())
}

/// Faces of an element among those on the boundary, which ascend.
fn free(
    outside: &[Face],
    ids: &Ids,
    place: Place,
    number: u64,
) -> Result<Vec<Face>, MeshFileFault> {
    let elements = ids.elements.get(&number);
    let elements = elements.ok_or_else(|| missing(place, "element", &ids.named(number)))?;
    let of_element = |element: ElementId| {
        let first = outside.partition_point(|face| face.element < element);
        let own = outside[first..].iter();
        own.take_while(move |face| face.element == element).copied()
    };
    Ok(elements.iter().copied().flat_map(of_element).collect())
}

/// Nodes of the facets of a side of an element.
fn sides(
    mesh: &Mesh,
    ids: &Ids,
    place: Place,
    number: u64,
    side: u8,
) -> Result<Vec<[NodeId; 4]>, MeshFileFault> {
    let elements = ids.elements.get(&number);
    let element = elements.ok_or_else(|| missing(place, "element", &ids.named(number)))?[0];
    let kind = mesh.kind(element);
    let sides = kind.faces_of_side(side);
    if sides.is_empty() {
        let found = format!(
            "side {} of element {}, a {kind}",
            side + 1,
            ids.named(number)
        );
        return Err(MeshFileFault::at(place, "a side of the element", found));
    }
    let nodes = sides.map(|side| mesh.face_nodes(Face { element, side }));
    Ok(nodes.collect())
}
