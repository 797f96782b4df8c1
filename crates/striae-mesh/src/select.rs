//! Sets of a mesh made from others, from regions and from the shape of its surface.
//!
//! All results are in ascending order and without repeats.

use std::collections::{BTreeSet, HashMap, VecDeque};

use crate::{ElementId, Face, Mesh, NodeId, Region, Vec3};

impl Mesh {
    /// Adds the set `all` of boundary facets if there is none of that name.
    pub fn name_all_facets(&mut self) {
        if self.facet_sets.get("all").is_none() {
            self.facet_sets.insert("all", self.boundary_faces());
        }
    }

    /// Adds the set `all` of elements if there is none of that name.
    pub fn name_all_elements(&mut self) {
        if self.element_sets.get("all").is_none() {
            let elements = 0..self.element_count();
            self.element_sets
                .insert("all", elements.map(ElementId::new));
        }
    }

    /// Nodes in a region.
    pub fn nodes_in(&self, region: &Region) -> Vec<NodeId> {
        let (low, high) = self.bounds();
        let size = (high - low).norm();
        let nodes = self.positions.iter().enumerate();
        let nodes = nodes.filter(|(_, x)| region.contains(x, size));
        nodes.map(|(index, _)| NodeId::new(index)).collect()
    }

    /// Corners of smallest and largest coordinates of the box around all nodes.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let start = self.positions.first().copied().unwrap_or_default();
        let nodes = self.positions.iter();
        nodes.fold((start, start), |(low, high), x| (low.inf(x), high.sup(x)))
    }

    /// Elements with all their corners among these nodes.
    pub fn elements_of(&self, nodes: &[NodeId]) -> Vec<ElementId> {
        let chosen = self.chosen(nodes);
        let elements = self.elements().enumerate();
        let elements = elements.filter(|(_, corners)| corners.iter().all(|n| chosen[n.index()]));
        elements.map(|(index, _)| ElementId::new(index)).collect()
    }

    /// Nodes of elements.
    pub fn nodes_of_elements(&self, elements: &[ElementId]) -> Vec<NodeId> {
        let nodes = elements.iter().flat_map(|element| self.corners(*element));
        let nodes: BTreeSet<NodeId> = nodes.copied().collect();
        nodes.into_iter().collect()
    }

    /// Faces, out of the given ones, with all corners among these nodes.
    pub fn faces_among(&self, faces: &[Face], nodes: &[NodeId]) -> Vec<Face> {
        let chosen = self.chosen(nodes);
        let is_in = |face: &Face| self.face_nodes(*face).iter().all(|n| chosen[n.index()]);
        faces.iter().copied().filter(is_in).collect()
    }

    /// Faces between some elements and all that is not these elements: others, or nothing.
    pub fn border(&self, elements: &[ElementId]) -> Vec<Face> {
        let mut faces: HashMap<[NodeId; 4], (Face, usize)> = HashMap::new();
        for &element in elements {
            for side in 0..self.kind(element).shape().faces.len() as u8 {
                let face = Face { element, side };
                let key = crate::sorted_face(self.face_nodes(face));
                faces.entry(key).or_insert((face, 0)).1 += 1;
            }
        }
        let single = faces.into_values().filter(|(_, count)| *count == 1);
        let border: BTreeSet<Face> = single.map(|(face, _)| face).collect();
        border.into_iter().collect()
    }

    /// Faces of some elements on the boundary of the body.
    pub fn boundary_of(&self, elements: &[ElementId]) -> Vec<Face> {
        let elements: BTreeSet<ElementId> = elements.iter().copied().collect();
        let mut faces = self.boundary_faces();
        faces.retain(|face| elements.contains(&face.element));
        faces
    }

    /// Faces, out of the given ones, whose outward normals are within an angle (radians) of a
    /// direction.
    pub fn faces_along(&self, faces: &[Face], direction: &Vec3, angle: f64) -> Vec<Face> {
        let faces = faces.iter().copied();
        faces
            .filter(|face| self.area_vector(*face).angle(direction) <= angle + SMALL_ANGLE)
            .collect()
    }

    /// The faces that are reached from the one nearest to a place, among some faces, over edges
    /// at which the normal turns by no more than an angle (radians).
    pub fn faces_around(&self, faces: &[Face], place: &Vec3, angle: f64) -> Vec<Face> {
        let distance = |at: &usize| self.distance(faces[*at], place);
        let nearest = (0..faces.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let Some(nearest) = nearest else {
            return Vec::new();
        };
        let normals: Vec<Vec3> = faces.iter().map(|face| self.area_vector(*face)).collect();
        let mut at_edge: HashMap<[NodeId; 2], Vec<usize>> = HashMap::new();
        for (at, face) in faces.iter().enumerate() {
            for edge in self.edges(*face) {
                at_edge.entry(edge).or_default().push(at);
            }
        }
        let mut reached = vec![false; faces.len()];
        let mut next = VecDeque::from([nearest]);
        reached[nearest] = true;
        while let Some(at) = next.pop_front() {
            for edge in self.edges(faces[at]) {
                for &other in &at_edge[&edge] {
                    let turn = normals[at].angle(&normals[other]);
                    if !reached[other] && turn <= angle + SMALL_ANGLE {
                        reached[other] = true;
                        next.push_back(other);
                    }
                }
            }
        }
        let reached = faces.iter().zip(reached).filter(|(_, reached)| *reached);
        let reached: BTreeSet<Face> = reached.map(|(face, _)| *face).collect();
        reached.into_iter().collect()
    }

    /// Ends of the edges of a face, in ascending order each.
    fn edges(&self, face: Face) -> impl Iterator<Item = [NodeId; 2]> + use<> {
        let nodes = self.face_nodes(face);
        let edges = (0..4).map(move |at| [nodes[at], nodes[(at + 1) % 4]]);
        let edges = edges.filter(|[a, b]| a != b);
        edges.map(|[a, b]| [a.min(b), a.max(b)])
    }

    /// Distance of a place from a face, of a quadrilateral as two triangles.
    fn distance(&self, face: Face, place: &Vec3) -> f64 {
        let [a, b, c, d] = self.face_positions(face);
        let halves = [[a, b, c], [a, c, d]].map(|half| (nearest(half, place) - place).norm());
        halves[0].min(halves[1])
    }

    fn chosen(&self, nodes: &[NodeId]) -> Vec<bool> {
        let mut chosen = vec![false; self.positions.len()];
        for node in nodes {
            chosen[node.index()] = true;
        }
        chosen
    }
}

