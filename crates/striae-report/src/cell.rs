//! Faces of VTK's cells.
//!
//! A face is a closed outline of corners and nodes on its edges in turn, counter-clockwise
//! seen from outside, and at most one node inside it. Numbering: "VTK file formats",
//! <https://docs.vtk.org/en/latest/vtk_file_formats/vtk_legacy_file_format.html>, and the
//! headers of `vtkQuadraticHexahedron` and its kin.

/// A face of a cell.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    /// Outline, with the nodes on edges between the corners.
    pub outline: Vec<usize>,
    /// Every how many entries of the outline there is a corner: 1, or 2 with nodes on edges.
    pub stride: usize,
    /// A node inside.
    pub inside: Option<usize>,
}

/// Places of the nodes of a face in its cell: outline, and a node inside.
type Places = (&'static [usize], Option<usize>);

const TETRAHEDRON: &[Places] = &[
    (&[0, 2, 1], None),
    (&[0, 1, 3], None),
    (&[1, 2, 3], None),
    (&[0, 3, 2], None),
];
const HEXAHEDRON: &[Places] = &[
    (&[0, 3, 2, 1], None),
    (&[4, 5, 6, 7], None),
    (&[0, 1, 5, 4], None),
    (&[1, 2, 6, 5], None),
    (&[2, 3, 7, 6], None),
    (&[3, 0, 4, 7], None),
];
/// VTK's wedge has its first triangle seen from outside.
const WEDGE: &[Places] = &[
    (&[0, 1, 2], None),
    (&[3, 5, 4], None),
    (&[0, 3, 4, 1], None),
    (&[1, 4, 5, 2], None),
    (&[2, 5, 3, 0], None),
];
const PYRAMID: &[Places] = &[
    (&[0, 3, 2, 1], None),
    (&[0, 1, 4], None),
    (&[1, 2, 4], None),
    (&[2, 3, 4], None),
    (&[3, 0, 4], None),
];
const QUADRATIC_TETRAHEDRON: &[Places] = &[
    (&[0, 6, 2, 5, 1, 4], None),
    (&[0, 4, 1, 8, 3, 7], None),
    (&[1, 5, 2, 9, 3, 8], None),
    (&[0, 7, 3, 9, 2, 6], None),
];
const QUADRATIC_HEXAHEDRON: &[Places] = &[
    (&[0, 11, 3, 10, 2, 9, 1, 8], None),
    (&[4, 12, 5, 13, 6, 14, 7, 15], None),
    (&[0, 8, 1, 17, 5, 12, 4, 16], None),
    (&[1, 9, 2, 18, 6, 13, 5, 17], None),
    (&[2, 10, 3, 19, 7, 14, 6, 18], None),
    (&[3, 11, 0, 16, 4, 15, 7, 19], None),
];
const TRIQUADRATIC_HEXAHEDRON: &[Places] = &[
    (&[0, 11, 3, 10, 2, 9, 1, 8], Some(24)),
    (&[4, 12, 5, 13, 6, 14, 7, 15], Some(25)),
    (&[0, 8, 1, 17, 5, 12, 4, 16], Some(22)),
    (&[1, 9, 2, 18, 6, 13, 5, 17], Some(21)),
    (&[2, 10, 3, 19, 7, 14, 6, 18], Some(23)),
    (&[3, 11, 0, 16, 4, 15, 7, 19], Some(20)),
];
const QUADRATIC_WEDGE: &[Places] = &[
    (&[0, 6, 1, 7, 2, 8], None),
    (&[3, 11, 5, 10, 4, 9], None),
    (&[0, 12, 3, 9, 4, 13, 1, 6], None),
    (&[1, 13, 4, 10, 5, 14, 2, 7], None),
    (&[2, 14, 5, 11, 3, 12, 0, 8], None),
];
const BIQUADRATIC_WEDGE: &[Places] = &[
    (&[0, 6, 1, 7, 2, 8], None),
    (&[3, 11, 5, 10, 4, 9], None),
    (&[0, 12, 3, 9, 4, 13, 1, 6], Some(15)),
    (&[1, 13, 4, 10, 5, 14, 2, 7], Some(16)),
    (&[2, 14, 5, 11, 3, 12, 0, 8], Some(17)),
];
const QUADRATIC_PYRAMID: &[Places] = &[
    (&[0, 8, 3, 7, 2, 6, 1, 5], None),
    (&[0, 5, 1, 10, 4, 9], None),
    (&[1, 6, 2, 11, 4, 10], None),
    (&[2, 7, 3, 12, 4, 11], None),
    (&[3, 8, 0, 9, 4, 12], None),
];
const SIX_NODE_TRIANGLE: &[Places] = &[(&[0, 3, 1, 4, 2, 5], None)];
const EIGHT_NODE_QUADRILATERAL: &[Places] = &[(&[0, 4, 1, 5, 2, 6, 3, 7], None)];
const NINE_NODE_QUADRILATERAL: &[Places] = &[(&[0, 4, 1, 5, 2, 6, 3, 7], Some(8))];

/// Returns whether a cell is a part of a surface rather than of a volume.
pub fn is_flat(shape: u8) -> bool {
    matches!(shape, 5 | 7 | 9 | 22 | 23 | 28)
}

/// Faces of a cell with nodes of the mesh; `None` for a shape that has none or is not known.
pub fn faces(shape: u8, corners: &[usize]) -> Option<Vec<Face>> {
    let (places, stride) = match shape {
        5 | 7 | 9 => {
            let outline = corners.to_vec();
            return Some(vec![Face {
                outline,
                stride: 1,
                inside: None,
            }]);
        }
        10 => (TETRAHEDRON, 1),
        12 => (HEXAHEDRON, 1),
        13 => (WEDGE, 1),
        14 => (PYRAMID, 1),
        22 => (SIX_NODE_TRIANGLE, 2),
        23 => (EIGHT_NODE_QUADRILATERAL, 2),
        24 => (QUADRATIC_TETRAHEDRON, 2),
        25 => (QUADRATIC_HEXAHEDRON, 2),
        26 => (QUADRATIC_WEDGE, 2),
        27 => (QUADRATIC_PYRAMID, 2),
        28 => (NINE_NODE_QUADRILATERAL, 2),
        29 => (TRIQUADRATIC_HEXAHEDRON, 2),
        32 => (BIQUADRATIC_WEDGE, 2),
        _ => return None,
    };
    let face = |(outline, inside): &Places| {
        Some(Face {
            outline: outline
                .iter()
                .map(|place| corners.get(*place).copied())
                .collect::<Option<_>>()?,
            stride,
            inside: match inside {
                Some(place) => Some(*corners.get(*place)?),
                None => None,
            },
        })
    };
    places.iter().map(face).collect()
}

impl Face {
    /// Triangles that cover the face.
    pub fn triangles(&self) -> Vec<[usize; 3]> {
        let outline = &self.outline;
        let count = outline.len();
        if let Some(inside) = self.inside {
            return (0..count)
                .map(|at| [inside, outline[at], outline[(at + 1) % count]])
                .collect();
        }
        if self.stride == 1 {
            return (1..count.saturating_sub(1))
                .map(|at| [outline[0], outline[at], outline[at + 1]])
                .collect();
        }
        // The corners are cut off between the nodes on edges; these make a polygon.
        let corner = |at: usize| {
            [
                outline[(at + count - 1) % count],
                outline[at],
                outline[at + 1],
            ]
        };
        let middles: Vec<usize> = outline.iter().skip(1).step_by(2).copied().collect();
        let cut = (0..count).step_by(2).map(corner);
        let rest = (1..middles.len().saturating_sub(1))
            .map(|at| [middles[0], middles[at], middles[at + 1]]);
        cut.chain(rest).collect()
    }

    /// Pieces of its edges.
    pub fn edges(&self) -> impl Iterator<Item = [usize; 2]> {
        let count = self.outline.len();
        (0..count).map(move |at| [self.outline[at], self.outline[(at + 1) % count]])
    }

    /// Key by which neighbouring cells recognise a common face: its corners in order of number.
    pub fn key(&self) -> Vec<usize> {
        let mut corners: Vec<usize> = self.outline.iter().step_by(self.stride).copied().collect();
        corners.sort_unstable();
        corners
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners of cells whose faces are outward by construction.
    fn places(shape: u8) -> Vec<[f64; 3]> {
        let corners: &[[f64; 3]] = match shape {
            10 | 24 => &[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]],
            12 | 25 | 29 => &[
                [0., 0., 0.],
                [1., 0., 0.],
                [1., 1., 0.],
                [0., 1., 0.],
                [0., 0., 1.],
                [1., 0., 1.],
                [1., 1., 1.],
                [0., 1., 1.],
            ],
            13 | 26 | 32 => &[
                [0., 0., 1.],
                [1., 0., 1.],
                [0., 1., 1.],
                [0., 0., 0.],
                [1., 0., 0.],
                [0., 1., 0.],
            ],
            _ => &[
                [0., 0., 0.],
                [1., 0., 0.],
                [1., 1., 0.],
                [0., 1., 0.],
                [0.5, 0.5, 1.],
            ],
        };
        let mean = |nodes: &[usize]| {
            [0, 1, 2].map(|axis| {
                nodes.iter().map(|n| corners[*n][axis]).sum::<f64>() / nodes.len() as f64
            })
        };
        let mut all = corners.to_vec();
        let edges: &[[usize; 2]] = match shape {
            24 => &[[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]],
            25 | 29 => &[
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
            ],
            26 | 32 => &[
                [0, 1],
                [1, 2],
                [2, 0],
                [3, 4],
                [4, 5],
                [5, 3],
                [0, 3],
                [1, 4],
                [2, 5],
            ],
            27 => &[
                [0, 1],
                [1, 2],
                [2, 3],
                [3, 0],
                [0, 4],
                [1, 4],
                [2, 4],
                [3, 4],
            ],
            _ => &[],
        };
        all.extend(edges.iter().map(|edge| mean(edge)));
        let inside: &[&[usize]] = match shape {
            29 => &[
                &[0, 3, 4, 7],
                &[1, 2, 5, 6],
                &[0, 1, 4, 5],
                &[2, 3, 6, 7],
                &[0, 1, 2, 3],
                &[4, 5, 6, 7],
                &[0, 1, 2, 3, 4, 5, 6, 7],
            ],
            32 => &[&[0, 1, 3, 4], &[1, 2, 4, 5], &[2, 0, 5, 3]],
            _ => &[],
        };
        all.extend(inside.iter().map(|nodes| mean(nodes)));
        all
    }

    /// By the divergence theorem, the faces of a cell enclose its volume, triangle by triangle.
    #[test]
    fn faces_enclose_the_volume_of_every_cell() {
        for (shape, volume) in [
            (10, 1.0 / 6.0),
            (12, 1.0),
            (13, 0.5),
            (14, 1.0 / 3.0),
            (24, 1.0 / 6.0),
            (25, 1.0),
            (26, 0.5),
            (27, 1.0 / 3.0),
            (29, 1.0),
            (32, 0.5),
        ] {
            let places = places(shape);
            let nodes: Vec<usize> = (0..places.len()).collect();
            let faces = faces(shape, &nodes).unwrap();
            let triangles = faces.iter().flat_map(Face::triangles);
            let found: f64 = triangles
                .map(|corners| {
                    let [a, b, c] = corners.map(|node| places[node]);
                    let cross = [
                        b[1] * c[2] - b[2] * c[1],
                        b[2] * c[0] - b[0] * c[2],
                        b[0] * c[1] - b[1] * c[0],
                    ];
                    (a[0] * cross[0] + a[1] * cross[1] + a[2] * cross[2]) / 6.0
                })
                .sum();
            assert!((found - volume).abs() < 1e-15, "shape {shape}: {found}");
        }
    }
}
