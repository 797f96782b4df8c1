//! Contact forces along and across the textures of the sides.
//!
//! The contact force `f_I` on every surface node is resolved in the frame of the texture
//! where the node is, `s` along the grooves and `a = n x s` across them,
//!
//! ```text
//! F_along = sum_I f_I . s_I,   F_across = sum_I f_I . a_I
//! ```
//!
//! On a plane with a uniform texture these are components of the resultant; where
//! the texture turns over the surface, they are what the grooves feel: of a circumferential
//! texture `F_along` is the torque about its axis over the radius. The force is that on the
//! side that carries the texture. The frame at a node of a deformable side is that of its
//! nodal normal; on a rigid side, which has forces at the nodes of side `a`, it is that of
//! the rigid surface at the point nearest to the node, on facets of their nearest corner.

use striae_contact::{
    configuration::Configuration, interference::nearest_of, pair::Geometry, side::Side,
    texture::SideTexture,
};
use striae_mesh::Vec3;
use striae_surface::{node::SurfaceNode, normal::nodal_normals, texture::Texture};

use crate::{interference::configuration, problem::Problem, state::State};

/// Force along and across a texture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Resolved {
    /// Sum of `f . s`.
    pub along: f64,
    /// Sum of `f . a`.
    pub across: f64,
}

/// Directions `s` and `a`; zero where the texture has none.
type Directions = [Vec3; 2];

/// Force on each side of a pair in the frame of its texture; `None` for sides without one.
pub fn resolved(problem: &Problem, state: &State, pair: usize) -> [Option<Resolved>; 2] {
    let contact = &problem.pairs[pair].contact;
    Side::BOTH.map(|side| {
        let texture = contact.sides[side].texture.as_ref()?;
        // The opposite of the forces on `a`, where `b` is rigid.
        let (carrier, sign) = match contact.is_rigid() && side == Side::B {
            true => (Side::A, -1.0),
            false => (side, 1.0),
        };
        let forces = nodal_forces(problem, state, pair, carrier);
        let directions = match (texture, carrier == side) {
            (SideTexture::Nodal(texture), true) => {
                Box::new(on_nodes(problem, state, (pair, side), texture))
                    as Box<dyn Fn(SurfaceNode) -> Directions>
            }
            (texture, _) => Box::new(on_rigid(problem, state, pair, texture)),
        };
        let mut sum = Resolved::default();
        for (node, force) in forces.iter().enumerate() {
            if *force != Vec3::zeros() {
                let [s, a] = directions(SurfaceNode::new(node));
                sum.along += sign * force.dot(&s);
                sum.across += sign * force.dot(&a);
            }
        }
        Some(sum)
    })
}

/// Contact forces on the surface nodes of a deformable side.
fn nodal_forces(problem: &Problem, state: &State, pair: usize, side: Side) -> Vec<Vec3> {
    let surface = problem.pairs[pair].contact.sides[side].surface();
    let Some(surface) = surface else {
        return Vec::new();
    };
    let mut forces = vec![Vec3::zeros(); surface.nodes().len()];
    for (facet, of_facet) in &state.pairs[pair].facets[side] {
        let corners = &surface.facets()[facet.index()];
        for (corner, force) in corners.iter().zip(&of_facet.force) {
            forces[*corner] += force;
        }
    }
    forces
}

fn on_nodes<'a>(
    problem: &'a Problem,
    state: &'a State,
    (pair, side): (usize, Side),
    texture: &'a Texture,
) -> impl Fn(SurfaceNode) -> Directions + 'a {
    let surface = problem.pairs[pair].contact.sides[side].surface();
    let count = surface.map_or(0, |surface| surface.nodes().len());
    let nodes = SurfaceNode::all(count).filter_map(|node| problem.surface_node(pair, side, node));
    let x: Vec<Vec3> = nodes.map(|node| state.positions[node]).collect();
    let normals = surface.map_or_else(Vec::new, |surface| nodal_normals(surface, &x));
    move |node| {
        let axes = texture.at(node, &x, normals[node]);
        axes.map_or([Vec3::zeros(); 2], |axes| [axes.s, axes.a])
    }
}

fn on_rigid<'a>(
    problem: &'a Problem,
    state: &'a State,
    pair: usize,
    texture: &'a SideTexture,
) -> impl Fn(SurfaceNode) -> Directions + 'a {
    let configuration = configuration(problem, pair, state.into());
    move |node| {
        let x = configuration.side(Side::A).x[node];
        let axes = match (texture, &configuration.pair.sides[1].geometry) {
            (SideTexture::Plane(field), Geometry::Plane { point, normal }) => {
                let place = configuration.placement.back(&x);
                let place = place - normal * normal.dot(&(place - point));
                let turned = |e: Vec3| configuration.placement.direction(&e);
                let axes = field.axes(place, *normal);
                axes.map(|axes| [turned(axes.s), turned(axes.a)])
            }
            (SideTexture::Nodal(texture), _) => at_nearest(&configuration, texture, &x),
            (SideTexture::Plane(_), _) => None,
        };
        axes.unwrap_or([Vec3::zeros(); 2])
    }
}

/// Directions at the corner nearest to `x` of the facet nearest to it.
fn at_nearest(configuration: &Configuration, texture: &Texture, x: &Vec3) -> Option<Directions> {
    let target = configuration.side(Side::B);
    let nearest = nearest_of(target, x)?;
    let distance = |corner: &SurfaceNode| (target.x[*corner] - nearest.point).norm();
    let corners = target.corners(nearest.facet).into_iter();
    let corner = corners.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    let normal = target.normals[corner];
    let axes = texture.at(corner, &target.x, normal).ok()?;
    Some([axes.s, axes.a])
}
