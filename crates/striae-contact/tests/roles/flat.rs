//! Flat faces with tensor grids: exact common integrals, products of those along a line.

use striae_contact::{
    interface::{
        ClampedProjection, FacetMass, Interface, InterfaceNode, LastIncrement, Opponent, Overlap,
    },
    side::Side,
};
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

/// A rectangular face with grid lines.
#[derive(Clone, Debug)]
pub struct Face {
    pub xs: Vec<f64>,
    pub ys: Vec<f64>,
    pub modulus: f64,
}

impl Face {
    pub fn uniform(divisions: [usize; 2], size: [f64; 2], origin: [f64; 2], modulus: f64) -> Self {
        let line = |axis: usize| {
            let step = size[axis] / divisions[axis] as f64;
            (0..=divisions[axis])
                .map(|at| origin[axis] + step * at as f64)
                .collect()
        };
        Self {
            xs: line(0),
            ys: line(1),
            modulus,
        }
    }

    fn corners(&self, i: usize, j: usize) -> [SurfaceNode; 4] {
        let node = |i: usize, j: usize| SurfaceNode::new(j * self.xs.len() + i);
        [
            node(i, j),
            node(i + 1, j),
            node(i + 1, j + 1),
            node(i, j + 1),
        ]
    }

    /// Nodes, x first; `h` is the root of the product of mean spacings.
    fn nodes(&self) -> Vec<InterfaceNode> {
        let spacing = |line: &[f64], at: usize| {
            let (low, high) = (at.saturating_sub(1), (at + 1).min(line.len() - 1));
            (line[high] - line[low]) / (high - low) as f64
        };
        let node = |i: usize, j: usize| {
            let h = (spacing(&self.xs, i) * spacing(&self.ys, j)).sqrt();
            InterfaceNode {
                position: Vec3::new(self.xs[i], self.ys[j], 0.0),
                flexibility: h / self.modulus,
                compliance: 1.0 / (self.modulus * h),
                last: LastIncrement::NotKept,
            }
        };
        (0..self.ys.len())
            .flat_map(|j| (0..self.xs.len()).map(move |i| node(i, j)))
            .collect()
    }

    /// Corners and weights at a point clamped to the face.
    fn projection(&self, point: &Vec3) -> ClampedProjection {
        let ([i, j], [s, t]) = {
            let (i, s) = locate(&self.xs, point.x);
            let (j, t) = locate(&self.ys, point.y);
            ([i, j], [s, t])
        };
        let weights = [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t];
        (self.corners(i, j), weights)
    }
}

fn locate(line: &[f64], at: f64) -> (usize, f64) {
    let at = at.clamp(line[0], line[line.len() - 1]);
    let cell = line.partition_point(|&x| x <= at).clamp(1, line.len() - 1) - 1;
    (cell, (at - line[cell]) / (line[cell + 1] - line[cell]))
}

/// A pair as plain values that own what an `Interface` borrows.
#[derive(Clone, Debug)]
pub struct Pair {
    pub nodes: [Vec<InterfaceNode>; 2],
    pub overlaps: Vec<Overlap>,
    pub opposing: [Vec<Option<ClampedProjection>>; 2],
    /// Of a pair with a rigid surface.
    pub whole: Option<Vec<FacetMass>>,
}

impl Pair {
    /// Both faces deformable; everything is within reach.
    pub fn new(faces: [&Face; 2]) -> Self {
        let nodes = faces.map(Face::nodes);
        let opposing = Side::BOTH.map(|side| {
            let on = |node: &InterfaceNode| Some(faces[side.opposite()].projection(&node.position));
            nodes[side].iter().map(on).collect()
        });
        Self {
            overlaps: overlaps(faces),
            nodes,
            opposing,
            whole: None,
        }
    }

    /// The second face rigid.
    pub fn on_rigid(faces: [&Face; 2]) -> Self {
        let mut pair = Self::new(faces);
        for node in &mut pair.nodes[1] {
            (node.flexibility, node.compliance) = (0.0, 0.0);
        }
        let whole = overlaps([faces[0], faces[0]]).into_iter().filter_map(|o| {
            let mass = std::array::from_fn(|c| std::array::from_fn(|d| o.mass[c][d]));
            (o.corners[0] == o.corners[1]).then_some(FacetMass {
                corners: o.corners[0],
                mass,
            })
        });
        pair.whole = Some(whole.collect());
        pair
    }

    pub fn interface(&self) -> Interface<'_> {
        Interface {
            nodes: self.nodes.each_ref().map(Vec::as_slice),
            overlaps: &self.overlaps,
            opposing: self.opposing.each_ref().map(Vec::as_slice),
            opponent: match &self.whole {
                Some(whole) => Opponent::Rigid { whole },
                None => Opponent::Deformable,
            },
            wear: [0.0; 2],
        }
    }
}

fn overlaps(faces: [&Face; 2]) -> Vec<Overlap> {
    let x = common_intervals(&faces.map(|face| face.xs.as_slice()));
    let y = common_intervals(&faces.map(|face| face.ys.as_slice()));
    let mut overlaps = Vec::new();
    for v in &y {
        for u in &x {
            let corners = Side::BOTH.map(|side| faces[side].corners(u.cells[side], v.cells[side]));
            let mass = std::array::from_fn(|c| {
                std::array::from_fn(|d| {
                    // Corners counter-clockwise: which end along x and along y.
                    let [a, b] = [c, d].map(|c: usize| {
                        let (side, corner) = (c / 4, c % 4);
                        let high = [corner == 1 || corner == 2, corner >= 2];
                        high.map(|high| 2 * side + usize::from(high))
                    });
                    u.mass[a[0]][b[0]] * v.mass[a[1]][b[1]]
                })
            });
            overlaps.push(Overlap {
                corners,
                mass,
                normal: Vec3::z(),
            });
        }
    }
    overlaps
}

/// Common part of a cell of each line, with the integrals of products of its four hats.
struct Interval {
    cells: [usize; 2],
    mass: [[f64; 4]; 4],
}

fn common_intervals(lines: &[&[f64]; 2]) -> Vec<Interval> {
    let mut intervals = Vec::new();
    for i in 0..lines[0].len() - 1 {
        for j in 0..lines[1].len() - 1 {
            let low = lines[0][i].max(lines[1][j]);
            let high = lines[0][i + 1].min(lines[1][j + 1]);
            if high - low > 1e-13 {
                let hats = |x: f64| {
                    let s = (x - lines[0][i]) / (lines[0][i + 1] - lines[0][i]);
                    let t = (x - lines[1][j]) / (lines[1][j + 1] - lines[1][j]);
                    [1.0 - s, s, 1.0 - t, t]
                };
                // Simpson's rule is exact for products of two linear functions.
                let [a, m, b] = [low, 0.5 * (low + high), high].map(hats);
                let sixth = (high - low) / 6.0;
                let mass = std::array::from_fn(|c| {
                    std::array::from_fn(|d| {
                        sixth * (a[c] * a[d] + 4.0 * (m[c] * m[d]) + b[c] * b[d])
                    })
                });
                intervals.push(Interval {
                    cells: [i, j],
                    mass,
                });
            }
        }
    }
    intervals
}
