//! Cells of higher order divided into linear ones on all their nodes.
//!
//! | cell | nodes | becomes |
//! | --- | --- | --- |
//! | hexahedron | 20 or 27 | eight hexahedra |
//! | wedge | 15 or 18 | eight wedges |
//!
//! Nodes are in the order corners, middles of edges, middles of the quadrilateral faces in the
//! order of [`CellShape::faces`](striae_mesh::CellShape::faces), middle of the hexahedron. Edges
//! are those of the first face, of the last, and those between, as in Abaqus and VTK. Middles of
//! faces and cells that a file does not give are put where the functions of second order have
//! them,
//!
//! ```text
//! x = (edges - corners/2)/2,  sums over the four edges and corners of a face;
//! x = (edges - corners)/4,    sums over the twelve edges and eight corners of a hexahedron,
//! ```
//!
//! and belong to both cells of a face.

use std::collections::{BTreeMap, HashMap};

use striae_mesh::{CellKind, Vec3};

/// Ends of the edges of a hexahedron.
const EDGES_8: [[usize; 2]; 12] = [
    [0, 1],
    [1, 2],
    [2, 3],
    [3, 0],
    [4, 5],
    [5, 6],
    [6, 7],
    [7, 4],
    [0, 4],
    [1, 5],
    [2, 6],
    [3, 7],
];
/// Ends of the edges of a wedge.
const EDGES_6: [[usize; 2]; 9] = [
    [0, 1],
    [1, 2],
    [2, 0],
    [3, 4],
    [4, 5],
    [5, 3],
    [0, 3],
    [1, 4],
    [2, 5],
];

/// Middles of faces by the sorted corners of these.
#[derive(Default)]
pub(super) struct Middles {
    known: HashMap<[u64; 4], u64>,
    next: u64,
}

impl Middles {
    /// Room for middles beside the nodes of a file.
    pub(super) fn beside(nodes: &BTreeMap<u64, Vec3>) -> Self {
        Self {
            known: HashMap::new(),
            next: nodes
                .last_key_value()
                .map_or(0, |(number, _)| number.wrapping_add(1)),
        }
    }

    /// The middle of a face, if there is one.
    pub(super) fn of(&self, corners: [u64; 4]) -> Option<u64> {
        self.known.get(&sorted(corners)).copied()
    }

    /// A node at a place.
    fn add(&mut self, at: Vec3, nodes: &mut BTreeMap<u64, Vec3>) -> u64 {
        // Behind the last number, or from 0 on where that is the largest there is.
        while nodes.contains_key(&self.next) {
            self.next = self.next.wrapping_add(1);
        }
        nodes.insert(self.next, at);
        self.next
    }

    /// Notes the middles that a cell brings along.
    pub(super) fn note(&mut self, kind: CellKind, nodes: &[u64]) {
        let first = kind.corner_count() + edges(kind).len();
        for (face, middle) in quadrilaterals(kind).zip(nodes.iter().skip(first)) {
            self.known.insert(sorted(face.map(|at| nodes[at])), *middle);
        }
    }
}

/// Returns whether a cell of a kind with so many nodes is divided.
pub(super) fn is_divided(kind: CellKind, nodes: usize) -> bool {
    nodes > kind.corner_count()
}

/// All nodes of a cell, those added that it lacks; `None` where it has nodes that are missing
/// in the file.
pub(super) fn completed(
    kind: CellKind,
    mut cell: Vec<u64>,
    middles: &mut Middles,
    nodes: &mut BTreeMap<u64, Vec3>,
) -> Option<Vec<u64>> {
    let (corners, edges) = (kind.corner_count(), edges(kind));
    let mean = |of: &[usize], on: &[usize], cell: &[u64], nodes: &BTreeMap<u64, Vec3>| {
        let sum = |places: &[usize]| -> Option<Vec3> {
            let at = places.iter().map(|at| nodes.get(&cell[*at]).copied());
            at.sum()
        };
        let share = if of.len() == 4 { 0.5 } else { 1.0 };
        let whole = if of.len() == 4 { 2.0 } else { 4.0 };
        Some((sum(on)? - sum(of)? * share) / whole)
    };
    if cell.len() == corners + edges.len() {
        for face in quadrilaterals(kind) {
            let numbers = face.map(|at| cell[at]);
            let middle = match middles.of(numbers) {
                Some(middle) => middle,
                None => {
                    let on = around(kind, &face);
                    let middle = middles.add(mean(&face, &on, &cell, nodes)?, nodes);
                    middles.known.insert(sorted(numbers), middle);
                    middle
                }
            };
            cell.push(middle);
        }
    }
    if kind == CellKind::Hexahedron && cell.len() == 26 {
        let (all, on): (Vec<usize>, Vec<usize>) = ((0..8).collect(), (8..20).collect());
        let middle = mean(&all, &on, &cell, nodes)?;
        cell.push(middles.add(middle, nodes));
    }
    Some(cell)
}

