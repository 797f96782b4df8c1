//! Mesh files as other programs write them, with numbers unlike our ids.

use std::{collections::BTreeMap, fmt::Write};
use striae_mesh::{CellKind, ElementId, Face, Mesh, NodeId, Vec3};

/// Number of a node in the file.
fn node(id: NodeId) -> u32 {
    10 * id.0 + 7
}

/// Number of an element in the file.
fn element(id: ElementId) -> u32 {
    3 * id.0 + 1001
}

fn joined(numbers: impl IntoIterator<Item = u32>, separator: &str) -> String {
    let words: Vec<String> = numbers
        .into_iter()
        .map(|number| number.to_string())
        .collect();
    words.join(separator)
}

fn elements(mesh: &Mesh) -> impl Iterator<Item = (ElementId, String)> {
    let corners = mesh.elements().enumerate();
    corners.map(|(index, corners)| {
        let nodes = corners.iter().map(|&id| node(id));
        (ElementId::new(index), joined(nodes, " "))
    })
}

/// Elements with their corners in Gmsh's order.
fn gmsh_elements(mesh: &Mesh) -> impl Iterator<Item = (ElementId, String)> {
    let corners = mesh.elements().enumerate();
    corners.map(|(index, corners)| {
        let mut nodes: Vec<u32> = corners.iter().map(|&id| node(id)).collect();
        if nodes.len() == 10 {
            nodes.swap(8, 9);
        }
        (ElementId::new(index), joined(nodes, " "))
    })
}

/// Gmsh's type and the nodes of the triangles or quadrangles that faces are parts of.
fn facets(mesh: &Mesh, faces: &[Face]) -> Vec<(u8, String)> {
    let each = mesh.blocks[0].kind.shape().faces_a_side;
    let one = |side: &[Face]| match (each, mesh.face_nodes(side[0])) {
        (4, [a, ab, ca, _]) => {
            let [_, b, bc, _] = mesh.face_nodes(side[1]);
            let [_, _, c, _] = mesh.face_nodes(side[2]);
            (9, joined([a, b, c, ab, bc, ca].map(node), " "))
        }
        (_, [a, b, c, d]) if c == d => (2, joined([a, b, c].map(node), " ")),
        (_, corners) => (3, joined(corners.map(node), " ")),
    };
    faces.chunks(each).map(one).collect()
}

/// Gmsh's type of the elements, all of one kind.
fn gmsh_kind(mesh: &Mesh) -> u8 {
    match mesh.blocks[0].kind {
        CellKind::Tetrahedron => 4,
        CellKind::Hexahedron => 5,
        CellKind::Wedge => 6,
        CellKind::Pyramid => 7,
        CellKind::CompositeTetrahedron => 11,
    }
}

