//! A textured surface at rest, as points with their texture.

use striae_contact::{pair::Geometry, side::Side, texture::SideTexture};
use striae_mesh::{NodeId, Vec3};
use striae_model::pair_geometry::PairError;
use striae_solve::problem::Problem;
use striae_surface::{
    node::SurfaceNode,
    normal::nodal_normals,
    texture::{Field, Texture, TextureError},
    topology::Surface,
};

/// Squares on the longer edge of the grid on which a plane is sampled.
const SQUARES: f64 = 16.0;

/// By how much that grid reaches beyond the other side on every edge, over its longer edge.
const MARGIN: f64 = 0.1;

/// Points of a surface with their normals and textures; vectors of unit length, or
/// zero where a field has no direction.
pub struct TexturedSurface {
    /// Positions of the points.
    pub positions: Vec<Vec3>,
    /// Corners of the facets, counter-clockwise seen from outside.
    pub facets: Vec<Vec<NodeId>>,
    /// Normals at the points.
    pub normals: Vec<Vec3>,
    /// `s`, along the texture.
    pub along: Vec<Vec3>,
    /// `a = n x s`, across it.
    pub across: Vec<Vec3>,
}

impl TexturedSurface {
    /// A side of a pair; `None` where it has no texture.
    ///
    /// # Errors
    /// If the texture has no direction on the surface.
    pub fn new(problem: &Problem, pair: usize, side: Side) -> Result<Option<Self>, PairError> {
        let geometry = &problem.pairs[pair].contact.sides[side];
        let textured = match (&geometry.geometry, &geometry.texture) {
            (_, None) => return Ok(None),
            (Geometry::Plane { point, normal }, Some(SideTexture::Plane(field))) => {
                let opposite = positions(problem, pair, side.opposite());
                Self::on_plane(*point, *normal, field, &opposite)
            }
            (
                Geometry::Deformable(surface) | Geometry::Rigid(surface),
                Some(SideTexture::Nodal(texture)),
            ) => {
                let positions = positions(problem, pair, side);
                Self::on_facets(surface, positions, texture)
                    .map_err(|error| texture_error(problem, pair, side, surface, error))?
            }
            _ => unreachable!("planes and only planes are textured by fields"),
        };
        Ok(Some(textured))
    }

    fn on_facets(
        surface: &Surface,
        positions: Vec<Vec3>,
        texture: &Texture,
    ) -> Result<Self, TextureError> {
        let normals = nodal_normals(surface, &positions);
        let axes = normals.iter().enumerate();
        let axes = axes
            .map(|(node, normal)| texture.at(SurfaceNode::new(node), &positions, *normal))
            .collect::<Result<Vec<_>, _>>()?;
        let facets = surface.facets().iter().map(|corners| {
            let mut corners: Vec<NodeId> = corners.iter().map(|&corner| NodeId(corner.0)).collect();
            corners.dedup();
            corners
        });
        Ok(Self {
            facets: facets.collect(),
            along: axes.iter().map(|axes| axes.s).collect(),
            across: axes.iter().map(|axes| axes.a).collect(),
            positions,
            normals,
        })
    }

    fn on_plane(point: Vec3, normal: Vec3, field: &Field, opposite: &[Vec3]) -> Self {
        let [u, v] = in_plane(normal);
        let (low, high) = extent(opposite.iter().map(|x| [u, v].map(|e| e.dot(&(x - point)))));
        let [wide, high_] = [high[0] - low[0], high[1] - low[1]];
        let margin = MARGIN * wide.max(high_);
        let edges = [wide, high_].map(|length| length + 2.0 * margin);
        let size = edges[0].max(edges[1]) / SQUARES;
        let counts = edges.map(|edge| ((edge / size).round() as usize).max(1));
        let mut positions = Vec::new();
        for j in 0..=counts[1] {
            for i in 0..=counts[0] {
                let at = |axis: usize, index: usize| {
                    low[axis] - margin + edges[axis] * index as f64 / counts[axis] as f64
                };
                positions.push(point + u * at(0, i) + v * at(1, j));
            }
        }
        let row = counts[0] + 1;
        let square = |j: usize, i: usize| {
            let first = j * row + i;
            [first, first + 1, first + row + 1, first + row]
                .map(NodeId::new)
                .to_vec()
        };
        let facets = (0..counts[1]).flat_map(|j| (0..counts[0]).map(move |i| square(j, i)));
        let axes = positions.iter().map(|x| field.axes(*x, normal));
        let (along, across) = axes
            .map(|axes| axes.map_or((Vec3::zeros(), Vec3::zeros()), |axes| (axes.s, axes.a)))
            .unzip();
        Self {
            facets: facets.collect(),
            normals: vec![normal; positions.len()],
            along,
            across,
            positions,
        }
    }
}

/// Two unit vectors, the first to the right and the second up for a viewer whom
/// `normal` points at: up is `z` as far as it can be, or `y` for a viewer above or below.
pub(super) fn in_plane(normal: Vec3) -> [Vec3; 2] {
    let upright = if normal.z.abs() < 0.9 {
        Vec3::z()
    } else {
        Vec3::y()
    };
    let up = (upright - normal * normal.dot(&upright)).normalize();
    [up.cross(&normal), up]
}

/// Least and largest coordinates.
pub(super) fn extent(points: impl Iterator<Item = [f64; 2]>) -> ([f64; 2], [f64; 2]) {
    let none = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    points.fold(none, |(low, high), point| {
        (
            [0, 1].map(|axis| low[axis].min(point[axis])),
            [0, 1].map(|axis| high[axis].max(point[axis])),
        )
    })
}

/// Reference positions of the nodes of a side that has nodes.
fn positions(problem: &Problem, pair: usize, side: Side) -> Vec<Vec3> {
    let geometry = &problem.pairs[pair];
    match &geometry.contact.sides[side].geometry {
        Geometry::Deformable(surface) => SurfaceNode::all(surface.nodes().len())
            .filter_map(|node| problem.surface_node(pair, side, node))
            .map(|node| problem.reference[node])
            .collect(),
        Geometry::Rigid(_) => geometry.rigid_reference.clone(),
        Geometry::Itself | Geometry::Plane { .. } => Vec::new(),
    }
}

fn texture_error(
    problem: &Problem,
    pair: usize,
    side: Side,
    surface: &Surface,
    error: TextureError,
) -> PairError {
    PairError::Texture {
        pair: problem.model.pairs[pair].name.clone(),
        side: side as usize,
        surface: super::owner(&problem.model, pair, side),
        node: error
            .node()
            .and_then(|node| surface.nodes().get(node.index()).copied()),
        error,
    }
}