/// Corners of the linear cells, as places among all nodes.
pub(super) fn parts(kind: CellKind) -> Vec<Vec<usize>> {
    match kind {
        CellKind::Hexahedron => hexahedra(),
        _ => wedges(),
    }
}

/// Facets on a side of a cell of a kind with all its nodes; a triangle repeats its last node.
pub(super) fn facets(kind: CellKind, side: usize, cell: &[u64]) -> Vec<[u64; 4]> {
    let Some(&face) = kind.shape().faces.get(side) else {
        return Vec::new();
    };
    let corners: Vec<u64> = face.iter().map(|at| cell[*at]).collect();
    let on: Vec<u64> = around(kind, face).iter().map(|at| cell[*at]).collect();
    match (corners[..].try_into(), on[..].try_into()) {
        (Ok(corners), Ok(on)) => {
            let mut quadrilaterals = quadrilaterals(kind);
            let place = quadrilaterals.position(|other| other == face);
            let first = kind.corner_count() + edges(kind).len();
            let middle = place.map(|place| cell[first + place]);
            quartered(corners, on, middle.expect("one of the quadrilaterals"))
        }
        _ => {
            let triangle = [0, 1, 2].map(|at| corners[at]);
            in_triangles(triangle, [0, 1, 2].map(|at| on[at]))
        }
    }
}

/// Four quadrilaterals from corners, middles of the edges that follow them, and the middle.
pub(super) fn quartered(
    [a, b, c, d]: [u64; 4],
    [ab, bc, cd, da]: [u64; 4],
    middle: u64,
) -> Vec<[u64; 4]> {
    vec![
        [a, ab, middle, da],
        [ab, b, bc, middle],
        [middle, bc, c, cd],
        [da, middle, cd, d],
    ]
}

/// Four triangles from corners and middles of the edges that follow them.
pub(super) fn in_triangles([a, b, c]: [u64; 3], [ab, bc, ca]: [u64; 3]) -> Vec<[u64; 4]> {
    let parts = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
    parts.map(|[a, b, c]| [a, b, c, c]).into()
}

fn sorted(mut corners: [u64; 4]) -> [u64; 4] {
    corners.sort_unstable();
    corners
}

fn edges(kind: CellKind) -> &'static [[usize; 2]] {
    match kind {
        CellKind::Hexahedron => &EDGES_8,
        _ => &EDGES_6,
    }
}

/// Corners of the faces that have a middle.
fn quadrilaterals(kind: CellKind) -> impl Iterator<Item = [usize; 4]> {
    let faces = kind.shape().faces.iter();
    faces.filter_map(|face| (*face).try_into().ok())
}

/// Places of the middles of the edges of a face, each after its corner.
fn around(kind: CellKind, face: &[usize]) -> Vec<usize> {
    let ends = (0..face.len()).map(|at| [face[at], face[(at + 1) % face.len()]]);
    let places = ends.map(|[a, b]| {
        let mut edges = edges(kind).iter();
        let place = edges.position(|edge| *edge == [a, b] || *edge == [b, a]);
        kind.corner_count() + place.expect("an edge of the cell")
    });
    places.collect()
}

/// One hexahedron at each corner, in the lattice of all nodes.
fn hexahedra() -> Vec<Vec<usize>> {
    let shape = CellKind::Hexahedron.shape();
    // Places on a lattice of three nodes along each axis.
    let lattice = |corners: &[usize]| -> [usize; 3] {
        std::array::from_fn(|axis| {
            let sum: f64 = corners.iter().map(|at| shape.corners[*at][axis]).sum();
            (sum / corners.len() as f64 + 1.0) as usize
        })
    };
    let mut nodes: HashMap<[usize; 3], usize> = HashMap::new();
    let whole: Vec<usize> = (0..8).collect();
    let singles = (0..8).map(|at| vec![at]);
    let pairs = EDGES_8.iter().map(|edge| edge.to_vec());
    let faces = shape.faces.iter().map(|face| face.to_vec());
    let all = singles.chain(pairs).chain(faces).chain([whole]);
    all.enumerate().for_each(|(place, corners)| {
        nodes.insert(lattice(&corners), place);
    });
    let parts = (0..8).map(|part| {
        let from = lattice(&[part]).map(|at| at / 2);
        let corner = |at: usize| {
            let to = lattice(&[at]).map(|at| at / 2);
            nodes[&std::array::from_fn(|axis| from[axis] + to[axis])]
        };
        (0..8).map(corner).collect()
    });
    parts.collect()
}