/// Version 2.2: an element of two groups is written twice.
pub(super) fn gmsh2(mesh: &Mesh) -> String {
    let mut text = String::from("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
    let mut cells = Vec::new();
    let mut names = Vec::new();
    for (group, (name, faces)) in mesh.facet_sets.iter().enumerate() {
        names.push(format!("2 {} \"{name}\"", group + 1));
        for (kind, corners) in facets(mesh, faces) {
            cells.push(format!("{kind} 2 {} 1 {corners}", group + 1));
        }
    }
    names.push("3 98 \"all\"".into());
    names.push("3 99 \"lower half\"".into());
    let kind = gmsh_kind(mesh);
    for (id, corners) in gmsh_elements(mesh) {
        cells.push(format!("{kind} 3 98 1 0 {corners}"));
        let lower = mesh.element_sets.get("lower half");
        if lower.is_some_and(|set| set.contains(&id)) {
            cells.push(format!("{kind} 2 99 1 {corners}"));
        }
    }
    let _ = write!(
        text,
        "$PhysicalNames\n{}\n{}\n$EndPhysicalNames\n",
        names.len(),
        names.join("\n")
    );
    let _ = writeln!(text, "$Nodes\n{}", mesh.positions.len());
    for (index, x) in mesh.positions.iter().enumerate() {
        let _ = writeln!(
            text,
            "{} {:e} {} {}",
            node(NodeId::new(index)),
            x.x,
            x.y,
            x.z
        );
    }
    let _ = writeln!(text, "$EndNodes\n$Elements\n{}", cells.len());
    for (number, cell) in cells.iter().enumerate() {
        let _ = writeln!(text, "{} {cell}", number + 1);
    }
    text + "$EndElements\n"
}

/// Version 4.1: one surface for each facet set, a volume for either half.
pub(super) fn gmsh4(mesh: &Mesh) -> String {
    let mut text = String::from("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n");
    let sides: Vec<_> = mesh.facet_sets.iter().collect();
    let _ = writeln!(text, "{}", sides.len() + 2);
    for (group, (name, _)) in sides.iter().enumerate() {
        let _ = writeln!(text, "2 {} \"{name}\"", group + 1);
    }
    text += "3 98 \"all\"\n3 99 \"lower half\"\n$EndPhysicalNames\n$Entities\n";
    let _ = writeln!(text, "1 0 {} 2\n1 0 0 0 0", sides.len());
    for group in 1..=sides.len() {
        let _ = writeln!(text, "{} 0 0 0 1 1 1 1 -{group} 0", group + 20);
    }
    text += "1 0 0 0 1 1 1 2 98 99 0\n2 0 0 0 1 1 1 1 98 0\n$EndEntities\n";
    let count = mesh.positions.len();
    let _ = writeln!(text, "$Nodes\n2 {count} 7 9999\n0 1 0 0\n3 1 0 {count}");
    for index in 0..count {
        let _ = writeln!(text, "{}", node(NodeId::new(index)));
    }
    for x in &mesh.positions {
        let _ = writeln!(text, "{} {} {}", x.x, x.y, x.z);
    }
    text += "$EndNodes\n$Elements\n";
    let _ = writeln!(text, "{} 0 1 9999", sides.len() + 2);
    let mut number = 1;
    for (group, (_, faces)) in sides.iter().enumerate() {
        let facets = facets(mesh, faces);
        let (kind, count) = (facets[0].0, facets.len());
        let _ = writeln!(text, "2 {} {kind} {count}", group + 21);
        for (_, corners) in facets {
            let _ = writeln!(text, "{number} {corners}");
            number += 1;
        }
    }
    let lower = mesh.element_sets.get("lower half").unwrap_or(&[]).to_vec();
    for (volume, part) in [(1, true), (2, false)] {
        let rows: Vec<String> = gmsh_elements(mesh)
            .filter(|(id, _)| lower.contains(id) == part)
            .map(|(id, corners)| format!("{} {corners}\n", element(id)))
            .collect();
        let kind = gmsh_kind(mesh);
        let _ = write!(text, "3 {volume} {kind} {}\n{}", rows.len(), rows.concat());
    }
    text + "$EndElements\n"
}

/// Abaqus with element and face based sets.
pub(super) fn abaqus(mesh: &Mesh) -> String {
    let mut text = String::from("*HEADING\n block\n*NODE\n");
    for (index, x) in mesh.positions.iter().enumerate() {
        let _ = writeln!(
            text,
            " {}, {}, {:e}, {}",
            node(NodeId::new(index)),
            x.x,
            x.y,
            x.z
        );
    }
    let corners = mesh.blocks[0].kind.corner_count();
    let _ = writeln!(text, "*ELEMENT, TYPE=C3D{corners}H");
    for (id, corners) in elements(mesh) {
        let _ = writeln!(text, "{}, {}", element(id), corners.replace(' ', ", "));
    }
    for (name, members) in mesh.element_sets.iter() {
        let members = joined(members.iter().map(|&id| element(id)), ",\n");
        let _ = writeln!(text, "*ELSET, ELSET=\"{name}\"\n{members}");
    }
    for (name, members) in mesh.node_sets.iter() {
        let members = joined(members.iter().map(|&id| node(id)), ", ");
        let _ = writeln!(text, "*NSET, NSET={name}\n{members},");
    }
    for (name, faces) in mesh.facet_sets.iter() {
        let _ = writeln!(text, "*SURFACE, TYPE=ELEMENT, NAME={name}");
        let each = mesh.blocks[0].kind.shape().faces_a_side;
        for face in faces.iter().step_by(each) {
            let side = usize::from(face.side) / each + 1;
            let _ = writeln!(text, "{}, S{side}", element(face.element));
        }
    }
    text
}

/// ASCII STL.
pub(super) fn stl_ascii(triangles: &[[Vec3; 3]]) -> Vec<u8> {
    let mut text = String::from("solid cube\n");
    for triangle in triangles {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for x in triangle {
            let _ = writeln!(text, "      vertex {:e} {} {}", x.x, x.y, x.z);
        }
        text += "    endloop\n  endfacet\n";
    }
    (text + "endsolid cube\n").into_bytes()
}

/// Binary STL whose header starts as an ASCII file would.
pub(super) fn stl_binary(triangles: &[[Vec3; 3]]) -> Vec<u8> {
    let mut bytes = b"solid by another program".to_vec();
    bytes.resize(80, b' ');
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        for value in triangle.iter().flat_map(|x| x.iter()) {
            bytes.extend((*value as f32).to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    bytes
}

/// A mesh of cells with nodes on their edges, and on faces and inside.
pub(super) struct Whole<'a> {
    linear: &'a Mesh,
    positions: Vec<Vec3>,
    /// Nodes of the cells.
    pub(super) cells: Vec<Vec<usize>>,
    /// Node by the sorted corners whose mean it is.
    means: BTreeMap<Vec<usize>, usize>,
}

impl<'a> Whole<'a> {
    /// The linear mesh with nodes on edges, and with `full` on these faces and in hexahedra.
    pub(super) fn new(
        linear: &'a Mesh,
        edges: &[[usize; 2]],
        faces: &[[usize; 4]],
        full: bool,
    ) -> Self {
        let mut whole = Self {
            linear,
            positions: linear.positions.clone(),
            cells: Vec::new(),
            means: BTreeMap::new(),
        };
        for corners in linear.elements() {
            let corners: Vec<usize> = corners.iter().map(|node| node.index()).collect();
            let mut nodes = corners.clone();
            for edge in edges {
                nodes.push(whole.mean(edge.iter().map(|at| corners[*at]).collect()));
            }
            if full {
                for face in faces {
                    nodes.push(whole.mean(face.iter().map(|at| corners[*at]).collect()));
                }
                if corners.len() == 8 {
                    nodes.push(whole.mean(corners));
                }
            }
            whole.cells.push(nodes);
        }
        whole
    }

    fn mean(&mut self, mut of: Vec<usize>) -> usize {
        of.sort_unstable();
        *self.means.entry(of.clone()).or_insert_with(|| {
            let sum: Vec3 = of.iter().map(|at| self.positions[*at]).sum();
            self.positions.push(sum / of.len() as f64);
            self.positions.len() - 1
        })
    }

    fn numbers(nodes: &[usize], separator: &str) -> String {
        joined(nodes.iter().map(|at| node(NodeId::new(*at))), separator)
    }

    /// Gmsh's type and nodes of a facet.
    fn facet(&self, face: Face) -> String {
        let corners = self.linear.face_nodes(face).map(|node| node.index());
        let count = if corners[2] == corners[3] { 3 } else { 4 };
        let mut nodes = corners[..count].to_vec();
        for at in 0..count {
            let mut ends = vec![corners[at], corners[(at + 1) % count]];
            ends.sort_unstable();
            nodes.push(self.means[&ends]);
        }
        let mut all = corners.to_vec();
        all.sort_unstable();
        let middle = self.means.get(&all).filter(|_| count == 4);
        nodes.extend(middle);
        let kind = match nodes.len() {
            6 => 9,
            8 => 16,
            _ => 10,
        };
        format!("{kind} {}", Self::numbers(&nodes, " "))
    }

    /// Version 2.2 with cells of a type.
    pub(super) fn gmsh(&self, kind: u8) -> String {
        let mut rows = Vec::new();
        let mut names = Vec::new();
        for (group, (name, faces)) in self.linear.facet_sets.iter().enumerate() {
            names.push(format!("2 {} \"{name}\"", group + 1));
            for face in faces {
                let facet = self.facet(*face);
                let (kind, nodes) = facet.split_once(' ').unwrap();
                rows.push(format!("{kind} 1 {} {nodes}", group + 1));
            }
        }
        let cells = self.cells.iter();
        rows.extend(cells.map(|cell| format!("{kind} 0 {}", Self::numbers(cell, " "))));
        let mut text = String::from("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
        let _ = writeln!(
            text,
            "$PhysicalNames\n{}\n{}",
            names.len(),
            names.join("\n")
        );
        let _ = writeln!(text, "$EndPhysicalNames\n$Nodes\n{}", self.positions.len());
        for (at, x) in self.positions.iter().enumerate() {
            let _ = writeln!(text, "{} {} {} {}", node(NodeId::new(at)), x.x, x.y, x.z);
        }
        let _ = writeln!(text, "$EndNodes\n$Elements\n{}", rows.len());
        for (number, row) in rows.iter().enumerate() {
            let _ = writeln!(text, "{} {row}", number + 1);
        }
        text + "$EndElements\n"
    }

    /// Abaqus with cells of a variant.
    pub(super) fn abaqus(&self, letters: &str) -> String {
        let mut text = String::from("*NODE\n");
        for (at, x) in self.positions.iter().enumerate() {
            let _ = writeln!(text, "{}, {}, {}, {}", node(NodeId::new(at)), x.x, x.y, x.z);
        }
        let count = self.cells[0].len();
        let _ = writeln!(text, "*ELEMENT, TYPE=C3D{count}{letters}");
        for (at, cell) in self.cells.iter().enumerate() {
            let number = element(ElementId::new(at));
            let _ = writeln!(text, "{number}, {}", Self::numbers(&cell[..10], ", ") + ",");
            let _ = writeln!(text, "{}", Self::numbers(&cell[10..], ", "));
        }
        for (name, faces) in self.linear.facet_sets.iter() {
            let _ = writeln!(text, "*SURFACE, TYPE=ELEMENT, NAME={name}");
            for face in faces {
                let _ = writeln!(text, "{}, S{}", element(face.element), face.side + 1);
            }
        }
        text
    }
}