/// Angle by which round-off may turn a normal: cosines are exact to 1e-16, angles to its root.
const SMALL_ANGLE: f64 = 1e-7;

/// The point of a triangle, or of a line it has fallen into, nearest to a place.
fn nearest([a, b, c]: [Vec3; 3], place: &Vec3) -> Vec3 {
    let normal = (b - a).cross(&(c - a));
    let inside = |from: Vec3, to: Vec3| (to - from).cross(&(place - from)).dot(&normal) >= 0.0;
    if normal.norm_squared() > 0.0 && inside(a, b) && inside(b, c) && inside(c, a) {
        return place - normal * (normal.dot(&(place - a)) / normal.norm_squared());
    }
    let on = |from: Vec3, to: Vec3| {
        let (along, length) = (to - from, (to - from).norm_squared());
        match length > 0.0 {
            true => from + along * (along.dot(&(place - from)) / length).clamp(0.0, 1.0),
            false => from,
        }
    };
    let edges = [on(a, b), on(b, c), on(c, a)];
    let distance = |x: &Vec3| (x - place).norm_squared();
    let [first, second, third] = edges;
    [second, third].into_iter().fold(first, |best, x| {
        if distance(&x) < distance(&best) {
            x
        } else {
            best
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        CellKind,
        generate::{Annulus, Block, HalfCylinder},
    };

    fn block(cells: CellKind) -> Mesh {
        let block = Block {
            divisions: [4, 3, 2],
            cells,
            ..Block::default()
        };
        block.mesh().unwrap()
    }

    #[test]
    fn sides_are_found_by_direction_flood_and_nodes() {
        for cells in CellKind::ALL {
            let mesh = block(cells);
            let all = mesh.boundary_faces();
            for (set, direction) in [
                ("xmin", -Vec3::x()),
                ("xmax", Vec3::x()),
                ("ymin", -Vec3::y()),
                ("zmax", Vec3::z()),
            ] {
                let side = mesh.facet_sets.get(set).unwrap();
                let along = mesh.faces_along(&all, &(direction * 3.0), 0.0);
                assert_eq!(along, side, "{cells} {set}");
                let place = Vec3::repeat(0.5) + direction * 0.7;
                assert_eq!(mesh.faces_around(&all, &place, 0.5), side, "{cells} {set}");
                let nodes = mesh.node_sets.get(set).unwrap();
                assert_eq!(mesh.faces_among(&all, nodes), side, "{cells} {set}");
            }
            let whole = mesh.faces_around(&all, &Vec3::zeros(), 1.6);
            assert_eq!(whole, all, "{cells}");
        }
    }

    #[test]
    fn floods_follow_curved_surfaces_up_to_their_edges() {
        let cylinder = HalfCylinder {
            apex: Vec3::zeros(),
            element_size: 0.1,
            ..HalfCylinder::default()
        };
        let mesh = cylinder.mesh().unwrap();
        let all = mesh.boundary_faces();
        let arc = mesh.faces_around(&all, &Vec3::new(0.0, 0.05, -0.1), 0.6);
        assert_eq!(arc, mesh.facet_sets.get("arc").unwrap());
        let mesh = Annulus::default().mesh().unwrap();
        let all = mesh.boundary_faces();
        let (low, high) = mesh.bounds();
        let outside = Vec3::new(high.x + 1.0, 0.5 * (low.y + high.y), 0.5 * (low.z + high.z));
        let tread = mesh.faces_around(&all, &outside, 1.0);
        assert_eq!(tread, mesh.facet_sets.get("tread").unwrap());
    }

    #[test]
    fn elements_and_their_borders() {
        let mesh = block(CellKind::Hexahedron);
        let half = Region::HalfSpace {
            point: Vec3::new(0.5, 0.0, 0.0),
            normal: Vec3::x(),
        };
        let nodes = mesh.nodes_in(&half);
        assert_eq!(nodes.len(), 3 * 4 * 3);
        let elements = mesh.elements_of(&nodes);
        assert_eq!(elements.len(), 12);
        assert_eq!(mesh.nodes_of_elements(&elements), nodes);
        let border = mesh.border(&elements);
        assert_eq!(border.len(), 2 * (2 * 3 + 2 * 2 + 3 * 2));
        let sum: Vec3 = border.iter().map(|face| mesh.area_vector(*face)).sum();
        assert!(sum.norm() < 1e-14);
        let every: Vec<ElementId> = (0..24).map(ElementId::new).collect();
        assert_eq!(mesh.border(&every), mesh.boundary_faces());
    }

    #[test]
    fn nearest_points_of_triangles() {
        let triangle = [Vec3::zeros(), Vec3::x() * 2.0, Vec3::y() * 2.0];
        for (place, expected) in [
            ([0.5, 0.5, 3.0], [0.5, 0.5, 0.0]),
            ([-1.0, -1.0, 1.0], [0.0, 0.0, 0.0]),
            ([1.0, -1.0, 1.0], [1.0, 0.0, 0.0]),
            ([2.0, 2.0, -1.0], [1.0, 1.0, 0.0]),
            ([9.0, 0.0, 0.0], [2.0, 0.0, 0.0]),
        ] {
            let found = nearest(triangle, &place.into());
            assert!((found - Vec3::from(expected)).norm() < 1e-14, "{place:?}");
        }
        let line = [Vec3::zeros(), Vec3::x(), Vec3::x()];
        assert_eq!(nearest(line, &Vec3::new(2.0, 1.0, 0.0)), Vec3::x());
    }
}
