//! Meshes of elements in rows along three curved axes, written in the deck.
//!
//! A map takes the unit cube to the body. Sides are named after the axes of the cube:
//! `xmin` to `zmax`. The first axis may close to a ring, which has no `xmin` and `xmax`.

use super::vector::{Vector, cross, dot, length, mean, minus};

/// A mesh with its sets of nodes; facets with all corners in a set are a set of its name.
#[derive(Clone, Debug)]
pub struct Grid {
    /// Positions of the nodes.
    pub positions: Vec<Vector>,
    /// Corners of the elements.
    pub cells: Vec<Vec<usize>>,
    /// Names and nodes of the sides.
    pub sides: Vec<(&'static str, Vec<usize>)>,
    /// Names and members of further sets of nodes.
    pub nodes: Vec<(&'static str, Vec<usize>)>,
    /// Shortest edge of the elements before they were divided.
    pub edge: f64,
    /// Volume.
    pub volume: f64,
}

/// Course of the first axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Course {
    /// The grid has two ends.
    Open,
    /// The grid closes on itself.
    Ring,
}

/// Elements that hexahedra are divided into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cells {
    /// Nothing.
    Hexahedra,
    /// Two wedges each.
    Wedges,
    /// Six tetrahedra each, about the diagonal from the first corner.
    Tetrahedra,
}

/// Tetrahedra of a hexahedron, all with one diagonal.
pub const TETRAHEDRA: [[usize; 4]; 6] = [
    [0, 1, 2, 6],
    [0, 2, 3, 6],
    [0, 3, 7, 6],
    [0, 7, 4, 6],
    [0, 4, 5, 6],
    [0, 5, 1, 6],
];

const WEDGES: [[usize; 6]; 2] = [[0, 1, 2, 4, 5, 6], [0, 2, 3, 4, 6, 7]];

impl Grid {
    /// The mesh of a map of the unit cube, which keeps its sense of turning.
    pub fn mapped(
        divisions: [usize; 3],
        course: Course,
        cells: Cells,
        map: impl Fn(Vector) -> Vector,
    ) -> Self {
        let [nx, ny, nz] = divisions;
        let columns = match course {
            Course::Open => nx + 1,
            Course::Ring => nx,
        };
        let id = |[i, j, k]: [usize; 3]| (i % columns) + columns * (j + (ny + 1) * k);
        let places: Vec<[usize; 3]> = (0..=nz)
            .flat_map(|k| (0..=ny).flat_map(move |j| (0..columns).map(move |i| [i, j, k])))
            .collect();
        let share = |at: [usize; 3]| [0, 1, 2].map(|axis| at[axis] as f64 / divisions[axis] as f64);
        let positions: Vec<Vector> = places.iter().map(|&at| map(share(at))).collect();
        let starts = places
            .iter()
            .filter(|at| at[0] < nx && at[1] < ny && at[2] < nz);
        let hexahedra: Vec<[usize; 8]> = starts
            .map(|&[i, j, k]| {
                let ring = |k| [[i, j, k], [i + 1, j, k], [i + 1, j + 1, k], [i, j + 1, k]];
                let [low, high] = [ring(k), ring(k + 1)];
                [0, 1, 2, 3, 4, 5, 6, 7].map(|c| id(if c < 4 { low[c] } else { high[c - 4] }))
            })
            .collect();
        let at = |axis: usize, value: usize| -> Vec<usize> {
            let on = places.iter().filter(|at| at[axis] == value);
            on.map(|&at| id(at)).collect()
        };
        let mut sides = vec![
            ("ymin", at(1, 0)),
            ("ymax", at(1, ny)),
            ("zmin", at(2, 0)),
            ("zmax", at(2, nz)),
        ];
        if course == Course::Open {
            sides.extend([("xmin", at(0, 0)), ("xmax", at(0, nx))]);
        }
        let corners = |hexahedron: &[usize; 8]| hexahedron.map(|node| positions[node]);
        Self {
            edge: hexahedra
                .iter()
                .map(|h| shortest(&corners(h)))
                .fold(f64::INFINITY, f64::min),
            volume: hexahedra.iter().map(|h| volume(&corners(h))).sum(),
            cells: hexahedra.iter().flat_map(|h| divided(h, cells)).collect(),
            positions,
            sides,
            nodes: Vec::new(),
        }
    }
}