/// Four wedges below and four above, on the triangles of six nodes.
fn wedges() -> Vec<Vec<usize>> {
    const LEVELS: [[usize; 6]; 3] = [
        [0, 1, 2, 6, 7, 8],
        [12, 13, 14, 15, 16, 17],
        [3, 4, 5, 9, 10, 11],
    ];
    const TRIANGLES: [[usize; 3]; 4] = [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]];
    let mut parts = Vec::new();
    for levels in LEVELS.windows(2) {
        for triangle in TRIANGLES {
            let corners = levels.iter().flat_map(|level| triangle.map(|at| level[at]));
            parts.push(corners.collect());
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Natural coordinates of the corners and of the middles of edges.
    fn cell(kind: CellKind) -> (Vec<u64>, BTreeMap<u64, Vec3>) {
        let corners = kind.shape().corners.iter().map(|x| Vec3::from(*x));
        let mut at: Vec<Vec3> = corners.collect();
        for [a, b] in edges(kind) {
            at.push((at[*a] + at[*b]) / 2.0);
        }
        let numbers = (0..at.len() as u64).map(|number| 3 * number + 5);
        (numbers.clone().collect(), numbers.zip(at).collect())
    }

    #[test]
    fn parts_fill_the_cell_and_share_its_sides() {
        for (kind, whole) in [(CellKind::Hexahedron, 8.0), (CellKind::Wedge, 1.0)] {
            let (numbers, mut nodes) = cell(kind);
            let mut middles = Middles::beside(&nodes);
            let all = completed(kind, numbers, &mut middles, &mut nodes).unwrap();
            let mut volume = 0.0;
            for part in parts(kind) {
                let x: Vec<Vec3> = part.iter().map(|at| nodes[&all[*at]]).collect();
                let points = kind.shape().points.iter();
                let of_part: f64 = points
                    .map(|(at, weight)| {
                        striae_mesh::quality::jacobian_determinant(kind, &x, *at) * weight
                    })
                    .sum();
                assert!((of_part - whole / 8.0).abs() < 1e-14, "{part:?}: {of_part}");
                volume += of_part;
            }
            assert!((volume - whole).abs() < 1e-14);
            for (side, face) in kind.shape().faces.iter().enumerate() {
                let facets = facets(kind, side, &all);
                let area = |corners: &[Vec3]| {
                    let [a, b, c] = [0, 1, corners.len() - 1].map(|at| corners[at]);
                    (b - a).cross(&(c - a))
                };
                let x: Vec<Vec3> = face.iter().map(|at| nodes[&all[*at]]).collect();
                for facet in &facets {
                    let x: Vec<Vec3> = facet[..face.len()].iter().map(|at| nodes[at]).collect();
                    assert!((area(&x) * 4.0 - area_of(face.len(), &facets, &nodes)).norm() < 1e-14);
                }
                assert_eq!(facets.len(), 4);
                assert!((area(&x) - area_of(face.len(), &facets, &nodes)).norm() < 1e-14);
            }
        }
    }

    fn area_of(corners: usize, facets: &[[u64; 4]], nodes: &BTreeMap<u64, Vec3>) -> Vec3 {
        let of_one = |facet: &[u64; 4]| {
            let [a, b, c] = [0, 1, corners - 1].map(|at| nodes[&facet[at]]);
            (b - a).cross(&(c - a))
        };
        facets.iter().map(of_one).sum()
    }

    #[test]
    fn middles_belong_to_both_cells_of_a_face() {
        let (numbers, mut nodes) = cell(CellKind::Hexahedron);
        let mut middles = Middles::beside(&nodes);
        let kind = CellKind::Hexahedron;
        let first = completed(kind, numbers.clone(), &mut middles, &mut nodes).unwrap();
        let again = completed(kind, numbers, &mut middles, &mut nodes).unwrap();
        assert_eq!(first[..26], again[..26]);
        assert_ne!(first[26], again[26]);
        assert_eq!(nodes[&first[22]], -Vec3::y());
    }
}
