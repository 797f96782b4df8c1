//! Surfaces for tests.

use std::f64::consts::TAU;

use striae_mesh::{NodeId, Vec3};

use crate::{
    node::SurfaceNode,
    normal::nodal_normals,
    texture::{Axes, Axis, Field, Lines, Paint, Texture},
    topology::Surface,
};

/// Nodes and facets of a surface.
#[derive(Clone)]
pub struct Shape {
    pub positions: Vec<Vec3>,
    pub facets: Vec<[SurfaceNode; 4]>,
}

impl Shape {
    /// `n x n` quadrilaterals on the image of the unit square, `u` first.
    pub fn patch(n: usize, map: impl Fn(f64, f64) -> Vec3) -> Self {
        let at = |i: usize, j: usize| SurfaceNode::new(i + (n + 1) * j);
        let coordinate = |i: usize| i as f64 / n as f64;
        Self {
            positions: (0..(n + 1) * (n + 1))
                .map(|k| map(coordinate(k % (n + 1)), coordinate(k / (n + 1))))
                .collect(),
            facets: (0..n * n)
                .map(|k| (k % n, k / n))
                .map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
                .collect(),
        }
    }

    /// Closed tube about the z axis of radius 1 and height 1.5.
    pub fn tube(around: usize, along: usize) -> Self {
        let at = |i: usize, j: usize| SurfaceNode::new(i % around + around * j);
        let place = |k: usize| {
            let angle = TAU * (k % around) as f64 / around as f64;
            let height = 1.5 * (k / around) as f64 / along as f64;
            Vec3::new(angle.cos(), angle.sin(), height)
        };
        Self {
            positions: (0..around * (along + 1)).map(place).collect(),
            facets: (0..around * along)
                .map(|k| (k % around, k / around))
                .map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
                .collect(),
        }
    }

    /// Copy of the shape with every third quadrilateral split into triangles.
    pub fn partly_triangular(mut self) -> Self {
        let cut = |(k, facet): (usize, [SurfaceNode; 4])| match (k % 3, facet) {
            (0, [a, b, c, d]) => vec![[a, b, c, c], [a, c, d, d]],
            _ => vec![facet],
        };
        self.facets = self.facets.into_iter().enumerate().flat_map(cut).collect();
        self
    }

    /// Copy of the shape with moved nodes.
    pub fn moved(&self, motion: impl Fn(&Vec3) -> Vec3) -> Self {
        Self {
            positions: self.positions.iter().map(motion).collect(),
            facets: self.facets.clone(),
        }
    }

    pub fn surface(&self) -> Surface {
        let facet = |facet: &[SurfaceNode; 4]| facet.map(|node| NodeId(node.0));
        Surface::new(&self.facets.iter().map(facet).collect::<Vec<_>>())
    }

    pub fn normals(&self) -> Vec<Vec3> {
        nodal_normals(&self.surface(), &self.positions)
    }

    /// Nodes that lie on no free boundary.
    pub fn inner_nodes(&self) -> Vec<usize> {
        let surface = self.surface();
        (0..self.positions.len())
            .filter(|&node| !surface.is_on_boundary(SurfaceNode::new(node)))
            .collect()
    }

    pub fn painted(&self, paint: &Paint) -> Texture {
        let (positions, facets) = (&self.positions, &self.facets);
        let (texture, _) = Texture::new(positions, facets, &self.normals(), paint).unwrap();
        texture
    }

    /// The texture at all nodes.
    pub fn axes(&self, texture: &Texture) -> Vec<Axes<f64>> {
        (self.normals().into_iter().enumerate())
            .map(|(node, normal)| {
                texture
                    .at(SurfaceNode::new(node), &self.positions, normal)
                    .unwrap()
            })
            .collect()
    }
}

/// Uneven coordinates, so that no mesh has accidental symmetries.
pub fn uneven(u: f64, v: f64) -> (f64, f64) {
    (
        u + 0.04 * (3.0 * u + 4.0 * v).sin(),
        v + 0.05 * (5.0 * u - 2.0 * v).cos(),
    )
}

/// Patch of the unit sphere away from its poles.
pub fn sphere(u: f64, v: f64) -> Vec3 {
    let (longitude, latitude) = (1.4 * u, 0.2 + 0.8 * v);
    let r = latitude.cos();
    Vec3::new(r * longitude.cos(), r * longitude.sin(), latitude.sin())
}

/// Patch of a torus about the z axis, with points of either sign of curvature.
pub fn torus(u: f64, v: f64) -> Vec3 {
    let (around, tube) = (1.2 * u, 0.6 + 1.8 * v);
    let r = 2.0 + 0.8 * tube.cos();
    Vec3::new(r * around.cos(), r * around.sin(), 0.8 * tube.sin())
}

/// Sheet in a plane that is not aligned with anything.
pub fn plane(u: f64, v: f64) -> Vec3 {
    let (u, v) = uneven(u, v);
    Vec3::new(1.0, 0.2, -0.3) * u + Vec3::new(-0.1, 0.9, 0.4) * v
}

pub fn uniform(direction: Vec3) -> Paint {
    Paint::Field(Field {
        lines: Lines::Uniform(direction),
        turn: 0.0,
    })
}

/// Circles about the z axis, turned.
pub fn helices(turn: f64) -> Paint {
    Paint::Field(Field {
        lines: Lines::Circumferential(z_axis()),
        turn,
    })
}

pub fn z_axis() -> Axis {
    Axis {
        point: Vec3::zeros(),
        direction: Vec3::z(),
    }
}

/// Largest difference of `s` or `a`.
pub fn difference(one: &Axes<f64>, other: &Axes<f64>) -> f64 {
    (one.s - other.s).norm().max((one.a - other.a).norm())
}