impl Grid {
    /// The mesh without the elements whose middles are where `removed` says, and without nodes
    /// that then belong to none.
    pub fn without(mut self, removed: impl Fn(Vector) -> bool) -> Self {
        let positions = &self.positions;
        self.cells.retain(|cell| {
            let corners: Vec<Vector> = cell.iter().map(|&node| positions[node]).collect();
            !removed(mean(&corners))
        });
        let mut number = vec![usize::MAX; self.positions.len()];
        self.cells
            .iter()
            .flatten()
            .for_each(|&node| number[node] = 0);
        let mut kept = Vec::new();
        for (node, number) in number.iter_mut().enumerate().filter(|(_, n)| **n == 0) {
            *number = kept.len();
            kept.push(self.positions[node]);
        }
        self.positions = kept;
        for nodes in self.cells.iter_mut() {
            nodes.iter_mut().for_each(|node| *node = number[*node]);
        }
        for (_, nodes) in self.sides.iter_mut().chain(&mut self.nodes) {
            nodes.retain(|&node| number[node] != usize::MAX);
            nodes.iter_mut().for_each(|node| *node = number[*node]);
        }
        self.sides.retain(|side| !side.1.is_empty());
        self
    }

    /// The mesh moved by a map of its nodes, for which its edge and volume are measured again.
    pub fn moved(mut self, map: impl Fn(Vector) -> Vector) -> Self {
        self.positions.iter_mut().for_each(|x| *x = map(*x));
        let positions = &self.positions;
        let corners = |cell: &Vec<usize>| {
            let corners = <[usize; 8]>::try_from(&cell[..]).expect("elements are hexahedra");
            corners.map(|node| positions[node])
        };
        let all: Vec<[Vector; 8]> = self.cells.iter().map(corners).collect();
        self.edge = all.iter().map(shortest).fold(f64::INFINITY, f64::min);
        self.volume = all.iter().map(volume).sum();
        self
    }

    /// The mesh with a further set of nodes, by their places.
    pub fn with_nodes(mut self, name: &'static str, wanted: impl Fn(Vector) -> bool) -> Self {
        let nodes = (0..self.positions.len()).filter(|&node| wanted(self.positions[node]));
        self.nodes.push((name, nodes.collect()));
        self
    }
}

fn divided(hexahedron: &[usize; 8], cells: Cells) -> Vec<Vec<usize>> {
    let of = |corners: &[usize]| corners.iter().map(|&c| hexahedron[c]).collect();
    match cells {
        Cells::Hexahedra => vec![hexahedron.to_vec()],
        Cells::Wedges => WEDGES.iter().map(|wedge| of(wedge)).collect(),
        Cells::Tetrahedra => TETRAHEDRA.iter().map(|cell| of(cell)).collect(),
    }
}

fn shortest(corners: &[Vector; 8]) -> f64 {
    const EDGES: [[usize; 2]; 12] = [
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
    EDGES
        .map(|[a, b]| length(minus(corners[a], corners[b])))
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

/// Volume of a hexahedron whose sides are two triangles each.
pub fn volume(corners: &[Vector; 8]) -> f64 {
    let of = |[a, b, c, d]: [usize; 4]| {
        let [b, c, d] = [b, c, d].map(|i| minus(corners[i], corners[a]));
        dot(cross(b, c), d) / 6.0
    };
    TETRAHEDRA.map(of).iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_has_its_volume_and_sides() {
        for (cells, count) in [
            (Cells::Hexahedra, 24),
            (Cells::Wedges, 48),
            (Cells::Tetrahedra, 144),
        ] {
            let stretched = |[x, y, z]: Vector| [2.0 * x, 3.0 * y, 4.0 * z];
            let grid = Grid::mapped([2, 3, 4], Course::Open, cells, stretched);
            assert_eq!(grid.cells.len(), count);
            assert_eq!(grid.positions.len(), 60);
            assert!((grid.volume - 24.0).abs() < 1e-12);
            assert!((grid.edge - 1.0).abs() < 1e-12);
            let top = grid.sides.iter().find(|side| side.0 == "zmax").unwrap();
            assert_eq!(top.1.len(), 12);
            assert!(top.1.iter().all(|&node| grid.positions[node][2] == 4.0));
        }
    }

    #[test]
    fn a_ring_runs_into_its_start() {
        let round = |[x, y, z]: Vector| {
            let (sine, cosine) = (x * std::f64::consts::TAU).sin_cos();
            let radius = 1.0 + z;
            [radius * sine, y, radius * cosine]
        };
        let grid = Grid::mapped([40, 1, 2], Course::Ring, Cells::Hexahedra, round);
        assert_eq!(grid.positions.len(), 40 * 2 * 3);
        assert!(grid.sides.iter().all(|side| side.0 != "xmin"));
        let exact = std::f64::consts::PI * 3.0;
        assert!((grid.volume / exact - 1.0).abs() < 0.01, "{}", grid.volume);
    }
}
