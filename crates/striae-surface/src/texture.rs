//! Textures: a tangential direction at every node of a surface that deforms with it.
//!
//! A texture is painted on the reference surface ([`Paint`]) and split, node by
//! node and once for all, into ordinates along the edges of the surface. The
//! current direction follows from the current edges, so it is convected like a
//! line drawn on the surface. Source: R. E. Jones and P. Papadopoulos, "Simulating
//! anisotropic frictional response using smoothly interpolated traction fields",
//! Comput. Methods Appl. Mech. Engrg. 195 (2006), equations (48) to (51):
//!
//! ```text
//! A_I = alpha_f E_J + beta_f E_K + gamma_f N_I     on each facet f at I, E_J = X_J - X_I
//! s_I = (I - n n) (1/m) sum_f (alpha_f e_J + beta_f e_K) / |...|,    a_I = n_I x s_I
//! ```
//!
//! `J` and `K` are the corners before and after `I` on the facet, `m` is the number of
//! facets at `I`, `N` and `n` are the nodal normals. The split along the *nodal
//! normal* (instead of an orthogonal projection on the facets) gives back `A_I`
//! exactly in the reference configuration. `s` runs along the grooves or the row of
//! scales, `a` across it.
//!
//! Exact: the painted direction at rest; rotation with a rigid motion; `F A/|F A|`
//! for an affine motion of a plane surface. On curved surfaces the latter holds up to
//! `O(h^2)` at inner nodes of a smooth mesh, and up to `O(h)` at nodes of a free boundary,
//! where nodal normals are tilted because facets lie on one side only.
//!
//! Shapes: one entry of `positions` and `normals` per node of the surface, facets of four
//! corners in the numbering of the surface, outward by the right-hand rule, a triangle
//! repeating its last corner. Normals are unit vectors. Directions are dimensionless,
//! ordinates are 1/length. Errors: [`TextureError`].

mod axes;
mod axis;
mod error;
mod ordinates;
mod own;
mod paint;
mod radial_basis;
mod stated;
#[cfg(test)]
mod tests;

pub use axes::Axes;
pub use axis::Axis;
pub use error::{InadmissibleTexture, TextureError};
pub use num_dual::DualNum;
pub use ordinates::Ordinates;
pub use own::{DirectionField, OwnLines, PointLane};
pub use paint::{
    AXIAL, CIRCUMFERENTIAL, Field, Lines, NODAL, PAINTED, Paint, RADIAL, TURN, UNIFORM,
};
pub use radial_basis::Conditioning;

use crate::node::SurfaceNode;
use striae_declared::Declared;
use striae_mesh::Vec3;

/// The textures that decks and the Python package know by name.
pub static TEXTURES: &[&Declared<Paint>] = &[
    &UNIFORM,
    &CIRCUMFERENTIAL,
    &AXIAL,
    &RADIAL,
    &PAINTED,
    &NODAL,
];

/// A texture: the edge ordinates of every node of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    offsets: Vec<usize>,
    ring: Vec<SurfaceNode>,
    weights: Vec<f64>,
}

impl Texture {
    /// Paints the reference surface and splits the directions into ordinates.
    ///
    /// A rigid surface given by facets is painted in the same way, with positions
    /// that will not change; on a rigid plane [`Field::axes`] is the texture at any point.
    pub fn new(
        positions: &[Vec3],
        facets: &[[SurfaceNode; 4]],
        normals: &[Vec3],
        paint: &Paint,
    ) -> Result<(Self, Conditioning), TextureError> {
        ordinates::check(positions, facets, normals)?;
        let (directions, conditioning) = paint.directions(positions, facets, normals)?;
        let rings = ordinates::split(positions, facets, normals, &directions);
        let mut texture = Self {
            offsets: vec![0],
            ring: Vec::new(),
            weights: Vec::new(),
        };
        for ring in rings {
            for (neighbour, weight) in ring {
                texture.ring.push(neighbour);
                texture.weights.push(weight);
            }
            texture.offsets.push(texture.ring.len());
        }
        Ok((texture, conditioning))
    }

    /// The neighbours of a surface-local node and their ordinates.
    pub fn ordinates(&self, node: SurfaceNode) -> Ordinates<'_> {
        let range = self.offsets[node]..self.offsets[node.index() + 1];
        Ordinates {
            ring: &self.ring[range.clone()],
            weights: &self.weights[range],
        }
    }

    /// The texture at a surface-local node for current `positions` of the surface and the
    /// nodal normal.
    pub fn at(
        &self,
        node: SurfaceNode,
        positions: &[Vec3],
        normal: Vec3,
    ) -> Result<Axes<f64>, TextureError> {
        let ordinates = self.ordinates(node);
        let neighbours: Vec<Vec3> = (ordinates.ring.iter())
            .map(|&neighbour| positions[neighbour])
            .collect();
        ordinates
            .convect(positions[node], &neighbours, normal)
            .ok_or(TextureError::Vanishing { node })
    }
}
